//! Several axes with one supply, as described by a project file.

use crate::model::document::Document;
use crate::model::site::Site;

/// The content of a project file.
#[derive(Clone, Debug)]
pub struct Project {
    /// Name of the file, for messages.
    pub name: String,
    /// Title for reports.
    pub title: String,
    /// Title block.
    pub document: Document,
    /// Whether all amplifiers share one DC bus.
    pub common_bus: bool,
    /// Supply and surroundings of all axes.
    pub site: Site,
    /// The axes.
    pub axes: Vec<ProjectAxis>,
}

/// An axis of a project.
#[derive(Clone, Debug, PartialEq)]
pub struct ProjectAxis {
    /// Its name in reports.
    pub name: String,
    /// Its machine file, relative to the project file.
    pub machine: String,
    /// Number of equal axes.
    pub quantity: u32,
    /// Time (s) after the start of the machine's cycle at which its cycle starts; `None`: any.
    pub phase: Option<f64>,
    /// Name of its drive; `None`: the best one.
    pub drive: Option<String>,
}
