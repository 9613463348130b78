//! A sizing as a submodel of the asset administration shell: IDTA 02021-1-0, Sizing of Power Drive Trains, as JSON of the metamodel V3.
//!
//! Names, semantic ids and units are those of the published template; its numbers are written as `xs:double`, because the template's `xs:long` has no
//! fractions. The standard knows one constant moment of inertia: the one written is the largest, and a statement says so. Its mechanisms have neither
//! cranks nor linkages, so `TransformationMechanism` is left out, and so is the motion, which belongs to a file beside the shell.

use serde_json::{Value, json};

use super::rule_words::{assumptions, note};
use super::source::{Source, machine_digest};
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_sizing::judge::Assessment;
use jred_sizing::judge::bill::{BillItem, Part};
use jred_sizing::judge::check::Check;

/// Joules of a kilowatt hour.
const KILOWATT_HOUR: f64 = 3.6e6;

/// The semantic ids that do not follow from the name.
const OTHER_IDS: [(&str, &str); 12] = [
    (
        "SizingProjectInformation",
        "https://admin-shell.io/idta/PowerDriveTrainSizing/SizingProjectInformation1/0",
    ),
    (
        "ContactInformation",
        "https://admin-shell.io/zvei/nameplate/1/0/ContactInformations/ContactInformation",
    ),
    (
        "Environmental",
        "https://admin-shell.io/idta/PowerDriveTrainSizing/EnvironmentalRequirements/1/0",
    ),
    ("InstallationAltitude", "0173-1#02-AAZ614#003"),
    ("BrakePresent", "0173-1#02-BAE085#007"),
    ("MainsConnection", "0173-1#02-ABF822#003"),
    ("NameOfContact", "0173-1#02-AAO205#002"),
    ("ManufacturerName", "0173-1#02-AAO677#002"),
    ("ManufacturerArticleNumber", "0173-1#02-AAO676#003"),
    ("ManufacturerProductDesignation", "0173-1#02-AAW338#001"),
    ("ManufacturerOrderCode", "0173-1#02-AAO227#002"),
    // The template's spelling of the name.
    (
        "InternalMomentOfIntertia",
        "https://admin-shell.io/idta/PowerDriveTrainSizing/InternalMomentOfInertia/1/0",
    ),
];

/// A sized axis.
#[derive(Clone, Copy, Debug)]
pub struct SizedAxis<'a> {
    /// Its file and the day of the run.
    pub source: &'a Source<'a>,
    /// The machine.
    pub file: &'a MachineFile,
    /// Name of the axis in a project.
    pub axis: Option<&'a str>,
    /// Length of the cycle (s).
    pub duration: f64,
    /// Its drive.
    pub judged: &'a Assessment<'a>,
}

/// The environment with one submodel for each axis.
pub fn environment<'a>(axes: impl IntoIterator<Item = SizedAxis<'a>>) -> String {
    let submodels: Vec<Value> = axes.into_iter().map(|axis| axis.submodel()).collect();
    format!("{:#}\n", json!({ "submodels": submodels }))
}

/// A reference to what an element means; `name` may end in a number.
fn semantic(name: &str) -> Value {
    let name = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let known = OTHER_IDS.iter().find(|(other, _)| *other == name);
    let id = known.map_or_else(
        || format!("https://admin-shell.io/idta/PowerDriveTrainSizing/{name}/1/0"),
        |(_, id)| (*id).to_owned(),
    );
    json!({ "type": "ExternalReference", "keys": [{ "type": "GlobalReference", "value": id }] })
}

fn property(name: &str, kind: &str, value: &str) -> Value {
    json!({ "modelType": "Property", "idShort": name, "semanticId": semantic(name), "valueType": kind, "value": value })
}

fn text(name: &str, value: &str) -> Value {
    property(name, "xs:string", value)
}

/// A number; left out if it is unknown.
fn number(name: &str, value: f64) -> Option<Value> {
    let value = value.is_finite().then(|| format!("{value}"))?;
    Some(property(name, "xs:double", &value))
}

fn sentence(name: &str, words: &str) -> Value {
    json!({ "modelType": "MultiLanguageProperty", "idShort": name, "semanticId": semantic(name), "value": [{ "language": "en", "text": words }] })
}

/// A collection; an empty one has no value.
fn collection(name: &str, elements: Vec<Value>) -> Value {
    let mut made = json!({ "modelType": "SubmodelElementCollection", "idShort": name, "semanticId": semantic(name) });
    if !elements.is_empty() {
        made["value"] = elements.into();
    }
    made
}

