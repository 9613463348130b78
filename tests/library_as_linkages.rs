//! Library mechanisms against the general linkage: the closed form, and the joints solved by continuation, give the same motion.

use crate::support::{assert_near, budget, config, forces, jointed, link_of};
use jred::Domain;
use jred::machine::{Body, Frame, Joint, Jointed, Link, Machine, Marker, Mechanism, Reducible};
use jred::mechanism::linkage::{Assembly, Linkage, Pair, Pose};
use jred::mechanism::{
    Branch, DrivenShaft, FourBar, FourBarDimensions, Geneva, Hoist, InvertedSliderCrank,
    InvertedSliderCrankDimensions, Member, ParallelShafts, Planetary, PlanetaryDimensions,
    PlanetaryGears, RackAndPinion, Rope, RopeLoad, ScotchYoke, ScotchYokeDimensions, Side, SixLink,
    SixLinkDimensions, Stage, TogglePress, TogglePressDimensions, Train,
};
use proptest::prelude::*;

const O: [f64; 2] = [0.0, 0.0];

fn links<const N: usize>() -> [Link; N] {
    std::array::from_fn(|k| {
        let k = k as f64;
        link_of(1.0 + k, 0.01 * (1.0 + k), [0.02 * k, 0.01])
    })
}

/// Positions, transfer functions, J, J′ and J″ over a turn and beyond.
fn same_motion(mechanism: &(impl Jointed + Clone), phi: f64) {
    let linkage = jointed::as_linkage(mechanism, 0.37).unwrap();
    let closed = Machine::new(mechanism.clone());
    let solved = Machine::new(&linkage);
    for phi in [phi, -phi, 3.0 * phi] {
        jointed::same_frames(mechanism, &linkage, phi, budget::LINKAGE);
        let [a, b] = [
            closed.reduction(phi).unwrap(),
            solved.reduction(phi).unwrap(),
        ];
        // J′ and J″ are sums whose terms may cancel: their scale is that of J and of each other.
        let mut size = 0.0_f64;
        for (order, (a, b)) in a.inertias().into_iter().zip(b.inertias()).enumerate() {
            size = size.max(a.abs());
            assert_near(
                &format!("J derivative {order} at φ = {phi}"),
                b,
                a,
                budget::LINKAGE * size,
            );
        }
        forces::dalembert(&solved, phi, 12.0, -70.0);
    }
}

