"""Machines with one degree of freedom: reduced inertia and torque, servo sizing, studies, firmware ticks.

The same core as the command ``jred`` and the firmware library computes every figure. Quantities have their units in
the keys, such as ``"J_red [kg m^2]"``; docs/python.md shows the package.
"""

from __future__ import annotations

import sys

from ._errors import JredError
from ._jred import __version__
from ._jred import command as _command
from ._machine import Machine, Model, catalogue, evaluate
from ._result import Result, run

__all__ = ["JredError", "Machine", "Model", "Result", "__version__", "catalogue", "evaluate", "main", "run"]


def main() -> None:
    """The command ``jred``."""
    import signal

    # Ctrl-C ends a command, as without Python.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_command(sys.argv[1:]))
