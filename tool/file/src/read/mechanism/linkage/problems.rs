//! Errors of the core about a linkage, in terms of the machine file.

use crate::math;
use jred::Domain;
use jred::machine::{Body, Frame, Joint, PoseError};
use jred::mechanism::linkage::{Linkage, LinkageError, Pair, Pose};
use jred::number::RangeError;

use crate::keys::linkage::MOST;
use crate::model::coordinate::Coordinate;
use crate::model::mechanism::ChangePoint;
use crate::number::rounding::figure;
use crate::read::mechanism::core;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

use super::bodies::Bodies;
use super::cam;
use super::joints::JointEntry;

/// An error nearer than this to the drawn position (rad or m) is an error of the drawing.
const DRAWING_TOLERANCE: f64 = 1e-6;

/// Data for messages.
pub(super) struct Context<'a> {
    pub(super) section: &'a Section<'a>,
    pub(super) bodies: &'a Bodies,
    pub(super) joints: &'a [JointEntry],
    pub(super) drive: usize,
    pub(super) coordinate: Coordinate,
    pub(super) poses: &'a [Pose],
    pub(super) frames: &'a [Frame],
    /// φ of the drawing (rad or m).
    pub(super) drawn_at: f64,
}

/// Refuses bodies without a joint, bodies not connected to the ground, and linkages with other than one degree of freedom.
pub(super) fn check_topology(
    section: &Section,
    bodies: &Bodies,
    joints: &[JointEntry],
) -> Result<()> {
    let count = bodies.moving.len();
    // One pass for each body finds all bodies connected to the ground.
    let mut held = vec![false; count];
    let mut used = vec![false; count];
    for _ in 0..=count {
        for joint in joints {
            let ends = joint.pair.bodies();
            let grounded = ends
                .iter()
                .any(|body| body.link().is_none_or(|link| held.get(link) == Some(&true)));
            for link in ends.iter().filter_map(|body| body.link()) {
                if let (Some(held), Some(used)) = (held.get_mut(link), used.get_mut(link)) {
                    *used = true;
                    *held |= grounded;
                }
            }
        }
    }
    for (k, body) in bodies.moving.iter().enumerate() {
        if !used.get(k).copied().unwrap_or_default() {
            return Err(
                Problem::new(format!("no joint connects body \"{}\"", body.name))
                    .at(body.place.clone(), "never used")
                    .help("remove it, or add the missing [[mechanism.joint]]"),
            );
        }
        if !held.get(k).copied().unwrap_or_default() {
            return Err(Problem::new(format!(
                "nothing connects body \"{}\" with the ground",
                body.name
            ))
            .at(body.place.clone(), "floats freely")
            .help("a chain of joints must lead from every body to the ground"));
        }
    }
    let taken: usize = joints.iter().map(|joint| joint.pair.constraints()).sum();
    let freedoms = 3 * count as i64 - taken as i64;
    if freedoms == 1 {
        return Ok(());
    }
    let each: Vec<String> = joints
        .iter()
        .map(|joint| format!("\"{}\" {}", joint.name, joint.pair.constraints()))
        .collect();
    let cure = if freedoms > 1 {
        "some body can still move independently: add a joint, or remove the body"
    } else {
        "some joints are redundant: remove one, or replace a pin by a pin-in-slot, which removes only 1 degree of freedom"
    };
    Err(section
        .problem(
            format!(
                "the linkage has {freedoms} degrees of freedom, not one: 3·{count} − {taken} = {freedoms}"
            ),
            "in this linkage",
        )
        .help(format!("{cure}. Degrees of freedom removed by each joint: {}", each.join(", "))))
}

