"""PlatformIO runs this: it links the library that was compiled for the core of the board."""

import glob
import os

Import("env")  # noqa: F821

core = env.BoardConfig().get("build.cpu", "")  # noqa: F821
folder = os.path.join(os.path.realpath("src"), core or "none")
flags = [str(flag) for key in ("CCFLAGS", "LINKFLAGS") for flag in env.get(key, [])]  # noqa: F821
libraries = glob.glob(os.path.join(folder, "libjred.a"))
if "-mfloat-abi=softfp" in flags:
    libraries = glob.glob(os.path.join(folder, "*-softfp", "libjred.a")) or libraries
if libraries:
    env.Append(LIBPATH=[os.path.dirname(libraries[0])], LIBS=["jred"])  # noqa: F821
else:
    print("jred: no library for the core '%s'; jred99.h needs none" % core)
