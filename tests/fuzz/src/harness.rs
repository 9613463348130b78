//! One function for each kind of input. It returns whether the input was accepted, and panics on a fault.

use jred::number::Quantity;
use std::collections::BTreeMap;
use std::sync::OnceLock;

use clap::Parser as _;
use jred::table::Format;
use jred::{
    Cubic, Harmonic, Image, Phase, Q31, Quadratic, Rows16, SliderCrankForm, Spline, Spline16,
    number::Number,
};
use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_analysis::inspect::Findings;
use jred_analysis::reduce::{Over, Request, Sets, reduce};
use jred_analysis::simulate::simulate;
use jred_cli::options::Cli;
use jred_cli::rows::store;
use jred_file::model::machine::MachineFile;
use jred_file::number::columns::Columns;
use jred_report::list::inspection;
use jred_report::list::rule_words::reasons;
use jred_report::table::output::{Format as Sheet, write};
use jred_report::table::rows::RowFormat;
use jred_report::table::screen::Screen;
use jred_sizing::catalogue::Catalogue;
use jred_sizing::cell::Cell;
use jred_sizing::cycle::Cycle;
use jred_sizing::select::fit::fit_input;
use jred_sizing::select::size::Selection;

use crate::{NAMED, at, files, no_number};

/// A kind of input, its seeds, and its processing.
#[derive(Clone, Copy, Debug)]
pub struct Harness {
    /// Its name.
    pub name: &'static str,
    /// Whether `corpus/` has a folder of this name.
    pub kept: bool,
    /// Seeds of the inputs.
    pub seeds: fn() -> Vec<Vec<u8>>,
    /// Processes an input like jred; returns whether it was accepted.
    pub run: fn(&[u8]) -> bool,
}

/// All harnesses.
pub const ALL: [Harness; 7] = [
    Harness {
        name: "image",
        kept: true,
        seeds: || files(&["examples/data", "examples/bits/data"], ".jred"),
        run: image,
    },
    Harness {
        name: "plan",
        kept: true,
        seeds: plans,
        run: crate::plan::plan,
    },
    Harness {
        name: "machine",
        kept: false,
        seeds: || files(&["machines"], ".toml"),
        run: |text| texts(text, machine),
    },
    Harness {
        name: "profile",
        kept: true,
        seeds: profiles,
        run: |text| texts(text, profile),
    },
    Harness {
        name: "catalogue",
        kept: true,
        seeds: catalogues,
        run: |text| texts(text, catalogue),
    },
    Harness {
        name: "rows",
        kept: true,
        seeds: || files(&["tests/fuzz/corpus/rows"], ""),
        run: |text| texts(text, rows),
    },
    Harness {
        name: "arguments",
        kept: true,
        seeds: || files(&["tests/fuzz/corpus/arguments"], ""),
        run: |text| texts(text, arguments),
    },
];

impl Harness {
    /// Complete inputs with former faults, or worth changing.
    ///
    /// # Panics
    /// The folder is not there.
    pub fn corpus(&self) -> Vec<Vec<u8>> {
        if !self.kept {
            return Vec::new();
        }
        files(&[&format!("tests/fuzz/corpus/{}", self.name)], "")
    }
}

/// The harness of this name.
pub fn named(name: &str) -> Option<Harness> {
    ALL.into_iter().find(|harness| harness.name == name)
}

/// Bytes that are not text are refused before they reach a reader.
fn texts(bytes: &[u8], run: fn(&str) -> bool) -> bool {
    std::str::from_utf8(bytes).is_ok_and(run)
}

/// Seeds of plans: that of the examples, and the kept ones.
fn plans() -> Vec<Vec<u8>> {
    let mut seeds = files(&["examples/data"], "_plan.jred");
    seeds.extend(files(&["tests/fuzz/corpus/plan"], ""));
    seeds
}

