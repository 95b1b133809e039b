//! A coarse crack in space under many wheels, as a surrogate for the fine one.

use super::coarse_crack::CoarseWheel;
use railcrack::crack::Crack;
use railcrack::fatigue::{GrowthLaw, LoadRange};
use railcrack::field::{PatchLoad, PatchWheel};
use railcrack::growth::FrontShape;
use railcrack::interruption::Interruption;
use railcrack::load::{SurfacePart, Travel};
use railcrack::material::IsotropicElastic;
use railcrack::space::{
    EllipticWheel, FrontSif, SpaceBody, SpaceContact, SpaceFaces, SpaceKernel, SpaceResolution, Symmetric,
    UncoupledWheel, body_of,
};
use railcrack_case::{TablePatch, TabledWheel};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// Cells of the coarse crack: the first of these whose stiffness is positive definite. A flap that
/// is thinner than a cell needs more of them.
const CELLS: [SpaceResolution; 3] =
    [SpaceResolution::new(1, 2), SpaceResolution::new(2, 2), SpaceResolution::new(3, 3)];
/// Positions of a passage, each one load step, and how many semi-axes it reaches to both sides of
/// the mouth and of the part below the deepest point.
const POSITIONS: usize = 25;
const REACH: f64 = 2.5;
/// Distance of the wheel from the crack, in semi-axes, within which the gap under it is computed.
const GAP_REACH: f64 = 1.5;
/// Strips of a patch and intervals of each from which its mean shear is taken.
const STRIPS: [usize; 2] = [15, 20];

/// The first crack on few cells, with contact and friction of its faces. Every patch is an ellipse
/// with its own mean shear, and the stress is taken at one point per node.
pub(super) struct CoarseFront {
    body: SpaceBody,
    /// Point (x, lateral, depth, mm) and area (mm²) of each node.
    nodes: Vec<([f64; 3], f64)>,
    /// x of the mouth and of the deepest point, mm.
    ends: [f64; 2],
    friction: f64,
    poisson: f64,
}

/// K at the front points during a passage, position by position.
pub(super) struct FrontHistory(Vec<Vec<FrontSif>>);

impl CoarseFront {
    /// The crack of `shape`, whose faces have the `friction` μ_c; none where no body can be made.
    pub fn new(shape: &FrontShape, friction: f64, steel: &IsotropicElastic) -> Option<Self> {
        let section: Crack = shape.section().ok()?;
        let kernel = SpaceKernel::new(&[shape.dip], steel.poisson());
        let body = CELLS.iter().find_map(|cells| {
            body_of(std::slice::from_ref(shape), steel, &kernel, *cells, Interruption::NEVER).ok()
        })?;
        let count = body.points().len();
        // Forces due to an even unit tension are the areas of the nodes; those due to one in
        // proportion to a coordinate are their moments.
        let forces = |factor: &(dyn Fn([f64; 3]) -> f64 + Sync)| {
            let forces = body.nodal_forces(|point| {
                let even = factor(point);
                [even, even, even, 0.0, 0.0, 0.0]
            });
            (0..count).map(|node| forces[3 * node]).collect::<Vec<f64>>()
        };
        let areas = forces(&|_| 1.0);
        let moments = [0, 1, 2].map(|axis| forces(&|point: [f64; 3]| point[axis]));
        let node = |i: usize| ([0, 1, 2].map(|axis| moments[axis][i] / areas[i]), areas[i]);
        let nodes = (0..count).map(node).collect();
        let xs = || section.points().iter().map(|point| point.x);
        let ends = [xs().fold(f64::INFINITY, f64::min), xs().fold(f64::NEG_INFINITY, f64::max)];
        Some(Self { body, nodes, ends, friction, poisson: steel.poisson() })
    }

    /// The histories under passages of `wheels` towards `travel`, with the crack moved by `aside`
    /// (mm) across the rail.
    pub fn histories(&self, wheels: &[&TabledWheel], travel: Travel, aside: f64) -> Vec<FrontHistory> {
        wheels.par_iter().map(|wheel| self.passage(&ellipses(wheel, travel, aside), travel)).collect()
    }

    /// A passage of a wheel with `patches`, each with its x from the wheel's centre (mm).
    fn passage(&self, patches: &[(f64, EllipticWheel)], travel: Travel) -> FrontHistory {
        let mut history = Vec::with_capacity(POSITIONS);
        self.follow(patches, &self.places(patches, travel), |_, forces, faces| {
            history.push(match faces {
                Some(faces) => self.body.sifs_of_jumps(&faces.jumps),
                None => self.body.sifs(forces),
            });
        });
        FrontHistory(history)
    }

    /// The largest gap (mm) that opens under `wheel` during its passage, since its contact does not
    /// feel the crack.
    pub fn gap_under(&self, wheel: &EllipticWheel, travel: Travel) -> f64 {
        let a = wheel.half_width;
        let mut unfelt = UncoupledWheel::new(&self.body, wheel, self.poisson);
        let mut most = 0.0f64;
        // Successive positions share parts of the running surface.
        let spacing = SurfacePart::SPACING * a;
        let [from, to] = [self.ends[0] - REACH * a, self.ends[1] + REACH * a];
        let count = ((to - from) / spacing).ceil() as usize;
        let mut places: Vec<f64> = (0..=count).map(|i| from + spacing * i as f64).collect();
        if travel == Travel::Backward {
            places.reverse();
        }
        self.follow(&[(0.0, *wheel)], &places, |place, _, faces| {
            let is_over = place > self.ends[0] - GAP_REACH * a && place < self.ends[1] + GAP_REACH * a;
            if let Some(faces) = faces.filter(|_| is_over) {
                most = most.max(unfelt.gap(place, &faces.jumps));
            }
        });
        most
    }

