//! JSON Schema of the case file, for editors.

use super::sections::SECTIONS;
use super::table::{
    Form, Key, Kind, NumberRange, Presence, Preset, RangeEnd, Section, SectionPresence, available,
};
use serde_json::{Map, Value, json};

/// The JSON Schema (draft 2020-12) of a case file.
pub fn json_schema() -> Value {
    let mut properties = Map::new();
    let mut required = Vec::new();
    for section in SECTIONS {
        if section.name.is_empty() {
            for key in section.keys {
                properties.insert(key.name.into(), key_schema(key));
            }
            continue;
        }
        let schema = match section.presence {
            SectionPresence::Repeated => {
                json!({ "description": section.doc, "type": "array", "minItems": 1, "items": section_schema(section) })
            }
            _ => section_schema(section),
        };
        properties.insert(section.name.into(), schema);
        if matches!(section.presence, SectionPresence::Required | SectionPresence::Repeated) {
            required.push(section.name);
        }
    }
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Case file of railcrack",
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

pub(super) fn section_schema(section: &Section) -> Value {
    let mut properties = Map::new();
    for key in section.keys.iter().filter(|k| section.offers(k)) {
        properties.insert(key.name.into(), key_schema(key));
    }
    let in_a_form = |key: &Key| section.forms.iter().any(|f| f.keys.contains(&key.name));
    let required: Vec<&str> =
        section.keys.iter().filter(|k| is_required(k) && !in_a_form(k)).map(|k| k.name).collect();
    let mut schema = json!({
        "description": section.doc,
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    });
    if let Some(schema) = schema.as_object_mut() {
        if !section.forms.is_empty() {
            let forms: Vec<Value> = section.forms.iter().map(|f| form_schema(section, f)).collect();
            schema.insert("oneOf".into(), forms.into());
        }
        if section.key("spacing_mm").is_some() {
            schema.insert("dependentRequired".into(), json!({ "spacing_mm": ["count"] }));
            schema.insert(
                "if".into(),
                json!({ "properties": { "count": { "minimum": 2 } }, "required": ["count"] }),
            );
            schema.insert("then".into(), json!({ "required": ["spacing_mm"] }));
        }
    }
    schema
}

/// All keys of this form that have no default, and none of the keys of another.
fn form_schema(section: &Section, form: &Form) -> Value {
    let required: Vec<&str> = section
        .keys
        .iter()
        .filter(|k| form.keys.contains(&k.name) && is_required(k))
        .map(|k| k.name)
        .collect();
    let others: Vec<Value> = section
        .forms
        .iter()
        .flat_map(|f| f.keys)
        .filter(|k| !form.keys.contains(k))
        .map(|k| json!({ "required": [k] }))
        .collect();
    json!({ "required": required, "not": { "anyOf": others } })
}

fn is_required(key: &Key) -> bool {
    matches!(key.presence, Presence::Required(_))
}

fn key_schema(key: &Key) -> Value {
    let mut schema = Map::new();
    schema.insert("description".into(), key.doc.into());
    match key.kind {
        Kind::Number { range, .. } => {
            schema.insert("type".into(), "number".into());
            insert_range(&mut schema, range);
        }
        Kind::Integer { min, max } => {
            schema.insert("type".into(), "integer".into());
            schema.insert("minimum".into(), min.into());
            schema.insert("maximum".into(), max.into());
        }
        Kind::Text => {
            schema.insert("type".into(), "string".into());
            schema.insert("maxLength".into(), 200.into());
        }
        Kind::Path => {
            schema.insert("type".into(), "string".into());
            schema.insert("minLength".into(), 1.into());
        }
        Kind::Choice(choices) => {
            let names: Vec<&str> = available(choices).map(|c| c.name).collect();
            schema.insert("enum".into(), names.into());
        }
        Kind::Numbers { range, .. } => {
            let mut number = Map::new();
            number.insert("type".into(), "number".into());
            insert_range(&mut number, range);
            schema.insert("type".into(), "array".into());
            schema.insert("maxItems".into(), Kind::MOST_NUMBERS.into());
            schema.insert("items".into(), Value::Object(number));
        }
        Kind::Points => {
            schema.insert("type".into(), "array".into());
            schema.insert("minItems".into(), 2.into());
            let number = json!({ "type": "number" });
            let pair = json!({ "type": "array", "items": number, "minItems": 2, "maxItems": 2 });
            schema.insert("items".into(), pair);
        }
        Kind::Groups => {
            schema.insert("type".into(), "array".into());
            let group = json!({ "type": "array", "items": { "type": "string" }, "minItems": 2 });
            schema.insert("items".into(), group);
        }
    }
    if let Presence::Default(preset) = key.presence {
        // JSON has no infinity: such a default is left to the description.
        match preset {
            Preset::Number(x) if x.is_finite() => schema.insert("default".into(), x.into()),
            Preset::Integer(n) => schema.insert("default".into(), n.into()),
            Preset::Text(text) => schema.insert("default".into(), text.into()),
            Preset::Numbers(numbers) => schema.insert("default".into(), numbers.into()),
            Preset::Number(_) | Preset::Points(_) | Preset::Groups(_) => None,
        };
    }
    Value::Object(schema)
}

fn insert_range(schema: &mut Map<String, Value>, range: NumberRange) {
    let mut insert = |name: &str, bound: f64| {
        if bound.is_finite() {
            schema.insert(name.into(), bound.into());
        }
    };
    match range.min {
        RangeEnd::Closed(min) => insert("minimum", min),
        RangeEnd::Open(min) => insert("exclusiveMinimum", min),
    }
    match range.max {
        RangeEnd::Closed(max) => insert("maximum", max),
        RangeEnd::Open(max) => insert("exclusiveMaximum", max),
    }
}
