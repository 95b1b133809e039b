//! Rows of a declaration: keys with the type of the values that they give.

use super::declaration::{Key, Kind, NumberRange, OnlyWith, Pair, Presence, Preset};
use super::value::NumberOr;
use railcrack::words::{Choice, Word};
use std::marker::PhantomData;

/// A key whose values are read as `T`.
#[derive(Debug)]
pub(crate) struct KeyRow<T> {
    pub key: Key,
    values: PhantomData<fn() -> T>,
}

impl<T> Clone for KeyRow<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for KeyRow<T> {}

impl<T> KeyRow<T> {
    const fn new(name: &'static str, kind: Kind, preset: Preset, doc: &'static str) -> Self {
        let presence = Presence::Default(preset);
        let key =
            Key { name, kind, presence, doc, only_with: None, excused: None, pair: None, reference: None };
        Self { key, values: PhantomData }
    }

    const fn with(self, key: Key) -> Self {
        Self { key, values: self.values }
    }

    /// Without a default: it must be given, where its form is chosen.
    pub const fn required(self) -> Self {
        let presence = Presence::Required(self.key.presence.preset());
        self.with(Key { presence, ..self.key })
    }

    /// Without a default: where it is not given, what it describes does not exist.
    pub const fn optional(self) -> Self {
        let presence = Presence::Optional(self.key.presence.preset());
        self.with(Key { presence, ..self.key })
    }

    /// With a value other than the default in the first file of a user.
    pub const fn first(self, value: Preset) -> Self {
        self.with(Key { reference: Some(value), ..self.key })
    }

    /// Only with the word `choice` of another key; `otherwise` gives the reason.
    pub const fn only_with<U>(self, other: KeyRow<U>, choice: &'static str, otherwise: &'static str) -> Self {
        self.only_with_any(other, choice, &[], otherwise)
    }

    /// Only with one of `words` of another key, of which there is at least one; `otherwise` gives
    /// the reason.
    pub const fn only_with_words<U>(
        self,
        other: KeyRow<U>,
        words: &'static [&'static str],
        otherwise: &'static str,
    ) -> Self {
        match words {
            [choice, also @ ..] => self.only_with_any(other, choice, also, otherwise),
            [] => panic!("a key that goes with no word"),
        }
    }

    /// Only with the word `choice` of another key, or one of the words `also`; `otherwise` gives
    /// the reason.
    pub const fn only_with_any<U>(
        self,
        other: KeyRow<U>,
        choice: &'static str,
        also: &'static [&'static str],
        otherwise: &'static str,
    ) -> Self {
        let only_with = OnlyWith { key: other.key.name, choice, also, otherwise };
        self.with(Key { only_with: Some(only_with), ..self.key })
    }

    /// Without a default, and required but with the word `choice` of another key; `because` gives
    /// the reason for the exception.
    pub const fn required_but_with<U>(
        self,
        other: KeyRow<U>,
        choice: &'static str,
        because: &'static str,
    ) -> Self {
        let excused = OnlyWith { key: other.key.name, choice, also: &[], otherwise: because };
        let row = self.required();
        row.with(Key { excused: Some(excused), ..row.key })
    }

    /// Given together with an integer above its default, [`Pair`].
    pub const fn paired(self, other: KeyRow<usize>, help: &'static str) -> Self {
        self.with(Key { pair: Some(Pair { key: other.key.name, help }), ..self.key })
    }
}

/// \[min, max\].
pub(crate) const fn closed(min: f64, max: f64) -> NumberRange {
    NumberRange::closed(min, max)
}

/// (0, max\].
pub(crate) const fn positive(max: f64) -> NumberRange {
    NumberRange::positive(max)
}

/// \[−largest, largest\].
pub(crate) const fn within(largest: f64) -> NumberRange {
    NumberRange::closed(-largest, largest)
}

/// A number with a default, or an example where it has none.
pub(crate) const fn number(
    name: &'static str,
    unit: &'static str,
    range: NumberRange,
    default: f64,
    doc: &'static str,
) -> KeyRow<f64> {
    KeyRow::new(name, Kind::Number { unit, range }, Preset::Number(default), doc)
}

/// A number or `word`, which is the default.
pub(crate) const fn number_or(
    name: &'static str,
    range: NumberRange,
    word: &'static str,
    doc: &'static str,
) -> KeyRow<NumberOr> {
    KeyRow::new(name, Kind::NumberOr { unit: "", range, word }, Preset::Text(word), doc)
}

/// An integer of `range`, ends included, with a default or an example.
pub(crate) const fn integer(
    name: &'static str,
    (min, max): (u64, u64),
    default: u64,
    doc: &'static str,
) -> KeyRow<usize> {
    KeyRow::new(name, Kind::Integer { min, max }, Preset::Integer(default), doc)
}

