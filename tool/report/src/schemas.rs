//! JSON schemas of all commands, generated from their types.

use schemars::Schema;

use crate::answer::schema::{of, of_sheet};
use crate::list;
use jred_analysis::steady::Steady;
use jred_export::data::ExportData;

/// All schemas, each with the name of its form.
pub fn all() -> Vec<(&'static str, Schema)> {
    vec![
        of::<list::balance::Form>(),
        of::<list::bus::Form>(),
        of::<ExportData>(),
        of::<list::fastest::Form>(),
        of::<list::inspection::Form>(),
        of::<list::front::Form>(),
        of_sheet(list::ratio::FORM, &list::ratio::COLUMNS),
        of::<list::reduction::Form>(),
        of::<list::retime::Form>(),
        of_sheet(list::sensitivity::FORM, &list::sensitivity::COLUMNS),
        of::<list::rule_list::Set>(),
        of::<list::rule_list::Sets>(),
        of::<list::simulation::Form>(),
        of::<list::split::SplitData>(),
        of::<Steady>(),
        of::<list::listing::Form>(),
        of_sheet(list::tolerance::FORM, &list::tolerance::COLUMNS),
    ]
}
