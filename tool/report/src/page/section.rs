//! Pages of sections with blocks and pictures.

use askama::Template;

use crate::answer::{Answer, Block};
use crate::plot::{Axes, Axis, lines};
use crate::units;
use jred_file::model::machine::MachineFile;
use jred_file::number::columns::{Column, ColumnQuantity, Columns};

use super::chart::Chart;
use super::figures::line;

/// A heading with its content.
#[derive(Default)]
pub(super) struct Section {
    pub(super) heading: String,
    /// Summary under which the blocks are folded; empty: they are not.
    pub(super) folded: String,
    pub(super) blocks: Vec<Block>,
    pub(super) figures: Vec<Figure>,
}

/// A picture.
pub(super) struct Figure {
    pub(super) svg: String,
    /// Data for the page's script; empty without.
    pub(super) data: String,
    pub(super) caption: String,
}

impl Section {
    pub(super) fn new(heading: impl Into<String>, figures: Vec<Figure>) -> Self {
        Self {
            heading: heading.into(),
            figures,
            ..Self::default()
        }
    }

    /// A section with one picture and no text.
    pub(super) fn of(heading: &str, svg: String) -> Self {
        Self::new(heading, vec![Figure::new(svg, "")])
    }

    /// A section of blocks.
    pub(super) fn read(heading: impl Into<String>, write: impl FnOnce(&mut Answer)) -> Self {
        let mut answer = Answer::words("");
        write(&mut answer);
        Self {
            blocks: answer.shown(),
            ..Self::new(heading, Vec::new())
        }
    }
}

impl Figure {
    pub(super) fn new(svg: String, caption: impl Into<String>) -> Self {
        Self {
            svg,
            data: String::new(),
            caption: units::text(&caption.into()).into_owned(),
        }
    }

    /// A chart that the page's script draws once more.
    pub(super) fn live(chart: &Chart, caption: impl Into<String>) -> Self {
        Self {
            data: chart.json(),
            ..Self::new(chart.svg.clone(), caption)
        }
    }
}

/// A page of blocks and pictures.
#[derive(Template)]
#[template(path = "page.html")]
pub(super) struct Page<'a> {
    pub(super) title: &'a str,
    /// Kind of page, for the window title.
    pub(super) subject: &'static str,
    pub(super) about: String,
    pub(super) version: &'static str,
    pub(super) file: &'a str,
    /// Class of the first blocks; empty: they have none.
    pub(super) class: &'static str,
    pub(super) blocks: Vec<Block>,
    pub(super) sections: Vec<Section>,
}

impl<'a> Page<'a> {
    pub(super) fn new(
        file: &'a MachineFile,
        subject: &'static str,
        answer: &'a Answer,
        sections: Vec<Section>,
    ) -> Self {
        Self {
            title: &file.title,
            subject,
            about: String::new(),
            version: env!("CARGO_PKG_VERSION"),
            file: &file.name,
            class: "",
            blocks: answer.shown(),
            sections,
        }
    }

    /// The page of an answer, with a line on its subject.
    pub(super) fn page(
        file: &'a MachineFile,
        subject: &'static str,
        about: impl Into<String>,
        answer: &'a Answer,
        sections: Vec<Section>,
    ) -> String {
        Self::new(file, subject, answer, sections).html(about)
    }

    /// The page, with a line on its subject.
    pub(super) fn html(self, about: impl Into<String>) -> String {
        let about = capital(about.into());
        // Rendering into a string fails only for a wrong template, which the tests show.
        Self { about, ..self }.render().unwrap_or_default()
    }

    /// Whether it has charts for the script.
    fn is_live(&self) -> bool {
        let mut figures = self.sections.iter().flat_map(|section| &section.figures);
        figures.any(|figure| !figure.data.is_empty())
    }
}

/// Capitalises the first letter.
fn capital(mut text: String) -> String {
    if let Some(first) = text.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    text
}

/// A curve: its name, and its points.
type NamedCurve = (String, Vec<(f64, f64)>);

/// The columns of a quantity over another, each under a name.
fn curves(
    columns: &Columns,
    along: ColumnQuantity,
    quantity: ColumnQuantity,
    name: impl Fn(&Column) -> String,
) -> Vec<NamedCurve> {
    let Some((x, _)) = columns.of(along).next() else {
        return Vec::new();
    };
    let each = columns.of(quantity).map(|(y, head)| {
        let rows = columns.rows().iter();
        let value = |row: &[Option<f64>], k: usize| row.get(k).copied().flatten();
        let points = rows.filter_map(|row| Some((value(row, x)?, value(row, y)?)));
        (name(head), points.collect())
    });
    each.collect()
}

fn drawn(curves: &[NamedCurve], x: Axis, y: &str) -> String {
    let series = curves
        .iter()
        .map(|(name, points)| line(name, points.clone()));
    let axes = Axes { title: "", x, y };
    lines(&axes, &series.collect::<Vec<_>>())
}

/// The columns of a quantity over another, of several courses that each have a name.
pub(super) fn plot(
    runs: &[(&str, &Columns)],
    (along, axis): (ColumnQuantity, Axis),
    (y, quantity): (&str, ColumnQuantity),
) -> String {
    let all = runs.iter().flat_map(|(name, run)| {
        let alone = run.of(quantity).count() == 1 && !name.is_empty();
        // For a single column the axis label is enough.
        curves(run, along, quantity, |head| {
            if alone {
                (*name).to_owned()
            } else {
                head.title()
            }
        })
    });
    drawn(&all.collect::<Vec<_>>(), axis, y)
}

/// The columns of a quantity over another that are not zero everywhere, each named after its part; `None` without such columns.
pub(super) fn over(
    columns: &Columns,
    (along, axis): (ColumnQuantity, Axis),
    (y, quantity): (&str, ColumnQuantity),
) -> Option<String> {
    let mut all = curves(columns, along, quantity, |head| {
        let named = if head.part.is_empty() {
            &head.name
        } else {
            &head.part
        };
        named.clone()
    });
    all.retain(|(_, points)| points.iter().any(|(_, value)| *value != 0.0));
    (!all.is_empty()).then(|| drawn(&all, axis, y))
}
