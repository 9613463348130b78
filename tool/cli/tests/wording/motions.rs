//! Output of the commands that follow or compute a motion.

use super::{Desk, compare};

/// A screw that reaches the end of its stroke before it is switched off.
const SCREW: &str = r#"title = "spindle"
gravity = { inclination = "0 deg" }
[mechanism]
type = "ball-screw"
lead = "10 mm"
stroke = ["-40 mm", "400 mm"]
[mechanism.screw]
inertia = "5 kg cm^2"
[mechanism.nut]
mass = "100 kg"
[simulation]
start_angle = "0 deg"
duration = "3 s"
output_step = "1 s"
"#;

/// A press that turns the wrong way: its blanking force drives it.
const BACKWARDS: &str = r#"title = "backwards"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "slider-crank"
flywheel = "6 kg m^2"
crank = { length = "60 mm", mass = "60 kg", inertia = "0.4 kg m^2" }
rod = { length = "420 mm", mass = "45 kg", inertia = "1.1 kg m^2", com = ["140 mm", "0 mm"] }
slider = { mass = "250 kg" }
[[load]]
name = "blanking"
on = "slider"
force = ["-1.2 kN", "0 N"]
between = ["335 deg", "358 deg"]
ramp = "4 deg"
[[load]]
on = "crank"
viscous_moment = "2 N m s/rad"
[simulation]
start_angle = "180 deg"
start_speed = "-100 rpm"
duration = "2 s"
output_step = "1 s"
torque_speed = [["-110 rpm", "0 N m"], ["-90 rpm", "-700 N m"], ["0 rpm", "-700 N m"]]
"#;

#[test]
fn simulate() {
    let short = |name: &str| {
        let text = Desk::machine(name).replacen("\"5 ms\"", "\"400 ms\"", 1);
        text.replacen("\"10 ms\"", "\"1 s\"", 1)
    };
    let lift = Desk::machine("pick-and-place.toml").replacen("\"5 ms\"", "\"300 ms\"", 1);
    let punched = "[[load]]\nname = \"punch\"\non = \"slider\"\nforce = [\"-1 N\", \"0 N\"]\ndirection = \"forward\"\n\
        [motion]\ntype = \"constant-speed\"\nspeed = \"60 rpm\"\n";
    let desk = Desk::new()
        .with("press.toml", short("press.toml"))
        .with("variator-press.toml", short("variator-press.toml"))
        .with("lift.toml", lift)
        .with(
            "variator-punch.toml",
            format!("{}\n{punched}", short("variator-press.toml")),
        )
        .with("gripper.toml", Desk::machine("linear-gripper.toml"))
        .with("never-off.toml", format!("{SCREW}torque = \"1 N m\"\nstop = {{ time = \"2 s\", brake_torque = \"1 N m\" }}\n"))
        .with(
            "drop.toml",
            format!("{SCREW}torque = \"0 N m\"\nstart_speed = \"-100 rad/s\"\nend_stops = {{ at = [\"-1000 deg\", \"9000 deg\"], restitution = 0.5 }}\n")
                .replace("0 deg\" }", "-30 deg\" }"),
        )
        .with("backwards.toml", BACKWARDS)
        .with(
            "axis.toml",
            Desk::machine("vertical-axis.toml").replace("output_step = \"5 ms\"", "output_step = \"100 ms\""),
        )
        .with(
            "weak.toml",
            short("press.toml").replace("torque_speed = [[\"0 rpm\", \"60 N m\"], [\"500 rpm\", \"45 N m\"], [\"800 rpm\", \"0 N m\"]]", ""),
        );
    let commands = "
        simulate press.toml
        simulate variator-press.toml
        simulate axis.toml
        simulate axis.toml --drive sgmsh-10a
        simulate axis.toml --drive sgmah-a3a --format json
        simulate weak.toml
        simulate weak.toml --drive sgmsh-10a --reactions --format csv
        simulate weak.toml --drive sgmsh-10a
        simulate weak.toml --drive none
        simulate variator-press.toml --drive sgmsh-10a
        steady weak.toml
        simulate press.toml press.toml --phase '90 deg'
        simulate press.toml press.toml --phase 90
        simulate press.toml --phase '90 deg'
        simulate press.toml gripper.toml
        simulate press.toml --drive sgm7j-a5a
        simulate lift.toml
        simulate never-off.toml
        simulate drop.toml
        simulate backwards.toml
        simulate variator-punch.toml
        steady lift.toml
    ";
    compare("simulate", &desk.runs(commands));
}

#[test]
fn steady() {
    let desk = Desk::new().with_machines(&["eccentric-press.toml", "press.toml"]);
    let commands = "
        steady eccentric-press.toml --positions 6
        steady eccentric-press.toml --delta 0.05 --positions 4
        steady press.toml --delta 0.9 --positions 4
        steady press.toml --torque '-20 N m' --positions 4
    ";
    compare("steady", &desk.runs(commands));
}

