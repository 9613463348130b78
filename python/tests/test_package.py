"""The package against the command, closed forms, and itself on a cluster."""

from __future__ import annotations

import json
import os
import pickle
import re
import signal
import subprocess
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command import JRED, OWN

import jred
from jred import Machine, evaluate, study

MACHINES = Path(__file__).parents[2] / "machines"
PRESS = MACHINES / "press.toml"


def command(*words: str) -> tuple[int, str]:
    run = subprocess.run([*JRED, *words], capture_output=True, text=True, check=False)
    return run.returncode, run.stdout


@pytest.mark.parametrize("path", sorted(MACHINES.glob("*.toml")), ids=lambda path: path.stem)
def test_results_are_those_of_the_command(path: Path) -> None:
    for name, options in [("size", {"top": 3}), ("check", {})]:
        words = [name, str(path), "--format", "json"]
        code, out = command(*words, *[word for key, value in options.items() for word in (f"--{key}", str(value))])
        if code == 2:
            with pytest.raises(jred.JredError):
                Machine(path).run(name, **options)
            continue
        found = Machine(path).run(name, **options)
        assert found.code == code
        assert found.to_dict() == json.loads(out)


def test_every_figure_is_an_attribute() -> None:
    def look(item: Any) -> int:
        count = 0
        for name in dir(item):
            value = getattr(item, name) if not name.startswith("_") else None
            if isinstance(value, jred.Result | type(item)) and hasattr(value, "to_dict"):
                count += look(value)
            count += isinstance(value, float | int) and not isinstance(value, bool)
        return count

    sized = Machine(PRESS).size(top=2)
    assert look(sized.fit[0]) > 5
    with pytest.raises(AttributeError, match="motor"):
        sized.fit[0].moter
    with pytest.raises(AttributeError):
        sized.code = 0


def test_curves_are_those_of_the_command() -> None:
    for path in [PRESS, MACHINES / "six-link.toml", MACHINES / "four-bar.toml"]:
        for options in [{}, {"points": True}, {"energy": True}]:
            found = Machine(path).curves(50, **options)
            words = [f"--{name}" for name in options]
            _, out = command("reduce", str(path), "--positions", "50", "--format", "csv", *words)
            header, *rows = out.strip().splitlines()
            columns = np.array([[float(x or "nan") for x in row.split(",")] for row in rows]).T
            assert [name.replace('"', "") for name in header.split(",")] == list(found)
            for name, column in zip(found, columns, strict=True):
                np.testing.assert_array_equal(found[name], column)


def test_reduced_inertia_of_a_slider_crank() -> None:
    r, rod, mass = 0.03, 0.18, 42.0
    text = """gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "slider-crank"
crank = { length = "30 mm", mass = "0 kg", inertia = "0.001 kg m^2", com = ["0 mm", "0 mm"] }
rod = { length = "180 mm", mass = "0 kg", inertia = "0 kg m^2", com = ["0 mm", "0 mm"] }
slider = { mass = "42 kg" }
"""
    machine = Machine(text)
    found = machine.curves(64)
    phi = np.deg2rad(found["phi [deg]"])
    slope = -r * np.sin(phi) - r * r * np.sin(phi) * np.cos(phi) / np.sqrt(rod * rod - (r * np.sin(phi)) ** 2)
    np.testing.assert_allclose(found["J_red [kg m^2]"], 1e-3 + mass * slope**2, rtol=0, atol=1e-13)
    twice = machine.set("slider.mass", "84 kg").curves(64)
    np.testing.assert_allclose(twice["J_red [kg m^2]"] - 1e-3, 2 * (found["J_red [kg m^2]"] - 1e-3), rtol=0, atol=1e-14)

    def bar(length: str) -> dict[str, Any]:
        inertia = "0.001 kg m^2" if length == "30 mm" else "0 kg m^2"
        return {"length": length, "mass": "0 kg", "inertia": inertia, "com": ["0 mm", "0 mm"]}

    as_dict = {
        "gravity": ["0 m/s^2", "0 m/s^2"],
        "mechanism": {"type": "slider-crank", "crank": bar("30 mm"), "rod": bar("180 mm"), "slider": {"mass": "42 kg"}},
    }
    same = Machine(as_dict).curves(64)
    for name, column in found.items():
        np.testing.assert_array_equal(same[name], column)


