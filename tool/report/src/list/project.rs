//! A project: the drives of all axes, their parts, and the supply.

use schemars::JsonSchema;
use serde::Serialize;

use super::bus::{self, BusData};
use super::listing::{Listing, order, table};
use super::marks;
use super::source::Source;
use crate::answer::Answer;
use crate::answer::schema::Data;
use crate::table::reading::ColumnKind::{Quantity, Verdict, Words};
use crate::table::reading::Reading;
use jred_file::model::project::{Project, ProjectAxis};
use jred_file::number::rounding::short;
use jred_file::number::words::counted;
use jred_sizing::bus::analysis::{BusAnalysis, BusAxis};
use jred_sizing::catalogue::Resistor;
use jred_sizing::judge::Assessment;
use jred_sizing::judge::bill::{BillItem, Part};

/// An axis with its judged drives.
#[derive(Debug)]
pub struct AxisView<'a> {
    /// The axis.
    pub axis: &'a ProjectAxis,
    /// Its drives.
    pub listing: Listing<'a>,
    /// Its file.
    pub source: Source<'a>,
    /// The drive.
    pub judged: Assessment<'a>,
    /// Its drive on the DC bus.
    pub bus: BusAxis,
}

/// A project with its drives.
#[derive(Debug)]
pub struct ProjectView<'a> {
    /// The project.
    pub project: &'a Project,
    /// Its axes.
    pub axes: Vec<AxisView<'a>>,
    /// The common bus; `None`: each amplifier has its own.
    pub bus: Option<&'a BusAnalysis>,
    /// The resistor chosen for it.
    pub resistor: Option<&'a Resistor>,
    /// The day of the run.
    pub date: &'a str,
}

/// A line of the bill of materials of a project.
struct BillLine<'c, 'a> {
    count: u32,
    name: &'static str,
    item: BillItem<'c, 'a>,
    /// Names of the axes.
    axes: Vec<&'a str>,
}

/// The JSON of `jred project`; units are in the names.
#[derive(Serialize, JsonSchema)]
pub(crate) struct ProjectData<'a> {
    /// Version of jred.
    version: &'static str,
    /// Whether every axis and the bus satisfy every rule.
    holds: bool,
    /// The axes.
    axes: Vec<AxisData<'a>>,
    /// All parts.
    #[serde(rename = "bill of materials")]
    bill: Vec<BillLineData<'a>>,
    /// The supply.
    supply: SupplyData,
    /// The common bus; null: each amplifier has its own.
    bus: Option<BusData<'a>>,
}

#[derive(Serialize, JsonSchema)]
struct AxisData<'a> {
    /// Its name.
    axis: &'a str,
    /// Number of equal axes.
    quantity: u32,
    /// Its machine file.
    machine: &'a str,
    /// Delay of its cycle; null: any.
    #[serde(rename = "phase [s]")]
    phase: Option<f64>,
    /// Name of its drive.
    drive: String,
    /// Whether the drive violates no rule.
    holds: bool,
    /// What is missing for the order; "as it is": nothing.
    order: String,
}

#[derive(Serialize, JsonSchema)]
struct BillLineData<'a> {
    /// Number of pieces.
    quantity: u32,
    part: Part,
    maker: &'a str,
    /// The maker's type designation.
    order: &'a str,
    /// Key in the catalogue.
    key: &'a str,
    /// Of one piece; null: not given.
    #[serde(rename = "mass [kg]")]
    mass: Option<f64>,
    /// Of one piece, in the currency of the catalogue; null: not given.
    price: Option<f64>,
    /// The axes that it belongs to.
    axes: Vec<&'a str>,
}

#[derive(Serialize, JsonSchema)]
struct SupplyData {
    /// Mean of the power that all axes draw, without what they feed back.
    #[serde(rename = "mean drawn [W]")]
    mean: f64,
    /// Mean of the power that all axes feed back.
    #[serde(rename = "mean fed back [W]")]
    back: f64,
    /// Largest power drawn if all axes have their peaks at once.
    #[serde(rename = "peak drawn [W]")]
    peak: f64,
}

impl Data for ProjectData<'_> {
    const FORM: &'static str = "jred-project/1";
}

impl<'a> ProjectView<'a> {
    /// Whether every axis and the bus satisfy every rule.
    pub fn holds(&self) -> bool {
        let axes = self.axes.iter().all(|axis| axis.judged.holds());
        axes && self.bus.is_none_or(BusAnalysis::holds)
    }

