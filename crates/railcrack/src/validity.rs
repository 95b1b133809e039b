//! Checks of a case against the limits of the model; they give warnings, not errors.

use crate::load::{Contact, Track};
use crate::math::MPA_SQRT_MM;
use thiserror::Error;

/// A case, or a result, outside the limits of the model.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ValidityWarning {
    /// Pressure beyond first yield without a given residual stress.
    #[error(
        "the peak pressure of {peak_pressure:.0} MPa is beyond first yield at {limit:.0} MPa (Q/P {adhesion:.3}, \
         yield stress {yield_stress:.0} MPa{}), and no residual stress is given: the rail shakes down to a state with one", if_default(*yield_stress)
    )]
    BeyondFirstYield {
        /// p0, MPa.
        peak_pressure: f64,
        /// p0 at first yield, MPa.
        limit: f64,
        /// Q/P.
        adhesion: f64,
        /// σ_y, MPa.
        yield_stress: f64,
    },
    /// Pressure beyond elastic shakedown.
    #[error(
        "the peak pressure of {peak_pressure:.0} MPa is beyond the limit of elastic shakedown at {limit:.0} MPa \
         (Q/P {adhesion:.3}, yield stress {yield_stress:.0} MPa{}): the rail yields in every passage, and K of an elastic \
         rail does not describe it", if_default(*yield_stress)
    )]
    BeyondShakedown {
        /// p0, MPa.
        peak_pressure: f64,
        /// p0 at the limit, MPa.
        limit: f64,
        /// Q/P.
        adhesion: f64,
        /// σ_y, MPa.
        yield_stress: f64,
    },
    /// Shear beyond the friction of wheel and rail.
    #[error("the shear is up to {ratio:.2} of the pressure, friction limits it to {friction:.2}")]
    ShearBeyondFriction {
        /// The largest |q|/p.
        ratio: f64,
        /// The largest plausible μ.
        friction: f64,
    },
    /// k1 beyond the usual toughness, in a case without a toughness.
    #[error(
        "k1 of a kink reaches {k1:.1} MPa\u{221a}m, beyond the toughness of {}: {}; [fracture] gives the toughness of this rail",
        steel, kink_ends(*after, steel.toughness)
    )]
    BeyondToughness {
        /// The largest k1 of a virtual kink, MPa√m.
        k1: f64,
        /// k1 at the end of a real kink, with its length; `None` where no kink was tested.
        after: Option<KinkAfter>,
        /// The steel with this toughness.
        steel: Steel,
    },
    /// Ranges of K outside the tests of the law.
    #[error(
        "Delta K_eq of {delta_k:.1} MPa\u{221a}m is {where_} the {least} to {most} MPa\u{221a}m {from}: the rate is an extrapolation",
        where_ = if delta_k < least { "below" } else { "above" }, from = measured.words()
    )]
    OutsideLaw {
        /// ΔK_eq, MPa√m.
        delta_k: f64,
        /// Lower end of the measured range, MPa√m.
        least: f64,
        /// Upper end of the measured range, MPa√m.
        most: f64,
        /// Source of the measured range.
        measured: Measured,
    },
    /// A deep crack in a rail with bending.
    #[error(
        "a crack is {depth:.1} mm deep, and beyond {limit:.0} mm the rail that bends is more compliant than a half-plane: K under bending \
         is too small; [rail] section computes it with head, web and foot"
    )]
    DeepCrackInBending {
        /// Depth of the deepest tip, mm.
        depth: f64,
        /// Depth to which the half-plane is a sufficient model, mm.
        limit: f64,
    },
    /// Faces that fluid opens so far that the wheel contact would change.
    #[error(
        "fluid opens the faces of a crack by up to {opening:.3} mm, beyond {limit} mm: the wheel would feel the flap above and press \
         it down, which the contact on the uncracked rail leaves out: K is too large"
    )]
    LiftedFlap {
        /// The largest opening, mm.
        opening: f64,
        /// The largest opening without an influence on the contact, mm.
        limit: f64,
    },
    /// A crack that gets deeper faster than cracks in track.
    #[error(
        "a crack {depth:.1} mm deep gets deeper by {rate:.2} mm per million gross tonnes, more than {limit:.2}, which is about three \
         times the fastest growth that is measured in track at that depth: calibrate C of the growth law (railcrack calibrate)"
    )]
    FastGrowth {
        /// Growth into the depth, mm per million gross tonnes.
        rate: f64,
        /// Depth of the crack, mm.
        depth: f64,
        /// The largest usual growth, mm per million gross tonnes.
        limit: f64,
    },
    /// A crack in space whose criterion asks for a kink out of its plane.
    #[error(
        "the direction criterion asks for a kink of {angle:.0} degrees out of the plane of the crack at its deepest point, where it \
         would grow {ratio:.2} times as fast as straight ahead: the model grows the crack in its plane, and its life may be too long"
    )]
    OutOfPlane {
        /// The kink, degrees.
        angle: f64,
        /// Rate along it over that straight ahead.
        ratio: f64,
    },
    /// A contact patch beside cracks in the plane.
    #[error(
        "the contact patch lies {offset:.2} b beside the cracks (b is its lateral semi-axis), and a plane crack does not feel that it \
         also shears their fronts sideways (mode III): Delta K_eq is too low, by up to 8 % at b/4, 27 % at b/2 and 70 % from b \
         on; engine = \"space\" has all three modes"
    )]
    PatchBeside {
        /// Its distance from the cracks over b.
        offset: f64,
    },
    /// Fluid in cracks in the plane under a contact patch.
    #[error(
        "the fluid opens a plane crack along its whole front, as a contact patch does not: K_I is too high, twofold where it is \
         trapped and threefold with pressure from the mouth in a semicircle of 4 mm; engine = \"space\" has the shape of the crack"
    )]
    FluidUnderPatch,
    /// A crack in the plane that is narrower than a semicircle.
    #[error(
        "a crack is {ratio:.2} times as long on the surface as down the dip, and below 2 the plane computes it as a semicircle: \
         Delta K_eq is too high, by up to a quarter at 1; engine = \"space\" has its shape"
    )]
    NarrowCrack {
        /// Its length on the surface over that down the dip.
        ratio: f64,
    },
    /// A patch whose strip loads the cracks as a line contact.
    #[error(
        "{} takes the strip of the contact patch over the cracks as a line contact, under which cracks deeper than 3 mm grow several \
         times too fast; {} = {} takes the whole patch",
        taken_by.words(), taken_by.key(), taken_by.remedy()
    )]
    StripOfPatch {
        /// The part of the case that takes it so.
        taken_by: LineContact,
    },
    /// No axle of the train is over the contact.
    #[error("no axle of [track] is at 0, that of this wheel: the rail bends under other axles only")]
    NoAxleHere,
}

