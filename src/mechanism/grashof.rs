//! Grashof's condition: which link of a four-bar turns fully.

use core::fmt;

/// The kinds of four-bar linkage by the lengths of their links.
///
/// Let s be the shortest and l the longest of the four lengths, p and q the others. If s + l < p + q (Grashof), the shortest link turns fully against
/// all others; if s + l > p + q no link does; if both are equal the linkage can flatten into one line, where its motion is not determined.
///
/// F. Grashof, *Theoretische Maschinenlehre*, volume 2 (1883); K. Luck, K.-H. Modler, *Getriebetechnik*, section on four-bar linkages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Grashof {
    /// The crank is the shortest link: it turns fully, the rocker swings.
    CrankRocker,
    /// The ground is the shortest link: crank, coupler and rocker turn fully (drag link).
    DoubleCrank,
    /// The rocker is the shortest link: it turns fully, the crank swings.
    RockerCrank,
    /// The coupler is the shortest link: it turns fully, crank and rocker swing.
    DoubleRocker,
    /// s + l > p + q: no link turns fully.
    TripleRocker,
    /// s + l = p + q: the linkage can flatten, like parallelogram, antiparallelogram and kite.
    ChangePoint,
}

/// The links of [`Grashof::of`], in its order.
pub(super) const NAMES: [&str; 4] = ["crank", "coupler", "rocker", "ground"];

impl Grashof {
    /// The kind of the four-bar with these `lengths` of crank, coupler, rocker and ground (m). Sums with a relative difference below 1e-12 count as
    /// equal (test `grashof_does_not_depend_on_the_size`).
    #[must_use]
    pub fn of(lengths: [f64; 4]) -> Self {
        let [shortest, _, _, longest] = order(lengths);
        let ends = lengths[shortest] + lengths[longest];
        let others = lengths.iter().sum::<f64>() - ends;
        let hair = 1e-12 * others;
        if ends > others + hair {
            Self::TripleRocker
        } else if ends >= others - hair {
            Self::ChangePoint
        } else {
            [
                Self::CrankRocker,
                Self::DoubleRocker,
                Self::RockerCrank,
                Self::DoubleCrank,
            ][shortest]
        }
    }
}

/// Indices of the lengths, shortest first.
fn order(lengths: [f64; 4]) -> [usize; 4] {
    let mut order = [0, 1, 2, 3];
    order.sort_unstable_by(|a, b| lengths[*a].total_cmp(&lengths[*b]));
    order
}

/// Why the crank of the four-bar with these lengths does not turn fully, as text.
pub(crate) struct Cause(pub(crate) [f64; 4]);

pub(crate) struct Remedy(pub(crate) [f64; 4]);

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lengths = self.0;
        let [s, p, q, l] = order(lengths);
        let [shortest, middle, other, longest] = [s, p, q, l].map(|k| NAMES[k]);
        let (ends, others) = (lengths[s] + lengths[l], lengths[p] + lengths[q]);
        match Grashof::of(lengths) {
            Grashof::TripleRocker => write!(
                f,
                "by Grashof's condition no link can: {shortest} + {longest} (shortest and longest) = {ends:.6} m, but must \
                 be less than {middle} + {other} = {others:.6} m"
            ),
            Grashof::ChangePoint => write!(
                f,
                "{shortest} + {longest} = {middle} + {other} = {ends:.6} m, so the linkage flattens into one line, a dead \
                 point where its motion is not determined (parallelogram, kite)"
            ),
            Grashof::RockerCrank | Grashof::DoubleRocker => write!(
                f,
                "by Grashof's condition only the shortest link can, the {shortest} of {:.6} m",
                lengths[s]
            ),
            // Not a reason, but the message is true.
            Grashof::CrankRocker | Grashof::DoubleCrank => write!(
                f,
                "{shortest} + {longest} = {ends:.6} m is within a rounding of {middle} + {other} = {others:.6} m"
            ),
        }
    }
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [shortest, .., longest] = order(self.0).map(|k| NAMES[k]);
        match Grashof::of(self.0) {
            Grashof::RockerCrank | Grashof::DoubleRocker => {
                f.write_str("make the crank or the ground the shortest link")
            }
            _ => write!(f, "shorten the {shortest} or the {longest}"),
        }
    }
}
