//! The data of an answer as JSON, and the schema of it.

use std::collections::BTreeSet;

use schemars::{JsonSchema, Schema, SchemaGenerator, generate::SchemaSettings};
use serde::Serialize;
use serde_json::{Map, Value, json};

/// The data of a command.
pub(crate) trait Data: Serialize + JsonSchema {
    /// Name and version of its form, such as `jred-steady/1`.
    const FORM: &'static str;
    /// Whether columns and rows belong to it.
    const HAS_COURSE: bool = false;
}

/// The data with its form and title.
pub(crate) fn headed(form: &str, title: &str, data: Value) -> Map<String, Value> {
    let mut map = Map::new();
    map.insert("schema".into(), form.into());
    map.insert("title".into(), title.into());
    if let Value::Object(data) = data {
        map.extend(data);
    }
    map
}

/// The data of a sheet.
#[derive(JsonSchema)]
#[expect(dead_code, reason = "a schema of columns that a sheet names")]
struct SheetData {
    /// Remarks and warnings.
    notes: Vec<String>,
    /// The rows: a number, a text, or null for each column; an infinite number is the text "inf".
    rows: Vec<Map<String, Value>>,
}

/// The schema of a sheet with these columns, and further ones.
pub(crate) fn of_sheet(form: &'static str, columns: &[&str]) -> (&'static str, Schema) {
    let mut schema = root::<SheetData>(form, false);
    let cell = json!({ "type": ["number", "string", "null"] });
    let all: Map<String, Value> = columns
        .iter()
        .map(|name| ((*name).to_owned(), cell.clone()))
        .collect();
    let required: Vec<&str> = columns.to_vec();
    let row = json!({ "type": "object", "properties": all, "required": required, "additionalProperties": cell });
    if let Some(rows) = schema.pointer_mut("/properties/rows/items") {
        *rows = row;
    }
    (form, schema)
}

/// The schema of a command's JSON.
pub(crate) fn of<D: Data>() -> (&'static str, Schema) {
    (D::FORM, root::<D>(D::FORM, D::HAS_COURSE))
}

/// The keys of an object.
fn names(map: &Map<String, Value>) -> Vec<Value> {
    map.keys().cloned().map(Value::from).collect()
}

fn root<D: JsonSchema>(form: &'static str, has_course: bool) -> Schema {
    let generator = SchemaGenerator::new(SchemaSettings::draft2020_12().for_serialize());
    let mut schema = generator.into_root_schema_for::<D>();
    let mut head = Map::new();
    head.insert(
        "schema".into(),
        json!({ "description": "Name and version of this form.", "const": form }),
    );
    head.insert(
        "title".into(),
        json!({ "description": "The machine, and what was computed.", "type": "string" }),
    );
    let mut tail = Map::new();
    if has_course {
        tail.insert("columns".into(), json!({ "description": "Names of the columns, with units.", "type": "array", "items": { "type": "string" } }));
        tail.insert("rows".into(), json!({
            "description": "A number for each column; null where there is no value.",
            "type": "array", "items": { "type": "array", "items": { "type": ["number", "null"] } },
        }));
    }
    let own = schema.remove("properties").unwrap_or_default();
    for (key, value) in own.as_object().into_iter().flatten() {
        head.entry(key.clone()).or_insert_with(|| value.clone());
    }
    let required = schema.remove("required").unwrap_or_default();
    let required = required.as_array().into_iter().flatten();
    let mut all: Vec<Value> = vec!["schema".into(), "title".into()];
    all.extend(required.chain(&names(&tail)).cloned());
    // A form that has its own head names it twice.
    let mut known = BTreeSet::new();
    all.retain(|key| known.insert(key.to_string()));
    head.extend(tail);
    schema.insert("title".into(), form.into());
    schema.insert("properties".into(), head.into());
    schema.insert("required".into(), all.into());
    schema.insert("unevaluatedProperties".into(), false.into());
    schema
}
