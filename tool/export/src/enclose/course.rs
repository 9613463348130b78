//! Curves over a position in intervals: the cubics of a spline, with enclosures between their knots.

use std::f64::consts::TAU;

use jred::machine::Window;
use jred_enclosure::{Curves, Interval, LinkFrame, TaylorForm, factor};

use jred_file::model::virtual_link::{Direction, LinkCurve, LinkPoint, LoadTable, TableVariable};
use jred_file::number::spline::{CubicPiece, Spline};

/// A curve and its derivative by its variable.
struct FormWithSlope {
    value: TaylorForm,
    slope: TaylorForm,
}

/// Adds the represented curve to those of the machine.
pub(super) fn add(
    curves: &mut Curves,
    course: &LinkCurve,
    places: &[LinkFrame<TaylorForm>],
    stretch: [f64; 2],
    window: Option<&Window>,
) {
    let phi = TaylorForm::variable(stretch);
    let part = window.map(|window| factor(window, stretch));
    let times = |curve: TaylorForm| part.map_or(curve, |part| part * curve);
    let rates = |on: &LinkPoint| point(on, places).map(|c| c.derivative());
    match course {
        LinkCurve::Inertia(curve) => {
            let found = at(curve, &phi);
            curves.inertia = curves.inertia + found.value;
            curves.inertia_slope = curves.inertia_slope + found.slope;
        }
        LinkCurve::Payload { mass, on, axis } => {
            let found = at(mass, &phi);
            let rate = rates(on)[*axis % 2];
            let square = rate.square();
            curves.inertia = curves.inertia + found.value * square;
            curves.inertia_slope =
                curves.inertia_slope + found.slope * square + found.value * square.derivative();
        }
        LinkCurve::Torque(curve) => curves.load = curves.load + times(at(curve, &phi).value),
        LinkCurve::Potential { torque, .. } => curves.load = curves.load + at(torque, &phi).value,
        LinkCurve::Opposing(curve) => {
            curves.coulomb = curves.coulomb + times(at(curve, &phi).value.magnitude());
        }
        LinkCurve::Viscous(curve) => {
            let value = at(curve, &phi).value;
            // A value below zero by rounding counts as zero.
            let value = if value.values().lo() < 0.0 {
                TaylorForm::somewhere(Interval::between(0.0, value.values().hi().max(0.0)))
            } else {
                value
            };
            curves.viscous = curves.viscous + times(value);
        }
        LinkCurve::Weight { mass, on, gravity } => {
            let [x, y] = rates(on);
            let fall = x * gravity[0] + y * gravity[1];
            curves.load = curves.load + times(at(mass, &phi).value * fall);
        }
        LinkCurve::Thrust { force, on } => {
            let [x, y] = rates(on);
            let force = force_at(force, &phi, places).magnitude();
            curves.coulomb = curves.coulomb + times(force * x.length(&y));
        }
        LinkCurve::Force { force, on, along } => {
            let [x, y] = rates(on);
            let [e_x, e_y] = match along {
                Direction::Fixed(vector) => vector.map(TaylorForm::constant),
                Direction::OnLink(vector) => link(on.link, places).vector(*vector),
            };
            let way = e_x * x + e_y * y;
            curves.load = curves.load + times(force_at(force, &phi, places) * way);
        }
        LinkCurve::Moment {
            moment,
            link: number,
        } => {
            let turn = link(*number, places).psi.derivative();
            curves.load = curves.load + times(force_at(moment, &phi, places) * turn);
        }
    }
}

fn link(number: usize, places: &[LinkFrame<TaylorForm>]) -> LinkFrame<TaylorForm> {
    places.get(number).copied().unwrap_or(LinkFrame::GROUND)
}

fn point(on: &LinkPoint, places: &[LinkFrame<TaylorForm>]) -> [TaylorForm; 2] {
    link(on.link, places).point(on.at)
}

