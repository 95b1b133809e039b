//! Study files, read to their cases or to all their errors.

use super::axes::{Axis, Settings};
use super::expand::{Keeping, MOST_RUNS, Study, StudyRun, choices};
use super::merge::RunErrors;
use super::names::{name_variations, run_folder, run_label, run_title};
use super::sampling::{
    DIMENSIONS, Distribution, SampleTable, Sampled, Substitute, find_sampled, points, substituted,
};
use super::variation::{Variation, find_variations};
use crate::case::{ByGeometry, Case, Overrides, build};
use crate::schema::{
    CaseError, CaseErrors, Chosen, Fault, Override, Reading, Report, SectionValues, Source, from_file,
    parse_document, read_section, read_sections, tables,
};
use crate::tables::{
    CASE_FILE, Kept, OF_STUDY, SAMPLES, SAMPLES_BY_DEFAULT, SAMPLING, SEED, STUDY, Sampling,
};
use rayon::prelude::*;
use std::collections::HashMap;
use std::path::Path;
use toml::de::DeTable;

impl Study {
    /// The study in the file `path`, with `overrides` replacing values of the file. Relative
    /// file names in it are relative to its folder.
    ///
    /// Errors: all of the file and of every case that it makes.
    pub fn read_with(path: &Path, overrides: &Overrides) -> Result<Self, CaseErrors> {
        Self::read_with_samples(path, overrides, None)
    }

    /// The same with the values of a table of samples.
    pub fn read_with_samples(
        path: &Path,
        overrides: &Overrides,
        table: Option<&SampleTable>,
    ) -> Result<Self, CaseErrors> {
        from_file(path, |text, name, folder| Self::parse_with_samples(text, name, folder, overrides, table))
    }

    /// The study written in `text`; errors call it `name`, relative file names are relative to
    /// `folder`.
    pub fn parse_with(
        text: &str,
        name: &str,
        folder: &Path,
        overrides: &Overrides,
    ) -> Result<Self, CaseErrors> {
        Self::parse_with_samples(text, name, folder, overrides, None)
    }

