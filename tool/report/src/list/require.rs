//! Requirements of a drive, for any maker.

use jred_file::math;
use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::answer::schema::Data;
use crate::table::reading::{ColumnKind, Reading};
use crate::table::rows::csv_line;
use jred_file::model::rule::Rule;
use jred_file::number::rounding::{down, percent, short, significant, up};
use jred_file::units::{ARCMIN, RPM, Vocabulary};
use jred_sizing::bus::Need;
use jred_sizing::cell::Cell;
use jred_sizing::select::fit::input_kind;
use jred_sizing::select::requirement::{
    CLOSING_TIMES, GearboxRequirement, Inquiry, Requirement, TorqueNeed, USUAL_SPEED,
};

/// Rotors of the boundary of a ratio, in equal ratios.
const ROTORS: u32 = 9;

/// The requirements of a machine.
#[derive(Clone, Copy, Debug)]
pub struct RequirementView<'a> {
    /// The machine and the choices.
    pub inquiry: &'a Inquiry<'a>,
    /// The requirement at each ratio.
    pub requirements: &'a [Requirement],
}

/// The JSON of `jred require`.
#[derive(Serialize, JsonSchema)]
pub(crate) struct RequireData<'a> {
    /// Whether the motor is linear: forces (N), masses (kg) and m/s then stand for torques, inertias and rad/s.
    linear: bool,
    /// Efficiency of the gearbox.
    efficiency: f64,
    /// Inertia of the gearbox at its input.
    #[serde(rename = "gearbox inertia [kg m^2]")]
    gearbox_inertia: f64,
    /// S1 torque above the least possible, as a share of it.
    allowance: f64,
    /// Index of the ratio that is described in full.
    described: usize,
    /// Each ratio.
    ratios: Vec<RatioData<'a>>,
}

#[derive(Serialize, JsonSchema)]
struct RatioData<'a> {
    #[serde(flatten)]
    requirement: &'a Requirement,
    /// The least torques of a motor with each of these rotors.
    boundary: Vec<TorqueNeed>,
}

impl Data for RequireData<'_> {
    const FORM: &'static str = "jred-require/1";
}