    /// The places (mm) of a passage of wheels with `patches` towards `travel`.
    fn places(&self, patches: &[(f64, EllipticWheel)], travel: Travel) -> Vec<f64> {
        let longest = patches.iter().map(|(_, own)| own.half_width).fold(0.0, f64::max);
        let (mut from, mut to) = (self.ends[0] - REACH * longest, self.ends[1] + REACH * longest);
        if travel == Travel::Backward {
            std::mem::swap(&mut from, &mut to);
        }
        (0..POSITIONS).map(|i| from + (to - from) * i as f64 / (POSITIONS - 1) as f64).collect()
    }

    /// Calls `visit` with each of `places` (mm) of a wheel with `patches`, each with its x from the
    /// wheel's centre (mm), the forces there and the faces, virgin at first. Where the contact of
    /// the faces does not converge, they are none and count as open.
    fn follow(
        &self,
        patches: &[(f64, EllipticWheel)],
        places: &[f64],
        mut visit: impl FnMut(f64, &[f64], Option<&SpaceFaces>),
    ) {
        let contact = SpaceContact { body: &self.body, friction: std::slice::from_ref(&self.friction) };
        let mut faces: Option<SpaceFaces> = Some(contact.virgin());
        for &place in places {
            let forces = self.forces(patches, place);
            faces = faces.take().and_then(|before| Some(contact.step(&before, &forces).ok()?.0));
            visit(place, &forces, faces.as_ref());
        }
    }

    fn forces(&self, patches: &[(f64, EllipticWheel)], place: f64) -> Vec<f64> {
        let mut forces = Vec::with_capacity(3 * self.nodes.len());
        for (node, &(point, area)) in self.nodes.iter().enumerate() {
            let mut stress: Symmetric = [0.0; 6];
            for (ahead, patch) in patches {
                let own = patch.stress(place + ahead, point, self.poisson);
                stress.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
            }
            forces.extend(self.body.frame_of(node).traction(&stress).map(|traction| area * traction));
        }
        forces
    }

    /// The mean rate (mm per cycle) along the front by `law`: that at which its area grows.
    pub fn rate(&self, history: &FrontHistory, law: &GrowthLaw) -> f64 {
        let points = self.body.front().len();
        let of_point = |q: usize| {
            let (opening, shear) = self.ranges(history, q);
            law.rate(LoadRange::new(opening, shear, opening))
        };
        (0..points).map(of_point).sum::<f64>() / points as f64
    }

    /// The largest ΔK_eq (MPa √mm) along the front.
    pub fn largest_range(&self, history: &FrontHistory, law: &GrowthLaw) -> f64 {
        let of_point = |q: usize| {
            let (opening, shear) = self.ranges(history, q);
            law.equivalent_range(opening, shear)
        };
        (0..self.body.front().len()).map(of_point).fold(0.0, f64::max)
    }

    /// ΔK_I of the open crack and ΔK_II with ΔK_III (MPa √mm) at the front point `q`. By its energy
    /// release rate, mode III counts 1/(1 − ν) times as much as mode II.
    fn ranges(&self, history: &FrontHistory, q: usize) -> (f64, f64) {
        let range = |of: &dyn Fn(&FrontSif) -> f64| {
            let wider = |(low, high): (f64, f64), sifs: &Vec<FrontSif>| {
                let k = of(&sifs[q]);
                (low.min(k), high.max(k))
            };
            let (low, high) = history.0.iter().fold((0.0, 0.0), wider);
            high - low
        };
        let shear = range(&|k| k.kii).hypot(range(&|k| k.kiii) / (1.0 - self.poisson).sqrt());
        (range(&|k| k.ki.max(0.0)), shear)
    }
}

impl FrontHistory {
    /// All of it in one row.
    pub fn flat(&self) -> Vec<f64> {
        self.0.iter().flatten().flat_map(|k| [k.ki, k.kii, k.kiii]).collect()
    }
}

/// A wheel that runs towards `travel` over a crack in the plane at `lateral` (mm): its patches as
/// ellipses.
pub(super) fn coarse_wheel(
    wheel: &TabledWheel,
    travel: Travel,
    lateral: f64,
    steel: &IsotropicElastic,
) -> CoarseWheel {
    let patch = |(ahead, own): (f64, EllipticWheel)| {
        PatchLoad::sliding(&own.ellipse(), [ahead, own.lateral], [own.friction, own.lateral_friction])
    };
    let patches: Vec<PatchLoad> = ellipses(wheel, travel, lateral).into_iter().map(patch).collect();
    CoarseWheel {
        half_width: wheel.wheel.heaviest().patch.ellipse.along,
        field: Box::new(PatchWheel::coarse(&patches, steel)),
    }
}

/// The patches of a wheel that runs towards `travel` as ellipses in full sliding with the mean
/// shear of each, and the x of each from the wheel's centre; the rail is moved by −`aside` (mm).
fn ellipses(wheel: &TabledWheel, travel: Travel, aside: f64) -> Vec<(f64, EllipticWheel)> {
    let sign = if travel == Travel::Forward { 1.0 } else { -1.0 };
    let of = |own: &TablePatch| {
        let ellipse = own.patch.ellipse;
        let [along, across] = own.patch.mean_shear(STRIPS);
        let wheel = EllipticWheel {
            peak_pressure: ellipse.peak_pressure,
            half_width: ellipse.along,
            lateral_half_width: ellipse.across,
            lateral: own.y_rail - aside,
            friction: sign * along,
            lateral_friction: across,
        };
        (sign * own.x, wheel)
    };
    wheel.wheel.patches.iter().map(of).collect()
}
