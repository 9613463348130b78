"""PlatformIO runs this: it links the library that was compiled for the core of the board."""

import os

Import("env")  # noqa: F821

core = env.BoardConfig().get("build.cpu", "")  # noqa: F821
flags = [str(flag) for key in ("CCFLAGS", "LINKFLAGS") for flag in env.get(key, [])]  # noqa: F821
folder = os.path.join(os.path.realpath("src"), core)
if "-mfloat-abi=softfp" in flags:
    folders = [entry.path for entry in os.scandir(folder) if entry.name.endswith("-softfp")]
    folder = folders[0] if folders else folder
if core and os.path.isfile(os.path.join(folder, "libjred.a")):
    env.Append(LIBPATH=[folder], LIBS=["jred"])  # noqa: F821
else:
    print("jred: no library for the core '%s'; jred99.h needs none" % core)
