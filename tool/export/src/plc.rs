//! The tick for a PLC: as Structured Text, and as PLCopen XML.

use crate::choice::{LayoutName, Number};
use crate::export::Export;
use crate::name::Name;
use crate::plcopen;
use crate::structured_text::Block;
use crate::wide_table::Wide;

impl Export {
    /// The tick as Structured Text: two blocks, the second tests the first. `about` are lines of its comment. `None` for several pieces, and for a
    /// table other than a spline in f32.
    pub fn structured_text(&self, name: &Name, about: &str) -> Option<String> {
        let texts = self.blocks(name, about)?;
        let texts: Vec<String> = texts.iter().map(Block::text).collect();
        Some(texts.join("\n"))
    }

    /// The same as PLCopen XML, made on a `day` such as 2026-11-28.
    pub fn plcopen(&self, name: &Name, about: &str, day: &str) -> Option<String> {
        Some(plcopen::project(
            &self.title,
            day,
            &self.blocks(name, about)?,
        ))
    }

    fn blocks(&self, name: &Name, about: &str) -> Option<[Block; 2]> {
        if self.kind() != (Number::F32, LayoutName::Spline) {
            return None;
        }
        let wide = Wide::of(&self.whole()?.words, self.domain)?;
        Some([
            self.tick_block(&wide, name, about),
            self.test_block(&wide, name)?,
        ])
    }
}
