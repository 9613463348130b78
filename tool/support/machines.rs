//! Machine files used by the tests of several packages.

/// A boom on a bearing, lifted by a cylinder: s² = a² + b² − 2·a·b·cos θ with a = 500 mm, b = 600 mm.
pub(crate) const LIFT: &str = r#"gravity = ["0 m/s^2", "-9.81 m/s^2"]

[mechanism]
type = "linkage"
drive = "cylinder"
stroke = ["400 mm", "800 mm"]
ground = { P = ["600 mm", "0 mm"] }
body = [
  { name = "boom", mass = "100 kg", inertia = "10 kg m^2", com = ["800 mm", "0 mm"], angle = "70 deg", points = { E = ["500 mm", "0 mm"] } },
  { name = "barrel", mass = "0 kg", inertia = "0 kg m^2", angle = "130 deg" },
  { name = "rod", mass = "0 kg", inertia = "0 kg m^2" },
]
joint = [
  { name = "boom bearing", between = ["ground", "boom"] },
  { name = "foot", between = ["ground.P", "barrel"] },
  { name = "cylinder", type = "prismatic", between = ["barrel", "rod"], direction = "0 deg" },
  { name = "head", between = ["rod", "boom.E"] },
]
"#;

/// The lift goes up, pauses, and comes down.
pub(crate) const LIFT_MOTION: &str = r#"
[motion]
type = "cycle"
start = "450 mm"
[[motion.segment]]
move = "300 mm"
law = "polynomial-345"
duration = "3 s"
[[motion.segment]]
dwell = "1 s"
[[motion.segment]]
move = "-300 mm"
law = "polynomial-345"
duration = "3 s"
"#;

/// Turns the rotation of a motor into the displacement of the lift's cylinder.
pub(crate) const SCREW: &str = r#"
[[drive_train]]
type = "belt"
driver = { radius = "30 mm", inertia = "2 kg cm^2" }
driven = { radius = "60 mm", inertia = "12 kg cm^2" }

[[drive_train]]
type = "ball-screw"
lead = "10 mm"
inertia = "6 kg cm^2"
mass = "4 kg"
efficiency = "90 %"
"#;

/// A rotor in balance with friction, at constant speed.
pub(crate) const CONSTANT_SPEED: &str = r#"
gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "gear-train"
flywheel = "3 kg m^2"
stage = [{ driver = { teeth = 20, inertia = "0.1 kg m^2" }, driven = { teeth = 60, inertia = "4 kg m^2" } }]
[[load]]
on = "shaft-2"
opposing_moment = "6 N m"
[[load]]
on = "shaft-1"
viscous_moment = "0.05 N m s/rad"
[motion]
type = "constant-speed"
speed = "-300 rpm"
"#;

/// Two shafts behind a variator without slip: 0.0205 kg m² at its output.
pub(crate) const SHAFTS: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "gear-train"
[[mechanism.stage]]
driver = { teeth = 20, inertia = "0.01 kg m^2" }
driven = { teeth = 40, inertia = "0.04 kg m^2" }
[variator]
ratio = 0.5
input_inertia = "0.004 kg m^2"
output_inertia = "0.0005 kg m^2"
# slip
[[variator.shift]]
at = "0.2 s"
duration = "0.5 s"
ratio = 1.6
[simulation]
start_angle = "0 deg"
start_speed = "300 rpm"
duration = "1 s"
output_step = "10 ms"
rotor_inertia = "0.002 kg m^2"
tolerance = 1e-12
torque = "0 N m"
"#;

/// A rotor of 0.02 kg m² with 3 N m and 0.11 N m s/rad against it, which moves 12 rad in 0.5 s by a law (its lines).
pub(crate) fn braked_rotor(law: &str) -> String {
    format!(
        r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "gear-train"
stage = [{{ driver = {{ teeth = 20, inertia = "0.02 kg m^2" }}, driven = {{ teeth = 20, inertia = "0 kg m^2" }} }}]
[[load]]
on = "shaft-1"
opposing_moment = "3 N m"
[[load]]
on = "shaft-1"
viscous_moment = "0.11 N m s/rad"
[motion]
type = "point-to-point"
[[motion.segment]]
{law}
move = "12 rad"
duration = "0.5 s"
"#
    )
}

/// The four-bar of the golden data, as a user would write it: lengths rounded nowhere, angles of the drawing by eye.
pub(crate) const FOUR_BAR: &str = r#"gravity = ["0 m/s^2", "-9.81 m/s^2"]

[mechanism]
type = "linkage"
drive = "crank bearing"
ground = { O = ["0 mm", "0 mm"], C = ["300 mm", "0 mm"] }

[[mechanism.body]]
name = "crank"
mass = "0.5 kg"
inertia = "4 kg cm^2"
com = ["30 mm", "-5 mm"]
angle = "0 deg"
points = { A = ["80 mm", "0 mm"] }

[[mechanism.body]]
name = "coupler"
mass = "0.9 kg"
inertia = "0.006 kg m^2"
com = ["110 mm", "40 mm"]
angle = "50 deg"
points = { B = ["250 mm", "0 mm"] }

[[mechanism.body]]
name = "rocker"
mass = "0.7 kg"
inertia = "0.0025 kg m^2"
com = ["85 mm", "10 mm"]
angle = "100 deg"
points = { B = ["180 mm", "0 mm"] }

[[mechanism.joint]]
name = "crank bearing"
between = ["ground.O", "crank"]

[[mechanism.joint]]
name = "crank pin"
between = ["crank.A", "coupler"]

[[mechanism.joint]]
name = "coupler pin"
between = ["coupler.B", "rocker.B"]

[[mechanism.joint]]
name = "rocker bearing"
between = ["ground.C", "rocker"]

[[load]]
on = "rocker"
moment = "-6 N m"
"#;

/// A press without friction, with a counterbalance spring below its ram, moving freely.
pub(crate) fn balanced_press(spring: &str) -> String {
    let press = super::press_text();
    let mechanism = press.split("[[load]]").next().unwrap();
    format!(
        "{mechanism}\n{spring}\n[simulation]\nstart_angle = \"100 deg\"\nstart_speed = \"500 rpm\"\nduration = \"2 s\"\n\
         output_step = \"10 ms\"\ntorque = \"0 N m\"\ntolerance = 1e-12\n"
    )
}

/// The spring.
pub(crate) const COUNTERBALANCE: &str = r#"[[spring]]
name = "counterbalance"
between = ["slider", { on = "ground", at = ["400 mm", "0 mm"] }]
stiffness = "3 N/mm"
free_length = "330 mm"
"#;
