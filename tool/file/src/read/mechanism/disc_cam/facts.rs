//! Properties of the shape of a cam that designers need.

use jred::mechanism::DiscCam;
use jred::mechanism::cam::Extreme;

use crate::model::coordinate::Coordinate;
use crate::number::rounding::short;

/// Labels and figures.
pub(super) fn of(cam: &DiscCam) -> Vec<[String; 2]> {
    let at = |extreme: &Extreme| Coordinate::Angle.place(extreme.phi);
    let [least, most] = cam.pressure_angles();
    let steepest = if least.value.abs() > most.value.abs() {
        least
    } else {
        most
    };
    let mut facts = vec![[
        "largest pressure angle".to_owned(),
        format!(
            "{} deg at {}",
            short(steepest.value.abs().to_degrees()),
            at(&steepest)
        ),
    ]];
    let [hollow, sharpest] = cam.curvatures();
    if sharpest.value > 0.0 {
        facts.push([
            "smallest radius of curvature of the profile".to_owned(),
            format!("{} mm at {}", short(1e3 / sharpest.value), at(&sharpest)),
        ]);
    }
    if hollow.value < 0.0 {
        facts.push([
            "smallest radius of the concave profile".to_owned(),
            format!(
                "{} mm at {}: cutter and grinding wheel must have a smaller radius",
                short(-1e3 / hollow.value),
                at(&hollow)
            ),
        ]);
    }
    facts
}
