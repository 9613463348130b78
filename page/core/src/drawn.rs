//! The linkage of a machine file, as it is drawn.

use jred::machine::Mechanism as _;
use jred_file::math;
use jred_file::problem;
use jred_file::read;
use jred_file::text::problem::{Problem, Result};
use jred_file::units::kind::{
    ACCELERATION, ANGLE, ANGULAR_SPEED, FORCE, INERTIA, Kind, LENGTH, MASS,
};
use jred_file::units::quantity;
use serde_json::json;
use toml::{Table, Value};

use crate::linkage::{Body, Frame, Guide, Linkage, Load, Point};
use crate::request::Request;

/// Position as a share of the range, off dead centres.
const SHOWN: f64 = 0.125;

/// Points nearer than this are one (mm).
const NEAR: f64 = 1e-3;

/// Answers with the linkage.
pub(crate) fn linkage(request: &Request) -> Result<String> {
    let file = read::parse(&request.name(), request.source(), request.files())?.trusted();
    let text: Table = request.source().parse().unwrap_or_default();
    let mechanism = file.machine.mechanism();
    let table = text
        .get("mechanism")
        .and_then(Value::as_table)
        .filter(|table| word(table, "type") == "linkage");
    let table = table.ok_or_else(|| {
        problem!(
            help = "begin a linkage anew, or take a machine with type = \"linkage\"",
            "{} is no linkage of pins and guides that can be drawn by hand",
            file.title
        )
    })?;
    let phi = mechanism.domain().position(SHOWN);
    let poses = mechanism.frames(phi).map_err(Problem::of)?;
    let frames: Vec<(String, Frame)> = mechanism
        .link_names()
        .iter()
        .cloned()
        .zip(poses.iter().map(|pose| Frame {
            origin: [pose.x.value * 1e3, pose.y.value * 1e3],
            angle: pose.psi.value,
        }))
        .collect();
    let mut drawn = Drawn {
        table,
        frames,
        linkage: Linkage::default(),
    };
    drawn.linkage.title = file.title.clone();
    drawn.linkage.gravity = text
        .get("gravity")
        .and_then(|value| pair(value, &ACCELERATION));
    drawn.bodies();
    drawn.pins()?;
    drawn.guides()?;
    drawn.drive();
    let speed = text.get("motion").and_then(|motion| motion.get("speed"));
    drawn.linkage.speed = speed
        .and_then(|value| si(value, &ANGULAR_SPEED))
        .map(|speed| rounded(speed * 30.0 / std::f64::consts::PI));
    let given = list(&text, "load")
        .filter_map(Value::as_table)
        .collect::<Vec<_>>();
    for load in &given {
        match drawn.load(load) {
            Some(load) => drawn.linkage.loads.push(load),
            None => request.warn(format!(
                "the load {:?} cannot be drawn, and is left out",
                word(load, "name")
            )),
        }
    }
    for body in &drawn.linkage.bodies {
        if body.points.len() < 2 {
            return Err(problem!(
                "the body {:?} has only one point, and cannot be drawn",
                body.name
            ));
        }
    }
    drawn.centres();
    Ok(json!(drawn.linkage).to_string())
}

struct Drawn<'t> {
    table: &'t Table,
    frames: Vec<(String, Frame)>,
    linkage: Linkage,
}

