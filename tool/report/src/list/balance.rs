//! Counterweights and springs that relieve the drive.

use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::answer::schema::Data;
use jred::machine::Element;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::model::with_mass::AttachedMass;
use jred_file::number::rounding::{figure, percent, short};
use jred_motion::balance::{BalanceFigures, BalanceGoal, BalanceRequest, BalanceResult};

/// The content of the listing.
#[derive(Debug)]
pub struct BalanceView<'a> {
    /// The machine.
    pub file: &'a MachineFile,
    /// The request.
    pub request: &'a BalanceRequest,
    /// The result.
    pub balanced: &'a BalanceResult,
}

impl BalanceView<'_> {
    fn coordinate(&self) -> Coordinate {
        self.file.machine.mechanism().coordinate()
    }

    fn link(&self, number: usize) -> &str {
        let names = self.file.machine.mechanism().link_names();
        names.get(number).map_or("", String::as_str)
    }

    /// Name of the objective.
    fn goal(&self) -> String {
        let effort = &self.coordinate().vocabulary().torque;
        match self.request.goal {
            BalanceGoal::Rms => format!("RMS {effort} of the drive link"),
            BalanceGoal::Peak => format!("peak {effort} of the drive link"),
            BalanceGoal::Holding => format!("RMS {effort} that holds it at rest"),
            BalanceGoal::Inertia => {
                format!("deviation of the reduced {} from its mean", self.inertia())
            }
        }
    }

    /// Name of the drive link's inertia.
    fn inertia(&self) -> &'static str {
        match self.coordinate() {
            Coordinate::Angle => "inertia",
            Coordinate::Length => "mass",
        }
    }

    fn unit(&self) -> &'static str {
        match self.request.goal {
            BalanceGoal::Inertia => self.coordinate().inertia_unit(),
            _ => self.coordinate().effort_unit(),
        }
    }
}

/// The result, the figures before and after, and what to write into the machine file.
pub fn answer(view: &BalanceView) -> Answer<'static> {
    let BalanceResult {
        masses,
        springs,
        efforts,
        before,
        after,
        bound,
    } = view.balanced;
    let goal = view.request.goal;
    let (unit, [was, is]) = (view.unit(), [before, after].map(|f| f.of(goal)));
    let title = format!("{}: least {}", view.file.title, view.goal());
    let mut answer = Answer::new(view.file.title.clone(), &data(view)).titled(title);
    let saved = if is <= was {
        format!("{} less", percent(1.0 - is / was))
    } else {
        "not less: nothing within the bounds is better".to_owned()
    };
    let [is, was, bound] = [is, was, *bound].map(short);
    answer.fact(
        "result",
        format!("{is} {unit} instead of {was} {unit}, {saved}"),
    );
    answer.fact(
        "optimum",
        format!("global: nothing within the bounds makes it less than {bound} {unit}"),
    );
    table(&mut answer, view, [before, after]);
    for warning in warnings(view) {
        answer.warning(warning);
    }
    let bodies = view.request.counterweights.iter().zip(masses);
    for (asked, found) in bodies {
        let on = view.link(asked.link);
        answer.code(match found {
            Some(found) => mass(on, found),
            None => format!("# {on}: no counterweight is best"),
        });
    }
    let springs = springs.iter().zip(efforts);
    for (number, (found, efforts)) in view.request.springs.iter().zip(springs) {
        let named = view.file.elements.get(*number);
        let name = named.map_or("", |named| &named.name);
        answer.code(match found {
            Some(found) => spring(name, found, efforts.as_ref()),
            None => format!("# {name}: no spring is best"),
        });
    }
    answer
}

/// Disadvantages of the result.
fn warnings(view: &BalanceView) -> Vec<String> {
    let effort = &view.coordinate().vocabulary().torque;
    let heats = view.balanced.heats().map(|share| {
        format!(
            "the RMS {effort} of the drive link rises by {}: the motor gets hotter; compare with --least rms",
            percent(share)
        )
    });
    heats.into_iter().collect()
}

