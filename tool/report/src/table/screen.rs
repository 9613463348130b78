//! The line width for text.

use textwrap::Options;

/// The screen for which a text is formatted.
#[derive(Clone, Copy, Debug, Default)]
pub struct Screen {
    /// Columns of a line; `None`: a pipe or a file, whose lines are not wrapped.
    pub width: Option<usize>,
}

impl Screen {
    /// Appends a text after the start of its first line, wrapped to the width.
    pub fn fill(self, text: &mut String, first: &str, rest: &str, says: &str) {
        match self.width {
            None => {
                *text += first;
                *text += says;
            }
            Some(width) => {
                let options = Options::new(width)
                    .initial_indent(first)
                    .subsequent_indent(rest)
                    .break_words(false);
                // A number stays with its per cent sign.
                let says = says.replace(" %", "\u{a0}%");
                *text += &textwrap::fill(&says, options).replace('\u{a0}', " ");
            }
        }
        text.push('\n');
    }
}
