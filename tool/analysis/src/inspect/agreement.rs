//! Independent checks: d'Alembert's principle against the reduced equation, work against energy.

use std::borrow::Cow;

use jred::error::Error;
use jred::machine::motion::State;
use jred::machine::{Jointed as _, Machine, Mechanism as _, Reducible as _};
use serde::Serialize;

use crate::duty;
use crate::reduce::between_edges;
use jred_file::model::carriage::Carriage;
use jred_file::model::coordinate::whole_range;
use jred_file::model::machine::{MachineFile, Machines};
use jred_file::model::mechanism::AnyMechanism;
use jred_file::model::motion::Motion;
use jred_file::model::schedule::ScheduleInstant;
use jred_file::number::{numerics, parabola};

/// Positions or instants that are compared.
const STEPS: usize = 360;

/// Fewest steps of a part.
const FEWEST: usize = 16;

/// Tolerance of a mean, as a share of the largest value.
const OF_MEAN: f64 = 1e-10;

/// Parts of the motion over which its work is integrated, each halved where necessary.
const PANELS: u32 = 96;

/// Parts of a recorded or computed motion, one to four from row to row: a bend of a load between two rows must not be missed by all places of the
/// rule.
const ROW_PANELS: usize = 8192;

/// Fewest panels for a turn or stroke.
const PANELS_OF_TURN: f64 = 8.0;

/// Number of turns after which the balance of a longer stretch ends: energy balances over every part of a motion.
const MOST_TURNS: f64 = 250.0;

/// Share of the machine's energy that counts as exchanged: at constant speed the exchanged energy is only its rounding.
const STORED: f64 = 1e-6;

/// Tolerance of the work, as a share of the energy exchanged by the drive.
const SHARE: f64 = 1e-11;

/// Rounding errors of the time in the length of a stretch; the tolerance grows with the excess.
const TIMES: f64 = 2.0;

/// Share of a stretch by which its ends are moved inside.
const INSIDE: f64 = 1e-13;

/// The moving masses.
#[derive(Clone, Copy, Debug, Serialize, schemars::JsonSchema)]
pub struct Inertia {
    /// J_red (or m_red): smallest, mean over the range, largest, including flywheel and drive train.
    pub reduced: [f64; 3],
    /// The same over the time of the motion, with the payloads and carriages of each instant; `None` without these.
    pub laden: Option<[f64; 3]>,
    /// Flywheel and drive train, included above.
    pub flywheel: f64,
    /// Mass of all links (kg).
    pub mass: f64,
}

/// Agreement of the two methods, for the machine with its drive train.
#[derive(Clone, Copy, Debug, Serialize, schemars::JsonSchema)]
pub struct Agreement {
    /// Largest difference of the two drive torques as a share of their largest term.
    pub dalembert: f64,
    /// Whether it is computed at the states of the motion, or else at unit speed and acceleration.
    pub of_motion: bool,
    /// |work of the drive + work of loads and losses − gain of energy| as a share of the energy exchanged by the drive. The
    /// work is that of the forces by d'Alembert.
    pub energy: Option<f64>,
}

/// The inertia of a file's machine with its drive train, and of its machines with payloads.
pub(super) fn inertia(
    file: &MachineFile,
    machine: &Machine<AnyMechanism>,
    machines: &Machines,
) -> Result<Inertia, Error> {
    let domain = machine.domain();
    let over_range = |phi: f64| Ok(machine.bare_reduction(phi)?.inertia);
    let parts: Vec<(Span, usize)> = between_edges(file)
        .into_iter()
        .map(|(from, to)| ([from, to], steps_of((to - from) / domain.span())))
        .collect();
    Ok(Inertia {
        reduced: extremes(&parts, &over_range)?,
        laden: laden_inertia(file, machines)?,
        flywheel: machine.flywheel(),
        mass: machine
            .mechanism()
            .links()
            .iter()
            .map(jred::machine::Link::mass)
            .sum(),
    })
}

