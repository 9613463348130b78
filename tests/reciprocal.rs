//! Forward dynamics without a division: the curve of 1/J, its remaining error, and refusals.

use std::f64::consts::TAU;

use crate::support::budget::{self, Q31_UNIT};
use crate::support::machines::{Spec, Wave, spec};
use crate::support::rows::{Fixed, Meaning as _, Plain, Rows};
use crate::support::{assert_near, config, largest, rk4, scale_of, value};
use jred::number::Role;
use jred::table::TableError;
use jred::{
    Acceleration, Cubic, CurveSet, Model, Phase, Q31, Quadratic, Scale, Speed, Spline, Torque,
    curves,
};
use proptest::prelude::*;

const SET: CurveSet = curves::ALL | curves::RECIPROCAL;

/// J_m: the product of J and its reciprocal's curve, a power of two.
fn unit<L: Fixed>(rows: &Rows<L>) -> f64 {
    let read = rows.exact(Phase::default(), !0);
    (read.inertia * read.reciprocal).log2().round().exp2()
}

/// Acceleration → torque → acceleration; the range of two torques; and the table's own seed against its own J.
fn there_and_back<L: Fixed>(
    spec: &Spec,
    cells: u32,
    [omega, alpha, other]: [f64; 3],
    phase: Phase,
) {
    let machine = spec.machine();
    let scale = Scale::covering(&machine, 60.0, 900.0, 256).unwrap();
    let scale = scale.for_cells(cells, TAU);
    let Ok(rows) = Rows::<L>::of(&machine, SET, cells, &scale) else {
        return; // too few cells
    };
    let Ok(model) = rows.try_model::<SET>(&scale) else {
        return; // too few cells for 1/J: `too_few_cells_are_refused`
    };
    let omega = scale.omega((60.0 * omega) as f32).value;
    let [alpha, other] = [alpha, other].map(|a| scale.alpha((900.0 * a) as f32).value);
    let torque = model.torque(phase, omega, alpha);
    let back = model.acceleration(phase, omega, torque);
    assert!(!back.saturated, "{back:?}");
    let unit = unit(&rows);
    let read = rows.exact(phase, crate::support::exact::place_bits::<L>());
    let relative = 1.0 - read.inertia * read.reciprocal / unit;
    let left = if L::NAME == "quadratic" {
        relative
    } else {
        relative * relative
    };
    // J·α loses up to a unit of Q29; the quotient and the step each up to one of Q28 times J_m; the step's factor has 29 bits.
    let units = 4.0 / read.inertia + budget::RECIPROCAL_UNITS / unit;
    let budget = units * Q31_UNIT + left.abs() * value(alpha).abs();
    assert_near("α", value(back.value), value(alpha), budget);
    // The error that the model states is about the same everywhere in the table.
    let stated = f64::from(model.table().reciprocal_error());
    assert!(
        left.abs()
            <= budget::RECIPROCAL_STATED * stated + budget::RECIPROCAL_UNITS * Q31_UNIT / unit,
        "{left:e} of {stated:e}"
    );

    let least = model.torque(phase, omega, other);
    let range = model.acceleration_range(phase, omega, least, torque);
    assert_eq!(range.greatest, back);
    assert_eq!(range.least, model.acceleration(phase, omega, least));
}

proptest! {
    #![proptest_config(config(128, 0x0091))]

    #[test]
    fn forward_inverts_inverse_without_division(
        spec in spec(), state in [-1.0..1.0, -1.0..1.0, -1.0..1.0], cells in 24u32..200, bits: u32,
    ) {
        let phase = Phase::from_bits(bits);
        there_and_back::<Spline<Q31>>(&spec, cells, state, phase);
        there_and_back::<Cubic<Q31>>(&spec, cells, state, phase);
        there_and_back::<Quadratic<Q31>>(&spec, 2 * cells, state, phase);
    }
}

fn wave() -> Wave {
    Wave {
        load: 0.5,
        ..Wave::bare(1.0, 0.5)
    }
}

