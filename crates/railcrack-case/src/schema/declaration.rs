//! Declaration of a file: sections, keys, kinds and ranges.

use railcrack::words::Word;

/// A kind of file: its sections, and the sentences that only its readers need.
#[derive(Debug)]
pub struct FileSchema {
    /// Title of its JSON Schema.
    pub title: &'static str,
    /// Its sections, in the order in which they are written.
    pub sections: &'static [Section],
    /// Sections of other kinds of file, which the reader of this one ignores.
    pub beside: &'static [Section],
    /// Beginning of its page of documentation.
    pub introduction: &'static str,
    /// Comment at the top of its first file.
    pub preamble: &'static str,
    /// Help where a section is missing.
    pub start: &'static str,
    /// Help where a list is given instead of a value.
    pub list: &'static str,
}

/// A section, `[name]` or `[[name]]`; the keys before the first section have the name "".
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
    /// Alternative forms, exactly one of which is chosen; empty where there is only one.
    pub forms: &'static [Form],
    /// Sections within this one, named with it: `outer.inner`.
    pub parts: &'static [Section],
    /// The section that may replace it; of a section within another one, the key.
    pub instead: Option<&'static str>,
    /// The choice that `false` in the position of the section stands for.
    pub off: Option<Off>,
}

/// A choice for which a section within another one may be replaced by `false`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Off {
    /// The key.
    pub key: &'static str,
    /// Its value.
    pub choice: &'static str,
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
    /// As `[[name]]`, or not at all.
    Several,
}

/// One of several alternative forms. All of its keys without a default must be given.
#[derive(Debug, Clone, Copy)]
pub struct Form {
    /// Names of its keys.
    pub keys: &'static [&'static str],
    /// Names of keys of other forms that may be given with it.
    pub also: &'static [&'static str],
}

impl Form {
    /// Whether the key `name` goes with it.
    #[must_use]
    pub fn admits(&self, name: &str) -> bool {
        self.keys.contains(&name) || self.also.contains(&name)
    }
}

/// A key of a section.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// Its name in the file, with the unit.
    pub name: &'static str,
    /// Type, unit and range of its values.
    pub kind: Kind,
    /// Whether it must be given.
    pub presence: Presence,
    /// One sentence.
    pub doc: &'static str,
    /// The choice of another key without which this one means nothing.
    pub only_with: Option<OnlyWith>,
    /// The choice of another key with which this one, otherwise required, need not be given.
    pub excused: Option<OnlyWith>,
    /// The other key of the same section that must be given with this one.
    pub pair: Option<Pair>,
    /// The value in the first file of a user, where it is not the default.
    pub reference: Option<Preset>,
}

/// A choice of another key of the same section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OnlyWith {
    /// The other key.
    pub key: &'static str,
    /// Its value.
    pub choice: &'static str,
    /// Other accepted values.
    pub also: &'static [&'static str],
    /// Why the key means nothing with the other values; help, followed by what to do.
    pub otherwise: &'static str,
}

impl OnlyWith {
    /// Whether `word` is such a choice.
    #[must_use]
    pub fn admits(&self, word: &str) -> bool {
        self.choice == word || self.also.contains(&word)
    }

    /// The choices, each in quotes: `kind = "hertz" or "carter"`.
    #[must_use]
    pub fn shown(&self) -> String {
        let words: Vec<String> =
            std::iter::once(&self.choice).chain(self.also).map(|word| format!("\"{word}\"")).collect();
        format!("{} = {}", self.key, words.join(" or "))
    }
}

/// An integer key of the same section that is given with this one: above its default it needs this
/// key, and this key needs it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pair {
    /// The integer key.
    pub key: &'static str,
    /// How the two keys are related; help where one of them is missing.
    pub help: &'static str,
}

/// Whether a key must be given, with its default or an example.
#[derive(Debug, Clone, Copy)]
pub enum Presence {
    /// Need not be given: this is its default.
    Default(Preset),
    /// Need not be given: without it, what it describes does not exist. An example.
    Optional(Preset),
    /// Must be given (where its form is chosen). The value in the first file of a user.
    Required(Preset),
}

impl Presence {
    /// The default or the example.
    #[must_use]
    pub const fn preset(self) -> Preset {
        match self {
            Self::Default(preset) | Self::Optional(preset) | Self::Required(preset) => preset,
        }
    }
}

