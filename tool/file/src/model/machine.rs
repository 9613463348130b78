//! A machine as described by a machine file, checked and in SI units.

use std::borrow::Cow;
use std::fmt;
use std::sync::OnceLock;

use jred::error::Error;
use jred::machine::{Element, Jointed, Load, Machine, Mechanism, Reducible as _, Reduction};

use crate::model::axis::Axis;
use crate::model::coordinate::positions;
use crate::model::document::Document;
use crate::model::drive_element::DriveElement;
use crate::model::drive_train::DriveTrain;
use crate::model::mechanism::{AnyMechanism, NamedElement, NamedLoad};
use crate::model::motion::{Motion, Steady};
use crate::model::rules::RuleSet;
use crate::model::schedule::{Schedule, ScheduleInstant};
use crate::model::simulation::Simulation;
use crate::model::site::Site;
use crate::model::tolerance::Tolerance;
use crate::model::variator::Variator;
use crate::model::with_mass::{AttachedMass, laden};

/// Positions over the range at which inertia and holding torque are evaluated.
pub const POSITIONS: usize = 720;

/// The content of a machine file.
#[derive(Clone, Debug)]
pub struct MachineFile {
    /// Name of the file, for messages.
    pub name: String,
    /// Title for reports.
    pub title: String,
    /// Title block of reports.
    pub document: Document,
    /// The mechanism with gravity, loads and flywheel, *without* the drive train and without the [`schedule`](Self::schedule).
    pub machine: Machine<AnyMechanism>,
    /// Loads that act only in a part of the motion, payloads and carriages.
    pub schedule: Schedule,
    /// Inertia of the flywheel on the drive link (kg·m²), contained in `machine`.
    pub flywheel: f64,
    /// The loads, in the order of the machine's.
    pub loads: Vec<NamedLoad>,
    /// Number of turns after which the tables of loads repeat.
    pub table_turns: u32,
    /// The springs and dampers, in the order of the machine's.
    pub elements: Vec<NamedElement>,
    /// Fixed drive train between the motor's gearbox (or the motor) and the drive link; it can be empty.
    pub drive_train: DriveTrain,
    /// Belts, screws and pinions of drive train and mechanism whose limits the file gives, in order from the motor.
    pub drive_elements: Vec<DriveElement>,
    /// Friction variator between the motor and the drive train, if there is one.
    pub variator: Option<Variator>,
    /// The prescribed motion, if any.
    pub motion: Option<Motion>,
    /// The simulation for `jred simulate`, if any.
    pub simulation: Option<Simulation>,
    /// Sizing rules: defaults, unless the file overrides them.
    pub rules: RuleSet,
    /// Tolerances of quantities, from `[tolerance]`.
    pub tolerances: Vec<Tolerance>,
    /// Supply, surroundings, stiffness and tool.
    pub site: Site,
    /// The reduced link over the range, computed on demand.
    pub over_range: ReductionCache,
}

/// The reduced link over the range of the drive link, computed once. A clone of a machine, which may be changed, starts without it.
#[derive(Default)]
pub struct ReductionCache(OnceLock<Vec<(f64, Reduction)>>);

impl Clone for ReductionCache {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl fmt::Debug for ReductionCache {
    /// It follows from the rest of the machine, so a digest does not need it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("ReductionCache")
    }
}

