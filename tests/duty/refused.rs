//! Limits, ticks and windows that a duty meter refuses.

use jred::duty::{Curve, LimitError as Error, Limits, Meter, Window};

#[test]
fn limits_that_cannot_be_meant_are_refused() {
    let curve = Curve::<f64>::new;
    let nine: Vec<[f64; 2]> = (0..9).map(|k| [f64::from(k), 1.0]).collect();
    assert_eq!(curve(&[]), Err(Error::Points { given: 0 }));
    assert_eq!(curve(&nine), Err(Error::Points { given: 9 }));
    assert!(matches!(
        curve(&[[0.0, f64::NAN]]),
        Err(Error::NotFinite(_))
    ));
    assert!(matches!(curve(&[[-1.0, 1.0]]), Err(Error::Negative(_))));
    assert!(matches!(curve(&[[0.0, -1.0]]), Err(Error::Negative(_))));
    assert_eq!(
        curve(&[[5.0, 1.0], [5.0, 2.0]]),
        Err(Error::NotRising { point: 1 })
    );
    assert!(curve(&nine[..8]).is_ok());

    let meter = |limits, step, window| Meter::<f64>::new(limits, step, window);
    let none = Limits::default;
    let forgets = |tau| Window::Exponential(tau);
    assert!(matches!(
        meter(none(), 0.0, Window::SinceStart),
        Err(Error::NotPositive(_))
    ));
    assert!(matches!(
        meter(none(), f64::NAN, Window::SinceStart),
        Err(Error::NotFinite(_))
    ));
    assert!(matches!(
        meter(none(), 1.0, forgets(9.0)),
        Err(Error::WindowTooShort)
    ));
    assert!(matches!(
        meter(none(), 1.0, forgets(f64::INFINITY)),
        Err(Error::NotFinite(_))
    ));
    let mut negative = none();
    negative.speed = Some(-1.0);
    assert!(matches!(
        meter(negative, 1.0, Window::SinceStart),
        Err(Error::Negative(_))
    ));
    // A drive that must not regenerate has a limit of zero.
    let mut zero = none();
    zero.regenerative_power = Some(0.0);
    assert!(meter(zero, 1.0, Window::SinceStart).is_ok());
}

#[test]
fn what_is_wrong_is_said_with_its_cure() {
    for (error, words, cure) in [
        (
            Error::NotFinite("peak"),
            "peak is not a finite number",
            "neither NaN nor infinite",
        ),
        (
            Error::Negative("speed"),
            "speed must not be negative",
            "zero or a positive value",
        ),
        (
            Error::NotPositive("step"),
            "step must be greater than zero",
            "greater than zero",
        ),
        (Error::Points { given: 9 }, "9 points", "1 to 8 points"),
        (
            Error::NotRising { point: 3 },
            "point 3",
            "order of their speeds",
        ),
        (Error::WindowTooShort, "ten ticks", "longer time constant"),
    ] {
        assert!(error.to_string().contains(words), "{error}");
        assert!(error.cure().to_string().contains(cure), "{}", error.cure());
    }
}
