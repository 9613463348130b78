//! The proven error of exported tables, for every machine file in `machines/`, against random places.

use jred::image::HEADER_WORDS;
use jred::machine::{Machine, Reducible};
use jred::table::Format;
use jred::tabulate::{Request, torque_between};
use jred::{Cubic, Image, Phase, Q31, Rows16, Spline};
use jred_export::{Export, LayoutChoice, Number, Task};
use jred_file::model::machine::MachineFile;
use jred_file::model::mechanism::AnyMechanism;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use crate::reading::machines;

/// Speed and acceleration of the drive link (rad/s, or m/s).
const OMEGA: f64 = 7.0;
const ALPHA: f64 = 40.0;
/// Random places of each table.
const PLACES: u32 = 4000;

/// The mechanisms that are not enclosed: cams, a roll that grows, and linkages that lie flat.
const OPEN: [&str; 7] = [
    "cam-oscillating",
    "cam-translating",
    "elliptic-drive",
    "indexing-cam",
    "linkage-cam-lever",
    "parallel-lift",
    "winder",
];

/// Those that have no table at all: loads by the motion, and a ratio that changes while it runs.
const NO_TABLE: [&str; 1] = ["pick-and-place"];

fn task(number: Number, layout: LayoutChoice) -> Task {
    Task {
        number,
        layout,
        core: jred_export::Core::default(),
        forward: false,
        reciprocal: false,
        torque_error: None,
        max_bytes: Some(1200),
        max_cells: 200,
        omega: OMEGA,
        alpha: ALPHA,
        rotor: 0.0,
        edges: Vec::new(),
        machine: None,
    }
}

/// A search for the largest errors of a machine's image.
type Searched = fn(&Machine<AnyMechanism>, &[u32]) -> [f64; 2];

/// The largest error that random places show: of the curves as the table reads them, and of the ticks at the corners of the range.
fn searched<F: Format>(machine: &Machine<AnyMechanism>, words: &[u32]) -> [f64; 2] {
    let image = Image::new(words).unwrap();
    let (table, model) = (image.table::<F>().unwrap(), image.any_model::<F>().unwrap());
    let request = Request::new(1.0)
        .with_max_speed(OMEGA)
        .with_max_acceleration(ALPHA);
    let domain = machine.domain();
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut most = [0.0_f64; 2];
    // The ends of a stroke, where a table errs most, are not met at random.
    let ends = [0, 1, u32::MAX - 1, u32::MAX];
    let places: Vec<u32> = (0..PLACES).map(|_| random.random()).chain(ends).collect();
    for bits in places {
        let phase = Phase::from_bits(bits);
        let phi = domain.position(f64::from(phase.to_bits()) / 4_294_967_296.0);
        let exact = machine.reduction(phi).unwrap();
        let read = torque_between(&request, &table.si(phase, domain), &exact);
        most[0] = most[0].max(read);
        for sign in [1.0, -1.0] {
            let ticked = tick(&model, &image, phase, [sign * OMEGA, ALPHA]);
            let [omega, alpha, torque] = ticked;
            let error = (torque - exact.torque(omega, alpha).total()).abs();
            most[1] = most[1].max(error);
        }
    }
    most
}

/// A tick in SI units, and the speed and acceleration that its numbers hold.
fn tick<F: Format>(
    model: &jred::AnyModel<'_, F>,
    image: &Image<'_>,
    phase: Phase,
    [omega, alpha]: [f64; 2],
) -> [f64; 3] {
    use jred::number::{Number as _, Quantity};
    use jred::table::{AccelerationOf, SpeedOf};
    fn of<Q: Quantity>(value: f64) -> Q {
        Q::of(Q::Number::from_f64(value).unwrap())
    }
    fn back(quantity: impl Quantity) -> f64 {
        quantity.number().to_f64()
    }
    let scale = image.scale();
    let [torque, speed, acceleration] =
        [scale.torque(), scale.speed(), scale.acceleration()].map(f64::from);
    let omega = of::<SpeedOf<F>>(omega / speed);
    let alpha = of::<AccelerationOf<F>>(alpha / acceleration);
    let found = model.torque(phase, omega, alpha);
    [
        back(omega) * speed,
        back(alpha) * acceleration,
        back(found) * torque,
    ]
}

