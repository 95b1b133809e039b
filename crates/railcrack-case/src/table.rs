//! How the case file is declared: sections, keys, kinds and ranges.

/// A section of the case file, `[name]` or `[[name]]`; the keys before the first section have the name "".
#[derive(Debug, Clone, Copy)]
pub struct Section {
    /// Its name in the file.
    pub name: &'static str,
    /// One sentence.
    pub doc: &'static str,
    /// Whether it must, may or can be written several times.
    pub presence: SectionPresence,
    /// Its keys in the order in which they are written.
    pub keys: &'static [Key],
    /// Ways of saying the same thing, of which exactly one is chosen; empty where there is only one.
    pub forms: &'static [Form],
}

/// How often a section is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SectionPresence {
    /// Once; without it every key has its default.
    Defaulted,
    /// Once, or what it describes does not exist.
    Optional,
    /// Exactly once.
    Required,
    /// At least once, as `[[name]]`.
    Repeated,
}

/// One of several ways of saying the same thing. Those of its keys that have no default must all be given.
#[derive(Debug, Clone, Copy)]
pub struct Form {
    /// Names of its keys.
    pub keys: &'static [&'static str],
}

/// A key of a section.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// Its name in the file, with the unit.
    pub name: &'static str,
    /// What it holds.
    pub kind: Kind,
    /// Whether it must be given.
    pub presence: Presence,
    /// One sentence.
    pub doc: &'static str,
    /// The choice of another key without which this one means nothing.
    pub only_with: Option<OnlyWith>,
    /// What the first file of `railcrack init` says, where that is not the default.
    pub reference: Option<Preset>,
}

/// A choice of another key of the same section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OnlyWith {
    /// The other key.
    pub key: &'static str,
    /// Its value.
    pub choice: &'static str,
}

/// Whether a key must be given, with its default or an example.
#[derive(Debug, Clone, Copy)]
pub enum Presence {
    /// Need not be given: this is its default.
    Default(Preset),
    /// Need not be given: without it, what it describes does not exist. An example.
    Optional(Preset),
    /// Must be given (where its form is chosen). The value of the reference case.
    Required(Preset),
}

impl Presence {
    /// The default or the example.
    pub fn preset(self) -> Preset {
        match self {
            Self::Default(preset) | Self::Optional(preset) | Self::Required(preset) => preset,
        }
    }
}

