//! Contributions to the motor torque and to the inertia at the motor.
//!
//! At every instant the motor torque is a sum of cells, one for each part of the machine and each effect that it has:
//!
//! ```text
//! T = Σ links, flywheel (J_k·α + ½·J_k′·ω²)/(i_t·i) + Σ links U_k′/(i_t·i) + Σ springs + Σ loads + Σ dampers
//!   + train: J_t·i·α_in + (τ − τ_lossless)/i + gearbox: J_G·i·α_in + (T_out(τ) − τ/i) + no-load torque + (J_M + J_B)·i·α_in
//!   + motor friction
//! ```
//!
//! i_t is the ratio of the machine's drive train, i that of the gearbox, τ the torque at the input of the drive train. A loss
//! is what a stage asks for beyond its lossless torque. The cells of an instant add up to the motor torque (test
//! `tests/explain.rs`, 1e-12 of the largest).
//!
//! Each cell's share of the mean square is ⟨T_k·T⟩/⟨T²⟩, its projection on the whole: the shares add up to one. A share may be
//! negative: without that cell the RMS torque would be greater.

use jred::machine::Mechanism as _;
use jred::{Error, Link};
use serde::Serialize;

use crate::catalogue::Drive;
use crate::cycle::form::loads;
use jred_machine::analysis::duty::Duty;
use jred_machine::model::machine::MachineFile;
use jred_machine::number::figures::Figures;
use jred_machine::units::Vocabulary;

/// Contribution of one part or effect to the motor torque.
#[derive(Clone, Debug, Serialize)]
pub struct Share {
    /// Name.
    pub name: String,
    /// Torque at the motor over the cycle (N·m).
    #[serde(rename = "torque [N m]")]
    pub torque: Figures,
    /// Share of the mean square torque; all add up to one, or are zero where there is no torque.
    #[serde(rename = "share of mean square")]
    pub mean_square: f64,
    /// Torque (N·m) at the instant of the largest motor torque.
    #[serde(rename = "at peak [N m]")]
    pub at_peak: f64,
    /// Energy over a cycle that it takes from the motor (J).
    #[serde(rename = "energy [J]")]
    pub energy: f64,
}

/// Contribution of one part to the inertia at the motor.
#[derive(Clone, Debug, Serialize)]
pub struct InertiaShare {
    /// Name of the part.
    pub name: String,
    /// Inertia at the motor over the cycle (kg·m²).
    #[serde(rename = "inertia [kg m^2]")]
    pub inertia: Figures,
    /// Share of the mean.
    #[serde(rename = "share of mean")]
    pub of_mean: f64,
}

/// The contributions to the motor torque and to the inertia at the motor.
#[derive(Clone, Debug, Serialize)]
pub struct Breakdown {
    /// Name of the drive.
    pub drive: String,
    /// What its figures are called and shown in.
    #[serde(skip)]
    pub words: &'static Vocabulary,
    /// When the motor torque is largest (s).
    #[serde(rename = "peak at [s]")]
    pub peak_time: f64,
    /// Energy that flows forth and back in a cycle (J).
    #[serde(skip)]
    stored: f64,
    /// Total.
    pub total: Share,
    /// By effect.
    pub effects: Vec<Share>,
    /// By part.
    pub parts: Vec<Share>,
    /// The inertia at the motor, by part.
    pub inertia: Vec<InertiaShare>,
    /// Its sum.
    pub total_inertia: InertiaShare,
}

/// Torque at the motor of one part through one effect, at every instant.
#[derive(Clone, Debug)]
pub struct Cell {
    kind: Kind,
    /// Name of the part.
    pub part: String,
    /// Its effect.
    pub effect: Effect,
    /// Torque at the motor at every instant of the duty (N·m).
    pub torque: Vec<f64>,
}

/// What a part does to the motor torque, in the order of reports.
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
    const ALL: [Self; 13] = [
        Self::Acceleration,
        Self::Velocity,
        Self::Weight,
        Self::Springs,
        Self::Process,
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
            Self::Viscous => "viscous".to_owned(),
            Self::Coulomb => "Coulomb".to_owned(),
            Self::Train => format!("drive train, {inertia}"),
            Self::TrainLoss => "drive train, losses".to_owned(),
            Self::Gearbox => format!("gearbox, {inertia}"),
            Self::GearboxLoss => "gearbox, losses".to_owned(),
            Self::Rotor => (*rotor).to_owned(),
            Self::Friction => "motor friction".to_owned(),
        }
    }
}

/// Kind of a part, since a link and a load may have the same name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Link,
    Load,
    Element,
    Drive,
}

/// All cells of a drive's cycle.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    /// The torques.
    pub cells: Vec<Cell>,
    inertias: Vec<(String, Vec<f64>)>,
    /// Places of the next cell and the next inertia while an instant is filled in: every instant has the same.
    next: usize,
    next_inertia: usize,
}

