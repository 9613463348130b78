//! Errors of the core about a cam, in terms of the machine file.

use jred::mechanism::cam::CamError;

use crate::read::mechanism::core;
use crate::text::problem::Problem;
use crate::text::section::Section;
use crate::text::value::Value;

/// The error of the core, shown at the key to change.
pub(in crate::read::mechanism) fn problem(
    section: &Section,
    follower: &Section,
    base_radius: &Value,
    error: CamError,
) -> Problem {
    let deg = |phi: f64| format!("{:.2}°", phi.to_degrees());
    match error {
        CamError::Undercut {
            phi,
            radius,
            limit,
            base_radius: cure,
        } => {
            let found = base_radius.problem(
                &format!(
                    "is too small: the cam is undercut at φ = {}, where the radius of curvature is {}, but must be \
                     greater than {}",
                    deg(phi),
                    base_radius.show(radius),
                    base_radius.show(limit)
                ),
                "undercut",
            );
            match cure {
                Some(least) => found.help(format!(
                    "make the base radius greater than {}, or the rise smaller, or its angle longer",
                    base_radius.show(least)
                )),
                None => found
                    .help("no base radius is large enough: make the rise smaller, its angle longer, or the roller smaller"),
            }
        }
        CamError::Offset {
            offset,
            base_radius: least,
        } => base_radius
            .problem(
                &format!(
                    "is too small for the offset of the guide, {}",
                    base_radius.show(offset)
                ),
                "too small",
            )
            .help(format!(
                "make it greater than {}, or the offset smaller",
                base_radius.show(least)
            )),
        CamError::Arm {
            pivot_distance,
            reach,
        } => follower
            .problem(
                format!(
                    "the arm in {} cannot hold the roller on the base circle",
                    follower.title()
                ),
                "this follower",
            )
            .help(format!(
                "with the pivot {} from the cam axis, base radius + roller radius must be between {} and {}",
                base_radius.show(pivot_distance),
                base_radius.show(reach[0]),
                base_radius.show(reach[1])
            )),
        CamError::Face {
            pivot_distance,
            least,
        } => follower
            .problem(
                format!(
                    "the face in {} cannot lie on the base circle",
                    follower.title()
                ),
                "this follower",
            )
            .help(format!(
                "its pivot is {} from the cam axis, but must be farther away than base radius + offset = {}",
                base_radius.show(pivot_distance),
                base_radius.show(least)
            )),
        CamError::CoversPivot { phi, reach, pivot } => base_radius
            .problem(
                &format!(
                    "is too large: at φ = {1} the cam reaches {0} from its axis and covers the follower's pivot, {2} away",
                    base_radius.show(reach),
                    deg(phi),
                    base_radius.show(pivot)
                ),
                "too large",
            )
            .help("make the base radius or the rise smaller, or move the pivot outwards"),
        _ => core(section, error),
    }
}
