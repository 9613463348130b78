//! `[[load]] table`: constant rows are the plain loads, and a payload that varies keeps the energy.

use std::f64::consts::TAU;
use std::fmt::Write;

use jred::machine::Reducible;
use jred_analysis::duty::Duty;
use jred_analysis::inspect::Findings;
use jred_file::model::machine::MachineFile;
use jred_file::number::numerics::integral;

use crate::reading::{oblique_slider_crank, parse_with as parse};
use crate::support::{near, within};

fn crank(mass: &str, loads: &str, csv: &str) -> MachineFile {
    let machine = oblique_slider_crank(mass, loads);
    parse(&machine, &[("loads.csv", csv)]).unwrap()
}

fn places() -> impl Iterator<Item = f64> {
    (0..400).map(|k| TAU * (f64::from(k) * 0.618_033_988_749_895).fract())
}

/// A constant payload on the slider is a heavier slider, with its weight; a constant thrust is an opposing force; a constant
/// torque is a moment on the crank.
#[test]
fn constant_rows_are_the_plain_loads() {
    let mut csv = String::from("Position [deg],Payload [kg],Thrust [N],Torque [N m]\n");
    for k in 0..=36 {
        writeln!(csv, "{},2.5,80,-3", k * 10).unwrap();
    }
    let table = crank(
        "4 kg",
        "[[load]]\ntable = \"loads.csv\"\non = \"slider\"\n",
        &csv,
    );
    let plain = crank(
        "6.5 kg",
        "[[load]]\non = \"slider\"\nopposing_force = \"80 N\"\n[[load]]\non = \"crank\"\nmoment = \"-3 N m\"\n",
        "",
    );
    for phi in places() {
        let [a, b] = [&table, &plain].map(|file| file.machine.reduction(phi).unwrap());
        for (a, b) in a.inertias().into_iter().zip(b.inertias()) {
            assert!((a - b).abs() < 1e-13, "{phi}: {a} {b}");
        }
        assert!((a.load_torque() - b.load_torque()).abs() < 1e-12);
        assert!((a.coulomb - b.coulomb).abs() < 1e-12);
        let [a, b] =
            [&table, &plain].map(|file| file.machine.forces(phi, -7.0, 30.0).unwrap().drive);
        assert!((a - b).abs() < 1e-10, "d'Alembert at {phi}: {a} {b}");
    }
}

/// The rows' curves are no parts of the machine: `jred check` lists its links and joints only, which have one degree of freedom, and no load
/// acts on a curve.
#[test]
fn curves_are_no_links_and_joints() {
    let mut csv = String::from("Position [deg],Payload [kg],Thrust [N],Torque [N m]\n");
    for k in 0..=36 {
        writeln!(csv, "{},{},80,-3", k * 10, 2 + k % 2).unwrap();
    }
    let loads = "[[load]]\nname = \"feed\"\ntable = \"loads.csv\"\non = \"slider\"\n";
    let file = crank("4 kg", loads, &csv);
    let findings = Findings::of(&file).unwrap();
    let joints: Vec<&str> = findings
        .joints
        .iter()
        .map(|joint| joint.name.as_str())
        .collect();
    assert_eq!(joints, ["crank pivot", "crank pin", "slider pin", "guide"]);
    assert_eq!((findings.links, findings.freedoms()), (3, 1));
    assert!(findings.holds(), "{:?}", findings.violations());
    let mechanism = file.machine.mechanism();
    assert_eq!(mechanism.link_names(), ["crank", "rod", "slider"]);
    assert_eq!(mechanism.joint_names(), joints);
    assert!(mechanism.names().iter().any(|name| name == "feed: thrust"));
}

/// A payload that varies over the turn: the drive's work at constant speed is the change of the kinetic energy, which only the
/// term ½·J′·ω² with the J′ of the varying payload can give; and what is lifted comes down.
#[test]
fn a_varying_payload_keeps_the_energy() {
    let mut csv = String::from("Position [deg]\tPayload [kg]\n");
    for k in 0..36 {
        let payload = if (5..=17).contains(&k) { 3.0 } else { 0.0 };
        writeln!(csv, "{}\t{payload}", k * 10).unwrap();
    }
    let with = crank(
        "4 kg",
        "[[load]]\ntable = \"loads.csv\"\non = \"slider\"\n",
        &csv,
    );
    let empty = crank("4 kg", "", "");
    let omega = 9.0;
    let inertia = |phi: f64| with.machine.reduction(phi).unwrap().inertia;
    // Within the loaded stretch the machine is the one with three more kilograms.
    let loaded = crank("7 kg", "", "");
    for phi in [1.0, 1.6, 2.4, 2.9] {
        let expected = loaded.machine.reduction(phi).unwrap();
        let found = with.machine.reduction(phi).unwrap();
        assert!((found.inertia_slope - expected.inertia_slope).abs() < 1e-13);
        assert!((found.load_torque() - expected.load_torque()).abs() < 1e-12);
    }
    for [from, to] in [[0.3, 0.8], [0.75, 0.85], [2.5, 3.4], [0.0, TAU]] {
        let work = |phi: f64| {
            let r = with.machine.reduction(phi)?;
            Ok::<f64, jred::error::Error>(0.5 * r.inertia_slope * omega * omega)
        };
        let work = integral(work, [from, to], 72, 1e-12).unwrap();
        let gained = 0.5 * omega * omega * (inertia(to) - inertia(from));
        assert!(
            (work - gained).abs() < 1e-9,
            "{from} to {to}: {work} {gained}"
        );
    }
    assert!(inertia(1.5) > empty.machine.reduction(1.5).unwrap().inertia + 0.01);
}

