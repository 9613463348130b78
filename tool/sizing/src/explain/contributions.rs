//! The torque of a drive, split by parts and by effects, at every instant of its cycle.

use jred::error::Error;
use jred::machine::Mechanism as _;

use crate::catalogue::Drive;
use crate::cycle::form::loads;
use jred_analysis::duty::{Duty, Instant};
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_file::model::schedule::ScheduleInstant;
use jred_file::units::Vocabulary;

/// Torque at the motor of one part through one effect, at every instant.
#[derive(Clone, Debug)]
pub struct Contribution {
    pub(super) kind: PartKind,
    /// Name of the part.
    pub part: String,
    /// Its effect.
    pub effect: Effect,
    /// Torque at the motor at every instant of the duty (N·m).
    pub torque: Vec<f64>,
}

/// Effect of a part on the motor torque, in the order of reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// J·α of the machine.
    Acceleration,
    /// ½·J′·ω² of the machine.
    Velocity,
    /// Its weight.
    Weight,
    /// Its springs.
    Springs,
    /// Process loads.
    Process,
    /// Motion of a carriage along its guide.
    Carriage,
    /// Viscous loads.
    Viscous,
    /// Loads against the motion.
    Coulomb,
    /// Inertia of the drive train.
    Train,
    /// Losses of the drive train.
    TrainLoss,
    /// Inertia of the gearbox.
    Gearbox,
    /// Losses of the gearbox.
    GearboxLoss,
    /// Inertia of rotor and brake.
    Rotor,
    /// Friction of the motor.
    Friction,
}

impl Effect {
    pub(super) const ALL: [Self; 14] = [
        Self::Acceleration,
        Self::Velocity,
        Self::Weight,
        Self::Springs,
        Self::Process,
        Self::Carriage,
        Self::Viscous,
        Self::Coulomb,
        Self::Train,
        Self::TrainLoss,
        Self::Gearbox,
        Self::GearboxLoss,
        Self::Rotor,
        Self::Friction,
    ];

    /// Its name for a kind of motor.
    pub fn name(self, Vocabulary { inertia, rotor, .. }: &Vocabulary) -> String {
        match self {
            Self::Acceleration => "acceleration J·α".to_owned(),
            Self::Velocity => "velocity ½·J′·ω²".to_owned(),
            Self::Weight => "weight".to_owned(),
            Self::Springs => "springs".to_owned(),
            Self::Process => "process".to_owned(),
            Self::Carriage => "second axis".to_owned(),
            Self::Viscous => "viscous".to_owned(),
            Self::Coulomb => "dry friction".to_owned(),
            Self::Train => format!("drive train, {inertia}"),
            Self::TrainLoss => "drive train, losses".to_owned(),
            Self::Gearbox => format!("gearbox, {inertia}"),
            Self::GearboxLoss => "gearbox, losses".to_owned(),
            Self::Rotor => (*rotor).to_owned(),
            Self::Friction => "motor friction".to_owned(),
        }
    }
}

/// Kind of a part, because a link and a load may have the same name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PartKind {
    Link,
    Load,
    Element,
    Drive,
}

/// All contributions over a drive's cycle.
#[derive(Clone, Debug, Default)]
pub struct Contributions {
    /// The torques.
    pub torques: Vec<Contribution>,
    pub(super) inertias: Vec<(String, Vec<f64>)>,
    /// Positions of the next torque and the next inertia while an instant is filled in: all instants have the same order.
    next: usize,
    next_inertia: usize,
}

impl Contributions {
    /// Splits the torque of a drive. Cost: one evaluation of the mechanism per instant.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere.
    pub fn new(file: &MachineFile, duty: &Duty, drive: &Drive) -> Result<Self, Error> {
        let mut contributions = Self::default();
        let own = file.motion.as_ref().map_or(duty.duration, Motion::duration);
        let share = own / duty.duration;
        for instant in &duty.instants {
            (contributions.next, contributions.next_inertia) = (0, 0);
            // The cycle may take longer than the file's.
            let t = instant.t * share;
            let starts = instant.omega == 0.0 && instant.direction != 0.0;
            // At the pace of the file, so that its carriages are in step.
            let now = if starts {
                ScheduleInstant::starting(t, instant.direction)
            } else {
                ScheduleInstant::of(t, instant.omega / share)
            };
            machine(&mut contributions, file, drive, instant, &now, share)?;
            drive_parts(&mut contributions, file, drive, instant);
        }
        Ok(contributions)
    }

    fn add(&mut self, kind: PartKind, part: &str, effect: Effect, torque: f64) {
        if self.next == self.torques.len() {
            self.torques.push(Contribution {
                kind,
                part: part.to_owned(),
                effect,
                torque: Vec::new(),
            });
        }
        self.torques[self.next].torque.push(torque);
        self.next += 1;
    }

    fn add_inertia(&mut self, part: &str, inertia: f64) {
        if self.next_inertia == self.inertias.len() {
            self.inertias.push((part.to_owned(), Vec::new()));
        }
        self.inertias[self.next_inertia].1.push(inertia);
        self.next_inertia += 1;
    }
}

