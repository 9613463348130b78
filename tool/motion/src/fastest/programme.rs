//! The fastest motion where limits look at more than place, speed and acceleration: jerk, torque rate, and what the motor's heat costs.
//!
//! Two sweeps do not find it, because the accelerations that are left depend on the one before. The motion is written as w(u), the square
//! of the pace along a path ([`mesh`]); its time is a convex integral, and [`limits`] are looked at seven places of every piece. An
//! interior-point method ([`interior`]) finds where no motion nearby is faster. Pieces are halved where the limit that is met changes,
//! until the time is settled, and limits are kept a little below themselves until the motion, looked at with the machine itself, satisfies them.
//!
//! Without a limit of jerk and torque rate the motion of the sweeps is faster than any of these: it is the lower bound.

mod borders;
mod interior;
mod limits;
mod mesh;
mod outcome;

use crate::gentlest::mesh::dot;
use crate::gentlest::shape::Shape;
use crate::gentlest::{self};

use super::field::{Field, Limits};
use super::track::Ends;
use super::{Fastest, NoMotion};
use interior::{Point, minimise};
use limits::{Margins, Problem};
use mesh::{Border, Form, Mesh};

/// Pieces of the first mesh, and the most.
const PIECES: [usize; 2] = [24, 1500];

/// Rounds of finer pieces.
const ROUNDS: u32 = 14;

/// Change of the time, as a share, at which finer pieces gain nothing.
const SETTLED: f64 = 2e-9;

/// How often borders are moved to where the limit changes.
const MOVES: u32 = 3;

/// How often pieces longer than this are halved after that.
const HALVED: u32 = 3;
const LONGEST: f64 = 0.006;

/// Share of u of the ends along which the path is that of a constant jerk.
const RAMP: f64 = 0.25;

/// Shares of an even pace from which the motion is sought, by the fastest one without limits of rates.
const STARTS: [f64; 3] = [0.25, 0.05, 0.7];

/// μ of the first mesh, of those that follow, and of the last: what is left of the time is about ten times as much.
const ROUGH: [f64; 2] = [0.1, 1e-5];
const FINER: [f64; 2] = [1e-2, 1e-8];
const LAST: [f64; 2] = [1e-3, 1e-10];

/// Places closer than this share of u are one.
const APART: f64 = 1e-9;

/// Share by which a limit may be exceeded between the nodes of the motion, and how often margins are widened for it.
const WITHIN: f64 = 2e-7;
const WIDENED: u32 = 8;

/// What is asked.
pub(super) struct Asked<'a> {
    pub(super) field: &'a Field<'a, 'a>,
    pub(super) ends: &'a Ends,
    /// Time (s) of the fastest motion without limits of rates and without heat.
    pub(super) bound: f64,
    /// Seconds that a second with one N²·m² of the torque's square costs.
    pub(super) price: f64,
}

/// The motion on a mesh.
struct Found {
    mesh: Mesh,
    point: Point,
    time: f64,
}

/// A border between two pieces of a smooth machine.
const fn inner(u: f64) -> Border {
    Border {
        u,
        is_corner: false,
        stays: false,
        is_plain: false,
    }
}

