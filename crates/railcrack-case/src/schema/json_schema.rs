//! JSON Schema of a declared file, for editors.

use super::declaration::{
    FileSchema, Form, Key, Kind, NumberRange, OnlyWith, Presence, Preset, RangeEnd, Section, SectionPresence,
};
use serde_json::{Map, Value, json};

/// The JSON Schema (draft 2020-12) of a file.
pub(crate) fn file_schema(file: &FileSchema) -> Value {
    let mut properties = Map::new();
    let mut required = Vec::new();
    let mut alternatives = Vec::new();
    for section in file.sections {
        if section.name.is_empty() {
            for key in section.keys {
                properties.insert(key.name.into(), key_schema(key));
            }
            continue;
        }
        let schema = match section.presence {
            SectionPresence::Several => {
                json!({ "description": section.doc, "type": "array", "minItems": 1, "items": section_schema(section) })
            }
            SectionPresence::Repeated => {
                json!({ "description": section.doc, "type": "array", "minItems": 1, "items": section_schema(section) })
            }
            _ => section_schema(section),
        };
        properties.insert(section.name.into(), schema);
        match section.instead {
            Some(other) if section.must_be_written() => alternatives.push(json!({
                "oneOf": [{ "required": [section.name] }, { "required": [other] }]
            })),
            _ if section.must_be_written() => required.push(section.name),
            _ => {}
        }
    }
    let mut schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": file.title,
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    });
    if let (false, Some(schema)) = (alternatives.is_empty(), schema.as_object_mut()) {
        schema.insert("allOf".into(), alternatives.into());
    }
    schema
}

/// The JSON Schema of one table of a section.
pub(crate) fn section_schema(section: &Section) -> Value {
    let mut properties = Map::new();
    for key in section.keys {
        properties.insert(key.name.into(), key_schema(key));
    }
    for part in section.parts {
        let schema = section_schema(part);
        let schema = match part.off {
            Some(_) => json!({ "description": part.doc, "anyOf": [{ "const": false }, schema] }),
            None => schema,
        };
        properties.insert(part.own_name().into(), schema);
    }
    let needed = |key: &&Key| key.is_required() && !section.is_in_a_form(key);
    let is_always_required = |key: &&Key| needed(key) && key.only_with.is_none() && key.excused.is_none();
    let is_always = |part: &&Section| part.must_be_written() && part.instead.is_none();
    let parts = section.parts.iter().filter(is_always).map(Section::own_name);
    let required: Vec<&str> =
        section.keys.iter().filter(is_always_required).map(|k| k.name).chain(parts).collect();
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
        let at_times: Vec<Value> = section.keys.iter().filter(needed).filter_map(required_at_times).collect();
        if !at_times.is_empty() {
            schema.insert("allOf".into(), at_times.into());
        }
        for (key, pair) in section.keys.iter().filter_map(|key| Some((key.name, key.pair?))) {
            let default = section.key(pair.key).map(|other| other.presence.preset());
            let Some(Preset::Integer(default)) = default else { continue };
            let above = json!({ pair.key: { "minimum": default + 1 } });
            schema.insert("dependentRequired".into(), json!({ key: [pair.key] }));
            schema.insert("if".into(), json!({ "properties": above, "required": [pair.key] }));
            schema.insert("then".into(), json!({ "required": [key] }));
        }
    }
    schema
}

/// A key that is required with some choices of another one only.
fn required_at_times(key: &Key) -> Option<Value> {
    let chosen = |with: &OnlyWith| {
        let words: Vec<&str> = std::iter::once(&with.choice).chain(with.also).copied().collect();
        json!({ "properties": { with.key: { "enum": words } }, "required": [with.key] })
    };
    let required = json!({ "required": [key.name] });
    match (&key.only_with, &key.excused) {
        (Some(with), _) => Some(json!({ "if": chosen(with), "then": required })),
        (None, Some(with)) => Some(json!({ "if": chosen(with), "else": required })),
        (None, None) => None,
    }
}

