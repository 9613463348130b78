//! How well the mechanism transmits: the transmission index, and with it the distance from a dead point.
//!
//! With its drive held, a mechanism is a rigid structure of *Assur groups*: smallest sets of links that are held by the links
//! before them. For each group take the velocities that it is free to have, one after another: each link's angular velocity
//! and each displacement along a guide. Each opens the joints of the group that are left; the column that says how fast is a
//! vector. The index is
//!
//! ```text
//! q = |det A| / Π ‖a_k‖        0 ≤ q ≤ 1 (Hadamard)
//! ```
//!
//! the volume that the columns span by that of the box with the same edges, and the smallest q of all groups counts. It does
//! not depend on the size of the machine. Two links between three pins have a₁ = the one link, a₂ = the other, each turned by
//! 90°: q = |sin μ| with the transmission angle μ between coupler and rocker (Alt 1932). A rod and a slider have q = |cos| of the
//! rod's angle to the guide. Velocities that a part of the joints determines alone are a block of their own, as a roller's
//! turning is beside its follower's way; a block of one velocity that a contact or a slot determines has the angle between the
//! two as its only measure: q = cos of the pressure angle. q = 0 is the dead point: the forces in the group grow as 1/q. For
//! groups of more than two links q is a stricter figure than the smallest angle between any two.

use jred::joint::Joints;
use jred::mechanism::Frames;
use jred::{Body, Joint, Marker, Wrench};

/// Velocity [v_x, v_y] of the body's point at the global origin, and angular velocity.
type Twist = [f64; 3];

/// Links that are held together by the links before them.
#[derive(Clone, Debug)]
struct Group {
    /// Indices of the links.
    links: Vec<usize>,
    /// Indices of the joints that hold them.
    joints: Vec<usize>,
    /// Which of its variables which of its closing joints determine, in the order in which they can be solved.
    blocks: Vec<Block>,
}

/// Variables that some closing joints determine.
#[derive(Clone, Debug)]
struct Block {
    closures: Vec<usize>,
    variables: Vec<usize>,
    /// Whether no contact or mesh is among the joints.
    bilateral: bool,
}

/// A mechanism taken apart.
#[derive(Clone, Debug)]
pub(super) struct Structure {
    drive: usize,
    groups: Vec<Group>,
}

/// The index of one block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Index {
    /// q with the determinant's sign.
    pub(super) value: f64,
    /// Which group of links.
    pub(super) group: usize,
    /// Whether the sign tells the branch: a contact may push from either side.
    pub(super) bilateral: bool,
}

impl Structure {
    /// Takes a mechanism apart that has the `joints` at one position; `samples` are its joints, frames and size at several,
    /// so that a coefficient which vanishes in one position only counts as one.
    pub(super) fn new(
        joints: &[Joint],
        drive: usize,
        links: usize,
        samples: &[(Joints, Frames, f64)],
    ) -> Self {
        let mut groups = groups(joints, drive, links);
        for group in &mut groups {
            let systems: Vec<System> = samples
                .iter()
                .map(|(joints, frames, length)| group.system(joints, drive, frames, *length))
                .collect();
            group.blocks = blocks(&systems);
        }
        Self { drive, groups }
    }

    /// The indices of all blocks at one position; `length` (m) is the size of the mechanism.
    pub(super) fn indices(&self, joints: &[Joint], frames: &Frames, length: f64) -> Vec<Index> {
        let groups = self.groups.iter().enumerate();
        groups
            .flat_map(|(k, group)| {
                let system = group.system(joints, self.drive, frames, length);
                let index = move |block: &Block| Index {
                    value: system.index(block),
                    group: k,
                    bilateral: block.bilateral,
                };
                group.blocks.iter().map(index).collect::<Vec<_>>()
            })
            .collect()
    }

    /// The links of a group.
    pub(super) fn links(&self, group: usize) -> &[usize] {
        self.groups.get(group).map_or(&[], |group| &group.links)
    }
}

