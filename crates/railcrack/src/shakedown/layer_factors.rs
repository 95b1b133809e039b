//! Transfer of a wave from border to border of a layer.

/// Transfer factors of a layer of thickness h for a wave of wave number κ; τ = κ h.
#[derive(Debug, Clone, Copy)]
pub(super) struct LayerFactors {
    /// τ, and e^(−τ).
    pub(super) thickness: f64,
    pub(super) decay: f64,
    /// ∫_0^τ e^(−t) dt and ∫_0^τ t e^(−t) dt: effect of a source in the layer at the border of the
    /// layer.
    pub(super) source: [f64; 2],
    /// These integrals over τ: mean effect in the layer of a source at its border.
    pub(super) mean: [f64; 2],
    /// (1/τ) ∫∫ e^(−|t − t'|) and (1/τ) ∫∫ |t − t'| e^(−|t − t'|): mean effect in the layer of a
    /// source in the same layer.
    pub(super) own: [f64; 2],
    /// κ d and e^(−κ d), d the depth of the upper border.
    pub(super) depth: f64,
    pub(super) depth_decay: f64,
}

/// Value of τ below which the closed forms of `source[1]` and `own` suffer from cancellation; the
/// first neglected term of the series is τ⁵/840 of them.
const THIN: f64 = 1e-2;

impl LayerFactors {
    /// The factors for `wave_number` κ > 0 (1/mm) of a layer with its upper border at the depth
    /// `top` (mm), of `thickness` (mm).
    pub(super) fn new(wave_number: f64, top: f64, thickness: f64) -> Self {
        let tau = wave_number * thickness;
        let decay = (-tau).exp();
        let whole = -(-tau).exp_m1();
        let (first, own) = if tau < THIN {
            let first = tau * tau * (0.5 - tau * (1.0 / 3.0 - tau * (0.125 - tau / 30.0)));
            let plain =
                tau * (1.0 - tau * (1.0 / 3.0 - tau * (1.0 / 12.0 - tau * (1.0 / 60.0 - tau / 360.0))));
            let moment = tau * tau * (1.0 / 3.0 - tau * (1.0 / 6.0 - tau * (0.05 - tau / 90.0)));
            (first, [plain, moment])
        } else {
            let plain = 2.0 / tau * (tau - whole);
            (whole - tau * decay, [plain, 2.0 / tau * (tau - 2.0 * whole + tau * decay)])
        };
        let depth = wave_number * top;
        Self {
            thickness: tau,
            decay,
            source: [whole, first],
            mean: [whole / tau, first / tau],
            own,
            depth,
            depth_decay: (-depth).exp(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Series and closed forms agree.
    #[test]
    fn thin_layers() {
        let (below, above) =
            (LayerFactors::new(1.0, 0.0, THIN * (1.0 - 1e-9)), LayerFactors::new(1.0, 0.0, THIN));
        for (a, b) in
            [(below.source[1], above.source[1]), (below.own[0], above.own[0]), (below.own[1], above.own[1])]
        {
            // The closed forms amplify round-off by τ⁻³.
            assert!((a / b - 1.0).abs() < 1e-8, "{a} {b}");
        }
    }
}
