//! Checks whether a load has an effect on its link, and repeats.

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::Mechanism as _;

use crate::model::mechanism::AnyMechanism;
use crate::text::item::Item;
use crate::text::problem::Result;

/// The action of a load and its place.
pub(super) struct Effect {
    pub(super) link: usize,
    /// The point of a force in the link's frame (m).
    pub(super) point: [f64; 2],
    /// Whether it is a force, otherwise a moment.
    pub(super) force: bool,
    /// Whether it is a force whose direction does not rotate.
    pub(super) fixed: bool,
}

impl Effect {
    /// Checks that the load moves something, and acts equally in every turn; a problem is shown at `item`.
    pub(super) fn check(&self, mechanism: &AnyMechanism, item: &Item) -> Result<()> {
        let link_name = mechanism.link_names().get(self.link);
        let link_name = link_name.map_or("", String::as_str);
        let movement = Movement::of(mechanism, self.link);
        if movement.slides && !self.force {
            return Err(item
                .problem(
                    &format!("does nothing: \"{link_name}\" does not turn"),
                    "acts on a link that only slides",
                )
                .help(format!(
                    "use force, opposing_force or viscous_force for \"{link_name}\", or choose another link in `on`"
                )));
        }
        if self.fixed && !movement.closes {
            return Err(item
                .problem(
                    &format!(
                        "acts in a fixed direction on \"{link_name}\", which does not move in the same way in every turn of the drive link"
                    ),
                    "does not repeat with each turn",
                )
                .help("a load must repeat with every turn of the drive link: use moment, or opposing_force"));
        }
        if movement.pivots && self.force && self.point == [0.0, 0.0] {
            return Err(item
                .problem(
                    &format!("does nothing: it acts on the fixed pivot of \"{link_name}\""),
                    "acts on the pivot",
                )
                .help("give the point where it acts, in the link's frame: at = [\"30 mm\", \"0 mm\"], or use a moment"));
        }
        Ok(())
    }
}

/// Motion of a link, as far as it matters for loads.
struct Movement {
    /// It never turns.
    slides: bool,
    /// The origin of its frame never moves.
    pivots: bool,
    /// After every turn of the drive link, it has the same position and motion.
    closes: bool,
}

impl Movement {
    /// Evaluated at positions spread over the drive link's range by the golden ratio, so that no position is special.
    fn of(mechanism: &AnyMechanism, link: usize) -> Self {
        let domain = mechanism.domain();
        let mut movement = Self {
            slides: true,
            pivots: true,
            closes: true,
        };
        for k in 1..=16 {
            let phi = domain.position((f64::from(k) * 0.618_033_988_749_895).fract());
            let frame = |phi| Some(*mechanism.frames(phi).ok()?.get(link)?);
            let Some(now) = frame(phi) else { continue };
            movement.slides &= now.psi.d1 == 0.0;
            movement.pivots &= now.x.d1 == 0.0 && now.y.d1 == 0.0;
            if let (Domain::Turn, Some(later)) = (domain, frame(phi + TAU)) {
                let turns = (later.psi.value - now.psi.value) / TAU;
                movement.closes &= (turns - turns.round()).abs() < 1e-9;
                // A rack may have another position after a turn, but must move as before.
                let same = |a: f64, b: f64| (a - b).abs() <= 1e-9 * (1.0 + a.abs());
                movement.closes &= same(now.x.d1, later.x.d1) && same(now.y.d1, later.y.d1);
            }
        }
        movement
    }
}