/// The smallest sets of closing joints that determine as many variables as they close, one after another.
fn blocks(systems: &[System]) -> Vec<Block> {
    let Some(first) = systems.first() else {
        return Vec::new();
    };
    let closures = first.closures.len();
    let touches = |closure: usize, variable: usize| {
        systems.iter().any(|system| {
            let closure = &system.closures[closure];
            let most = closure.full.iter().copied().fold(0.0, f64::max).sqrt();
            let mut rows = closure.rows.iter();
            rows.any(|row| row[variable].abs() > 1e-9 * most)
        })
    };
    let mut solved = vec![false; first.variables];
    let mut used = vec![false; closures];
    let mut blocks = Vec::new();
    loop {
        let open: Vec<usize> = (0..closures).filter(|&k| !used[k]).collect();
        if open.is_empty() {
            return blocks;
        }
        let found = subsets(&open).into_iter().find_map(|set| {
            let rows: usize = set.iter().map(|&k| first.closures[k].rows.len()).sum();
            let variables: Vec<usize> = (0..first.variables)
                .filter(|&v| !solved[v] && set.iter().any(|&k| touches(k, v)))
                .collect();
            (variables.len() == rows).then_some((set, variables))
        });
        // A closing joint that nothing opens: the block is at a dead point everywhere.
        let (set, variables) = found.unwrap_or_else(|| {
            let rest = (0..first.variables).filter(|&v| !solved[v]).collect();
            (open.clone(), rest)
        });
        for &k in &set {
            used[k] = true;
        }
        for &v in &variables {
            solved[v] = true;
        }
        blocks.push(Block {
            bilateral: !set.iter().any(|&k| first.closures[k].contact),
            closures: set,
            variables,
        });
    }
}

/// Every set of the given numbers, small sets first.
fn subsets(of: &[usize]) -> Vec<Vec<usize>> {
    let mut masks: Vec<u32> = (1..1u32 << of.len().min(20)).collect();
    masks.sort_by_key(|mask| mask.count_ones());
    let chosen = |mask: u32| {
        let bits = of.iter().enumerate();
        let set = bits.filter(|(bit, _)| mask >> bit & 1 == 1);
        set.map(|(_, &k)| k).collect()
    };
    masks.into_iter().map(chosen).collect()
}

/// The Assur groups of a mechanism whose drive is held, in the order in which they can be placed.
fn groups(joints: &[Joint], drive: usize, links: usize) -> Vec<Group> {
    // Held, the drive's joint is rigid.
    let taken = |k: usize| {
        joints.get(k).map_or(
            0,
            |joint| {
                if k == drive { 3 } else { joint.constraints() }
            },
        )
    };
    let mut known = vec![false; links];
    let mut groups = Vec::new();
    loop {
        let unknown: Vec<usize> = (0..links).filter(|&k| !known[k]).collect();
        if unknown.is_empty() {
            return groups;
        }
        let holding = |set: &[usize]| -> Vec<usize> {
            let inside = |body: &Body| body.link().is_some_and(|k| set.contains(&k));
            let placed = |body: &Body| body.link().is_none_or(|k| known[k] || set.contains(&k));
            let holds = |joint: &Joint| {
                let bodies = joint.bodies();
                bodies.iter().any(inside) && bodies.iter().all(placed)
            };
            (0..joints.len()).filter(|&k| holds(&joints[k])).collect()
        };
        let found = subsets(&unknown).into_iter().find_map(|set| {
            let joints = holding(&set);
            let constraints: usize = joints.iter().map(|&k| taken(k)).sum();
            (constraints == 3 * set.len()).then_some((set, joints))
        });
        // Joints that do not determine the links are refused when a mechanism is built: then all are one group.
        let (set, joints) = found.unwrap_or_else(|| (unknown.clone(), holding(&unknown)));
        for &link in &set {
            known[link] = true;
        }
        groups.push(Group {
            links: set,
            joints,
            blocks: Vec::new(),
        });
    }
}

impl Group {
    /// How fast each variable opens the joints that are left, at one position.
    fn system(&self, joints: &[Joint], drive: usize, frames: &Frames, length: f64) -> System {
        let mut motion = Motion::new(frames, &self.links);
        let mut left = self.joints.clone();
        while let Some(place) = motion.next_joint(joints, drive, &left) {
            let k = left.remove(place);
            motion.attach(&joints[k], k == drive);
        }
        let closures = left
            .iter()
            .map(|&k| Closure::new(&joints[k], k == drive, &motion, length));
        System {
            variables: motion.variables,
            closures: closures.collect(),
        }
    }
}