/// The largest difference after a round trip, as a share of the acceleration, at large accelerations and everywhere.
fn inconsistency<L: Fixed>(cells: u32) -> [f64; 2] {
    // J is 0.19 to 0.57, so J_m is ⅛; the velocity factor is one.
    let speed = (2.0 * TAU / f64::from(cells) * 5.0 / 2.63).sqrt();
    let scale = scale_of(5.0, speed as f32, 2.63);
    let scale = scale.for_cells(cells, TAU);
    let rows = Rows::<L>::of(&wave(), SET, cells, &scale).unwrap();
    let model = rows.model::<SET>(&scale);
    let alpha = scale.alpha(1.8).value;
    let places = 64 * cells;
    let found = largest((0..places).map(|k| {
        let phase = Phase::from_bits(((u64::from(2 * k + 1) << 31) / u64::from(places)) as u32);
        let torque = model.torque(phase, Speed::default(), alpha);
        let back = model.acceleration(phase, Speed::default(), torque);
        assert!(!back.saturated);
        value(back.value) / value(alpha) - 1.0
    }));
    [found, f64::from(model.table().reciprocal_error())]
}

/// It falls with the order of the spline, squared by Newton's step, down to the roundings; and it matches the stated error.
fn falls<L: Fixed>(cells: [u32; 3], ratio: [f64; 2], floor: f64) {
    let found = cells.map(inconsistency::<L>);
    for (cells, [found, stated]) in cells.iter().zip(found) {
        println!(
            "{} {cells} cells: {found:.2e}, stated {stated:.2e}",
            L::NAME
        );
        assert!(found <= budget::RECIPROCAL_STATED * stated + floor);
        assert!(stated <= budget::RECIPROCAL_STATED * found + floor);
    }
    let [coarse, fine, finest] = found.map(|[found, _]| found);
    assert!(
        (ratio[0]..ratio[1]).contains(&(coarse / fine)),
        "{}",
        coarse / fine
    );
    assert!(finest <= floor, "{finest:e}");
}

#[test]
fn the_inconsistency_is_what_is_stated() {
    // (16/12)⁴ squared is 10, and 2³. The roundings are those of `there_and_back`, over J = 0.19 and J_m = ⅛.
    falls::<Spline<Q31>>([12, 16, 48], [6.0, 16.0], 1e-7);
    falls::<Cubic<Q31>>([12, 16, 48], [6.0, 16.0], 1e-7);
    falls::<Quadratic<Q31>>([32, 64, 1024], [7.0, 9.5], 3e-7);
}

/// Unit by unit around T = ±J: flagged if the quotient leaves the range, within the quotient's own error.
fn saturates<L: Fixed>() {
    let scale = Scale::SI.for_cells(16, TAU);
    let [torque, inertia] = [scale.torque(), scale.inertia()].map(f64::from);
    let machine = Wave {
        coulomb: 0.1 * torque,
        ..Wave::bare(0.5 * inertia, 0.0)
    };
    let set = curves::COULOMB | curves::RECIPROCAL;
    let rows = Rows::<L>::of(&machine, set, 16, &scale).unwrap();
    let model = rows.model::<{ curves::COULOMB | curves::RECIPROCAL }>(&scale);
    let read = model.table().at(Phase::default());
    let [inertia, friction] = [read.inertia, read.coulomb].map(|x| (x / Q31_UNIT) as i32);
    let at = |omega: i32, torque: i32| {
        model.acceleration(
            Phase::default(),
            Speed::<Q31>::from_bits(omega),
            Torque::<Q31>::from_bits(torque),
        )
    };
    // One unit of T is 1/J of α; J_m is ¼.
    let edge = (budget::RECIPROCAL_UNITS * 4.0 * 0.5) as i32 + 4;
    for sign in [1, -1] {
        let end = if sign > 0 {
            Acceleration::<Q31>::MAX
        } else {
            Acceleration::<Q31>::MIN
        };
        for k in -400..400 {
            let found = at(sign, sign * (inertia + k + friction));
            if k.abs() > edge {
                assert_eq!(found.saturated, k > 0, "T − J = {k}");
            }
            if found.saturated {
                assert_eq!(found.value, end);
            } else {
                let exact = f64::from(sign) * f64::from(inertia + k) / f64::from(inertia);
                assert_near(
                    "α",
                    value(found.value),
                    exact,
                    2.0 * f64::from(edge) * Q31_UNIT,
                );
            }
        }
        for torque in [i32::MAX, i32::MIN] {
            let found = at(-torque.signum(), torque);
            assert!(found.saturated && found.value.to_bits().signum() == torque.signum());
        }
    }
}

