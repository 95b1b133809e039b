//! `[contact]`: wheel on rail.

use crate::files::{ContactFile, ContactReading, PointFile, ProfileAxes, read_contact_table};
use crate::schema::{
    Choice, KeyRow, Kind, NumberRange, Preset, RangeEnd, Report, SectionValues, Word, choice, closed, file,
    integer, number, numbers, read_by_word, section, switch, within,
};
use railcrack::load::{
    CarterContact, Contact, ContactKind, HertzEllipse, HertzianContact, Travel, WheelOnRail,
};
use railcrack::material::IsotropicElastic;
use railcrack::profiles::ProfileContact;
use railcrack::rolling::{CreepageSign, PlacedPatch, RollingPatch, RollingTheory};
use std::path::Path;

/// Curvatures across the rail: straight, or a radius of either sign.
const PROFILE_RADII: NumberRange =
    NumberRange { min: RangeEnd::Closed(-1e6), max: RangeEnd::Closed(f64::INFINITY) };

const TABLE: &str = "table";
const ROLLING: &str = "rolling";
const PROFILED: &str = "profiles belong to rolling contact";
const SLIDING: &str = "creepage belongs to rolling contact";
const HERTZIAN: &str = "a table defines its own pressure and extent";
const SIZED: &str = "a table defines its own pressure and extent, and rolling contact follows from normal_kn";