/// Links, flywheel, loads, springs and dampers.
fn machine(
    contributions: &mut Contributions,
    file: &MachineFile,
    drive: &Drive,
    instant: &Instant,
    now: &ScheduleInstant,
    pace: f64,
) -> Result<(), Error> {
    let machine = file.machine_at(now, instant.phi)?;
    let mechanism = machine.mechanism();
    let total = file.drive_train.ratio() * drive.ratio();
    let (omega, alpha) = (instant.omega, instant.alpha);
    // Sign of the move that begins when static friction is overcome.
    let sign = if instant.direction == 0.0 {
        0.0
    } else {
        instant.direction.signum()
    };
    let frames = mechanism.frames(instant.phi)?;
    let names = mechanism.names();
    // A carriage has its own share, apart from the link that carries it.
    let unladen = file.machine_among(now).mechanism();
    let links = unladen.links().iter().copied().zip(&frames).zip(names);
    let links = links.map(|((link, frame), name)| (link, frame, PartKind::Link, name.as_str()));
    let mut parts: Vec<_> = links.collect();
    for carriage in file.schedule.carriages() {
        if let Some((t, frame)) = now.t.zip(frames.get(carriage.mass.link)) {
            let (kind, part) = (PartKind::Load, carriage.name.as_str());
            parts.push((carriage.placed(t).alone()?, frame, kind, part));
        }
    }
    for (link, frame, kind, part) in parts {
        let [inertia, slope, _] = link.reduced_inertia(frame);
        let [_, weight] = link.potential_energy(frame, machine.gravity());
        contributions.add(kind, part, Effect::Acceleration, inertia * alpha / total);
        let velocity = 0.5 * slope * omega * omega;
        contributions.add(kind, part, Effect::Velocity, velocity / total);
        contributions.add(kind, part, Effect::Weight, weight / total);
        contributions.add_inertia(part, inertia / (total * total));
    }
    contributions.add(
        PartKind::Drive,
        "flywheel",
        Effect::Acceleration,
        machine.flywheel() * alpha / total,
    );
    contributions.add_inertia("flywheel", machine.flywheel() / (total * total));
    for (k, (load, named)) in machine.loads().iter().zip(&file.loads).enumerate() {
        let curves = frames.get(load.link());
        let curves = curves.map(|frame| load.reduce(frame, instant.phi));
        let curves = curves.unwrap_or_default();
        let (kind, part) = (PartKind::Load, named.name.as_str());
        let effect = if mechanism.is_weight(load) {
            Effect::Weight
        } else {
            Effect::Process
        };
        let (effect, scale) = if file.schedule.is_of_carriage(k) {
            (Effect::Carriage, pace * pace)
        } else {
            (effect, 1.0)
        };
        contributions.add(kind, part, effect, -curves.process * scale / total);
        contributions.add(kind, part, Effect::Viscous, curves.viscous * omega / total);
        contributions.add(kind, part, Effect::Coulomb, curves.coulomb * sign / total);
    }
    contributions.add(
        PartKind::Load,
        "friction in joints",
        Effect::Coulomb,
        instant.joint_friction / total,
    );
    for (element, named) in machine.elements().iter().zip(&file.elements) {
        let slope = element.length(&frames).d1;
        let still = element.effort(&frames, 0.0);
        let moving = element.effort(&frames, omega);
        // The effort acts on the element's end; the drive applies the opposite.
        let (kind, part) = (PartKind::Element, named.name.as_str());
        contributions.add(kind, part, Effect::Springs, -still * slope / total);
        contributions.add(
            kind,
            part,
            Effect::Viscous,
            (still - moving) * slope / total,
        );
    }
    Ok(())
}

/// Drive train, gearbox and motor.
fn drive_parts(
    contributions: &mut Contributions,
    file: &MachineFile,
    drive: &Drive,
    instant: &Instant,
) {
    let train = &file.drive_train;
    let ratio = drive.ratio();
    let alpha = instant.input_alpha * ratio;
    let behind = train.inertia_at_input();
    let lossless = instant.terms.total() / train.ratio() + behind * instant.input_alpha;
    let loss = (instant.input_torque - lossless) / ratio;
    contributions.add(
        PartKind::Drive,
        "drive train",
        Effect::Train,
        behind * instant.input_alpha / ratio,
    );
    contributions.add(PartKind::Drive, "drive train", Effect::TrainLoss, loss);
    contributions.add_inertia("drive train", behind / (ratio * ratio));
    let [_, driving, back, speed, sign] = loads(instant);
    let [_, to_machine, from_machine, viscous, coulomb] = drive.coefficients().0;
    let losses = driving * (to_machine - 1.0 / ratio) + back * (from_machine - 1.0 / ratio);
    let [own_coulomb, _] = drive.motor.friction;
    let gearbox = drive.gearbox.map_or(0.0, |g| g.inertia);
    contributions.add(PartKind::Drive, "gearbox", Effect::Gearbox, gearbox * alpha);
    contributions.add(
        PartKind::Drive,
        "gearbox",
        Effect::GearboxLoss,
        losses + (coulomb - own_coulomb) * sign,
    );
    contributions.add_inertia("gearbox", gearbox);
    let rotor = drive.motor.kind.vocabulary().rotor;
    let brake = drive.motor.brake_inertia();
    contributions.add(
        PartKind::Drive,
        rotor,
        Effect::Rotor,
        drive.motor.rotor_inertia * alpha,
    );
    contributions.add_inertia(rotor, drive.motor.rotor_inertia);
    contributions.add(
        PartKind::Drive,
        "brake of the motor",
        Effect::Rotor,
        brake * alpha,
    );
    contributions.add_inertia("brake of the motor", brake);
    contributions.add(
        PartKind::Drive,
        "motor friction",
        Effect::Friction,
        viscous * speed + own_coulomb * sign,
    );
}
