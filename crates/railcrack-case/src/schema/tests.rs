//! A file about ovens: the reader depends on nothing but the declaration.

use super::{
    Choice, Chosen, FileSchema, Reading, Report, Sections, Source, Word, choice, file_schema, first_file,
    integer, number, parse_document, positive, read_sections, section,
};

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Heat {
    Still,
    Fan,
}

super::read_by_word!(Heat);

impl Choice for Heat {
    const WORDS: &'static [(Self, Word)] =
        &[(Self::Still, Word::now("still", "no fan")), (Self::Fan, Word::now("fan", "moving air"))];
}

section! {
    OVEN "oven", Required, "An oven.";
    HEAT: Heat = choice("heat", "Motion of the air.");
    SPEED: f64 = number("speed_m_s", "m/s", positive(5.0), 1.0, "Speed of the fan.")
        .only_with(HEAT, "fan", "still air has no speed");
    TRAYS: usize = integer("trays", (1, 9), 1, "Number of trays.");
    GAP: f64 = number("gap_mm", "mm", positive(1e3), 50.0, "Distance of the trays.")
        .optional()
        .paired(TRAYS, "trays stand gap_mm apart");
}

static OVENS: FileSchema = FileSchema {
    title: "Ovens",
    sections: &[OVEN],
    beside: &[],
    introduction: "",
    preamble: "",
    start: "",
    list: "no lists here",
};

fn read(text: &str) -> Result<Sections, String> {
    let mut report = Report::new(Source::new("oven.toml", text));
    let root = parse_document(text, &mut report);
    let reading = Reading { file: &OVENS, overrides: &[], chosen: &Chosen::default(), defaults: &[] };
    let sections = root.map(|root| read_sections(root.get_ref(), reading, &mut report));
    match sections {
        Some(sections) if report.is_clean() => Ok(sections),
        _ => Err(report.into_errors().to_string()),
    }
}

#[test]
fn help_comes_from_the_declaration() {
    for (text, want) in [
        ("speed_m_s = 2.0", "needs heat = \"fan\" (still air has no speed: leave `speed_m_s` out)"),
        ("trays = [1, 2]", "not a list (no lists here)"),
        ("trays = 3", "`oven.trays = 3` needs it (trays stand gap_mm apart)"),
        ("gap_mm = 30", "`oven.gap_mm = 30` needs it (trays stand gap_mm apart)"),
        ("tray = 3", "nearest known key: `trays`"),
        ("heat = \"fun\"", "must be \"still\" or \"fan\" (nearest: \"fan\")"),
    ] {
        let errors = read(&format!("[oven]\n{text}\n")).unwrap_err();
        assert!(errors.contains(want), "{text}: {errors}");
    }
}

#[test]
fn values_are_typed_by_their_rows() {
    let sections = read("[oven]\nheat = \"fan\"\ntrays = 2\ngap_mm = 30\n").unwrap();
    let oven = sections.one(&OVEN).unwrap();
    assert_eq!((oven.get(HEAT), oven.get(SPEED)), (Some(Heat::Fan), Some(1.0)));
    assert_eq!((oven.get(TRAYS), oven.get(GAP)), (Some(2), Some(30.0)));
    assert_eq!((Heat::Still.word(), Heat::of_word("steam")), ("still", None));
}

#[test]
fn what_goes_together_is_in_the_schema_and_commented_out_at_first() {
    let schema = file_schema(&OVENS);
    let oven = &schema["properties"]["oven"];
    assert_eq!(oven["dependentRequired"]["gap_mm"][0], "trays");
    assert_eq!(oven["if"]["properties"]["trays"]["minimum"], 2);
    let first = first_file(&OVENS);
    assert!(first.contains("# trays = 1 ") && first.contains("# speed_m_s = 1.0 "), "{first}");
}
