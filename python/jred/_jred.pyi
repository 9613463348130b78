"""
The native part of the package.
"""

from _typeshed import Incomplete, SupportsGetItem, SupportsLenAndGetItem
import numpy.typing
import typing
from os import PathLike
from pathlib import Path
from typing import Final, SupportsFloat, SupportsIndex, final
__version__: Final[str]

@final
class Machine:
    """
    A machine file that was read and checked.
    """
    def _curves(self, /, positions: SupportsIndex, over: str, speed: SupportsFloat | SupportsIndex | str | None, acceleration: SupportsFloat | SupportsIndex | str | None, links: bool, points: bool, forces: bool, energy: bool) -> "dict[str, numpy.typing.NDArray[numpy.float64]]": ...
    def _set(self, /, path: str, value: str) -> Machine:
        """
        A machine with another value of the quantity at `path`, such as "slider.mass" and "60 kg".
        """
    def _unit(self, /, path: str) -> str:
        """
        The unit of the quantity at `path`; empty for a plain number.
        """
    @property
    def folder(self, /) -> Path:
        """
        The folder from which the files that it names are read.
        """
    @property
    def name(self, /) -> str:
        """
        Name in messages.
        """
    @property
    def quantities(self, /) -> list[tuple[str, str]]:
        """
        Paths of the quantities that can be set, each with its value.
        """
    @property
    def text(self, /) -> str:
        """
        The text of the machine file.
        """
    @property
    def title(self, /) -> str:
        """
        Title of the machine.
        """

@final
class Model:
    """
    A table image with its ticks.
    """
    def __new__(cls, /, image: bytes) -> Model:
        """
        The model of an image as `jred export` writes it.
        """
    def _outcome(self, /, phase: "numpy.typing.NDArray[numpy.uint32]", omega: "numpy.typing.NDArray[typing.Any]", torque: "numpy.typing.NDArray[typing.Any]") -> "tuple[numpy.typing.NDArray[typing.Any], numpy.typing.NDArray[numpy.bool_]]": ...
    def _torque(self, /, phase: "numpy.typing.NDArray[numpy.uint32]", omega: "numpy.typing.NDArray[typing.Any]", alpha: "numpy.typing.NDArray[typing.Any]") -> "numpy.typing.NDArray[typing.Any]": ...
    @property
    def format(self, /) -> str:
        """
        Name of the format, such as "spline-f32".
        """
    def phase(self, /, position: "numpy.typing.NDArray[numpy.float64]") -> "numpy.typing.NDArray[numpy.uint32]":
        """
        Phase words of positions (rad, or m).
        """
    @property
    def scale(self, /) -> list[float]:
        """
        Machine units of fixed-point numbers: torque (N m), speed (rad/s), acceleration (rad/s²) of 1.0.
        """
    @property
    def validity(self, /) -> list[float]:
        """
        Limits of validity: speed (rad/s), acceleration (rad/s²), and the torque's error within them (N m).
        """

@final
class Study:
    """
    A machine over a catalogue.
    """
    def __new__(cls, /, name: str, text: str, folder: str | PathLike[str], catalogues: SupportsGetItem[int, str | PathLike[str]], drive: str | None, steps: SupportsIndex) -> Study: ...
    def evaluate(self, /, values: SupportsGetItem[int, tuple[str, str]]) -> tuple[str, bool, list[tuple[str, float, bool]], list[str]]:
        """
        The judgement of the drive for these values of quantities.
        """
    def is_current(self, /) -> bool:
        """
        Whether the files that the machine names are still as they were read.
        """
    def tolerance(self, /, given: SupportsGetItem[int, tuple[str, str]], samples: SupportsIndex, seed: SupportsIndex, share: SupportsLenAndGetItem[SupportsIndex]) -> "dict[str, dict[str, typing.Any]]":
        """
        Rows of a share of `jred tolerance`.
        """
    def vary(self, /, axes: SupportsGetItem[int, str], share: SupportsLenAndGetItem[SupportsIndex]) -> "dict[str, dict[str, typing.Any]]":
        """
        Rows of a share of `jred vary`: the columns, and what the study is.
        """

def command(words: SupportsGetItem[int, str]) -> int:
    """
    The command line: words behind `jred`; returns the exit code.
    """

def read(name: str, text: str, folder: str | PathLike[str]) -> Machine:
    """
    The machine of a file or a text.
    """

def run(words: SupportsGetItem[int, str], files: SupportsGetItem[int, tuple[str | PathLike[str], str]]) -> tuple[int, str, list[str]]:
    """
    Runs a command of `jred` on a thread of its own, so that Ctrl-C is heeded, and returns its exit code, its standard output and its messages. `files` has texts that stand for files on disk.
    """

def __getattr__(name: str) -> Incomplete: ...
