//! Rows of a log become samples at equal steps.

use std::f64::consts::TAU;

use jred_analysis::identify::{RecordFault, Repair, samples};

#[test]
fn rows_become_samples() {
    let time: Vec<f64> = (0..1000).map(|k| f64::from(k) * 1e-3).collect();
    let position: Vec<f64> = time.iter().map(|t| (9.0 * t).rem_euclid(TAU)).collect();
    let torque: Vec<f64> = time.iter().map(|t| (3.0 * t).sin()).collect();
    let (whole, repairs) = samples(&time, &position, &torque).unwrap();
    assert_eq!(repairs, []);
    assert!((whole.step - 1e-3).abs() < 1e-12);
    // An encoder of one turn is unwrapped.
    assert!((whole.position[999] - 9.0 * 0.999).abs() < 1e-9);
    let without = |rows: std::ops::Range<usize>| {
        let cut = |of: &[f64]| [&of[..rows.start], &of[rows.end..]].concat();
        samples(&cut(&time), &cut(&position), &cut(&torque)).unwrap()
    };
    let (gap, repairs) = without(400..450);
    assert!(
        matches!(
            repairs[..],
            [Repair::Gaps {
                count: 1,
                row: 401,
                ..
            }]
        ),
        "{repairs:?}"
    );
    assert_eq!(gap.position.len(), 1000);
    assert_eq!(gap.faulty.iter().filter(|faulty| **faulty).count(), 50);
    assert!((gap.position[425] - 9.0 * 0.425).abs() < 1e-9);
    let mut twice = time.clone();
    twice[500] = twice[499];
    let (_, repairs) = samples(&twice, &position, &torque).unwrap();
    assert!(matches!(
        repairs[0],
        Repair::Duplicates { count: 1, row: 501 }
    ));
    twice[500] = 0.1;
    assert!(matches!(
        samples(&twice, &position, &torque).unwrap_err(),
        RecordFault::Backwards { row: 501, .. }
    ));
    let limited: Vec<f64> = torque.iter().map(|torque| torque.min(0.08)).collect();
    let (limited, repairs) = samples(&time, &position, &limited).unwrap();
    assert!(
        matches!(repairs[..], [Repair::Saturated { torque: 0.08, .. }]),
        "{repairs:?}"
    );
    assert!(limited.faulty[500] && !limited.faulty[0]);
}
