//! The planetary gear: Willis' equation derived independently, energy planet by planet, forces.

use crate::support::spoken;
use jred::machine::PoseError;
use jred::mechanism::{BuildError, PlanetaryDimensions};
use jred::number::RangeError;
use std::f64::consts::TAU;

use crate::support::machines::loaded;
use crate::support::{assert_near, budget, config, link_of};
use jred::machine::{Action, Link, Load, Machine, Mechanism, Reducible};
use jred::mechanism::{DimensionError, Member, Planetary, PlanetaryGears};
use proptest::prelude::*;

const MEMBERS: [Member; 3] = [Member::Sun, Member::Carrier, Member::Ring];

fn rotors(inertia: [f64; 4]) -> [Link; 4] {
    inertia.map(|inertia| Link::rotor(inertia).unwrap())
}

fn index(member: Member) -> usize {
    MEMBERS.iter().position(|m| *m == member).unwrap()
}

/// The six ways to use a planetary gear: input and fixed member.
fn uses() -> impl Iterator<Item = (Member, Member)> {
    let pairs = MEMBERS.into_iter().flat_map(|a| MEMBERS.map(|b| (a, b)));
    pairs.filter(|(input, fixed)| input != fixed)
}

/// The tabular method: all locked and turned by x, plus carrier held and sun turned by y.
fn tabular([sun, planet, ring]: [f64; 3], input: Member, fixed: Member) -> [f64; 4] {
    let held = [1.0, 0.0, -sun / ring, -sun / planet];
    // x + y·held = 0 for the fixed member and 1 for the input.
    let (f, i) = (held[index(fixed)], held[index(input)]);
    let y = 1.0 / (i - f);
    let x = -y * f;
    held.map(|h| x + y * h)
}

#[test]
fn speeds_by_the_tabular_method() {
    for (teeth, planets) in [
        ([30, 20, 70], 4),
        ([12, 48, 108], 3),
        ([18, 14, 48], 3),
        ([24, 24, 72], 2),
    ] {
        let gears = PlanetaryGears::new(PlanetaryDimensions {
            sun: teeth[0],
            planet: teeth[1],
            ring: teeth[2],
            planets,
            centres: 0.1,
        })
        .unwrap();
        for (input, fixed) in uses() {
            let gear = Planetary::new(gears, input, fixed, rotors([0.0; 4])).unwrap();
            let expected = tabular(teeth.map(f64::from), input, fixed);
            let size = budget::CLOSED_FORM * crate::support::largest(expected);
            for (found, expected) in gear.speeds().into_iter().zip(expected) {
                assert_near("speed", found, expected, size);
            }
            let frames = gear.frames(2.0).unwrap();
            let output = frames[index(gear.output())].psi;
            assert_near("ratio", gear.ratio() * output.d1, 1.0, budget::CLOSED_FORM);
            assert!(gear.output() != input && gear.output() != fixed);
        }
    }
    // The textbook case: fixed ring, sun drives, i = 1 + z_r/z_s.
    let gears = PlanetaryGears::new(PlanetaryDimensions {
        sun: 30,
        planet: 20,
        ring: 70,
        planets: 4,
        centres: 0.1,
    })
    .unwrap();
    let gear = Planetary::new(gears, Member::Sun, Member::Ring, rotors([0.0; 4])).unwrap();
    assert_near(
        "i",
        gear.ratio(),
        1.0 + 7.0 / 3.0,
        budget::CLOSED_FORM * 4.0,
    );
    let star = Planetary::new(gears, Member::Sun, Member::Carrier, rotors([0.0; 4])).unwrap();
    assert_near("star", star.ratio(), -7.0 / 3.0, budget::CLOSED_FORM * 4.0);
}

/// Each planet at its own position, with orbit and spin.
#[test]
fn inertia_of_planets_one_by_one() {
    let (teeth, count, a) = ([30, 20, 70], 5, 0.12);
    let (mass, spin) = (1.7, 0.004);
    let links = [
        Link::rotor(0.003).unwrap(),
        link_of(6.0, 0.05, [0.0, 0.0]),
        Link::rotor(0.4).unwrap(),
        link_of(mass, spin, [0.0, 0.0]),
    ];
    let gears = PlanetaryGears::new(PlanetaryDimensions {
        sun: teeth[0],
        planet: teeth[1],
        ring: teeth[2],
        planets: count,
        centres: a,
    })
    .unwrap();
    for (input, fixed) in uses() {
        let speeds = tabular(teeth.map(f64::from), input, fixed);
        let gear = Planetary::new(gears, input, fixed, links).unwrap();
        let machine = Machine::new(gear);
        let omega = 3.0;
        let [s, c, r, p] = speeds.map(|speed| speed * omega);
        let mut energy = 0.5 * (0.003 * s * s + 0.05 * c * c + 0.4 * r * r);
        for k in 0..count {
            // The planet's centre moves perpendicular to its radius, at any position.
            let (sin, cos) = (TAU * f64::from(k) / f64::from(count)).sin_cos();
            let velocity = [-a * sin * c, a * cos * c];
            energy += 0.5 * mass * (velocity[0].powi(2) + velocity[1].powi(2)) + 0.5 * spin * p * p;
        }
        let reduced = machine.reduction(0.7).unwrap();
        let found = 0.5 * reduced.inertia * omega * omega;
        assert_near("energy", found, energy, budget::CLOSED_FORM * energy);
        assert_eq!(reduced.inertias()[1..], [0.0, 0.0]);
    }
}

