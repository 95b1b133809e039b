//! Entries of a folder, or the shipped ones, with the conditions that they name.

use super::computed::Conditions;
use super::score::Score;
use super::shipped;
use crate::simulation::RunObserver;
use railcrack_case::{CaseErrors, Comparison, Entry, Quantity};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Entries and the conditions that they name.
#[derive(Debug, Clone)]
pub struct Validation {
    entries: Vec<Entry>,
    conditions: BTreeMap<String, Conditions>,
    space: Space,
    /// The files that were read; none of those that come with the program.
    files: Vec<PathBuf>,
}

/// Entries that cannot be used.
#[derive(Debug, Error)]
pub enum ValidationError {
    /// An entry or its conditions are wrong.
    #[error(transparent)]
    Case(#[from] CaseErrors),
    /// A folder that cannot be read.
    #[error("cannot read the folder {}: {source}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// A folder without entries.
    #[error("{} holds no entry: an entry is a file NAME.toml with id, grade, quantity and source", path.display())]
    NoEntries {
        /// The folder.
        path: PathBuf,
    },
    /// Two sets of conditions whose samples cannot be taken in pairs.
    #[error(
        "entry `{id}`: `study` has {samples} samples and `over_study` {others}: a ratio of lives takes them in pairs, drawn from the same seed"
    )]
    Unpaired {
        /// The name of the entry.
        id: String,
        /// Samples of the numerator.
        samples: usize,
        /// Samples of the denominator.
        others: usize,
    },
    /// Two entries with the same name.
    #[error("two entries have the id `{id}`")]
    Twice {
        /// The name.
        id: String,
    },
}

/// An entry with its scores.
#[derive(Debug, Clone, PartialEq)]
pub struct Validated {
    /// The entry.
    pub entry: Entry,
    /// The score; none where nothing is compared, or no sample gives a value.
    pub score: Option<Score>,
    /// The score of the prediction in space.
    pub in_space: Option<Score>,
}

/// Whether the predictions in space, which take most of the time, are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Space {
    /// They are.
    Computed,
    /// They are left out.
    LeftOut,
}

impl Validation {
    /// The entries that come with the program.
    ///
    /// Errors: none of them is wrong, as a test shows.
    pub fn shipped() -> Result<Self, ValidationError> {
        let entries = shipped::ENTRIES.iter().map(|(name, text)| Entry::parse(text, name));
        let entries = entries.collect::<Result<Vec<Entry>, CaseErrors>>()?;
        let text = |name: &str| {
            let known = shipped::CONDITIONS.iter().find(|(known, _)| *known == name);
            known.map(|(_, text)| (*text).to_owned())
        };
        Self::of(entries, |name| Conditions::parse(&text(name).unwrap_or_default(), name, Path::new(".")))
    }

    /// The entries of the folder `path`: its files with the extension `toml`.
    ///
    /// Errors: it cannot be read; it holds no entry; an entry or its conditions are wrong.
    pub fn read(path: &Path) -> Result<Self, ValidationError> {
        let refused = |source| ValidationError::Folder { path: path.to_owned(), source };
        let mut files = Vec::new();
        for file in std::fs::read_dir(path).map_err(refused)? {
            let file = file.map_err(refused)?.path();
            if file.extension().is_some_and(|extension| extension == "toml") {
                files.push(file);
            }
        }
        files.sort();
        if files.is_empty() {
            return Err(ValidationError::NoEntries { path: path.to_owned() });
        }
        let entries =
            files.iter().map(|file| Entry::read(file)).collect::<Result<Vec<Entry>, CaseErrors>>()?;
        let read = Self::of(entries, |name| {
            let file = path.join(name);
            let text = railcrack_case::read_text_file(&file)?;
            Conditions::parse(&text, &file.display().to_string(), file.parent().unwrap_or(path))
        })?;
        for (name, conditions) in &read.conditions {
            let file = path.join(name);
            files.extend(conditions.named_files().map(|named| file.with_file_name("").join(named)));
            files.push(file);
        }
        Ok(Self { files, ..read })
    }