/// Share of the larger of pull and push below which the other counts as zero.
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
fn table(answer: &mut Answer, view: &BalanceView, figures: [&BalanceFigures; 2]) {
    let coordinate = view.coordinate();
    let (effort, unit) = (&coordinate.vocabulary().torque, coordinate.effort_unit());
    let pair = |of: fn(&BalanceFigures) -> Option<[f64; 2]>, unit: &str| {
        let [Some(before), Some(after)] = figures.map(of) else {
            return None;
        };
        let [rms, peak] = [0, 1].map(|k| format!("{} -> {}", short(before[k]), short(after[k])));
        Some(format!("RMS {rms} {unit}, peak {peak} {unit}"))
    };
    let input = input_unit(view.file);
    let rows = [
        ("drive link", pair(|f| f.torque, unit)),
        ("at the input", pair(|f| f.input, input)),
        ("holding at rest", pair(|f| Some(f.holding), unit)),
    ];
    for (name, says) in rows {
        if let Some(says) = says {
            answer.fact(name, format!("{effort}: {says}"));
        }
    }
    let [before, after] = figures.map(|f| {
        let [least, mean, most] = f.inertia.map(short);
        format!("{least} to {most}, mean {mean}")
    });
    let inertia = view.inertia();
    answer.fact(
        "reduced",
        format!(
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

/// The mass as text of a machine file.
fn mass(on: &str, found: &AttachedMass) -> String {
    let [u, v] = found.at.map(|x| figure(x * 1e3));
    let inertia = if found.inertia > 0.0 {
        format!("inertia = \"{} kg m^2\"", figure(found.inertia))
    } else {
        "# a point mass: a real one has an inertia in addition".to_owned()
    };
    format!(
        "[[mass]]\nname = \"counterweight on {on}\"\non = \"{on}\"\nat = [\"{u} mm\", \"{v} mm\"]\nmass = \"{} kg\"\n{inertia}",
        figure(found.mass)
    )
}

fn spring(name: &str, found: &Element, efforts: Option<&[f64; 2]>) -> String {
    let [stiffness, free] = found.spring_rate().unwrap_or_default();
    let (rate, free_key, free, unit) = if found.is_torsional() {
        ("N m/rad", "free_angle", free.to_degrees(), "deg")
    } else {
        ("N/m", "free_length", free * 1e3, "mm")
    };
    let [stiffness, free] = [stiffness, free].map(figure);
    let remark = efforts.and_then(|efforts| both_ways(found, *efforts));
    let remark = remark.map_or_else(String::new, |remark| format!("\n# {remark}"));
    format!("# {name}\nstiffness = \"{stiffness} {rate}\"\n{free_key} = \"{free} {unit}\"{remark}")
}

/// The JSON of `jred balance` (SI units).
#[derive(Serialize, JsonSchema)]
pub(crate) struct BalanceData<'a> {
    /// The quantity that is least: rms, peak, holding or inertia.
    least: String,
    /// Figures of the machine as it is.
    before: FiguresData,
    /// Figures with counterweights and springs.
    after: FiguresData,
    /// Lower bound of the least value within the bounds (N·m, N, kg·m² or kg).
    bound: f64,
    /// Disadvantages of the result.
    warnings: Vec<String>,
    /// The counterweights.
    counterweights: Vec<CounterweightData<'a>>,
    /// The springs.
    springs: Vec<SpringData<'a>>,
}

impl Data for BalanceData<'_> {
    const FORM: &'static str = "jred-balance/1";
}

#[derive(Serialize, JsonSchema)]
struct FiguresData {
    /// The value of the quantity that is least.
    least: f64,
    /// Torque (N·m) or force (N) at the drive link over the motion.
    drive_link: Option<RmsAndPeak>,
    /// Torque (N·m) or force (N) at the input of the drive train over the motion.
    input: Option<RmsAndPeak>,
    /// Torque (N·m) or force (N) that holds the machine at rest, over its range.
    holding: RmsAndPeak,
    /// Reduced inertia (kg·m²) or mass (kg) of the mechanism.
    inertia: InertiaData,
}

#[derive(Serialize, JsonSchema)]
struct RmsAndPeak {
    /// Root of the mean square.
    rms: f64,
    /// Largest magnitude.
    peak: f64,
}

impl From<[f64; 2]> for RmsAndPeak {
    fn from([rms, peak]: [f64; 2]) -> Self {
        Self { rms, peak }
    }
}

#[derive(Serialize, JsonSchema)]
struct InertiaData {
    /// Least.
    min: f64,
    /// Mean over the range.
    mean: f64,
    /// Largest.
    max: f64,
    /// RMS deviation from the mean.
    rms_deviation: f64,
}

#[derive(Serialize, JsonSchema)]
struct CounterweightData<'a> {
    /// Link that carries it.
    on: &'a str,
    /// Largest permitted mass (kg).
    most: f64,
    /// Largest permitted distance from the origin of the link's frame (m).
    reach: f64,
    /// The counterweight; none: no counterweight is best.
    found: Option<MassData>,
}

