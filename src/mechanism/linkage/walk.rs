//! Continuation along φ, (79), and the linkage as a mechanism.

use crate::machine::error::PoseError;
use crate::mechanism::linkage::LinkageError;
use crate::number::error::RangeError;
use core::f64::consts::TAU;

use crate::machine::joint::Joints;
use crate::machine::link::{Frame, Link};
use crate::machine::{Frames, Jointed, Mechanism};
use crate::number::error::finite;
use crate::number::transfer::Transfer;
use crate::{Domain, math};

use super::solver::{Solved, Unsolved};
use super::{Linkage, Pair, Pose};

/// The corrector may move a link so far (rad, or of the linkage's size): beyond, the predictor was not to be trusted.
const TRUSTED: f64 = 0.02;
/// Shortest step, of the drive's range: what cannot be passed with it is a dead point.
const SHORTEST: f64 = 1e-9;
/// Largest gap (rad, or of the linkage's size) between the ends of a turn that closes.
const CLOSED: f64 = 1e-9;

/// A coordinate at a station: its value and its first transfer function.
type Station<const LINKS: usize> = [[[f64; 2]; 3]; LINKS];

/// A linkage that was assembled and followed over the drive's whole range: a mechanism.
///
/// `STATIONS` positions (at least two) are kept, evenly spaced; a position between two is found from both of them. More of
/// them cost memory, 48 bytes a link, and save steps of Newton's method: from about 200 on, one step is enough for usual
/// linkages.
///
/// Accuracy: positions 1e-12, transfer functions and reduced inertia 1e-11 of the largest value, against closed forms and
/// golden data (tests `four_bar_golden_as_a_linkage` and those of `library_as_linkages.rs`). Cost: proportional to the number
/// of positions; in each, the sum over the [groups](Linkage::group_sizes), one of which costs at most the cube of its size
/// (bench `linkage`, docs/performance.md).
#[derive(Clone, Debug)]
pub struct Assembly<
    const LINKS: usize,
    const PAIRS: usize,
    const STATIONS: usize,
    const CAMS: usize = 0,
> {
    linkage: Linkage<LINKS, PAIRS, CAMS>,
    domain: Domain,
    stations: [Station<LINKS>; STATIONS],
    /// Signs of the determinants on this branch.
    signs: u64,
    /// How far each link's angle advances in a turn (rad).
    turn: [f64; LINKS],
}

impl<const LINKS: usize, const PAIRS: usize, const CAMS: usize> Linkage<LINKS, PAIRS, CAMS> {
    /// Assembles the linkage at the drive's position `phi` (rad, or m) from an approximate drawing, one pose a link, and
    /// follows it over the `domain`.
    ///
    /// # Errors
    /// A drawing far outside the domain, or one from which no position is found: which pair stays open and how far. A dead point of the drive or a change
    /// of branch: where, and at which pair. A turn after which a link is not where it was.
    pub fn assemble<const STATIONS: usize>(
        self,
        domain: Domain,
        phi: f64,
        drawing: &[Pose],
    ) -> Result<Assembly<LINKS, PAIRS, STATIONS, CAMS>, LinkageError> {
        const { assert!(STATIONS >= 2, "a range has two ends") }
        let span = domain.span();
        let [min, max] = [domain.position(0.0) - span, domain.position(1.0) + span];
        if !(min..=max).contains(&finite("drive position of the drawing", phi)?) {
            return Err(RangeError::OutOfRange {
                what: "drive position of the drawing",
                value: phi,
                min,
                max,
            }
            .into());
        }
        let mut frames = self.drawing(drawing)?;
        let first = self.solve(phi, &mut frames).map_err(|why| why.at(phi))?;
        let from = domain.position(0.0);
        let mut now = self.walk(phi, (first, &mut frames), from, span)?;
        let signs = now.signs;
        let start = frames.clone();
        let mut stations = [[[[0.0; 2]; 3]; LINKS]; STATIONS];
        let mut before = from;
        for (k, station) in stations.iter_mut().enumerate() {
            let next = domain.position(k as f64 / (STATIONS - 1) as f64);
            now = self.walk(before, (now, &mut frames), next, span)?;
            before = next;
            for (slot, frame) in station.iter_mut().zip(&frames) {
                *slot = [frame.x, frame.y, frame.psi].map(|c| [c.value, c.d1]);
            }
        }
        let mut turn = [0.0; LINKS];
        if domain == Domain::Turn {
            let ends = start.iter().zip(&frames).enumerate();
            for ((link, (start, end)), advance) in ends.zip(&mut turn) {
                *advance = self.closes(link, start, end)?;
            }
        }
        Ok(Assembly {
            linkage: self,
            domain,
            stations,
            signs,
            turn,
        })
    }

