"""Time of a tolerance study of 10,000 presses on one worker and on two: ``python speed_up.py [machines]``."""

import sys
import tempfile
import time
from pathlib import Path

from distributed import Client, LocalCluster

from jred import Machine, study


def main() -> None:
    """Print both times, and check that the rows are equal."""
    machine = Machine(Path(__file__).parents[2] / "machines" / "press.toml")
    samples = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    scatter = {"slider.mass": "normal: 5 %", "load.pressing force.force.1": "normal: 5 %"}
    seconds, rows = [], []
    for workers in (1, 2):
        with (
            tempfile.TemporaryDirectory() as parts,
            LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as cluster,
            Client(cluster) as client,
        ):
            begun = time.perf_counter()
            rows.append(study.tolerance(machine, parts, given=scatter, samples=samples, client=client))
            seconds.append(time.perf_counter() - begun)
        print(f"{workers} of 2 workers: {seconds[-1]:.2f} s")
    assert rows[0].equals(rows[1])
    print(f"{seconds[0] / seconds[1] / 2:.1%} of the ideal speed-up")


if __name__ == "__main__":
    main()
