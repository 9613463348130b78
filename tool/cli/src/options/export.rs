//! `jred export`

use std::path::PathBuf;

use clap::{ArgGroup, Args};

use super::catalogue::CatalogueFiles;
use super::output_file;
use super::word::word;
use jred_export::{Choice, Core, LayoutChoice, Number, OutputForm};

/// `jred export`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 done; 1 no table meets the error, or its proof fails; 2 bad input."
)]
#[command(group = ArgGroup::new("target").required(true).multiple(true).args(["torque_error", "max_bytes", "rated_torque", "drive"]))]
#[command(group = ArgGroup::new("of_drives").multiple(true).args(["rated_torque", "drive", "counts_per_turn", "rows"])
    .conflicts_with_all(["torque_error", "max_bytes", "omega", "alpha", "pieces", "prove", "forward"]))]
pub struct Export {
    /// Machine file.
    pub file: PathBuf,
    /// Form of the output.
    #[arg(long, value_parser = word::<OutputForm>(), default_value_t)]
    pub format: OutputForm,
    /// Number type of the table.
    #[arg(long = "type", value_parser = word::<Number>(), default_value_t)]
    pub number: Number,
    /// Layout of the curves in memory.
    #[arg(long, value_parser = word::<LayoutChoice>(), default_value_t)]
    pub layout: LayoutChoice,
    /// Core that the firmware runs on: of the layouts that meet the torque error, one with the fewest instructions there is taken, unless
    /// --max-bytes or --layout is given.
    #[arg(long, value_parser = word::<Core>(), default_value_t)]
    pub core: Core,
    /// The firmware also computes accelerations: forward dynamics, limits, governor. Tables in fixed point then have a curve of 1/J.
    #[arg(long)]
    pub forward: bool,
    /// A curve of 1/J, which avoids the division in fixed-point forward dynamics; auto: with --forward.
    #[arg(long, value_parser = word::<Choice>(), default_value_t)]
    pub reciprocal: Choice,
    /// Largest error of the drive torque at the drive link, e.g. "0.5 N m" ("5 N" for a sliding link); optional with
    /// --max-bytes.
    #[arg(long, allow_hyphen_values = true)]
    pub torque_error: Option<String>,
    /// Largest speed of the drive link, e.g. "90 rpm" ("0.2 m/s" for a sliding link); if not given, that of the motion.
    #[arg(long, allow_hyphen_values = true)]
    pub omega: Option<String>,
    /// Largest acceleration of the drive link, e.g. "120 rad/s^2" ("3 m/s^2"); if not given, that of the motion, or omega^2
    /// if the motion has none.
    #[arg(long, allow_hyphen_values = true)]
    pub alpha: Option<String>,
    /// Include this inertia of rotor and gearbox at the input of the drive train, e.g. "90 kg cm^2".
    #[arg(long, value_parser = jred_file::argument::positive(&jred_file::units::kind::INERTIA))]
    pub rotor_inertia: Option<f64>,
    /// Largest number of cells to try.
    #[arg(long, default_value_t = 4096, value_parser = clap::value_parser!(u32).range(4..=65535))]
    pub max_cells: u32,
    /// Largest size of the image in bytes, including header and CRC. Without --torque-error: write the most accurate table
    /// of this size.
    #[arg(long)]
    pub max_bytes: Option<u32>,
    /// A table for each piece of the range, for loads that begin and end steeply and mechanisms with corners: the positions
    /// where pieces meet, e.g. "60 deg, 75 deg" (of a turn: modulo 360 deg); or auto, for the edges of loads, of a disc cam's
    /// segments and of a Geneva drive's engagement. Not together with --max-bytes.
    #[arg(
        long,
        value_name = "auto|POSITIONS",
        conflicts_with = "max_bytes",
        allow_hyphen_values = true
    )]
    pub pieces: Option<String>,
    /// Identifier of the machine in the image, by which firmware refuses the image of another machine, e.g. 7 or 0x1a2b; if not given, the CRC-32 of
    /// the title.
    #[arg(long, value_name = "NUMBER", value_parser = machine_id, allow_negative_numbers = true)]
    pub machine_id: Option<u32>,
    /// Name of the table in the program, for --format c, rust, st and plcopen: a prefix of the names in C, a module in Rust, the function block in a
    /// PLC; if not given, C and PLC use the name of the file to write.
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// For --format cia402: the motor's rated torque as set in object 0x6076 of the drive, e.g. "4.2 N m"; torques are thousandths of it. If not
    /// given, that of --drive.
    #[arg(long, allow_hyphen_values = true)]
    pub rated_torque: Option<String>,
    /// For --format cia402: the drive whose motor has the torque, MOTOR+GEARBOX, or MOTOR for a direct drive, with its inertia, losses and friction; if
    /// not given, the torque is that of the input of the machine.
    #[arg(long, value_name = "MOTOR+GEARBOX", conflicts_with = "rotor_inertia")]
    pub drive: Option<String>,
    /// For --format cia402: increments of object 0x6064 in a turn of the shaft that has the torque, for a column of positions: the motor with --drive,
    /// else the input of the machine.
    #[arg(long, value_name = "COUNTS", value_parser = clap::value_parser!(u32).range(1..))]
    pub counts_per_turn: Option<u32>,
    /// For --format cia402: number of rows, at equal times over the motion; 1001 if not given.
    #[arg(long, value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    pub rows: Option<u32>,
    /// Prove the torque error over every position, by interval arithmetic, with all roundings of the ticks; takes some seconds. The image then
    /// contains the proven error. Exit code 1 if that is larger than --torque-error, or if it cannot be proven.
    #[arg(long)]
    pub prove: bool,
    /// File to write; if not given, only a summary is printed (as JSON with --format json).
    #[arg(long, short, value_parser = output_file())]
    pub out: Option<PathBuf>,
    /// Parts of drives.
    #[command(flatten)]
    pub catalogue: CatalogueFiles,
}

/// A number of 32 bits, decimal or hexadecimal.
fn machine_id(text: &str) -> Result<u32, String> {
    let found = match text.strip_prefix("0x") {
        Some(digits) => u32::from_str_radix(digits, 16),
        None => text.parse(),
    };
    match found {
        Ok(0) => Err("0 means that an image has no identifier; take another number".to_owned()),
        Ok(number) => Ok(number),
        Err(_) => Err(
            "write a whole number from 1 to 4294967295, or 0x and up to eight hexadecimal digits"
                .to_owned(),
        ),
    }
}
