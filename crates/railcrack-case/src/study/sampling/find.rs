//! Distributions given instead of values.

use super::distribution::{ACCEPTED, Distribution};
use super::substitute::Substitute;
use crate::schema::{Fault, Kind, Report};
use crate::study::tables::{TableOf, all_tables};
use std::ops::Range;
use toml::de::{DeTable, DeValue};

/// A key whose values are drawn.
#[derive(Debug, Clone)]
pub(in crate::study) struct Sampled {
    /// Section, number of the table within it (from 1) and key.
    place: (&'static str, usize, &'static str),
    /// Its name with its section.
    pub dotted: String,
    pub span: Range<usize>,
    pub distribution: Distribution,
}

impl Sampled {
    /// Its values at the shares `u` of (0, 1).
    pub fn values(&self, u: impl Iterator<Item = f64>) -> Substitute {
        let (section, number, key) = self.place;
        let values = u.map(|u| self.distribution.value(u)).collect();
        Substitute { section, number, key, values, span: Some(self.span.clone()) }
    }
}

/// Whether a distribution is given instead of a value in the document `root`.
pub(in crate::study) fn is_sampled(root: &DeTable) -> bool {
    !places(root).is_empty()
}

/// The distributions of the document `root`, in the order of the file; errors are added to
/// `report`.
pub(in crate::study) fn find_sampled(root: &DeTable, report: &mut Report) -> Vec<Sampled> {
    let text = report.source.text.clone();
    let mut found = Vec::new();
    for (place, dotted, span, kind, table) in places(root) {
        match Distribution::read(table, matches!(kind, Kind::Number { .. }), &text) {
            Ok(distribution) => found.push(Sampled { place, dotted, span, distribution }),
            Err(says) => {
                let message = format!("`{dotted} = {}`: {says}", report.shown(&span));
                report.add(Fault::of(dotted, span, message).help(format!("a distribution is {ACCEPTED}")));
            }
        }
    }
    found.sort_by_key(|sampled| sampled.span.start);
    found
}

type Place<'d, 'i> = ((&'static str, usize, &'static str), String, Range<usize>, Kind, &'d DeTable<'i>);

fn places<'d, 'i>(root: &'d DeTable<'i>) -> Vec<Place<'d, 'i>> {
    let mut places = Vec::new();
    for TableOf { section, number, path, table } in all_tables(root) {
        if section.name.is_empty() {
            continue;
        }
        for (name, value) in table {
            let (Some(key), DeValue::Table(of_key)) = (section.key(name.get_ref()), value.get_ref()) else {
                continue;
            };
            let takes_one =
                !matches!(key.kind, Kind::Numbers { .. } | Kind::Points { .. } | Kind::Groups { .. });
            if takes_one {
                let dotted = format!("{path}.{}", key.name);
                let place = (section.name, number, key.name);
                places.push((place, dotted, value.span(), key.kind, of_key));
            }
        }
    }
    places
}
