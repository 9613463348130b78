//! Messages about wrong or contradictory options, and about files that cannot be read or written.

use super::{Desk, compare};

fn desk() -> Desk {
    let press = Desk::machine("press.toml");
    let (rest, simulation) = press.split_once("[motion]").unwrap();
    let (_, simulation) = simulation.split_once("[simulation]").unwrap();
    Desk::new()
        .with("press.toml", &press)
        .with("no-motion.toml", format!("{rest}[simulation]{simulation}"))
        .with(
            "no-simulation.toml",
            press.split("[simulation]").next().unwrap(),
        )
        .with("empty.toml", "")
        .with("binary.toml", [0xff_u8, 0xfe, 0, 1])
        .with_machines(&[
            "variator-press.toml",
            "linear-gripper.toml",
            "ball-screw.toml",
        ])
}

#[test]
fn files() {
    let commands = "
        reduce none.toml
        reduce .
        reduce empty.toml
        reduce binary.toml
        size no-motion.toml
        reduce no-motion.toml --over time
        reduce no-motion.toml --reactions
        simulate no-simulation.toml
        steady no-simulation.toml
        steady no-simulation.toml --torque 20
        steady no-simulation.toml --torque '0 N m'
        steady no-simulation.toml --torque '60 N m'
        steady no-simulation.toml --torque '3 N m'
        steady no-simulation.toml --torque '3 N m' --delta 0.1
        steady press.toml --delta '2 percent'
        steady press.toml --delta 7
        steady variator-press.toml
        steady linear-gripper.toml --torque '3 N m'
        gentlest no-motion.toml
        gentlest variator-press.toml
        gentlest press.toml --objective energy
        gentlest press.toml --drive none
        gentlest press.toml --drive sgmsh-30a+none
        gentlest press.toml --ramp '40 %'
        gentlest press.toml --ramp slow
        gentlest press.toml --profile press.toml
        export no-motion.toml --torque-error '1 N m'
        ratio no-motion.toml
        bus no-motion.toml
        vary no-motion.toml --vary slider.mass=1,2kg
        reduce variator-press.toml
        size linear-gripper.toml
        size press.toml --report none/out.html
        size press.toml --report press.toml
        size press.toml --report -
        size press.toml --report out --meter out
        size press.toml --catalogue none
        size press.toml --motors .
        size press.toml --catalogue press.toml
        size press.toml --catalogue drives --catalogue drives
    ";
    compare("option-files", &desk().runs(commands));
}

#[test]
fn values() {
    let commands = "
        size press.toml --catalogue drives --steps 15
        size press.toml --catalogue drives --fromat csv
        size press.toml --catalogue drives --ratio 3
        size press.toml --catalogue drives --ratio 5..3
        size press.toml --catalogue drives --max-mass 3
        size press.toml --catalogue drives --max-price cheap
        size press.toml --catalogue drives --max-price -3
        size press.toml --catalogue drives --pareto mass
        size press.toml --catalogue drives --pareto mass,beauty
        size press.toml --catalogue drives --why sgmsh-15
        size press.toml --catalogue drives --rules generl
        size press.toml --catalogue drives --meter out.rs --motor 'none*'
        size press.toml --catalogue drives --gearbox 'g*' --direct-only
        ratio press.toml --efficiency 1.1
        ratio press.toml --efficiency good
        sensitivity press.toml --change 0
        sensitivity press.toml --drive none
        vary press.toml --vary slider.mass
        vary press.toml --vary slider.mass=1..2kg
        vary press.toml --vary slider.mass=1..2mm:3
        vary press.toml --vary slider.mass=0..2kg:3:log
        vary press.toml --vary slider.mass=2..2kg:3
        vary press.toml --vary slider.mass=1..2kg:3:lin
        vary press.toml --vary slider.mas=1,2kg
        vary press.toml --vary mass=1,2kg
        vary press.toml --vary slider.mass=1,2kg --vary slider.mass=1,2kg
        vary press.toml --vary slider.mass=1..2kg:3 --out o --shard 3/3
        vary press.toml --vary slider.mass=1..2kg:3 --out o --shard 3
        bus press.toml --drive sgmsh-15a
        bus press.toml --drive 1=sgmsh-15a --drive 1=sgmsh-20a
        bus press.toml --drive 1=none
        reduce press.toml --over time --speed '3 rpm'
        reduce press.toml --at '30 deg, 3 rad/s^2'
        reduce press.toml --at '30 deg, high'
        reduce press.toml --at '30 deg' --over time
        reduce press.toml --speed 3
        reduce press.toml --speed '3 m/s'
        rules generl
        export press.toml --torque-error 0.5
        export press.toml --torque-error '-1 N m'
        export press.toml --torque-error '1 N'
        export press.toml --torque-error '1 N m' --omega '90 Hz'
        export press.toml --torque-error '1 N m' --omega '-90 rpm'
        export press.toml --torque-error '1 N m' --reciprocal yes
        export press.toml --torque-error '1 N m' --type i16 --layout cubic
        export press.toml --max-cells 3 --torque-error '1 N m'
        split --ratio 30 --stages 2 --pinion '1 kg'
    ";
    compare("option-values", &desk().runs(commands));
}
