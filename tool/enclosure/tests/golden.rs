//! Enclosures of J, J′ and the load, compared with 50-digit references (`tests/data` of the library).

use jred::machine::{Action, Jointed, Link, Load, Machine, MassProperties};
use jred::mechanism::{
    Branch, FourBar, FourBarDimensions, Side, SliderCrank, SliderCrankDimensions,
};
use jred_enclosure::Interval;
use serde_json::Value;

use crate::mechanics::EnclosedMachine;

struct Case(Value);

impl Case {
    fn input(&self, path: &str) -> f64 {
        self.0
            .pointer(&format!("/inputs/{path}"))
            .and_then(Value::as_f64)
            .unwrap()
    }

    fn link(&self, number: u32, name: &str, inertia: f64) -> Link {
        let com = [0, 1].map(|axis| self.input(&format!("{name}_com/{axis}")));
        let mass = self.input(&format!("m{number}"));
        Link::new(MassProperties { mass, inertia, com }).unwrap()
    }

    fn gravity(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.input(&format!("gravity/{axis}")))
    }

    /// The rows of the table of positions: φ, J, J′ and the load.
    fn rows(&self) -> Vec<[f64; 4]> {
        let table = &self.0["expected"]["tables"]["position"];
        let columns = table["columns"].as_array().unwrap();
        let column = |name: &str| columns.iter().position(|c| c == name).unwrap();
        let places = ["phi", "J", "dJ", "Q"].map(column);
        let rows = table["rows"].as_array().unwrap().iter();
        rows.map(|row| places.map(|k| row[k].as_f64().unwrap()))
            .collect()
    }
}

/// The enclosures in the middle of a stretch contain the references and are as narrow as rounding permits.
fn compare(case: &Case, machine: &Machine<impl Jointed>) {
    let enclosed = EnclosedMachine::new(machine);
    let rows = case.rows();
    assert!(rows.len() > 10);
    for [phi, inertia, slope, load] in rows {
        let curves = enclosed.curves([phi - 1e-3, phi + 1e-3]).unwrap();
        for (form, exact) in [
            (curves.inertia, inertia),
            (curves.inertia_slope, slope),
            (curves.load, load),
        ] {
            // The middle of the stretch is φ, except for rounding.
            let found = form.at.0[0] + form.at.0[1] * Interval::within(1e-15 * (1.0 + phi.abs()));
            let reference = Interval::around(exact, 2e-16 * exact.abs());
            assert!(
                found.lo() <= reference.hi() && reference.lo() <= found.hi(),
                "{phi}: {found:?} {exact}"
            );
            assert!(
                found.width() < 1e-11 * (1.0 + exact.abs()),
                "{phi}: {found:?}"
            );
        }
    }
}

#[test]
fn a_slider_crank_contains_its_references() {
    let case = Case(
        serde_json::from_str(include_str!("../../../tests/data/01_slider_crank_A.json")).unwrap(),
    );
    let links = [
        case.link(1, "crank", case.input("I1")),
        case.link(2, "coupler", case.input("I2")),
        case.link(3, "slider", 0.0),
    ];
    let branch = if case.input("branch") > 0.0 {
        Branch::Right
    } else {
        Branch::Left
    };
    let dimensions = SliderCrankDimensions {
        crank: case.input("r"),
        rod: case.input("l"),
        offset: case.input("e"),
    };
    let mechanism = SliderCrank::new(dimensions, branch, links).unwrap();
    let force = Action::Force([case.input("F_slider/F/0"), case.input("F_slider/F/1")]);
    let at = [case.input("F_slider/at/0"), case.input("F_slider/at/1")];
    let force = Load::new(SliderCrank::SLIDER, force)
        .and_then(|f| f.at(at))
        .unwrap();
    let moment = Load::new(SliderCrank::CRANK, Action::Moment(case.input("M_crank"))).unwrap();
    let machine = Machine::new(mechanism)
        .with_gravity(case.gravity())
        .and_then(|m| m.with_load(force))
        .and_then(|m| m.with_load(moment))
        .unwrap();
    compare(&case, &machine);
}

#[test]
fn a_four_bar_contains_its_references() {
    let case =
        Case(serde_json::from_str(include_str!("../../../tests/data/02_four_bar_A.json")).unwrap());
    let names = ["crank", "coupler", "rocker"];
    let link = |k: u32| case.link(k, names[k as usize - 1], case.input(&format!("I{k}")));
    let side = if case.input("mode") > 0.0 {
        Side::Left
    } else {
        Side::Right
    };
    let dimensions = FourBarDimensions {
        crank: case.input("a"),
        coupler: case.input("b"),
        rocker: case.input("c"),
        pivot: [case.input("C/0"), case.input("C/1")],
    };
    let mechanism = FourBar::new(dimensions, side, [link(1), link(2), link(3)]).unwrap();
    let moment = |link, path| Load::new(link, Action::Moment(case.input(path))).unwrap();
    let machine = Machine::new(mechanism)
        .with_gravity(case.gravity())
        .and_then(|m| m.with_load(moment(FourBar::CRANK, "M_crank")))
        .and_then(|m| m.with_load(moment(FourBar::ROCKER, "M_rocker")))
        .unwrap();
    compare(&case, &machine);
}