    /// The answer.
    pub fn answer(&self) -> Answer<'static> {
        let bill = self.bill();
        let data = ProjectData {
            version: env!("CARGO_PKG_VERSION"),
            holds: self.holds(),
            axes: self.axes.iter().map(AxisView::data).collect(),
            bill: bill.iter().map(BillLine::data).collect(),
            supply: self.supply(),
            bus: self.bus.map(bus::data),
        };
        let mut answer = Answer::new(&self.project.title, &data);
        answer.csv(bill_table(&bill, false).csv());
        self.title(&mut answer);
        self.drives(&mut answer);
        answer.heading("Bill of materials");
        answer.table(bill_table(&bill, true));
        if bill.iter().any(|line| !line.item.from_maker) {
            answer.sentence("* figures not from the maker's own document");
        }
        self.supplied(&mut answer, &data.supply);
        answer
    }

    /// The title block.
    fn title(&self, answer: &mut Answer) {
        let document = &self.project.document;
        for (name, text) in document.entries() {
            answer.fact(name, text);
        }
        if document.date.is_empty() {
            answer.fact("date", self.date);
        }
    }

    fn drives(&self, answer: &mut Answer) {
        let row = |axis: &AxisView| {
            let verdict = axis.judged.verdict().word();
            [
                axis.axis.name.clone(),
                axis.axis.quantity.to_string(),
                axis.judged.drive.name(),
                verdict.to_owned(),
                order(axis.listing.file, &axis.judged),
            ]
        };
        let header = [
            ("axis", Words),
            ("quantity", Quantity),
            ("drive", Words),
            ("verdict", Verdict),
            ("order", Words),
        ];
        answer.table(table(header, self.axes.iter().map(row), 1));
    }

    /// All parts, equal ones in one line.
    fn bill(&self) -> Vec<BillLine<'a, '_>> {
        let mut bill: Vec<BillLine> = Vec::new();
        for axis in &self.axes {
            // A brake is ordered with its motor.
            let parts = axis.judged.bill();
            let has_brake = parts.iter().any(|item| item.part == Part::Brake);
            let parts = parts.into_iter();
            for item in parts.filter(|item| item.part != Part::Brake) {
                let own =
                    |line: &BillLine| line.item.part == item.part && line.item.key == item.key;
                let known = bill.iter().position(own);
                let at = known.unwrap_or_else(|| {
                    bill.push(BillLine {
                        count: 0,
                        name: match item.part {
                            Part::Motor if has_brake => "motor with brake",
                            part => part.name(),
                        },
                        item,
                        axes: Vec::new(),
                    });
                    bill.len() - 1
                });
                if let Some(line) = bill.get_mut(at) {
                    line.count += axis.axis.quantity;
                    line.axes.push(&axis.axis.name);
                }
            }
        }
        bill.extend(self.resistor.map(|common| BillLine {
            count: 1,
            name: Part::Resistor.name(),
            item: BillItem::resistor(common),
            axes: vec!["all"],
        }));
        let place = |line: &BillLine| line.item.part as u8;
        bill.sort_by_key(place);
        bill
    }

    fn supply(&self) -> SupplyData {
        let none = SupplyData {
            mean: 0.0,
            back: 0.0,
            peak: 0.0,
        };
        self.axes.iter().fold(none, |sum, axis| {
            let count = f64::from(axis.axis.quantity);
            let [drawn, back] = axis.bus.curve.energies();
            let [_, most] = axis.bus.curve.extremes();
            SupplyData {
                mean: sum.mean + count * drawn / axis.bus.curve.period(),
                back: sum.back + count * back / axis.bus.curve.period(),
                peak: sum.peak + count * most.max(0.0),
            }
        })
    }

    fn supplied(&self, answer: &mut Answer, supply: &SupplyData) {
        answer.heading("Supply");
        let [mean, back, peak] = [supply.mean, supply.back, supply.peak].map(short);
        answer.sentence(format!(
            "All axes draw {mean} W and feed back {back} W in the mean; {peak} W if all have their largest power at once."
        ));
        let Some(bus) = self.bus else {
            answer.sentence("Each amplifier has a DC bus and, where the bill of materials lists it, a brake resistor of its own.");
            return;
        };
        let count = counted(bus.axes.len(), "drive", "drives");
        let together = "at the phases of the project";
        let phases = match bus.power {
            Some(_) if bus.only_in_step => together,
            Some(_) => "at the worst phases",
            None => "at any phases",
        };
        answer.heading(format!("Common DC bus of {count}, {phases}"));
        bus::blocks(bus, together, answer);
        answer
            .sentence("The bill has no rectifier for the common bus: choose one for these powers.");
    }
}

impl<'a> AxisView<'a> {
    fn data(&self) -> AxisData<'a> {
        let axis = self.axis;
        AxisData {
            axis: &axis.name,
            quantity: axis.quantity,
            machine: &axis.machine,
            phase: axis.phase,
            drive: self.judged.drive.name(),
            holds: self.judged.holds(),
            order: order(self.listing.file, &self.judged),
        }
    }
}

impl BillLine<'_, '_> {
    fn data(&self) -> BillLineData<'_> {
        let item = &self.item;
        BillLineData {
            quantity: self.count,
            part: item.part,
            maker: item.maker,
            order: item.model,
            key: item.key,
            mass: item.mass,
            price: item.price,
            axes: self.axes.clone(),
        }
    }
}

/// The bill of materials; to be read by a person with its sum and dashes.
fn bill_table(bill: &[BillLine], is_read: bool) -> Reading {
    let figure = |value: Option<f64>| match value {
        None if is_read => "–".to_owned(),
        value => value.map_or(String::new(), short),
    };
    let row = |line: &BillLine| {
        [
            line.count.to_string(),
            line.name.to_owned(),
            format!("{} {}", line.item.maker, line.item.model),
            marks::key(line.item.key, line.item.from_maker),
            line.axes.join(", "),
            figure(line.item.mass),
            figure(line.item.price),
        ]
    };
    let sum = |of: fn(&BillLine) -> Option<f64>| {
        let all = bill
            .iter()
            .map(|line| Some(f64::from(line.count) * of(line)?));
        figure(all.sum())
    };
    let total = [
        String::new(),
        "sum".to_owned(),
        String::new(),
        String::new(),
        String::new(),
        sum(|line| line.item.mass),
        sum(|line| line.item.price),
    ];
    let header = [
        ("pieces", Quantity),
        ("part", Words),
        ("order", Words),
        ("key", Words),
        ("axes", Words),
        ("mass each [kg]", Quantity),
        ("price each", Quantity),
    ];
    let total = is_read.then_some(total);
    table(header, bill.iter().map(row).chain(total), 3)
}
