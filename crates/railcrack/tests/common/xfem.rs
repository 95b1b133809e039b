//! Cracked rails by the finite-element engine, with the default settings of users.

use super::{History, steel};
use railcrack::body::{BodyEngine, CrackedBody};
use railcrack::bulk::BulkRail;
use railcrack::crack::{Crack, CrackNetwork};
use railcrack::growth::StabilisedPassage;
use railcrack::interruption::Interruption;
use railcrack::linear::spd_inverse;
use railcrack::math::{Matrix, Stress, Vec2};
use railcrack::xfem::{
    ColumnStore, RailEnd, RefinedRegion, XfemEngine, XfemSettings, cracked_body_with, default_element_sizes,
};

/// How the rail is meshed.
#[derive(Debug, Clone)]
pub struct Meshed {
    /// Size of the elements, mm; none for the default.
    pub element_size: Option<f64>,
    /// Final over initial length for which the refined region makes room.
    pub expected_growth: f64,
    pub settings: XfemSettings,
    pub end: RailEnd,
}

impl Default for Meshed {
    /// The first mesh of a case file: room for growth by a quarter.
    fn default() -> Self {
        Self {
            element_size: None,
            expected_growth: 1.25,
            settings: XfemSettings::default(),
            end: RailEnd::HalfPlane { centre: 0.0 },
        }
    }
}

impl Meshed {
    /// Without room for growth.
    pub fn still() -> Self {
        Self { expected_growth: 1.0, ..Self::default() }
    }

    /// Elements of `size` (mm) without room for growth.
    pub fn of_size(size: f64) -> Self {
        Self { element_size: Some(size), ..Self::still() }
    }

    /// The smallest size of the elements at `cracks`, mm.
    pub fn size(&self, cracks: &[Crack]) -> f64 {
        let network = CrackNetwork::new(cracks.to_vec()).unwrap();
        self.sizes(&network).into_iter().fold(f64::INFINITY, f64::min)
    }

    /// The size of the elements at each crack, mm.
    fn sizes(&self, network: &CrackNetwork) -> Vec<f64> {
        match self.element_size {
            Some(size) => vec![size; network.cracks().len()],
            None => default_element_sizes(network),
        }
    }

    /// The engine with a mesh for `cracks`.
    pub fn engine(&self, cracks: &[Crack]) -> XfemEngine {
        self.engine_of(&CrackNetwork::new(cracks.to_vec()).unwrap())
    }

    /// The engine with a mesh for joined cracks.
    pub fn engine_of(&self, network: &CrackNetwork) -> XfemEngine {
        let refined = RefinedRegion::with_sizes(network, &self.sizes(network), self.expected_growth);
        XfemEngine::with_region(refined, steel(), self.end, self.settings)
    }

    pub fn body(&self, cracks: &[Crack]) -> CrackedBody {
        self.engine(cracks).body(&CrackNetwork::new(cracks.to_vec()).unwrap()).unwrap()
    }

    /// The body with cracks that meet.
    pub fn body_of(&self, network: &CrackNetwork) -> CrackedBody {
        self.engine_of(network).body(network).unwrap()
    }

    /// Applies `look` to the uncracked rail and to the function that turns settings into bodies on
    /// it.
    pub fn with_bodies<T>(
        &self,
        cracks: &[Crack],
        look: impl FnOnce(&BulkRail, &mut dyn FnMut(XfemSettings) -> CrackedBody) -> T,
    ) -> T {
        let network = CrackNetwork::new(cracks.to_vec()).unwrap();
        let mut engine = self.engine(cracks);
        let rail = engine.background(&network).unwrap();
        let mut columns = ColumnStore::default();
        look(rail, &mut |settings| {
            cracked_body_with(rail, &network, settings, &mut columns, Interruption::NEVER).unwrap()
        })
    }
}

/// K_I and K_II (MPa √mm) per tip of an open cracked rail under the stress of the uncracked one.
pub fn sifs_under(body: &CrackedBody, stress: impl Fn(Vec2) -> Stress) -> Vec<f64> {
    body.sif_influence.times(&body.faces.nodal_forces(stress))
}

/// The condition number of a symmetric positive definite matrix scaled to a unit diagonal, by power
/// iteration on it and on its inverse; none where it is not symmetric to the last bit or not
/// positive definite.
pub fn condition(matrix: &Matrix) -> Option<f64> {
    let n = matrix.rows();
    let symmetric = (0..n).all(|i| (0..i).all(|j| matrix[(i, j)] == matrix[(j, i)]));
    if !symmetric || (0..n).any(|i| matrix[(i, i)].is_nan() || matrix[(i, i)] <= 0.0) {
        return None;
    }
    let scaled = Matrix::from_fn(n, n, |i, j| matrix[(i, j)] / (matrix[(i, i)] * matrix[(j, j)]).sqrt());
    let inverse = spd_inverse(&scaled).ok()?;
    Some(largest_eigenvalue(&scaled) * largest_eigenvalue(&inverse))
}

/// Steps of the power iteration: its value is a lower bound, accurate to some per cent.
const POWER_STEPS: usize = 40;

fn largest_eigenvalue(matrix: &Matrix) -> f64 {
    let mut vector: Vec<f64> = (0..matrix.rows()).map(|i| 1.0 + 0.5 * (7.3 * i as f64).sin()).collect();
    let mut value = 0.0;
    for _ in 0..POWER_STEPS {
        let size = dot(&vector, &vector).sqrt();
        vector.iter_mut().for_each(|v| *v /= size);
        let image = matrix.times(&vector);
        value = dot(&vector, &image);
        vector = image;
    }
    value
}

/// The largest difference of K at any position and crack, relative to the peak of the reference,
/// and where it occurs.
pub fn misfit(result: &StabilisedPassage, reference: &[History]) -> (f64, String) {
    let passage = &result.passages[result.passages.len() - 1];
    let all = || reference.iter().flat_map(|h| &h.sifs);
    let peak = all().fold(0.0f64, |m, k| m.max(k.ki.abs()).max(k.kii.abs()));
    let mut worst = (0.0, String::new());
    for (crack, history) in reference.iter().enumerate() {
        assert_eq!(history.sifs.len(), passage.sifs[crack].len());
        for (i, (want, got)) in history.sifs.iter().zip(&passage.sifs[crack]).enumerate() {
            for (name, want, got) in [("K_I", want.ki, got.ki), ("K_II", want.kii, got.kii)] {
                let error = (got - want).abs() / peak;
                if error > worst.0 {
                    let xc = history.xc_over_a[i];
                    worst = (error, format!("{name} of crack {} at x_c/a {xc:.2}", crack + 1));
                }
            }
        }
    }
    worst
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
