//! The RMS torque as a limit.

use std::f64::consts::{PI, TAU};

use jred_motion::fastest::cycle::{cycle, single};
use jred_motion::fastest::{MoveLimits, NoMotion, Rms, Task};
use jred_motion::gentlest::{Objective, Travel, gentlest};
use jred_motion::moves::{Move, Part};
use jred_motion::path_dynamics::PathDynamics;

use super::{close, jerk_limits, motor, table, task};
use crate::support::{edited_press, press_file};

/// With constant inertia and no friction: ∫T² dt = 12·J²·D²/t³ in the time t, and the torque falls linearly.
#[test]
fn a_torque_that_falls_in_a_straight_line() {
    let file = table(2.0, "");
    let (inertia, dynamics, dwell) = (2.0, 3.0, 0.4);
    for limit in [3.0, 2.0, 0.5] {
        let found = single(
            &file,
            &motor([100.0; 2], 1e3),
            task(0.0, dynamics),
            Some(Rms::Torque(limit)),
        )
        .unwrap();
        // 12·J²·D²/t³ = limit²·t
        let time = (12.0_f64 * (inertia * dynamics / limit).powi(2)).powf(0.25);
        close(found.trace.duration(), time, 1e-6);
        let load = found.load;
        assert!(
            load.rms <= limit && load.rms > limit * (1.0 - 1e-6),
            "{}",
            load.rms
        );
        close(
            load.peaks[0],
            6.0 * inertia * dynamics / (time * time),
            1e-3,
        );
    }
    // With a pause in the cycle more torque is available.
    let parts = [
        Part::Move(Move {
            from: 0.0,
            to: dynamics,
            duration: 2.0,
        }),
        Part::Dwell {
            at: dynamics,
            duration: dwell,
        },
    ];
    let found = cycle(
        &file,
        &motor([100.0; 2], 1e3),
        MoveLimits::default(),
        Some(Rms::Torque(2.0)),
        &parts,
    )
    .unwrap();
    let excess = |t: f64| 12.0 * (inertia * dynamics).powi(2) / t.powi(3) - 4.0 * (t + dwell);
    let (mut low, mut high) = (1e-3, 1e3);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    close(found.trace.duration() - dwell, low, 1e-6);
}

/// With a torque limit: constant torque, a line, constant torque. With the line from +P to −P in the share s of the time t: ∫T² = P²·t·(1 − 2·s/3), D
/// = P·t²/J·(1/4 − s²/12).
#[test]
fn a_torque_limit_cuts_the_line() {
    let file = table(2.0, "");
    let (inertia, dynamics, peak, limit) = (2.0, 3.0, 5.0, 4.4);
    let s = 1.5 * (1.0 - (limit / peak) * (limit / peak));
    let time = (dynamics * inertia / peak / (0.25 - s * s / 12.0_f64)).sqrt();
    let found = single(
        &file,
        &motor([peak; 2], 1e3),
        task(0.0, dynamics),
        Some(Rms::Torque(limit)),
    )
    .unwrap();
    close(found.trace.duration(), time, 1e-6);
    assert!(found.moves[0].fastest.excess <= 1e-6);
}

/// Two moves share the heat of the cycle, with the same price of the torque in both. With constant inertia ∫T²ᵢ = 12·J²·Dᵢ²/tᵢ³, and the sum of the
/// times is least where Dᵢ²/tᵢ⁴ is equal: tᵢ ∝ √Dᵢ.
#[test]
fn moves_share_the_heat() {
    let file = table(2.0, "");
    let parts = [(0.0, 4.0), (4.0, 3.0)].map(|(from, to)| {
        Part::Move(Move {
            from,
            to,
            duration: 1.0,
        })
    });
    let found = cycle(
        &file,
        &motor([100.0; 2], 1e3),
        MoveLimits::default(),
        Some(Rms::Torque(2.0)),
        &parts,
    )
    .unwrap();
    let times: Vec<f64> = found.moves.iter().map(|made| made.fastest.time).collect();
    close(times[0] / times[1], 2.0, 1e-5);
    // Σ 12·J²·D²/t³ = limit²·Σt with t₁ = 2·t₂, D₁ = 4, D₂ = 1.
    let second = (12.0_f64 * 4.0 * (16.0 / 8.0 + 1.0) / (4.0 * 3.0)).powf(0.25);
    close(times[1], second, 1e-5);
}

/// Friction above the limit: no motion is slow enough; an inactive limit changes nothing.
#[test]
fn friction_above_the_limit_is_refused() {
    let file = table(
        2.0,
        "[[load]]\non = \"table\"\nopposing_moment = \"2 N m\"\n",
    );
    let motor = motor([10.0; 2], 100.0);
    let refused = single(&file, &motor, task(0.0, 3.0), Some(Rms::Torque(1.9)));
    assert!(
        matches!(refused, Err(NoMotion::RmsTooLarge { .. })),
        "{refused:?}"
    );
    let free = single(&file, &motor, task(0.0, 3.0), None).unwrap();
    let same = single(&file, &motor, task(0.0, 3.0), Some(Rms::Torque(10.0))).unwrap();
    assert_eq!(free.trace, same.trace);
}

