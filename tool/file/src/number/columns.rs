//! Columns of numbers, each with its quantity, name and unit: the result of an analysis.

/// Quantity of a column: a program finds the column by it, whatever its name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColumnQuantity {
    /// Time.
    Time,
    /// Position of the drive link.
    Position,
    /// Speed of the drive link.
    DriveSpeed,
    /// Acceleration of the drive link.
    DriveAcceleration,
    /// Reference less position.
    FollowingError,
    /// Reduced inertia, or reduced mass.
    ReducedInertia,
    /// Its derivative with respect to the position.
    InertiaSlope,
    /// Required torque or force of the drive link.
    DriveEffort,
    /// A term of that torque or force: of the acceleration, of loads and so on.
    EffortTerm,
    /// Torque or force of the motor.
    MotorEffort,
    /// Torque at the output of the motor's gearbox.
    GearboxTorque,
    /// Speed of the motor.
    MotorSpeed,
    /// Current of the motor.
    Current,
    /// Temperature of the motor, or its rise.
    Temperature,
    /// Coordinate x or y of a point.
    Coordinate,
    /// Transfer function x′ of a point.
    XSlope,
    /// Transfer function y′ of a point.
    YSlope,
    /// Magnitude of the velocity of a point.
    Speed,
    /// Magnitude of the acceleration of a point.
    Acceleration,
    /// Transfer function ψ′ of a link's angle.
    AngleSlope,
    /// Angular speed of a link.
    AngularSpeed,
    /// Angular acceleration of a link.
    AngularAcceleration,
    /// Magnitude of the force in a joint, or of the shaking force.
    Force,
    /// Moment in a joint, or the shaking moment.
    Moment,
    /// Energy, work or loss.
    Energy,
    /// A balance that is zero except for the error of the integration.
    EnergyBalance,
    /// Anything else.
    #[default]
    Other,
}

/// The header of a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its quantity.
    pub quantity: ColumnQuantity,
    /// Its part, if several columns have the same quantity: a point, a link, a joint. Empty if there is only one.
    pub part: String,
    /// Its name, for example `B v_x`.
    pub name: String,
    /// Its unit; empty: no unit.
    pub unit: String,
}

impl Column {
    /// A column of the whole machine.
    pub fn new(quantity: ColumnQuantity, name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self {
            quantity,
            part: String::new(),
            name: name.into(),
            unit: unit.into(),
        }
    }

    /// A column without a quantity for programs.
    pub fn other(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self::new(ColumnQuantity::Other, name, unit)
    }

    /// A column of one part, for example `B` and `v_x`.
    pub fn of(quantity: ColumnQuantity, part: &str, symbol: &str, unit: &str) -> Self {
        Self {
            part: part.to_owned(),
            ..Self::new(quantity, format!("{part} {symbol}"), unit)
        }
    }

    /// Name and unit, for example `omega [rad/s]`.
    pub fn title(&self) -> String {
        if self.unit.is_empty() {
            self.name.clone()
        } else {
            format!("{} [{}]", self.name, self.unit)
        }
    }
}

/// Columns of numbers; `None` is an empty cell.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    heads: Vec<Column>,
    rows: Vec<Vec<Option<f64>>>,
}

impl Columns {
    /// Columns with these headers, without rows.
    pub fn new(heads: impl IntoIterator<Item = Column>) -> Self {
        Self {
            heads: heads.into_iter().collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row with one value for each column.
    ///
    /// # Panics
    /// If the number of values differs.
    pub fn push(&mut self, row: impl IntoIterator<Item = impl Into<Option<f64>>>) {
        let row: Vec<Option<f64>> = row.into_iter().map(Into::into).collect();
        assert_eq!(row.len(), self.heads.len());
        self.rows.push(row);
    }

    /// The headers.
    pub fn heads(&self) -> &[Column] {
        &self.heads
    }

    /// Names and units.
    pub fn names(&self) -> Vec<String> {
        self.heads.iter().map(Column::title).collect()
    }

    /// The columns of one quantity: index and header.
    pub fn of(&self, quantity: ColumnQuantity) -> impl Iterator<Item = (usize, &Column)> {
        let heads = self.heads.iter().enumerate();
        heads.filter(move |(_, head)| head.quantity == quantity)
    }

    /// Whether a value is missing anywhere in the first `columns` columns.
    pub fn has_empty_cells(&self, columns: usize) -> bool {
        let first = |row: &Vec<Option<f64>>| row.iter().take(columns).any(Option::is_none);
        self.rows.iter().any(first)
    }

    /// The rows.
    pub fn rows(&self) -> &[Vec<Option<f64>>] {
        &self.rows
    }
}
