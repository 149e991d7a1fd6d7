# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""How commands of the Python package alone end: what they say of a fault, and their exit code, which is that of ``tofray``."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING

from ._errors import Error

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable

_EXIT_CODES = {"undetermined": 1, "bad_input": 2, "io": 3, "limit": 4}


def _kind(fault: Error | ImportError) -> str:
    return "undetermined" if type(fault).__name__ == "Undetermined" else str(getattr(fault, "kind", "io"))


def exit_code_of(run: Callable[[argparse.Namespace], None], options: argparse.Namespace) -> int:
    """Runs a command; a fault goes to stderr and, with ``--json``, as an object to stdout."""
    try:
        run(options)
    except (Error, ImportError) as fault:
        text = str(fault) if isinstance(fault, Error) else f"error: {fault}"
        if options.json:
            print(json.dumps({"good": False, "error": text}))
        print(text, file=sys.stderr)
        return _EXIT_CODES.get(_kind(fault), 5)
    return 0
