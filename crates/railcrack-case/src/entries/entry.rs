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
            Self::LawRate { .. } => "mm/cycle",
            Self::DepthRateRatio { .. } | Self::LawExponent => "",
        }
    }

    /// Whether a run is needed for it.
    #[must_use]
    pub fn needs_a_run(self) -> bool {
        matches!(self, Self::DepthRate { .. } | Self::DepthRateRatio { .. })
    }
}

/// How the model is compared with an entry.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The computed quantity.
    pub quantity: Quantity,
    /// The file of the conditions as the entry names it.
    pub study: String,
    /// The measured value is between these with 95 %.
    pub measured: (f64, f64),
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
