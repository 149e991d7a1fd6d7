#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""run.py PACKAGES TEST: runs a file of tests with the module that stands in PACKAGES; 77 where it or pytest is not there."""

import glob
import importlib.util
import os
import sys


def main() -> int:
    packages, test = sys.argv[1:]
    if not glob.glob(os.path.join(packages, "tofray", "_native*.so")):
        print("SKIPPED: the Python module was not built (Debian: python3-dev pybind11-dev)")
        return 77
    for needed in ("pytest", "numpy"):
        if importlib.util.find_spec(needed) is None:
            print(f"SKIPPED: {needed} is not installed (Debian: python3-{needed})")
            return 77
    os.environ["PYTHONPATH"] = packages
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    os.execv(sys.executable, [sys.executable, "-X", "faulthandler", "-m", "pytest", "-q", "-p", "no:cacheprovider", "-rs", test])


if __name__ == "__main__":
    sys.exit(main())