section! {
    CONTACT "contact", Required, "Wheel-rail contact; one passage is one axle.",
        forms [[PEAK_PRESSURE, HALF_WIDTH, LATERAL_HALF_WIDTH], [LINE_LOAD, WHEEL_RADIUS, RAIL_RADIUS],
            [WHEEL_LOAD, WHEEL_RADIUS, RAIL_HEAD_RADIUS, WHEEL_PROFILE_RADIUS],
            [CONTACT_PROFILE, SCALE, STRIP],
            [NORMAL, WHEEL_RADIUS, RAIL_HEAD_RADIUS, WHEEL_PROFILE_RADIUS], [NORMAL, SEMI_AXES],
            [NORMAL, WHEEL_RADIUS, RAIL_PROFILE, WHEEL_PROFILE, RAIL_AXES, WHEEL_AXES, SMOOTHING, SHIFT, YAW, ROLL]],
        instead "wheel";
    KIND: ContactKind = choice("kind", "Description of the contact.");
    PEAK_PRESSURE: f64 = number("peak_pressure_mpa", "MPa", closed(1e-3, 1e4), 845.0, "Peak pressure p0.")
        .required().only_with_any(KIND, "hertz", &["carter"], SIZED);
    HALF_WIDTH: f64 =
        number("half_width_mm", "mm", closed(0.01, 100.0), 6.75,
            "Half-width a of the contact.")
        .required().only_with_any(KIND, "hertz", &["carter"], SIZED);
    LINE_LOAD: f64 =
        number("line_load_n_per_mm", "N/mm", closed(1e-5, 1e7), 8959.4, "Wheel load per unit width.")
        .required().only_with_any(KIND, "hertz", &["carter"], SIZED);
    WHEEL_RADIUS: f64 = number("wheel_radius_mm", "mm", closed(1e-2, 1e5), 460.9, "Radius of the wheel.")
        .required().only_with_any(KIND, "hertz", &["carter", ROLLING], HERTZIAN);
    RAIL_RADIUS: f64 = number("rail_radius_mm", "mm", closed(0.01, f64::INFINITY), f64::INFINITY,
        "Longitudinal radius of the rail; inf if flat.")
        .only_with_any(KIND, "hertz", &["carter"], SIZED);
    WHEEL_LOAD: f64 = number("wheel_load_kn", "kN", closed(1e-3, 1e4), 100.0,
        "Wheel load; with the radii it defines the contact ellipse.")
        .required().only_with_any(KIND, "hertz", &["carter"], SIZED);
    RAIL_HEAD_RADIUS: f64 = number("rail_head_radius_mm", "mm", closed(0.01, f64::INFINITY), 300.0,
        "Transverse radius of the rail head; inf if flat.")
        .required().only_with_any(KIND, "hertz", &["carter", ROLLING], HERTZIAN);
    WHEEL_PROFILE_RADIUS: f64 = number("wheel_profile_radius_mm", "mm", PROFILE_RADII, f64::INFINITY,
        "Transverse radius of the wheel profile; inf if straight, negative if concave.")
        .only_with_any(KIND, "hertz", &["carter", ROLLING], HERTZIAN);
    LATERAL_HALF_WIDTH: f64 = number("lateral_half_width_mm", "mm", closed(0.1, 1e3), 6.0,
        "Lateral semi-axis b of the contact ellipse; without it the contact is a line contact, which the space engine refuses.")
        .only_with_any(KIND, "hertz", &["carter"], SIZED).optional();
    LATERAL: f64 = number("lateral_mm", "mm", within(100.0), 0.0,
        "Lateral position of the ellipse relative to the cracks, by default 0; with rolling, y of the crack in the patch; with profiles, y of the crack on rail_profile, by default under the most loaded patch.")
        .only_with_any(KIND, "hertz", &["carter", ROLLING], HERTZIAN).optional();
    LATERAL_EXTENT: ContactExtent = choice("lateral",
        "Part of the contact that loads cracks in the plane: by default the patch, in a block or with coupled the strip.")
        .only_with_words(KIND, &["hertz", "carter", ROLLING], HERTZIAN).optional();
    CONTACT_PROFILE: String = file("profile", "inputs/contact-table", "contact.csv",
        "CSV file with the columns u_mm,p_mpa,q_mpa, u from the wheel centre along +x, linear between rows; or a .mat file of the program CONTACT.")
        .required().only_with(KIND, TABLE, "pressure and shear are computed");
    SCALE: f64 = number("scale", "", closed(1e-6, 1e6), 1.0, "Factor on pressure and shear.")
        .only_with(KIND, TABLE, "pressure and shear are computed");
    STRIP: f64 = number("strip_mm", "mm", within(1e3), 0.0,
        "Lateral position, in CONTACT's frame, of the strip of a .mat file.")
        .only_with(KIND, TABLE, "lateral_mm chooses the strip of an ellipse").optional();
    FRICTION: f64 = number("friction", "", closed(-1.0, 1.0), 0.025,
        "Wheel-rail friction coefficient; with carter and rolling that of the slip zone, with table an upper limit of abs(q)/p. Negative only with hertz without torque: > 0 drags the rail along +x (a wheel braking towards +x).")
        .required_but_with(KIND, TABLE, "a table defines its own shear");
    TORQUE: Torque = choice("torque",
        "Direction of the shear; friction then has no sign.")
        .only_with(KIND, "hertz", "the sign of the shear is that of traction or creepage").optional();
    LATERAL_FRICTION: f64 = number("lateral_friction", "", closed(-1.0, 1.0), 0.0,
        "Ratio of lateral shear to pressure, > 0 towards +z; by default 0. In the plane it has no effect at lateral_mm = 0.")
        .only_with(KIND, "hertz", "no other contact has lateral shear of its own").optional();
    TRACTION: f64 = number("traction", "", closed(-1.0, 1.0), -0.5,
        "Traction ratio Q/(friction P), signed like the shear on the rail along +x: < 0 drives a wheel towards +x; 1 and -1 are full sliding.")
        .required().only_with(KIND, "carter", "full sliding mobilises all friction, and a table defines its own shear");
    NORMAL: f64 = number("normal_kn", "kN", closed(1e-3, 1e4), 100.0,
        "Normal force; with profiles, the sum over the patches.")
        .required().only_with(KIND, ROLLING, "wheel_load_kn is the load of the other contacts");
    SEMI_AXES: Vec<f64> = numbers("semi_axes_mm", "mm", closed(0.01, 100.0), &[6.0, 5.0],
        "Semi-axes [a, b] of the contact ellipse, along and across the rail.")
        .required().only_with(KIND, ROLLING, "half_width_mm and lateral_half_width_mm are the semi-axes of the other contacts");
    RAIL_PROFILE: String = file("rail_profile", "inputs/rail-profile", "rail.csv",
        "CSV file with the points y_mm,z_mm of the rail head in order, z downwards; or two columns without a header, or a file of MiniProf (.ban) or Simpack (.prr).")
        .required().only_with(KIND, ROLLING, PROFILED);
    WHEEL_PROFILE: String = file("wheel_profile", "inputs/wheel-profile", "wheel.csv",
        "Wheel profile in the axes and formats of rail_profile (.whl, .prw); wheel_radius_mm is the radius at z = 0.")
        .required().only_with(KIND, ROLLING, PROFILED);
    RAIL_AXES: ProfileAxes = choice("rail_profile_axes", "Axes of rail_profile, after those that a Simpack file states; by default z-down, in MiniProf files also z-up.")
        .only_with(KIND, ROLLING, PROFILED).optional();
    WHEEL_AXES: ProfileAxes = choice("wheel_profile_axes", "Axes of wheel_profile, likewise.")
        .only_with(KIND, ROLLING, PROFILED).optional();
    SMOOTHING: f64 = number("profile_smoothing_mm", "mm", closed(0.01, 20.0), 1.0,
        "Half the length of the parabolas fitted to the profiles; about 3 for measured points with scatter.")
        .only_with(KIND, ROLLING, PROFILED);
    SHIFT: f64 = number("shift_mm", "mm", within(200.0), 0.0, "y of the origin of wheel_profile on rail_profile.")
        .only_with(KIND, ROLLING, PROFILED);
    YAW: f64 = number("yaw_deg", "degrees", within(10.0), 0.0,
        "Angle of attack of the wheel, > 0 towards +y.").only_with(KIND, ROLLING, PROFILED);
    ROLL: f64 = number("roll_deg", "degrees", within(10.0), 0.0,
        "Rotation of wheel_profile about its origin; > 0 lowers +y.").only_with(KIND, ROLLING, PROFILED);
    CREEPAGE_X: f64 = number("creepage_x", "", within(1.0), 0.0, "Longitudinal creepage, signed by creepage_sign.")
        .only_with(KIND, ROLLING, SLIDING);
    CREEPAGE_Y: f64 = number("creepage_y", "", within(1.0), 0.0, "Lateral creepage.")
        .only_with(KIND, ROLLING, SLIDING);
    SPIN: f64 = number("spin_per_mm", "1/mm", within(1.0), 0.0, "Spin creepage; with creepage_sign = \"contact\", > 0 turns +x (travel) towards +y.")
        .only_with(KIND, ROLLING, SLIDING);
    SIGN: CreepageSign = choice("creepage_sign", "Sign convention of creepages and spin.")
        .required().only_with(KIND, ROLLING, SLIDING);
    THEORY: RollingTheory = choice("theory", "Theory of the shear.").only_with(KIND, ROLLING, SLIDING);
    COUPLED: bool = switch("coupled", Preset::Switch(false),
        "Whether the wheel feels the cracks: the pressure is that of a smooth elastic wheel on the cracked rail, as a line contact (of an ellipse, the strip at lateral_mm). Plane engines and half-plane only.")
        .only_with_words(KIND, &["hertz", "carter", "rolling"], "a wheel that feels the cracks needs a half-ellipse of pressure on the uncracked rail");
    SURFACE_NODES: usize = integer("surface_nodes_per_half_width", (10, 160), 40,
        "Surface nodes per half-width of a coupled wheel, denser at the mouths; by default 40.")
        .only_with_words(KIND, &["hertz", "carter", "rolling"], "a wheel that feels the cracks needs a half-ellipse of pressure on the uncracked rail").optional();
    COUPLED_WITHIN: f64 = number("coupled_within_over_a", "a", closed(1.5, 12.0), 3.0,
        "Distance of the contact centre from the nearest mouth up to which a coupled wheel feels the cracks; by default 3.")
        .only_with_words(KIND, &["hertz", "carter", "rolling"], "a wheel that feels the cracks needs a half-ellipse of pressure on the uncracked rail").optional();
}