/// All keys of this form that have no default, and none of the keys of another.
fn form_schema(section: &Section, form: &Form) -> Value {
    let required: Vec<&str> = section
        .keys
        .iter()
        .filter(|k| form.keys.contains(&k.name) && k.is_required())
        .map(|k| k.name)
        .collect();
    let others: Vec<Value> = section
        .forms
        .iter()
        .flat_map(|f| f.keys)
        .filter(|k| !form.admits(k))
        .map(|k| json!({ "required": [k] }))
        .collect();
    json!({ "required": required, "not": { "anyOf": others } })
}

/// The schema of a value of this kind.
fn kind_schema(kind: Kind) -> Value {
    match kind {
        Kind::Number { range, .. } => number_schema(range),
        Kind::NumberOr { range, word, .. } => json!({ "anyOf": [number_schema(range), { "const": word }] }),
        Kind::Integer { min, max } => json!({ "type": "integer", "minimum": min, "maximum": max }),
        Kind::Switch => json!({ "type": "boolean" }),
        Kind::Text => json!({ "type": "string", "maxLength": 200 }),
        Kind::LongText => json!({ "type": "string", "maxLength": Kind::LONG_TEXT }),
        Kind::Path { .. } => json!({ "type": "string", "minLength": 1 }),
        Kind::Choice(words) => {
            let words = words();
            let switches = || words.iter().filter(|word| word.switch.is_some());
            let names = words.iter().map(|word| Value::from(word.name));
            let all: Vec<Value> = names.chain(switches().map(|word| word.switch.into())).collect();
            let meanings: Vec<&str> = words.iter().chain(switches()).map(|word| word.doc).collect();
            json!({ "enum": all, "enumDescriptions": meanings })
        }
        Kind::Numbers { range, .. } => {
            json!({ "type": "array", "maxItems": Kind::MOST_NUMBERS, "items": number_schema(range) })
        }
        Kind::Points { .. } => {
            let pair =
                json!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 });
            json!({ "type": "array", "minItems": 2, "items": pair })
        }
        Kind::Groups { .. } => {
            json!({ "type": "array", "items": { "type": "array", "items": { "type": "string" }, "minItems": 2 } })
        }
    }
}

fn key_schema(key: &Key) -> Value {
    let mut schema = kind_schema(key.kind);
    schema["description"] = key.doc.into();
    // Not of the vocabulary: readers of a schema ignore such keywords, generators of classes use
    // them.
    if let Some(unit) = unit_of(key.kind) {
        schema["x-unit"] = unit.into();
    }
    if let Some(with) = &key.only_with {
        schema["x-only-with"] = with.shown().into();
    }
    if let Presence::Default(preset) = key.presence {
        // JSON has no infinity: such a default is left to the description.
        let value = match preset {
            Preset::Number(x) if x.is_finite() => Some(x.into()),
            Preset::Integer(n) => Some(n.into()),
            Preset::Text(text) => Some(text.into()),
            Preset::Switch(value) => Some(value.into()),
            Preset::Numbers(numbers) => Some(numbers.into()),
            Preset::Number(_) | Preset::Points(_) | Preset::Groups(_) => None,
        };
        if let Some(value) = value {
            schema["default"] = value;
        }
    }
    schema
}

/// The unit of the numbers of a key; none of words and pure numbers.
fn unit_of(kind: Kind) -> Option<&'static str> {
    match kind {
        Kind::Number { unit, .. }
        | Kind::NumberOr { unit, .. }
        | Kind::Numbers { unit, .. }
        | Kind::Points { unit, .. } => Some(unit).filter(|unit| !unit.is_empty()),
        _ => None,
    }
}

fn number_schema(range: NumberRange) -> Value {
    let mut schema = json!({ "type": "number" });
    let bounds = [
        match range.min {
            RangeEnd::Closed(min) => ("minimum", min),
            RangeEnd::Open(min) => ("exclusiveMinimum", min),
        },
        match range.max {
            RangeEnd::Closed(max) => ("maximum", max),
            RangeEnd::Open(max) => ("exclusiveMaximum", max),
        },
    ];
    for (name, bound) in bounds.into_iter().filter(|(_, bound)| bound.is_finite()) {
        schema[name] = bound.into();
    }
    schema
}
