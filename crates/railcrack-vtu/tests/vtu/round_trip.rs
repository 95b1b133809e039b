//! Round trips with identical bits, and rejection of inconsistent grids on writing.

use super::{grid_of_every_shape, scratch};
use railcrack::math::{Stress, Vec2};
use railcrack::mesh::{Array, CellBlock, CellShape, GridError, UnstructuredGrid};
use railcrack_vtu::{Snapshot, VtuError, read_vtu, write_pvd, write_vtu};

#[test]
fn every_shape_and_every_bit_comes_back() {
    let path = scratch("round-trip").join("grid.vtu");
    let grid = grid_of_every_shape();
    assert_eq!((grid.cell_count(), grid.cells[2].cell_count()), (12, 2));
    write_vtu(&path, &grid).unwrap();
    assert_eq!(read_vtu(&path).unwrap(), grid);
    // Compares bits, not only values.
    let zeros = UnstructuredGrid {
        points: vec![Vec2::new(-0.0, 5e-324)],
        point_data: vec![Array::scalars("x", vec![-0.0])],
        ..UnstructuredGrid::default()
    };
    write_vtu(&path, &zeros).unwrap();
    let read = read_vtu(&path).unwrap();
    assert!(read.points[0].x.is_sign_negative() && read.point_data[0].values[0].is_sign_negative());
    assert_eq!(read.points[0].y, 5e-324);
    write_vtu(&path, &UnstructuredGrid::default()).unwrap();
    assert_eq!(read_vtu(&path).unwrap(), UnstructuredGrid::default());
}

#[test]
fn arrays_become_vectors_and_stresses() {
    let stress = Stress { xx: 1.0, yy: 2.0, zz: 3.0, xy: 4.0 };
    let written = Array::stresses("s", &[stress]);
    assert_eq!(written.values, [1.0, 2.0, 3.0, 4.0, 0.0, 0.0], "XX, YY, ZZ, XY, YZ, XZ");
    assert_eq!(written.to_stresses().unwrap(), [stress]);
    assert_eq!(Array::vectors("u", &[Vec2::new(5.0, 6.0)]).values, [5.0, 6.0, 0.0]);
    let four = Array { name: "s".to_owned(), components: 4, values: vec![1.0, 2.0, 3.0, 4.0] };
    assert_eq!(four.to_stresses().unwrap(), [stress]);
    let wrong = four.to_vectors().unwrap_err();
    assert_eq!(wrong.to_string(), "`s` has 4 components: must be 2 or 3");
    let hole = Array { values: vec![1.0, 2.0, 3.0, f64::NAN], ..four };
    assert_eq!(
        hole.to_stresses().unwrap_err().to_string(),
        "`s` is NaN at entry 0 (from 0): must be a finite number"
    );
}

#[test]
fn what_does_not_fit_together_is_not_written() {
    let folder = scratch("refused");
    let path = folder.join("grid.vtu");
    let fine = grid_of_every_shape();
    let refused = |change: &dyn Fn(&mut UnstructuredGrid)| {
        let mut grid = fine.clone();
        change(&mut grid);
        match write_vtu(&path, &grid).unwrap_err() {
            VtuError::Grid { reason, .. } => reason,
            other => panic!("{other}"),
        }
    };
    assert_eq!(
        refused(&|grid| grid.cells[1].connectivity.truncate(5)),
        GridError::PartialCell { block: 1, found: 5, nodes: 3 }
    );
    let digon = CellBlock { shape: CellShape::Polygon { corners: 2 }, connectivity: vec![0, 1] };
    assert!(matches!(
        refused(&|grid| grid.cells[8] = digon.clone()),
        GridError::PartialCell { block: 8, nodes: 2, .. }
    ));
    assert_eq!(
        refused(&|grid| grid.cells[0].connectivity[3] = 9),
        GridError::NoSuchPoint { block: 0, point: 9, points: 9 }
    );
    assert!(matches!(
        refused(&|grid| grid.point_data[1].values.truncate(53)),
        GridError::Length { found: 53, components: 6, entries: 9, .. }
    ));
    assert!(matches!(
        refused(&|grid| grid.cell_data[1].name = "material".to_owned()),
        GridError::SameName { .. }
    ));
    assert!(matches!(
        refused(&|grid| grid.points[4].y = f64::INFINITY),
        GridError::NotFinite { entry: 4, .. }
    ));
    assert!(matches!(
        refused(&|grid| grid.cell_data[1].values[7] = f64::NAN),
        GridError::NotFinite { entry: 3, .. }
    ));
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
    let nowhere = write_vtu(&folder.join("absent/grid.vtu"), &fine).unwrap_err().to_string();
    assert!(nowhere.starts_with("cannot write ") && nowhere.contains("absent/grid.vtu"), "{nowhere}");
}

#[test]
fn a_collection_names_its_grids_in_order() {
    let path = scratch("collection").join("fields.pvd");
    let snapshot = |time, file: &str| Snapshot { time, file: file.to_owned() };
    write_pvd(&path, &[snapshot(-6.0, "fields/a&b.vtu"), snapshot(0.1, "fields/2.vtu")]).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    assert_eq!(document.root_element().attribute("type"), Some("Collection"));
    let sets: Vec<_> = document
        .descendants()
        .filter(|node| node.has_tag_name("DataSet"))
        .map(|node| (node.attribute("timestep").unwrap(), node.attribute("file").unwrap()))
        .collect();
    assert_eq!(sets, [("-6", "fields/a&b.vtu"), ("0.1", "fields/2.vtu")]);
    let endless = write_pvd(&path, &[snapshot(f64::NAN, "a.vtu")]).unwrap_err().to_string();
    assert!(endless.contains("`time` is NaN at entry 0"), "{endless}");
}
