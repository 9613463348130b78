//! Named points, centres of mass and links as columns: positions, transfer functions, velocities and accelerations.

use jred::error::Error;
use jred::machine::motion::State;
use jred::machine::{Frames, Mechanism as _};
use jred::number::Transfer;
use jred_file::math;

use super::{RowPose, Set, Source};
use jred_file::model::mechanism::AnyMechanism;
use jred_file::number::columns::{Column, ColumnQuantity};

/// Every named point, every link's centre of mass (for links with a mass), and every link's angle.
pub(super) struct Points {
    /// Also velocities and accelerations in time.
    pub(super) in_time: bool,
}

/// The points: the named ones, then the centres of mass.
fn points(mechanism: &AnyMechanism) -> Vec<(String, usize, [f64; 2])> {
    let named = mechanism.points().iter();
    let named = named.map(|point| (point.name.clone(), point.link, point.at));
    let links = mechanism.link_names().iter().zip(mechanism.links());
    let centres = links
        .enumerate()
        .filter(|(_, (_, link))| link.mass() > 0.0)
        .map(|(k, (name, link))| (format!("{name} com"), k, link.com()));
    named.chain(centres).collect()
}

fn place_of(frames: &Frames, link: usize, at: [f64; 2]) -> [Transfer; 2] {
    frames
        .get(link)
        .map_or([Transfer::default(); 2], |frame| frame.point(at))
}

impl Set for Points {
    fn heads(&self, source: &Source) -> Vec<Column> {
        let per = source.coordinate.per();
        let ratio = source
            .coordinate
            .pick(["rad/rad", "rad/rad^2"], ["rad/m", "rad/m^2"]);
        let mechanism = source.machine.mechanism();
        let mut heads = Vec::new();
        for (name, ..) in points(mechanism) {
            let slope = format!("m/{per}");
            let bend = format!("m/{per}^2");
            let mut add =
                |quantity, symbol, unit| heads.push(Column::of(quantity, &name, symbol, unit));
            add(ColumnQuantity::Coordinate, "x", "m");
            add(ColumnQuantity::Coordinate, "y", "m");
            add(ColumnQuantity::XSlope, "x'", &slope);
            add(ColumnQuantity::YSlope, "y'", &slope);
            add(ColumnQuantity::Other, "x''", &bend);
            add(ColumnQuantity::Other, "y''", &bend);
            if self.in_time {
                add(ColumnQuantity::Other, "v_x", "m/s");
                add(ColumnQuantity::Other, "v_y", "m/s");
                add(ColumnQuantity::Speed, "v", "m/s");
                add(ColumnQuantity::Other, "a_x", "m/s^2");
                add(ColumnQuantity::Other, "a_y", "m/s^2");
                add(ColumnQuantity::Acceleration, "a", "m/s^2");
            }
        }
        for link in mechanism.link_names() {
            let mut add =
                |quantity, symbol, unit| heads.push(Column::of(quantity, link, symbol, unit));
            add(ColumnQuantity::Other, "psi", "deg");
            add(ColumnQuantity::AngleSlope, "psi'", ratio[0]);
            add(ColumnQuantity::Other, "psi''", ratio[1]);
            if self.in_time {
                add(ColumnQuantity::AngularSpeed, "omega", "rad/s");
                add(ColumnQuantity::AngularAcceleration, "alpha", "rad/s^2");
            }
        }
        heads
    }

    fn values(&self, source: &Source, place: &RowPose) -> Result<Vec<Option<f64>>, Error> {
        let mechanism = source.machine.mechanism();
        let mut values = Vec::new();
        for (_, link, at) in points(mechanism) {
            let point = place_of(&place.frames, link, at);
            values.extend(point.map(|c| Some(c.value)));
            values.extend(point.map(|c| Some(c.d1)));
            values.extend(point.map(|c| Some(c.d2)));
            if self.in_time {
                values.extend(with_size(place.state, |s| {
                    point.map(|c| c.velocity(s.omega))
                }));
                values.extend(with_size(place.state, |s| {
                    point.map(|c| c.acceleration(s.omega, s.alpha))
                }));
            }
        }
        for frame in place.frames.iter().take(mechanism.own_links()) {
            values.extend([frame.psi.value.to_degrees(), frame.psi.d1, frame.psi.d2].map(Some));
            if self.in_time {
                let state = place.state;
                values.push(state.map(|s| frame.psi.velocity(s.omega)));
                values.push(state.map(|s| frame.psi.acceleration(s.omega, s.alpha)));
            }
        }
        Ok(values)
    }
}

/// Both components and the magnitude of a vector that depends on the motion.
fn with_size(
    state: Option<State<f64>>,
    vector: impl Fn(State<f64>) -> [f64; 2],
) -> [Option<f64>; 3] {
    let Some([x, y]) = state.map(vector) else {
        return [None; 3];
    };
    [Some(x), Some(y), Some(math::hypot(x, y))]
}
