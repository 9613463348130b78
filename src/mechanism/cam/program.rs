//! The displacement of a follower over one turn of the cam.

use crate::number::error::RangeError;
use core::f64::consts::TAU;

use super::extreme::{Extreme, smallest};
use super::segment::{Segment, Shape};
use crate::math;
use crate::mechanism::cam::CamError;
use crate::number::transfer::Transfer;

/// Greatest number of segments of a program.
pub const MAX_SEGMENTS: usize = 16;

/// Relative difference that counts as rounding: of a turn, of the largest displacement, of the largest velocity.
const CLOSED: f64 = 1e-9;

/// s(φ) over one turn of the cam, from φ = 0 on: consecutive segments, repeated every turn.
///
/// s, s′, s″ and s‴ are exact, as a [`Transfer`]. s and s′ are continuous; s″ may jump at the ends of a segment or at a break of its law: see
/// [`acceleration_jumps`](Self::acceleration_jumps).
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    segments: heapless::Vec<ProgramSegment, MAX_SEGMENTS>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct ProgramSegment {
    segment: Segment,
    /// φ and s at its start.
    from: f64,
    height: f64,
}

/// A range of φ over which s and all its derivatives are smooth.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Piece {
    /// Start (rad).
    pub from: f64,
    /// End (rad).
    pub to: f64,
}

impl Piece {
    /// φ at a share (0 to 1) of the piece, with a margin at its ends, so that jumping quantities have this piece's value there.
    pub(crate) fn inside(self, share: f64) -> f64 {
        // The margin is larger than the rounding of φ within a turn.
        let hair = (1e-12 * (self.to - self.from)).max(4e-15);
        (self.from + share * (self.to - self.from)).clamp(self.from + hair, self.to - hair)
    }
}

/// A jump of the follower's acceleration: an infinite jerk, which excites vibrations.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct AccelerationJump {
    /// Angle (rad).
    pub phi: f64,
    /// s″ before it (m/rad², or rad/rad²).
    pub from: f64,
    /// s″ after it.
    pub to: f64,
}

impl Program {
    /// The program of these segments. The first begins at φ = 0, where s = 0: there the roller or the face touches the base circle.
    ///
    /// # Errors
    /// No segments or too many; an invalid segment; angles that do not add up to one turn, or rises that do not add up to zero, to 1e-9; a velocity
    /// that jumps. The error names the segment.
    pub fn new(segments: &[Segment]) -> Result<Self, CamError> {
        if segments.is_empty() {
            return Err(CamError::Empty);
        }
        for (index, segment) in segments.iter().enumerate() {
            segment.check(index)?;
        }
        let sum: f64 = segments.iter().map(|segment| segment.angle).sum();
        if math::abs(sum / TAU - 1.0) > CLOSED {
            return Err(CamError::NotOneTurn { sum });
        }
        let gap: f64 = segments.iter().map(|segment| segment.rise).sum();
        let largest = |f: fn(&Segment) -> f64| {
            segments
                .iter()
                .fold(0.0_f64, |most, segment| most.max(math::abs(f(segment))))
        };
        let last_move = segments.iter().rposition(|s| s.shape != Shape::Dwell);
        if math::abs(gap) > CLOSED * largest(|segment| segment.rise) {
            let segment = last_move.unwrap_or_default();
            return Err(CamError::NotClosed { segment, gap });
        }

        let mut placed = heapless::Vec::new();
        let (mut from, mut height) = (0.0, 0.0);
        for (index, segment) in segments.iter().enumerate() {
            let mut segment = *segment;
            segment.angle *= TAU / sum;
            // The remaining gap is rounding.
            if Some(index) == last_move {
                segment.rise -= gap;
            }
            let next = ProgramSegment {
                segment,
                from,
                height,
            };
            placed.push(next).map_err(|_| RangeError::TooMany {
                what: "segments of a cam program",
                capacity: MAX_SEGMENTS,
            })?;
            from += segment.angle;
            height += segment.rise;
        }
        let program = Self { segments: placed };
        let speed = largest(|segment| segment.rise / segment.angle);
        program.check_speeds(CLOSED * speed)?;
        Ok(program)
    }

