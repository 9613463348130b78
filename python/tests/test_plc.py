"""The function blocks for PLCs: executed, and compared with the image, with splines of SciPy, and with the library's own figures."""

from __future__ import annotations

import math
import re
import subprocess
from functools import cache
from json import loads
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
import structured_text
from command import JRED
from scipy.interpolate import BSpline

MACHINES = Path(__file__).parents[2] / "machines"
#: Load and friction as curves; a stroke in metres; constants alone; friction by speed as a curve. With the largest error of the table.
OPTIONS = {"press": "1 N m", "excavator-bucket": "5 N", "hoist": "1 N m", "shaking-feeder": "0.1 N m"}
NAMES = list(OPTIONS)


@cache
def exported(machine: str, form: str, *more: str) -> str:
    """What ``jred export`` writes."""
    with TemporaryDirectory() as folder:
        out = Path(folder) / f"{machine.replace('-', '_')}.{form}"
        path = str(MACHINES / f"{machine}.toml")
        words = ["export", path, "--torque-error", OPTIONS[machine], "--format", form, *more, "--out", str(out)]
        run = subprocess.run([*JRED, *words], capture_output=True, text=True, check=False)
        assert run.returncode == 0, run.stderr
        return out.read_text(encoding="utf-8")


class Reference:
    """The tick over the words of the image, written from docs/table-image.md with the splines of SciPy."""

    def __init__(self, words: list[int], start: float, span: float) -> None:
        image = np.array(words, dtype=np.uint32)
        numbers = image.view(np.float32).astype(np.float64)
        _, curves, layout, self.stroke = np.array([words[3]], dtype=np.uint32).view(np.uint8)
        assert (layout, words[19] != 0) == (1, True)
        self.cells, self.start, self.span = words[4], start, span
        self.validity = numbers[10:12]
        columns = [name for bit, name in enumerate(["load", "viscous", "coulomb"]) if curves & (1 << bit)]
        columns = ["inertia", *columns]
        rows = numbers[24:-1].reshape(self.cells + 3, len(columns))
        self.points = dict(zip(columns, rows.T))
        knots = np.arange(-3, self.cells + 4, dtype=float)
        self.curves = {name: BSpline(knots, 6 * points, 3) for name, points in self.points.items()}
        self.offset, self.viscous, self.coulomb = numbers[13:16]

    def curve(self, name: str, x: np.ndarray, constant: float = 0.0) -> np.ndarray:
        return self.curves[name](x) if name in self.curves else np.full_like(x, constant)

    def tick(self, position: np.ndarray, omega: np.ndarray, alpha: np.ndarray, torque: np.ndarray) -> dict[str, np.ndarray]:
        share = (position - self.start) / self.span
        share = np.clip(share, 0, 1) if self.stroke else share - np.floor(share)
        x = share * self.cells
        inertia = self.curve("inertia", x) + self.offset
        slope = self.curves["inertia"].derivative()(x) * self.cells / self.span
        resisting = 0.5 * slope * omega**2 + self.curve("viscous", x, self.viscous) * omega - self.curve("load", x)
        resisting += np.abs(self.curve("coulomb", x, self.coulomb)) * np.sign(omega)
        return {
            "torque": inertia * alpha + resisting,
            "acceleration": (torque - resisting) / inertia,
            "inertia": inertia,
            "slope": slope,
            "terms": np.abs(inertia * alpha) + np.abs(0.5 * slope * omega**2) + np.abs(resisting) + np.abs(torque),
        }


def prepared(machine: str) -> tuple[str, Any, Reference, list[str]]:
    text = exported(machine, "st")
    made = structured_text.blocks(text)
    tick = made[machine.replace("-", "_")]()
    words = loads(exported(machine, "json", "--layout", "spline"))["words"]
    names = ["Torque", "Force"] if "DriveTorque" in text else ["Force", "Torque"]
    assert "Drive" + names[1] not in text
    return text, tick, Reference(words, tick.START, tick.SPAN), names


