//! The result for the axes on one DC bus.

use jred_file::problem;
use jred_file::text::problem::Result;

use super::axes::{Axes, Bounds, WorstPhases};
use super::cure::{Cure, share};
use super::curve::PowerCurve;
use super::need::Misses;
use super::store::BusFigures;
use super::supply::BusData;
use super::{Need, Watch, power, stop};
use crate::catalogue::{Catalogue, Drive};
use crate::cycle::Cycle;
use crate::motor::envelope::MotorLimits;
use jred_file::model::site::Site;
use jred_file::model::supply::Supply;

/// One axis: its drive and its power.
#[derive(Clone, Debug)]
pub struct BusAxis {
    /// Title of its machine file.
    pub title: String,
    /// Name of its drive.
    pub drive: String,
    /// Power that it draws over its cycle.
    pub curve: PowerCurve,
    /// Bus data of its own amplifier and motor.
    pub data: BusData,
    /// Whether its power contains the loss of the winding.
    pub loses: bool,
    /// Whether its drive violates no rule.
    pub holds: bool,
}

impl BusAxis {
    /// The axis of a drive, on a bus of this supply.
    pub fn new(
        title: &str,
        drive: &Drive,
        limits: &MotorLimits,
        cycle: &Cycle,
        supply: &Site,
        drive_stop: Option<f64>,
        holds: bool,
    ) -> Self {
        let (motor, amplifier) = (drive.motor, drive.amplifier);
        let (coefficients, ratio) = (drive.coefficients(), drive.ratio());
        let limits = limits.on(amplifier);
        let curve = power(cycle, &coefficients, ratio, motor, limits, amplifier);
        let stop = stop(cycle, &coefficients, ratio, limits, drive_stop);
        Self {
            title: title.to_owned(),
            loses: motor.winding.resistance.is_some(),
            drive: drive.name(),
            curve: curve.with_stop(stop),
            data: BusData::new(&supply.supply, supply.highest_supply(), amplifier, motor),
            holds,
        }
    }
}

/// The result for the axes on their bus.
#[derive(Debug)]
pub struct BusAnalysis {
    /// Whether all axes start their cycles together, and only that is judged.
    pub only_in_step: bool,
    /// The axes.
    pub axes: Vec<BusAxis>,
    /// Data of the bus.
    pub data: BusData,
    /// All axes on the bus.
    pub shared: Axes,
    /// Figures of the bus with all axes in step.
    pub in_step: Option<BusFigures>,
    /// Power drawn with all axes in step.
    pub power: Option<PowerCurve>,
    /// Worst phases for each of the figures of [`BusFigures::judged`].
    pub worst: Option<[WorstPhases; 4]>,
    /// Phases with the smallest use of the limits.
    pub calmest: Option<WorstPhases>,
    /// Bounds for any phases.
    pub bounds: Bounds,
    /// Requirements for a brake resistor if the machine files give none or it is not suitable.
    pub need: Option<Need>,
    /// The smallest resistor of the catalogue that meets the need.
    pub proposal: Option<String>,
    /// The same, if it was connected to the bus because the machine files give no resistor.
    pub chosen: Option<String>,
    /// Why no resistor of the catalogue meets the need.
    pub misses: Option<Misses>,
    /// Changes that would satisfy every limit.
    pub cures: Vec<Cure>,
}

impl BusAnalysis {
    /// Computes the result; `only_in_step`: only with all axes in step.
    ///
    /// # Errors
    /// Data of the DC bus are missing.
    pub fn new(
        axes: Vec<BusAxis>,
        only_in_step: bool,
        supply: &Supply,
        catalogue: &Catalogue,
        watch: &dyn Watch,
    ) -> Result<Self> {
        let each: Vec<BusData> = axes.iter().map(|axis| axis.data).collect();
        let data = BusData::shared(supply, &each);
        let mut answer = Self::on(axes, data, only_in_step, watch)?;
        if data.asks_for_a_resistor(answer.judged()[0]) || !answer.failed().is_empty() {
            let need = match &answer.power {
                Some(power) if only_in_step => Need::of(&data, power),
                _ => Need::over(&data, &answer.shared, watch),
            };
            let proposal = need.and_then(|need| need.proposal(&catalogue.resistors, None));
            if let Some(resistor) = proposal.filter(|_| data.resistor.is_none()) {
                let with = BusData {
                    resistor: Some(resistor.on_bus()),
                    ..data
                };
                answer = Self::on(answer.axes, with, only_in_step, watch)?;
                answer.chosen = Some(resistor.key.clone());
            }
            answer.need = need;
            answer.proposal = proposal.map(|resistor| resistor.key.clone());
            if let (Some(need), None) = (need, proposal)
                && !catalogue.resistors.is_empty()
            {
                answer.misses = Some(need.misses(&catalogue.resistors, None));
            }
        }
        if only_in_step && !answer.failed().is_empty() {
            answer.search(watch);
            answer.worst = None;
        }
        answer.cures = answer.cures(watch);
        Ok(answer)
    }

    /// The axes on a bus with these data, and their worst phases.
    fn on(
        axes: Vec<BusAxis>,
        data: BusData,
        only_in_step: bool,
        watch: &dyn Watch,
    ) -> Result<Self> {
        let unknown = |axis: &&BusAxis| !axis.curve.stop().peak.is_finite();
        if let Some(axis) = axes.iter().find(unknown) {
            return Err(problem!(
                help = "give peak_torque of the motor in the catalogue, or remove drive_stop from [duty]",
                "{}: the energy of a stop by the drive is not known: the peak torque of {} is missing",
                axis.title,
                axis.drive
            ));
        }
        let bus = data.bus().map_err(|missing| {
            problem!(
                help = "add a [supply] to one of the machine files, for example mains_voltage = \"400 V\", capacitance = \"470 uF\", \
                        chopper_voltage = \"780 V\", max_voltage = \"820 V\"; docs/thermal-and-bus.md has all keys",
                "no data for the DC bus: {missing} is missing"
            )
        })?;
        let curves: Vec<PowerCurve> = axes.iter().map(|axis| axis.curve.clone()).collect();
        let shared = Axes::new(bus, curves);
        let together = vec![0.0; axes.len()];
        let mut answer = Self {
            only_in_step,
            in_step: shared.at(&together),
            power: shared.power(&together),
            worst: None,
            calmest: None,
            bounds: shared.bounds(),
            need: None,
            proposal: None,
            chosen: None,
            misses: None,
            cures: Vec::new(),
            axes,
            data,
            shared,
        };
        if !only_in_step {
            answer.search(watch);
        }
        Ok(answer)
    }

    /// The worst phases, and the phases with the most margin.
    fn search(&mut self, watch: &dyn Watch) {
        let Some(period) = self.power.as_ref().map(PowerCurve::period) else {
            return;
        };
        let limits = self.limits();
        let goals = |figures: &BusFigures| {
            let [voltage, burnt, peak, pulse] = figures.judged(1.0);
            let calmest = -share(limits, figures, period);
            [voltage, burnt, peak, pulse, calmest]
        };
        if let Some([voltage, resistor, peak, pulse, calmest]) = self.shared.largest(goals, watch) {
            self.worst = Some([voltage, resistor, peak, pulse]);
            self.calmest = Some(calmest);
        }
    }

    /// Mean power of separate resistors less the mean power of a common one (W), with all axes in step; only for several axes with a given resistor.
    pub fn saved(&self) -> Option<f64> {
        self.data.resistor.filter(|_| self.axes.len() > 1)?;
        let period = self.power.as_ref()?.period();
        Some(self.shared.apart() - self.in_step?.burnt / period)
    }
}
