"""Options of the commands as keywords. Written by stubs.py from their help."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Literal, TypedDict

Option = str | float | Path | Sequence[str | float | Path] | None

class BalanceOptions(TypedDict, total=False):
    least: Literal['rms', 'peak', 'holding', 'inertia'] | None
    """Quantity to minimise."""
    counterweight: Option
    """A link that may carry a counterweight, its largest mass, and the largest distance of its parts from the origin of the link's frame, e.g. "crank, 20 kg, 250 mm"; may be repeated."""
    spring: Option
    """A `[[spring]]` of the machine file by its name: its ends are kept, its stiffness and free length are computed; may be repeated."""
    tolerance: Option
    """Relative error of the integrals over the cycle (RMS, mean, energy, losses), 1e-12 to 0.01."""
    steps: Option
    """Approximate least number of instants in a cycle; there are more where the torque bends."""
    units: Literal['si', 'imperial'] | None
    """Units in which quantities are printed: SI if not given. Files and options may have either."""

class CatalogueListOptions(TypedDict, total=False):
    units: Literal['si', 'imperial'] | None
    """Units in which quantities are printed: SI if not given. Files and options may have either."""
    catalogue: Option
    """Folder or file of motors, gearboxes, servo amplifiers and brake resistors to use instead of the built-in catalogue, in jred's own format or that of the Motor-Gearbox Database; may be repeated; "built-in" adds the built-in catalogue."""
    motors: Option
    """Motors from this CSV file instead of the built-in ones."""
    gearboxes: Option
    """Gearboxes from this CSV file instead of the built-in ones."""
    skip_broken_rows: bool
    """Skip rows of the catalogue that cannot be used, and report their number."""
    key: Option
    """Only parts whose key matches, e.g. "sgm7*"; may be repeated."""
    maker: Option
    """Only parts of matching makers; may be repeated."""

class CheckOptions(TypedDict, total=False):
    units: Literal['si', 'imperial'] | None
    """Units in which quantities are printed: SI if not given. Files and options may have either."""

class DriveOptions(TypedDict, total=False):
    units: Literal['si', 'imperial'] | None
    """Units in which quantities are printed: SI if not given. Files and options may have either."""
    catalogue: Option
    """Folder or file of motors, gearboxes, servo amplifiers and brake resistors to use instead of the built-in catalogue, in jred's own format or that of the Motor-Gearbox Database; may be repeated; "built-in" adds the built-in catalogue."""
    motors: Option
    """Motors from this CSV file instead of the built-in ones."""
    gearboxes: Option
    """Gearboxes from this CSV file instead of the built-in ones."""
    skip_broken_rows: bool
    """Skip rows of the catalogue that cannot be used, and report their number."""
    drive: Option
    """Drive instead of the best suitable one: MOTOR+GEARBOX (or MOTOR), or the name as printed."""
    maker: Option
    """Only the parameters of this maker: cia402, ax8000, sigma-7, akd or ax5000."""
    counts_per_turn: Option
    """Encoder counts in a turn of the motor."""
    bandwidth: Option
    """Bandwidth of the speed loop for its gain, e.g. "40 Hz"."""
    tolerance: Option
    """Relative error of the integrals over the cycle (RMS, mean, energy, losses), 1e-12 to 0.01."""
    steps: Option
    """Approximate least number of instants in a cycle; there are more where the torque bends."""
    report: Option
    """Write a report as one self-contained HTML page."""
    pdf: Option
    """Write the report as PDF. A browser prints it: the one named by the environment variable JRED_BROWSER, else Chromium, Chrome, Edge or Brave."""
    paper: Literal['a4', 'letter'] | None
    """Paper of the report: a4 if not given."""
    xlsx: Option
    """Write every table of the answer as a sheet of a workbook for spreadsheet programs."""

