//! `jred export`: the image holds the machine's torque to the error that it states, in every form that it is written.
// Copied figures, counts and zeros are exact.
#![allow(clippy::float_cmp)]

mod support;

use std::path::PathBuf;

use jred::table::curves;
use jred::{Image, ImageError, Phase, Q31};
use support::{Columns, Folder, Run, budget, jred, largest, press_file};

/// Exports the press.
fn export(
    folder: &Folder,
    number: &str,
    form: &str,
    error: &str,
    more: [&str; 2],
) -> (Run, PathBuf) {
    let out = folder.path(&format!("press-{number}-{form}"));
    let run = jred([
        &"export",
        &press_file(),
        &"--type",
        &number,
        &"--format",
        &form,
        &"--torque-error",
        &error,
        &more[0],
        &more[1],
        &"--out",
        &out,
    ]);
    (run, out)
}

const NO_MORE: [&str; 2] = ["--max-cells", "4096"];

fn words_of(path: &PathBuf) -> Vec<u32> {
    let bytes = std::fs::read(path).unwrap();
    assert_eq!(bytes.len() % 4, 0);
    let word = |chunk: &[u8]| u32::from_le_bytes(chunk.try_into().unwrap());
    bytes.chunks_exact(4).map(word).collect()
}

/// φ, ω, α and drive torque of the press over its cycle, from the command.
fn motion() -> [Vec<f64>; 4] {
    let run = jred([
        &"reduce",
        &press_file(),
        &"--over",
        &"time",
        &"--positions",
        &"4001",
        &"--format",
        &"json",
    ]);
    let columns = Columns::of_json(&run.ends(0).json());
    [
        "phi [deg]",
        "omega [rad/s]",
        "alpha [rad/s^2]",
        "T_drive [N m]",
    ]
    .map(|name| columns.get(name))
}

/// The torque that the image gives at each instant.
fn torques(image: &Image, number: &str, [phi, omega, alpha, _]: &[Vec<f64>; 4]) -> Vec<f64> {
    let instants = phi.iter().zip(omega).zip(alpha);
    let phase = |phi: f64| Phase::from_radians(phi.to_radians());
    if number == "f32" {
        let model = image.model::<f32, { curves::ALL }>().unwrap();
        let torque = instants.map(|((phi, omega), alpha)| {
            let torque = model.torque(phase(*phi), *omega as f32, *alpha as f32);
            f64::from(torque.value)
        });
        torque.collect()
    } else {
        let model = image.model::<Q31, { curves::ALL }>().unwrap();
        let scale = image.scale();
        let torque = instants.map(|((phi, omega), alpha)| {
            let omega = scale.omega::<Q31>(*omega as f32).value;
            let alpha = scale.alpha::<Q31>(*alpha as f32).value;
            let torque = model.torque(phase(*phi), omega, alpha);
            f64::from(scale.torque_si(torque.value))
        });
        torque.collect()
    }
}

#[test]
fn the_image_gives_the_torque_of_the_machine() {
    let folder = Folder::new();
    let motion = motion();
    for number in ["f32", "q31"] {
        let mut before = 0;
        for allowed in [2.0, 0.5, 0.05] {
            let (run, path) = export(&folder, number, "image", &format!("{allowed} N m"), NO_MORE);
            let run = run.ends(0);
            let words = words_of(&path);
            let image = Image::new(&words).unwrap();
            let stated = f64::from(image.validity().torque_error);
            assert!(
                stated <= allowed && stated > allowed / 20.0,
                "{stated} of {allowed}"
            );
            let found = torques(&image, number, &motion);
            let errors: Vec<f64> = found.iter().zip(&motion[3]).map(|(a, b)| a - b).collect();
            let worst = largest(&errors);
            println!(
                "{number}, {allowed} N m: {} cells, stated {stated}, found {worst}",
                image.cells()
            );
            let rounding = budget::TICK_ROUNDING * largest(&motion[3]);
            assert!(
                worst <= stated * (1.0 + budget::BETWEEN_CHECKS) + rounding,
                "{worst} above {stated}"
            );
            // The bound is not idle: the motion comes within a tenth of it.
            assert!(worst > stated / 10.0, "{worst} far below {stated}");
            assert!(image.cells() > before, "a smaller error needs more cells");
            before = image.cells();
            // What is printed is what the header says.
            let printed = number_after(&run.out, "torque error reached ");
            assert!(
                (printed / stated - 1.0).abs() < 1e-5,
                "{printed} and {stated}"
            );
            let printed = number_after(&run.out, &format!("{number}, "));
            assert_eq!(printed, f64::from(image.cells()));
            let bytes = number_after(&run.out, "coulomb, ");
            assert_eq!(bytes, 4.0 * words.len() as f64);
            let omega = number_after(&run.out, "|omega| <= ");
            assert!((omega / f64::from(image.validity().omega) - 1.0).abs() < 1e-5);
            assert!((omega / largest(&motion[1]) - 1.0).abs() < 1e-5);
            let alpha = number_after(&run.out, "|alpha| <= ");
            assert!((alpha / largest(&motion[2]) - 1.0).abs() < 1e-5);
        }
    }
}

fn number_after(text: &str, mark: &str) -> f64 {
    let (_, rest) = text
        .split_once(mark)
        .unwrap_or_else(|| panic!("no {mark:?} in {text}"));
    let end = rest
        .find(|c: char| !"0123456789.e-".contains(c))
        .unwrap_or(rest.len());
    rest[..end].trim_end_matches('.').parse().unwrap()
}

