"""Results of commands: the JSON of ``jred COMMAND --format json`` as objects."""

from __future__ import annotations

import json
import re
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches
from functools import lru_cache
from keyword import iskeyword
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _jred
from ._errors import JredError

Files = Mapping[str | Path, str]


#: Names of a mapping and of a result, which no figure can have.
_TAKEN = {"get", "items", "keys", "values", "to_dict", "table", "code", "messages", "report"}


def _attribute(key: str) -> str:
    """The name of a key without its unit: ``rated power [W]`` is ``rated_power``, ``J_red'`` is ``J_red_1``, ``from`` is ``from_``."""
    name = re.sub(r"\s*\[[^\]]*\]\s*$", "", key)
    name = name.replace("''", "_2").replace("'", "_1")
    name = re.sub(r"\W+", "_", name).strip("_")
    name = name if name[:1].isalpha() or name[:1] == "_" else f"_{name}"
    return f"{name}_" if name in _TAKEN or iskeyword(name) else name


def _made(value: Any) -> Any:
    if isinstance(value, dict):
        return Item(value)
    if isinstance(value, list):
        return tuple(_made(each) for each in value)
    return value


class Item(Mapping[str, Any]):
    """An object of a result: keys as in JSON, with units, or attributes without them."""

    __slots__ = ("_data", "_names")

    _data: dict[str, Any]
    _names: dict[str, str]

    def __init__(self, data: dict[str, Any]) -> None:
        object.__setattr__(self, "_data", data)
        object.__setattr__(self, "_names", {_attribute(key): key for key in data})

    # Type checkers know the attributes of each answer from its class.
    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            names: dict[str, str] = object.__getattribute__(self, "_names")
            if name not in names:
                raise AttributeError(f"no {name!r}; there is {', '.join(names)}")
            return _made(self._data[names[name]])

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("results cannot be changed")

    def __getitem__(self, key: str) -> Any:
        return _made(self._at(key))

    def _at(self, key: str) -> Any:
        if key not in self._data:
            raise KeyError(f"{key}; there is {', '.join(self._data)}")
        return self._data[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self._names})

    def __repr__(self) -> str:
        def short(value: Any) -> str:
            return "…" if isinstance(value, dict | list) else repr(value)

        shown = (f"{name}={short(self._data[key])}" for name, key in self._names.items())
        return f"{type(self).__name__}({', '.join(shown)})"

    def __reduce__(self) -> tuple[object, ...]:
        return (type(self), (self._data,))

    def to_dict(self) -> dict[str, Any]:
        """The data as in JSON."""
        copied: dict[str, Any] = json.loads(json.dumps(self._data))
        return copied

    def table(self, key: str) -> dict[str, npt.NDArray[Any]]:
        """The rows of a list of objects, or the columns of numbers, as arrays by name: for pandas or polars.

        Objects in a row become columns such as "duty.RMS torque [N m]"; the margins of checks "margin of peak torque".
        """
        rows = self._at(key)
        if rows is None:
            rows = []
        if isinstance(rows, dict) and all(isinstance(column, list) for column in rows.values()):
            return {name: _column(column) for name, column in rows.items()}
        if isinstance(rows, list) and rows and isinstance(rows[0], list) and "columns" in self._data:
            names = self._data["columns"]
            return {name: _column(list(column)) for name, column in zip(names, zip(*rows))}
        if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
            tables = (name for name, value in self._data.items() if isinstance(value, list))
            raise TypeError(f"{key} is not a table; lists are {', '.join(tables)}")
        rows = [dict(_flat(row)) for row in rows]
        names = list(dict.fromkeys(name for row in rows for name in row))
        return {name: _column([row.get(name) for row in rows]) for name in names}


