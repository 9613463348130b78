//! `jred fastest`.

use std::path::PathBuf;

use clap::Args;

use super::documents::Documents;
use super::gentlest::EndAcceleration;
use super::plan::PlanFile;
use super::search::SizingOptions;
use super::series::SeriesFiles;
use super::word::word;
use jred_file::argument;
use jred_report::table::output::Format;

/// The requested reserve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReserveOption {
    /// A share of torque and speed.
    Share(f64),
    /// The share that the rules require.
    Rules,
}

fn asked(text: &str) -> Result<ReserveOption, String> {
    if text.eq_ignore_ascii_case("rules") {
        return Ok(ReserveOption::Rules);
    }
    let share = argument::any(&jred_file::units::kind::SHARE)(text)?;
    if (0.0..1.0).contains(&share) {
        return Ok(ReserveOption::Share(share));
    }
    Err("it must be at least 0 % and less than 100 %, such as \"10 %\", or \"rules\"".to_owned())
}

/// `jred fastest`
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 done; 1 the motion violates a rule of `jred size` (with --reserve rules), loses a contact, or keeps a part of the file that is beyond a limit; 2 bad input, or there is no motion within the limits.\ndocs/motion/theory.md explains the result, and why it is the fastest."
)]
pub struct Fastest {
    /// Machine file. The moves are those of its `[motion]`, whose pauses are kept, unless --from and --to are given.
    pub file: PathBuf,
    /// Position at which one move begins, e.g. "180 deg" ("20 mm" for a sliding link, and for an axis whose `[motion]` is in mm).
    #[arg(long, allow_hyphen_values = true, requires = "to")]
    pub from: Option<String>,
    /// Position at which it ends.
    #[arg(long, allow_hyphen_values = true, requires = "from")]
    pub to: Option<String>,
    /// Speed at its beginning, in the direction of the move; at rest if not given.
    #[arg(
        long,
        value_name = "SPEED",
        requires = "from",
        allow_hyphen_values = true
    )]
    pub from_speed: Option<String>,
    /// Speed at its end.
    #[arg(
        long,
        value_name = "SPEED",
        requires = "from",
        allow_hyphen_values = true
    )]
    pub to_speed: Option<String>,
    /// The drive: MOTOR+GEARBOX, or MOTOR for a direct drive; if not given, the best drive in the catalogue for the motion.
    #[arg(long, value_name = "MOTOR+GEARBOX", conflicts_with = "torque")]
    pub drive: Option<String>,
    /// Instead of a drive: largest torque at the input of the drive train, e.g. "20 N m" ("500 N" for a linear motor).
    #[arg(
        long,
        conflicts_with_all = ["catalogue", "motors", "gearboxes"],
        allow_hyphen_values = true
    )]
    pub torque: Option<String>,
    /// Largest speed of that motor, e.g. "3000 rpm" ("2 m/s"); without a limit if not given.
    #[arg(
        long,
        value_name = "SPEED",
        requires = "torque",
        allow_hyphen_values = true
    )]
    pub motor_speed: Option<String>,
    /// Inertia of its rotor, e.g. "2 kg cm^2"; zero if not given.
    #[arg(long, requires = "torque", value_parser = jred_file::argument::positive(&jred_file::units::kind::INERTIA))]
    pub rotor_inertia: Option<f64>,
    /// Share of the motor's torque and of its largest speed that stays unused, e.g. "10 %"; "rules": the motion satisfies the rules of `jred size`
    /// for motor, gearbox and amplifier (`[rules]` of the file), the motor's heat with --max-rms or --max-winding-temperature; no reserve if not
    /// given.
    #[arg(long, value_name = "SHARE|rules", value_parser = asked, allow_hyphen_values = true)]
    pub reserve: Option<ReserveOption>,
    /// Largest speed of the drive link, e.g. "90 rpm" ("0.2 m/s").
    #[arg(long, value_name = "SPEED", allow_hyphen_values = true)]
    pub max_speed: Option<String>,
    /// Largest speed of a point of the tool over a range of positions: a named point or a link, the speed, and two positions of the drive link, e.g.
    /// "slider, 60 mm/s, 300 deg, 360 deg" for a press that is slow through the work and fast elsewhere; may be repeated for several ranges.
    #[arg(long, value_name = "POINT, SPEED, FROM, TO")]
    pub max_tool_speed: Vec<String>,
    /// Largest force in a joint, e.g. "crank pin=2 kN"; `jred check` lists the joints; may be repeated for several joints.
    #[arg(long, value_name = "JOINT=FORCE")]
    pub max_reaction: Vec<String>,
    /// Largest acceleration of the drive link while its speed grows, e.g. "120 rad/s^2" ("3 m/s^2").
    #[arg(long, value_name = "ACCELERATION", allow_hyphen_values = true)]
    pub max_acceleration: Option<String>,
    /// Largest deceleration; that of --max-acceleration if not given.
    #[arg(long, value_name = "ACCELERATION", allow_hyphen_values = true)]
    pub max_deceleration: Option<String>,
    /// Largest rate of the drive link's acceleration, e.g. "2000 rad/s^3" ("50 m/s^3"): the acceleration has no jumps, also at the ends.
    #[arg(long, value_name = "JERK", allow_hyphen_values = true)]
    pub max_jerk: Option<String>,
    /// Largest rate of the motor's torque, e.g. "500 N m/s" ("5 kN/s" of a linear motor).
    #[arg(long, value_name = "RATE", allow_hyphen_values = true)]
    pub max_torque_rate: Option<String>,
    /// Acceleration at the ends of the motion; zero with --max-jerk or --max-torque-rate, otherwise free.
    #[arg(long, value_parser = word::<EndAcceleration>())]
    pub ends: Option<EndAcceleration>,
    /// Largest RMS torque over the motion with its pauses, e.g. "2 N m"; "s1": the motor's S1 torque at the mean speed, without the reserve
    /// of --reserve rules.
    #[arg(long, value_name = "TORQUE|s1", allow_hyphen_values = true)]
    pub max_rms: Option<String>,
    /// Highest temperature of the motor's winding when the motion with its pauses repeats endlessly, e.g. "120 degC": its mean and its ripple, from
    /// the thermal figures of the motor.
    #[arg(long, value_name = "TEMPERATURE", allow_hyphen_values = true)]
    pub max_winding_temperature: Option<String>,
    /// Profile and electronic cam.
    #[command(flatten)]
    pub series: SeriesFiles,
    /// Documents.
    #[command(flatten)]
    pub documents: Documents,
    /// Plan for firmware.
    #[command(flatten)]
    pub plan: PlanFile,
    /// Number of instants in the list of CSV and JSON.
    #[arg(long, default_value_t = 201, value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    pub instants: u32,
    /// Catalogue.
    #[command(flatten)]
    pub supply: SizingOptions,
    /// Output format.
    #[arg(long, value_parser = word::<Format>(), default_value_t)]
    pub format: Format,
}