    /// Checks that s′ is continuous from segment to segment.
    fn check_speeds(&self, tolerance: f64) -> Result<(), CamError> {
        let next = self.segments.iter().cycle().skip(1);
        for (index, (placed, next)) in self.segments.iter().zip(next).enumerate() {
            let [from, to] = [placed.segment.end_speeds()[1], next.segment.end_speeds()[0]];
            if math::abs(to - from) > tolerance {
                return Err(CamError::VelocityJump {
                    segment: index,
                    phi: placed.from + placed.segment.angle,
                    from,
                    to,
                });
            }
        }
        Ok(())
    }

    /// The segments.
    pub fn segments(&self) -> impl Iterator<Item = &Segment> {
        self.segments.iter().map(|placed| &placed.segment)
    }

    /// s(φ) (m, or rad) with s′, s″, s‴. At a jump, the value after it.
    #[must_use]
    pub fn displacement(&self, phi: f64) -> Transfer {
        let into = within_turn(phi);
        let at = self.segments.partition_point(|placed| placed.from <= into);
        let Some(placed) = self.segments.get(at.max(1) - 1) else {
            return Transfer::constant(0.0);
        };
        let z = (into - placed.from) / placed.segment.angle;
        Transfer::constant(placed.height) + placed.segment.at(z.clamp(0.0, 1.0))
    }

    /// The pieces of the turn over which s is smooth, in order.
    pub fn pieces(&self) -> impl Iterator<Item = Piece> + Clone + '_ {
        self.segments.iter().flat_map(|placed| {
            let breaks = placed.segment.breaks();
            let at = move |z: f64| placed.from + z * placed.segment.angle;
            let ends = breaks.into_iter().flatten().chain(core::iter::once(1.0));
            ends.scan(0.0, move |from, to| {
                let start = core::mem::replace(from, to);
                Some([start, to])
            })
            // Shares of a trapezoid that fill the segment leave no piece between them.
            .filter(|[from, to]| to - from > 1e-6)
            .map(move |[from, to]| Piece {
                from: at(from),
                to: at(to),
            })
        })
    }

    /// The jumps of s″, which laws such as the trapezoid or the simple sine have.
    pub fn acceleration_jumps(&self) -> impl Iterator<Item = AccelerationJump> + '_ {
        // Scale of the accelerations: smaller jumps are rounding of a place next to a jump.
        let size = self.segments().fold(0.0_f64, |most, segment| {
            most.max(math::abs(segment.rise) / (segment.angle * segment.angle))
        });
        let next = self.pieces().cycle().skip(1);
        self.pieces().zip(next).filter_map(move |(piece, next)| {
            let at = |phi: f64| self.displacement(phi).d2;
            let (from, to) = (at(piece.inside(1.0)), at(next.inside(0.0)));
            (math::abs(to - from) > 1e-6 * size).then_some(AccelerationJump {
                phi: piece.to,
                from,
                to,
            })
        })
    }

    /// The lowest and the highest position of the follower (m, or rad).
    #[must_use]
    pub fn range(&self) -> [Extreme; 2] {
        let signed = |sign: f64| {
            let least = self.smallest(|s| sign * s.value);
            Extreme {
                value: sign * least.value,
                ..least
            }
        };
        [signed(1.0), signed(-1.0)]
    }

    /// The largest |s′|, |s″| and |s‴|: per rad, rad² and rad³. s‴ excludes jumps of s″.
    #[must_use]
    pub fn peaks(&self) -> [Extreme; 3] {
        let most = |f: fn(Transfer) -> f64| {
            let least = self.smallest(|s| -math::abs(f(s)));
            Extreme {
                value: -least.value,
                ..least
            }
        };
        [most(|s| s.d1), most(|s| s.d2), most(|s| s.d3)]
    }

    fn smallest(&self, f: impl Fn(Transfer) -> f64) -> Extreme {
        let value = |phi| Ok::<_, core::convert::Infallible>(f(self.displacement(phi)));
        match smallest(self.pieces(), value) {
            Ok(extreme) => extreme,
            Err(never) => match never {},
        }
    }
}

/// φ within its turn: 0 to 2π.
pub(crate) fn within_turn(phi: f64) -> f64 {
    phi - TAU * math::floor(phi / TAU)
}
