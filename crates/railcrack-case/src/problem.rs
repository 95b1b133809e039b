//! Sections that say what is computed: rail, wheel, cracks, stress.

use super::declare::{
    FROM_ZERO_BELOW_HALF, choice, closed, integer, key, later, length, now, number, positive, required,
    support,
};
use super::table::{
    Availability, Form, Key, Kind, NumberRange, Presence, Preset, RangeEnd, Section, SectionPresence,
};
use Preset::{Number, Points, Text};

pub(super) const TOP: Section = Section {
    name: "",
    doc: "The case.",
    presence: SectionPresence::Defaulted,
    keys: &[Key {
        reference: Some(Text("Reference case, Table 1")),
        ..key("title", Kind::Text, Presence::Default(Text("Untitled")), "Heading of plots and reports.")
    }],
    forms: &[],
};

pub(super) const RAIL: Section = Section {
    name: "rail",
    doc: "The rail: linear elastic steel in plane strain below the running surface y = 0.",
    presence: SectionPresence::Defaulted,
    keys: &[
        number("young_modulus_mpa", "MPa", closed(1.0, 1e7), 210e3, "Young's modulus of rail and wheel."),
        number("poisson_ratio", "", FROM_ZERO_BELOW_HALF, 0.3, "Poisson's ratio of rail and wheel."),
        number(
            "width_mm",
            "mm",
            positive(1e5),
            300.0,
            "Length of rail along x that the cracks may not leave.",
        ),
        number("depth_mm", "mm", positive(1e5), 172.0, "Depth that the cracks may not leave."),
        key(
            "centre_mm",
            length(closed(-1e6, 1e6)),
            Presence::Optional(Number(0.0)),
            "Middle of that length; without it, the middle of the crack mouths.",
        ),
        choice(
            "boundary",
            &[
                now("half-plane", "no boundary but the running surface"),
                now("block", "a block of width_mm times depth_mm on supports; finite-element engine only"),
            ],
            "half-plane",
            "What the rail ends at.",
        ),
        support(
            "bottom",
            &[
                now("clamped", "no displacement"),
                now("rollers", "no vertical displacement, one point held along x"),
            ],
            "clamped",
            "Support of the bottom of a block.",
        ),
        support(
            "sides",
            &[
                now("free", "no traction"),
                now("rollers", "no horizontal displacement"),
                now("clamped", "no displacement"),
            ],
            "free",
            "Support of the sides of a block.",
        ),
    ],
    forms: &[],
};

pub(super) const CONTACT: Section = Section {
    name: "contact",
    doc: "Wheel on rail: fully sliding line contact; one passage is one axle.",
    presence: SectionPresence::Required,
    keys: &[
        choice(
            "kind",
            &[
                now("hertz", "pressure p0 sqrt(1 - (x - xc)^2 / a^2) and a shear proportional to it"),
                later(
                    "table",
                    "measured pressure and shear",
                    Availability::Later {
                        reason: "measured contact tables are not part of this version",
                        instead: "describe the contact with kind = \"hertz\"",
                    },
                ),
            ],
            "hertz",
            "How the contact is described.",
        ),
        required("peak_pressure_mpa", "MPa", positive(1e4), Number(845.0), "Peak pressure p0."),
        required("half_width_mm", "mm", positive(100.0), Number(6.75), "Half width a of the contact."),
        required("line_load_n_per_mm", "N/mm", positive(1e7), Number(8959.4), "Wheel load per width."),
        required("wheel_radius_mm", "mm", positive(1e5), Number(460.9), "Radius of the wheel."),
        number(
            "rail_radius_mm",
            "mm",
            positive(f64::INFINITY),
            f64::INFINITY,
            "Radius of the rail in the plane of the model; inf is flat.",
        ),
        required(
            "friction",
            "",
            closed(-1.0, 1.0),
            Number(0.025),
            "Wheel-rail friction coefficient; > 0 drags the rail along +x (a braking wheel running towards +x).",
        ),
    ],
    forms: &[
        Form { keys: &["peak_pressure_mpa", "half_width_mm"] },
        Form { keys: &["line_load_n_per_mm", "wheel_radius_mm", "rail_radius_mm"] },
    ],
};

