//! End stops, switching off, brakes.

use super::{J, imbalance, simulate, turntable};
use crate::reading::parse;
use crate::support::{budget, near, within};

/// A table on a slide that a constant force pushes, without friction.
fn slide(simulation: &str) -> String {
    format!(
        r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "linkage"
drive = "slide"
stroke = ["0 mm", "1000 mm"]
ground = {{ P = ["-100 mm", "0 mm"] }}
body = [{{ name = "table", mass = "2 kg", inertia = "0 kg m^2" }}]
joint = [{{ name = "slide", type = "prismatic", between = ["ground", "table"], direction = "0 deg" }}]
[simulation]
start_position = "100 mm"
output_step = "10 ms"
{simulation}
"#
    )
}

/// 4 N on 2 kg: 0.9 m to the stop, bounces of restitution ½ whose flights halve, and rest after t₁·(1 + 2·e/(1 − e)) = 3·t₁.
#[test]
fn a_bouncing_slide_comes_to_rest_at_its_stop() {
    let alpha: f64 = 2.0;
    let first = (2.0 * 0.9 / alpha).sqrt();
    let text = slide(
        "duration = \"3 s\"\nforce = \"4 N\"\nend_stops = { at = [\"0 mm\", \"1000 mm\"], restitution = 0.5 }",
    );
    let found = simulate(&text);
    let speeds = found.get("v [m/s]");
    for ((t, s), v) in found
        .get("t [s]")
        .iter()
        .zip(found.get("s [mm]"))
        .zip(&speeds)
    {
        let s = s / 1000.0;
        let (mut from, mut speed, mut flight) = (first, 0.5 * alpha * first, first);
        if *t <= first {
            within("position", s, 0.1 + 0.5 * alpha * t * t, budget::STANDSTILL);
            continue;
        }
        while *t > from + flight && flight > 1e-6 {
            from += flight;
            speed *= 0.5;
            flight *= 0.5;
        }
        let since = (t - from).min(flight);
        let resting = flight <= 1e-6;
        let expected = if resting {
            1.0
        } else {
            1.0 - speed * since + 0.5 * alpha * since * since
        };
        within(
            "position after the stop",
            s,
            expected,
            budget::CLOSED_MOTION,
        );
        if resting {
            assert_eq!(*v, 0.0, "at t = {t}");
        }
    }
    assert_eq!(speeds.last(), Some(&0.0));
    assert!(imbalance(&found) < budget::BALANCE);
    let file = parse(&text).unwrap();
    let whole =
        jred_analysis::simulate::simulate(&file, file.simulation.as_ref().unwrap()).unwrap();
    let impacts = whole.impacts.unwrap();
    near("first impact", impacts.time, first, budget::CLOSED_MOTION);
    near(
        "its speed",
        impacts.speed,
        alpha * first,
        budget::CLOSED_MOTION,
    );
    within("its place", impacts.position, 1.0, budget::CLOSED_MOTION);
    // Flights of 2⁻ᵏ of the first down to a microsecond: the one of 2⁻²⁰ is none.
    assert!((19..=22).contains(&impacts.count), "{}", impacts.count);
    assert!(impacts.settled, "the rest of the series is left out");
    let soon = text.replace("\"3 s\"", "\"2 s\"");
    let file = parse(&soon).unwrap();
    let begun =
        jred_analysis::simulate::simulate(&file, file.simulation.as_ref().unwrap()).unwrap();
    assert!(!begun.impacts.unwrap().settled, "it still bounces");
    // All of the work is lost in impacts.
    let lost = found.get("losses [J]");
    near(
        "impacts",
        *lost.last().unwrap(),
        4.0 * 0.9,
        budget::CLOSED_MOTION,
    );
}

/// Against a stop without restitution it stays while the push is greater than the pull of a spring, and swings back about the spring's
/// free length once the motor is switched off.
#[test]
fn a_stop_holds_what_is_pushed_against_it() {
    let text = slide(
        "duration = \"2 s\"\nforce = \"4 N\"\nend_stops = { at = [\"0 mm\", \"600 mm\"] }\nstop = { time = \"1.5 s\" }",
    ) + "[[spring]]\nbetween = [\"ground.P\", \"table\"]\nstiffness = \"4 N/m\"\nfree_length = \"150 mm\"\n";
    let found = simulate(&text);
    let rows = found.get("t [s]").into_iter().zip(found.get("s [mm]"));
    for (t, s) in rows.filter(|(t, _)| *t >= 1.3) {
        let swing = (2.0f64.sqrt() * (t - 1.5).max(0.0)).cos();
        within(
            "position",
            s / 1000.0,
            0.05 + 0.55 * swing,
            budget::CLOSED_MOTION,
        );
    }
    assert!(imbalance(&found) < budget::BALANCE);
}

