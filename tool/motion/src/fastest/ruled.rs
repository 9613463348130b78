//! The fastest motion that the rules of sizing accept.
//!
//! Some limits of a drive depend on the whole motion: T2B on its cycles per hour, T2N on the cubic mean, others on the mean speed and the RMS
//! current. The motion is made, and judged as `jred size` judges it ([`Judge`]). Where a rule is violated, a [`Cap`] that acts at every instant is
//! lowered, until the rule is satisfied by no more than a thousandth. A faster motion uses more of every one of these limits, so there is one such
//! cap. For the cycles per hour it is a fixed point: the allowed torque at the resulting rate.
//!
//! With such a cap the motion is the fastest one within constant limits. For the cubic mean or the mean speed another motion may be faster that uses
//! torque and speed unevenly over the path.

mod judge;

use jred_file::math;
use jred_file::model::rule::Rule;
use jred_sizing::judge::Findings;

use super::cycle::Cycle;
use super::field::MoveLimits;
use super::{NoMotion, Rms};

pub use judge::{Judge, Judgement};

/// Share by which the final use of a limit may stay below it.
const USE_TOLERANCE: f64 = 1e-3;

/// Most motions for one cap, and most rounds over all caps.
const TRIES: u32 = 10;
const ROUNDS: u32 = 4;

/// If the use falls by a smaller share than this while the cap falls by more, the use does not depend on the cap.
const LEAST_RESPONSE: f64 = 1e-3;

/// A quantity that is lowered at every instant to satisfy a rule of the whole motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cap {
    /// Share of the motor's torque.
    MotorTorque,
    /// Torque at the gearbox output (N·m).
    GearboxTorque,
    /// Speed of the motor (rad/s, or m/s).
    Speed,
    /// RMS torque of the motor (N·m), a limit of the whole motion.
    RmsTorque,
}

impl Cap {
    /// All caps, in the order of the search.
    pub const ALL: [Self; 4] = [
        Self::MotorTorque,
        Self::GearboxTorque,
        Self::Speed,
        Self::RmsTorque,
    ];

    /// The cap that is lowered to satisfy a rule. `heat`: the rules of the motor's heat are included.
    const fn of(rule: Rule, heat: bool) -> Option<Self> {
        match rule {
            Rule::GearboxPeak | Rule::GearboxCubicMean => Some(Self::GearboxTorque),
            // Forces behind the motor, with a gearbox or without one.
            Rule::PeakTorque
            | Rule::PeakCurrent
            | Rule::BeltTension
            | Rule::BeltForce
            | Rule::BeltPretension
            | Rule::ScrewForce
            | Rule::ScrewBuckling
            | Rule::PinionForce
            | Rule::GearboxRadial
            | Rule::GearboxAxial => Some(Self::MotorTorque),
            Rule::Speed
            | Rule::GearboxSpeed
            | Rule::GearboxMeanSpeed
            | Rule::GearboxCycles
            | Rule::ScrewSpeed => Some(Self::Speed),
            Rule::RmsCurrent | Rule::Overload => Some(Self::RmsTorque),
            Rule::RmsTorque | Rule::WindingTemperature | Rule::HousingTemperature if heat => {
                Some(Self::RmsTorque)
            }
            Rule::RmsTorque
            | Rule::WindingTemperature
            | Rule::HousingTemperature
            | Rule::HoldingTorque
            | Rule::ConstantTorque
            | Rule::BrakeTorque
            | Rule::BrakeWork
            | Rule::AmbientTemperature
            | Rule::CabinetTemperature
            | Rule::Altitude
            | Rule::InertiaRatio
            | Rule::GearboxEmergency
            | Rule::MotorVoltage
            | Rule::AmplifierVoltage
            | Rule::BusVoltage
            | Rule::BrakeResistance
            | Rule::ResistorPower
            | Rule::ResistorPeak
            | Rule::ResistorPulse
            | Rule::NaturalFrequency
            | Rule::Backlash => None,
        }
    }
}

/// Caps in the order of [`Cap::ALL`]; infinite: no cap.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Caps([f64; Cap::ALL.len()]);

impl Caps {
    const NONE: Self = Self([f64::INFINITY; Cap::ALL.len()]);

    const fn get(&self, cap: Cap) -> f64 {
        self.0[cap as usize]
    }

    const fn with(mut self, cap: Cap, value: f64) -> Self {
        self.0[cap as usize] = value;
        self
    }

