//! `[simulation]`.

use super::inner;
use crate::text::key::{ValueForm, KEEP_ONE, ValueRange, POSITION, KeyTable, key, may, of_axis, quantity};
use crate::units::kind::{
    ANGLE, ANGULAR_SPEED, FORCE, GAIN, INDUCTANCE, INERTIA, LENGTH, MASS, POWER, RESISTANCE, SHARE, TIME, TORQUE, TORQUE_CONSTANT, VELOCITY, VISCOUS_FORCE, VISCOUS_MOMENT, VOLTAGE,
};

const POINTS: [usize; 2] = [1, 1000];
const ANY_SPEED: ValueForm = ValueForm::Any(&[quantity(&ANGULAR_SPEED), quantity(&VELOCITY)]);
const ANY_POSITION: ValueForm = ValueForm::Any(&[quantity(&ANGLE), quantity(&LENGTH)]);

static CONTROL: KeyTable = KeyTable::of("control", &[&[
    key("speed_gain", ValueForm::Quantity([&VISCOUS_MOMENT, &VISCOUS_FORCE], ValueRange::Positive), "K at the motor shaft, `\"4 N m s/rad\"` (`\"20 N s/m\"` of a linear motor)"),
    may("integral_time", quantity(&TIME).positive(), "t_i (no integral); at the limit the integral stops growing"),
    may("position_gain", quantity(&GAIN).not_negative(), "K_v, `\"20 1/s\"`; with 0 only the speed is controlled").or("0"),
    may("feed_forward", ValueForm::Words(&["none", "mean-inertia", "model"]), "T_ff").or("none"),
]]);

pub(crate) static SIMULATION: KeyTable = KeyTable::of("simulation", &[&[
    may("start_angle", of_axis(POSITION), "φ at the start; required, except under a controller"),
    may("start_position", of_axis(POSITION), "instead: of a drive link that slides, or of the axis that `of` names"),
    may("start_speed", ANY_SPEED, "ω of the drive link at the start").or("0"),
    key("duration", quantity(&TIME).positive(), ""),
    key("output_step", quantity(&TIME).positive(), "between output points, 1 to 100000 in `duration`"),
    may("torque", quantity(&TORQUE), "motor: a constant torque"),
    may("torque_speed", ValueForm::List(&ValueForm::Tuple(&[quantity(&ANGULAR_SPEED), quantity(&TORQUE)]), POINTS), "motor: straight lines through points `[speed, torque]`, speeds rising; constant beyond"),
    may("force", quantity(&FORCE), "of a linear motor or a drive link that slides: a constant force"),
    may("force_speed", ValueForm::List(&ValueForm::Tuple(&[quantity(&VELOCITY), quantity(&FORCE)]), POINTS), "the same over the speed, `[speed, force]`"),
    may("dc_motor", inner!(&[
        may("no_load_speed", quantity(&ANGULAR_SPEED), "motor: by no-load speed and stall torque"),
        may("stall_torque", quantity(&TORQUE), "motor: by no-load speed and stall torque"),
        may("voltage", quantity(&VOLTAGE), "motor: by its winding"),
        may("resistance", quantity(&RESISTANCE).positive(), "motor: by its winding"),
        may("torque_constant", quantity(&TORQUE_CONSTANT).positive(), "motor: by its winding"),
        may("inductance", quantity(&INDUCTANCE).positive(), "motor: by its winding (without a time constant)"),
    ]), ""),
    may("induction_motor", ValueForm::Table(&KeyTable::of("", &[&[
        key("synchronous_speed", quantity(&ANGULAR_SPEED), "motor: by Kloss's formula"),
        key("breakdown_torque", quantity(&TORQUE), "motor: by Kloss's formula"),
        may("breakdown_slip", quantity(&SHARE), "> 0, ≤ 100 %"),
        may("rated_speed", quantity(&ANGULAR_SPEED), "of the name plate, instead of the slip"),
        may("rated_power", quantity(&POWER), "of the name plate, with the rated speed"),
        may("rated_torque", quantity(&TORQUE), "of the name plate, instead of the rated power"),
    ]]).either(&[
        (&["breakdown_slip", "rated_speed"], "keep `breakdown_slip`, or `rated_speed` with `rated_torque` or `rated_power`"),
        (&["rated_torque", "rated_power"], KEEP_ONE),
    ])), ""),
    may("at", ValueForm::Words(&["motor", "crank", "drive-link"]), "whose torque and speed; crank is a drive link that turns").or("motor"),
    may("rotor_inertia", quantity(&INERTIA).not_negative(), "at the motor shaft").or("0"),
    may("motor_mass", quantity(&MASS).not_negative(), "instead, of a linear motor: its moving mass").or("0"),
    may("tolerance", ValueForm::Number([1e-13, 1e-3]), "relative, of the integrator").or("1e-12").such_as("1e-12"),
    may("control", ValueForm::Table(&CONTROL), "[controller](#controller-stop-end-stops)"),
    may("stop", inner!(&[
        key("time", quantity(&TIME).not_negative(), "at which the motor is [switched off](#controller-stop-end-stops)"),
        may("brake_torque", quantity(&TORQUE).not_negative(), "at the motor shaft").or("0"),
        may("brake_force", quantity(&FORCE).not_negative(), "instead, of a linear motor").or("0"),
        may("brake_delay", quantity(&TIME).not_negative(), "after which the brake closes").or("0"),
    ]), ""),
    may("end_stops", inner!(&[
        key("at", ValueForm::List(&ANY_POSITION, [2, 2]), "lower and upper [stop](#controller-stop-end-stops)"),
        may("restitution", ValueForm::Number([0.0, 0.99]), "speed after an impact over speed before").or("0").such_as("0.3"),
    ]), ""),
]]).either(&[
    (&["start_angle", "start_position"], KEEP_ONE),
    (&["torque", "torque_speed", "dc_motor", "induction_motor"], KEEP_ONE),
    (&["force", "force_speed"], KEEP_ONE),
]);

