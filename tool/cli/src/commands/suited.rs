//! The motion that suits a drive best, and the drive: `jred size --motion best`.

use std::collections::BTreeSet;

use miette::Result;

use crate::commands::core_error::core_report;
use crate::commands::retime::report;
use crate::options::Size;
use jred_machine::analysis::duty::Duty;
use jred_machine::model::machine::MachineFile;
use jred_machine::model::motion::Motion;
use jred_machine::number::rounding::{percent, short};
use jred_motion::gentlest::without_drive;
use jred_motion::retime::{Goal, Request, Retimed, retime};
use jred_motion::way::Actuator;
use jred_sizing::catalogue::{Catalogue, Drive, DriveId};
use jred_sizing::cycle::Cycle;
use jred_sizing::motor::envelope::{Envelope, Prepared};
use jred_sizing::select::filter::Filter;
use jred_sizing::select::size::Selection;

/// Suitable and refused drives, of the file's motion and of the machine's own gentlest one, that get a motion of their own.
const TRIED: usize = 8;

/// What drives are judged with.
pub(super) struct Judging<'a> {
    pub(super) options: &'a Size,
    pub(super) file: &'a MachineFile,
    pub(super) own: &'a Motion,
    pub(super) filter: &'a Filter,
    pub(super) catalogue: &'a Catalogue,
    pub(super) motors: &'a [Prepared],
}

/// A drive with the motion that suits it.
struct Suited<'a> {
    drive: Drive<'a>,
    retimed: Retimed,
    rank: Rank,
}

/// Figures of others than the makers and an unknown voltage come last, then the smaller motor comes first, one without a warning, and
/// the one that uses its limits less: the order of the list.
type Rank = (u8, u64, bool, u64);

impl<'a> Judging<'a> {
    /// The motion with the least RMS torque for the drive that is the best one with its own such motion; and what it saves, in
    /// words. `None`: no drive is suitable with a motion of its own.
    pub(super) fn best(&self) -> Result<(Option<Motion>, String)> {
        let before = self.drives(self.own)?;
        let free = self.drives(&self.gentlest(None)?.motion)?;
        let mut names = BTreeSet::new();
        let mut best: Option<Suited> = None;
        for (id, drive) in before.tried.iter().chain(&free.tried) {
            if !names.insert(drive.name()) {
                continue;
            }
            let retimed = self.gentlest(Some(drive))?;
            if let Some(rank) = self.rank(*id, *drive, &retimed.motion)?
                && best.as_ref().is_none_or(|best| rank < best.rank)
            {
                best = Some(Suited {
                    drive: *drive,
                    retimed,
                    rank,
                });
            }
        }
        let Some(best) = best else {
            let says = "Motion: that of the file; with its gentlest motion none of the closest drives is suitable";
            return Ok((None, says.to_owned()));
        };
        let says = words(&best, before.first.as_ref());
        Ok((Some(best.retimed.motion), says))
    }

    /// The gentlest motion for a drive, or for the machine alone.
    fn gentlest(&self, drive: Option<&Drive>) -> Result<Retimed> {
        let actuator = drive.map_or_else(without_drive, |drive| {
            let envelope = Envelope::at(drive.motor, drive.amplifier, &self.file.site);
            Actuator::new(drive, envelope)
        });
        let request = Request {
            actuator,
            copper: None,
            goal: Goal::Rms,
            ramp: 0.0,
            steps: self.options.supply.steps as usize,
        };
        let path = &self.options.file;
        retime(self.file, self.own, &request)
            .map_err(|obstacle| report(path, None, self.file, &obstacle))
    }

    fn cycle(&self, motion: &Motion) -> Result<Cycle> {
        let steps = self.options.supply.steps as usize;
        let duty = Duty::new(self.file, motion, steps).map_err(core_report)?;
        Ok(Cycle::new(&duty))
    }

    /// The first drives of a motion.
    fn drives(&self, motion: &Motion) -> Result<First<'a>> {
        let Self { file, motors, .. } = self;
        let cycle = self.cycle(motion)?;
        let mut selection =
            Selection::parallel(self.catalogue, motors, &cycle, &file.site, &file.rules);
        self.options.search.apply(self.filter, &mut selection);
        let fit = selection.first_fit(TRIED);
        let first = fit.first().map(|candidate| candidate.drive.name());
        // The smaller motor that is refused by least is the one that another motion may make suitable.
        let smaller = selection.next_smaller();
        let refused = selection.first_refused(TRIED);
        let tried: BTreeSet<String> = (fit.iter().chain(&refused).chain(&smaller))
            .map(|candidate| candidate.drive.name())
            .collect();
        // Drives of the catalogue outlive the selection.
        let named = |name: &String| {
            let mut drives = self.catalogue.drives();
            drives.find(|(_, drive)| drive.name() == *name)
        };
        Ok(First {
            first: first.as_ref().and_then(named).map(|(_, drive)| drive),
            tried: tried.iter().filter_map(named).collect(),
        })
    }

    /// The rank of a drive with a motion; `None`: it is refused.
    fn rank(&self, id: DriveId, drive: Drive<'a>, motion: &Motion) -> Result<Option<Rank>> {
        let Self {
            file,
            motors,
            catalogue,
            ..
        } = self;
        let cycle = self.cycle(motion)?;
        let alone = std::iter::once((id, drive));
        let selection = Selection::among(alone, catalogue, motors, &cycle, &file.site, &file.rules);
        Ok(selection.fit.first().map(|candidate| {
            let outcome = &candidate.outcome;
            let doubt = u8::from(outcome.voltage_unknown) << 1 | u8::from(!drive.from_makers());
            let power = drive.motor.rated_power().unwrap_or(f64::INFINITY);
            // The bits of numbers that are not negative are in their order.
            let [power, used] = [power.abs(), outcome.worst_use.max(0.0)].map(f64::to_bits);
            (doubt, power, outcome.warnings > 0, used)
        }))
    }
}

/// The first drives of a motion: the best one that fits, and those near the border.
struct First<'a> {
    first: Option<Drive<'a>>,
    tried: Vec<(DriveId, Drive<'a>)>,
}

fn words(best: &Suited, before: Option<&Drive>) -> String {
    let power = |drive: &Drive| {
        let known = drive.motor.rated_power();
        known.map_or_else(
            || "of unknown power".to_owned(),
            |power| format!("{} W", short(power)),
        )
    };
    let Suited { drive, retimed, .. } = best;
    let less = (1.0 - retimed.best.rms / retimed.own.rms).max(0.0);
    let says = format!(
        "Motion: the gentlest for {} ({}), with {} less RMS torque than the file's; `jred retime` writes it",
        drive.name(),
        power(drive),
        percent(less)
    );
    let saved = match before {
        None => "With the motion of the file no drive is suitable".to_owned(),
        Some(before) if before.name() == drive.name() => {
            "With the motion of the file the same drive is the best one".to_owned()
        }
        Some(before) => format!(
            "With the motion of the file the best drive is {} ({})",
            before.name(),
            power(before)
        ),
    };
    format!("{says}\n{saved}")
}
