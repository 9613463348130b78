//! Changes of a machine during its motion: loads that act only in a part of it, payloads that are picked up and set down, and carriages that a second
//! axis moves.
//!
//! At every instant the machine is one of a few variants. All have the same links, joints and loads in the same order; some loads are without force,
//! and some links are heavier by their payload. With a carriage the machine is different at every instant.

use std::borrow::Cow;

use jred::error::Error;
use jred::machine::Mechanism as _;
use jred::machine::{Action, Load, Machine};

use crate::model::carriage::Carriage;
use crate::model::machine::machine_like;
use crate::model::mechanism::AnyMechanism;
use crate::model::motion::Motion;
use crate::model::with_mass::{AttachedMass, laden};

mod when;

pub use when::{ScheduleInstant, Travel, When};

/// A load that does not always act, or has a separate value at rest.
#[derive(Clone, Debug)]
pub struct ScheduledLoad {
    /// Its name.
    pub name: String,
    /// Index of the load among the machine's.
    pub load: usize,
    /// Its times.
    pub when: When,
    /// A different load for a drive link at rest; for a motion-opposing load its static friction.
    pub at_rest: Option<Load>,
    /// Whether that is static friction.
    pub is_static_friction: bool,
    /// Its description for reports.
    pub words: String,
}

/// A mass that a link carries for a part of the motion.
#[derive(Clone, Debug)]
pub struct Payload {
    /// Its name.
    pub name: String,
    /// The mass.
    pub mass: AttachedMass,
    /// Its times.
    pub when: When,
    /// Its description for reports.
    pub words: String,
}

/// State of a load at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum LoadState {
    Nothing,
    Moving,
    AtRest,
}

/// The states of the loads, and whether each payload is carried, in the schedule's order.
type ScheduleState = (Vec<LoadState>, Vec<bool>);

/// All changes during the motion, and the resulting machines.
#[derive(Clone, Debug, Default)]
pub struct Schedule {
    loads: Vec<ScheduledLoad>,
    payloads: Vec<Payload>,
    carriages: Vec<Carriage>,
    /// End of the motion (s).
    end: f64,
    variants: Vec<(ScheduleState, Machine<AnyMechanism>)>,
}

impl Schedule {
    /// The variants of `machine`, all of whose loads act, at the instants of the motion, and without a motion.
    ///
    /// # Errors
    /// Errors of the machine.
    pub fn new(
        machine: &Machine<AnyMechanism>,
        (loads, payloads, carriages): (Vec<ScheduledLoad>, Vec<Payload>, Vec<Carriage>),
        motion: Option<&Motion>,
    ) -> Result<Self, Error> {
        let mut schedule = Self {
            loads,
            payloads,
            carriages,
            end: motion.map_or(0.0, Motion::duration),
            variants: Vec::new(),
        };
        let mut times: Vec<Option<f64>> = vec![None];
        if motion.is_some() {
            times.push(Some(0.0));
            times.extend(schedule.times().into_iter().map(Some));
        }
        let rest = Some(0.0);
        let speeds = [
            (None, None),
            (Some(-1.0), None),
            (Some(1.0), None),
            (rest, None),
            (rest, Some(-1.0)),
            (rest, Some(1.0)),
        ];
        let mut states: Vec<ScheduleState> = Vec::new();
        for t in times {
            states.extend(speeds.map(|(omega, starts)| {
                schedule.state(&ScheduleInstant {
                    t,
                    omega,
                    starts,
                    ..ScheduleInstant::default()
                })
            }));
        }
        states.sort();
        states.dedup();
        for state in states {
            let variant = schedule.variant(machine, &state)?;
            schedule.variants.push((state, variant));
        }
        Ok(schedule)
    }

    /// The same schedule for another machine with the same loads.
    ///
    /// # Errors
    /// Errors of the machine.
    pub fn of_machine(
        &self,
        machine: &Machine<AnyMechanism>,
        motion: Option<&Motion>,
    ) -> Result<Self, Error> {
        if self.is_empty() {
            return Ok(Self::default());
        }
        let parts = (
            self.loads.clone(),
            self.payloads.clone(),
            self.carriages.clone(),
        );
        Self::new(machine, parts, motion)
    }

    /// The loads that do not always act, or have a separate value at rest.
    pub fn loads(&self) -> &[ScheduledLoad] {
        &self.loads
    }

    /// The payloads that are picked up and set down.
    pub fn payloads(&self) -> &[Payload] {
        &self.payloads
    }

    /// The carriages that second axes move.
    pub fn carriages(&self) -> &[Carriage] {
        &self.carriages
    }

    /// Whether the load with this index belongs to a carriage.
    pub fn is_of_carriage(&self, load: usize) -> bool {
        self.carriages.iter().any(|carriage| carriage.load == load)
    }

    /// Whether nothing changes.
    pub const fn is_empty(&self) -> bool {
        self.loads.is_empty() && self.payloads.is_empty() && self.carriages.is_empty()
    }

    /// Whether the machine is different at every instant, not one of a few variants.
    pub const fn flows(&self) -> bool {
        !self.carriages.is_empty()
    }

    /// Whether a load has a separate value at rest.
    pub fn has_values_at_rest(&self) -> bool {
        self.loads.iter().any(|load| load.at_rest.is_some())
    }

    /// Whether a load has static friction.
    pub fn has_static_friction(&self) -> bool {
        self.loads.iter().any(|load| load.is_static_friction)
    }

