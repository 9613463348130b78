//! The parts of an axis: made here, ticked in the header; and the observer.

use std::fmt::Write as _;

use core::mem::{MaybeUninit, zeroed};

use jred::axis::{
    FrictionRamp, Gearbox, MotionState, Observer, Period, TorqueLimits, Tracker, TrackerOutput,
    Transmission, Units,
};
use jred::number::{Bases, FrictionSign, Quantity};
use jred::{Domain, Image, Model, Phase, Q15, Q31, Spline};

use super::{Numbers, PRESS, Press, answers, jred_spline_f32_load, press};
use crate::axis::{CObserved, Observe, jred_tracker_make};
use crate::image::{Info, jred_image_info};
use crate::number::CNumber;
use crate::status::Status;

/// A number of any kind, and how it is written.
pub(super) trait Any: CNumber {
    const KIND: char;
    fn any(numbers: &mut Numbers) -> Self;
    fn bits(self) -> u32;
}

impl Any for f32 {
    const KIND: char = 'f';
    fn any(numbers: &mut Numbers) -> Self {
        const ENDS: [f32; 8] = [
            0.0,
            -0.0,
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            f32::MAX,
            1e-45,
            1.0,
        ];
        let k = numbers.below(40) as usize;
        let random = (numbers.next() as i32) as f32 * 2f32.powi(numbers.below(40) as i32 - 50);
        ENDS.get(k).copied().unwrap_or(random)
    }
    fn bits(self) -> u32 {
        if self.is_nan() {
            0x7fc0_0000
        } else {
            self.to_bits()
        }
    }
}

impl Any for Q31 {
    const KIND: char = 'l';
    fn any(numbers: &mut Numbers) -> Self {
        const ENDS: [i32; 5] = [0, 1, -1, i32::MIN, i32::MAX];
        let k = numbers.below(30) as usize;
        let random = numbers.next() as i32 >> numbers.below(31);
        Self::from_bits(ENDS.get(k).copied().unwrap_or(random))
    }
    fn bits(self) -> u32 {
        self.to_bits().cast_unsigned()
    }
}

impl Any for Q15 {
    const KIND: char = 's';
    fn any(numbers: &mut Numbers) -> Self {
        Self::from_bits((Q31::any(numbers).to_bits() >> 16) as i16)
    }
    fn bits(self) -> u32 {
        i32::from(self.to_bits()).cast_unsigned()
    }
}

fn bits<Q: Quantity<Number: Any>>(quantity: Q) -> u32 {
    quantity.number().bits()
}

/// The words of a part that has no other fields, as far as they go, and the last one of a flag.
fn words_of<T>(part: &T, count: usize) -> String {
    let address = core::ptr::from_ref(part).cast::<u32>();
    (0..count).fold(String::new(), |text, k| {
        // SAFETY: every field before is a word.
        let word = unsafe { address.add(k).read() };
        text + &format!("{word:x} ")
    })
}

/// Positive, of many magnitudes.
fn figure(numbers: &mut Numbers, from: f32, to: f32) -> f32 {
    let place = numbers.below(1 << 24) as f32 / 16_777_216.0;
    from * (to / from).powf(place)
}