/// Moves of a motion with a drive of the catalogue, a single move with plain limits, and impossible moves.
#[test]
fn fastest() {
    let desk = Desk::new().with_machines(&[
        "press.toml",
        "hoist.toml",
        "conveyor.toml",
        "linear-gripper.toml",
        "variator-press.toml",
        "line-shaft.toml",
    ]);
    let commands = "
        fastest press.toml --catalogue drives
        fastest press.toml --catalogue drives --drive sgmsh-15a+npt025mf-5 --profile p.csv --cam c.csv
        fastest press.toml --torque '20 N m' --motor-speed '3000 rpm' --from '180 deg' --to '300 deg' --max-speed '100 rpm' \
            --max-acceleration '80 rad/s^2'
        fastest press.toml --torque '20 N m' --motor-speed '3000 rpm' --from '180 deg' --to '300 deg' --format csv --instants 2
        fastest press.toml --torque '20 N m' --motor-speed '3000 rpm' --from '180 deg' --to '300 deg' --format json --instants 2
        fastest press.toml --torque '0.1 N m' --motor-speed '3000 rpm' --from '180 deg' --to '300 deg'
        fastest hoist.toml --torque '2 N m' --motor-speed '3000 rpm'
        fastest press.toml --torque '20 N m' --motor-speed '3000 rpm' --from '180 deg' --to '300 deg' --from-speed '2000 rpm'
        fastest press.toml --torque '20 N m' --motor-speed '3000 rpm' --from '180 deg' --to '300 deg' --to-speed '2000 rpm'
        fastest press.toml --torque '20 N m' --motor-speed '3000 rpm' --from '10 deg' --to '10 deg'
        fastest press.toml --torque '20 N m' --motor-speed '3000 rpm' --from '10 deg'
        fastest press.toml --torque '20 N m' --motor-speed '3000 rpm' --from '10 mm' --to '20 mm'
        fastest press.toml --torque '20 N m' --motor-speed '3000 rpm' --from '180 deg' --to '300 deg' '--from-speed=-2 rpm'
        fastest press.toml --torque '-1 N m' --motor-speed '3000 rpm'
        fastest press.toml --catalogue drives --drive sgmsh-15b
        fastest conveyor.toml --torque '20 N m' --motor-speed '3000 rpm'
        fastest conveyor.toml --max-jerk '1e6 rad/s^3' --torque '20 N m' --motor-speed '3000 rpm'
        fastest press.toml --ends zero --torque '20 N m' --motor-speed '3000 rpm' --from '180 deg' --to '300 deg'
        fastest press.toml --max-rms s1 --torque '20 N m' --motor-speed '3000 rpm' --from '180 deg' --to '300 deg'
        fastest press.toml --max-rms '0.5 N m' --torque '20 N m' --motor-speed '3000 rpm' --from '180 deg' --to '300 deg'
        fastest press.toml --max-torque-rate '3 rpm' --torque '20 N m' --motor-speed '3000 rpm' --from '180 deg' --to '300 deg'
        fastest variator-press.toml --torque '20 N m' --motor-speed '3000 rpm'
        fastest line-shaft.toml --torque '20 N m' --motor-speed '3000 rpm'
    ";
    compare("fastest", &desk.runs(commands));
}

/// A press that is slow through the work, and invalid limits of a tool.
#[test]
fn slow_through_the_work() {
    let desk = Desk::new().with_machines(&["press.toml"]);
    let commands = "
        fastest press.toml --torque '500 N m' --motor-speed '90 rpm' --from '180 deg' --to '540 deg' \
            --max-tool-speed 'slider, 60 mm/s, 300 deg, 360 deg'
        fastest press.toml --torque '500 N m' --motor-speed '90 rpm' --from '180 deg' --to '540 deg' \
            --max-tool-speed 'slidr, 60 mm/s, 300 deg, 360 deg'
        fastest press.toml --torque '500 N m' --motor-speed '90 rpm' --from '180 deg' --to '540 deg' \
            --max-tool-speed 'slider, 60 mm/s, 300 deg'
        fastest press.toml --torque '500 N m' --motor-speed '90 rpm' --from '180 deg' --to '540 deg' \
            --max-tool-speed 'slider, 60 rpm, 300 deg, 360 deg'
        fastest press.toml --torque '500 N m' --motor-speed '90 rpm' --from '180 deg' --to '540 deg' \
            --max-tool-speed 'slider, 0 mm/s, 300 deg, 360 deg'
        fastest press.toml --torque '500 N m' --motor-speed '90 rpm' --from '180 deg' --to '540 deg' \
            --max-tool-speed 'slider, 60 mm/s, 300 deg, 300 deg'
        fastest press.toml --torque '500 N m' --motor-speed '90 rpm' --from '180 deg' --to '540 deg' \
            --max-tool-speed 'slider, 60 mm/s, 30 deg, 300 deg'
        fastest press.toml --torque '500 N m' --motor-speed '90 rpm' --from '180 deg' --to '540 deg' \
            --max-tool-speed 'slider, 60 mm/s, 300 deg, 30 deg'
        fastest press.toml --torque '500 N m' --motor-speed '90 rpm' --from '180 deg' --to '540 deg' \
            --max-tool-speed 'slider, 0.2 m/s, 270 deg, 320 deg' --max-tool-speed 'slider, 60 mm/s, 320 deg, 360 deg'
        fastest press.toml --torque '500 N m' --motor-speed '90 rpm' --from '180 deg' --to '540 deg' \
            --max-reaction 'crank pin=4 kN' --max-reaction 'crank pin=5 kN'
    ";
    compare("fastest-tool-speed", &desk.runs(commands));
}