pub(super) const PASSAGE: Section = Section {
    name: "passage",
    doc: "The way of the wheel; from > to is a wheel that runs towards -x, and the two mouths change places.",
    presence: SectionPresence::Defaulted,
    keys: &[
        number(
            "from_over_a",
            "a",
            closed(-1e3, 1e3),
            -6.0,
            "First position of the contact's middle, measured from the first mouth that the wheel meets.",
        ),
        number(
            "to_over_a",
            "a",
            closed(-1e3, 1e3),
            6.0,
            "Last position, measured from the last mouth that the wheel meets.",
        ),
        integer("positions", 2, 100_000, 241, "Output positions, evenly spaced."),
        integer("max_passages", 1, 1000, 5, "Most passages on a fixed crack until the history repeats."),
        number(
            "passage_tolerance",
            "",
            closed(1e-9, 0.1),
            1e-3,
            "Change of K between two passages, relative to its peak, below which the history repeats.",
        ),
        number(
            "step_tolerance",
            "",
            closed(1e-6, 0.1),
            2e-3,
            "Substeps are refined until K changes by less, relative to its peak.",
        ),
        choice(
            "step_control",
            &[
                now(
                    "adaptive",
                    "events between positions are met in their order, steps are cut by step_tolerance where the load bends",
                ),
                now(
                    "fixed",
                    "one step from output position to output position, as in a code without control",
                ),
            ],
            "adaptive",
            "How load steps are chosen.",
        ),
    ],
    forms: &[],
};

pub(super) const CRACK: Section = Section {
    name: "crack",
    doc: "A crack, or a row of equal ones; write it once for each.",
    presence: SectionPresence::Repeated,
    keys: &[
        required("mouth_mm", "mm", closed(-1e6, 1e6), Number(0.0), "Abscissa of the mouth at the surface."),
        required("length_mm", "mm", closed(1e-3, 1e4), Number(6.0), "Length of a straight crack."),
        required(
            "angle_deg",
            "degrees",
            NumberRange { min: RangeEnd::Open(0.0), max: RangeEnd::Open(180.0) },
            Number(15.0),
            "Angle below the surface, from +x.",
        ),
        key(
            "points_mm",
            Kind::Points,
            Presence::Required(Points(&[[0.0, 0.0], [4.0, -1.0], [6.0, -1.2]])),
            "A polyline; first point on the surface (y = 0), or below it for a buried crack with two tips.",
        ),
        required("friction", "", closed(0.0, 2.0), Number(0.5), "Friction coefficient of the crack faces."),
        integer("count", 1, 100, 1, "Number of equal cracks, copies to the right included."),
        key(
            "spacing_mm",
            length(positive(1e4)),
            Presence::Optional(Number(3.375)),
            "Distance from one copy to the next; needed when count > 1.",
        ),
    ],
    forms: &[Form { keys: &["mouth_mm", "length_mm", "angle_deg"] }, Form { keys: &["points_mm"] }],
};

pub(super) const RESIDUAL_STRESS: Section = Section {
    name: "residual_stress",
    doc: "A balanced residual stress that depends on depth; it adds to the wheel.",
    presence: SectionPresence::Optional,
    keys: &[key(
        "profile",
        Kind::Path,
        Presence::Required(Text("profile.csv")),
        "CSV read by header, depth_mm,sxx_mpa[,szz_mpa]: linear between rows, zero beyond the last.",
    )],
    forms: &[],
};

pub(super) const PLASTIC_STRESS: Section = Section {
    name: "plastic_stress",
    doc: "A plastic stress K:eps_p = 2 G eps_p that is still to be balanced on the crack mesh. With neither key, that of the \
          stabilised state of [shakedown], which the run computes first.",
    presence: SectionPresence::Optional,
    keys: &[
        key(
            "field",
            Kind::Path,
            Presence::Optional(Text("shakedown/plastic.vtu")),
            "VTU with plastic_stress_mpa on points or cells: written by `railcrack shakedown`, or by any other program.",
        ),
        key(
            "profile",
            Kind::Path,
            Presence::Optional(Text("plastic.csv")),
            "CSV as that of [residual_stress], read as a plastic stress.",
        ),
    ],
    forms: &[Form { keys: &["field"] }, Form { keys: &["profile"] }],
};
