//! Messages about mistakes in machine files.

use std::fmt::Write as _;

use super::{Desk, compare};
use crate::support::rows;

/// `machine` with one text replaced by another, a message for each of the edits ([`rows`]).
pub(super) fn mistakes(name: &str, machine: &str, command: &str, edits: &str) {
    let original = Desk::machine(machine);
    let mut text = String::new();
    for [from, to] in rows(edits) {
        assert!(original.contains(&from), "{machine} has no {from:?}");
        let desk = Desk::new()
            .with_machines(&[
                "load-table.csv",
                "reduced-curves.csv",
                "drive-log.csv",
                "force-over-stroke.csv",
            ])
            .with("short.csv", "Position [deg],Thrust [N]\n0,1\n10\n")
            .with(
                "twice.csv",
                "Position [deg],Thrust [N],Thrust [kN]\n0,1,1\n10,1,1\n20,1,1\n",
            )
            .with("unknown.csv", "Position [deg],Thrst [N]\n0,1\n10,1\n20,1\n")
            .with("bare.csv", "Position,Thrust [N]\n0,1\n10,1\n20,1\n")
            .with("back.csv", "Position [deg],Thrust [N]\n0,1\n20,1\n10,1\n")
            .with(
                "jump.csv",
                "s [mm],Force [kN]\n0,0\n10,-5\n20,-9\n30,-5\n36,-2\n",
            )
            .with(
                "gap.csv",
                "s [mm],Force [kN]\n0,0\n1,-1\n2,-3\n3,-5\n4,-6\n34,-2\n35,0\n",
            )
            .with(
                "steps.csv",
                "s [mm],Force [kN]\n0,0\n6,0\n12,-5\n18,-5\n24,-5\n30,0\n",
            )
            .with(
                "moment.csv",
                "s [mm],Force [kN],Moment [N m]\n0,0,0\n9,-2,1\n18,-3,1\n27,-2,1\n36,0,0\n",
            )
            .with(
                "unsorted.csv",
                "s [mm],Force [kN]\n0,0\n20,-2\n10,-3\n30,-2\n36,0\n",
            )
            .with("word.csv", "Position [deg],Thrust [N]\n0,1\n10,one\n20,1\n")
            .with("m.toml", original.replacen(&from, &to, 1));
        let message = desk.run(&format!("{command} m.toml"));
        let (_, message) = message.split_once('\n').unwrap();
        writeln!(text, "{} -> {}\n{message}", quoted(&from), quoted(&to)).unwrap();
    }
    compare(name, &text);
}

fn quoted(text: &str) -> String {
    format!("`{}`", text.replace('\n', " ⏎ "))
}

#[test]
fn quantities() {
    let edits = r#"
        length = "30 mm" =>
        length = "30 mm" => length = 30
        length = "30 mm" => length = "30"
        length = "30 mm" => length = "30 kg"
        length = "30 mm" => length = "30 bananas"
        length = "30 mm" => length = "30 inches"
        length = "30 mm" => length = "30 mm/s/s"
        length = "30 mm" => length = "1,5 mm"
        length = "30 mm" => length = "1 m + 2 m"
        length = "30 mm" => length = "long"
        length = "30 mm" => length = "0 mm"
        length = "30 mm" => length = "1e-9 mm"
        length = "30 mm" => length = "30 km"
        length = "30 mm" => length = nan
        length = "30 mm" => length = ["30 mm"]
        length = "30 mm" => length = 30 mm
        length = "30 mm" => length = "30 mm"\nlength = "31 mm"
        mass = "42 kg" => mass = "-42 kg"
        com = ["6 mm", "0 mm"] => com = ["6 mm"]
        97 % => 103 %
        duration = "2 s" => duration = "2 Hz"
    "#;
    mistakes("machine-quantities", "press.toml", "reduce", edits);
}