impl Context<'_> {
    /// An error of the core in terms of the file. `kept`: the linkage was kept on its branch. If it was not, `flat` finds the change points that it
    /// would pass if it were.
    pub(super) fn problem(
        &self,
        error: LinkageError,
        kept: bool,
        flat: impl FnOnce() -> std::result::Result<Vec<ChangePoint>, LinkageError>,
    ) -> Problem {
        if let LinkageError::Pose(
            PoseError::DeadPoint { phi, joint } | PoseError::BranchChange { phi, joint },
        ) = error
        {
            if !kept
                && let Ok(flat) = flat()
                && !flat.is_empty()
            {
                return self.crossing(joint, &flat);
            }
            if (phi - self.drawn_at).abs() < DRAWING_TOLERANCE {
                return self.drawn_flat(phi, joint);
            }
        }
        match error {
            LinkageError::Pose(PoseError::CannotAssemble { phi, joint, gap }) => {
                self.open(phi, joint, gap)
            }
            LinkageError::Pose(PoseError::DeadPoint { phi, joint }) => self.dead(phi, joint),
            LinkageError::Pose(PoseError::BranchChange { phi, joint }) => self
                .at_joint(
                    joint,
                    &format!(
                        "is where the linkage can change to another branch, at {}",
                        self.place(phi)
                    ),
                    "extended or folded here",
                )
                .help(
                    "two bodies come into line there and may continue either way: change the lengths, or end the \
                     stroke before this position",
                ),
            LinkageError::NotClosed { link, gap } => self.not_closed(link, gap),
            LinkageError::Range(RangeError::OutOfRange {
                what: "drive position of the drawing",
                value,
                min,
                max,
            }) => self.far_from_stroke(value, [min, max]),
            LinkageError::OverConstrained { joint, free } => self.held_twice(joint, free),
            _ => core(self.section, error),
        }
    }

    /// Branches cross, and the file does not say which one the linkage follows.
    fn crossing(&self, joint: usize, flat: &[ChangePoint]) -> Problem {
        let places: Vec<String> = flat.iter().map(|point| self.place(point.at)).collect();
        self.at_joint(
            joint,
            &format!(
                "is in line at {}, a change point: the linkage can go on in two ways",
                places.join(" and ")
            ),
            "extended or folded there",
        )
        .help(
            "if something guides it through (a second crank, teeth, another coupler), write keep_branch = true in [mechanism]: it then \
             stays on the branch on which it is drawn; or end the stroke before this position",
        )
    }

    /// A drawing at a dead point or a change point does not define a branch.
    fn drawn_flat(&self, phi: f64, joint: usize) -> Problem {
        self.at_joint(
            joint,
            &format!(
                "locks in the drawing itself, at {}: bodies lie in one line there",
                self.place(phi)
            ),
            "locks here",
        )
        .help(
            "draw the linkage in another position: give `drawn_at`, and each body its angle there; the drawing names the branch",
        )
    }

    /// `keep_branch` without a change point in the drive's range.
    pub(super) fn never_flat(&self, keep: &Item) -> Problem {
        Problem::new(format!(
            "{}: there is no change point to pass: no two branches of the linkage cross in the drive's range",
            self.section.title()
        ))
        .at(keep.span(), "nothing to keep like this")
        .help("leave `keep_branch` out: the linkage stays on the branch on which it is drawn")
    }

    fn place(&self, phi: f64) -> String {
        self.coordinate.place(phi)
    }

    fn at_joint(&self, joint: usize, message: &str, label: &str) -> Problem {
        match self.joints.get(joint) {
            Some(joint) => Problem::new(format!("joint \"{}\" {message}", joint.name))
                .at(joint.place.clone(), label),
            None => self.section.problem(message, label),
        }
    }

    /// A joint that cannot close.
    fn open(&self, phi: f64, joint: usize, gap: f64) -> Problem {
        let Some(held) = self.joints.get(joint) else {
            return core(self.section, PoseError::CannotAssemble { phi, joint, gap });
        };
        let size = match held.kind {
            "prismatic" | "fixed" | "cam" => {
                format!("{} mm, or mrad of an angle", figure(gap * 1e3))
            }
            _ => format!("{} mm", figure(gap * 1e3)),
        };
        let [a, b] = held.pair.bodies().map(|body| self.bodies.name(body));
        self.at_joint(
            joint,
            &format!(
                "cannot be closed: the linkage cannot be assembled at {}, a gap of {size} remains at this joint",
                self.place(phi)
            ),
            "stays open",
        )
        .help(format!(
            "check the angles of {a} and {b} in the drawing, and whether their points can coincide{}",
            self.widest_gap()
        ))
    }

    /// The largest gap in the drawing.
    fn widest_gap(&self) -> String {
        let gap = |held: &JointEntry| match held.pair {
            Pair::Joint(Joint::Revolute([a, b])) => {
                let (a, b) = (a.position(self.frames), b.position(self.frames));
                math::hypot(b[0].value - a[0].value, b[1].value - a[1].value)
            }
            _ => 0.0,
        };
        let widest = self
            .joints
            .iter()
            .map(|held| (gap(held), &held.name))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        match widest {
            Some((gap, name)) if gap > 0.0 => format!(
                "; the largest gap in the drawing is {} mm, at \"{name}\"",
                figure(gap * 1e3)
            ),
            _ => String::new(),
        }
    }

    /// The number of equations is right, but some constraints are redundant.
    fn held_twice(&self, joint: usize, free: usize) -> Problem {
        let free = self.bodies.name(Body::Link(free));
        let what = if joint == self.drive {
            "is driven, but the other joints leave it no degree of freedom"
        } else {
            "constrains bodies that other joints already constrain"
        };
        self.at_joint(
            joint,
            &format!("{what}, while {free} can still move"),
            "redundant",
        )
        .help(format!(
            "remove one of the joints between the bodies of this loop, and add one that constrains {free}"
        ))
    }

    /// A dead point that limits the drive's range.
    fn dead(&self, phi: f64, joint: usize) -> Problem {
        let drive = self.joints.get(self.drive).map_or("", |j| j.name.as_str());
        let problem = self.at_joint(
            joint,
            &format!(
                "locks: the drive \"{drive}\" reaches a dead point at {}",
                self.place(phi)
            ),
            "locks here",
        );
        let Some([from, to]) = self.reach() else {
            return problem.help(
                "the drawing itself is at a dead point, or two joints impose the same constraint: check its angles, or \
                 draw it in another position",
            );
        };
        let unit = self.coordinate.unit();
        let shown = |position: f64| (self.coordinate.shown(position) * 1e2).round() / 1e2 + 0.0;
        problem.help(format!(
            "from the drawn position the drive can move from {} {unit} to {} {unit}: give a stroke within this range, \
             such as stroke = [\"{} {unit}\", \"{} {unit}\"], or change the lengths",
            shown(from),
            shown(to),
            figure(shown(from + 0.1 * (to - from)).round()),
            figure(shown(to - 0.1 * (to - from)).round()),
        ))
    }

    /// The drawing is outside the drive's range extended by its length at both ends; the core reports that extended range.
    fn far_from_stroke(&self, drawn: f64, [min, max]: [f64; 2]) -> Problem {
        let length = (max - min) / 3.0;
        let unit = self.coordinate.unit();
        let shown = |position: f64| {
            let rounded = (self.coordinate.shown(position) * 1e2).round() / 1e2 + 0.0;
            format!("{rounded} {unit}")
        };
        let message = format!(
            "the drawing shows the drive at {}, far from its range from {} to {}",
            shown(drawn),
            shown(min + length),
            shown(max - length)
        );
        let place = self.section.peek("stroke");
        let place = place.map_or_else(|| self.section.header(), |item| item.span());
        Problem::new(message).at(place, "this range").help(
            "draw the linkage within this range or not farther from it than its length, or change the stroke",
        )
    }

    /// Range of the drive on both sides of the drawn position.
    fn reach(&self) -> Option<[f64; 2]> {
        let drawn = self.drawn_at;
        let mut ends = [0.0; 2];
        for (end, way) in ends.iter_mut().zip([-1.0, 1.0]) {
            let far = drawn + way * self.search();
            let domain = Domain::stroke(drawn.min(far), drawn.max(far)).ok()?;
            let linkage = self.linkage().ok()?;
            // Followed from the drawing to the far end; the error gives the position where it stops.
            *end = match linkage.assemble::<2>(domain, drawn, self.poses) {
                Ok(_) => far,
                Err(LinkageError::Pose(
                    PoseError::DeadPoint { phi, .. } | PoseError::BranchChange { phi, .. },
                )) => phi,
                Err(_) => return None,
            };
        }
        let [from, to] = ends;
        (to - from > 1e-6 * self.search()).then_some(ends)
    }

    /// Distance over which to search for the end: a turn, or several times the size of the linkage.
    fn search(&self) -> f64 {
        match self.coordinate {
            Coordinate::Angle => std::f64::consts::TAU,
            Coordinate::Length => {
                let points = self.joints.iter().flat_map(|j| j.pair.markers());
                let far = points
                    .flat_map(|m| m.at)
                    .fold(0.0_f64, |most, c| most.max(c.abs()));
                4.0 * far.max(1e-3)
            }
        }
    }

    /// The linkage with its topology checked.
    pub(super) fn linkage(&self) -> std::result::Result<LargestLinkage, LinkageError> {
        let links: Vec<_> = self.bodies.moving.iter().map(|body| body.link).collect();
        let pairs: Vec<_> = self.joints.iter().map(|joint| joint.pair).collect();
        Linkage::with_cams(&links, &pairs, &cam::placed(self.joints), self.drive)
    }

    fn not_closed(&self, link: usize, gap: f64) -> Problem {
        let message = format!(
            "the linkage does not repeat: after a turn of the drive link, body {} is {} mm from where it was (a \
             rotation counts as an arc at the size of the linkage)",
            self.bodies.name(Body::Link(link)),
            figure(gap * 1e3)
        );
        let problem = match self.bodies.moving.get(link) {
            Some(body) => Problem::new(message).at(body.place.clone(), "not back in place"),
            None => self.section.problem(message, "in this linkage"),
        };
        problem.help(
            "with gears, a linkage may repeat only after several turns: give a `stroke` over all of them, or drive the \
             slowest shaft",
        )
    }
}

/// Room for the largest linkage.
type LargestLinkage = Linkage<{ MOST[0] }, { MOST[1] }, { cam::MOST }>;