/// Coasting under friction M: ω₀·J/M, and half that times ω₀. With a brake behind the belt M + i·T_b, once it has closed.
#[test]
fn a_machine_that_is_switched_off_coasts_or_brakes() {
    let (omega, friction) = (20.0, 2.0);
    let brakes = [
        ("", 0.0, 0.0),
        (", brake_torque = \"1 N m\"", 1.0, 0.0),
        (
            ", brake_torque = \"1 N m\", brake_delay = \"50 ms\"",
            1.0,
            0.05,
        ),
    ];
    for (brake, torque, delay) in brakes {
        let train = r#"
[[load]]
on = "shaft-1"
opposing_moment = "2 N m"
[[drive_train]]
type = "belt"
driver = { radius = "20 mm", inertia = "0 kg m^2" }
driven = { radius = "60 mm", inertia = "0 kg m^2" }
"#;
        // Two thirds of the friction at the motor keep the speed until it is switched off.
        let text = turntable(
            train,
            &format!(
                "start_speed = \"20 rad/s\"\nduration = \"4 s\"\noutput_step = \"0.1 s\"\ntorque = \"{} N m\"\nstop = {{ time = \"0.35 s\"{brake} }}",
                friction / 3.0
            ),
        );
        let file = parse(&text).unwrap();
        let found =
            jred_analysis::simulate::simulate(&file, file.simulation.as_ref().unwrap()).unwrap();
        let rest = found.rest.unwrap();
        let coasting = if torque == 0.0 {
            omega * J / friction
        } else {
            delay
        };
        let slower = omega - friction / J * coasting;
        let braking = slower * J / (friction + 3.0 * torque);
        let way = omega.midpoint(slower) * coasting + 0.5 * slower * braking;
        near("time", rest.time, coasting + braking, budget::CLOSED_MOTION);
        near("way", rest.way, way, budget::CLOSED_MOTION);
        assert!(found.ended.is_none());
        // The motor's work until then, and the brake's: neither is in the other.
        let last = found.columns.rows().last().unwrap();
        let names = found.columns.names();
        let work = |name: &str| Some(last[names.iter().position(|own| own == name)?].unwrap());
        let given = friction * omega * 0.35;
        near(
            "motor",
            work("motor work [J]").unwrap(),
            given,
            budget::CLOSED_MOTION,
        );
        let taken = (torque > 0.0).then(|| -3.0 * torque * 0.5 * slower * braking);
        assert_eq!(work("brake work [J]").is_some(), taken.is_some());
        if let (Some(found), Some(taken)) = (work("brake work [J]"), taken) {
            near("brake", found, taken, budget::CLOSED_MOTION);
        }
        let rest = work("energy balance [J]").unwrap();
        within("balance", rest, 0.0, budget::BALANCE * given);
    }
}

/// A mass on a rope, wound upwards at 20 rad/s: when the motor is switched off, it stops after ω·J/M and falls back. A brake that closes later
/// holds it; without one it does not come to rest.
#[test]
fn what_is_not_held_turns_back() {
    let (omega, weight) = (20.0, 5.0);
    for (brake, held) in [
        ("", false),
        (", brake_torque = \"50 N m\", brake_delay = \"2 s\"", true),
    ] {
        let load = format!("[[load]]\non = \"shaft-1\"\nmoment = \"-{weight} N m\"\n");
        let simulation = format!(
            "start_speed = \"20 rad/s\"\nduration = \"4 s\"\noutput_step = \"0.1 s\"\ntorque = \"{weight} N m\"\nstop = {{ time = \"0.35 s\"{brake} }}"
        );
        let file = parse(&turntable(&load, &simulation)).unwrap();
        let found =
            jred_analysis::simulate::simulate(&file, file.simulation.as_ref().unwrap()).unwrap();
        let stops = omega * J / weight;
        let first = found.turned_back.unwrap();
        near("time", first.time, stops, budget::CLOSED_MOTION);
        near("way", first.way, 0.5 * omega * stops, budget::CLOSED_MOTION);
        assert_eq!(found.rest.is_some(), held);
        if let Some(rest) = found.rest {
            // It falls until the brake closes, which stops it.
            let falls = 2.0 - stops;
            let fall = 0.5 * weight / J * falls * falls;
            let braking = weight * falls / (50.0 - weight);
            let way = 0.5 * omega * stops - fall - 0.5 * weight / J * falls * braking;
            near("time", rest.time, 2.0 + braking, budget::CLOSED_MOTION);
            near("way", rest.way, way, budget::CLOSED_MOTION);
        }
    }
}
