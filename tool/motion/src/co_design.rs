//! Chooses drive and motion together: each borderline drive is tried with its own gentlest motion.

use std::collections::{BTreeMap, BTreeSet};

use jred_analysis::duty::{Duty, Sampling};
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_sizing::catalogue::{Catalogue, Drive, DriveId};
use jred_sizing::cycle::Cycle;
use jred_sizing::motor::envelope::{Envelope, MotorLimits};
use jred_sizing::select::size::{Candidate, Order, Selection};
use jred_sizing::threads;

use crate::gentlest::cycle::{self, Figures, Goal, Obstacle, Request};
use crate::gentlest::without_drive;
use crate::moves::{self, Chain};
use crate::path_dynamics::Actuator;

/// Number of suitable and of refused drives, under the file's motion and under the machine's own gentlest one, that get their own motion.
const MOST_CANDIDATES: usize = 8;

/// Data for judging drives.
pub struct CoDesignInput<'a> {
    /// The machine.
    pub file: &'a MachineFile,
    /// Its motion.
    pub own: &'a Motion,
    /// The drives.
    pub catalogue: &'a Catalogue,
    /// Limits of their motors.
    pub motors: &'a [MotorLimits],
    /// How finely the duty is sampled.
    pub sampling: Sampling,
    /// Removes drives that were not requested from a selection.
    pub narrow: &'a (dyn Fn(&mut Selection) + Sync),
}

/// A drive with its gentlest motion.
#[derive(Clone, Debug)]
pub struct DriveWithMotion<'c> {
    /// The drive.
    pub drive: Drive<'c>,
    /// Its figures with the motion of the file.
    pub own: Figures,
    /// Its figures with its gentlest motion.
    pub gentlest: Figures,
    /// Its rank among drives with their own motions; `None` if it violates a rule with its own motion.
    pub order: Option<Order<'c>>,
    motion: Motion,
    cycle: Cycle,
}

/// The best drive with its own motion, and accompanying results.
#[derive(Clone, Debug)]
pub struct CoDesign<'c> {
    /// The tried drives, in order of rank; those that violate a rule last.
    pub tried: Vec<DriveWithMotion<'c>>,
    /// The first drive with the motion of the file, and its rank.
    pub before: Option<(Drive<'c>, Order<'c>)>,
    /// The parts of the file's motion.
    pub chain: Chain,
    /// A drive that ranks higher under the motion of the first tried drive, although its own motion would be worse for it.
    pub ahead: Option<Drive<'c>>,
}

impl<'c> CoDesign<'c> {
    /// The best drive; `None` if no drive satisfies the rules with its own motion.
    pub fn best(&self) -> Option<&DriveWithMotion<'c>> {
        self.tried.first().filter(|tried| tried.order.is_some())
    }

    /// The same, if it is as good as the first drive with the motion of the file; `None` if the motion of the file stays. The motion of least RMS
    /// torque distributes speed and torque differently, which may exceed the limits of a small drive.
    pub fn better(&self) -> Option<&DriveWithMotion<'c>> {
        let as_good = |tried: &&DriveWithMotion| match (&self.before, &tried.order) {
            (Some((_, before)), Some(order)) => order.is_as_good_as(before),
            _ => true,
        };
        self.best().filter(as_good)
    }

    /// The motion of that drive.
    pub fn motion(&self) -> Option<&Motion> {
        self.better().map(|tried| &tried.motion)
    }
}

/// The first drives of a motion: those that fit, and borderline ones.
struct Shortlist<'a> {
    fit: Vec<(DriveId, Drive<'a>, Order<'a>)>,
    tried: BTreeMap<DriveId, Drive<'a>>,
}

