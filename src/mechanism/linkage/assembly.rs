//! The linkage as a mechanism: assembled, and followed over its range.

use core::f64::consts::TAU;

use crate::machine::error::PoseError;
use crate::machine::joint::Joints;
use crate::machine::link::{Frame, Link};
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::linkage::LinkageError;
use crate::number::error::{RangeError, finite};
use crate::number::transfer::Transfer;
use crate::{Domain, math};

use super::crossing::{Crossing, PassError};
use super::solver::Solution;
use super::walk::{Gait, TRUSTED};
use super::{Linkage, Pair, Pose};

/// Largest gap (rad, or relative to the linkage's size) between the ends of a turn that closes.
const CLOSED: f64 = 1e-9;
/// The same for a turn that begins in the window around a change point.
const CLOSED_FLAT: f64 = 1e-6;
/// Distance from a change point within which the forces in the joints are not determined (rad, or relative to the linkage's size).
const FLAT: f64 = 0.01;

/// The coordinates of all links at a station: value and first transfer function.
type Station<const LINKS: usize> = [[[f64; 2]; 3]; LINKS];

/// A linkage that was assembled and followed over the drive's whole range: a mechanism.
///
/// `STATIONS` positions (at least two) are stored, evenly spaced; a position between two is computed from both. More stations cost memory, 48 bytes
/// per link each, and save steps of Newton's method: from about 200 on, one step is enough for usual linkages.
///
/// Accuracy: positions 1e-12, transfer functions and reduced inertia 1e-11 of the largest value, against closed forms and golden data (tests
/// `four_bar_golden_as_a_linkage` and those of `library_as_linkages.rs`). Cost: proportional to the number of positions; for each, the sum over the
/// [groups](Linkage::group_sizes), each at most the cube of its size (bench `linkage`, docs/performance.md).
///
/// `FLATS` is the greatest number of change points in its range, 0 for a linkage that passes none. In a window around a change point, at most 0.3 rad
/// to each side, the coordinates are interpolated; [`assemble_through_change_points`](Linkage::assemble_through_change_points) gives the accuracy.
#[derive(Clone, Debug)]
pub struct Assembly<
    const LINKS: usize,
    const PAIRS: usize,
    const STATIONS: usize,
    const CAMS: usize = 0,
    const FLATS: usize = 0,
> {
    linkage: Linkage<LINKS, PAIRS, CAMS>,
    domain: Domain,
    stations: [Station<LINKS>; STATIONS],
    /// Signs of the determinants on this branch, below the first change point.
    signs: u64,
    /// The change points with windows that reach into the domain, in order.
    crossings: heapless::Vec<Crossing<LINKS>, FLATS>,
    /// Advance of each link's angle per turn (rad).
    turn: [f64; LINKS],
}

impl<const LINKS: usize, const PAIRS: usize, const CAMS: usize> Linkage<LINKS, PAIRS, CAMS> {
    /// Assembles the linkage at the drive's position `phi` (rad, or m) from an approximate drawing, one pose per link, and follows it over the
    /// `domain`.
    ///
    /// # Errors
    /// A drawing far outside the domain, or without a position nearby: with the pair that stays open and its gap. A dead point of the drive or a
    /// change of branch: with its place and pair. A link that is in another place after a turn.
    pub fn assemble<const STATIONS: usize>(
        self,
        domain: Domain,
        phi: f64,
        drawing: &[Pose],
    ) -> Result<Assembly<LINKS, PAIRS, STATIONS, CAMS>, LinkageError> {
        self.assemble_along(domain, phi, drawing)
    }

    /// Assembles a linkage like [`assemble`](Self::assemble), and follows it through its change points, on its branch.
    ///
    /// At a change point bodies are in line, so that the linkage could continue in two ways: antiparallelogram, kite, a slider-crank with crank and
    /// rod of the same length. A guide makes the linkage continue smoothly: a second crank, teeth, another coupler. The drawing determines the
    /// branch, and must not be drawn at a change point. All transfer functions are finite. The forces in the joints grow without bound towards the
    /// change point, and are [not determined](Jointed::determined) within [`flat`](Assembly::flat).
    ///
    /// `FLATS` is the greatest number of change points in the range; one at the start of a turn counts twice. In a window around each, the
    /// coordinates are interpolated: positions to 1e-12, first, second and third transfer functions to 1e-11, 5e-9 and 1e-6 (relative to 1 or the
    /// value), for lengths that differ by half or more, against the closed forms of parallelogram, antiparallelogram, kite, Galloway's mechanism and
    /// folded slider-crank (tests of `linkage_change_points.rs`). Lengths count as equal to a relative 1e-12; with a larger difference the linkage
    /// has a dead point or a steep place instead of a change point. Towards equal lengths of crank and ground an antiparallelogram becomes steep and
    /// less accurate: 2e-10 in position and 1e-5 of the largest third transfer function at 0.28 m and 0.3 m (test
    /// `a_steep_antiparallelogram_is_less_exact`).
    ///
    /// # Errors
    /// As [`assemble`](Self::assemble), with a dead point that is not a change point; more change points than `FLATS`; no change point
    /// ([`LinkageError::NoChangePoint`]).
    pub fn assemble_through_change_points<const STATIONS: usize, const FLATS: usize>(
        self,
        domain: Domain,
        phi: f64,
        drawing: &[Pose],
    ) -> Result<Assembly<LINKS, PAIRS, STATIONS, CAMS, FLATS>, LinkageError> {
        const { assert!(FLATS > 0, "a linkage without change points: assemble") }
        let assembly = self.assemble_along(domain, phi, drawing)?;
        if assembly.change_points().next().is_none() {
            return Err(LinkageError::NoChangePoint);
        }
        Ok(assembly)
    }