@pytest.mark.parametrize(("kind", "digits"), [("f32", 1e-5), ("i32", 1e-5), ("i16", 1e-2)])
def test_ticks_are_exact_dynamics(kind: str, digits: float, tmp_path: Path) -> None:
    model = Machine(PRESS).model(type=kind, torque_error="0.05 N m" if kind != "i16" else "2 N m")
    path = tmp_path / "press.jred"
    error = "0.05 N m" if kind != "i16" else "2 N m"
    command("export", str(PRESS), "--type", kind, "--torque-error", error, "--out", str(path))
    assert path.read_bytes() == model.image
    curves = Machine(PRESS).curves(32, speed=10.0, acceleration=50.0)
    position = np.deg2rad(curves["phi [deg]"])
    phase = model.phase(position)
    torque_base, speed_base, acceleration_base = model.scale
    if model.dtype == np.float32:
        omega, alpha, unit = np.full(32, 10, np.float32), np.full(32, 50, np.float32), 1.0
    else:
        one = 2.0 ** (8 * model.dtype.itemsize - 1)
        omega = model.raw(np.full(32, 10.0), speed_base)
        alpha = model.raw(np.full(32, 50.0), acceleration_base)
        assert omega[0] == round(10.0 / speed_base * one)
        assert model.raw(-9 * speed_base, speed_base) == -one
        unit = torque_base / one
    torque = model.torque(phase, omega, alpha)
    assert torque.dtype == model.dtype
    due = curves["T_drive [N m]"]
    assert np.abs(torque * unit - due).max() < digits * np.abs(due).max() + 3 * model.validity[2]
    back = model.acceleration(phase, omega, torque)
    assert np.abs(back.astype(float) - alpha).max() <= 10 * digits * np.abs(alpha).max()
    again = pickle.loads(pickle.dumps(model))
    np.testing.assert_array_equal(again.torque(phase, omega, alpha), torque)


def test_ticks_have_the_bits_of_controllers() -> None:
    """The digests that five Cortex-M cores print: random ticks as in examples/bits."""
    examples = MACHINES.parent / "examples"
    images = {
        "f32 spline": "data/press_f32",
        "f32 cubic": "bits/data/f32_cubic",
        "f32 quadratic": "bits/data/f32_quadratic",
        "f32 harmonics": "bits/data/f32_harmonic",
        "f32 slider-crank": "bits/data/f32_slider_crank",
        "q31 spline": "data/press_q31",
        "q31 cubic, 1/J": "bits/data/q31_cubic_seed",
        "q31 quadratic, 1/J": "bits/data/q31_quadratic_seed",
        "q31 spline16, 1/J": "bits/data/q31_spline16_seed",
        "q15 rows": "bits/data/q15_rows",
        "q15 rows, 1/J": "bits/data/q15_rows_seed",
    }
    due = {}
    for line in (examples / "expected" / "bits.txt").read_text(encoding="utf-8").splitlines():
        name, *rest = line.rsplit(maxsplit=2)
        due.setdefault(name, rest)

    count, state, words = 10_000, 2_463_534_242, []
    for _ in range(4 * count):
        state ^= state << 13 & 0xFFFFFFFF
        state ^= state >> 17
        state ^= state << 5 & 0xFFFFFFFF
        words.append(state)
    phase, *others = np.array(words, np.uint32).reshape(count, 4).T.copy()

    def drawn(bits: np.ndarray, dtype: np.dtype[Any], limit: float) -> np.ndarray:
        if dtype == np.float32:
            return bits.view(np.int32).astype(np.float32) * (np.float32(limit) / np.float32(2**30))
        return (bits.view(np.int32) >> (32 - 8 * dtype.itemsize)).astype(dtype) >> (bits % 8).astype(dtype)

    for name, path in images.items():
        model = jred.Model((examples / f"{path}.jred").read_bytes())
        speed, acceleration, _ = model.validity
        limits = [speed, acceleration, 500.0]
        omega, alpha, torque = (drawn(bits, model.dtype, limit) for bits, limit in zip(others, limits))
        omega[::16] = 0
        needed = model.torque(phase, omega, alpha)
        gained, saturated = model.outcome(phase, omega, torque)
        raw = np.int32 if model.dtype == np.float32 else model.dtype
        results = [array.view(raw).astype(np.int64) & 0xFFFFFFFF for array in (needed, gained)]
        digest = 2_166_136_261
        for row in np.stack([*results, saturated.astype(np.int64)], 1).tolist():
            for word in row:
                digest = (digest ^ word) * 16_777_619 & 0xFFFFFFFF
        assert [f"{digest:08x}", str(int(saturated.sum()))] == due[name], name


