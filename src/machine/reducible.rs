//! The source of a table: anything that can be reduced to one link, and whether it repeats every turn.

use core::f64::consts::TAU;

use crate::machine::error::PoseError;
use crate::machine::load::Load;
use crate::machine::mechanism::Mechanism;
use crate::machine::reduction::{Machine, Reduction};
use crate::{Domain, math};

/// Anything that can be reduced to one link: the source of tables.
pub trait Reducible {
    /// Range of the drive link.
    fn domain(&self) -> Domain;

    /// The reduced link at the drive link's position `phi` (rad, or m for a sliding link).
    ///
    /// # Errors
    /// The mechanism cannot be placed there, or the reduced inertia is not positive.
    fn reduction(&self, phi: f64) -> Result<Reduction, PoseError>;

    /// The `k`-th of the positions (rad, or m), in order, between which the curves are smooth: the edges of loads and [those of the
    /// mechanism](Mechanism::edge). A search for the largest error of a table checks at and between them
    /// ([`edge_places`](crate::tabulate::edge_places)), so that it finds every load, however narrow. The default has no such positions.
    fn edge(&self, _k: usize) -> Option<f64> {
        None
    }

    /// Checks that a table of one turn represents every turn: inertia and loads are the same a turn later. Used before a table is made for a drive
    /// link that turns fully. This default checks three places.
    ///
    /// # Errors
    /// [`PoseError::NotPeriodic`], with a place where they differ; as [`reduction`](Self::reduction).
    fn check_repeats(&self) -> Result<(), PoseError> {
        for phi in SAMPLES {
            let [now, later] = [self.reduction(phi)?, self.reduction(phi + TAU)?];
            for (a, b) in [
                (now.inertia, later.inertia),
                (now.load_torque(), later.load_torque()),
                (now.viscous, later.viscous),
                (now.coulomb, later.coulomb),
            ] {
                // U′ and the process may cancel in the load torque.
                let size = math::abs(a) + math::abs(b) + math::abs(now.process);
                if math::abs(a - b) > REPEATS * size {
                    return Err(PoseError::NotPeriodic { phi });
                }
            }
        }
        Ok(())
    }
}

/// Places to compare with the same places a turn later.
const SAMPLES: [f64; 3] = [0.4, 2.9, 5.1];

/// Largest relative difference between two turns: rounding of φ + 2π, and of the sums.
const REPEATS: f64 = 1e-6;

impl<M: Mechanism> Reducible for Machine<M> {
    fn domain(&self) -> Domain {
        self.mechanism().domain()
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, PoseError> {
        self.check_curves()?;
        let reduction = self.bare_reduction(phi)?;
        if reduction.inertia > 0.0 {
            Ok(reduction)
        } else {
            Err(PoseError::NoInertia { phi })
        }
    }

    fn edge(&self, k: usize) -> Option<f64> {
        self.mechanism().edge(k).or_else(|| {
            let own = (0..k).map_while(|k| self.mechanism().edge(k)).count();
            self.load_edges().nth(k - own)
        })
    }

    /// Depends on the inertia and on the links' positions a turn later, not on the magnitude of the loads, which may act only in a part of the turn.
    /// A force or a weight of fixed direction requires a link with the same direction again, a spring the same length. A load with a period of
    /// several turns does not repeat.
    fn check_repeats(&self) -> Result<(), PoseError> {
        let links = self.mechanism().links();
        let mut windows = self.loads().iter().filter_map(Load::window);
        let once = windows.all(|window| window.turns() <= 1);
        for phi in SAMPLES {
            let [now, later] = [
                self.mechanism().frames(phi)?,
                self.mechanism().frames(phi + TAU)?,
            ];
            let comes_back = |link: usize| {
                now.get(link).zip(later.get(link)).is_none_or(|(a, b)| {
                    let turns = (b.psi.value - a.psi.value) / TAU;
                    math::abs(turns - math::floor(turns + 0.5)) <= REPEATS
                })
            };
            let heavy = |link: usize| {
                let off_axis = links
                    .get(link)
                    .is_some_and(|l| l.mass() > 0.0 && !l.is_centred());
                off_axis && self.gravity().iter().any(|g| math::abs(*g) > 0.0)
            };
            let mut pulled = self
                .loads()
                .iter()
                .filter(|load| load.has_fixed_direction());
            let forced = pulled.all(|load| comes_back(load.link()));
            let weighed = (0..links.len()).all(|link| !heavy(link) || comes_back(link));
            let sprung = self.elements().iter().all(|element| {
                let [a, b] = [element.effort(&now, 1.0), element.effort(&later, 1.0)];
                math::abs(a - b) <= REPEATS * (math::abs(a) + math::abs(b))
            });
            let [a, b] = [&now, &later].map(|frames| {
                let links = self.each_link(frames).map(|[inertia, ..]| inertia);
                links.sum::<f64>() + self.flywheel()
            });
            let inert = math::abs(a - b) <= REPEATS * (math::abs(a) + math::abs(b));
            if !(once && forced && weighed && sprung && inert) {
                return Err(PoseError::NotPeriodic { phi });
            }
        }
        Ok(())
    }
}