/// Moments on the gear as a whole balance, and the mesh forces are those of the textbook: T_sun over the sun's radius.
#[test]
fn forces_of_the_textbook() {
    let (teeth, a, load) = ([30, 20, 70], 0.12, -500.0);
    let gears = PlanetaryGears::new(PlanetaryDimensions {
        sun: teeth[0],
        planet: teeth[1],
        ring: teeth[2],
        planets: 4,
        centres: a,
    })
    .unwrap();
    let [sun, ring] = gears.pitch_radii();
    assert_near("r_s", sun, 0.072, budget::CLOSED_FORM);
    assert_near("r_r", ring, 0.168, budget::CLOSED_FORM);
    let gear = Planetary::new(gears, Member::Sun, Member::Ring, rotors([0.0; 4])).unwrap();
    let machine = Machine::new(gear)
        .with_gravity([0.0, -9.81])
        .and_then(|m| m.with_flywheel(0.001))
        .and_then(|m| m.with_load(Load::new(Planetary::CARRIER, Action::Moment(load))?))
        .unwrap();
    for phi in [0.0, 1.0, 5.0, 40.0] {
        let forces = machine.forces(phi, 20.0, 0.0).unwrap();
        let near = |what: &str, found: f64, expected: f64| {
            assert_near(what, found, expected, budget::REACTIONS * 5e3);
        };
        let torque = -load * 30.0 / 100.0;
        near("drive", forces.drive, torque);
        // Ground holds the ring: T_ring = −T_sun − T_carrier.
        near("ring", forces.reactions[2].moment, -torque - load);
        let carrier = machine.mechanism().frames(phi).unwrap()[Planetary::CARRIER]
            .psi
            .value;
        let along = [-carrier.sin(), carrier.cos()];
        let tangential = |k: usize| {
            let [x, y] = forces.reactions[k].force;
            x * along[0] + y * along[1]
        };
        // Planets without inertia: equal mesh forces, and twice that on the pins.
        near("sun mesh", tangential(5), torque / sun);
        near("ring mesh", tangential(6), torque / sun);
        near("pins", tangential(3), -2.0 * torque / sun);
        for k in 0..3 {
            near("bearing x", forces.reactions[k].force[0], 0.0);
            near("bearing y", forces.reactions[k].force[1], 0.0);
        }
    }
}

prop_compose! {
    pub(crate) fn machines()(
        (sun, planet, count) in (8..60_u32, 8..60_u32, 2..6_u32),
        shift in -2..=2_i32,
        a in 0.02..0.5_f64,
        choice in 0..6_usize,
        inertia in [1e-4..0.1, 1e-3..0.5, 1e-3..0.5, 1e-5..0.05],
        masses in [0.1..3.0, 0.1..9.0, 0.1..9.0, 0.05..3.0],
        down in 0.0..6.2_f64,
        load in [-300.0..300.0, 0.0..100.0, 0.0..2.0],
    ) -> Option<Machine<Planetary>> {
        let ring = (sun + 2 * planet).checked_add_signed(shift)?;
        let gears = PlanetaryGears::new(PlanetaryDimensions { sun, planet, ring, planets: count, centres: a }).ok()?;
        let (input, fixed) = uses().nth(choice)?;
        let mut links = rotors([0.0; 4]);
        for (link, (inertia, mass)) in links.iter_mut().zip(inertia.into_iter().zip(masses)) {
            *link = link_of(mass, inertia, [0.0, 0.0]);
        }
        let gear = Planetary::new(gears, input, fixed, links).unwrap();
        let output = index(gear.output());
        let loads = [Action::Moment(load[0]), Action::OpposingMoment(load[1]), Action::ViscousMoment(load[2])];
        Some(loaded(gear, down, output, loads))
    }
}

