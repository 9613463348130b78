//! Output of the commands that judge drives: size, ratio, bus, vary, sensitivity, tolerance.

use super::listings::press;
use super::{Desk, compare};

/// The press with ninety times the load.
fn heavy() -> Desk {
    let text = Desk::machine("press.toml").replacen("\"-10 kN\"", "\"-900 kN\"", 1);
    Desk::new().with("heavy.toml", text)
}

#[test]
fn size() {
    let press = press();
    compare(
        "size-screen",
        &press.runs("size press.toml --catalogue drives --steps 64"),
    );
    compare(
        "size",
        &press.runs("size press.toml --full --catalogue drives --steps 64"),
    );
    compare(
        "size-explain",
        &press.runs("size press.toml --explain --nearest 1 --catalogue drives --steps 64"),
    );
    compare(
        "size-motion",
        &press.runs("size press.toml --motion best --top 3 --catalogue drives --steps 64"),
    );
    compare(
        "size-all",
        &press.runs("size press.toml --all --catalogue drives --steps 64"),
    );
    let commands = "
        size press.toml --drive sgmsh-30a+npt025mf-5 --catalogue drives --steps 64
        size press.toml --drive sgmsh-15a --catalogue drives --steps 64
        size press.toml --drive sgmsh-15+npt025mf-5 --catalogue drives --steps 64
        size press.toml --drive sgmsh-15a --rank mass --catalogue drives --steps 64
    ";
    compare("size-drive", &press.runs(commands));
    let commands = "
        size press.toml --why sgmsh-30a+npt025mf-5 --catalogue drives --steps 64
        size press.toml --why sgmsh-15a --catalogue drives --steps 64
        size press.toml --why sgmsh-15a+npt035mf-10 --catalogue drives --steps 64
    ";
    compare("size-why", &press.runs(commands));
    let commands = "
        size press.toml --rank mass --max-mass '3 kg' --catalogue drives --steps 64
        size press.toml --pareto power,energy --catalogue drives --steps 64
        size press.toml --pareto mass,energy --catalogue drives --steps 64
        size press.toml --motor 'none*' --catalogue drives --steps 64
        size press.toml --ratio 500..600 --catalogue drives --steps 64
    ";
    compare("size-ranked", &press.runs(commands));
    let heavy = heavy();
    let commands = "
        size heavy.toml --catalogue drives --steps 64
        size heavy.toml --refused --explain --nearest 1 --catalogue drives --steps 64
    ";
    compare("size-refused", &heavy.runs(commands));
}

/// Linear motors: force instead of torque, mass instead of inertia.
#[test]
fn size_linear() {
    let motors = "key,kind,maker,model,rated_force [N],rated_speed [m/s],peak_force [N],max_speed [m/s],moving_mass [kg],\
                  torque_constant [N/A rms],source\n\
                  slide,linear,Maker,Slide,140,3,450,4,1.8,60,Sheet\n";
    let desk = Desk::new()
        .with_machines(&["linear-gripper.toml"])
        .with("linear.csv", motors);
    let commands = "
        size linear-gripper.toml --motors linear.csv
        size linear-gripper.toml --motors linear.csv --full
        size linear-gripper.toml --motors linear.csv --explain --why slide
    ";
    compare("size-linear", &desk.runs(commands));
}

/// Winding data, thermal resistances and an amplifier: for the rules that small catalogues leave unchecked.
#[test]
fn size_with_every_figure() {
    let motors = "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],max_speed [rpm],rotor_inertia [kg cm^2],\
                  torque_constant [N m/A rms],voltage_constant [V s/rad],winding_resistance [Ohm],winding_inductance [mH],\
                  pole_pairs,rated_current [A rms],peak_current [A rms],thermal_resistance_winding [K/W],\
                  thermal_resistance_housing [K/W],thermal_time_winding [s],thermal_time_housing [s],\
                  max_winding_temperature [C],bus_voltage [V],source\n\
                  m1,Maker,One,8,3000,30,4500,8.5,1.1,0.64,0.9,6.5,4,8,30,0.3,0.4,60,2100,155,560,Sheet\n";
    let amplifiers = "key,maker,model,rated_current [A rms],peak_current [A rms],peak_time [s],capacitance [uF],\
                      chopper_voltage [V],max_voltage [V],min_resistance [Ohm],source\n\
                      a1,Maker,Drive,10,32,3,470,760,820,22,Sheet\n";
    let supply = "\n[supply]\nmains_voltage = \"400 V\"\n";
    let desk = Desk::new()
        .with("drives/motors.csv", motors)
        .with("drives/amplifiers.csv", amplifiers)
        .with("press.toml", Desk::machine("press.toml") + supply);
    let commands = "
        size press.toml --why 'm1+npt025mf-5 on a1' --catalogue drives --steps 64
    ";
    compare("size-amplifier", &desk.runs(commands));
}