/// A table image: its CRC is corrected, so that the content is checked; accepted images are ticked.
fn image(bytes: &[u8]) -> bool {
    let words = with_crc(bytes);
    let Ok(image) = Image::new(&words) else {
        return false;
    };
    let found = [
        ticks::<Spline<f32>>(&image),
        ticks::<Cubic<f32>>(&image),
        ticks::<Quadratic<f32>>(&image),
        ticks::<Harmonic<f32>>(&image),
        ticks::<SliderCrankForm>(&image),
        ticks::<Spline<Q31>>(&image),
        ticks::<Cubic<Q31>>(&image),
        ticks::<Quadratic<Q31>>(&image),
        ticks::<Spline16>(&image),
        ticks::<Rows16>(&image),
    ];
    found.contains(&true)
}

/// Ticks at the ends of every cell and of the number range; returns whether the image has this format.
fn ticks<F: Format>(image: &Image<'_>) -> bool {
    let Ok(model) = image.any_model::<F>() else {
        return false;
    };
    // In f32 up to the size of a table's own figures; a fixed-point number is limited to its range.
    let numbers = [0.0, 0.999, -1.0, 0.3, -1e-3].into_iter();
    let numbers: Vec<F::Number> = numbers.filter_map(F::Number::from_f64).collect();
    for k in 0..512u32 {
        let phase = Phase::from_bits(((k / 2) << 24).wrapping_sub(k % 2));
        for &a in &numbers {
            let b = numbers[k as usize % numbers.len()];
            let (omega, alpha) = (Quantity::of(a), Quantity::of(b));
            let torque = model.torque(phase, omega, alpha);
            let reach = model.acceleration_range(phase, omega, Quantity::of(b), torque);
            let [least, greatest] = [reach.least, reach.greatest].map(|end| end.value.number());
            for value in [torque.number(), least, greatest] {
                // A table of f32 may contain figures whose products exceed its range.
                assert!(
                    !value.to_f64().is_nan(),
                    "{phase:?}, {a:?}, {b:?}: {value:?}"
                );
            }
        }
    }
    true
}

/// Bytes as the words of an image with a correct CRC.
pub(crate) fn with_crc(bytes: &[u8]) -> Vec<u32> {
    let words = bytes
        .chunks_exact(4)
        .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]));
    let mut words: Vec<u32> = words.collect();
    if let Some((last, before)) = words.split_last_mut() {
        *last = crc32(before);
    }
    words
}

/// CRC-32 as in IEEE 802.3.
fn crc32(words: &[u32]) -> u32 {
    !words
        .iter()
        .flat_map(|word| word.to_le_bytes())
        .fold(u32::MAX, |crc, byte| {
            (0..8).fold(crc ^ u32::from(byte), |crc, _| {
                (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg())
            })
        })
}

/// The CSV files named in machine files.
fn data() -> BTreeMap<String, String> {
    let text = |name: &str| std::fs::read_to_string(at("machines").join(name)).expect("an example");
    NAMED.map(|name| (name.to_owned(), text(name))).into()
}

/// A machine file: reduced, checked, run through its motion, and sized with the built-in catalogue.
fn machine(text: &str) -> bool {
    static DATA: OnceLock<BTreeMap<String, String>> = OnceLock::new();
    computed(text, DATA.get_or_init(data))
}

/// Seeds of profiles: recorded speeds of a drive, positions, and states.
fn profiles() -> Vec<Vec<u8>> {
    let mut seeds = files(&["machines"], "drive-log.csv");
    seeds.extend(files(&["tests/fuzz/corpus/profile"], ""));
    seeds
}

/// A recorded motion, for a machine that smooths it and for one that uses it as it is.
fn profile(text: &str) -> bool {
    static MACHINES: OnceLock<[String; 2]> = OnceLock::new();
    let machines = MACHINES.get_or_init(|| {
        let smooth = std::fs::read_to_string(at("machines/reduced-curves.toml"));
        let smooth = smooth.expect("an example");
        let lines = smooth.lines().filter(|line| !line.starts_with("smoothing"));
        let plain: Vec<&str> = lines.collect();
        [plain.join("\n"), smooth]
    });
    let mut data = data();
    data.insert("drive-log.csv".to_owned(), text.to_owned());
    // Not `any`: both must be tried.
    let understood = machines.each_ref().map(|machine| computed(machine, &data));
    understood.contains(&true)
}

