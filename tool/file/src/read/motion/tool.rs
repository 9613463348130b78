//! `of` and `near` in `[motion]`: the tool coordinate whose motion is prescribed, and its range.

use std::convert::Infallible;
use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::motion::State;
use jred::machine::{Joint, Jointed as _, Machine, Mechanism as _};

use crate::keys::motion::SUCH_AS;
use crate::model::mechanism::{AnyMechanism, NamedLoad};
use crate::model::motion::{Measure, Motion, Reach, Standstill, ToolCoordinate};
use crate::number::numerics;
use crate::number::rounding::figure;
use crate::read::drive_link::DriveLink;
use crate::read::tool;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::text::value::Value;

/// Share of the tool's path that counts as its dead centre: the drive link's acceleration grows without bound towards it.
const AT_DEAD_CENTRE: f64 = 1e-8;

/// Share of a stroke that counts as rounding.
const ROUNDING: f64 = 1e-9;

/// The same for the curve through recorded rows, which overshoots a rest at the end of the stroke.
const OF_CURVE: f64 = 1e-7;

/// The coordinate whose motion is prescribed: the drive link's, or one of the tool.
pub(in crate::read) struct PrescribedCoordinate<'a> {
    /// Its kind and range: the tool coordinate's, if there is one.
    pub(in crate::read) axis: DriveLink,
    pub(in crate::read) drive: DriveLink,
    pub(in crate::read) tool: Option<ToolCoordinate>,
    pub(in crate::read) machine: &'a Machine<AnyMechanism>,
    /// The machine's loads with their names.
    pub(in crate::read) loads: &'a [NamedLoad],
}

impl<'a> PrescribedCoordinate<'a> {
    pub(super) fn read(
        section: &Section,
        drive: DriveLink,
        (machine, loads): (&'a Machine<AnyMechanism>, &'a [NamedLoad]),
    ) -> Result<Self> {
        let near = section.given("near")?;
        let Some(of) = section.get("of") else {
            if let Some(near) = near {
                return Err(near
                    .problem("is given without `of`", "not needed")
                    .help("`near` says on which branch a motion of the tool lies; the drive link's motion starts at `start`"));
            }
            return Ok(Self {
                axis: drive,
                drive,
                tool: None,
                machine,
                loads,
            });
        };
        let mechanism = machine.mechanism();
        let (measure, name) = measure(&of, mechanism)?;
        if let Some(near) = near.as_ref().filter(|near| !drive.reaches(near.si)) {
            let what = format!("is {}, outside the stroke, {}", near.shown(), drive.range());
            return Err(near
                .problem(&what, "out of reach")
                .help("give a position within the stroke"));
        }
        let place = near
            .as_ref()
            .map_or_else(|| drive.domain.position(0.0), |near| near.si);
        let made = ToolCoordinate::new(mechanism, measure, name.clone(), place);
        let tool = made.map_err(|standstill| {
            let problem = |what: &str| match &near {
                Some(near) => near.problem(what, "here"),
                None => of.problem(what, "`near` is not given"),
            };
            match standstill {
                Standstill::Everywhere => of
                    .problem(
                        &format!("is {name}, which does not change when the drive link moves"),
                        "stands",
                    )
                    .help("name the point, link or guide that does the machine's work"),
                Standstill::Here => problem(&format!(
                    "needs a place where the tool moves: at {}, {name} is at a dead centre, where it says nothing of the motion of the drive link",
                    drive.coordinate.place(place)
                ))
                .help("give near = \"…\", a position of the drive link between two dead centres of the tool, on the branch on which it works; `jred check` lists the dead centres"),
                Standstill::Unplaced(error) => problem(&format!("cannot be used: {error}")).help(error.cure().to_string()),
            }
        })?;
        let domain = tool
            .ends()
            .map_or(Domain::Turn, |[[_, from], [_, to]]| Domain::Stroke {
                from,
                to,
            });
        let axis = DriveLink {
            coordinate: tool.coordinate(),
            domain,
        };
        section.set_slides(axis.slides());
        Ok(Self {
            axis,
            drive,
            tool: Some(tool),
            machine,
            loads,
        })
    }