impl MachineFile {
    /// Name of the shaft at which a motor or its gearbox drives the machine.
    pub fn input_name(&self) -> &'static str {
        if self.drive_train.stages().is_empty() {
            "drive link"
        } else {
            "input of the drive train"
        }
    }

    /// Number of turns of the drive link after which the loads repeat.
    pub fn turns(&self) -> u32 {
        let windows = self.loads.iter().filter_map(|named| named.load.window());
        let windows = windows.map(|window| window.turns().max(1));
        windows.fold(self.table_turns, least_common_multiple)
    }

    /// The motion of a file that must have one.
    ///
    /// # Errors
    /// The file has no motion.
    pub fn required_motion(&self) -> crate::text::problem::Result<&Motion> {
        self.motion_or("")
    }

    /// The same if an option can replace it: `instead` is the beginning of the cure, such as `give --omega, or `.
    ///
    /// # Errors
    /// The file has no motion.
    pub fn motion_or(&self, instead: &str) -> crate::text::problem::Result<&Motion> {
        self.motion.as_ref().ok_or_else(|| {
            crate::problem!(
                help = format!(
                    "{instead}add a [motion], for example type = \"constant-speed\", speed = \"60 rpm\""
                ),
                "{} has no [motion]",
                self.name
            )
        })
    }

    /// The process parts of the motion: segments of constant speed, and for a winder the constant speed of the web, after any law.
    pub fn process(&self) -> Vec<Steady> {
        let winds = self.machine.mechanism().kind() == "winder";
        let stretches = self.motion.iter().flat_map(Motion::steady);
        stretches.filter(|steady| steady.whole || winds).collect()
    }

    /// The coordinate of this axis for users: see [`Axis::of`].
    pub fn axis(&self) -> Axis {
        Axis::of(self.motion.as_ref(), self.machine.mechanism())
    }

    /// The machine at an instant, with the loads and payloads of that time, without the drive train. Its carriages are valid only at the position
    /// `phi` of the drive link.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`, if there are carriages.
    pub fn machine_at(
        &self,
        now: &ScheduleInstant,
        phi: f64,
    ) -> Result<Cow<'_, Machine<AnyMechanism>>, Error> {
        let machine = self.machine_among(now);
        self.schedule.flowing(Cow::Borrowed(machine), now, phi)
    }

    /// The same without carriages.
    pub fn machine_among(&self, now: &ScheduleInstant) -> &Machine<AnyMechanism> {
        let number = self.schedule.number(now);
        self.schedule.machine(number).unwrap_or(&self.machine)
    }

    /// Share of carriages in the process torque of a machine of [`machine_at`](Self::machine_at), at its position, from their motion along their
    /// guides (N·m).
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`.
    pub fn carriage_torque(&self, machine: &Machine<AnyMechanism>, phi: f64) -> Result<f64, Error> {
        if !self.schedule.flows() {
            return Ok(0.0);
        }
        let frames = machine.mechanism().frames(phi)?;
        let torques = self.schedule.carriages().iter().filter_map(|carriage| {
            let load = machine.loads().get(carriage.load)?;
            let frame = frames.get(load.link())?;
            Some(load.reduce(frame, phi).process)
        });
        Ok(torques.sum())
    }

    /// The reduced link of a machine of [`machine_at`](Self::machine_at) without the share of carriages in its process torque, and their resisting
    /// torque (N·m) from their motion along their guides. Like the velocity torque, it is proportional to masses and the square of the pace.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`.
    pub fn apart(
        &self,
        machine: &Machine<AnyMechanism>,
        mut reduction: Reduction,
        phi: f64,
    ) -> Result<(Reduction, f64), Error> {
        let driving = self.carriage_torque(machine, phi)?;
        reduction.process -= driving;
        Ok((reduction, -driving))
    }

    /// The reduced link at `phi` without the drive train and without the schedule, as by [`Machine::bare_reduction`], but with the weight of payloads
    /// from tables in U′ and not among the process loads. U stays without it: a payload that varies with the position has no U.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`.
    pub fn bare_reduction(&self, phi: f64) -> Result<Reduction, Error> {
        self.bare_reduction_at(&ScheduleInstant::default(), phi)
    }

    /// [`bare_reduction`](Self::bare_reduction) at [`POSITIONS`] positions over the range, with each of them.
    ///
    /// # Errors
    /// The mechanism cannot be placed at one of them.
    pub fn over_range(&self) -> Result<&[(f64, Reduction)], Error> {
        if let Some(known) = self.over_range.0.get() {
            return Ok(known);
        }
        let all = positions(self.machine.domain(), POSITIONS)
            .map(|phi| Ok((phi, self.bare_reduction(phi)?)))
            .collect::<Result<Vec<_>, Error>>()?;
        Ok(self.over_range.0.get_or_init(|| all))
    }

    /// The same at an instant, with the loads and payloads of that time.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`.
    pub fn bare_reduction_at(&self, now: &ScheduleInstant, phi: f64) -> Result<Reduction, Error> {
        self.reduction_of(&*self.machine_at(now, phi)?, phi)
    }

    /// The same for one of its machines.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`.
    pub fn reduction_of(
        &self,
        machine: &Machine<AnyMechanism>,
        phi: f64,
    ) -> Result<Reduction, Error> {
        let mut reduction = machine.bare_reduction(phi)?;
        let weight = self.payload_weight(phi)?;
        reduction.potential_slope += weight;
        reduction.process += weight;
        Ok(reduction)
    }

    /// Torque (N·m) of the drive link against the weight of payloads from tables, −m·g·r′; zero without such payloads.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`.
    pub fn payload_weight(&self, phi: f64) -> Result<f64, Error> {
        let mechanism = self.machine.mechanism();
        if mechanism.weights.is_empty() {
            return Ok(0.0);
        }
        let frames = mechanism.frames(phi)?;
        let loads = self.machine.loads().iter();
        let weights = loads.filter(|load| mechanism.is_weight(load));
        let torques = weights.filter_map(|load| {
            let frame = frames.get(load.link())?;
            Some(-load.reduce(frame, phi).process)
        });
        Ok(torques.sum())
    }

    /// Puts masses on links, and replaces the springs with these numbers; `None`: no spring.
    ///
    /// # Errors
    /// Errors of the machine.
    pub fn rebuild<'a>(
        &mut self,
        masses: impl IntoIterator<Item = &'a AttachedMass>,
        springs: impl IntoIterator<Item = (usize, Option<Element>)>,
    ) -> Result<(), Error> {
        let mut elements: Vec<Option<NamedElement>> = self.elements.drain(..).map(Some).collect();
        for (number, spring) in springs {
            if let Some(slot) = elements.get_mut(number) {
                *slot = spring
                    .zip(slot.take())
                    .map(|(element, named)| NamedElement {
                        element,
                        name: named.name,
                    });
            }
        }
        self.elements = elements.into_iter().flatten().collect();
        let mechanism = laden(self.machine.mechanism(), masses)?;
        let loads = self.loads.iter().map(|named| named.load);
        let elements = self.elements.iter().map(|named| named.element);
        let machine = machine_like(&self.machine, mechanism, loads, elements)?;
        self.schedule = self.schedule.of_machine(&machine, self.motion.as_ref())?;
        self.machine = self.schedule.at_no_time().cloned().unwrap_or(machine);
        self.over_range = ReductionCache::default();
        Ok(())
    }

    /// The machine with its drive train reduced to the drive link: the load of the motor's gearbox.
    ///
    /// # Errors
    /// Never for a machine file that was read without error.
    pub fn with_drive_train(&self) -> Result<Machine<AnyMechanism>, Error> {
        Ok(self.machine.clone().with_flywheel(self.train_inertia())?)
    }

    /// Inertia of the drive train reduced to the drive link (kg·m², or kg).
    pub fn train_inertia(&self) -> f64 {
        let ratio = self.drive_train.ratio();
        self.drive_train.inertia_at_input() * ratio * ratio
    }
}

