//! Pages of sections with pictures, without a script.

use askama::Template;

use crate::answer::{Answer, Block};
use crate::plot::{Axes, Axis, lines};
use jred_file::model::machine::MachineFile;
use jred_file::number::columns::{Column, ColumnQuantity, Columns};

use super::figures::line;

/// A heading with its content.
pub(super) struct Section {
    pub(super) heading: String,
    pub(super) figures: Vec<Figure>,
}

/// A picture.
pub(super) struct Figure {
    pub(super) svg: String,
    pub(super) caption: String,
}

impl Section {
    pub(super) fn new(heading: impl Into<String>, figures: Vec<Figure>) -> Self {
        let heading = heading.into();
        Self { heading, figures }
    }

    /// A section with one picture and no text.
    pub(super) fn of(heading: &str, svg: String) -> Self {
        let caption = String::new();
        Self::new(heading, vec![Figure { svg, caption }])
    }
}

impl Figure {
    pub(super) fn new(svg: String, caption: impl Into<String>) -> Self {
        let caption = caption.into();
        Self { svg, caption }
    }
}

/// A page about a motion.
#[derive(Template)]
#[template(path = "motion.html")]
pub(super) struct MotionPage<'a> {
    title: &'a str,
    /// Kind of page, for the window title.
    subject: &'static str,
    about: String,
    version: &'static str,
    file: &'a str,
    blocks: &'a [Block],
    sections: Vec<Section>,
}

impl<'a> MotionPage<'a> {
    pub(super) fn page(
        file: &'a MachineFile,
        subject: &'static str,
        about: impl Into<String>,
        answer: &'a Answer,
        sections: Vec<Section>,
    ) -> String {
        let page = Self {
            title: &file.title,
            subject,
            about: capital(about.into()),
            version: env!("CARGO_PKG_VERSION"),
            file: &file.name,
            blocks: &answer.blocks,
            sections,
        };
        // Rendering into a string fails only for a wrong template, which the tests show.
        page.render().unwrap_or_default()
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
