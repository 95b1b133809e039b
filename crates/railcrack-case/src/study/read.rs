//! Study files, read to their cases or to all their errors.

use super::axes::{Axis, Settings};
use super::expand::{MOST_RUNS, Study, StudyRun, choices};
use super::merge::RunErrors;
use super::names::{name_variations, run_folder, run_label, run_title};
use super::variation::{Variation, find_variations};
use crate::case::{Case, Overrides, build};
use crate::schema::{
    CaseErrors, Chosen, Fault, Override, Reading, Report, Source, parse_document, read_file, read_section,
    read_sections, tables,
};
use crate::tables::{CASE_FILE, STUDY};
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;
use toml::de::DeTable;

impl Study {
    /// The study in the file `path`, with `overrides` in place of the values in the file. Relative
    /// file names in it are relative to its folder.
    ///
    /// Errors: all of the file and of every case that it makes.
    pub fn read_with(path: &Path, overrides: &Overrides) -> Result<Self, CaseErrors> {
        let source = read_file(path)?;
        Self::parse_with(&source.text, &source.name, path.parent().unwrap_or(Path::new("")), overrides)
    }

    /// The study written in `text`; errors call it `name`, relative file names are relative to
    /// `folder`.
    pub fn parse_with(
        text: &str,
        name: &str,
        folder: &Path,
        overrides: &Overrides,
    ) -> Result<Self, CaseErrors> {
        let source = Source { name: name.into(), text: Arc::from(text) };
        let mut report = Report::new(source.clone());
        let study = parse_document(text, &mut report)
            .and_then(|root| read_study(&source, root.get_ref(), folder, &overrides.list(), &mut report));
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
    overrides: &[Override],
    report: &mut Report,
) -> Option<Study> {
    let (mut variations, refused) = find_variations(root, overrides, report);
    name_variations(&mut variations);
    if variations.is_empty() && report.is_clean() {
        report.add(nothing_varies(&source.name));
    }
    let section = match root.get_key_value(STUDY.name) {
        None => None,
        Some((name, value)) => tables(&STUDY, name.span(), value, report)?.into_iter().next(),
    };
    let reading = Reading { file: &CASE_FILE, overrides: &[], chosen: &Chosen::default() };
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
    Fault::new("nothing varies: a study has a list in place of at least one value").help(format!(
        "such as friction = [0.1, 0.2] in [contact]; `railcrack run {file}` computes a single case"
    ))
}

fn plan(axes: &[Axis], report: &mut Report) -> Option<Plan> {
    let Some(choices) = choices(axes) else {
        let lengths: Vec<String> = axes.iter().map(|axis| axis.len().to_string()).collect();
        let span = axes.first().and_then(|axis| axis.variations.first()).map(|v| v.span.clone());
        let fault = Fault::new(format!("{} are more than {MOST_RUNS} runs", lengths.join(" x ")))
            .help("shorter lists, or [study] combine = \"zip\", or several studies");
        report.add(Fault { span, ..fault });
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
    overrides: &[Override],
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
        let reading = Reading { file: &CASE_FILE, overrides, chosen: &chosen };
        match build(read_sections(root, reading, &mut own), folder, &mut own) {
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
        let help = match axes {
            [_] => "a value is given twice",
            _ => "a value is given twice, or lists that go together stand in a product",
        };
        let message = format!("runs {first} and {number} of the study are the same ({label})");
        report.add(Fault { span, ..Fault::new(message).help(help) });
        return;
    }
}