fn computed(text: &str, files: &BTreeMap<String, String>) -> bool {
    let file = match checked::parse("machine.toml", text, files) {
        Ok(file) => file,
        Err(report) => {
            assert!(!format!("{report:?}").is_empty());
            return false;
        }
    };
    let curves = Sets {
        curves: true,
        links: true,
        ..Sets::default()
    };
    let others = [
        Sets {
            points: true,
            ..Sets::default()
        },
        Sets {
            reactions: true,
            ..Sets::default()
        },
        Sets {
            energy: true,
            ..Sets::default()
        },
    ];
    for (over, sets) in [(Over::Angle, curves), (Over::Time, curves)]
        .into_iter()
        .chain(others.map(|sets| (Over::Time, sets)))
    {
        if over == Over::Time && file.motion.is_none() {
            continue;
        }
        let request = Request {
            over,
            positions: 9,
            sets,
            state: None,
        };
        if let Ok(columns) = reduce(&file, &request) {
            written(&columns);
        }
    }
    if let Some(simulation) = &file.simulation
        && let Ok(found) = simulate(&file, simulation)
    {
        written(&found.columns);
    }
    if let Ok(findings) = Findings::of(&file) {
        let answer = inspection::answer(&findings);
        for format in [Sheet::Json, Sheet::Table] {
            sound(&answer.write(format, Screen::default()).collect::<String>());
        }
    }
    sized(&file);
    true
}

/// Text, CSV and JSON of the same columns: finite, and the same numbers.
fn written(columns: &Columns) {
    for row in columns.rows() {
        assert!(
            row.iter().flatten().all(|cell| cell.is_finite()),
            "{row:?} of {:?}",
            columns.names()
        );
    }
    let csv = write(columns, Sheet::Csv, "");
    let json: serde_json::Value =
        serde_json::from_str(&write(columns, Sheet::Json, "")).expect("JSON");
    let mut rows = csv::Reader::from_reader(csv.as_bytes());
    let rows: Vec<csv::StringRecord> = rows.records().collect::<Result<_, _>>().expect("CSV");
    let of_json = json["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), of_json.len());
    for (row, of_json) in rows.iter().zip(of_json) {
        for (cell, of_json) in row.iter().zip(of_json.as_array().expect("a row")) {
            let cell: Option<f64> = cell.parse().ok();
            // The general JSON parser may differ by a unit in the last place.
            let close = |(a, b): (f64, f64)| (a - b).abs() <= 2.0 * f64::EPSILON * a.abs();
            assert!(
                cell == of_json.as_f64() || cell.zip(of_json.as_f64()).is_some_and(close),
                "{cell:?}, {of_json:?}"
            );
        }
    }
    sound(&write(columns, Sheet::Table, ""));
}

/// The text contains no NaN and no infinity.
///
/// # Panics
/// It contains one.
fn sound(text: &str) {
    assert_eq!(no_number(text), None, "in {text}");
}

fn sized(file: &MachineFile) {
    let Some(motion) = &file.motion else {
        return;
    };
    let mut catalogue = built_in().clone();
    let (Ok(()), Ok(duty)) = (
        fit_input(&mut catalogue, file),
        Duty::new(file, motion, 200),
    ) else {
        return;
    };
    judged(&catalogue, &Cycle::new(&duty), file);
}

fn judged(catalogue: &Catalogue, cycle: &Cycle, file: &MachineFile) {
    let motors = catalogue.prepare(&file.site);
    let selection = Selection::new(catalogue, &motors, cycle, &file.site, &file.rules);
    for candidate in selection
        .first_fit(3)
        .iter()
        .chain(&selection.first_refused(3))
    {
        sound(&reasons(&selection.judged(candidate)));
    }
}

fn built_in() -> &'static Catalogue {
    static CATALOGUE: OnceLock<Catalogue> = OnceLock::new();
    CATALOGUE.get_or_init(|| Catalogue::built_in().expect("the built-in catalogue"))
}