class ExportOptions(TypedDict, total=False):
    format: Literal['image', 'rust', 'c', 'st', 'plcopen', 'cia402', 'json'] | None
    """Form of the output."""
    type: Literal['f32', 'i32', 'i16'] | None
    """Number type of the table."""
    layout: Literal['auto', 'spline', 'spline16', 'cubic', 'quadratic', 'rows', 'harmonic', 'slider-crank'] | None
    """Layout of the curves in memory."""
    core: Literal['m0', 'm3', 'm4f', 'm7'] | None
    """Core that the firmware runs on: of the layouts that meet the torque error, one with the fewest instructions there is taken, unless --max-bytes or --layout is given."""
    forward: bool
    """The firmware also computes accelerations: forward dynamics, limits, governor. Tables in fixed point then have a curve of 1/J."""
    reciprocal: Literal['auto', 'yes', 'no'] | None
    """A curve of 1/J, which avoids the division in fixed-point forward dynamics; auto: with --forward."""
    torque_error: Option
    """Largest error of the drive torque at the drive link, e.g. "0.5 N m" ("5 N" for a sliding link); optional with --max-bytes."""
    omega: Option
    """Largest speed of the drive link, e.g. "90 rpm" ("0.2 m/s" for a sliding link); if not given, that of the motion."""
    alpha: Option
    """Largest acceleration of the drive link, e.g. "120 rad/s^2" ("3 m/s^2"); if not given, that of the motion, or omega^2 if the motion has none."""
    rotor_inertia: Option
    """Include this inertia of rotor and gearbox at the input of the drive train, e.g. "90 kg cm^2"."""
    max_cells: Option
    """Largest number of cells to try."""
    max_bytes: Option
    """Largest size of the image in bytes, including header and CRC. Without --torque-error: write the most accurate table of this size."""
    pieces: Option
    """A table for each piece of the range, for loads that begin and end steeply and mechanisms with corners: the positions where pieces meet, e.g. "60 deg, 75 deg" (of a turn: modulo 360 deg); or auto, for the edges of loads, of a disc cam's segments and of a Geneva drive's engagement. Not together with --max-bytes."""
    machine_id: Option
    """Identifier of the machine in the image, by which firmware refuses the image of another machine, e.g. 7 or 0x1a2b; if not given, the CRC-32 of the title."""
    name: Option
    """Name of the table in the program, for --format c, rust, st and plcopen: a prefix of the names in C, a module in Rust, the function block in a PLC; if not given, C and PLC use the name of the file to write."""
    rated_torque: Option
    """For --format cia402: the motor's rated torque as set in object 0x6076 of the drive, e.g. "4.2 N m"; torques are thousandths of it. If not given, that of --drive."""
    drive: Option
    """For --format cia402: the drive whose motor has the torque, MOTOR+GEARBOX, or MOTOR for a direct drive, with its inertia, losses and friction; if not given, the torque is that of the input of the machine."""
    counts_per_turn: Option
    """For --format cia402: increments of object 0x6064 in a turn of the shaft that has the torque, for a column of positions: the motor with --drive, else the input of the machine."""
    rows: Option
    """For --format cia402: number of rows, at equal times over the motion; 1001 if not given."""
    prove: bool
    """Prove the torque error over every position, by interval arithmetic, with all roundings of the ticks; takes some seconds. The image then contains the proven error. Exit code 1 if that is larger than --torque-error, or if it cannot be proven."""
    units: Literal['si', 'imperial'] | None
    """Units in which quantities are printed: SI if not given. Files and options may have either."""
    catalogue: Option
    """Folder or file of motors, gearboxes, servo amplifiers and brake resistors to use instead of the built-in catalogue, in jred's own format or that of the Motor-Gearbox Database; may be repeated; "built-in" adds the built-in catalogue."""
    motors: Option
    """Motors from this CSV file instead of the built-in ones."""
    gearboxes: Option
    """Gearboxes from this CSV file instead of the built-in ones."""
    skip_broken_rows: bool
    """Skip rows of the catalogue that cannot be used, and report their number."""