fn entity(name: &str, statements: &[Value]) -> Value {
    json!({ "modelType": "Entity", "idShort": name, "semanticId": semantic(name), "entityType": "CoManagedEntity", "statements": statements })
}

impl SizedAxis<'_> {
    fn submodel(&self) -> Value {
        let id = machine_digest(self.source, self.file);
        let submodel = "https://admin-shell.io/idta/PowerDriveTrainSizing/1/0";
        json!({
            "modelType": "Submodel",
            "kind": "Instance",
            "id": format!("urn:jred:sizing:{id}:{}", self.axis.unwrap_or("axis").replace(' ', "-")),
            "idShort": "PowerDriveTrainSizing",
            "administration": { "version": "1", "revision": "0" },
            "semanticId": { "type": "ModelReference", "keys": [{ "type": "Submodel", "value": submodel }] },
            "submodelElements": [self.project(), self.requirements(), self.result()],
        })
    }

    fn project(&self) -> Value {
        let document = &self.file.document;
        let day = format!("{}T00:00:00Z", self.source.date);
        let contact = match document.author.as_str() {
            "" => Vec::new(),
            author => vec![sentence("NameOfContact", author)],
        };
        let link = json!({
            "modelType": "File", "idShort": "SizingProjectLink", "semanticId": semantic("SizingProjectLink"),
            "contentType": "application/toml", "value": self.source.name,
        });
        let mut elements = vec![
            text("ClientName", &document.customer),
            text("SizingProjectName", &document.project),
            sentence("SizingProjectDescription", &self.file.title),
            link,
            text(
                "SizingToolName",
                concat!("jred ", env!("CARGO_PKG_VERSION")),
            ),
            property("DateCreated", "xs:dateTime", &day),
            property("DateChanged", "xs:dateTime", &day),
            collection("ContactInformation", contact),
        ];
        elements.extend(
            self.axis
                .map(|axis| text("SizingProjectAxisReference", axis)),
        );
        collection("SizingProjectInformation", elements)
    }

    fn requirements(&self) -> Value {
        let site = &self.file.site;
        let warm = |name: &str, celsius: f64| json!({ "modelType": "Range", "idShort": name, "semanticId": semantic(name), "valueType": "xs:double", "max": format!("{celsius}") });
        let around = &site.surroundings;
        let environment = vec![
            text("InstallationAltitude", &format!("{}", around.altitude)),
            warm(
                "AmbientTemperatureController",
                around.cabinet.unwrap_or(around.ambient),
            ),
            warm("AmbientTemperatureMotor", around.ambient),
        ];
        let brake = self
            .judged
            .checks
            .iter()
            .any(|check| check.id == Rule::BrakeTorque);
        let mut overall = vec![text("BrakePresent", if brake { "true" } else { "false" })];
        overall.extend(
            site.mains_voltage
                .map(|volts| text("MainsConnection", &format!("{volts} VAC"))),
        );
        collection(
            "ApplicationRequirements",
            vec![
                collection("Environmental", environment),
                collection("OverallSystemRequirements", overall),
            ],
        )
    }

    fn result(&self) -> Value {
        let judged = self.judged;
        let duty = &judged.duty;
        let rotor = judged.drive.rotor();
        let makers: Vec<&str> = judged.bill().iter().map(|item| item.maker).collect();
        let name = judged.drive.name();
        let energy = duty.motoring_energy / KILOWATT_HOUR;
        let mut overall = vec![
            text(
                "ManufacturerName",
                makers.first().copied().unwrap_or_default(),
            ),
            text("ManufacturerOrderCode", &name),
        ];
        overall.extend(number(
            "ExternalMomentOfInertia",
            duty.inertia_ratio.max * rotor,
        ));
        overall.extend(number("InternalMomentOfIntertia", rotor));
        overall.extend(number("MassInertiaRatio", duty.inertia_ratio.max));
        overall.extend(number("EnergyConsumtionPerCycle", energy));
        let mut elements = vec![entity("OverallSystem", &overall)];
        let (mut main, mut other) = (0, 0);
        for item in judged.bill() {
            match item.part {
                // A brake is ordered with its motor.
                Part::Brake => {}
                Part::Resistor => {
                    other += 1;
                    let mut statements = named(&item);
                    statements.push(property("QuantityOfParts", "xs:integer", "1"));
                    elements.push(entity(&format!("OtherComponent{other}"), &statements));
                }
                _ => {
                    main += 1;
                    elements.push(entity(
                        &format!("MainComponent{main}"),
                        &self.component(&item),
                    ));
                }
            }
        }
        elements.push(collection("Messages", self.messages()));
        elements.push(sentence(
            "TextStatement",
            "The inertia of the machine varies over the cycle: moments of inertia and inertia ratio are the largest. Energies are at the motor shaft.",
        ));
        collection("SizingResult", elements)
    }

    /// A motor, a gearbox or an amplifier with its figures.
    fn component(&self, item: &BillItem) -> Vec<Value> {
        let duty = &self.judged.duty;
        let mut statements = vec![text("MainComponentType", item.part.name())];
        statements.extend(named(item));
        let mut add = |name: &str, value: f64| statements.extend(number(name, value));
        // The largest figure, and its share of the rating.
        let mut used = |rule: Rule, names: [&str; 2]| {
            let check = self.judged.checks.iter().find(|check| check.id == rule);
            if let Some(check) = check.filter(|check| check.finding.is_known()) {
                add(names[0], check.value.unwrap_or(f64::NAN));
                add(names[1], 100.0 * check.finding.value / check.finding.rating);
            }
        };
        let torque = ["MaxTorqueUtilization", "MaxTorqueUtilizationPercentage"];
        let speed = [
            "MaxRotationSpeedUtilization",
            "MaxRotationSpeedUtilizationPercentage",
        ];
        match item.part {
            Part::Motor => {
                used(Rule::PeakTorque, torque);
                used(Rule::Speed, speed);
                used(
                    Rule::WindingTemperature,
                    ["", "MaxThermalUtilizationPercentage"],
                );
                used(
                    Rule::RmsTorque,
                    ["RmsOfMotorTorque", "EffectiveUtilization"],
                );
                add("MassInertiaRatio", duty.inertia_ratio.max);
                add("RmsOfPower", duty.power.rms);
                add(
                    "PowerInMotorOperation",
                    duty.motoring_energy / self.duration,
                );
                add(
                    "PowerInRegenerativeOperation",
                    duty.regenerative_energy / self.duration,
                );
            }
            Part::Gearbox => {
                used(Rule::GearboxPeak, torque);
                used(Rule::GearboxSpeed, speed);
                used(Rule::GearboxCubicMean, ["", "EffectiveUtilization"]);
            }
            _ => {
                used(
                    Rule::PeakCurrent,
                    ["MaxCurrentUtilization", "MaxCurrentUtilizationPercentage"],
                );
                used(Rule::RmsCurrent, ["", "EffectiveUtilization"]);
                let rated = self
                    .judged
                    .drive
                    .amplifier
                    .map_or(f64::NAN, |a| a.rated_current);
                add("ContinuousCurrent", rated);
                add(
                    "AverageRegenerativePowerDcLink",
                    duty.regenerative_energy / self.duration,
                );
                add("MaxRegenerativePowerDcLink", (-duty.power.min).max(0.0));
            }
        }
        // Figures for which the standard has no name.
        statements.retain(|statement| statement["idShort"] != "");
        statements
    }

    /// Rules that are violated, that warn or that are not checked, and the assumptions.
    fn messages(&self) -> Vec<Value> {
        let judged = self.judged;
        let words = |check: &Check| format!("{} {}: {}", check.rule, check.against(), note(check));
        let of_rules = judged.checks.iter().filter_map(|check| {
            let level = match check.verdict {
                RuleVerdict::Fail => "error",
                RuleVerdict::Warn => "warning",
                RuleVerdict::NotChecked => "not checked",
                RuleVerdict::Pass | RuleVerdict::Off => return None,
            };
            Some((level, words(check)))
        });
        let assumed = assumptions(&judged.drive, &judged.assumptions).into_iter();
        let all = of_rules.chain(assumed.map(|words| ("assumption", words)));
        let message = |(k, (level, words)): (usize, (&str, String))| {
            let elements = vec![
                text("CriticalityOfMessage", level),
                sentence("MessageText", &words),
            ];
            collection(&format!("Message{}", k + 1), elements)
        };
        all.enumerate().map(message).collect()
    }
}

/// Maker, key and order code of a part.
fn named(item: &BillItem) -> Vec<Value> {
    vec![
        text("ManufacturerName", item.maker),
        text("ManufacturerArticleNumber", item.key),
        text("ManufacturerOrderCode", item.model),
    ]
}