read_by_word!(Torque, ContactKind, CreepageSign, RollingTheory, ContactExtent, ProfileAxes);

/// Origin of the numbers of a contact.
#[derive(Debug, Clone, PartialEq)]
pub enum ContactOrigin {
    /// Peak pressure and half-width are given.
    Given,
    /// Peak pressure and both semi-axes of the ellipse are given.
    GivenEllipse {
        /// The ellipse.
        ellipse: HertzEllipse,
        /// Offset of the strip from its middle, mm.
        lateral: f64,
        /// Ratio of lateral shear to pressure, > 0 towards +z; no strip carries it.
        lateral_friction: f64,
    },
    /// A line load on cylinders.
    LineLoad {
        /// R of 1/R = 1/R_wheel + 1/R_rail, mm.
        radius: f64,
    },
    /// A strip of the Hertz ellipse.
    Ellipse {
        /// Wheel and rail.
        wheel: WheelOnRail,
        /// Their ellipse.
        ellipse: HertzEllipse,
        /// Offset of the strip from its middle, mm.
        lateral: f64,
        /// Ratio of lateral shear to pressure, > 0 towards +z; no strip carries it.
        lateral_friction: f64,
    },
    /// A table.
    Table(ContactFile),
    /// A strip of a patch in rolling contact.
    Rolling {
        /// The patch.
        patch: Box<RollingPatch>,
        /// y of the strip in the patch, mm.
        lateral: f64,
        /// Direction in which the wheel runs.
        travel: Travel,
    },
    /// Patches of profiles.
    Profiles(Box<ProfileOrigin>),
}

