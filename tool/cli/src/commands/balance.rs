//! `jred balance`: counterweights and springs that relieve the drive.

use miette::{Report, Result, miette};

use crate::commands::core_error::duty_report;
use crate::commands::{Completion, print_answer};
use crate::options;
use jred_analysis::checked;
use jred_file::argument;
use jred_file::model::machine::MachineFile;
use jred_file::model::variator;
use jred_file::read;
use jred_motion::balance::{self, BalanceError, BalanceGoal, BalanceRequest, Counterweight};
use jred_report::list;

/// Runs the command.
///
/// # Errors
/// Bad input, or nothing to balance.
pub fn balance(options: &options::balance::Balance) -> Result<Completion> {
    let file = checked::read(&options.file)?;
    variator::refuse(&file, "balance")?;
    file.refuse_joint_friction("balance")?;
    if let Some(carriage) = file.carriages().next() {
        return Err(miette!(
            help =
                "remove the [[carriage]], or fix it where it is most of the time with a [[mass]]",
            "{carriage}, and `jred balance` does not know where it is over the range"
        ));
    }
    let all = options.counterweight.iter();
    let counterweights = all.map(|text| counterweight(text, &file));
    let mut request = BalanceRequest {
        goal: options.least,
        counterweights: counterweights.collect::<Result<_>>()?,
        springs: Vec::new(),
        sampling: options.sampling.sampling(),
    };
    for name in &options.spring {
        let number = spring(name, &file)?;
        if request.springs.contains(&number) {
            return Err(miette!("--spring {name:?} is given twice"));
        }
        request.springs.push(number);
    }
    let links = request.counterweights.iter().map(|c| c.link);
    for (k, link) in links.clone().enumerate() {
        if links.clone().take(k).any(|earlier| earlier == link) {
            return Err(miette!(
                help = "give one of them with the sum of both masses",
                "two counterweights are on {:?}",
                file.machine.mechanism().link_names()[link]
            ));
        }
    }
    let balanced = balance::balance(&file, &request).map_err(|fault| {
        let links = if matches!(fault, BalanceError::NoEffect) {
            balance::effective(&file, &request)
        } else {
            Vec::new()
        };
        report(options, &fault, &links)
    })?;
    let view = list::balance::BalanceView {
        file: &file,
        request: &request,
        balanced: &balanced,
    };
    print_answer(&list::balance::answer(&view), options.format.into())?;
    Ok(Completion::Holds)
}

/// Why there is no answer; `links` are the links with an effect.
fn report(options: &options::balance::Balance, fault: &BalanceError, links: &[String]) -> Report {
    let name = read::name(&options.file);
    match fault {
        BalanceError::Duty(fault) => duty_report(fault.clone()),
        BalanceError::NoMotion => miette!(
            help = "add a [motion], or give --least holding or --least inertia, which need none",
            "{name} has no [motion] over which the torque could be minimised"
        ),
        BalanceError::Nothing => match options.least {
            BalanceGoal::Inertia => miette!(
                "the reduced inertia of {name} is the same at every position: there is nothing to balance"
            ),
            _ => miette!("the drive of {name} gives no torque: there is nothing to balance"),
        },
        BalanceError::SpringForInertia => miette!(
            help = "remove --spring, or choose another --least",
            "a spring has no inertia and no effect on --least inertia"
        ),
        BalanceError::Parts(parted) => miette!(
            help = "keep the spring that closes the contact as it is, or choose another --least",
            "with the optimum, {} ({}): {}",
            parted.what(),
            parted.state(),
            parted.required_force()
        ),
        BalanceError::NoEffect => {
            let (such, or) = match options.least {
                BalanceGoal::Inertia => ("a link whose speed changes over the turn", ""),
                BalanceGoal::Holding => (
                    "a link that rises and falls",
                    ", or a spring whose length changes",
                ),
                _ => ("a link that moves", ", or a spring whose length changes"),
            };
            let named = match links {
                [] => String::new(),
                links => format!(" ({})", links.join(", ")),
            };
            miette!(
                help = format!("choose {such}{named}{or}"),
                "none of the given counterweights and springs changes the objective"
            )
        }
    }
}

/// "crank, 20 kg, 250 mm".
fn counterweight(text: &str, file: &MachineFile) -> Result<Counterweight> {
    let given = format!("--counterweight {text:?}");
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let mechanism = file.machine.mechanism();
    let links = mechanism.link_names();
    let example = links.first().map_or("crank", String::as_str);
    let &[link, most, reach] = parts.as_slice() else {
        return Err(miette!(
            help = format!(
                "write the link, the largest mass of the counterweight, and its largest distance from the origin of the link's frame: \
                 \"{example}, 20 kg, 250 mm\""
            ),
            "{given} has {} parts instead of three",
            parts.len()
        ));
    };
    let Some(number) = links.iter().position(|name| name == link) else {
        return Err(miette!(
            help = format!("its links are {}", links.join(", ")),
            "{given}: the mechanism has no link {link:?}"
        ));
    };
    let refused = |why| miette!("{given}: {why}");
    Ok(Counterweight {
        link: number,
        most: argument::positive(&jred_file::units::kind::MASS)(most).map_err(refused)?,
        reach: argument::positive(&jred_file::units::kind::LENGTH)(reach).map_err(refused)?,
    })
}

/// Index of a spring.
fn spring(name: &str, file: &MachineFile) -> Result<usize> {
    let springs = || {
        let all = file.elements.iter().enumerate();
        all.filter(|(_, named)| named.element.spring_rate().is_some())
    };
    if let Some((number, _)) = springs().find(|(_, named)| named.name == name) {
        return Ok(number);
    }
    let names: Vec<String> = springs()
        .map(|(_, named)| format!("{:?}", named.name))
        .collect();
    Err(if names.is_empty() {
        miette!(
            help =
                "add a [[spring]] with its ends and rough values; docs/machine-file.md shows how",
            "--spring {name:?}: the machine has no spring"
        )
    } else {
        miette!(
            help = format!("its springs are {}", names.join(", ")),
            "--spring {name:?}: the machine has no spring of this name"
        )
    })
}
