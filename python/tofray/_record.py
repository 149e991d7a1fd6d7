# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What the classes of _model have in common."""

from __future__ import annotations

import copy
from typing import Any

_UNCHANGING = frozenset((int, float, str, bool, type(None)))


def _plain(value: Any) -> Any:
    if isinstance(value, Record):
        return value.to_dict()
    value = _listed(value)
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    return value


def _listed(value: Any) -> Any:
    """Arrays and numbers of numpy's, which members may hold, as lists and numbers of Python's."""
    return value.tolist() if hasattr(value, "tolist") and hasattr(value, "dtype") else value


def _same(one: Any, other: Any) -> bool:
    """Whether two members say the same: a list, a tuple and an array of the same numbers do."""
    one, other = _listed(one), _listed(other)
    if isinstance(one, (list, tuple)) and isinstance(other, (list, tuple)):
        return len(one) == len(other) and all(map(_same, one, other))
    return bool(one == other)


def _copied(value: Any, memo: dict[int, Any]) -> Any:
    """As copy.deepcopy, a twentieth of its time for lists of numbers."""
    kind = type(value)
    if kind in _UNCHANGING:
        return value
    if kind is list:
        if (known := memo.get(id(value))) is not None:
            return known
        out: list[Any] = []
        memo[id(value)] = out  # of a list that is in itself
        out.extend(one if type(one) in _UNCHANGING else _copied(one, memo) for one in value)
        return out
    if kind is tuple and all(type(one) in _UNCHANGING for one in value):
        return value
    return copy.deepcopy(value, memo)


class Record:
    """A struct: members with their units in their names, and no others."""

    __slots__: tuple[str, ...] = ()
    __hash__ = None  # type: ignore[assignment]

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(_same(getattr(self, name), getattr(other, name)) for name in self.__slots__)

    def __deepcopy__(self, memo: dict[int, Any]) -> Any:
        """Simulators copy scenes and cameras: what a caller changes later is not theirs."""
        out = memo[id(self)] = object.__new__(type(self))
        for name in (*self.__slots__, *getattr(self, "__dict__", ())):  # (a class of a user's own may have the latter)
            object.__setattr__(out, name, _copied(getattr(self, name), memo))
        return out

    def __repr__(self) -> str:
        fresh = type(self)()
        said = ((name, getattr(self, name)) for name in self.__slots__)
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in said if not _same(value, getattr(fresh, name)))})"

    def __setattr__(self, name: str, value: Any) -> None:
        try:
            object.__setattr__(self, name, value)
        except AttributeError:
            raise AttributeError(
                f"{type(self).__name__} has no member {name!r}\n  expected one of {', '.join(self.__slots__)}"
            ) from None

    def to_dict(self) -> dict[str, Any]:
        """Members by name, in SI units; structs within as dicts.

        Returns
        -------
        dict
            Lists in place of tuples and arrays, numbers and texts as they are.
        """
        return {name: _plain(getattr(self, name)) for name in self.__slots__}
