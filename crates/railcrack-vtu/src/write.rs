//! Writer of `.vtu` files.

use crate::cell_type::vtk_type;
use crate::error::VtuError;
use data_encoding::BASE64;
use miniz_oxide::deflate::compress_to_vec_zlib;
use railcrack::mesh::{Array, GridError, SYMMETRIC_TENSOR, UnstructuredGrid};
use std::fs;
use std::path::Path;

/// Size in bytes of a block of compressed numbers, as in VTK.
const BLOCK: usize = 1 << 15;
/// Compression level of zlib. At higher levels coordinates and stresses shrink no further but take
/// several times as long.
const LEVEL: u8 = 3;

/// Writes `grid` to the file `path` as [`vtu_text`]. The file is written under a temporary name in
/// the same folder and then renamed.
///
/// Errors: an inconsistent grid; a number that is not finite; an error of the operating system.
pub fn write_vtu(path: &Path, grid: &UnstructuredGrid) -> Result<(), VtuError> {
    let text = vtu_text(grid).map_err(|reason| VtuError::Grid { path: path.to_path_buf(), reason })?;
    put(path, &text)
}

/// Renames the finished file.
pub(super) fn put(path: &Path, text: &[u8]) -> Result<(), VtuError> {
    let mut name = path.as_os_str().to_owned();
    name.push(".partial");
    let refused = |reason| VtuError::Io { action: "write", path: path.to_path_buf(), reason };
    fs::write(&name, text).map_err(refused)?;
    fs::rename(&name, path).map_err(refused)
}

/// As [`vtu_text_with`], without data of the whole grid.
///
/// Errors: an inconsistent grid; a number that is not finite.
pub fn vtu_text(grid: &UnstructuredGrid) -> Result<Vec<u8>, GridError> {
    vtu_text_with(grid, &[])
}

/// The contents of the file of `grid`, with the field data `of_all` of the whole grid: numbers in
/// base64, little endian, with headers of 64 bits, compressed in blocks by zlib as VTK does by
/// default. Points of the plane get z = 0. The text is ASCII except for the names of arrays.
///
/// Errors: an inconsistent grid; a number that is not finite.
pub fn vtu_text_with(grid: &UnstructuredGrid, of_all: &[Array]) -> Result<Vec<u8>, GridError> {
    grid.check()?;
    for array in grid.point_data.iter().chain(&grid.cell_data).chain(of_all) {
        array.finite()?;
    }
    let mut points = Array::vectors("points", &grid.points);
    points.values.iter_mut().skip(2).step_by(3).zip(&grid.z).for_each(|(to, z)| *to = *z);
    points.finite()?;
    let mut text = Vec::new();
    line(&mut text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    line(
        &mut text,
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" \
         compressor=\"vtkZLibDataCompressor\">",
    );
    line(&mut text, "<UnstructuredGrid>");
    if !of_all.is_empty() {
        line(&mut text, "<FieldData>");
        for array in of_all {
            let bytes: Vec<u8> = array.values.iter().flat_map(|value| value.to_le_bytes()).collect();
            let count = array.values.len() / array.components.max(1);
            let name = escaped(&array.name);
            let attributes = format!("type=\"Float64\" Name=\"{name}\" NumberOfTuples=\"{count}\"");
            binary_array(&mut text, &attributes, &bytes);
        }
        line(&mut text, "</FieldData>");
    }
    let (count, cells) = (grid.points.len(), grid.cell_count());
    line(&mut text, &format!("<Piece NumberOfPoints=\"{count}\" NumberOfCells=\"{cells}\">"));
    line(&mut text, "<Points>");
    real_array(&mut text, &points);
    line(&mut text, "</Points>");
    cell_arrays(&mut text, grid);
    for (element, data) in [("PointData", &grid.point_data), ("CellData", &grid.cell_data)] {
        line(&mut text, &format!("<{element}>"));
        for array in data {
            real_array(&mut text, array);
        }
        line(&mut text, &format!("</{element}>"));
    }
    line(&mut text, "</Piece>");
    line(&mut text, "</UnstructuredGrid>");
    line(&mut text, "</VTKFile>");
    Ok(text)
}

fn line(text: &mut Vec<u8>, line: &str) {
    text.extend_from_slice(line.as_bytes());
    text.push(b'\n');
}

fn cell_arrays(text: &mut Vec<u8>, grid: &UnstructuredGrid) {
    let (mut connectivity, mut offsets, mut types) = (Vec::new(), Vec::new(), Vec::new());
    let mut end = 0;
    for block in &grid.cells {
        connectivity.extend(block.connectivity.iter().flat_map(|&point| (point as i64).to_le_bytes()));
        for _ in block.cells() {
            end += block.shape.nodes() as i64;
            offsets.extend_from_slice(&end.to_le_bytes());
            types.push(vtk_type(block.shape));
        }
    }
    line(text, "<Cells>");
    binary_array(text, "type=\"Int64\" Name=\"connectivity\"", &connectivity);
    binary_array(text, "type=\"Int64\" Name=\"offsets\"", &offsets);
    binary_array(text, "type=\"UInt8\" Name=\"types\"", &types);
    line(text, "</Cells>");
}

fn real_array(text: &mut Vec<u8>, array: &Array) {
    let bytes: Vec<u8> = array.values.iter().flat_map(|value| value.to_le_bytes()).collect();
    let mut attributes = format!("type=\"Float64\" Name=\"{}\"", escaped(&array.name));
    // One component is the default of the attribute; with it, some readers give a table of one
    // column.
    if array.components > 1 {
        attributes.push_str(&format!(" NumberOfComponents=\"{}\"", array.components));
    }
    if array.components == SYMMETRIC_TENSOR.len() {
        // Programs that display the file label the components with these names.
        for (i, name) in SYMMETRIC_TENSOR.iter().enumerate() {
            attributes.push_str(&format!(" ComponentName{i}=\"{name}\""));
        }
    }
    binary_array(text, &attributes, &bytes);
}

fn binary_array(text: &mut Vec<u8>, attributes: &str, bytes: &[u8]) {
    line(text, &format!("<DataArray {attributes} format=\"binary\">"));
    let blocks: Vec<Vec<u8>> = bytes.chunks(BLOCK).map(|block| compress_to_vec_zlib(block, LEVEL)).collect();
    // Number of blocks, bytes of a full one, bytes of the last one if it is not full, compressed
    // bytes of each.
    let sizes = [blocks.len(), BLOCK, bytes.len() % BLOCK];
    let sizes = sizes.into_iter().chain(blocks.iter().map(Vec::len));
    let header: Vec<u8> = sizes.flat_map(|size| (size as u64).to_le_bytes()).collect();
    text.extend(BASE64.encode(&header).into_bytes());
    text.extend(BASE64.encode(&blocks.concat()).into_bytes());
    line(text, "\n</DataArray>");
}

/// Whether `letter` is none in XML: the two noncharacters of the basic plane.
fn is_no_character(letter: char) -> bool {
    matches!(letter, '\u{fffe}' | '\u{ffff}')
}

/// `text` as the content of an element or the value of a quoted attribute, in XML and in HTML.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // Neither format can represent them.
            control if (control.is_control() && control != '\n') || is_no_character(control) => out.push(' '),
            other => out.push(other),
        }
    }
    out
}
