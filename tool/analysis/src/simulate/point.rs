//! The reduced link of each machine at an instant, including its second axes.

use jred::error::Error;
use jred::machine::{Frames, FrictionState, Mechanism as _, Reduction};

use super::clock::Moment;
use super::coupled::GearedMachine;
use super::drive_state::DriveState;
use jred_file::model::carriage::Carriage;
use jred_file::number::numerics::sign;

/// The reduced link of a machine at an instant.
pub(super) struct ReducedLink<'a> {
    pub(super) machine: GearedMachine<'a>,
    /// Without the motion of carriages along their guides.
    pub(super) reduction: Reduction,
    /// b and c of the motion-opposing loads that do process work; they are contained in those of the reduction.
    pub(super) working: [f64; 2],
    /// Friction by a coefficient in the joints.
    pub(super) friction: FrictionState,
    /// Torque of carriages by that motion, against the drive link (N·m).
    resists: f64,
    carried: Option<CarriageState<'a>>,
}

/// The carriages of a machine at an instant.
struct CarriageState<'a> {
    carriages: &'a [Carriage],
    frames: Frames,
    /// Time of the motion (s).
    t: f64,
    omega: f64,
    gravity: [f64; 2],
}

impl<'a> ReducedLink<'a> {
    /// The reduced link of a machine at this position and speed of the first drive link.
    pub(super) fn new(
        machine: GearedMachine<'a>,
        moment: &Moment,
        DriveState { phi, omega }: DriveState,
    ) -> Result<Self, Error> {
        let [phi, omega, _] = machine.state([phi, omega, 0.0]);
        let file = machine.file;
        let now = moment.now(&machine, omega);
        let own = file.machine_at(&now, phi)?;
        let (reduction, resists) = file.apart(&own, own.bare_reduction(phi)?, phi)?;
        let carried = match now.t.filter(|_| file.schedule.flows()) {
            Some(t) => Some(CarriageState {
                carriages: file.schedule.carriages(),
                frames: own.mechanism().frames(phi)?,
                t,
                omega: now.omega.unwrap_or(0.0),
                gravity: own.gravity(),
            }),
            None => None,
        };
        let friction = own.friction_at(phi, omega, moment.direction * machine.ratio())?;
        friction.check(reduction.inertia + file.train_inertia())?;
        Ok(Self {
            machine,
            friction,
            working: file.working(&own, phi)?,
            reduction,
            resists,
            carried,
        })
    }

    /// Torque and inertia at the drive link for an acceleration, with friction in the joints.
    pub(super) fn load(&self, direction: f64, omega: f64, alpha: f64) -> Result<[f64; 2], Error> {
        let inertia = self.reduction.inertia;
        let [torque, per_alpha] = self.friction.torque(alpha)?;
        let resisting = self.resisting(direction, omega) + torque;
        Ok([inertia * alpha + resisting, inertia + per_alpha])
    }

    /// The torque at the drive link that keeps its speed, without friction by a coefficient; only the sign of the direction counts.
    pub(super) fn resisting(&self, direction: f64, omega: f64) -> f64 {
        let point = &self.reduction;
        let load = point.load_torque() - point.viscous * omega - point.coulomb * sign(direction);
        let load = load - self.resists;
        0.5 * point.inertia_slope * omega * omega - load
    }

    /// Power of the second axes, F·ṡ (W), at this acceleration of the drive link.
    pub(super) fn carriage_power(&self, alpha: f64) -> f64 {
        self.each_carriage(|carriage, carried| {
            let frame = carried.frames.get(carriage.mass.link)?;
            let state = [carried.omega, alpha];
            let effort = carriage.effort(frame, carried.t, state, carried.gravity);
            Some(effort * carriage.at(carried.t).omega)
        })
    }

    /// Kinetic energy (J) beyond ½·J·ω²: that of carriages along their guides.
    pub(super) fn kinetic_beyond(&self) -> f64 {
        self.each_carriage(|carriage, carried| {
            let frame = carried.frames.get(carriage.mass.link)?;
            Some(carriage.energy(frame, carried.t, carried.omega))
        })
    }

    fn each_carriage(&self, value: impl Fn(&Carriage, &CarriageState) -> Option<f64>) -> f64 {
        let all = self.carried.iter().flat_map(|carried| {
            let carriages = carried.carriages.iter();
            carriages.filter_map(|carriage| value(carriage, carried))
        });
        all.sum()
    }
}

/// The reduced links of all machines, at an instant.
pub(super) struct ReducedLinks<'a> {
    first: ReducedLink<'a>,
    beside: Vec<ReducedLink<'a>>,
}

impl<'a> ReducedLinks<'a> {
    /// The reduced links of these machines, at this position and speed of the first drive link.
    pub(super) fn new(
        first: GearedMachine<'a>,
        beside: &[GearedMachine<'a>],
        moment: &Moment,
        link: DriveState,
    ) -> Result<Self, Error> {
        let beside = beside.iter();
        let beside = beside.map(|machine| ReducedLink::new(*machine, moment, link));
        Ok(Self {
            first: ReducedLink::new(first, moment, link)?,
            beside: beside.collect::<Result<_, Error>>()?,
        })
    }

    /// Torque and inertia at each drive link, for a direction and a motion of the first.
    pub(super) fn loads(
        &self,
        direction: f64,
        state: [f64; 3],
    ) -> Result<Vec<(GearedMachine<'a>, [f64; 2])>, Error> {
        let load = |point: &ReducedLink<'a>| {
            let machine = point.machine;
            let [_, omega, alpha] = machine.state(state);
            let load = point.load(direction * machine.ratio(), omega, alpha)?;
            Ok((machine, load))
        };
        self.all().map(load).collect()
    }

    pub(super) fn all(&self) -> impl Iterator<Item = &ReducedLink<'a>> {
        std::iter::once(&self.first).chain(&self.beside)
    }
}
