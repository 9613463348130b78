//! Structure of a linkage: which equations determine which coordinates, and in which order.
//!
//! The links' coordinates x, y, ψ and as many equations, including the drive's, are split into groups that can be solved one after the other: the
//! Assur groups of the theory of mechanisms, and smaller ones for single coordinates. A group of k coordinates costs about k³ operations, a chain of
//! groups no more than their sum.

use crate::machine::error::MachineError;
use crate::machine::link::Frame;
use crate::mechanism::linkage::LinkageError;
use crate::number::transfer::Transfer;

use super::pair::Pair;

/// One equation: a component of a pair, or the drive's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Equation {
    /// Index of the pair.
    pub(super) pair: u8,
    /// Number of the pair's equation; `DRIVE` for the drive's.
    pub(super) component: u8,
}

impl Equation {
    /// The component that represents the drive's equation.
    pub(super) const DRIVE: u8 = u8::MAX;
}

/// A coordinate of a link: 0 = x, 1 = y, 2 = ψ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Coordinate {
    pub(super) link: u8,
    pub(super) axis: u8,
}

impl Coordinate {
    /// Whether it is in a set of bits 3·link + axis.
    #[inline]
    pub(super) const fn is_in(self, bits: u64) -> bool {
        bits >> (3 * self.link + self.axis) & 1 == 1
    }
}

/// The axis of the angle.
pub(super) const PSI: u8 = 2;

/// Equations and coordinates in the order of solving, split into groups.
#[derive(Clone, Debug)]
pub(super) struct Structure<const LINKS: usize> {
    equations: [[Equation; 3]; LINKS],
    coordinates: [[Coordinate; 3]; LINKS],
    /// For each equation, its coordinates.
    contents: [[u64; 3]; LINKS],
    groups: heapless::Vec<Group, MOST>,
}

/// Greatest number of coordinates: dependencies are bits of a word.
const MOST: usize = 64;

/// A run of equations that together determine as many coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Group {
    /// First place in the order.
    pub(super) start: u8,
    /// Number of equations.
    pub(super) size: u8,
    pub(super) method: Method,
}

/// Method of solution of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Method {
    /// The single equation is q + … = 0, or −q + … = 0 if `negative`: most coordinates of usual linkages.
    Explicit { negative: bool },
    /// Newton's first step is exact.
    Linear,
    /// Newton's method.
    Newton,
}

impl<const LINKS: usize> Structure<LINKS> {
    /// The structure of `links` links connected by `pairs`, with the drive in pair number `drive`.
    ///
    /// # Errors
    /// Not exactly one degree of freedom; a link left free while others are constrained twice.
    pub(super) fn new(
        links: usize,
        pairs: &[Pair],
        evaluate: impl Fn(Equation, &[Frame]) -> f64,
        drive: usize,
    ) -> Result<Self, LinkageError> {
        const { assert!(3 * LINKS <= MOST, "at most 21 links") }
        let constraints: usize = pairs.iter().map(Pair::constraints).sum();
        let count = 3 * links;
        if constraints + 1 != count {
            return Err(MachineError::Mobility { links, constraints }.into());
        }
        let mut equations = heapless::Vec::<Equation, MOST>::new();
        for (pair, taken) in pairs.iter().map(Pair::constraints).enumerate() {
            for component in 0..taken {
                let equation = Equation {
                    pair: pair as u8,
                    component: component as u8,
                };
                // Cannot fail: counted above.
                let _ = equations.push(equation);
            }
        }
        let _ = equations.push(Equation {
            pair: drive as u8,
            component: Equation::DRIVE,
        });

        let depends = dependencies::<LINKS>(links, &equations, &evaluate);
        let matched = matching(&depends, count).map_err(|(equation, coordinate)| {
            let joint = equations.get(equation).map_or(0, |e| e.pair.into());
            LinkageError::OverConstrained {
                joint,
                free: coordinate / 3,
            }
        })?;
        let reach = reachable(&depends, &matched, count);

        let mut order: heapless::Vec<usize, MOST> = (0..count).collect();
        order.sort_unstable_by_key(|&c| (reach[c].count_ones(), reach[c], c));
        let mut structure = Self {
            equations: [[Equation::default(); 3]; LINKS],
            coordinates: [[Coordinate::default(); 3]; LINKS],
            contents: [[0; 3]; LINKS],
            groups: heapless::Vec::new(),
        };
        let mut before = None;
        for (place, &c) in order.iter().enumerate() {
            let coordinate = Coordinate {
                link: (c / 3) as u8,
                axis: (c % 3) as u8,
            };
            let e = matched[c];
            if let (Some(slot), Some(equation)) = (
                structure.coordinates.as_flattened_mut().get_mut(place),
                equations.get(e),
            ) {
                *slot = coordinate;
                structure.equations.as_flattened_mut()[place] = *equation;
                structure.contents.as_flattened_mut()[place] = depends[e];
            }
            if before != Some(reach[c]) {
                let _ = structure.groups.push(Group {
                    start: place as u8,
                    size: 0,
                    method: Method::Linear,
                });
            }
            before = Some(reach[c]);
            if let Some(group) = structure.groups.last_mut() {
                group.size += 1;
                // Every equation is linear in x and y, and equations between angles only are linear in ψ, except for a cam's.
                let cam = equations.get(e).is_some_and(|equation| {
                    matches!(
                        pairs.get(usize::from(equation.pair)),
                        Some(Pair::Cam { .. })
                    )
                });
                if cam || (coordinate.axis == PSI && depends[e] & !ANGLES != 0) {
                    group.method = Method::Newton;
                }
            }
        }
        let mut groups = structure.groups.clone();
        for group in &mut groups {
            if let Some(negative) = structure.explicit(*group, &evaluate) {
                group.method = Method::Explicit { negative };
            }
        }
        Ok(Self {
            groups,
            ..structure
        })
    }

