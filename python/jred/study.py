"""Studies over many machines as tasks of dask.distributed: on the desk, on Slurm or on Kubernetes.

Each finished share of the rows is a Parquet part, written under a temporary name and renamed, with the digests of
machine and catalogue and the options in its metadata. A restart computes the parts that are missing. Needs
``pip install jred[study]``.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any
from uuid import uuid4

from ._machine import Machine, Paths, _study
from ._result import whole

ABOUT = ("study", "version", "machine", "catalogue", "options", "rows", "share")


class PartError(ValueError):
    """A part belongs to another study: other machine, catalogue, options or version."""


def vary(
    machine: Machine | str | Path,
    axes: Sequence[str],
    out: str | Path,
    *,
    catalogue: Paths = (),
    shares: int = 64,
    steps: int = 1000,
    client: Any = None,
    progress: Callable[[int, int], None] | None = None,
) -> Any:
    """``jred vary``: every machine of a grid, sized. ``axes`` as of ``--vary``, such as "slider.mass=40..60 kg:20".

    Returns the rows in their order as a pyarrow Table, equal bit for bit for any ``client`` and number of shares. Columns
    of rules have the used shares of limits. The folder ``out`` keeps the parts; ``progress`` gets how many of the shares
    are done.
    """
    axes = [axes] if isinstance(axes, str) else list(axes)
    if not axes:
        raise ValueError('axes is empty; give what varies, such as ["slider.mass=40..60 kg:20"]')
    return _run("vary", (axes,), machine, out, catalogue, None, shares, steps, client, progress)


def tolerance(
    machine: Machine | str | Path,
    out: str | Path,
    *,
    given: Mapping[str, str] | None = None,
    samples: int = 1000,
    seed: int = 1,
    drive: str | None = None,
    catalogue: Paths = (),
    shares: int = 64,
    steps: int = 1000,
    client: Any = None,
    progress: Callable[[int, int], None] | None = None,
) -> Any:
    """``jred tolerance``: machines that scatter about this one, with one drive judged in each.

    ``given``: amounts by path, such as {"slider.mass": "normal: 2 %"}, besides those of ``[tolerance]``.
    """
    if not isinstance(given, Mapping | None) or not all(isinstance(amount, str) for amount in (given or {}).values()):
        raise TypeError('given: a dict of amounts by path, such as {"slider.mass": "5 %"}')
    whole("samples", samples, 1, 100_000_000)
    whole("seed", seed, 0, 2**64 - 1)
    asked = (list((given or {}).items()), samples, seed)
    return _run("tolerance", asked, machine, out, catalogue, drive, shares, steps, client, progress)


def share(
    kind: str,
    asked: tuple[Any, ...],
    machine: Machine,
    out: str,
    catalogue: tuple[str, ...],
    drive: str | None,
    steps: int,
    index: int,
    count: int,
) -> int:
    """One share of a study, as a part in ``out``: a task with the same rows on any worker, any number of times."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    path = Path(out) / f"part-{index:05}-of-{count:05}.parquet"
    if path.exists() and _read(path) is not None:
        return index
    study = _study(machine, catalogue, drive, steps)
    found = getattr(study, kind)(*asked, [index, count])
    table = pa.table({name: _typed(pa, column) for name, column in found["columns"].items()})
    about = {**found["about"], "share": f"{index}/{count}"}
    about = {key: about[key] for key in ABOUT}
    table = table.replace_schema_metadata({**about, "digest": _digest(about, table)})
    partial = path.with_suffix(f".{uuid4().hex}.partial")
    try:
        pq.write_table(table, partial)
        os.replace(partial, path)
    except OSError:
        partial.unlink(missing_ok=True)
        raise
    return index


def _typed(pa: Any, column: Any) -> Any:
    """Numbers as float64, row numbers as they are, anything else as text."""
    if all(value is None for value in column):
        return pa.nulls(len(column))
    if all(value is None or isinstance(value, float) for value in column):
        return pa.array(column, type=pa.float64())
    if all(isinstance(value, int) for value in column):
        return pa.array(column, type=pa.uint64())
    return pa.array([None if value is None else str(value) for value in column], type=pa.string())