    /// The limits with the caps applied.
    fn on(&self, limits: &MoveLimits) -> MoveLimits {
        let least = |limit: Option<f64>, cap: f64| {
            let both = limit.map_or(cap, |limit| limit.min(cap));
            Some(both).filter(|limit| limit.is_finite())
        };
        let mut limits = *limits;
        limits.gearbox_torque = least(limits.gearbox_torque, self.get(Cap::GearboxTorque));
        limits.gearbox_speed = least(limits.gearbox_speed, self.get(Cap::Speed));
        let share = self.get(Cap::MotorTorque).min(1.0);
        limits.reserve.torque = 1.0 - (1.0 - limits.reserve.torque) * share;
        limits
    }

    /// The limit of the RMS torque with the caps applied.
    fn rms(&self, rms: Option<Rms>) -> Option<Rms> {
        let torque = self.get(Cap::RmsTorque);
        if torque.is_finite() {
            Some(Rms::and(rms, torque))
        } else {
            rms
        }
    }
}

/// Why there is no motion, with the index of the move.
type Refusal = (Option<usize>, NoMotion);

/// A motion that was tried, with its accompanying result.
struct RuleTrial<W> {
    caps: Caps,
    cycle: Cycle,
    with: W,
    findings: Findings,
}

/// The value in the motion of a quantity that a cap limits: a higher cap has no effect.
fn has<W>(tried: &RuleTrial<W>, cap: Cap) -> f64 {
    let value = |rule| tried.findings.get(rule).map_or(f64::INFINITY, |f| f.value);
    let own = match cap {
        Cap::MotorTorque => 1.0,
        Cap::GearboxTorque => value(Rule::GearboxPeak),
        Cap::Speed => value(Rule::Speed),
        Cap::RmsTorque => tried.cycle.load.rms,
    };
    own.min(tried.caps.get(cap))
}

/// The search for the fastest motion that the rules accept.
struct Search<'s, W> {
    judge: &'s Judge<'s>,
    limits: &'s MoveLimits,
    rms: Option<Rms>,
    /// Whether the motor's heat is limited by rules.
    heat: bool,
    make: &'s MotionSource<'s, W>,
}

/// Makes the motion for some limits, with an accompanying result.
type MotionSource<'s, W> = dyn Fn(&MoveLimits, Option<Rms>) -> Result<(Cycle, W), Refusal> + 's;

impl<W> Search<'_, W> {
    fn at(&self, caps: Caps) -> Result<RuleTrial<W>, Refusal> {
        let (cycle, with) = (self.make)(&caps.on(self.limits), caps.rms(self.rms))?;
        let findings = self.judge.findings(&cycle.trace);
        Ok(RuleTrial {
            findings: findings.map_err(|error| (None, error.into()))?,
            caps,
            cycle,
            with,
        })
    }

    fn used(&self, tried: &RuleTrial<W>, cap: Cap) -> f64 {
        self.judge.used(&tried.findings, cap, self.heat)
    }

    fn keeps_all(&self, tried: &RuleTrial<W>, but: &[Cap]) -> bool {
        let sought = Cap::ALL.iter().filter(|cap| !but.contains(cap));
        sought.into_iter().all(|cap| self.used(tried, *cap) <= 1.0)
    }

    /// Lowers a cap until its rules are satisfied; `None` if lowering it does not satisfy them.
    fn lowered(&self, cap: Cap, from: &RuleTrial<W>) -> Option<RuleTrial<W>> {
        // Cap and its use: too high, and low enough.
        let mut high = [has(from, cap), self.used(from, cap)];
        let mut low: Option<([f64; 2], RuleTrial<W>)> = None;
        // Largest value without a motion.
        let mut least = 0.0_f64;
        for round in 0..TRIES {
            let next = match &low {
                Some((own, _)) if round % 3 == 2 => (high[0] * own[0]).sqrt(),
                Some((own, _)) => between(*own, high),
                None => high[0] / high[1],
            };
            let next = if next > least {
                next
            } else {
                least.midpoint(high[0])
            };
            if !next.is_finite() || next <= 0.0 || high[0] - least <= USE_TOLERANCE * high[0] {
                break;
            }
            let Ok(tried) = self.at(from.caps.with(cap, next)) else {
                least = next;
                continue;
            };
            let used = self.used(&tried, cap);
            if used <= 1.0 {
                low = Some(([next, used], tried));
                if used >= 1.0 - USE_TOLERANCE {
                    break;
                }
            } else {
                let falls = used < high[1] * (1.0 - LEAST_RESPONSE);
                if !falls && next < high[0] * (1.0 - 10.0 * LEAST_RESPONSE) {
                    break;
                }
                high = [next, used];
            }
        }
        low.map(|(_, tried)| tried)
    }

    /// Raises a cap that became too low when another one was lowered, as far as all rules stay satisfied.
    fn raised(&self, cap: Cap, from: RuleTrial<W>, but: &[Cap]) -> RuleTrial<W> {
        let mut best = from;
        for _ in 0..TRIES / 2 {
            let used = self.used(&best, cap);
            if !best.caps.get(cap).is_finite() || used <= 0.0 || used >= 1.0 - USE_TOLERANCE {
                break;
            }
            let next = best.caps.get(cap) / used.max(0.5);
            let Ok(tried) = self.at(best.caps.with(cap, next)) else {
                break;
            };
            let is_faster = tried.cycle.trace.duration() < best.cycle.trace.duration();
            if !is_faster || !self.keeps_all(&tried, but) {
                // Half of it may suffice.
                let next = (best.caps.get(cap) * next).sqrt();
                match self.at(best.caps.with(cap, next)) {
                    Ok(tried) if self.keeps_all(&tried, but) => best = tried,
                    _ => {}
                }
                break;
            }
            best = tried;
        }
        best
    }

    /// Lowers caps until all rules that can be satisfied are; caps that cannot are added to `lost`.
    fn settled(&self, from: RuleTrial<W>, lost: &mut Vec<Cap>) -> RuleTrial<W> {
        let mut now = from;
        for _ in 0..ROUNDS {
            let mut changed = false;
            for cap in Cap::ALL {
                if lost.contains(&cap) || self.used(&now, cap) <= 1.0 {
                    continue;
                }
                match self.lowered(cap, &now) {
                    Some(tried) => (now, changed) = (tried, true),
                    None => lost.push(cap),
                }
            }
            if !changed {
                break;
            }
        }
        for cap in Cap::ALL {
            now = self.raised(cap, now, lost);
        }
        now
    }
}

