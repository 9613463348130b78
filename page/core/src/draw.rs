//! A drawn linkage as a machine file.
//!
//! On the sheet a point of several bodies is a pin, a fixed point a bearing, and a guided point has a block on a guide.

use std::fmt::Write as _;

use jred::Domain;
use jred::machine::Mechanism as _;
use jred_analysis::checked;
use jred_analysis::inspect::Findings;
use jred_file::math;
use jred_file::model::coordinate::Coordinate;
use jred_file::problem;
use jred_file::text::problem::{Problem, Result};
use serde_json::json;

use crate::linkage::{Body, Frame, Guide, Linkage, Point};
use crate::request::Request;

/// Two points nearer than this (mm) are one.
const NEAR: f64 = 1e-3;

/// A text of the machine file.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars().filter(|letter| !letter.is_control()) {
        if matches!(letter, '"' | '\\') {
            quoted.push('\\');
        }
        quoted.push(letter);
    }
    quoted + "\""
}

/// A pair of lengths (mm).
fn lengths([u, v]: [f64; 2]) -> String {
    let [u, v] = [u, v].map(|length| (length * 1e4).round() / 1e4 + 0.0);
    format!("[\"{u} mm\", \"{v} mm\"]")
}

impl Guide {
    fn block(&self) -> String {
        self.body
            .clone()
            .unwrap_or_else(|| format!("block {}", self.point))
    }
}

impl Linkage {
    /// Refuses bodies without two points, or with both at one place.
    fn checked(&self, body: &Body) -> Result<Frame> {
        let frame = self.frame(body).ok_or_else(|| {
            problem!(
                help = "give it two joints, apart from each other",
                "link \"{}\" needs two joints",
                body.name
            )
        })?;
        match self.local(body).get(1) {
            Some((_, [u, _])) if *u >= NEAR => Ok(frame),
            _ => Err(problem!(
                help = "draw them apart",
                "the first two joints of link \"{}\" are at one place",
                body.name
            )),
        }
    }

    /// A point of the sheet in the frame of a body.
    fn on(&self, body: &Body, name: &str) -> Result<[f64; 2]> {
        let found = self.point(name);
        let point = found.ok_or_else(|| problem!("the drawing has no point \"{name}\""))?;
        Ok(self.checked(body)?.inside([point.x, point.y]))
    }

    /// The machine file; `stroke` is a line of its mechanism, `motion` its motion.
    fn text(&self, stroke: &str, motion: &str) -> Result<String> {
        let [gx, gy] = self.gravity.unwrap_or([0.0, -9.81]);
        let mut text = format!(
            "title = {}\ngravity = [\"{gx} m/s^2\", \"{gy} m/s^2\"]\n\n[mechanism]\ntype = \"linkage\"\ndrive = {}\n{stroke}",
            quoted(&self.title),
            quoted(&self.drive_joint()),
        );
        let fixed = self.points.iter().filter(|point| {
            let guide = self.guides.iter().find(|guide| guide.point == point.name);
            guide.map_or(point.ground, |guide| guide.on.is_none())
        });
        let fixed = fixed.map(|p| format!("{} = {}", quoted(&p.name), lengths([p.x, p.y])));
        let fixed: Vec<String> = fixed.collect();
        let _ = write!(text, "ground = {{ {} }}\n\n", fixed.join(", "));
        self.bodies_text(&mut text)?;
        self.joints_text(&mut text)?;
        self.loads_text(&mut text)?;
        Ok(text + motion)
    }