/// A value of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Preset {
    /// A number.
    Number(f64),
    /// An integer.
    Integer(u64),
    /// Text, a choice or a path.
    Text(&'static str),
    /// Numbers.
    Numbers(&'static [f64]),
    /// Points (x, y), mm.
    Points(&'static [[f64; 2]]),
    /// Groups of keys.
    Groups(&'static [&'static [&'static str]]),
}

/// What a key holds and accepts.
#[derive(Debug, Clone, Copy)]
pub enum Kind {
    /// A number, integers included.
    Number {
        /// Its unit; empty for a pure number.
        unit: &'static str,
        /// What is accepted.
        range: NumberRange,
    },
    /// An integer, ends included.
    Integer {
        /// The smallest accepted.
        min: u64,
        /// The largest accepted.
        max: u64,
    },
    /// One line of text.
    Text,
    /// One of several words.
    Choice(&'static [Choice]),
    /// A file, relative to the case file.
    Path,
    /// Numbers `[x, …]`, any count up to [`Kind::MOST_NUMBERS`].
    Numbers {
        /// Their unit.
        unit: &'static str,
        /// What is accepted of each.
        range: NumberRange,
    },
    /// Points `[[x, y], …]` in mm.
    Points,
    /// Groups of keys, `[["section.key", "section.key"], …]`.
    Groups,
}

/// One word of a [`Kind::Choice`].
#[derive(Debug, Clone, Copy)]
pub struct Choice {
    /// The word.
    pub name: &'static str,
    /// What it chooses.
    pub doc: &'static str,
    /// Whether this version has it.
    pub availability: Availability,
}

/// Whether this version has a section or a choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Availability {
    /// It has.
    Now,
    /// The name is reserved and refused.
    Later {
        /// What is not part of this version, a sentence.
        reason: &'static str,
        /// What to write instead.
        instead: &'static str,
    },
}

/// One end of a range of numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RangeEnd {
    /// The number itself is accepted.
    Closed(f64),
    /// The number itself is not accepted.
    Open(f64),
}

/// A range of numbers. NaN is never in it, an infinity only where an end says so.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NumberRange {
    /// Lower end.
    pub min: RangeEnd,
    /// Upper end.
    pub max: RangeEnd,
}

impl NumberRange {
    /// \[min, max\].
    pub const fn closed(min: f64, max: f64) -> Self {
        Self { min: RangeEnd::Closed(min), max: RangeEnd::Closed(max) }
    }

    /// (0, max\].
    pub const fn positive(max: f64) -> Self {
        Self { min: RangeEnd::Open(0.0), max: RangeEnd::Closed(max) }
    }

    /// Whether `value` is accepted.
    pub fn contains(&self, value: f64) -> bool {
        let above = match self.min {
            RangeEnd::Closed(min) => value >= min,
            RangeEnd::Open(min) => value > min,
        };
        let below = match self.max {
            RangeEnd::Closed(max) => value <= max,
            RangeEnd::Open(max) => value < max,
        };
        above && below
    }
}

impl std::fmt::Display for NumberRange {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self.min {
            RangeEnd::Closed(min) => write!(f, "[{}", short(min))?,
            RangeEnd::Open(min) => write!(f, "({}", short(min))?,
        }
        match self.max {
            RangeEnd::Closed(max) => write!(f, ", {}]", short(max)),
            RangeEnd::Open(max) => write!(f, ", {})", short(max)),
        }
    }
}

/// A number as people write it: exponents only for the very large and the very small.
pub(super) fn short(value: f64) -> String {
    let size = value.abs();
    if size.is_finite() && size != 0.0 && !(1e-3..1e5).contains(&size) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

impl Kind {
    /// The longest list of numbers.
    pub const MOST_NUMBERS: usize = 100;

    /// What is accepted, to follow "must be".
    pub fn accepted(&self) -> String {
        match self {
            Self::Number { unit: "", range } => format!("a number in {range}"),
            Self::Number { unit, range } => format!("a number in {range} {unit}"),
            Self::Integer { min, max } => format!("an integer from {min} to {max}"),
            Self::Text => "one line of text of at most 200 characters".into(),
            Self::Choice(choices) => {
                let names: Vec<String> = available(choices).map(|c| format!("\"{}\"", c.name)).collect();
                names.join(" or ")
            }
            Self::Path => "the name of a file".into(),
            Self::Numbers { unit, range } => {
                format!("a list of at most {} numbers in {range} {unit}", Self::MOST_NUMBERS)
            }
            Self::Points => "a list of at least two points [x, y] in mm".into(),
            Self::Groups => "a list of groups, each a list of at least two keys".into(),
        }
    }
}

/// The choices that this version has.
pub(super) fn available(choices: &'static [Choice]) -> impl Iterator<Item = &'static Choice> {
    choices.iter().filter(|c| c.availability == Availability::Now)
}

impl Section {
    /// The key called `name`.
    pub fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|k| k.name == name)
    }

    /// The header as written: `[rail]`, `[[crack]]`; empty for the keys before the first section.
    pub fn header(&self) -> String {
        match (self.name, self.presence) {
            ("", _) => String::new(),
            (name, SectionPresence::Repeated) => format!("[[{name}]]"),
            (name, _) => format!("[{name}]"),
        }
    }

    /// Whether `key` can be given in this version.
    pub fn offers(&self, key: &Key) -> bool {
        let Some(with) = key.only_with else { return true };
        match self.key(with.key).map(|k| k.kind) {
            Some(Kind::Choice(choices)) => available(choices).any(|c| c.name == with.choice),
            _ => true,
        }
    }
}
