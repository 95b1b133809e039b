//! Fluid in the cracks of a network: the cracks that it fills and the pressure along them.

use crate::body::FaceMesh;
use crate::contact::{CrackFluid, FaceFluid, Pocket, PocketMouth, PressureProfile};
use crate::crack::{Crack, CrackNetwork, End, JunctionPoint};
use crate::math::{Stress, Vec2};

/// A crack of a pocket, with the point at which the path from the mouth enters it.
#[derive(Debug, Clone, Copy)]
struct Entered {
    /// Arc length of the entry, mm.
    at: f64,
    /// Distance of the entry from the mouth, mm.
    distance: f64,
}

impl Entered {
    fn distance(&self, s: f64) -> f64 {
        self.distance + (s - self.at).abs()
    }
}

impl CrackFluid {
    /// The pockets on `faces` of the cracks of `network`: one for each connected crack with fluid.
    pub fn on(&self, network: &CrackNetwork, faces: &FaceMesh) -> FaceFluid {
        let count = network.cracks().len();
        let mut taken = vec![false; count];
        let mut pockets = Vec::new();
        // Mouths come first, so that a joined buried crack is entered from the crack with the
        // mouth.
        let breaks_surface = |crack: &usize| network.cracks()[*crack].is_surface_breaking();
        let order =
            (0..count).filter(breaks_surface).chain((0..count).filter(|crack| !breaks_surface(crack)));
        for first in order {
            if taken[first] {
                continue;
            }
            let entered = connected(network, first);
            let cracks: Vec<usize> = (0..count).filter(|&crack| entered[crack].is_some()).collect();
            cracks.iter().for_each(|&crack| taken[crack] = true);
            if cracks.iter().any(|&crack| self.wets(crack)) {
                pockets.push(self.pocket(network, faces, first, cracks, &entered));
            }
        }
        FaceFluid { model: self.model, pockets }
    }

    fn pocket(
        &self,
        network: &CrackNetwork,
        faces: &FaceMesh,
        first: usize,
        cracks: Vec<usize>,
        entered: &[Option<Entered>],
    ) -> Pocket {
        let crack_of = |k: usize| {
            let shares = faces.samples[k].shares.iter();
            shares.filter(|share| share.1 > 0.0).map(|share| faces.points[share.0].crack).next()
        };
        let farthest = |crack: &usize| {
            let ends = [0.0, network.cracks()[*crack].length()];
            ends.map(|s| entered[*crack].map_or(0.0, |entry| entry.distance(s)))
                .into_iter()
                .fold(0.0, f64::max)
        };
        let length = cracks.iter().map(farthest).fold(f64::MIN_POSITIVE, f64::max);
        let share = |k: usize, point: Vec2| {
            let Some(crack) = crack_of(k).filter(|crack| cracks.contains(crack)) else { return [0.0; 2] };
            let s = arc_length(&network.cracks()[crack], point);
            let distance = entered[crack].map_or(0.0, |entry| entry.distance(s));
            match self.profile {
                PressureProfile::Constant => [1.0, 1.0],
                PressureProfile::Linear => [1.0, (1.0 - distance / length).max(0.0)],
            }
        };
        let shares: Vec<[f64; 2]> =
            faces.samples.iter().enumerate().map(|(k, sample)| share(k, sample.point)).collect();
        // Tension across the crack line pushes on the + face like pressure in the crack.
        let forces = |which: usize| {
            faces.nodal_forces_of_samples(|k, _| Stress {
                xx: shares[k][which],
                yy: shares[k][which],
                ..Stress::ZERO
            })
        };
        let points: Vec<usize> =
            (0..faces.points.len()).filter(|&j| cracks.contains(&faces.points[j].crack)).collect();
        let mouth = network.cracks()[first].is_surface_breaking().then(|| {
            let point = faces.points.iter().position(|point| point.crack == first);
            point.map(|point| PocketMouth { x: network.cracks()[first].points()[0].x, point })
        });
        Pocket {
            unit: forces(0),
            profile: forces(1),
            mouth: mouth.flatten(),
            neighbours: neighbours(network, faces, &points, &cracks),
            points,
            cracks,
        }
    }
}

/// The entries of all cracks connected to crack `first`, seen from its first point.
fn connected(network: &CrackNetwork, first: usize) -> Vec<Option<Entered>> {
    let mut entered = vec![None; network.cracks().len()];
    entered[first] = Some(Entered { at: 0.0, distance: 0.0 });
    loop {
        let mut grown = false;
        for point in network.junction_points() {
            let arms = arms(network, point);
            let known = arms.iter().find_map(|&(crack, s)| entered[crack].map(|e: Entered| e.distance(s)));
            let Some(distance) = known else { continue };
            for &(crack, at) in &arms {
                if entered[crack].is_none() {
                    entered[crack] = Some(Entered { at, distance });
                    grown = true;
                }
            }
        }
        if !grown {
            return entered;
        }
    }
}

/// The cracks at a junction, each with its arc length (mm) there.
fn arms(network: &CrackNetwork, point: &JunctionPoint) -> Vec<(usize, f64)> {
    let end = |end: &crate::crack::CrackEnd| {
        let s = if end.end == End::First { 0.0 } else { network.cracks()[end.crack].length() };
        (end.crack, s)
    };
    let through = point.through.map(|passing| (passing.crack, passing.s));
    point.ends.iter().map(end).chain(through).collect()
}

/// Arc length (mm) of the point on `crack` nearest to `point`.
fn arc_length(crack: &Crack, point: Vec2) -> f64 {
    let (mut before, mut best) = (0.0, (f64::INFINITY, 0.0));
    for i in 0..crack.segment_count() {
        let (from, to) = crack.segment(i);
        let (along, length) = (to - from, (to - from).length());
        let t = ((point - from).dot(along) / (length * length)).clamp(0.0, 1.0);
        let distance = (point - (from + along * t)).length();
        if distance < best.0 {
            best = (distance, before + t * length);
        }
        before += length;
    }
    best.1
}

/// Pairs of adjacent face points, including those across junctions.
fn neighbours(
    network: &CrackNetwork,
    faces: &FaceMesh,
    points: &[usize],
    cracks: &[usize],
) -> Vec<(usize, usize)> {
    let adjacent = |pair: &[usize]| {
        (faces.points[pair[0]].crack == faces.points[pair[1]].crack).then_some((pair[0], pair[1]))
    };
    let mut pairs: Vec<(usize, usize)> = points.windows(2).filter_map(adjacent).collect();
    for junction in network.junction_points() {
        let nearest = |&(crack, s): &(usize, f64)| {
            let own = points.iter().copied().filter(|&j| faces.points[j].crack == crack);
            let to = |j: usize| (faces.points[j].s - s).abs();
            own.min_by(|&one, &other| to(one).total_cmp(&to(other)))
        };
        let arms: Vec<usize> = arms(network, junction)
            .iter()
            .filter(|arm| cracks.contains(&arm.0))
            .filter_map(nearest)
            .collect();
        pairs.extend(arms.windows(2).map(|pair| (pair[0], pair[1])));
    }
    pairs
}