/// On an axis in mm the range is in mm or in degrees, either end first; a named drive and all options are in answer and page; limits may be in
/// capitals; an endless motion has no end to hold.
#[test]
fn fastest_says_what_was_asked() {
    let press = Desk::machine("press.toml");
    let (before, rest) = press.split_once("[motion]").unwrap();
    let (_, after) = rest.split_once("# Start from rest").unwrap();
    let turns = "[motion]\ntype = \"constant-speed\"\nspeed = \"90 rpm\"\n\n#";
    let axis = Desk::machine("vertical-axis.toml");
    let desk = Desk::new()
        .with("press.toml", press.clone())
        .with("turning.toml", [before, turns, after].concat())
        .with(
            "axis.toml",
            axis.replace(
                "lead = \"10 mm\"",
                "lead = \"10 mm\"\nstroke = [\"-400 mm\", \"10 mm\"]",
            )
            .replace("along = \"x\" }", "along = \"x\" }\nstart = \"0 mm\""),
        )
        .with("endless.toml", axis);
    let commands = "
        fastest turning.toml --torque '20 N m' --motor-speed '2000 rpm'
        fastest axis.toml --torque '20 N m' --motor-speed '2000 rpm' --from '0 mm' --to '-300 mm' \
            --max-tool-speed 'nut, 0.1 m/s, -200 mm, -100 mm'
        fastest axis.toml --torque '20 N m' --motor-speed '2000 rpm' --from '0 mm' --to '-300 mm' \
            --max-tool-speed 'nut, 0.1 m/s, -100 mm, -200 mm'
        fastest axis.toml --torque '20 N m' --motor-speed '2000 rpm' --from '0 mm' --to '-300 mm' \
            --max-tool-speed 'nut, 0.1 m/s, -7200 deg, -3600 deg'
        fastest axis.toml --torque '20 N m' --motor-speed '2000 rpm' --from '0 mm' --to '-300 mm' \
            --max-tool-speed 'nut, 0.1 m/s, -100 mm, -2 m'
        fastest endless.toml --torque '20 N m' --motor-speed '2000 rpm' --from '0 mm' --to '-300 mm' \
            --max-tool-speed 'nut, 0.1 m/s, -200 mm, -100 mm'
        fastest endless.toml --torque '20 N m' --motor-speed '2000 rpm' --from '0 mm' --to '-300 mm' \
            --max-tool-speed 'nut, 0.1 m/s, -200 mm, 40 deg'
        fastest press.toml --drive sgm7a-25a+npt025mf-4 --reserve RULES --max-speed '400 rpm'
        fastest turning.toml --torque '20 N m' --motor-speed '2000 rpm' --from '0 deg' --to '90 deg' --max-rms S1
    ";
    compare("fastest-asked", &desk.runs(commands));
}

#[test]
fn fastest_within_the_force_of_a_joint() {
    let desk = Desk::new().with_machines(&["press.toml", "scotch-yoke.toml"]);
    let commands = "
        fastest scotch-yoke.toml --torque '80 N m' --motor-speed '1500 rpm' --from '30 deg' --to '400 deg' \
            --max-reaction 'pin in the slot=1 kN'
        fastest scotch-yoke.toml --torque '80 N m' --motor-speed '1500 rpm' --from '30 deg' --to '400 deg' \
            --max-reaction 'pin in the slot=1 kN' --max-reaction 'guide=20 N'
        fastest scotch-yoke.toml --torque '80 N m' --motor-speed '1500 rpm' --from '30 deg' --to '400 deg' \
            --max-reaction 'pin in the slot'
        fastest scotch-yoke.toml --torque '80 N m' --motor-speed '1500 rpm' --from '30 deg' --to '400 deg' \
            --max-reaction 'pin=1 kN'
        fastest scotch-yoke.toml --torque '80 N m' --motor-speed '1500 rpm' --from '30 deg' --to '400 deg' \
            --max-reaction 'guide=1 N m'
        fastest scotch-yoke.toml --torque '80 N m' --motor-speed '1500 rpm' --from '30 deg' --to '400 deg' \
            --max-reaction 'guide=1 kN' --max-jerk '1e5 rad/s^3'
    ";
    compare("fastest-joint-force", &desk.runs(commands));
}