def test_ticks_are_broadcast() -> None:
    model = Machine(PRESS).model(torque_error="0.05 N m")
    phase = model.phase([[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]])
    torque = model.torque(phase, 3.0, [1.0, 2.0, 3.0])
    assert torque.shape == (2, 3)
    assert torque[1, 2] == model.torque(model.phase(0.6), 3.0, 3.0)
    assert model.torque(model.phase(0.6), 3.0, 3.0).shape == ()


def test_evaluate_is_pure_and_picklable() -> None:
    machine = pickle.loads(pickle.dumps(Machine(PRESS)))
    drive = "sgm7a-30a-brake+tp004mf-4"
    heavy = evaluate(machine, {"slider.mass": 60.0}, drive=drive)
    assert heavy == evaluate(machine, {"mechanism.slider.mass": "60 kg"}, drive=drive)
    strong = evaluate(machine, {"load.pressing force.force.1": "-12 kN"}, drive=drive)
    assert strong["margins"]["peak torque"] < evaluate(machine, drive=drive)["margins"]["peak torque"]
    sized = Machine(PRESS).size(top=1)
    best = evaluate(machine)
    margins = {check.rule: check.margin for check in sized.fit[0].checks if check.margin is not None}
    assert best["holds"] and best["drive"].startswith(sized.fit[0].motor)
    # The command takes 2000 steps.
    fine = evaluate(machine, steps=2000)
    assert "brake work" in fine["not_checked"]
    fine = fine["margins"] | fine["warnings"]
    assert len(margins) > 10
    # An optimiser gets as many constraints for every machine.
    assert evaluate(machine, {"slider.mass": "189.8 kg"}, steps=2000)["margins"].keys() == evaluate(machine)["margins"].keys()
    for rule, margin in margins.items():
        assert fine[rule] == pytest.approx(margin, abs=1e-9)
    with ThreadPoolExecutor(4) as pool:
        for found in pool.map(lambda _: evaluate(machine, {"slider.mass": 60.0}, drive=drive), range(8)):
            assert found == heavy