    /// Start of the motion, if the file does not give it.
    pub(in crate::read) fn start(&self) -> f64 {
        self.tool
            .as_ref()
            .map_or_else(|| self.axis.start(), ToolCoordinate::value_near)
    }

    /// Checks that the start is on the stroke, or on the tool's branch.
    pub(in crate::read) fn check_start(&self, start: &Value) -> Result<()> {
        if self.axis.reaches(start.si) {
            return Ok(());
        }
        let (shown, range) = (start.shown(), self.axis.range());
        Err(match &self.tool {
            None => start
                .problem(&format!("is {shown}, outside the stroke, {range}"), "out of reach")
                .help("start at a position within the stroke"),
            Some(tool) if self.has_no_dead_centre(tool) => start
                .problem(
                    &format!("is {shown}, but over the stroke {} goes from {range}", tool.name()),
                    "out of reach",
                )
                .help("start in this range, or change the stroke of the mechanism"),
            Some(tool) => start
                .problem(
                    &format!(
                        "is {shown}, but between two dead centres {} goes from {range}",
                        tool.name()
                    ),
                    "out of reach",
                )
                .help("start in this range, or give near = \"…\", a position of the drive link on another branch"),
        })
    }

    /// Whether the tool's path ends exactly where the drive link's stroke ends.
    fn has_no_dead_centre(&self, tool: &ToolCoordinate) -> bool {
        let (Domain::Stroke { from, to }, Some([[low, _], [high, _]])) =
            (self.drive.domain, tool.ends())
        else {
            return false;
        };
        let at_end = |phi: f64| (phi - from).abs().min((phi - to).abs()) <= ROUNDING * (to - from);
        at_end(low) && at_end(high)
    }

    /// Change of the coordinate over a turn of the drive link; `None` if its range is limited.
    pub(in crate::read) fn per_turn(&self) -> Option<f64> {
        match &self.tool {
            Some(tool) => tool.per_turn(),
            None => (self.axis.domain == Domain::Turn).then_some(TAU),
        }
    }

    /// Turns a motion of this coordinate into one of the machine.
    pub(in crate::read) fn of_tool(&self, motion: Motion) -> Motion {
        match &self.tool {
            Some(tool) => motion.of_tool(tool.clone()),
            None => motion,
        }
    }

    /// The drive link's state at this state of the coordinate.
    pub(in crate::read) fn drive_state(&self, state: State<f64>) -> State<f64> {
        match &self.tool {
            Some(tool) => tool.drive(state),
            None => state,
        }
    }

    /// Advance of the drive link while the coordinate advances by `way` from `start`.
    pub(in crate::read) fn advance(&self, start: f64, way: f64) -> f64 {
        let Some(tool) = &self.tool else {
            return way;
        };
        tool.drive_at(start + way) - tool.drive_at(start)
    }