class FastestOptions(TypedDict, total=False):
    from_: Option
    """Position at which one move begins, e.g. "180 deg" ("20 mm" for a sliding link, and for an axis whose `[motion]` is in mm)."""
    to: Option
    """Position at which it ends."""
    from_speed: Option
    """Speed at its beginning, in the direction of the move; at rest if not given."""
    to_speed: Option
    """Speed at its end."""
    drive: Option
    """The drive: MOTOR+GEARBOX, or MOTOR for a direct drive; if not given, the best drive in the catalogue for the motion."""
    torque: Option
    """Instead of a drive: largest torque at the input of the drive train, e.g. "20 N m" ("500 N" for a linear motor)."""
    motor_speed: Option
    """Largest speed of that motor, e.g. "3000 rpm" ("2 m/s"); without a limit if not given."""
    rotor_inertia: Option
    """Inertia of its rotor, e.g. "2 kg cm^2"; zero if not given."""
    reserve: Option
    """Share of the motor's torque and of its largest speed that stays unused, e.g. "10 %"; "rules": the motion satisfies the rules of `jred size` for motor, gearbox and amplifier (`[rules]` of the file), the motor's heat with --max-rms or --max-winding-temperature; no reserve if not given."""
    max_speed: Option
    """Largest speed of the drive link, e.g. "90 rpm" ("0.2 m/s")."""
    max_tool_speed: Option
    """Largest speed of a point of the tool over a range of positions: a named point or a link, the speed, and two positions of the drive link, e.g. "slider, 60 mm/s, 300 deg, 360 deg" for a press that is slow through the work and fast elsewhere; may be repeated for several ranges."""
    max_reaction: Option
    """Largest force in a joint, e.g. "crank pin=2 kN"; `jred check` lists the joints; may be repeated for several joints."""
    max_acceleration: Option
    """Largest acceleration of the drive link while its speed grows, e.g. "120 rad/s^2" ("3 m/s^2")."""
    max_deceleration: Option
    """Largest deceleration; that of --max-acceleration if not given."""
    max_jerk: Option
    """Largest rate of the drive link's acceleration, e.g. "2000 rad/s^3" ("50 m/s^3"): the acceleration has no jumps, also at the ends."""
    max_torque_rate: Option
    """Largest rate of the motor's torque, e.g. "500 N m/s" ("5 kN/s" of a linear motor)."""
    ends: Literal['free', 'zero'] | None
    """Acceleration at the ends of the motion; zero with --max-jerk or --max-torque-rate, otherwise free."""
    max_rms: Option
    """Largest RMS torque over the motion with its pauses, e.g. "2 N m"; "s1": the motor's S1 torque at the mean speed, without the reserve of --reserve rules."""
    max_winding_temperature: Option
    """Highest temperature of the motor's winding when the motion with its pauses repeats endlessly, e.g. "120 degC": its mean and its ripple, from the thermal figures of the motor."""
    profile: Option
    """Write the motion to this file as a profile, times and positions, which `[motion]` of a machine file reads with type = "profile"."""
    cam: Option
    """Write the motion as the table of an electronic cam, over a master that makes one turn during the motion."""
    cam_form: Literal['csv', 'codesys', 'twincat', 'rockwell', 'siemens', 'sew', 'kollmorgen', 'lenze'] | None
    """Form of the cam table; names in it are that of the file."""
    rows: Option
    """Number of rows of the cam table; if not given 2001, or 721 with --cam-form sew or siemens, which take fewer as delivered."""
    master: Literal['deg', 'rad', 'turn'] | None
    """Unit of the cam table's master, which makes one turn during the motion; the derivatives are with respect to it."""
    report: Option
    """Write a report as one self-contained HTML page."""
    units: Literal['si', 'imperial'] | None
    """Units in which quantities are printed: SI if not given. Files and options may have either."""
    pdf: Option
    """Write the report as PDF. A browser prints it: the one named by the environment variable JRED_BROWSER, else Chromium, Chrome, Edge or Brave."""
    paper: Literal['a4', 'letter'] | None
    """Paper of the report: a4 if not given."""
    xlsx: Option
    """Write every table of the answer as a sheet of a workbook for spreadsheet programs."""
    plan: Option
    """Write the motion of the drive link as a plan that firmware follows (docs/table-image.md): Rust source if the name ends in .rs, source of C and C++ if in .h, .hh, .hpp, .hxx, .c, .cc, .cpp or .cxx, a binary image if in .jred, .bin, .img or .dat."""
    plan_error: Option
    """Largest error of the plan as a share of the greatest speed and acceleration; for the position a tenth of this share of the distance."""
    instants: Option
    """Number of instants in the list of CSV and JSON."""
    catalogue: Option
    """Folder or file of motors, gearboxes, servo amplifiers and brake resistors to use instead of the built-in catalogue, in jred's own format or that of the Motor-Gearbox Database; may be repeated; "built-in" adds the built-in catalogue."""
    motors: Option
    """Motors from this CSV file instead of the built-in ones."""
    gearboxes: Option
    """Gearboxes from this CSV file instead of the built-in ones."""
    skip_broken_rows: bool
    """Skip rows of the catalogue that cannot be used, and report their number."""
    rules: Option
    """Rule set instead of that in the machine file: a name from `jred rules`, or a file; other entries of `[rules]` still apply."""
    steps: Option
    """Approximate least number of instants in a cycle; there are more where the torque bends."""

