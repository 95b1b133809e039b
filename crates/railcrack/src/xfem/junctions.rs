//! Face points near junctions of cracks.
//!
//! The jumps of the arms of a junction are coupled there, since the displacement around it is
//! single-valued: n arms have n contact conditions but n − 1 free jumps. So no face point lies at
//! the junction itself. On the last element of each arm jumps and tractions are constant at their
//! values at its other end: no part of the tractions is lost or counted twice.

use crate::body::{FaceElement, FaceMesh};
use crate::crack::{CrackCurve, CrackNetwork, End};

/// The points of `crack` at which other cracks meet it, by index, in order.
pub(super) fn junctions_on(network: &CrackNetwork, crack: usize) -> Vec<usize> {
    let last = network.cracks()[crack].points().len() - 1;
    let mut points: Vec<usize> = network
        .junction_points()
        .iter()
        .flat_map(|point| {
            let ends = point.ends.iter().filter(|end| end.crack == crack).map(|end| match end.end {
                End::First => 0,
                End::Last => last,
            });
            let through = point.through.filter(|passing| passing.crack == crack);
            ends.chain(through.map(|passing| passing.vertex)).collect::<Vec<usize>>()
        })
        .collect();
    points.sort_unstable();
    points
}

/// Removes the face points at junctions and adds their share to the next point of the same arm.
/// `joined` are the points of each crack at which other cracks meet it.
pub(super) fn leave_junctions(
    curves: &[CrackCurve],
    joined: &[Vec<usize>],
    elements: &mut [FaceElement],
    faces: &mut FaceMesh,
) {
    let mut heir: Vec<usize> = (0..faces.points.len()).collect();
    for element in elements.iter_mut() {
        let vertices = curves[element.crack].vertices();
        let at = joined[element.crack].iter().map(|&point| vertices[point]);
        let ends = [element.range.0, element.range.1];
        for g in at {
            for (own, other) in [(0, 1), (1, 0)] {
                if let (true, [Some(a), Some(b)]) = (ends[own] == g, element.ends) {
                    heir[[a, b][own]] = [a, b][other];
                }
            }
        }
    }
    let stays: Vec<bool> = heir.iter().enumerate().map(|(i, &heir)| i == heir).collect();
    let mut number = vec![0; heir.len()];
    let mut next = 0;
    for (i, number) in number.iter_mut().enumerate() {
        *number = next;
        next += usize::from(stays[i]);
    }
    let new = |point: usize| number[heir[point]];
    for i in 0..heir.len() {
        if !stays[i] {
            let weight = faces.points[i].weight;
            faces.points[heir[i]].weight += weight;
        }
    }
    for element in elements {
        element.ends = element.ends.map(|point| point.map(new));
    }
    let samples = faces.samples.iter_mut().chain(&mut faces.graded);
    for (point, _) in samples.flat_map(|sample| &mut sample.shares) {
        *point = new(*point);
    }
    let mut stays = stays.into_iter();
    faces.points.retain(|_| stays.next().unwrap_or(true));
}