#[test]
#[ignore = "more than five seconds of a processor"]
fn no_place_errs_more_than_is_proven() {
    let kinds: [(Number, LayoutChoice, Searched); 3] = [
        (Number::F32, LayoutChoice::Spline, searched::<Spline<f32>>),
        (Number::I32, LayoutChoice::Cubic, searched::<Cubic<Q31>>),
        (Number::I16, LayoutChoice::Rows, searched::<Rows16>),
    ];
    let (mut open, mut refused, mut proven, mut loosest) = (Vec::new(), Vec::new(), 0, 0.0_f64);
    for (k, (path, file)) in machines().into_iter().enumerate() {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let (number, layout, searched) = kinds[k % kinds.len()];
        let Ok(export) = Export::proven(&file, &task(number, layout), &mut |_| true) else {
            refused.push(name);
            continue;
        };
        let table = &export.chosen().tables[0];
        let machine = with_train(&file);
        let found = searched(&machine, &table.words);
        match export.proof().unwrap() {
            Err(why) => {
                // Where a linkage lies flat, the joints alone do not say where its links are.
                let flat = ["parallel-lift", "elliptic-drive"].contains(&name.as_str())
                    && why.to_string().contains("dead point");
                assert!(
                    flat || why.to_string().contains("is not enclosed"),
                    "{name}: {why}"
                );
                open.push(name);
            }
            Ok(proof) => {
                let ticked = proof.ticked.unwrap();
                println!("{name}: {found:?} {proof:?}");
                // The tick's arithmetic within the cell is part of what is read.
                assert!(
                    found[0] <= ticked && found[1] <= ticked,
                    "{name}: {found:?} {proof:?}"
                );
                assert!(
                    proof.least <= proof.bound && proof.bound <= ticked,
                    "{name}: {proof:?}"
                );
                // Where the error is more than roundings, random places come close to the bound.
                if found[0] > 4.0 * (ticked - proof.bound) {
                    loosest = loosest.max(proof.bound / found[0].max(proof.least));
                }
                // The image says what is proven.
                let image = Image::new(&table.words).unwrap();
                let stated = f64::from(image.validity().torque_error);
                assert!(
                    stated >= ticked && stated <= ticked * 1.000_001,
                    "{name}: {stated}"
                );
                assert!(table.words.len() > HEADER_WORDS);
                proven += 1;
            }
        }
    }
    println!("{proven} proven, loosest {loosest}; open {open:?}; no table {refused:?}");
    assert_eq!(open, OPEN);
    assert_eq!(refused, NO_TABLE);
    assert!(proven > 30 && loosest < 1.1, "{proven} {loosest}");
}

/// The machine that the export tabulates.
fn with_train(file: &MachineFile) -> Machine<AnyMechanism> {
    file.with_drive_train().unwrap()
}

/// Tables for each piece between the edges of loads are proven piece by piece, and a table that is too coarse for its proof is
/// searched for again.
#[test]
fn pieces_and_a_torque_error_are_proven() {
    let all = machines();
    let (_, file) = all
        .iter()
        .find(|(path, _)| path.ends_with("press.toml"))
        .unwrap();
    let edges: Vec<f64> = (0..).map_while(|k| file.machine.edge(k)).collect();
    for (torque_error, edges) in [(0.5, Vec::new()), (0.05, edges)] {
        let task = Task {
            torque_error: Some(torque_error),
            max_bytes: None,
            max_cells: 4096,
            edges,
            ..task(Number::I32, LayoutChoice::Spline)
        };
        let export = Export::proven(file, &task, &mut |_| true).unwrap();
        let Some(Ok(proof)) = export.proof() else {
            panic!("{:?}", export.proof());
        };
        let ticked = proof.ticked.unwrap();
        println!("{torque_error}: {proof:?}");
        assert!(
            export.excess().is_none() && ticked <= torque_error,
            "{proof:?}"
        );
        // The smallest table for it: a search that asked for much less would have a larger one.
        assert!(ticked > 0.5 * torque_error, "{proof:?}");
        let least = export
            .chosen()
            .tables
            .iter()
            .map(|table| table.found.torque_error);
        assert!(least.fold(0.0, f64::max) <= ticked);
    }
}
