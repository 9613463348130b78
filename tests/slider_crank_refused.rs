//! Slider-cranks without a closed form, and invalid coefficients.

use crate::support::cranks::{model_of, words_of};
use crate::support::{link_of, scale_of};
use jred::error::Error;
use jred::image::{Validity, encode, image_len};
use jred::machine::{Action, Element, Load, Machine, Marker, Window};
use jred::mechanism::{Branch, SliderCrank, SliderCrankDimensions};
use jred::number::RangeError;
use jred::slider_crank::{Coefficient, STEEPEST, SliderCrankError, form, set_in_use, terms};
use jred::table::{Format, Shape, Table, TableError};
use jred::{CurveSet, Domain, Image, ImageError, Phase, SliderCrankForm, curves};

fn press() -> Machine<SliderCrank> {
    let links = [
        link_of(9.0, 0.018, [0.006, 0.0]),
        link_of(6.5, 0.03, [0.055, 0.0]),
        link_of(42.0, 0.0, [0.0; 2]),
    ];
    let lengths = SliderCrankDimensions {
        crank: 0.03,
        rod: 0.18,
        offset: 0.0,
    };
    let mechanism = SliderCrank::new(lengths, Branch::Right, links).unwrap();
    Machine::new(mechanism).with_gravity([9.81, 0.0]).unwrap()
}

fn refused(machine: &Machine<SliderCrank>) -> SliderCrankError {
    let error = set_in_use(machine).unwrap_err();
    let by_form = form(machine, 0xffff, &mut [0.0; 18]).unwrap_err();
    assert_eq!(by_form, Error::SliderCrank(error));
    assert_eq!(by_form.to_string(), error.to_string());
    assert!(!by_form.cure().to_string().is_empty());
    error
}

#[test]
fn what_the_form_cannot_hold_is_named() {
    let weight = Load::new(SliderCrank::CRANK, Action::Moment(1.0)).unwrap();
    let force = Load::new(SliderCrank::SLIDER, Action::Force([-100.0, 0.0])).unwrap();
    let window = Window::new(Domain::Turn, [5.0, 6.0], 0.1).unwrap();
    let machine = press().with_load(weight).unwrap();
    let pressing = machine.clone().with_load(force.within(window)).unwrap();
    assert_eq!(refused(&pressing), SliderCrankError::Window(1));
    let rubbing = Load::new(SliderCrank::ROD, Action::OpposingForce(5.0)).unwrap();
    let middle = machine.clone().with_load(rubbing.at([0.09, 0.0]).unwrap());
    assert_eq!(refused(&middle.unwrap()), SliderCrankError::RubbingRod(1));
    let ends = [
        Marker::ground([0.3, 0.0]),
        Marker::on(SliderCrank::SLIDER, [0.0, 0.0]),
    ];
    let spring = Element::spring(ends, 100.0, 0.05).unwrap();
    let sprung = machine.clone().with_element(spring).unwrap();
    assert_eq!(refused(&sprung), SliderCrankError::Element(0));
    // Without them there is one.
    assert!(set_in_use(&machine.with_load(force).unwrap()).is_ok());
}

#[test]
fn a_set_without_what_the_machine_has_is_refused() {
    let machine = press();
    let set = curves::LOAD | terms::LOAD_SIN;
    assert_eq!(set_in_use(&machine), Ok(set));
    for missing in [0, curves::LOAD] {
        let refused = form(&machine, missing, &mut [0.0; 18]).unwrap_err();
        assert_eq!(refused, Error::Table(TableError::Curves(set)));
    }
    let short = form(&machine, set, &mut [0.0; 6]).unwrap_err();
    let (needed, given) = (7, 6);
    assert_eq!(
        short,
        Error::Range(RangeError::BufferTooShort { needed, given })
    );
    // Missing terms are zero.
    let mut words = [1.0; 18];
    let all = 0xff00 | curves::ALL | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
    assert_eq!(form(&machine, all, &mut words), Ok(18));
    for (part, word) in Coefficient::ALL.into_iter().zip(words) {
        let there = [
            Coefficient::Ratio,
            Coefficient::Inertia,
            Coefficient::InertiaSquare,
            Coefficient::InertiaSin,
            Coefficient::Load,
            Coefficient::LoadSin,
        ];
        assert_eq!(word.abs() > 0.0, there.contains(&part), "{part}: {word}");
    }
}

/// Gravity rotated by a rounding does not create a term.
#[test]
fn roundings_of_a_turned_drawing_are_no_terms() {
    let turned = press().with_gravity([9.81, 1e-10]).unwrap();
    assert_eq!(set_in_use(&turned), Ok(curves::LOAD | terms::LOAD_SIN));
    let turned = press().with_gravity([9.81, 1e-6]).unwrap();
    let both = curves::LOAD | terms::LOAD_SIN | terms::LOAD_COS;
    assert_eq!(set_in_use(&turned), Ok(both));
}