/// With a jerk limit as well: the RMS torque is at its limit, and the motion takes longer than with either alone.
#[test]
fn with_a_limited_jerk() {
    let file = table(2.0, "");
    let limits = jerk_limits(20.0);
    let asked = Task {
        limits,
        ..task(0.0, 3.0)
    };
    let motor = motor([8.0; 2], 1e3);
    let jerk = single(&file, &motor, asked, None).unwrap();
    let limit = 0.9 * jerk.load.rms;
    let both = single(&file, &motor, asked, Some(Rms::Torque(limit))).unwrap();
    let rms = single(&file, &motor, task(0.0, 3.0), Some(Rms::Torque(limit))).unwrap();
    assert!(both.load.rms <= limit && both.load.rms > limit * (1.0 - 1e-6));
    let [both, jerk, rms] = [both, jerk, rms].map(|cycle| cycle.trace.duration());
    assert!(
        both > 1.001 * jerk && both > 1.001 * rms,
        "{both} {jerk} {rms}"
    );
}

/// A weight held throughout: J constant against G takes ∫T² = 12·J²·D²/t³ + G²·t, so t⁴ = 12·J²·D²/(R² − G²), also below 1.155·G, where a slower
/// motion has a larger ∫T² and a smaller RMS torque.
#[test]
fn a_held_weight_bears_a_limit_near_itself() {
    let text = "title = \"lift\"\ngravity = [\"0 m/s^2\", \"-10 m/s^2\"]\n[mechanism]\ntype = \"hoist\"\n\
        [mechanism.drum]\nmass = \"10 kg\"\ninertia = \"0.5 kg m^2\"\n[mechanism.load]\nradius = \"100 mm\"\nmass = \"40 kg\"\n";
    let file = super::machine(text);
    let (inertia, weight, dynamics) = (0.5 + 40.0 * 0.01, 40.0, 20.0);
    let motor = motor([400.0; 2], 1e3);
    for limit in [1.5, 1.2, 1.15, 1.05, 1.01] {
        let limit = limit * weight;
        let found = single(&file, &motor, task(0.0, dynamics), Some(Rms::Torque(limit))).unwrap();
        let own: f64 = inertia * dynamics;
        let time = (12.0 * own * own / (limit * limit - weight * weight)).powf(0.25);
        close(found.trace.duration(), time, 1e-6);
        assert!(found.load.rms <= limit, "{}", found.load.rms);
    }
    let refused = single(
        &file,
        &motor,
        task(0.0, dynamics),
        Some(Rms::Torque(0.99 * weight)),
    );
    let Err(why @ NoMotion::RmsTooLarge { slow, .. }) = refused else {
        panic!("{refused:?}")
    };
    // At constant speed the screw carries the weight, and no motion takes less.
    close(slow, weight, 1e-9);
    let words = why.to_string();
    assert!(
        words.contains("however slowly the machine moves"),
        "{words}"
    );
}

/// Peak torque and speed limits far from active change nothing: a belt's bends are rounded over the loads that occur.
#[test]
fn a_torque_that_does_not_bind_changes_nothing() {
    let text = edited_press("efficiency = \"97 %\"", "efficiency = \"60 %\"");
    let file = super::machine(&text);
    let times = [60.0, 200.0, 5e3].map(|torque| {
        let asked = task(PI, 3.0 * PI);
        let found = single(
            &file,
            &motor([torque; 2], 942.0),
            asked,
            Some(Rms::Torque(7.942)),
        );
        found.unwrap().trace.duration()
    });
    // The least RMS torque in that time, by the other search.
    let dynamics = PathDynamics::new(&file, motor([60.0; 2], 942.0), 1.0);
    let travel = Travel {
        start: PI,
        distance: TAU,
        duration: times[0],
        speeds: [0.0; 2],
        accelerations: [0.0; 2],
        ramp: 0.0,
        ring: false,
    };
    let least = gentlest(&dynamics, &travel, Objective::Rms).unwrap();
    close((least.cost / times[0]).sqrt(), 7.942, 1e-5);
    close(times[1], times[0], 1e-6);
    close(times[2], times[0], 1e-6);
}

/// A press with losses, friction and a falling torque: a tighter limit takes longer, and one that is hardly active takes as long as none.
#[test]
fn a_tighter_limit_of_a_press_takes_longer() {
    let file = jred_analysis::checked::read(&press_file()).unwrap();
    let motor = motor([24.0, 12.0], 300.0);
    let asked = task(3.2, 9.0);
    let free = single(&file, &motor, asked, None).unwrap();
    let mut last = free.trace.duration();
    for share in [0.999_999, 0.97, 0.8, 0.6, 0.5] {
        let limit = share * free.load.rms;
        let found = single(&file, &motor, asked, Some(Rms::Torque(limit))).unwrap();
        let time = found.trace.duration();
        assert!(time > last * (1.0 - 1e-6), "{time} after {last} at {share}");
        assert!(found.load.rms <= limit, "{}", found.load.rms);
        if share > 0.99 {
            close(time, last, 1e-5);
        }
        last = time;
    }
}
