//! JSON against the schema of its form.

use std::sync::LazyLock;

use jsonschema::Validator;
use serde_json::Value;

/// The form of each command, and its validator.
pub(crate) static VALIDATORS: LazyLock<Vec<(&str, Validator)>> = LazyLock::new(|| {
    let all = jred_report::schemas::all().into_iter();
    all.map(|(form, schema)| {
        (
            form,
            jsonschema::draft202012::new(schema.as_value()).unwrap(),
        )
    })
    .collect()
});

/// The schema violations of an answer, by the schema that it names.
pub(crate) fn faults(answer: &Value) -> Vec<String> {
    let form = answer["schema"].as_str();
    let Some((_, validator)) = VALIDATORS.iter().find(|(name, _)| Some(*name) == form) else {
        return vec![format!("unknown form {form:?}")];
    };
    let faults = validator.iter_errors(answer);
    faults
        .map(|fault| format!("{}: {fault}", fault.instance_path))
        .collect()
}
