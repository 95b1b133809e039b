//! The paper as data: `figures.toml`, `setups.toml` and `claims.toml`.

use crate::error::PaperError;
use crate::rolled::RolledRule;
use crate::rules::{SingleRule, Test};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toml::de::{DeTable, DeValue};

/// Number of main set-ups: both bodies, both directions of travel.
pub const MAIN: usize = 4;

/// The folder of this crate.
pub fn home() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Figures, set-ups and statements.
pub struct Paper {
    /// Groups of figures that vary the same input.
    pub groups: Vec<Group>,
    /// All figures with results.
    pub figures: Vec<Figure>,
    /// The curves of the figures.
    pub curves: Vec<PaperCurve>,
    /// The set-ups, the main ones first.
    pub setups: Vec<Setup>,
    /// The statements in the order of the paper.
    pub claims: Vec<Claim>,
    /// The statements about the plastic state.
    pub rolled: Vec<RolledClaim>,
    /// Curves that are compared, each with its words.
    pub series: BTreeMap<String, Vec<(String, String)>>,
}

/// Figures that vary the same input.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// The input that they vary.
    pub title: String,
    /// Their numbers, in order.
    pub figures: Vec<u8>,
}

/// Contents of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// K_I and K_II against the wheel position.
    Sif,
    /// Paths to scale.
    Paths,
    /// Stress against depth.
    Profile,
}

/// A figure of the paper.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Figure {
    /// Its number.
    pub number: u8,
    /// Its contents.
    pub kind: Kind,
    /// Its title.
    pub title: String,
    /// The curves that it shows.
    pub curves: Vec<String>,
    /// Words of curves that have others in this figure.
    #[serde(default)]
    pub legend: BTreeMap<String, String>,
}

/// One curve of the figures; several figures may show it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PaperCurve {
    /// Its name in file names and tables.
    pub name: String,
    /// Its words in legends.
    pub legend: String,
    /// Its case file in `cases`.
    pub case: String,
    /// Wheel–rail friction with the sign of the paper: positive is braking.
    pub wheel_friction: f64,
    /// Values that differ from those of the case file.
    #[serde(default)]
    pub set: Vec<String>,
    /// The figures that show it or need it as a reference.
    pub figures: Vec<u8>,
}

/// Direction of travel with respect to cracks of 15°, which lean towards +x as they go down.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Travel {
    /// The cracks lean along the travel: the wheel meets the mouth first, then passes over the tip.
    Along,
    /// They lean against it: the wheel passes over the tip first. Crack 9 of a network is met
    /// first.
    Against,
}

impl Travel {
    /// The sign of the velocity of the wheel in x.
    pub fn sign(self) -> f64 {
        match self {
            Self::Along => 1.0,
            Self::Against => -1.0,
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Along => "along",
            Self::Against => "against",
        }
    }
}

/// A stress that replaces the residual stress of the cases that have one.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OtherStress {
    /// Fig. 21 read as the plastic stress, which is then balanced.
    Plastic,
    /// The residual stress of a rolled rail, in this table.
    Rolled(String),
}

/// One choice of the inputs that the paper does not specify.
#[derive(Debug, Clone)]
pub struct Setup {
    /// Its name in files and tables: `block, along`.
    pub name: String,
    /// Its description.
    pub words: String,
    /// The set-up that it varies; none of a main one.
    pub varies: Option<String>,
    /// The direction of travel.
    pub travel: Travel,
    /// Its row of `setups.toml`.
    pub row: SetupRow,
}

/// A row of `setups.toml`: a set-up for both directions of travel.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SetupRow {
    name: String,
    words: String,
    varies: Option<String>,
    /// The figures that it is computed for.
    pub figures: Vec<u8>,
    /// Values of the case, after those of the set-up that it varies.
    #[serde(default)]
    pub set: Vec<String>,
    /// The curves that are other cases here than in the set-up that it varies; all if none given.
    pub curves: Option<Vec<String>>,
    /// The curves whose cracks grow; all if none given.
    pub grows: Option<Vec<String>>,
    /// Whether positive friction drags the rail against the travel.
    #[serde(default)]
    pub reversed_drag: bool,
    /// Whether its load steps are fixed.
    #[serde(default)]
    pub fixed_steps: bool,
    /// Whether K of an initial crack without stress is that of the set-up that it varies.
    #[serde(default)]
    pub same_k: bool,
    /// Its stress instead of Fig. 21.
    pub stress: Option<OtherStress>,
}

/// A statement of the paper and its rule.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// Its name.
    pub id: String,
    /// Where the paper says it.
    pub place: String,
    /// The figures whose runs decide it.
    pub figures: Vec<u8>,
    /// The statement, paraphrased.
    pub statement: String,
    /// When it counts as true.
    pub rule: String,
    /// The rule as tests, all of which must hold.
    #[serde(default)]
    pub test: Vec<Test>,
    /// A rule that occurs once, instead of tests.
    pub decide: Option<SingleRule>,
    /// The reason for the verdict, as far as known.
    #[serde(default)]
    pub why: String,
}

