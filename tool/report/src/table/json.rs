//! JSON whose arrays are written part by part.

use serde_json::Value;

/// Splits the text of an object at its entry `key`, which is null: the text before the value, and after it.
pub(crate) fn split_at_entry(text: &str, key: &str) -> (String, String) {
    let entry = format!("\n  \"{key}\": ");
    // JSON text contains no line feeds, so this matches the entry itself.
    let found = text.split_once(&format!("{entry}null"));
    let (before, after) = found.unwrap_or_default();
    (format!("{before}{entry}"), after.to_owned())
}

/// The array of an object's entry, in parts of one item.
pub(crate) fn array_parts(items: impl Iterator<Item = Value>) -> impl Iterator<Item = String> {
    let mut items = items.fuse();
    let (mut begun, mut ended) = (false, false);
    std::iter::from_fn(move || {
        if ended {
            return None;
        }
        let opening = if begun { "," } else { "[" };
        let Some(item) = items.next() else {
            ended = true;
            return Some(if begun { "\n  ]" } else { "[]" }.to_owned());
        };
        begun = true;
        Some(format!("{opening}\n{item:#}").replace('\n', "\n    "))
    })
}
