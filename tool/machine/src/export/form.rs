//! Output formats of an export.

use std::fmt::Write as _;

use super::Export;

crate::words! {
    /// Output format of an export.
    pub enum Form default Image {
        /// The binary image, for `include_image!` or a flash region.
        Image = "image",
        /// A Rust source file with the image as a `static` array of words.
        Rust = "rust",
        /// A C source file with the image as a `const` array of words.
        C = "c",
        /// JSON: the words, all properties of the table, and its alternatives.
        Json = "json",
    }
}

impl Export {
    /// The table in one of the forms.
    pub fn write(&self, form: Form) -> Vec<u8> {
        let words = &self.chosen().words;
        match form {
            Form::Image => words.iter().flat_map(|w| w.to_le_bytes()).collect(),
            // `include_image!` and this array are aligned as the words are; rows of a power of two then do not cross cache
            // lines.
            Form::Rust => self.source(
                &format!("pub static TABLE: [u32; {}] = [\n", words.len()),
                "];\n",
            ),
            Form::C => self.source(
                &format!(
                    "#include <stdint.h>\n\nconst uint32_t jred_table[{}] = {{\n",
                    words.len()
                ),
                "};\n",
            ),
            Form::Json => format!("{:#}\n", self.json()).into_bytes(),
        }
    }

    fn source(&self, open: &str, close: &str) -> Vec<u8> {
        let mut text = String::new();
        for line in self.summary().lines() {
            let _ = writeln!(text, "// {line}");
        }
        text.push_str(open);
        for row in self.chosen().words.chunks(8) {
            let words: Vec<String> = row.iter().map(|w| format!("0x{w:08x}")).collect();
            let _ = writeln!(text, "    {},", words.join(", "));
        }
        text.push_str(close);
        text.into_bytes()
    }
}
