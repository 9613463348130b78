//! Messages of the axis's errors: quantity, value, limit, cure.

use core::fmt::Display;

use jred::axis::{
    AxisError, Braking, Direction, Encoder, Envelope, FrictionRamp, Gearbox, Governor, Limits,
    LookAhead, Mounting, Period, StrokeEncoder, StrokeMounting, TorqueLimits, Tracker,
    Transmission,
};
use jred::{Domain, Phase, Q31, Scale, Spline};

use super::machine::in_units;
use crate::support::scale_of;

#[track_caller]
fn says<T>(made: Result<T, AxisError>, expected: &str) {
    let error = made.err().expect("an error");
    let text = format!("{error}; {}", error.cure());
    assert_eq!(text, expected);
}

fn period() -> impl Fn(f32) -> Result<Period<Q31>, AxisError> {
    let model = in_units::<Spline<Q31>>(Domain::Turn, scale_of(10.0, 30.0, 1.0));
    move |seconds| Period::new(seconds, &model)
}

#[test]
fn an_axis_error_says_value_limit_and_cure() {
    let none = "give a number that is neither NaN nor infinite";
    let more = "give a value greater than zero";
    says(
        TorqueLimits::new(f32::NAN, 5.0),
        &format!("the least torque is not a finite number; {none}"),
    );
    says(
        TorqueLimits::new(-2.0, -0.5),
        "the greatest torque is -0.5, but must be zero or positive; give a value zero or positive",
    );
    let single = in_units::<Spline<f32>>(Domain::Turn, Scale::SI);
    says(
        Envelope::new([], 5.0, &single),
        "the number of points of the torque curve is 0, but must be at least 1; give a value at least 1",
    );
    says(
        Envelope::new([[5.0, 8.0], [4.0, 3.0]], 5.0, &single),
        "a speed of the torque curve is 4, but must be finite, from 0 on, and greater than the one before; \
         give a value finite, from 0 on, and greater than the one before",
    );
    let fixed = in_units::<Spline<Q31>>(Domain::Turn, scale_of(4.0, 10.0, 1.0));
    says(
        Envelope::new([[5.0, 4.5]], 3.0, &fixed),
        "a torque of the torque curve is 4.5, but must be less than its base, 4; \
         give a smaller value, or export the table for a greater speed and acceleration",
    );
    says(
        period()(0.5),
        "the period is 0.5, but must be short enough for a quarter of the range at the speed base; \
         give a value short enough for a quarter of the range at the speed base",
    );
    says(
        period()(-1.0),
        &format!("the period is -1, but must be greater than zero; {more}"),
    );
    says(
        period()(f32::INFINITY),
        &format!("the period is not a finite number; {none}"),
    );
    says(
        Tracker::new(1.25),
        "the memory of the filter is 1.25, but must be from 0 to 0.99; give a value from 0 to 0.99",
    );
    let gearbox = Gearbox {
        ratio: 20.0,
        efficiency: 1.0625,
        rotor: 0.0,
    };
    says(
        Transmission::new(gearbox, &single),
        "the efficiency of the gearbox is 1.063, but must be from 0.01 to 1; give a value from 0.01 to 1",
    );
    says(
        FrictionRamp::new(1e-7, &single),
        "the width of the friction ramp is less than 0.001, but must be at least a millionth of the speed base; \
         give a value at least a millionth of the speed base",
    );
    says(
        Encoder::new(Mounting::direct(0)),
        &format!(
            "the number of counts of a turn of the encoder is 0, but must be greater than zero; {more}"
        ),
    );
    let stroke = Domain::Stroke { from: 0.0, to: 0.5 };
    let scaled = StrokeMounting {
        resolution: 0.25,
        homing_offset: 0,
        home_position: 0.0,
    };
    says(
        StrokeEncoder::new(stroke, scaled),
        "the number of counts of the stroke is 2, but must be from 16 to 9007199254740992; \
         give a value from 16 to 9007199254740992",
    );
}

#[test]
fn what_lies_ahead_says_how_many_nodes_and_which_speed() {
    let model = in_units::<Spline<Q31>>(Domain::Turn, scale_of(10.0, 30.0, 1.0));
    let period = Period::new(0.001, &model).unwrap();
    let envelope = Envelope::<_, 1>::new([[20.0, 8.0]], 5.0, &model).unwrap();
    says(
        Limits::new(envelope, 31.0, 5.0, period, &model),
        "the greatest speed is 31, but must be less than its base, 30; \
         give a smaller value, or export the table for a greater speed and acceleration",
    );
    let braking = Braking {
        torque: 5.0,
        deceleration: 5.0,
        helped: false,
    };
    let few = LookAhead::<_, 3>::new(&model, Direction::Forward, braking, |_| 5.0, &period);
    says(
        few,
        "the number of nodes is 3, but must be from 4 to 4096; give a value from 4 to 4096",
    );
    let ahead =
        LookAhead::<_, 16>::new(&model, Direction::Forward, braking, |_: Phase| 5.0, &period)
            .unwrap();
    says(
        Governor::both_ways(&ahead, &ahead),
        "the look-aheads of the governor are not one forward and one backward; \
         give one that looks forward, and then one that looks backward",
    );
}

/// Numbers of any magnitude are formatted with integers.
#[test]
fn figures_of_any_size_are_shown() {
    let shown = |value: f32| {
        let text = AxisError::NotPositive("x", value).to_string();
        let (_, text) = text.split_once("x is ").unwrap();
        text.split_once(',').unwrap().0.to_owned()
    };
    let same = |value: f32, expected: &dyn Display| assert_eq!(shown(value), expected.to_string());
    for whole in [0u32, 1, 7, 999, 16_777_216] {
        same(whole as f32, &whole);
    }
    for (value, expected) in [
        (0.25, "0.25"),
        (-1.5, "-1.5"),
        (2.007_812_5, "2.008"),
        (0.9999, "1"),
        (1.0 / 3.0, "0.333"),
        (1e-6, "less than 0.001"),
        (3e9, "3000000000"),
        (5e9, "more than 4000000000"),
        (f32::NEG_INFINITY, "-infinite"),
    ] {
        same(value, &expected);
    }
}
