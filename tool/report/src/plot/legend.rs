//! The legend below the axes: entries in columns.

use super::svg::{Anchor, Ink, Svg, dash_array};
use super::{HEIGHT, NUMBER, Series, Style, colour, dashes, width};

/// Height of a row, and width of a key with its gaps (px).
const ROW: f64 = 17.0;
const KEY: f64 = 24.0;
const GAP: f64 = 6.0;

struct LegendEntry {
    name: String,
    index: usize,
    style: Style,
}

/// The named curves with the positions of their entries.
pub(super) struct Legend {
    entries: Vec<LegendEntry>,
    left: f64,
    /// Width of a column.
    column: f64,
    columns: usize,
}

impl Legend {
    /// Entries of the curves on both vertical axes, between these ends of the horizontal one.
    pub(super) fn new(left: &[Series], right: &[Series], [from, to]: [f64; 2]) -> Self {
        let all = left.iter().map(|series| (series, ""));
        let all = all.chain(right.iter().map(|series| (series, " (right axis)")));
        let entries: Vec<LegendEntry> = all
            .enumerate()
            .filter(|(_, (series, _))| !series.name.is_empty())
            .map(|(index, (series, suffix))| LegendEntry {
                name: format!("{}{suffix}", series.name),
                index,
                style: series.style,
            })
            .collect();
        let widest = entries.iter().map(|entry| width(&entry.name, NUMBER));
        let column = KEY + GAP + widest.fold(0.0, f64::max) + 3.0 * GAP;
        let most = (((to - from) / column).floor() as usize).max(1);
        // As many rows as needed, and no more columns than they need.
        let rows = entries.len().div_ceil(most).max(1);
        Self {
            columns: entries.len().div_ceil(rows).max(1),
            entries,
            left: from,
            column,
        }
    }

    /// Height (px).
    pub(super) fn height(&self) -> f64 {
        self.entries.len().div_ceil(self.columns) as f64 * ROW
    }

    pub(super) fn draw(&self, svg: &mut Svg) {
        let top = HEIGHT - self.height() - 4.0;
        for (k, entry) in self.entries.iter().enumerate() {
            let x = self.left + (k % self.columns) as f64 * self.column;
            let y = top + ((k / self.columns) as f64 + 0.5) * ROW;
            let colour = colour(entry.index);
            if entry.style == Style::Dots {
                let ink = Ink::line(colour, 0.0).filled(colour);
                svg.circle([x + 0.5 * KEY, y], 3.0, &ink);
            } else {
                let dashes = dash_array(dashes(entry.index, entry.style));
                let ink = format!("stroke=\"{colour}\" stroke-width=\"2\"{dashes}");
                svg.open(&ink, "");
                svg.rule([x, y], [x + KEY, y]);
                svg.close();
            }
            let at = [x + KEY + GAP, y + 0.36 * NUMBER];
            let look = format!("font-size=\"{NUMBER}\"");
            svg.text(at, Anchor::Start, &look, &entry.name);
        }
    }
}