    fn bodies_text(&self, text: &mut String) -> Result<()> {
        for body in &self.bodies {
            let frame = self.checked(body)?;
            let mut points = Vec::new();
            for name in &body.points {
                points.push((name, self.on(body, name)?));
            }
            for guide in &self.guides {
                if guide.on.as_ref() == Some(&body.name) && !body.points.contains(&guide.point) {
                    points.push((&guide.point, self.on(body, &guide.point)?));
                }
            }
            let own = points.iter().take(body.points.len());
            let length = own.fold(0.0_f64, |most, (_, [u, v])| most.max(math::hypot(*u, *v)));
            let mass = body.mass.unwrap_or(0.0);
            let rod = mass * (length * 1e-3) * (length * 1e-3) / 12.0;
            let inertia = body.inertia.unwrap_or((rod * 1e9).round() / 1e9);
            let count = body.points.len() as f64;
            let middle = [0, 1].map(|k| {
                let own = points.iter().take(body.points.len());
                own.map(|(_, at)| at[k]).sum::<f64>() / count
            });
            let named = points
                .iter()
                .map(|(name, at)| format!("{} = {}", quoted(name), lengths(*at)));
            let _ = write!(
                text,
                "[[mechanism.body]]\nname = {}\nmass = \"{mass} kg\"\ninertia = \"{inertia} kg m^2\"\ncom = {}\nangle = \"{} deg\"\npoints = {{ {} }}\n\n",
                quoted(&body.name),
                lengths(body.com.unwrap_or(middle)),
                (frame.angle.to_degrees() * 1e3).round() / 1e3 + 0.0,
                named.collect::<Vec<_>>().join(", "),
            );
        }
        for guide in &self.guides {
            let _ = write!(
                text,
                "[[mechanism.body]]\nname = {}\nmass = \"{} kg\"\n",
                quoted(&guide.block()),
                guide.mass.unwrap_or(0.0)
            );
            text.push_str(if guide.on.is_some() {
                "inertia = \"0 kg m^2\"\n\n"
            } else {
                "\n"
            });
        }
        Ok(())
    }

    fn joints_text(&self, text: &mut String) -> Result<()> {
        for point in &self.points {
            let name = &point.name;
            let guide = self.guides.iter().find(|guide| guide.point == *name);
            let mut ends = Vec::new();
            match guide {
                Some(guide) => ends.push(quoted(&guide.block())),
                None if point.ground => ends.push(quoted(&format!("ground.{name}"))),
                None => {}
            }
            let bodies = self.bodies.iter().filter(|body| body.points.contains(name));
            ends.extend(bodies.map(|body| quoted(&format!("{}.{name}", body.name))));
            let kind = if point.ground && guide.is_none() {
                "bearing"
            } else {
                "pin"
            };
            let Some((first, others)) = ends.split_first() else {
                continue;
            };
            for (k, other) in others.iter().enumerate() {
                let number = if k == 0 {
                    String::new()
                } else {
                    format!(" {}", k + 1)
                };
                let _ = write!(
                    text,
                    "[[mechanism.joint]]\nname = {}\nbetween = [{first}, {other}]\n\n",
                    quoted(&format!("{kind} {name}{number}"))
                );
            }
        }
        for guide in &self.guides {
            let on = self
                .bodies
                .iter()
                .find(|body| Some(&body.name) == guide.on.as_ref());
            let turned = match on {
                Some(body) => guide.angle - self.checked(body)?.angle.to_degrees(),
                None => guide.angle,
            };
            let _ = write!(
                text,
                "[[mechanism.joint]]\nname = {}\ntype = \"prismatic\"\nbetween = [{}, {}]\ndirection = \"{} deg\"\n\n",
                quoted(&format!("guide {}", guide.point)),
                quoted(&format!(
                    "{}.{}",
                    guide.on.as_deref().unwrap_or("ground"),
                    guide.point
                )),
                quoted(&guide.block()),
                (turned * 1e6).round() / 1e6 + 0.0,
            );
        }
        Ok(())
    }

    fn loads_text(&self, text: &mut String) -> Result<()> {
        for load in &self.loads {
            let _ = write!(
                text,
                "[[load]]\nname = {}\non = {}\n",
                quoted(&load.name),
                quoted(&load.on)
            );
            if let Some(body) = self.bodies.iter().find(|body| body.name == load.on) {
                let at = self.on(body, &load.at)?;
                let _ = writeln!(text, "at = {}", lengths(at));
            }
            if let Some([x, y]) = load.force {
                let _ = writeln!(text, "force = [\"{x} N\", \"{y} N\"]");
            }
            if let Some(force) = load.opposing {
                let _ = writeln!(text, "opposing_force = \"{force} N\"");
            }
            text.push('\n');
        }
        Ok(())
    }

    fn drives_a_guide(&self) -> bool {
        self.guides.iter().any(|guide| guide.point == self.drive)
    }

    fn drive_joint(&self) -> String {
        let kind = if self.drives_a_guide() {
            "guide"
        } else {
            "bearing"
        };
        format!("{kind} {}", self.drive)
    }

    /// Degrees of freedom by Grübler's count; a pin of n bodies is n − 1 pins.
    fn freedoms(&self) -> i64 {
        let moving = self.bodies.len() + self.guides.len();
        let ends = |point: &Point| {
            let guided = self.guides.iter().any(|guide| guide.point == point.name);
            let bodies = self
                .bodies
                .iter()
                .filter(|body| body.points.contains(&point.name));
            bodies.count() + usize::from(guided || point.ground)
        };
        let pins: usize = self.points.iter().map(|p| ends(p).saturating_sub(1)).sum();
        3 * moving as i64 - 2 * pins as i64 - 2 * self.guides.len() as i64
    }