    /// Not inlined, so that its places leave the stack with it.
    #[inline(never)]
    fn assemble_along<const STATIONS: usize, const FLATS: usize>(
        self,
        domain: Domain,
        phi: f64,
        drawing: &[Pose],
    ) -> Result<Assembly<LINKS, PAIRS, STATIONS, CAMS, FLATS>, LinkageError> {
        const { assert!(STATIONS >= 2, "a range has two ends") }
        let span = domain.span();
        let [from, to] = [domain.position(0.0), domain.position(1.0)];
        let [min, max] = [from - span, to + span];
        if !(min..=max).contains(&finite("drive position of the drawing", phi)?) {
            return Err(RangeError::OutOfRange {
                what: "drive position of the drawing",
                value: phi,
                min,
                max,
            }
            .into());
        }
        let frames = self.drawing(drawing)?;
        let mut place = self.placed(phi, frames).map_err(|why| why.at(phi))?;
        if let Some(joint) = self.flat_at(&place) {
            return Err(PoseError::DeadPoint { phi, joint }.into());
        }
        let count = self.links.len();
        let mut crossings = heapless::Vec::<Crossing<LINKS>, FLATS>::new();
        let passed = |result: Result<(), PassError>| {
            result.map_err(|error| match error {
                PassError::Pose(error) => error.into(),
                PassError::TooMany => LinkageError::from(RangeError::TooMany {
                    what: "change points",
                    capacity: FLATS,
                }),
            })
        };
        passed(self.walk_through(&mut place, from, span, &mut crossings))?;
        crossings.retain(|crossing| crossing.holds(from));
        if let Some(first) = crossings.first() {
            place = first.upper(count);
        }
        let signs = place.solved.signs;
        if FLATS > 0 {
            passed(self.walk_through(&mut place.clone(), to, span, &mut crossings))?;
        }
        let mut start = Frames::new();
        let mut frames = Frames::new();
        let mut stations = [[[[0.0; 2]; 3]; LINKS]; STATIONS];
        for (k, station) in stations.iter_mut().enumerate() {
            let next = domain.position(k as f64 / (STATIONS - 1) as f64);
            if let Some(window) = crossings.iter().find(|window| window.holds(next)) {
                window.place(next, count, &mut frames);
            } else {
                let passed = |window: &&Crossing<LINKS>| {
                    window.is_below(next) && !window.is_below(place.phi)
                };
                if let Some(window) = crossings.iter().rev().find(passed) {
                    place = window.upper(count);
                }
                self.walk(&mut place, next, Gait::strict(span))?;
                frames.clone_from(&place.frames);
            }
            for (slot, frame) in station.iter_mut().zip(&frames) {
                *slot = [frame.x, frame.y, frame.psi].map(|c| [c.value, c.d1]);
            }
            if k == 0 {
                start.clone_from(&frames);
            }
        }
        let mut turn = [0.0; LINKS];
        if domain == Domain::Turn {
            let flat = crossings.iter().any(|window| window.holds(from));
            let closed = if flat { CLOSED_FLAT } else { CLOSED };
            let ends = start.iter().zip(&frames).enumerate();
            for ((link, (start, end)), advance) in ends.zip(&mut turn) {
                *advance = self.closes(link, [start, end], closed)?;
            }
        }
        Ok(Assembly {
            linkage: self,
            domain,
            stations,
            signs,
            crossings,
            turn,
        })
    }

    /// Advance of a link's angle per turn, if the link has returned: the same position, the same angle except for whole turns, the same first
    /// transfer functions. A balanced wheel that only rolls with other wheels may stop at any angle.
    fn closes(
        &self,
        link: usize,
        [start, end]: [&Frame; 2],
        closed: f64,
    ) -> Result<f64, LinkageError> {
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
        if gap <= closed * self.size {
            Ok(if turned <= closed { whole } else { advance })
        } else {
            Err(LinkageError::NotClosed { link, gap })
        }
    }

    /// Whether only the angles of other wheels depend on the angle of this link, in proportion.
    fn only_rolls(&self, link: usize) -> bool {
        let is_cam = |pair: usize| matches!(self.pairs.get(pair), Some(Pair::Cam { .. }));
        let mut held = self.structure.with_angle_of(link);
        held.all(|(equation, angles_alone)| angles_alone && !is_cam(equation.pair.into()))
    }
}

impl<
    const LINKS: usize,
    const PAIRS: usize,
    const STATIONS: usize,
    const CAMS: usize,
    const FLATS: usize,
