//! The quantities of a machine file for sliders, and the text with other ones.

use jred_file::keys::complete::candidates;
use jred_file::keys::place::Place;
use jred_file::number::rounding::significant;
use jred_file::problem;
use jred_file::text::key::words::plain;
use jred_file::text::key::{ValueForm, ValueRange};
use jred_file::text::problem::Result;
use jred_file::units::{literal, unit};
use jred_sizing::study::edit::{Document, Edit, Quantity, steps};
use serde_json::{Value, json};

use crate::fault::{bytes, utf16};
use crate::request::Request;

/// Every quantity, in the order of the text, with its meaning and a range for a slider.
pub(crate) fn list(request: &Request) -> Result<String> {
    let text = request.source();
    let document = Document::parse(text.to_owned())?;
    let file = toml::Value::Table(text.parse().unwrap_or_default());
    let all = document.quantities().iter().map(|quantity| {
        let place = Place::at(&file, &steps(&quantity.path));
        let key = place.and_then(|place| place.key);
        let help = key.map_or_else(String::new, |(table, key)| plain(&key.says(table)));
        let [min, max] = range(quantity, place);
        let [from, to] = [quantity.span().start, quantity.span().end].map(|at| utf16(text, at));
        json!({
            "key": quantity.path,
            "help": help,
            "number": quantity.number(),
            "unit": quantity.unit(),
            "whole": quantity.is_whole(),
            "min": min,
            "max": max,
            "from": from,
            "to": to,
        })
    });
    Ok(all.collect::<Value>().to_string())
}

/// From a third to three times the number, half a turn around an angle, 100 mm or 1 around zero; within the limits of its key.
fn range(quantity: &Quantity, place: Option<Place>) -> [f64; 2] {
    let number = quantity.number();
    let [least, most] = match (quantity.unit(), number) {
        ("deg", _) => [number - 180.0, number + 180.0],
        ("mm", 0.0) => [-100.0, 100.0],
        (_, 0.0) => [-1.0, 1.0],
        _ if number < 0.0 => [number * 3.0, number / 3.0],
        _ => [number / 3.0, number * 3.0],
    };
    let digits = |x: f64| significant(x, 3).parse().unwrap_or(x);
    let [least, most] = [least, most].map(digits);
    let form = place.map(|place| place.form);
    let limit = |si: f64| unit::read(quantity.unit()).map_or(si, |unit| unit.number(si));
    let [low, high] = match form {
        Some(ValueForm::Quantity(_, range)) => match range {
            ValueRange::Any => [f64::NEG_INFINITY, f64::INFINITY],
            ValueRange::Positive | ValueRange::NotNegative => [0.0, f64::INFINITY],
            ValueRange::UpTo(most) | ValueRange::Within(most) => [0.0, limit(most)],
            ValueRange::Between(least, most) => [limit(least), limit(most)],
        },
        Some(ValueForm::Number(limits)) => limits,
        Some(ValueForm::Count([least, most])) => [f64::from(least), f64::from(most)],
        _ => [f64::NEG_INFINITY, f64::INFINITY],
    };
    [least.max(low).min(number), most.min(high).max(number)]
}

/// Keys and values for a place of the text.
pub(crate) fn complete(request: &Request) -> String {
    let text = request.source();
    let (range, found) = candidates(text, bytes(text, request.count("at", 0)));
    let found = found.into_iter().map(|candidate| {
        json!({
            "label": candidate.label,
            "detail": candidate.detail,
            "insert": candidate.insert,
        })
    });
    let [from, to] = [range.start, range.end].map(|at| utf16(text, at));
    json!({ "from": from, "to": to, "candidates": found.collect::<Value>() }).to_string()
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
