//! Data of other programs: reduced curves, tables of loads, recorded motions.

mod cams;
mod curves;
mod drive_logs;
mod faults;
mod forms;
mod link_table;
mod recordings;
mod slips;

use crate::reading::parse_with as parse;
use jred_file::model::machine::MachineFile;

/// A machine of curves in `curves.csv`.
fn of_curves(csv: &str, range: &str) -> Result<MachineFile, String> {
    let machine = format!(
        "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"reduced-curves\"\nfile = \"curves.csv\"\nrange = \"{range}\"\n"
    );
    parse(&machine, &[("curves.csv", csv)])
}
