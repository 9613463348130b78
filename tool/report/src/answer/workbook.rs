//! An answer as a workbook (XLSX): its words on the first sheet, each of its tables on a sheet of its own.

use miette::{Result, miette};
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, FormatAlign, Workbook, XlsxError};

use super::{Answer, Block};
use crate::table::grid::Grid;
use crate::units;
use jred_sizing::cell::Cell;

/// Name of the first sheet.
const SUMMARY: &str = "summary";

/// Letters that a sheet's name may have.
const MOST_LETTERS: usize = 31;

/// Widest column of a table (px).
const WIDEST: u32 = 400;

impl Answer<'_> {
    /// The bytes of a workbook with all numbers of the answer, those of its CSV with every digit.
    ///
    /// # Errors
    /// A table has more rows, columns or letters than a sheet can have.
    pub fn workbook(&self) -> Result<Vec<u8>> {
        self.sheets().map_err(|why| {
            miette!(
                help = "use --format csv, which has no limit, or fewer rows",
                "a table of the answer does not fit on a sheet: {why}"
            )
        })
    }

    fn sheets(&self) -> Result<Vec<u8>, XlsxError> {
        let mut book = Workbook::new();
        // The same answer gives the same bytes.
        let made = ExcelDateTime::from_ymd(2000, 1, 1)?;
        book.set_properties(&DocProperties::new().set_creation_datetime(&made));
        self.summary(&mut book)?;
        let mut heading = None;
        let mut csv = self.csv.as_ref().map(|csv| csv.0().collect::<String>());
        for block in &self.blocks {
            match block {
                Block::Heading(name) => heading = Some(name),
                Block::Table(table) => {
                    let name = heading.take().or(table.columns.first());
                    let name = units::text(name.map_or("", String::as_str));
                    add(&mut book, &name, table.shown().grid())?;
                    // The same table need not be there twice.
                    csv = csv.filter(|csv| *csv != table.csv());
                }
                _ => {}
            }
        }
        if let Some(course) = &self.course {
            let course = units::columns(course);
            let rows = course.rows().iter();
            let rows = rows.map(|row| row.iter().copied().map(Cell::from).collect());
            let (heads, rows) = (course.names(), rows.collect());
            add(&mut book, "course", Grid { heads, rows })?;
        }
        if let Some(csv) = csv {
            add(&mut book, "all values", Grid::of_csv(&units::table(csv)))?;
        }
        book.save_to_buffer()
    }

    /// The sheet of everything that is no table.
    fn summary(&self, book: &mut Workbook) -> Result<(), XlsxError> {
        let bold = Format::new().set_bold().set_align(FormatAlign::Top);
        let wrapped = Format::new().set_text_wrap();
        let sheet = book.add_worksheet().set_name(SUMMARY)?;
        sheet.set_column_width(0, 28)?.set_column_width(1, 100)?;
        sheet.write_string_with_format(0, 0, &self.title, &bold)?;
        let blocks = self.shown();
        let words = blocks.iter().filter_map(|block| match block {
            Block::Table(_) => None,
            Block::Heading(heading) => Some((heading.as_str(), "")),
            Block::Fact(name, text) => Some((name.as_str(), text.as_str())),
            Block::Warning(text) => Some(("warning", text.as_str())),
            Block::Sentence(text) | Block::Code(text) => Some(("", text.as_str())),
        });
        for (row, (name, text)) in (1..).zip(words) {
            sheet.write_string_with_format(row, 0, name, &bold)?;
            sheet.write_string_with_format(row, 1, text, &wrapped)?;
        }
        Ok(())
    }
}

/// Adds a sheet with a table under heads that stay in place.
fn add(book: &mut Workbook, name: &str, grid: Grid) -> Result<(), XlsxError> {
    let name = free_name(book, name);
    let sheet = book.add_worksheet().set_name(name)?;
    sheet.set_freeze_panes(1, 0)?;
    for (column, head) in (0..).zip(&grid.heads) {
        sheet.write_string_with_format(0, column, head, &Format::new().set_bold())?;
    }
    for (row, cells) in (1..).zip(grid.rows) {
        for (column, cell) in (0..).zip(cells) {
            match cell {
                Cell::Empty => continue,
                Cell::Number(x) if x.is_finite() => sheet.write_number(row, column, x)?,
                // A spreadsheet has no infinite numbers.
                Cell::Number(x) => sheet.write_string(row, column, x.to_string())?,
                Cell::Text(text) => sheet.write_string(row, column, text)?,
            };
        }
    }
    sheet.set_autofit_max_width(WIDEST).autofit();
    Ok(())
}

