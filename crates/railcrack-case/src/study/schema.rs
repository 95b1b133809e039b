//! JSON Schema of a study.

use crate::plausible::json_schema;
use crate::schema::section_schema;
use crate::tables::{SECTIONS, STUDY};
use serde_json::{Map, Value, json};

/// The JSON Schema (draft 2020-12) of a study: that of a case, with a list allowed instead of any
/// value except the title, and with `[study]`.
#[must_use]
pub fn study_schema() -> Value {
    let mut schema = json_schema();
    schema["title"] = "Study file of railcrack".into();
    let Some(properties) = schema.get_mut("properties").and_then(Value::as_object_mut) else { return schema };
    for section in SECTIONS.iter().filter(|section| !section.name.is_empty()) {
        let Some(of_section) = properties.get_mut(section.name) else { continue };
        let of_table = if of_section.get("items").is_some() { &mut of_section["items"] } else { of_section };
        if let Some(keys) = of_table.get_mut("properties").and_then(Value::as_object_mut) {
            allow_lists(keys);
        }
        // Only the reader can check which values belong together: a list does not reveal its
        // smallest element.
        if let Some(table) = of_table.as_object_mut() {
            table.remove("if");
            table.remove("then");
        }
    }
    properties.insert(STUDY.name.into(), section_schema(&STUDY));
    schema
}

fn allow_lists(keys: &mut Map<String, Value>) {
    for schema in keys.values_mut() {
        let Some(keywords) = schema.as_object_mut() else { continue };
        let mut around = Map::new();
        for keyword in ["description", "default"] {
            if let Some(value) = keywords.remove(keyword) {
                around.insert(keyword.into(), value);
            }
        }
        let one = Value::Object(keywords.clone());
        around.insert("anyOf".into(), json!([one.clone(), { "type": "array", "items": one, "minItems": 1 }]));
        *schema = Value::Object(around);
    }
}