/// One of the words of `T`, by default the first.
pub(crate) const fn choice<T: Choice>(name: &'static str, doc: &'static str) -> KeyRow<T> {
    KeyRow::new(name, Kind::Choice(words::<T>), Preset::Text(T::WORDS[0].1.name), doc)
}

/// All words of a choice.
fn words<T: Choice>() -> Vec<Word> {
    T::WORDS.iter().map(|(_, word)| *word).collect()
}

/// Yes or no.
pub(crate) const fn switch(name: &'static str, default: Preset, doc: &'static str) -> KeyRow<bool> {
    KeyRow::new(name, Kind::Switch, default, doc)
}

/// One line of text.
pub(crate) const fn text(name: &'static str, default: &'static str, doc: &'static str) -> KeyRow<String> {
    KeyRow::new(name, Kind::Text, Preset::Text(default), doc)
}

/// One line of text that may be long.
pub(crate) const fn long_text(
    name: &'static str,
    default: &'static str,
    doc: &'static str,
) -> KeyRow<String> {
    KeyRow::new(name, Kind::LongText, Preset::Text(default), doc)
}

/// The name of another file, and its name where a complete copy is kept.
pub(crate) const fn file(
    name: &'static str,
    kept_as: &'static str,
    example: &'static str,
    doc: &'static str,
) -> KeyRow<String> {
    KeyRow::new(name, Kind::Path { kept_as }, Preset::Text(example), doc)
}

/// A list of numbers.
pub(crate) const fn numbers(
    name: &'static str,
    unit: &'static str,
    range: NumberRange,
    default: &'static [f64],
    doc: &'static str,
) -> KeyRow<Vec<f64>> {
    KeyRow::new(name, Kind::Numbers { unit, range }, Preset::Numbers(default), doc)
}

/// A list of points.
pub(crate) const fn points(
    name: &'static str,
    unit: &'static str,
    range: NumberRange,
    example: &'static [[f64; 2]],
    doc: &'static str,
) -> KeyRow<Vec<[f64; 2]>> {
    KeyRow::new(name, Kind::Points { unit, range }, Preset::Points(example), doc)
}

/// Groups of keys; `written` is `example` as it stands in a file.
pub(crate) const fn groups(
    name: &'static str,
    example: &'static [&'static [&'static str]],
    written: &'static str,
    doc: &'static str,
) -> KeyRow<Vec<Vec<String>>> {
    KeyRow::new(name, Kind::Groups { example: written }, Preset::Groups(example), doc)
}

/// How many keys `parts` have.
pub(crate) const fn count(parts: &[&[Key]]) -> usize {
    let (mut keys, mut part) = (0, 0);
    while part < parts.len() {
        keys += parts[part].len();
        part += 1;
    }
    keys
}

/// The keys of all `parts`, which are `N`.
pub(crate) const fn joined<const N: usize>(parts: &[&[Key]]) -> [Key; N] {
    let mut keys = [parts[0][0]; N];
    let (mut next, mut part) = (0, 0);
    while part < parts.len() {
        let mut i = 0;
        while i < parts[part].len() {
            keys[next] = parts[part][i];
            (next, i) = (next + 1, i + 1);
        }
        part += 1;
    }
    keys
}

/// Declares a section: a constant for each row, and the [`Section`](super::Section) of all of them.
///
/// `NAME "name", Presence, "Sentence." [, forms [[ROW, … [; ROW, …]], …]] [, parts [SECTION, …]]
/// [, instead "name"]; ROW: Type = row; [..KEYS;] …`, where KEYS are keys that are declared
/// elsewhere, and rows after the semicolon of a form may be given with it.
macro_rules! section {
    (
        $SECTION:ident $name:literal, $presence:ident, $doc:literal $(, forms [$([$($OF:ident),+ $(; $($ALSO:ident),+)?]),+])?
            $(, parts [$($PART:expr),+])? $(, instead $instead:literal)?;
        $($ROW:ident: $Type:ty = $row:expr; $(..$MORE:expr;)?)+
    ) => {
        $(pub(crate) const $ROW: $crate::schema::KeyRow<$Type> = $row;)+

        #[doc = $doc]
        pub const $SECTION: $crate::schema::Section = $crate::schema::Section {
            name: $name,
            doc: $doc,
            presence: $crate::schema::SectionPresence::$presence,
            keys: {
                const PARTS: &[&[$crate::schema::Key]] = &[$(&[$ROW.key], $($MORE,)?)+];
                &$crate::schema::joined::<{ $crate::schema::count(PARTS) }>(PARTS)
            },
            forms: &[$($($crate::schema::Form {
                keys: &[$($OF.key.name),+],
                also: &[$($($ALSO.key.name),+)?],
            }),+)?],
            parts: &[$($($PART),+)?],
            instead: $crate::schema::given!($($instead)?),
            off: None,
        };
    };
}
pub(crate) use section;

/// The value that is written, or none.
macro_rules! given {
    () => {
        None
    };
    ($value:expr) => {
        Some($value)
    };
}
pub(crate) use given;