/// A part of a case that takes a contact patch as a line contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineContact {
    /// A wheel that feels the cracks.
    CoupledWheel,
    /// A block of rail.
    Block,
}

impl LineContact {
    fn words(self) -> &'static str {
        match self {
            Self::CoupledWheel => "a wheel that feels the cracks",
            Self::Block => "a block of rail",
        }
    }

    fn key(self) -> &'static str {
        match self {
            Self::CoupledWheel => "contact.coupled",
            Self::Block => "rail.boundary",
        }
    }

    fn remedy(self) -> &'static str {
        match self {
            Self::CoupledWheel => "false",
            Self::Block => "\"half-plane\"",
        }
    }
}

/// A real kink at a tip whose virtual kinks reach a toughness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KinkAfter {
    /// Its length, mm.
    pub length: f64,
    /// The largest k1 at its end; `None` where the kinked crack cannot be computed.
    pub k1: Option<f64>,
}

/// A rail steel with its toughness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steel {
    /// K_Ic, MPa√m.
    pub toughness: f64,
    /// The name in EN 13674-1.
    pub name: &'static str,
    /// Where the name comes from.
    pub origin: SteelOrigin,
}

/// Origin of a steel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SteelOrigin {
    /// The case names it.
    Case,
    /// The case names none.
    Assumed,
}

impl std::fmt::Display for Steel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let origin = match self.origin {
            SteelOrigin::Case => "the rail steel that [growth] names",
            SteelOrigin::Assumed => "assumed because the case names no steel",
        };
        write!(
            f,
            "{:.0} MPa\u{221a}m of {}, {origin} (least mean at -20 degrees C by EN 13674-1)",
            self.toughness, self.name
        )
    }
}

/// The fate of a kink in a steel of `toughness`, all MPa√m.
fn kink_ends(after: Option<KinkAfter>, toughness: f64) -> String {
    match after {
        None => "such a rail may break, unless the kink arrests".to_owned(),
        Some(KinkAfter { length, k1: Some(k1) }) if k1 < toughness => format!(
            "such a kink pops in and arrests, since after {length} mm k1 is {k1:.1} MPa\u{221a}m; the run leaves it out"
        ),
        Some(KinkAfter { length, k1: Some(k1) }) => {
            format!("such a rail breaks, since after a kink of {length} mm k1 is still {k1:.1} MPa\u{221a}m")
        }
        Some(KinkAfter { length, k1: None }) => {
            format!("such a rail may break, a kink of {length} mm cannot be computed")
        }
    }
}

