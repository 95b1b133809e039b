//! Cracks in space as a file of VTK: their faces with jumps, their fronts with K.

use super::names::name_in_space;
use crate::disk::files::FIELDS_FOLDER;
use railcrack::contact::FaceStatus;
use railcrack::growth::{FaceAcross, PassageRecord, SpaceGeometry, StepRecord};
use railcrack::math::{MPA_SQRT_MM, Vec2};
use railcrack::mesh::{Array, CellBlock, CellShape, UnstructuredGrid};

/// The cracks of a step in space: of each written wheel position its number (from 1), the name of
/// its file in the run folder, and what the file holds.
pub(crate) fn space_grids(record: &StepRecord) -> impl Iterator<Item = (usize, String, UnstructuredGrid)> {
    let parts = record.geometry.space().zip(record.faces.across.as_ref()).zip(record.passages.last());
    parts.into_iter().flat_map(move |((cracks, across), passage)| {
        across.written.iter().map(move |&position| {
            let grid = grid_of(record, cracks, across, passage, position);
            let file = format!("{FIELDS_FOLDER}/{}", name_in_space(record.step, position + 1));
            (position + 1, file, grid)
        })
    })
}

/// The ends of the segments of the front of a crack, which is closed where the crack is buried.
fn along_front(record: &StepRecord, cracks: &SpaceGeometry, crack: usize) -> Vec<usize> {
    let first = record.faces.points.len();
    let own = || (0..record.tips.len()).filter(|&q| record.tips[q].tip.crack == crack).map(|q| first + q);
    let closing = own().next().filter(|_| cracks.shapes[crack].buried.is_some());
    own().zip(own().skip(1).chain(closing)).flat_map(|(a, b)| [a, b]).collect()
}

/// A contact status as a number of the files.
pub(super) fn status_number(status: FaceStatus) -> f64 {
    match status {
        FaceStatus::Open => 0.0,
        FaceStatus::Stick => 1.0,
        FaceStatus::Slip => 2.0,
    }
}

fn grid_of(
    record: &StepRecord,
    cracks: &SpaceGeometry,
    across: &FaceAcross,
    passage: &PassageRecord,
    position: usize,
) -> UnstructuredGrid {
    let faces = &record.faces;
    let (free, tips) = (faces.points.len(), record.tips.len());
    let inner = faces.points.iter().map(|point| point.position);
    let points: Vec<Vec2> = inner.chain(record.tips.iter().map(|tip| Vec2::new(tip.x, tip.y))).collect();
    let lateral_of_tips = record.tips.iter().map(|tip| tip.front().map_or(0.0, |front| front.lateral));
    let z = across.lateral.iter().copied().chain(lateral_of_tips).collect();
    let along_front = (0..cracks.shapes.len()).flat_map(|crack| along_front(record, cracks, crack)).collect();
    let cells = vec![
        CellBlock { shape: CellShape::Quad, connectivity: across.cells.concat() },
        CellBlock { shape: CellShape::Line, connectivity: along_front },
    ];
    let states = &faces.states[position];
    let third = &across.states[position];
    // Cracks without a jump.
    let of_faces = |value: &dyn Fn(usize) -> f64| -> Vec<f64> {
        (0..free).map(value).chain(std::iter::repeat_n(0.0, tips)).collect()
    };
    let of_front = |value: &dyn Fn(usize) -> f64| -> Vec<f64> {
        std::iter::repeat_n(0.0, free).chain((0..tips).map(value)).collect()
    };
    let jumps = (0..free + tips).flat_map(|i| match states.get(i).zip(faces.points.get(i)) {
        Some((state, point)) => {
            let frame = cracks.shapes[point.crack].frame_at(point.s);
            let [x, z, down] = frame.vector([state.opening, state.slip, third[i][0]]);
            [x, -down, z]
        }
        None => [0.0; 3],
    });
    let crack_of = |i: usize| match faces.points.get(i) {
        Some(point) => point.crack,
        None => record.tips[i - free].tip.crack,
    };
    let status = |i: usize| status_number(states[i].status);
    UnstructuredGrid {
        points,
        z,
        cells,
        point_data: vec![
            Array { name: "jump_mm".to_owned(), components: 3, values: jumps.collect() },
            Array::scalars("opening_mm", of_faces(&|i| states[i].opening)),
            Array::scalars("slip_mm", of_faces(&|i| states[i].slip)),
            Array::scalars("slip_z_mm", of_faces(&|i| third[i][0])),
            Array::scalars("s22_mpa", of_faces(&|i| states[i].s22)),
            Array::scalars("s12_mpa", of_faces(&|i| states[i].s12)),
            Array::scalars("s23_mpa", of_faces(&|i| third[i][1])),
            Array::scalars("status", of_faces(&status)),
            Array::scalars("crack", (0..free + tips).map(|i| (crack_of(i) + 1) as f64).collect()),
            Array::scalars("ki_mpa_sqrt_m", of_front(&|q| passage.sifs[q][position].ki_mpa_sqrt_m())),
            Array::scalars("kii_mpa_sqrt_m", of_front(&|q| passage.sifs[q][position].kii_mpa_sqrt_m())),
            Array::scalars("kiii_mpa_sqrt_m", of_front(&|q| passage.kiii[q][position] / MPA_SQRT_MM)),
        ],
        cell_data: Vec::new(),
    }
}
