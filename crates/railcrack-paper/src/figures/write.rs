//! The tables of the figures, written: every curve in every set-up.

use crate::figure::Figure;
use crate::profile::StressProfile;
use crate::results::Results;

/// The columns of a table of K.
const SIF_COLUMNS: &str = "setup,curve,crack,xc_over_a,ki_mpa_sqrt_m,kii_mpa_sqrt_m";
/// The columns of a table of paths.
const PATH_COLUMNS: &str = "setup,curve,crack,point,x_mm,depth_mm";
/// The columns of the table of Fig. 21.
const PROFILE_COLUMNS: &str = "profile,depth_mm,sxx_mpa";

/// K of the initial cracks over the passage.
pub(crate) fn sif_table(figure: &Figure, results: &Results) -> String {
    let mut text = format!("{SIF_COLUMNS}\n");
    for r in results.setups() {
        for name in figure.curves {
            let Some(run) = r.run(name) else { continue };
            for (i, crack) in run.cracks.iter().enumerate() {
                let sif = &crack.sif;
                for ((x, ki), kii) in sif.position.iter().zip(&sif.ki).zip(&sif.kii) {
                    text.push_str(&format!("\"{}\",{name},{},{x:?},{ki:?},{kii:?}\n", r.setup().name, i + 1));
                }
            }
        }
    }
    text
}

/// The paths of the cracks.
pub(crate) fn path_table(figure: &Figure, results: &Results) -> String {
    let mut text = format!("{PATH_COLUMNS}\n");
    for r in results.setups() {
        for name in figure.curves {
            let Some(run) = r.grown(name) else { continue };
            for (i, crack) in run.cracks.iter().enumerate() {
                for (p, [x, depth]) in crack.points.iter().enumerate() {
                    text.push_str(&format!("\"{}\",{name},{},{p},{x:?},{depth:?}\n", r.setup().name, i + 1));
                }
            }
        }
    }
    text
}

/// The stress by depth of Fig. 21.
pub(crate) fn profile_table(profiles: &[StressProfile]) -> String {
    let mut text = format!("{PROFILE_COLUMNS}\n");
    for profile in profiles {
        for (depth, sxx) in profile.points() {
            text.push_str(&format!("\"{}\",{depth:.1},{sxx:?}\n", profile.name));
        }
    }
    text
}
