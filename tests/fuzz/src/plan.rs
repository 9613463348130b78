//! Plans: accepted plans are followed.

use jred::axis::{MachineUnits, MotionState, Override, Plan, PlanFollower, PlanState};
use jred::number::{Bases, Number, Quantity as _};
use jred::table::{Format, Shape, Table};
use jred::{Domain, Model, Q31, Scale, Spline, curves};

use crate::harness::with_crc;

/// Ticks of a plan at full rate; twice as many are followed.
const TICKS: u32 = 1000;

/// Words of the header that name the range: its code, start and end.
const RANGE: [usize; 3] = [3, 5, 6];

/// A plan image: its CRC is corrected, so that the content is checked; an accepted plan is followed in each number type. Returns whether one was
/// accepted.
pub(crate) fn plan(bytes: &[u8]) -> bool {
    let words = with_crc(bytes);
    let [kinds, from, to] = RANGE.map(|k| words.get(k).copied().unwrap_or_default());
    let [kind, ..] = kinds.to_le_bytes();
    let domain = if kind == 0 {
        Domain::Turn
    } else {
        let ends = [from, to].map(|end| f64::from(f32::from_bits(end)));
        let Ok(stroke) = Domain::stroke(ends[0], ends[1]) else {
            // No model has this range, so no plan with it is accepted.
            assert!(read::<Spline<f32>>(&words, Domain::Turn, Scale::SI, [1.0 / 6.0; 7]).is_none());
            return false;
        };
        stroke
    };
    // A torque of 2³⁰ N m gives 1 kg m² an acceleration of 2³⁰ rad/s².
    let wide = Bases {
        torque: 1_073_741_824.0,
        speed: 32_768.0,
        inertia: 1.0,
    };
    let wide = Scale::new(wide).expect("bases");
    let sixth = Q31::from_f64(1.0 / 6.0).expect("a number of the range");
    let found = [
        read::<Spline<f64>>(&words, domain, Scale::SI, [1.0 / 6.0; 7]),
        read::<Spline<f32>>(&words, domain, Scale::SI, [1.0 / 6.0; 7]),
        read::<Spline<Q31>>(&words, domain, wide, [sixth.to_bits(); 7]),
    ];
    found.contains(&Some(true))
}

/// Reads a plan for a machine of this range, with any inertia, and follows it; `None` if the plan is refused, or there is no such machine.
fn read<F: Format>(
    words: &[u32],
    domain: Domain,
    scale: Scale,
    table: [F::Word; 7],
) -> Option<bool> {
    let shape = Shape::<F> {
        set: curves::INERTIA,
        cells: 4,
        domain: domain.to(),
        scale,
        constants: F::Constants::default(),
    };
    let table = Table::new(&table, shape).ok()?;
    let model = Model::<F, { curves::INERTIA }>::new(table).ok()?;
    let plan = Plan::new(words, &model).map_err(|error| {
        assert!(!error.to_string().is_empty() && !error.cure().to_string().is_empty());
    });
    let plan = plan.ok()?;
    let on_stroke = domain != Domain::Turn;
    let places = (0..=8).map(|k| plan.end() / 8 * k).chain([u64::MAX]);
    for place in places.map(|time| plan.at(time).value) {
        sound(&place.motion, place.turns, on_stroke);
    }
    Some(followed(plan, &model, on_stroke))
}

/// Follows a plan at full rate, slower, and with a changing rate, once and repeatedly; returns whether it can be followed.
fn followed<N: Number>(
    plan: Plan<'_, N>,
    model: &impl MachineUnits<Number = N>,
    on_stroke: bool,
) -> bool {
    let period = (plan.duration() / TICKS as f32).clamp(1e-6, 0.24);
    let changing = |tick: u32| match tick / 100 % 4 {
        0 => Override::FULL,
        1 => Override::STILL,
        _ => Override::percent(tick % 101),
    };
    let slower = |_| Override::percent(37);
    let rates: [(f32, &dyn Fn(u32) -> Override); 3] = [
        (0.0, &|_| Override::FULL),
        (100.0 * period, &slower),
        (3.3 * period, &changing),
    ];
    for (k, (ramp, rate)) in rates.into_iter().enumerate() {
        let Ok(once) = PlanFollower::new(plan, period, ramp, model) else {
            return false;
        };
        for mut follower in [Some(once), once.repeating().ok()].into_iter().flatten() {
            let repeats = follower != once;
            follower.start();
            let mut done = false;
            for tick in 0..2 * TICKS {
                let planned = follower.next(rate(tick));
                sound(&planned.motion, planned.turns, on_stroke);
                // At its end it stays.
                assert!(
                    !done || planned.state == PlanState::Done,
                    "{tick}: {planned:?}"
                );
                done = planned.state == PlanState::Done;
            }
            assert!(!(done && repeats), "it ends: {plan:?}");
            let in_time = plan.duration() < 1.5 * TICKS as f32 * period;
            assert!(
                k > 0 || repeats || done || !in_time,
                "it does not end: {plan:?}"
            );
        }
    }
    true
}

/// Checks that numbers are finite, and that a stroke has no turns.
fn sound<N: Number>(motion: &MotionState<N>, turns: i32, on_stroke: bool) {
    let rates = [motion.omega.number(), motion.alpha.number()].map(Number::to_f64);
    assert!(rates.iter().all(|rate| rate.is_finite()), "{motion:?}");
    assert!(!on_stroke || turns == 0, "{motion:?}: {turns}");
}