/// Patches in rolling contact that follow from profiles.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfileOrigin {
    /// The profile of the rail.
    pub rail: PointFile,
    /// The profile of the wheel.
    pub wheel: PointFile,
    /// The patches, by increasing y.
    pub contacts: Vec<ProfileContact>,
    /// The same, with the place of the crack in each.
    pub placed: Vec<PlacedPatch>,
    /// y of the crack on the rail's profile, mm.
    pub lateral: f64,
    /// Direction in which the wheel runs.
    pub travel: Travel,
}

impl ContactOrigin {
    /// Whether it has a lateral extent: an ellipse, or patches in rolling contact.
    #[must_use]
    pub fn is_patch(&self) -> bool {
        match self {
            Self::GivenEllipse { .. } | Self::Ellipse { .. } | Self::Rolling { .. } | Self::Profiles(_) => {
                true
            }
            Self::Given | Self::LineLoad { .. } | Self::Table(_) => false,
        }
    }

    /// R of 1/R = 1/R_wheel + 1/R_rail in the plane of the model, mm, where it is known.
    #[must_use]
    pub fn radius(&self) -> Option<f64> {
        match self {
            Self::LineLoad { radius } => Some(*radius),
            Self::Ellipse { wheel, .. } => Some(wheel.wheel_radius),
            Self::Given
            | Self::GivenEllipse { .. }
            | Self::Table(_)
            | Self::Rolling { .. }
            | Self::Profiles(_) => None,
        }
    }
}

/// Part of a contact patch that loads the cracks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactExtent {
    /// The whole patch.
    Patch,
    /// The strip above the cracks, as a line contact.
    Strip,
}

impl Choice for ContactExtent {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Patch, Word::now("patch", "averaged along the crack front")),
        (Self::Strip, Word::now("strip", "at lateral_mm, as a line contact")),
    ];
}

/// Which way the torque of a wheel acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Torque {
    /// It drives the train.
    Driven,
    /// It brakes it.
    Braked,
}

impl Choice for Torque {
    const WORDS: &'static [(Self, Word)] = &[
        (Self::Driven, Word::now("driven", "drags the rail backwards")),
        (Self::Braked, Word::now("braked", "drags the rail forwards")),
    ];
}

impl Torque {
    /// `friction`, which is not negative, with the sign of the shear on the rail along +x under a
    /// wheel that runs towards `travel`.
    fn signed(self, friction: f64, travel: Travel) -> f64 {
        let forwards = if travel == Travel::Forward { friction } else { -friction };
        match self {
            Self::Driven => -forwards,
            Self::Braked => forwards,
        }
    }
}

/// Contact, of a kind other than rolling, of a wheel that runs towards `travel` with a rail of
/// `steel`; files are relative to `folder`. For a whole ellipse, this is its middle strip.
pub(crate) fn read_contact(
    section: &SectionValues,
    steel: &IsotropicElastic,
    travel: Travel,
    extent: ContactExtent,
    folder: &Path,
    report: &mut Report,
) -> Option<(Contact, ContactOrigin)> {
    let kind = section.get(KIND)?;
    if kind == ContactKind::Table {
        return read_table(section, travel, folder, report);
    }
    let friction = section.get(FRICTION)?;
    if kind == ContactKind::Carter && friction < 0.0 {
        let help = "the friction of the slip zone; the sign of the shear is that of traction";
        return report.refuse(section.fault(FRICTION, "must be a number in [0, 1]").help(help));
    }
    let friction = match section.get(TORQUE) {
        Some(_) if friction < 0.0 => {
            let help = "torque says which way the shear acts; without it, friction has its sign";
            return report.refuse(section.fault(FRICTION, "must be a number in [0, 1]").help(help));
        }
        torque => torque.map_or(friction, |torque| torque.signed(friction, travel)),
    };
    let (contact, origin) = read_hertz(section, steel, friction, extent, report)?;
    let contact = match kind {
        ContactKind::Carter => Contact::Carter(CarterContact {
            peak_pressure: contact.peak_pressure,
            half_width: contact.half_width,
            friction,
            traction: section.get(TRACTION)?,
            travel,
        }),
        _ => Contact::Hertz(contact),
    };
    Some((contact, origin))
}