impl<'a> CoDesignInput<'a> {
    /// Each of the first drives with its motion of least RMS torque.
    ///
    /// # Errors
    /// As [`cycle::gentlest_cycle`].
    pub fn best(&self) -> Result<CoDesign<'a>, Obstacle> {
        let own = self.cycle(self.own)?;
        let before = self.first(&own);
        let free = self.gentlest(&self.request(None))?;
        let free = self.first(&self.cycle(&free)?);
        let mut known = BTreeSet::new();
        let mut suited = CoDesign {
            tried: Vec::new(),
            before: before.fit.first().map(|(_, drive, order)| (*drive, *order)),
            chain: moves::chain(self.own, &self.file.process()).map_err(Obstacle::NoMoves)?,
            ahead: None,
        };
        let first = before.tried.into_iter().chain(free.tried);
        let first: Vec<(DriveId, Drive)> = first.filter(|(id, _)| known.insert(*id)).collect();
        let tried = threads::map(&first, |(id, drive)| self.with_own(*id, *drive, &own));
        suited.tried = tried.into_iter().collect::<Result<_, _>>()?;
        suited.sort();
        // With the motion of the best drive, an untried drive may rank first.
        for _ in 0..MOST_CANDIDATES {
            let Some(best) = suited.best() else { break };
            let listed = self.first(&best.cycle);
            let ahead = listed.fit.first();
            let Some((id, drive, _)) = ahead.filter(|(.., order)| Some(*order) < best.order) else {
                break;
            };
            if !known.insert(*id) {
                suited.ahead = Some(*drive);
                break;
            }
            suited.tried.push(self.with_own(*id, *drive, &own)?);
            suited.sort();
        }
        Ok(suited)
    }

    /// A drive with its own motion; `own` is the cycle of the file's motion.
    fn with_own(
        &self,
        id: DriveId,
        drive: Drive<'a>,
        own: &Cycle,
    ) -> Result<DriveWithMotion<'a>, Obstacle> {
        let request = self.request(Some(&drive));
        let motion = self.gentlest(&request)?;
        let cycle = self.cycle(&motion)?;
        Ok(DriveWithMotion {
            drive,
            order: self.order(id, drive, &cycle),
            own: request.figures(own),
            gentlest: request.figures(&cycle),
            motion,
            cycle,
        })
    }

    /// The request for a drive, or for the machine alone.
    fn request(&self, drive: Option<&Drive>) -> Request {
        let actuator = drive.map_or_else(without_drive, |drive| {
            let envelope = Envelope::at(drive.motor, drive.amplifier, &self.file.site);
            Actuator::new(drive, envelope)
        });
        Request {
            actuator,
            copper: None,
            goal: Goal::Rms,
            ramp: 0.0,
            sampling: self.sampling,
        }
    }

    fn gentlest(&self, request: &Request) -> Result<Motion, Obstacle> {
        cycle::alone(self.file, self.own, request)
    }

    fn cycle(&self, motion: &Motion) -> Result<Cycle, Obstacle> {
        Ok(Cycle::new(&Duty::new(self.file, motion, self.sampling)?))
    }

    fn first(&self, cycle: &Cycle) -> Shortlist<'a> {
        let Self { file, motors, .. } = self;
        let mut selection =
            Selection::parallel(self.catalogue, motors, cycle, &file.site, &file.rules);
        (self.narrow)(&mut selection);
        let fit = selection.first_fit(MOST_CANDIDATES);
        // The smaller motor that is refused by least is the one that another motion may make suitable.
        let smaller = selection.next_smaller();
        let refused = selection.first_refused(MOST_CANDIDATES);
        // Drives of the catalogue outlive the selection.
        let all = fit.iter().chain(&refused).chain(&smaller);
        let wanted: BTreeSet<DriveId> = all.map(Candidate::id).collect();
        let drives = self.catalogue.drives();
        let tried: BTreeMap<DriveId, Drive<'a>> =
            drives.filter(|(id, _)| wanted.contains(id)).collect();
        let with_order = fit.iter().filter_map(|candidate| {
            let drive = tried.get(&candidate.id())?;
            Some((candidate.id(), *drive, Order::of(candidate).on(*drive)))
        });
        Shortlist {
            fit: with_order.collect(),
            tried,
        }
    }

    /// The rank of a drive with a motion of this cycle; `None` if it violates a rule.
    fn order(&self, id: DriveId, drive: Drive<'a>, cycle: &Cycle) -> Option<Order<'a>> {
        let Self {
            file,
            motors,
            catalogue,
            ..
        } = self;
        let alone = std::iter::once((id, drive));
        let selection = Selection::among(alone, catalogue, motors, cycle, &file.site, &file.rules);
        let first = selection.fit.first()?;
        Some(Order::of(first).on(drive))
    }
}

impl<'c> CoDesign<'c> {
    fn sort(&mut self) {
        let key = |tried: &DriveWithMotion<'c>| (tried.order.is_none(), tried.order);
        self.tried.sort_by_key(key);
    }
}
