"""The command: the program of the tool where it is built, else that of the package."""

import os
import sys

OWN = [sys.executable, "-I", "-c", "import jred; jred.main()"]
JRED = [os.environ["JRED_COMMAND"]] if os.environ.get("JRED_COMMAND") else OWN
