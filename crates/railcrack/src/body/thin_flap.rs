//! Cracks below flaps that are too thin for the elements.

use crate::crack::{Crack, CrackNetwork};

/// Depth of a surface-breaking crack over its length below which the flap above it is too thin to
/// be resolved: that of 1.5°.
const THIN: f64 = 0.026;

/// Remarks on the cracks of `network` below such flaps. `per_cent` is the error of K of the engine
/// at 1°, in % of the peak; `remedy` names the change that resolves the flap.
pub(crate) fn thin_flaps(network: &CrackNetwork, per_cent: u32, remedy: &str) -> Vec<String> {
    let cracks = network.cracks().iter().enumerate();
    let thin = cracks.filter(|(_, c)| c.is_surface_breaking() && c.depth() < THIN * c.length());
    let remark = |(i, crack): (usize, &Crack)| {
        format!(
            "crack {}: over its length of {:.3} mm it is nowhere deeper than {:.3} mm; the thin flap above it bends, and its K is known to {per_cent} % \
             of the peak at 1°, less well below; {remedy} resolve it",
            i + 1,
            crack.length(),
            crack.depth()
        )
    };
    thin.map(remark).collect()
}
