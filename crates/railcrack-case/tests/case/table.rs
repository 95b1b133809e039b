//! Pages, schemas and files derived from the table of keys.

use railcrack_case::Choice;
use railcrack_case::{Engine, Kind, Presence, Preset, SECTIONS, Section, json_schema, markdown};
use serde_json::json;

#[test]
fn the_committed_page_is_the_generated_one() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/case-file.md");
    let page = std::fs::read_to_string(path).unwrap();
    if page != markdown() {
        let fresh = concat!(env!("CARGO_TARGET_TMPDIR"), "/case-file.md");
        std::fs::write(fresh, markdown()).unwrap();
        panic!("docs/case-file.md is out of date; the new page is {fresh}");
    }
}

#[test]
fn names_are_unique_and_forms_name_keys() {
    for (i, section) in SECTIONS.iter().enumerate() {
        assert!(SECTIONS[..i].iter().all(|s| s.name != section.name), "{}", section.name);
        for (j, key) in section.keys.iter().enumerate() {
            assert!(section.keys[..j].iter().all(|k| k.name != key.name), "{}", key.name);
            assert!(key.doc.ends_with('.') && !key.doc.contains('\n'), "{}: {}", key.name, key.doc);
        }
        let of_forms = section.forms.iter().flat_map(|f| f.keys).copied();
        let pairs = section.keys.iter().filter_map(|key| Some(key.pair?.key));
        for name in of_forms.chain(pairs) {
            assert!(section.key(name).is_some(), "{name}");
        }
        for with in section.keys.iter().filter_map(|key| key.only_with) {
            let Some(Kind::Choice(words)) = section.key(with.key).map(|k| k.kind) else { panic!("{with:?}") };
            for choice in std::iter::once(&with.choice).chain(with.also) {
                assert!(words().iter().any(|word| word.name == *choice), "{with:?}");
            }
        }
    }
}

/// JSON has no infinity.
fn infinite(preset: Preset) -> bool {
    matches!(preset, Preset::Number(value) if value.is_infinite())
}

#[test]
fn the_schema_has_every_key() {
    let schema = json_schema();
    let keys_of = |section: &Section| {
        let properties = if section.name.is_empty() {
            &schema["properties"]
        } else {
            let of_section = &schema["properties"][section.name];
            if of_section["type"] == "array" {
                &of_section["items"]["properties"]
            } else {
                &of_section["properties"]
            }
        };
        properties.clone()
    };
    for section in SECTIONS {
        for key in section.keys {
            let found = &keys_of(section)[key.name];
            assert_eq!(found["description"], json!(key.doc), "{}.{}", section.name, key.name);
            let has_default =
                !infinite(key.presence.preset()) && matches!(key.presence, Presence::Default(_));
            assert_eq!(found.get("default").is_some(), has_default, "{}", key.name);
        }
    }
    let alternatives = json!([{ "required": ["contact"] }, { "required": ["wheel"] }]);
    assert_eq!((&schema["required"], &schema["allOf"][0]["oneOf"]), (&json!(["crack"]), &alternatives));
    assert_eq!(schema["additionalProperties"], json!(false));
    assert_eq!(schema["$schema"], json!("https://json-schema.org/draft/2020-12/schema"));
}

#[test]
fn the_schema_says_what_the_reader_accepts() {
    let schema = json_schema();
    let key = |section: &str, key: &str| schema["properties"][section]["properties"][key].clone();
    assert_eq!(key("solver", "engine")["enum"], json!(["xfem", "dislocation", "space"]));
    assert_eq!(key("rail", "sides")["enumDescriptions"][0], json!("no traction"));
    let pressure = key("contact", "peak_pressure_mpa");
    assert_eq!((&pressure["x-unit"], &pressure["x-usual"]), (&json!("MPa"), &json!([50.0, 4000.0])));
    let of_wheel = &schema["properties"]["wheel"]["items"]["properties"]["contact"]["properties"];
    assert_eq!(of_wheel["peak_pressure_mpa"]["x-usual"], pressure["x-usual"]);
    assert_eq!(key("growth", "increment")["minimum"], json!(1e-4));
    assert_eq!(key("growth", "increment")["maximum"], json!(0.5));
    assert_eq!(key("passage", "positions")["minimum"], json!(2));
    assert_eq!(key("rail", "bottom")["enum"], json!(["clamped", "rollers"]));
    assert_eq!(schema["properties"]["plastic_stress"]["required"], json!([]));
    let contact = &schema["properties"]["contact"];
    assert_eq!(contact["required"], json!([]));
    let kind = |word: &str| json!({ "properties": { "kind": { "enum": [word] } }, "required": ["kind"] });
    assert_eq!(contact["allOf"][0], json!({ "if": kind("table"), "else": { "required": ["friction"] } }));
    assert_eq!(contact["allOf"][1], json!({ "if": kind("carter"), "then": { "required": ["traction"] } }));
    assert_eq!(contact["oneOf"][1]["required"], json!(["line_load_n_per_mm", "wheel_radius_mm"]));
}

#[test]
fn every_engine_that_a_case_may_name_is_listed() {
    let solver = SECTIONS.iter().find(|section| section.name == "solver").unwrap();
    let Kind::Choice(words) = solver.key("engine").unwrap().kind else { panic!("engine is a choice") };
    let listed: Vec<&str> = Engine::WORDS.iter().map(|(_, word)| word.name).collect();
    assert_eq!(words().iter().map(|word| word.name).collect::<Vec<_>>(), listed);
}
