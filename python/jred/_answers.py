"""Answers of the commands, with every figure as an attribute. Written by stubs.py from docs/schemas."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal, TypeAlias

from ._result import Item, Result

class BalanceFiguresData(Item):
    least: float
    """The value of the quantity that is least."""
    drive_link: BalanceRmsAndPeak | None
    """Torque (N·m) or force (N) at the drive link over the motion."""
    input: BalanceRmsAndPeak | None
    """Torque (N·m) or force (N) at the input of the drive train over the motion."""
    holding: BalanceRmsAndPeak
    """Torque (N·m) or force (N) that holds the machine at rest, over its range."""
    inertia: BalanceInertiaData
    """Reduced inertia (kg·m²) or mass (kg) of the mechanism."""

class BalanceRmsAndPeak(Item):
    rms: float
    """Root of the mean square."""
    peak: float
    """Largest magnitude."""

class BalanceInertiaData(Item):
    min: float
    """Least."""
    mean: float
    """Mean over the range."""
    max: float
    """Largest."""
    rms_deviation: float
    """RMS deviation from the mean."""

class BalanceCounterweightData(Item):
    on: str
    """Link that carries it."""
    most: float
    """Largest permitted mass (kg)."""
    reach: float
    """Largest permitted distance from the origin of the link's frame (m)."""
    found: BalanceMassData | None
    """The counterweight; none: no counterweight is best."""

class BalanceMassData(Item):
    at: tuple[float, float]
    """Position of its centre in the link's frame (m)."""
    mass: float
    """Mass (kg)."""
    inertia: float
    """Inertia about its centre (kg·m²)."""

class BalanceSpringData(Item):
    name: str | None
    """Name of the spring in the machine file."""
    found: BalanceRateData | None
    """Its data; none: no spring is best."""

class BalanceRateData(Item):
    stiffness: float
    """Stiffness (N/m, or N·m/rad)."""
    free_length: float | None
    """Free length (m)."""
    free_angle: float | None
    """Free angle (rad)."""
    pull: float
    """Largest pull (N, or N·m)."""
    push: float
    """Largest push (N, or N·m)."""