proptest! {
    #![proptest_config(config(60, 0x11b0))]

    #[test]
    fn four_bars(
        lengths in [0.04..0.3, 0.04..0.3, 0.04..0.3],
        pivot in [-0.3..0.3, -0.3..0.3],
        left in any::<bool>(),
        phi in 0.0..6.3,
    ) {
        let side = if left { Side::Left } else { Side::Right };
        let four_bar = FourBar::new(FourBarDimensions { crank: lengths[0], coupler: lengths[1], rocker: lengths[2], pivot }, side, links());
        prop_assume!(four_bar.is_ok());
        let four_bar = four_bar.unwrap();
        // Near a dead point every rounding is amplified.
        let least = (0..360).map(|k| {
            let mu = four_bar.transmission_angle(f64::from(k).to_radians()).unwrap();
            mu.value.sin().abs()
        });
        prop_assume!(least.fold(1.0, f64::min) > 0.2);
        same_motion(&four_bar, phi);
    }

    #[test]
    fn six_links(
        crank in 0.05..0.2,
        centres in 0.02..0.5,
        rocker in 0.1..0.6,
        below in -0.3..0.3,
        slack in 0.2..1.0,
        left in any::<bool>(),
        phi in 0.0..6.3,
    ) {
        prop_assume!(f64::abs(centres / crank - 1.0) > 0.2);
        let rod = (rocker + f64::abs(below)) * (1.0 + slack);
        let branch = if left { Branch::Left } else { Branch::Right };
        let six_link = SixLink::new(SixLinkDimensions { crank, rocker, rod, centres, below }, branch, links()).unwrap();
        same_motion(&six_link, phi);
    }

    #[test]
    fn inverted_slider_cranks(
        crank in 0.05..0.2,
        pivot in [-0.5..0.5, -0.5..0.5],
        offset in -0.05..0.05,
        phi in 0.0..6.3,
    ) {
        let centres = f64::hypot(pivot[0], pivot[1]);
        prop_assume!(f64::abs(centres / crank - 1.0) > 0.2 + f64::abs(offset) / crank);
        let mechanism = InvertedSliderCrank::new(InvertedSliderCrankDimensions { crank, pivot, offset }, links());
        prop_assume!(mechanism.is_ok());
        same_motion(&mechanism.unwrap(), phi);
    }

    #[test]
    fn toggle_presses(
        sizes in [0.03..0.08, 1.2..2.0, 1.0..1.8, 1.3..2.0],
        direction in -0.4..0.4,
        left in any::<bool>(),
        backward in any::<bool>(),
        phi in 0.0..6.3,
    ) {
        // A crank-rocker: the crank is the shortest, and crank plus ground are shorter than the other two together.
        let crank = sizes[0];
        let [rod, upper] = [4.0 * crank * sizes[1], 4.0 * crank * sizes[2]];
        let ground = 0.75 * (rod + upper) * 0.9;
        let pivot = [ground * f64::cos(direction), ground * f64::sin(direction)];
        let lower = sizes[3] * (upper + f64::abs(pivot[1]));
        let sides = (
            if left { Side::Left } else { Side::Right },
            if backward { Branch::Left } else { Branch::Right },
        );
        let press = TogglePress::new(TogglePressDimensions { crank, rod, upper, lower, pivot, guide: 0.0 }, sides.0, sides.1, links());
        prop_assume!(press.is_ok());
        same_motion(&press.unwrap(), phi);
    }

    #[test]
    fn shafts(ratios in [0.3..4.0, 0.3..4.0, 0.3..4.0], reversed in [any::<bool>(), any::<bool>(), any::<bool>()], phi in -3.0..3.0) {
        let ratios: [f64; 3] = ratios;
        let [a, b, c] = [0, 1, 2].map(|k| if reversed[k] { -ratios[k] } else { ratios[k] });
        let rotors = [0.01, 0.02, 0.03, 0.04].map(|j| Link::rotor(j).unwrap());
        // In series: the driven side of a stage turns with the driver of the next.
        let stages = [(a, 0.01), (b, 0.02), (c, 0.03)].map(|(i, j)| Stage::new(i, [j, 0.0]).unwrap());
        let train = Train::new(&stages).unwrap();
        let belt = |from: usize, to: usize, ratio: f64| Pair::Belt {
            centres: [Marker::on(from, O), Marker::on(to, O)],
            radii: [0.02, 0.02 * ratio],
            phase: 0.0,
        };
        same_shafts(&train, &[belt(0, 1, a), belt(1, 2, b), belt(2, 3, c)], phi);
        // Side by side.
        let driven = [(a, 1), (b, 2), (c, 3)].map(|(ratio, k)| DrivenShaft {
            ratio,
            link: rotors[k],
        });
        let shafts = ParallelShafts::new(rotors[0], &driven).unwrap();
        same_shafts(&shafts, &[belt(0, 1, a), belt(0, 2, b), belt(0, 3, c)], phi);
    }

    #[test]
    fn hoists(radii in [0.05..0.4, 0.05..0.4], falls in [1_u32..6, 1_u32..6], masses in [10.0..900.0, 10.0..900.0], phi in -3.0..3.0) {
        let rope = |k: usize| Rope::new(radii[k], falls[k]).unwrap();
        let mass = |k: usize| Link::point_mass(masses[k]).unwrap();
        let drum = Link::rotor(0.5).unwrap();
        let hoist = Hoist::with_counterweight(drum, RopeLoad { rope: rope(0), link: mass(0) }, RopeLoad { rope: rope(1), link: mass(1) });
        let frames = hoist.frames(0.0).unwrap();
        let joints = hoist.joints(0.0, &frames).unwrap();
        // A rope is a rack that the drum winds up; a tackle moves its load by a share of that.
        let wound = |k: usize, side: f64| Pair::Rack {
            pinion: Marker::on(0, O),
            rack: Marker::on(k + 1, O).with_angle(std::f64::consts::FRAC_PI_2),
            radius: side * radii[k] / f64::from(falls[k]),
            phase: 0.0,
        };
        let held = joints.iter().take(3).copied().map(Pair::Joint);
        let pairs: Vec<Pair> = held.chain([wound(0, 1.0), wound(1, -1.0)]).collect();
        let linkage = over_a_stroke::<3>(&hoist, &pairs);
        jointed::same_frames(&hoist, &linkage, phi, budget::LINKAGE);
        let [a, b] = [
            Machine::new(hoist).with_gravity([0.0, -9.81]).unwrap().reduction(phi).unwrap(),
            Machine::new(&linkage).with_gravity([0.0, -9.81]).unwrap().reduction(phi).unwrap(),
        ];
        assert_near("J", b.inertia, a.inertia, budget::LINKAGE * a.inertia);
        let size = 9.81 * (masses[0] + masses[1]);
        assert_near("weights", b.load_torque(), a.load_torque(), budget::LINKAGE * size);
    }

    #[test]
    fn scotch_yokes(crank in 0.02..0.2, slot in 0.5..2.6, phi in 0.0..6.3) {
        same_motion(&ScotchYoke::new(ScotchYokeDimensions { crank, slot_angle: slot }, links()).unwrap(), phi);
    }
}

