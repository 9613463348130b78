//! The torque of a motion in the units of a drive with the profile CiA 402, as feed-forward.
//!
//! The torque offset 0x60B2 and the target torque 0x6071 count thousandths of the motor's rated torque 0x6076, which is in mN·m; the position 0x6064
//! counts increments.

use std::f64::consts::TAU;
use std::fmt::{self, Write as _};

use jred_file::number::rounding::rounded;

/// An instant at the shaft of the motor.
#[derive(Clone, Copy, Debug)]
pub struct ShaftInstant {
    /// Time (s).
    pub t: f64,
    /// Position (rad, or m).
    pub position: f64,
    /// Torque (N·m, or N), positive where it moves the shaft towards growing position.
    pub torque: f64,
}

/// A table for a drive.
#[derive(Clone, Copy, Debug)]
pub struct TorqueOffsets<'a> {
    /// Name of the machine.
    pub title: &'a str,
    /// The instants.
    pub instants: &'a [ShaftInstant],
    /// Rated torque in the drive's object 0x6076 (N·m, or N).
    pub rated: f64,
    /// Increments of a turn of the shaft, for a column of positions.
    pub counts_per_turn: Option<u32>,
    /// Inertia of the rotor in the torques (kg·m²).
    pub rotor: f64,
    /// Unit of torques: "N m", or "N".
    pub unit: &'static str,
}

/// A figure that a drive cannot represent.
#[derive(Clone, Debug, PartialEq)]
pub enum TorqueOffsetFault {
    /// The rated torque (N·m, or N) in 0x6076.
    Rated(f64, &'static str),
    /// A torque (N·m, or N) at a time (s), in thousandths, and the least rated torque that represents it.
    Torque {
        /// Time (s).
        t: f64,
        /// Torque (N·m, or N).
        torque: f64,
        /// Thousandths of the rated torque.
        per_mille: f64,
        /// The least rated torque (N·m, or N) for which the motion fits.
        least: f64,
        /// Unit of torques.
        unit: &'static str,
    },
    /// A position at a time (s), in increments.
    Position(f64, f64),
}

/// Largest magnitude of a thousandth in an INTEGER16, whose least number is not used.
const MOST: f64 = i16::MAX as f64;

impl fmt::Display for TorqueOffsetFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rated(rated, unit) => write!(
                f,
                "the rated torque {} {unit} does not fit object 0x6076, whole m{unit} from 1 to {}",
                rounded(*rated),
                u32::MAX
            ),
            Self::Torque {
                t,
                torque,
                per_mille,
                unit,
                ..
            } => write!(
                f,
                "the torque {} {unit} at t = {} s is {} per mille of the rated torque: objects 0x60B2 and 0x6071 are INTEGER16, up to {MOST}",
                rounded(*torque),
                rounded(*t),
                rounded(*per_mille)
            ),
            Self::Position(t, counts) => write!(
                f,
                "the position at t = {} s is {} counts: object 0x6064 is INTEGER32, up to {}",
                rounded(*t),
                rounded(*counts),
                i32::MAX
            ),
        }
    }
}

impl TorqueOffsetFault {
    /// The cure.
    pub fn cure(&self) -> String {
        match self {
            Self::Rated(..) => {
                "give the rated torque of the motor, as it is set in the drive".to_owned()
            }
            Self::Torque { least, unit, .. } => format!(
                "is --rated-torque that of the motor? From {} {unit} the motion fits; set the same in object 0x6076",
                rounded(*least)
            ),
            Self::Position(..) => {
                "give fewer --counts-per-turn, as scaled in the drive, or a motion of fewer turns"
                    .to_owned()
            }
        }
    }
}

impl TorqueOffsets<'_> {
    /// The table as CSV, with base and frame in comments.
    ///
    /// # Errors
    /// A number beyond the range of its object.
    pub fn csv(&self) -> Result<String, TorqueOffsetFault> {
        let unit = self.unit;
        let base = (self.rated * 1e3).round();
        if !(1.0..=f64::from(u32::MAX)).contains(&base) {
            return Err(TorqueOffsetFault::Rated(self.rated, unit));
        }
        // The drive knows the rated torque in whole thousandths of a newton metre only.
        let rated = base * 1e-3;
        let largest = (self.instants.iter()).fold(0.0, |most, i| f64::max(most, i.torque.abs()));
        let mut text = String::new();
        let title = self.title.replace(['\n', '\r'], " ");
        for line in [
            title,
            format!("base: 0x6076 = {base} m{unit}; 1 per mille = {} {unit}", rounded(rated * 1e-3)),
            format!("largest torque {} {unit}; rounded to half of a per mille", rounded(largest)),
            "frame: the shaft of the motor, at the input of the drive train; positive torque and counts where the drive link moves to growing position, \
             negative if the ratio is"
                .to_owned(),
            format!(
                "inertia of rotor and gearbox in the torque: {} kg m^2",
                rounded(self.rotor)
            ),
            "write the torque to 0x60B2 (torque offset) in position and velocity modes, to 0x6071 (target torque) in torque mode"
                .to_owned(),
        ] {
            let _ = writeln!(text, "# {line}");
        }
        text += match self.counts_per_turn {
            Some(_) => "t [s],0x6064 [counts],0x60B2 [per mille]\n",
            None => "t [s],0x60B2 [per mille]\n",
        };
        for ShaftInstant {
            t,
            position,
            torque,
        } in self.instants
        {
            // Avoids -0.
            let per_mille = (torque / rated * 1e3).round() + 0.0;
            if !(-MOST..=MOST).contains(&per_mille) {
                return Err(TorqueOffsetFault::Torque {
                    t: *t,
                    torque: *torque,
                    per_mille,
                    // In whole thousandths, so that it fits.
                    least: (largest * 1e6 / MOST).ceil() * 1e-3,
                    unit,
                });
            }
            let counts = match self.counts_per_turn {
                None => String::new(),
                Some(per_turn) => {
                    let counts = (position / TAU * f64::from(per_turn)).round() + 0.0;
                    if !(f64::from(-i32::MAX)..=f64::from(i32::MAX)).contains(&counts) {
                        return Err(TorqueOffsetFault::Position(*t, counts));
                    }
                    format!("{counts},")
                }
            };
            let _ = writeln!(text, "{t},{counts}{per_mille}");
        }
        Ok(text)
    }
}
