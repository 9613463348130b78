//! What can be wrong with a cam.

use core::fmt;

use crate::Error;

/// Why a cam program or a cam cannot be built. Segments are counted from 0 here, and from 1 in messages.
///
/// Displacements of a swinging follower are angles: read rad where a message of the program says m.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum CamError {
    /// The program has no segment.
    Empty,
    /// A number of the segment is NaN or infinite.
    NotFinite {
        /// Index of the segment.
        segment: usize,
    },
    /// The angle of the segment is not greater than zero.
    Angle {
        /// Index of the segment.
        segment: usize,
        /// Its angle (rad).
        angle: f64,
    },
    /// A dwell with a rise.
    DwellRises {
        /// Index of the segment.
        segment: usize,
        /// Its rise.
        rise: f64,
    },
    /// The shares of the segment's trapezoid are not possible.
    Shares {
        /// Index of the segment.
        segment: usize,
    },
    /// The segments do not cover exactly one turn.
    NotOneTurn {
        /// Sum of their angles (rad).
        sum: f64,
    },
    /// The follower is not back at its start after the last segment.
    NotClosed {
        /// Index of the last segment that moves the follower.
        segment: usize,
        /// The sum of all rises (m, or rad).
        gap: f64,
    },
    /// The follower's velocity jumps at the end of the segment.
    VelocityJump {
        /// Index of the segment.
        segment: usize,
        /// Where (rad).
        phi: f64,
        /// s′ at its end (m/rad, or rad/rad).
        from: f64,
        /// s′ at the start of the next segment.
        to: f64,
    },
    /// The roller's centre cannot be on the follower's path: the cam is too small for the guide's offset.
    Offset {
        /// Offset (m).
        offset: f64,
        /// The base radius must be larger than this (m).
        base_radius: f64,
    },
    /// The arm cannot keep the roller on the base circle.
    Arm {
        /// Distance of the arm's pivot from the cam's (m).
        pivot_distance: f64,
        /// Base radius + roller radius must be larger than the first and smaller than the second of these (m).
        reach: [f64; 2],
    },
    /// The face that swings cannot lie on the base circle: its pivot is too near to the cam.
    Face {
        /// Distance of the pivot from the cam's (m).
        pivot_distance: f64,
        /// It must be larger than this (m).
        least: f64,
    },
    /// The swinging follower goes beyond the position where its arm and the line of the pivots are stretched or folded.
    Swing {
        /// Where (rad).
        phi: f64,
    },
    /// The follower would come down to the cam's axis.
    BelowAxis {
        /// Where (rad).
        phi: f64,
    },
    /// The cam would have to be cut away: the roller or the face does not touch it where it should.
    Undercut {
        /// Where it is worst (rad).
        phi: f64,
        /// Radius of curvature there (m): of the pitch curve for a roller, of the profile for a flat face.
        radius: f64,
        /// The radius of curvature must be larger than this (m): the roller's radius, or zero.
        limit: f64,
        /// The smallest base radius that cures it (m); `None` if none does.
        base_radius: Option<f64>,
    },
    /// The cam is so large that it would cover the axis about which its follower swings.
    CoversPivot {
        /// Where the profile is farthest from the cam's axis (rad).
        phi: f64,
        /// How far (m).
        reach: f64,
        /// Distance of the two axes (m).
        pivot: f64,
    },
    /// A swinging face turns with the cam as fast as the cam itself, so it touches in no single point.
    FaceTooFast {
        /// Where (rad).
        phi: f64,
        /// dψ/dφ of the face, which must be below 1.
        ratio: f64,
    },
}

impl fmt::Display for CamError {
    #[expect(clippy::too_many_lines, reason = "one message for each mistake")]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let deg = |phi: f64| phi.to_degrees();
        match *self {
            Self::Empty => write!(
                f,
                "the cam program has no segment: give rises, dwells and returns over one turn"
            ),
            Self::NotFinite { segment } => {
                write!(f, "segment {}: a value is not a finite number", segment + 1)
            }
            Self::Angle { segment, angle } => write!(
                f,
                "segment {}: its angle is {:.6}°, but must be greater than zero",
                segment + 1,
                deg(angle)
            ),
            Self::DwellRises { segment, rise } => write!(
                f,
                "segment {}: a dwell cannot rise by {rise}; give it a motion law",
                segment + 1
            ),
            Self::Shares { segment } => write!(
                f,
                "segment {}: the shares of the trapezoid must be greater than zero and together at most 1",
                segment + 1
            ),
            Self::NotOneTurn { sum } => write!(
                f,
                "the segments cover {:.6}°, but must cover exactly one turn: {} {:.6}°",
                deg(sum),
                if sum < core::f64::consts::TAU {
                    "add"
                } else {
                    "remove"
                },
                deg((core::f64::consts::TAU - sum).abs())
            ),
            Self::NotClosed { segment, gap } => write!(
                f,
                "after a turn the follower is {gap:.3e} m off its start: the rises must add up to zero; \
                 change the rise of segment {} by {:.3e}",
                segment + 1,
                -gap
            ),
            Self::VelocityJump {
                segment,
                phi,
                from,
                to,
            } => write!(
                f,
                "segment {}: the follower's velocity jumps at its end, φ = {:.2}°, from s′ = {from} to {to} m/rad; \
                 make both ends equal",
                segment + 1,
                deg(phi)
            ),
            Self::Offset {
                offset,
                base_radius,
            } => write!(
                f,
                "the base radius is too small for the guide's offset of {offset} m: make it larger than {base_radius} m, \
                 or reduce the offset"
            ),
            Self::Arm {
                pivot_distance,
                reach,
            } => write!(
                f,
                "the arm cannot hold the roller on the base circle: with its pivot {pivot_distance} m from the cam's, base \
                 radius + roller radius must lie between {} m and {} m",
                reach[0], reach[1]
            ),
            Self::Face {
                pivot_distance,
                least,
            } => write!(
                f,
                "the face cannot lie on the base circle: its pivot is {pivot_distance} m from the cam's, but must be \
                 farther than base radius + face offset = {least} m"
            ),
            Self::Swing { phi } => write!(
                f,
                "the follower swings too far at φ = {:.2}°: beyond the line of the two pivots, or square to it; reduce \
                 the rise or move the pivot",
                deg(phi)
            ),
            Self::BelowAxis { phi } => write!(
                f,
                "the follower goes down to the cam's axis at φ = {:.2}°: make the base radius larger",
                deg(phi)
            ),
            Self::Undercut {
                phi,
                radius,
                limit,
                base_radius,
            } => {
                write!(
                    f,
                    "undercut at φ = {:.2}°: the radius of curvature is {radius:.6} m, but must be larger than {limit} m; ",
                    deg(phi)
                )?;
                match base_radius {
                    Some(least) => write!(f, "make the base radius larger than {least:.6} m"),
                    None => write!(
                        f,
                        "no base radius cures it here: reduce the rise or give it a longer angle"
                    ),
                }
            }
            Self::CoversPivot { phi, reach, pivot } => write!(
                f,
                "the cam reaches {reach:.6} m from its axis at φ = {:.2}° and so covers the follower's pivot, {pivot:.6} m away: \
                 make the base radius smaller or move the pivot outwards",
                deg(phi)
            ),
            Self::FaceTooFast { phi, ratio } => write!(
                f,
                "the face turns {ratio:.3} times as fast as the cam at φ = {:.2}°, but must be slower than the cam: \
                 reduce the rise or give it a longer angle",
                deg(phi)
            ),
        }
    }
}

impl From<CamError> for Error {
    fn from(error: CamError) -> Self {
        Self::Cam(error)
    }
}