/// A machine with the gravity, the flywheel and the friction in the joints of another one, whose joints are the same.
///
/// # Errors
/// A load or an element does not belong to the mechanism.
pub fn machine_like<M: Jointed>(
    like: &Machine<impl Mechanism>,
    mechanism: M,
    loads: impl IntoIterator<Item = Load>,
    elements: impl IntoIterator<Item = Element>,
) -> Result<Machine<M>, Error> {
    let mut machine = Machine::new(mechanism)
        .with_gravity(like.gravity())?
        .with_flywheel(like.flywheel())?;
    for load in loads {
        machine = machine.with_load(load)?;
    }
    for element in elements {
        machine = machine.with_element(element)?;
    }
    for friction in like.frictions() {
        machine = machine.with_friction(*friction)?;
    }
    Ok(machine)
}

/// The least common multiple.
pub fn least_common_multiple(a: u32, b: u32) -> u32 {
    let (mut x, mut y) = (a, b);
    while y > 0 {
        (x, y) = (y, x % y);
    }
    a / x.max(1) * b
}

/// The machines of a file with its drive train: a single one, or those of its schedule.
#[derive(Clone, Debug)]
pub struct Machines<'f> {
    schedule: &'f Schedule,
    machines: Vec<Machine<AnyMechanism>>,
}

impl<'f> Machines<'f> {
    /// The machines of a file.
    ///
    /// # Errors
    /// Never for a machine file that was read without error.
    pub fn of(file: &'f MachineFile) -> Result<Self, Error> {
        let with_train = |machine: &Machine<AnyMechanism>| {
            Ok(machine.clone().with_flywheel(file.train_inertia())?)
        };
        let mut machines = vec![file.with_drive_train()?];
        if !file.schedule.is_empty() {
            let scheduled = file.schedule.machines().map(with_train);
            machines = scheduled.collect::<Result<_, Error>>()?;
        }
        Ok(Self {
            schedule: &file.schedule,
            machines,
        })
    }

    /// The machine at an instant; its carriages are valid only at the position `phi` of the drive link.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`, if there are carriages.
    pub fn at(
        &self,
        now: &ScheduleInstant,
        phi: f64,
    ) -> Result<Cow<'_, Machine<AnyMechanism>>, Error> {
        self.flowing(self.among(now), now, phi)
    }

    /// The machine at an instant, without carriages.
    pub fn among(&self, now: &ScheduleInstant) -> &Machine<AnyMechanism> {
        &self.machines[self.schedule.number(now)]
    }

    /// One of the machines, with the carriages in their positions at an instant.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`, if there are carriages.
    pub fn flowing<'m>(
        &self,
        machine: &'m Machine<AnyMechanism>,
        now: &ScheduleInstant,
        phi: f64,
    ) -> Result<Cow<'m, Machine<AnyMechanism>>, Error> {
        self.schedule.flowing(Cow::Borrowed(machine), now, phi)
    }
}
