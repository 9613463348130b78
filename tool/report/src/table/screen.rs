//! The width that text is written for.

use textwrap::Options;

/// The screen that a text is for.
#[derive(Clone, Copy, Debug, Default)]
pub struct Screen {
    /// Columns that a line may have; `None`: a pipe or a file, in which lines are not broken.
    pub width: Option<usize>,
}

impl Screen {
    /// A text behind the beginning of its first line, in as many lines as the width needs.
    pub(crate) fn fill(self, text: &mut String, first: &str, rest: &str, says: &str) {
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
                // A number stays with its per cent.
                let says = says.replace(" %", "\u{a0}%");
                *text += &textwrap::fill(&says, options).replace('\u{a0}', " ");
            }
        }
        text.push('\n');
    }
}