def _digest(about: Mapping[str, str], table: Any) -> str:
    """Of every bit of a part."""
    return sha256(json.dumps([about, table.to_pydict()]).encode()).hexdigest()


def _read(path: Path) -> Any:
    """A part; None if it is damaged."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        part = pq.read_table(path)
        known = {key.decode(): value.decode() for key, value in (part.schema.metadata or {}).items()}
        digest = known.pop("digest", None)
        return part if digest == _digest({key: known.get(key, "") for key in ABOUT}, part) else None
    except (pa.ArrowException, ValueError):
        return None
    except OSError as error:
        # pyarrow raises it for damaged files too, then without a number.
        if error.errno:
            raise
        return None


def _same(path: Path, part: Any, own: dict[str, str], shares: int) -> None:
    """Refuses a part of another study."""
    metadata = {} if part is None else part.schema.metadata or {}
    known = {key.decode(): value.decode() for key, value in metadata.items()}
    asked = {**{key: own[key] for key in ABOUT[:-1]}, "share": f"{int(path.name[5:10])}/{shares}"}
    differs = [f"{key} is {known.get(key)}, not {value}" for key, value in asked.items() if known.get(key) != value]
    if differs:
        raise PartError(f"{path} is of another study: {'; '.join(differs)}. Choose another folder, or remove its parts")


def _run(
    kind: str,
    asked: tuple[Any, ...],
    machine: Machine | str | Path,
    out: str | Path,
    catalogue: Paths,
    drive: str | None,
    shares: int,
    steps: int,
    client: Any,
    progress: Callable[[int, int], None] | None,
) -> Any:
    import pyarrow as pa

    whole("shares", shares, 1, 100_000)
    if client is not None and not hasattr(client, "submit"):
        raise TypeError(f"client = {client!r}; give a distributed.Client")
    machine = machine if isinstance(machine, Machine) else Machine(machine)
    folder = Path(out).expanduser()
    folder.mkdir(parents=True, exist_ok=True)
    catalogue = [catalogue] if isinstance(catalogue, str | Path) else catalogue
    files = tuple(str(path) if str(path) == "built-in" else str(Path(path).resolve()) for path in catalogue)
    # The study of these options: its first share has no row beyond the last, so that nothing is computed twice.
    study = _study(machine, files, drive, steps)
    own = getattr(study, kind)(*asked, [2**62, 1])["about"]
    for path in sorted(folder.glob(f"part-{'[0-9]' * 5}-of-*.parquet")):
        # A damaged part is computed again.
        if (part := _read(path)) is not None:
            _same(path, part, own, shares)
    tasks = [(kind, asked, machine, str(folder.resolve()), files, drive, steps, k, shares) for k in range(shares)]
    if client is None:
        for done, task in enumerate(tasks, 1):
            share(*task)
            if progress:
                progress(done, shares)
    else:
        _on(client, tasks, progress)
    paths = [folder / f"part-{k:05}-of-{shares:05}.parquet" for k in range(shares)]
    parts = [_read(path) for path in paths]
    for path, part in zip(paths, parts):
        # A worker may have another version of jred, of the catalogue or of a file that the machine names.
        _same(path, part, own, shares)
    rows = pa.concat_tables(parts, promote_options="permissive").sort_by("row")
    return rows.replace_schema_metadata({key: own[key] for key in ABOUT[:-1]})


def _on(client: Any, tasks: list[tuple[Any, ...]], progress: Callable[[int, int], None] | None) -> None:
    """Runs the tasks on a cluster; a task whose worker dies is run again elsewhere."""
    from distributed import as_completed

    futures = [client.submit(share, *task, pure=False, retries=3) for task in tasks]
    for done, future in enumerate(as_completed(futures), 1):  # type: ignore[no-untyped-call]
        future.result()
        if progress:
            progress(done, len(tasks))