/// The cap at which the use would be slightly below its limit, by a power law through two points.
fn between(low: [f64; 2], high: [f64; 2]) -> f64 {
    let aim = 1.0 - 0.5 * USE_TOLERANCE;
    let share = math::ln(high[1] / aim) / math::ln(high[1] / low[1]);
    high[0] * math::pow(low[0] / high[0], share.clamp(0.02, 0.98))
}

/// The fastest motion within `limits` and a limit of the RMS torque that the rules of a drive accept, with its accompanying result.
///
/// `heat`: the rules of the motor's heat must be satisfied too. `make` makes the fastest motion within limits. Rules that no slower motion satisfies
/// stay violated: see [`Judgement::violated`].
///
/// # Errors
/// Those of `make`.
pub fn ruled<W>(
    judge: &Judge<'_>,
    limits: &MoveLimits,
    rms: Option<Rms>,
    heat: bool,
    make: impl Fn(&MoveLimits, Option<Rms>) -> Result<(Cycle, W), Refusal>,
) -> Result<(Cycle, W, Judgement), Refusal> {
    let search = |rms, heat| Search {
        judge,
        limits,
        rms,
        heat,
        make: &make,
    };
    // A limit of the RMS torque needs many motions: first without it.
    let mut lost = vec![Cap::RmsTorque];
    let first = search(None, false);
    let mut caps = first.settled(first.at(Caps::NONE)?, &mut lost);
    lost.retain(|cap| *cap != Cap::RmsTorque);
    let whole = search(rms, heat);
    let turns = caps.cycle.moves.iter().any(|made| made.task.endless);
    if turns || limits.forces.is_some() {
        lost.push(Cap::RmsTorque);
    } else if rms.is_some() {
        caps = whole.at(caps.caps)?;
    }
    let found = whole.settled(caps, &mut lost);
    let checks = judge.checks(&found.cycle.trace);
    let checks = checks.map_err(|error| (None, error.into()))?;
    let applies = checks.iter().map(|check| check.id);
    let sought = applies.filter(|rule| Cap::of(*rule, heat).is_some());
    let capped = Cap::ALL.into_iter().filter_map(|cap| {
        let value = found.caps.get(cap);
        value.is_finite().then_some((cap, value))
    });
    let judged = Judgement {
        sought: sought.collect(),
        caps: capped.collect(),
        checks,
    };
    Ok((found.cycle, found.with, judged))
}