/// The links of a mechanism that does not return, held by `pairs`, over a stroke.
fn over_a_stroke<const LINKS: usize>(
    mechanism: &impl Mechanism,
    pairs: &[Pair],
) -> Assembly<LINKS, 7, 8> {
    let drawing: Vec<Pose> = mechanism.frames(0.0).unwrap().iter().map(pose).collect();
    let linkage = Linkage::new(mechanism.links(), pairs, 0).unwrap();
    let stroke = Domain::stroke(-3.0, 3.0).unwrap();
    linkage.assemble(stroke, 0.0, &drawing).unwrap()
}

fn pose(frame: &Frame) -> Pose {
    Pose {
        x: frame.x.value,
        y: frame.y.value,
        psi: frame.psi.value,
    }
}

/// Four shafts with three belts between them.
fn same_shafts(shafts: &(impl Jointed + Clone), belts: &[Pair; 3], phi: f64) {
    let frames = shafts.frames(0.0).unwrap();
    let joints = shafts.joints(0.0, &frames).unwrap();
    let bearings = joints.iter().take(4).copied().map(Pair::Joint);
    let pairs: Vec<Pair> = bearings.chain(belts.iter().copied()).collect();
    let linkage = over_a_stroke::<4>(shafts, &pairs);
    jointed::same_frames(shafts, &linkage, phi, budget::LINKAGE);
    let [a, b] = [
        Machine::new(shafts.clone()).reduction(phi),
        Machine::new(&linkage).reduction(phi),
    ]
    .map(|r| r.unwrap().inertia);
    assert_near("J", b, a, budget::LINKAGE * a);
    forces::dalembert(&Machine::new(&linkage), phi, 5.0, -30.0);
}

/// While the pin is in the slot.
#[test]
fn a_geneva_drive_while_engaged() {
    let wheel = Link::rotor(0.02).unwrap();
    for slots in [3, 4, 6, 12] {
        let geneva = Geneva::new(slots, 0.1, [links::<2>()[1], wheel]).unwrap();
        let engaged =
            0.98 * (std::f64::consts::FRAC_PI_2 - std::f64::consts::PI / f64::from(slots));
        let frames = geneva.frames(0.0).unwrap();
        let joints = geneva.joints(0.0, &frames).unwrap();
        let pairs: Vec<Pair> = joints.iter().copied().map(Pair::Joint).collect();
        let drawing: Vec<Pose> = frames.iter().map(pose).collect();
        let domain = Domain::stroke(-engaged, engaged).unwrap();
        let linkage: Assembly<2, 3, 64> = Linkage::new(geneva.links(), &pairs, 0)
            .unwrap()
            .assemble(domain, 0.0, &drawing)
            .unwrap();
        for k in -10..=10 {
            jointed::same_frames(
                &geneva,
                &linkage,
                engaged * f64::from(k) / 10.0,
                budget::LINKAGE,
            );
        }
    }
}