#[test]
fn keys_and_words() {
    let edits = r#"
        length = "30 mm" => lenght = "30 mm"
        offset = "0 mm" => offset = "0 mm"\ncolour = "red"
        [simulation] => [simulaton]
        "slider-crank" => "slidercrank"
        "right" => "up"
        driver = { radius = "40 mm", => driver = { diameter = "80 mm",
        gravity = => # gravity =
        flywheel = => efficiency = 0.9\nflywheel =
        mass = "42 kg" => mass = "42 kg"\ninertia = "1 kg m^2"
        [mechanism] => [[mechanism]]
        [motion] => [motion
    "#;
    mistakes("machine-keys", "press.toml", "reduce", edits);
}

#[test]
fn loads() {
    let edits = r#"
        on = "crank" => on = "shaft"
        opposing_force => opposing_moment
        opposing_force = "150 N" => opposing_moment = "150 N m"
        opposing_force = "150 N" => opposing_force = "-150 N"
        opposing_force = "150 N" => opposing_force = "150 N"\nmoment = "1 N m"
        opposing_force = "150 N" =>
        viscous_moment = "0.4 N m s/rad" => opposing_force = "3 N"
        viscous_moment => at = ["1 mm", "0 mm"]\nviscous_moment
        ramp = "15 deg" => ramp = "25 deg"
        "360 deg"] => "315 deg"]
        [[load]] =>
            [[mechanism.spring]]\nbetween = ["slider", "ground"]\nstiffness = "1 N/mm"\nfree_length = "1 m"\nfree_angle = "0 deg"\n[[load]]
    "#;
    mistakes("machine-loads", "press.toml", "reduce", edits);
}

#[test]
fn schedules() {
    let edits = r#"
        segments = [2] => segments = [2, 5]
        segments = [2] => segments = [2, 2]
        segments = [2] => segments = [0]
        segments = [2] => segments = []
        segments = [2] => segments = [1, 3]
        segments = [2] => during = ["0.4 s", "1.1 s"]
        segments = [2] => during = ["1.1 s", "1.1 s"]
        segments = [2] => during = ["1 s", "3 s"]
        segments = [2] => segments = [2]\nduring = ["0 s", "1 s"]
        segments = [2] => segments = [2]\ndirection = "forward"
        segments = [2] =>
        [[load]]\nname = "suction =>
            [[payload]]\nname = "part"\non = "rack"\nmass = "1 kg"\nsegments = [2, 3]\n\n[[load]]\nname = "suction
        direction = "forward" => direction = "up"
        direction = "forward" => direction = "forward"\nsegments = [4]
        at_rest = "60 N" => at_rest = "20 N"
        at_rest = "60 N" => at_rest = ["60 N", "0 N"]
        opposing_force = "35 N" => viscous_force = "35 N s/m"
        name = "guide friction" => name = "brush at the way up"
    "#;
    mistakes("machine-schedule", "pick-and-place.toml", "reduce", edits);
}

#[test]
fn motions() {
    let edits = r#"
        "360 deg"\nduration => "350 deg"\nduration
        dwell = "0.1 s" => dwell = "0.1 s"\nmove = "10 deg"
        dwell = "0.1 s" => dwell = "0 s"
        dwell = "0.1 s" => dwell = "0.1 s"\nlaw = "cycloidal"
        move = "360 deg" => move = "0 deg"
        "polynomial-345" => "trapezoid"\naccelerate = "80 %"
        "polynomial-345" => "cycloidal"\naccelerate = "80 %"
        "polynomial-345" => "poly5"
        type = "cycle" => type = "constant-speed"\nspeed = "0 rpm"
        type = "cycle" => type = "profile"\nfile = "turn.csv"
        type = "cycle" => type = "cycle"\nduty_type = "S4"
        "polynomial-345" => "constant-speed"
        "polynomial-345" => "polynomial-5"\nend_speed = "10 rpm"
        "polynomial-345" => "polynomial-6"
        "polynomial-345" => "cycloidal"\nmax_speed = "10 rpm"
        law = "polynomial-345"\nmove = "360 deg"\nduration = "0.4 s" =>
            law = "jerk-limited"\nmove = "360 deg"\nmax_speed = "60 rpm"\nmax_acceleration = "9 rad/s^2"
        law = "polynomial-345"\nmove = "360 deg"\nduration = "0.4 s" =>
            law = "trapezoid"\nmove = "60 deg"\nmax_speed = "60 rpm"\nmax_acceleration = "9 rad/s^2"\nstart_speed = "50 rpm"
    "#;
    mistakes("machine-motions", "press.toml", "size", edits);
    let edits = r#"
        near = "300 deg" => near = "0 deg"
        near = "300 deg"\n =>
        along = "x" => along = "z"
        , along = "x" =>
        point = "slider", along = "x" => link = "slider"
        point = "slider", along = "x" => slide = "crank pin"
        start = "195 mm" => start = "145 mm"
        move = "11 mm" => move = "17 mm"
        law = "join"\nto = "180 deg" => law = "join"
        law = "join"\nto = "180 deg" => law = "join"\nto = "180 mm"
        of = { point => # of = { point
    "#;
    mistakes("machine-tool-motions", "drawing-press.toml", "size", edits);
}

#[test]
fn rules_and_simulations() {
    let edits = r#"
        [simulation] => [rules]\nset = "generl"\n[simulation]
        [simulation] => [rules]\nrms_torqe = 0.9\n[simulation]
        [simulation] => [rules]\nspeed = 0.9\nspeed_warning = 0.95\n[simulation]
        [simulation] => [rules]\nspeed = "off"\nspeed_warning = 0.95\n[simulation]
        [simulation] => [rules]\ninertia_ratio = 3\n[simulation]
        [simulation] => [duty]\ntype = "S3"\n[simulation]
        [simulation] => [duty]\ntype = "S1"\noperating_time = "3 s"\n[simulation]
        [simulation] => [surroundings]\nambient = "300 degC"\n[simulation]
        [simulation] => [surroundings]\naltitude = "5 km"\n[simulation]
        [simulation] => [stiffness]\n[simulation]
        [simulation] => [tool]\n[simulation]
        [simulation] => [supply]\nmains_voltage = "4000 V"\n[simulation]
        [simulation] => [supply]\nmains_voltage = "0 V"\n[simulation]
        [simulation] => [supply]\nmains_voltage = 400\n[simulation]
        [simulation] => [supply]\nmains_voltage = "400 V"\nchopper_voltage = "540 V"\n[simulation]
        [simulation] => [supply]\nbus_voltage = "565 V"\nmains_voltage = "400 V"\n[simulation]
        [simulation] => [supply]\nmains_voltage = "400 V"\nmax_voltage = "500 V"\n[simulation]
        [simulation] => [supply]\nchopper_voltage = "900 V"\nmax_voltage = "800 V"\n[simulation]
        [simulation] => [tolerance]\n"slider.mass" = "5"\n[simulation]
    "#;
    mistakes("machine-rules", "press.toml", "size", edits);
    let edits = r#"
        at = "motor" => at = "motor"\ntorque = "3 N m"
        ["500 rpm" => ["900 rpm"
        output_step = "5 ms" => output_step = "5 us"
        rotor_inertia => tolerance = 1\nrotor_inertia
        [simulation] => [motion.simulation]
        at = "motor" => dc_motor = {}
        torque_speed = [ => dc_motor = { no_load_speed = "-900 rpm", stall_torque = "60 N m" }\n# [
        torque_speed = [ =>
            induction_motor = { synchronous_speed = "900 rpm", breakdown_torque = "60 N m", breakdown_slip = "120 %" }\n# [
        torque_speed = [ =>
            induction_motor = { synchronous_speed = "-900 rpm", breakdown_torque = "60 N m", rated_speed = "-870 rpm", rated_power = "2 kW" }\n# [
        torque_speed = [ =>
            induction_motor = { synchronous_speed = "900 rpm", breakdown_torque = "60 N m", rated_speed = "870 rpm", rated_power = "7 kW" }\n# [
        [simulation] => [simulation]\nstart_position = "0 mm"
    "#;
    mistakes("machine-simulations", "press.toml", "simulate", edits);
    let edits = r#"
        creep = { slip = "3 %", torque = "45 N m" } => creep = { slip = "3 %", torque = "45 N m" }\nslip = "2 %"
        creep = { slip = "3 %", torque = "45 N m" } => slip = "2 %"
        creep = { slip = "3 %", torque = "45 N m" } => power_flow = "input-drives"
        at = "3.4 s" => at = "1.6 s"
        creep = { slip = "3 %", torque = "45 N m" } => slip = "2 %"\npower_flow = "output-drives"
        creep = { slip = "3 %", torque = "45 N m" } =>
            creep = { curve = [["1 %", "20 N m"], ["2 %", "18 N m"], ["3 %", "45 N m"]] }
        ratio = 0.35 => ratio = "0.35 + 0.2*time"
        ratio = 0.35 => ratio = "0.35 - t"
        ratio = 0.35 => ratio = "0.35 + 0.1*sin(t)"
    "#;
    mistakes(
        "machine-variators",
        "variator-press.toml",
        "simulate",
        edits,
    );
}
