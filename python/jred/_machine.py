"""Machines and firmware models."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import numpy.typing as npt

from . import _jred
from ._errors import JredError
from ._result import Result, run, whole, words_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._answers import Balance, Check, Drive, Fastest, Gentlest, Require, Sensitivity, Simulate, Size, Steady
    from ._options import (
        BalanceOptions,
        CatalogueListOptions,
        CheckOptions,
        DriveOptions,
        ExportOptions,
        FastestOptions,
        GentlestOptions,
        RequireOptions,
        SensitivityOptions,
        SimulateOptions,
        SizeOptions,
        SteadyOptions,
    )

Array = npt.NDArray[np.float64]
Value = str | float | int | np.number[Any]
Paths = str | Path | Sequence[str | Path]


def _toml(data: Mapping[str, Any], path: str = "") -> str:
    """A machine text from a dict: tables, lists of tables, quantities as texts."""

    def plain(value: Any) -> str:
        if isinstance(value, Mapping):
            return "{ " + ", ".join(f"{_key(k)} = {plain(v)}" for k, v in value.items()) + " }"
        if isinstance(value, list | tuple):
            return "[" + ", ".join(map(plain, value)) + "]"
        if isinstance(value, bool):
            return "true" if value else "false"
        if isinstance(value, int | float | np.number):
            return repr(value.item() if isinstance(value, np.number) else value)
        if isinstance(value, str | Path):
            return json.dumps(str(value), ensure_ascii=False)
        raise TypeError(
            f"{path or 'the machine'}: {type(value).__name__} cannot be written; use texts, numbers, lists and dicts"
        )

    def is_table(value: Any) -> bool:
        return isinstance(value, Mapping) or (
            isinstance(value, list | tuple) and bool(value) and all(isinstance(each, Mapping) for each in value)
        )

    lines = [f"{_key(key)} = {plain(value)}" for key, value in data.items() if not is_table(value)]
    for key, value in data.items():
        name = f"{path}.{_key(key)}" if path else _key(key)
        if isinstance(value, Mapping):
            lines += [f"[{name}]", _toml(value, name)]
        elif is_table(value):
            for each in value:
                lines += [f"[[{name}]]", _toml(each, name)]
    return "\n".join(lines)


def _key(key: str) -> str:
    if not isinstance(key, str):
        raise TypeError(f"{key!r} is no key of a machine; keys are texts")
    return key if key.replace("_", "").replace("-", "").isalnum() and key.isascii() else json.dumps(key)


def _plain(name: str, value: Value) -> str | float:
    """A text, or a finite number of Python."""
    if isinstance(value, str):
        return value
    number: object = value.item() if isinstance(value, np.generic | np.ndarray) and value.ndim == 0 else value
    if isinstance(number, bool) or not isinstance(number, int | float):
        raise TypeError(f'{name} = {value!r}; give a text with a unit, such as "60 kg", or a number')
    if not np.isfinite(number):
        raise ValueError(f"{name} = {number}; give a finite number")
    return number


class Machine:
    """A machine file, read and checked; it cannot be changed, ``set`` returns another one.

    ``source``: the path of a machine file, its text of several lines, or a dict of its tables, in which quantities are
    texts with units. Files that a text or dict names are in ``folder``; ``name`` is for messages.
    Raises JredError with file, line, quantity and cure; OSError for a file that cannot be read.
    """

    __slots__ = ("_own", "_units")

    def __init__(self, source: str | Path | Mapping[str, Any], *, name: str | None = None, folder: str | Path = ".") -> None:
        if isinstance(source, Mapping):
            text, path = _toml(source), None
        elif not isinstance(source, str | Path):
            raise TypeError(f"a machine from {type(source).__name__}: give a path, a text or a dict")
        elif isinstance(source, Path) or (source.strip() and "\n" not in source):
            path = Path(source).expanduser()
            # Line ends stay as they are: the digests are those of the command.
            try:
                text = path.read_bytes().decode("utf-8")
            except UnicodeDecodeError:
                run("check", path)
                raise
        else:
            text, path = source, None
        if name and name != Path(name).name:
            raise ValueError(f"name = {name!r}; give a name without a folder, and the folder with folder=")
        if path is not None:
            name, folder = name or path.name, path.parent
        self._own = _jred.read(name or "machine.toml", text, Path(folder).expanduser().resolve())
        self._units: dict[str, str] = {}

    @classmethod
    def _of(cls, own: _jred.Machine) -> Machine:
        machine = object.__new__(cls)
        machine._own, machine._units = own, {}
        return machine

    def __reduce__(self) -> tuple[object, ...]:
        return (_restored, (self.name, self.text, str(self._own.folder)))

    def __repr__(self) -> str:
        return f"Machine({self.title!r})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Machine) and self.__reduce__() == other.__reduce__()

    def __hash__(self) -> int:
        return hash(self.__reduce__())

    @property
    def name(self) -> str:
        """Name of the file in messages."""
        return self._own.name

    @property
    def title(self) -> str:
        """Title of the machine."""
        return self._own.title

    @property
    def text(self) -> str:
        """The machine file."""
        return self._own.text

    @property
    def quantities(self) -> dict[str, str]:
        """Paths of the quantities that ``set`` takes, each with its value."""
        return dict(self._own.quantities)

    def set(self, path: str, value: Value) -> Machine:
        """The machine with another value: ``machine.set("slider.mass", "60 kg")``; a number has the unit of the file.

        Only quantities that the file gives can be set; words and keys are changed in its text.
        """
        return Machine._of(self._own._set(path, self._in_unit(path, value)))

    def _in_unit(self, path: str, value: Value) -> str:
        """A value as text; a number gets the unit of the file."""
        plain = _plain(path, value)
        if isinstance(plain, str):
            return plain
        if path not in self._units:
            self._units[path] = self._own._unit(path)
        return f"{plain!r} {self._units[path]}".strip()

    def curves(
        self,
        positions: int = 360,
        *,
        over: str = "angle",
        speed: float | str | None = None,
        acceleration: float | str | None = None,
        links: bool = False,
        points: bool = False,
        forces: bool = False,
        energy: bool = False,
    ) -> dict[str, Array]:
        """Arrays of ``positions`` numbers by title and unit; NaN for an empty cell.

        By default the reduced inertia J_red with its derivatives, the terms of the reduced torque, and the torque that
        the motion needs; with ``links`` also each link's share. Instead: ``points`` (and links) with their velocities,
        ``forces`` in the joints, ``energy``. ``over``: "angle", or "time" of the motion. ``speed`` and ``acceleration`` of
        the drive link (numbers in rad/s and rad/s², or m/s and m/s²; texts such as "60 rpm") replace those of the motion.
        """
        if over not in ("angle", "time"):
            raise ValueError(f'over = {over!r}; write "angle" or "time"')
        whole("positions", positions, 2, 1_000_000)
        speed, acceleration = (
            None if value is None else _plain(name, value) for name, value in [("speed", speed), ("acceleration", acceleration)]
        )
        return self._own._curves(positions, over, speed, acceleration, links, points, forces, energy)

    def run(self, command: str, *arguments: str | Path, **options: object) -> Any:
        """Runs a command of ``jred`` with this machine, such as ``machine.run("size", top=3)``: its JSON as an object."""
        path = Path(self._own.folder) / self.name
        return run(command, path, *arguments, files={path: self.text}, **options)

    def check(self, **options: Unpack[CheckOptions]) -> Check:
        """``jred check``: closure, mobility, energy balance, noise of a recorded motion."""
        return cast("Check", self.run("check", **options))

    def size(self, **options: Unpack[SizeOptions]) -> Size:
        """``jred size``: drives that satisfy every rule, ranked; ``catalogue``, ``motor``, ``top`` … as of the command."""
        return cast("Size", self.run("size", **options))

    def require(self, **options: Unpack[RequireOptions]) -> Require:
        """``jred require``: what any maker needs to quote a drive."""
        return cast("Require", self.run("require", **options))

    def drive(self, **options: Unpack[DriveOptions]) -> Drive:
        """``jred drive``: the parameters to type into the drive."""
        return cast("Drive", self.run("drive", **options))

    def fastest(self, **options: Unpack[FastestOptions]) -> Fastest:
        """``jred fastest``: the time-optimal motion along the same way."""
        return cast("Fastest", self.run("fastest", **options))

    def gentlest(self, **options: Unpack[GentlestOptions]) -> Gentlest:
        """``jred gentlest``: the motion with the least RMS torque or loss."""
        return cast("Gentlest", self.run("gentlest", **options))

    def steady(self, **options: Unpack[SteadyOptions]) -> Steady:
        """``jred steady``: the steady cycle under a motor, and the flywheel that smooths it."""
        return cast("Steady", self.run("steady", **options))

    def simulate(self, **options: Unpack[SimulateOptions]) -> Simulate:
        """``jred simulate``: the free motion of ``[simulation]``."""
        return cast("Simulate", self.run("simulate", **options))

    def balance(self, **options: Unpack[BalanceOptions]) -> Balance:
        """``jred balance``: counterweights and springs."""
        return cast("Balance", self.run("balance", **options))

    def sensitivity(self, **options: Unpack[SensitivityOptions]) -> Sensitivity:
        """``jred sensitivity``: how each quantity moves the rules."""
        return cast("Sensitivity", self.run("sensitivity", **options))

    def export(self, out: str | Path, **options: Unpack[ExportOptions]) -> str:
        """``jred export``: writes the firmware's table to the file ``out``; returns what the command prints of it.

        ``format="rust"``, ``type="i32"``, ``torque_error="0.01 N m"`` … as of the command.
        """
        path = str(Path(self._own.folder) / self.name)
        words = ["export", path, "--out", str(out), *words_of("export", options)]
        code, printed, messages = _jred.run(words, [(path, self.text)])
        if code:
            raise JredError("\n".join([printed.strip(), *messages]).strip())
        return printed

    def model(self, **options: Unpack[ExportOptions]) -> Model:
        """The firmware's table of ``jred export`` with its ticks; ``type="i32"``, ``torque_error="0.01 N m"`` …."""
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "table.jred"
            self.export(out, **options)
            return Model(out.read_bytes())