/// Rolling pairs: a rack, and a planetary gear with its ring held, as links and teeth.
#[test]
fn a_rack_and_a_planetary_gear() {
    let [pinion, rack] = [Link::rotor(0.01).unwrap(), Link::point_mass(3.0).unwrap()];
    let radius = 0.04;
    let closed = RackAndPinion::new(radius, [pinion, rack]).unwrap();
    let start = closed.frames(0.0).unwrap();
    let drawing: Vec<Pose> = start.iter().map(pose).collect();
    let along = Pair::Rack {
        pinion: Marker::on(0, O),
        rack: Marker::on(1, O),
        radius,
        phase: 0.0,
    };
    let pairs = [
        Pair::Joint(Joint::Revolute([Marker::ground(O), Marker::on(0, O)])),
        Pair::Joint(Joint::Prismatic([
            Marker::ground([0.0, -radius]),
            Marker::on(1, O),
        ])),
        along.meshing_at(&start),
    ];
    let domain = Domain::stroke(-2.0, 3.0).unwrap();
    let linkage: Assembly<2, 3, 8> = Linkage::new(closed.links(), &pairs, 0)
        .unwrap()
        .assemble(domain, 0.0, &drawing)
        .unwrap();
    for phi in [-1.9, 0.0, 0.5, 2.9] {
        jointed::same_frames(&closed, &linkage, phi, budget::LINKAGE);
        forces::dalembert(&Machine::new(&linkage), phi, 2.0, 5.0);
    }

    let teeth = [24, 18, 60];
    let centres = 0.042;
    let module = 2.0 * centres / f64::from(teeth[0] + teeth[1]);
    let [sun, planet, ring] = teeth.map(|z| 0.5 * module * f64::from(z));
    let member = Link::rotor(0.002).unwrap();
    let one_planet = link_of(0.1, 0.00002, O);
    let gears = PlanetaryGears::new(PlanetaryDimensions {
        sun: teeth[0],
        planet: teeth[1],
        ring: teeth[2],
        planets: 3,
        centres,
    })
    .unwrap();
    let closed = Planetary::new(
        gears,
        Member::Sun,
        Member::Ring,
        [member, member, member, one_planet],
    )
    .unwrap();
    let pin = |a, b| Pair::Joint(Joint::Revolute([a, b]));
    let pairs = [
        pin(Marker::ground(O), Marker::on(0, O)),
        pin(Marker::ground(O), Marker::on(1, O)),
        pin(Marker::on(1, [centres, 0.0]), Marker::on(2, O)),
        Pair::Gears {
            centres: [Marker::on(0, O), Marker::on(2, O)],
            carrier: Body::Link(1),
            radii: [sun, planet],
            phase: 0.0,
        },
        Pair::Gears {
            centres: [Marker::ground(O), Marker::on(2, O)],
            carrier: Body::Link(1),
            radii: [-ring, planet],
            phase: 0.0,
        },
    ];
    let drawing = [O, O, [centres, 0.0]].map(|[x, y]| Pose { x, y, psi: 0.0 });
    let linkage: Assembly<3, 5, 8> = Linkage::new(&[member, member, one_planet], &pairs, 0)
        .unwrap()
        .assemble(Domain::stroke(0.0, 3.0).unwrap(), 0.0, &drawing)
        .unwrap();
    for phi in [0.0, 1.0, 3.0] {
        let [a, b] = [closed.frames(phi).unwrap(), linkage.frames(phi).unwrap()];
        for (closed, solved) in [(0, 0), (1, 1), (3, 2)] {
            let [a, b] = [a[closed].psi, b[solved].psi];
            assert_near("speed", b.d1, a.d1, budget::LINKAGE);
        }
        // One planet's link of the three.
        let one = Machine::new(&linkage).link_inertias(phi).unwrap()[2][0];
        let carrier = Machine::new(&closed).link_inertias(phi).unwrap()[1][0];
        let spin = Machine::new(&closed).link_inertias(phi).unwrap()[3][0];
        let bare = 0.002 * a[1].psi.d1.powi(2);
        assert_near("planets", 3.0 * one, carrier - bare + spin, budget::LINKAGE);
    }
}
