//! Whether a cam with this program can be manufactured.

use super::follower::Follower;
use super::geometry::{Geometry, Touch};
use crate::math;
use crate::mechanism::cam::{CamError, Extreme, Program, smallest};

/// The geometry with this base radius, checked over the whole turn.
pub(super) fn checked(
    program: &Program,
    follower: Follower,
    base_radius: f64,
) -> Result<Geometry, CamError> {
    let geometry = placed(program, follower, base_radius)?;
    let worst = least(program, |phi| touch(program, &geometry, phi).margin);
    if worst.value <= 0.0 {
        return Err(CamError::Undercut {
            phi: worst.phi,
            radius: touch(program, &geometry, worst.phi).radius,
            limit: follower.roller_radius(),
            base_radius: cure(program, follower, base_radius),
        });
    }
    clear_of_pivot(program, &geometry)?;
    Ok(geometry)
}

/// Checks that the cam does not reach the axis of its swinging follower.
fn clear_of_pivot(program: &Program, geometry: &Geometry) -> Result<(), CamError> {
    let Some(([x, y], _)) = geometry.follower.pivot() else {
        return Ok(());
    };
    let length = |[x, y]: [f64; 2]| math::sqrt(x * x + y * y);
    let pivot = length([x, y]);
    let farthest = least(program, |phi| -length(touch(program, geometry, phi).point));
    if -farthest.value < pivot {
        return Ok(());
    }
    Err(CamError::CoversPivot {
        phi: farthest.phi,
        reach: -farthest.value,
        pivot,
    })
}

/// The geometry, with every position of the follower checked separately.
fn placed(program: &Program, follower: Follower, base_radius: f64) -> Result<Geometry, CamError> {
    let geometry = Geometry::new(base_radius, follower)?;
    geometry.check_range(program.range())?;
    if let Follower::OscillatingFace { swing, .. } = follower {
        let fastest = least(program, |phi| -swing.sign() * program.displacement(phi).d1);
        if fastest.value <= -1.0 {
            return Err(CamError::FaceTooFast {
                phi: fastest.phi,
                ratio: -fastest.value,
            });
        }
    }
    Ok(geometry)
}

/// The smallest base radius above `from` (m) without undercut: increased until it fits, then bisected.
fn cure(program: &Program, follower: Follower, from: f64) -> Option<f64> {
    const GROWTH: f64 = 1.02;
    const STEPS: u32 = 400;
    let fits = |radius: f64| {
        placed(program, follower, radius).is_ok_and(|geometry| {
            least(program, |phi| touch(program, &geometry, phi).margin).value > 0.0
                && clear_of_pivot(program, &geometry).is_ok()
        })
    };
    let mut low = from;
    for _ in 0..STEPS {
        let mut high = low * GROWTH;
        if fits(high) {
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if fits(middle) {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            return Some(high);
        }
        low = high;
    }
    None
}

/// Smallest and largest pressure angle.
pub(super) fn pressure_angles(program: &Program, geometry: &Geometry) -> [Extreme; 2] {
    both(program, |phi| touch(program, geometry, phi).pressure_angle)
}

/// Smallest and largest curvature of the profile.
pub(super) fn curvatures(program: &Program, geometry: &Geometry) -> [Extreme; 2] {
    both(program, |phi| touch(program, geometry, phi).curvature)
}

fn both(program: &Program, f: impl Fn(f64) -> f64) -> [Extreme; 2] {
    let low = least(program, &f);
    let high = least(program, |phi| -f(phi));
    [
        low,
        Extreme {
            value: -high.value,
            ..high
        },
    ]
}

fn touch(program: &Program, geometry: &Geometry, phi: f64) -> Touch {
    geometry.touch(program.displacement(phi))
}

fn least(program: &Program, f: impl Fn(f64) -> f64) -> Extreme {
    match smallest(program.pieces(), |phi| {
        Ok::<_, core::convert::Infallible>(f(phi))
    }) {
        Ok(extreme) => extreme,
        Err(never) => match never {},
    }
}
