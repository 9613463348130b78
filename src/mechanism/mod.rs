//! Mechanisms: from the angle of the drive link to the position of every link.
//!
//! The first step of the data flow: dimensions and links form one of the closed forms below, or a [`linkage`] of any topology. Each is a
//! [`Mechanism`](crate::machine::Mechanism), the basis of a [`Machine`](crate::machine::Machine).

mod ball_screw;
pub mod cam;
mod dimensions;
mod disc_cam;
mod dyad;
pub(crate) mod error;
mod four_bar;
mod geneva;
mod grashof;
mod hoist;
mod indexing_cam;
mod inverted_slider_crank;
pub mod linkage;
mod parallel_shafts;
mod planetary;
mod rack;
mod reach;
mod rotation;
mod scotch_yoke;
mod six_link;
mod slider_crank;
pub mod synthesis;
mod toggle_press;
mod train;

pub use ball_screw::BallScrew;
pub use dimensions::DimensionError;
pub use disc_cam::{CamContact, CamProfile, DiscCam, Follower, Roller, RollerDimensions, Swing};
pub use dyad::Side;
pub use error::BuildError;
pub use four_bar::{FourBar, FourBarDimensions};
pub use geneva::Geneva;
pub use grashof::Grashof;
pub use hoist::{Hoist, Rope, RopeLoad};
pub use indexing_cam::{IndexingCam, IndexingCamDimensions};
pub use inverted_slider_crank::{InvertedSliderCrank, InvertedSliderCrankDimensions, LeverMotion};
pub use parallel_shafts::{DrivenShaft, ParallelShafts};
pub use planetary::{Member, Planetary, PlanetaryDimensions, PlanetaryGears};
pub use rack::RackAndPinion;
pub use rotation::RotationError;
pub use scotch_yoke::{ScotchYoke, ScotchYokeDimensions};
pub use six_link::{SixLink, SixLinkDimensions};
pub use slider_crank::{Branch, SliderCrank, SliderCrankDimensions};
pub use toggle_press::{DeadCentre, DeadCentres, Standstill, TogglePress, TogglePressDimensions};
pub use train::{BeltDimensions, GearDimensions, Mesh, Stage, Train, TrainInput, TrainOutput};