/// A name like the wanted one that spreadsheet programs accept and no other sheet has, in any case.
fn free_name(book: &mut Workbook, wanted: &str) -> String {
    let refused = |c: char| "[]:*?/\\'".contains(c) || c.is_control();
    let wanted = wanted.replace(refused, " ");
    let words: Vec<&str> = wanted.split_whitespace().collect();
    let wanted = if words.is_empty() {
        "table".to_owned()
    } else {
        words.join(" ")
    };
    let sheets = book.worksheets().iter();
    // Excel keeps "History" for itself.
    let mut taken: Vec<String> = sheets.map(|sheet| sheet.name().to_lowercase()).collect();
    taken.push("history".to_owned());
    let numbered = |number: u32| {
        let end = if number == 1 {
            String::new()
        } else {
            format!(" {number}")
        };
        let mut name = wanted.clone();
        // A letter outside the basic plane counts twice.
        while name.encode_utf16().count() + end.len() > MOST_LETTERS {
            name.pop();
        }
        name.trim_end().to_owned() + &end
    };
    let mut names = (1..).map(numbered);
    let free = names.find(|name| !taken.contains(&name.to_lowercase()));
    free.unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use std::borrow::Cow;
    use std::io::Cursor;

    use calamine::{Data, Reader as _, Xlsx, open_workbook_from_rs};

    use super::*;
    use crate::table::reading::Reading;
    use jred_file::number::columns::Columns;

    fn opened(answer: &Answer) -> Xlsx<Cursor<Vec<u8>>> {
        open_workbook_from_rs(Cursor::new(answer.workbook().unwrap())).unwrap()
    }

    fn one_cell(head: &str) -> Reading {
        Reading {
            columns: vec![head.to_owned()],
            rows: vec![
                vec![Cell::Number(f64::INFINITY)],
                vec![Cell::Number(0.1 + 0.2)],
            ],
            ..Reading::default()
        }
    }

    /// Names of sheets: at most 31 letters of 16 bits, no two alike in any case, none of the forbidden letters.
    #[test]
    fn names_of_sheets_are_valid_and_unique() {
        let long = "Contributions to the torque of the motor";
        let wanted = [
            "Summary",
            "drive: figures [N m] / 'limit'",
            "",
            "History",
            long,
            long,
            "𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞",
            "'",
        ];
        let mut answer = Answer::words("t");
        for name in wanted {
            answer.heading(name);
            answer.table(one_cell("x"));
        }
        let names = opened(&answer).sheet_names();
        assert_eq!(
            names,
            [
                "summary",
                "Summary 2",
                "drive figures N m limit",
                "table",
                "History 2",
                "Contributions to the torque of",
                "Contributions to the torque o 2",
                "𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞𝄞",
                "table 2",
            ]
        );
    }

    #[test]
    fn words_numbers_and_courses_are_read_back() {
        let mut answer = Answer::words("Press <&> \"a\"");
        answer.fact("motor", "=1+1");
        answer.warning("hot");
        answer.table(one_cell("force [N]"));
        answer.csv("key,x\n=a,2\n".to_owned());
        let columns = Columns::default();
        answer.course(Cow::Owned(columns));
        let mut book = opened(&answer);
        let summary = book.worksheet_range(SUMMARY).unwrap();
        let texts: Vec<String> = summary
            .cells()
            .map(|(_, _, cell)| cell.to_string())
            .collect();
        assert_eq!(
            texts,
            ["Press <&> \"a\"", "", "motor", "=1+1", "warning", "hot"]
        );
        let table = book
            .worksheet_range("force [N]".replace(['[', ']'], "").trim())
            .unwrap();
        assert_eq!(
            table.get_value((0, 0)),
            Some(&Data::String("force [N]".into()))
        );
        assert_eq!(table.get_value((1, 0)), Some(&Data::String("inf".into())));
        assert_eq!(table.get_value((2, 0)), Some(&Data::Float(0.1 + 0.2)));
        let values = book.worksheet_range("all values").unwrap();
        assert_eq!(values.get_value((1, 0)), Some(&Data::String("=a".into())));
        assert_eq!(values.get_value((1, 1)), Some(&Data::Float(2.0)));
        assert!(book.worksheet_formula("all values").unwrap().is_empty());
    }

    #[test]
    fn the_same_answer_gives_the_same_bytes() {
        let mut answer = Answer::words("t");
        answer.table(one_cell("x"));
        let first = answer.workbook().unwrap();
        std::thread::sleep(std::time::Duration::from_millis(1100));
        assert_eq!(answer.workbook().unwrap(), first);
    }
}