/// Source of the range of K in which a growth law was measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measured {
    /// From the table of the law.
    InTable,
    /// Not given; an assumption about rail steel.
    Assumed,
}

impl Measured {
    fn words(self) -> &'static str {
        match self {
            Self::InTable => "of the table of the law",
            Self::Assumed => {
                "in which rail steel is usually tested (an assumption: the law does not say where it was measured)"
            }
        }
    }
}

/// The yield stress (MPa) of `[shakedown]` where a case gives none.
const DEFAULT_YIELD_STRESS: f64 = 500.0;

/// Text on the source of a yield stress (MPa).
fn if_default(yield_stress: f64) -> &'static str {
    if yield_stress == DEFAULT_YIELD_STRESS {
        ", the default of [shakedown] and not that of this rail unless it is given as such"
    } else {
        " of [shakedown]"
    }
}

/// Whether a residual stress is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResidualStress {
    /// A profile, or a plastic stress.
    Given,
    /// None.
    Absent,
}

/// Depth (mm) to which a half-plane has the compliance of a rail that bends: the depth of the rail
/// head's sides.
pub(crate) const BENDING_DEPTH: f64 = 20.0;
/// Opening (mm) of a crack under a wheel up to which the contact is not affected; larger openings
/// exceed the indentation of the wheel.
pub const UNCOUPLED_OPENING: f64 = 0.05;
/// Fastest growth into the depth (mm per million gross tonnes) that is measured in track, by depth
/// (mm): 0.4 to 1.1 mm per 10 million gross tonnes at 0.3 to 2.3 mm, 2.4 to 3.2 mm at 5 to 8 mm.
pub const FASTEST_MEASURED: [(f64, f64); 2] = [(2.3, 0.11), (5.0, 0.32)];
/// The slowest growth of the same records.
pub const SLOWEST_MEASURED: [(f64, f64); 2] = [(2.3, 0.04), (5.0, 0.24)];
/// Growth over the fastest that is measured from which on a rate needs a reason.
const TOO_FAST: f64 = 0.3 / 0.11;

/// Growth into the depth (mm per million gross tonnes) at `depth` (mm) by one of the `measured`
/// bands: constant outside of its depths, linear in the logarithms between them.
#[must_use]
pub fn measured_growth(measured: [(f64, f64); 2], depth: f64) -> f64 {
    let [(shallow, slow), (deep, fast)] = measured;
    let share = (depth.max(shallow) / shallow).ln() / (deep / shallow).ln();
    slow * (fast / slow).powf(share.min(1.0))
}

/// Growth into the depth (mm per million gross tonnes) of a crack of `depth` (mm) from which on a
/// rate needs a reason.
#[must_use]
pub fn fast_growth(depth: f64) -> f64 {
    TOO_FAST * measured_growth(FASTEST_MEASURED, depth)
}
/// Kink (degrees) out of the plane of a crack in space, and its gain in rate, from which the plane
/// is no approximation of the path.
pub(crate) const OUT_OF_PLANE: (f64, f64) = (20.0, 1.1);
/// Distances of a patch from cracks, over its lateral semi-axis b, between which mode III counts:
/// closer, it is below 10 % of ΔK_eq (`patch_in_plane` of the verification); farther away, the
/// patch hardly loads the cracks.
pub(crate) const PATCH_BESIDE: (f64, f64) = (0.25, 3.0);
/// Length of a crack on the surface over that down the dip from which on the plane has weights.
pub(crate) const NARROWEST_CRACK: f64 = 2.0;
/// Largest |q|/p of dry steel on steel.
pub(crate) const DRY_FRICTION: f64 = 0.6;
/// ΔK_eq (MPa√m) between the threshold of rail steel and the end of stable growth: the usual range
/// of da/dN tests. It is assumed for laws that do not state their measured range.
pub(crate) const MEASURED_GROWTH: (f64, f64) = (4.0, 50.0);

