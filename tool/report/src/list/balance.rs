//! Counterweights and springs that relieve the drive, for reading and as JSON.

use std::fmt::Write as _;

use serde_json::{Value, json};

use crate::list::inspection::Format;
use jred::machine::Element;
use jred_machine::model::coordinate::Coordinate;
use jred_machine::model::laden::Attached;
use jred_machine::model::machine::MachineFile;
use jred_machine::number::rounding::{figure, percent, short};
use jred_motion::balance::{Balanced, Figures, Goal, Request};

/// Name and version of the form in JSON.
const SCHEMA: &str = "jred-balance/1";

/// What is shown.
#[derive(Debug)]
pub struct Shown<'a> {
    /// The machine.
    pub file: &'a MachineFile,
    /// What was asked.
    pub request: &'a Request,
    /// The result.
    pub balanced: &'a Balanced,
}

/// The result in one of the formats.
pub fn write(shown: &Shown, format: Format) -> String {
    match format {
        Format::Table => text(shown),
        Format::Json => format!("{:#}\n", json(shown)),
    }
}

impl Shown<'_> {
    fn coordinate(&self) -> Coordinate {
        self.file.machine.mechanism().coordinate()
    }

    fn link(&self, number: usize) -> &str {
        let names = self.file.machine.mechanism().link_names();
        names.get(number).map_or("", String::as_str)
    }

    /// What is to be least, in words.
    fn goal(&self) -> String {
        let effort = &self.coordinate().vocabulary().torque;
        match self.request.goal {
            Goal::Rms => format!("RMS {effort} of the drive link"),
            Goal::Peak => format!("peak {effort} of the drive link"),
            Goal::Holding => format!("RMS {effort} that holds it at rest"),
            Goal::Inertia => format!("deviation of the reduced {} from its mean", self.inertia()),
        }
    }

    /// What the inertia of the drive link is called.
    fn inertia(&self) -> &'static str {
        match self.coordinate() {
            Coordinate::Angle => "inertia",
            Coordinate::Length => "mass",
        }
    }

    fn unit(&self) -> &'static str {
        match self.request.goal {
            Goal::Inertia => self.coordinate().inertia_unit(),
            _ => self.coordinate().effort_unit(),
        }
    }
}

/// A line: its name, and what it says.
fn line(text: &mut String, name: &str, says: &str) {
    let _ = writeln!(text, "  {name:<18} {says}");
}

fn text(shown: &Shown) -> String {
    let Balanced {
        masses,
        springs,
        efforts,
        before,
        after,
        bound,
    } = shown.balanced;
    let goal = shown.request.goal;
    let (unit, [was, is]) = (shown.unit(), [before, after].map(|f| f.of(goal)));
    let mut text = format!("{}: least {}\n\n", shown.file.title, shown.goal());
    let saved = if is <= was {
        format!("{} less", percent(1.0 - is / was))
    } else {
        "not less: nothing within the bounds is better".to_owned()
    };
    line(
        &mut text,
        "result",
        &format!(
            "{} {unit} instead of {} {unit}, {saved}",
            short(is),
            short(was)
        ),
    );
    line(
        &mut text,
        "optimum",
        &format!(
            "global: nothing within the bounds makes it less than {} {unit}",
            short(*bound)
        ),
    );
    table(&mut text, shown, [before, after]);
    for warning in warnings(shown) {
        line(&mut text, "warning", &warning);
    }
    let bodies = shown.request.counterweights.iter().zip(masses);
    for (asked, found) in bodies {
        text.push('\n');
        let on = shown.link(asked.link);
        match found {
            Some(found) => mass(&mut text, on, found),
            None => {
                let _ = writeln!(text, "# {on}: no counterweight is best");
            }
        }
    }
    let springs = springs.iter().zip(efforts);
    for (number, (found, efforts)) in shown.request.springs.iter().zip(springs) {
        text.push('\n');
        let name = shown
            .file
            .elements
            .get(*number)
            .map_or("", |named| &named.name);
        match found {
            Some(found) => spring(&mut text, name, found, efforts.as_ref()),
            None => {
                let _ = writeln!(text, "# {name}: no spring is best");
            }
        }
    }
    text
}

/// What the result has against it.
fn warnings(shown: &Shown) -> Vec<String> {
    let effort = &shown.coordinate().vocabulary().torque;
    let heats = shown.balanced.heats().map(|share| {
        format!(
            "the RMS {effort} of the drive link rises by {}: the motor gets hotter; compare with --least rms",
            percent(share)
        )
    });
    heats.into_iter().collect()
}

/// Share of the larger of pull and push below which the other is none.
const ONE_WAY: f64 = 1e-6;

/// A spring that must both pull and push.
fn both_ways(found: &Element, [pull, push]: [f64; 2]) -> Option<String> {
    if pull.min(push) <= ONE_WAY * pull.max(push) {
        return None;
    }
    let [pull, push] = [pull, push].map(short);
    Some(if found.is_torsional() {
        format!(
            "turns its bodies both ways, by up to {pull} and {push} N m: take a torsion spring that is fixed to both of them, or a preloaded pair"
        )
    } else {
        format!(
            "pulls by up to {pull} N and pushes by up to {push} N: take a preloaded pair, or a spring for both directions that is fixed at both ends"
        )
    })
}

