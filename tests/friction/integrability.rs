//! Holonomic or not: (III.6), Frobenius, and the friction drive.

use jred::friction::integrability::{
    Integrability, StageConstraint, SystemIntegrability, dependent, potential, test, test_system,
};
use jred::friction::{
    Arrangement, Contact, Creep, Drive, Dual, Flow, Place, Ramp, Sine, Stage, Variable,
};
use jred::motion::Law;

use crate::support::{assert_near, budget};

/// Places over N variables, away from symmetries.
fn places<const N: usize>() -> [[f64; N]; 5] {
    std::array::from_fn(|k| {
        std::array::from_fn(|i| (1.7 * k as f64 + 0.9 * i as f64 + 0.4).sin() + 1.6)
    })
}

fn zero<const N: usize>() -> Dual<N> {
    Dual::constant(0.0)
}

// Variables of the two-shaft forms: α₂, α₁, t.

#[test]
fn constant_ratio_is_holonomic() {
    let j = 1.4;
    let found = test(
        |[a, _, _]: &[Dual<3>; 3]| [*a * 0.0 + 1.0, Dual::constant(-j), zero()],
        &places(),
    );
    assert_eq!(found, Ok(Integrability::Constant([1.0, -j, 0.0])));
    assert!(found.unwrap().to_string().contains("(III.18)"));
}

#[test]
fn a_ratio_over_the_angle_is_a_total_differential() {
    let form =
        |[_, a, _]: &[Dual<3>; 3]| [Dual::constant(1.0), -(a.sin_cos().0 * 0.3 + 1.2), zero()];
    assert_eq!(test(form, &places()), Ok(Integrability::Exact));
    // Φ = α₂ − (1.2·α₁ − 0.3·cos α₁)
    let phi = |[b, a, _]: [f64; 3]| b - (1.2 * a - 0.3 * a.cos());
    let (from, to) = ([0.3, -1.0, 0.0], [2.0, 2.5, 4.0]);
    let found = potential(form, from, to).unwrap();
    assert_near("Φ", found, phi(to) - phi(from), budget::RELATION);
    // And α₂ itself.
    let angle = dependent(form, from, to, 0, 400).unwrap();
    let expected = from[0] + 1.2 * 3.5 - 0.3 * (2.5f64.cos() - 1f64.cos());
    assert_near("α₂", angle, expected, budget::RELATION);
}

#[test]
fn a_ratio_over_time_is_not_holonomic() {
    // θ∧dθ = −j′·dα₂∧dt∧dα₁ = +j′·dα₂∧dα₁∧dt
    let form = |[_, _, t]: &[Dual<3>; 3]| [Dual::constant(1.0), -(*t * *t * 0.5 + 1.0), zero()];
    let Integrability::NonHolonomic {
        variables,
        value,
        place,
    } = test(form, &places()).unwrap()
    else {
        panic!("holonomic");
    };
    assert_eq!(variables, [0, 1, 2]);
    assert_near("θ∧dθ", value, place[2], budget::IDENTITY);
    // The largest of the places.
    let latest = places::<3>().iter().fold(0.0f64, |most, p| most.max(p[2]));
    assert_near("place", place[2], latest, 0.0);
    // Without a relation, the way matters.
    let from = [0.0, 0.0, 0.0];
    let straight = dependent(form, from, [0.0, 1.0, 1.0], 0, 200).unwrap();
    let corner = dependent(form, from, [0.0, 1.0, 0.0], 0, 200).unwrap();
    assert!((straight - corner).abs() > 0.1);
}

#[test]
fn a_rolling_disc_is_not_holonomic() {
    // x, y, heading ψ, roll: dx = R·cos ψ·dχ, dy = R·sin ψ·dχ.
    let x = |[_, _, psi, _]: &[Dual<4>; 4]| {
        [Dual::constant(1.0), zero(), zero(), psi.sin_cos().1 * -0.3]
    };
    let y = |[_, _, psi, _]: &[Dual<4>; 4]| {
        [zero(), Dual::constant(1.0), zero(), psi.sin_cos().0 * -0.3]
    };
    assert!(!test(x, &places()).unwrap().is_holonomic());
    let system = test_system(|q| [x(q), y(q)], &places()).unwrap();
    let SystemIntegrability::NonHolonomic {
        variables,
        relations,
        ..
    } = system
    else {
        panic!("holonomic");
    };
    // ψ and the roll (or what stands for it) are free; one combination of the two survives the first derivation.
    assert!(variables.contains(&2), "{variables:?}");
    assert_eq!(relations, 1);
    // Rolling along a fixed line it is holonomic.
    let line = |q: &[Dual<4>; 4]| {
        let fixed = [zero(), zero(), Dual::constant(1.0), zero()];
        [x(q), y(q), fixed]
    };
    assert_eq!(
        test_system(line, &places()),
        Ok(SystemIntegrability::Holonomic)
    );
}