/// Start and end of a part.
type Span = [f64; 2];

/// Steps of a part with this many turns or strokes.
fn steps_of(turns: f64) -> usize {
    ((STEPS as f64 * turns).ceil() as usize).max(FEWEST)
}

/// Least, mean and largest of a quantity over successive parts in which it is smooth. Each part is evaluated in its number of steps, and the extremes
/// are refined between them.
fn extremes(
    parts: &[(Span, usize)],
    f: &impl Fn(f64) -> Result<f64, Error>,
) -> Result<[f64; 3], Error> {
    let (mut places, mut firsts) = (Vec::new(), Vec::new());
    for ([from, to], steps) in parts {
        let inset = INSIDE * (to - from);
        for k in 0..=*steps {
            firsts.push(places.len() - k);
            let even = from + (to - from) * k as f64 / *steps as f64;
            places.push(even.clamp(from + inset, to - inset));
        }
    }
    let values = places
        .iter()
        .map(|x| f(*x))
        .collect::<Result<Vec<_>, Error>>()?;
    let count = values.len();
    let around = |k: usize| {
        let first = *firsts.get(k)?;
        let end = firsts.partition_point(|other| *other <= first);
        let middle = k.saturating_sub(1).clamp(first, end - 3);
        Some([middle, middle + 1, middle + 2])
    };
    let mut most = [0.0; 2];
    for (most, sign) in most.iter_mut().zip([-1.0, 1.0]) {
        let known = values.iter().map(|value| sign * value);
        let known = known.fold(f64::NEG_INFINITY, f64::max);
        let peak = parabola::highest(
            (count, |k| sign * values[k]),
            around,
            |k| places[k],
            |x| Ok::<_, Error>(sign * f(x)?),
            known,
        )?;
        *most = match peak {
            Some((_, x)) => f(x)?,
            None => sign * known,
        };
    }
    let [least, largest] = most;
    let all: f64 = parts.iter().map(|([from, to], _)| to - from).sum();
    let mut sum = 0.0;
    for ([from, to], _) in parts {
        let tolerance = OF_MEAN * largest.abs() * (to - from);
        sum += numerics::integral(f, [*from, *to], 4, tolerance)?;
    }
    Ok([least, sum / all, largest])
}

/// Over the time of the motion, with payloads and carriages; `None` without these.
fn laden_inertia(file: &MachineFile, machines: &Machines) -> Result<Option<[f64; 3]>, Error> {
    let schedule = &file.schedule;
    let Some(motion) =
        (file.motion.as_ref()).filter(|_| schedule.flows() || !schedule.payloads().is_empty())
    else {
        return Ok(None);
    };
    let parts: Vec<(Span, usize)> = duty::smooth_stretches(file, motion)
        .into_iter()
        .map(|(from, to)| {
            let turns = duty::turns(file, motion, (from, to));
            let time = (to - from) / motion.duration();
            ([from, to], steps_of(turns.max(time)))
        })
        .collect();
    let at = |t: f64| {
        let state = motion.at(t);
        let machine = machines.at(&ScheduleInstant::of(t, state.omega), state.phi)?;
        Ok(machine.bare_reduction(state.phi)?.inertia)
    };
    Ok(Some(extremes(&parts, &at)?))
}

