//! Reader of `.vtu` files.

use crate::cell_type::shape_of;
use crate::error::{Fault, VtuError};
use crate::numbers::{ByteOrder, NumberType};
use crate::payload::{Compression, Encoding, Payload, index};
use railcrack::math::Vec2;
use railcrack::mesh::{Array, CellBlock, GridError, UnstructuredGrid};
use roxmltree::{Document, Node};
use std::path::Path;

/// Reads the grid in the file `path`: files of this library and of other programs. Numbers may be
/// decimal, in base64 or appended (raw or in base64), of any type and byte order, compressed by
/// zlib or not; cells are those of [`CellShape`](railcrack::mesh::CellShape); arrays of strings are
/// ignored. Values of data are returned as they are, finite or not: see [`Array::finite`].
///
/// Errors: an error of the operating system; a file of another kind, with several pieces, with
/// cells that have no [`CellShape`](railcrack::mesh::CellShape) or with an unsupported compression;
/// an array that ends early, is too long or does not hold numbers; a point off the plane z = 0; a
/// cell that refers to a missing point.
pub fn read_vtu(path: &Path) -> Result<UnstructuredGrid, VtuError> {
    let refused = |reason| VtuError::Io { action: "read", path: path.to_path_buf(), reason };
    if !std::fs::metadata(path).map_err(refused)?.is_file() {
        // A device may be endless, and a pipe would block until another program writes to it.
        return Err(refused(std::io::Error::other("it is not a regular file")));
    }
    let bytes = std::fs::read(path).map_err(refused)?;
    read_vtu_bytes(&bytes, path)
}

/// [`read_vtu`] of the contents of a file, which messages call `path`.
///
/// Errors: those of [`read_vtu`] except errors of the operating system.
pub fn read_vtu_bytes(bytes: &[u8], path: &Path) -> Result<UnstructuredGrid, VtuError> {
    grid_of(bytes).map_err(|fault| fault.of(path))
}

/// The contents of `<AppendedData>`, starting with its first byte.
#[derive(Debug, Clone, Copy)]
struct Appended<'a> {
    bytes: &'a [u8],
    is_raw: bool,
}

/// Splits off the appended data, which need not be text.
fn split(bytes: &[u8]) -> Result<(String, Option<&[u8]>), Fault> {
    const OPEN: &[u8] = b"<AppendedData";
    let find = |from: usize, what: &[u8]| {
        bytes[from..].windows(what.len()).position(|window| window == what).map(|at| from + at)
    };
    let (xml, appended) = match find(0, OPEN) {
        None => (bytes, None),
        Some(open) => {
            let tag = find(open, b">").map(|end| end + 1);
            let begin = tag.and_then(|end| find(end, b"_")).map(|underscore| underscore + 1);
            let (Some(tag), Some(begin)) = (tag, begin) else {
                return Err(Fault::malformed("<AppendedData>", "has no `_` that begins the data"));
            };
            (&bytes[..tag], Some(&bytes[begin..]))
        }
    };
    let mut text = std::str::from_utf8(xml)
        .map_err(|reason| Fault::malformed("the file", format!("is not UTF-8 text: {reason}")))?
        .to_owned();
    if appended.is_some() {
        text.push_str("</AppendedData></VTKFile>");
    }
    Ok((text, appended))
}

fn grid_of(bytes: &[u8]) -> Result<UnstructuredGrid, Fault> {
    let (text, appended) = split(bytes)?;
    let document = Document::parse(&text)
        .map_err(|reason| Fault::malformed("the file", format!("is not XML: {reason}")))?;
    let root = document.root_element();
    if root.tag_name().name() != "VTKFile" {
        return Err(Fault::malformed(
            format!("<{}>", root.tag_name().name()),
            "the file must begin <VTKFile>",
        ));
    }
    let kind = root.attribute("type").unwrap_or("");
    if kind != "UnstructuredGrid" {
        let accepted = "only UnstructuredGrid is read";
        return Err(Fault::unsupported("type of <VTKFile>", format!("`{kind}`"), accepted));
    }
    let appended = appended
        .zip(child(root, "AppendedData"))
        .map(|(bytes, element)| Appended { bytes, is_raw: element.attribute("encoding") == Some("raw") });
    let file = File { encoding: encoding(root)?, appended };
    let grid = child(root, "UnstructuredGrid")
        .ok_or_else(|| Fault::malformed("<VTKFile>", "has no <UnstructuredGrid>"))?;
    let pieces: Vec<Node> = children(grid, "Piece").collect();
    match pieces[..] {
        [piece] => file.grid(piece),
        _ => {
            let accepted = "one <Piece> is read: merge the pieces and write them as one";
            Err(Fault::unsupported("<UnstructuredGrid>", format!("of {} pieces", pieces.len()), accepted))
        }
    }
}