/// How the links of a group move with each of its variables.
struct Motion<'a> {
    frames: &'a Frames,
    /// For links of the group: their twist for each variable, once they are attached.
    twists: Vec<Option<Vec<Twist>>>,
    members: &'a [usize],
    variables: usize,
}

impl<'a> Motion<'a> {
    fn new(frames: &'a Frames, members: &'a [usize]) -> Self {
        Self {
            frames,
            twists: vec![None; frames.len()],
            members,
            variables: 0,
        }
    }

    fn is_placed(&self, body: Body) -> bool {
        body.link()
            .is_none_or(|k| !self.members.contains(&k) || self.twists[k].is_some())
    }

    /// The joint to attach the next link by: one whose first or second body is placed, guides before pins, so that every
    /// variable is an angle of a link or a way along a guide.
    fn next_joint(&mut self, joints: &[Joint], drive: usize, left: &[usize]) -> Option<usize> {
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
        // A link that only contacts hold moves freely: along x, along y, and about its origin.
        let loose = self.members.iter().find(|&&k| self.twists[k].is_none());
        if let Some(&link) = loose {
            let frame = &self.frames[link];
            let (x, y) = (frame.x.value, frame.y.value);
            let mut twists = vec![[0.0; 3]; self.variables];
            twists.extend([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [y, -x, 1.0]]);
            self.variables += 3;
            self.twists[link] = Some(twists);
            return self.next_joint(joints, drive, left);
        }
        None
    }

    /// The body's twist for one variable; placed bodies stand still.
    fn twist(&self, body: Body, variable: usize) -> Twist {
        let moving = body.link().and_then(|k| self.twists[k].as_ref());
        moving
            .and_then(|twists| twists.get(variable).copied())
            .unwrap_or_default()
    }

    /// Velocity of the body's point `at` for one variable.
    fn velocity(&self, body: Body, at: [f64; 2], variable: usize) -> [f64; 2] {
        let [x, y, turn] = self.twist(body, variable);
        [x - turn * at[1], y + turn * at[0]]
    }

    /// Attaches the body of the joint that is not placed yet.
    fn attach(&mut self, joint: &Joint, held: bool) {
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
        self.twists[link] = Some(twists);
    }
}

fn position(marker: &Marker, frames: &Frames) -> [f64; 2] {
    marker.position(frames).map(|c| c.value)
}

fn direction(marker: &Marker, frames: &Frames) -> [f64; 2] {
    marker.axis(frames).map(|c| c.value)
}

/// The point about which the joint lets its bodies turn.
fn pivot(joint: &Joint, frames: &Frames) -> [f64; 2] {
    match joint {
        Joint::Revolute([a, _]) | Joint::PinInSlot([a, _]) => position(a, frames),
        Joint::Prismatic([_, b]) | Joint::Fixed([_, b]) => position(b, frames),
        Joint::Transmission([a, _]) => a.point,
    }
}

/// How fast each variable opens the joints that are left.
struct System {
    variables: usize,
    closures: Vec<Closure>,
}

/// One joint that is left.
struct Closure {
    /// For each of its constraints how fast each variable opens it.
    rows: Vec<Vec<f64>>,
    /// Squares of the speeds with which each variable moves its bodies against each other, before what the joint lets pass is
    /// taken away.
    full: Vec<f64>,
    contact: bool,
}

