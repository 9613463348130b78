//! `jred reduce`: the reduced link over a turn, and what the file's motion asks of the drive.

use std::f64::consts::TAU;

use jred::motion::State;
use jred::{Error, Reducible, Reduction, TorqueTerms};

use crate::machine::MachineFile;
use crate::motion::Motion;
use crate::output::Columns;

/// What the rows run over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Over {
    /// Equal steps of the drive link's angle over one turn.
    #[default]
    Angle,
    /// Equal steps of time over the motion.
    Time,
}

/// The columns of the reduced link, drive train and flywheel included.
const CURVES: [&str; 8] = [
    "J_red [kg m^2]",
    "J_red' [kg m^2/rad]",
    "J_red'' [kg m^2/rad^2]",
    "U [J]",
    "T_potential [N m]",
    "T_process [N m]",
    "b_viscous [N m s/rad]",
    "c_coulomb [N m]",
];

/// The reduced curves at `positions` places, with each link's share of J_red if `links`, and the motion's drive
/// torque.
///
/// # Errors
/// Those of the machine.
pub fn reduce(
    file: &MachineFile,
    over: Over,
    positions: usize,
    links: bool,
) -> Result<Columns, Error> {
    let machine = file.with_drive_train()?;
    let mut names: Vec<String> = match over {
        Over::Angle => vec!["phi [deg]".into()],
        Over::Time => vec!["t [s]".into(), "phi [deg]".into()],
    };
    names.extend(CURVES.map(String::from));
    if links {
        let each = machine.mechanism().link_names();
        names.extend(each.iter().map(|link| format!("J_red {link} [kg m^2]")));
        names.push("J_red flywheel and drive train [kg m^2]".into());
    }
    if file.motion.is_some() {
        names.extend(["omega [rad/s]", "alpha [rad/s^2]"].map(String::from));
        names.extend(TorqueTerms::NAMES.map(|term| format!("T_drive {term} [N m]")));
        names.extend(["T_drive [N m]", "T_input [N m]"].map(String::from));
    }
    let mut columns = Columns::new(names);
    for k in 0..positions {
        let (mut row, phi, state) = if let (Over::Time, Some(motion)) = (over, &file.motion) {
            let last = (positions - 1).max(1) as f64;
            let t = motion.duration() * k as f64 / last;
            let state = motion.at(t);
            let row = vec![Some(t), Some(state.phi.to_degrees())];
            (row, state.phi, Some(state))
        } else {
            let phi = TAU * k as f64 / positions as f64;
            let state = file.motion.as_ref().and_then(|m| at_angle(m, phi));
            (vec![Some(phi.to_degrees())], phi, state)
        };
        let point = machine.reduction(phi)?;
        row.extend(curve_values(&point).map(Some));
        if links {
            row.extend(machine.link_inertias(phi)?.iter().map(|j| Some(j[0])));
            row.push(Some(machine.flywheel()));
        }
        if file.motion.is_some() {
            row.extend(drive_values(file, &point, phi, state)?);
        }
        columns.push(row);
    }
    Ok(columns)
}

fn curve_values(point: &Reduction) -> [f64; 8] {
    [
        point.inertia[0],
        point.inertia[1],
        point.inertia[2],
        point.potential_energy[0],
        -point.potential_energy[1],
        point.process,
        point.viscous,
        point.coulomb,
    ]
}

/// Speed, acceleration, terms and totals of the drive torque; empty where the motion does not pass.
fn drive_values(
    file: &MachineFile,
    point: &Reduction,
    phi: f64,
    state: Option<State<f64>>,
) -> Result<[Option<f64>; 10], Error> {
    let mut values = [None; 10];
    let Some(State { omega, alpha, .. }) = state else {
        return Ok(values);
    };
    let terms = point.torque(omega, alpha);
    // The drive train's inertia sits in its stages, between the losses.
    let bare = file
        .machine
        .bare_reduction(phi)?
        .torque(omega, alpha)
        .total();
    let motor = file.drive_train.input(bare, 0.0, omega, alpha).torque;
    let totals = [terms.total(), motor];
    let all = [omega, alpha]
        .into_iter()
        .chain(terms.values())
        .chain(totals);
    for (slot, value) in values.iter_mut().zip(all) {
        *slot = Some(value);
    }
    Ok(values)
}

/// The motion's state where it passes the angle `phi` (modulo a turn), for a motion that passes every angle once:
/// it turns one way, through exactly one turn. Dwells count once, at rest.
fn at_angle(motion: &Motion, phi: f64) -> Option<State<f64>> {
    let (start, end) = (motion.at(0.0).phi, motion.at(motion.duration()).phi);
    let way = (end - start).signum();
    let one_turn = ((end - start).abs() - TAU).abs() < 1e-9;
    let one_way = (0..=1000).all(|k| {
        let t = motion.duration() * f64::from(k) / 1000.0;
        motion.at(t).omega * way >= -1e-12
    });
    if !(one_turn && one_way) {
        return None;
    }
    let distance = ((phi - start) * way).rem_euclid(TAU);
    let (mut early, mut late) = (0.0, motion.duration());
    for _ in 0..60 {
        let middle = 0.5 * (early + late);
        if (motion.at(middle).phi - start) * way < distance {
            early = middle;
        } else {
            late = middle;
        }
    }
    let state = motion.at(late);
    Some(State { phi, ..state })
}