/// Compares the largest pressure of `contact` with first yield and with the limit of elastic
/// shakedown, p0/k = `limits`; σ_y = `yield_stress` (MPa). With a residual stress only the latter
/// counts.
pub fn pressure(
    contact: &Contact,
    limits: [f64; 2],
    yield_stress: f64,
    residual: ResidualStress,
) -> Option<ValidityWarning> {
    let (peak_pressure, adhesion) = (contact.peak_pressure(), contact.adhesion());
    let shear_yield = yield_stress / 3f64.sqrt();
    let limit = shear_yield * limits[0];
    if peak_pressure <= limit {
        return None;
    }
    let beyond = ValidityWarning::BeyondFirstYield { peak_pressure, limit, adhesion, yield_stress };
    let limit = shear_yield * limits[1];
    if peak_pressure > limit {
        return Some(ValidityWarning::BeyondShakedown { peak_pressure, limit, adhesion, yield_stress });
    }
    (residual == ResidualStress::Absent).then_some(beyond)
}

/// Compares the shear of `contact` with the friction of dry steel, 0.6.
pub fn shear(contact: &Contact) -> Option<ValidityWarning> {
    let ratio = contact.largest_friction();
    (ratio > DRY_FRICTION).then_some(ValidityWarning::ShearBeyondFriction { ratio, friction: DRY_FRICTION })
}

/// Compares the largest `k1` (MPa √mm) of a virtual kink with the toughness of `steel`; `after`, k1
/// (MPa √mm) at the end of a real kink, tells a rail that breaks from a kink that arrests.
pub fn toughness(k1: f64, after: Option<KinkAfter>, steel: &Steel) -> Option<ValidityWarning> {
    let k1 = k1 / MPA_SQRT_MM;
    let after = after.map(|after| KinkAfter { k1: after.k1.map(|k1| k1 / MPA_SQRT_MM), ..after });
    (k1 > steel.toughness).then_some(ValidityWarning::BeyondToughness { k1, after, steel: *steel })
}

/// Compares ΔK_eq (MPa√m) = `delta_k` of a growing tip with the range of the `table` of its law, or
/// with 4 to 50 MPa √m.
pub fn growth(delta_k: f64, table: Option<(f64, f64)>) -> Option<ValidityWarning> {
    let (least, most) = table.unwrap_or(MEASURED_GROWTH);
    let measured = if table.is_some() { Measured::InTable } else { Measured::Assumed };
    let outside = delta_k < least || delta_k > most;
    outside.then_some(ValidityWarning::OutsideLaw { delta_k, least, most, measured })
}

/// Compares the `depth` (mm) of the deepest tip in a rail that bends with 20 mm.
pub fn depth_in_bending(depth: f64) -> Option<ValidityWarning> {
    (depth > BENDING_DEPTH).then_some(ValidityWarning::DeepCrackInBending { depth, limit: BENDING_DEPTH })
}

/// Compares the largest `opening` (mm) of faces with fluid with 0.05 mm, which has no influence on
/// the contact.
pub fn flap(opening: f64) -> Option<ValidityWarning> {
    let limit = UNCOUPLED_OPENING;
    (opening > limit).then_some(ValidityWarning::LiftedFlap { opening, limit })
}

/// Compares the growth (mm per million gross tonnes) into the depth of a crack of `depth` (mm) with
/// what is measured in track.
pub fn depth_rate(rate: f64, depth: f64) -> Option<ValidityWarning> {
    let limit = fast_growth(depth);
    (rate > limit).then_some(ValidityWarning::FastGrowth { rate, depth, limit })
}

/// Checks the kink (degrees) that the direction criterion asks for at the deepest point of a crack
/// in space, and its rate in relation to that straight ahead.
pub fn out_of_plane(angle: f64, ratio: f64) -> Option<ValidityWarning> {
    let (least_angle, least_ratio) = OUT_OF_PLANE;
    (angle.abs() >= least_angle && ratio >= least_ratio)
        .then_some(ValidityWarning::OutOfPlane { angle, ratio })
}

/// Checks the distance of a contact patch from cracks in the plane over its lateral semi-axis.
pub fn patch_beside(offset: f64) -> Option<ValidityWarning> {
    let (near, far) = PATCH_BESIDE;
    (offset > near && offset < far).then_some(ValidityWarning::PatchBeside { offset })
}

/// Checks the length on the surface over that down the dip of a crack in the plane.
pub fn crack_width(ratio: f64) -> Option<ValidityWarning> {
    (ratio < NARROWEST_CRACK).then_some(ValidityWarning::NarrowCrack { ratio })
}

