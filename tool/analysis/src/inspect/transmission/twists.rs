//! Motion of a group's links for each of its free velocities.

use jred::machine::{Body, Frames, Joint, Marker};

/// Velocity [v_x, v_y] of the body's point at the global origin, and angular velocity.
type Twist = [f64; 3];

/// Motion of a group's links for each of its variables.
pub(super) struct Twists<'a> {
    pub(super) frames: &'a Frames,
    /// Twists of the group's links for each variable, once they are attached.
    of: Vec<Option<Vec<Twist>>>,
    members: &'a [usize],
    pub(super) variables: usize,
}

impl<'a> Twists<'a> {
    pub(super) fn new(frames: &'a Frames, members: &'a [usize]) -> Self {
        Self {
            frames,
            of: vec![None; frames.len()],
            members,
            variables: 0,
        }
    }

    fn is_placed(&self, body: Body) -> bool {
        body.link()
            .is_none_or(|k| !self.members.contains(&k) || self.of[k].is_some())
    }

    /// The joint that attaches the next link: one whose first or second body is placed, guides before pins, so that every variable is an angle of a
    /// link or a travel along a guide.
    pub(super) fn next_joint(
        &mut self,
        joints: &[Joint],
        drive: usize,
        left: &[usize],
    ) -> Option<usize> {
        let rank = |k: usize| match joints[k] {
            _ if k == drive => Some(0),
            Joint::Fixed(_) => Some(0),
            Joint::Prismatic(_) => Some(1),
            Joint::Revolute(_) => Some(2),
            Joint::PinInSlot(_) => Some(3),
            Joint::Transmission(_) => None,
        };
        let half_placed = |k: usize| {
            let [a, b] = joints[k].bodies();
            self.is_placed(a) != self.is_placed(b)
        };
        let ranked = left.iter().enumerate().filter(|(_, k)| half_placed(**k));
        let best = ranked
            .filter_map(|(place, &k)| Some((rank(k)?, place)))
            .min();
        if let Some((_, place)) = best {
            return Some(place);
        }
        // A link with contacts only moves freely: along x, along y, and about its origin.
        let loose = self.members.iter().find(|&&k| self.of[k].is_none());
        if let Some(&link) = loose {
            let frame = &self.frames[link];
            let (x, y) = (frame.x.value, frame.y.value);
            let mut twists = vec![[0.0; 3]; self.variables];
            twists.extend([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [y, -x, 1.0]]);
            self.variables += 3;
            self.of[link] = Some(twists);
            return self.next_joint(joints, drive, left);
        }
        None
    }

    /// The body's twist for one variable; placed bodies are at rest.
    pub(super) fn twist(&self, body: Body, variable: usize) -> Twist {
        let moving = body.link().and_then(|k| self.of[k].as_ref());
        moving
            .and_then(|twists| twists.get(variable).copied())
            .unwrap_or_default()
    }

    /// Velocity of the body's point `at` for one variable.
    pub(super) fn velocity(&self, body: Body, at: [f64; 2], variable: usize) -> [f64; 2] {
        let [x, y, turn] = self.twist(body, variable);
        [x - turn * at[1], y + turn * at[0]]
    }

    /// Attaches the joint's body that is not placed yet.
    pub(super) fn attach(&mut self, joint: &Joint, held: bool) {
        let bodies = joint.bodies();
        let (parent, child) = if self.is_placed(bodies[0]) {
            (bodies[0], bodies[1])
        } else {
            (bodies[1], bodies[0])
        };
        let Some(link) = child.link() else {
            return;
        };
        let carried = |turning: bool| -> Vec<Twist> {
            (0..self.variables)
                .map(|k| self.twist(parent, k))
                .map(|twist| {
                    let at = pivot(joint, self.frames);
                    let [x, y, turn] = twist;
                    if turning {
                        twist
                    } else {
                        [x - turn * at[1], y + turn * at[0], 0.0]
                    }
                })
                .collect()
        };
        let [x, y] = pivot(joint, self.frames);
        let turning = [y, -x, 1.0];
        let mut twists;
        match joint {
            _ if held => twists = carried(true),
            Joint::Fixed(_) | Joint::Transmission(_) => twists = carried(true),
            Joint::Prismatic([guide, _]) => {
                let [cos, sin] = direction(guide, self.frames);
                twists = carried(true);
                twists.push([cos, sin, 0.0]);
            }
            Joint::Revolute(_) => {
                twists = carried(false);
                twists.push(turning);
            }
            Joint::PinInSlot([_, slot]) => {
                let [cos, sin] = direction(slot, self.frames);
                twists = carried(false);
                twists.extend([turning, [cos, sin, 0.0]]);
            }
        }
        self.variables = twists.len().max(self.variables);
        self.of[link] = Some(twists);
    }
}

pub(super) fn position(marker: &Marker, frames: &Frames) -> [f64; 2] {
    marker.position(frames).map(|c| c.value)
}

pub(super) fn direction(marker: &Marker, frames: &Frames) -> [f64; 2] {
    marker.axis(frames).map(|c| c.value)
}

/// The point about which the bodies of the joint may turn.
pub(super) fn pivot(joint: &Joint, frames: &Frames) -> [f64; 2] {
    match joint {
        Joint::Revolute([a, _]) | Joint::PinInSlot([a, _]) => position(a, frames),
        Joint::Prismatic([_, b]) | Joint::Fixed([_, b]) => position(b, frames),
        Joint::Transmission([a, _]) => a.point,
    }
}