    /// How far a link's angle has advanced in a turn, if the link has returned: the same place, the same angle except for whole
    /// turns, the same first transfer functions. A balanced wheel that only rolls with other
    /// wheels may stop at any angle.
    fn closes(&self, link: usize, start: &Frame, end: &Frame) -> Result<f64, LinkageError> {
        let advance = end.psi.value - start.psi.value;
        let whole = math::floor(advance / TAU + 0.5) * TAU;
        let turned = math::abs(advance - whole);
        let balanced = self.links.get(link).is_some_and(Link::is_centred);
        let wheel = balanced && self.only_rolls(link);
        let apart = |a: f64, b: f64| math::abs(a - b);
        let gap = [
            if wheel { 0.0 } else { turned * self.size },
            apart(start.x.value, end.x.value),
            apart(start.y.value, end.y.value),
            apart(start.x.d1, end.x.d1),
            apart(start.y.d1, end.y.d1),
            apart(start.psi.d1, end.psi.d1) * self.size,
        ];
        let gap = gap.into_iter().fold(0.0, f64::max);
        if gap <= CLOSED * self.size {
            Ok(if turned <= CLOSED { whole } else { advance })
        } else {
            Err(LinkageError::NotClosed { link, gap })
        }
    }

    /// Whether nothing but the angles of other wheels depends on the angle of this link, and that in proportion.
    fn only_rolls(&self, link: usize) -> bool {
        let is_cam = |pair: usize| matches!(self.pairs.get(pair), Some(Pair::Cam { .. }));
        let mut held = self.structure.with_angle_of(link);
        held.all(|(equation, angles_alone)| angles_alone && !is_cam(equation.pair.into()))
    }

    /// From a solved position, where the links are in `frames`, to another φ, in steps as long as the predictor is to be trusted.
    fn walk(
        &self,
        from: f64,
        (start, frames): (Solved, &mut Frames),
        to: f64,
        span: f64,
    ) -> Result<Solved, PoseError> {
        let (mut phi, mut now) = (from, start);
        let mut step = to - from;
        let mut arrived = math::abs(step) == 0.0;
        while !arrived {
            let last = math::abs(to - phi) <= math::abs(step);
            let next = if last { to } else { phi + step };
            let mut there = predicted(frames, next - phi);
            let dead = match self.solve(next, &mut there) {
                Ok(found) if found.signs == now.signs && found.correction <= TRUSTED => {
                    (phi, now, arrived) = (next, found, last);
                    *frames = there;
                    step *= 2.0;
                    continue;
                }
                // Another solution, on the far side of a dead point.
                Ok(found) if found.signs != now.signs => PoseError::BranchChange {
                    phi: next,
                    joint: now.weakest,
                },
                _ => PoseError::DeadPoint {
                    phi: next,
                    joint: now.weakest,
                },
            };
            if math::abs(next - phi) <= SHORTEST * span {
                return Err(dead);
            }
            step = 0.5 * (next - phi);
        }
        Ok(now)
    }
}

impl Unsolved {
    fn at(self, phi: f64) -> PoseError {
        let Self { pair: joint, gap } = self;
        if gap > 0.0 {
            PoseError::CannotAssemble { phi, joint, gap }
        } else {
            PoseError::DeadPoint { phi, joint }
        }
    }
}

/// The links a step `h` on, by Taylor's polynomial of third order.
fn predicted(frames: &Frames, h: f64) -> Frames {
    let on =
        |c: Transfer| Transfer::constant(c.value + h * (c.d1 + h / 2.0 * (c.d2 + h / 3.0 * c.d3)));
    frames
        .iter()
        .map(|frame| Frame::turned([on(frame.x), on(frame.y)], on(frame.psi)))
        .collect()
}

