//! Sections that say how it is computed and how cracks grow.

use super::declare::{choice, closed, integer, key, length, now, number, positive};
use super::table::{Kind, Presence, Preset, Section, SectionPresence};
use Preset::{Integer, Number, Numbers, Text};

pub(super) const SHAKEDOWN: Section = Section {
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
                now(
                    "direct",
                    "upstream := downstream in every iteration: cheaper, and another admissible state",
                ),
            ],
            "pass-by-pass",
            "Way to the stabilised state.",
        ),
        integer("max_passes", 1, 100_000, 500, "Passages after which the rail counts as not stabilised."),
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
};

pub(super) const GROWTH: Section = Section {
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
                now(
                    "max-rate-unclipped",
                    "the same, negative k1 counted as if a closed kink opened negatively",
                ),
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
};

pub(super) const MESH: Section = Section {
    name: "mesh",
    doc: "Discretisation.",
    presence: SectionPresence::Defaulted,
    keys: &[
        key(
            "element_size_mm",
            length(positive(100.0)),
            Presence::Optional(Number(0.1)),
            "Element size at the cracks in the finite-element engine; without it, at each crack a sixtieth of the longest one \
             (a thirtieth where there are more than three), or a thirtieth of the crack or a seventh of the segment at its \
             tip if that is less. Without effect on the dislocation engine.",
        ),
        key(
            "tip_enrichment_radius_mm",
            length(positive(100.0)),
            Presence::Optional(Number(0.5)),
            "Radius around a tip within which nodes carry its square-root functions; without it, two and a half elements.",
        ),
        key(
            "interface_spacing_mm",
            length(positive(100.0)),
            Presence::Optional(Number(0.2)),
            "Largest distance between face points in the finite-element engine; without it, the length of crack in an element.",
        ),
        key(
            "interface_elements",
            Kind::Integer { min: 8, max: 400 },
            Presence::Optional(Integer(48)),
            "Elements along each crack in the dislocation engine, before its grading towards mouth and kinks; without \
             it 48, and 180 shared by all cracks, but at least 28 each, where there are more than three.",
        ),
    ],
    forms: &[],
};

pub(super) const SOLVER: Section = Section {
    name: "solver",
    doc: "Solvers.",
    presence: SectionPresence::Defaulted,
    keys: &[
        choice(
            "engine",
            &[
                now("xfem", "extended finite elements"),
                now("dislocation", "distributed dislocations in a half-plane"),
            ],
            "xfem",
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
};

pub(super) const TRAFFIC: Section = Section {
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
};

pub(super) const OUTPUT: Section = Section {
    name: "output",
    doc: "Fields of displacement and stress around the cracks, by the finite-element engine.",
    presence: SectionPresence::Defaulted,
    keys: &[
        key(
            "fields_over_a",
            Kind::Numbers { unit: "a", range: closed(-1e3, 1e3) },
            Presence::Default(Numbers(&[-1.0, 0.0, 1.0])),
            "Wheel positions, from the mouth of the first crack: of each, the nearest output position.",
        ),
        integer(
            "fields_every",
            0,
            10_000,
            25,
            "Every how many growth steps, step 0 the first; 0 writes none.",
        ),
    ],
    forms: &[],
};
