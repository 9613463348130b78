//! What happened in a simulated motion, as JSON.

use jred_machine::analysis::simulate::{Effort, Rest, Stop};
use jred_machine::model::axis::Axis;
use jred_machine::units::RPM;
use jred_motion::driven::{Loads, Peak};
use serde_json::{Map, Value, json};

use super::Shown;

impl Shown<'_> {
    /// What happened on the way.
    pub(super) fn figures(&self) -> Map<String, Value> {
        let axis = self.machines.first.axis();
        let unit = axis.coordinate.unit();
        let (position, speed, way) = (
            format!("position [{unit}]"),
            format!("speed [{}]", axis.coordinate.speed_unit()),
            format!("way [{unit}]"),
        );
        let mut after = Map::new();
        let mut add = |key: &str, value: Value| after.insert(key.to_owned(), value);
        let by_motion = self.by_motion();
        if !by_motion.is_empty() {
            add("by_motion", json!(by_motion));
        }
        if let Some(impacts) = self.found.impacts {
            let first = json!({
                "time [s]": impacts.time,
                &position: axis.shown(impacts.position),
                speed: axis.rate(impacts.speed),
            });
            add("impacts", json!({ "count": impacts.count, "first": first }));
        }
        if self.simulation.halt.is_some() {
            let place = |rest: Rest| json!({ "time [s]": rest.time, way.as_str(): axis.shown_way(rest.way) });
            add("rest", json!(self.found.rest.map(place)));
            if let Some(first) = self.found.turned_back {
                add("turned_back", place(first));
            }
        }
        if let Some(stops) = self.stops {
            let stop = |stop: &Stop| {
                json!({
                    "time [s]": stop.time,
                    &position: axis.shown(stop.position),
                    "to rest [s]": stop.rest.map(|rest| rest.time),
                    way.as_str(): stop.rest.map(|rest| axis.shown_way(rest.way)),
                })
            };
            let all: Vec<Value> = stops.iter().map(stop).collect();
            add("stops_over_the_cycle", all.into());
        }
        if let Some(held) = self.found.held {
            let held = json!({ "time [s]": held.time, way.as_str(): axis.shown_way(held.way) });
            add("held", held);
        }
        if self.simulation.to_speed.is_some() {
            let reached = self.found.reached.map(
                |reached| json!({ "time [s]": reached.time, way.as_str(): axis.shown_way(reached.way) }),
            );
            add("reached", json!(reached));
        }
        if let Some(effort) = self.found.effort {
            add("motor", self.motor(&effort));
        }
        if let Some(stuck) = self.found.missing {
            let effort = self.effort_unit();
            add(
                "stops",
                json!({
                    "time [s]": stuck.time,
                    &position: axis.shown(stuck.missing.phi),
                    format!("given [{effort}]"): stuck.missing.given,
                    format!("needed [{effort}]"): stuck.missing.needed,
                }),
            );
        }
        if let Some(limit) = self.found.torque_limit {
            let first = json!({ "time [s]": limit.time, &position: axis.shown(limit.position) });
            add(
                "torque_limit",
                json!({ "count": limit.count, "duration [s]": limit.duration, "first": first }),
            );
        }
        if let Some(following) = self.found.following {
            add(
                "following_error",
                json!({
                    "time [s]": following.time,
                    &position: axis.shown(following.position),
                    format!("error [{unit}]"): axis.shown_way(following.error),
                }),
            );
        }
        if let Some((name, loads)) = self.drive {
            add("drive", self.drive_figures(&axis, name, loads));
        }
        if let Some(error) = &self.found.ended {
            add("ended", error.to_string().into());
        }
        after
    }

    /// What the motor gives.
    fn motor(&self, effort: &Effort) -> Value {
        let unit = self.effort_unit();
        let most = |[value, time]: [f64; 2], scale: f64, unit: &str| json!({ format!("largest [{unit}]"): value * scale, "time [s]": time });
        let (scale, speed) = if self.slides() {
            (1.0, "m/s")
        } else {
            (1.0 / RPM, "rpm")
        };
        json!({
            "effort": most(effort.torque, 1.0, unit),
            format!("RMS [{unit}]"): effort.rms,
            "power": most(effort.power, 1.0, "W"),
            "speed": most(effort.speed, scale, speed),
        })
    }

    /// What the drive bears.
    fn drive_figures(&self, axis: &Axis, name: &str, loads: &Loads) -> Value {
        let position = format!("position [{}]", axis.coordinate.unit());
        let peak = |peak: &Peak, scale: f64, unit: &str| {
            json!({
                "time [s]": peak.time,
                &position: axis.shown(peak.phi),
                format!("largest [{unit}]"): peak.value * scale,
                format!("allowed [{unit}]"): peak.allowed.map(|allowed| allowed * scale),
            })
        };
        let (scale, unit) = if self.slides() {
            (1.0, "m/s")
        } else {
            (1.0 / RPM, "rpm")
        };
        let mut drive = Map::new();
        drive.insert("name".into(), name.into());
        drive.insert("motor_speed".into(), peak(&loads.motor_speed, scale, unit));
        if let Some(torque) = &loads.gearbox_torque {
            drive.insert("gearbox_torque".into(), peak(torque, 1.0, "N m"));
        }
        if let Some(heat) = &loads.heat {
            let (scale, unit) = if heat.relative {
                (100.0, "% of the rated rise")
            } else {
                (1.0, "K")
            };
            drive.insert("rise".into(), peak(&heat.hottest, scale, unit));
        }
        drive.into()
    }
}
