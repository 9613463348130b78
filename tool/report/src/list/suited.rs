//! Drives with motions made for them: the head of the list of `jred size --motion best`.

use schemars::JsonSchema;
use serde::Serialize;

use jred_file::model::machine::MachineFile;
use jred_file::number::rounding::{percent, short};
use jred_file::units::Vocabulary;
use jred_motion::co_design::{CoDesign, DriveWithMotion};
use jred_sizing::catalogue::Drive;
use jred_sizing::cell::Cell;

use crate::answer::Answer;
use crate::list::kept::{self, KeptPart};
use crate::table::reading::Reading;

/// The motion that the drives are judged with, and the drives that were tried for it.
#[derive(Debug)]
pub struct MotionChoice {
    pub(crate) data: MotionData,
    sentences: Vec<String>,
    /// Parts of the file's motion that are kept, and those that are not, with names.
    kept: Vec<(&'static str, String)>,
    tried: Option<Reading>,
}

impl MotionChoice {
    /// The result of a search.
    pub fn new(file: &MachineFile, suited: &CoDesign) -> Self {
        let better = suited.better().is_some();
        Self {
            data: data(file, suited),
            sentences: sentences(suited),
            kept: if better {
                kept::all_lines(file, &suited.chain)
            } else {
                Vec::new()
            },
            tried: tried(suited),
        }
    }

    /// In words, without the table.
    pub fn words(&self) -> String {
        let kept = self.kept.iter();
        let kept = kept.map(|(name, says)| format!("  {name}: {says}"));
        let mut lines = self.sentences.clone();
        lines.splice(1..1, kept);
        lines.join("\n")
    }

    pub(super) fn blocks(&self, answer: &mut Answer) {
        answer.sentence(&self.sentences[0]);
        for (name, says) in &self.kept {
            answer.fact(*name, says);
        }
        for sentence in &self.sentences[1..] {
            answer.sentence(sentence);
        }
        if let Some(tried) = &self.tried {
            answer.table(tried.clone());
        }
    }
}

/// The motion of the list, the best drive before, and the drive that the list ranks first if it is another one.
fn sentences(suited: &CoDesign) -> Vec<String> {
    let Some(best) = suited.best() else {
        return vec!["Motion: that of the file; with its gentlest motion none of the closest drives is suitable".to_owned()];
    };
    if suited.better().is_none()
        && let Some((before, _)) = &suited.before
    {
        return stays(before, &best.drive).to_vec();
    }
    let torque = best.drive.motor.kind.vocabulary().torque;
    let mut sentences = vec![format!(
        "Motion: the gentlest for {}, with {} less RMS {torque} than the file's; `jred gentlest` writes it",
        named(&best.drive),
        percent(saving(best))
    )];
    sentences.push(match &suited.before {
        None => "With the motion of the file no drive is suitable".to_owned(),
        Some((before, _)) if before.name() == best.drive.name() => {
            "With the motion of the file the same drive is the best one".to_owned()
        }
        Some((before, _)) => format!(
            "With the motion of the file the best drive is {}",
            named(before)
        ),
    });
    sentences.extend(suited.ahead.as_ref().map(|ahead| {
        format!(
            "The list ranks {} first: with this motion it uses less of its limits than with its own gentlest one, which has the least RMS {torque} only",
            named(ahead)
        )
    }));
    sentences
}

/// Why the motion of the file is kept.
fn stays(before: &Drive, best: &Drive) -> [String; 2] {
    let why = if before.name() == best.name() {
        "With its own gentlest motion the same drive is suitable as well, but with a warning"
            .to_owned()
    } else {
        format!(
            "With a gentlest motion of its own no drive that was tried is as good, by its size and warnings; the first suitable one is {}",
            named(best)
        )
    };
    let kept = format!(
        "Motion: that of the file is kept, with which the best drive is {}",
        named(before)
    );
    [kept, why]
}

/// The motion that drives are judged with.
#[derive(Debug, Serialize, JsonSchema)]
pub struct MotionData {
    /// gentlest: the motion of least effort for a drive; file: the motion of the machine file, kept if no equally small drive is suitable with a
    /// motion of its own.
    from: &'static str,
    /// The drive that the motion is made for; null: the motion is that of the file.
    #[serde(rename = "made for")]
    made_for: Option<NamedDrive>,
    /// Reduction of the RMS torque as a share of that with the motion of the file.
    #[serde(rename = "saving of RMS torque")]
    saving: Option<f64>,
    /// The best drive with the motion of the file; null: no drive is suitable.
    #[serde(rename = "best with the file's motion")]
    before: Option<NamedDrive>,
    /// The best drive with a motion of its own; null: no tried drive is suitable.
    #[serde(rename = "best with a motion of its own")]
    own: Option<NamedDrive>,
    /// Parts of the file's motion that are kept.
    kept: Vec<KeptPart>,
    /// Parts and limits of the file's motion that are not kept.
    #[serde(rename = "not kept")]
    not_kept: Vec<String>,
}

#[derive(Debug, Serialize, JsonSchema)]
struct NamedDrive {
    /// Key of the motor.
    motor: String,
    /// Key of the gearbox.
    gearbox: Option<String>,
    /// Rated power.
    #[serde(rename = "rated power [W]")]
    power: Option<f64>,
}

impl From<&Drive<'_>> for NamedDrive {
    fn from(drive: &Drive) -> Self {
        Self {
            motor: drive.motor.key.clone(),
            gearbox: drive.gearbox.map(|gearbox| gearbox.key.clone()),
            power: drive.motor.rated_power(),
        }
    }
}

/// The motion as data.
fn data(file: &MachineFile, suited: &CoDesign) -> MotionData {
    let better = suited.better();
    let before = suited.before.as_ref();
    // With the motion of the file everything is kept.
    MotionData {
        from: if better.is_some() { "gentlest" } else { "file" },
        made_for: better.map(|tried| (&tried.drive).into()),
        saving: better.map(saving),
        before: before.map(|(before, _)| before.into()),
        own: suited.best().map(|tried| (&tried.drive).into()),
        kept: better.map_or_else(Vec::new, |_| kept::parts(file, &suited.chain)),
        not_kept: better.map_or_else(Vec::new, |_| kept::lost(file, &suited.chain)),
    }
}

/// The tried drives, each with its own motion, and the saving.
fn tried(suited: &CoDesign) -> Option<Reading> {
    let first = suited.tried.first()?;
    let words: &Vocabulary = first.drive.motor.kind.vocabulary();
    let heads = [
        "drive, each with its own motion".to_owned(),
        "rated power [W]".to_owned(),
        format!("RMS {}, file's motion", words.torque.label()),
        "its gentlest".to_owned(),
        "saving [%]".to_owned(),
        "rules".to_owned(),
    ];
    let row = |tried: &DriveWithMotion| -> Vec<Cell> {
        let rules = if tried.order.is_some() {
            "satisfied"
        } else {
            "violated"
        };
        vec![
            tried.drive.name().as_str().into(),
            tried.drive.motor.rated_power().into(),
            tried.own.rms.into(),
            tried.gentlest.rms.into(),
            (100.0 * saving(tried)).into(),
            rules.into(),
        ]
    };
    Some(Reading::new(heads, suited.tried.iter().map(row), 1))
}

fn saving(tried: &DriveWithMotion) -> f64 {
    (1.0 - tried.gentlest.rms / tried.own.rms).max(0.0)
}

fn named(drive: &Drive) -> String {
    let power = drive.motor.rated_power();
    let power = power.map_or_else(
        || "of unknown power".to_owned(),
        |power| format!("{} W", short(power)),
    );
    format!("{} ({power})", drive.name())
}
