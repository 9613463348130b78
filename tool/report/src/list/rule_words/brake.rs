//! The holding brake.

use std::fmt::Write as _;

use jred_file::number::rounding::short;
use jred_file::units::DEGREE;
use jred_sizing::judge::Grounds;
use jred_sizing::judge::check::Check;

pub(super) fn of_torque(check: &Check) -> (String, String) {
    let torque = check.words.torque;
    let rating = if check.finding.rating.is_nan() {
        "holding brake of the motor, without which the machine moves when it is switched off"
            .to_owned()
    } else {
        format!("brake {torque}")
    };
    let place = if matches!(check.grounds, Grounds::SelfLocking) {
        "the gearbox is self-locking and holds by itself".to_owned()
    } else {
        format!("{torque} at standstill without the help of friction")
    };
    (rating, place)
}

pub(super) fn of_work(check: &Check) -> (String, String) {
    let finding = check.finding;
    let uncounted = matches!(
        check.grounds,
        Grounds::BrakeStop {
            per_hour: None,
            stops: Some(_),
            ..
        }
    );
    let rating = match (finding.value.is_nan(), finding.rating.is_nan()) {
        (false, false) => "work of the brake in one emergency stop",
        (false, true) if uncounted => {
            "work that the brake bears in one emergency stop and stops per hour, brake_work and brake_stops in the catalogue"
        }
        (true, false) => "closing time of the brake, brake_closing_time in the catalogue",
        (false, true) => {
            "work that the brake bears in one emergency stop, brake_work in the catalogue"
        }
        (true, true) => {
            "closing time of the brake and its work in one emergency stop, brake_closing_time and brake_work in the catalogue"
        }
    };
    (rating.to_owned(), run_on(check))
}

/// Distance that the machine continues to run when the supply fails.
fn run_on(check: &Check) -> String {
    let Grounds::BrakeStop {
        ways,
        slides,
        tool,
        dynamic,
        per_hour,
        stops,
    } = &check.grounds
    else {
        return String::new();
    };
    let (unit, scale) = if *slides {
        ("mm", 1e-3)
    } else {
        ("deg", DEGREE)
    };
    let [closed, stopped] = ways.map(|way| {
        let way = way / scale;
        if way.is_finite() {
            format!("{} {unit}", short(way))
        } else {
            "without end".to_owned()
        }
    });
    let of = tool.as_deref().unwrap_or("the drive link");
    let mut place = format!(
        "if the supply fails, {of} runs on by at most {closed} until the brake closes and {stopped} until it stops"
    );
    if tool.is_none() {
        place.push_str("; [tool] names a point whose way is stated instead");
    }
    if !dynamic {
        let torque = check.words.torque;
        let _ = write!(
            place,
            "; brake_dynamic_{torque} not given, using the static {torque}"
        );
    }
    if let Some(most) = per_hour {
        let _ = write!(
            place,
            "; the brake bears {} such stops per hour",
            short(*most)
        );
        if let Some(stops) = stops {
            let _ = write!(place, ", the machine has {}", short(*stops));
        }
    }
    place
}