class GentlestOptions(TypedDict, total=False):
    objective: Literal['rms', 'energy', 'peak'] | None
    """Quantity to minimise."""
    ends: Literal['free', 'zero'] | None
    """Acceleration at the ends of a move."""
    ramp: Option
    """With --ends zero: share of a move's time in which the acceleration rises to its first peak, e.g. "5 %"; 10 % if not given."""
    profile: Option
    """Write the motion to this file as a profile, times and positions, which `[motion]` of a machine file reads with type = "profile"."""
    cam: Option
    """Write the motion as the table of an electronic cam, over a master that makes one turn during the motion."""
    cam_form: Literal['csv', 'codesys', 'twincat', 'rockwell', 'siemens', 'sew', 'kollmorgen', 'lenze'] | None
    """Form of the cam table; names in it are that of the file."""
    rows: Option
    """Number of rows of the cam table; if not given 2001, or 721 with --cam-form sew or siemens, which take fewer as delivered."""
    master: Literal['deg', 'rad', 'turn'] | None
    """Unit of the cam table's master, which makes one turn during the motion; the derivatives are with respect to it."""
    report: Option
    """Write a report as one self-contained HTML page."""
    pdf: Option
    """Write the report as PDF. A browser prints it: the one named by the environment variable JRED_BROWSER, else Chromium, Chrome, Edge or Brave."""
    paper: Literal['a4', 'letter'] | None
    """Paper of the report: a4 if not given."""
    xlsx: Option
    """Write every table of the answer as a sheet of a workbook for spreadsheet programs."""
    plan: Option
    """Write the motion of the drive link as a plan that firmware follows (docs/table-image.md): Rust source if the name ends in .rs, source of C and C++ if in .h, .hh, .hpp, .hxx, .c, .cc, .cpp or .cxx, a binary image if in .jred, .bin, .img or .dat."""
    plan_error: Option
    """Largest error of the plan as a share of the greatest speed and acceleration; for the position a tenth of this share of the distance."""
    tolerance: Option
    """Relative error of the integrals over the cycle (RMS, mean, energy, losses), 1e-12 to 0.01."""
    steps: Option
    """Approximate least number of instants in a cycle; there are more where the torque bends."""
    drive: Option
    """The drive: MOTOR+GEARBOX, or MOTOR for a direct drive; if not given, the torque is at the input of the drive train."""
    units: Literal['si', 'imperial'] | None
    """Units in which quantities are printed: SI if not given. Files and options may have either."""
    catalogue: Option
    """Folder or file of motors, gearboxes, servo amplifiers and brake resistors to use instead of the built-in catalogue, in jred's own format or that of the Motor-Gearbox Database; may be repeated; "built-in" adds the built-in catalogue."""
    motors: Option
    """Motors from this CSV file instead of the built-in ones."""
    gearboxes: Option
    """Gearboxes from this CSV file instead of the built-in ones."""
    skip_broken_rows: bool
    """Skip rows of the catalogue that cannot be used, and report their number."""

