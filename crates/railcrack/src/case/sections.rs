//! Every section and key of the case file, once.

use super::declare::{
    FROM_ZERO_BELOW_HALF, choice, closed, integer, key, later, length, now, number, positive, required,
    support,
};
use super::table::{
    Availability, Form, Key, Kind, NumberRange, Presence, Preset, RangeEnd, Section, SectionPresence,
};
use Preset::{Number, Points, Text};

/// The case file, in the order in which it is written.
pub const SECTIONS: &[Section] = &[
    TOP,
    RAIL,
    CONTACT,
    PASSAGE,
    CRACK,
    RESIDUAL_STRESS,
    PLASTIC_STRESS,
    SHAKEDOWN,
    GROWTH,
    MESH,
    SOLVER,
    TRAFFIC,
];

const FINITE_ELEMENTS: Availability = Availability::Later {
    reason: "the finite-element engine is not part of this version",
    instead: "the engine of this version is \"dislocation\"",
};

const TOP: Section = Section {
    name: "",
    doc: "The case.",
    presence: SectionPresence::Defaulted,
    keys: &[Key {
        reference: Some(Text("Reference case, Table 1")),
        ..key("title", Kind::Text, Presence::Default(Text("Untitled")), "Heading of plots and reports.")
    }],
    forms: &[],
    availability: Availability::Now,
};

const RAIL: Section = Section {
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
                later("block", "a block of width_mm times depth_mm on supports", FINITE_ELEMENTS),
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
    availability: Availability::Now,
};

const CONTACT: Section = Section {
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
    availability: Availability::Now,
};

const PASSAGE: Section = Section {
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
    ],
    forms: &[],
    availability: Availability::Now,
};

const CRACK: Section = Section {
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
    availability: Availability::Now,
};

const RESIDUAL_STRESS: Section = Section {
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
    availability: Availability::Now,
};

const PLASTIC_STRESS: Section = Section {
    name: "plastic_stress",
    doc: "A plastic stress K:eps_p that is still to be balanced on the crack mesh.",
    presence: SectionPresence::Optional,
    keys: &[key(
        "field",
        Kind::Path,
        Presence::Required(Text("shakedown/plastic.vtu")),
        "VTU file with the plastic stress.",
    )],
    forms: &[],
    availability: Availability::Later {
        reason: "projecting a plastic stress is not part of this version",
        instead: "give a balanced stress in [residual_stress] instead",
    },
};

const SHAKEDOWN: Section = Section {
    name: "shakedown",
    doc: "Plastic behaviour of the rail under the repeated passage, and the Dang Van criterion.",
    presence: SectionPresence::Defaulted,
    keys: &[
        number(
            "yield_stress_mpa",
            "MPa",
            positive(1e4),
            500.0,
            "Yield stress in tension; k is it over sqrt(3).",
        ),
        number(
            "hardening_modulus_mpa",
            "MPa",
            positive(1e7),
            20e3,
            "Modulus C of the linear kinematic hardening X = (2/3) C eps_p.",
        ),
        choice(
            "method",
            &[
                now("pass-by-pass", "each passage starts from the state the one before left"),
                now("direct", "the stabilised state in one iteration"),
            ],
            "pass-by-pass",
            "Way to the stabilised state.",
        ),
        key(
            "initial_residual",
            Kind::Path,
            Presence::Optional(Text("manufacturing.csv")),
            "Balanced profile present before the first passage, as [residual_stress] profile.",
        ),
        number("dang_van_a", "", closed(0.0, 10.0), 0.3, "Slope of the Dang Van criterion."),
        number(
            "dang_van_b_mpa",
            "MPa",
            positive(1e4),
            250.0,
            "Fatigue limit in pure shear of the criterion.",
        ),
    ],
    forms: &[],
    availability: Availability::Now,
};

const GROWTH: Section = Section {
    name: "growth",
    doc: "Growth: da/dN = C dKeq^m, dKeq^2 = dKI^2 + w dKII^2.",
    presence: SectionPresence::Defaulted,
    keys: &[
        integer("steps", 0, 10_000, 25, "Number of increments; 0 computes the initial cracks only."),
        number(
            "increment",
            "",
            positive(0.5),
            0.04,
            "Increment of the fastest tip, as a fraction of its crack's length.",
        ),
        number("paris_c", "mm/cycle, MPa sqrt(m)", positive(1.0), 2e-9, "C of the law."),
        number("paris_m", "", positive(20.0), 3.33, "m of the law."),
        number("mode_2_weight", "", closed(0.0, 100.0), 0.772, "w, weight of mode II."),
        number(
            "threshold_mpa_sqrt_m",
            "MPa sqrt(m)",
            closed(0.0, 1e3),
            0.0,
            "At or below this dKeq nothing grows.",
        ),
        number(
            "arrest_rate_mm_per_cycle",
            "mm/cycle",
            closed(0.0, 1.0),
            1e-9,
            "A tip slower than this is arrested.",
        ),
        choice(
            "direction",
            &[
                now("max-rate", "the largest growth rate of the kink (Hourlier-Pineau)"),
                now("max-delta-k1", "the largest range of k1"),
                now("max-k1", "the largest k1"),
            ],
            "max-rate",
            "What the direction of growth maximises.",
        ),
        key(
            "critical_length_mm",
            length(positive(1e5)),
            Presence::Optional(Number(20.0)),
            "A crack this long ends the run.",
        ),
        key(
            "stop_after_cycles",
            Kind::Number { unit: "cycles", range: positive(1e18) },
            Presence::Optional(Number(1e7)),
            "This many load cycles end the run.",
        ),
    ],
    forms: &[],
    availability: Availability::Now,
};

const MESH: Section = Section {
    name: "mesh",
    doc: "Discretisation.",
    presence: SectionPresence::Defaulted,
    keys: &[
        number(
            "element_size_mm",
            "mm",
            positive(100.0),
            0.1,
            "Element size near the cracks in a finite-element engine; without effect on the dislocation engine.",
        ),
        integer("interface_elements", 8, 400, 40, "Elements along each crack in the dislocation engine."),
    ],
    forms: &[],
    availability: Availability::Now,
};

const SOLVER: Section = Section {
    name: "solver",
    doc: "Solvers.",
    presence: SectionPresence::Defaulted,
    keys: &[
        choice(
            "engine",
            &[
                now("dislocation", "distributed dislocations in a half-plane"),
                later("xfem", "extended finite elements", FINITE_ELEMENTS),
            ],
            "dislocation",
            "What computes the cracked rail.",
        ),
        choice(
            "contact",
            &[
                now("newton", "active sets, exact complementarity"),
                now("latin", "the LATIN method of the paper"),
            ],
            "newton",
            "What solves the contact of the crack faces.",
        ),
    ],
    forms: &[],
    availability: Availability::Now,
};

const TRAFFIC: Section = Section {
    name: "traffic",
    doc: "Traffic: with it, cycles are also given in million gross tonnes.",
    presence: SectionPresence::Optional,
    keys: &[key(
        "axle_load_t",
        Kind::Number { unit: "t", range: positive(100.0) },
        Presence::Required(Number(17.0)),
        "Load of one axle; one passage is one axle.",
    )],
    forms: &[],
    availability: Availability::Now,
};