/// Separator between the name of a catalogue's table and its text in an input.
const NAME_ENDS: char = '\n';

/// The first rows of the built-in tables, each after its name: mutating the hundredth row shows no more. Only kept inputs have gearboxes with every
/// column, and a catalogue in TOML.
fn catalogues() -> Vec<Vec<u8>> {
    let table = |name: &str| {
        let table = at("tool/sizing/catalogue").join(name);
        let text = std::fs::read_to_string(table).expect("a built-in table");
        let rows: Vec<&str> = text.lines().take(8).collect();
        format!("{name}{NAME_ENDS}{}\n", rows.join("\n")).into_bytes()
    };
    let built_in = ["gearboxes.csv", "motors.csv", "resistors.csv"].map(table);
    [&built_in[..], &files(&["tests/fuzz/corpus/catalogue"], "")].concat()
}

/// A table of a catalogue: the name of its file on the first line, then its text. The press is sized with it.
fn catalogue(input: &str) -> bool {
    static PRESS: OnceLock<(MachineFile, Cycle)> = OnceLock::new();
    let (press, cycle) = PRESS.get_or_init(|| {
        let file = checked::read(&at("machines/press.toml")).expect("an example");
        let motion = file.motion.as_ref().expect("a motion");
        let cycle = Cycle::new(&Duty::new(&file, motion, 200).expect("a duty"));
        (file, cycle)
    });
    let Some((name, text)) = input.split_once(NAME_ENDS) else {
        return false;
    };
    let found = [false, true].map(|skip| Catalogue::of_texts([(name, text)], skip));
    for found in found.iter().filter_map(|found| found.as_ref().err()) {
        assert!(!found.to_string().is_empty());
    }
    let mut understood = false;
    for mut catalogue in found.into_iter().flatten() {
        understood = true;
        if catalogue.motors.is_empty() {
            catalogue.motors.clone_from(&built_in().motors);
        }
        let _ = catalogue.one_currency();
        if fit_input(&mut catalogue, press).is_ok() {
            judged(&catalogue, cycle, press);
        }
    }
    understood
}

/// A file of a study's rows: its header, then every line as a row.
fn rows(text: &str) -> bool {
    let path = std::path::Path::new("rows.csv");
    let mut lines = text.lines().peekable();
    let first = lines.next().unwrap_or_default();
    let Ok(form) = store::form(first, path) else {
        return false;
    };
    let study = match form {
        RowFormat::Csv => lines.peek().and_then(|row| RowFormat::study_of(row)),
        _ => Some(first.to_owned()),
    };
    let Some(Ok(header)) = study.map(|study| store::parse(&study, path)) else {
        return false;
    };
    let mut found = 0;
    for line in lines {
        let (index, cells) = match form.row(line, &header.columns) {
            Some(row) => {
                found += 1;
                row
            }
            None if line.contains(char::is_control) => continue,
            None => {
                let texts = line
                    .split(',')
                    .map(Cell::from)
                    .chain(std::iter::repeat(Cell::Empty));
                (0, texts.take(header.columns.len()).collect())
            }
        };
        let again = form.line(&header.columns, index, &cells, None);
        let read = form.row(again.trim_end(), &header.columns);
        assert!(
            read.is_some_and(|(_, cells)| cells.len() == header.columns.len()),
            "{line:?} is written as {again:?}"
        );
    }
    found > 0
}

/// Words of a command line, one per line, after the name of the program: parsed, not run.
fn arguments(text: &str) -> bool {
    let words = std::iter::once("jred").chain(text.lines());
    match Cli::try_parse_from(words) {
        Ok(_) => true,
        Err(error) => {
            assert!(!error.render().to_string().is_empty());
            false
        }
    }
}
