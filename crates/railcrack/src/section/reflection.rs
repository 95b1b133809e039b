//! Waves that leave the head downwards, and those that the rail below it sends back.

use super::layers::{Layer, SectionLayers};
use super::modes::{Amplitude, Pair, columns, inverse, minus, scaled, times};
use crate::material::IsotropicElastic;
use crate::math::gauss_legendre;
use std::f64::consts::PI;

/// Elasticity of the rail and of its support.
#[derive(Debug, Clone, Copy)]
pub(super) struct Support<'a> {
    /// The steel.
    pub steel: &'a IsotropicElastic,
    /// k of the foundation, N/mm per mm of deflection of one rail; 0 for a free rail.
    pub foundation: f64,
}

/// Z(k) at the top of `layers` (from the top downwards), in (σ_xz, σ_zz) = Z (u_x, u_z): the
/// traction on the head's bottom, forces per width `unit` (mm) of the rail.
fn impedance(k: f64, layers: &[Layer], unit: f64, support: Support<'_>) -> Pair {
    // The foundation presses against the deflection.
    let mut below: Pair = [[0.0, 0.0], [0.0, -support.foundation / unit]];
    for &Layer { height, width } in layers.iter().rev() {
        let share = width / unit;
        // Waves that decay from the top and from the bottom of the layer.
        let at = |z: f64| [Amplitude::decaying(k, z), Amplitude::growing(k, z - height)];
        let displacements = |of: [Amplitude; 2]| columns(of.map(|a| a.displacement(k, support.steel)));
        let tractions = |of: [Amplitude; 2]| scaled(share, columns(of.map(|a| a.traction(k))));
        let [down, up] = at(height);
        // What the bottom reflects of a wave from the top.
        let missing = |of: [Amplitude; 2]| minus(tractions(of), times(below, displacements(of)));
        let reflected = times(inverse(missing(up)), scaled(-1.0, missing(down)));
        let [down, up] = at(0.0);
        let both = |of: &dyn Fn([Amplitude; 2]) -> Pair| {
            let sent_back = times(of(up), reflected);
            minus(of(down), scaled(-1.0, sent_back))
        };
        below = times(both(&tractions), inverse(both(&displacements)));
    }
    below
}

/// Q(k), symmetric: with U the work of the tractions of both fields of
/// [`Amplitude::below_free_surface`] on the jumps of cracks in the head, Q U dk are the amplitudes
/// of these fields in what the section reflects.
///
/// By Betti's theorem the crack radiates the decaying waves −B⁻¹ U, with B the bracket of both
/// kinds of waves at the bottom of the head; the rail below has the impedance Z there.
pub(super) fn reflection(k: f64, layers: &SectionLayers, support: Support<'_>) -> Pair {
    let height = layers.head.height;
    // A head without anything below it rests on the foundation itself.
    let impedance = impedance(k, &layers.below, layers.head.width, support);
    let free = Amplitude::below_free_surface(k, height, height);
    let sent = Amplitude::decaying(k, 0.0);
    let displacement = |a: Amplitude| a.displacement(k, support.steel);
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let bracket = [0, 1].map(|j| {
        [0, 1].map(|i| {
            PI * (dot(sent[i].traction(k), displacement(free[j]))
                - dot(free[j].traction(k), displacement(sent[i])))
        })
    });
    let missing = |of: [Amplitude; 2]| {
        minus(columns(of.map(|a| a.traction(k))), times(impedance, columns(of.map(displacement))))
    };
    let [[a, b], [c, d]] = times(times(inverse(missing(free)), missing(sent)), inverse(bracket));
    let off = 0.5 * (b + c);
    [[a, off], [off, d]]
}

/// Wave numbers (1/mm) and weights for the waves between a rail of `layers` and cracks in its head
/// that end `ligament` (mm) above the bottom of the head and extend over `reach` (mm) along the
/// rail.
pub(super) fn wave_numbers(layers: &SectionLayers, ligament: f64, reach: f64) -> Vec<(f64, f64)> {
    let last = DECAYED / ligament;
    let widest = (WIDEST_PANEL / layers.head.height).min(WIDEST_PANEL / reach);
    let rule = gauss_legendre(PANEL_POINTS);
    let mut nodes = Vec::new();
    let mut from = 0.0;
    while from < last {
        let width = from.max(FIRST_PANEL / layers.height()).min(widest);
        nodes.extend(rule.iter().map(|(x, w)| (from + width * x, width * w)));
        from += width;
    }
    nodes
}

/// k times the ligament at which waves, which decay there and back, have vanished: e^(−20).
const DECAYED: f64 = 10.0;
/// Width of the first panel times the height of the rail: below it the rail is a beam.
const FIRST_PANEL: f64 = 0.1;
/// Largest width of a panel times the height of the head, or the reach of the cracks.
const WIDEST_PANEL: f64 = 1.5;
/// Gauss points of a panel.
const PANEL_POINTS: usize = 6;
