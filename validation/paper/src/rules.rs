//! Rules that decide statements: numbers of curves, and conditions for them.

use crate::measure::Measure;
use crate::path_shape::{PathCourse, PathShape};
use crate::results::SetupResults;
use crate::tables::Claim;
use serde::Deserialize;

pub use crate::single_rules::SingleRule;

/// The decision on a statement in one set-up.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Decision {
    /// Whether it holds.
    pub holds: bool,
    /// The numbers that decide it, each with its name.
    pub numbers: Vec<(String, f64)>,
}

/// Numbers of the cracks of a curve or of a series of curves, and what must hold for them.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Test {
    of: Measure,
    on: String,
    /// The curve or series with respect to which changes are given, in per cent.
    than: Option<String>,
    /// The name of the numbers.
    name: String,
    /// Conditions, all of which must hold; numbers without are given for information.
    #[serde(default)]
    holds: Vec<Condition>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Condition {
    /// Each is larger than the one before.
    Rises,
    /// Each is smaller than the one before.
    Falls,
    /// None is larger than the one before, and the last is smaller than the first.
    IsEarlier,
    /// Each is within these limits.
    All(Limits),
    /// One at least is.
    Some(Limits),
    /// The largest is.
    Largest(Limits),
    /// The largest less the smallest is.
    Spread(Limits),
    /// The same, over the largest.
    RelativeSpread(Limits),
    /// The paths are of each of these courses.
    Paths {
        /// Words of the paths concerned; all if empty.
        #[serde(default)]
        at: Vec<String>,
        are: Vec<PathCourse>,
    },
    /// One path at least is of one of these courses.
    SomePath(Vec<PathCourse>),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Limits {
    /// Words of the numbers concerned; all if empty.
    #[serde(default)]
    at: Vec<String>,
    least: Option<f64>,
    most: Option<f64>,
    above: Option<f64>,
    below: Option<f64>,
}

/// A number of a test with the path of its crack.
struct Value {
    words: String,
    number: f64,
    path: PathShape,
}

impl Limits {
    fn include(&self, number: f64) -> bool {
        self.least.is_none_or(|least| number >= least)
            && self.most.is_none_or(|most| number <= most)
            && self.above.is_none_or(|above| number > above)
            && self.below.is_none_or(|below| number < below)
    }
}

impl Claim {
    /// The decision in the set-up of `r`; none where it lacks a run that the rule needs.
    pub fn decide(&self, r: SetupResults) -> Option<Decision> {
        if let Some(rule) = &self.decide {
            return rule.decide(r);
        }
        let mut decision = Decision { holds: true, numbers: Vec::new() };
        for test in &self.test {
            let part = test.decide(r)?;
            decision.holds &= part.holds;
            decision.numbers.extend(part.numbers);
        }
        Some(decision)
    }
}

impl Test {
    fn decide(&self, r: SetupResults) -> Option<Decision> {
        let mut values = self.values(r, &self.on)?;
        if let Some(than) = &self.than {
            let others = self.values(r, than)?;
            for (i, value) in values.iter_mut().enumerate() {
                // One crack is compared with each.
                let other = others.get(i).or(others.first())?;
                value.number = 100.0 * (value.number / other.number - 1.0);
            }
        }
        if values.is_empty() && !self.holds.is_empty() {
            return None;
        }
        let travel = r.setup().travel.sign();
        let holds = self.holds.iter().all(|condition| condition.holds(&values, travel));
        let about_paths = |condition| matches!(condition, &Condition::Paths { .. } | &Condition::SomePath(_));
        let numbers = if self.holds.iter().any(about_paths) {
            values.iter().map(|value| value.with_path(&self.name)).collect()
        } else {
            values.iter().map(|value| (joined(&self.name, &value.words), value.number)).collect()
        };
        Some(Decision { holds, numbers })
    }

    /// The numbers of the cracks of `curves`, without those that a crack lacks; none where a run is
    /// missing.
    fn values(&self, r: SetupResults, curves: &str) -> Option<Vec<Value>> {
        let mut values = Vec::new();
        for (words, curve) in r.paper.series(curves) {
            let run = if self.of.needs_growth() { r.grown(curve)? } else { r.run(curve)? };
            for (i, crack) in run.cracks.iter().enumerate() {
                let words = if run.cracks.len() > 1 { (i + 1).to_string() } else { words.to_owned() };
                let Some(number) = self.of.value(crack) else { continue };
                values.push(Value { words, number, path: PathShape::new(crack) });
            }
        }
        Some(values)
    }
}

impl Value {
    /// The number called `name`, with the words of its path.
    fn with_path(&self, name: &str) -> (String, f64) {
        (format!("{}, {name}", joined(&self.words, &self.path.words())), self.number)
    }
}

fn joined(first: &str, second: &str) -> String {
    format!("{first} {second}").trim().to_owned()
}

impl Condition {
    fn holds(&self, values: &[Value], travel: f64) -> bool {
        let numbers: Vec<f64> = values.iter().map(|value| value.number).collect();
        let pairs = |ordered: fn(f64, f64) -> bool| numbers.windows(2).all(|pair| ordered(pair[0], pair[1]));
        let largest = numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let spread = largest - numbers.iter().copied().fold(f64::INFINITY, f64::min);
        match self {
            Self::Rises => pairs(|a, b| b > a),
            Self::Falls => pairs(|a, b| b < a),
            Self::IsEarlier => pairs(|a, b| b <= a) && numbers.last() < numbers.first(),
            Self::All(limits) => chosen(values, &limits.at).all(|value| limits.include(value.number)),
            Self::Some(limits) => chosen(values, &limits.at).any(|value| limits.include(value.number)),
            Self::Largest(limits) => limits.include(largest),
            Self::Spread(limits) => limits.include(spread),
            Self::RelativeSpread(limits) => limits.include(spread / largest),
            Self::Paths { at, are } => {
                chosen(values, at).all(|value| are.iter().all(|course| value.path.is(*course, travel)))
            }
            Self::SomePath(courses) => {
                values.iter().any(|value| courses.iter().any(|course| value.path.is(*course, travel)))
            }
        }
    }
}

/// The values whose words are among `at`; all if it is empty.
fn chosen<'a>(values: &'a [Value], at: &'a [String]) -> impl Iterator<Item = &'a Value> {
    values.iter().filter(move |value| at.is_empty() || at.contains(&value.words))
}

impl Decision {
    /// A decision whose numbers follow.
    pub fn new(holds: bool) -> Self {
        Self { holds, numbers: Vec::new() }
    }

    /// The decision with one more number.
    #[must_use]
    pub fn with(mut self, name: &str, value: f64) -> Self {
        self.numbers.push((name.to_owned(), value));
        self
    }

    /// The decision with the inclinations of `paths`, which are numbered.
    #[must_use]
    pub fn with_paths(mut self, paths: &[PathShape]) -> Self {
        for (i, path) in paths.iter().enumerate() {
            let angle = path.inclination_after.or(path.inclination).unwrap_or(0.0);
            self = self.with(&format!("{} {}, below surface °", i + 1, path.words()), angle);
        }
        self
    }

    /// `yes; ` or `no; ` and the numbers in one line, three digits each.
    pub fn text(&self) -> String {
        let number = |(name, value): &(String, f64)| format!("{name} {}", rounded(*value));
        let numbers = self.numbers.iter().map(number).collect::<Vec<_>>().join(", ");
        format!("{}; {numbers}", self.answer())
    }

    /// `yes` or `no`.
    pub fn answer(&self) -> &'static str {
        if self.holds { "yes" } else { "no" }
    }
}