impl Closure {
    fn new(joint: &Joint, held: bool, motion: &Motion, length: f64) -> Self {
        let variables = 0..motion.variables;
        let [first, second] = joint.bodies();
        let at = pivot(joint, motion.frames);
        let gap = |k: usize| {
            let (a, b) = (motion.velocity(first, at, k), motion.velocity(second, at, k));
            let turn = motion.twist(second, k)[2] - motion.twist(first, k)[2];
            [b[0] - a[0], b[1] - a[1], turn * length]
        };
        let across = |marker: &Marker| {
            let [cos, sin] = direction(marker, motion.frames);
            [-sin, cos, 0.0]
        };
        let (x, y, turn) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        let (kept, opens): (Vec<[f64; 3]>, [f64; 3]) = match joint {
            _ if held => (vec![x, y, turn], [1.0; 3]),
            Joint::Fixed(_) => (vec![x, y, turn], [1.0; 3]),
            Joint::Revolute(_) => (vec![x, y], [1.0, 1.0, 0.0]),
            Joint::Prismatic([guide, _]) => (vec![across(guide), turn], [1.0; 3]),
            Joint::PinInSlot([_, slot]) => (vec![across(slot)], [1.0, 1.0, 0.0]),
            Joint::Transmission(wrenches) => return Self::transmission(wrenches, motion),
        };
        let row = |part: &[f64; 3]| {
            let value = |k| gap(k).iter().zip(part).map(|(g, p)| g * p).sum();
            variables.clone().map(value).collect()
        };
        let square = |k: usize| gap(k).iter().zip(opens).map(|(g, o)| g * g * o).sum();
        Self {
            rows: kept.iter().map(row).collect(),
            full: variables.clone().map(square).collect(),
            contact: false,
        }
    }

    /// The power of one unit of the transmission's effort.
    fn transmission(wrenches: &[Wrench; 2], motion: &Motion) -> Self {
        let (mut row, mut full) = (Vec::new(), Vec::new());
        for k in 0..motion.variables {
            let (mut power, mut most) = (0.0, 0.0);
            for wrench in wrenches {
                let v = motion.velocity(wrench.body, wrench.point, k);
                let turn = motion.twist(wrench.body, k)[2];
                let [f_x, f_y] = wrench.force;
                power += f_x * v[0] + f_y * v[1] + wrench.moment * turn;
                most += f_x.hypot(f_y) * v[0].hypot(v[1]) + (wrench.moment * turn).abs();
            }
            row.push(power);
            full.push(most * most);
        }
        Self {
            rows: vec![row],
            full,
            contact: true,
        }
    }
}

impl System {
    fn index(&self, block: &Block) -> f64 {
        let closures = || block.closures.iter().map(|&k| &self.closures[k]);
        let alone = block.variables.len() == 1;
        let size = |v: usize| -> f64 {
            let square = closures().map(|closure| {
                let rows = closure.rows.iter().map(|row| row[v] * row[v]);
                if alone { closure.full[v] } else { rows.sum() }
            });
            square.sum::<f64>().sqrt()
        };
        // Columns of length one: the determinant is the ratio.
        let sizes: Vec<f64> = block.variables.iter().map(|&v| size(v)).collect();
        let scaled = |row: &Vec<f64>| -> Vec<f64> {
            let cells = block.variables.iter().zip(&sizes);
            let cell = |(&v, size): (&usize, &f64)| if *size > 0.0 { row[v] / size } else { 0.0 };
            cells.map(cell).collect()
        };
        let rows: Vec<Vec<f64>> = closures().flat_map(|c| c.rows.iter().map(scaled)).collect();
        if rows.len() == block.variables.len() {
            determinant(rows)
        } else {
            0.0
        }
    }
}

/// By Gaussian elimination with row pivoting.
fn determinant(mut rows: Vec<Vec<f64>>) -> f64 {
    let mut product = 1.0;
    for k in 0..rows.len() {
        let size = |row: &Vec<f64>| row[k].abs();
        let rest = rows.iter().enumerate().skip(k);
        let best = rest.max_by(|a, b| size(a.1).total_cmp(&size(b.1)));
        let pivot = best.map_or(k, |(row, _)| row);
        if pivot != k {
            rows.swap(pivot, k);
            product = -product;
        }
        let (done, below) = rows.split_at_mut(k + 1);
        let Some(row) = done.last() else {
            return 0.0;
        };
        if row[k] == 0.0 {
            return 0.0;
        }
        product *= row[k];
        for other in below {
            let factor = other[k] / row[k];
            for (value, top) in other.iter_mut().zip(row).skip(k) {
                *value -= factor * top;
            }
        }
    }
    product
}
