//! Output formats of an export.

use std::fmt::Write as _;

use super::Export;
use super::candidate::Made;
use super::figures::rust_arguments;

crate::words! {
    /// Output format of an export.
    pub enum Form default Image {
        /// The binary image, for `include_image!` or a flash region.
        Image = "image",
        /// A Rust source file with the image as a `static` array of words.
        Rust = "rust",
        /// A C or C++ source file with the image as a `const` array of words, to be compiled or included once.
        C = "c",
        /// JSON: the words, all properties of the table, and its alternatives.
        Json = "json",
    }
}

const INDENT: &str = "    ";

impl Export {
    /// The table in one of the forms; `None` for several pieces as one image.
    pub fn write(&self, form: Form) -> Option<Vec<u8>> {
        let tables = &self.chosen().tables;
        Some(match (form, self.whole()) {
            (Form::Image, Some(table)) => {
                table.words.iter().flat_map(|w| w.to_le_bytes()).collect()
            }
            (Form::Image, None) => return None,
            (Form::Rust, Some(table)) => self.source(&rust_table("TABLE", &table.words)),
            (Form::Rust, None) => self.source(&self.rust_pieces(tables)),
            (Form::C, Some(table)) => self.source(&c_source(&c_table("jred_table", &table.words))),
            (Form::C, None) => self.source(&c_source(&self.c_pieces(tables))),
            (Form::Json, _) => format!("{:#}\n", self.json()).into_bytes(),
        })
    }

    /// A source text, with the summary as its comment.
    fn source(&self, code: &str) -> Vec<u8> {
        let mut text = String::new();
        for line in self.summary().lines() {
            let _ = writeln!(text, "// {line}");
        }
        text.push_str(code);
        text.into_bytes()
    }

    /// A table for each piece, and a function that puts them together.
    fn rust_pieces(&self, tables: &[Made]) -> String {
        let arguments = rust_arguments(self.chosen());
        let mut text = format!(
            "use jred::*;\n\n\
             /// The machine in pieces.\n\
             pub type PiecewiseModel = Pieces<'static, {arguments}, {}>;\n\n\
             /// Checks the tables and puts them together.\n\
             pub fn pieces() -> Result<PiecewiseModel, ImageError> {{\n\
             {INDENT}fn piece(start: u32, words: &'static [u32]) -> Result<(Phase, Model<'static, {arguments}>), ImageError> {{\n\
             {INDENT}{INDENT}Ok((Phase::from_bits(start), Image::new(words)?.model()?))\n\
             {INDENT}}}\n\
             {INDENT}Pieces::new([\n",
            tables.len()
        );
        for (number, table) in (1..).zip(tables) {
            let start = self.start(table).to_bits();
            let _ = writeln!(text, "        piece(0x{start:08x}, &TABLE_{number})?,");
        }
        text += "    ])\n    .map_err(ImageError::Table)\n}\n";
        for (number, table) in (1..).zip(tables) {
            let _ = write!(
                text,
                "\n{}",
                rust_table(&format!("TABLE_{number}"), &table.words)
            );
        }
        text
    }

    /// A table for each piece, and where each starts.
    fn c_pieces(&self, tables: &[Made]) -> String {
        let mut text = String::new();
        for (number, table) in (1..).zip(tables) {
            text += &c_table(&format!("jred_table_{number}"), &table.words);
            text.push('\n');
        }
        let count = tables.len();
        let starts = tables
            .iter()
            .map(|table| format!("0x{:08x}", self.start(table).to_bits()));
        let starts: Vec<String> = starts.collect();
        let names: Vec<String> = (1..=count)
            .map(|number| format!("jred_table_{number}"))
            .collect();
        let _ = write!(
            text,
            "/* Phase at which each begins, in units of 2^-32 of the whole range. */\n\
             extern const uint32_t jred_starts[{count}];\n\
             const uint32_t jred_starts[{count}] = {{ {} }};\n\
             extern const uint32_t *const jred_tables[{count}];\n\
             const uint32_t *const jred_tables[{count}] = {{ {} }};\n",
            starts.join(", "),
            names.join(", ")
        );
        text
    }
}

// `include_image!` and these arrays are aligned as the words are; rows of a power of two then do not cross cache lines.

fn rust_table(name: &str, words: &[u32]) -> String {
    format!(
        "pub static {name}: [u32; {}] = [\n{}];\n",
        words.len(),
        rows(words)
    )
}

/// In C++ a constant is seen in its file only, unless it was declared `extern`.
fn c_table(name: &str, words: &[u32]) -> String {
    let count = words.len();
    format!(
        "extern const uint32_t {name}[{count}];\nconst uint32_t {name}[{count}] = {{\n{}}};\n",
        rows(words)
    )
}

/// A source file of C or C++, compiled or included: once, and with the same names in both.
fn c_source(code: &str) -> String {
    format!(
        "#ifndef JRED_TABLE\n#define JRED_TABLE\n\n#include <stdint.h>\n\n\
         #ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n{code}\n\
         #ifdef __cplusplus\n}}\n#endif\n\n#endif\n"
    )
}

fn rows(words: &[u32]) -> String {
    let mut text = String::new();
    for row in words.chunks(8) {
        let words: Vec<String> = row.iter().map(|w| format!("0x{w:08x}")).collect();
        let _ = writeln!(text, "    {},", words.join(", "));
    }
    text
}