    /// The files that were read: entries, conditions and the files that these name.
    #[must_use]
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    fn of(
        mut entries: Vec<Entry>,
        read: impl Fn(&str) -> Result<Conditions, CaseErrors>,
    ) -> Result<Self, ValidationError> {
        entries.sort_by(|a, b| (a.grade, place(&a.id)).cmp(&(b.grade, place(&b.id))));
        let mut ids: Vec<&str> = entries.iter().map(|entry| entry.id.as_str()).collect();
        ids.sort_unstable();
        if let Some(pair) = ids.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(ValidationError::Twice { id: pair[0].to_owned() });
        }
        let mut conditions = BTreeMap::new();
        let compared = entries.iter().filter_map(|entry| entry.comparison.as_ref());
        for study in compared.flat_map(Comparison::studies) {
            if !conditions.contains_key(study) {
                conditions.insert(study.clone(), read(study)?);
            }
        }
        for entry in &entries {
            let Some(of) = &entry.comparison else { continue };
            let Some(over) = &of.over_study else { continue };
            let (samples, others) = (conditions[&of.study].samples(), conditions[over].samples());
            if samples != others {
                return Err(ValidationError::Unpaired { id: entry.id.clone(), samples, others });
            }
        }
        Ok(Self { entries, conditions, space: Space::Computed, files: Vec::new() })
    }

    /// The same, with the predictions in space or without.
    #[must_use]
    pub fn with(self, space: Space) -> Self {
        Self { space, ..self }
    }

    /// The entries, by grade and number.
    #[must_use]
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// Whether the growth of the samples of `study` is needed.
    fn needs_runs(&self, study: &str) -> bool {
        let compared = self.entries.iter().filter_map(|entry| entry.comparison.as_ref());
        let named = |of: &Comparison| {
            let in_space = of.study_in_space.as_deref() == Some(study) && self.space == Space::Computed;
            in_space || of.study == study || of.over_study.as_deref() == Some(study)
        };
        compared.filter(|of| of.quantity.needs_a_run()).any(named)
    }

    /// How many runs [`Validation::compute`] makes.
    #[must_use]
    pub fn runs(&self) -> usize {
        let needed = self.conditions.iter().filter(|(study, _)| self.needs_runs(study));
        needed.map(|(_, conditions)| conditions.runs()).sum()
    }

    /// Computes all samples.
    pub fn compute(&mut self, observer: &dyn RunObserver) {
        let studies: Vec<String> = self.conditions.keys().filter(|of| self.needs_runs(of)).cloned().collect();
        for study in studies {
            if let Some(conditions) = self.conditions.get_mut(&study) {
                conditions.compute(observer);
            }
        }
    }

    /// Every entry with its score, after the computation.
    #[must_use]
    pub fn validated(&self) -> Vec<Validated> {
        let score = |of: &Comparison, study: &str| {
            let over = of.over_study.as_ref().and_then(|over| self.conditions.get(over));
            Score::of(&self.conditions.get(study)?.predict(of.quantity, over), of.measured)
        };
        let validated = |entry: &Entry| {
            let of = entry.comparison.as_ref();
            Validated {
                entry: entry.clone(),
                score: of.and_then(|of| score(of, &of.study)),
                in_space: of.and_then(|of| score(of, of.study_in_space.as_ref()?)),
            }
        };
        self.entries.iter().map(validated).collect()
    }

    /// Quantiles (2.5, 50, 97.5 %) of the rate of growth in depth under the conditions `study`,
    /// between each of `depths` (mm) and the next; depths that no sample reaches are left out.
    #[must_use]
    pub fn rate_over_depth(&self, study: &str, depths: &[f64]) -> Vec<(f64, [f64; 3])> {
        let Some(conditions) = self.conditions.get(study) else { return Vec::new() };
        let between = |pair: &[f64]| {
            let predicted = conditions.predict(Quantity::DepthRate { from: pair[0], to: pair[1] }, None);
            let score = Score::of(&predicted, (0.5, 2.0))?;
            Some(((pair[0] * pair[1]).sqrt(), score.predicted))
        };
        depths.windows(2).filter_map(between).collect()
    }

    /// The studies whose rates in depth per tonnage are compared, each with that of the same
    /// conditions in space where these are computed.
    #[must_use]
    pub fn studies_over_depth(&self) -> BTreeMap<&str, Option<&str>> {
        let mut pairs: BTreeMap<&str, Option<&str>> = BTreeMap::new();
        for of in self.entries.iter().filter_map(|entry| entry.comparison.as_ref()) {
            if matches!(of.quantity, Quantity::DepthRate { .. }) {
                let space = of.study_in_space.as_deref().filter(|_| self.space == Space::Computed);
                let known = pairs.entry(&of.study).or_default();
                *known = known.or(space);
            }
        }
        pairs
    }
}

/// A name before and as its number, so that T10 follows T9; the name itself for equal numbers.
fn place(id: &str) -> (&str, usize, &str) {
    let letters = id.trim_end_matches(|letter: char| letter.is_ascii_digit());
    (letters, id[letters.len()..].parse().unwrap_or(usize::MAX), id)
}

#[cfg(test)]
mod tests {
    use super::*;
    use railcrack_case::Grade;

    #[test]
    fn the_shipped_entries_are_those_of_the_folder() {
        let shipped = Validation::shipped().unwrap();
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation");
        let read = Validation::read(&folder).unwrap();
        assert_eq!(shipped.entries, read.entries);
        assert!(shipped.runs() > 0 && shipped.runs() == read.runs());
        for (name, text) in shipped::CONDITIONS {
            assert_eq!(std::fs::read_to_string(folder.join(name)).unwrap(), *text, "{name}");
        }
    }

    #[test]
    fn what_is_known_from_memory_is_never_scored() {
        let shipped = Validation::shipped().unwrap();
        let remembered = |entry: &&Entry| entry.certainty == 1;
        assert!(shipped.entries.iter().filter(remembered).count() >= 6);
        assert!(!shipped.entries.iter().filter(remembered).any(Entry::is_scored));
        // Law entries need no run.
        let validated = shipped.validated();
        let law = validated.iter().find(|one| one.entry.id == "L1").unwrap();
        let score = law.score.unwrap();
        // The default law over that of U71Mn at 13.5 MPa√m: 1.16e-5 over 1.01e-5.
        assert!((score.factor - 1.15).abs() < 0.02, "{score:?}");
        assert_eq!(law.entry.grade, Grade::Law);
    }
}