impl<const LINKS: usize, const PAIRS: usize, const STATIONS: usize, const CAMS: usize>
    Assembly<LINKS, PAIRS, STATIONS, CAMS>
{
    /// The linkage.
    pub const fn linkage(&self) -> &Linkage<LINKS, PAIRS, CAMS> {
        &self.linkage
    }

    /// Another mass of a link: a new payload. The positions stay.
    ///
    /// # Errors
    /// A link that does not exist.
    pub fn set_link(&mut self, index: usize, link: Link) -> Result<(), LinkageError> {
        self.linkage.set_link(index, link)
    }

    /// How well the drive moves the linkage at `phi`: the smallest |det A|/Π‖column‖ over the groups' Jacobians A, with
    /// the index of the pair that it belongs to. 0 at a dead point, 1 at best; of a two-link group with pins at the
    /// frames' origins it is the sine of the transmission angle.
    ///
    /// # Errors
    /// Those of [`frames`](Mechanism::frames).
    pub fn quality(&self, phi: f64) -> Result<(f64, usize), PoseError> {
        let mut frames = Frames::new();
        let (solved, _) = self.solved(phi, &mut frames)?;
        Ok((solved.quality, solved.weakest))
    }

    /// Puts the links at `phi` into `frames`, without the whole turns, which are returned.
    fn solved(&self, phi: f64, frames: &mut Frames) -> Result<(Solved, f64), PoseError> {
        let phi = finite("drive position", phi)?;
        let (turns, phi) = match self.domain {
            Domain::Turn => {
                let turns = math::floor(phi / TAU);
                (turns, phi - turns * TAU)
            }
            Domain::Stroke { from, to } => (0.0, phi.clamp(from, to)),
        };
        let cells = (STATIONS - 1) as f64;
        let place = (phi - self.domain.position(0.0)) / self.domain.span() * cells;
        let cell = (math::floor(place).max(0.0) as usize).min(STATIONS - 2);
        self.between(cell, place - cell as f64, frames);
        if let Ok(solved) = self.linkage.solve(phi, frames)
            && solved.signs == self.signs
            && solved.correction <= TRUSTED
        {
            return Ok((solved, turns));
        }
        // Few stations, or a dead point nearby: follow the linkage from the station.
        let start = self.domain.position(cell as f64 / cells);
        self.between(cell, 0.0, frames);
        let station = self.linkage.solve(start, frames);
        let station = station.map_err(|why| why.at(start))?;
        let span = self.domain.span();
        let solved = self.linkage.walk(start, (station, frames), phi, span)?;
        Ok((solved, turns))
    }

    /// The links in a cell, u = 0 to 1, by Hermite's cubic polynomial.
    fn between(&self, cell: usize, u: f64, frames: &mut Frames) {
        let width = self.domain.span() / (STATIONS - 1) as f64;
        let (one, u2) = (1.0 - u, u * u);
        let weights = [
            (1.0 + 2.0 * u) * one * one,
            u * one * one * width,
            u2 * (3.0 - 2.0 * u),
            -u2 * one * width,
        ];
        let count = self.linkage.links.len();
        frames.clear();
        frames.extend((0..count).map(|link| {
            let [x, y, psi] = core::array::from_fn(|axis| {
                let [a, b] = [cell, cell + 1].map(|k| self.stations[k][link][axis]);
                Transfer::constant(
                    weights[0] * a[0] + weights[1] * a[1] + weights[2] * b[0] + weights[3] * b[1],
                )
            });
            Frame::turned([x, y], psi)
        }));
    }
}

impl<const LINKS: usize, const PAIRS: usize, const STATIONS: usize, const CAMS: usize> Mechanism
    for Assembly<LINKS, PAIRS, STATIONS, CAMS>
{
    fn links(&self) -> &[Link] {
        &self.linkage.links
    }

    fn domain(&self) -> Domain {
        self.domain
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let mut frames = Frames::new();
        let (_, turns) = self.solved(phi, &mut frames)?;
        for (frame, turn) in frames.iter_mut().zip(&self.turn) {
            *frame = frame.advanced(turns * turn);
        }
        Ok(frames)
    }
}

impl<const LINKS: usize, const PAIRS: usize, const STATIONS: usize, const CAMS: usize> Jointed
    for Assembly<LINKS, PAIRS, STATIONS, CAMS>
{
    /// The pairs, in their order.
    fn joints(&self, _phi: f64, frames: &Frames) -> Result<Joints, PoseError> {
        let pairs = self.linkage.pairs.iter();
        let cams = &self.linkage.cams;
        Ok(pairs.map(|pair| pair.joint(frames, cams)).collect())
    }

    fn drive(&self) -> usize {
        self.linkage.drive
    }
}
