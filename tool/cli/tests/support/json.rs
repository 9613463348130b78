//! Numbers of a JSON text, read as exactly as they are written.

/// The numbers and nulls of the rows of a result, in the order written. The general parser of `serde_json` may be off
/// by one unit in the last place; the standard library's is exact.
pub(crate) fn row_numbers(json: &str) -> Vec<Option<f64>> {
    let (_, rows) = json.split_once("\"rows\":").unwrap();
    let end = rows.find('"').unwrap_or(rows.len());
    let separators = |c: char| c.is_whitespace() || "[],{}".contains(c);
    let words = rows[..end].split(separators).filter(|w| !w.is_empty());
    words
        .map(|word| (word != "null").then(|| word.parse().unwrap()))
        .collect()
}