impl Cells {
    /// Divides the torque of a drive into cells. Cost: one evaluation of the mechanism per instant.
    ///
    /// # Errors
    /// Those of the machine.
    pub fn new(file: &MachineFile, duty: &Duty, drive: &Drive) -> Result<Self, Error> {
        let mut cells = Self::default();
        for instant in &duty.instants {
            (cells.next, cells.next_inertia) = (0, 0);
            machine(&mut cells, file, drive, instant)?;
            drive_parts(&mut cells, file, drive, instant);
        }
        Ok(cells)
    }

    fn add(&mut self, (kind, part): (Kind, &str), effect: Effect, torque: f64) {
        if self.next == self.cells.len() {
            self.cells.push(Cell {
                kind,
                part: part.to_owned(),
                effect,
                torque: Vec::new(),
            });
        }
        self.cells[self.next].torque.push(torque);
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

impl Breakdown {
    /// The figures of every part and every effect.
    ///
    /// # Errors
    /// Those of the machine.
    pub fn new(file: &MachineFile, duty: &Duty, drive: &Drive) -> Result<Self, Error> {
        Ok(Self::of(duty, drive, &Cells::new(file, duty, drive)?))
    }

    /// Reference energy (J) for recognising rounding errors.
    pub fn turned_over(&self) -> f64 {
        let energies = self.effects.iter().map(|share| share.energy.abs());
        energies
            .fold(self.total.energy.abs(), f64::max)
            .max(self.stored)
    }

    /// The figures of cells that are there already.
    pub fn of(duty: &Duty, drive: &Drive, cells: &Cells) -> Self {
        let words = drive.motor.kind.vocabulary();
        let coefficients = drive.coefficients();
        let whole: Vec<f64> = duty
            .instants
            .iter()
            .map(|i| coefficients.torque(&loads(i)))
            .collect();
        let peak = (0..whole.len())
            .max_by(|&a, &b| whole[a].abs().total_cmp(&whole[b].abs()))
            .unwrap_or(0);
        let square = duty.integral_of(whole.iter().map(|t| t * t));
        let ratio = drive.ratio();
        let share = |name: &str, torque: &[f64]| {
            let product = duty.integral_of(torque.iter().zip(&whole).map(|(a, b)| a * b));
            let power = duty.instants.iter().zip(torque);
            Share {
                name: name.to_owned(),
                torque: duty.figures_of(torque.iter().copied()),
                mean_square: if square > 0.0 { product / square } else { 0.0 },
                at_peak: torque.get(peak).copied().unwrap_or(0.0),
                energy: duty.integral_of(power.map(|(i, t)| t * i.input_speed * ratio)),
            }
        };
        let sum_of = |chosen: &dyn Fn(&Cell) -> bool| {
            let mut sum = vec![0.0; whole.len()];
            for cell in cells.cells.iter().filter(|cell| chosen(cell)) {
                for (sum, torque) in sum.iter_mut().zip(&cell.torque) {
                    *sum += torque;
                }
            }
            sum
        };
        let acts = |share: &Share| share.torque.peak() > 0.0;
        let mut parts: Vec<(Kind, &str)> = Vec::new();
        for cell in &cells.cells {
            if !parts.contains(&(cell.kind, &cell.part)) {
                parts.push((cell.kind, &cell.part));
            }
        }
        let parts = parts.into_iter().map(|(kind, part)| {
            let own = sum_of(&|cell| cell.kind == kind && cell.part == part);
            share(part, &own)
        });
        let effects = Effect::ALL.into_iter().map(|effect| {
            let own = sum_of(&|cell| cell.effect == effect);
            share(&effect.name(words), &own)
        });
        let mut inertia_whole = vec![0.0; whole.len()];
        for (_, values) in &cells.inertias {
            for (sum, value) in inertia_whole.iter_mut().zip(values) {
                *sum += value;
            }
        }
        let mean = duty.figures_of(inertia_whole.iter().copied()).mean;
        let inertia = |name: &str, values: &[f64]| {
            let inertia = duty.figures_of(values.iter().copied());
            InertiaShare {
                name: name.to_owned(),
                inertia,
                of_mean: if mean > 0.0 { inertia.mean / mean } else { 0.0 },
            }
        };
        let inertias = cells.inertias.iter();
        let inertias = inertias.map(|(name, values)| inertia(name, values));
        Self {
            drive: drive.name(),
            words,
            peak_time: duty.instants.get(peak).map_or(0.0, |i| i.t),
            stored: {
                let power = duty.instants.iter().zip(&whole);
                duty.integral_of(power.map(|(i, torque)| (torque * i.input_speed * ratio).abs()))
            },
            total: share(&format!("motor {}", words.torque), &whole),
            effects: effects.filter(acts).collect(),
            parts: parts.filter(acts).collect(),
            inertia: inertias.filter(|i| i.inertia.max > 0.0).collect(),
            total_inertia: inertia("at the motor", &inertia_whole),
        }
    }
}

/// Links, flywheel, loads, springs and dampers.
fn machine(
    cells: &mut Cells,
    file: &MachineFile,
    drive: &Drive,
    instant: &jred_machine::analysis::duty::Instant,
) -> Result<(), Error> {
    let machine = &file.machine;
    let mechanism = machine.mechanism();
    let total = file.drive_train.ratio() * drive.ratio();
    let (omega, alpha) = (instant.omega, instant.alpha);
    let sign = if omega == 0.0 { 0.0 } else { omega.signum() };
    let frames = mechanism.frames(instant.phi)?;
    let names = mechanism.link_names();
    let links = mechanism.links().iter().zip(&frames).zip(names);
    for ((link, frame), name) in links {
        let [inertia, slope, _] = Link::reduced_inertia(link, frame);
        let [_, weight] = link.potential_energy(frame, machine.gravity());
        cells.add(
            (Kind::Link, name),
            Effect::Acceleration,
            inertia * alpha / total,
        );
        cells.add(
            (Kind::Link, name),
            Effect::Velocity,
            0.5 * slope * omega * omega / total,
        );
        cells.add((Kind::Link, name), Effect::Weight, weight / total);
        cells.add_inertia(name, inertia / (total * total));
    }
    cells.add(
        (Kind::Drive, "flywheel"),
        Effect::Acceleration,
        machine.flywheel() * alpha / total,
    );
    cells.add_inertia("flywheel", machine.flywheel() / (total * total));
    for (load, named) in machine.loads().iter().zip(&file.loads) {
        let curves = frames.get(load.link());
        let curves = curves.map(|frame| load.reduce(frame, instant.phi));
        let curves = curves.unwrap_or_default();
        let part = (Kind::Load, named.name.as_str());
        let effect = if mechanism.is_weight(load) {
            Effect::Weight
        } else {
            Effect::Process
        };
        cells.add(part, effect, -curves.process / total);
        cells.add(part, Effect::Viscous, curves.viscous * omega / total);
        cells.add(part, Effect::Coulomb, curves.coulomb * sign / total);
    }
    for (element, named) in machine.elements().iter().zip(&file.elements) {
        let slope = element.length(&frames).d1;
        let still = element.effort(&frames, 0.0);
        let moving = element.effort(&frames, omega);
        // The effort acts on the element's end; the drive gives the opposite.
        let part = (Kind::Element, named.name.as_str());
        cells.add(part, Effect::Springs, -still * slope / total);
        cells.add(part, Effect::Viscous, (still - moving) * slope / total);
    }
    Ok(())
}

/// Drive train, gearbox and motor.
fn drive_parts(
    cells: &mut Cells,
    file: &MachineFile,
    drive: &Drive,
    instant: &jred_machine::analysis::duty::Instant,
) {
    let train = &file.drive_train;
    let ratio = drive.ratio();
    let alpha = instant.input_alpha * ratio;
    let behind = train.inertia_at_input();
    let lossless = instant.terms.total() / train.ratio() + behind * instant.input_alpha;
    let loss = (instant.input_torque - lossless) / ratio;
    cells.add(
        (Kind::Drive, "drive train"),
        Effect::Train,
        behind * instant.input_alpha / ratio,
    );
    cells.add((Kind::Drive, "drive train"), Effect::TrainLoss, loss);
    cells.add_inertia("drive train", behind / (ratio * ratio));
    let [_, driving, back, speed, sign] = loads(instant);
    let [_, to_machine, from_machine, viscous, coulomb] = drive.coefficients().0;
    let losses = driving * (to_machine - 1.0 / ratio) + back * (from_machine - 1.0 / ratio);
    let [own_coulomb, _] = drive.motor.friction;
    let gearbox = drive.gearbox.map_or(0.0, |g| g.inertia);
    cells.add((Kind::Drive, "gearbox"), Effect::Gearbox, gearbox * alpha);
    cells.add(
        (Kind::Drive, "gearbox"),
        Effect::GearboxLoss,
        losses + (coulomb - own_coulomb) * sign,
    );
    cells.add_inertia("gearbox", gearbox);
    let rotor = drive.motor.kind.vocabulary().rotor;
    let brake = drive.motor.brake_inertia();
    cells.add(
        (Kind::Drive, rotor),
        Effect::Rotor,
        drive.motor.rotor_inertia * alpha,
    );
    cells.add_inertia(rotor, drive.motor.rotor_inertia);
    cells.add(
        (Kind::Drive, "brake of the motor"),
        Effect::Rotor,
        brake * alpha,
    );
    cells.add_inertia("brake of the motor", brake);
    cells.add(
        (Kind::Drive, "motor friction"),
        Effect::Friction,
        viscous * speed + own_coulomb * sign,
    );
}