#[test]
fn saturation_is_flagged() {
    saturates::<Spline<Q31>>();
    saturates::<Cubic<Q31>>();
    saturates::<Quadratic<Q31>>();
}

/// Largest share by which the energy ½·J·ω² + U changes over four turns without drive torque, with the model's own J, load and acceleration.
fn energy_drift<const S: CurveSet, L: Fixed>(spec: &Spec) -> f64 {
    const STEPS: u32 = 1024;
    let machine = spec.heavy();
    let scale = Scale::covering(&machine, 90.0, 2000.0, 256).unwrap();
    let scale = scale.for_cells(64, TAU);
    let rows = Rows::<L>::of(&machine, S, 64, &scale).unwrap();
    let model: Model<'_, L, S> = rows.model(&scale);
    let phase = |x: f64| Phase::from_bits((x * (4_294_967_296.0 / f64::from(STEPS))) as u64 as u32);
    let [torque, speed, inertia] = [scale.torque(), scale.speed(), scale.inertia()].map(f64::from);
    let exact = |x: f64| rows.exact(phase(x), !0);
    let width = TAU / f64::from(STEPS);
    let slope = |x: f64, w: f64| {
        let omega = crate::support::quantity(w / speed);
        let found = model.acceleration(phase(x), omega, Torque::default());
        assert!(!found.saturated);
        value(found.value) * torque / inertia / w * width
    };
    let energy = |x: f64, w: f64, u: f64| 0.5 * exact(x).inertia * inertia * w * w + u;
    let (mut w, mut u) = (60.0, 0.0);
    let start = energy(0.0, w, 0.0);
    let mut drift = 0.0;
    for k in 0..4 * STEPS {
        let x = f64::from(k);
        w = rk4(slope, x, w, 1.0);
        let load = |x: f64| exact(x).load * torque;
        u -= width / 6.0 * (load(x) + 4.0 * load(x + 0.5) + load(x + 1.0));
        drift = largest([drift, (energy(x + 1.0, w, u) - start) / start]);
    }
    drift
}

#[test]
fn energy_is_conserved_without_division() {
    const DIVIDE: CurveSet = curves::LOAD;
    const MULTIPLY: CurveSet = curves::LOAD | curves::RECIPROCAL;
    let press = Spec {
        crank: 0.08,
        rod_ratio: 2.5,
        offset_ratio: 0.2,
        left: false,
        mass: [1.0, 0.8, 2.0],
        com: [0.3, 0.1, 1.0, 0.05],
        down: 0.3,
        loads: [0.0; 4],
        flywheel: 0.6,
    };
    let divided = energy_drift::<DIVIDE, Spline<Q31>>(&press);
    println!("spline, divided {divided:.1e}");
    assert_near("spline", divided, 0.0, budget::Q31_ENERGY);
    for (name, drift) in [
        ("spline", energy_drift::<MULTIPLY, Spline<Q31>>(&press)),
        ("cubic", energy_drift::<MULTIPLY, Cubic<Q31>>(&press)),
        (
            "quadratic",
            energy_drift::<MULTIPLY, Quadratic<Q31>>(&press),
        ),
    ] {
        println!("{name} {drift:.1e}");
        assert_near(name, drift, 0.0, budget::Q31_ENERGY_RECIPROCAL);
    }
}