def _restored(name: str, text: str, folder: str) -> Machine:
    return Machine._of(_jred.read(name, text, Path(folder)))


class Model:
    """Ticks over a table image, or over the file of one, bit for bit those of firmware.

    Numbers are float32, or the raw int32 of Q31 and int16 of Q15 in the machine units of ``scale``.
    """

    __slots__ = ("_image", "_own")

    def __init__(self, image: bytes | str | Path) -> None:
        self._image = Path(image).read_bytes() if isinstance(image, str | Path) else bytes(image)
        self._own = _jred.Model(self._image)

    def __reduce__(self) -> tuple[object, ...]:
        return (Model, (self._image,))

    @property
    def image(self) -> bytes:
        """The image, as firmware loads it."""
        return self._image

    @property
    def format(self) -> str:
        """Name of the format, such as "spline-f32"."""
        return self._own.format

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of speeds, accelerations and torques."""
        number = self.format.rsplit("-", 1)[-1]
        return np.dtype({"f32": np.float32, "q31": np.int32, "q15": np.int16}[number])

    @property
    def scale(self) -> tuple[float, float, float]:
        """The torque (N m), speed (rad/s) and acceleration (rad/s²) that are 1.0, the raw number 2³¹ or 2¹⁵."""
        torque, speed, acceleration = self._own.scale
        return torque, speed, acceleration

    @property
    def validity(self) -> tuple[float, float, float]:
        """Largest speed and acceleration, and the largest error of the torque within them (SI)."""
        speed, acceleration, torque = self._own.validity
        return speed, acceleration, torque

    def __repr__(self) -> str:
        return f"Model({self.format}, {len(self._image)} bytes)"

    def raw(self, values: npt.ArrayLike, base: float) -> npt.NDArray[Any]:
        """Raw numbers of fixed point of SI values over a base of ``scale``, rounded and saturated; float32 as they are."""
        if self.dtype.kind == "f":
            return np.asarray(values, dtype=np.float32)
        limits = np.iinfo(self.dtype)
        raw = np.rint(np.asarray(values, dtype=np.float64) / base * -float(limits.min))
        return raw.clip(limits.min, limits.max).astype(self.dtype)

    def phase(self, position: npt.ArrayLike) -> npt.NDArray[np.uint32]:
        """Phase words of positions of the drive link (rad, or m)."""
        array = np.asarray(position, dtype=np.float64)
        return self._own.phase(np.ascontiguousarray(array.ravel())).reshape(array.shape)

    def torque(self, phase: npt.ArrayLike, omega: npt.ArrayLike, alpha: npt.ArrayLike) -> npt.NDArray[Any]:
        """Inverse dynamics: the drive torque at phase words, speeds and accelerations, which are broadcast as in NumPy."""
        shape, arrays = self._arrays(phase, omega=omega, alpha=alpha)
        return self._own._torque(*arrays).reshape(shape)

    def acceleration(self, phase: npt.ArrayLike, omega: npt.ArrayLike, torque: npt.ArrayLike) -> npt.NDArray[Any]:
        """Forward dynamics: the acceleration that a drive torque gives."""
        return self.outcome(phase, omega, torque)[0]

    def outcome(
        self, phase: npt.ArrayLike, omega: npt.ArrayLike, torque: npt.ArrayLike
    ) -> tuple[npt.NDArray[Any], npt.NDArray[np.bool_]]:
        """``acceleration``, and where a number of fixed point was saturated on the way."""
        shape, arrays = self._arrays(phase, omega=omega, torque=torque)
        value, saturated = self._own._outcome(*arrays)
        return value.reshape(shape), saturated.reshape(shape)

    def _arrays(self, phase: npt.ArrayLike, **numbers: npt.ArrayLike) -> tuple[tuple[int, ...], list[npt.NDArray[Any]]]:
        """Arrays of one shape, each in a row and of the type of its numbers."""
        arrays = [np.asarray(phase)]
        if arrays[0].dtype != np.uint32:
            raise TypeError(f"phase has {arrays[0].dtype}; phase words are uint32: use model.phase(position)")
        for name, values in numbers.items():
            array = np.asarray(values)
            if array.dtype.kind not in "fiu":
                raise TypeError(f"{name} has {array.dtype}; give numbers")
            if self.dtype.kind == "f":
                with np.errstate(over="ignore"):
                    array = array.astype(np.float32)
                if not np.isfinite(array).all():
                    raise ValueError(f"{name} has numbers that are not finite in float32")
            elif array.dtype.kind == "f" or not np.array_equal(array.astype(self.dtype), array):
                raise TypeError(f"{name} is not raw {self.dtype}, which this model takes: use model.raw")
            else:
                array = array.astype(self.dtype)
            arrays.append(array)
        shape = np.broadcast_shapes(*(array.shape for array in arrays))
        return shape, [np.ascontiguousarray(np.broadcast_to(array, shape).ravel()) for array in arrays]


def catalogue(table: str = "motors", **options: Unpack[CatalogueListOptions]) -> dict[str, npt.NDArray[Any]]:
    """A table of the catalogue by columns, for pandas or polars.

    ``table``: "motors", "linear-motors", "gearboxes", "amplifiers" or "resistors"; options as of ``jred catalogue list``.
    """
    found: Result = run("catalogue", "list", table, **options)
    return found.table("rows")


def _stamp(path: str) -> tuple[tuple[str, int, int], ...]:
    """Names, times and sizes of the files of a catalogue: a changed one is read again."""
    own = Path(path)
    files = sorted(own.rglob("*")) if own.is_dir() else [own]
    stats = ((str(file), file.stat()) for file in files if file.exists())
    return tuple((name, stat.st_mtime_ns, stat.st_size) for name, stat in stats)


#: The studies that were made last.
_KEPT: dict[object, _jred.Study] = {}
_KEEPING = Lock()


def _study(machine: Machine, catalogue: Paths, drive: str | None, steps: int) -> _jred.Study:
    """A machine over a catalogue, read once."""
    whole("steps", steps, 16, 200_000)
    if not isinstance(drive, str | None):
        raise TypeError(f'drive = {drive!r}; give its name, such as "MOTOR+GEARBOX"')
    files = tuple(map(str, [catalogue] if isinstance(catalogue, str | Path) else catalogue))
    key = (machine, files, drive, steps, tuple(map(_stamp, files)))
    study = _KEPT.get(key)
    if study is None or not study.is_current():
        study = _jred.Study(machine.name, machine.text, machine._own.folder, [Path(path) for path in files], drive, steps)
        with _KEEPING:
            while len(_KEPT) >= 16:
                del _KEPT[next(iter(_KEPT))]
            _KEPT[key] = study
    return study


def evaluate(
    machine: Machine | str | Path | Mapping[str, Any],
    overrides: Mapping[str, Value] | None = None,
    *,
    catalogue: Paths = (),
    drive: str | None = None,
    steps: int = 1000,
) -> dict[str, Any]:
    """Judges a drive in the machine with other values of some quantities: for optimisers, pure and picklable.

    Returns ``drive``; ``holds``, whether no rule is violated; ``margins``: 1 less the used share of the limit of each
    rule, negative where it is violated (−inf: a limit of zero), 1 where the rule does not apply or lacks data; in
    ``warnings`` those of rules that only warn; in ``not_checked`` the rules that lack data. Without ``drive`` the best one
    of the catalogue. ``steps`` is that of ``jred vary``; ``jred size`` takes 2000. Raises JredError for values that give
    no machine.
    """
    machine = machine if isinstance(machine, Machine) else Machine(machine)
    if not isinstance(overrides, Mapping | None):
        raise TypeError('overrides: give a dict of values by path, such as {"slider.mass": "60 kg"}')
    study = _study(machine, catalogue, drive, steps)
    values = [(path, machine._in_unit(path, value)) for path, value in (overrides or {}).items()]
    name, holds, used, not_checked = study.evaluate(values)
    margins = {rule: 1.0 - share for rule, share, is_limit in used if is_limit}
    warnings = {rule: 1.0 - share for rule, share, is_limit in used if not is_limit}
    return {"drive": name, "holds": holds, "margins": margins, "warnings": warnings, "not_checked": not_checked}