/// A value in a declaration.
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
    /// Points (x, y).
    Points(&'static [[f64; 2]]),
    /// Groups of keys.
    Groups(&'static [&'static [&'static str]]),
    /// Yes or no.
    Switch(bool),
}

/// Type, unit and range of a key's values.
#[non_exhaustive]
#[derive(Debug, Clone, Copy)]
pub enum Kind {
    /// A number, integers included.
    Number {
        /// Its unit; empty for a pure number.
        unit: &'static str,
        /// Accepted numbers.
        range: NumberRange,
    },
    /// A number, or a word that stands for one that is still to be found.
    NumberOr {
        /// Its unit; empty for a pure number.
        unit: &'static str,
        /// Accepted numbers.
        range: NumberRange,
        /// The word.
        word: &'static str,
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
    /// One line of text of any reasonable length: a sentence, a source.
    LongText,
    /// One of several words.
    Choice(fn() -> Vec<Word>),
    /// Yes or no.
    Switch,
    /// The name of another file, relative to the folder of this one.
    Path {
        /// Its name where a complete copy of both is kept, with `/`.
        kept_as: &'static str,
    },
    /// Numbers `[x, …]`, any count up to [`Kind::MOST_NUMBERS`].
    Numbers {
        /// Their unit.
        unit: &'static str,
        /// Accepted numbers, each.
        range: NumberRange,
    },
    /// Points `[[x, y], …]`, from two up to [`Kind::MOST_POINTS`].
    Points {
        /// Unit of the coordinates.
        unit: &'static str,
        /// Accepted coordinates.
        range: NumberRange,
    },
    /// Groups of keys, `[["section.key", "section.key"], …]`.
    Groups {
        /// A group as it is written.
        example: &'static str,
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
    #[must_use]
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
pub(crate) fn short(value: f64) -> String {
    let size = value.abs();
    if size.is_finite() && size != 0.0 && !(1e-3..1e5).contains(&size) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

impl Kind {
    /// The most characters of a long text.
    pub const LONG_TEXT: usize = 2000;

    /// The longest list of numbers.
    pub const MOST_NUMBERS: usize = 100;

    /// The longest list of points: no drawing has more, and pairs of segments stay few.
    pub const MOST_POINTS: usize = 200;

    /// Whether its values are text.
    #[must_use]
    pub fn is_text(&self) -> bool {
        matches!(self, Self::Text | Self::LongText | Self::Choice(_) | Self::Path { .. })
    }

    /// The accepted values, to follow "must be".
    #[must_use]
    pub fn accepted(&self) -> String {
        match self {
            Self::Number { unit: "", range } => format!("a number in {range}"),
            Self::Number { unit, range } => format!("a number in {range} {unit}"),
            Self::NumberOr { unit, range, word } => {
                let number = Self::Number { unit, range: *range }.accepted();
                format!("{number} or \"{word}\"")
            }
            Self::Integer { min, max } => format!("an integer from {min} to {max}"),
            Self::Text => "one line of text of at most 200 characters".into(),
            Self::LongText => format!("one line of text of at most {} characters", Self::LONG_TEXT),
            Self::Choice(words) => {
                let names: Vec<String> =
                    words().into_iter().map(|word| format!("\"{}\"", word.name)).collect();
                let switches =
                    words().into_iter().filter_map(|word| word.switch).map(|value| value.to_string());
                names.into_iter().chain(switches).collect::<Vec<_>>().join(" or ")
            }
            Self::Switch => "true or false".into(),
            Self::Path { .. } => "the name of a file".into(),
            Self::Numbers { unit, range } => {
                let numbers = Self::Number { unit, range: *range }.accepted();
                numbers.replacen("a number", &format!("a list of at most {} numbers", Self::MOST_NUMBERS), 1)
            }
            Self::Points { unit, .. } => format!("a list of at least two points [x, y] in {unit}"),
            Self::Groups { .. } => "a list of groups, each a list of at least two keys".into(),
        }
    }
}

impl Key {
    /// Whether it must be given, where its form is chosen.
    #[must_use]
    pub fn is_required(&self) -> bool {
        matches!(self.presence, Presence::Required(_))
    }
}

impl Section {
    /// The key called `name`.
    #[must_use]
    pub fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|k| k.name == name)
    }

    /// The header as written: `[name]`, `[[name]]`; empty for the keys before the first section.
    #[must_use]
    pub fn header(&self) -> String {
        match (self.name, self.presence) {
            ("", _) => String::new(),
            (name, SectionPresence::Repeated | SectionPresence::Several) => format!("[[{name}]]"),
            (name, _) => format!("[{name}]"),
        }
    }

    /// Whether it is written as `[[name]]`.
    #[must_use]
    pub fn repeats(&self) -> bool {
        matches!(self.presence, SectionPresence::Repeated | SectionPresence::Several)
    }

    /// The name of its `number`-th table, from 1, in messages: `section`, `section[2]`,
    /// `outer[2].inner`.
    #[must_use]
    pub fn path(&self, number: usize) -> String {
        match self.name.split_once('.') {
            Some((outer, own)) => format!("{outer}[{number}].{own}"),
            None if self.repeats() => format!("{}[{number}]", self.name),
            None => self.name.to_owned(),
        }
    }

    /// The last part of its name: `inner` of `outer.inner`.
    #[must_use]
    pub fn own_name(&self) -> &'static str {
        self.name.rsplit('.').next().unwrap_or_default()
    }

    /// Whether this section must be written.
    #[must_use]
    pub fn must_be_written(&self) -> bool {
        matches!(self.presence, SectionPresence::Required | SectionPresence::Repeated)
    }

    /// Whether `key` belongs to one of several alternative forms.
    #[must_use]
    pub fn is_in_a_form(&self, key: &Key) -> bool {
        self.forms.iter().any(|form| form.keys.contains(&key.name))
    }
}