/// The agreement for a machine file and its machines with the drive train.
pub(super) fn agreement(file: &MachineFile, machines: &Machines) -> Result<Agreement, Error> {
    let states: Vec<(ScheduleInstant, [f64; 3])> = match &file.motion {
        Some(motion) => (0..=STEPS)
            .map(|k| motion.duration() * k as f64 / STEPS as f64)
            .map(|t| (t, motion.at(t)))
            .map(|(t, s)| (ScheduleInstant::of(t, s.omega), [s.phi, s.omega, s.alpha]))
            .collect(),
        None => whole_range(file.machine.domain(), STEPS)
            .zip([[1.0, 1.0], [-1.0, 0.5], [1.0, -1.0]].into_iter().cycle())
            .map(|(phi, [omega, alpha])| (ScheduleInstant::default(), [phi, omega, alpha]))
            .collect(),
    };
    let (mut worst, mut largest) = (0.0f64, 0.0f64);
    for (now, [phi, omega, alpha]) in states {
        let machine = machines.at(&now, phi)?;
        if !machine.mechanism().determined(phi) {
            continue;
        }
        let terms = machine.torque(phi, omega, alpha)?;
        let found = machine.forces(phi, omega, alpha)?.drive;
        let off = (found - terms.total()).abs();
        // NaN agrees with nothing.
        worst = if worst.is_nan() || off <= worst {
            worst
        } else {
            off
        };
        largest = terms
            .values()
            .into_iter()
            .map(f64::abs)
            .fold(largest, f64::max);
    }
    let share = if largest > 0.0 {
        worst / largest
    } else {
        worst
    };
    let energy = match &file.motion {
        Some(motion) => Some(balance(file, machines, motion)?),
        None => None,
    };
    Ok(Agreement {
        dalembert: share,
        of_motion: file.motion.is_some(),
        energy,
    })
}

/// The energy balance over the motion, stretch by stretch: a payload brings its energy and takes it away.
fn balance(file: &MachineFile, machines: &Machines, motion: &Motion) -> Result<f64, Error> {
    let stretches = duty::smooth_stretches(file, motion);
    let parts: Vec<SmoothStretch> = stretches
        .into_iter()
        .map(|(from, to)| {
            let turns = duty::turns(file, motion, (from, to));
            let to = from + (to - from) * (MOST_TURNS / turns).min(1.0);
            SmoothStretch::new(file, machines, motion, [from, to])
        })
        .collect();
    let duration = motion.duration();
    // Between two rows of a recorded or computed motion, where it is smooth.
    let over = |part: &SmoothStretch, f: &dyn Fn(f64) -> Result<f64, Error>, tolerance: f64| {
        let cuts = motion.cut_at_rows(part.span);
        let least = if cuts.len() > 2 {
            (ROW_PANELS / cuts.len()).clamp(1, 4)
        } else {
            2
        };
        let mut sum = 0.0;
        for pair in cuts.windows(2) {
            let panels = f64::from(PANELS) * (pair[1] - pair[0]) / duration;
            let of_turns = PANELS_OF_TURN * duty::turns(file, motion, (pair[0], pair[1]));
            let panels = panels.max(of_turns).ceil().max(least as f64) as u32;
            let share = (pair[1] - pair[0]) / (part.span[1] - part.span[0]);
            // Between near rows it is limited by rounding of their times.
            let rounded = 1.0 + 16.0 * f64::EPSILON * pair[1] / (pair[1] - pair[0]) / SHARE;
            let tolerance = tolerance * share * rounded;
            sum += numerics::integral(f, [pair[0], pair[1]], panels, tolerance)?;
        }
        Ok::<f64, Error>(sum)
    };
    // Only for scale: the rule without halving.
    let moved = (parts.iter())
        .map(|part| over(part, &|t| Ok(part.drive(t)?.abs()), f64::INFINITY))
        .collect::<Result<Vec<f64>, Error>>()?;
    let all: f64 = moved.iter().sum();
    let (mut off, mut stored) = (0.0, 0.0_f64);
    for (part, moved) in parts.iter().zip(moved) {
        let [from, to] = part.span;
        // Relative to its own energy, or to its share by time: in a short part of a long motion the former would be less than rounding.
        let tolerance = SHARE * moved.max(all * (to - from) / duration);
        let work_here = over(part, &|t| part.power(t), tolerance)?;
        let [before, after] = [part.energy(from)?, part.energy(to)?];
        stored = stored.max(before.abs()).max(after.abs());
        // The times of a short stretch late in a long motion are rounded, and so is its work.
        let rounded = TIMES * f64::EPSILON * to / (to - from);
        let more = moved * (rounded - SHARE).max(0.0);
        off += ((work_here - (after - before)).abs() - more).max(0.0);
    }
    let moved = all + STORED * stored;
    Ok(if moved > 0.0 { off / moved } else { off })
}

