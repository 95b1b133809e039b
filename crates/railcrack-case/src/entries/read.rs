//! Entries, read to an entry or to all errors of its file.

use super::entry::{Comparison, Entry, EntryValue, HowRead, Quantity, QuantityKind};
use super::tables::{
    CERTAINTY, COMPARE, CONDITIONS, DELTA_K, ENTRY_FILE, FROM, GRADE, HIGH, ID, IN_SPACE, KIND, LOW,
    MEASURED_HIGH, MEASURED_LOW, NAME, NOTE, NUMBER, OVER_FROM, OVER_STUDY, OVER_TO, PLACE_LOG_STD, QUANTITY,
    QUOTE, RATIO, READ, SOURCE, STUDY_FILE, TEXT, TO, TOP, VALUE,
};
use crate::schema::{
    CaseErrors, Chosen, KeyRow, Reading, Report, SectionValues, Sections, Source, from_file, parse_document,
    read_sections,
};
use std::path::Path;

impl Entry {
    /// The entry in the file `path`.
    ///
    /// Errors: all of the file, a file that cannot be read included.
    pub fn read(path: &Path) -> Result<Self, CaseErrors> {
        from_file(path, |text, name, _| Self::parse(text, name))
    }

    /// The entry written in `text`; errors call it `name`.
    ///
    /// Errors: all of the text.
    pub fn parse(text: &str, name: &str) -> Result<Self, CaseErrors> {
        let mut report = Report::new(Source::of_file(name, text, &ENTRY_FILE));
        let entry = parse_document(text, &mut report).and_then(|root| {
            let reading =
                Reading { file: &ENTRY_FILE, overrides: &[], chosen: &Chosen::default(), defaults: &[] };
            let sections = read_sections(root.get_ref(), reading, &mut report);
            of_sections(&sections, &mut report)
        });
        match entry {
            Some(entry) if report.is_clean() => Ok(entry),
            _ => Err(report.into_errors()),
        }
    }
}

fn of_sections(sections: &Sections, report: &mut Report) -> Option<Entry> {
    let top = sections.one(&TOP)?;
    let comparison = match sections.one(&COMPARE) {
        Some(section) => Some(comparison(section, report)?),
        None => None,
    };
    let grade = top.get(GRADE)?;
    if let (Some(section), false) = (sections.one(&COMPARE), grade.is_compared()) {
        let says = format!("the grade `{}` is not compared with the model", grade.word());
        return report
            .refuse(section.fault_of_all(says).help("leave [compare] out, or choose track, rig or law"));
    }
    let (read, certainty) = (top.get(READ)?, top.get(CERTAINTY)?);
    if (read == HowRead::Memory) != (certainty == 1) {
        let says = "and `read` disagree: what is known from memory has the certainty 1, and nothing else has";
        return report.refuse(top.fault(CERTAINTY, says));
    }
    Some(Entry {
        id: top.get(ID)?,
        grade,
        quantity: top.get(QUANTITY)?,
        conditions: top.get(CONDITIONS)?,
        source: top.get(SOURCE)?,
        read,
        certainty,
        quote: top.get(QUOTE),
        note: top.get(NOTE),
        values: sections.all(&VALUE).map(value).collect::<Option<Vec<EntryValue>>>()?,
        comparison,
    })
}

fn value(section: &SectionValues) -> Option<EntryValue> {
    let value = match (section.get(NUMBER), section.get(LOW), section.get(HIGH)) {
        (Some(number), ..) => number.to_string(),
        (None, Some(low), Some(high)) => format!("{low} to {high}"),
        _ => section.get(TEXT)?,
    };
    Some(EntryValue { name: section.get(NAME)?, value })
}