class RequireOptions(TypedDict, total=False):
    ratios: Option
    """Gear ratios, e.g. "7, 10, 25"; 1 is direct coupling. A comma separates two ratios; with semicolons between them, "3,5; 7,5", it is a decimal sign. If not given: the usual ratios of planetary gearboxes in the range of --within."""
    within: Option
    """Only the usual ratios in this range, e.g. "3..10"; a direct drive has 1."""
    max_speed: Option
    """Largest speed of the motor for the usual ratios, e.g. "4500 rpm": 6000 rpm if not given."""
    efficiency: Option
    """Efficiency of the gearbox, above 0 to 1."""
    gearbox_inertia: Option
    """Inertia of the gearbox at its input, e.g. "0.5 kg cm^2"; zero if not given."""
    allowance: Option
    """S1 torque above the least possible, e.g. 20%: the more, the wider is the window of rotor inertias."""
    rules: Option
    """Rule set instead of that in the machine file: a name from `jred rules`, or a file; other entries of `[rules]` still apply."""
    steps: Option
    """Approximate least number of instants in a cycle; there are more where the torque bends."""
    tolerance: Option
    """Relative error of the integrals over the cycle (RMS, mean, energy, losses), 1e-12 to 0.01."""
    report: Option
    """Write a report as one self-contained HTML page."""
    pdf: Option
    """Write the report as PDF. A browser prints it: the one named by the environment variable JRED_BROWSER, else Chromium, Chrome, Edge or Brave."""
    paper: Literal['a4', 'letter'] | None
    """Paper of the report: a4 if not given."""
    xlsx: Option
    """Write every table of the answer as a sheet of a workbook for spreadsheet programs."""
    units: Literal['si', 'imperial'] | None
    """Units in which quantities are printed: SI if not given. Files and options may have either."""

class SensitivityOptions(TypedDict, total=False):
    drive: Option
    """The drive: MOTOR+GEARBOX, or MOTOR for a direct drive; if not given, the best drive in the catalogue."""
    change: Option
    """Step of the finite differences (%)."""
    most: Option
    """Largest change of each quantity in search of the first violation (%)."""
    units: Literal['si', 'imperial'] | None
    """Units in which quantities are printed: SI if not given. Files and options may have either."""
    catalogue: Option
    """Folder or file of motors, gearboxes, servo amplifiers and brake resistors to use instead of the built-in catalogue, in jred's own format or that of the Motor-Gearbox Database; may be repeated; "built-in" adds the built-in catalogue."""
    motors: Option
    """Motors from this CSV file instead of the built-in ones."""
    gearboxes: Option
    """Gearboxes from this CSV file instead of the built-in ones."""
    skip_broken_rows: bool
    """Skip rows of the catalogue that cannot be used, and report their number."""
    rules: Option
    """Rule set instead of that in the machine file: a name from `jred rules`, or a file; other entries of `[rules]` still apply."""
    steps: Option
    """Approximate least number of instants in a cycle; there are more where the torque bends."""
    tolerance: Option
    """Relative error of the integrals over the cycle (RMS, mean, energy, losses), 1e-12 to 0.01."""
    rank: Literal['power', 'mass', 'price', 'energy', 'margin', 'temperature'] | None
    """Rank by this instead of the smallest motor first."""
    maker: Option
    """Only motors and gearboxes of matching makers; may be repeated."""
    motor: Option
    """Only motors whose key matches, e.g. "sgmsh-*"; may be repeated."""
    gearbox: Option
    """Only gearboxes whose key matches; may be repeated."""
    ratio: Option
    """Only ratios in this range, e.g. "3..10"; a direct drive has 1."""
    direct_only: bool
    """Only direct drives (no gearbox)."""
    max_mass: Option
    """Only drives up to this mass, e.g. "12 kg"."""
    max_price: Option
    """Only drives up to this price, in the currency of the catalogue."""

