//! Sort key of drives.

use std::cmp::Ordering;

use super::Candidate;
use crate::catalogue::{Drive, DriveId};
use crate::judge::Outcome;
use jred_file::model::rule::Rule;

jred_file::words! {
    /// How certain it is that a drive that violates no rule can be bought as it is. The more certain drives come first in any ranking.
    #[derive(PartialOrd, Ord, Hash)]
    pub enum Certainty {
        /// The voltage is stated, and all figures are the makers' own.
        Makers = "makers-figures",
        /// The voltage is stated, but not all figures are from the makers' own documents.
        Others = "other-figures",
        /// The makers' own figures, but the catalogue gives no amplifier for this motor, only for others, no holding brake that the machine needs, or no peak torque of the gearbox.
        MakersIncomplete = "makers-figures-incomplete",
        /// The same with figures that are not all from the makers' own documents.
        OthersIncomplete = "other-figures-incomplete",
        /// Nobody states that the amplifier runs the motor, which is of another maker.
        Pairing = "pairing-unknown",
        /// Nobody states what voltage the motor or the amplifier is made for.
        Voltage = "voltage-unknown",
    }
}

impl Certainty {
    /// All, the most certain first.
    pub const ALL: [Self; 6] = [
        Self::Makers,
        Self::Others,
        Self::MakersIncomplete,
        Self::OthersIncomplete,
        Self::Pairing,
        Self::Voltage,
    ];

    /// The certainty of a drive with this outcome.
    pub fn of(drive: &Drive, outcome: &Outcome) -> Self {
        // By its data, because a drive may be sorted before every rule is judged.
        let gearbox = drive.gearbox;
        let incomplete = drive.motor.lacks_amplifier
            || outcome.not_checked.has(Rule::BrakeTorque)
            || gearbox.is_some_and(|gearbox| gearbox.peak_torque.is_none());
        if outcome.voltage_unknown {
            return Self::Voltage;
        }
        if !drive.is_paired() {
            return Self::Pairing;
        }
        match (drive.from_makers(), incomplete) {
            (true, false) => Self::Makers,
            (false, false) => Self::Others,
            (true, true) => Self::MakersIncomplete,
            (false, true) => Self::OthersIncomplete,
        }
    }
}

/// Sort key of drives.
///
/// Suitable drives are sorted by certainty, then by size: the smaller motor, for the same motor without warnings first, then the smaller amplifier
/// and the smaller gearbox, then mass and price where known. Refused drives are sorted by the number of violated limits without a share, by the
/// largest use of a limit, then by size. Ties are broken by the keys, so that the order depends neither on the last digits of a figure nor on the
/// division of the work.
#[derive(Clone, Copy, Debug)]
pub struct Order<'c> {
    /// `None` for refused drives.
    certainty: Option<Certainty>,
    /// For refused drives.
    beyond: u8,
    share: RoundedFigure,
    /// For suitable drives.
    warns: bool,
    power: RoundedFigure,
    pub(super) drive: Drive<'c>,
    pub(super) id: DriveId,
}

/// A non-negative figure with the precision of a data sheet; its bits have the order of the figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct RoundedFigure(u32);

impl RoundedFigure {
    const ZERO: Self = Self(0);

    const fn of(value: f64) -> Self {
        Self((value as f32).to_bits())
    }

    /// Last without a value.
    const fn known(value: Option<f64>) -> Self {
        match value {
            Some(value) => Self::of(value),
            None => Self::of(f64::INFINITY),
        }
    }
}

impl<'c> Order<'c> {
    /// The key of a candidate.
    pub fn of(candidate: &Candidate<'c>) -> Self {
        Self::from(candidate.drive, &candidate.outcome, candidate.id)
    }

    /// The same key for another catalogue's or a longer-lived copy of the drive.
    pub fn on<'d>(&self, drive: Drive<'d>) -> Order<'d> {
        Order {
            drive,
            certainty: self.certainty,
            beyond: self.beyond,
            share: self.share,
            warns: self.warns,
            power: self.power,
            id: self.id,
        }
    }

    /// Whether a suitable drive is as certain as another one, with a motor no larger and no more warnings, whatever its other parts.
    pub fn is_as_good_as(&self, other: &Order) -> bool {
        let of = |order: &Order| (order.certainty, order.power, order.warns);
        of(self) <= of(other)
    }

    /// The key of a drive with this outcome. It does not fall when shares of limits or their number grow, so a partial outcome gives a lower bound. A
    /// suitable drive needs no share.
    pub(super) fn from(drive: Drive<'c>, outcome: &Outcome, id: DriveId) -> Self {
        let fails = outcome.fails();
        Self {
            certainty: (!fails).then(|| Certainty::of(&drive, outcome)),
            beyond: if fails { outcome.beyond_all_limits } else { 0 },
            share: if fails {
                RoundedFigure::of(outcome.worst_use)
            } else {
                RoundedFigure::ZERO
            },
            warns: !fails && outcome.warnings > 0,
            power: RoundedFigure::known(drive.motor.rated_power()),
            drive,
            id,
        }
    }

    /// All criteria after the power of the motor; rarely needed, so not stored.
    fn rest(&self) -> (RoundedFigure, bool, [RoundedFigure; 4]) {
        let Drive {
            motor,
            gearbox,
            amplifier,
        } = self.drive;
        let current = amplifier.map(|amplifier| amplifier.rated_current);
        let gearbox = gearbox.map_or(RoundedFigure::ZERO, |g| RoundedFigure::known(g.size()));
        (
            RoundedFigure::known(motor.rated_torque.or(motor.standstill_torque)),
            self.warns,
            [
                RoundedFigure::known(current),
                gearbox,
                RoundedFigure::known(self.drive.mass()),
                RoundedFigure::known(self.drive.price()),
            ],
        )
    }

    fn keys(&self) -> [&'c str; 3] {
        let Drive {
            motor,
            gearbox,
            amplifier,
        } = self.drive;
        [
            &motor.key,
            gearbox.map_or("", |g| &g.key),
            amplifier.map_or("", |a| &a.key),
        ]
    }
}

impl Ord for Order<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        let first = |o: &Self| (o.certainty, o.beyond, o.share, o.power);
        first(self)
            .cmp(&first(other))
            .then_with(|| self.rest().cmp(&other.rest()))
            .then_with(|| self.keys().cmp(&other.keys()))
            .then_with(|| self.id.cmp(&other.id))
    }
}

impl PartialOrd for Order<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Order<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Order<'_> {}