fn comparison(section: &SectionValues, report: &mut Report) -> Option<Comparison> {
    let measured = ascending(section, MEASURED_LOW, MEASURED_HIGH, report)?;
    let quantity = match section.get(KIND)? {
        QuantityKind::DepthRate => {
            let (from, to) = ascending(section, FROM, TO, report)?;
            Quantity::DepthRate { from, to }
        }
        QuantityKind::DepthRateRatio => Quantity::DepthRateRatio {
            depths: ascending(section, FROM, TO, report)?,
            over: ascending(section, OVER_FROM, OVER_TO, report)?,
        },
        QuantityKind::DepthPerCycle => {
            let (from, to) = ascending(section, FROM, TO, report)?;
            Quantity::DepthPerCycle { from, to }
        }
        QuantityKind::LifeRatio => {
            let (from, to) = ascending(section, FROM, TO, report)?;
            Quantity::LifeRatio { from, to }
        }
        QuantityKind::LawRate => {
            Quantity::LawRate { delta_k: section.get(DELTA_K)?, ratio: section.get(RATIO)? }
        }
        QuantityKind::LawExponent => Quantity::LawExponent,
    };
    Some(Comparison {
        quantity,
        study: section.get(STUDY_FILE)?,
        over_study: section.get(OVER_STUDY),
        study_in_space: section.get(IN_SPACE),
        measured,
        place_log_std: section.get(PLACE_LOG_STD),
    })
}

/// Two numbers of which the second is larger.
fn ascending(
    section: &SectionValues,
    low: KeyRow<f64>,
    high: KeyRow<f64>,
    report: &mut Report,
) -> Option<(f64, f64)> {
    let (from, to) = (section.get(low)?, section.get(high)?);
    if from < to {
        return Some((from, to));
    }
    report.refuse(section.fault(high, format!("must be more than {} = {from}", low.key.name)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::entries::Grade;

    const TEXT: &str = "id = \"T1\"\ngrade = \"track\"\nquantity = \"q\"\nconditions = \"c\"\nsource = \"s\"\nread = \"abstract\"\ncertainty = 2\n";
    const SCORE: &str = "[compare]\nkind = \"depth-rate\"\nstudy = \"net.toml\"\nlow = 0.1\nhigh = 0.2\nfrom_mm = 1.0\nto_mm = 2.0\n";

    #[test]
    fn an_entry() {
        let values = "[[value]]\nname = \"a\"\nnumber = 2.0\n[[value]]\nname = \"b\"\nlow = 1\nhigh = 2\n";
        let entry = Entry::parse(&format!("{TEXT}{SCORE}{values}"), "a.toml").unwrap();
        assert_eq!((entry.grade, entry.values[1].value.as_str()), (Grade::Track, "1 to 2"));
        let comparison = entry.comparison.clone().unwrap();
        assert_eq!(comparison.quantity, Quantity::DepthRate { from: 1.0, to: 2.0 });
        assert!(entry.is_scored());
        let remembered = TEXT.replace("abstract", "memory").replace("certainty = 2", "certainty = 1");
        assert!(!Entry::parse(&format!("{remembered}{SCORE}"), "a.toml").unwrap().is_scored());
    }

    #[test]
    fn wrong_entries_are_refused_with_the_reason() {
        for (text, says) in [
            (TEXT.replace("track", "rails"), "`grade = \"rails\"`: must be \"track\""),
            (TEXT.replace("source = \"s\"\n", ""), "`source` is missing"),
            (TEXT.replace("abstract", "memory"), "and `read` disagree"),
            (format!("{TEXT}mood = 1\n"), "`mood = 1`: unknown key"),
            (format!("{TEXT}{}", SCORE.replace("high = 0.2", "high = 0.05")), "must be more than low = 0.1"),
            (format!("{TEXT}{}", SCORE.replace("to_mm = 2.0\n", "")), "`compare.to_mm` is missing"),
            (format!("{}{SCORE}", TEXT.replace("track", "friction")), "is not compared with the model"),
            (format!("{TEXT}{SCORE}ratio = 0.1\n"), "ratio"),
        ] {
            let errors = Entry::parse(&text, "a.toml").unwrap_err();
            assert!(errors.to_string().contains(says), "{says}: {errors}");
        }
    }
}
