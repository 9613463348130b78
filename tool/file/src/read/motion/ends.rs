//! Speed, acceleration and jerk at the ends of a segment, as far as the file gives them.

use crate::text::item::Item;
use crate::text::key::JERKS;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::text::value::Value;

/// The ends of a segment; values that are not given come from its neighbours.
#[derive(Default)]
pub(super) struct Ends {
    pub(super) speeds: [Option<Value>; 2],
    pub(super) accelerations: [Option<f64>; 2],
    /// For polynomials of sixth and seventh degree.
    pub(super) jerks: [Option<f64>; 2],
}

impl Ends {
    /// Speeds only.
    pub(super) fn speeds(section: &Section) -> Result<Self> {
        let speeds = [section.given("start_speed")?, section.given("end_speed")?];
        Ok(Self {
            speeds,
            ..Self::default()
        })
    }

    /// Values for the polynomial `name`: of sixth degree it has the jerk at one end, of seventh at both.
    pub(super) fn of_polynomial(section: &Section, law: &Item, name: &str) -> Result<Self> {
        let mut ends = Self::speeds(section)?;
        ends.accelerations = [
            section.maybe("start_acceleration")?,
            section.maybe("end_acceleration")?,
        ];
        if name == "polynomial-5" {
            return Ok(ends);
        }
        ends.jerks = [section.maybe("start_jerk")?, section.maybe("end_jerk")?];
        if name == "polynomial-7" {
            // A jerk that is not given is zero.
            ends.jerks = ends.jerks.map(|jerk| jerk.or(Some(0.0)));
        } else if ends.jerks.iter().flatten().count() != 1 {
            let zero = format!("0 {}", JERKS[usize::from(section.slides())].unit);
            return Err(law
                .problem("needs the jerk at one of its ends", "six conditions and one more")
                .help(format!(
                    "write start_jerk = \"{zero}\" or end_jerk = \"{zero}\"; for both write law = \"polynomial-7\", for none \"polynomial-5\""
                )));
        }
        Ok(ends)
    }
}
