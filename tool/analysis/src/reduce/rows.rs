//! The rows: positions of the drive link, each with its instant and state.

use std::convert::Infallible;

use jred::Domain;
use jred::machine::Reducible as _;
use jred::machine::motion::State;

use super::{DrivePoint, Over, Request};
use jred_file::model::coordinate::positions;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_file::model::schedule::ScheduleInstant;
use jred_file::number::numerics::{sides, zero};

/// Time (over time only), instant, position and state of a row.
pub(super) struct RowMotion {
    pub(super) time: Option<f64>,
    pub(super) now: ScheduleInstant,
    pub(super) phi: f64,
    pub(super) state: Option<State<f64>>,
}

/// The rows, in order.
pub(super) fn rows<'f>(
    file: &'f MachineFile,
    request: &Request,
) -> Box<dyn Iterator<Item = RowMotion> + 'f> {
    if let (Over::Time, Some(motion)) = (request.over, &file.motion) {
        let last = (request.positions - 1).max(1) as f64;
        let row = move |k: usize| {
            let t = motion.duration() * k as f64 / last;
            let state = motion.at(t);
            RowMotion {
                time: Some(t),
                now: ScheduleInstant::of(t, state.omega),
                phi: state.phi,
                state: Some(state),
            }
        };
        return Box::new((0..request.positions).map(row));
    }
    let state = state_at(file, request.state);
    let domain = file.machine.domain();
    Box::new(positions(domain, request.positions).map(state))
}

/// The rows at these positions.
pub(super) fn rows_at(
    file: &MachineFile,
    request: &Request,
    at: &[DrivePoint],
) -> impl Iterator<Item = RowMotion> {
    let state = state_at(file, request.state);
    at.iter().map(move |at| match at.state {
        Some(own) => row_at(at.phi, Some(own), None),
        None => state(at.phi),
    })
}

/// The row of a position: with the given state, or with that of the motion, if it passes each position once.
fn state_at(file: &MachineFile, given: Option<[f64; 2]>) -> impl Fn(f64) -> RowMotion {
    let pass = match &file.motion {
        Some(motion) if given.is_none() => Pass::of(motion, file.machine.domain()),
        _ => None,
    };
    move |phi| row_at(phi, given, pass.as_ref())
}

pub(super) fn row_at(phi: f64, given: Option<[f64; 2]>, pass: Option<&Pass>) -> RowMotion {
    let (t, state) = if let Some([omega, alpha]) = given {
        (None, Some(State { phi, omega, alpha }))
    } else {
        let at = pass.and_then(|pass| pass.at(phi));
        (at.map(|(t, _)| t), at.map(|(_, state)| state))
    };
    let omega = state.map(|state| state.omega);
    RowMotion {
        time: None,
        now: ScheduleInstant {
            t,
            omega,
            ..ScheduleInstant::default()
        },
        phi,
        state,
    }
}

/// A motion that passes every position at most once: in one direction, through exactly one turn or within the stroke. Dwells count once, at rest.
pub(super) struct Pass<'m> {
    motion: &'m Motion,
    start: f64,
    direction: f64,
    length: f64,
    turn: bool,
    /// Distance from the start at equal steps of time.
    passed: Vec<f64>,
}

/// Steps of time of a motion whose direction is checked.
const STEPS: usize = 1000;

impl<'m> Pass<'m> {
    pub(super) fn of(motion: &'m Motion, domain: Domain) -> Option<Self> {
        let (start, end) = (motion.at(0.0).phi, motion.at(motion.duration()).phi);
        let direction = (end - start).signum();
        let length = (end - start).abs();
        let turn = domain == Domain::Turn;
        let one_turn = !turn || (length - domain.span()).abs() < 1e-9;
        if !one_turn {
            return None;
        }
        let mut pass = Self {
            motion,
            start,
            direction,
            length,
            turn,
            passed: Vec::new(),
        };
        for k in 0..=STEPS {
            let (distance, state) = pass.after(pass.time(k));
            pass.passed.push(distance);
            if state.omega * direction < -1e-12 {
                return None;
            }
        }
        Some(pass)
    }

    /// The time at a step.
    fn time(&self, step: usize) -> f64 {
        self.motion.duration() * step as f64 / STEPS as f64
    }

    /// Distance from the start, and state, at a time.
    fn after(&self, t: f64) -> (f64, State<f64>) {
        let state = self.motion.at(t);
        ((state.phi - self.start) * self.direction, state)
    }

    /// The first time at which the motion has come this far: by halves where it rests there.
    fn reached(&self, distance: f64) -> f64 {
        let step = self.passed.partition_point(|passed| *passed < distance);
        let step = step.clamp(1, STEPS);
        let ends = [step - 1, step];
        let [low, high] = ends.map(|step| self.time(step));
        let ahead = ends.map(|step| self.passed[step] - distance);
        if ahead[0] < 0.0 && ahead[1] > 0.0 {
            let way = |t: f64| Ok::<_, Infallible>(self.after(t).0 - distance);
            let Ok(time) = zero(way, [low, high], ahead, 1e-15);
            if self.motion.at(time).omega != 0.0 {
                return time;
            }
        }
        let before = |t: f64| Ok::<_, Infallible>(self.after(t).0 < distance);
        let Ok([_, late]) = sides(before, low, high);
        late
    }

    /// Time and state at which the motion passes the position `phi`, for a turn modulo 2π.
    fn at(&self, phi: f64) -> Option<(f64, State<f64>)> {
        let motion = self.motion;
        let ahead = (phi - self.start) * self.direction;
        let distance = if self.turn {
            ahead.rem_euclid(std::f64::consts::TAU)
        } else {
            ahead
        };
        // The ends of a stroke are positions too, and rounding must not exclude them.
        let slack = 1e-12 * self.length;
        if !self.turn && !(-slack..=self.length + slack).contains(&distance) {
            return None;
        }
        let time = self.reached(distance);
        let state = State {
            phi,
            ..motion.at(time)
        };
        Some((time, state))
    }
}

/// The loads, payloads and frictions that some rows of the request omit, because these have no time of the motion, or no direction.
pub fn not_contained(file: &MachineFile, request: &Request) -> Vec<String> {
    not_in(file, || rows(file, request))
}

/// The same for [`reduce_at`](super::reduce_at).
pub fn not_contained_at(file: &MachineFile, request: &Request, at: &[DrivePoint]) -> Vec<String> {
    not_in(file, || rows_at(file, request, at))
}

fn not_in<R: Iterator<Item = RowMotion>>(
    file: &MachineFile,
    rows: impl FnOnce() -> R,
) -> Vec<String> {
    if file.schedule.is_empty() && file.machine.frictions().is_empty() {
        return Vec::new();
    }
    let (mut timed, mut directed) = (true, true);
    for row in rows() {
        timed &= row.now.t.is_some();
        directed &= row.now.omega.is_some();
    }
    let missing = file.scheduled_where(|when| {
        (when.spans.is_some() && !timed) || (when.travel.is_some() && !directed)
    });
    let carriages = file.carriages().filter(|_| !timed);
    let frictions = file.frictions_in_words().filter(|_| !directed);
    let missing = missing.chain(carriages.map(|item| item.what));
    missing.chain(frictions).collect()
}
