//! Repetition of passages until the history of K no longer changes.

use super::PassageSettings;

/// A passage that may repeat the previous one.
pub(crate) trait Repeats: Sized {
    /// The part of a passage that is kept.
    type Record: Clone;

    /// The record of this passage.
    fn record(&self) -> Self::Record;

    /// The largest change of K at any tip and position since the passage recorded in `before`,
    /// relative to the largest |K|.
    fn change_from(&self, before: &Self::Record) -> f64;

    /// Whether it coincides with the previous passage from some position on; the next passage is
    /// then identical to this one.
    fn joins(&self) -> bool {
        false
    }
}

/// All passages, with the last one in full.
pub(crate) struct Repeated<P: Repeats> {
    pub records: Vec<P::Record>,
    pub last: P,
    /// Change of K between the last two passages; `None` after a single passage.
    pub change: Option<f64>,
}

/// Whether the faces retain a memory of a passage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Memory {
    /// Friction locks in slip, so that passages differ until the history repeats.
    Friction,
    /// Without friction all passages are the same.
    None,
}

/// Computes passages with `pass`, which takes the number of the passage (from 1) and the previous
/// one, until they repeat or their number reaches the limit in `settings`; without memory, a single
/// passage.
pub(crate) fn until_repeated<P: Repeats, E>(
    settings: &PassageSettings,
    memory: Memory,
    mut pass: impl FnMut(usize, Option<&P>) -> Result<P, E>,
) -> Result<Repeated<P>, E> {
    let mut records: Vec<P::Record> = Vec::new();
    let mut before: Option<P> = None;
    loop {
        let last = pass(records.len() + 1, before.as_ref())?;
        let mut change = records.last().map(|before| last.change_from(before));
        records.push(last.record());
        let mut repeats = change.is_some_and(|change| change <= settings.passage_tolerance);
        if last.joins() && !repeats && records.len() < settings.max_passages {
            records.push(last.record());
            (change, repeats) = (Some(0.0), true);
        }
        if repeats || records.len() >= settings.max_passages || memory == Memory::None {
            return Ok(Repeated { records, last, change });
        }
        before = Some(last);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// K of a passage.
    #[derive(Clone)]
    struct Value(f64);

    impl Repeats for Value {
        type Record = f64;

        fn record(&self) -> f64 {
            self.0
        }

        fn change_from(&self, before: &f64) -> f64 {
            (self.0 - before).abs()
        }
    }

    fn passes(memory: Memory, max_passages: usize) -> Repeated<Value> {
        let settings = PassageSettings { max_passages, passage_tolerance: 0.3, ..PassageSettings::default() };
        until_repeated(&settings, memory, |number, _| Ok::<_, ()>(Value(1.0 / number as f64))).unwrap()
    }

    #[test]
    fn passages_go_on_until_they_repeat_or_are_enough() {
        // 1, 1/2, 1/3: the last two differ by 1/6.
        let all = passes(Memory::Friction, 5);
        assert_eq!((all.records.len(), all.change), (3, Some(1.0 / 2.0 - 1.0 / 3.0)));
        assert_eq!(passes(Memory::Friction, 2).change, Some(0.5));
        let one = passes(Memory::None, 5);
        assert_eq!((one.records.len(), one.change), (1, None));
    }
}
