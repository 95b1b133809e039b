//! `[contact] kind = "rolling"`: a patch in rolling contact.

use super::contact::{
    CREEPAGE_X, CREEPAGE_Y, ContactExtent, ContactOrigin, FRICTION, HALF_WIDTH, LATERAL, NORMAL,
    PEAK_PRESSURE, ProfileOrigin, RAIL_AXES, RAIL_HEAD_RADIUS, RAIL_PROFILE, ROLL, SEMI_AXES, SHIFT, SIGN,
    SMOOTHING, SPIN, THEORY, WHEEL_AXES, WHEEL_PROFILE, WHEEL_PROFILE_RADIUS, WHEEL_RADIUS, YAW,
    out_of_range,
};
use crate::files::{ProfileReading, Profiled, read_points};
use crate::schema::{Report, SectionValues};
use railcrack::load::{Contact, HertzEllipse, Travel, WheelOnRail};
use railcrack::material::IsotropicElastic;
use railcrack::profiles::{Profile, ProfileContact, ProfilePair, SearchError, WheelPosition};
use railcrack::rolling::{Creepage, PatchError, PlacedPatch, RollingPatch, StripOutline};
use std::f64::consts::PI;
use std::path::Path;

/// Contact of the strip that loads the crack, of a wheel that runs towards `travel`; files are
/// relative to `folder`. For a whole patch, this is its middle strip.
pub(super) fn read_rolling(
    section: &SectionValues,
    steel: &IsotropicElastic,
    travel: Travel,
    extent: ContactExtent,
    folder: &Path,
    report: &mut Report,
) -> Option<(Contact, ContactOrigin)> {
    let friction = section.get(FRICTION)?;
    if friction < 0.0 {
        let help = "the friction of the slip zone; the signs of the shear follow from the creepages";
        return report.refuse(section.fault(FRICTION, "must be a number in [0, 1]").help(help));
    }
    let given = Creepage {
        longitudinal: section.get(CREEPAGE_X)?,
        lateral: section.get(CREEPAGE_Y)?,
        spin: section.get(SPIN)?,
    };
    let (creepage, theory) = (section.get(SIGN)?.read(given), section.get(THEORY)?);
    let rolling = |ellipse: HertzEllipse, outline: Option<StripOutline>| RollingPatch {
        ellipse,
        outline,
        friction,
        creepage,
        steel: *steel,
        theory,
    };
    if section.get(RAIL_PROFILE).is_some() {
        return read_profiles(section, (steel, travel, extent), folder, rolling, report);
    }
    let ellipse = read_ellipse(section, steel, report)?;
    let patch = checked(section, rolling(ellipse, None), report)?;
    let lateral = section.get(LATERAL).unwrap_or(0.0);
    let place = if extent == ContactExtent::Patch { 0.0 } else { lateral };
    let Ok(contact) = patch.plane_contact(place, travel) else {
        let across = ellipse.across;
        let says = format!("is outside the patch, which reaches {across:.3} mm to either side");
        return report.refuse(section.fault(LATERAL, says).help("choose a strip within the patch"));
    };
    let contact = within_limits(section, contact, report)?;
    Some((contact, ContactOrigin::Rolling { patch: Box::new(patch), lateral, travel }))
}

/// The patch, if it can roll as described.
fn checked(section: &SectionValues, patch: RollingPatch, report: &mut Report) -> Option<RollingPatch> {
    if let Err(error) = patch.check() {
        return report.refuse(match error {
            PatchError::NoFriction => section.fault(FRICTION, error),
            PatchError::Saturated { .. } => section.fault(THEORY, error),
            PatchError::Range(_) => section.fault_of_all(error),
        });
    }
    Some(patch)
}

/// The contact, if its pressure and width are those of a wheel.
fn within_limits(section: &SectionValues, contact: Contact, report: &mut Report) -> Option<Contact> {
    let refusal = out_of_range(PEAK_PRESSURE, contact.peak_pressure())
        .or_else(|| out_of_range(HALF_WIDTH, contact.half_width()));
    if let Some(says) = refusal {
        let help = "normal force and radii, semi-axes or profiles together define the patch, and lateral_mm its strip";
        return report.refuse(section.fault(NORMAL, says).help(help));
    }
    Some(contact)
}

