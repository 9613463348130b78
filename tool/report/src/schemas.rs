//! JSON schemas of all commands, generated from their types.

use schemars::Schema;

use crate::answer::schema::{of, of_sheet};
use crate::list;
use crate::list::export::ExportData;

/// All schemas, each with the name of its form.
pub fn all() -> Vec<(&'static str, Schema)> {
    vec![
        of::<list::balance::BalanceData>(),
        of::<list::bus::BusData>(),
        of_sheet(list::catalogue::FORM, &["key", "maker", "model", "source"]),
        of::<list::catalogue::CheckedData>(),
        of::<list::catalogue::PartData>(),
        of::<list::drive::DriveData>(),
        of::<ExportData>(),
        of::<list::fastest::FastestData>(),
        of::<list::inspection::CheckData>(),
        of::<list::front::FrontData>(),
        of::<list::identify::IdentifyData>(),
        of::<list::project::ProjectData>(),
        of_sheet(list::ratio::FORM, &list::ratio::COLUMNS),
        of::<list::reduction::ReductionData>(),
        of::<list::require::RequireData>(),
        of::<list::gentlest::GentlestData>(),
        of_sheet(list::sensitivity::FORM, &list::sensitivity::COLUMNS),
        of::<list::rule_list::SetData>(),
        of::<list::rule_list::SetsData>(),
        of::<list::simulation::SimulationData>(),
        of::<list::split::SplitData>(),
        of::<list::steady::SteadyData>(),
        of::<list::listing::SizeData>(),
        of_sheet(list::tolerance::FORM, &list::tolerance::COLUMNS),
    ]
}
