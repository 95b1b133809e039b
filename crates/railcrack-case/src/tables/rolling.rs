//! `[contact] kind = "rolling"`: a patch in rolling contact.

use super::contact::{
    CREEPAGE_X, CREEPAGE_Y, ContactExtent, ContactOrigin, FRICTION, HALF_WIDTH, KIND, LATERAL, NORMAL,
    PEAK_PRESSURE, RAIL_HEAD_RADIUS, SEMI_AXES, SIGN, SPIN, THEORY, WHEEL_PROFILE_RADIUS, WHEEL_RADIUS,
    out_of_range,
};
use crate::schema::{Report, SectionValues};
use railcrack::load::{Contact, HertzEllipse, Travel, WheelOnRail};
use railcrack::material::IsotropicElastic;
use railcrack::rolling::{Creepage, PatchError, RollingPatch};
use std::f64::consts::PI;

/// Contact of the strip that loads the crack, of a wheel that runs towards `travel`.
pub(super) fn read_rolling(
    section: &SectionValues,
    steel: &IsotropicElastic,
    travel: Travel,
    extent: ContactExtent,
    report: &mut Report,
) -> Option<(Contact, ContactOrigin)> {
    if extent == ContactExtent::Ellipse {
        let says = "the space engine computes the Hertz ellipse in full sliding only";
        report.add(section.fault(KIND, says).help("use kind = \"hertz\", or a plane engine"));
        return None;
    }
    let friction = section.get(FRICTION)?;
    if friction < 0.0 {
        let help = "the friction of the slip zone; the signs of the shear follow from the creepages";
        report.add(section.fault(FRICTION, "must be a number in [0, 1]").help(help));
        return None;
    }
    let ellipse = read_ellipse(section, steel, report)?;
    let given = Creepage {
        longitudinal: section.get(CREEPAGE_X)?,
        lateral: section.get(CREEPAGE_Y)?,
        spin: section.get(SPIN)?,
    };
    let (creepage, theory) = (section.get(SIGN)?.read(given), section.get(THEORY)?);
    let patch = RollingPatch { ellipse, friction, creepage, steel: *steel, theory };
    if let Err(error) = patch.check() {
        report.add(match error {
            PatchError::NoFriction => section.fault(FRICTION, error),
            PatchError::Saturated { .. } => section.fault(THEORY, error),
            PatchError::Range(_) => section.fault_of_all(error),
        });
        return None;
    }
    let lateral = section.get(LATERAL).unwrap_or(0.0);
    let Ok(contact) = patch.plane_contact(lateral, travel) else {
        let across = ellipse.across;
        let says = format!("is outside the patch, which reaches {across:.3} mm to either side");
        report.add(section.fault(LATERAL, says).help("choose a strip within the patch"));
        return None;
    };
    let refusal = out_of_range(PEAK_PRESSURE, contact.peak_pressure())
        .or_else(|| out_of_range(HALF_WIDTH, contact.half_width()));
    if let Some(says) = refusal {
        let help = "normal force and radii or semi-axes together define the patch, and lateral_mm its strip";
        report.add(section.fault(NORMAL, says).help(help));
        return None;
    }
    Some((contact, ContactOrigin::Rolling { patch, lateral }))
}

/// The ellipse of the normal force with the semi-axes or the radii.
fn read_ellipse(
    section: &SectionValues,
    steel: &IsotropicElastic,
    report: &mut Report,
) -> Option<HertzEllipse> {
    let normal = 1e3 * section.get(NORMAL)?;
    if let Some(axes) = section.get(SEMI_AXES) {
        let [along, across] = axes[..] else {
            let says = format!("{} numbers; must be two, [a, b]", axes.len());
            report.add(
                section.fault(SEMI_AXES, says).help("half the length of the patch, then half its width"),
            );
            return None;
        };
        return Some(HertzEllipse { peak_pressure: 1.5 * normal / (PI * along * across), along, across });
    }
    let wheel = WheelOnRail {
        wheel_load: normal,
        wheel_radius: section.get(WHEEL_RADIUS)?,
        rail_head_radius: section.get(RAIL_HEAD_RADIUS)?,
        wheel_profile_radius: section.get(WHEEL_PROFILE_RADIUS)?,
    };
    HertzEllipse::new(&wheel, steel)
        .map_err(|error| report.add(section.fault(WHEEL_PROFILE_RADIUS, error)))
        .ok()
}