#[derive(Serialize, JsonSchema)]
struct MassData {
    /// Position of its centre in the link's frame (m).
    at: [f64; 2],
    /// Mass (kg).
    mass: f64,
    /// Inertia about its centre (kg·m²).
    inertia: f64,
}

#[derive(Serialize, JsonSchema)]
struct SpringData<'a> {
    /// Name of the spring in the machine file.
    name: Option<&'a str>,
    /// Its data; none: no spring is best.
    found: Option<RateData>,
}

#[derive(Serialize, JsonSchema)]
struct RateData {
    /// Stiffness (N/m, or N·m/rad).
    stiffness: f64,
    /// Free length (m).
    #[serde(skip_serializing_if = "Option::is_none")]
    free_length: Option<f64>,
    /// Free angle (rad).
    #[serde(skip_serializing_if = "Option::is_none")]
    free_angle: Option<f64>,
    /// Largest pull (N, or N·m).
    pull: f64,
    /// Largest push (N, or N·m).
    push: f64,
}

fn data<'a>(view: &'a BalanceView) -> BalanceData<'a> {
    let BalanceResult {
        masses,
        springs,
        efforts,
        before,
        after,
        bound,
    } = view.balanced;
    let figures = |f: &BalanceFigures| {
        let [min, mean, max] = f.inertia;
        FiguresData {
            least: f.of(view.request.goal),
            drive_link: f.torque.map(RmsAndPeak::from),
            input: f.input.map(RmsAndPeak::from),
            holding: f.holding.into(),
            inertia: InertiaData {
                min,
                mean,
                max,
                rms_deviation: f.deviation,
            },
        }
    };
    let counterweights = view.request.counterweights.iter().zip(masses);
    let counterweights = counterweights.map(|(asked, found)| CounterweightData {
        on: view.link(asked.link),
        most: asked.most,
        reach: asked.reach,
        found: found.as_ref().map(|m| MassData {
            at: m.at,
            mass: m.mass,
            inertia: m.inertia,
        }),
    });
    let springs = view.request.springs.iter().zip(springs.iter().zip(efforts));
    let springs = springs.map(|(number, (found, efforts))| {
        let rate = found.as_ref().and_then(|spring| {
            let [stiffness, free] = spring.spring_rate()?;
            let [pull, push] = efforts.unwrap_or_default();
            let torsional = spring.is_torsional();
            Some(RateData {
                stiffness,
                free_length: (!torsional).then_some(free),
                free_angle: torsional.then_some(free),
                pull,
                push,
            })
        });
        let named = view.file.elements.get(*number);
        SpringData {
            name: named.map(|named| named.name.as_str()),
            found: rate,
        }
    });
    BalanceData {
        least: view.request.goal.to_string(),
        before: figures(before),
        after: figures(after),
        bound: *bound,
        warnings: warnings(view),
        counterweights: counterweights.collect(),
        springs: springs.collect(),
    }
}
