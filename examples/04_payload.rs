//! A new payload: firmware makes a new table from the mechanism itself.
//!
//! A crank swings an arm through a four-bar linkage. The arm picks up 2.5 kg, so that masses change and the table with them. The linkage is described
//! twice: only by its links and pins, from which the new table is filled, and in closed form, against which that table is checked. All of it runs in
//! double precision, in memory of fixed size: two tables, one in use while the other is filled.
//!
//! ```text
//! cargo run -p jred --example 04_payload --profile firmware --target thumbv7em-none-eabihf
//! ```
//!
//! It needs between 32 and 40 KiB of stack; the Cortex-M0 of the examples has 16.
//!
//! runs on: cortex-m3 cortex-m4 cortex-m7 cortex-m33
//! computes in: double precision
#![cfg_attr(target_os = "none", no_std, no_main)]

mod support;
use jred::error::Error;
use jred::machine::{Joint, Link, Machine, Marker, MassProperties, Mechanism};
use jred::mechanism::linkage::{Assembly, Linkage, Pair, Pose};
use jred::mechanism::{FourBar, FourBarDimensions, Side};
use jred::table::{Table, words_len};
use jred::tabulate::{Request, fill, measure, scratch_len};
use jred::{Domain, Model, Phase, Scale, Spline, curves};
use support::{Failure, milli, println, program};

/// Dimensions (m).
const DIMENSIONS: FourBarDimensions = FourBarDimensions {
    crank: 0.08,
    coupler: 0.32,
    rocker: 0.24,
    pivot: [0.3, 0.05],
};
/// The gripper's distance from that bearing (m).
const REACH: f64 = 0.4;
/// The mass that it picks up (kg), and that mass's own inertia (kg·m²).
const PAYLOAD: [f64; 2] = [2.5, 0.004];
/// Standard gravity (m/s²).
const GRAVITY: [f64; 2] = [0.0, -9.806_65];

/// Cells of the table: enough for the requirements below, with the payload; `check` verifies it.
const CELLS: u32 = 40;
/// Words of such a table of inertia and load.
const WORDS: usize = words_len::<Spline<f32>>(CELLS, curves::LOAD);
/// Its requirements.
const DESIGN: Request = Request::new(0.02)
    .with_max_speed(12.0)
    .with_max_acceleration(60.0)
    .with_max_cells(CELLS);

type Words = [f32; WORDS];

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        println!("{error}");
        Self::Claim("the machine was refused")
    }
}

/// Crank, coupler and empty arm.
fn links() -> Result<[Link; 3], Error> {
    Ok([
        Link::new(MassProperties {
            mass: 0.9,
            inertia: 0.002,
            com: [0.03, 0.0],
        })?,
        Link::new(MassProperties {
            mass: 0.6,
            inertia: 0.006,
            com: [0.16, 0.01],
        })?,
        Link::new(MassProperties {
            mass: 1.4,
            inertia: 0.011,
            com: [0.12, 0.0],
        })?,
    ])
}

/// The arm with the payload in its gripper: one body, by Steiner's theorem.
fn loaded(arm: &Link) -> Result<Link, Error> {
    let [mass, inertia] = PAYLOAD;
    let sum = arm.mass() + mass;
    let [u, v] = arm.com();
    let com = [(arm.mass() * u + mass * REACH) / sum, arm.mass() * v / sum];
    let apart = (REACH - u) * (REACH - u) + v * v;
    let reduced_mass = arm.mass() * mass / sum;
    Ok(Link::new(MassProperties {
        mass: sum,
        inertia: arm.inertia() + inertia + reduced_mass * apart,
        com,
    })?)
}

/// The linkage from its pins only, assembled from a rough drawing and followed over a turn.
fn assemble(links: &[Link; 3]) -> Result<Assembly<3, 4, 32>, Error> {
    let FourBarDimensions {
        crank,
        coupler,
        rocker: arm,
        pivot,
    } = DIMENSIONS;
    let origin = [0.0, 0.0];
    let pin = |a, b| Pair::Joint(Joint::Revolute([a, b]));
    let pins = [
        pin(Marker::ground(origin), Marker::on(0, origin)),
        pin(Marker::on(0, [crank, 0.0]), Marker::on(1, origin)),
        pin(Marker::on(1, [coupler, 0.0]), Marker::on(2, [arm, 0.0])),
        pin(Marker::ground(pivot), Marker::on(2, origin)),
    ];
    let drawing = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.8], [0.3, 0.05, 1.7]];
    let drawing = drawing.map(|[x, y, psi]| Pose { x, y, psi });
    Ok(Linkage::new(links, &pins, 0)?.assemble(Domain::Turn, 0.0, &drawing)?)
}

/// Fills a table from a mechanism.
fn tabulate<'w>(
    mechanism: &impl Mechanism,
    words: &'w mut Words,
) -> Result<Table<'w, Spline<f32>>, Error> {
    let machine = Machine::new(mechanism).with_gravity(GRAVITY)?;
    let mut scratch = [0.0; scratch_len(CELLS, curves::LOAD)];
    fill(
        &machine,
        curves::LOAD,
        CELLS,
        &Scale::SI,
        &mut scratch,
        words,
    )
}

/// Checks a table against the closed form, and prints its error.
fn check(table: &Table<'_, Spline<f32>>, links: [Link; 3]) -> Result<(), Failure> {
    let four_bar = FourBar::new(DIMENSIONS, Side::Left, links).map_err(Error::from)?;
    let machine = Machine::new(&four_bar)
        .with_gravity(GRAVITY)
        .map_err(Error::from)?;
    let found = measure(&machine, table, &DESIGN)?;
    let sum = table.words().iter().fold(0u32, |sum, word| {
        (sum ^ word.to_bits()).wrapping_mul(16_777_619)
    });
    let error = milli(found.torque_error as f32 * 1000.0);
    println!("table {sum:08x}, torque exact to {error} uN m");
    if found.torque_error > DESIGN.torque_error {
        return Err("the table is not as exact as it was designed for".into());
    }
    Ok(())
}

fn run() -> Result<(), Failure> {
    let [crank, coupler, arm] = links()?;
    let mut linkage = assemble(&[crank, coupler, arm])?;
    let (mut in_use, mut spare): (Words, Words) = ([0.0; WORDS], [0.0; WORDS]);
    let in_use = tabulate(&linkage, &mut in_use)?;
    println!("empty gripper");
    check(&in_use, [crank, coupler, arm])?;

    // The gripper closes. The linkage's positions stay the same, only a mass changes.
    let arm = loaded(&arm)?;
    linkage.set_link(2, arm).map_err(Error::from)?;
    let spare = tabulate(&linkage, &mut spare)?;
    println!("with {} g", milli(PAYLOAD[0] as f32));
    check(&spare, [crank, coupler, arm])?;

    let model = |table| Model::new(table).map_err(Error::Table);
    let (before, after) = (model(in_use)?, model(spare)?);
    println!("   phase   drive torque for 10 rad/s, 50 rad/s2: empty, loaded");
    for eighth in 0..8u32 {
        let phase = Phase::from_bits(eighth << 29);
        let torque = |model: &Model<'_, Spline<f32>, { curves::LOAD }>| {
            milli(model.torque(phase, 10.0, 50.0))
        };
        println!(
            "{:08x} {:12} {:12} mN m",
            phase.to_bits(),
            torque(&before),
            torque(&after)
        );
    }
    Ok(())
}

program!(run);
