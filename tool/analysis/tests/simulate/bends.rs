//! Steps that end where the equations bend: against an integration of its own in closed form, and against a finer tolerance.

use std::f64::consts::TAU;
use std::path::Path;

use crate::reader;
use jred_analysis::simulate::{SimulationResult, simulate};
use jred_file::model::simulation::Simulation;

use crate::reading::parse;

/// A slider-crank behind a stage with losses; a heavy rotor lets the power through the stage turn twice in every turn.
fn lossy(rotor: f64) -> String {
    format!(
        r#"gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "slider-crank"
offset = "0 mm"
branch = "right"
flywheel = "0.02 kg m^2"
crank = {{ length = "50 mm", mass = "1 kg", inertia = "0.001 kg m^2", com = ["20 mm", "0 mm"] }}
rod = {{ length = "200 mm", mass = "1.5 kg", inertia = "0.006 kg m^2", com = ["80 mm", "0 mm"] }}
slider = {{ mass = "3 kg" }}
[[load]]
on = "slider"
viscous_force = "20 N s/m"
[[load]]
name = "guide"
on = "slider"
opposing_force = "15 N"
[[drive_train]]
type = "gear-train"
stage = [{{ driver = {{ teeth = 20, inertia = "1e-4 kg m^2" }}, driven = {{ teeth = 40, inertia = "1e-3 kg m^2" }}, efficiency = "93 %" }}]
[simulation]
start_angle = "0 deg"
duration = "1 s"
output_step = "0.1 s"
torque = "5 N m"
rotor_inertia = "{rotor} kg m^2"
"#
    )
}

/// The same machine in closed form.
struct Own {
    rotor: f64,
}

impl Own {
    /// [J, x′ of the slider, U] at φ.
    fn at(phi: f64) -> [f64; 3] {
        let (r, l, c) = (0.05, 0.2, 0.08);
        let (sin, cos) = phi.sin_cos();
        // sin β = −(r/l)·sin φ
        let s = -r / l * sin;
        let k = (1.0 - s * s).sqrt();
        let turn = -r / l * cos / k;
        let slider = -r * sin - l * s * turn;
        let com = [-r * sin - c * s * turn, r * cos + c * k * turn];
        let inertia = 0.02
            + 0.001
            + 0.02 * 0.02
            + 1.5 * (com[0] * com[0] + com[1] * com[1])
            + 0.006 * turn * turn
            + 3.0 * slider * slider;
        let potential = 9.81 * (0.02 * sin + 1.5 * (r * sin + c * s));
        [inertia, slider, potential]
    }

    /// α, and the torque that the stage delivers in the direction of motion.
    fn alpha(&self, [phi, omega]: [f64; 2], way: f64) -> [f64; 2] {
        let h = 1e-3;
        let derivative = |k: usize| {
            let at = |n: f64| Self::at(phi + n * h)[k];
            (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h)
        };
        let [inertia, slider, _] = Self::at(phi);
        let resisting = 0.5 * derivative(0) * omega * omega
            + derivative(2)
            + 20.0 * slider * slider * omega
            + 15.0 * slider.abs() * way;
        // ω_motor = −2·ω: 5 N m = (J·α + R)/(−2·η) − 2·(rotor + driver)·α, or with η in the place of 1/η.
        let (ratio, eta) = (-2.0, 0.93);
        let own = (self.rotor + 1e-4) * ratio;
        let solve = |loss: f64| {
            let alpha = (5.0 - resisting * loss / ratio) / ((inertia + 1e-3) * loss / ratio + own);
            (alpha, (inertia + 1e-3) * alpha + resisting)
        };
        let (alpha, delivered) = solve(1.0 / eta);
        if delivered * way >= 0.0 {
            return [alpha, delivered * way];
        }
        let (alpha, delivered) = solve(eta);
        [alpha, delivered * way]
    }

    fn step(&self, [phi, omega]: [f64; 2], h: f64, way: f64) -> [f64; 2] {
        let f = |[phi, omega]: [f64; 2]| [omega, self.alpha([phi, omega], way)[0]];
        let y = [phi, omega];
        let plus = |k: [f64; 2], h: f64| [y[0] + h * k[0], y[1] + h * k[1]];
        let a = f(y);
        let b = f(plus(a, 0.5 * h));
        let c = f(plus(b, 0.5 * h));
        let d = f(plus(c, h));
        let mean = |i: usize| (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]) / 6.0;
        plus([mean(0), mean(1)], h)
    }

    /// φ and ω after a second, by Runge and Kutta's method of order 4 whose steps end where the power turns or the slider does; and how often
    /// the power turns.
    fn after_a_second(&self) -> ([f64; 2], u32) {
        let way = -1.0;
        let (mut t, mut y, mut turned) = (0.0f64, [0.0, 0.0], 0);
        let sides = |y: [f64; 2]| [self.alpha(y, way)[1] > 0.0, Self::at(y[0])[1] > 0.0];
        let mut side = sides(self.step(y, 1e-9, way));
        while t < 1.0 {
            let h = 1e-5f64.min(1.0 - t);
            let whole = self.step(y, h, way);
            let mut end = h;
            if sides(whole) != side {
                let mut low = 0.0;
                for _ in 0..60 {
                    let middle = 0.5 * (low + end);
                    if sides(self.step(y, middle, way)) == side {
                        low = middle;
                    } else {
                        end = middle;
                    }
                }
            }
            y = self.step(y, end, way);
            t += end;
            let now = sides(y);
            turned += u32::from(now[0] != side[0]);
            side = now;
        }
        (y, turned)
    }
}

