//! The tables of ARCHITECTURE.md.

use std::collections::{BTreeMap, BTreeSet};

/// Who may import whom, and who must never reach whom.
pub struct Rules {
    rows: BTreeMap<String, Row>,
    promises: Vec<Promise>,
}

struct Row {
    may_import: BTreeSet<String>,
    stage: Stage,
}

/// Whether a module of the table exists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    Present,
    Planned,
}

struct Promise {
    from: String,
    never: BTreeSet<String>,
    extent: Extent,
}

/// How far a promise goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Extent {
    /// The module itself does not import it.
    Directly,
    /// Nor does anything that it imports.
    AtAll,
}

const TABLE: &str = "| module | may import | because |";
const CRATES: &str = "| crate | holds | may import |";
const PROMISES: &str = "| module | never | extent | because |";

impl Rules {
    /// Reads both tables. Panics where one is missing or a row is not understood: a rule nobody
    /// checks is none.
    pub fn parse(text: &str) -> Self {
        let mut rows = BTreeMap::new();
        for cells in table(text, TABLE) {
            let stage = if cells[0].contains("planned") { Stage::Planned } else { Stage::Present };
            let row = || Row { may_import: names(&cells[1]).collect(), stage };
            for module in names(&cells[0]) {
                assert!(rows.insert(module.clone(), row()).is_none(), "`{module}` has two rows");
            }
        }
        let promises = table(text, PROMISES).iter().flat_map(|cells| promises_of(cells)).collect();
        let rules = Self { rows, promises };
        for name in rules.all_names() {
            assert!(rules.rows.contains_key(name), "`{name}` has no row");
        }
        rules
    }

    pub fn allows(&self, module: &str, imported: &str) -> bool {
        self.rows.get(module).is_some_and(|row| row.may_import.contains(imported))
    }

    /// The modules that exist, or those that are planned.
    pub fn modules(&self, stage: Stage) -> BTreeSet<String> {
        self.rows.iter().filter(|(_, row)| row.stage == stage).map(|(name, _)| name.clone()).collect()
    }

    /// Modules that may import themselves through others.
    pub fn circles(&self) -> Vec<String> {
        let reaches_itself = |module: &&String| self.reached(module).contains(*module);
        self.rows.keys().filter(reaches_itself).map(|module| format!("{module} reaches itself")).collect()
    }

    /// Promises that the first table allows to break.
    pub fn broken_promises(&self) -> Vec<String> {
        let mut broken = Vec::new();
        for Promise { from, never, extent } in &self.promises {
            let reached = match extent {
                Extent::Directly => self.rows[from].may_import.clone(),
                Extent::AtAll => self.reached(from),
            };
            broken.extend(never.intersection(&reached).map(|module| format!("{from} may reach {module}")));
        }
        broken
    }

    /// Everything that `module` may import, itself or through others.
    fn reached(&self, module: &str) -> BTreeSet<String> {
        let mut reached = BTreeSet::new();
        let mut pending = vec![module];
        while let Some(next) = pending.pop() {
            for imported in &self.rows[next].may_import {
                if reached.insert(imported.clone()) {
                    pending.push(imported);
                }
            }
        }
        reached
    }

    fn all_names(&self) -> impl Iterator<Item = &String> {
        let imported = self.rows.values().flat_map(|row| &row.may_import);
        let promised = self.promises.iter().flat_map(|p| p.never.iter().chain([&p.from]));
        imported.chain(promised)
    }
}

fn promises_of(cells: &[String]) -> Vec<Promise> {
    let extent = match cells[2].as_str() {
        "directly" => Extent::Directly,
        "at all" => Extent::AtAll,
        other => panic!("extent `{other}`: `directly` or `at all`"),
    };
    names(&cells[0]).map(|from| Promise { from, never: names(&cells[1]).collect(), extent }).collect()
}

/// The crates that every crate of the table may import.
pub fn crates(text: &str) -> BTreeMap<String, BTreeSet<String>> {
    let row = |cells: Vec<String>| {
        let name = names(&cells[0]).next().expect("a crate in the first column");
        (name, names(&cells[2]).collect())
    };
    table(text, CRATES).into_iter().map(row).collect()
}

/// The names in the `[dependencies]` of a manifest, those for tests left out.
pub fn dependencies(manifest: &str) -> BTreeSet<String> {
    let section = manifest.lines().skip_while(|line| line.trim() != "[dependencies]").skip(1);
    let lines = section.take_while(|line| !line.starts_with('['));
    lines.filter_map(|line| line.split_once('=')).map(|(name, _)| name.trim().to_owned()).collect()
}

/// The rows under `heading` and its ruler, cell by cell.
pub fn table(text: &str, heading: &str) -> Vec<Vec<String>> {
    let columns = heading.matches('|').count() - 1;
    let rows = text.lines().skip_while(|line| line.trim() != heading).skip(2);
    let rows: Vec<Vec<String>> = rows
        .take_while(|line| line.starts_with('|'))
        .map(|line| line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect())
        .collect();
    assert!(!rows.is_empty(), "ARCHITECTURE.md has no table `{heading}`");
    assert!(rows.iter().all(|row| row.len() == columns), "a row of `{heading}` has not {columns} cells");
    rows
}

/// The names between backticks.
pub fn names(cell: &str) -> impl Iterator<Item = String> {
    cell.split('`').skip(1).step_by(2).map(str::to_owned)
}

const SAMPLE: &str = "
| module | may import | because |
|---|---|---|
| `math` | nothing | |
| `crack`, `mesh` (planned) | `math` | |
| `contact` | `math`, `crack` | |
| `fatigue` | `contact` | |

| module | never | extent | because |
|---|---|---|---|
| `contact` | `mesh` | at all | |
| `fatigue` | `crack` | directly | |
";

#[test]
fn promises_reach_as_far_as_they_say() {
    let rules = Rules::parse(SAMPLE);
    assert!(rules.allows("contact", "crack") && !rules.allows("crack", "contact"));
    assert_eq!((rules.circles(), rules.broken_promises()), (vec![], vec![]));
    let farther = Rules::parse(&SAMPLE.replace("| directly |", "| at all |"));
    assert_eq!(farther.broken_promises(), ["fatigue may reach crack"]);
    let circle = Rules::parse(&SAMPLE.replace("nothing", "`fatigue`"));
    assert!(circle.circles().contains(&"math reaches itself".to_owned()));
}

#[test]
#[should_panic(expected = "`mash` has no row")]
fn a_name_without_a_row_is_refused() {
    Rules::parse(&SAMPLE.replace("| `mesh` | at all", "| `mash` | at all"));
}
