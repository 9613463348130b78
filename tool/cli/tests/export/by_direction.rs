//! Friction by direction of motion: exact in both directions in the tables of every number type.

use jred::number::{Number, Quantity};
use jred::table::{AccelerationOf, Format, SpeedOf, TorqueOf};
use jred::{CurveSet, Image, Phase, Rows16, Spline, curves};

use super::{export_of, words_of};
use crate::support::{Folder, shipped, typed};

const TABLE: &str = include_str!("friction_by_direction.toml");
/// A motion in both directions.
const BOTH_WAYS: &str = "type = \"cycle\"\n\
    [[motion.segment]]\nlaw = \"modified-sine\"\nmove = \"90 deg\"\nduration = \"0.5 s\"\n\
    [[motion.segment]]\nlaw = \"modified-sine\"\nmove = \"-90 deg\"\nduration = \"0.5 s\"";
/// m·d²/8 of the table.
const INERTIA: f64 = 20.0 * 0.3 * 0.3 / 8.0;
const SET: CurveSet = curves::LOAD | curves::CONSTANT_COULOMB;
/// Curves of a slider whose friction depends on the position.
const SLIDER: CurveSet = curves::LOAD | curves::COULOMB;

fn of<Q: Quantity>(value: f64) -> Q {
    Q::of(Q::Number::from_f64(value).unwrap())
}

/// The largest torque error (N·m) of a model against `exact` (of phase, speed and acceleration) over both directions.
fn worst<F: Format, const SET: CurveSet>(
    words: &[u32],
    [omega, alpha]: [f64; 2],
    exact: impl Fn(f64, f64, f64) -> f64,
) -> f64
where
    SpeedOf<F>: Quantity,
{
    let image = Image::new(words).unwrap();
    let model = image.model::<F, SET>().unwrap();
    let scale = image.scale();
    let [torque, speed] = [scale.torque(), scale.speed()].map(f64::from);
    let acceleration = f64::from(scale.acceleration());
    let mut worst = 0.0_f64;
    for k in 0..720 {
        let phase = Phase::from_bits(k * 5_965_233);
        for [way, rise] in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            let omega: SpeedOf<F> = of(way * omega / speed);
            let alpha: AccelerationOf<F> = of(rise * alpha / acceleration);
            let found: TorqueOf<F> = model.torque(phase, omega, alpha);
            let expected = exact(
                phase.radians(),
                omega.number().to_f64() * speed,
                alpha.number().to_f64() * acceleration,
            );
            worst = worst.max((found.number().to_f64() * torque - expected).abs());
        }
    }
    worst
}

/// T = J·α + 2 N·m forwards, − 3 N·m backwards.
#[test]
fn a_joint_has_its_friction_in_both_directions() {
    let folder = Folder::new();
    let file = folder.path("joint.toml");
    std::fs::write(&file, TABLE).unwrap();
    let exact =
        |_: f64, omega: f64, alpha: f64| INERTIA * alpha + if omega > 0.0 { 2.0 } else { -3.0 };
    let image = |kind: &str, layout: &str| {
        let out = folder.path("joint.jred");
        let more = typed("--torque-error '0.01 N m' --omega '4 rad/s' --alpha '20 rad/s^2'");
        let kind = ["--type", kind, "--layout", layout];
        let run = export_of(&file, &[&more[..], &kind].concat(), Some(&out)).ends(0);
        assert!(run.out.contains("loads by direction: "), "{}", run.out);
        words_of(&out)
    };
    let most = [3.9, 19.0];
    assert!(worst::<Spline<f32>, SET>(&image("f32", "spline"), most, exact) < 1e-5);
    assert!(worst::<Spline<jred::Q31>, SET>(&image("i32", "spline"), most, exact) < 1e-5);
    assert!(worst::<Rows16, SET>(&image("i16", "rows"), most, exact) < 0.01);
}

/// A slider: F·|dx/dφ| in closed form with x = r·cos φ + √(l² − r²·sin² φ).
#[test]
fn a_slider_has_its_friction_in_both_directions() {
    let folder = Folder::new();
    let file = folder.path("slider.toml");
    let feeder = std::fs::read_to_string(shipped("shaking-feeder.toml")).unwrap();
    let text = feeder
        .replace(
            "[\"0 m/s^2\", \"-9.81 m/s^2\"]",
            "[\"0 m/s^2\", \"0 m/s^2\"]",
        )
        .replace("offset = \"20 mm\"", "offset = \"0 mm\"")
        .replace(
            "viscous_force = \"60 N s/m\"",
            "opposing_force = \"90 N\"\ndirection = \"backward\"",
        )
        .replace(
            "opposing_force = \"40 N\"",
            "opposing_force = \"40 N\"\ndirection = \"forward\"",
        )
        .replace("type = \"constant-speed\"\nspeed = \"240 rpm\"", BOTH_WAYS);
    std::fs::write(&file, text).unwrap();
    let out = folder.path("slider.jred");
    let more =
        typed("--torque-error '0.01 N m' --layout cubic --omega '2 rad/s' --alpha '1 rad/s^2'");
    export_of(&file, &more, Some(&out)).ends(0);
    // Slowly: ½·J′·ω² is below 1e-6 N·m.
    let (radius, length) = (0.025_f64, 0.14_f64);
    let exact = |phi: f64, omega: f64, _: f64| {
        let (sin, cos) = phi.sin_cos();
        let slope =
            radius * sin * (1.0 + radius * cos / (length * length - (radius * sin).powi(2)).sqrt());
        let force = if omega > 0.0 { 40.0 } else { -90.0 };
        force * slope.abs() + 0.3 * omega.signum()
    };
    let found = worst::<jred::Cubic<f32>, SLIDER>(&words_of(&out), [1e-3, 0.0], exact);
    assert!(found < 0.01, "{found}");
    // The closed form has only one friction.
    let more = typed(
        "--torque-error '0.01 N m' --layout slider-crank --omega '2 rad/s' --alpha '1 rad/s^2'",
    );
    export_of(&file, &more, None)
        .ends(2)
        .says(&["loads go by the direction of travel"]);
}

/// A load that helps the motion is not friction; b has no direction.
#[test]
fn what_is_no_friction_is_refused() {
    let folder = Folder::new();
    let file = folder.path("joint.toml");
    for (load, words) in [
        (
            "viscous_moment = \"2 N m s\"",
            "the viscous friction goes by the direction",
        ),
        (
            "moment = \"9 N m\"",
            "the loads by direction drive the motion",
        ),
    ] {
        std::fs::write(&file, TABLE.replace("opposing_moment = \"2 N m\"", load)).unwrap();
        export_of(&file, &["--torque-error", "0.01 N m"], None)
            .ends(2)
            .says(&[words]);
    }
}