@pytest.mark.parametrize("machine", NAMES)
def test_numbers_are_those_of_the_image(machine: str) -> None:
    text, tick, reference, _ = prepared(machine)
    arrays = structured_text.arrays(text)
    named = {"inertia": "inertias", "load": "loads", "viscous": "viscouses", "coulomb": "coulombs"}
    assert set(arrays) == {named[name] for name in reference.points} | {"rows"}
    for name, points in reference.points.items():
        found = np.array(arrays[named[name]])
        np.testing.assert_array_equal(found.view(np.uint64), points.view(np.uint64))
    assert (reference.cells, reference.offset) == (tick.CELLS, tick.OFFSET)
    limits = [tick.MAX_SPEED, tick.MAX_ACCELERATION]
    np.testing.assert_allclose(limits, reference.validity, rtol=1e-6)


@pytest.mark.parametrize("machine", NAMES)
def test_the_block_computes_what_the_table_says(machine: str) -> None:
    _, tick, reference, [effort, _] = prepared(machine)
    random, count = np.random.default_rng(7), 4000
    near = random.uniform(-0.2, 1.2, count) * reference.span + reference.start
    far = random.uniform(-1e6, 1e6, count // 4)
    knots = reference.start + np.arange(reference.cells + 1) * (reference.span / reference.cells)
    position = np.concatenate([near, far, knots])
    number = len(position)
    omega = random.uniform(-1.3, 1.3, number) * tick.MAX_SPEED
    omega[random.random(number) < 0.05] = 0.0
    alpha = random.uniform(-1.3, 1.3, number) * tick.MAX_ACCELERATION
    torque = random.uniform(-2, 2, number) * reference.tick(position, omega, alpha, 0 * alpha)["torque"]
    expected = reference.tick(position, omega, alpha, torque)
    found = {name: np.empty(number) for name in ("torque", "acceleration", "inertia", "slope")}
    status = np.empty(number)
    for k in range(number):
        inputs = {"Position": position[k], "Speed": omega[k], "Acceleration": alpha[k], f"Drive{effort}": torque[k]}
        tick(Unit=1.0, **{name: float(value) for name, value in inputs.items()})
        found["torque"][k] = getattr(tick, f"Required{effort}")
        found["acceleration"][k] = tick.ResultingAcceleration
        found["inertia"][k], found["slope"][k], status[k] = tick.Inertia, tick.InertiaSlope, tick.Status
    # A position far away has lost digits before it arrives: its own rounding moves the place in the table.
    lost = np.spacing(np.abs(position)) * 2 * reference.cells / reference.span
    for name, scale in [
        ("torque", np.max(expected["terms"])),
        ("inertia", np.max(expected["inertia"])),
        ("acceleration", np.max(expected["terms"] / expected["inertia"])),
        ("slope", np.max(np.abs(expected["slope"])) + 1e-3 * np.max(expected["inertia"])),
    ]:
        error = np.abs(found[name] - expected[name]) / scale
        assert np.max(error - lost) < 1e-12, (name, np.max(error))
    share = (position - reference.start) / reference.span
    beyond = ((share < -1e-9) | (share > 1 + 1e-9)) if reference.stroke else np.zeros(number, bool)
    fast, hard = np.abs(omega) > tick.MAX_SPEED * (1 + 1e-9), np.abs(alpha) > tick.MAX_ACCELERATION * (1 + 1e-9)
    np.testing.assert_array_equal(status, beyond + 2 * fast + 4 * hard)
    assert 0.05 < np.mean(fast) < 0.5 and np.mean(status == 0) > 0.3


@pytest.mark.parametrize("machine", NAMES)
def test_the_block_for_the_plc_agrees_with_the_library(machine: str) -> None:
    text = exported(machine, "st")
    name = machine.replace("-", "_")
    test = structured_text.blocks(text)[f"{name}_test"]()
    assert not test.Passed
    assert test().Passed
    assert 0.0 <= test.Worst < 1e-12
    # One wrong control point is found.
    wrong = re.sub(r"(INERTIAS : ARRAY.*\n\s*)(-?)(\d)", r"\1\g<2>1\3", text)
    test = structured_text.blocks(wrong)[f"{name}_test"]()
    assert not test().Passed


@pytest.mark.parametrize("machine", NAMES)
def test_units_and_inputs_that_are_no_numbers(machine: str) -> None:
    _, tick, reference, [effort, _] = prepared(machine)
    position = reference.start + 0.3 * reference.span
    inputs = {"Position": position, "Speed": 0.4 * tick.MAX_SPEED, "Acceleration": 0.3 * tick.MAX_ACCELERATION}
    inputs[f"Drive{effort}"] = 1.25
    tick(Unit=1.0, **inputs)
    wanted = getattr(tick, f"Required{effort}"), tick.ResultingAcceleration
    unit = math.radians(1) if effort == "Torque" else 1e-3
    scaled = {name: value / unit if not name.startswith("Drive") else value for name, value in inputs.items()}
    tick(Unit=unit, **scaled)
    found = getattr(tick, f"Required{effort}"), tick.ResultingAcceleration * unit
    np.testing.assert_allclose(found, wanted, rtol=1e-11)
    assert tick.Status == 0
    for name in [*inputs, "Unit"]:
        for bad in [math.nan, math.inf, -math.inf, 1e31, *([0.0, -1.0] if name == "Unit" else [])]:
            tick(**{"Unit": 1.0, **inputs, name: bad})
            outputs = getattr(tick, f"Required{effort}"), tick.ResultingAcceleration, tick.Inertia, tick.InertiaSlope
            assert (tick.Status, outputs) == (8, (0.0, 0.0, 0.0, 0.0)), (name, bad)
    tick(Unit=1.0, **inputs)
    assert (tick.Status, getattr(tick, f"Required{effort}")) == (0, wanted[0])


@pytest.mark.parametrize("machine", NAMES)
def test_plcopen_xml_is_the_same_program(machine: str) -> None:
    text = exported(machine, "st")
    root = ElementTree.fromstring(exported(machine, "plcopen"))
    space = {"p": "http://www.plcopen.org/xml/tc6_0200", "h": "http://www.w3.org/1999/xhtml"}
    words = {"inputVars": "VAR_INPUT", "outputVars": "VAR_OUTPUT", "localVars": "VAR"}
    blocks = re.split(r"(?<=END_FUNCTION_BLOCK\n)\n?", text)[:2]
    pous = root.findall(".//p:pou", space)
    assert [pou.get("pouType") for pou in pous] == ["functionBlock"] * 2
    for pou, block in zip(pous, blocks):
        assert f"FUNCTION_BLOCK {pou.get('name')}\n" in block
        body = pou.findtext("p:body/p:ST/h:xhtml", namespaces=space)
        assert body and block.endswith(f"END_VAR\n\n{body}END_FUNCTION_BLOCK\n")
        declared = {}
        for group in pou.find("p:interface", space) or []:
            use = words.get(group.tag.split("}")[1])
            if use is None:
                continue
            use += " CONSTANT" if group.get("constant") == "true" else ""
            for variable in group:
                kind = variable.find("p:type", space)
                assert kind is not None
                array, derived = kind.find("p:array", space), kind.find("p:derived", space)
                base = kind if array is None else array.find("p:baseType", space)
                named = derived.get("name") if derived is not None else base[0].tag.split("}")[1]  # type: ignore[index]
                values = [value.get("value") for value in variable.iterfind(".//p:simpleValue", space)]
                if array is not None:
                    dimension = array.find("p:dimension", space)
                    assert dimension is not None and dimension.get("upper") == str(len(values) - 1)
                declared[variable.get("name")] = (use, named, values)
        in_text = {}
        for use, listed in re.findall(r"^(VAR\w*(?: CONSTANT)?)\n(.*?)^END_VAR", block, re.M | re.S):
            plain = re.sub(r"\(\*.*?\*\)", "", listed, flags=re.S)
            for name, kind, value in re.findall(r"(\w+) : (?:ARRAY\S+ OF )?(\w+)(?: := ([^;]*))?;", plain):
                in_text[name] = (use, kind, re.sub(r"[\[\]\s]", "", value).split(",") if value else [])
        assert declared == in_text
