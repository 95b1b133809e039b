//! Passages until the history of K repeats.

use super::PassageSettings;

/// A passage that may repeat the one before.
pub(crate) trait Repeats: Sized {
    /// What is kept of it.
    type Record: Clone;

    /// What is kept of it.
    fn record(&self) -> Self::Record;

    /// The largest change of K at any tip and position from the passage of `before`, relative to
    /// the largest |K|.
    fn change_from(&self, before: &Self::Record) -> f64;

    /// Whether it coincides with the passage before from some position on: the next one then
    /// begins and goes like this one.
    fn joins(&self) -> bool {
        false
    }
}

/// Passages up to the last one.
pub(crate) struct Repeated<P: Repeats> {
    pub records: Vec<P::Record>,
    pub last: P,
    /// Change of K from the last but one passage to the last; none after a single passage.
    pub change: Option<f64>,
}

/// Whether the faces remember a passage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Memory {
    /// Friction locks slip in: passages differ until the history repeats.
    Friction,
    /// Without friction one passage is like the next.
    None,
}

/// Computes passages by `pass`, which takes their number from 1 and the one before, until they
/// repeat, or as many as `settings` allow; one only without memory.
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