/// Every word of the reciprocal's curve times `share`.
fn scaled<L: Fixed>(rows: &Rows<L>, share: f64) -> Rows<L> {
    let mut rows = rows.clone();
    let (first, count, pitch) = match L::NAME {
        "spline" => (1, 1, 2),
        "cubic" => (4, 4, 8),
        _ => (3, 3, 8),
    };
    for row in rows.words.chunks_mut(pitch) {
        for word in &mut row[first..first + count] {
            *word = (f64::from(*word) * share) as i32;
        }
    }
    rows
}

fn refuses_another_reciprocal<L: Fixed>(accepted: [f64; 2], refused: [f64; 2]) {
    const SET: CurveSet = curves::RECIPROCAL;
    let scale = Scale::covering(&wave(), 10.0, 20.0, 256).unwrap();
    let scale = scale.for_cells(128, TAU);
    let rows = Rows::<L>::of(&wave(), SET, 128, &scale).unwrap();
    let build = |rows: &Rows<L>| rows.try_model::<SET>(&scale).map(|_| ());
    assert_eq!(build(&rows), Ok(()));
    for share in accepted {
        assert_eq!(build(&scaled(&rows, share)), Ok(()), "{share}");
    }
    for share in refused.into_iter().chain([0.0, -0.5, -1.0, 0.7, 1e-6]) {
        let found = build(&scaled(&rows, share));
        assert!(
            matches!(found, Err(TableError::Reciprocal { .. })),
            "{share}: {found:?}"
        );
    }
    // For the same inertia a quarter of a turn later.
    let mut shifted = rows.clone();
    let pitch = shifted.words.len() / 128;
    if L::NAME != "spline" {
        let before = rows.words.clone();
        for (k, word) in shifted.words.iter_mut().enumerate() {
            let column = k % pitch;
            let count = if L::NAME == "cubic" { 4 } else { 3 };
            if (count..2 * count).contains(&column) {
                *word = before[(k + 32 * pitch) % before.len()];
            }
        }
        let found = build(&shifted);
        assert!(
            matches!(found, Err(TableError::Reciprocal { .. })),
            "{found:?}"
        );
    }
}

#[test]
fn a_reciprocal_of_another_inertia_is_refused() {
    refuses_another_reciprocal::<Spline<Q31>>([0.85, 1.0], [0.79, 0.6]);
    refuses_another_reciprocal::<Cubic<Q31>>([0.85, 1.0], [0.79, 0.6]);
    refuses_another_reciprocal::<Quadratic<Q31>>([0.985, 1.0], [0.975, 0.9]);
}

/// 1/J of a strongly varying inertia needs more cells than J itself.
#[test]
fn too_few_cells_are_refused() {
    const SET: CurveSet = curves::RECIPROCAL;
    let machine = Wave::bare(1.0, 0.9);
    let build = |cells: u32| {
        let scale = Scale::covering(&machine, 10.0, 20.0, 256).unwrap();
        let scale = scale.for_cells(cells, TAU);
        let rows = Rows::<Quadratic<Q31>>::of(&machine, SET, cells, &scale)?;
        rows.try_model::<SET>(&scale)
            .map(|_| ())
            .map_err(jred::error::Error::Table)
    };
    for cells in [8, 12] {
        assert!(build(cells).is_err(), "{cells} cells");
    }
    assert_eq!(build(96), Ok(()));
}

fn refused_in_floating_point<F: Plain>() {
    let refused = Rows::<F>::of(&wave(), SET, 16, &Scale::SI).map(|_| ());
    let expected = TableError::Curves(SET);
    assert_eq!(refused, Err(jred::error::Error::Table(expected)));
    let word = F::Word::of(Role::Inertia, 0.1);
    let words = vec![word; jred::table::words_len::<F>(16, curves::RECIPROCAL)];
    let rows = Rows::<F>::plain(words, curves::RECIPROCAL, 16, jred::Domain::Turn);
    let expected = TableError::Curves(curves::RECIPROCAL);
    assert_eq!(rows.try_table().map(|_| ()), Err(expected));
}

#[test]
fn floating_point_has_no_reciprocal() {
    refused_in_floating_point::<Spline<f32>>();
    refused_in_floating_point::<Quadratic<f32>>();
    refused_in_floating_point::<Cubic<f64>>();
}
