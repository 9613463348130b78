//! Every exported type and layout, loaded and ticked like in firmware, against the exact reduction.

use jred::machine::Reducible as _;
use jred::number::{Number, Quantity};
use jred::table::Format;
use jred::{
    Cubic, CurveSet, Image, ImageError, Phase, Q31, Quadratic, Rows16, SliderCrankForm, Spline,
    Spline16, curves,
};
use jred_file::model::machine::MachineFile;
use jred_file::model::mechanism::AnyMechanism;

use super::{KINDS, export, export_of, image, number_after, words_of};
use crate::support::{Folder, budget, press_file, shipped, typed};

/// The curves of the press.
const SET: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
const WITH_RECIPROCAL: CurveSet = SET | curves::RECIPROCAL;

/// A fixed sequence of numbers from 0 to 1 (xorshift; G. Marsaglia 2003).
pub(super) fn random() -> impl FnMut() -> f64 {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

pub(super) fn machine(file: &MachineFile) -> jred::machine::Machine<AnyMechanism> {
    file.with_drive_train().unwrap()
}

/// The largest errors of torque (N·m), and of acceleration times J, at random states; `spread` maps a number from 0 to 1 to a phase.
pub(super) fn errors<N: Number>(
    machine: &jred::machine::Machine<AnyMechanism>,
    image: &Image<'_>,
    spread: impl Fn(f64) -> Phase,
    torque: impl Fn(Phase, N::Speed, N::Acceleration) -> N::Torque,
    acceleration: impl Fn(Phase, N::Speed, N::Torque) -> jred::Outcome<N::Acceleration>,
) -> [f64; 2] {
    let scale = image.scale();
    let [torque_base, speed_base] = [scale.torque(), scale.speed()].map(f64::from);
    let acceleration_base = f64::from(scale.acceleration());
    let (most_omega, most_alpha) = (
        image.validity().max_speed,
        image.validity().max_acceleration,
    );
    let mut random = random();
    let mut worst = [0.0f64; 2];
    for k in 0..20_000 {
        let phase = spread(random());
        let mut signed = |most: f32| {
            let share = 2.0 * random() - 1.0;
            // Every fourth at an end of the range.
            f64::from(most) * if k % 4 == 0 { share.signum() } else { share }
        };
        let (omega, alpha) = (signed(most_omega), signed(most_alpha));
        let (omega, alpha) = (
            quantity::<N::Speed>(omega / speed_base),
            quantity::<N::Acceleration>(alpha / acceleration_base),
        );
        let speed = value(omega) * speed_base;
        let exact = machine.reduction(phase.radians()).unwrap();
        let expected = exact.torque(speed, value(alpha) * acceleration_base);
        let found = value(torque(phase, omega, alpha)) * torque_base;
        worst[0] = worst[0].max((found - expected.total()).abs());
        let drive = quantity::<N::Torque>(expected.total() / torque_base);
        let back = acceleration(phase, omega, drive);
        if back.saturated {
            continue; // 16 bits only: their base is that of the range itself.
        }
        let expected = exact.acceleration(speed, value(drive) * torque_base);
        let off = (value(back.value) * acceleration_base - expected).abs();
        worst[1] = worst[1].max(off * exact.inertia);
    }
    worst
}

/// The nearest value in machine units.
fn quantity<Q: Quantity>(value: f64) -> Q {
    Q::of(Q::Number::from_f64(value).unwrap())
}

fn value<Q: Quantity>(quantity: Q) -> f64 {
    quantity.number().to_f64()
}

fn of_model<F: Format, const CURVES: CurveSet>(words: &[u32]) -> [f64; 2] {
    let image = Image::new(words).unwrap();
    let model = image.model::<F, CURVES>().unwrap();
    errors::<F::Number>(
        &machine(&jred_analysis::checked::read(&press_file()).unwrap()),
        &image,
        |share| Phase::from_bits((share * 4_294_967_296.0) as u32),
        |phase, omega, alpha| model.torque(phase, omega, alpha),
        |phase, omega, torque| model.acceleration(phase, omega, torque),
    )
}

fn ticked(words: &[u32], kind: (&str, &str), reciprocal: bool) -> [f64; 2] {
    match (kind, reciprocal) {
        (("f32", "spline"), _) => of_model::<Spline<f32>, SET>(words),
        (("f32", "cubic"), _) => of_model::<Cubic<f32>, SET>(words),
        (("f32", _), _) => of_model::<Quadratic<f32>, SET>(words),
        (("i32", "spline"), false) => of_model::<Spline<Q31>, SET>(words),
        (("i32", "spline16"), false) => of_model::<Spline16, SET>(words),
        (("i32", "cubic"), false) => of_model::<Cubic<Q31>, SET>(words),
        (("i32", _), false) => of_model::<Quadratic<Q31>, SET>(words),
        (("i32", "spline"), true) => of_model::<Spline<Q31>, WITH_RECIPROCAL>(words),
        (("i32", "spline16"), true) => of_model::<Spline16, WITH_RECIPROCAL>(words),
        (("i32", "cubic"), true) => of_model::<Cubic<Q31>, WITH_RECIPROCAL>(words),
        (("i32", _), true) => of_model::<Quadratic<Q31>, WITH_RECIPROCAL>(words),
        (_, false) => of_model::<Rows16, SET>(words),
        (_, true) => of_model::<Rows16, WITH_RECIPROCAL>(words),
    }
}

#[test]
fn every_type_and_layout_holds_its_error() {
    let folder = Folder::new();
    for (number, layout) in KINDS {
        let mut before = 0;
        for (allowed, reciprocal) in [(2.0, "no"), (0.5, "no"), (0.5, "yes")] {
            if number == "f32" && reciprocal == "yes" {
                continue;
            }
            let error = format!("{allowed} N m");
            let (run, path) = export(
                &folder,
                &[
                    "--type",
                    number,
                    "--layout",
                    layout,
                    "--torque-error",
                    &error,
                    "--reciprocal",
                    reciprocal,
                ],
            );
            let run = run.ends(0);
            let words = words_of(&path);
            let image = Image::new(&words).unwrap();
            let stated = f64::from(image.validity().torque_error);
            assert!(stated <= allowed, "{stated} of {allowed}");
            let [torque, acceleration] = ticked(&words, (number, layout), reciprocal == "yes");
            println!(
                "{number} {layout} {reciprocal}: {} cells, stated {stated}, torque {torque}, acceleration {acceleration}",
                image.cells()
            );
            let most = stated * (1.0 + budget::BETWEEN_PLACES);
            assert!(torque <= most, "{number} {layout}: {torque} above {stated}");
            // The stated error is not excessive.
            assert!(torque > stated / 4.0, "{torque} far below {stated}");
            // J·δα is the torque error, up to the error of J itself.
            assert!(
                acceleration <= most,
                "{number} {layout}: {acceleration} above {stated}"
            );
            if reciprocal == "no" {
                assert!(image.cells() > before, "a smaller error needs more cells");
                before = image.cells();
            }
            // The printed error is that of the header.
            let printed = number_after(&run.out, "torque error reached ");
            assert!(
                (printed / stated - 1.0).abs() < 1e-5,
                "{printed} and {stated}"
            );
            let printed = number_after(&run.out, &format!("{number}, layout {layout}, "));
            assert_eq!(printed, f64::from(image.cells()));
            let bytes = number_after(&run.out, " bytes of rows, ");
            assert_eq!(bytes, 4.0 * words.len() as f64);
            let omega = number_after(&run.out, "|omega| <= ");
            assert!((omega / f64::from(image.validity().max_speed) - 1.0).abs() < 1e-5);
        }
    }
}

/// The same for every example machine, with its own curves and range: the torque from the table's curves.
#[test]
#[ignore = "more than five seconds of a processor"]
fn every_machine_holds_its_error() {
    let folder = Folder::new();
    let machines = shipped("");
    let mut files: Vec<_> = std::fs::read_dir(machines)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    files.sort();
    let mut checked = 0;
    for (k, path) in files.iter().enumerate() {
        let file = jred_analysis::checked::read(path).unwrap();
        // Parts that follow the motion are in no table.
        if file.variator.is_some() || file.scheduled().next().is_some() {
            continue;
        }
        let out = folder.path("machine.jred");
        let number = ["f32", "i32", "i16"][k % 3];
        let more: &[&str] = if file.motion.is_some() {
            &[]
        } else {
            &["--omega", "60 rpm"]
        };
        let arguments = [&["--type", number, "--max-bytes", "1500"], more].concat();
        let run = export_of(path, &arguments, Some(&out)).ends(0);
        let words = words_of(&out);
        assert!(4 * words.len() <= 1500);
        let image = Image::new(&words).unwrap();
        let layout = run.out.split_once("layout ").unwrap().1;
        let layout = layout.split_once(',').unwrap().0;
        let stated = f64::from(image.validity().torque_error);
        let worst = of_curves(&image, &file, (number, layout));
        println!(
            "{} {number} {layout}: stated {stated}, found {worst}",
            path.display()
        );
        assert!(
            worst <= stated * (1.0 + budget::BETWEEN_PLACES) + budget::NO_ERROR,
            "{}: {worst} above {stated}",
            path.display()
        );
        checked += 1;
    }
    assert!(checked >= 20, "{checked}");
}

/// The largest torque error at random states; the torque is summed in double precision from the table's curves.
fn of_curves(image: &Image<'_>, file: &MachineFile, kind: (&str, &str)) -> f64 {
    let machine = machine(file);
    let domain = machine.domain();
    let (omega, alpha) = (
        image.validity().max_speed,
        image.validity().max_acceleration,
    );
    let mut random = random();
    let mut worst = 0.0f64;
    for _ in 0..2000 {
        let bits = (random() * 4_294_967_296.0) as u32;
        let phi = domain.position(f64::from(bits) / 4_294_967_296.0);
        let [inertia, slope, load, viscous, coulomb] =
            curves_at(image, kind, Phase::from_bits(bits));
        let omega = f64::from(omega) * (2.0 * random() - 1.0);
        let alpha = f64::from(alpha) * (2.0 * random() - 1.0);
        let found = inertia * alpha + 0.5 * slope * omega * omega - load
            + viscous * omega
            + coulomb * omega.signum();
        let exact = machine.reduction(phi).unwrap().torque(omega, alpha).total();
        worst = worst.max((found - exact).abs());
    }
    worst
}

fn curves_at(image: &Image<'_>, kind: (&str, &str), phase: Phase) -> [f64; 5] {
    match kind {
        ("f32", "spline") => long::<Spline<f32>>(image, phase),
        ("f32", "cubic") => long::<Cubic<f32>>(image, phase),
        ("f32", "slider-crank") => long::<SliderCrankForm>(image, phase),
        ("f32", _) => long::<Quadratic<f32>>(image, phase),
        ("i32", "spline") => long::<Spline<Q31>>(image, phase),
        ("i32", "spline16") => long::<Spline16>(image, phase),
        ("i32", "cubic") => long::<Cubic<Q31>>(image, phase),
        ("i32", _) => long::<Quadratic<Q31>>(image, phase),
        _ => long::<Rows16>(image, phase),
    }
}

fn long<F: Format>(image: &Image<'_>, phase: Phase) -> [f64; 5] {
    let table = image.table::<F>().unwrap();
    let read = table.si(phase, image.domain().to());
    [
        read.inertia,
        read.inertia_slope,
        read.load,
        read.viscous,
        read.coulomb,
    ]
}

#[test]
fn no_smaller_table_would_do() {
    let folder = Folder::new();
    for (number, layout) in KINDS {
        let of = |most: &str| {
            let line = format!("--type {number} --layout {layout} --torque-error '0.5 N m'");
            let more = typed(&line);
            export(&folder, &[&more[..], &["--max-cells", most]].concat())
        };
        let (run, path) = of("4096");
        run.ends(0);
        let cells = Image::new(&words_of(&path)).unwrap().cells();
        let (run, _) = of(&(cells - 1).to_string());
        run.ends(1).says(&[
            "no table meets a torque error of 0.5 N m",
            &format!("{layout}: "),
        ]);
        of(&cells.to_string()).0.ends(0);
    }
}

/// Loads the words and ticks once; returns an error wherever it is detected.
fn load(words: &[u32]) -> Result<f32, ImageError> {
    let image = Image::new(words)?;
    let model = image.model::<Spline<f32>, SET>()?;
    Ok(model.torque(Phase::from_radians(1.0), 2.0, 3.0))
}

#[test]
fn a_damaged_file_is_refused() {
    let folder = Folder::new();
    let words = image(&folder, &["--torque-error", "2 N m", "--layout", "spline"]);
    let whole: &[u8] = bytemuck::cast_slice(&words);
    load(&words).unwrap();
    for length in 0..words.len() {
        let error = load(&words[..length]).unwrap_err();
        assert!(
            matches!(error, ImageError::Length { .. }),
            "{length}: {error}"
        );
    }
    let mut longer = words.clone();
    longer.push(0);
    load(&longer).unwrap_err();
    for bit in 0..words.len() * 32 {
        let mut flipped = words.clone();
        flipped[bit / 32] ^= 1 << (bit % 32);
        assert!(load(&flipped).is_err(), "bit {bit}");
    }
    // Bytes that are not aligned to words.
    let mut padded = vec![0u32; words.len() + 1];
    let shifted: &mut [u8] = bytemuck::cast_slice_mut(&mut padded);
    shifted[1..=whole.len()].copy_from_slice(whole);
    let error = Image::from_bytes(&shifted[1..=whole.len()]).unwrap_err();
    assert_eq!(error, ImageError::Misaligned);
    Image::from_bytes(whole).unwrap();
    let error = Image::from_bytes(&whole[..whole.len() - 1]).unwrap_err();
    assert_eq!(error, ImageError::Misaligned);
    // Another number type, layout or set is refused.
    let image = Image::new(&words).unwrap();
    assert!(matches!(
        image.model::<Spline<Q31>, SET>(),
        Err(ImageError::NumberType(1))
    ));
    assert!(matches!(
        image.model::<Cubic<f32>, SET>(),
        Err(ImageError::Layout(1))
    ));
    assert!(matches!(
        image.model::<Rows16, SET>(),
        Err(ImageError::NumberType(1))
    ));
    assert!(matches!(
        image.model::<Spline<f32>, 0>(),
        Err(ImageError::Table(jred::table::TableError::Curves(SET)))
    ));
}

/// Rotor and gearbox of 0.01 kg m² before a belt of ratio 3 add 0.09 kg m² at the crank.
#[test]
fn the_rotor_comes_into_the_table() {
    let folder = Folder::new();
    let torque = |more: &[&str]| {
        let words = image(
            &folder,
            &[&["--torque-error", "0.05 N m", "--layout", "spline"], more].concat(),
        );
        let model = Image::new(&words).unwrap();
        let model = model.model::<Spline<f32>, SET>().unwrap();
        f64::from(model.torque(Phase::from_radians(0.7), 0.0, 100.0))
    };
    let more = torque(&["--rotor-inertia", "100 kg cm^2"]) - torque(&[]);
    assert!((more - 9.0).abs() <= 2.0 * 0.05, "{more}");
}