/// Motors and amplifiers of several voltages with and without a mains voltage.
#[test]
fn size_by_voltage() {
    let motors = "key,maker,model,rated_torque [N m],rated_speed [rpm],max_speed [rpm],peak_torque [N m],rotor_inertia [kg cm^2],rated_current [A rms],\
                  mains_voltage [V],bus_voltage [V],max_bus_voltage [V],figures_from,source\n\
                  low,Maker,48 V,9.8,3000,5000,29.4,7,18.8,,48,,maker,Sheet\n\
                  class200,Maker,200 V,9.8,3000,5000,29.4,7,18.8,200,,,maker,Sheet\n\
                  insulated,Maker,800 V,9.8,3000,5000,29.4,7,18.8,,320,800,maker,Sheet\n\
                  class400,Maker,400 V,12,3000,5000,36,9,18.8,400,,,maker,Sheet\n\
                  elsewhere,Maker,other,9.8,3000,5000,29.4,7,18.8,400,,,other,Sheet\n\
                  unknown,Maker,unknown,9.8,3000,5000,29.4,7,18.8,,,,maker,Sheet\n";
    let amplifiers = "key,maker,model,rated_current [A rms],peak_current [A rms],mains_voltage [V],source\n\
                      a230,Maker,Drive 230,20,60,230,Sheet\n\
                      a400,Maker,Drive 400,20,60,400,Sheet\n";
    let press = Desk::machine("press.toml");
    let at = |volts: &str| format!("{press}\n[supply]\nmains_voltage = \"{volts} V\"\n");
    let desk = Desk::new();
    let gearboxes = std::fs::read_to_string(desk.0.path("drives/gearboxes.csv")).unwrap();
    std::fs::create_dir(desk.0.path("own")).unwrap();
    let desk = desk
        .with("drives/motors.csv", motors)
        .with("own/motors.csv", motors)
        .with("own/amplifiers.csv", amplifiers)
        .with("own/gearboxes.csv", gearboxes)
        .with("none.toml", &press)
        .with("200.toml", at("200"))
        .with("400.toml", at("400"));
    let commands = "
        size 400.toml --refused --full --catalogue drives --steps 64
        size 200.toml --top 9 --catalogue drives --steps 64
        size none.toml --top 1 --catalogue drives --steps 64
        size 400.toml --why unknown+npt025mf-5 --catalogue drives --steps 64
        size 400.toml --why class200+npt025mf-5 --catalogue drives --steps 64
        ratio 400.toml --motor 'class*' --catalogue drives --steps 64
        size 400.toml --refused --full --catalogue own --gearbox npt025mf-5 --steps 64
        size none.toml --top 9 --catalogue own --gearbox npt025mf-5 --steps 64
    ";
    compare("size-voltage", &desk.runs(commands));
}

#[test]
fn ratio() {
    let desk = heavy().with("press.toml", Desk::machine("press.toml"));
    let commands = "
        ratio press.toml --catalogue drives --steps 64
        ratio press.toml --efficiency 0.9 --top 1 --catalogue drives --steps 64
        ratio heavy.toml --catalogue drives --steps 64
    ";
    compare("ratio", &desk.runs(commands));
}

#[test]
fn bus() {
    let supply = "\n[supply]\nmains_voltage = \"230 V\"\ncapacitance = \"2600 uF\"\nchopper_voltage = \"380 V\"\n\
                  max_voltage = \"410 V\"\n";
    let text = Desk::machine("press.toml");
    let desk = Desk::new()
        .with("press.toml", text.clone())
        .with("powered.toml", text.clone() + supply)
        .with("slow.toml", text.replacen("\"0.1 s\"", "\"0.2 s\"", 1));
    let commands = "
        bus press.toml --catalogue drives --steps 64
        bus powered.toml slow.toml --catalogue drives --steps 64
        bus powered.toml press.toml --in-step --catalogue drives --steps 64
        bus powered.toml --drive 1=sgmsh-30a+npt025mf-5 --catalogue drives --steps 64
    ";
    compare("bus", &desk.runs(commands));
}

#[test]
fn vary() {
    let desk = press();
    let commands = "
        vary press.toml --vary slider.mass=40..400kg:3 --catalogue drives --steps 64
        vary press.toml --vary slider.mass=40..400kg:3 --format csv --catalogue drives --steps 64
        vary press.toml --vary slider.mass=40..400kg:3 --vary 'pressing force.force.1=-10,-900kN' --catalogue drives --steps 64
        vary press.toml --vary slider.mass=40..400kg:3 --out a.csv --format csv --shard 0/2 --catalogue drives --steps 64
        vary press.toml --vary slider.mass=40..400kg:3 --out b.csv --format csv --shard 1/2 --catalogue drives --steps 64
        vary press.toml --vary slider.mass=40..400kg:3 --out a.csv --format csv --catalogue drives --steps 64
        vary press.toml --vary slider.mass=40..400kg:3 --out a.csv --format csv --resume --rank mass --catalogue drives \
            --steps 64
        vary press.toml --vary slider.mass=40..400kg:3 --out a.csv --format csv --resume --catalogue drives --steps 64
    ";
    compare("vary", &desk.runs(commands));
}

#[test]
fn sensitivity_and_tolerance() {
    let desk = press();
    let commands = "
        sensitivity press.toml --catalogue drives --steps 64
        sensitivity press.toml --drive sgmsh-15a --catalogue drives --steps 64
    ";
    compare("sensitivity", &desk.runs(commands));
    let commands = "
        tolerance press.toml --samples 100 --tolerance slider.mass=5% --catalogue drives --steps 64
        tolerance press.toml --samples 100 --tolerance crank.length=normal:2% --tolerance segment.1.duration=10% \
            --catalogue drives --steps 64
        tolerance press.toml --samples 100 --catalogue drives --steps 64
        tolerance press.toml --samples 100 --tolerance slider.mass --catalogue drives --steps 64
        tolerance press.toml --samples 100 --tolerance slider.mas=5% --catalogue drives --steps 64
        tolerance press.toml --samples 100 --tolerance slider.mass=5mm --catalogue drives --steps 64
    ";
    compare("tolerance", &desk.runs(commands));
}
