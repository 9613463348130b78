//! A user-defined mechanism with a sliding drive link: every heading and unit is that of a stroke.
use std::path::Path;

use crate::support::{budget, near};
use jred::Domain;
use jred::machine::{
    Frame, Frames, Joint, Jointed, Joints, Link, Machine, Marker, MassProperties, Mechanism,
};
use jred::number::Transfer;
use jred_analysis::inspect::Findings;
use jred_analysis::reduce::{Over, Request, Sets, reduce};
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::{MachineFile, ReductionCache};
use jred_file::model::mechanism::AnyMechanism;
use jred_report::table::output::Format;
use jred_report::table::screen::Screen;
use serde_json::Value;

/// A block on a guide along x, driven along it, with a pin that swings a slotted lever about (0, −h).
#[derive(Debug)]
struct Lever {
    links: [Link; 2],
}

const HEIGHT: f64 = 0.2;
const FROM: f64 = -0.1;
const TO: f64 = 0.15;

impl Mechanism for Lever {
    fn links(&self) -> &[Link] {
        &self.links
    }
    fn domain(&self) -> Domain {
        Domain::stroke(FROM, TO).unwrap()
    }
    fn frames(&self, s: f64) -> Result<Frames, jred::machine::PoseError> {
        let s = Transfer::variable(s);
        let h = Transfer::constant(HEIGHT);
        let length = (s * s + h * h).sqrt();
        let lever = Transfer::angle(h.over(length), s.over(length));
        Ok(Frames::from_iter([
            Frame::translating([s, Transfer::constant(0.0)]),
            Frame::turning([0.0, -HEIGHT], lever),
        ]))
    }
}

impl Jointed for Lever {
    fn joints(&self, _: f64, _: &Frames) -> Result<Joints, jred::machine::PoseError> {
        Ok(Joints::from_iter([
            Joint::Prismatic([Marker::ground([0.0, 0.0]), Marker::on(0, [0.0, 0.0])]),
            Joint::Revolute([Marker::ground([0.0, -HEIGHT]), Marker::on(1, [0.0, 0.0])]),
            Joint::PinInSlot([Marker::on(0, [0.0, 0.0]), Marker::on(1, [0.0, 0.0])]),
        ]))
    }
}

fn lever() -> MachineFile {
    let plain = "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"belt\"\n\
         driver = { radius = \"1 m\", inertia = \"1 kg m^2\" }\ndriven = { radius = \"1 m\", inertia = \"1 kg m^2\" }\n";
    let file = jred_analysis::checked::parse("plain", plain, Path::new("")).unwrap();
    let links = [
        Link::point_mass(3.0).unwrap(),
        Link::new(MassProperties {
            mass: 2.0,
            inertia: 0.04,
            com: [0.0, 0.0],
        })
        .unwrap(),
    ];
    let mechanism = AnyMechanism::new(
        "lever",
        Lever { links },
        ["block", "lever"],
        ["guide", "pivot", "pin, in the slot"],
    )
    .with_point("tip, \"end\"", 1, [0.3, 0.0]);
    MachineFile {
        title: "Lever".to_owned(),
        machine: Machine::new(mechanism),
        over_range: ReductionCache::default(),
        ..file
    }
}

fn request(sets: Sets) -> Request {
    Request {
        over: Over::Angle,
        positions: 6,
        sets,
        state: Some([0.4, -2.0]),
    }
}

/// m_red = m + J·ψ′², ψ′ = −h/(s² + h²); a stroke is counted from end to end, in millimetres.
#[test]
fn a_sliding_drive_link() {
    let file = lever();
    assert_eq!(file.machine.mechanism().coordinate(), Coordinate::Length);
    let curves = Sets {
        curves: true,
        ..Sets::default()
    };
    let columns = reduce(&file, &request(curves)).unwrap();
    let expected = [
        "s [mm]",
        "m_red [kg]",
        "m_red' [kg/m]",
        "m_red'' [kg/m^2]",
        "U [J]",
        "F_potential [N]",
        "F_process [N]",
        "b_viscous [N s/m]",
        "c_coulomb [N]",
        "v [m/s]",
        "a [m/s^2]",
    ];
    assert_eq!(&columns.names()[..11], expected);
    assert!(columns.names().contains(&"F_drive [N]".to_owned()));
    for (k, row) in columns.rows().iter().enumerate() {
        let s = FROM + (TO - FROM) * k as f64 / 5.0;
        near("s", row[0].unwrap(), s * 1e3, 1e-12);
        let psi = -HEIGHT / (s * s + HEIGHT * HEIGHT);
        near(
            "m_red",
            row[1].unwrap(),
            3.0 + 0.04 * psi * psi,
            budget::CLOSED_FORM,
        );
    }
    let points = Sets {
        points: true,
        reactions: true,
        ..Sets::default()
    };
    let columns = reduce(&file, &request(points)).unwrap();
    let csv = jred_report::table::output::write(&columns, Format::Csv, "");
    let header = csv.lines().next().unwrap();
    assert!(header.contains("\"tip, \"\"end\"\" x' [m/m]\""), "{header}");
    assert!(header.contains("lever psi' [rad/m]") && header.contains("\"pin, in the slot F [N]\""));
    assert!(header.contains("guide M [N m]") && !header.contains("pivot M"));
    let at = |name: &str| columns.names().iter().position(|n| n == name).unwrap();
    for row in columns.rows() {
        let s = row[0].unwrap() * 1e-3;
        let d = s * s + HEIGHT * HEIGHT;
        let turn = -HEIGHT / d * 0.4;
        near(
            "lever",
            row[at("lever omega [rad/s]")].unwrap(),
            turn,
            budget::CLOSED_FORM,
        );
        // J·ψ̈ is the pin's moment about the pivot.
        let bend = 2.0 * s * HEIGHT / (d * d) * 0.16 + HEIGHT / d * 2.0;
        let force = row[at("pin, in the slot F [N]")].unwrap();
        near("pin", force, (0.04 * bend).abs() / d.sqrt(), 1e-11);
    }
}

/// A pin in a straight slot through the pivot pushes perpendicular to the lever, which is optimal; seen from the guide it is not.
#[test]
fn the_check_of_a_stroke() {
    let findings = Findings::of(&lever()).unwrap();
    assert!(findings.holds(), "{:?}", findings.violations());
    let answer = jred_report::list::inspection::answer(&findings);
    let written = |format| answer.write(format, Screen::default()).collect::<String>();
    let json: Value = serde_json::from_str(&written(Format::Json)).unwrap();
    assert_eq!(json["degrees of freedom"], 1);
    assert_eq!(json["range"], serde_json::json!([FROM, TO]));
    assert_eq!(json["closure"], Value::Null);
    let travel = &json["travels"][0];
    assert_eq!(travel["way"], "swings");
    let swing = HEIGHT.atan2(FROM) - HEIGHT.atan2(TO);
    near("swing", travel["stroke"].as_f64().unwrap(), swing, 1e-12);
    near(
        "index",
        json["transmission"]["index"].as_f64().unwrap(),
        1.0,
        1e-12,
    );
    let text = written(Format::Table);
    for words in [
        "s = -100 to 150 mm",
        "no dead centre",
        "m_red ",
        "drive force",
    ] {
        assert!(text.contains(words), "{words} is not in\n{text}");
    }
    let page = jred_report::page::mechanism_page("lever.toml", &lever(), Some([0.4, 0.0]));
    let page = page.unwrap();
    assert!(page.contains("displacement of the drive link s [mm]") && !page.contains("NaN"));
    assert!(page.contains("reduced force [N]") && page.contains("m_red [kg]"));
}