class Balance(Result):
    """The JSON of `jred balance` (SI units)."""
    schema: Literal['jred-balance/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    least: str
    """The quantity that is least: rms, peak, holding or inertia."""
    before: BalanceFiguresData
    """Figures of the machine as it is."""
    after: BalanceFiguresData
    """Figures with counterweights and springs."""
    bound: float
    """Lower bound of the least value within the bounds (N·m, N, kg·m² or kg)."""
    warnings: tuple[str, ...]
    """Disadvantages of the result."""
    counterweights: tuple[BalanceCounterweightData, ...]
    """The counterweights."""
    springs: tuple[BalanceSpringData, ...]
    """The springs."""

class BusAxisData(Item):
    title: str
    """Title of the machine."""
    drive: str
    """Name of the drive."""
    period: float
    """[s]. Duration of its cycle."""
    drawn: float
    """[J]. Energy that it draws in a cycle."""
    fed_back: float
    """[J]. Energy that it feeds back in a cycle."""
    peak_drawn: float
    """[W]. Largest power drawn."""
    peak_fed_back: float
    """[W]. Largest power fed back."""

class BusCommonData(Item):
    kind: str
    """searched, too long, or none."""
    period: float | None
    """[s]. The common period."""
    cycles: tuple[int, ...] | None
    """Cycles of each axis in it."""
    most_cycles: int
    """The most cycles that are searched."""

class BusBusFigures(Item):
    """Result for one period in the steady state."""
    supplied: float | None
    """[J]. Energy from the supply (J); NaN if the voltage is unbounded."""
    returned: float
    """[J]. Energy that the supply takes back (J)."""
    burnt: float
    """[J]. Energy that the brake resistor turns into heat (J)."""
    resistor_peak: float
    """[W]. Its largest power (W)."""
    resistor_pulse: float
    """[J]. Its largest energy without a pause (J); if it never pauses, its energy per period."""
    highest_voltage: float | None
    """[V]. Highest voltage (V); infinite if unbounded."""
    stored_at_the_start: float | None
    """[J]. Energy stored at the start of a period above that at U₀ (J)."""

class BusWorstData(Item):
    voltage: BusWorstPhases
    """Phases with the highest voltage."""
    resistor: BusWorstPhases
    """Phases with the highest mean power of the brake resistor."""
    peak: BusWorstPhases
    """Phases with its highest peak power."""
    pulse: BusWorstPhases
    """Phases with its largest pulse."""
    exhaustive: bool
    """Whether no worse phases exist."""

class BusWorstPhases(Item):
    """Phases found by a search."""
    phases: tuple[float, ...]
    """[s]. Delay of each axis relative to the first (s)."""
    figures: BusBusFigures
    """Result for the bus over the common period."""

class BusBounds(Item):
    """Bounds that are valid for any phases and periods."""
    peak_drawn: float
    """[W]. Largest power drawn (W): the sum of the axes' largest powers. It is reached."""
    peak_fed_back: float
    """[W]. Largest power fed back (W): the sum of the axes' largest values, of the cycles or of the stops. It is reached if all axes feed back."""
    highest_voltage: float | None
    """[V]. Highest voltage (V)."""
    resistor_mean: float
    """[W]. Mean power of a brake resistor (W): all regenerated energy."""

class BusMissingFigures(Item):
    mean: float | None
    """[W]."""
    peak: float | None
    """[W]."""
    pulse: float | None
    """[J]."""
    resistance: float | None
    """[Ohm]."""

class BusNeed(Item):
    """Requirements for a brake resistor that by itself limits the bus to the chopper voltage."""
    mean: float
    """[W]. Mean power (W)."""
    peak: float
    """[W]. Largest power (W)."""
    pulse: float | None
    """[J]. Largest energy without a pause (J); NaN: not known."""
    largest_resistance: float
    """[Ohm]. Largest resistance that takes that power at the chopper's voltage (Ω)."""
    smallest_resistance: float | None
    """[Ohm]. Smallest resistance that the chopper may switch (Ω)."""

class BusConflict(Item):
    any_of: tuple[str, ...]
    """Keys of `[supply]`, any one of which resolves it."""
    words: str
    """The reason."""

class BusCheckRow(Item):
    check: str
    """Name."""
    value: float | None
    """Value, in `unit`; none: unbounded or unknown."""
    limit: float | None
    """Limit, in `unit`."""
    at_least: bool
    """Whether the value must be at least the limit; otherwise at most."""
    unit: str
    """Unit."""

class BusUnknownFigure(Item):
    figure: str
    """The figure."""
    any_of: tuple[tuple[str, ...], ...]
    """Lists of keys of `[supply]`: all keys of any one list give it."""

class BusCureData(Item):
    changes: tuple[BusChangeData, ...]
    """Keys to change, all of them."""
    phases: tuple[float, ...] | None
    """[s]. Phases of the axes with this cure."""
    words: str
    """The cure in words."""

class BusChangeData(Item):
    key: str
    """Key of `[supply]`."""
    at_least: float | None
    """Least value."""
    at_most: float | None
    """Largest value."""
    unit: str
    """Unit."""

class Bus(Result):
    """The JSON of `jred bus`; units are in the names."""
    schema: Literal['jred-bus/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    axes: tuple[BusAxisData, ...]
    """The axes."""
    period: float | None
    """[s]. The common period; none: none is searched."""
    common_period: BusCommonData
    """The search for a common period."""
    in_step: BusBusFigures | None
    """All axes in step."""
    worst: BusWorstData | None
    """The worst phases."""
    most_room: BusWorstPhases | None
    """The phases that leave most room."""
    bounds: BusBounds
    """Bounds for any phases."""
    saved_by_sharing: float | None
    """[W]. Mean power that one bus saves over a bus for each axis."""
    brake_resistor_lacks: BusMissingFigures
    """The shortage of the brake resistor."""
    brake_resistor_needed: BusNeed | None
    """The brake resistor that is needed."""
    proposal: str | None
    """A brake resistor of the catalogue that is suitable."""
    brake_resistor_chosen: str | None
    """The brake resistor chosen from the catalogue."""
    conflict: BusConflict | None
    """Why no brake resistor can work."""
    checks: tuple[BusCheckRow, ...]
    """The checks."""
    not_checked: tuple[str, ...]
    """Checks without data."""
    not_known: tuple[BusUnknownFigure, ...]
    """Data that are missing."""
    cures: tuple[BusCureData, ...]
    """Changes, any one of which is sufficient."""

class CheckJointFinding(Item):
    """One joint."""
    name: str
    """Its name."""
    kind: str
    """Pin, guide, and so on."""
    bodies: tuple[str, str]
    """The two bodies: the first acts on the second."""
    constraints: int
    """Degrees of freedom that it removes."""
    driven: bool
    """Whether the drive moves it."""

CheckRange: TypeAlias = "Literal['turn'] | tuple[float, float]"

class CheckTravel(Item):
    """Motion of one link on the ground."""
    link: str
    """Name of the link."""
    way: CheckTravelKind
    """How it moves."""
    stroke: float
    """Stroke, swing, or advance over a turn of the drive (m or rad)."""
    back: float
    """Distance that an advancing or turning link moves backwards during a turn of the drive (m or rad)."""
    dead_centres: tuple[tuple[float, float], ...]
    """Dead centres: position of the drive link (rad or m), and the link's own there (m or rad)."""
    dwells: tuple[tuple[float, float], ...]
    """Dwells: start and end (rad or m of the drive link)."""

CheckTravelKind: TypeAlias = "Literal['advances'] | Literal['slides'] | Literal['swings'] | Literal['turns']"

class CheckTransmission(Item):
    """The smallest transmission index."""
    index: float
    """The index, 0 (dead point) to 1."""
    angle: float | None
    """[deg]. The transmission angle of a dyad with this index (deg); `None` for a contact or a mesh."""
    at: float | None
    """Position of the drive link (rad or m); `None` if the index is the same everywhere."""
    links: tuple[str, ...]
    """The links of the group."""
    branch_kept: bool
    """Whether the determinant of every group keeps its sign, and so its branch."""

class CheckInertia(Item):
    """The moving masses."""
    reduced: tuple[float, float, float]
    """J_red (or m_red): smallest, mean over the range, largest, including flywheel and drive train."""
    laden: tuple[float, float, float] | None
    """The same over the time of the motion, with the payloads and carriages of each instant; `None` without these."""
    flywheel: float
    """Flywheel and drive train, included above."""
    mass: float
    """Mass of all links (kg)."""

class CheckAgreement(Item):
    """Agreement of the two methods, for the machine with its drive train."""
    dalembert: float
    """Largest difference of the two drive torques as a share of their largest term."""
    of_motion: bool
    """Whether it is computed at the states of the motion, or else at unit speed and acceleration."""
    energy: float | None
    """|work of the drive + work of loads and losses − gain of energy| as a share of the energy exchanged by the drive. The
work is that of the forces by d'Alembert."""

class CheckMotionFindings(Item):
    """The motion in figures (SI)."""
    of: str
    """The prescribed coordinate: "drive link", or a coordinate of the tool."""
    cyclic: bool
    """Whether it repeats."""
    duration: float
    """[s]. Duration (s)."""
    advance: float
    """Advance of the drive link (rad, or m)."""
    speed: float
    """The drive link's largest speed (per s)."""
    acceleration: float
    """The drive link's largest acceleration (per s²)."""
    segments: tuple[CheckSegmentFinding, ...]
    """Its segments."""

class CheckSegmentFinding(Item):
    """One segment (SI)."""
    angle: bool
    """Whether it prescribes an angle."""
    of_the_drive_link: bool
    """Whether it prescribes the drive link, not the tool."""
    duration: float
    """[s]. Duration (s)."""
    distance: float
    """Distance (rad, or m)."""
    speed: float
    """Largest speed (per s)."""
    acceleration: float
    """Largest acceleration (per s²)."""
    jerk: float | None
    """Largest jerk (per s³); `None` if the acceleration jumps."""
    coefficients: tuple[float | None, float | None, float | None, float | None] | None
    """C_v, C_a, C_j and C_Mdyn; `None` for a dwell."""

class CheckFact(Item):
    """A property of one kind of mechanism, such as the largest pressure angle of a cam."""
    label: str
    """Its name."""
    text: str
    """The figure, its unit and position."""

class Check(Result):
    """The JSON of `jred check` (SI units)."""
    schema: Literal['jred-check/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    mechanism: str
    """Kind of the mechanism."""
    drive_coordinate: str
    """Coordinate of the drive link."""
    degrees_of_freedom: int
    """Degrees of freedom: 3·links − constraints."""
    links: int
    """Number of moving links."""
    constraints: int
    """Number of constraints."""
    joints: tuple[CheckJointFinding, ...]
    """The joints."""
    range: CheckRange
    """Range of the drive link."""
    closure: float | None
    """Difference of the links' speeds after a turn, as a share; none for a stroke."""
    travels: tuple[CheckTravel, ...]
    """Travels of the links."""
    transmission: CheckTransmission | None
    """The smallest transmission index; none without a group of links."""
    inertia: CheckInertia
    """Inertia."""
    agreement: CheckAgreement
    """Agreement of independent methods."""
    motion: CheckMotionFindings | None
    """The motion; none without one."""
    facts: tuple[CheckFact, ...]
    """Figures of its kind."""
    notes: tuple[str, ...]
    """Remarks."""
    warnings: tuple[str, ...]
    """Possible mistakes in the machine file."""
    violations: tuple[str, ...]
    """Violated checks; empty: every check is satisfied."""

class DriveFigure(Item):
    """A figure that a drive asks for."""
    setting: DriveSetting
    """The figure."""
    name: str
    """Its name."""
    value: float | None
    """Its value in SI; null if it is not given."""
    remark: str
    """Where to read a value that is not given, or the part that sets a limit."""

DriveSetting: TypeAlias = "Literal['bandwidth'] | Literal['brake-closing'] | Literal['brake-opening'] | Literal['coulomb-friction'] | Literal['counts-per-turn'] | Literal['current-limit'] | Literal['cycle-peak-speed'] | Literal['cycle-peak-torque'] | Literal['cycle-rms-torque'] | Literal['direction'] | Literal['inertia-ratio'] | Literal['integral-time'] | Literal['largest-load-inertia'] | Literal['largest-position'] | Literal['least-load-inertia'] | Literal['least-position'] | Literal['load-inertia'] | Literal['motor-time'] | Literal['motor-turns'] | Literal['peak-current'] | Literal['peak-torque'] | Literal['position-gain'] | Literal['rated-current'] | Literal['rated-torque'] | Literal['resistance'] | Literal['resistor-power'] | Literal['rotor-inertia'] | Literal['shaft-turns'] | Literal['speed-gain'] | Literal['speed-limit'] | Literal['standstill-current'] | Literal['standstill-torque'] | Literal['torque-constant'] | Literal['torque-limit'] | Literal['total-inertia'] | Literal['viscous-friction'] | Literal['weight-torque'] | Literal['winding-time']"

class DriveMaker(Item):
    """A maker of drives, or a profile."""
    key: str
    """Word of the maker on the command line."""
    name: str
    """Name of the maker or profile."""
    source: str
    """Source of names, units and ranges."""
    parameters: tuple[DriveParameter, ...]
    """The parameters."""

class DriveParameter(Item):
    """A parameter: as the table gives it, and with its value for a drive."""
    number: str
    """Number, as the maker writes it."""
    name: str
    """Name."""
    value: float | None
    """Value as typed; null if it is not given or beyond the range."""
    unit: str
    """Unit of the value."""
    range: str
    """Range of the parameter as text, empty if it is not known."""
    remark: str
    """Where to read a value that is not given, the fault of one beyond the range, or the part that sets a limit."""

class Drive(Result):
    """The JSON of `jred drive`."""
    schema: Literal['jred-drive/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    drive: str
    """Name of the drive."""
    figures: tuple[DriveFigure, ...]
    """The figures at the motor shaft."""
    makers: tuple[DriveMaker, ...]
    """The parameters of each maker."""
    warnings: tuple[str, ...]
    """Warnings."""

class FastestReserveData(Item):
    torque: float
    """Of the motor torque."""
    speed: float
    """Of the motor speed."""
    gearbox_torque: float
    """Of the gearbox torque."""
    gearbox_speed: float
    """Of the gearbox speed."""
    s1_torque: float
    """Of the S1 torque."""

class FastestMotorData(Item):
    """Load of the motor (N·m and rad/s, or N and m/s)."""
    rms_torque: float
    """RMS torque over the motion."""
    peak_torque: float
    """Largest torque."""
    peak_speed: float
    """Largest speed."""
    mean_speed: float
    """Mean of the speed's magnitude."""
    holding_torque: float
    """Torque that holds the machine at the end."""
    s1_torque: float | None
    """S1 torque at the mean speed; none: not known."""
    rms_allowed: float | None
    """Allowed RMS torque, with the reserve."""
    pause_needed: float | None
    """Time at rest that a repeated motion needs in addition (s); none: no pause is sufficient."""

class FastestWindingData(Item):
    """Temperatures of the winding (°C) when the motion repeats."""
    greatest: float | None
    """Largest; none: it grows without bound."""
    mean: float | None
    """Mean over the cycle."""
    ripple: float | None
    """Largest minus mean (K)."""
    limit: float
    """Limit."""
    ambient: float
    """Ambient temperature."""
    estimated: bool
    """Whether the rise is estimated from the rated one."""
    ripple_followed: bool
    """Whether the temperature is followed within the cycle."""
    binds: bool
    """Whether the limit restricts the motion."""
    rms_torque: float | None
    """RMS torque that keeps the limit (N·m, or N)."""
    duration_without: float | None
    """Duration without the limit (s)."""

class FastestRulesData(Item):
    kept: tuple[FastestCheck, ...]
    """Rules that limit the search and are satisfied."""
    not_kept: tuple[FastestCheck, ...]
    """Rules that the motion violates."""
    lowered: FastestLoweredLimits
    """Limits that were lowered for the rules."""

class FastestCheck(Item):
    """A rule with its value, limit and verdict."""
    rule: str
    """Name of the rule."""
    id: FastestRule
    """The rule."""
    value: float | None
    """The value, in `unit`; `None` if unknown."""
    limit: float | None
    """Its limit, in `unit`; `None` without data in the catalogue."""
    unit: str
    """Unit of figure and limit."""
    margin: float | None
    """Margin as a share of the limit; `None` without a limit, or for a yes-or-no rule."""
    verdict: FastestVerdict
    """Verdict."""
    note: str
    """How the limit is computed, or the missing data."""
    source: str
    """Source of the limit."""

FastestRule: TypeAlias = "Literal['altitude'] | Literal['ambient-temperature'] | Literal['amplifier-voltage'] | Literal['backlash'] | Literal['belt-force'] | Literal['belt-pretension'] | Literal['belt-tension'] | Literal['brake-resistance'] | Literal['brake-torque'] | Literal['brake-work'] | Literal['bus-voltage'] | Literal['cabinet-temperature'] | Literal['constant-torque'] | Literal['gearbox-axial'] | Literal['gearbox-cubic-mean'] | Literal['gearbox-cycles'] | Literal['gearbox-emergency'] | Literal['gearbox-mean-speed'] | Literal['gearbox-peak'] | Literal['gearbox-radial'] | Literal['gearbox-speed'] | Literal['holding-torque'] | Literal['housing-temperature'] | Literal['inertia-ratio'] | Literal['motor-voltage'] | Literal['natural-frequency'] | Literal['overload'] | Literal['peak-current'] | Literal['peak-torque'] | Literal['pinion-force'] | Literal['resistor-peak'] | Literal['resistor-power'] | Literal['resistor-pulse'] | Literal['rms-current'] | Literal['rms-torque'] | Literal['screw-buckling'] | Literal['screw-force'] | Literal['screw-speed'] | Literal['speed'] | Literal['winding-temperature']"

FastestVerdict: TypeAlias = "Literal['fail'] | Literal['not-checked'] | Literal['off'] | Literal['pass'] | Literal['warn']"

class FastestLoweredLimits(Item):
    share_of_motor_torque: float | None
    """Share of the motor torque that the reserve leaves."""
    gearbox_torque: float | None
    """Torque at the gearbox output (N·m)."""
    motor_speed: float | None
    """Speed of the motor (rad/s, or m/s)."""
    rms_torque: float | None
    """RMS torque (N·m, or N)."""

class FastestForceData(Item):
    """The largest force in a joint."""
    joint: str
    """Name of the joint."""
    force: float
    """Force (N)."""
    limit: float
    """Its limit (N)."""
    at: float
    """Position."""
    time: float
    """Time (s)."""
    at_rest: bool
    """Whether the machine is at rest there."""

class FastestMoveData(Item):
    """A move."""
    from_: float
    """Position at its start."""
    to: float
    """Position at its end."""
    from_speed: float
    """Speed at its start."""
    to_speed: float
    """Speed at its end."""
    time: float
    """Its time (s)."""
    time_before: float | None
    """Its time in the file (s)."""
    error: float
    """Estimated error of its time (s)."""
    bound: float | None
    """A lower bound of its time (s), without limits of jerk, torque rate and RMS torque."""
    excess: float
    """Share by which limits may be exceeded between nodes."""
    phases: tuple[FastestPhaseData, ...]
    """Its phases, each at one limit."""
    costs: tuple[FastestCostData, ...]
    """The time without each limit."""

class FastestPhaseData(Item):
    limit: str
    """The active limit."""
    from_: float
    """Position at its start."""
    to: float
    """Position at its end."""
    from_time: float
    """Start (s)."""
    to_time: float
    """End (s)."""
    from_speed: float
    """Speed at its start."""
    to_speed: float
    """Speed at its end."""
    greatest_speed: float
    """Largest speed in it."""

class FastestCostData(Item):
    limit: str
    """The limit."""
    eased: str
    """The change of the limit, in words."""
    time: float
    """The time of the move with that change (s)."""

class FastestKeptPart(Item):
    """A part of the file's motion that is kept."""
    segment: int
    """Number of the segment, from 1."""
    speed: float
    """Prescribed speed (rad/s, or m/s)."""
    from_: float
    """Position at its start (rad, or m)."""
    to: float
    """Position at its end (rad, or m)."""
    time: float
    """Duration (s)."""

class Fastest(Result):
    """The JSON of `jred fastest` (SI units; positions and speeds of the axis)."""
    schema: Literal['jred-fastest/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    drive: str
    """Name of the drive."""
    asked: tuple[str, ...]
    """The requested limits, option by option."""
    duration: float
    """Duration of the motion (s)."""
    duration_before: float | None
    """Duration of the motion of the file (s)."""
    at_rest: float
    """Time at rest (s)."""
    reserve: FastestReserveData
    """Shares of the limits that the motion leaves unused."""
    motor: FastestMotorData
    """Load of the motor."""
    winding: FastestWindingData | None
    """Temperature of the winding, where it is limited."""
    rules: FastestRulesData | None
    """Rules of sizing that judge the motion (`--reserve rules`)."""
    joint_forces: tuple[FastestForceData, ...]
    """Largest forces in the joints whose force is limited."""
    contact_lost: str | None
    """A one-sided contact that the motion loses."""
    unit: str
    """Unit of positions: rad or m."""
    moves: tuple[FastestMoveData, ...]
    """The moves."""
    kept: tuple[FastestKeptPart, ...] | None
    """Parts of the file's motion that are kept."""
    columns: tuple[str, ...]
    """Names of the columns, with units."""
    rows: tuple[tuple[float | None, ...], ...]
    """A number for each column; null where there is no value."""

class GentlestMotionFigures(Item):
    """Figures of a motion (SI units)."""
    rms_torque: float
    """Of the motor (N·m, or N)."""
    peak_torque: float
    """Of the motor (N·m, or N)."""
    peak_speed: float
    """Of the motor (rad/s, or m/s)."""
    work_drawn: float
    """Mechanical work that the motor delivers while driving (J)."""
    copper_loss: float | None
    """Loss in the winding (J)."""
    share_of_limits: float | None
    """Largest share of the torque limit at the same speed."""
    share_of_s1: float | None
    """RMS torque as a share of the S1 torque."""
    share_of_largest_speed: float | None
    """Largest speed as a share of the maximum speed."""
    motion: str
    """Name of the motion."""

class GentlestCheck(Item):
    """A rule with its value, limit and verdict."""
    rule: str
    """Name of the rule."""
    id: GentlestRule
    """The rule."""
    value: float | None
    """The value, in `unit`; `None` if unknown."""
    limit: float | None
    """Its limit, in `unit`; `None` without data in the catalogue."""
    unit: str
    """Unit of figure and limit."""
    margin: float | None
    """Margin as a share of the limit; `None` without a limit, or for a yes-or-no rule."""
    verdict: GentlestVerdict
    """Verdict."""
    note: str
    """How the limit is computed, or the missing data."""
    source: str
    """Source of the limit."""

GentlestRule: TypeAlias = "Literal['altitude'] | Literal['ambient-temperature'] | Literal['amplifier-voltage'] | Literal['backlash'] | Literal['belt-force'] | Literal['belt-pretension'] | Literal['belt-tension'] | Literal['brake-resistance'] | Literal['brake-torque'] | Literal['brake-work'] | Literal['bus-voltage'] | Literal['cabinet-temperature'] | Literal['constant-torque'] | Literal['gearbox-axial'] | Literal['gearbox-cubic-mean'] | Literal['gearbox-cycles'] | Literal['gearbox-emergency'] | Literal['gearbox-mean-speed'] | Literal['gearbox-peak'] | Literal['gearbox-radial'] | Literal['gearbox-speed'] | Literal['holding-torque'] | Literal['housing-temperature'] | Literal['inertia-ratio'] | Literal['motor-voltage'] | Literal['natural-frequency'] | Literal['overload'] | Literal['peak-current'] | Literal['peak-torque'] | Literal['pinion-force'] | Literal['resistor-peak'] | Literal['resistor-power'] | Literal['resistor-pulse'] | Literal['rms-current'] | Literal['rms-torque'] | Literal['screw-buckling'] | Literal['screw-force'] | Literal['screw-speed'] | Literal['speed'] | Literal['winding-temperature']"

GentlestVerdict: TypeAlias = "Literal['fail'] | Literal['not-checked'] | Literal['off'] | Literal['pass'] | Literal['warn']"

class GentlestMoveData(Item):
    """A move (s; rad or m)."""
    start: float
    """Position at its start."""
    distance: float
    """Signed distance."""
    law: str | None
    """The motion law that it keeps, if any."""
    duration: float
    """Its time."""
    moving: float
    """Time in motion; the rest it waits."""
    waits_at: float
    """Where it waits."""
    cost: float | None
    """Its part of the objective: integral of the squared torque (N²·m²·s), or energy (J)."""
    bound: float | None
    """A proven lower bound of the cost."""
    cost_per_second: float | None
    """Change of the cost per second of duration."""
    discretisation: float
    """Estimated relative error of the cost by discretisation."""
    elements: int
    """Elements of the discretisation."""

class GentlestKeptPart(Item):
    """A part of the file's motion that is kept."""
    segment: int
    """Number of the segment, from 1."""
    speed: float
    """Prescribed speed (rad/s, or m/s)."""
    from_: float
    """Position at its start (rad, or m)."""
    to: float
    """Position at its end (rad, or m)."""
    time: float
    """Duration (s)."""

class Gentlest(Result):
    """The JSON of `jred gentlest` (SI units)."""
    schema: Literal['jred-gentlest/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    drive: str | None
    """Name of the drive; none: torque and speed are those at the input of the drive train."""
    objective: str
    """The quantity that is least: rms, energy or peak."""
    motions: tuple[GentlestMotionFigures, ...]
    """The motion of the file, the motion laws, and the motion of least effort, which is the last."""
    least: float
    """The least value: RMS or peak torque (N·m, or N), or energy (J)."""
    bound: float | None
    """A proven lower bound of that value."""
    global_: bool
    """Whether no other motion of these moves is better."""
    local_because: str | None
    """Why the optimum is not proven to be global."""
    contact_lost: str | None
    """A one-sided contact that the motion loses."""
    rules_not_kept: tuple[GentlestCheck, ...]
    """Rules of sizing that the motion violates with this drive."""
    unit: str
    """Unit of positions: rad or m."""
    moves: tuple[GentlestMoveData, ...]
    """The moves."""
    kept: tuple[GentlestKeptPart, ...]
    """Parts of the file's motion that are kept."""
    not_kept: tuple[str, ...]
    """Parts and limits of the file's motion that are not kept."""
    nodes: tuple[tuple[float, float, float, float, float], ...]
    """Nodes of the motion: time (s), position, speed, acceleration before and after the node."""

class ProjectAxisData(Item):
    axis: str
    """Its name."""
    quantity: int
    """Number of equal axes."""
    machine: str
    """Its machine file."""
    phase: float | None
    """[s]. Delay of its cycle; null: any."""
    drive: str
    """Name of its drive."""
    order: str
    """What is missing for the order; "as it is": nothing."""

class ProjectBillLineData(Item):
    quantity: int
    """Number of pieces."""
    part: ProjectPart
    maker: str
    order: str
    """The maker's type designation."""
    key: str
    """Key in the catalogue."""
    mass: float | None
    """[kg]. Of one piece; null: not given."""
    price: float | None
    """Of one piece, in the currency of the catalogue; null: not given."""
    axes: tuple[str, ...]
    """The axes that it belongs to."""

ProjectPart: TypeAlias = "Literal['amplifier'] | Literal['brake'] | Literal['element'] | Literal['gearbox'] | Literal['motor'] | Literal['resistor']"

class ProjectSupplyData(Item):
    mean_drawn: float
    """[W]. Mean of the power that all axes draw, without what they feed back."""
    mean_fed_back: float
    """[W]. Mean of the power that all axes feed back."""
    peak_drawn: float
    """[W]. Largest power drawn if all axes have their peaks at once."""

class ProjectBusData(Item):
    """The JSON of `jred bus`; units are in the names."""
    axes: tuple[ProjectAxisData2, ...]
    """The axes."""
    period: float | None
    """[s]. The common period; none: none is searched."""
    common_period: ProjectCommonData
    """The search for a common period."""
    in_step: ProjectBusFigures | None
    """All axes in step."""
    worst: ProjectWorstData | None
    """The worst phases."""
    most_room: ProjectWorstPhases | None
    """The phases that leave most room."""
    bounds: ProjectBounds
    """Bounds for any phases."""
    saved_by_sharing: float | None
    """[W]. Mean power that one bus saves over a bus for each axis."""
    brake_resistor_lacks: ProjectMissingFigures
    """The shortage of the brake resistor."""
    brake_resistor_needed: ProjectNeed | None
    """The brake resistor that is needed."""
    proposal: str | None
    """A brake resistor of the catalogue that is suitable."""
    brake_resistor_chosen: str | None
    """The brake resistor chosen from the catalogue."""
    conflict: ProjectConflict | None
    """Why no brake resistor can work."""
    checks: tuple[ProjectCheckRow, ...]
    """The checks."""
    not_checked: tuple[str, ...]
    """Checks without data."""
    not_known: tuple[ProjectUnknownFigure, ...]
    """Data that are missing."""
    cures: tuple[ProjectCureData, ...]
    """Changes, any one of which is sufficient."""

class ProjectAxisData2(Item):
    title: str
    """Title of the machine."""
    drive: str
    """Name of the drive."""
    period: float
    """[s]. Duration of its cycle."""
    drawn: float
    """[J]. Energy that it draws in a cycle."""
    fed_back: float
    """[J]. Energy that it feeds back in a cycle."""
    peak_drawn: float
    """[W]. Largest power drawn."""
    peak_fed_back: float
    """[W]. Largest power fed back."""

class ProjectCommonData(Item):
    kind: str
    """searched, too long, or none."""
    period: float | None
    """[s]. The common period."""
    cycles: tuple[int, ...] | None
    """Cycles of each axis in it."""
    most_cycles: int
    """The most cycles that are searched."""

class ProjectBusFigures(Item):
    """Result for one period in the steady state."""
    supplied: float | None
    """[J]. Energy from the supply (J); NaN if the voltage is unbounded."""
    returned: float
    """[J]. Energy that the supply takes back (J)."""
    burnt: float
    """[J]. Energy that the brake resistor turns into heat (J)."""
    resistor_peak: float
    """[W]. Its largest power (W)."""
    resistor_pulse: float
    """[J]. Its largest energy without a pause (J); if it never pauses, its energy per period."""
    highest_voltage: float | None
    """[V]. Highest voltage (V); infinite if unbounded."""
    stored_at_the_start: float | None
    """[J]. Energy stored at the start of a period above that at U₀ (J)."""

class ProjectWorstData(Item):
    voltage: ProjectWorstPhases
    """Phases with the highest voltage."""
    resistor: ProjectWorstPhases
    """Phases with the highest mean power of the brake resistor."""
    peak: ProjectWorstPhases
    """Phases with its highest peak power."""
    pulse: ProjectWorstPhases
    """Phases with its largest pulse."""
    exhaustive: bool
    """Whether no worse phases exist."""

class ProjectWorstPhases(Item):
    """Phases found by a search."""
    phases: tuple[float, ...]
    """[s]. Delay of each axis relative to the first (s)."""
    figures: ProjectBusFigures
    """Result for the bus over the common period."""

class ProjectBounds(Item):
    """Bounds that are valid for any phases and periods."""
    peak_drawn: float
    """[W]. Largest power drawn (W): the sum of the axes' largest powers. It is reached."""
    peak_fed_back: float
    """[W]. Largest power fed back (W): the sum of the axes' largest values, of the cycles or of the stops. It is reached if all axes feed back."""
    highest_voltage: float | None
    """[V]. Highest voltage (V)."""
    resistor_mean: float
    """[W]. Mean power of a brake resistor (W): all regenerated energy."""

class ProjectMissingFigures(Item):
    mean: float | None
    """[W]."""
    peak: float | None
    """[W]."""
    pulse: float | None
    """[J]."""
    resistance: float | None
    """[Ohm]."""

class ProjectNeed(Item):
    """Requirements for a brake resistor that by itself limits the bus to the chopper voltage."""
    mean: float
    """[W]. Mean power (W)."""
    peak: float
    """[W]. Largest power (W)."""
    pulse: float | None
    """[J]. Largest energy without a pause (J); NaN: not known."""
    largest_resistance: float
    """[Ohm]. Largest resistance that takes that power at the chopper's voltage (Ω)."""
    smallest_resistance: float | None
    """[Ohm]. Smallest resistance that the chopper may switch (Ω)."""

class ProjectConflict(Item):
    any_of: tuple[str, ...]
    """Keys of `[supply]`, any one of which resolves it."""
    words: str
    """The reason."""

class ProjectCheckRow(Item):
    check: str
    """Name."""
    value: float | None
    """Value, in `unit`; none: unbounded or unknown."""
    limit: float | None
    """Limit, in `unit`."""
    at_least: bool
    """Whether the value must be at least the limit; otherwise at most."""
    unit: str
    """Unit."""

class ProjectUnknownFigure(Item):
    figure: str
    """The figure."""
    any_of: tuple[tuple[str, ...], ...]
    """Lists of keys of `[supply]`: all keys of any one list give it."""

class ProjectCureData(Item):
    changes: tuple[ProjectChangeData, ...]
    """Keys to change, all of them."""
    phases: tuple[float, ...] | None
    """[s]. Phases of the axes with this cure."""
    words: str
    """The cure in words."""

class ProjectChangeData(Item):
    key: str
    """Key of `[supply]`."""
    at_least: float | None
    """Least value."""
    at_most: float | None
    """Largest value."""
    unit: str
    """Unit."""

class Project(Result):
    """The JSON of `jred project`; units are in the names."""
    schema: Literal['jred-project/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    version: str
    """Version of jred."""
    axes: tuple[ProjectAxisData, ...]
    """The axes."""
    bill_of_materials: tuple[ProjectBillLineData, ...]
    """All parts."""
    supply: ProjectSupplyData
    """The supply."""
    bus: ProjectBusData | None
    """The common bus; null: each amplifier has its own."""

class RatioRows(Item):
    motor: float | str | None
    rated_power: float | str | None
    """[W]."""
    alpha: float | str | None
    """[W/s]."""
    beta: float | str | None
    """[W/s]."""
    best_ratio: float | str | None
    RMS_torque_there: float | str | None
    """[N m]."""
    RMS_ratio_from: float | str | None
    RMS_ratio_to: float | str | None
    ratio_from: float | str | None
    ended_by: float | str | None
    ratio_to: float | str | None
    ended_by_above: float | str | None
    gearboxes: float | str | None
    why_none: float | str | None

class Ratio(Result):
    """The data of a sheet."""
    schema: Literal['jred-ratio/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    notes: tuple[str, ...]
    """Remarks and warnings."""
    rows: tuple[RatioRows, ...]
    """The rows: a number, a text, or null for each column; an infinite number is the text "inf"."""

class ReduceLargest(Item):
    """The largest magnitude of one quantity."""
    quantity: str
    """The quantity."""
    value: float
    """The value, with its sign."""
    over: str
    """The variable of the rows."""
    at: float
    """Its place."""

class Reduce(Result):
    """The JSON of `jred reduce`."""
    schema: Literal['jred-reduce/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    notes: tuple[str, ...]
    """Remarks about the rows."""
    largest: tuple[ReduceLargest, ...]
    """The largest forces, with `--reactions`."""
    columns: tuple[str, ...]
    """Names of the columns, with units."""
    rows: tuple[tuple[float | None, ...], ...]
    """A number for each column; null where there is no value."""

class RequireRatioData(Item):
    """The ratings that a drive needs at one ratio; SI units. For a linear motor read force for torque, mass for inertia."""
    ratio: float | None
    """Gear ratio; `None`: coupled directly."""
    rotor_inertia: tuple[float | None, float | None]
    """[kg m^2]. Smallest and largest inertia of rotor and brake; no largest: any."""
    smallest_rotor_inertia: float
    """[kg m^2]. Smallest inertia of rotor and brake that the rule of the inertia ratio allows; zero without a limit."""
    S1_torque: float
    """[N m]. S1 torque at the mean speed, in the surroundings of the data sheet."""
    standstill_torque: float
    """[N m]. S1 torque at standstill: for the loads that last, and not below that at the mean speed."""
    lasting_torque_at_rest: float
    """[N m]. The part of it for the loads that last at rest."""
    mean_speed: float
    """[rad/s]. Mean speed, at which the S1 torque is required."""
    maximum_speed: float
    """[rad/s]. Largest speed."""
    peak_torque: float
    """[N m]. Peak torque."""
    peak_torque_over_speed: tuple[tuple[float, float], ...]
    """[rad/s, N m]. Peak torque over speed: (rad/s, N·m), not rising."""
    brake_torque: float | None
    """[N m]. Torque of the holding brake; `None`: the machine stays where it is without current."""
    brake_work_if_closed_after_20_ms_and_100_ms: tuple[float | None, float | None] | None
    """[J]. Work of this brake in the worst stop by it alone, with any rotor of the window, if it has its torque after 20 ms and after 100 ms; infinite: it
holds the machine but does not stop it; `None` also for a window without an end."""
    continuous_and_peak_current_times_torque_constant: tuple[float, float]
    """[N m]. Continuous and peak current of the amplifier, times the torque constant of the motor, as its data sheet
states them."""
    regeneration: RequireRegeneration
    """Energy that flows back."""
    possible: bool
    """Whether shafts and drive train alone satisfy the rules of natural frequency and backlash, so that a gearbox can, and the machine's belts,
screws and pinions theirs."""
    gearbox: RequireGearboxRequirement | None
    """The gearbox; `None`: coupled directly."""
    mean_square_torque_by_rotor_inertia: tuple[float, float, float]
    """Mean square of the motor torque as a polynomial of the rotor's inertia: constant, linear, square."""
    boundary: tuple[RequireTorqueNeed, ...]
    """The least torques of a motor with each of these rotors."""

class RequireRegeneration(Item):
    """Energy that flows back over a cycle, without the losses of motor and amplifier, which only reduce it; SI units."""
    energy_per_cycle: float
    """[J]. Energy over a cycle."""
    mean: float
    """[W]. Its mean power."""
    peak: float
    """[W]. Its largest power."""
    pulse: float
    """[J]. Largest energy without a pause, if nothing is stored."""
    motoring_peak: float
    """[W]. Largest motoring power; losses are added to it."""
    resistor: RequireNeed | None
    """The brake resistor, if `[supply]` gives the voltages and the bus needs one."""
    stops: bool | None
    """Whether the drive with the least peak torque stops the machine with its share of it (`drive_stop` of `[duty]`); `None` without the key."""

class RequireNeed(Item):
    """Requirements for a brake resistor that by itself limits the bus to the chopper voltage."""
    mean: float
    """[W]. Mean power (W)."""
    peak: float
    """[W]. Largest power (W)."""
    pulse: float | None
    """[J]. Largest energy without a pause (J); NaN: not known."""
    largest_resistance: float
    """[Ohm]. Largest resistance that takes that power at the chopper's voltage (Ω)."""
    smallest_resistance: float | None
    """[Ohm]. Smallest resistance that the chopper may switch (Ω)."""

class RequireGearboxRequirement(Item):
    """The ratings that a gearbox needs at its output and input; SI units."""
    T2B: float
    """[N m]. Acceleration torque T2B, at the cycles per hour below."""
    T2N: float
    """[N m]. Rated torque T2N."""
    emergency_torque: float | None
    """[N m]. Emergency torque, if the motor brakes with the required peak torque."""
    n1N: float
    """[rad/s]. Rated input speed n1N."""
    maximum_input_speed: float
    """[rad/s]. Largest input speed."""
    cycles_per_hour: float
    """Cycles per hour."""
    stiffness: float | None
    """[N m/rad]. Torsional stiffness at the output; infinite if the shafts alone are too soft; `None`: no rule needs it."""
    backlash: float | None
    """[rad]. Largest backlash at the output; negative if the drive train alone has too much; `None`: no rule needs it."""
    radial_load: float | None
    """[N]. Radial load that the output shaft must bear; `None`: nothing with a known pull is on it."""
    axial_load: float | None
    """[N]. Axial load that the output shaft must bear; `None`: as above."""

class RequireTorqueNeed(Item):
    """Required torques of a motor with a given rotor."""
    rotor_inertia: float
    """[kg m^2]. Inertia of rotor and brake."""
    S1_torque: float
    """[N m]. S1 torque at the mean speed, in the surroundings of the data sheet."""
    peak_torque: float
    """[N m]. Peak torque."""

class Require(Result):
    """The JSON of `jred require`."""
    schema: Literal['jred-require/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    linear: bool
    """Whether the motor is linear: forces (N), masses (kg) and m/s then stand for torques, inertias and rad/s."""
    efficiency: float
    """Efficiency of the gearbox."""
    gearbox_inertia: float
    """[kg m^2]. Inertia of the gearbox at its input."""
    allowance: float
    """S1 torque above the least possible, as a share of it."""
    described: int
    """Index of the ratio that is described in full."""
    ratios: tuple[RequireRatioData, ...]
    """Each ratio."""

class SensitivityRows(Item):
    quantity: float | str | None
    value: float | str | None
    unit: float | str | None
    affects_most: float | str | None
    slope: float | str | None
    """[% of limit per +1 %]."""
    uncertainty: float | str | None
    """[% of limit per +1 %]."""
    down_to: float | str | None
    """[%]."""
    then_down: float | str | None
    up_to: float | str | None
    """[%]."""
    then_up: float | str | None

class Sensitivity(Result):
    """The data of a sheet."""
    schema: Literal['jred-sensitivity/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    notes: tuple[str, ...]
    """Remarks and warnings."""
    rows: tuple[SensitivityRows, ...]
    """The rows: a number, a text, or null for each column; an infinite number is the text "inf"."""

class SimulateImpactData(Item):
    count: int
    """Number of impacts."""
    time: float
    """Time of the first (s)."""
    position: float
    """Its position."""
    speed: float
    """Its speed."""

class SimulateTravelData(Item):
    """Time (s) and distance (rad, or m) since the start, or since the motor was switched off."""
    time: float
    """Time (s)."""
    way: float
    """Distance (rad, or m)."""

class SimulateStopData(Item):
    time: float
    """Instant at which the motor is switched off (s)."""
    position: float
    """Position at that instant."""
    rest: SimulateTravelData | None
    """Distance and time to rest; none: still in motion at the end."""

class SimulateMotorData(Item):
    torque: SimulatePeakData
    """Largest torque (N·m), or force (N)."""
    rms_torque: float
    """RMS torque (N·m), or force (N)."""
    power: SimulatePeakData
    """Largest power (W)."""
    speed: SimulatePeakData
    """Largest speed (rad/s, or m/s)."""

class SimulatePeakData(Item):
    """A largest value (SI units)."""
    value: float
    """The value."""
    time: float
    """Its time (s)."""

class SimulateStandstillData(Item):
    time: float
    """Time (s)."""
    position: float
    """Position."""
    given: float
    """Torque of the motor at rest (N·m), or force (N)."""
    needed: float
    """Torque that would be needed (N·m), or force (N)."""

class SimulateLimitData(Item):
    count: int
    """Number of times."""
    duration: float
    """Time in all (s)."""
    time: float
    """The first time (s)."""
    position: float
    """Position at that time."""

class SimulateFollowingData(Item):
    error: float
    """The error (rad, or m)."""
    time: float
    """Its time (s)."""
    position: float
    """Its position."""

class SimulateDriveData(Item):
    name: str
    """Name of the drive."""
    motor_speed: SimulateLoadData
    """Speed of the motor (rad/s, or m/s), against the largest input speed of the gearbox."""
    gearbox_torque: SimulateLoadData | None
    """Torque at the gearbox output (N·m), against its acceleration torque."""
    rise: SimulateLoadData | None
    """Temperature rise of the winding above the surroundings (K), or as a share of the rated rise."""
    rise_is_share: bool
    """Whether the rise is a share of the rated rise."""

class SimulateLoadData(Item):
    """A largest value against its limit."""
    value: float
    """The value."""
    allowed: float | None
    """Its limit."""
    time: float
    """Its time (s)."""
    position: float
    """Its position."""

class Simulate(Result):
    """The JSON of `jred simulate` (SI units; positions and distances of the axis in rad or m)."""
    schema: Literal['jred-simulate/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    unit: str
    """Unit of positions: rad or m."""
    by_motion: tuple[str, ...]
    """Loads, payloads and carriages that follow the clock of the motion."""
    impacts: SimulateImpactData | None
    """Impacts on end stops."""
    rest: SimulateTravelData | None
    """Rest after the motor was switched off."""
    turned_back: SimulateTravelData | None
    """The first standstill after the motor was switched off, if nothing held the machine there."""
    stops_over_the_cycle: tuple[SimulateStopData, ...] | None
    """Stops at instants over a cycle."""
    held: SimulateTravelData | None
    """Rest in which friction holds the machine to the end."""
    reached: SimulateTravelData | None
    """The time and distance to the requested speed."""
    motor: SimulateMotorData | None
    """Largest values of the motor until it is switched off."""
    stops: SimulateStandstillData | None
    """The place where the motor cannot drive the machine on."""
    torque_limit: SimulateLimitData | None
    """Time at the limit of the motor torque."""
    following_error: SimulateFollowingData | None
    """The largest following error."""
    drive: SimulateDriveData | None
    """Loads of the drive of the catalogue."""
    ended: str | None
    """Why the simulation ended before its time."""
    columns: tuple[str, ...]
    """Names of the columns, with units."""
    rows: tuple[tuple[float | None, ...], ...]
    """A number for each column; null where there is no value."""

class SizeFigures(Item):
    """Extremes, mean and RMS of a quantity over the cycle."""
    min: float
    """Smallest value."""
    mean: float
    """Mean over time."""
    max: float
    """Largest value."""
    rms: float
    """Root mean square over time."""

class SizeSupplyData(Item):
    mains_voltage: float | None
    """[V]. Null: not given, or the bus voltage was given itself."""
    bus_voltage: float | None
    """[V]. Null: not given; each motor at the voltage of its data."""

class SizeRulesData(Item):
    set: str
    """Name of the set."""
    title: str
    """Its description."""
    limits: Mapping[str, SizeLimitData]
    """Limits by the rule's key in `[rules]`: shares of the rating."""

class SizeLimitData(Item):
    fail: float | None
    """Beyond this the rule is violated."""
    warn: float | None
    """Beyond this there is a warning."""
    source: str
    """Source of the limit."""

class SizeCounts(Item):
    drives: int
    """All drives."""
    fit: int
    """Drives that violate no rule."""
    fit_not_all_rules_checked: int
    """Suitable drives with rules that are not checked."""
    refused: int
    """Drives that violate a rule."""

class SizeClassData(Item):
    certainty: str
    """makers-figures, other-figures, pairing-unknown or voltage-unknown."""
    drives: int
    """Number of suitable drives."""
    rank: int
    """Rank of the first one."""
    first: SizeDriveData
    """The first one."""

class SizeDriveData(Item):
    """A drive."""
    motor: str
    """Key of the motor in the catalogue."""
    gearbox: str | None
    """Key of the gearbox; null: coupled directly."""
    amplifier: str | None
    """Key of the amplifier."""
    brake_resistor: str | None
    """Key of the brake resistor that was chosen; null: not needed, none fits, or the machine file gives one."""
    ratio: float
    """Gear ratio."""
    mass: float | None
    """[kg]. Mass of motor, gearbox and amplifier; null: one of them has no data."""
    price: float | None
    """Price of motor, gearbox, amplifier and chosen resistor, in the currency of the catalogue; null: one of them has no data."""
    rated_power: float | None
    """[W]. Rated power."""
    motor_mains_voltage: float | None
    """[V]. Mains voltage that the motor is made for; null: not stated."""
    motor_largest_bus_voltage: float | None
    """[V]. Bus voltage that the rule motor-voltage judges by; null: no voltage is stated."""
    certainty: str | None
    """makers-figures, other-figures, pairing-unknown or voltage-unknown; null: refused."""
    figures_from: str
    """maker, or other: not all figures are from the maker's own document."""
    verdict: SizeVerdict
    """The worst verdict of its rules."""
    duty: SizeMotorDuty
    """Duty of the motor."""
    checks: tuple[SizeCheck, ...]
    """The rules."""
    assumptions: tuple[str, ...]
    """Assumptions where data are missing."""

SizeVerdict: TypeAlias = "Literal['fail'] | Literal['not-checked'] | Literal['off'] | Literal['pass'] | Literal['warn']"

class SizeMotorDuty(Item):
    """The duty at the motor."""
    torque: SizeFigures
    """[N m]. Motor torque (N·m)."""
    speed: SizeFigures
    """[rad/s]. Motor speed (rad/s)."""
    mean_speed: float
    """[rad/s]. Mean of the speed's magnitude (rad/s)."""
    power: SizeFigures
    """[W]. Mechanical power at the motor shaft (W)."""
    motoring_energy: float
    """[J]. Energy supplied by the motor over a cycle (J)."""
    regenerative_energy: float
    """[J]. Energy that flows back to the motor over a cycle (J)."""
    inertia_ratio: SizeFigures
    """Inertia ratio λ = (load and gearbox at the motor)/(rotor), over the cycle."""

class SizeCheck(Item):
    """A rule with its value, limit and verdict."""
    rule: str
    """Name of the rule."""
    id: SizeRule
    """The rule."""
    value: float | None
    """The value, in `unit`; `None` if unknown."""
    limit: float | None
    """Its limit, in `unit`; `None` without data in the catalogue."""
    unit: str
    """Unit of figure and limit."""
    margin: float | None
    """Margin as a share of the limit; `None` without a limit, or for a yes-or-no rule."""
    verdict: SizeVerdict
    """Verdict."""
    note: str
    """How the limit is computed, or the missing data."""
    source: str
    """Source of the limit."""

SizeRule: TypeAlias = "Literal['altitude'] | Literal['ambient-temperature'] | Literal['amplifier-voltage'] | Literal['backlash'] | Literal['belt-force'] | Literal['belt-pretension'] | Literal['belt-tension'] | Literal['brake-resistance'] | Literal['brake-torque'] | Literal['brake-work'] | Literal['bus-voltage'] | Literal['cabinet-temperature'] | Literal['constant-torque'] | Literal['gearbox-axial'] | Literal['gearbox-cubic-mean'] | Literal['gearbox-cycles'] | Literal['gearbox-emergency'] | Literal['gearbox-mean-speed'] | Literal['gearbox-peak'] | Literal['gearbox-radial'] | Literal['gearbox-speed'] | Literal['holding-torque'] | Literal['housing-temperature'] | Literal['inertia-ratio'] | Literal['motor-voltage'] | Literal['natural-frequency'] | Literal['overload'] | Literal['peak-current'] | Literal['peak-torque'] | Literal['pinion-force'] | Literal['resistor-peak'] | Literal['resistor-power'] | Literal['resistor-pulse'] | Literal['rms-current'] | Literal['rms-torque'] | Literal['screw-buckling'] | Literal['screw-force'] | Literal['screw-speed'] | Literal['speed'] | Literal['winding-temperature']"

class SizeGapData(Item):
    rule: str
    """Name of the rule."""
    id: SizeRule
    """The rule."""
    drives: int
    """Suitable drives that the rule could not judge."""
    missing: str
    """Missing data of one of them."""
    cure: str
    """Keys of the catalogue or the machine file."""

class SizeViolationData(Item):
    rule: str
    """Name of the rule."""
    id: SizeRule
    """The rule."""
    drives: int
    """Refused drives that violate it; rules over time are judged only where all others are satisfied."""
    drives_nothing_else: int
    """Refused drives that violate no other rule."""

class SizeRankedData(Item):
    """A drive with its rank."""
    motor: str
    """Key of the motor in the catalogue."""
    gearbox: str | None
    """Key of the gearbox; null: coupled directly."""
    amplifier: str | None
    """Key of the amplifier."""
    brake_resistor: str | None
    """Key of the brake resistor that was chosen; null: not needed, none fits, or the machine file gives one."""
    ratio: float
    """Gear ratio."""
    mass: float | None
    """[kg]. Mass of motor, gearbox and amplifier; null: one of them has no data."""
    price: float | None
    """Price of motor, gearbox, amplifier and chosen resistor, in the currency of the catalogue; null: one of them has no data."""
    rated_power: float | None
    """[W]. Rated power."""
    motor_mains_voltage: float | None
    """[V]. Mains voltage that the motor is made for; null: not stated."""
    motor_largest_bus_voltage: float | None
    """[V]. Bus voltage that the rule motor-voltage judges by; null: no voltage is stated."""
    certainty: str | None
    """makers-figures, other-figures, pairing-unknown or voltage-unknown; null: refused."""
    figures_from: str
    """maker, or other: not all figures are from the maker's own document."""
    verdict: SizeVerdict
    """The worst verdict of its rules."""
    duty: SizeMotorDuty
    """Duty of the motor."""
    checks: tuple[SizeCheck, ...]
    """The rules."""
    assumptions: tuple[str, ...]
    """Assumptions where data are missing."""
    rank: int | None
    """Rank among the drives that violate no rule, from 1; null: refused."""

class SizeBillData(Item):
    """A part as it is ordered."""
    part: SizePart
    maker: str
    order: str
    """The maker's type designation."""
    key: str
    """Key in the catalogue."""
    mass: float | None
    """[kg]. Null: not given; a brake is contained in its motor."""
    price: float | None
    """In the currency of the catalogue; null: not given."""
    decided_by: SizeRule | None
    """The rule on this part that uses most of its limit; null: no rule is checked."""
    source: str
    """Source of its figures."""

SizePart: TypeAlias = "Literal['amplifier'] | Literal['brake'] | Literal['element'] | Literal['gearbox'] | Literal['motor'] | Literal['resistor']"

class SizeExplanation(Item):
    """The explanation of one drive, and of the refused drives closest to their limits."""
    contributions: SizeBreakdown | None
    """Torque and inertia of the drive, part by part; `None` if only refused drives were requested."""
    change: SizeRemedies | None
    """The range of each quantity, or the changes that are needed."""
    nearest_refused: tuple[SizeRemedies, ...]
    """The same for the closest refused drives."""

class SizeBreakdown(Item):
    """The contributions to the motor torque and to the inertia at the motor."""
    drive: str
    """Name of the drive."""
    peak_at: float
    """[s]. Time of the largest motor torque (s)."""
    total: SizeShare
    """Total."""
    effects: tuple[SizeShare, ...]
    """By effect."""
    parts: tuple[SizeShare, ...]
    """By part."""
    inertia: tuple[SizeInertiaShare, ...]
    """The inertia at the motor, by part."""
    total_inertia: SizeInertiaShare
    """Its sum."""

class SizeShare(Item):
    """Contribution of one part or effect to the motor torque."""
    name: str
    """Name."""
    torque: SizeFigures
    """[N m]. Torque at the motor over the cycle (N·m)."""
    share_of_mean_square: float
    """Share of the mean square torque; all add up to one, or are zero without a torque."""
    at_peak: float
    """[N m]. Torque (N·m) at the instant of the largest motor torque."""
    energy: float
    """[J]. Energy that it takes from the motor in a cycle (J)."""

class SizeInertiaShare(Item):
    """Contribution of one part to the inertia at the motor."""
    name: str
    """Name of the part."""
    inertia: SizeFigures
    """[kg m^2]. Inertia at the motor over the cycle (kg·m²)."""
    share_of_mean: float
    """Share of the mean."""

class SizeRemedies(Item):
    """Changes that would make one drive suitable."""
    drive: str
    """The drive."""
    misses: tuple[SizeRuleViolation, ...]
    """The rules that it violates."""
    remedies: tuple[SizeRemedy, ...]
    """One entry for each quantity."""

class SizeRuleViolation(Item):
    """A rule that a drive violates."""
    rule: SizeRule
    """The rule."""
    used: float | None
    """The share of its limit that is used; `None` if the limit is zero there, or for a yes-or-no rule."""
    limit: float
    """The limit as a share of the rating."""
    needed: float | None
    """The limit that the drive would satisfy; `None` if no limit would be sufficient, or for a yes-or-no rule."""

class SizeRemedy(Item):
    """The result of changing one quantity by itself."""
    lever: SizeLever
    """The quantity that is changed."""
    now: float
    """Its current value: the ratio, or 1."""
    range: tuple[SizeEdge, SizeEdge] | None
    """Range in which every rule is satisfied: the one that contains the current value, or the closest one; `None` if no practical value helps."""
    best: SizeEdge | None
    """If no value helps: the best value tried, and the rule violated there."""
    best_use: float | None
    """The share of its limit that this rule uses there."""

SizeLever: TypeAlias = "Literal['cycle-time'] | Literal['gear-ratio'] | Literal['ideal-gearbox'] | Literal['moving-mass'] | Literal['process-load']"

class SizeEdge(Item):
    """An end of the range in which every rule is satisfied."""
    value: float
    """The value."""
    rule: SizeRule | None
    """The rule at its limit there; `None`: the end of the tried values."""

class SizeMotionData(Item):
    """The motion that drives are judged with."""
    from_: str
    """gentlest: the motion of least effort for a drive; file: the motion of the machine file, kept if no equally small drive is suitable with a
motion of its own."""
    made_for: SizeNamedDrive | None
    """The drive that the motion is made for; null: the motion is that of the file."""
    saving_of_RMS_torque: float | None
    """Reduction of the RMS torque as a share of that with the motion of the file."""
    best_with_the_file_1s_motion: SizeNamedDrive | None
    """The best drive with the motion of the file; null: no drive is suitable."""
    best_with_a_motion_of_its_own: SizeNamedDrive | None
    """The best drive with a motion of its own; null: no tried drive is suitable."""
    kept: tuple[SizeKeptPart, ...]
    """Parts of the file's motion that are kept."""
    not_kept: tuple[str, ...]
    """Parts and limits of the file's motion that are not kept."""

class SizeNamedDrive(Item):
    motor: str
    """Key of the motor."""
    gearbox: str | None
    """Key of the gearbox."""
    rated_power: float | None
    """[W]. Rated power."""

class SizeKeptPart(Item):
    """A part of the file's motion that is kept."""
    segment: int
    """Number of the segment, from 1."""
    speed: float
    """Prescribed speed (rad/s, or m/s)."""
    from_: float
    """Position at its start (rad, or m)."""
    to: float
    """Position at its end (rad, or m)."""
    time: float
    """Duration (s)."""

class Size(Result):
    """The JSON of `jred size`: SI units unless a key names another; of a linear motor read N for N m, m/s for rad/s and kg for kg m^2."""
    schema: Literal['jred-size/4']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    version: str
    """Version of jred."""
    cycle: float
    """[s]. Duration of a cycle."""
    input_torque: SizeFigures
    """[N m]. Torque at the input of the drive train, which is the gearbox output."""
    input_speed: SizeFigures
    """[rad/s]. Speed at the input of the drive train."""
    input_inertia: SizeFigures
    """[kg m^2]. Inertia at the input of the drive train."""
    holding_torque: float
    """[N m]. Holding torque at the input of the drive train."""
    supply: SizeSupplyData
    """The supply of the machine file."""
    rules: SizeRulesData
    """The rules."""
    warnings: tuple[str, ...]
    """Possible mistakes in the machine file."""
    ranking: str
    """Order of the suitable drives, in words."""
    counts: SizeCounts
    """Numbers of drives."""
    certainties: tuple[SizeClassData, ...]
    """The suitable drives by the certainty of their data, the most certain first, which is the order of the ranking."""
    not_checked: tuple[SizeGapData, ...]
    """Rules that are not checked for some of the suitable drives."""
    violated: tuple[SizeViolationData, ...]
    """Reasons for which drives are refused, the most frequent first; empty where a drive fits."""
    fit: tuple[SizeRankedData, ...]
    """The first drive of each motor, of those that violate no rule, best first: `--top` motors; with `--all-gearboxes` or `--all` every drive."""
    refused: tuple[SizeDriveData, ...]
    """Drives that violate a rule, those that miss by least first: `--nearest` of them."""
    asked: SizeRankedData | None
    """The drive of `--why`."""
    bill_of_materials: tuple[SizeBillData, ...]
    """The parts of the first or requested drive as they are ordered."""
    explanation: SizeExplanation | None
    """Contributions and changes, with `--explain` or `--why`."""
    motion: SizeMotionData | None
    """The motion that the drives are judged with, with `--motion best`."""

class SplitDivision(Item):
    ratios: tuple[float, ...]
    """Ratio of each stage, from the input."""
    J_red_kg_m2: float
    """Reduced inertia at the input (kg·m²)."""

class Split(Result):
    """The JSON of `jred split`."""
    schema: Literal['jred-split/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    ratio: float
    """Total ratio."""
    optimum: SplitDivision
    """The best division."""
    equal: SplitDivision
    """Equal ratios in all stages."""
    equal_within_bounds: bool
    """Whether equal ratios keep within the bounds of a stage."""
    columns: tuple[str, ...]
    """Names of the columns, with units."""
    rows: tuple[tuple[float | None, ...], ...]
    """A number for each column; null where there is no value."""

class SteadyCycle(Item):
    """The motion that repeats with every turn."""
    mean_speed: float
    """Mean over the time, 2π·turns/period (rad/s); negative: the drive link turns clockwise."""
    speed_at_start_of_turn: float
    """Speed at the start of the cycle (rad/s), by magnitude."""
    max_speed: float
    """Largest speed (rad/s), by magnitude."""
    max_speed_at: float
    """Its position (rad)."""
    min_speed: float
    """Smallest speed (rad/s), by magnitude."""
    min_speed_at: float
    """Its position (rad)."""
    delta: float
    """δ = (ω_max − ω_min)/ω_mean with the mean over the time."""
    delta_of_extremes: float
    """The same with the mean (ω_max + ω_min)/2."""
    turns: int
    """Turns of the drive link in a cycle."""
    period: float
    """Duration of a cycle (s)."""
    kinetic_energy_fluctuation: float
    """Largest minus least kinetic energy of all moving parts over a cycle (J)."""
    motor_torque: SteadyMotorTorque
    """Motor torque over the time (N·m)."""
    motor_power: SteadyMotorPower
    """Motor power (W)."""
    motor_speed: float
    """Mean speed of the motor (rad/s)."""
    energy: SteadyEnergies
    """Energies of a cycle (J)."""
    imbalance: float
    """The largest energy balance as a share of the energy turned over."""
    for_mean_speed: SteadyScaling | None
    """The scale of the motor or a load for a prescribed mean speed."""
    residual: float
    """|E(end) − E(0)|/E(0)."""
    left_over: float
    """Remaining share of a small deviation of the energy after a cycle: below 1 the cycle is stable."""
    reached_from_speed: float | None
    """The lowest speed at the start of a cycle from which the machine comes to this cycle (rad/s); none: from every speed."""
    start: SteadyStart
    """The start from rest."""

class SteadyMotorTorque(Item):
    """Torque of the motor over a cycle (N·m)."""
    mean: float
    """Mean over the time."""
    rms: float
    """Root of the mean square over the time."""
    peak: float
    """Largest magnitude."""

class SteadyMotorPower(Item):
    """Power of the motor over a cycle (W)."""
    mean: float
    """Mean over the time."""
    peak: float
    """Largest."""

class SteadyEnergies(Item):
    """Energies of a cycle (J)."""
    motor: float
    """Work of the motor."""
    process: float
    """Work of the process loads; positive: they drive."""
    losses: float
    """Losses of friction and drive train."""

class SteadyScaling(Item):
    """The scaling that gives a mean speed."""
    scaled: str | None
    """The load that is scaled; none: the motor torque."""
    factor: float
    """Factor on the torque of the motor, or on the load."""
    constant_torque: float | None
    """The torque of a motor whose torque is constant (N·m)."""

class SteadyStart_0(Item):
    """From then on the speed stays within 1 % of the cycle's at the same position for a turn."""
    outcome: Literal['reached']
    time: float
    """Time from rest (s), to a 24th of a turn."""
    turns: float
    """Turns from rest."""

class SteadyStart_1(Item):
    """It does not move, or stops again after some turns."""
    outcome: Literal['stuck']
    turns: float
    """Turns from rest."""
    stuck_at: float
    """Position there (rad), within the cycle."""
    torque_at_rest: float
    """Motor torque at rest (N·m)."""
    torque_needed: float
    """Motor torque that the loads need there (N·m)."""

class SteadyStart_2(Item):
    """It takes more turns than are simulated."""
    outcome: Literal['slow']
    turns: float
    """Simulated turns."""
    time: float
    """Their time (s)."""
    share_of_speed: float
    """Speed then as a share of the cycle's."""

SteadyStart: TypeAlias = "SteadyStart_0 | SteadyStart_1 | SteadyStart_2"

class SteadyFlywheel(Item):
    """The flywheel for a coefficient of speed fluctuation."""
    delta: float
    """Requested δ."""
    inertia: float
    """Inertia to add on the drive link (kg·m²); 0: none is needed."""
    inertia_at_motor: float | None
    """Inertia at the motor's shaft for the same δ (kg·m²), where the motor drives the machine through stages."""
    places: tuple[SteadyShaftFlywheel, ...]
    """The shafts on which it can sit, from the motor to the drive link: the latter alone if the motor acts there, or none is needed."""
    classical: SteadyClassical
    """The classical estimate."""
    cycle: SteadyCycle
    """The cycle with it."""

class SteadyShaftFlywheel(Item):
    """A shaft of the drive train, and the flywheel on it, or why none there makes the fluctuation this small."""
    shaft: int
    """The stage that the shaft drives, counted from 0; the number of stages means the drive link."""
    inertia: float
    """Inertia for δ (kg·m²)."""
    mean_speed: float
    """Mean speed of the shaft (rad/s), by magnitude."""
    kinetic_energy: float
    """Kinetic energy of the flywheel at its mean speed (J)."""
    largest_torque_delivered_by_stage: tuple[float, ...]
    """Largest torque that each stage delivers to the shaft behind it over the turn (N·m), by magnitude."""
    motor_torque: SteadyMotorTorque
    """Motor torque over the cycle (N·m)."""
    losses: float
    """Losses in a cycle (J)."""
    no_flywheel: str | None
    """Why no flywheel here makes the fluctuation this small."""

class SteadyClassical(Item):
    """The flywheel by Wittenbauer's method: constant motor torque, energies at the constant mean speed."""
    work: float
    """ΔW: difference between the largest and the least excess of the work at the drive link over that of the machine (J)."""
    speed: float
    """The constant speed (rad/s)."""
    total: float
    """ΔW/(δ·ω²) (kg·m²): the required total inertia."""
    own: float
    """Existing inertia: the mean of J over the angle (kg·m²), with drive train and rotor."""
    inertia: float
    """Inertia of the flywheel, at least 0 (kg·m²)."""

class Steady(Result):
    """The steady motion of a machine."""
    schema: Literal['jred-steady/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    cycle: SteadyCycle | None
    """The cycle without a further flywheel."""
    no_cycle: str | None
    """Why the machine has no steady cycle without a further flywheel."""
    inductance_left_out: bool
    """Whether the inductance of the motor's winding is neglected: the torque is that of the settled current at each speed."""
    flywheel: SteadyFlywheel | None
    """The flywheel for the requested δ."""
    columns: tuple[str, ...]
    """Names of the columns, with units."""
    rows: tuple[tuple[float | None, ...], ...]
    """A number for each column; null where there is no value."""

class ToleranceRows(Item):
    rule: float | str | None
    machines_that_hold_it: float | str | None
    """[%]."""
    surely_above: float | str | None
    """[%]."""
    surely_below: float | str | None
    """[%]."""
    _5_of_machines_use_at_most: float | str | None
    _50_of_machines_use_at_most: float | str | None
    _95_of_machines_use_at_most: float | str | None
    _99_of_machines_use_at_most: float | str | None
    largest_use: float | str | None

class Tolerance(Result):
    """The data of a sheet."""
    schema: Literal['jred-tolerance/1']
    """Name and version of this form."""
    title: str
    """The machine, and what was computed."""
    notes: tuple[str, ...]
    """Remarks and warnings."""
    rows: tuple[ToleranceRows, ...]
    """The rows: a number, a text, or null for each column; an infinite number is the text "inf"."""
