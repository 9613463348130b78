//! The quantities of a machine file for sliders, and the text with other ones.

use jred_file::problem;
use jred_file::text::problem::Result;
use jred_file::units::literal;
use jred_sizing::study::edit::{Document, Edit};
use serde_json::{Value, json};

use crate::fault::utf16;
use crate::request::Request;

/// Every quantity, in the order of the text.
pub(crate) fn list(request: &Request) -> Result<String> {
    let text = request.source();
    let document = Document::parse(text.to_owned())?;
    let all = document.quantities().iter().map(|quantity| {
        let [from, to] = [quantity.span().start, quantity.span().end].map(|at| utf16(text, at));
        json!({
            "key": quantity.path,
            "number": quantity.number(),
            "unit": quantity.unit(),
            "whole": quantity.is_whole(),
            "from": from,
            "to": to,
        })
    });
    Ok(Value::from_iter(all).to_string())
}

/// The text with some quantities changed.
pub(crate) fn set(request: &Request) -> Result<String> {
    let document = Document::parse(request.source().to_owned())?;
    let values = request.field("values").as_object();
    let mut changed = Vec::new();
    for (path, value) in values.into_iter().flatten() {
        let value = literal::read(value.as_str().unwrap_or_default());
        let value = value.map_err(|why| problem!("{path} cannot be set: {why}"))?;
        changed.push((document.find(path)?, value));
    }
    let edits: Vec<Edit> = changed
        .iter()
        .map(|(quantity, value)| Edit {
            quantity: *quantity,
            number: value.number,
            unit: &value.unit,
        })
        .collect();
    Ok(json!({ "text": document.with(&edits) }).to_string())
}