#[test]
fn an_integrating_factor_is_recognised() {
    // y·dx − x·dy: 1/y² makes it d(x/y).
    let form = |[x, y]: &[Dual<2>; 2]| [*y, -*x];
    let found = test(form, &places()).unwrap();
    assert!(matches!(
        found,
        Integrability::IntegratingFactor {
            variables: [0, 1],
            curl: -2.0,
            ..
        }
    ));
    let to = dependent(form, [2.0, 1.0], [5.0, 0.0], 1, 100).unwrap();
    assert_near("x/y", 5.0 / to, 2.0, budget::RELATION);
    // Three variables, where it is no matter of course: y·z·dx + x·z·dy − x·y·dz times 1/z².
    let form = |[x, y, z]: &[Dual<3>; 3]| [*y * *z, *x * *z, -(*x * *y)];
    let found = test(form, &places()).unwrap();
    assert!(
        matches!(found, Integrability::IntegratingFactor { .. }),
        "{found}"
    );
    let from = [1.0, 2.0, 3.0];
    let z = dependent(form, from, [2.0, 1.5, 0.0], 2, 400).unwrap();
    assert_near("xy/z", 2.0 * 1.5 / z, 2.0 / 3.0, budget::RELATION);
    // And its neighbour that has none: z·dx + dy.
    let form = |[_, _, z]: &[Dual<3>; 3]| [*z, Dual::constant(1.0), zero()];
    let Integrability::NonHolonomic {
        variables, value, ..
    } = test(form, &places()).unwrap()
    else {
        panic!("holonomic");
    };
    // θ∧dθ = dy∧dz∧dx
    assert_eq!((variables, value), ([0, 1, 2], 1.0));
}

/// (III.6) is not invariant: a total differential times any function loses it and stays holonomic.
#[test]
fn an_integrating_factor_hides_behind_sums() {
    // e-free: θ = f·dΦ with Φ = x·y + sin z + t², f = 2 + cos(x·t).
    let form = |[x, y, z, t]: &[Dual<4>; 4]| {
        let f = (*x * *t).sin_cos().1 + 2.0;
        [*y * f, *x * f, z.sin_cos().1 * f, *t * f * 2.0]
    };
    let found = test(form, &places()).unwrap();
    assert!(
        matches!(found, Integrability::IntegratingFactor { .. }),
        "{found}"
    );
    // A millionth of it turned: not holonomic any more.
    let spoilt = move |q: &[Dual<4>; 4]| {
        let mut c = form(q);
        c[2] = c[2] + q[0] * 1e-6;
        c
    };
    assert!(!test(spoilt, &places()).unwrap().is_holonomic());
}

#[test]
fn systems_are_more_than_their_parts() {
    // θ₁ = dz − y·dx alone is not holonomic; with θ₂ = dx it is.
    let first = |[_, y, _]: &[Dual<3>; 3]| [-*y, zero(), Dual::constant(1.0)];
    assert!(!test(first, &places()).unwrap().is_holonomic());
    let both = |q: &[Dual<3>; 3]| [first(q), [Dual::constant(1.0), zero(), zero()]];
    assert_eq!(
        test_system(both, &places()),
        Ok(SystemIntegrability::Holonomic)
    );
    // One form is the system of one.
    let found = test_system(|q| [first(q)], &places()).unwrap();
    assert!(matches!(
        found,
        SystemIntegrability::NonHolonomic {
            form: 0,
            relations: 0,
            ..
        }
    ));
}

/// A fan of two equal variators (III.19): neither is holonomic, yet their outputs keep one relation.
#[test]
fn equal_variators_keep_a_relation() {
    let fan = |second: f64| {
        // α₁, α₂, α₃, t
        move |[_, _, _, t]: &[Dual<4>; 4]| {
            let (one, j) = (Dual::constant(1.0), *t * *t + 1.0);
            let other = if second == 0.0 {
                *t * 0.0 + 1.5
            } else {
                t.sin_cos().0 * second + 1.0
            };
            [[-j, one, zero(), zero()], [-other, zero(), one, zero()]]
        }
    };
    let equal = |q: &[Dual<4>; 4]| {
        let [first, _] = fan(0.0)(q);
        [first, [first[0], zero(), Dual::constant(1.0), zero()]]
    };
    let left = |system| match system {
        SystemIntegrability::NonHolonomic::<4> {
            relations,
            variables,
            ..
        } => (relations, variables),
        SystemIntegrability::Holonomic => panic!("holonomic"),
    };
    let (relations, variables) = left(test_system(equal, &places()).unwrap());
    assert_eq!(relations, 1);
    assert!(variables.contains(&3), "time is one of {variables:?}");
    // A constant ratio beside a shifted one is a relation as well.
    assert_eq!(left(test_system(fan(0.0), &places()).unwrap()).0, 1);
}