/// On the drive link itself a payload is an inertia, a thrust an opposing torque.
#[test]
fn on_the_drive_link_a_payload_is_an_inertia() {
    let mut csv = String::from("position [deg],payload [kg m^2],thrust [N m]\n");
    for k in 0..12 {
        writeln!(csv, "{},0.03,1.5", k * 30).unwrap();
    }
    let table = crank(
        "4 kg",
        "[[load]]\nname = \"table\"\ntable = \"loads.csv\"\n",
        &csv,
    );
    let plain = crank("4 kg", "", "");
    for phi in places() {
        let [a, b] = [&table, &plain].map(|file| file.machine.reduction(phi).unwrap());
        assert!((a.inertia - b.inertia - 0.03).abs() < 1e-14);
        assert!((a.inertia_slope - b.inertia_slope).abs() < 1e-14);
        assert!((a.coulomb - b.coulomb - 1.5).abs() < 1e-14);
        assert!((a.load_torque() - b.load_torque()).abs() < 1e-14);
    }
    let names: Vec<&str> = table.loads.iter().map(|load| load.name.as_str()).collect();
    assert_eq!(names, ["table: thrust"]);
}

/// A payload that rides on the slider of a vertical slider-crank weighs as much as the same mass of the slider: torque, holding
/// torque and the torque of weight and friction agree, and so does what a change of the moving masses does.
#[test]
fn a_payload_weighs_what_a_link_of_its_mass_weighs() {
    let machine = |slider: &str, load: &str| {
        format!(
            r#"
gravity = ["-9.81 m/s^2", "0 m/s^2"]
[mechanism]
type = "slider-crank"
[mechanism.crank]
length = "90 mm"
mass = "0.01 kg"
inertia = "0.00001 kg m^2"
[mechanism.rod]
length = "340 mm"
mass = "0.01 kg"
inertia = "0.00001 kg m^2"
[mechanism.slider]
mass = "{slider}"
{load}
[motion]
type = "cycle"
[[motion.segment]]
move = "360 deg"
duration = "1.5 s"
law = "polynomial-345"
"#
        )
    };
    let mut table = String::from("Position [deg],Payload [kg]\n");
    for k in 0..=36 {
        writeln!(table, "{},60", 10 * k).unwrap();
    }
    let load = "[[load]]\nname = \"payload\"\ntable = \"payload.csv\"\non = \"slider\"\n";
    let whole = parse(&machine("60.01 kg", ""), &[]).unwrap();
    let laden = parse(&machine("0.01 kg", load), &[("payload.csv", &table)]).unwrap();
    let [whole, laden] =
        [whole, laden].map(|file| Duty::new(&file, file.motion.as_ref().unwrap(), 400).unwrap());
    near("hold", laden.hold_torque, whole.hold_torque, 1e-9);
    assert!(whole.hold_torque > 50.0);
    for (laden, whole) in laden
        .mechanics
        .constant
        .iter()
        .zip(whole.mechanics.constant)
    {
        near("constant", *laden, whole, 1e-9);
    }
    let most = whole.figures(|i| i.input_torque).peak();
    // Instants without weight lie at peaks, which are not at the same bits.
    let [laden, whole] = [&laden, &whole].map(|duty| {
        let weighted = duty.instants.iter().filter(|i| i.weight > 0.0);
        weighted.collect::<Vec<_>>()
    });
    assert_eq!(laden.len(), whole.len());
    for (laden, whole) in laden.iter().zip(&whole) {
        within(
            "torque",
            laden.input_torque,
            whole.input_torque,
            1e-9 * most,
        );
        within(
            "weight",
            laden.terms.potential,
            whole.terms.potential,
            1e-9 * most,
        );
        within(
            "process",
            laden.terms.process,
            whole.terms.process,
            1e-9 * most,
        );
    }
}