class SimulateOptions(TypedDict, total=False):
    phase: Option
    """Lead of a further machine's drive link over that start, e.g. "180 deg"; one for each of them, in order."""
    drive: Option
    """The drive instead of the motor in `[simulation]`: MOTOR+GEARBOX, or MOTOR for a direct drive. Without a controller it gives its full torque."""
    to_speed: Option
    """Report when the drive link, or the axis, first reaches this speed, e.g. "120 rpm", in either direction."""
    stops: Option
    """Switch the motor off at this many instants over the last cycle before the `stop` of the file, and report the longest distance and time to rest."""
    torques: bool
    """Add columns of the parts of the drive torque: acceleration, change of the inertia, weight and springs, process loads, viscous and dry friction."""
    points: bool
    """Add columns of every named point, centre of mass and link: positions, transfer functions, velocities and accelerations."""
    reactions: bool
    """Add columns of drive torque, joint forces, shaking force and moment by d'Alembert's principle."""
    units: Literal['si', 'imperial'] | None
    """Units in which quantities are printed: SI if not given. Files and options may have either."""
    catalogue: Option
    """Folder or file of motors, gearboxes, servo amplifiers and brake resistors to use instead of the built-in catalogue, in jred's own format or that of the Motor-Gearbox Database; may be repeated; "built-in" adds the built-in catalogue."""
    motors: Option
    """Motors from this CSV file instead of the built-in ones."""
    gearboxes: Option
    """Gearboxes from this CSV file instead of the built-in ones."""
    skip_broken_rows: bool
    """Skip rows of the catalogue that cannot be used, and report their number."""
    report: Option
    """Write a report as one self-contained HTML page."""
    pdf: Option
    """Write the report as PDF. A browser prints it: the one named by the environment variable JRED_BROWSER, else Chromium, Chrome, Edge or Brave."""
    paper: Literal['a4', 'letter'] | None
    """Paper of the report: a4 if not given."""
    xlsx: Option
    """Write every table of the answer as a sheet of a workbook for spreadsheet programs."""