/// The figures before and after.
fn table(text: &mut String, shown: &Shown, figures: [&Figures; 2]) {
    let coordinate = shown.coordinate();
    let (effort, unit) = (&coordinate.vocabulary().torque, coordinate.effort_unit());
    let pair = |of: fn(&Figures) -> Option<[f64; 2]>, unit: &str| {
        let [Some(before), Some(after)] = figures.map(of) else {
            return None;
        };
        let [rms, peak] = [0, 1].map(|k| format!("{} -> {}", short(before[k]), short(after[k])));
        Some(format!("RMS {rms} {unit}, peak {peak} {unit}"))
    };
    let input = input_unit(shown.file);
    let rows = [
        ("drive link", pair(|f| f.torque, unit)),
        ("at the input", pair(|f| f.input, input)),
        ("holding at rest", pair(|f| Some(f.holding), unit)),
    ];
    for (name, says) in rows {
        if let Some(says) = says {
            line(text, name, &format!("{effort}: {says}"));
        }
    }
    let [before, after] = figures.map(|f| {
        let [least, mean, most] = f.inertia.map(short);
        format!("{least} to {most}, mean {mean}")
    });
    let inertia = shown.inertia();
    line(
        text,
        "reduced",
        &format!(
            "{inertia} of the mechanism {before} -> {after} {}",
            coordinate.inertia_unit()
        ),
    );
}

/// Unit of the effort at the input of the drive train.
fn input_unit(file: &MachineFile) -> &'static str {
    jred_sizing::select::fit::input_kind(file)
        .vocabulary()
        .torque
        .unit
}

/// As a machine file has it.
fn mass(text: &mut String, on: &str, found: &Attached) {
    let [u, v] = found.at.map(|x| figure(x * 1e3));
    let _ = writeln!(
        text,
        "[[mass]]\nname = \"counterweight on {on}\"\non = \"{on}\"\nat = [\"{u} mm\", \"{v} mm\"]\nmass = \"{} kg\"",
        figure(found.mass)
    );
    if found.inertia > 0.0 {
        let _ = writeln!(text, "inertia = \"{} kg m^2\"", figure(found.inertia));
    } else {
        let _ = writeln!(
            text,
            "# a point mass: a real one has an inertia of its own, which comes on top"
        );
    }
}

fn spring(text: &mut String, name: &str, found: &Element, efforts: Option<&[f64; 2]>) {
    let [stiffness, free] = found.spring_rate().unwrap_or_default();
    let _ = if found.is_torsional() {
        writeln!(
            text,
            "# {name}\nstiffness = \"{} N m/rad\"\nfree_angle = \"{} deg\"",
            figure(stiffness),
            figure(free.to_degrees())
        )
    } else {
        writeln!(
            text,
            "# {name}\nstiffness = \"{} N/m\"\nfree_length = \"{} mm\"",
            figure(stiffness),
            figure(free * 1e3)
        )
    };
    if let Some(remark) = efforts.and_then(|efforts| both_ways(found, *efforts)) {
        let _ = writeln!(text, "# {remark}");
    }
}

fn json(shown: &Shown) -> Value {
    let Balanced {
        masses,
        springs,
        efforts,
        before,
        after,
        bound,
    } = shown.balanced;
    let figures = |f: &Figures| {
        let pair =
            |pair: Option<[f64; 2]>| pair.map(|[rms, peak]| json!({ "rms": rms, "peak": peak }));
        let [min, mean, max] = f.inertia;
        json!({
            "least": f.of(shown.request.goal),
            "drive_link": pair(f.torque),
            "input": pair(f.input),
            "holding": pair(Some(f.holding)),
            "inertia": { "min": min, "mean": mean, "max": max, "rms_deviation": f.deviation },
        })
    };
    let masses: Vec<Value> = (shown.request.counterweights.iter().zip(masses))
        .map(|(asked, found)| {
            json!({
                "on": shown.link(asked.link),
                "most": asked.most,
                "reach": asked.reach,
                "found": found.map(|m| json!({ "at": m.at, "mass": m.mass, "inertia": m.inertia })),
            })
        })
        .collect();
    let springs: Vec<Value> = (shown
        .request
        .springs
        .iter()
        .zip(springs.iter().zip(efforts)))
    .map(|(number, (found, efforts))| {
        let rate = found.and_then(|spring| spring.spring_rate().zip(Some(spring.is_torsional())));
        let found = rate.map(|([stiffness, free], torsional)| {
            let name = if torsional {
                "free_angle"
            } else {
                "free_length"
            };
            {
                let [pull, push] = efforts.unwrap_or_default();
                json!({ "stiffness": stiffness, name: free, "pull": pull, "push": push })
            }
        });
        let name = shown.file.elements.get(*number).map(|named| &named.name);
        json!({ "name": name, "found": found })
    })
    .collect();
    json!({
        "schema": SCHEMA,
        "title": shown.file.title,
        "least": shown.request.goal.to_string(),
        "before": figures(before),
        "after": figures(after),
        "bound": bound,
        "warnings": warnings(shown),
        "counterweights": masses,
        "springs": springs,
    })
}
