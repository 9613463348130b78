//! A spline table of the image in double precision: the same numbers, as a PLC computes with them.

use jred::table::{Constants, Shape, Table};
use jred::{AnyModel, CurveSet, Domain, Image, Spline, curves};

/// A spline table in double precision: the same numbers as in the image.
pub(crate) struct Wide {
    words: Vec<f64>,
    pub(crate) shape: Shape<Spline<f64>>,
}

impl Wide {
    /// The table of an image of single precision.
    pub(crate) fn of(words: &[u32], domain: Domain) -> Option<Self> {
        let table = Image::new(words).ok()?.table::<Spline<f32>>().ok()?;
        let constants = table.constants();
        Some(Self {
            words: table.words().iter().map(|word| f64::from(*word)).collect(),
            shape: Shape {
                set: table.set(),
                cells: table.cells(),
                domain,
                scale: *table.scale(),
                constants: Constants {
                    inertia: constants.inertia.into(),
                    viscous: constants.viscous.into(),
                    coulomb: constants.coulomb.into(),
                    gains: constants.gains,
                },
            },
        })
    }

    /// Whether it has one of these curves. Every table has that of J.
    pub(crate) fn has(&self, curves: CurveSet) -> bool {
        curves == curves::INERTIA || self.shape.set & curves != 0
    }

    /// The control points of a curve of the set: of J for [`curves::INERTIA`].
    pub(crate) fn points(&self, curve: CurveSet) -> Vec<f64> {
        let width = curves::width(self.shape.set);
        let column = match curve {
            curves::INERTIA => 0,
            curve => curves::width(self.shape.set & (curve - 1)),
        };
        let points = self.words.iter().skip(column).step_by(width);
        points.copied().collect()
    }

    /// The library's own tick over it.
    pub(crate) fn model(&self) -> Option<AnyModel<'_, Spline<f64>>> {
        AnyModel::new(Table::new(&self.words, self.shape).ok()?).ok()
    }
}
