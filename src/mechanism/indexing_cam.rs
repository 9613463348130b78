//! The indexing cam: a cam shaft that turns fully, and a table that a globoid or parallel cam advances by one station and then locks.
//!
//! ```text
//! index, φ from 0 to β:     ψ = h·S(φ/β)        ψ′ = h/β·S′        ψ″ = h/β²·S″        ψ‴ = h/β³·S‴
//! dwell, to the next one:   ψ = h
//! J_red = J₁ + J₂·ψ′²       J_red′ = 2·J₂·ψ′·ψ″
//! ```
//!
//! h = ±2π/n for n stops; S is the motion law. With C_v, C_a and C_Mdyn of the law, at the constant speed ω of the cam shaft the table has at most
//! the speed C_v·h/β·ω and the acceleration C_a·h/β²·ω², and takes at most the torque C_Mdyn·J₂·h²/β³·ω² from the cam shaft. Makers of indexing
//! drives use these figures.
//!
//! The cam's surface is not needed for that: with crossed shafts (globoid and barrel cams) or parallel ones, the rollers of the table follow the law.
//! The force on a roller is the table's moment over its pitch radius.

use core::f64::consts::TAU;

use super::cam::Segment;
use super::dimensions::centred;
use crate::machine::error::PoseError;
use crate::machine::joint::{Body, Joint, Joints, Marker, Wrench};
use crate::machine::link::{Frame, Link};
use crate::machine::motion::Law;
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::error::BuildError;
use crate::number::error::{finite, within};
use crate::number::transfer::Transfer;
use crate::{Domain, math};

/// Motion of the table over a turn of the cam shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct IndexingCamDimensions {
    /// Number n of stops per turn of the table.
    pub stops: u32,
    /// Index angle β: angle of the cam shaft (rad) in which the table advances by one stop.
    pub index: f64,
    /// Indexes per turn of the cam shaft; 1 for most cams.
    pub indexes: u32,
    /// Whether the table turns against the cam shaft, in the plane of the drawing.
    pub reverses: bool,
    /// The motion law.
    pub law: Law,
}

/// An indexing drive: a cam shaft, and a table on followers.
///
/// Links: [`CAM`](Self::CAM), [`TABLE`](Self::TABLE), both frames at the origin: the drive has ratios, but no positions. An index begins at φ = 0.
/// The table does not return after a turn of the cam shaft, and must be balanced; J and every moment are periodic.
///
/// Accuracy: within thirty turns of φ = 0, ψ to ψ″ agree with the formulas above to 1e-12 of the next derivative's largest value, at least
/// 1 (test `table_textbook`).
#[derive(Clone, Debug, PartialEq)]
pub struct IndexingCam {
    segment: Segment,
    indexes: u32,
    links: [Link; 2],
}

impl IndexingCam {
    /// Index of the cam shaft.
    pub const CAM: usize = 0;
    /// Index of the table.
    pub const TABLE: usize = 1;
    /// Greatest number of stops.
    pub const MAX_STOPS: u32 = 360;
    /// Greatest number of indexes per turn of the cam shaft.
    pub const MAX_INDEXES: u32 = 8;

    /// An indexing drive of these `dimensions` with the links cam shaft, table.
    ///
    /// # Errors
    /// A number of stops outside 1 to 360, or of indexes outside 1 to 8; an index angle that is not positive or exceeds 2π over the number of
    /// indexes; an invalid law; a table whose centre of mass is off its axis.
    pub fn new(dimensions: IndexingCamDimensions, links: [Link; 2]) -> Result<Self, BuildError> {
        let IndexingCamDimensions {
            stops,
            index,
            indexes,
            reverses,
            law,
        } = dimensions;
        let most = [Self::MAX_STOPS, Self::MAX_INDEXES].map(f64::from);
        within("number of stops", f64::from(stops), [1.0, most[0]])?;
        within("indexes a turn", f64::from(indexes), [1.0, most[1]])?;
        let period = TAU / f64::from(indexes);
        within("index angle", index, [Self::LEAST, period])?;
        law.check()?;
        centred("table", &links[Self::TABLE])?;
        let way = if reverses { -TAU } else { TAU };
        Ok(Self {
            segment: Segment::law(law, index, way / f64::from(stops)),
            indexes,
            links,
        })
    }

    /// Smallest index angle (rad).
    const LEAST: f64 = 1e-3;

    /// Index angle β (rad).
    pub const fn index(&self) -> f64 {
        self.segment.angle
    }

    /// Angle h (rad) by which the table advances in an index, negative if against the cam shaft.
    pub const fn step(&self) -> f64 {
        self.segment.rise
    }

    /// Angle of the cam shaft (rad) from one index to the next.
    #[must_use]
    pub fn period(&self) -> f64 {
        TAU / f64::from(self.indexes)
    }

    /// ψ with its derivatives.
    fn table(&self, phi: f64) -> Transfer {
        let period = self.period();
        let index = math::floor(phi / period);
        let into = phi - index * period;
        let before = Transfer::constant(self.segment.rise * index);
        if into < self.segment.angle {
            before + self.segment.at((into / self.segment.angle).clamp(0.0, 1.0))
        } else {
            before + Transfer::constant(self.segment.rise)
        }
    }
}

impl Jointed for IndexingCam {
    /// The bearings of cam shaft and table, and the cam: the moment on the table, and ψ′ times it on the cam shaft in return; in the dwell the moment
    /// that locks the table.
    fn joints(&self, phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let slope = self.table(finite("cam shaft angle", phi)?).d1;
        let bearing =
            |link| Joint::Revolute([Marker::ground([0.0, 0.0]), Marker::on(link, [0.0, 0.0])]);
        Ok(Joints::from_iter([
            bearing(Self::CAM),
            bearing(Self::TABLE),
            Joint::Transmission([
                Wrench::moment(Body::Link(Self::CAM), -slope),
                Wrench::moment(Body::Link(Self::TABLE), 1.0),
            ]),
        ]))
    }
}

impl Mechanism for IndexingCam {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    /// Start and end of an index, and the jumps of a derivative of its law.
    fn edge(&self, k: usize) -> Option<f64> {
        let breaks = self.segment.breaks();
        let places = || {
            let within = breaks.into_iter().flatten();
            let all = core::iter::once(0.0).chain(within).chain([1.0]);
            all.map(|z| z * self.segment.angle)
        };
        let each = places().count();
        let turn = u32::try_from(k / each).ok()?;
        let place = places().nth(k % each)? + f64::from(turn) * self.period();
        // An index that fills the turn ends where the next begins.
        (turn < self.indexes && place < TAU).then_some(place)
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let angle = Transfer::variable(finite("cam shaft angle", phi)?);
        Ok(Frames::from_iter([
            Frame::turning([0.0, 0.0], angle),
            Frame::turning([0.0, 0.0], self.table(phi)),
        ]))
    }
}