/// A line for the program, and what it must answer.
fn parts<N: Any<Real = f32>>(numbers: &mut Numbers) -> Option<(String, String)> {
    let base = |numbers: &mut Numbers| {
        if N::FIXED {
            figure(numbers, 0.01, 1e4)
        } else {
            1.0
        }
    };
    let [torque, speed, inertia] = [(); 3].map(|()| base(numbers));
    let bases = Bases {
        torque,
        speed,
        inertia,
    };
    let on_stroke = numbers.below(2) == 1;
    let domain = if on_stroke {
        Domain::Stroke { from: 0.5, to: 2.0 }
    } else {
        Domain::Turn
    };
    let units = Units::<N>::new(bases, domain).ok()?;
    let period = Period::new(figure(numbers, 1e-6, 0.1), &units).ok()?;
    let ramp = FrictionRamp::new(figure(numbers, 1e-3, 1e3) * speed, &units).ok()?;
    let rotor = if numbers.below(3) == 0 {
        0.0
    } else {
        figure(numbers, 1e-6, 1.0)
    };
    let gearbox = Gearbox {
        ratio: figure(numbers, 0.1, 1e3),
        efficiency: figure(numbers, 0.01, 1.0),
        rotor,
    };
    let gearbox = Transmission::new(gearbox, &units).ok()?;
    let [counts, acceleration] = [(); 2].map(|()| Q31::any(numbers).to_bits());
    let phase = numbers.next() as u32;
    let [omega, alpha, torque, least, greatest] = [(); 5].map(|()| N::any(numbers));
    let limits = TorqueLimits::new(
        <N::MotorTorque as Quantity>::of(least),
        <N::MotorTorque as Quantity>::of(greatest),
    )
    .ok()?;
    let asked = format!(
        "{} {}{:x} {}{}{counts:x} {acceleration:x} {phase:x} {:x} {:x} {:x} {:x} {:x}\n",
        N::KIND,
        words_of(&period, 15),
        u32::from(on_stroke),
        words_of(&ramp, 3),
        words_of(&gearbox, 10),
        omega.bits(),
        alpha.bits(),
        torque.bits(),
        least.bits(),
        greatest.bits(),
    );
    let tracked = TrackerOutput {
        speed: counts,
        acceleration,
        ..TrackerOutput::default()
    };
    let motion = MotionState::<N> {
        phase: Phase::from_bits(phase),
        omega: Quantity::of(omega),
        alpha: Quantity::of(alpha),
    };
    let (found_omega, found_alpha) = (period.omega(tracked), period.alpha(tracked));
    let later = period.later(motion);
    let FrictionSign::Scaled(share) = ramp.at(motion.omega) else {
        panic!("a ramp gives a share")
    };
    let motor = gearbox.motor(Quantity::of(torque), motion.omega, motion.alpha);
    let limited = limits.limited(Quantity::of(torque));
    let flags = [
        found_omega.saturated,
        found_alpha.saturated,
        later.saturated,
        true,
        motor.saturated,
    ];
    let expected = format!(
        "{:x} {:x} {:x} {:x} {:x} {:x} {:x} {:x} {:x} {:x} {}",
        bits(found_omega.value),
        bits(found_alpha.value),
        period.moved(motion.omega).to_bits(),
        later.value.phase.to_bits(),
        bits(later.value.omega),
        bits(later.value.alpha),
        share.bits(),
        bits(motor.value),
        bits(limited.torque),
        bits(limited.clipped),
        flags.map(|flag| u8::from(flag).to_string()).concat(),
    );
    Some((asked, expected))
}

/// Sixteen readings of a tracker: near each other, or anywhere.
fn track(numbers: &mut Numbers) -> (String, String) {
    let memory = numbers.below(100) as f32 * 0.01;
    let most = Phase::from_bits(numbers.next() as u32);
    let mut phase = numbers.next() as u32;
    let tracker = Tracker::new(memory).unwrap().at(Phase::from_bits(phase));
    let mut tracker = tracker.with_largest_step(most);
    let on_stroke = numbers.below(2) == 1;
    let mut asked = format!("t {}10 {:x}", words_of(&tracker, 10), u8::from(on_stroke));
    let mut expected = String::new();
    let step = (numbers.next() as u32) >> numbers.below(31);
    for _ in 0..16 {
        phase = match numbers.below(12) {
            0 => numbers.next() as u32,
            1 => 0,
            2 => u32::MAX,
            _ => phase.wrapping_add(step),
        };
        write!(asked, " {phase:x}").unwrap();
        let measured = Phase::from_bits(phase);
        let found = if on_stroke {
            tracker.update_stroke(measured)
        } else {
            tracker.update(measured)
        };
        let phase = found.phase.to_bits();
        write!(
            expected,
            "{phase:x} {} {} {} {} ",
            found.speed,
            found.acceleration,
            found.residual,
            u8::from(found.jumped)
        )
        .unwrap();
    }
    (asked + "\n", expected.trim_end().to_owned())
}

#[test]
fn the_header_of_the_axis_computes_the_bits_of_rust() {
    let mut numbers = Numbers(0x2545_f491_4f6c_dd1d);
    let mut cases = Vec::new();
    for _ in 0..8000 {
        cases.extend(parts::<f32>(&mut numbers));
        cases.extend(parts::<Q31>(&mut numbers));
        cases.extend(parts::<Q15>(&mut numbers));
        cases.push(track(&mut numbers));
    }
    // Limits that do not contain 0 are refused: a quarter of all is left.
    for kind in ['f', 'l', 's', 't'] {
        let many = cases.iter().filter(|(asked, _)| asked.starts_with(kind));
        assert!(many.count() > 800, "{kind}");
    }
    let asked: String = cases.iter().map(|(asked, _)| asked.as_str()).collect();
    for short in [false, true] {
        let found = answers("axis", &asked, short);
        assert_eq!(found.len(), cases.len());
        for (found, (asked, expected)) in found.iter().zip(&cases) {
            assert_eq!(found.trim_end(), expected, "{asked}");
        }
    }
}

