//! JSON Schema, the part that `docs/size.schema.json` uses (draft 2020-12): a library for all of it would be the largest thing
//! that the tests compile. A keyword that is not known here panics, so that none is passed over.

use serde_json::Value;

/// Where and why a value does not follow a schema; references are looked up in the `root` schema.
pub(crate) fn faults(root: &Value, value: &Value) -> Vec<String> {
    let mut found = Vec::new();
    Check { root }.check(root, value, "", &mut found);
    found
}

struct Check<'s> {
    root: &'s Value,
}

impl Check<'_> {
    fn check(&self, schema: &Value, value: &Value, place: &str, found: &mut Vec<String>) {
        let Some(keywords) = schema.as_object() else {
            if *schema != Value::Bool(true) {
                found.push(format!("{place}: not allowed here"));
            }
            return;
        };
        for (keyword, rule) in keywords {
            let holds = match keyword.as_str() {
                "$schema" | "title" | "description" | "$defs" => true,
                "type" => each(rule).any(|name| is_of_type(value, name.as_str().unwrap())),
                "const" => value == rule,
                "enum" => rule.as_array().unwrap().contains(value),
                "minimum" => number(value).is_none_or(|n| n >= rule.as_f64().unwrap()),
                "exclusiveMinimum" => number(value).is_none_or(|n| n > rule.as_f64().unwrap()),
                "minItems" => length(value).is_none_or(|n| n >= rule.as_u64().unwrap()),
                "maxItems" => length(value).is_none_or(|n| n <= rule.as_u64().unwrap()),
                "required" => {
                    let has = |key: &Value| value.get(key.as_str().unwrap()).is_some();
                    !value.is_object() || rule.as_array().unwrap().iter().all(has)
                }
                "oneOf" => {
                    let follows = each(rule).filter(|schema| self.follows(schema, value));
                    follows.count() == 1
                }
                "allOf" => {
                    each(rule).for_each(|schema| self.check(schema, value, place, found));
                    true
                }
                "$ref" => {
                    let target = rule.as_str().unwrap().strip_prefix('#').unwrap();
                    let target = self.root.pointer(target).expect("a definition");
                    self.check(target, value, place, found);
                    true
                }
                "items" => {
                    for (index, item) in value.as_array().into_iter().flatten().enumerate() {
                        self.check(rule, item, &format!("{place}/{index}"), found);
                    }
                    true
                }
                "properties" => {
                    for (key, schema) in rule.as_object().unwrap() {
                        if let Some(property) = value.get(key) {
                            self.check(schema, property, &format!("{place}/{key}"), found);
                        }
                    }
                    true
                }
                "additionalProperties" => {
                    let named = keywords.get("properties").and_then(Value::as_object);
                    let object = value.as_object().into_iter().flatten();
                    for (key, property) in object {
                        if named.is_none_or(|named| !named.contains_key(key)) {
                            self.check(rule, property, &format!("{place}/{key}"), found);
                        }
                    }
                    true
                }
                other => {
                    panic!("the schema uses {other:?}, which tests/support/schema.rs does not know")
                }
            };
            if !holds {
                found.push(format!("{place}: {value} violates {keyword} {rule}"));
            }
        }
    }

    fn follows(&self, schema: &Value, value: &Value) -> bool {
        let mut found = Vec::new();
        self.check(schema, value, "", &mut found);
        found.is_empty()
    }
}

/// The elements of an array, or the value itself.
fn each(value: &Value) -> impl Iterator<Item = &Value> {
    let list = value
        .as_array()
        .map_or(std::slice::from_ref(value), Vec::as_slice);
    list.iter()
}

fn number(value: &Value) -> Option<f64> {
    value.as_f64()
}

fn length(value: &Value) -> Option<u64> {
    value.as_array().map(|items| items.len() as u64)
}

fn is_of_type(value: &Value, name: &str) -> bool {
    match name {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "string" => value.is_string(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        "number" => value.is_number(),
        "integer" => number(value).is_some_and(|n| n.fract() == 0.0),
        _ => panic!("no type of JSON: {name}"),
    }
}

/// A value that follows each keyword, and one that does not.
#[test]
fn every_keyword_takes_and_refuses() {
    use serde_json::json;

    let root = |schema: Value| json!({ "$defs": { "positive": { "exclusiveMinimum": 0 } }, "allOf": [schema] });
    for (schema, good, bad) in [
        (json!({ "type": "integer" }), json!(2.0), json!(2.5)),
        (
            json!({ "type": ["number", "null"] }),
            json!(null),
            json!("1"),
        ),
        (json!({ "type": "object" }), json!({}), json!([])),
        (json!({ "type": "array" }), json!([]), json!({})),
        (json!({ "type": "string" }), json!(""), json!(1)),
        (json!({ "type": "boolean" }), json!(false), json!(0)),
        (json!({ "const": "a" }), json!("a"), json!("b")),
        (json!({ "enum": ["a", null] }), json!(null), json!("c")),
        (json!({ "minimum": 1 }), json!(1), json!(0.999)),
        (json!({ "exclusiveMinimum": 1 }), json!(1.001), json!(1)),
        (json!({ "minItems": 1 }), json!([0]), json!([])),
        (json!({ "maxItems": 1 }), json!([0]), json!([0, 0])),
        (
            json!({ "required": ["a"] }),
            json!({ "a": null }),
            json!({ "b": 1 }),
        ),
        (
            json!({ "oneOf": [{ "type": "number" }, { "minimum": 1 }] }),
            json!(0),
            json!(2),
        ),
        (
            json!({ "oneOf": [{ "type": "number" }, { "type": "null" }] }),
            json!(null),
            json!("a"),
        ),
        (
            json!({ "allOf": [{ "minimum": 0 }, { "type": "integer" }] }),
            json!(3),
            json!(-3),
        ),
        (json!({ "$ref": "#/$defs/positive" }), json!(1), json!(0)),
        (
            json!({ "items": { "type": "null" } }),
            json!([null]),
            json!([null, 1]),
        ),
        (
            json!({ "properties": { "a": { "const": 1 } } }),
            json!({ "b": 2 }),
            json!({ "a": 2 }),
        ),
        (
            json!({ "properties": { "a": true }, "additionalProperties": false }),
            json!({ "a": 1 }),
            json!({ "b": 1 }),
        ),
        (
            json!({ "additionalProperties": { "type": "null" } }),
            json!({ "a": null }),
            json!({ "a": 1 }),
        ),
    ] {
        let schema = root(schema);
        assert_eq!(faults(&schema, &good), [""; 0], "{schema}");
        assert!(!faults(&schema, &bad).is_empty(), "{schema} takes {bad}");
    }
}