/// A statement about the plastic state.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RolledClaim {
    /// Its name.
    pub id: String,
    /// Where the paper says it.
    pub place: String,
    /// The statement, paraphrased.
    pub statement: String,
    /// When it counts as true.
    pub rule: String,
    /// The rule.
    pub decide: RolledRule,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Figures {
    group: Vec<Group>,
    figure: Vec<Figure>,
    curve: Vec<PaperCurve>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Setups {
    setup: Vec<SetupRow>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Claims {
    series: BTreeMap<String, Vec<(String, String)>>,
    claim: Vec<Claim>,
    rolled: Vec<RolledClaim>,
}

impl Paper {
    /// Reads the three files.
    ///
    /// Errors: one of them is damaged; the system refuses.
    pub fn read() -> Result<Self, PaperError> {
        let Figures { group, figure, curve } = read(&home().join("figures.toml"))?;
        let Setups { setup } = read(&home().join("setups.toml"))?;
        let Claims { series, claim, rolled } = read(&home().join("claims.toml"))?;
        let setups = both_ways(&setup);
        Ok(Self { groups: group, figures: figure, curves: curve, setups, claims: claim, rolled, series })
    }

    /// The numbers of the figures called `names`, `13` or `fig13`, each once and in order; all
    /// where there are none.
    ///
    /// Errors: a name that is no figure with results.
    pub fn figures_called(&self, names: &[String]) -> Result<Vec<u8>, PaperError> {
        let known: Vec<u8> = self.figures.iter().map(|figure| figure.number).collect();
        if names.is_empty() {
            return Ok(known);
        }
        let number = |name: &String| {
            let lower = name.to_lowercase();
            let number = lower.strip_prefix("fig").unwrap_or(&lower).parse().ok();
            number.filter(|number| known.contains(number)).ok_or_else(|| PaperError::UnknownFigure {
                given: name.clone(),
                accepted: known.iter().map(u8::to_string).collect::<Vec<_>>().join(", "),
            })
        };
        let mut numbers = names.iter().map(number).collect::<Result<Vec<u8>, _>>()?;
        numbers.sort_unstable();
        numbers.dedup();
        Ok(numbers)
    }

    /// Whether cracks grow in figure `number`.
    pub fn shows_paths(&self, number: u8) -> bool {
        self.figures.iter().any(|figure| figure.number == number && figure.kind == Kind::Paths)
    }

    /// The words of the curve or profile `name` in the legend of `figure`.
    pub fn legend<'a>(&'a self, figure: &'a Figure, name: &'a str) -> &'a str {
        let usual = || self.curves.iter().find(|curve| curve.name == name).map(|curve| curve.legend.as_str());
        figure.legend.get(name).map(String::as_str).or_else(usual).unwrap_or(name)
    }

    /// The curves `name` stands for, each with its words: those of a series, or one curve.
    pub fn series<'a>(&'a self, name: &'a str) -> Vec<(&'a str, &'a str)> {
        match self.series.get(name) {
            Some(series) => series.iter().map(|(words, curve)| (words.as_str(), curve.as_str())).collect(),
            None => vec![("", name)],
        }
    }
}

/// Every set-up for both directions of travel.
fn both_ways(rows: &[SetupRow]) -> Vec<Setup> {
    let both = |row: &SetupRow| {
        let parent = rows.iter().find(|parent| Some(&parent.name) == row.varies.as_ref());
        let first = parent.map_or(&[][..], |parent| &parent.set);
        let set = first.iter().chain(&row.set).cloned().collect::<Vec<_>>();
        [Travel::Along, Travel::Against].map(|travel| {
            let way = travel.word();
            Setup {
                name: format!("{}, {way}", row.name),
                words: format!("{}; cracks lean {way} the travel", row.words),
                varies: row.varies.as_ref().map(|parent| format!("{parent}, {way}")),
                travel,
                row: SetupRow { set: set.clone(), ..row.clone() },
            }
        })
    };
    rows.iter().flat_map(both).collect()
}

fn read<T: DeserializeOwned>(path: &Path) -> Result<T, PaperError> {
    let text = std::fs::read_to_string(path).map_err(railcrack_run::OutputError::io("read", path))?;
    let refused = |reason: String| PaperError::Table { path: path.to_path_buf(), reason };
    let table = DeTable::parse(&text).map_err(|fault| refused(fault.to_string()))?;
    serde_json::from_value(object(table.get_ref())).map_err(|fault| refused(fault.to_string()))
}

fn object(table: &DeTable) -> Value {
    let entry = |(key, value): (_, &toml::Spanned<DeValue>)| {
        let key: &toml::Spanned<std::borrow::Cow<str>> = key;
        (key.get_ref().to_string(), json(value.get_ref()))
    };
    Value::Object(table.iter().map(entry).collect::<Map<_, _>>())
}

/// `value` as JSON, which serde reads here: the TOML library of the workspace is compiled without
/// serde.
fn json(value: &DeValue) -> Value {
    match value {
        DeValue::String(text) => Value::String(text.to_string()),
        DeValue::Integer(number) => number.as_str().parse::<i64>().map_or(Value::Null, Value::from),
        DeValue::Float(number) => number.as_str().parse::<f64>().map_or(Value::Null, Value::from),
        DeValue::Boolean(is) => Value::Bool(*is),
        DeValue::Datetime(time) => Value::String(time.to_string()),
        DeValue::Array(items) => items.iter().map(|item| json(item.get_ref())).collect(),
        DeValue::Table(table) => object(table),
    }
}