impl Asked<'_> {
    /// The motion.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere, a load jumps under a limit of the torque rate, or no motion was found.
    pub(super) fn solve(&self) -> Result<Fastest, NoMotion> {
        self.refuse_jumps()?;
        let shape = Shape::new(self.form_of_ends());
        let mut borders = self.first_borders(&shape);
        let mut found = self.first(&shape, &borders)?;
        let mut change = f64::INFINITY;
        for _ in 0..ROUNDS {
            let finer = self.finer(&found);
            if finer.is_empty() || borders.len() + finer.len() > PIECES[1] {
                break;
            }
            borders.extend(finer);
            borders.sort_by(|a, b| a.u.total_cmp(&b.u));
            let Some(next) = self.next(&shape, &borders, &found, &[], FINER)? else {
                break;
            };
            change = (next.time - found.time).abs() / next.time;
            found = next;
            if change < SETTLED {
                break;
            }
        }
        for _ in 0..MOVES {
            let Some(moved) = self.moved(&borders, &found, &self.trace(&shape, &found)) else {
                break;
            };
            let Some(next) = self.next(&shape, &moved, &found, &[], FINER)? else {
                break;
            };
            change = (next.time - found.time).abs() / next.time;
            (found, borders) = (next, moved);
        }
        for _ in 0..HALVED {
            let longer = |piece: &[Border]| piece[1].u - piece[0].u > LONGEST;
            let finer = borders.windows(2).filter(|piece| longer(piece));
            let finer: Vec<Border> = finer
                .map(|piece| inner(piece[0].u.midpoint(piece[1].u)))
                .collect();
            let mut halved = borders.clone();
            halved.extend(finer);
            halved.sort_by(|a, b| a.u.total_cmp(&b.u));
            let Some(next) = self.next(&shape, &halved, &found, &[], FINER)? else {
                break;
            };
            change = (next.time - found.time).abs() / next.time;
            (found, borders) = (next, halved);
        }
        for (border, changes) in borders.iter_mut().zip(self.changes(&found)) {
            border.is_plain = changes[1];
        }
        let mut margins = vec![Margins::default(); borders.len() - 1];
        let mut trace = self.trace(&shape, &found);
        let mut excess = f64::INFINITY;
        for _ in 0..WIDENED {
            let Some(next) = self.next(&shape, &borders, &found, &margins, LAST)? else {
                break;
            };
            found = next;
            trace = self.trace(&shape, &found);
            excess = self.widen(&trace, &mut margins)?;
            if excess <= WITHIN {
                break;
            }
        }
        if excess > super::MOST_EXCESS {
            return Err(NoMotion::NotFound { bound: self.bound });
        }
        let time = trace.duration();
        Ok(Fastest {
            time,
            error: change.min(1.0) * time,
            phases: self.phases(&found, &trace),
            trace,
            excess,
            cells: found.mesh.elements.len(),
            bound: Some(self.bound),
        })
    }

    fn limits(&self) -> &Limits {
        &self.field.limits
    }

    fn form_of_ends(&self) -> gentlest::Ends {
        gentlest::Ends {
            rest: self.ends.speeds.map(|speed| speed == 0.0),
            ramp: if self.limits().level_ends { RAMP } else { 0.0 },
            ring: false,
        }
    }

    /// Start and length of the way with its sign.
    fn course(&self) -> [f64; 2] {
        [self.ends.from, self.ends.length * self.field.way.direction]
    }

    fn mesh(&self, shape: &Shape, borders: &[Border]) -> Result<Mesh, NoMotion> {
        let [start, distance] = self.course();
        let pace = |end: usize| {
            let [_, slope, ..] = shape.series(end as f64, end as f64);
            (self.ends.speeds[end] * self.bound / (distance.abs() * slope)).powi(2)
        };
        let rest = self.form_of_ends().rest;
        let form = Form {
            rest,
            pace: [0, 1].map(|end| if rest[end] { 0.0 } else { pace(end) }),
            level: self.limits().level_ends,
            smooth: self.limits().has_rates(),
        };
        Ok(Mesh::new(
            self.field.way,
            [start, distance],
            shape,
            form,
            borders,
        )?)
    }

    fn problem<'m>(&'m self, mesh: &'m Mesh, margins: &'m [Margins]) -> Problem<'m> {
        Problem {
            field: self.field,
            mesh,
            unit: self.bound,
            pace: self.ends.length / self.bound,
            price: self.price,
            margins,
        }
    }

    /// Equal pieces, cut where the path or the machine is not smooth.
    fn first_borders(&self, shape: &Shape) -> Vec<Border> {
        let [pieces, _] = PIECES;
        let border = |u: f64, stays: bool| Border { stays, ..inner(u) };
        let corners = self.ends.corners.iter();
        let mut borders: Vec<Border> = (0..=pieces)
            .map(|k| border(k as f64 / pieces as f64, false))
            .chain(shape.knots().map(|u| border(u, true)))
            .chain(corners.map(|x| Border {
                is_corner: true,
                ..border(shape.place(x / self.ends.length), true)
            }))
            .collect();
        borders.sort_by(|a, b| a.u.total_cmp(&b.u));
        borders.dedup_by(|b, a| {
            let same = b.u - a.u <= APART;
            a.is_corner |= same && b.is_corner;
            a.stays |= same && b.stays;
            same
        });
        borders
    }

    fn first(&self, shape: &Shape, borders: &[Border]) -> Result<Found, NoMotion> {
        let mesh = self.mesh(shape, borders)?;
        let margins = vec![Margins::default(); mesh.elements.len()];
        let problem = self.problem(&mesh, &margins);
        let found = STARTS
            .into_iter()
            .find_map(|pace| minimise(&problem, &mesh.even(pace * pace), ROUGH));
        let point = found.ok_or(NoMotion::NotFound { bound: self.bound })?;
        let time = self.time(&mesh, &point.x);
        Ok(Found { mesh, point, time })
    }

    /// From another mesh; without margins if none are given.
    fn next(
        &self,
        shape: &Shape,
        borders: &[Border],
        before: &Found,
        margins: &[Margins],
        barrier: [f64; 2],
    ) -> Result<Option<Found>, NoMotion> {
        let mesh = self.mesh(shape, borders)?;
        let start = mesh.refined(&before.mesh, &before.point.x);
        let none = vec![Margins::default(); mesh.elements.len()];
        let margins = if margins.is_empty() { &none } else { margins };
        let problem = self.problem(&mesh, margins);
        let Some(point) = minimise(&problem, &start, barrier) else {
            return Ok(None);
        };
        let time = self.time(&mesh, &point.x);
        Ok(Some(Found { mesh, point, time }))
    }

    /// The time (s).
    fn time(&self, mesh: &Mesh, x: &[f64]) -> f64 {
        let each = mesh.stations.iter().map(|station| {
            let values = mesh.values(x, station.element);
            station.weight / dot(&station.basis[0], &values).sqrt()
        });
        self.bound * each.sum::<f64>()
    }

    /// A load that jumps makes the torque jump, or the acceleration.
    fn refuse_jumps(&self) -> Result<(), NoMotion> {
        if self.limits().torque_rate.is_none() {
            return Ok(());
        }
        let way = self.field.way;
        let scale = self.field.motor_torques(0.0).map(f64::abs)[1];
        let near = self.ends.inside(1e-3 * self.ends.length);
        for x in &self.ends.corners {
            let place = |x: f64| way.place(self.ends.from + way.direction * x);
            let sides = [place(x - near)?, place(x + near)?];
            let speed = self.ends.length / self.bound;
            let [before, after] = sides.map(|place| way.demand(&place, speed, 0.0).torque);
            if (after - before).abs() > 1e-6 * scale {
                return Err(NoMotion::LoadJumps {
                    phi: self.ends.from + way.direction * x,
                    torques: [before, after],
                    axis: way.file.axis(),
                });
            }
        }
        Ok(())
    }
}