#[test]
fn stages_say_what_they_are() {
    let shift = Ramp::new(Variable::Time, 5.0, 0.01, [1.0, 2.0], Law::Polynomial345).unwrap();
    let slow = Sine::new(Variable::Time, 1.0, 0.2, 0.7, 0.0).unwrap();
    let angle = Sine::new(Variable::Angle, 1.0, 0.2, 2.0, 0.0).unwrap();
    let creep = Creep::new(0.02, 10.0).unwrap();
    let slipping = slow_slip();
    let both = |p: Place| (p.phi * 2.0 + p.t * 0.1).sin_cos().0 * 0.2 + 1.0;
    let stages = [
        Stage::new(1.25)
            .unwrap()
            .with_slip(0.2, Flow::FirstDrives)
            .unwrap(),
        Stage::new(&shift).unwrap(),
        Stage::new(1.0)
            .unwrap()
            .with_slip(&slipping, Flow::SecondDrives)
            .unwrap(),
        Stage::new(&angle).unwrap(),
        Stage::new(1.0)
            .unwrap()
            .with_slip(&creep, Flow::SecondDrives)
            .unwrap(),
        Stage::new(&both).unwrap(),
        Stage::new(&slow).unwrap(),
    ];
    let drive = Drive::new(Arrangement::Fan, Contact::Ideal, &stages).unwrap();
    let tau = std::f64::consts::TAU;
    let found = drive.integrability([0.0, 10.0], [0.0, tau]).unwrap();
    assert_eq!(found[0], StageConstraint::Proportional { speed: 1.0 });
    // A shift of 10 ms within 10 s lies between the places of the grid: its change betrays it.
    assert!(
        matches!(found[1], StageConstraint::NonHolonomic { rate, t, .. } if rate > 1.0 && (t - 5.0).abs() < 0.1)
    );
    assert!(matches!(found[2], StageConstraint::NonHolonomic { .. }));
    assert_eq!(found[3], StageConstraint::Integral);
    assert_eq!(found[4], StageConstraint::Constitutive);
    assert!(matches!(found[5], StageConstraint::NonHolonomic { .. }));
    let StageConstraint::NonHolonomic { rate, .. } = found[6] else {
        panic!("{:?}", found[6]);
    };
    assert_near("∂j/∂t", rate.abs(), 0.2 * 0.7, budget::GRID_MAXIMUM);
    let holonomic: Vec<bool> = found.iter().map(StageConstraint::is_holonomic).collect();
    assert_eq!(holonomic, [true, false, false, true, false, false, false]);
    assert!(
        found[1]
            .to_string()
            .starts_with("non-holonomic: θ∧dθ = -(∂j/∂t) dα_b∧dt∧dα_a")
    );
    // α₂ = ∫ j dα₁
    let angle = drive.stages()[3].angle(0.0, 0.5, 2.5).unwrap();
    let expected = 2.0 - 0.1 * (5f64.cos() - 1f64.cos());
    assert_near("α₂", angle, expected, budget::RELATION);
}

fn slow_slip() -> Ramp {
    Ramp::linear(Variable::Time, 0.0, 100.0, [0.01, 0.02]).unwrap()
}

#[test]
fn what_is_wrong_is_said() {
    let text = |r: Result<Integrability<2>, jred::Error>| r.unwrap_err().to_string();
    let form = |[x, y]: &[Dual<2>; 2]| [*y, -*x];
    assert_eq!(
        text(test(form, &[])),
        "number of places is 0, but must be greater than zero"
    );
    assert_eq!(
        text(test(form, &[[0.0, 0.0]])),
        "largest coefficient of the constraint is 0, but must be greater than zero"
    );
    assert_eq!(
        text(test(|[x, y]: &[Dual<2>; 2]| [*x / 0.0, *y], &[[1.0, 1.0]])),
        "coefficient of the constraint is not a finite number"
    );
    let twice = |[x, y]: &[Dual<2>; 2]| [[*y, -*x], [*y * 2.0, *x * -2.0]];
    let error = test_system(twice, &places()).unwrap_err().to_string();
    assert!(
        error.starts_with("independent part of a constraint of the system is "),
        "{error}"
    );
    let error = dependent(form, [1.0, 0.0], [1.0, 2.0], 0, 10)
        .unwrap_err()
        .to_string();
    assert!(
        error.starts_with("size of the dependent variable's coefficient is 0"),
        "{error}"
    );
    assert!(dependent(form, [1.0, 1.0], [1.0, 2.0], 2, 10).is_err());
    assert!(dependent(form, [1.0, 1.0], [1.0, 2.0], 0, 0).is_err());
}