/// Checks that an axle of `track` is at the wheel, at 0.
pub fn axles(track: &Track) -> Option<ValidityWarning> {
    track.axles.iter().all(|axle| axle.at != 0.0).then_some(ValidityWarning::NoAxleHere)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::wheel_under;
    use crate::load::{HertzianContact, WheelLoad};
    use crate::material::IsotropicElastic;
    use crate::shakedown::ContactBounds;

    fn warned(peak_pressure: f64, friction: f64, residual: ResidualStress) -> Option<ValidityWarning> {
        let contact = Contact::Hertz(HertzianContact { peak_pressure, half_width: 6.75, friction });
        let load = WheelLoad { contact: contact.clone(), track: None, temperature: None };
        let wheel = wheel_under(&load, &IsotropicElastic::new(210e3, 0.3).unwrap()).unwrap();
        let bounds = ContactBounds::new(&contact, wheel.as_ref());
        let limits = [bounds.first_yield().ratio, bounds.shakedown_limit().ratio];
        pressure(&contact, limits, 500.0, residual)
    }

    #[test]
    fn pressures_are_compared_with_both_limits() {
        let of = |peak, residual| warned(peak, 0.1, residual);
        // p0/k = 3.063 and 3.987 at friction 0.1: 884 and 1151 MPa.
        assert_eq!(of(880.0, ResidualStress::Absent), None);
        let beyond = of(890.0, ResidualStress::Absent);
        assert!(matches!(beyond, Some(ValidityWarning::BeyondFirstYield { .. })), "{beyond:?}");
        assert_eq!(of(890.0, ResidualStress::Given), None);
        let beyond = of(1160.0, ResidualStress::Given);
        assert!(matches!(beyond, Some(ValidityWarning::BeyondShakedown { .. })), "{beyond:?}");
        let text = warned(1600.0, 0.4, ResidualStress::Absent).unwrap().to_string();
        assert!(text.starts_with("the peak pressure of 1600 MPa is beyond the limit of elastic"), "{text}");
        assert!(text.contains("500 MPa, the default of [shakedown]"), "{text}");
    }

    #[test]
    fn kinks_out_of_a_plane_are_told() {
        let text = out_of_plane(-34.6, 1.7).unwrap().to_string();
        assert!(text.contains("-35 degrees") && text.contains("1.70 times"), "{text}");
        assert_eq!([out_of_plane(19.0, 1.7), out_of_plane(34.0, 1.05)], [None, None]);
    }

    #[test]
    fn patches_and_widths_that_a_plane_crack_cannot_have() {
        assert_eq!([0.0, 0.25, 3.0, 9.0].map(patch_beside), [None; 4]);
        let text = patch_beside(0.5).unwrap().to_string();
        assert!(text.contains("lies 0.50 b beside") && text.contains("mode III"), "{text}");
        assert_eq!([2.0, 4.0, f64::INFINITY].map(crack_width), [None; 3]);
        assert!(crack_width(1.5).unwrap().to_string().starts_with("a crack is 1.50 times as long"));
        let of = |taken_by| ValidityWarning::StripOfPatch { taken_by }.to_string();
        assert!(of(LineContact::CoupledWheel).contains("contact.coupled = false takes the whole patch"));
        assert!(of(LineContact::Block).contains("rail.boundary = \"half-plane\" takes the whole patch"));
    }

    #[test]
    fn other_limits_are_exact() {
        let steel = Steel { toughness: 29.0, name: "R260", origin: SteelOrigin::Assumed };
        assert_eq!(toughness(29.0 * MPA_SQRT_MM, None, &steel), None);
        let after = |k1| Some(KinkAfter { length: 2.0, k1 });
        for (after, says) in [
            (after(Some(28.9 * MPA_SQRT_MM)), "pops in and arrests, since after 2 mm k1 is 28.9"),
            (
                after(Some(29.1 * MPA_SQRT_MM)),
                "such a rail breaks, since after a kink of 2 mm k1 is still 29.1",
            ),
            (after(None), "may break, a kink of 2 mm cannot be computed"),
            (None, "may break, unless"),
        ] {
            let text = toughness(29.5 * MPA_SQRT_MM, after, &steel).unwrap().to_string();
            assert!(text.contains(says) && text.contains("the case names no steel"), "{text}");
        }
        assert_eq!(depth_in_bending(20.0), None);
        assert!(matches!(depth_in_bending(25.0), Some(ValidityWarning::DeepCrackInBending { .. })));
        assert_eq!((growth(4.0, None), growth(50.0, None)), (None, None));
        let below = growth(2.0, None).unwrap().to_string();
        assert!(below.contains("an assumption"), "{below}");
        let in_table = growth(2.0, Some((3.0, 30.0))).unwrap().to_string();
        assert!(in_table.contains("is below the 3 to 30 MPa\u{221a}m of the table"), "{in_table}");
        assert!(below.contains("of 2.0 MPa\u{221a}m is below the 4 to 50 MPa"), "{below}");
    }
}