    /// Whether a group is an equation whose only coordinate has the factor 1 or, `Some(true)`, −1.
    fn explicit(&self, group: Group, evaluate: impl Fn(Equation, &[Frame]) -> f64) -> Option<bool> {
        let ([equation], [c]) = (self.equations(group), self.coordinates(group)) else {
            return None;
        };
        let factor = |sample| {
            let mut frames = sample_frames::<LINKS>(sample);
            frames[usize::from(c.link)].seed(c.axis, 1.0);
            evaluate(*equation, &frames)
        };
        let unit = |one: f64| (0..SAMPLES).all(|sample| factor(sample).to_bits() == one.to_bits());
        match (unit(1.0), unit(-1.0)) {
            (true, _) => Some(false),
            (_, true) => Some(true),
            _ => None,
        }
    }

    /// The equations that contain the angle of a link, and whether each contains only angles.
    pub(super) fn with_angle_of(&self, link: usize) -> impl Iterator<Item = (Equation, bool)> + '_ {
        let angle = 1_u64 << (3 * link + usize::from(PSI));
        let equations = self.equations.as_flattened().iter().copied();
        equations
            .zip(self.contents.as_flattened())
            .filter(move |(_, contents)| *contents & angle != 0)
            .map(|(equation, contents)| (equation, contents & !ANGLES == 0))
    }

    /// The groups, in the order of solving.
    pub(super) fn groups(&self) -> impl Iterator<Item = Group> + '_ {
        self.groups.iter().copied()
    }

    /// Number of entries of the Jacobians of all groups that have one.
    pub(super) fn entries(&self) -> usize {
        let explicit = |group: &Group| matches!(group.method, Method::Explicit { .. });
        let solved = self.groups().filter(|group| !explicit(group));
        solved.map(|group| usize::from(group.size).pow(2)).sum()
    }

    pub(super) fn equations(&self, group: Group) -> &[Equation] {
        let start = usize::from(group.start);
        &self.equations.as_flattened()[start..start + usize::from(group.size)]
    }

    /// For each equation of a group, its coordinates, as bits.
    pub(super) fn contents(&self, group: Group) -> &[u64] {
        let start = usize::from(group.start);
        &self.contents.as_flattened()[start..start + usize::from(group.size)]
    }

    pub(super) fn coordinates(&self, group: Group) -> &[Coordinate] {
        let start = usize::from(group.start);
        &self.coordinates.as_flattened()[start..start + usize::from(group.size)]
    }
}

/// The bits of all angles.
const ANGLES: u64 = 0x4924_9249_2492_4924;

/// Number of samples for the analysis of the structure.
const SAMPLES: usize = 2;

/// Links in generic poses.
fn sample_frames<const LINKS: usize>(sample: usize) -> [Frame; LINKS] {
    core::array::from_fn(|k| {
        // Spread by the golden ratio.
        let spread = (k + 1 + 7 * sample) as f64 * 0.618_033_988_749_895;
        let at = [0.3 + 0.17 * spread, 0.1 - 0.29 * spread].map(Transfer::constant);
        Frame::turned(at, Transfer::constant(spread))
    })
}

/// For each equation, its coordinates, as bits 3·link + axis.
fn dependencies<const LINKS: usize>(
    links: usize,
    equations: &[Equation],
    evaluate: impl Fn(Equation, &[Frame]) -> f64,
) -> [u64; MOST] {
    let mut depends = [0; MOST];
    for sample in 0..SAMPLES {
        let mut frames = sample_frames::<LINKS>(sample);
        for c in 0..3 * links {
            let (link, axis) = (c / 3, (c % 3) as u8);
            frames[link].seed(axis, 1.0);
            for (e, equation) in equations.iter().enumerate() {
                if evaluate(*equation, &frames) != 0.0 {
                    depends[e] |= 1 << c;
                }
            }
            frames[link].seed(axis, 0.0);
        }
    }
    depends
}

/// For each coordinate, the equation that determines it: a perfect matching by augmenting paths. Otherwise an unmatched equation and an unmatched
/// coordinate.
fn matching(depends: &[u64; MOST], count: usize) -> Result<[usize; MOST], (usize, usize)> {
    let mut matched = [usize::MAX; MOST];
    for equation in 0..count {
        let mut seen = 0;
        if !augment(equation, depends, &mut matched, &mut seen) {
            let free = matched.iter().take(count).position(|&e| e == usize::MAX);
            return Err((equation, free.unwrap_or(0)));
        }
    }
    Ok(matched)
}

/// Finds a coordinate for `equation`, reassigning other equations if necessary. Recurses at most `count` levels deep.
fn augment(
    equation: usize,
    depends: &[u64; MOST],
    matched: &mut [usize; MOST],
    seen: &mut u64,
) -> bool {
    let mut open = depends[equation];
    while open & !*seen != 0 {
        open &= !*seen;
        let c = open.trailing_zeros() as usize;
        *seen |= 1 << c;
        if matched[c] == usize::MAX || augment(matched[c], depends, matched, seen) {
            matched[c] = equation;
            return true;
        }
    }
    false
}

/// For each coordinate, all coordinates on which it depends, directly or indirectly, including itself.
fn reachable(depends: &[u64; MOST], matched: &[usize; MOST], count: usize) -> [u64; MOST] {
    let mut reach = [0; MOST];
    for c in 0..count {
        reach[c] = depends[matched[c]] | 1 << c;
    }
    for through in 0..count {
        for c in 0..count {
            if reach[c] & 1 << through != 0 {
                reach[c] |= reach[through];
            }
        }
    }
    reach
}
