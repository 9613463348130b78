//! The gearboxes and amplifiers that can be combined with each motor.

use std::collections::HashMap;

use super::amplifier::Amplifier;
use super::fault::Remarks;
use super::motor::{Motor, MotorKind};
use super::voltage::of_one_class;
use super::{Catalogue, Gearbox};
use crate::catalogue::{Drive, DriveId};

/// Gearboxes and amplifiers that can be combined with each motor, as indices into the lists of the catalogue.
///
/// By default every motor is combined with every gearbox, without a gearbox, and with every suitable amplifier ([`Pairing::suits`]) of its own maker.
/// Amplifiers of other makers are used only if the catalogue has no amplifier of the motor's maker and its lists pair no amplifiers at all.
#[derive(Clone, Debug, Default)]
pub struct Pairing {
    /// By index of the motor; a motor beyond the end is combined with everything.
    pub(super) motors: Vec<Partners>,
    /// Whether a list names amplifiers for any motor.
    pub(super) lists_amplifiers: bool,
    /// By index of the amplifier: whether a list names it, so that it runs no other motors.
    pub(super) listed: Vec<bool>,
    /// By index of the gearbox: whether it is part of gear motors and so used with no other motor.
    pub(super) built_in: Vec<bool>,
}

/// Combinations of one motor.
#[derive(Clone, Debug, Default)]
pub(super) struct Partners {
    /// Gearboxes in increasing order; `None`: all that are not part of gear motors.
    pub(super) gearboxes: Option<Box<[u32]>>,
    /// Whether it may not be directly coupled.
    pub(super) never_direct: bool,
    /// Amplifiers in increasing order; `None`: all suitable ones.
    pub(super) amplifiers: Option<Box<[u32]>>,
}

/// Whether both are from one maker, in any spelling.
pub(super) fn of_one_maker(motor: &Motor, amplifier: &Amplifier) -> bool {
    same_name(&motor.maker, &amplifier.maker)
}

/// Whether two names differ only in capitals, blanks and hyphens.
fn same_name(one: &str, other: &str) -> bool {
    let letters = |name: &str| -> Vec<char> {
        let letters = name.chars().filter(|c| c.is_alphanumeric());
        letters.flat_map(char::to_lowercase).collect()
    };
    one == other || letters(one) == letters(other)
}

/// Rated current of an amplifier relative to the motor's: a smaller one cannot feed the motor, a larger one controls it coarsely.
const CURRENTS: [f64; 2] = [0.5, 4.0];

impl Pairing {
    /// Whether an amplifier is suitable for a motor if no list decides. Its bus voltage must be within a factor of 4/3 of the voltage of the motor
    /// data, or higher and within the voltage that the motor is stated to be made for. Its rated current must be half to four times the motor's
    /// (standstill, else rated). Missing data do not exclude an amplifier.
    pub fn suits(motor: &Motor, amplifier: &Amplifier) -> bool {
        let winding = &motor.winding;
        let current = winding.standstill_current.or(winding.rated_current);
        let [least, most] = CURRENTS;
        let enough = current.is_none_or(|current| {
            (least * current..=most * current).contains(&amplifier.rated_current)
        });
        enough && of_one_class(motor, amplifier)
    }

    fn partners(&self, motor: usize) -> Option<&Partners> {
        self.motors.get(motor)
    }
}

/// Finds entries by key or by the start of a key.
pub(super) struct Keys<'k> {
    exact: HashMap<&'k str, u32>,
    sorted: Vec<(&'k str, u32)>,
}

impl<'k> Keys<'k> {
    pub(super) fn new(keys: impl Iterator<Item = &'k str>) -> Self {
        let mut sorted: Vec<(&str, u32)> = (0..).zip(keys).map(|(i, key)| (key, i)).collect();
        let exact = sorted.iter().copied().collect();
        sorted.sort_unstable();
        Self { exact, sorted }
    }

    /// The entries that match `pattern`: one by its key, or, with "*" at the end, all whose key begins with it.
    pub(super) fn find(&self, pattern: &str, mut take: impl FnMut(u32)) {
        if let Some(start) = pattern.strip_suffix('*') {
            let first = self.sorted.partition_point(|(key, _)| *key < start);
            let rest = self.sorted.get(first..).unwrap_or_default();
            let found = rest.iter().take_while(|(key, _)| key.starts_with(start));
            found.for_each(|(_, index)| take(*index));
        } else if let Some(index) = self.exact.get(pattern) {
            take(*index);
        }
    }

    pub(super) fn names(&self) -> Vec<&'k str> {
        self.sorted.iter().map(|(key, _)| *key).collect()
    }
}

