//! Positions of links on a stretch of the drive link's range.

use jred::machine::Marker;

use crate::interval::Interval;
use crate::series::Series;
use crate::taylor_form::TaylorForm;

/// A link's frame with its Taylor series: origin, angle, and sine and cosine of the angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkFrame<T> {
    /// Origin, x (m).
    pub x: T,
    /// Origin, y (m).
    pub y: T,
    /// Angle of its u axis (rad).
    pub psi: T,
    /// Sine of the angle.
    pub sin: T,
    /// Cosine of the angle.
    pub cos: T,
}

impl LinkFrame<TaylorForm> {
    /// The fixed frame.
    pub const GROUND: Self = Self {
        x: TaylorForm::constant(0.0),
        y: TaylorForm::constant(0.0),
        psi: TaylorForm::constant(0.0),
        sin: TaylorForm::constant(0.0),
        cos: TaylorForm::constant(1.0),
    };

    /// A link with its origin and its angle.
    #[must_use]
    pub fn new([x, y]: [TaylorForm; 2], psi: TaylorForm) -> Self {
        let (sin, cos) = psi.sin_cos();
        Self {
            x,
            y,
            psi,
            sin,
            cos,
        }
    }

    /// Joins the series in the middle of the stretch and over the stretch.
    pub(crate) fn joined(at: &LinkFrame<Series>, over: &LinkFrame<Series>) -> Self {
        let form = |at: &Series, over: &Series| TaylorForm {
            at: *at,
            over: *over,
        };
        Self {
            x: form(&at.x, &over.x),
            y: form(&at.y, &over.y),
            psi: form(&at.psi, &over.psi),
            sin: form(&at.sin, &over.sin),
            cos: form(&at.cos, &over.cos),
        }
    }

    /// A vector of the link, [u, v], in the coordinates of the mechanism.
    #[must_use]
    pub fn vector(&self, [u, v]: [f64; 2]) -> [TaylorForm; 2] {
        [self.cos * u - self.sin * v, self.sin * u + self.cos * v]
    }

    /// A point of the link.
    #[must_use]
    pub fn point(&self, at: [f64; 2]) -> [TaylorForm; 2] {
        let [x, y] = self.vector(at);
        [self.x + x, self.y + y]
    }
}

pub(crate) fn body(marker: &Marker, places: &[LinkFrame<TaylorForm>]) -> LinkFrame<TaylorForm> {
    let link = marker.body.link().and_then(|link| places.get(link));
    link.copied().unwrap_or(LinkFrame::GROUND)
}

/// A marker's direction from +x.
pub(crate) fn direction(marker: &Marker, places: &[LinkFrame<TaylorForm>]) -> TaylorForm {
    body(marker, places).psi + TaylorForm::somewhere(Interval::of(marker.angle()))
}