/// A force over a position.
fn force_at(table: &LoadTable, phi: &TaylorForm, places: &[LinkFrame<TaylorForm>]) -> TaylorForm {
    let (curve, over, turns) = table.parts();
    let place = match over {
        TableVariable::Drive => *phi,
        TableVariable::Point {
            link: number,
            at,
            axis,
            zero,
        } => link(number, places).point(at)[axis % 2] - TaylorForm::constant(zero),
    };
    if !turns {
        return at(curve, &place).value;
    }
    // The rows, zero at both ends and beyond, repeat with every turn.
    let [from, to] = curve.range();
    let middle = place.at.0[0].middle();
    let turn = ((middle - from) / TAU).floor();
    let place = place - TaylorForm::somewhere(Interval::turn() * turn);
    let values = place.values();
    if values.width() > TAU {
        return TaylorForm::somewhere(Interval::ALL);
    }
    let rows = curve.pieces_between(curve.range());
    let rows = rows
        .iter()
        .filter(|piece| piece.ends.iter().all(|end| end.is_finite()));
    let gap = CubicPiece {
        ends: [to, from + TAU],
        origin: to,
        coefficients: [0.0; 4],
    };
    let once: Vec<CubicPiece> = rows.copied().chain([gap]).collect();
    let shifted = [-TAU, 0.0, TAU].into_iter().flat_map(|turn| {
        once.iter().map(move |piece| CubicPiece {
            ends: piece.ends.map(|end| end + turn),
            origin: piece.origin + turn,
            ..*piece
        })
    });
    let pieces: Vec<CubicPiece> = shifted
        .filter(|piece| piece.ends[0] <= values.hi() && values.lo() <= piece.ends[1])
        .collect();
    joined(&pieces, &place).value
}

fn at(curve: &Spline, place: &TaylorForm) -> FormWithSlope {
    let values = place.values();
    let values = [values.lo(), values.hi()];
    if values.iter().any(|end| !end.is_finite()) {
        let all = TaylorForm::somewhere(Interval::ALL);
        return FormWithSlope {
            value: all,
            slope: all,
        };
    }
    joined(&curve.pieces_between(values), place)
}

/// The cubic in the middle, and the deviation of the other cubics on the stretch from it.
fn joined(pieces: &[CubicPiece], place: &TaylorForm) -> FormWithSlope {
    let middle = place.at.0[0].middle();
    let values = place.values();
    let away = |piece: &CubicPiece| (piece.ends[0] - middle).max(middle - piece.ends[1]);
    let main = pieces.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
    let Some(main) = main else {
        let all = TaylorForm::somewhere(Interval::ALL);
        return FormWithSlope {
            value: all,
            slope: all,
        };
    };
    // Knots and periods are rounded: a piece may end slightly beside its nominal end.
    let beside = 1e-14 * (1.0 + values.size());
    let (mut apart, mut apart_slope) = (0.0_f64, 0.0_f64);
    for other in pieces {
        let low = values.lo().max(other.ends[0] - beside);
        let high = values.hi().min(other.ends[1] + beside);
        if low <= high && other != main {
            let u = TaylorForm::variable([low, high]);
            let [own, its] = [main, other].map(|piece| polynomials(piece, &u));
            // As series about the middle of their common range.
            let half = 0.5 * (high - low) + beside;
            let size = |a: TaylorForm, b: TaylorForm| {
                let (mut sum, mut power) = (0.0, 1.0);
                for term in &(a - b).at.0[..4] {
                    sum += term.size() * power;
                    power *= half;
                }
                sum * (1.0 + 1e-12)
            };
            apart = apart.max(size(own.value, its.value));
            apart_slope = apart_slope.max(size(own.slope, its.slope));
        }
    }
    let found = polynomials(main, place);
    let widened = |form: TaylorForm, by: f64| {
        if by > 0.0 {
            form + TaylorForm::somewhere(Interval::within(by))
        } else {
            form
        }
    };
    FormWithSlope {
        value: widened(found.value, apart),
        slope: widened(found.slope, apart_slope),
    }
}

fn polynomials(piece: &CubicPiece, place: &TaylorForm) -> FormWithSlope {
    let u = *place - TaylorForm::constant(piece.origin);
    let [a, b, c, d] = piece.coefficients;
    FormWithSlope {
        value: u.polynomial(&[a, b, c, d]),
        slope: u.polynomial(&[b, 2.0 * c, 3.0 * d]),
    }
}