/// A motor without thermal data, and one with all, named in another case than the catalogue's.
#[test]
fn fastest_with_a_warm_winding() {
    let cat = include_str!("../../../../examples/data/thermal-drive.toml");
    let desk = Desk::new()
        .with_machines(&["press.toml", "eccentric-press.toml"])
        .with("warm.toml", cat);
    // Without a pause.
    let commands = "
        fastest press.toml --catalogue warm.toml --drive WARM-1+Box-4 --max-winding-temperature '110 degC'
        fastest press.toml --catalogue warm.toml --drive WARM-1+Box-4 --max-winding-temperature '110 degC' --format json \
            --instants 2
        fastest press.toml --catalogue warm.toml --drive WARM-1+Box-4 --max-winding-temperature '250 degC'
        fastest press.toml --catalogue warm.toml --drive WARM-1+Box-4 --max-winding-temperature '30 degC'
        fastest press.toml --catalogue warm.toml --drive WARM-1+Box-4 --max-winding-temperature '-5 K'
        fastest press.toml --catalogue warm.toml --drive WARM-1+Box-4 --max-winding-temperature '110 C'
        fastest eccentric-press.toml --catalogue warm.toml --drive WARM-1+Box-4 --max-winding-temperature '60 degC'
        fastest press.toml --catalogue warm.toml --drive WARM-1+Box-4 --max-winding-temperature '230 degF'
        fastest press.toml --torque '20 N m' --motor-speed '3000 rpm' --max-winding-temperature '110 degC'
        fastest press.toml --drive sgm7a-25a+npt025mf-4 --max-winding-temperature '110 degC'
    ";
    compare("fastest-winding", &desk.runs(commands));
}

#[test]
fn gentlest() {
    let machines = ["press.toml", "vertical-axis.toml", "scotch-yoke.toml"];
    let desk = Desk::new().with_machines(&machines);
    let commands = "
        gentlest press.toml --steps 500
        gentlest press.toml --steps 500 --drive sgmsh-30a+npt025mf-5 --catalogue drives
        gentlest press.toml --steps 500 --drive sgmsh-30a+npt025mf-5 --catalogue drives --objective peak
        gentlest press.toml --steps 500 --ends zero --ramp '5 %'
        gentlest vertical-axis.toml --steps 500 --profile motion.csv --cam cam.csv
        gentlest scotch-yoke.toml --steps 500
    ";
    compare("gentlest", &desk.runs(commands));
}

#[test]
fn balance() {
    let press = Desk::machine("press.toml");
    let (still, _) = press.split_once("# One turn from top").unwrap();
    let masses =
        |on: &str, rest: &str| format!("{press}\n[[mass]]\non = \"{on}\"\nmass = \"2 kg\"\n{rest}");
    let desk = Desk::new()
        .with_machines(&["press.toml", "linkage-four-bar.toml"])
        .with("no-motion.toml", still)
        .with("for-a-while.toml", masses("crank", "segments = [1]\n"))
        .with("nowhere.toml", masses("wheel", ""));
    let commands = "
        balance press.toml --steps 200 --counterweight 'crank, 40 kg, 200 mm'
        balance press.toml --steps 200 --counterweight 'crank, 40 kg, 200 mm' --least peak
        balance linkage-four-bar.toml --steps 200 --spring counterbalance --least holding
        balance linkage-four-bar.toml --steps 200 --spring counterbalance --format json
        balance press.toml --steps 200 --counterweight 'crank, 40 kg'
        balance press.toml --steps 200 --counterweight 'wheel, 40 kg, 200 mm'
        balance press.toml --steps 200 --counterweight 'crank, 40 mm, 200 mm'
        balance press.toml --steps 200 --counterweight 'crank, 40 kg, 200 mm' --counterweight 'crank, 40 kg, 200 mm'
        balance press.toml --steps 200 --counterweight 'crank, 40 kg, 200 mm' --least inertia
        balance press.toml --steps 200 --spring none
        balance linkage-four-bar.toml --steps 200 --spring none
        balance no-motion.toml --steps 200 --counterweight 'crank, 40 kg, 200 mm'
        balance press.toml
        check for-a-while.toml
        check nowhere.toml
    ";
    compare("balance", &desk.runs(commands));
}
