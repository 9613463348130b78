//! An answer for reading on a terminal or in a file.

use super::{Answer, Block};
use crate::table::screen::Screen;

/// Names up to this width get a column of their own.
const WIDEST: usize = 20;

/// Gap between the name of a fact and its text.
const GAP: &str = "  ";

/// Indentation of a fact.
const INDENT: &str = "  ";

impl Answer<'_> {
    /// Title and blocks, without the course.
    pub(crate) fn text(&self, screen: Screen) -> String {
        let names = self.blocks.iter().filter_map(|block| match block {
            Block::Fact(name, _) => Some(name.chars().count()),
            _ => None,
        });
        let width = names.filter(|width| *width <= WIDEST).max().unwrap_or(0);
        let mut text = String::new();
        screen.fill(&mut text, "", INDENT, &self.title);
        text.push('\n');
        for (k, block) in self.shown().iter().enumerate() {
            match block {
                Block::Heading(heading) => {
                    if k > 0 {
                        text.push('\n');
                    }
                    screen.fill(&mut text, "", INDENT, heading);
                }
                Block::Fact(name, says) => {
                    let rest = " ".repeat(INDENT.len() + width + GAP.len());
                    let colon = if name.chars().count() > width {
                        ":"
                    } else {
                        ""
                    };
                    let name = format!("{INDENT}{name:<width$}{colon}{GAP}");
                    screen.fill(&mut text, &name, &rest, says);
                }
                Block::Code(code) => {
                    text.push('\n');
                    text += code;
                    text.push('\n');
                }
                Block::Table(table) => text += &table.text(screen),
                Block::Sentence(sentence) => screen.fill(&mut text, "", INDENT, sentence),
                Block::Warning(warning) => {
                    screen.fill(&mut text, "", INDENT, &format!("warning: {warning}"));
                }
            }
        }
        text
    }
}
