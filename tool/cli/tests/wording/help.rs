//! Help of the command and of each of its commands.

use super::{Desk, compare};
use crate::support::COMMANDS;

#[test]
fn help_of_every_command() {
    let desk = Desk::new();
    compare("help", &desk.runs("-h\n--help"));
    for command in COMMANDS {
        compare(
            &format!("help-{command}"),
            &desk.run(&format!("{command} --help")),
        );
    }
}

/// Every command must be in the list.
#[test]
fn no_command_is_left_out() {
    use clap::CommandFactory as _;
    let commands = jred_cli::options::Cli::command();
    assert_eq!(commands.get_subcommands().count(), COMMANDS.len());
}