BAD: list[tuple[Any, type[Exception], str]] = [
    (lambda m: m.set("slider.mass", "60 apples"), jred.JredError, "apples"),
    (lambda m: m.set("slider.mas", "60 kg"), jred.JredError, "slider.mass"),
    (lambda m: evaluate(m, {"crank.lenght": 1.0}), jred.JredError, "crank.length"),
    (lambda m: evaluate(m, {"slider.mass": float("nan")}), ValueError, "finite"),
    (lambda m: evaluate(m, {"slider.mass": "60 s"}), jred.JredError, "mass"),
    (lambda m: evaluate(m, {"slider.mass": -3.0}), jred.JredError, "mass"),
    (lambda m: evaluate(m, drive="no-such-drive"), jred.JredError, "no-such-drive"),
    (lambda m: evaluate(m, catalogue=["no-such-folder"]), jred.JredError, "no-such-folder"),
    (lambda m: m.curves(1), ValueError, "positions"),
    (lambda m: m.curves(speed=float("nan")), ValueError, "finite"),
    (lambda m: m.curves(over="turn"), ValueError, "time"),
    (lambda m: m.curves(acceleration=3.0), ValueError, "speed"),
    (lambda m: m.curves(speed="60 apples"), jred.JredError, "apples"),
    (lambda m: m.curves(speed=1.0, over="time"), ValueError, "motion"),
    (lambda m: m.curves(positions=2.5), TypeError, "whole"),
    (lambda m: Machine(m.text.split("[motion]")[0]).curves(forces=True), jred.JredError, "speed"),
    (lambda m: Machine(m.text.split("[motion]")[0]).curves(over="time"), jred.JredError, "motion"),
    (lambda m: m.run("vary", vary="slider.mass=40,50 kg"), ValueError, "study.vary"),
    (lambda m: m.size(tops=3), jred.JredError, "did you mean top=?"),
    (lambda m: m.size(top="x"), jred.JredError, "'x'"),
    (lambda m: m.size(help=True), jred.JredError, "help="),
    (lambda m: m.size(top=True), jred.JredError, "takes a value"),
    (lambda m: m.size(full="yes"), jred.JredError, "True or False"),
    (lambda m: m.curves(speed=np.ones(3)), TypeError, "speed"),
    (lambda m: evaluate(m, [("slider.mass", 5)]), TypeError, "dict"),
    (lambda m: evaluate(m, drive=3), TypeError, "drive = 3"),
    (lambda m: study.tolerance(m, "unused", given={"slider.mass": 5}), TypeError, "given"),
    (lambda m: study.vary(m, AXES, "unused", client="tcp://x"), TypeError, "Client"),
    (lambda m: m.set("mechanism.type", "four-bar"), jred.JredError, "word"),
    (lambda _: Machine({"gravity": {3: "0 m/s^2"}}), TypeError, "key"),
    (lambda m: m.model(torque_error="0.05 N m").torque(np.zeros(1, np.uint32), [1j], [1.0]), TypeError, "complex"),
    (lambda m: m.size(format="csv"), jred.JredError, "format="),
    (lambda _: jred.run("new"), ValueError, "no JSON"),
    (lambda _: jred.run("--version"), ValueError, "keywords"),
    (lambda _: jred.run("sice", PRESS), jred.JredError, "'size'"),
    (lambda m: m.size(top=1)["fits"], KeyError, "refused"),
    (lambda m: m.check().report(), ValueError, "no report"),
    (lambda m: evaluate(m, steps=-1), ValueError, "steps"),
    (lambda m: evaluate(m, {"slider.mass": 60, "mechanism.slider.mass": 50}), jred.JredError, "given twice"),
    (lambda m: Machine(m.text, name="sub/press.toml"), ValueError, "folder="),
    (lambda _: jred.catalogue("--help"), ValueError, "keywords"),
    (lambda m: m.size(top=1).table("title"), TypeError, "fit"),
    (lambda m: m.model(torque_error="0.05 N m").phase([1e18]), ValueError, "at most 1000000 rad"),
    (lambda m: evaluate(m, steps=0.5), TypeError, "steps"),
    (lambda m: study.tolerance(m, "unused", samples=0), ValueError, "samples"),
    (lambda m: study.tolerance(m, "unused", samples=-5), ValueError, "samples"),
    (lambda m: study.tolerance(m, "unused", seed=-1), ValueError, "seed"),
    (lambda m: study.vary(m, [], "unused"), ValueError, "axes"),
    (lambda m: study.vary(m, AXES, "unused", shares=0), ValueError, "shares"),
    (lambda m: evaluate(m, {"slider.mass": True}), TypeError, "60 kg"),
    (lambda m: m.set("slider.mass", None), TypeError, "60 kg"),
    (lambda _: Machine(""), jred.JredError, "empty"),
    (lambda _: Machine(3), TypeError, "path"),
    (lambda _: Machine("gravity = [\n"), jred.JredError, "TOML"),
    (lambda _: Machine({"gravity": object()}), TypeError, "object"),
    (lambda _: Machine(Path("none.toml")), OSError, "none.toml"),
    (lambda _: jred.Model(b"abc"), ValueError, "4 bytes"),
    (lambda m: jred.Model(m.model(torque_error="0.05 N m").image[:-8]), ValueError, ""),
    (
        lambda m: m.model(torque_error="0.05 N m").torque(np.zeros(3, np.uint32), 1.0, [1.0, 2.0]),
        ValueError,
        "shape mismatch",
    ),
    (lambda m: m.model(torque_error="0.05 N m").torque(np.zeros(1, np.uint32), [np.nan], [1.0]), ValueError, "finite"),
    (lambda m: m.model(torque_error="0.05 N m").torque(np.zeros(1, np.uint32), [1e39], [1.0]), ValueError, "finite"),
    (lambda m: m.model(torque_error="0.05 N m").torque(np.zeros(1), [1.0], [1.0]), TypeError, "uint32"),
    (
        lambda m: m.model(type="i32", torque_error="0.05 N m").torque(np.zeros(1, np.uint32), [1.0], [1.0]),
        TypeError,
        "model.raw",
    ),
]


