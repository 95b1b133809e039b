//! How the lists of a study are combined.

use super::variation::Variation;
use crate::schema::{Fault, KeyRow, Report, SectionValues, nearest};
use crate::tables::{COLOUR_BY, COMBINE, Combine, TOGETHER};
use std::fmt::Display;
use std::ops::Range;

/// Keys that vary together: one direction of a study. Their lists are of one length.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The keys, in the order of the file; at least one.
    pub variations: Vec<Variation>,
}

impl Axis {
    /// Number of its values; at least one.
    #[must_use]
    pub fn len(&self) -> usize {
        self.variations.first().map_or(0, |variation| variation.values.len())
    }

    /// Whether it has no value, which does not occur in a study.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The settings of `[study]`.
pub(super) struct Settings<'a> {
    section: &'a SectionValues,
    pub combine: Combine,
    /// Keys whose values are sampled, as one axis.
    drawn: Vec<String>,
}

impl<'a> Settings<'a> {
    pub fn new(section: &'a SectionValues) -> Self {
        Self { section, combine: section.get(COMBINE).unwrap_or(Combine::Product), drawn: Vec::new() }
    }

    /// The same where the values of the keys `drawn` are samples.
    pub fn drawing(self, drawn: Vec<String>) -> Self {
        Self { drawn, ..self }
    }

    /// The axes of a study, in the order of the file; none if there is an error, which is added to
    /// `report`.
    pub fn axes(&self, variations: Vec<Variation>, report: &mut Report) -> Option<Vec<Axis>> {
        let groups = self.groups(&variations, report)?;
        let mut axes: Vec<(usize, Axis)> = Vec::new();
        for (i, variation) in variations.into_iter().enumerate() {
            let group = groups.iter().position(|group| group.contains(&i));
            let place = group.unwrap_or(groups.len() + i);
            match axes.iter_mut().find(|(of, _)| *of == place) {
                Some((_, axis)) => axis.variations.push(variation),
                None => axes.push((place, Axis { variations: vec![variation] })),
            }
        }
        let mut equal = true;
        for (_, axis) in &axes {
            equal &= self.are_of_one_length(&axis.variations, report);
        }
        equal.then(|| axes.into_iter().map(|(_, axis)| axis).collect())
    }

    /// Indices of the variations that are combined element by element.
    fn groups(&self, variations: &[Variation], report: &mut Report) -> Option<Vec<Vec<usize>>> {
        let entry = self.section.entry(TOGETHER);
        let written = self.section.get(TOGETHER).unwrap_or_default();
        let span = self.section.span_of(TOGETHER);
        if self.combine == Combine::Zip {
            if entry.is_some() {
                let says = "in a zip, all lists are combined element by element";
                return report.refuse(
                    self.fault(TOGETHER, span, says).help("leave it out, or use combine = \"product\""),
                );
            }
            return Some(vec![(0..variations.len()).collect()]);
        }
        let is_drawn = |(_, variation): &(usize, &Variation)| self.drawn.contains(&variation.key);
        let drawn: Vec<usize> = variations.iter().enumerate().filter(is_drawn).map(|(i, _)| i).collect();
        let mut groups: Vec<Vec<usize>> = if drawn.is_empty() { Vec::new() } else { vec![drawn] };
        let mut clean = true;
        for (group, keys) in written.iter().enumerate() {
            let span = entry.and_then(|entry| entry.parts.get(group).cloned()).unwrap_or(span.clone());
            let mut members = Vec::new();
            for key in keys {
                let Some(i) = self.find(TOGETHER, key, span.clone(), variations, report) else {
                    clean = false;
                    continue;
                };
                if members.contains(&i) || groups.iter().any(|group| group.contains(&i)) {
                    let says = format!("`{key}` is named twice");
                    report.add(self.fault(TOGETHER, span.clone(), says).help("a key belongs to one group"));
                    clean = false;
                }
                members.push(i);
            }
            groups.push(members);
        }
        clean.then_some(groups)
    }

    /// The axis that `colour_by` names; the first one where it is not given.
    pub fn colour_axis(&self, axes: &[Axis], report: &mut Report) -> usize {
        let Some(key) = self.section.get(COLOUR_BY) else { return 0 };
        let variations: Vec<Variation> = axes.iter().flat_map(|axis| axis.variations.clone()).collect();
        let span = self.section.span_of(COLOUR_BY);
        let Some(i) = self.find(COLOUR_BY, &key, span, &variations, report) else { return 0 };
        let key = &variations[i].key;
        axes.iter().position(|axis| axis.variations.iter().any(|v| v.key == *key)).unwrap_or(0)
    }

    /// The variation that a key of `[study]` names; if there is only one crack, `crack.` refers to
    /// it.
    fn find<T>(
        &self,
        of: KeyRow<T>,
        key: &str,
        span: Range<usize>,
        variations: &[Variation],
        report: &mut Report,
    ) -> Option<usize> {
        let numbered = key.replacen("crack.", "crack[1].", 1);
        let is_only_crack = !variations.iter().any(|v| v.key.starts_with("crack[2]"));
        let is_it = |v: &Variation| v.key == key || (is_only_crack && v.key == numbered);
        let found = variations.iter().position(is_it);
        if found.is_none() {
            let near = nearest(key, variations.iter().map(|v| v.key.as_str())).unwrap_or_default();
            let all: Vec<&str> = variations.iter().map(|v| v.key.as_str()).collect();
            let help = format!("nearest: `{near}`; varying keys: {}", all.join(", "));
            report.add(self.fault(of, span, format!("`{key}` does not vary in this study")).help(help));
        }
        found
    }

    fn are_of_one_length(&self, variations: &[Variation], report: &mut Report) -> bool {
        let Some((first, others)) = variations.split_first() else { return true };
        let mut equal = true;
        for other in others.iter().filter(|other| other.values.len() != first.values.len()) {
            equal = false;
            let message = format!(
                "`{}` has {} values and `{}` has {}: lists that are combined element by element must have the same length",
                other.key,
                other.values.len(),
                first.key,
                first.values.len()
            );
            let help = match self.combine {
                Combine::Zip => "[study] combine = \"product\" combines lists of any length",
                Combine::Product => "[study] together lists the keys to be combined element by element",
            };
            let fault = Fault::of(other.key.clone(), other.span.clone(), message).help(help);
            report.add(fault.also(first.span.clone(), "the other list"));
        }
        equal
    }

    fn fault<T>(&self, row: KeyRow<T>, span: Range<usize>, says: impl Display) -> Fault {
        let key = self.section.dotted(row.key.name);
        Fault::of(key.clone(), span, format!("`{key}`: {says}"))
    }
}