/// φ and ω at the end.
fn last(text: &str, tolerance: Option<f64>) -> [f64; 2] {
    let file = parse(text).unwrap();
    let own = file.simulation.clone().unwrap();
    let simulation = Simulation {
        tolerance: tolerance.unwrap_or(own.tolerance),
        ..own
    };
    let states = simulate(&file, &simulation).and_then(SimulationResult::whole_states);
    let [phi, omega, _] = *states.unwrap().last().unwrap();
    [phi, omega]
}

/// The speed is exact to 1e-9 where the power through a stage does not turn, and where it turns in every turn.
#[test]
fn a_stage_with_losses_is_followed_exactly() {
    for (rotor, turns) in [(0.0, false), (0.02, true)] {
        let text = lossy(rotor);
        let ([phi, omega], turned) = Own { rotor }.after_a_second();
        assert_eq!(turned > 4, turns, "{turned}");
        let [found, fine] = [None, Some(1e-13)].map(|tolerance| last(&text, tolerance));
        for (what, [a, b]) in [("default", found), ("1e-13", fine)] {
            assert!((a / phi - 1.0).abs() < 1e-9, "{rotor} {what}: {a} {phi}");
            assert!(
                (b / omega - 1.0).abs() < 1e-9,
                "{rotor} {what}: {b} {omega}"
            );
        }
        assert!(
            (found[1] / fine[1] - 1.0).abs() < 1e-9,
            "{found:?} {fine:?}"
        );
    }
}

/// Every shipped machine with a simulation: positions and speeds by default are those of a finer tolerance to 1e-9 of the largest.
#[test]
fn the_default_tolerance_is_fine_enough() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let mut seen = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let file = reader::read(&path).unwrap();
        let Some(own) = file.simulation.clone().filter(|own| own.torque.is_some()) else {
            continue;
        };
        let states = |tolerance: f64| {
            let simulation = Simulation {
                tolerance,
                ..own.clone()
            };
            simulate(&file, &simulation).unwrap().states
        };
        let [rough, fine] = [own.tolerance, 1e-13].map(states);
        assert_eq!(rough.len(), fine.len(), "{}", file.name);
        for k in 0..2 {
            let most = fine
                .iter()
                .fold(1e-3f64, |most, state| most.max(state[k].abs()));
            for (a, b) in rough.iter().zip(&fine) {
                let off = (a[k] - b[k]).abs() / most;
                assert!(off < 1e-9, "{}: {off:e}", file.name);
            }
        }
        seen += 1;
    }
    assert!(seen > 10, "{seen}");
}

/// A load that comes again every second turn: its work is that of one window in two turns.
#[test]
fn a_load_over_two_turns() {
    let text = format!(
        "{}[simulation]\nstart_angle = \"0 deg\"\nstart_speed = \"600 rpm\"\nduration = \"0.4 s\"\noutput_step = \"0.1 s\"\ntorque = \"0.001 N m\"\n",
        r#"gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "gear-train"
[[mechanism.stage]]
driver = { teeth = 20, inertia = "5 kg m^2" }
driven = { teeth = 20, inertia = "0 kg m^2" }
[[load]]
on = "shaft-1"
moment = "8 N m"
between = ["340 deg", "500 deg"]
ramp = "20 deg"
turns = 2
"#
    );
    let found = super::simulate(&text);
    let work = found.get("process work [J]");
    // The 3-4-5 ramps have half of their width: 8 N m over 140°, twice in 0.4 s = 4 turns.
    let each = 8.0 * 140.0 / 360.0 * TAU;
    let last = *work.last().unwrap();
    assert!((last / (2.0 * each) - 1.0).abs() < 1e-9, "{last} {each}");
    // After 0.1 s, one turn, the window has opened by 20°: its ramp, half of it.
    assert!(
        (work[1] / (8.0 * 10.0 / 360.0 * TAU) - 1.0).abs() < 0.05,
        "{}",
        work[1]
    );
}

/// A press force against the motion is work of the process, friction of a guide a loss.
#[test]
fn a_press_force_is_no_loss() {
    let text = r#"gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "gear-train"
[[mechanism.stage]]
driver = { teeth = 20, inertia = "5 kg m^2" }
driven = { teeth = 20, inertia = "0 kg m^2" }
[[load]]
on = "shaft-1"
opposing_moment = "30 N m"
between = ["90 deg", "180 deg"]
ramp = "10 deg"
[[load]]
name = "bearing"
on = "shaft-1"
opposing_moment = "2 N m"
[simulation]
start_angle = "0 deg"
start_speed = "600 rpm"
duration = "0.5 s"
output_step = "0.1 s"
torque = "0.001 N m"
"#;
    let found = super::simulate(text);
    let file = parse(text).unwrap();
    let states = simulate(&file, file.simulation.as_ref().unwrap())
        .unwrap()
        .states;
    let [way, ..] = *states.last().unwrap();
    let [process, losses] =
        ["process work [J]", "losses [J]"].map(|name| *found.get(name).last().unwrap());
    assert!((losses / (2.0 * way) - 1.0).abs() < 1e-9, "{losses} {way}");
    // Whole windows of 80° by half their ramps: one has passed after half of a turn.
    let turns = (way / TAU + 0.5).floor();
    assert!(
        (process / (-30.0 * 80.0 / 360.0 * TAU * turns) - 1.0).abs() < 1e-9,
        "{process} {turns}"
    );
}
