"""A tolerance study on Dask: how likely a drive keeps its rules if the machine scatters.

Run it with ``python tolerance.py [machines]`` (100000 if not given), or as a notebook with ``marimo edit tolerance.py``. On
Slurm only the client changes: ``Client(SLURMCluster(cores=1, memory="2GB"))`` of dask-jobqueue.
"""

import marimo

app = marimo.App()


@app.cell
def _():
    import sys
    import tempfile
    import time
    from pathlib import Path

    import marimo as mo
    from distributed import Client, LocalCluster

    import jred
    from jred import study

    machine = jred.Machine(Path(__file__).resolve().parents[2] / "machines" / "press.toml")
    samples = int(sys.argv[1]) if len(sys.argv) > 1 and sys.argv[1].isdigit() else 100_000
    return Client, LocalCluster, Path, jred, machine, mo, samples, study, tempfile, time


@app.cell
def _(mo):
    mo.md(
        """
        # Tolerances of a press

        The mass of the ram scatters by 8 %, the pressing force by 5 %, lengths by 0.2 mm. Every machine is judged with the drive of the nominal one.
        """
    )


@app.cell
def _(Client, LocalCluster, Path, machine, samples, study, tempfile, time):
    scatter = {
        "mechanism.slider.mass": "normal: 8 %",
        "load.pressing force.force.1": "normal: 5 %",
        "mechanism.crank.length": "0.2 mm",
        "mechanism.rod.length": "0.2 mm",
    }
    with (
        tempfile.TemporaryDirectory() as parts,
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        begun = time.perf_counter()
        rows = study.tolerance(machine, Path(parts), given=scatter, samples=samples, seed=1, client=client)
        seconds = time.perf_counter() - begun
    print(f"{rows.num_rows} machines in {seconds:.1f} s on two workers")
    return (rows,)


@app.cell
def _(mo, rows):
    # A pyarrow Table: pandas and polars take it.
    frame = rows.to_pandas()
    kept = (frame["verdict"] == "holds").mean()
    print(f"{kept:.2%} of the machines keep every rule")
    mo.ui.table(frame.describe().reset_index())


if __name__ == "__main__":
    app.run()
