# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""``python -m tofray …``: the command line, with the same arguments; ``python -m tofray fit …``, ``calibrate …`` and ``dask …`` are of Python alone."""

from __future__ import annotations

import os
import shutil
import sys


def command() -> str | None:
    """The command that belongs to this package: in a wheel, in the build tree, below the same prefix, or on the path."""
    here = os.path.dirname(os.path.abspath(__file__ if os.path.exists(__file__) else sys.argv[0]))
    places = [os.path.join(here, "bin", "tofray"), os.path.join(here, "..", "..", "apps", "tofray", "tofray"),
              os.path.join(here, "..", "..", "..", "..", "bin", "tofray")]
    for place in (os.environ.get("TOFRAY_COMMAND", ""), *places):
        if place and os.path.isfile(place) and os.access(place, os.X_OK):
            return os.path.normpath(place)
    return shutil.which("tofray")


def main() -> int:
    if sys.argv[1:2] == ["fit"]:
        from ._fit_command import main as fit

        return fit(sys.argv[2:])
    if sys.argv[1:2] == ["calibrate"]:
        from ._calibrate_command import main as calibrate

        return calibrate(sys.argv[2:])
    if sys.argv[1:2] == ["dask"]:
        from ._dask_command import main as dask

        return dask(sys.argv[2:])
    found = command()
    if found is None:
        print("error: the command tofray is neither beside this package nor on the path\n"
              "  expected it there, or its place in the environment variable TOFRAY_COMMAND", file=sys.stderr)
        return 3
    os.execv(found, [found, *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