impl RequirementView<'_> {
    pub(crate) fn words(&self) -> &'static Vocabulary {
        input_kind(self.inquiry.file).vocabulary()
    }

    /// Index of the ratio with the smallest motor: the least S1 torque among those that are possible with a usual speed.
    fn described_index(&self) -> usize {
        let usual = |r: &Requirement| r.possible && r.max_speed <= USUAL_SPEED * (1.0 + 1e-9);
        let any_usual = self.requirements.iter().any(usual);
        let each = self.requirements.iter().enumerate();
        let open = each.filter(|(_, r)| r.possible && (usual(r) || !any_usual));
        let best = open.min_by(|a, b| a.1.s1_torque.total_cmp(&b.1.s1_torque));
        best.map_or(0, |(index, _)| index)
    }

    /// That ratio.
    pub(crate) fn described(&self) -> Option<&Requirement> {
        self.requirements.get(self.described_index())
    }

    /// That ratio with its neighbours.
    pub(crate) fn near_described(&self) -> &[Requirement] {
        let at = self.described_index();
        let last = self.requirements.len().min(at + 2);
        let near = self.requirements.get(at.saturating_sub(1)..last);
        near.unwrap_or_default()
    }

    /// The least torques over the rotor: from the window's start to twice its end.
    pub(crate) fn boundary(&self, found: &Requirement) -> Vec<TorqueNeed> {
        let [from, to] = found.rotor;
        let (low, high) = match (from > 0.0, to.is_finite()) {
            (true, true) => (from, 2.0 * to),
            (true, false) => (from, 10.0 * from),
            (false, true) => (0.05 * to, 2.0 * to),
            (false, false) => return Vec::new(),
        };
        if !(low > 0.0 && high > low) {
            return Vec::new();
        }
        let step = |k: u32| low * math::pow(high / low, f64::from(k) / f64::from(ROTORS - 1));
        let mut rotors: Vec<f64> = (0..ROTORS).map(step).collect();
        rotors.extend(
            [from, to]
                .into_iter()
                .filter(|end| *end > 0.0 && end.is_finite()),
        );
        rotors.sort_by(f64::total_cmp);
        rotors.dedup();
        let needs = rotors
            .into_iter()
            .map(|rotor| self.inquiry.needs(found.ratio, rotor));
        needs.collect()
    }

    /// The requirement of every ratio, and one of them in full.
    pub fn answer(&self) -> Answer<'static> {
        let Inquiry {
            file,
            gear,
            allowance,
            ..
        } = *self.inquiry;
        let data = RequireData {
            linear: self.words().slides(),
            efficiency: gear.efficiency,
            gearbox_inertia: gear.inertia,
            allowance,
            described: self.described_index(),
            ratios: (self.requirements.iter())
                .map(|requirement| RatioData {
                    requirement,
                    boundary: self.boundary(requirement),
                })
                .collect(),
        };
        let title = format!("{}: requirements of the drive, for any maker", file.title);
        let mut answer = Answer::new(file.title.clone(), &data).titled(title);
        self.ratios(&mut answer);
        if let Some(found) = self.described() {
            answer.heading(format!("{}, in full", name(found.ratio)));
            self.motor(&mut answer, found);
            if !found.possible {
                answer.warning(
                    "a belt, screw or pinion is overloaded, or shafts and drive train alone are too soft for the natural frequency, or have more \
                     backlash than the tool may have: no motor or gearbox helps; `jred size --full` names the rule",
                );
            }
            self.gearbox(&mut answer, found);
            self.electric(&mut answer, found);
        }
        self.notes(&mut answer);
        answer.csv(self.csv());
        answer
    }

    /// A row for each ratio.
    pub(crate) fn ratios(&self, answer: &mut Answer) {
        let words = self.words();
        let (torque, speed, inertia) = (&words.torque, &words.speed, &words.inertia);
        let columns = [
            ("ratio".to_owned(), ColumnKind::Quantity),
            (format!("max [{}]", speed.unit), ColumnKind::Quantity),
            (format!("mean [{}]", speed.unit), ColumnKind::Quantity),
            (
                format!("{} [{}]", words.rotor, inertia.unit),
                ColumnKind::Words,
            ),
            (format!("S1 [{}]", torque.unit), ColumnKind::Quantity),
            (format!("peak [{}]", torque.unit), ColumnKind::Quantity),
            ("S1 power [kW]".to_owned(), ColumnKind::Quantity),
        ];
        let whole = columns.len();
        let (columns, kinds) = columns.into_iter().unzip();
        let rows = self.requirements.iter().map(|found| -> Vec<Cell> {
            let power = found.power() / 1000.0;
            vec![
                found
                    .ratio
                    .map_or_else(|| "direct".to_owned(), short)
                    .into(),
                short(up(found.max_speed / speed.scale)).into(),
                short(up(found.mean_speed / speed.scale)).into(),
                window(found.rotor.map(|end| end / inertia.scale)).into(),
                short(up(found.s1_torque)).into(),
                short(up(found.peak_torque)).into(),
                significant(power, 3).into(),
            ]
        });
        answer.table(Reading {
            columns,
            rows: rows.collect(),
            kinds,
            whole,
            ..Reading::default()
        });
    }

    pub(crate) fn motor(&self, answer: &mut Answer, found: &Requirement) {
        let words = self.words();
        let (torque, inertia) = (&words.torque, &words.inertia);
        let effort = |x: f64| format!("{} {}", short(up(x)), torque.unit);
        let turns = |x: f64| {
            let unit = words.speed.unit;
            format!("{} {unit}", short(up(x / words.speed.scale)))
        };
        answer.fact(
            "motor",
            format!(
                "S1 {torque} {} at {}, and {} at standstill",
                effort(found.s1_torque),
                turns(found.mean_speed),
                effort(found.standstill_torque)
            ),
        );
        let points = found.envelope.iter();
        let points: Vec<String> = points
            .map(|[speed, most]| format!("{} at {}", effort(*most), turns(*speed)))
            .collect();
        answer.fact(
            format!("peak {torque}"),
            format!("{} up to the maximum speed", effort(found.peak_torque)),
        );
        answer.fact("or over speed", points.join(", "));
        answer.fact("maximum speed", turns(found.max_speed));
        let brake = if found.brake_torque.is_some() {
            " with brake"
        } else {
            ""
        };
        answer.fact(
            words.rotor,
            format!(
                "{} {}{brake}",
                window(found.rotor.map(|end| end / inertia.scale)),
                inertia.unit
            ),
        );
        answer.fact(
            "holding brake",
            match found.brake_torque {
                Some(least) => format!(
                    "at least {}: the machine moves without current{}",
                    effort(least),
                    self.brake_work(found)
                ),
                None if !self.inquiry.file.rules.limit(Rule::BrakeTorque).is_set() => {
                    "not asked for: brake_torque is off in [rules]".to_owned()
                }
                None => "not needed: the machine stays where it is without current".to_owned(),
            },
        );
    }

    /// Work of the holding brake in a stop by it alone.
    fn brake_work(&self, found: &Requirement) -> String {
        let Some([soon, late]) = found.brake_work else {
            return String::new();
        };
        if !late.is_finite() {
            return "; a brake of this torque alone does not stop it".to_owned();
        }
        let [first, last] = CLOSING_TIMES.map(|time| short(time * 1e3));
        let often = self.inquiry.file.site.emergency_stops;
        let often = often.map_or_else(String::new, |stops| {
            format!(", {} times per hour", short(stops))
        });
        format!(
            "; work of a stop without supply, slipping with this torque, at least {} J if it closes after {first} ms, {} J after {last} ms{often}",
            short(up(soon)),
            short(up(late))
        )
    }

    pub(crate) fn gearbox(&self, answer: &mut Answer, found: &Requirement) {
        let Some(gearbox) = &found.gearbox else {
            return;
        };
        let GearboxRequirement {
            peak_torque,
            rated_torque,
            emergency_torque,
            rated_speed,
            max_speed,
            cycles,
            stiffness,
            backlash,
            radial_load,
            axial_load,
        } = *gearbox;
        let efficiency = percent(self.inquiry.gear.efficiency);
        let cycles = if cycles > 0.0 {
            format!(" at {} cycles per hour", short(cycles))
        } else {
            String::new()
        };
        answer.fact(
            "gearbox",
            format!(
                "T2B at least {} N m{cycles}, T2N at least {} N m, rated input speed n1N at least {} rpm, maximum input speed at least {} rpm; \
                 computed with {efficiency} efficiency and {} kg cm^2",
                short(up(peak_torque)),
                short(up(rated_torque)),
                short(up(rated_speed / RPM)),
                short(up(max_speed / RPM)),
                short(self.inquiry.gear.inertia * 1e4)
            ),
        );
        if let Some(torque) = emergency_torque {
            answer.fact("emergency torque", {
                // That of the rounded peak torque.
                let most = up(found.peak_torque);
                let torque = torque * most / found.peak_torque;
                format!(
                    "at least {} N m, if the motor brakes with {} N m; more with a stronger motor",
                    short(up(torque)),
                    short(most)
                )
            });
        }
        if let Some(stiffness) = stiffness.filter(|stiffness| stiffness.is_finite()) {
            let least = short(up(stiffness * ARCMIN));
            answer.fact("stiffness", format!("at least {least} N m/arcmin"));
        }
        if let Some(play) = backlash.filter(|play| *play >= 0.0) {
            let most = short(down(play / ARCMIN));
            answer.fact("backlash", format!("at most {most} arcmin"));
        }
        let loads = [("radial", radial_load), ("axial", axial_load)];
        let loads = loads
            .into_iter()
            .filter_map(|(word, load)| Some(format!("{word} at least {} N", short(up(load?)))));
        let loads: Vec<String> = loads.collect();
        if !loads.is_empty() {
            answer.fact("output shaft", loads.join(", "));
        }
    }

    pub(crate) fn electric(&self, answer: &mut Answer, found: &Requirement) {
        let words = self.words();
        let unit = words.torque.unit;
        let [continuous, peak] = found.currents.map(|x| short(up(x)));
        answer.fact(
            "amplifier",
            format!("continuous current {continuous}/k_T, peak current {peak}/k_T (A), with k_T the {} constant in {unit}/A", words.torque),
        );
        let back = &found.regeneration;
        answer.fact(
            "regeneration",
            if back.energy == 0.0 {
                "no energy flows back".to_owned()
            } else {
                format!(
                    "at most {} J per cycle, {} W mean, {} W peak, {} J a pulse; motoring peak {} W",
                    short(up(back.energy)),
                    short(up(back.mean)),
                    short(up(back.peak)),
                    short(up(back.pulse)),
                    short(up(back.motoring_peak))
                )
            },
        );
        if let Some(need) = &back.resistor {
            answer.fact("brake resistor", resistor(need));
        }
    }

    pub(crate) fn notes(&self, answer: &mut Answer) {
        let words = self.words();
        let (torque, inertia, rotor) = (words.torque, words.inertia, words.rotor);
        let Inquiry {
            file, allowance, ..
        } = *self.inquiry;
        for rule in self.inquiry.beyond_site() {
            answer.warning(format!(
                "{} of the site: beyond the general derating; ask for motors whose makers state their torque there",
                rule.name()
            ));
        }
        answer.sentence(format!(
            "A motor with these figures and a {rotor} in the window satisfies every rule of the set \"{}\" that needs no data of its winding. \
             The window belongs to an S1 {torque} {} above the least possible; figures are rounded to the safe side.",
            file.rules.name,
            percent(allowance)
        ));
        let symbol = if words.slides() { "m" } else { "J" };
        let square = |found: &Requirement| -> String {
            let [constant, linear, square] = found.mean_square;
            let sign = if linear < 0.0 { '−' } else { '+' };
            format!(
                "RMS {torque}² = {} {sign} {}·{symbol} + {}·{symbol}²",
                significant(constant, 5),
                significant(linear.abs(), 5),
                significant(square, 5)
            )
        };
        if let Some(found) = self.described() {
            answer.sentence(format!(
                "Any other {rotor}: {} ({torque} in {}, {symbol} its {inertia} in {}).",
                square(found),
                torque.unit,
                if words.slides() { "kg" } else { "kg m²" }
            ));
        }
        let limit = file.rules.limit(Rule::InertiaRatio);
        if !limit.is_set() {
            answer.sentence(format!("The rule set has no limit for the {inertia} ratio: the smallest {rotor} is not limited."));
        }
        if let Some(found) = self.described() {
            match found.regeneration.stops {
                Some(true) => answer.sentence("The brake resistor takes the stop by the drive, drive_stop of [duty], with the least peak torque; a stronger motor brakes with more power."),
                Some(false) => answer.warning("drive_stop of [duty]: with this share of the least peak torque the drive does not stop the machine, and the resistor takes the cycle alone; give a larger share, or ask for a stronger motor".to_owned()),
                None => {}
            }
        }
        answer.sentence(
            "Not contained: temperatures, and losses, friction and saturation of the motor. Check the offers: add them to a catalogue, and run `jred size FILE --catalogue FOLDER`.",
        );
    }

    /// Every figure of every ratio, and its boundary.
    fn csv(&self) -> String {
        let words = self.words();
        let (torque, speed, inertia) = (
            words.torque.unit,
            words.speed_si,
            if words.slides() { "kg" } else { "kg m^2" },
        );
        let header = [
            "ratio".to_owned(),
            format!("rotor [{inertia}]"),
            format!("least S1 torque [{torque}]"),
            format!("least peak torque [{torque}]"),
            "in the window".to_owned(),
            format!("mean speed [{speed}]"),
            format!("maximum speed [{speed}]"),
        ];
        let mut csv = csv_line(header.iter().map(|name| Cell::from(name.as_str())));
        for found in self.requirements {
            let [from, to] = found.rotor;
            for need in self.boundary(found) {
                let row: [Cell; 7] = [
                    found.ratio.map_or_else(|| "direct".into(), Cell::from),
                    need.rotor.into(),
                    need.s1_torque.into(),
                    need.peak_torque.into(),
                    if (from..=to).contains(&need.rotor) {
                        "yes"
                    } else {
                        "no"
                    }
                    .into(),
                    found.mean_speed.into(),
                    found.max_speed.into(),
                ];
                csv += &csv_line(row.into_iter());
            }
        }
        csv
    }
}

/// A ratio as a heading.
pub(crate) fn name(ratio: Option<f64>) -> String {
    ratio.map_or_else(
        || "direct coupling".to_owned(),
        |ratio| format!("ratio {}", short(ratio)),
    )
}

fn resistor(need: &Need) -> String {
    let least = need.smallest_resistance.map_or_else(String::new, |least| {
        format!("at least {} Ω, ", short(least))
    });
    format!(
        "{least}at most {} Ω, {} W mean, {} W peak, {} J a pulse",
        short(down(need.largest_resistance)),
        short(up(need.mean)),
        short(up(need.peak)),
        short(up(need.pulse))
    )
}

/// A range, its start rounded up and its end down.
fn window([from, to]: [f64; 2]) -> String {
    match (from > 0.0, to.is_finite()) {
        (true, true) if up(from) >= down(to) => format!("about {}", short(from)),
        (true, true) => format!("{} to {}", short(up(from)), short(down(to))),
        (true, false) => format!("at least {}", short(up(from))),
        (false, true) => format!("at most {}", short(down(to))),
        (false, false) => "any".to_owned(),
    }
}