    /// Checks that the tool stays on its branch. `problem` makes the error from the segment's index and the message.
    pub(in crate::read) fn check_reach(
        &self,
        motion: &Motion,
        problem: impl Fn(usize, &str) -> Problem,
    ) -> Result<()> {
        let Some((tool, ends)) = (self.tool.as_ref()).and_then(|tool| Some((tool, tool.ends()?)))
        else {
            return Ok(());
        };
        let mechanism = self.machine.mechanism();
        let way = ends[1][1] - ends[0][1];
        let is_stroke = |phi: f64| match mechanism.domain() {
            Domain::Turn => false,
            Domain::Stroke { from, to } => (phi - from).min(to - phi) <= ROUNDING * (to - from),
        };
        // Margin at each end of the tool's path.
        let [low, high] = ends.map(|[phi, _]| {
            if is_stroke(phi) {
                -OF_CURVE * way
            } else {
                AT_DEAD_CENTRE * way
            }
        });
        let within = |value: f64| (ends[0][1] + low..=ends[1][1] - high).contains(&value);
        let mut before = 0.0;
        let reaches = motion.reaches();
        for &Reach {
            segment,
            of_drive,
            t,
            position: value,
        } in &reaches
        {
            if of_drive {
                continue;
            }
            if within(value) {
                before = t;
                continue;
            }
            let still = |t: f64| Ok::<_, Infallible>(within(motion.prescribed(t).phi));
            let Ok(first) = numerics::edge(still, before, t);
            let [phi, end] = ends[usize::from(value > ends[0][1] + 0.5 * way)];
            let drive = mechanism.coordinate();
            let turned = match mechanism.domain() {
                // Just below a whole turn is its start.
                Domain::Turn if (phi / TAU - (phi / TAU).round()).abs() < ROUNDING => 0.0,
                Domain::Turn => phi.rem_euclid(TAU),
                Domain::Stroke { .. } => phi,
            };
            let (what, cure) = if is_stroke(phi) {
                ("the end of the drive link's stroke", "")
            } else {
                (
                    "its dead centre",
                    "; a full stroke, and whatever passes a dead centre, is a motion of the drive link: law = \"join\", or a motion without `of`",
                )
            };
            let [least, most] = ends.map(|[_, end]| self.axis.distance(end));
            let name = tool.name();
            let place = format!(
                "{}, {} = {}",
                drive.place(turned),
                tool.symbol(),
                self.axis.distance(end)
            );
            // Of several positions out of reach in a segment, the farthest is reported.
            let farthest = (reaches.iter())
                .filter(|reach| reach.segment == segment && !reach.of_drive)
                .map(|reach| reach.position)
                .filter(|position| (position - end) * (value - end) > 0.0)
                .max_by(|a, b| (a - end).abs().total_cmp(&(b - end).abs()))
                .unwrap_or(value);
            let beyond = (value - end).abs() > AT_DEAD_CENTRE * way;
            let message = if first <= 0.0 && !within(motion.prescribed(0.0).phi) {
                format!(
                    "starts with {name} at {what}, at {place}, where the drive link's motion does not follow from it"
                )
            } else if beyond {
                format!(
                    "leads {name} to {}: at t = {} s it reaches {what} at {place}, and no position of the drive link takes it further",
                    self.axis.distance(farthest),
                    figure(first),
                )
            } else {
                format!(
                    "leads {name} to {what}, at {place}, at t = {} s, where the drive link's motion does not follow from it",
                    figure(t),
                )
            };
            return Err(problem(segment, &message).help(format!(
                "keep {} between {least} and {most}{cure}",
                tool.name()
            )));
        }
        Ok(())
    }
}

/// The measure that `of` defines, and its name.
fn measure(of: &Item, mechanism: &AnyMechanism) -> Result<(Measure, String)> {
    let section = of.section("[motion.of]".into())?;
    let Some((key, item)) = section.one_of(&["point", "link", "slide"]) else {
        let problem = of.problem("names neither `point` nor `link` nor `slide`", "incomplete");
        return Err(problem.help(SUCH_AS));
    };
    let found = match key {
        "link" => {
            let link = item.choice(mechanism.link_names())?;
            let name = item.words_of_text()?;
            (Measure::Angle { link }, format!("angle of {name}"))
        }
        "slide" => {
            let joint = item.choice(mechanism.joint_names())?;
            let name = item.words_of_text()?;
            let start = mechanism.domain().position(0.0);
            let joints = mechanism
                .frames(start)
                .and_then(|frames| mechanism.joints(start, &frames));
            let slides =
                joints.is_ok_and(|joints| matches!(joints.get(joint), Some(Joint::Prismatic(_))));
            if !slides {
                return Err(item
                    .problem("is not a guide, so nothing slides in it", "this joint")
                    .help("name a joint of the kind guide: `jred check` lists the joints; for a link that turns write of = { link = \"…\" }"));
            }
            (Measure::Slide { joint }, format!("displacement in {name}"))
        }
        _ => {
            let (name, link, at) = tool::place(&section, &item, mechanism)?;
            let along = section.need("along")?;
            let measure = match along.word()? {
                2 => Measure::Path { link, at },
                axis => Measure::Position { link, at, axis },
            };
            let word = along.words_of_text()?;
            (measure, format!("{word} of {name}"))
        }
    };
    section.finish()?;
    Ok(found)
}