    /// The times of the motion (s) at which a load or payload begins or ends.
    pub fn times(&self) -> Vec<f64> {
        let loads = self.loads.iter().map(|load| &load.when);
        let whens = loads.chain(self.payloads.iter().map(|payload| &payload.when));
        let spans = whens.filter_map(|when| when.spans.as_ref()).flatten();
        let mut times: Vec<f64> = spans.flatten().copied().collect();
        for carriage in &self.carriages {
            times.extend(carriage.motion.stretches().into_iter().map(|(_, to)| to));
        }
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// Number of the variant at this instant.
    pub fn number(&self, now: &ScheduleInstant) -> usize {
        if self.is_empty() {
            return 0;
        }
        let state = self.state(now);
        let same = |(known, _): &(ScheduleState, _)| *known == state;
        self.variants.iter().position(same).unwrap_or_default()
    }

    /// The variant with this number; `None` if nothing changes.
    pub fn machine(&self, number: usize) -> Option<&Machine<AnyMechanism>> {
        self.variants.get(number).map(|(_, machine)| machine)
    }

    /// The machine without any part that depends on the motion; `None` if nothing changes.
    pub fn at_no_time(&self) -> Option<&Machine<AnyMechanism>> {
        self.machine(self.number(&ScheduleInstant::default()))
    }

    /// The variants, in the order of their numbers.
    pub fn machines(&self) -> impl Iterator<Item = &Machine<AnyMechanism>> {
        self.variants.iter().map(|(_, machine)| machine)
    }

    /// `machine`, the variant of this instant, with its carriages in position, at the position `phi` of the drive link.
    ///
    /// # Errors
    /// The mechanism cannot be placed there; errors of the machine.
    pub fn flowing<'m>(
        &self,
        machine: Cow<'m, Machine<AnyMechanism>>,
        now: &ScheduleInstant,
        phi: f64,
    ) -> Result<Cow<'m, Machine<AnyMechanism>>, Error> {
        let (Some(t), true) = (now.t, self.flows()) else {
            return Ok(machine);
        };
        let placed: Vec<AttachedMass> = self.carriages.iter().map(|c| c.placed(t)).collect();
        let frames = machine.mechanism().frames(phi)?;
        let mechanism = laden(machine.mechanism(), &placed)?;
        let moved = rebuilt(&machine, mechanism, |k, load| {
            let carriage = (self.carriages.iter().zip(&placed)).find(|(c, _)| c.load == k);
            let Some(((carriage, placed), frame)) = carriage.zip(frames.get(load.link())) else {
                return Ok(*load);
            };
            let force = carriage.force(frame, t, now.omega.unwrap_or(0.0));
            Ok(Load::new(load.link(), Action::Force(force))?.at(placed.at)?)
        })?;
        Ok(Cow::Owned(moved))
    }

    /// Whether a payload is carried at this time of the motion.
    pub fn is_laden(&self, t: f64) -> bool {
        if self.flows() {
            return true;
        }
        let now = ScheduleInstant::of(t, 0.0);
        (self.payloads.iter()).any(|payload| payload.when.holds(&now, self.end))
    }

    fn state(&self, now: &ScheduleInstant) -> ScheduleState {
        let share = |load: &ScheduledLoad| {
            if load.at_rest.is_some() && now.is_at_rest() {
                // Where no move begins the direction is unknown: the value at rest is valid for every direction.
                let travel = load.when.travel.filter(|_| now.starts.is_some());
                let when = When {
                    travel,
                    ..load.when.clone()
                };
                if when.holds(now, self.end) {
                    return LoadState::AtRest;
                }
                return LoadState::Nothing;
            }
            if load.when.holds(now, self.end) {
                LoadState::Moving
            } else {
                LoadState::Nothing
            }
        };
        let carried = |payload: &Payload| payload.when.holds(now, self.end);
        (
            self.loads.iter().map(share).collect(),
            self.payloads.iter().map(carried).collect(),
        )
    }

    /// The machine with the loads and payloads of a state.
    fn variant(
        &self,
        machine: &Machine<AnyMechanism>,
        (shares, carried): &ScheduleState,
    ) -> Result<Machine<AnyMechanism>, Error> {
        let masses = (self.payloads.iter().zip(carried))
            .filter_map(|(payload, carried)| carried.then_some(&payload.mass));
        let mechanism = laden(machine.mechanism(), masses)?;
        rebuilt(machine, mechanism, |k, load| {
            let scheduled = self.loads.iter().zip(shares).find(|(s, _)| s.load == k);
            Ok(match scheduled {
                Some((_, LoadState::Nothing)) => {
                    // Its edges stay: the variants differ only in their forces and masses.
                    let none = Load::new(load.link(), Action::Moment(0.0))?;
                    load.window().map_or(none, |window| none.within(window))
                }
                Some((scheduled, LoadState::AtRest)) => scheduled.at_rest.unwrap_or(*load),
                _ => *load,
            })
        })
    }
}

/// The machine with another mechanism of the same links, and with other loads instead of its own.
fn rebuilt(
    machine: &Machine<AnyMechanism>,
    mechanism: AnyMechanism,
    load_of: impl Fn(usize, &Load) -> Result<Load, Error>,
) -> Result<Machine<AnyMechanism>, Error> {
    let loads = machine.loads().iter().enumerate();
    let loads: Vec<Load> = loads
        .map(|(k, load)| load_of(k, load))
        .collect::<Result<_, Error>>()?;
    machine_like(
        machine,
        mechanism,
        loads,
        machine.elements().iter().copied(),
    )
}