class SizeOptions(TypedDict, total=False):
    units: Literal['si', 'imperial'] | None
    """Units in which quantities are printed: SI if not given. Files and options may have either."""
    catalogue: Option
    """Folder or file of motors, gearboxes, servo amplifiers and brake resistors to use instead of the built-in catalogue, in jred's own format or that of the Motor-Gearbox Database; may be repeated; "built-in" adds the built-in catalogue."""
    motors: Option
    """Motors from this CSV file instead of the built-in ones."""
    gearboxes: Option
    """Gearboxes from this CSV file instead of the built-in ones."""
    skip_broken_rows: bool
    """Skip rows of the catalogue that cannot be used, and report their number."""
    rules: Option
    """Rule set instead of that in the machine file: a name from `jred rules`, or a file; other entries of `[rules]` still apply."""
    steps: Option
    """Approximate least number of instants in a cycle; there are more where the torque bends."""
    tolerance: Option
    """Relative error of the integrals over the cycle (RMS, mean, energy, losses), 1e-12 to 0.01."""
    motion: Literal['own', 'best'] | None
    """Which motion the drives are judged with."""
    pareto: Option
    """Instead of the ranking: list the Pareto front over two or three of power, mass, price, energy, margin and temperature, e.g. "mass,energy"."""
    rank: Literal['power', 'mass', 'price', 'energy', 'margin', 'temperature'] | None
    """Rank by this instead of the smallest motor first."""
    maker: Option
    """Only motors and gearboxes of matching makers; may be repeated."""
    motor: Option
    """Only motors whose key matches, e.g. "sgmsh-*"; may be repeated."""
    gearbox: Option
    """Only gearboxes whose key matches; may be repeated."""
    ratio: Option
    """Only ratios in this range, e.g. "3..10"; a direct drive has 1."""
    direct_only: bool
    """Only direct drives (no gearbox)."""
    max_mass: Option
    """Only drives up to this mass, e.g. "12 kg"."""
    max_price: Option
    """Only drives up to this price, in the currency of the catalogue."""
    drive: Option
    """Judge this drive alone: MOTOR+GEARBOX, or MOTOR for a direct drive, followed by " on AMPLIFIER" if there are several."""
    all_gearboxes: bool
    """List every gearbox and amplifier of a motor instead of the first."""
    full: bool
    """Print the duty, every rule with figure, limit and margin, what is not checked, and the ranking below the first screen."""
    top: Option
    """Number of motors to rank, each with its first gearbox and amplifier, or of drives with --all-gearboxes: 10 if not given. In CSV and JSON the closest refused drives follow, which --nearest 0 leaves out."""
    nearest: Option
    """Number of refused drives to list in CSV and JSON and to explain with --explain, closest first."""
    refused: bool
    """List every refused drive with its reasons."""
    all: bool
    """List every drive, ranked or refused."""
    explain: bool
    """Explain the best drive: contributions to its torque and inertia, how far gear ratio, cycle time, moving masses and process loads may change, and what would make the closest refused drives suitable."""
    why: Option
    """Show and explain this drive instead of the best one, and the reason for its rank: MOTOR+GEARBOX, or MOTOR for a direct drive, followed by " on AMPLIFIER" if there are several, or the name as printed. In CSV its rows come first and are not repeated."""
    meter: Option
    """Write the limits of the best drive, or of the drive of --why, for the duty meter in the firmware as Rust source (docs/duty-meter.md)."""
    report: Option
    """Write a report as one self-contained HTML page."""
    pdf: Option
    """Write the report as PDF. A browser prints it: the one named by the environment variable JRED_BROWSER, else Chromium, Chrome, Edge or Brave."""
    paper: Literal['a4', 'letter'] | None
    """Paper of the report: a4 if not given."""
    xlsx: Option
    """Write every table of the answer as a sheet of a workbook for spreadsheet programs."""

class SteadyOptions(TypedDict, total=False):
    phase: Option
    """Lead of a further machine's drive link over the start in its `[simulation]`, e.g. "180 deg"; one for each of them, in order."""
    delta: Option
    """Coefficient of speed fluctuation that a flywheel is to reach, e.g. 0.02 or 2%: find its inertia."""
    torque: Option
    """Constant torque of the motor instead of that in `[simulation]`, e.g. "20 N m"."""
    mean_speed: Option
    """Mean speed of the drive link over the time, e.g. "300 rpm": find the size of the motor torque for it, or a constant torque if `[simulation]` gives no motor. A torque below zero brakes a machine that the process drives. A negative speed turns the machine backwards."""
    scale: Option
    """Find the size of the loads of this name for that mean speed, with the motor unchanged."""
    turns: Option
    """Turns of the drive link in a cycle; as many as the loads need, if not given."""
    positions: Option
    """Number of positions in the list for each turn; the list ends with the end of the cycle."""
    report: Option
    """Write a report as one self-contained HTML page."""
    pdf: Option
    """Write the report as PDF. A browser prints it: the one named by the environment variable JRED_BROWSER, else Chromium, Chrome, Edge or Brave."""
    paper: Literal['a4', 'letter'] | None
    """Paper of the report: a4 if not given."""
    xlsx: Option
    """Write every table of the answer as a sheet of a workbook for spreadsheet programs."""
    units: Literal['si', 'imperial'] | None
    """Units in which quantities are printed: SI if not given. Files and options may have either."""
