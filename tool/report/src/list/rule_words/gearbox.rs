//! The gearbox.

use jred_file::model::rule::Rule;
use jred_file::number::rounding::short;
use jred_sizing::judge::Grounds;
use jred_sizing::judge::check::Check;

pub(super) fn words(check: &Check) -> (String, String) {
    let rating = match check.id {
        Rule::GearboxPeak => "acceleration torque T2B",
        Rule::GearboxCubicMean => "rated torque T2N",
        Rule::GearboxEmergency => "emergency torque",
        Rule::GearboxMeanSpeed => "rated input speed n1N",
        Rule::GearboxSpeed => "maximum input speed",
        _ => {
            "number up to which T2B is valid; above it, T2B is reduced by the maker's shock factor"
        }
    };
    let (mut rating, mut place) = (rating.to_owned(), String::new());
    match check.grounds {
        Grounds::ShockFactor { factor, cycles } => {
            rating = format!(
                "{rating} reduced by the maker's shock factor of {} for {} cycles per hour",
                short(factor),
                short(cycles)
            );
        }
        Grounds::RollerBearing => "mean with the exponent 10/3".clone_into(&mut place),
        Grounds::SelfLocking => {
            "the gearbox is self-locking: its stiffness decides".clone_into(&mut rating);
        }
        Grounds::EmergencyAt(inertia) => {
            place = format!(
                "if the motor brakes with its peak torque where the machine has {} kg m^2 at the gearbox",
                short(inertia)
            );
        }
        Grounds::ShockFactors => {
            "number up to which the maker gives shock factors".clone_into(&mut rating);
        }
        _ => {}
    }
    (rating, place)
}
