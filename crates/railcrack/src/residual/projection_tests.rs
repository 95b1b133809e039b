use super::{PlasticField, PlasticFieldError};
use crate::math::{Stress, Vec2};
use crate::mesh::{Array, CellBlock, CellShape, UnstructuredGrid};

fn linear(p: Vec2) -> Stress {
    Stress { xx: 30.0 + 2.0 * p.x - 5.0 * p.y, yy: -4.0 + p.y, zz: 1.0 - p.x, xy: 0.3 * p.x - p.y }
}

/// Uneven squares from x = −6 to 6 mm and down to 5 mm, divided into triangles if `shape` requires
/// it.
fn uneven(shape: CellShape) -> UnstructuredGrid {
    let (columns, rows) = (6, 5);
    let place = |i: usize, j: usize| {
        let inner = i > 0 && i < columns && j > 0 && j < rows;
        let shake = if inner { 0.3 * ((7 * i + 3 * j) as f64).sin() } else { 0.0 };
        Vec2::new(-6.0 + 2.0 * i as f64 + shake, -5.0 + j as f64 - shake)
    };
    let points = (0..=rows).flat_map(|j| (0..=columns).map(move |i| place(i, j))).collect();
    let at = move |i: usize, j: usize| j * (columns + 1) + i;
    let square = move |i: usize, j: usize| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
    let squares = (0..rows).flat_map(|j| (0..columns).map(move |i| square(i, j)));
    let connectivity = squares
        .flat_map(|[a, b, c, d]| match shape {
            CellShape::Triangle => vec![a, b, c, a, c, d],
            _ => vec![a, b, c, d],
        })
        .collect();
    UnstructuredGrid { points, cells: vec![CellBlock { shape, connectivity }], ..UnstructuredGrid::default() }
}

/// The field given by values at nodes or at the centroids of cells.
fn field(mut grid: UnstructuredGrid, value: impl Fn(Vec2) -> Stress, on_cells: bool) -> PlasticField {
    if on_cells {
        let middles =
            grid.cells[0].cells().map(|nodes| centroid(nodes.iter().map(|&n| grid.points[n]).collect()));
        let values: Vec<Stress> = middles.map(value).collect();
        grid.cell_data = vec![Array::stresses("plastic_stress_mpa", &values)];
    } else {
        let values: Vec<Stress> = grid.points.iter().map(|&p| value(p)).collect();
        grid.point_data = vec![Array::stresses("plastic_stress_mpa", &values)];
    }
    PlasticField::from_grid(&grid).unwrap()
}

/// Centroid of a polygon, where linear fields equal their mean.
fn centroid(corners: Vec<Vec2>) -> Vec2 {
    let (mut area, mut sum) = (0.0, Vec2::default());
    for i in 0..corners.len() {
        let (p, q) = (corners[i], corners[(i + 1) % corners.len()]);
        let twice = p.x * q.y - p.y * q.x;
        area += 0.5 * twice;
        sum = sum + (p + q) * (twice / 6.0);
    }
    sum * (1.0 / area)
}

fn probes() -> impl Iterator<Item = Vec2> {
    (0..=23)
        .flat_map(|i| (0..=19).map(move |j| Vec2::new(-6.0 + 12.0 * i as f64 / 23.0, -5.0 * j as f64 / 19.0)))
}

fn distance(one: Stress, other: Stress) -> f64 {
    (one - other).squared().sqrt()
}

#[test]
fn linear_fields_are_reproduced_exactly() {
    for shape in [CellShape::Triangle, CellShape::Quad] {
        for on_cells in [false, true] {
            let field = field(uneven(shape), linear, on_cells);
            for point in probes() {
                let error = distance(field.plastic_stress(point), linear(point));
                // Reference coordinates to 1e-12 of values around 50.
                assert!(error < 1e-9, "{shape:?}, on cells: {on_cells}, at {point:?}: {error}");
            }
        }
    }
}