> Assembly<LINKS, PAIRS, STATIONS, CAMS, FLATS>
{
    /// The linkage.
    pub const fn linkage(&self) -> &Linkage<LINKS, PAIRS, CAMS> {
        &self.linkage
    }

    /// Sets another mass of a link: a new payload. The positions stay the same.
    ///
    /// # Errors
    /// A link that does not exist.
    pub fn set_link(&mut self, index: usize, link: Link) -> Result<(), LinkageError> {
        self.linkage.set_link(index, link)
    }

    /// Quality of transmission at `phi`: the smallest |det A|/Π‖column‖ over the groups' Jacobians A, with the index of its pair. 0 at a dead point,
    /// 1 at best; for a two-link group with pins at the frames' origins it is the sine of the transmission angle.
    ///
    /// # Errors
    /// As [`frames`](Mechanism::frames).
    pub fn quality(&self, phi: f64) -> Result<(f64, usize), PoseError> {
        let mut frames = Frames::new();
        let (solved, _) = self.solved(phi, &mut frames)?;
        Ok((solved.quality, solved.weakest))
    }

    /// Puts the links at `phi` into `frames`, without the whole turns, which are returned.
    fn solved(&self, phi: f64, frames: &mut Frames) -> Result<(Solution, f64), PoseError> {
        let (turns, phi) = self.within(finite("drive position", phi)?);
        if let Some(window) = self.crossings.iter().find(|window| window.holds(phi)) {
            let solved = window.place(phi, self.linkage.links.len(), frames);
            return Ok((solved, turns));
        }
        let below = self.crossings.iter().rev().find(|it| it.is_below(phi));
        let upper = |window: &Crossing<LINKS>| window.upper(self.linkage.links.len());
        let signs = below.map_or(self.signs, Crossing::signs_above);
        let cells = (STATIONS - 1) as f64;
        let place = (phi - self.domain.position(0.0)) / self.domain.span() * cells;
        let cell = (math::floor(place).max(0.0) as usize).min(STATIONS - 2);
        self.between(cell, place - cell as f64, frames);
        if let Ok(solved) = self.linkage.solve(phi, frames)
            && solved.signs == signs
            && solved.correction <= TRUSTED
        {
            return Ok((solved, turns));
        }
        // Few stations, or a dead point nearby: follow the linkage from the station.
        let start = self.domain.position(cell as f64 / cells);
        let mut place = if let Some(window) = below.filter(|window| !window.is_below(start)) {
            upper(window)
        } else {
            self.between(cell, 0.0, frames);
            let placed = self.linkage.placed(start, frames.clone());
            placed.map_err(|why| why.at(start))?
        };
        let span = self.domain.span();
        self.linkage.walk(&mut place, phi, Gait::strict(span))?;
        *frames = place.frames;
        Ok((place.solved, turns))
    }

    /// A position as whole turns, and a position in the domain.
    fn within(&self, phi: f64) -> (f64, f64) {
        match self.domain {
            Domain::Turn => {
                let turns = math::floor(phi / TAU);
                (turns, phi - turns * TAU)
            }
            Domain::Stroke { from, to } => (0.0, phi.clamp(from, to)),
        }
    }

    /// The change points through which the linkage is kept on its branch, as positions of the drive (rad, or m) in its domain.
    pub fn change_points(&self) -> impl Iterator<Item = f64> + '_ {
        let [from, to] = [self.domain.position(0.0), self.domain.position(1.0)];
        let hair = self.flat() * 1e-3;
        let again = match self.domain {
            Domain::Turn => (self.crossings.first()).map(|first| first.phi + TAU),
            Domain::Stroke { .. } => None,
        };
        let all = self.crossings.iter().map(|crossing| crossing.phi);
        all.filter(move |phi| *phi >= from - hair && *phi <= to + hair)
            .filter(move |phi| again.is_none_or(|again| math::abs(again - phi) > hair))
            .map(move |phi| phi.clamp(from, to))
    }

    /// Distance from a change point (rad, or m) within which the forces in the joints are not determined: they grow in proportion to 1/distance, and
    /// depend there on play and stiffness, and on the linkage's guide. 0.01 rad, or that share of the linkage's size.
    pub fn flat(&self) -> f64 {
        FLAT * self.linkage.unit()
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

impl<
    const LINKS: usize,
    const PAIRS: usize,
    const STATIONS: usize,
    const CAMS: usize,
    const FLATS: usize,
> Mechanism for Assembly<LINKS, PAIRS, STATIONS, CAMS, FLATS>
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

impl<
    const LINKS: usize,
    const PAIRS: usize,
    const STATIONS: usize,
    const CAMS: usize,
    const FLATS: usize,
> Jointed for Assembly<LINKS, PAIRS, STATIONS, CAMS, FLATS>
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

    /// False within [`flat`](Self::flat) of a change point.
    fn determined(&self, phi: f64) -> bool {
        let (_, phi) = self.within(phi);
        let mut all = self.crossings.iter();
        all.all(|crossing| math::abs(phi - crossing.phi) >= self.flat())
    }
}
