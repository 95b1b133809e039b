//! An entry as read.

/// The subject of an entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Grade {
    /// Rails in service.
    Track,
    /// Rigs.
    Rig,
    /// Growth under known K.
    Law,
    /// Strength, toughness, sections.
    Material,
    /// Inspection.
    Inspection,
    /// Frictions.
    Friction,
}

impl Grade {
    /// Its word in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        <Self as railcrack::words::Choice>::word(self)
    }

    /// Whether the model can be compared with it.
    #[must_use]
    pub fn is_compared(self) -> bool {
        matches!(self, Self::Track | Self::Rig | Self::Law)
    }
}

/// How a number was read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HowRead {
    /// From the source itself.
    FullText,
    /// From its abstract.
    Abstract,
    /// From a text that quotes it.
    Secondary,
    /// From memory.
    Memory,
}

impl HowRead {
    /// Its word in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        <Self as railcrack::words::Choice>::word(self)
    }
}

/// The words of the computed quantities.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum QuantityKind {
    DepthRate,
    DepthRateRatio,
    DepthPerCycle,
    LifeRatio,
    LawRate,
    LawExponent,
}

/// A computed quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// Mean growth in depth between two depths (mm), mm per million gross tonnes.
    DepthRate {
        /// The first depth.
        from: f64,
        /// The second one.
        to: f64,
    },
    /// The same between two depths over that between two others (mm).
    DepthRateRatio {
        /// First and second depth of the numerator.
        depths: (f64, f64),
        /// Those of the denominator.
        over: (f64, f64),
    },
    /// Mean growth in depth between two depths (mm), mm per load cycle.
    DepthPerCycle {
        /// The first depth.
        from: f64,
        /// The second one.
        to: f64,
    },
    /// Load cycles between two depths (mm) over those under other conditions.
    LifeRatio {
        /// The first depth.
        from: f64,
        /// The second one.
        to: f64,
    },
    /// da/dN of the growth law, mm per cycle.
    LawRate {
        /// Range of K_I, MPa√m.
        delta_k: f64,
        /// R.
        ratio: f64,
    },
    /// Exponent of the growth law.
    LawExponent,
}

impl Quantity {
    /// Its unit; empty for a pure number.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::DepthRate { .. } => "mm/MGT",
            Self::DepthPerCycle { .. } | Self::LawRate { .. } => "mm/cycle",
            Self::DepthRateRatio { .. } | Self::LifeRatio { .. } | Self::LawExponent => "",
        }
    }

    /// Whether a run is needed for it.
    #[must_use]
    pub fn needs_a_run(self) -> bool {
        !matches!(self, Self::LawRate { .. } | Self::LawExponent)
    }
}

/// How the model is compared with an entry.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The computed quantity.
    pub quantity: Quantity,
    /// The file of the conditions as the entry names it.
    pub study: String,
    /// The file of the conditions whose life is the denominator of a ratio.
    pub over_study: Option<String>,
    /// The file of the same conditions in space, whose prediction is scored apart.
    pub study_in_space: Option<String>,
    /// The measured value is between these with 95 %.
    pub measured: (f64, f64),
    /// Standard deviation of the logarithm of the quantity from place to place.
    pub place_log_std: Option<f64>,
}

impl Comparison {
    /// The files of all conditions that it names.
    pub fn studies(&self) -> impl Iterator<Item = &String> {
        [Some(&self.study), self.over_study.as_ref(), self.study_in_space.as_ref()].into_iter().flatten()
    }
}

/// One of the numbers of an entry.
#[derive(Debug, Clone, PartialEq)]
pub struct EntryValue {
    /// Name with unit.
    pub name: String,
    /// The number, the ends of a range, or a statement.
    pub value: String,
}

/// A measured number.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Its name.
    pub id: String,
    /// Its subject.
    pub grade: Grade,
    /// The measured quantity in words.
    pub quantity: String,
    /// Under which conditions.
    pub conditions: String,
    /// Where it is published.
    pub source: String,
    /// How it was read.
    pub read: HowRead,
    /// 1 to 3.
    pub certainty: usize,
    /// The words that give it.
    pub quote: Option<String>,
    /// Caveats.
    pub note: Option<String>,
    /// Its numbers.
    pub values: Vec<EntryValue>,
    /// How it is compared.
    pub comparison: Option<Comparison>,
}

impl Entry {
    /// Whether it counts in a score: read, and compared.
    #[must_use]
    pub fn is_scored(&self) -> bool {
        self.comparison.is_some() && self.read != HowRead::Memory && self.certainty > 1
    }
}