@pytest.mark.parametrize(("call", "kind", "words"), BAD)
def test_bad_input_is_named(call: Any, kind: type[Exception], words: str) -> None:
    with pytest.raises(kind) as raised:
        call(Machine(PRESS))
    assert words in str(raised.value)


def test_an_error_keeps_its_place() -> None:
    text = PRESS.read_text(encoding="utf-8").replace('"42 kg"', '"42 km"')
    with pytest.raises(jred.JredError) as raised:
        Machine(text, name="heavy.toml")
    error = pickle.loads(pickle.dumps(raised.value))
    line = next(k for k, line in enumerate(text.splitlines(), 1) if "42 km" in line)
    assert (error.file, error.line, error.quantity) == ("heavy.toml", line, "mass")
    assert error.excerpt == text.splitlines()[line - 1].strip() and error.cure


def test_a_machine_keeps_its_folder_and_its_line_ends(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = PRESS.read_text(encoding="utf-8")
    (tmp_path / "press.toml").write_bytes(text.replace("\n", "\r\n").encode())
    monkeypatch.chdir(tmp_path)
    machine = Machine("press.toml")
    assert machine.text.count("\r\n") == text.count("\n")
    assert machine == Machine(tmp_path / "press.toml") and hash(machine) == hash(Machine("press.toml"))
    (tmp_path / "other").mkdir()
    monkeypatch.chdir(tmp_path / "other")
    assert machine.size(top=1).to_dict() == Machine(tmp_path / "press.toml").size(top=1).to_dict()
    with pytest.raises(jred.JredError, match=re.escape("press.toml")):
        machine.export(tmp_path / "press.toml", torque_error="1 N m")
    assert (tmp_path / "press.toml").read_bytes() == machine.text.encode()


def test_a_changed_profile_is_read_again(tmp_path: Path) -> None:
    for file in MACHINES.glob("load-table.*"):
        (tmp_path / file.name).write_bytes(file.read_bytes())
    machine = Machine(tmp_path / "load-table.toml")
    assert evaluate(machine)["drive"]
    named = next(tmp_path / word for word in machine.text.split('"') if word.endswith(".csv"))
    named.write_text("nothing", encoding="utf-8")
    with pytest.raises(jred.JredError, match=re.escape(named.name)):
        evaluate(machine)


def test_ctrl_c_ends_a_call(tmp_path: Path, request: pytest.FixtureRequest) -> None:
    # A test run in the background ignores the signal.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    request.addfinalizer(lambda: signal.signal(signal.SIGINT, before))
    threading.Timer(0.5, os.kill, [os.getpid(), signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        Machine(PRESS).run("tolerance", tolerance="slider.mass=5%", samples=100_000_000, steps=16)
    threading.Timer(0.5, os.kill, [os.getpid(), signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        study.tolerance(Machine(PRESS), tmp_path, given={"slider.mass": "5 %"}, samples=10_000_000, shares=1)
    assert list(tmp_path.iterdir()) == []
    again = Machine(PRESS).run("tolerance", tolerance="slider.mass=5%", samples=3, steps=16)
    assert again.code in (0, 1)


def test_a_report_is_that_of_its_result(tmp_path: Path) -> None:
    path = tmp_path / "press.toml"
    path.write_bytes(PRESS.read_bytes())
    found = jred.run("size", path, top=1)
    assert "<svg" in found.report()
    path.write_text(Machine(PRESS).set("slider.mass", "60 kg").text, encoding="utf-8")
    with pytest.raises(ValueError, match="have changed"):
        found.report()


def test_a_small_stack_is_enough() -> None:
    threading.stack_size(256 * 1024)
    try:
        with ThreadPoolExecutor(1) as pool:
            assert pool.submit(lambda: evaluate(Machine(MACHINES / "elliptic-drive.toml"))).result()["margins"]
    finally:
        threading.stack_size(0)


def test_a_large_text_is_refused() -> None:
    with pytest.raises(jred.JredError, match="the maximum is 1 MiB"):
        Machine("x = 1\n" * 180_000)


def test_tables_for_frames() -> None:
    import pandas as pd
    import polars as pl

    sized = Machine(PRESS).size(top=5)
    table = sized.table("fit")
    frame = pd.DataFrame(table)
    assert frame["motor"][0] == sized.fit[0].motor
    assert frame["margin of peak torque"][0] == next(c.margin for c in sized.fit[0].checks if c.rule == "peak torque")
    curves = Machine(PRESS).curves(16)
    assert pl.DataFrame(curves).shape == (16, len(curves))
    assert "<svg" in sized.report()
    assert sized._repr_html_().startswith("<iframe")


AXES = ["slider.mass=40..60 kg:5", "segment.1.duration=0.4..0.5 s:4"]


def test_a_study_on_a_cluster_has_the_same_rows(tmp_path: Path) -> None:
    from distributed import Client, LocalCluster

    machine = Machine(PRESS)
    alone = study.vary(machine, AXES, tmp_path / "alone", shares=3, steps=200)
    assert alone.num_rows == 20
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        killed = iter(list(cluster.workers.values()))

        def kill(done: int, _: int) -> None:
            worker = next(killed, None) if done in (2, 4) else None
            if worker is not None:
                worker.process.process.kill()

        found = study.vary(machine, AXES, tmp_path / "cluster", shares=7, steps=200, client=client, progress=kill)
    assert found.equals(alone)
    part = tmp_path / "alone" / "part-00001-of-00003.parquet"
    whole = part.read_bytes()
    part.write_bytes(whole[:100])
    assert study.vary(machine, AXES, tmp_path / "alone", shares=3, steps=200).equals(alone)
    random = np.random.default_rng(1)
    for _ in range(60):
        damaged = bytearray(whole)
        damaged[random.integers(len(whole))] ^= 1 << random.integers(8)
        part.write_bytes(damaged)
        assert study.vary(machine, AXES, tmp_path / "alone", shares=3, steps=200).equals(alone)
    with pytest.raises(study.PartError, match=r"machine is [0-9a-f]+, not [0-9a-f]+"):
        study.vary(machine.set("slider.mass", "43 kg"), AXES, tmp_path / "alone", shares=3, steps=200)
    with pytest.raises(study.PartError, match="share is 0/3, not 0/4"):
        study.vary(machine, AXES, tmp_path / "alone", shares=4, steps=200)


def test_a_full_disk_loses_no_part(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import pyarrow.parquet as pq

    machine, written = Machine(PRESS), pq.write_table

    def full(table: Any, where: Any, **options: Any) -> None:
        if "part-00002" in str(where):
            Path(where).write_bytes(b"PAR1")
            raise OSError(28, "No space left on device")
        written(table, where, **options)

    monkeypatch.setattr(pq, "write_table", full)
    with pytest.raises(OSError, match="No space left"):
        study.vary(machine, AXES, tmp_path, shares=4, steps=200)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["part-00000-of-00004.parquet", "part-00001-of-00004.parquet"]
    monkeypatch.undo()
    before = [path.stat().st_mtime_ns for path in sorted(tmp_path.iterdir())]
    assert study.vary(machine, AXES, tmp_path, shares=4, steps=200).num_rows == 20
    assert [path.stat().st_mtime_ns for path in sorted(tmp_path.iterdir())][:2] == before


def test_a_part_that_cannot_be_read_is_not_lost(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import pyarrow.parquet as pq

    study.vary(Machine(PRESS), AXES, tmp_path, shares=2, steps=200)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}

    def refused(*_: Any, **__: Any) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(pq, "read_table", refused)
    with pytest.raises(PermissionError):
        study.vary(Machine(PRESS), AXES, tmp_path, shares=2, steps=200)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_two_versions_of_a_catalogue_are_told_apart(tmp_path: Path) -> None:
    machine, folder = Machine(PRESS), tmp_path / "catalogue"
    folder.mkdir()
    head = (
        "key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],max_speed [rpm],rotor_inertia [kg cm^2],source"
    )
    motors = folder / "motors.csv"
    motors.write_text(f"{head}\nm1,A,M,40,3000,160,6000,40,data sheet\n", encoding="utf-8")
    options: dict[str, Any] = {"catalogue": [folder], "shares": 2, "steps": 200}
    assert study.vary(machine, AXES, tmp_path / "parts", **options).num_rows == 20
    motors.write_text(f"{head}\nm1,A,M,41,3000,160,6000,40,data sheet\n", encoding="utf-8")
    with pytest.raises(study.PartError, match=r"catalogue is [0-9a-f]+, not"):
        study.vary(machine, AXES, tmp_path / "parts", **options)


def test_a_study_has_the_rows_of_the_command(tmp_path: Path) -> None:
    rows = study.vary(Machine(PRESS), AXES, tmp_path, shares=4, steps=200).to_pylist()
    words = [word for axis in AXES for word in ("--vary", axis)]
    _, out = command("vary", str(PRESS), "--steps", "200", "--format", "json", *words)
    due = [json.loads(line) for line in out.splitlines()[1:]]
    assert len(rows) == len(due) == 20
    for row, own in zip(rows, due, strict=True):
        for name in ["verdict", "motor", "gearbox", "margin", "worst rule"]:
            assert row[name] == own[name]


def test_tolerance_in_shares(tmp_path: Path) -> None:
    given = {"slider.mass": "normal: 5 %"}
    options: dict[str, Any] = {"given": given, "samples": 12, "drive": "sgm7a-30a-brake+tp004mf-4", "steps": 200}
    one = study.tolerance(Machine(PRESS), tmp_path / "one", shares=1, **options)
    many = study.tolerance(Machine(PRESS), tmp_path / "many", shares=5, **options)
    assert one.num_rows == 12
    assert one.equals(many)
    words = ["--tolerance", "slider.mass=normal: 5 %", "--samples", "12", "--drive", options["drive"], "--steps", "200"]
    rows = tmp_path / "rows.json"
    command("tolerance", str(PRESS), *words, "--format", "json", "--out", str(rows))
    due = [json.loads(line) for line in rows.read_text(encoding="utf-8").splitlines()[1:]]
    assert len(due) == 12 and len(due[0]) > 5
    for row, own in zip(one.to_pylist(), due, strict=True):
        assert {name: row[name] for name in own} == own
    part = tmp_path / "many" / "part-00001-of-00005.parquet"
    (tmp_path / "many" / "part-00000-of-00005.parquet").write_bytes(part.read_bytes())
    with pytest.raises(study.PartError, match="share is 1/5, not 0/5"):
        study.tolerance(Machine(PRESS), tmp_path / "many", shares=5, **options)


def test_the_package_has_the_crates_of_the_command() -> None:
    def versions(path: Path) -> dict[str, set[str]]:
        found: dict[str, set[str]] = {}
        for name, version in re.findall(r'name = "(.+)"\nversion = "(.+)"', path.read_text(encoding="utf-8")):
            found.setdefault(name, set()).add(version)
        return found

    own, root = (versions(MACHINES.parent / folder / "Cargo.lock") for folder in ("python", "."))
    assert {name: found for name, found in own.items() if name in root and not found <= root[name]} == {}


def test_the_command_in_the_package() -> None:
    def run(*words: str) -> tuple[int, str]:
        ran = subprocess.run([*OWN, *words], capture_output=True, text=True, check=False)
        return ran.returncode, ran.stdout

    code, out = run("--version")
    assert (code, out.split()[-1]) == (0, jred.__version__)
    assert run("size", "none.toml")[0] == 2
    assert run("size", str(PRESS), "--top", "2") == command("size", str(PRESS), "--top", "2")


def test_the_catalogue_as_a_frame() -> None:
    import pandas as pd

    for table, least in [("motors", 180), ("gearboxes", 100), ("amplifiers", 10), ("resistors", 10)]:
        frame = pd.DataFrame(jred.catalogue(table))
        assert len(frame) >= least and frame["key"].is_unique
    assert pd.DataFrame(jred.catalogue("gearboxes"))["ratio"].dtype == float
