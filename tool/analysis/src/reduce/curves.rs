//! The reduced link and the motion's drive torque as columns.

use jred::error::Error;
use jred::machine::TorqueTerms;
use jred::mechanism::TrainOutput;

use super::{RowPose, Set, Source};
use jred_file::model::coordinate::Coordinate;
use jred_file::number::columns::{Column, ColumnQuantity};

/// J_red with its derivatives, the terms of the reduced torque, and the drive torque of the motion.
pub(super) struct CurveColumns {
    /// Each link's share of J_red.
    pub(super) links: bool,
    /// Whether there is a motion.
    pub(super) moves: bool,
}

/// Only speed and acceleration.
pub(super) struct MotionColumns;

/// The terms of the motion's drive torque, including drive train and flywheel, without the losses of the drive train.
pub(super) struct TorqueColumns {
    /// Also their sum, unless the forces contain it.
    pub(super) sum: bool,
}

impl Set for TorqueColumns {
    fn heads(&self, source: &Source) -> Vec<Column> {
        let sum = self.sum.then(|| source.coordinate.drive_effort());
        terms(source.coordinate).chain(sum).collect()
    }

    fn values(&self, source: &Source, place: &RowPose) -> Result<Vec<Option<f64>>, Error> {
        let machine = source.machines.at(&place.now, place.phi)?;
        let terms = place
            .state
            .map(|s| machine.torque(place.phi, s.omega, s.alpha));
        let terms = terms.transpose()?;
        let values = (0..TorqueTerms::NAMES.len()).map(|k| Some(terms?.values()[k]));
        let sum = self.sum.then(|| terms.map(|terms| terms.total()));
        Ok(values.chain(sum).collect())
    }
}

/// The columns of the drive torque's terms.
fn terms(coordinate: Coordinate) -> impl Iterator<Item = Column> {
    let (effort, unit) = (coordinate.effort(), coordinate.effort_unit());
    let term = move |term: &str| Column {
        part: term.to_owned(),
        ..Column::new(
            ColumnQuantity::EffortTerm,
            format!("{effort}_drive {term}"),
            unit,
        )
    };
    TorqueTerms::NAMES.into_iter().map(term)
}

impl Set for MotionColumns {
    fn heads(&self, source: &Source) -> Vec<Column> {
        source.coordinate.rates().to_vec()
    }

    fn values(&self, _: &Source, place: &RowPose) -> Result<Vec<Option<f64>>, Error> {
        let rates = place.state.map(|s| [s.omega, s.alpha]);
        Ok(vec![rates.map(|r| r[0]), rates.map(|r| r[1])])
    }
}

/// The columns of the reduced link, including drive train and flywheel.
fn curves(coordinate: Coordinate) -> Vec<Column> {
    let (inertia, unit, per) = (
        coordinate.inertia(),
        coordinate.inertia_unit(),
        coordinate.per(),
    );
    let (effort, effort_unit) = (coordinate.effort(), coordinate.effort_unit());
    let viscous = coordinate.pick("N m s/rad", "N s/m");
    vec![
        Column::new(ColumnQuantity::ReducedInertia, inertia, unit),
        Column::new(
            ColumnQuantity::InertiaSlope,
            format!("{inertia}'"),
            format!("{unit}/{per}"),
        ),
        Column::other(format!("{inertia}''"), format!("{unit}/{per}^2")),
        Column::other("U", "J"),
        Column::other(format!("{effort}_potential"), effort_unit),
        Column::other(format!("{effort}_process"), effort_unit),
        Column::other("b_viscous", viscous),
        Column::other("c_coulomb", effort_unit),
    ]
}

impl Set for CurveColumns {
    fn heads(&self, source: &Source) -> Vec<Column> {
        let coordinate = source.coordinate;
        let (inertia, unit) = (coordinate.inertia(), coordinate.inertia_unit());
        let mut heads = curves(coordinate);
        if self.links {
            let each = source.machine.mechanism().names().iter();
            heads.extend(each.map(|link| Column::other(format!("{inertia} {link}"), unit)));
            let train = format!("{inertia} flywheel and drive train");
            heads.push(Column::other(train, unit));
        }
        if self.moves {
            // Stages begin with a shaft that turns, also those of a link that slides.
            let at_input = match source.file.drive_train.stages() {
                [] => coordinate,
                _ => Coordinate::Angle,
            };
            let (effort, unit) = (at_input.effort(), at_input.effort_unit());
            heads.extend(coordinate.rates());
            heads.extend(terms(coordinate));
            heads.push(coordinate.drive_effort());
            heads.push(Column::other(format!("{effort}_input"), unit));
        }
        heads
    }

    fn values(&self, source: &Source, place: &RowPose) -> Result<Vec<Option<f64>>, Error> {
        let machine = source.machines.at(&place.now, place.phi)?;
        let point = machine.bare_reduction(place.phi)?;
        let [inertia, slope, bend] = point.inertias();
        let mut values = vec![
            inertia,
            slope,
            bend,
            point.potential_energy,
            -point.potential_slope,
            point.process,
            point.viscous,
            point.coulomb,
        ];
        if self.links {
            // Without carriages, which have their own columns.
            let machine = source.machines.among(&place.now);
            let each = machine.link_inertias(place.phi)?;
            values.extend(each.iter().map(|j| j[0]));
            values.push(source.machine.flywheel());
        }
        let mut values: Vec<Option<f64>> = values.into_iter().map(Some).collect();
        let Some(state) = place.state else {
            let empty = if self.moves { 10 } else { 0 };
            values.resize(values.len() + empty, None);
            return Ok(values);
        };
        let terms = machine.torque(place.phi, state.omega, state.alpha)?;
        // The drive train's inertia is in its stages, between the losses.
        let bare = source.file.machine_at(&place.now, place.phi)?;
        let bare = bare.torque(place.phi, state.omega, state.alpha)?.total();
        let train = &source.file.drive_train;
        let input = train
            .input(&TrainOutput {
                torque: bare,
                torque_per_alpha: 0.0,
                omega: state.omega,
                alpha: state.alpha,
                direction: state.omega,
            })
            .torque;
        values.extend([state.omega, state.alpha].map(Some));
        values.extend(terms.values().map(Some));
        values.extend([terms.total(), input].map(Some));
        Ok(values)
    }
}
