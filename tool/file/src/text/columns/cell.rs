//! Numbers in the cells of a file.

use crate::text::csv::CsvTable;

/// A field without its quotes, which a blank before them made part of it.
pub(super) fn unquoted(field: &str) -> &str {
    let inner = field
        .strip_prefix('"')
        .and_then(|field| field.strip_suffix('"'));
    inner.map_or(field, str::trim)
}

/// Whether a text is a number, with either decimal sign.
pub(super) fn is_number(text: &str) -> bool {
    text.replacen(',', ".", 1).parse::<f64>().is_ok()
}

/// The fault of a cell, and its cure.
pub(super) type CellFault = (String, &'static str);

const PLAIN: &str =
    "write plain numbers with a decimal point and no units, such as 12.5; leave no cell empty";
const ONE_SIGN: &str =
    "write all numbers of the file with one decimal sign, and none between thousands";

/// Reads numbers whose decimal sign is the same in the whole file.
#[derive(Default)]
pub(super) struct NumberReader {
    /// The first rows with a decimal point and with a decimal comma, counted from 1.
    first: [Option<usize>; 2],
}

impl NumberReader {
    /// The number in a cell of row `row`, counted from 1. A comma can be the decimal sign if it does not separate cells.
    pub(super) fn number(
        &mut self,
        field: &str,
        row: usize,
        table: &CsvTable,
    ) -> Result<f64, CellFault> {
        let [point, comma] = ['.', ','].map(|sign| field.contains(sign));
        let value = if comma {
            field.replacen(',', ".", 1).parse()
        } else {
            field.parse()
        };
        let value = value.ok().filter(|value: &f64| value.is_finite());
        let Some(value) = value else {
            let help = if point && comma { ONE_SIGN } else { PLAIN };
            return Err(("not a finite number".to_owned(), help));
        };
        if comma && table.separator() == ',' {
            return Err((
                "a number with a decimal comma, but commas separate the cells".to_owned(),
                "save the file with semicolons between the cells, or write decimals with a point",
            ));
        }
        if point || comma {
            let (own, other) = (usize::from(comma), usize::from(!comma));
            if let Some(before) = self.first[other] {
                let sign = ["point", "comma"];
                let what = format!(
                    "a number with a {}, but row {before} has one with a {}",
                    sign[own], sign[other]
                );
                return Err((what, ONE_SIGN));
            }
            self.first[own].get_or_insert(row);
        }
        Ok(value)
    }
}