fn read_table(
    section: &SectionValues,
    travel: Travel,
    folder: &Path,
    report: &mut Report,
) -> Option<(Contact, ContactOrigin)> {
    let friction = section.get(FRICTION);
    if friction.is_some_and(|friction| friction < 0.0) {
        let help = "with a table, it is the upper limit of |q|/p";
        return report.refuse(section.fault(FRICTION, "must be a number in [0, 1]").help(help));
    }
    let reading = ContactReading { friction, lateral: section.get(STRIP), travel };
    let file = read_contact_table(section, CONTACT_PROFILE, reading, folder, report)?;
    let scaled = file.content().scaled(section.get(SCALE)?);
    let table = scaled.map_err(|error| report.add(section.fault(SCALE, error))).ok()?;
    let refusal = out_of_range(HALF_WIDTH, table.half_width())
        .or_else(|| out_of_range(PEAK_PRESSURE, table.peak_pressure()));
    if let Some(says) = refusal {
        return report
            .refuse(section.fault(CONTACT_PROFILE, says).help("u in mm, p and q in MPa, times scale"));
    }
    Some((Contact::Table(table), ContactOrigin::Table(file)))
}

/// The Hertzian contact in full sliding, from any of the forms that define its size.
fn read_hertz(
    section: &SectionValues,
    steel: &IsotropicElastic,
    friction: f64,
    extent: ContactExtent,
    report: &mut Report,
) -> Option<(HertzianContact, ContactOrigin)> {
    if let (Some(peak_pressure), Some(half_width)) = (section.get(PEAK_PRESSURE), section.get(HALF_WIDTH)) {
        let contact = HertzianContact { peak_pressure, half_width, friction };
        return read_given(section, contact, extent, report);
    }
    if section.get(WHEEL_LOAD).is_some() {
        return read_ellipse(section, steel, friction, extent, report);
    }
    let line_load = section.get(LINE_LOAD)?;
    refuse_lateral(section, report)?;
    let (wheel, rail) = (section.get(WHEEL_RADIUS)?, section.get(RAIL_RADIUS)?);
    let contact = HertzianContact::from_line_load(line_load, wheel, rail, steel, friction);
    let refusal = match &contact {
        Ok(contact) => out_of_range(PEAK_PRESSURE, contact.peak_pressure)
            .or_else(|| out_of_range(HALF_WIDTH, contact.half_width)),
        Err(error) => Some(error.to_string()),
    };
    if let Some(says) = refusal {
        let help = "line load and radii together define the peak pressure and the half-width";
        return report.refuse(section.fault(LINE_LOAD, says).help(help));
    }
    let radius = 1.0 / (1.0 / wheel + 1.0 / rail);
    Some((contact.ok()?, ContactOrigin::LineLoad { radius }))
}

/// Peak pressure and half-width as given: of a line contact, or of an ellipse with its strip.
fn read_given(
    section: &SectionValues,
    contact: HertzianContact,
    extent: ContactExtent,
    report: &mut Report,
) -> Option<(HertzianContact, ContactOrigin)> {
    let HertzianContact { peak_pressure, half_width, friction } = contact;
    let lateral = section.get(LATERAL).unwrap_or(0.0);
    let Some(across) = section.get(LATERAL_HALF_WIDTH) else {
        refuse_lateral(section, report)?;
        return Some((contact, ContactOrigin::Given));
    };
    let ellipse = HertzEllipse { peak_pressure, along: half_width, across };
    let strip = strip(section, &ellipse, extent.offset(lateral), friction, report)?;
    let lateral_friction = section.get(LATERAL_FRICTION).unwrap_or(0.0);
    Some((strip, ContactOrigin::GivenEllipse { ellipse, lateral, lateral_friction }))
}

/// A line contact is the same at all lateral positions.
fn refuse_lateral(section: &SectionValues, report: &mut Report) -> Option<()> {
    if section.entry(LATERAL).is_none() {
        return Some(());
    }
    let says = "is an offset within the contact ellipse, whose lateral semi-axis is missing";
    let help = "give lateral_half_width_mm, or wheel_load_kn with the radii of wheel and rail, or leave lateral_mm out";
    report.refuse(section.fault(LATERAL, says).help(help))
}

