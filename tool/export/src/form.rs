//! Output formats of an export.

use std::fmt::Write as _;

use jred::Domain;

use crate::candidate::RangeTable;
use crate::export::Export;
use crate::name::Name;
use crate::rust_type::full_rust_arguments;

jred_file::words! {
    /// Output format of an export.
    pub enum OutputForm default Image {
        /// The binary image, for `include_image!` or a flash region.
        Image = "image",
        /// A Rust source file with the image as a `static` array of words.
        Rust = "rust",
        /// A C or C++ source file with the image as a `const` array of words, and the functions of `jred.h`.
        C = "c",
        /// Structured Text for a PLC: a function block with both directions of the tick in LREAL, and a block that tests it.
        St = "st",
        /// The same as PLCopen XML, which CODESYS and TwinCAT import.
        Plcopen = "plcopen",
        /// CSV for a drive with CiA 402: the torque of the motion in thousandths of the rated torque, over time and position.
        Cia402 = "cia402",
        /// JSON: the words, all properties of the table, and its alternatives.
        Json = "json",
    }
}

const INDENT: &str = "    ";

impl Export {
    /// The binary image; `None` for several pieces.
    pub fn image(&self) -> Option<Vec<u8>> {
        let words = self.whole()?.words.iter();
        Some(words.flat_map(|word| word.to_le_bytes()).collect())
    }

    /// Rust source, in a module `name` or at the top level of its file.
    pub fn rust_source(&self, name: Option<&Name>) -> String {
        module(
            name,
            &match self.whole() {
                Some(table) => self.rust_whole(table),
                None => self.rust_pieces(&self.chosen().tables),
            },
        )
    }

    /// C source, whose names begin with `name`.
    pub fn c_source(&self, name: &Name) -> String {
        match self.whole() {
            Some(table) => self.c_table(table, name),
            None => self.c_pieces(&self.chosen().tables, name),
        }
    }

    /// A table with the type of its model, which the compiler checks.
    fn rust_whole(&self, table: &RangeTable) -> String {
        let arguments = full_rust_arguments(self.chosen());
        format!(
            "/// Identifier of the machine: `Image::of_machine` refuses the image of another.\n\
             #[allow(dead_code)]\n\
             pub const MACHINE: u32 = 0x{:08x};\n\n\
             /// The machine.\n\
             #[allow(dead_code)]\n\
             pub type TableModel = jred::Model<'static, {arguments}>;\n\n\
             // A table of another type or with other curves does not compile.\n\
             const _: () = assert!(jred::Image::is_of::<{arguments}>(&TABLE));\n\n\
             /// Checks the table.\n\
             #[allow(dead_code)]\n\
             pub fn model() -> Result<TableModel, jred::ImageError> {{\n\
             {INDENT}jred::Image::new(&TABLE)?.of_machine(MACHINE)?.model()\n\
             }}\n\n{}",
            self.machine,
            rust_table("TABLE", &table.words)
        )
    }

    /// A table for each piece, and a function that combines them.
    fn rust_pieces(&self, tables: &[RangeTable]) -> String {
        let arguments = full_rust_arguments(self.chosen());
        let mut text = format!(
            "/// Identifier of the machine: `Image::of_machine` refuses the image of another.\n\
             pub const MACHINE: u32 = 0x{:08x};\n\n\
             /// The machine in pieces.\n\
             pub type PiecewiseModel = jred::Pieces<'static, {arguments}, {}>;\n\n\
             /// Checks the tables and puts them together.\n\
             pub fn pieces() -> Result<PiecewiseModel, jred::ImageError> {{\n\
             {INDENT}fn piece(start: u32, words: &'static [u32]) -> Result<(jred::Phase, jred::Model<'static, {arguments}>), jred::ImageError> {{\n\
             {INDENT}{INDENT}Ok((jred::Phase::from_bits(start), jred::Image::new(words)?.of_machine(MACHINE)?.model()?))\n\
             {INDENT}}}\n\
             {INDENT}jred::Pieces::new({}, [\n",
            self.machine,
            tables.len(),
            match self.domain {
                Domain::Turn => "jred::Domain::Turn".to_owned(),
                Domain::Stroke { from, to } => {
                    format!("jred::Domain::Stroke {{ from: {from:?}, to: {to:?} }}")
                }
            }
        );
        for (number, table) in (1..).zip(tables) {
            let start = self.start(table).to_bits();
            let _ = writeln!(text, "        piece(0x{start:08x}, &TABLE_{number})?,");
        }
        text += "    ])\n    .map_err(jred::ImageError::Table)\n}\n";
        for (number, table) in (1..).zip(tables) {
            let _ = write!(
                text,
                "\n{}",
                rust_table(&format!("TABLE_{number}"), &table.words)
            );
        }
        text
    }
}

// Arrays are as aligned as with `include_image!`, so that rows of a power of two do not cross cache lines.

/// Rust code as a module of this name.
fn module(name: Option<&Name>, code: &str) -> String {
    let Some(name) = name else {
        return code.to_owned();
    };
    let mut text = format!("pub mod {} {{\n", name.as_str());
    for line in code.lines() {
        if line.is_empty() {
            text.push('\n');
        } else {
            let _ = writeln!(text, "{INDENT}{line}");
        }
    }
    text + "}\n"
}

pub(crate) fn rust_table(name: &str, words: &[u32]) -> String {
    format!(
        "pub static {name}: [u32; {}] = [\n{}];\n",
        words.len(),
        rows(words, "")
    )
}

/// Words in hexadecimal, each with this suffix.
pub(crate) fn rows(words: &[u32], suffix: &str) -> String {
    let mut text = String::new();
    for row in words.chunks(8) {
        let words: Vec<String> = row.iter().map(|w| format!("0x{w:08x}{suffix}")).collect();
        let _ = writeln!(text, "    {},", words.join(", "));
    }
    text
}
