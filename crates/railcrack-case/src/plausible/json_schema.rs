//! JSON Schema of a case with the usual ranges.

use super::ranges::USUAL;
use crate::tables;
use serde_json::{Value, json};

/// The JSON Schema (draft 2020-12) of a case file, for editors: `x-unit` has the unit of a number,
/// `x-usual` its usual range, whatever its sign.
#[must_use]
pub fn json_schema() -> Value {
    let mut schema = tables::json_schema();
    for usual in USUAL {
        for name in usual.keys {
            let Some((section, key)) = name.split_once('.') else { continue };
            let range = json!([usual.range.0, usual.range.1]);
            // A section is also that of a wheel.
            for outer in ["/properties", "/properties/wheel/items/properties"] {
                if let Some(section) = schema.pointer_mut(&format!("{outer}/{section}")) {
                    insert(section, key, &range);
                }
            }
        }
    }
    schema
}

/// The `range` of `key` in `section`, which is a table, several, or a table or false.
fn insert(section: &mut Value, key: &str, range: &Value) {
    for pointer in ["/properties", "/items/properties", "/anyOf/1/properties"] {
        let keys = section.pointer_mut(pointer).and_then(Value::as_object_mut);
        if let Some(of_key) = keys.and_then(|keys| keys.get_mut(key)).and_then(Value::as_object_mut) {
            of_key.insert("x-usual".into(), range.clone());
        }
    }
}