fn encoding(root: Node) -> Result<Encoding, Fault> {
    let order = match root.attribute("byte_order").unwrap_or("LittleEndian") {
        "LittleEndian" => ByteOrder::Little,
        "BigEndian" => ByteOrder::Big,
        other => {
            let accepted = "LittleEndian and BigEndian are read";
            return Err(Fault::unsupported("byte_order", format!("`{other}`"), accepted));
        }
    };
    let header = match root.attribute("header_type").unwrap_or("UInt32") {
        "UInt32" => NumberType::UInt32,
        "UInt64" => NumberType::UInt64,
        other => {
            let accepted = "UInt32 and UInt64 are read";
            return Err(Fault::unsupported("header_type", format!("`{other}`"), accepted));
        }
    };
    let compression = match root.attribute("compressor").unwrap_or("") {
        "" => Compression::None,
        "vtkZLibDataCompressor" => Compression::Zlib,
        other => {
            let accepted = "files without compression and with that of zlib are read";
            return Err(Fault::unsupported("compressor", format!("`{other}`"), accepted));
        }
    };
    Ok(Encoding { order, header, compression })
}

/// The properties shared by all arrays of a file.
struct File<'a> {
    encoding: Encoding,
    appended: Option<Appended<'a>>,
}

impl File<'_> {
    fn grid(&self, piece: Node) -> Result<UnstructuredGrid, Fault> {
        let (points, cells) = (count(piece, "NumberOfPoints")?, count(piece, "NumberOfCells")?);
        let grid = UnstructuredGrid {
            points: self.points(piece, points)?,
            z: Vec::new(),
            cells: self.cells(piece, cells)?,
            point_data: self.data(piece, "PointData", points)?,
            cell_data: self.data(piece, "CellData", cells)?,
        };
        grid.check()?;
        Ok(grid)
    }

    fn points(&self, piece: Node, count: usize) -> Result<Vec<Vec2>, Fault> {
        let array = child(piece, "Points").and_then(|points| child(points, "DataArray"));
        let Some(array) = array else {
            return if count == 0 { Ok(Vec::new()) } else { Err(missing("<Points>")) };
        };
        let points = self.array(array, "points", count)?;
        if points.components != 3 {
            let (name, found) = (points.name, points.components);
            return Err(GridError::Components { name, found, accepted: "3" }.into());
        }
        points.finite()?;
        match points.entries().position(|point| point[2] != 0.0) {
            None => Ok(points.to_vectors()?),
            Some(i) => {
                let z = points.values[3 * i + 2];
                let (part, accepted) =
                    (format!("point {i} (from 0)"), "only grids of the plane z = 0 are read");
                Err(Fault::unsupported(part, format!("at z = {z}"), accepted))
            }
        }
    }

    fn cells(&self, piece: Node, count: usize) -> Result<Vec<CellBlock>, Fault> {
        if count == 0 {
            return Ok(Vec::new());
        }
        let cells = child(piece, "Cells").ok_or_else(|| missing("<Cells>"))?;
        let indices = |name: &str, count: usize| -> Result<Vec<usize>, Fault> {
            let array = children(cells, "DataArray").find(|array| array.attribute("Name") == Some(name));
            let array =
                self.array(array.ok_or_else(|| missing(&format!("`{name}` of <Cells>")))?, name, count)?;
            let index = |&value: &f64| {
                index(value)
                    .ok_or_else(|| Fault::malformed(name, format!("{value:?} is not an index of a grid")))
            };
            array.values.iter().map(index).collect()
        };
        let offsets = indices("offsets", count)?;
        let types = indices("types", count)?;
        let connectivity = indices("connectivity", offsets.last().copied().unwrap_or(0))?;
        let mut blocks: Vec<CellBlock> = Vec::new();
        let mut begin = 0;
        for (cell, (&end, &vtk_type)) in offsets.iter().zip(&types).enumerate() {
            let nodes = connectivity.get(begin..end).ok_or_else(|| {
                Fault::malformed(
                    "offsets",
                    format!("cell {cell} (from 0) ends at {end} and begins at {begin}"),
                )
            })?;
            let shape = u8::try_from(vtk_type).ok().and_then(|kind| shape_of(kind, nodes.len()));
            let shape = shape.ok_or_else(|| {
                let found = format!("of type {vtk_type} with {} nodes", nodes.len());
                let accepted = "points (type 1), lines (3, 21), triangles (5, 22), quads (9, 23, 28) and polygons (7) are read";
                Fault::unsupported(format!("cell {cell} (from 0)"), found, accepted)
            })?;
            match blocks.last_mut().filter(|block| block.shape == shape) {
                Some(block) => block.connectivity.extend_from_slice(nodes),
                None => blocks.push(CellBlock { shape, connectivity: nodes.to_vec() }),
            }
            begin = end;
        }
        Ok(blocks)
    }

    fn data(&self, piece: Node, element: &str, entries: usize) -> Result<Vec<Array>, Fault> {
        let arrays = child(piece, element).into_iter().flat_map(|data| children(data, "DataArray"));
        let named = |array: Node| {
            let name = array.attribute("Name");
            let name =
                name.ok_or_else(|| Fault::malformed(format!("<{element}>"), "an array without a Name"))?;
            self.array(array, name, entries)
        };
        arrays.map(named).collect()
    }

    /// The array of the element `array`, called `name`, with the given number of entries.
    fn array(&self, array: Node, name: &str, entries: usize) -> Result<Array, Fault> {
        let part = format!("array `{name}`");
        let kind = array.attribute("type").unwrap_or("");
        let number = NumberType::named(kind).ok_or_else(|| {
            let accepted = "Int8 to Int64, UInt8 to UInt64, Float32 and Float64 are read";
            Fault::unsupported(format!("type of {part}"), format!("`{kind}`"), accepted)
        })?;
        let components = match array.attribute("NumberOfComponents") {
            None => 1,
            Some(text) => {
                text.trim().parse().ok().filter(|&components: &usize| components > 0).ok_or_else(|| {
                    Fault::malformed(&part, format!("NumberOfComponents is `{text}`, not a positive number"))
                })?
            }
        };
        let count = components
            .checked_mul(entries)
            .ok_or_else(|| Fault::malformed(&part, "is larger than any file"))?;
        let values = self.payload(array, &part)?.numbers(&part, number, count, self.encoding)?;
        Ok(Array { name: name.to_owned(), components, values })
    }

    fn payload<'a>(&'a self, array: Node<'a, '_>, part: &str) -> Result<Payload<'a>, Fault> {
        let text = array.text().unwrap_or("");
        match array.attribute("format").unwrap_or("ascii") {
            "ascii" => Ok(Payload::Ascii(text)),
            "binary" => Ok(Payload::Base64(text.as_bytes())),
            "appended" => {
                let Appended { bytes, is_raw } =
                    self.appended.ok_or_else(|| Fault::malformed(part, "there is no <AppendedData>"))?;
                let offset = array.attribute("offset").unwrap_or("");
                let from = offset.trim().parse().ok().and_then(|offset: usize| bytes.get(offset..));
                let from = from.ok_or_else(|| {
                    let reason =
                        format!("offset `{offset}` is not within the {} bytes appended", bytes.len());
                    Fault::malformed(part, reason)
                })?;
                Ok(if is_raw { Payload::Raw(from) } else { Payload::Base64(from) })
            }
            other => {
                let accepted = "ascii, binary and appended are read";
                Err(Fault::unsupported(format!("format of {part}"), format!("`{other}`"), accepted))
            }
        }
    }
}

fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|child| child.has_tag_name(name))
}

fn children<'a, 'i>(node: Node<'a, 'i>, name: &str) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(move |child| child.has_tag_name(name))
}

fn missing(part: &str) -> Fault {
    Fault::malformed("<Piece>", format!("has no {part}"))
}

fn count(piece: Node, name: &str) -> Result<usize, Fault> {
    let text = piece.attribute(name).unwrap_or("");
    let refused = |_| Fault::malformed("<Piece>", format!("{name} is `{text}`, not a count"));
    text.trim().parse().map_err(refused)
}