macro_rules! functions {
    ($($name:ident($($argument:ty),*) $(-> $result:ty)?;)*) => {
        #[allow(improper_ctypes, reason = "C sees the memory of a part as bytes")]
        unsafe extern "C" {
            $(fn $name($(_: $argument),*) $(-> $result)?;)*
        }
    };
}

type Made<'a, T> = Option<&'a mut MaybeUninit<T>>;
functions! {
    jred_f32_period_make(Made<Period<f32>>, Option<&Info>, f32) -> Status;
    jred_f32_friction_ramp_make(Made<FrictionRamp<f32>>, Option<&Info>, f32) -> Status;
    jred_f32_transmission_make(Made<Transmission<f32>>, Option<&Info>, Option<&Gearbox>) -> Status;
    jred_f32_torque_limits_make(Made<TorqueLimits<f32>>, f32, f32) -> Status;
    jred_f32_observer_make(Option<&mut Observe<f32>>, Option<&Info>, f32, f32, u32) -> Status;
    jred_spline_f32_s21_observe(*const Press, *mut Observe<f32>, u32, f32, f32, bool, *mut CObserved<f32>);
}

fn info(words: &[u32]) -> Info {
    let mut info = MaybeUninit::<Info>::uninit();
    // SAFETY: words and their number.
    let read = unsafe { jred_image_info(words.as_ptr(), words.len(), Some(&mut info)) };
    assert_eq!(read, Status::Ok);
    // SAFETY: it was written.
    unsafe { info.assume_init() }
}

/// Every part: a figure that does not fit, a null pointer; and what was made is that of Rust.
#[test]
fn parts_are_those_of_rust_and_wrong_figures_are_refused() {
    let words = press();
    let info = info(&words);
    let image = Image::new(&words).unwrap();
    let model: Model<'_, Spline<f32>, PRESS> = image.model().unwrap();
    let gearbox = Gearbox {
        ratio: 20.0,
        efficiency: 0.95,
        rotor: 0.000_3,
    };
    let nan = f32::NAN;
    // SAFETY: null pointers are allowed; what is read was written.
    unsafe {
        let mut made = MaybeUninit::uninit();
        assert_eq!(
            jred_f32_period_make(Some(&mut made), Some(&info), 5e-4),
            Status::Ok
        );
        assert_eq!(made.assume_init(), Period::new(5e-4, &model).unwrap());
        for wrong in [0.0, -1.0, nan, f32::INFINITY, 1e-30] {
            assert_eq!(
                jred_f32_period_make(Some(&mut made), Some(&info), wrong),
                Status::Figure
            );
            assert_eq!(made.assume_init().moved(1e6).to_bits(), 0);
        }
        assert_eq!(
            jred_f32_period_make(Some(&mut made), None, 5e-4),
            Status::Null
        );
        assert_eq!(jred_f32_period_make(None, Some(&info), 5e-4), Status::Null);

        let mut made = MaybeUninit::uninit();
        assert_eq!(
            jred_f32_friction_ramp_make(Some(&mut made), Some(&info), 0.05),
            Status::Ok
        );
        assert_eq!(made.assume_init(), FrictionRamp::new(0.05, &model).unwrap());
        for wrong in [0.0, nan, 1e-7] {
            let status = jred_f32_friction_ramp_make(Some(&mut made), Some(&info), wrong);
            assert_eq!(status, Status::Figure);
            assert_eq!(made.assume_init().at(1e6), FrictionSign::Scaled(0.0));
        }

        let mut made = MaybeUninit::uninit();
        let status = jred_f32_transmission_make(Some(&mut made), Some(&info), Some(&gearbox));
        assert_eq!(status, Status::Ok);
        assert_eq!(
            made.assume_init(),
            Transmission::new(gearbox, &model).unwrap()
        );
        for wrong in [
            Gearbox {
                ratio: 0.0,
                ..gearbox
            },
            Gearbox {
                efficiency: 1.1,
                ..gearbox
            },
            Gearbox {
                rotor: nan,
                ..gearbox
            },
        ] {
            let status = jred_f32_transmission_make(Some(&mut made), Some(&info), Some(&wrong));
            assert_eq!(status, Status::Figure);
        }
        let status = jred_f32_transmission_make(Some(&mut made), Some(&info), None);
        assert_eq!(status, Status::Null);

        let mut made = MaybeUninit::uninit();
        assert_eq!(
            jred_f32_torque_limits_make(Some(&mut made), -6.0, 6.0),
            Status::Ok
        );
        assert_eq!(made.assume_init(), TorqueLimits::new(-6.0, 6.0).unwrap());
        for [least, greatest] in [[1.0, 6.0], [-6.0, -1.0], [nan, 6.0], [-6.0, nan]] {
            let status = jred_f32_torque_limits_make(Some(&mut made), least, greatest);
            assert_eq!(status, Status::Figure);
            assert_eq!(made.assume_init().limited(3.0).torque.to_bits(), 0);
        }
    }
}

