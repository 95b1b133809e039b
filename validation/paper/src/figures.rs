//! The curves of the figures, and their tables.

use crate::results::Results;
use crate::rolled::StressProfile;
use crate::tables::{Figure, Kind, Paper};

/// The set-up of digitised curves.
pub const DIGITISED: &str = "digitised";

/// A quantity that a figure shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// K_I over the passage.
    Ki,
    /// K_II over the passage.
    Kii,
    /// Crack paths.
    Paths,
    /// Stress by depth.
    Profile,
}

impl Quantity {
    /// The quantities of a figure of this kind.
    pub fn of(kind: Kind) -> &'static [Self] {
        match kind {
            Kind::Sif => &[Self::Ki, Self::Kii],
            Kind::Paths => &[Self::Paths],
            Kind::Profile => &[Self::Profile],
        }
    }

    /// The columns of x and y.
    pub fn columns(self) -> [&'static str; 2] {
        match self {
            Self::Ki => ["xc_over_a", "ki_mpa_sqrt_m"],
            Self::Kii => ["xc_over_a", "kii_mpa_sqrt_m"],
            Self::Paths => ["x_mm", "depth_mm"],
            Self::Profile => ["sxx_mpa", "depth_mm"],
        }
    }
}

/// A curve of a figure in one set-up.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureCurve {
    /// The set-up; empty for the profiles of Fig. 21.
    pub setup: String,
    /// The curve of the paper, or the profile.
    pub name: String,
    /// The number of the crack; 1 for a profile.
    pub crack: usize,
    /// Points in the units of the columns.
    pub points: Vec<[f64; 2]>,
}

/// The quantities of a figure with their curves.
pub type Curves = Vec<(Quantity, Vec<FigureCurve>)>;

/// The curves of `figure` in all set-ups; `profiles` are those of Fig. 21.
pub fn curves(paper: &Paper, figure: &Figure, results: &Results, profiles: &[StressProfile]) -> Curves {
    let of = |quantity: Quantity| match quantity {
        Quantity::Profile => profiles.iter().map(profile).collect(),
        _ => of_cracks(paper, figure, quantity, results),
    };
    Quantity::of(figure.kind).iter().map(|quantity| (*quantity, of(*quantity))).collect()
}

fn profile(profile: &StressProfile) -> FigureCurve {
    FigureCurve { setup: String::new(), name: profile.name.clone(), crack: 1, points: profile.points() }
}

fn of_cracks(paper: &Paper, figure: &Figure, quantity: Quantity, results: &Results) -> Vec<FigureCurve> {
    let mut curves = Vec::new();
    for r in results.setups(paper) {
        for name in &figure.curves {
            let run = if quantity == Quantity::Paths { r.grown(name) } else { r.run(name) };
            for (i, crack) in run.iter().flat_map(|run| &run.cracks).enumerate() {
                let over = |k: &[f64]| crack.sif.position.iter().zip(k).map(|(&x, &k)| [x, k]).collect();
                let points = match quantity {
                    Quantity::Ki => over(&crack.sif.ki),
                    Quantity::Kii => over(&crack.sif.kii),
                    _ => crack.points.clone(),
                };
                let (setup, name) = (r.setup().name.clone(), name.clone());
                curves.push(FigureCurve { setup, name, crack: i + 1, points });
            }
        }
    }
    curves
}

/// The table of a figure, in CSV.
pub fn table(curves: &Curves) -> String {
    let mut text = String::new();
    let mut row = |cells: String| text.push_str(&(cells + "\n"));
    match curves.as_slice() {
        [(Quantity::Ki, ki), (_, kii)] => {
            row("setup,curve,crack,xc_over_a,ki_mpa_sqrt_m,kii_mpa_sqrt_m".to_owned());
            for (curve, other) in ki.iter().zip(kii) {
                for ([x, ki], [_, kii]) in curve.points.iter().zip(&other.points) {
                    row(format!("{},{x:?},{ki:?},{kii:?}", curve.first_cells()));
                }
            }
        }
        [(Quantity::Paths, paths)] => {
            row("setup,curve,crack,point,x_mm,depth_mm".to_owned());
            for path in paths {
                for (p, [x, depth]) in path.points.iter().enumerate() {
                    row(format!("{},{p},{x:?},{depth:?}", path.first_cells()));
                }
            }
        }
        other => {
            row("profile,depth_mm,sxx_mpa".to_owned());
            for curve in other.iter().flat_map(|(_, curves)| curves) {
                for [stress, depth] in &curve.points {
                    row(format!("\"{}\",{depth:.1},{stress:?}", curve.name));
                }
            }
        }
    }
    text
}

impl FigureCurve {
    fn first_cells(&self) -> String {
        format!("\"{}\",{},{}", self.setup, self.name, self.crack)
    }

    /// Whether it is the same crack of the same curve as `other`.
    pub fn is_same_crack(&self, other: &Self) -> bool {
        self.name == other.name && self.crack == other.crack
    }
}

/// Number of cracks of the curve `name` among `curves`.
pub fn cracks(curves: &[FigureCurve], name: &str) -> usize {
    curves.iter().filter(|curve| curve.name == name).map(|curve| curve.crack).max().unwrap_or(0)
}