    /// A range of a sliding drive that is larger than the linkage.
    fn wide_stroke(&self) -> String {
        let far = self.points.iter().map(|p| math::hypot(p.x, p.y));
        let size = 2.0 * far.fold(1.0, f64::max).ceil();
        format!("stroke = [\"-{size} mm\", \"{size} mm\"]\n")
    }

    /// The motion: turning on and on, or between the ends of the stroke in the times that the speed takes on average.
    fn motion(&self, domain: Domain, coordinate: Coordinate) -> String {
        let speed = self.speed.filter(|speed| *speed > 0.0).unwrap_or(60.0);
        let Domain::Stroke { from, to } = domain else {
            return format!("[motion]\ntype = \"constant-speed\"\nspeed = \"{speed} rpm\"\n");
        };
        let unit = coordinate.unit();
        let [from, to] = [from, to].map(|end| (coordinate.shown(end) * 1e3).round() / 1e3);
        let mean = if unit == "deg" { 6.0 * speed } else { speed };
        let time = ((to - from) / mean * 1e6).round() / 1e6;
        let segment = |way: f64| {
            format!(
                "\n[[motion.segment]]\nlaw = \"polynomial-345\"\nmove = \"{way} {unit}\"\nduration = \"{time} s\"\n"
            )
        };
        let way = ((to - from) * 1e3).round() / 1e3;
        format!(
            "[motion]\ntype = \"cycle\"\nstart = \"{from} {unit}\"\n{}{}",
            segment(way),
            segment(-way)
        )
    }
}

/// Degrees of freedom, dead points and machine file of a drawn linkage.
pub(crate) fn draw(request: &Request) -> Result<String> {
    let drawn: Linkage = serde_json::from_value(request.field("linkage").clone())
        .map_err(|why| problem!("the drawing cannot be read: {why}"))?;
    let freedoms = drawn.freedoms();
    let answer = |obstacle: String, range: Option<[f64; 2]>, dead: Vec<String>, text: String| {
        json!({"freedoms": freedoms, "obstacle": obstacle, "range": range, "dead": dead, "text": text})
            .to_string()
    };
    let obstacle = |why: &Problem| {
        let cure = why.cure().map_or(String::new(), |cure| format!(". {cure}"));
        answer(format!("{why}{cure}"), None, Vec::new(), String::new())
    };
    if drawn.drive.is_empty() {
        let why =
            problem!("no joint is driven: choose a fixed joint that turns, or one that slides");
        return Ok(obstacle(&why));
    }
    let read = |text: &str| checked::parse("drawing.toml", text, request.files());
    let mut stroke = String::new();
    if drawn.drives_a_guide() {
        stroke = drawn.wide_stroke();
    }
    let mut dead = Vec::new();
    let text = drawn.text(&stroke, "");
    let file = match text.and_then(|text| read(&text)) {
        Ok(file) => file,
        Err(why) => {
            // The cure of a dead point proposes a line for the file.
            let Some(line) = why.cure().and_then(proposed_stroke) else {
                return Ok(obstacle(&why));
            };
            stroke = line;
            dead.push(why.to_string());
            match drawn.text(&stroke, "").and_then(|text| read(&text)) {
                Ok(file) => file,
                Err(why) => return Ok(obstacle(&why)),
            }
        }
    };
    let mechanism = file.machine.mechanism();
    let coordinate = mechanism.coordinate();
    let domain = mechanism.domain();
    let range = match domain {
        Domain::Stroke { from, to } => Some([from, to].map(|end| coordinate.shown(end))),
        _ => None,
    };
    for travel in Findings::of(&file).map_err(Problem::of)?.travels {
        for [at, _] in travel.dead_centres {
            dead.push(format!("{} at {}", travel.link, coordinate.place(at)));
        }
    }
    let text = drawn.text(&stroke, &drawn.motion(domain, coordinate))?;
    Ok(match read(&text) {
        Ok(_) => answer(String::new(), range, dead, text),
        Err(why) => obstacle(&why),
    })
}

/// The line `stroke = […]` of a cure.
fn proposed_stroke(cure: &str) -> Option<String> {
    let from = cure.find("stroke = [")?;
    let line = cure.get(from..)?;
    let to = line.find(']')?;
    Some(format!("{}\n", line.get(..=to)?))
}