#[test]
fn a_tracker_is_that_of_rust_and_parts_have_the_sizes_of_the_header() {
    let nan = f32::NAN;
    let mut made = MaybeUninit::uninit();
    assert_eq!(
        jred_tracker_make(Some(&mut made), 60.0, 5e-4, 77),
        Status::Ok
    );
    let tracker = Tracker::with_bandwidth(60.0, 5e-4).unwrap();
    // SAFETY: it was written.
    assert_eq!(
        unsafe { made.assume_init() },
        tracker.at(Phase::from_bits(77))
    );
    for [bandwidth, period] in [[0.0, 5e-4], [60.0, nan], [1e-6, 1e-6]] {
        let status = jred_tracker_make(Some(&mut made), bandwidth, period, 77);
        assert_eq!(status, Status::Figure);
    }
    assert_eq!(jred_tracker_make(None, 60.0, 5e-4, 0), Status::Null);
    assert_eq!([size_of::<Tracker>(), size_of::<Period<f32>>()], [40, 64]);
    assert_eq!(
        [
            size_of::<Transmission<f32>>(),
            size_of::<FrictionRamp<f32>>()
        ],
        [40, 12]
    );
    assert_eq!(
        [size_of::<TorqueLimits<f32>>(), size_of::<Gearbox>()],
        [8, 12]
    );
}

/// A thousand ticks of the observer, over motions, torques and frictions of any kind.
#[test]
fn the_observer_has_the_bits_of_rust() {
    let words = press();
    let info = info(&words);
    let model: Model<'_, Spline<f32>, PRESS> = Image::new(&words).unwrap().model().unwrap();
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let mut of_rust = Observer::with_bandwidth(60.0, 1e-3, &model).unwrap();
    // SAFETY: zeros are no model and no observer; the words outlive them.
    unsafe {
        let (mut memory, mut observer): (Press, Observe<f32>) = (zeroed(), zeroed());
        let length = words.len();
        assert_eq!(
            jred_spline_f32_load(&raw mut memory, PRESS, words.as_ptr(), length),
            0
        );
        let (info, none) = (Some(&info), None);
        for [bandwidth, period] in [[0.0, 1e-3], [60.0, 0.0], [f32::NAN, 1e-3]] {
            let status = jred_f32_observer_make(Some(&mut observer), info, bandwidth, period, 0);
            assert_eq!(status, Status::Figure);
        }
        assert_eq!(
            jred_f32_observer_make(none, info, 60.0, 1e-3, 0),
            Status::Null
        );
        let made = jred_f32_observer_make(Some(&mut observer), info, 60.0, 1e-3, 0);
        assert_eq!(made, Status::Ok);
        let mut phase = 0u32;
        for k in 0..1000 {
            phase = phase.wrapping_add(4_000_000 + (numbers.next() as u32 >> 14));
            let wild = k % 50 == 49;
            let torque = if wild {
                f32::any(&mut numbers)
            } else {
                (k % 97) as f32 - 40.0
            };
            let is_share = k % 3 == 0;
            let number = if is_share { 0.5 } else { 3.0 };
            let friction = if is_share {
                FrictionSign::Scaled(number)
            } else {
                FrictionSign::OfSpeed(number)
            };
            let expected = of_rust.update(&model, Phase::from_bits(phase), torque, friction);
            let mut seen = CObserved::default();
            jred_spline_f32_s21_observe(
                &raw const memory,
                &raw mut observer,
                phase,
                torque,
                number,
                is_share,
                &raw mut seen,
            );
            let same = |a: f32, b: f32| assert_eq!(a.bits(), b.bits(), "{k}");
            same(seen.load, expected.load);
            same(seen.motion.omega, expected.motion.omega);
            same(seen.motion.alpha, expected.motion.alpha);
            assert_eq!(seen.motion.phase, expected.motion.phase.to_bits(), "{k}");
            let flags = [seen.jumped, seen.limited];
            assert_eq!(flags, [expected.jumped, expected.limited], "{k}");
            assert_eq!(seen.residual, expected.residual, "{k}");
        }
    }
}