/// Three significant digits; more would not be known, fewer would hide differences of a per cent.
pub fn rounded(value: f64) -> String {
    /// K in MPa√m, degrees, millimetres and per cent smaller than that are round-off or tolerance.
    const NOTHING: f64 = 5e-4;
    if value.abs() < NOTHING {
        return "0".into();
    }
    if !value.is_finite() {
        return format!("{value}");
    }
    let size = value.abs().log10().floor() as i32;
    if !(-3..6).contains(&size) {
        return format!("{value:.1e}");
    }
    let decimals = (2 - size).max(0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::Paper;

    fn holds(condition: &str, numbers: &[f64]) -> bool {
        let condition: Condition = serde_json::from_str(condition).unwrap();
        let path = PathShape::new(&crate::case_run::CrackGrowth {
            points: vec![[0.0, 0.0], [1.0, 1.0]],
            initial_points: 2,
            ..Default::default()
        });
        let value = |(i, number): (usize, &f64)| Value { words: i.to_string(), number: *number, path };
        condition.holds(&numbers.iter().enumerate().map(value).collect::<Vec<_>>(), 1.0)
    }

    #[test]
    fn conditions_are_those_that_they_are_called() {
        assert!(holds("\"rises\"", &[1.0, 2.0, 3.0]) && !holds("\"rises\"", &[1.0, 3.0, 3.0]));
        assert!(holds("\"falls\"", &[3.0, 2.0]) && !holds("\"falls\"", &[2.0, 3.0]));
        assert!(holds("\"is-earlier\"", &[3.0, 3.0, 1.0]) && !holds("\"is-earlier\"", &[3.0, 3.0]));
        assert!(!holds("\"is-earlier\"", &[3.0, 4.0, 1.0]));
        assert!(holds(r#"{"all": {"most": 2.0}}"#, &[1.0, 2.0]));
        assert!(!holds(r#"{"all": {"below": 2.0}}"#, &[1.0, 2.0]));
        assert!(holds(r#"{"all": {"at": ["1"], "above": 1.0}}"#, &[1.0, 2.0]));
        assert!(holds(r#"{"some": {"least": 2.0}}"#, &[1.0, 2.0]));
        assert!(!holds(r#"{"largest": {"least": 1.0, "most": 1.5}}"#, &[1.0, 2.0]));
        assert!(holds(r#"{"spread": {"least": 1.0}}"#, &[1.0, 2.0]));
        assert!(!holds(r#"{"relative-spread": {"most": 0.05}}"#, &[1.0, 2.0]));
    }

    #[test]
    fn a_rule_names_curves_of_the_paper_that_its_figures_need() {
        let paper = Paper::read().unwrap();
        for claim in &paper.claims {
            assert!(claim.decide.is_some() == claim.test.is_empty(), "{}", claim.id);
            for test in &claim.test {
                let names = [Some(&test.on), test.than.as_ref()];
                for (_, name) in names.into_iter().flatten().flat_map(|name| paper.series(name)) {
                    let curve = paper.curves.iter().find(|curve| curve.name == name);
                    let curve = curve.unwrap_or_else(|| panic!("{}: no curve {name}", claim.id));
                    assert!(claim.figures.iter().any(|f| curve.figures.contains(f)), "{}: {name}", claim.id);
                }
            }
        }
    }
}
