//! Comma-separated values (RFC 4180): the common writer of all results.
//!
//! A number has the shortest digits that read back to the same number. A cell is in quotes if it contains a comma, a quote or a line break.
//! `tests/cli/forms.rs` reads every command's CSV back. A text that a spreadsheet would read as a formula gets a leading apostrophe.

/// Rows as text, each ended by a line feed.
pub fn rows<R, C>(rows: impl IntoIterator<Item = R>) -> String
where
    R: IntoIterator<Item = C>,
    C: AsRef<[u8]>,
{
    let mut writer = csv::WriterBuilder::new()
        .flexible(true)
        .buffer_capacity(512)
        .from_writer(Vec::new());
    for row in rows {
        // Writing rows of any length into memory cannot fail.
        for cell in row {
            let cell = cell.as_ref();
            let _ = if is_formula(cell) {
                writer.write_field([b"'", cell].concat())
            } else {
                writer.write_field(cell)
            };
        }
        let _ = writer.write_record(None::<&[u8]>);
    }
    let bytes = writer.into_inner().unwrap_or_default();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Whether a spreadsheet would read a cell as a formula: it begins like one, and is neither a number nor only signs.
fn is_formula(cell: &[u8]) -> bool {
    let is_number = || std::str::from_utf8(cell).is_ok_and(|text| text.parse::<f64>().is_ok());
    matches!(cell, [b'=' | b'+' | b'-' | b'@' | b'\t' | b'\r', ..])
        && cell.iter().any(u8::is_ascii_alphanumeric)
        && !is_number()
}

/// One row as text.
pub fn row<C: AsRef<[u8]>>(cells: impl IntoIterator<Item = C>) -> String {
    rows([cells])
}

/// A number with every digit, tiny and huge ones with an exponent; zero has no sign, a whole number no decimal point.
pub fn number(x: f64) -> String {
    let mut text = format!("{:?}", x + 0.0);
    if text.ends_with(".0") {
        text.truncate(text.len() - 2);
    }
    text
}

/// A number, or an empty cell without a number.
pub fn known(x: Option<f64>) -> String {
    x.map_or_else(String::new, number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back() {
        for x in [0.1 + 0.2, -1e-300, 5e300, f64::MIN_POSITIVE, 1.0 / 3.0] {
            assert_eq!(number(x).parse::<f64>().map(f64::to_bits), Ok(x.to_bits()));
        }
        assert_eq!(
            [-0.0, 440.0, -20.0, 1e300].map(number),
            ["0", "440", "-20", "1e300"]
        );
        assert_eq!(known(None), "");
    }

    #[test]
    fn formulas_are_texts() {
        let cells = [
            "=1+1", "+a", "-b", "@c", "\td", "-1.5", "+2e-3", "a=b", "+-",
        ];
        assert_eq!(row(cells), "'=1+1,'+a,'-b,'@c,'\td,-1.5,+2e-3,a=b,+-\n");
    }

    #[test]
    fn cells_are_quoted_where_they_must() {
        let cells = ["a", "b, c", "\"d\"", "", "e\nf"];
        let text = row(cells);
        assert_eq!(text, "a,\"b, c\",\"\"\"d\"\"\",,\"e\nf\"\n");
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .from_reader(text.as_bytes());
        let read = reader.records().next().unwrap().unwrap();
        assert_eq!(read.iter().collect::<Vec<_>>(), cells);
    }
}