proptest! {
    #![proptest_config(config(200, 48))]

    #[test]
    fn the_whole_is_in_equilibrium(
        machine in machines().prop_filter_map("gears that do not fit", |machine| machine),
        phi in -60.0..60.0_f64,
    ) {
        // All terms of the reduced equation repeat, though the planets are elsewhere after a turn.
        let speeds = machine.mechanism().speeds();
        for (frame, speed) in machine.mechanism().frames(phi).unwrap().iter().zip(speeds) {
            prop_assert!((frame.psi.value - speed * phi).abs() <= budget::POSITION * (1.0 + (speed * phi).abs()));
        }
        let (now, later) = (machine.reduction(phi).unwrap(), machine.reduction(phi + TAU).unwrap());
        prop_assert!((now.inertia - later.inertia).abs() <= budget::A_TURN_LATER * now.inertia);
        assert_near("load", later.load_torque(), now.load_torque(), budget::CLOSED_FORM * now.load_torque().abs());
        // Equilibrium of the whole: moments of the ground, the drive and the load, and inertia.
        let forces = machine.forces(phi, 0.0, 0.0).unwrap();
        let load = machine.loads()[0];
        let frames = machine.mechanism().frames(phi).unwrap();
        let moment = load.wrench(&frames[load.link()], phi, 0.0).moment;
        let held = forces.reactions[index(machine.mechanism().fixed())].moment;
        let sum = forces.drive + moment + held;
        prop_assert!(sum.abs() <= budget::DALEMBERT * (forces.drive.abs() + moment.abs() + held.abs()), "{sum}");
    }
}

#[test]
fn wrong_gears_are_refused() {
    let gears = |teeth: [u32; 3], planets| {
        PlanetaryGears::new(PlanetaryDimensions {
            sun: teeth[0],
            planet: teeth[1],
            ring: teeth[2],
            planets,
            centres: 0.1,
        })
        .unwrap_err()
    };
    assert_eq!(
        gears([4, 20, 44], 3).to_string(),
        "teeth of the sun is 4, outside 5 to 100000"
    );
    assert_eq!(
        gears([30, 20, 100_001], 3).to_string(),
        "teeth of the ring is 100001, outside 5 to 100000"
    );
    assert_eq!(
        gears([30, 20, 70], 1).to_string(),
        "number of planets is 1, outside 2 to 100"
    );
    assert_eq!(
        PlanetaryGears::new(PlanetaryDimensions {
            sun: 30,
            planet: 20,
            ring: 70,
            planets: 4,
            centres: 0.0
        })
        .unwrap_err()
        .to_string(),
        "centre distance is 0, but must be greater than zero"
    );
    assert_eq!(
        gears([30, 20, 73], 4),
        BuildError::Dimensions(DimensionError::PlanetTeeth {
            planet: 20,
            gap: 43
        })
    );
    assert_eq!(
        gears([30, 20, 67], 4).to_string(),
        "planets with 20 teeth do not fill the gap between sun and ring: ring less sun, 37, must be twice the planet's \
         teeth, give or take 2 with profile shift"
    );
    // A ring smaller than its sun is refused.
    assert_eq!(
        gears([70, 20, 30], 4),
        BuildError::Dimensions(DimensionError::PlanetTeeth { planet: 20, gap: 0 })
    );
    assert_eq!(
        gears([30, 20, 70], 3).to_string(),
        "3 equally spaced planets do not mesh: the teeth of sun and ring together, 100, must be divisible by the number \
         of planets"
    );
    // z_p/(z_s + z_p) = 0.4 = sin 23.6°: up to seven planets.
    assert_eq!(
        gears([30, 20, 70], 10).to_string(),
        "10 planets of this size overlap: at most 7 fit round the sun"
    );
    let fits = PlanetaryGears::new(PlanetaryDimensions {
        sun: 30,
        planet: 20,
        ring: 70,
        planets: 5,
        centres: 0.1,
    })
    .unwrap();
    let new = |input, fixed, links| Planetary::new(fits, input, fixed, links).unwrap_err();
    assert_eq!(
        spoken(new(Member::Carrier, Member::Carrier, rotors([1.0; 4]))),
        "the carrier is fixed and cannot be the input as well; choose another member for one of the two"
    );
    let off = link_of(1.0, 1.0, [0.0, 0.5]);
    for (k, link) in ["sun", "carrier", "ring", "planet"].into_iter().enumerate() {
        let mut links = rotors([1.0; 4]);
        links[k] = off;
        let misfit = DimensionError::OffAxis {
            link,
            distance: 0.5,
        };
        assert_eq!(
            new(Member::Sun, Member::Ring, links),
            BuildError::Dimensions(misfit)
        );
    }
    let gear = Planetary::new(fits, Member::Sun, Member::Ring, rotors([1.0; 4])).unwrap();
    assert_eq!(
        gear.frames(f64::NAN).unwrap_err(),
        PoseError::Range(RangeError::NotFinite("input angle"))
    );
}