impl Drawn<'_> {
    /// The frame of a body; `None`: the ground.
    fn frame(&self, body: &str) -> Option<Frame> {
        self.frames
            .iter()
            .find(|(name, _)| name == body)
            .map(|(_, frame)| *frame)
    }

    fn entry(&self, body: &str) -> Option<&Table> {
        let mut bodies = list(self.table, "body").filter_map(Value::as_table);
        bodies.find(|entry| word(entry, "name") == body)
    }

    /// The bodies that are no blocks of guides, with their named points.
    fn bodies(&mut self) {
        let blocks: Vec<String> = self
            .joints("prismatic")
            .map(|joint| split(&joint[1]).0.to_owned())
            .collect();
        for (name, frame) in self.frames.clone() {
            if blocks.contains(&name) {
                continue;
            }
            let entry = self.entry(&name).cloned().unwrap_or_default();
            let body = Body {
                name: name.clone(),
                mass: entry.get("mass").and_then(|value| si(value, &MASS)),
                inertia: entry.get("inertia").and_then(|value| si(value, &INERTIA)),
                com: Some(
                    entry
                        .get("com")
                        .and_then(|value| pair(value, &LENGTH))
                        .map_or([0.0; 2], |at| at.map(|x| x * 1e3)),
                ),
                ..Body::default()
            };
            self.linkage.bodies.push(body);
            let points = entry.get("points").and_then(Value::as_table);
            for (point, at) in points.into_iter().flatten() {
                if let Some(at) = pair(at, &LENGTH) {
                    let place = frame.outside(at.map(|x| x * 1e3));
                    self.point(point, place, Some(&name));
                }
            }
        }
    }

    /// The ends of the joints of a type.
    fn joints(&self, kind: &str) -> impl Iterator<Item = [String; 2]> {
        let joints = list(self.table, "joint").filter_map(Value::as_table);
        let of_kind = joints.filter(move |joint| match word(joint, "type") {
            "" => kind == "revolute",
            own => own == kind,
        });
        of_kind.map(ends)
    }

    /// Adds a point, or finds the one that is there, and puts it on a body.
    fn point(&mut self, name: &str, [x, y]: [f64; 2], body: Option<&str>) -> String {
        let near = |point: &&Point| math::hypot(point.x - x, point.y - y) < NEAR;
        let known = self
            .linkage
            .points
            .iter()
            .find(near)
            .map(|point| point.name.clone());
        let name = known.unwrap_or_else(|| {
            let taken = |name: &str| self.linkage.point(name).is_some();
            let mut others = (2..).map(|k| format!("{name}{k}"));
            let name = if taken(name) {
                others.find(|name| !taken(name))
            } else {
                None
            }
            .unwrap_or_else(|| name.to_owned());
            self.linkage.points.push(Point {
                name: name.clone(),
                x,
                y,
                ground: false,
            });
            name
        });
        let body = self
            .linkage
            .bodies
            .iter_mut()
            .find(|own| Some(own.name.as_str()) == body);
        if let Some(body) = body.filter(|body| !body.points.contains(&name)) {
            body.points.push(name.clone());
        }
        name
    }

    /// The place of an end of a joint, and its name.
    fn place(&self, end: &str) -> ([f64; 2], String) {
        let (body, point) = split(end);
        let points = match self.entry(body) {
            Some(entry) => entry.get("points"),
            None => self.table.get("ground"),
        };
        let at = points
            .and_then(|points| pair(points.get(point)?, &LENGTH))
            .unwrap_or_default();
        let at = at.map(|x| x * 1e3);
        let place = self.frame(body).map_or(at, |frame| frame.outside(at));
        (place, point.to_owned())
    }

    fn pins(&mut self) -> Result<()> {
        for joint in list(self.table, "joint").filter_map(Value::as_table) {
            let kind = word(joint, "type");
            if !["", "revolute", "prismatic"].contains(&kind) {
                return Err(problem!("a joint of type {kind:?} cannot be drawn by hand"));
            }
            if kind == "prismatic" {
                continue;
            }
            let ends = ends(joint);
            let names = ends.each_ref().map(|end| self.place(end).1);
            let name = names.into_iter().find(|name| !name.is_empty());
            let name = name.unwrap_or_else(|| word(joint, "name").to_owned());
            for end in &ends {
                let (body, _) = split(end);
                let (place, _) = self.place(end);
                let point = self.point(&name, place, Some(body));
                if body == "ground" {
                    let point = self.linkage.points.iter_mut().find(|own| own.name == point);
                    point.into_iter().for_each(|point| point.ground = true);
                }
            }
        }
        Ok(())
    }

    fn guides(&mut self) -> Result<()> {
        let guides = list(self.table, "joint").filter_map(Value::as_table);
        let guides: Vec<&Table> = guides
            .filter(|joint| word(joint, "type") == "prismatic")
            .collect();
        for joint in guides {
            let [first, second] = ends(joint);
            let (on, block) = (split(&first).0.to_owned(), split(&second).0.to_owned());
            let pinned = self
                .joints("revolute")
                .flatten()
                .find(|end| split(end).0 == block);
            let pinned = pinned.ok_or_else(|| {
                problem!("the body {block:?} of a guide has no pin, and cannot be drawn")
            })?;
            let (place, _) = self.place(&pinned);
            let turned = self.frame(&on).map_or(0.0, |frame| frame.angle);
            let direction = joint
                .get("direction")
                .and_then(|value| si(value, &ANGLE))
                .unwrap_or(0.0);
            let mass = self
                .entry(&block)
                .and_then(|entry| si(entry.get("mass")?, &MASS));
            let guide = Guide {
                point: self.point(&block, place, None),
                angle: rounded((direction + turned).to_degrees()),
                on: (on != "ground").then_some(on),
                body: Some(block),
                mass,
            };
            self.linkage.guides.push(guide);
        }
        Ok(())
    }

    /// The driven point: that of the joint with this name.
    fn drive(&mut self) {
        let wanted = word(self.table, "drive");
        let mut joints = list(self.table, "joint").filter_map(Value::as_table);
        let named =
            |joint: &&Table| word(joint, "name") == wanted || ends(joint).join(" to ") == wanted;
        if let Some(joint) = joints.find(named) {
            let [first, second] = ends(joint);
            let guided = self
                .linkage
                .guides
                .iter()
                .find(|guide| guide.body.as_deref() == Some(split(&second).0));
            let (place, _) = self.place(&first);
            self.linkage.drive = match guided.filter(|_| word(joint, "type") == "prismatic") {
                Some(guide) => guide.point.clone(),
                None => self.point("drive", place, None),
            };
        }
    }

    /// A load that consists of a force at a point or an opposing force.
    fn load(&mut self, load: &Table) -> Option<Load> {
        let plain = ["name", "on", "at", "force", "opposing_force"];
        let on = word(load, "on").to_owned();
        if !load.keys().all(|key| plain.contains(&key.as_str())) {
            return None;
        }
        let at = load
            .get("at")
            .and_then(|value| pair(value, &LENGTH))
            .map(|at| at.map(|x| x * 1e3));
        let guide = self
            .linkage
            .guides
            .iter()
            .find(|guide| guide.body.as_ref() == Some(&on));
        let at = match (guide, at) {
            (Some(guide), _) => guide.point.clone(),
            (None, at) => {
                let place = self.frame(&on)?.outside(at.unwrap_or_default());
                self.point("load", place, Some(&on))
            }
        };
        Some(Load {
            name: word(load, "name").to_owned(),
            on,
            at,
            force: load.get("force").and_then(|value| pair(value, &FORCE)),
            opposing: load
                .get("opposing_force")
                .and_then(|value| si(value, &FORCE)),
        })
    }

    /// Centres of mass in the frames of the drawing, which are those of the file where that is possible: a body's points begin with its origin and
    /// one on its u axis.
    fn centres(&mut self) {
        for k in 0..self.linkage.bodies.len() {
            let Some(own) = self.frame(&self.linkage.bodies[k].name) else {
                continue;
            };
            let mut points = std::mem::take(&mut self.linkage.bodies[k].points);
            let turned = |name: &String| {
                let point = self.linkage.point(name);
                let [u, v] = own.inside(point.map_or([0.0; 2], |point| [point.x, point.y]));
                let far = math::hypot(u, v) > NEAR;
                if far {
                    1.0 + math::atan2(v, u).abs()
                } else {
                    0.0
                }
            };
            points.sort_by(|a, b| turned(a).total_cmp(&turned(b)));
            self.linkage.bodies[k].points = points;
            let body = &self.linkage.bodies[k];
            let com = self.linkage.frame(body).zip(body.com);
            let com = com.map(|(new, at)| new.inside(own.outside(at)).map(rounded));
            self.linkage.bodies[k].com = com;
        }
        for point in &mut self.linkage.points {
            [point.x, point.y] = [point.x, point.y].map(rounded);
        }
    }
}

/// A number without the errors of rounding behind its millionths.
fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6 + 0.0
}

/// A body and its point: "crank.A".
fn split(end: &str) -> (&str, &str) {
    end.split_once('.').unwrap_or((end, ""))
}

fn ends(joint: &Table) -> [String; 2] {
    let mut ends = list(joint, "between").map(|end| end.as_str().unwrap_or_default().to_owned());
    [
        ends.next().unwrap_or_default(),
        ends.next().unwrap_or_default(),
    ]
}

fn list<'t>(table: &'t Table, key: &str) -> impl Iterator<Item = &'t Value> {
    table
        .get(key)
        .and_then(Value::as_array)
        .into_iter()
        .flatten()
}

fn word<'t>(table: &'t Table, key: &str) -> &'t str {
    table.get(key).and_then(Value::as_str).unwrap_or_default()
}

/// A quantity in SI units.
fn si(value: &Value, kind: &Kind) -> Option<f64> {
    quantity::read(value.as_str()?, kind)
        .ok()
        .map(|read| read.si)
}

fn pair(value: &Value, kind: &Kind) -> Option<[f64; 2]> {
    let list = value.as_array()?;
    Some([si(list.first()?, kind)?, si(list.get(1)?, kind)?])
}
