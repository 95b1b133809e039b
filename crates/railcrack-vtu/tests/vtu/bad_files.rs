//! Invalid files: errors that name the file, the part and the fault, without a panic.

use super::{grid_of_every_shape, scratch};
use railcrack_vtu::{read_vtu, write_vtu};
use std::path::Path;

/// A triangle with decimal numbers.
const TRIANGLE: &str = r#"<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="3" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 -1 0</DataArray></Points>
<Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray>
</Cells>
<PointData><DataArray type="Float32" Name="t" format="ascii">1 2 3</DataArray></PointData>
</Piece></UnstructuredGrid></VTKFile>
"#;

fn message(path: &Path, content: &[u8]) -> String {
    std::fs::write(path, content).unwrap();
    let message = read_vtu(path).map(|grid| format!("{grid:?}")).unwrap_err().to_string();
    assert!(message.contains("bad.vtu"), "{message}");
    message
}

#[test]
fn errors_name_the_part_and_what_is_wrong() {
    let path = scratch("bad").join("bad.vtu");
    std::fs::write(&path, TRIANGLE).unwrap();
    assert_eq!(read_vtu(&path).unwrap().point_data[0].values, [1.0, 2.0, 3.0]);
    let changes = [
        ("NumberOfCells=\"1\"", "NumberOfCells=\"2\"", "array `offsets`: holds 1 numbers, not 2"),
        ("NumberOfPoints=\"3\"", "NumberOfPoints=\"-3\"", "NumberOfPoints is `-3`, not a count"),
        ("0 0 0 1 0 0 0 -1 0", "0 0 0 1 0 0 0 -1", "array `points`: holds 8 numbers, not 9"),
        ("0 0 0 1 0 0 0 -1 0", "0 0 0 1 0 0.5 0 -1 0", "point 1 (from 0) is at z = 0.5"),
        ("0 0 0 1 0 0 0 -1 0", "0 0 0 1 nan 0 0 -1 0", "`points` is NaN at entry 1"),
        (">0 1 2<", ">0 1 3<", "refers to point 3"),
        (">0 1 2<", ">0 1 -2<", "-2.0 is not an index of a grid"),
        (">5<", ">12<", "cell 0 (from 0) is of type 12 with 3 nodes: points (type 1)"),
        (">5<", ">9<", "of type 9 with 3 nodes"),
        (">3</DataArray>", ">1e300</DataArray>", "1e300 is not an index"),
        (">1 2 3<", ">1 2 three<", "array `t`: `three` is not a number"),
        ("Float32", "String", "type of array `t` is `String`"),
        (" Name=\"t\"", "", "<PointData>: an array without a Name"),
        ("Name=\"offsets\"", "Name=\"off\"", "has no `offsets` of <Cells>"),
        ("<VTKFile type=\"UnstructuredGrid\"", "<VTKFile type=\"PolyData\"", "is `PolyData`: only"),
        (
            "byte_order=",
            "compressor=\"vtkLZ4DataCompressor\" byte_order=",
            "compressor is `vtkLZ4DataCompressor`",
        ),
        ("LittleEndian", "Middle", "byte_order is `Middle`"),
        ("</VTKFile>", "", "is not XML"),
        (
            "\"t\" format=\"ascii\"",
            "\"t\" format=\"appended\" offset=\"0\"",
            "array `t`: there is no <AppendedData>",
        ),
        ("\"t\" format=\"ascii\"", "\"t\" format=\"octal\"", "format of array `t` is `octal`"),
        ("\"t\" format=\"ascii\"", "\"t\" format=\"binary\"", "array `t`: invalid base64 at byte 0 of 5"),
        ("Name=\"t\"", "Name=\"t\" NumberOfComponents=\"0\"", "NumberOfComponents is `0`"),
        ("</Piece>", "</Piece><Piece/>", "is of 2 pieces"),
    ];
    for (from, to, says) in changes {
        assert!(TRIANGLE.contains(from), "{from}");
        let message = message(&path, TRIANGLE.replacen(from, to, 1).as_bytes());
        assert!(message.contains(says), "{from} -> {to}: {message}");
    }
    let latin = TRIANGLE.replace("\"t\"", "\"\u{e9}\"").chars().map(|c| c as u8).collect::<Vec<_>>();
    assert!(message(&path, &latin).contains("is not UTF-8"));
    std::fs::remove_file(&path).unwrap();
    assert!(read_vtu(&path).unwrap_err().to_string().starts_with("cannot read "));
}

#[test]
fn a_file_cut_anywhere_is_an_error() {
    let folder = scratch("cut");
    let whole = folder.join("whole.vtu");
    write_vtu(&whole, &grid_of_every_shape()).unwrap();
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../verification/vtu/samples");
    let files = [whole, samples.join("vtk_appended_raw.vtu"), samples.join("vtk_zlib_appended_raw.vtu")];
    for file in files {
        let bytes = std::fs::read(&file).unwrap();
        let end = bytes.windows(9).rposition(|window| window == b"</VTKFile").unwrap();
        // The markup after the appended data is not read.
        let markup = bytes.windows(15).rposition(|window| window == b"</AppendedData>").unwrap_or(end);
        for at in (0..markup.saturating_sub(8)).step_by(37) {
            message(&folder.join("bad.vtu"), &bytes[..at]);
        }
    }
}

#[test]
fn lies_about_lengths_are_errors() {
    let path = scratch("lies").join("bad.vtu");
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../verification/vtu/samples");
    // Bytes of the first header: where compressed, number of blocks, and size of the only block
    // after two more counts; else the size.
    let first_count = [0, 1, 2, 3];
    let lengths = [
        ("vtk_appended_raw.vtu", &first_count[..]),
        ("vtk_zlib_appended_raw.vtu", &[0, 1, 2, 3, 12, 13, 14, 15]),
    ];
    for (name, places) in lengths {
        let bytes = std::fs::read(samples.join(name)).unwrap();
        let appended = bytes.windows(13).position(|window| window == b"<AppendedData").unwrap();
        let first = appended + bytes[appended..].iter().position(|&byte| byte == b'_').unwrap() + 1;
        for at in places {
            let mut lie = bytes.clone();
            lie[first + at] ^= 0xff;
            message(&path, &lie);
        }
    }
}