/// Every drive of a catalogue, or of one of its motors: gearbox by gearbox, first directly coupled, with each amplifier in turn. Each step costs a
/// few nanoseconds.
#[derive(Clone, Debug)]
pub struct Drives<'c> {
    catalogue: &'c Catalogue,
    /// Remaining motors, without the current one.
    motors: std::ops::Range<usize>,
    motor: Option<(usize, &'c Motor)>,
    /// Remaining gearboxes of the current motor.
    gearboxes: Gearboxes<'c>,
    amplifiers: Vec<&'c Amplifier>,
    gearbox: Option<(usize, &'c Gearbox)>,
    /// Index of the next amplifier; at the end the next gearbox is due.
    next: usize,
}

#[derive(Clone, Debug)]
enum Gearboxes<'c> {
    All(std::ops::Range<usize>),
    These(std::slice::Iter<'c, u32>),
}

impl<'c> Drives<'c> {
    pub(super) fn new(catalogue: &'c Catalogue, motors: std::ops::Range<usize>) -> Self {
        Self {
            catalogue,
            motors,
            motor: None,
            gearboxes: Gearboxes::All(0..0),
            amplifiers: Vec::new(),
            gearbox: None,
            next: 0,
        }
    }

    /// Advances to the next motor that has any drive.
    fn advance_motor(&mut self) -> Option<()> {
        loop {
            let index = self.motors.next()?;
            let catalogue = self.catalogue;
            let motor = catalogue.motors.get(index)?;
            let partners = catalogue.pairing.partners(index);
            self.motor = Some((index, motor));
            self.gearboxes = match partners.and_then(|p| p.gearboxes.as_deref()) {
                Some(these) => Gearboxes::These(these.iter()),
                None if motor.kind == MotorKind::Linear => Gearboxes::All(0..0),
                None => Gearboxes::All(0..catalogue.gearboxes.len()),
            };
            self.amplifiers = catalogue.amplifiers_of(index);
            self.next = 0;
            self.gearbox = None;
            if !partners.is_some_and(|p| p.never_direct) {
                return Some(());
            }
            if self.advance_gearbox() {
                return Some(());
            }
        }
    }

    fn advance_gearbox(&mut self) -> bool {
        let catalogue = self.catalogue;
        let built_in = |index: usize| catalogue.pairing.built_in.get(index) == Some(&true);
        let motor = self.motor.map(|(_, motor)| motor);
        let takes = |index: usize| {
            let gearbox = catalogue.gearboxes.get(index);
            gearbox
                .zip(motor)
                .is_none_or(|(gearbox, motor)| gearbox.takes(motor))
        };
        let index = match &mut self.gearboxes {
            Gearboxes::All(rest) => rest.find(|index| !built_in(*index) && takes(*index)),
            Gearboxes::These(rest) => rest.next().map(|index| *index as usize),
        };
        self.next = 0;
        self.gearbox = index.and_then(|index| Some((index, catalogue.gearboxes.get(index)?)));
        self.gearbox.is_some()
    }

    /// The drive with amplifier number `way` of this motor and gearbox.
    fn drive(&self, (index, motor): (usize, &'c Motor), way: usize) -> (DriveId, Drive<'c>) {
        let drive = Drive {
            motor,
            gearbox: self.gearbox.map(|(_, gearbox)| gearbox),
            amplifier: self.amplifiers.get(way).copied(),
        };
        let gearbox = self.gearbox.map(|(index, _)| index);
        (DriveId::new(index, gearbox, way), drive)
    }
}

impl<'c> Iterator for Drives<'c> {
    type Item = (DriveId, Drive<'c>);

    fn next(&mut self) -> Option<Self::Item> {
        // Without amplifiers, each drive is returned once.
        let ways = self.amplifiers.len().max(1);
        let done = self.motor.is_none() || self.next >= ways && !self.advance_gearbox();
        if done {
            self.advance_motor()?;
        }
        let drive = self.drive(self.motor?, self.next);
        self.next += 1;
        Some(drive)
    }

    /// The same drives in plain loops, so that values common to all drives of a motor are computed once.
    fn fold<B, F: FnMut(B, Self::Item) -> B>(mut self, start: B, mut take: F) -> B {
        let mut folded = start;
        // The remaining drives of the current motor.
        loop {
            let Some(motor) = self.motor else {
                if self.advance_motor().is_none() {
                    return folded;
                }
                continue;
            };
            loop {
                let ways = self.amplifiers.len().max(1);
                for way in self.next..ways {
                    folded = take(folded, self.drive(motor, way));
                }
                if !self.advance_gearbox() {
                    break;
                }
            }
            self.motor = None;
        }
    }
}

impl Catalogue {
    /// Marks the motors that no amplifier runs.
    pub(super) fn mark_amplifiers(&mut self) {
        if self.amplifiers.is_empty() {
            return;
        }
        let lacks = (0..self.motors.len()).map(|index| self.amplifiers_of(index).is_empty());
        let lacks: Vec<bool> = lacks.collect();
        for (motor, lacks) in self.motors.iter_mut().zip(lacks) {
            motor.lacks_amplifier = lacks;
        }
    }

    /// Every possible drive, with its id.
    pub fn drives(&self) -> Drives<'_> {
        Drives::new(self, 0..self.motors.len())
    }

    /// The drives with the motors of these indices, in the order of [`Catalogue::drives`].
    pub fn drives_of(&self, motors: std::ops::Range<usize>) -> Drives<'_> {
        Drives::new(self, motors)
    }

    /// The amplifiers that a motor is combined with, by its index; each of its gearboxes is combined with all of them.
    pub fn amplifiers_of(&self, motor: usize) -> Vec<&Amplifier> {
        let partners = self.pairing.partners(motor);
        if let Some(these) = partners.and_then(|p| p.amplifiers.as_deref()) {
            let named = these
                .iter()
                .map(|index| self.amplifiers.get(*index as usize));
            return named.flatten().collect();
        }
        let Some(motor) = self.motors.get(motor) else {
            return Vec::new();
        };
        let own = |a: &&Amplifier| of_one_maker(motor, a);
        let any_own = self.amplifiers.iter().any(|a| own(&a));
        if !any_own && self.pairing.lists_amplifiers {
            return Vec::new();
        }
        let listed = |index: usize| self.pairing.listed.get(index) == Some(&true);
        let all = self.amplifiers.iter().enumerate();
        let free = all.filter(|(index, a)| !listed(*index) && (!any_own || own(a)));
        free.map(|(_, amplifier)| amplifier)
            .filter(|a| Pairing::suits(motor, a))
            .collect()
    }

    /// Number of possible drives, computed without iterating over them.
    pub fn count(&self) -> usize {
        let built_in = |index: usize| self.pairing.built_in.get(index) == Some(&true);
        let all = self.gearboxes.iter().enumerate();
        let free: Vec<&Gearbox> = all
            .filter(|(index, _)| !built_in(*index))
            .map(|(_, gearbox)| gearbox)
            .collect();
        let of = |(index, motor): (usize, &Motor)| {
            let partners = self.pairing.partners(index);
            let gearboxes = match partners.and_then(|p| p.gearboxes.as_deref()) {
                Some(these) => these.len(),
                None if motor.kind == MotorKind::Linear => 0,
                None => free.iter().filter(|gearbox| gearbox.takes(motor)).count(),
            };
            let direct = usize::from(!partners.is_some_and(|p| p.never_direct));
            (gearboxes + direct) * self.amplifiers_of(index).len().max(1)
        };
        self.motors.iter().enumerate().map(of).sum()
    }
}

impl Catalogue {
    /// Warns of amplifiers without a motor, and of motors combined with other makers' amplifiers only by their figures.
    pub(super) fn remark_amplifiers(&self, remarks: &mut Remarks) {
        let mut runs = vec![false; self.amplifiers.len()];
        let mut unpaired: Vec<[&str; 2]> = Vec::new();
        for (index, motor) in self.motors.iter().enumerate() {
            for amplifier in self.amplifiers_of(index) {
                let own = |a: &Amplifier| std::ptr::eq(a, amplifier);
                if let Some(place) = self.amplifiers.iter().position(own) {
                    runs[place] = true;
                }
                let makers = [motor.maker.as_str(), amplifier.maker.as_str()];
                let listed = motor.amplifiers_listed || of_one_maker(motor, amplifier);
                if !listed && !unpaired.contains(&makers) {
                    unpaired.push(makers);
                }
            }
        }
        for [motor, amplifier] in unpaired {
            remarks.add("makers whose amplifiers no list pairs with motors", || {
                format!(
                    "no list of the catalogue pairs motors of {motor} with amplifiers of {amplifier}; they are combined by voltage and current, \
                     and such drives rank below those that a list pairs: name the amplifiers of each motor in the column amplifiers of compatibility.csv"
                )
            });
        }
        let idle = self.amplifiers.iter().zip(runs).filter(|(_, runs)| !runs);
        for (amplifier, _) in idle {
            remarks.add("amplifiers that run no motor", || {
                format!(
                    "amplifier \"{}\" of {} runs no motor of the catalogue: no list names it, and no motor {} has its voltage and a current of a quarter to \
                     twice its rated current; name it in the column amplifiers of compatibility.csv",
                    amplifier.key,
                    amplifier.maker,
                    if self.pairing.lists_amplifiers {
                        "of its maker"
                    } else {
                        "without amplifiers of its own maker"
                    }
                )
            });
        }
    }
}
