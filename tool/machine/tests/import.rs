//! Data of other programs: reduced curves, tables of loads, recorded motions.

mod curves;
mod faults;
mod forms;
mod link_table;
mod load_table;
mod recordings;

use jred_machine::model::machine::MachineFile;
use jred_machine::read;

/// A machine file with files beside it.
fn parse(machine: &str, files: &[(&str, &str)]) -> Result<MachineFile, String> {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    read::parse("machine.toml", machine, folder.path()).map_err(|report| {
        let mut text = String::new();
        miette::NarratableReportHandler::new()
            .render_report(&mut text, report.as_ref())
            .unwrap();
        text
    })
}

/// A machine of curves in `curves.csv`.
fn of_curves(csv: &str, range: &str) -> Result<MachineFile, String> {
    let machine = format!(
        "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"reduced-curves\"\nfile = \"curves.csv\"\nrange = \"{range}\"\n"
    );
    parse(&machine, &[("curves.csv", csv)])
}