/// The patches of a pair of profiles, of which those over the crack load it.
fn read_profiles(
    section: &SectionValues,
    (steel, travel, extent): (&IsotropicElastic, Travel, ContactExtent),
    folder: &Path,
    rolling: impl Fn(HertzEllipse, Option<StripOutline>) -> RollingPatch,
    report: &mut Report,
) -> Option<(Contact, ContactOrigin)> {
    let smoothing = section.get(SMOOTHING)?;
    let of_rail = ProfileReading { smoothing, is: Profiled::Rail, axes: section.get(RAIL_AXES) };
    let of_wheel = ProfileReading { smoothing, is: Profiled::Wheel, axes: section.get(WHEEL_AXES) };
    let rail = read_points(section, RAIL_PROFILE, of_rail, folder, report);
    let wheel = read_points(section, WHEEL_PROFILE, of_wheel, folder, report);
    let (rail, wheel) = (rail?, wheel?);
    check_sides(section, rail.content(), wheel.content(), report)?;
    let position = WheelPosition {
        shift: section.get(SHIFT)?,
        yaw: section.get(YAW)?.to_radians(),
        roll: section.get(ROLL)?.to_radians(),
    };
    let radius = section.get(WHEEL_RADIUS)?;
    let pair = ProfilePair { rail: rail.content(), wheel: wheel.content(), radius, position, steel };
    let normal = 1e3 * section.get(NORMAL)?;
    let contacts = match pair.contacts(normal) {
        Ok(contacts) => contacts,
        Err(error) => {
            let row = match error {
                SearchError::NoApproach { .. } | SearchError::Range(_) => NORMAL,
                SearchError::Apart { .. } | SearchError::AtEnd { .. } => SHIFT,
            };
            return report.refuse(section.fault(row, error));
        }
    };
    let load = |i: usize| contacts[i].normal_force;
    let most = (0..contacts.len()).reduce(|a, b| if load(b) > load(a) { b } else { a })?;
    let heaviest = contacts[most];
    let lateral = section.get(LATERAL).unwrap_or(heaviest.y);
    let mut placed = Vec::new();
    for own in &contacts {
        let patch = checked(section, rolling(own.ellipse, Some(own.outline)), report)?;
        placed.push(PlacedPatch {
            patch,
            y: (lateral - own.y) / own.angle.cos(),
            x: own.ahead - heaviest.ahead,
        });
    }
    let contact = match extent {
        ContactExtent::Patch => placed[most].patch.plane_contact(0.0, travel).ok(),
        ContactExtent::Strip => PlacedPatch::plane_contact(&placed, travel),
    };
    let Some(contact) = contact else {
        let reach = |own: &ProfileContact| {
            let [from, to] = own.outline.ends().map(|end| own.y + end * own.angle.cos());
            format!("{from:.2} to {to:.2} mm")
        };
        let all: Vec<String> = contacts.iter().map(reach).collect();
        let says = format!("is outside the patches, which reach from {}", all.join(" and "));
        return report.refuse(section.fault(LATERAL, says).help("y of the crack on the profile of the rail"));
    };
    let contact = within_limits(section, contact, report)?;
    let origin = ProfileOrigin { rail, wheel, contacts, placed, lateral, travel };
    Some((contact, ContactOrigin::Profiles(Box::new(origin))))
}

/// Rejects a wheel whose flange is not at the gauge side of an inclined rail.
fn check_sides(section: &SectionValues, rail: &Profile, wheel: &Profile, report: &mut Report) -> Option<()> {
    let (Some(side), Some([flange, _])) = (rail.gauge_side(), wheel.flange()) else { return Some(()) };
    if side * flange > 0.0 {
        return Some(());
    }
    let named = if side > 0.0 { "positive" } else { "negative" };
    let says = format!(
        "the flange of the wheel lies at y = {flange:.1} mm, but the rail falls to {named} y, where its gauge face is: one of the profiles is mirrored"
    );
    let help = "wheel_profile_axes = \"mirrored\" or rail_profile_axes = \"mirrored\" turns the file over";
    report.refuse(section.fault(WHEEL_PROFILE, says).help(help))
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
            return report.refuse(
                section.fault(SEMI_AXES, says).help("half the length of the patch, then half its width"),
            );
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
