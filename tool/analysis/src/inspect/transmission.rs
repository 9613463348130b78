//! The transmission index, a measure of the distance from a dead point.
//!
//! With its drive held, a mechanism is a rigid structure of *Assur groups*: smallest sets of links that are held by the links before them. For each
//! group, consider its free velocities one after another: each link's angular velocity and each displacement along a guide. Each opens the remaining
//! joints of the group at certain rates, which form a column vector. The index is
//!
//! ```text
//! q = |det A| / Π ‖a_k‖        0 ≤ q ≤ 1 (Hadamard)
//! ```
//!
//! that is, the volume spanned by the columns divided by that of the box with the same edges; the smallest q of all groups counts. It does not depend
//! on the size of the machine.
//!
//! Two links between three pins have a₁ and a₂ = the links turned by 90°: q = |sin μ| with the transmission angle μ between coupler and rocker (Alt
//! 1932). A rod and a slider have q = |cos| of the rod's angle to the guide. Velocities that some of the joints determine alone form a separate
//! block, as a roller's rotation beside its follower's travel. A block of one velocity that a contact or a slot determines is measured by the angle
//! between the two: q = cos of the pressure angle. q = 0 is the dead point: the forces in the group grow as 1/q. For groups of more than two links q
//! is a stricter figure than the smallest angle between any two.

use jred::machine::{Body, Frames, Joint, Joints};

mod closure;
mod twists;

use closure::{Closure, System};
use twists::Twists;

/// Links that are held together by the links before them.
#[derive(Clone, Debug)]
struct Group {
    /// Indices of the links.
    links: Vec<usize>,
    /// Indices of the joints that hold them.
    joints: Vec<usize>,
    /// Which closing joints determine which of its variables, in the order of solution.
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

/// The decomposition of a mechanism.
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
    /// Index of the group of links.
    pub(super) group: usize,
    /// Whether the sign indicates the branch: a contact may push from either side.
    pub(super) bilateral: bool,
}

impl Structure {
    /// Decomposes a mechanism with these `joints` at one position. `samples` are its joints, frames and size at several positions, so that a
    /// coefficient that vanishes at one position is still found.
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

/// The smallest sets of closing joints that determine as many variables as they close, in order.
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
        // A closing joint that no variable opens: the block is at a dead point everywhere.
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

/// The Assur groups of a mechanism with held drive, in the order of placement.
fn groups(joints: &[Joint], drive: usize, links: usize) -> Vec<Group> {
    // With the drive held, its joint is rigid.
    let taken = |k: usize| {
        joints
            .get(k)
            .map_or(0, |joint| if k == drive { 3 } else { joint.constraints() })
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
        // Joints that do not determine the links are refused when a mechanism is built; then all are one group.
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
    /// Rates at which each variable opens the remaining joints, at one position.
    fn system(&self, joints: &[Joint], drive: usize, frames: &Frames, length: f64) -> System {
        let mut motion = Twists::new(frames, &self.links);
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