/// The hexadecimal words of a source text.
fn words_in(source: &str) -> Vec<u32> {
    source
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter_map(|word| word.strip_prefix("0x"))
        .map(|word| u32::from_str_radix(word, 16).unwrap())
        .collect()
}

#[test]
fn source_texts_hold_the_image() {
    let folder = Folder::new();
    for number in ["f32", "q31"] {
        let (_, image) = export(&folder, number, "image", "0.5 N m", NO_MORE);
        let image = words_of(&image);
        let (run, rust) = export(&folder, number, "rust", "0.5 N m", NO_MORE);
        run.ends(0);
        let rust = std::fs::read_to_string(rust).unwrap();
        assert!(rust.contains(&format!("pub static TABLE: [u32; {}] = [", image.len())));
        assert_eq!(words_in(&rust), image);
        let (run, c) = export(&folder, number, "c", "0.5 N m", NO_MORE);
        run.ends(0);
        let c = std::fs::read_to_string(c).unwrap();
        assert!(c.contains("#include <stdint.h>"));
        assert!(c.contains(&format!("const uint32_t jred_table[{}] = {{", image.len())));
        assert_eq!(words_in(&c), image);
        // Outside the comment: a declaration, words, and a closing bracket; as many open as close.
        for text in [&rust, &c] {
            let code: String = text.lines().filter(|l| !l.starts_with("//")).collect();
            let count = |c: char| code.matches(c).count();
            assert_eq!(
                (count('['), count('{'), count('(')),
                (count(']'), count('}'), count(')'))
            );
            assert!(code.trim_end().ends_with("};") || code.trim_end().ends_with("];"));
            assert!(
                text.lines()
                    .all(|line| line.is_ascii() || line.starts_with("//"))
            );
        }
    }
}

/// A title goes into a comment, and must not leave it.
#[test]
fn a_title_stays_in_its_comment() {
    let folder = Folder::new();
    let title = "title = \"one\\nint evil; \\\\\\nend\"";
    let text = support::edited_press("title = \"Servo press, 60 mm stroke, 10 kN\"", title);
    let file = folder.file("m.toml", text);
    let out = folder.path("table.c");
    let run = jred([
        &"export",
        &file,
        &"--format",
        &"c",
        &"--torque-error",
        &"1 N m",
        &"--out",
        &out,
    ]);
    if run.code == 2 {
        return; // Refused as a title: just as good.
    }
    let source = std::fs::read_to_string(out).unwrap();
    for line in source.lines() {
        assert!(line.starts_with("//") || !line.contains("evil"), "{line}");
    }
}

#[test]
fn no_smaller_table_would_do() {
    let folder = Folder::new();
    for number in ["f32", "q31"] {
        let (_, path) = export(&folder, number, "image", "0.5 N m", NO_MORE);
        let cells = Image::new(&words_of(&path)).unwrap().cells();
        let most = (cells - 1).to_string();
        let (run, _) = export(&folder, number, "image", "0.5 N m", ["--max-cells", &most]);
        run.ends(1).says(&[
            "no table meets a torque error",
            &format!("{most} cells reach"),
        ]);
        let most = cells.to_string();
        let (run, _) = export(&folder, number, "image", "0.5 N m", ["--max-cells", &most]);
        run.ends(0);
    }
}

/// Loads the words and ticks them once; an error wherever it is noticed.
fn load(words: &[u32]) -> Result<f32, ImageError> {
    let image = Image::new(words)?;
    let model = image.model::<f32, { curves::ALL }>()?;
    Ok(model.torque(Phase::from_radians(1.0), 2.0, 3.0).value)
}

#[test]
fn a_damaged_file_is_refused() {
    let folder = Folder::new();
    let (_, path) = export(&folder, "f32", "image", "2 N m", NO_MORE);
    let bytes = std::fs::read(&path).unwrap();
    let words = words_of(&path);
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
    // Bytes that do not lie on words.
    let mut padded = vec![0u32; words.len() + 1];
    let shifted: &mut [u8] = bytemuck::cast_slice_mut(&mut padded);
    shifted[1..=bytes.len()].copy_from_slice(&bytes);
    let error = Image::from_bytes(&shifted[1..=bytes.len()]).unwrap_err();
    assert_eq!(error, ImageError::Misaligned);
    let whole: &[u8] = bytemuck::cast_slice(&words);
    Image::from_bytes(whole).unwrap();
    assert_eq!(
        Image::from_bytes(&whole[..whole.len() - 1]).unwrap_err(),
        ImageError::Misaligned
    );
    // The other number type is refused, not misread.
    let image = Image::new(&words).unwrap();
    assert!(matches!(
        image.model::<Q31, { curves::ALL }>(),
        Err(ImageError::NumberType(1))
    ));
    assert!(matches!(
        image.model::<f32, 0>(),
        Err(ImageError::Curves(7))
    ));
}

/// Rotor and gearbox of 0.01 kg m² in front of a belt of ratio 3 add 0.09 kg m² at the crank.
#[test]
fn the_rotor_comes_into_the_table() {
    let folder = Folder::new();
    let torque = |more: [&str; 2]| {
        let (run, path) = export(&folder, "f32", "image", "0.05 N m", more);
        run.ends(0);
        let words = words_of(&path);
        let model = Image::new(&words).unwrap();
        let model = model.model::<f32, { curves::ALL }>().unwrap();
        f64::from(model.torque(Phase::from_radians(0.7), 0.0, 100.0).value)
    };
    let more = torque(["--rotor-inertia", "100 kg cm^2"]) - torque(NO_MORE);
    assert!((more - 9.0).abs() <= 2.0 * 0.05, "{more}");
}
