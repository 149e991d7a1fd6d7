# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Errors: one class, and for each kind a subclass that is also the exception that Python's own functions would raise."""

from __future__ import annotations


class Error(Exception):
    """What went wrong, with the text of C++: its first line is complete in itself, further ones say how to mend it.

    Attributes
    ----------
    kind : str
        "bad_input" (also a ValueError), "io" (also an OSError), "limit" (also a MemoryError), "device" or "bug" (RuntimeError), or
        "stopped": by ``Simulator.stop()``.
    """

    kind = "bug"

    def __reduce__(self) -> tuple[object, ...]:
        return error_of, (self.kind, str(self))


class BadInput(Error, ValueError):
    """A fault in what the caller or a file says."""

    kind = "bad_input"


class IoError(Error, OSError):
    """A file that cannot be read or written."""

    kind = "io"


class LimitError(Error, MemoryError):
    """Out of memory, or over a limit that ``tofray --limits`` prints."""

    kind = "limit"


class DeviceError(Error, RuntimeError):
    """No such device, or it failed."""

    kind = "device"


class Stopped(Error):
    """``Simulator.stop()`` ended the frame."""

    kind = "stopped"


class Bug(Error, RuntimeError):
    """A fault of tofray's own."""


def error_of(kind: str, text: str) -> Error:
    for one in (BadInput, IoError, LimitError, DeviceError, Stopped):
        if one.kind == kind:
            return one(text)
    return Bug(text)


for _one in (Error, BadInput, IoError, LimitError, DeviceError, Stopped, Bug):
    _one.__module__ = "tofray"
