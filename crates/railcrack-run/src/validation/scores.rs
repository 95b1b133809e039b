//! The scores of all entries, by grade and geometry.

use super::folder::Validated;
use super::score::{GradeScore, Residuals, Score, grade_scores};
use railcrack_case::{Grade, Quantity};

/// The scores by grade and geometry, and what they say of the coefficient.
#[derive(Debug, Clone, PartialEq)]
pub struct Scores {
    /// In the plane, or of a law.
    pub plane: Vec<GradeScore>,
    /// In space.
    pub space: Vec<GradeScore>,
    /// The prior of ln C by the residuals of growth in depth of rails in service, with the name of
    /// the geometry.
    pub residuals: Vec<(&'static str, Residuals)>,
}

impl Scores {
    /// The scores of the entries in `validated` that are scored.
    pub fn of(validated: &[Validated]) -> Self {
        let scored = || validated.iter().filter(|one| one.entry.is_scored());
        let grades = |of: &dyn Fn(&Validated) -> Option<Score>| {
            let all: Vec<_> = scored().filter_map(|one| Some((one.entry.grade, of(one)?))).collect();
            grade_scores(&all)
        };
        let residuals = |of: &dyn Fn(&Validated) -> Option<Score>| {
            let of_track = scored().filter(|one| one.entry.grade == Grade::Track).filter_map(|one| {
                let comparison = one.entry.comparison.as_ref()?;
                let is_rate = matches!(comparison.quantity, Quantity::DepthRate { .. });
                is_rate.then_some((of(one)?, comparison.place_log_std?))
            });
            Residuals::of(&of_track.collect::<Vec<_>>())
        };
        let both = [("plane", residuals(&|one| one.score)), ("space", residuals(&|one| one.in_space))];
        Self {
            plane: grades(&|one| one.score),
            space: grades(&|one| one.in_space),
            residuals: both.into_iter().filter_map(|(name, of)| Some((name, of?))).collect(),
        }
    }

    /// Each with the words that name it: `track`, `track, in space`.
    pub fn by_grade(&self) -> impl Iterator<Item = (String, &GradeScore)> {
        let plane = self.plane.iter().map(|of| (of.grade.word().to_owned(), of));
        plane.chain(self.space.iter().map(|of| (format!("{}, in space", of.grade.word()), of)))
    }

    /// A line for each grade, prior and entry that is not compared, and the count of all.
    pub fn text(&self, validated: &[Validated]) -> String {
        let mut text = String::new();
        for (name, of) in self.by_grade() {
            text.push_str(&format!(
            "{}: {}, {} within 95 %, {} within a factor of 2, {} within a factor of 5; predicted over measured {:.2} in the mean, CRPS of ln {:.2}\n",
            name,
            entries(of.entries),
            of.inside,
            of.within_2,
            of.within_5,
            of.factor,
            of.crps
        ));
        }
        for (name, of) in &self.residuals {
            text.push_str(&format!(
                "prior of ln C by the residuals of {} entries of track in {}: mean {:.2}, sd {:.2}\n",
                of.entries,
                if *name == "plane" { "the plane" } else { "space" },
                of.mean,
                of.log_std
            ));
        }
        let scored = validated.iter().filter(|one| one.entry.is_scored() && one.score.is_some()).count();
        let remembered = validated.iter().filter(|one| one.entry.certainty == 1).count();
        let is_missing =
            |one: &&Validated| one.entry.is_scored() && one.entry.comparison.is_some() && one.score.is_none();
        for one in validated.iter().filter(is_missing) {
            text.push_str(&format!(
                "{}: not compared, since no sample of its conditions reaches what was measured\n",
                one.entry.id
            ));
        }
        text.push_str(&format!(
            "{}, {scored} scored; {remembered} from memory, never scored\n",
            entries(validated.len())
        ));
        text
    }
}

fn entries(count: usize) -> String {
    if count == 1 { "1 entry".to_owned() } else { format!("{count} entries") }
}