def _flat(row: dict[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """The cells of a row."""
    for name, value in row.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{before}{name}.")
        elif name == "checks" and not before:
            yield from ((f"margin of {check['rule']}", check["margin"]) for check in value)
        else:
            yield f"{before}{name}", value


def _column(values: list[Any]) -> npt.NDArray[Any]:
    numbers = [np.nan if value is None else value for value in values]
    if all(isinstance(value, float | int) and not isinstance(value, bool) for value in numbers):
        return np.asarray(numbers, dtype=np.float64)
    column = np.empty(len(values), dtype=object)
    column[:] = values
    return column


class Result(Item):
    """The result of a command, with its exit ``code`` (1: a rule is violated) and the ``messages`` that it prints."""

    __slots__ = ("_again", "code", "messages")

    code: int
    messages: tuple[str, ...]
    _again: tuple[list[str], list[tuple[str, str]]] | None

    def __init__(
        self,
        data: dict[str, Any],
        code: int = 0,
        messages: Sequence[str] = (),
        again: tuple[list[str], list[tuple[str, str]]] | None = None,
    ) -> None:
        super().__init__(data)
        object.__setattr__(self, "code", code)
        object.__setattr__(self, "messages", tuple(messages))
        object.__setattr__(self, "_again", again)

    def __reduce__(self) -> tuple[object, ...]:
        return (type(self), (self._data, self.code, self.messages, self._again))

    @property
    def holds(self) -> bool:
        """Whether every requirement is satisfied."""
        return self.code == 0

    def report(self) -> str:
        """The page of ``--report``, with drawing and plots."""
        if self._again is None or "--report" not in _options(self._again[0][0]):
            raise ValueError("this result has no report")
        words, files = self._again
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "report.html"
            _, out, _ = _jred.run([*words, "--format", "json", "--report", str(page)], files)
            if json.loads(out) != self._data:
                raise ValueError("the files of this result have changed since; run it again")
            return page.read_text(encoding="utf-8")

    def _repr_html_(self) -> str | None:
        try:
            page = self.report()
        except ValueError:
            return None
        page = page.replace("&", "&amp;").replace('"', "&quot;")
        return f'<iframe srcdoc="{page}" style="width:100%;height:40em;border:0"></iframe>'


def whole(name: str, value: object, least: int, most: int) -> None:
    """Refuses anything but a whole number from ``least`` to ``most``."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer):
        raise TypeError(f"{name} = {value!r}; give a whole number")
    if not least <= value <= most:
        raise ValueError(f"{name} = {value}; give {least} to {most}")


@lru_cache(maxsize=64)
def _options(command: str) -> Mapping[str, bool]:
    """The options of a command, such as "size" or "catalogue list", and whether each takes a value."""
    found = re.findall(r"^ +(?:-\w, )?(--[a-z-]+)( <)?", _jred.run([*command.split(), "--help"], [])[1], re.MULTILINE)
    return {option: bool(value) for option, value in found}


#: Options that write files besides the result; a second run for the report leaves them out.
_WRITE = {"report", "pdf", "xlsx", "out", "profile", "cam", "plan", "plan_error"}


def words_of(command: str, options: Mapping[str, object]) -> list[str]:
    """Options of the command line: ``top=3`` is ``--top 3``; True is the option alone, a list repeats it."""
    words: list[str] = []
    for name, value in options.items():
        option = "--" + name.rstrip("_").replace("_", "-")
        known = _options(command)
        if option not in known or option == "--help" or (option == "--format" and command != "export"):
            near = get_close_matches(option, known, 1, 0.75)
            cure = f"did you mean {near[0][2:].replace('-', '_')}=?" if near else None
            raise JredError(f"`jred {command}` has no option {name}=", cure=cure, quantity=name)
        if value is not None and isinstance(value, bool) == known[option]:
            raise JredError(
                f"{name} = {value!r}; {'it takes a value' if known[option] else 'give True or False'}", quantity=name
            )
        if value is None or value is False:
            continue
        if value is True:
            words.append(option)
            continue
        each = value if isinstance(value, list | tuple) else [value]
        for one in each:
            words += [option, str(one)]
    return words


def run(command: str, *arguments: str | Path, files: Files | None = None, **options: object) -> Any:
    """Runs a command of ``jred`` and returns its JSON as a Result.

    ``files`` has texts that stand for files on disk. Raises JredError.
    """
    if command in ("vary", "export"):
        raise ValueError(f"{command} has no JSON; use jred.study.vary, Machine.export or Machine.model")
    words = [command, *map(str, arguments)]
    if any(word.startswith("-") for word in words):
        raise ValueError("give options as keywords: --top 3 is top=3")
    name = " ".join(words[:2]) if command == "catalogue" else command
    if "--format" not in _options(name):
        raise ValueError(f"{name} has no JSON; use the command jred")
    texts = [(str(path), text) for path, text in (files or {}).items()]
    code, out, messages = _jred.run([*words, *words_of(name, options), "--format", "json"], texts)
    again = {option: value for option, value in options.items() if option not in _WRITE}
    return Result(json.loads(out), code, messages, ([*words, *words_of(name, again)], texts))
