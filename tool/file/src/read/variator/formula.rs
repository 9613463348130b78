//! A variator's ratio by a formula; it must stay positive and bounded at every instant of the simulation.

use jred::friction::{Course as _, OperatingPoint};
use jred_enclosure::Interval;

use crate::model::variator::{RATIOS, Ratio, VARIABLES};
use crate::number::formula::Formula;
use crate::number::rounding::figure;
use crate::text::item::Item;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::TIME;

/// Instants of a simulation at which a formula is evaluated.
const INSTANTS: u32 = 4000;

/// `ratio = "0.8 + 0.3*sin(2*pi*t)"`: a formula of the time (s) and the angle of the input shaft (rad).
pub(super) fn formula(item: &Item, root: &Section) -> Result<Ratio> {
    let text = item.text("0.8 + 0.3*sin(2*pi*t)")?;
    let formula = Formula::parse(text, &VARIABLES).map_err(|fault| {
        let shown = text.get(fault.place).unwrap_or_default();
        let label = if shown.is_empty() {
            "this formula".to_owned()
        } else {
            format!("at \"{shown}\"")
        };
        item.problem(&format!("is no formula: {}", fault.what), &label).help(
            "write a ratio as a number, ratio = 0.5, or as a formula of the time t (s) and the angle phi (rad) of the input shaft: \
             ratio = \"0.8 + 0.3*sin(2*pi*t)\"",
        )
    })?;
    // Checked to the end of the simulation, and over one turn of the input shaft from the start. The simulation itself checks what is beyond.
    let simulation = root.peek("simulation").filter(Item::is_table);
    let duration = match simulation {
        Some(item) => match item.section("[simulation]".into())?.peek("duration") {
            Some(duration) => duration.quantity(&TIME)?.si,
            None => 0.0,
        },
        None => 0.0,
    };
    let ratio = Ratio::by(formula);
    for k in 0..=INSTANTS {
        let share = f64::from(k) / f64::from(INSTANTS);
        let (t, phi) = (
            share * duration,
            (share * 64.0).fract() * std::f64::consts::TAU,
        );
        if let Some(what) = leaves(&ratio, t, phi) {
            return Err(item.problem(&what, "this formula").help(POSITIVE));
        }
    }
    match unbounded(&ratio, duration) {
        None => Ok(ratio),
        Some([t, phi]) => Err(match leaves(&ratio, t, phi) {
            Some(what) => item
                .problem(&what, "this formula")
                .help(POSITIVE),
            None => item
                .problem(
                    &format!(
                        "is not shown to stay between {} and {} near {}",
                        RATIOS[0],
                        RATIOS[1],
                        place(&ratio, t, phi)
                    ),
                    "this formula",
                )
                .help("between the instants that were tried it may have a pole or a zero there: check what is divided by"),
        }),
    }
}

/// The cure of a formula that leaves its range.
const POSITIVE: &str = "the output speed over the input speed is positive at every instant of the simulation: check the signs, and what is divided by";

/// A time, and an angle if the ratio depends on it, in words.
fn place(ratio: &Ratio, t: f64, phi: f64) -> String {
    if ratio.is_turned() {
        format!("t = {} s, phi = {} rad", figure(t), figure(phi))
    } else {
        format!("t = {} s", figure(t))
    }
}

/// How a ratio leaves its range at a time (s) and an angle (rad); `None` if it does not.
fn leaves(ratio: &Ratio, t: f64, phi: f64) -> Option<String> {
    let found = ratio.at(OperatingPoint::at_time(t).with_angle(phi));
    let value = found.value;
    if !found.is_finite() {
        return Some(format!(
            "has no finite value or slope at {}",
            place(ratio, t, phi)
        ));
    }
    let out = !(RATIOS[0]..=RATIOS[1]).contains(&value);
    out.then(|| {
        format!(
            "is {} at {}, but must be between {} and {}",
            figure(value),
            place(ratio, t, phi),
            RATIOS[0],
            RATIOS[1]
        )
    })
}

/// Intervals of a range at the start of the bisection.
const PARTS: u32 = 64;

/// Share of a range below which an interval counts as a point.
const PLACE: f64 = 1e-12;

/// Most intervals that are bisected.
const MOST_PARTS: u32 = 400_000;

/// A time and an angle near which the bounds of a formula exceed those of a ratio, within the simulation and one turn of the input shaft. `None` if
/// interval arithmetic shows that they never do.
fn unbounded(ratio: &Ratio, duration: f64) -> Option<[f64; 2]> {
    let turn = if ratio.is_turned() {
        std::f64::consts::TAU
    } else {
        0.0
    };
    let spans = [duration, turn];
    let part = |span: f64, k: u32| {
        let end = |k: u32| span * f64::from(k) / f64::from(PARTS);
        Interval::between(end(k), end(k + 1))
    };
    let counts = spans.map(|span| if span > 0.0 { PARTS } else { 1 });
    let times = (0..counts[0]).rev();
    let mut parts: Vec<[Interval; 2]> = times
        .flat_map(|k| {
            (0..counts[1])
                .rev()
                .map(move |l| [part(spans[0], k), part(spans[1], l)])
        })
        .collect();
    let mut looked = 0;
    while let Some([t, phi]) = parts.pop() {
        let found = ratio.bounds(t, phi)?;
        if RATIOS[0] <= found.lo() && found.hi() <= RATIOS[1] {
            continue;
        }
        looked += 1;
        let share = |of: Interval, span: f64| if span > 0.0 { of.width() / span } else { 0.0 };
        let [in_time, in_angle] = [share(t, duration), share(phi, turn)];
        let middle = [t, phi].map(Interval::middle);
        let small = looked > MOST_PARTS || in_time.max(in_angle) < PLACE;
        if small || leaves(ratio, middle[0], middle[1]).is_some() {
            return Some(middle);
        }
        let halves = |of: Interval| {
            let middle = of.middle();
            [
                Interval::between(middle, of.hi()),
                Interval::between(of.lo(), middle),
            ]
        };
        if in_time >= in_angle {
            parts.extend(halves(t).map(|t| [t, phi]));
        } else {
            parts.extend(halves(phi).map(|phi| [t, phi]));
        }
    }
    None
}