/// A time (s), the state of the drive link, and the machine.
type MachineState<'m> = (f64, State<f64>, Cow<'m, Machine<AnyMechanism>>);

/// A smooth stretch of the motion, over which the machine does not change, except for carriages.
struct SmoothStretch<'m> {
    carriages: &'m [Carriage],
    machines: &'m Machines<'m>,
    machine: &'m Machine<AnyMechanism>,
    motion: &'m Motion,
    span: [f64; 2],
}

impl<'m> SmoothStretch<'m> {
    fn new(
        file: &'m MachineFile,
        machines: &'m Machines,
        motion: &'m Motion,
        span: [f64; 2],
    ) -> Self {
        let t = span[0].midpoint(span[1]);
        Self {
            carriages: file.schedule.carriages(),
            machines,
            machine: machines.among(&ScheduleInstant::of(t, motion.at(t).omega)),
            motion,
            span,
        }
    }

    /// The machine at a time, moved inside the stretch by [`INSIDE`]: at its ends the acceleration of a carriage may jump.
    fn at(&self, t: f64) -> Result<MachineState<'m>, Error> {
        let [from, to] = self.span;
        let inset = INSIDE * (to - from);
        let state = self.motion.at(t);
        let inside = t.clamp(from + inset, to - inset);
        let now = ScheduleInstant::of(inside, state.omega);
        let machine = self.machines.flowing(self.machine, &now, state.phi)?;
        Ok((inside, state, machine))
    }

    /// Power of the drive.
    fn drive(&self, t: f64) -> Result<f64, Error> {
        let (_, state, machine) = self.at(t)?;
        let (phi, omega, alpha) = (state.phi, state.omega, state.alpha);
        // At a change point only one method works.
        let drive = if machine.mechanism().determined(phi) {
            machine.forces(phi, omega, alpha)?.drive
        } else {
            machine.torque(phi, omega, alpha)?.total()
        };
        Ok(drive * omega)
    }

    /// The power remaining after loads and losses, with that of second axes.
    fn power(&self, t: f64) -> Result<f64, Error> {
        let (inside, state, machine) = self.at(t)?;
        let point = machine.bare_reduction(state.phi)?;
        let loads = point.reduced_torque(state.omega) + point.potential_slope;
        let friction = machine.friction_at(state.phi, state.omega, state.omega)?;
        let loads = loads - friction.torque(state.alpha)?[0];
        let mut power = self.drive(t)? + loads * state.omega;
        if !self.carriages.is_empty() {
            let frames = machine.mechanism().frames(state.phi)?;
            let gravity = machine.gravity();
            for carriage in self.carriages {
                let load = machine.loads().get(carriage.load);
                let Some((load, frame)) = load.zip(frames.get(carriage.mass.link)) else {
                    continue;
                };
                // Its inertia force is not a load of the machine.
                power -= load.reduce(frame, state.phi).process * state.omega;
                let effort = carriage.effort(frame, inside, [state.omega, state.alpha], gravity);
                power += effort * carriage.at(inside).omega;
            }
        }
        Ok(power)
    }

    fn energy(&self, t: f64) -> Result<f64, Error> {
        let (inside, state, machine) = self.at(t)?;
        let point = machine.bare_reduction(state.phi)?;
        let mut energy = 0.5 * point.inertia * state.omega * state.omega + point.potential_energy;
        if !self.carriages.is_empty() {
            let frames = machine.mechanism().frames(state.phi)?;
            for carriage in self.carriages {
                if let Some(frame) = frames.get(carriage.mass.link) {
                    energy += carriage.energy(frame, inside, state.omega);
                }
            }
        }
        Ok(energy)
    }
}