fn refused_words(words: &[f32], set: CurveSet) -> TableError {
    match model_of(words, set).map(|_| ()) {
        Err(Error::Table(error)) => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn words_that_are_no_machine_are_refused() {
    let sound = [0.25, 0.1, 0.02, 0.03, -0.004];
    assert!(model_of(&sound, 0).is_ok());
    for bad in [f32::NAN, f32::INFINITY, -1e31] {
        for word in 0..5 {
            let mut words = sound;
            words[word] = bad;
            let (curve, cell) = (0, 0);
            assert_eq!(refused_words(&words, 0), TableError::Range { curve, cell });
        }
        let set = curves::LOAD | curves::CONSTANT_COULOMB;
        let (curve, cell) = (3, 0);
        let words = [&sound[..], &[1.0, bad]].concat();
        assert_eq!(
            refused_words(&words, set),
            TableError::Range { curve, cell }
        );
    }
    let set = curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
    for (word, curve) in [(5, 2), (6, 3)] {
        let mut words = [&sound[..], &[0.1, 0.2]].concat();
        assert!(model_of(&words, set).is_ok());
        words[word] = 1e31;
        let cell = 0;
        assert_eq!(
            refused_words(&words, set),
            TableError::Range { curve, cell }
        );
    }
    // The rod: (r + |e|)/l on either side of the limit, for all signs.
    for (ratio, offset) in [(STEEPEST, 0.0), (-0.5, -0.45), (0.0, 0.95)] {
        assert!(
            model_of(&[ratio, offset, 1.0, 0.0, 0.0], 0).is_ok(),
            "{ratio}"
        );
        let longer = [1.001 * ratio, 1.001 * offset, 1.0, 0.0, 0.0];
        let error = refused_words(&longer, 0);
        assert_eq!(error, TableError::ShortRod);
        assert!(error.to_string().contains("0.95") && error.cure().to_string().contains("table"));
    }
    // J: negative somewhere, and too close to zero.
    let nowhere = [0.25, 0.0, 0.0, 1.0, 0.0];
    let phase = Phase::default();
    assert_eq!(
        refused_words(&nowhere, 0),
        TableError::NoInertiaAt { phase }
    );
    let nearly = [0.25, 0.0, 1e-6, 1.0, 0.0];
    assert!(matches!(
        refused_words(&nearly, 0),
        TableError::InertiaNotShown { .. }
    ));
    let little = [0.25, 0.0, 0.005, 1.0, 0.0];
    assert!(model_of(&little, 0).is_ok());
    // Between the first 64 positions it would be negative.
    let hidden = [0.0, 0.0, 0.0, 1.0, 0.0];
    assert!(model_of(&hidden, 0).is_err());
    let huge = [0.25, 0.0, 9e29, 9e29, 0.0];
    assert_eq!(refused_words(&huge, 0), TableError::TorqueRange { cell: 0 });
}

#[test]
fn shapes_that_do_not_suit_are_refused() {
    let words = [0.25, 0.1, 0.02, 0.03, -0.004];
    let shape = Shape::slider_crank(0);
    let table = |words, shape| Table::<SliderCrankForm>::new(words, shape).map(|_| ());
    assert_eq!(table(&words, shape), Ok(()));
    let (needed, given) = (5, 4);
    assert_eq!(
        table(&words[..4], shape),
        Err(TableError::Length { needed, given })
    );
    assert_eq!(
        table(&words, Shape { cells: 1, ..shape }),
        Err(TableError::Cells(1))
    );
    let stroke = Domain::Stroke { from: 0.0, to: 1.0 };
    assert_eq!(
        table(
            &words,
            Shape {
                domain: stroke,
                ..shape
            }
        ),
        Err(TableError::Stroke)
    );
    // Units in which J·ω² is a torque are accepted, others are not.
    for (inertia, expected) in [(2.0, Ok(())), (2.1, Err(TableError::SpeedBase))] {
        let mut shape = shape;
        shape.scale = scale_of(8.0, 2.0, inertia);
        assert_eq!(table(&words, shape), expected);
    }
    // A term without its curve, and bits without a meaning.
    let orphans = [
        terms::LOAD_SIN,
        terms::LOAD_ROD | curves::VISCOUS,
        terms::VISCOUS_COS | curves::CONSTANT_VISCOUS,
        terms::COULOMB_ROD,
        curves::RECIPROCAL,
        1 << 6,
        1 << 7,
    ];
    for set in orphans {
        assert!(!SliderCrankForm::accepts(set), "{set:#x}");
        assert_eq!(
            table(&[0.0; 18], Shape::slider_crank(set)),
            Err(TableError::Curves(set))
        );
    }
    let accepted = (0..=u16::MAX).filter(|set| SliderCrankForm::accepts(*set));
    // J in 2 ways, c and b constant or not in 2 × 2, a load in 1 + 2⁴, b in 1 + 2², c in 1 + 2.
    assert_eq!(accepted.count(), 2 * 4 * 17 * 5 * 3);
}

/// Damaged words in an image with a recomputed CRC: refused, or ticked without a panic to a finite number.
#[test]
fn damaged_coefficients_are_refused_or_ticked() {
    let (words, set) = words_of(&press()).unwrap();
    let model = model_of(&words, set).unwrap();
    let validity = Validity {
        max_speed: 60.0,
        max_acceleration: 400.0,
        torque_error: 0.01,
    };
    let (mut accepted, mut refused) = (0, 0);
    for word in 0..words.len() {
        for bit in 0..32 {
            let mut damaged = words.clone();
            damaged[word] = f32::from_bits(damaged[word].to_bits() ^ (1 << bit));
            match model_of(&damaged, set) {
                Ok(model) => {
                    accepted += 1;
                    for k in 0..64u32 {
                        let torque = model.torque(Phase::from_bits(k << 26), 10.0, 100.0);
                        assert!(torque.is_finite(), "{damaged:?}");
                    }
                }
                Err(_) => refused += 1,
            }
        }
    }
    assert!(accepted > 100 && refused > 10, "{accepted}, {refused}");
    // Another set in the header has another length, so it is refused.
    let mut buffer = vec![0; image_len::<SliderCrankForm>(0, set)];
    let mut image = encode(model.table(), validity, &mut buffer)
        .unwrap()
        .to_vec();
    image[13] = 0;
    let image = crate::support::images::sealed(image);
    let read = Image::new(&image).unwrap().any_model::<SliderCrankForm>();
    assert!(matches!(
        read.map(|_| ()),
        Err(ImageError::Table(TableError::Length {
            needed: 6,
            given: 7
        }))
    ));
}
