//! Keys of `[growth]` that the growth laws declare.

use crate::schema::{Key, KeyRow, choice, closed, number};
use railcrack::fatigue::{Constant, LawDeclaration, LawInput};

const LAWS: &[&LawDeclaration] = LawDeclaration::ALL;

/// The key of the law.
pub(super) const LAW: KeyRow<&'static LawDeclaration> = choice("law", "Growth law.");

/// The key of a constant, whatever the law.
pub(super) const fn row(constant: &Constant) -> KeyRow<f64> {
    let (low, high) = constant.range;
    number(constant.key, constant.unit, closed(low, high), constant.default, constant.doc)
}

/// The keys of all constants, each once, in the order of the laws.
const ALL_CONSTANTS: &[Key; COUNT] = &{
    let mut keys = [LAW.key; COUNT];
    let mut i = 0;
    while i < COUNT {
        let constant = CONSTANTS[i];
        keys[i] = row(&constant).only_with_words(LAW, USERS[i].names(), constant.reason).key;
        i += 1;
    }
    keys
};

/// The keys of the constants that precede the threshold shared by the laws: those of the default
/// law.
pub(super) const OF_DEFAULT_LAW: &[Key] = ALL_CONSTANTS.split_at(place_of(Constant::THRESHOLD.key)).0;

/// The keys of all other constants.
pub(super) const OF_OTHER_LAWS: &[Key] = ALL_CONSTANTS.split_at(place_of(Constant::THRESHOLD.key)).1;

/// The laws with which an equivalent range is chosen.
pub(super) const WITH_A_RANGE: &[&str] = RANGED.names();

/// The laws that are tables of measured rates.
pub(super) const OF_RATES: &[&str] = MEASURED.names();

/// Reason for refusing an equivalent range with the other laws.
pub(super) const OWN_RANGE: &str = {
    let mut reason = "";
    let mut i = 0;
    while i < LAWS.len() {
        if let Some(own) = LAWS[i].own_range {
            // A sentence about one law does not apply to two.
            reason = if reason.is_empty() { own.reason } else { "the law defines its own equivalent range" };
        }
        i += 1;
    }
    reason
};

/// Names of laws, the first `count` of which count.
#[derive(Clone, Copy)]
struct Names {
    words: [&'static str; LAWS.len()],
    count: usize,
}

impl Names {
    const NONE: Self = Self { words: [""; LAWS.len()], count: 0 };

    const fn and(mut self, law: &LawDeclaration) -> Self {
        self.words[self.count] = law.word.name;
        self.count += 1;
        self
    }

    const fn names(&'static self) -> &'static [&'static str] {
        self.words.split_at(self.count).0
    }
}

const COUNT: usize = {
    let (mut count, mut law) = (0, 0);
    while law < LAWS.len() {
        let mut i = 0;
        while i < constants(law).len() {
            count += is_first(law, i) as usize;
            i += 1;
        }
        law += 1;
    }
    count
};

/// Every constant once, where it is first named.
const CONSTANTS: &[Constant; COUNT] = &{
    let mut all = [Constant::THRESHOLD; COUNT];
    let (mut count, mut law) = (0, 0);
    while law < LAWS.len() {
        let mut i = 0;
        while i < constants(law).len() {
            if is_first(law, i) {
                all[count] = constants(law)[i];
                count += 1;
            }
            i += 1;
        }
        law += 1;
    }
    all
};

/// For each constant, the laws that use it.
const USERS: &[Names; COUNT] = &{
    let mut users = [Names::NONE; COUNT];
    let mut i = 0;
    while i < COUNT {
        let mut law = 0;
        while law < LAWS.len() {
            if has(law, CONSTANTS[i].key, constants(law).len()) {
                users[i] = users[i].and(LAWS[law]);
            }
            law += 1;
        }
        i += 1;
    }
    users
};

const RANGED: &Names = &{
    let (mut names, mut law) = (Names::NONE, 0);
    while law < LAWS.len() {
        if LAWS[law].own_range.is_none() {
            names = names.and(LAWS[law]);
        }
        law += 1;
    }
    names
};

const MEASURED: &Names = &{
    let (mut names, mut law) = (Names::NONE, 0);
    while law < LAWS.len() {
        if let LawInput::Table = LAWS[law].input {
            names = names.and(LAWS[law]);
        }
        law += 1;
    }
    names
};

const fn constants(law: usize) -> &'static [Constant] {
    match LAWS[law].input {
        LawInput::Constants(of) => of.all,
        LawInput::Table => &[],
    }
}

/// Whether no law before `law` has its constant `i`.
const fn is_first(law: usize, i: usize) -> bool {
    let mut before = 0;
    while before < law {
        if has(before, constants(law)[i].key, constants(before).len()) {
            return false;
        }
        before += 1;
    }
    !has(law, constants(law)[i].key, i)
}

/// Whether `key` is one of the first `end` constants of `law`.
const fn has(law: usize, key: &str, end: usize) -> bool {
    let mut i = 0;
    while i < end {
        if is_same(constants(law)[i].key, key) {
            return true;
        }
        i += 1;
    }
    false
}

const fn place_of(key: &str) -> usize {
    let mut i = 0;
    while i < COUNT && !is_same(CONSTANTS[i].key, key) {
        i += 1;
    }
    i
}

/// Equality of texts: the standard library has no constant function for it.
const fn is_same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}
