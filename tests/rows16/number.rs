//! The number itself, and its conversions.

use jred::number::{Number, Quantity};
use jred::{Acceleration, Outcome, Q15, Speed, Torque};

use crate::rows16::q15;
use crate::support::scale_of;

fn outcome<Q: Quantity<Number = Q15>>(bits: i16, saturated: bool) -> Outcome<Q> {
    Outcome {
        value: q15(bits),
        saturated,
    }
}

#[test]
fn conversions_round_to_the_nearest_and_say_when_they_saturate() {
    let scale = scale_of(64.0, 32.0, 2.0);
    let omega = |units: f32| scale.omega::<Speed<Q15>>(units * (32.0 / 32_768.0));
    for (given, expected) in [
        (0.0, outcome(0, false)),
        (0.49, outcome(0, false)),
        (0.5, outcome(1, false)),
        (-0.49, outcome(0, false)),
        (-0.5, outcome(-1, false)),
        (1234.4, outcome(1234, false)),
        (32_767.4, outcome(i16::MAX, false)),
        (32_767.6, outcome(i16::MAX, true)),
        (1e30, outcome(i16::MAX, true)),
        (-32_768.4, outcome(i16::MIN, false)),
        (-32_768.6, outcome(i16::MIN, true)),
        (f32::NEG_INFINITY, outcome(i16::MIN, true)),
        (f32::NAN, outcome(0, true)),
    ] {
        assert_eq!(omega(given), expected, "{given}");
    }
    assert_eq!(
        scale.to_torque::<Torque<Q15>>(32.0),
        outcome(1 << 14, false)
    );
    assert_eq!(
        scale.alpha::<Acceleration<Q15>>(-8.0),
        outcome(-(1 << 13), false)
    );
    assert_eq!(
        scale.torque_si(q15::<Torque<Q15>>(-(1 << 13))).to_bits(),
        (-16f32).to_bits()
    );
    let speed = scale.omega_si(q15::<Speed<Q15>>(1 << 14));
    assert_eq!(scale.omega::<Speed<Q15>>(speed), outcome(1 << 14, false));
    assert_eq!(
        scale.alpha_si(q15::<Acceleration<Q15>>(1 << 14)).to_bits(),
        16f32.to_bits()
    );
}

#[test]
fn doubles_come_back() {
    for bits in i16::MIN..=i16::MAX {
        let number = Q15::from_bits(bits);
        assert_eq!(Q15::from_f64(number.to_f64()), Some(number));
    }
    assert_eq!(Q15::MIN.to_f64().to_bits(), (-1f64).to_bits());
    assert_eq!(Q15::from_f64(1.0), None);
    assert_eq!(Q15::from_f64(-1.0001), None);
    assert_eq!(Q15::from_f64(f64::NAN), None);
    assert_eq!(
        [Q15::MIN, Q15::MAX],
        [i16::MIN, i16::MAX].map(Q15::from_bits)
    );
}
