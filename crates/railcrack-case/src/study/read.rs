//! From a study file to its cases, or to everything that is wrong with it.

use super::axes::{Axis, Settings};
use super::declare::STUDY;
use super::expand::{MOST_RUNS, Study, StudyRun, choices};
use super::merge::RunErrors;
use super::names::{run_folder, run_label, run_title};
use super::variation::{Variation, find_variations};
use crate::build::build;
use crate::chosen::{Chosen, Reading};
use crate::error::{CaseErrors, Fault, Report, Source};
use crate::overrides::Overrides;
use crate::read::{parse_document, read_sections, source_of, tables};
use crate::section::read_section;
use crate::validated::Case;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;
use toml::de::DeTable;

impl Study {
    /// The study in the file `path`, with `overrides` in place of what the file says. Relative file names in it are relative to its
    /// folder.
    ///
    /// Errors: everything that is wrong with the file and with every case that it makes.
    pub fn read_with(path: &Path, overrides: &Overrides) -> Result<Self, CaseErrors> {
        let name = path.display().to_string();
        let source = source_of(path, &name)?;
        Self::parse_with(&source.text, &name, path.parent().unwrap_or(Path::new("")), overrides)
    }

    /// The study written in `text`; errors call it `name`, relative file names are relative to `folder`.
    pub fn parse_with(
        text: &str,
        name: &str,
        folder: &Path,
        overrides: &Overrides,
    ) -> Result<Self, CaseErrors> {
        let source = Source { name: name.into(), text: Arc::from(text) };
        let mut report = Report::new(source.clone());
        let study = parse_document(text, &mut report)
            .and_then(|root| read_study(&source, root.get_ref(), folder, overrides, &mut report));
        match study {
            Some(study) if report.is_clean() => Ok(study),
            _ => Err(report.into_errors()),
        }
    }
}

/// Number, choice and label of every run.
type Plan = Vec<(usize, Vec<usize>, String)>;

fn read_study(
    source: &Source,
    root: &DeTable,
    folder: &Path,
    overrides: &Overrides,
    report: &mut Report,
) -> Option<Study> {
    let (variations, refused) = find_variations(root, overrides, report);
    if variations.is_empty() && report.is_clean() {
        report.add(nothing_varies(&source.name));
    }
    let section = match root.get_key_value(STUDY.name) {
        None => None,
        Some((name, value)) => tables(&STUDY, name.span(), value, report)?.into_iter().next(),
    };
    let nothing = Overrides::default();
    let reading = Reading { overrides: &nothing, chosen: &Chosen::default() };
    let section = read_section(&STUDY, 1, section, reading, report);
    let settings = Settings::new(&section);
    let axes = settings.axes(variations.clone(), report);
    let colour_axis = axes.as_ref().map_or(0, |axes| settings.colour_axis(axes, report));
    let combine = settings.combine;
    // Where the lists cannot be combined, their elements are still read, each by itself.
    let (axes, plan) = match axes.filter(|_| report.is_clean()) {
        Some(axes) => {
            let plan = plan(&axes, report)?;
            (axes, plan)
        }
        None => each_by_itself(variations),
    };
    let errors = RunErrors::new(refused);
    let cases = read_cases(root, source, folder, overrides, (&axes, &plan), errors, report)?;
    if !report.is_clean() {
        return None;
    }
    report_repetitions(&plan, &cases, &axes, report);
    let title = cases.first()?.title.clone();
    let count = plan.len();
    let runs = plan
        .into_iter()
        .zip(cases)
        .map(|((number, choice, label), case)| StudyRun {
            folder: run_folder(number, count, &axes, &choice),
            case: case.titled(&run_title(&title, &label)),
            number,
            choice,
            label,
        })
        .collect();
    Some(Study { title, combine, axes, colour_axis, runs, text: source.text.to_string() })
}

fn nothing_varies(file: &str) -> Fault {
    Fault {
        message: "nothing varies: a study has a list in place of at least one value".into(),
        help: Some(format!(
            "such as friction = [0.1, 0.2] in [contact]; `railcrack run {file}` computes a single case"
        )),
        ..Fault::default()
    }
}

fn plan(axes: &[Axis], report: &mut Report) -> Option<Plan> {
    let Some(choices) = choices(axes) else {
        let lengths: Vec<String> = axes.iter().map(|axis| axis.len().to_string()).collect();
        report.add(Fault {
            message: format!("{} are more than {MOST_RUNS} runs", lengths.join(" x ")),
            span: axes.first().and_then(|axis| axis.variations.first()).map(|v| v.span.clone()),
            help: Some("shorter lists, or [study] combine = \"zip\", or several studies".into()),
            ..Fault::default()
        });
        return None;
    };
    let labelled = |(i, choice): (usize, Vec<usize>)| (i + 1, run_label(axes, &choice), choice);
    Some(choices.into_iter().enumerate().map(labelled).map(|(i, label, choice)| (i, choice, label)).collect())
}

/// As many runs as the longest list has elements; shorter lists stay at their last one.
fn each_by_itself(variations: Vec<Variation>) -> (Vec<Axis>, Plan) {
    let axes: Vec<Axis> = variations.into_iter().map(|v| Axis { variations: vec![v] }).collect();
    let most = axes.iter().map(Axis::len).max().unwrap_or(1);
    let choice = |i: usize| axes.iter().map(|axis| i.min(axis.len() - 1)).collect();
    let plan = (0..most).map(|i| (i + 1, choice(i), String::new())).collect();
    (axes, plan)
}

/// The cases of all runs; none where one of them is wrong.
fn read_cases(
    root: &DeTable,
    source: &Source,
    folder: &Path,
    overrides: &Overrides,
    (axes, plan): (&[Axis], &Plan),
    mut errors: RunErrors,
    report: &mut Report,
) -> Option<Vec<Case>> {
    let mut cases = Vec::with_capacity(plan.len());
    for (number, choice, label) in plan {
        let elements = axes.iter().zip(choice).flat_map(|(axis, &index)| {
            axis.variations.iter().map(move |variation| (variation.span.start, index))
        });
        let chosen = Chosen::new(elements.collect());
        let mut own = Report::new(source.clone());
        let sections = read_sections(root, Reading { overrides, chosen: &chosen }, &mut own);
        match build(&sections, folder, &mut own) {
            Some(case) if own.is_clean() => cases.push(case),
            _ => errors.add(*number, label, own.into_list()),
        }
    }
    if cases.len() == plan.len() {
        return Some(cases);
    }
    let mut elements = Vec::new();
    for (place, axis) in axes.iter().enumerate() {
        for index in 0..axis.len() {
            let taken = plan.iter().filter(|(_, choice, _)| choice[place] == index).count();
            elements.extend(axis.variations.iter().map(|v| (v.elements[index].clone(), taken)));
        }
    }
    errors.report(plan.len(), &elements, report);
    None
}

/// Reports the first run that computes what another one computes.
fn report_repetitions(plan: &Plan, cases: &[Case], axes: &[Axis], report: &mut Report) {
    let mut known: HashMap<String, usize> = HashMap::new();
    for ((number, _, label), case) in plan.iter().zip(cases) {
        let Some(first) = known.insert(case.to_toml(), *number) else { continue };
        let span = axes.last().and_then(|axis| axis.variations.last()).map(|v| v.span.clone());
        report.add(Fault {
            message: format!("runs {first} and {number} of the study are the same ({label})"),
            span,
            help: Some(match axes {
                [_] => "a value is given twice".into(),
                _ => "a value is given twice, or lists that go together stand in a product".into(),
            }),
            ..Fault::default()
        });
        return;
    }
}