    /// The same with the values of `table`, a run for each of its rows (with every choice of the
    /// lists that the text has).
    pub fn parse_with_samples(
        text: &str,
        name: &str,
        folder: &Path,
        overrides: &Overrides,
        table: Option<&SampleTable>,
    ) -> Result<Self, CaseErrors> {
        let source = Source::of_file(name, text, &CASE_FILE);
        let mut report = Report::new(source.clone());
        let overrides = overrides.list(&mut report);
        let study = parse_document(text, &mut report)
            .and_then(|root| read_study(&source, root.get_ref(), folder, &overrides, table, &mut report));
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
    table: Option<&SampleTable>,
    report: &mut Report,
) -> Option<Study> {
    let section = match root.get_key_value(STUDY.name) {
        None => None,
        Some((name, value)) => tables(&STUDY, name.span(), value, report)?.into_iter().next(),
    };
    let reading = Reading { file: &CASE_FILE, overrides: &[], chosen: &Chosen::default(), defaults: &[] };
    let section = read_section(&STUDY, 1, section, reading, report);
    let drawn = drawn(root, &section, table, report);
    let root = &substituted(root, &drawn.values, report);
    let (mut variations, refused) = find_variations(root, overrides, report);
    name_variations(&mut variations);
    for (key, distribution) in drawn.keys.iter().zip(drawn.distributions) {
        let of_key = variations.iter_mut().filter(|variation| variation.key == *key);
        of_key.for_each(|variation| variation.distribution = Some(distribution.clone()));
    }
    if variations.is_empty() && report.is_clean() {
        report.add(nothing_varies(&source.name));
    }
    let settings = Settings::new(&section).drawing(drawn.keys);
    let axes = settings.axes(variations.clone(), report);
    let colour_axis = axes.as_ref().map_or(0, |axes| settings.colour_axis(axes, report));
    let combine = settings.combine;
    // If the lists cannot be combined, their elements are still read one by one.
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
    refuse_what_is_not_packed(&cases, report);
    let title = cases.first()?.title.clone();
    let keeping = if cases.first()?.output.run_folders { Keeping::Folders } else { Keeping::Packed };
    let count = plan.len();
    let runs = plan
        .into_iter()
        .zip(cases)
        .map(|((number, choice, label), case)| StudyRun {
            folder: run_folder(number, count),
            case: case.titled(&run_title(&title, &label)).in_its_folder(),
            number,
            choice,
            label,
        })
        .collect();
    Some(Study { title, combine, axes, colour_axis, keeping, runs, text: source.text.to_string() })
}

/// Keys whose values are drawn or come from a table, and these values.
#[derive(Default)]
struct Drawn {
    keys: Vec<String>,
    /// One for each key; none for a table.
    distributions: Vec<Distribution>,
    values: Vec<Substitute>,
}

fn drawn(root: &DeTable, section: &SectionValues, table: Option<&SampleTable>, report: &mut Report) -> Drawn {
    let sampled = find_sampled(root, report);
    let fault = |says: &str, help: &str| {
        Fault::of(STUDY.name, section.span.clone(), format!("`[study]`: {says}")).help(help)
    };
    if let Some(table) = table {
        if let Some(other) = sampled.first() {
            let says =
                format!("`{}`: a distribution cannot be combined with a table of samples", other.dotted);
            report.add(Fault::of(other.dotted.clone(), other.span.clone(), says));
        }
        return Drawn {
            keys: table.columns.iter().map(|(_, values)| values.dotted()).collect(),
            distributions: Vec::new(),
            values: table.columns.iter().map(|(_, values)| values.clone()).collect(),
        };
    }
    let given = section.get(SAMPLES);
    if sampled.is_empty() {
        if given.is_some() {
            let help = "such as friction = { normal = [0.3, 0.05] } in [contact]";
            report.add(fault("a number of samples is given, but no value is a distribution", help));
        }
        return Drawn::default();
    }
    let (samples, sampling) = (given.unwrap_or(SAMPLES_BY_DEFAULT), section.get(SAMPLING));
    let (sampling, seed) = (sampling.unwrap_or(Sampling::Sobol), section.get(SEED).unwrap_or(1));
    if sampling == Sampling::Sobol && sampled.len() > DIMENSIONS {
        let says = format!(
            "Sobol's sequence supports at most {DIMENSIONS} distributions; {} are given",
            sampled.len()
        );
        report.add(fault(&says, "use sampling = \"latin-hypercube\""));
        return Drawn::default();
    }
    let points = points(sampling, samples, sampled.len(), seed as u64);
    let of_key = |(i, key): (usize, &Sampled)| key.values(points.iter().map(|point| point[i]));
    Drawn {
        keys: sampled.iter().map(|key| key.dotted.clone()).collect(),
        distributions: sampled.iter().map(|key| key.distribution.clone()).collect(),
        values: sampled.iter().enumerate().map(of_key).collect(),
    }
}

fn nothing_varies(file: &str) -> Fault {
    Fault::new("nothing varies: in a study at least one value is a list or a distribution").help(format!(
        "such as friction = [0.1, 0.2] in [contact]; `railcrack run {file}` computes a single case"
    ))
}

fn plan(axes: &[Axis], report: &mut Report) -> Option<Plan> {
    let Some(choices) = choices(axes) else {
        let lengths: Vec<String> = axes.iter().map(|axis| axis.len().to_string()).collect();
        let span = axes.first().and_then(|axis| axis.variations.first()).map(|v| v.span.clone());
        let fault = Fault::new(format!("{} are more than {MOST_RUNS} runs", lengths.join(" x ")))
            .help("use shorter lists, [study] combine = \"zip\", or several studies");
        return report.refuse(Fault { span, ..fault });
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
    let sizes = ByGeometry::default();
    let read = |(_, choice, _): &(usize, Vec<usize>, String)| {
        let elements = axes.iter().zip(choice).flat_map(|(axis, &index)| {
            axis.variations.iter().map(move |variation| (variation.span.start, index))
        });
        let chosen = Chosen::new(elements.collect());
        let mut own = Report::new(source.clone());
        let reading = Reading { file: &CASE_FILE, overrides, chosen: &chosen, defaults: OF_STUDY };
        match build(read_sections(root, reading, &mut own), folder, &sizes, &mut own) {
            Some(case) if own.is_clean() => Ok(case),
            _ => Err(own.into_list()),
        }
    };
    let mut cases = Vec::with_capacity(plan.len());
    let read: Vec<Result<Case, Vec<CaseError>>> = plan.par_iter().map(read).collect();
    for ((number, _, label), read) in plan.iter().zip(read) {
        match read {
            Ok(case) => cases.push(case),
            Err(found) => errors.add(*number, label, found),
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

/// Packed runs consist of tables: nothing else is kept once a run folder is removed.
fn refuse_what_is_not_packed(cases: &[Case], report: &mut Report) {
    let is_more = |case: &&Case| {
        let output = &case.output;
        !output.run_folders && (output.is_shown() || output.faces != Kept::None || case.fields.every > 0)
    };
    if cases.iter().any(|case| is_more(&case)) {
        let says = "`output.run_folders = false` keeps growth and K of the runs, but no faces, fields, plots or pages";
        let help = "leave these out; `railcrack report DIR --run N` makes the page of a run when needed";
        report.add(Fault::new(says).help(help));
    }
}

/// Reports the first run that computes what another one computes.
fn report_repetitions(plan: &Plan, cases: &[Case], axes: &[Axis], report: &mut Report) {
    let mut known: HashMap<String, usize> = HashMap::new();
    let texts: Vec<String> = cases.par_iter().map(Case::to_toml).collect();
    for ((number, _, label), text) in plan.iter().zip(texts) {
        let Some(first) = known.insert(text, *number) else { continue };
        let span = axes.last().and_then(|axis| axis.variations.last()).map(|v| v.span.clone());
        let help = match axes {
            [_] => "a value is given twice",
            _ => "a value is given twice, or lists that belong together are combined in a product",
        };
        let message = format!("runs {first} and {number} of the study are the same ({label})");
        report.add(Fault { span, ..Fault::new(message).help(help) });
        return;
    }
}
