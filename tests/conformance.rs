//! One suite for every mechanism: random machines at random positions and motions.
//!
//! - Both markers of every joint coincide, in position and in every transfer function, and no joint does work.
//! - d'Alembert's drive torque equals that of the reduced equation, and every link is in equilibrium about the point of each of its reactions.
//! - The reduced kinetic energy is the sum over the links.
//! - Transfer functions, J′, J″ and U′ are the derivatives that their names state.
//! - No link jumps over the drive's range.
//!
//! The closed forms against the general solver: `library_as_linkages.rs`. Properties of a single mechanism are in its own file.

use std::f64::consts::TAU;

use proptest::prelude::*;

use crate::support::derivatives::derivatives;
use crate::support::jointed::{holds, turns};
use crate::support::{cams, config};
use crate::{
    ball_screw, disc_cam, four_bar, geneva, hoist, indexing_cam, inverted_slider_crank,
    parallel_shafts, planetary, rack, scotch_yoke, six_link, toggle_press,
};

/// The tests of one mechanism: its machines, ranges of φ, ω and α, number of cases and seed, and the positions of a turn at which its links are
/// followed (planets do not return after a turn).
macro_rules! conforms {
    ($mechanism:ident: $machines:expr, $phi:expr, $omega:expr, $alpha:expr, $cases:literal from $seed:literal $(, $steps:literal)?) => {
        mod $mechanism {
            use super::*;

            proptest! {
                #![proptest_config(config($cases, $seed))]

                #[test]
                fn joints_close_and_forces_balance(machine in $machines, phi in $phi, omega in $omega, alpha in $alpha) {
                    holds(&machine, phi, omega, alpha);
                }

                #[test]
                fn curves_are_derivatives(machine in $machines, phi in $phi) {
                    derivatives(&machine, phi);
                }

                $(#[test]
                fn links_move_without_jumps(machine in $machines) {
                    turns(machine.mechanism(), $steps);
                })?
            }
        }
    };
}

conforms!(screws: ball_screw::machines(), -200.0..200.0_f64, -300.0..300.0_f64, -1000.0..1000.0_f64, 150 from 45, 100);
conforms!(racks: rack::machines(), -20.0..20.0_f64, -15.0..15.0_f64, -100.0..100.0_f64, 150 from 44, 100);
conforms!(hoists: hoist::machines(), -60.0..60.0_f64, -15.0..15.0_f64, -100.0..100.0_f64, 150 from 46, 100);
conforms!(yokes: scotch_yoke::machines(), -20.0..20.0_f64, -15.0..15.0_f64, -100.0..100.0_f64, 200 from 41, 400);
conforms!(
    levers: inverted_slider_crank::machines(),
    -20.0..20.0_f64, -15.0..15.0_f64, -100.0..100.0_f64, 200 from 42, 3000
);
conforms!(
    shafts: parallel_shafts::machines(),
    -60.0..60.0_f64, -15.0..15.0_f64, -100.0..100.0_f64, 150 from 47, 50
);
conforms!(
    planets: planetary::machines().prop_filter_map("gears that do not fit", |machine| machine),
    -60.0..60.0_f64, -15.0..15.0_f64, -100.0..100.0_f64, 200 from 48
);
conforms!(
    wheels: geneva::machines(),
    // One angle anywhere, one in or close to the engagement.
    prop_oneof![-60.0..60.0_f64, (-10..10_i32, -1.3..1.3_f64).prop_map(|(turn, near)| near + TAU * f64::from(turn))],
    -15.0..15.0_f64, -100.0..100.0_f64, 400 from 43, 2000
);
conforms!(
    indexers: indexing_cam::machines(),
    -60.0..60.0_f64, -15.0..15.0_f64, -100.0..100.0_f64, 400 from 49, 2000
);
conforms!(
    six_links: six_link::spec().prop_map(|spec| spec.machine()),
    -7.0..7.0_f64, -40.0..40.0_f64, -500.0..500.0_f64, 300 from 0x0511, 7200
);
conforms!(
    presses: toggle_press::spec().prop_map(|spec| spec.machine()),
    -7.0..7.0_f64, -40.0..40.0_f64, -500.0..500.0_f64, 300 from 0x0701, 7200
);
conforms!(
    four_bars: four_bar::spec().prop_map(|spec| spec.machine()),
    -7.0..7.0_f64, -40.0..40.0_f64, -500.0..500.0_f64, 200 from 0x04b1, 7200
);
conforms!(
    disc_cams: cams::cam().prop_map(disc_cam::loaded),
    -7.0..14.0_f64, -60.0..60.0_f64, -300.0..300.0_f64, 60 from 0x0ca1, 1440
);