#[test]
fn smooth_fields_on_cells_converge_with_the_second_order() {
    let smooth = |p: Vec2| Stress { xx: (0.9 * p.y).sin() * (0.5 * p.x).cos(), ..Stress::ZERO };
    let mean_error = |count: usize| {
        let points = (0..=count)
            .flat_map(|j| {
                (0..=count).map(move |i| {
                    Vec2::new(-6.0 + 12.0 * i as f64 / count as f64, -5.0 + 5.0 * j as f64 / count as f64)
                })
            })
            .collect();
        let at = |i: usize, j: usize| j * (count + 1) + i;
        let connectivity = (0..count)
            .flat_map(|j| {
                (0..count).flat_map(move |i| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
            })
            .collect();
        let grid = UnstructuredGrid {
            points,
            cells: vec![CellBlock { shape: CellShape::Quad, connectivity }],
            ..UnstructuredGrid::default()
        };
        let field = field(grid, smooth, true);
        probes().map(|p| distance(field.plastic_stress(p), smooth(p))).sum::<f64>() / probes().count() as f64
    };
    let errors = [10, 20, 40].map(mean_error);
    let order = (errors[0] / errors[2]).log2() / 2.0;
    assert!(order > 1.8, "order {order}: {errors:?}");
}

#[test]
fn the_loss_is_that_of_the_norms() {
    // Layers of a profile in one column of cells, as written for a steady state.
    let depths = [0.0, 0.5, 1.0, 2.0, 4.0, 20.0];
    let values = [-80.0, -120.0, -40.0, 10.0, 0.0];
    let points = depths.iter().flat_map(|&d| [Vec2::new(-100.0, -d), Vec2::new(100.0, -d)]).collect();
    let connectivity = (0..values.len()).flat_map(|i| [2 * i + 2, 2 * i + 3, 2 * i + 1, 2 * i]).collect();
    let stresses: Vec<Stress> = values.iter().map(|&xx| Stress { xx, ..Stress::ZERO }).collect();
    let grid = UnstructuredGrid {
        z: Vec::new(),
        points,
        cells: vec![CellBlock { shape: CellShape::Quad, connectivity }],
        point_data: vec![],
        cell_data: vec![Array::stresses("plastic_stress_mpa", &stresses)],
    };
    let field = PlasticField::from_grid(&grid).unwrap();
    // The means over the layers are close to the given ones.
    let at = |depth: f64| field.plastic_stress(Vec2::new(3.0, -depth)).xx;
    for (layer, value) in depths.windows(2).zip(values) {
        let mean = 0.5 * (at(layer[0]) + at(layer[1]));
        assert!((mean - value).abs() < 24.0, "{layer:?}: {mean} for {value}"); // a fifth of the largest
    }
    let loss = field.recovery_loss().unwrap();
    let norm: f64 = (0..5).map(|i| 200.0 * (depths[i + 1] - depths[i]) * values[i] * values[i]).sum();
    assert!((loss.norm - norm.sqrt()).abs() < 1e-6 * norm, "{loss:?}");
    let count = 20_000;
    let (mut kept, mut difference) = (0.0, 0.0);
    for i in 0..count {
        let depth = 20.0 * (i as f64 + 0.5) / count as f64;
        let layer = depths.partition_point(|&d| d <= depth) - 1;
        let weight = 200.0 * 20.0 / count as f64;
        kept += weight * at(depth).powi(2);
        difference += weight * (at(depth) - values[layer]).powi(2);
    }
    // The sum over depths is a sum of rectangles.
    assert!((loss.norm_ratio - (kept / norm).sqrt()).abs() < 1e-4, "{loss:?}");
    assert!((loss.difference - (difference / norm).sqrt()).abs() < 1e-4, "{loss:?}");
}

#[test]
fn a_field_continues_beyond_its_ends_and_is_zero_below() {
    let field = field(uneven(CellShape::Quad), linear, false);
    for y in [-0.1, -3.0, -4.9] {
        let far = field.plastic_stress(Vec2::new(1000.0, y));
        assert!(distance(far, linear(Vec2::new(6.0, y))) < 1e-9); // as above
    }
    assert_eq!(field.plastic_stress(Vec2::new(0.0, -5.1)), Stress::ZERO);
}

#[test]
fn quadratic_cells_are_read() {
    // One curved quadrilateral with eight nodes: a linear field is reproduced wherever the map
    // leads.
    let points: Vec<Vec2> = [
        (0.0, -4.0),
        (4.0, -4.0),
        (4.0, 0.0),
        (0.0, 0.0),
        (2.0, -4.3),
        (4.2, -2.0),
        (2.0, 0.0),
        (-0.2, -2.0),
    ]
    .map(|(x, y)| Vec2::new(x, y))
    .to_vec();
    let grid = UnstructuredGrid {
        points,
        cells: vec![CellBlock { shape: CellShape::QuadraticQuad, connectivity: (0..8).collect() }],
        ..UnstructuredGrid::default()
    };
    let field = field(grid, linear, false);
    for point in [Vec2::new(2.0, -4.25), Vec2::new(4.15, -2.0), Vec2::new(0.3, -0.2)] {
        let error = distance(field.plastic_stress(point), linear(point));
        assert!(error < 1e-9, "at {point:?}: {error}"); // reference coordinates to 1e-12
    }
}

/// Which of them holds a point would be arbitrary, and to find one would take a look at each.
#[test]
fn cells_on_top_of_one_another_are_refused() {
    let stressed = |points: Vec<Vec2>, connectivity: Vec<usize>| {
        let stresses = vec![Stress { xx: 1.0, ..Stress::ZERO }; points.len()];
        PlasticField::from_grid(&UnstructuredGrid {
            points,
            cells: vec![CellBlock { shape: CellShape::Quad, connectivity }],
            point_data: vec![Array::stresses("plastic_stress_mpa", &stresses)],
            ..UnstructuredGrid::default()
        })
    };
    let square = [(-1.0, -2.0), (1.0, -2.0), (1.0, 0.0), (-1.0, 0.0)].map(|(x, y)| Vec2::new(x, y));
    assert!(stressed(square.to_vec(), vec![0, 1, 2, 3]).is_ok());
    let stack = stressed(square.to_vec(), [0, 1, 2, 3].repeat(100_000));
    assert!(matches!(stack, Err(PlasticFieldError::Overlap { cells: 100_000, .. })), "{stack:?}");
    // Slivers along a diagonal: little area, but each a candidate for every point.
    let count = 1000;
    let place = |i: usize| 1e-6 * i as f64;
    let points = (0..count).flat_map(|i| {
        let [low, high] = [place(2 * i), place(2 * i + 1)];
        [(-1.0, -2.0 + low), (1.0, -0.1 + low), (1.0, -0.1 + high), (-1.0, -2.0 + high)]
    });
    let points: Vec<Vec2> = points.map(|(x, y)| Vec2::new(x, y)).collect();
    let slivers = stressed(points, (0..4 * count).collect());
    assert!(matches!(slivers, Err(PlasticFieldError::Overlap { .. })), "{slivers:?}");
}

#[test]
fn inadmissible_fields_are_refused_by_name() {
    let refused = |grid: &UnstructuredGrid| PlasticField::from_grid(grid).unwrap_err();
    let mut grid = uneven(CellShape::Quad);
    let count = grid.points.len();
    grid.point_data = vec![Array::scalars("temperature", vec![0.0; count])];
    let text = refused(&grid).to_string();
    assert!(text.contains("plastic_stress_mpa") && text.contains("`temperature`"), "{text}");

    grid.point_data = vec![Array::scalars("plastic_stress_mpa", vec![0.0; count])];
    assert!(matches!(refused(&grid), PlasticFieldError::Array { .. }));

    let huge = vec![Stress { xx: 2e8, ..Stress::ZERO }; count];
    grid.point_data = vec![Array::stresses("plastic_stress_mpa", &huge)];
    assert!(matches!(refused(&grid), PlasticFieldError::TooLarge { .. }), "Pa in place of MPa");

    grid.point_data = vec![Array::stresses("plastic_stress_mpa", &vec![Stress::ZERO; count])];
    let flat = UnstructuredGrid { cells: vec![], ..grid.clone() };
    assert_eq!(refused(&flat), PlasticFieldError::NoCells);
    let folded = vec![CellBlock { shape: CellShape::Quad, connectivity: vec![0, 8, 1, 7] }];
    assert!(matches!(
        refused(&UnstructuredGrid { cells: folded, ..grid.clone() }),
        PlasticFieldError::Folded { .. }
    ));
    let above: Vec<Vec2> = grid.points.iter().map(|p| *p + Vec2::new(0.0, 5.0)).collect();
    assert!(matches!(
        refused(&UnstructuredGrid { points: above, ..grid }),
        PlasticFieldError::NotInRail { .. }
    ));
}