/// Parts of contact patches by which a case can load its cracks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PossibleExtent {
    /// Either, by default the whole patch.
    Any,
    /// Whole patches: cracks in space.
    Patch,
    /// Line contacts: the ends of a block cancel a field of the half-plane.
    Strip,
}

impl PossibleExtent {
    /// The part that `row` of `section` chooses; an error is added to `report` where it is not
    /// possible.
    pub(crate) fn chosen(
        self,
        section: &SectionValues,
        row: KeyRow<ContactExtent>,
        report: &mut Report,
    ) -> ContactExtent {
        let given = section.get(row);
        let refusal = match (self, given) {
            (Self::Patch, Some(ContactExtent::Strip)) => {
                Some(("cracks in space are loaded by whole patches", "leave it out, or use a plane engine"))
            }
            (Self::Strip, Some(ContactExtent::Patch)) => Some((
                "a block is loaded by line contacts",
                "leave it out, or use rail.boundary = \"half-plane\"",
            )),
            _ => None,
        };
        if let Some((says, help)) = refusal {
            report.add(section.fault(row, says).help(help));
        }
        match self {
            Self::Any => given.unwrap_or(ContactExtent::Patch),
            Self::Patch => ContactExtent::Patch,
            Self::Strip => ContactExtent::Strip,
        }
    }

    /// The part by which the contact of `section` loads the cracks: a wheel that feels the cracks
    /// is a line contact.
    pub(crate) fn of_contact(self, section: &SectionValues, report: &mut Report) -> ContactExtent {
        let chosen = self.chosen(section, LATERAL_EXTENT, report);
        if section.get(COUPLED) == Some(true) { ContactExtent::Strip } else { chosen }
    }
}

impl ContactExtent {
    /// The offset of the strip that represents the contact.
    fn offset(self, lateral: f64) -> f64 {
        match self {
            Self::Strip => lateral,
            Self::Patch => 0.0,
        }
    }
}

/// The strip of an ellipse that the plane engines use.
fn strip(
    section: &SectionValues,
    ellipse: &HertzEllipse,
    lateral: f64,
    friction: f64,
    report: &mut Report,
) -> Option<HertzianContact> {
    ellipse
        .strip(lateral, friction)
        .map_err(|_| {
            let across = ellipse.across;
            let says = format!("is outside the contact, which reaches {across:.3} mm to either side");
            report.add(section.fault(LATERAL, says).help("choose a strip within the ellipse"));
        })
        .ok()
}

fn read_ellipse(
    section: &SectionValues,
    steel: &IsotropicElastic,
    friction: f64,
    extent: ContactExtent,
    report: &mut Report,
) -> Option<(HertzianContact, ContactOrigin)> {
    let wheel = WheelOnRail {
        wheel_load: 1e3 * section.get(WHEEL_LOAD)?,
        wheel_radius: section.get(WHEEL_RADIUS)?,
        rail_head_radius: section.get(RAIL_HEAD_RADIUS)?,
        wheel_profile_radius: section.get(WHEEL_PROFILE_RADIUS)?,
    };
    let lateral = section.get(LATERAL).unwrap_or(0.0);
    let ellipse = HertzEllipse::new(&wheel, steel)
        .map_err(|error| report.add(section.fault(WHEEL_PROFILE_RADIUS, error)))
        .ok()?;
    let contact = strip(section, &ellipse, extent.offset(lateral), friction, report)?;
    let refusal = out_of_range(PEAK_PRESSURE, contact.peak_pressure)
        .or_else(|| out_of_range(HALF_WIDTH, contact.half_width));
    if let Some(says) = refusal {
        let help = "wheel load and radii together define the ellipse, and lateral_mm its place";
        return report.refuse(section.fault(WHEEL_LOAD, says).help(help));
    }
    let lateral_friction = section.get(LATERAL_FRICTION).unwrap_or(0.0);
    Some((contact, ContactOrigin::Ellipse { wheel, ellipse, lateral, lateral_friction }))
}

/// Reason why a derived value is outside the range of its key.
pub(super) fn out_of_range(row: KeyRow<f64>, value: f64) -> Option<String> {
    match row.key.kind {
        Kind::Number { range, .. } if !range.contains(value) => {
            Some(format!("gives {} = {value:.4}, which must be in {range}", row.key.name))
        }
        _ => None,
    }
}
