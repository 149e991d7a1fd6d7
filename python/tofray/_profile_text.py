# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Values changed in the text of a profile, which keeps its comments and its form."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


class _Scanner:
    """Where in YAML text brackets, quotes and comments are."""

    def __init__(self, text: str) -> None:
        self.depths = []  # of brackets before each character
        depth, i = 0, 0
        while i < len(text):
            end = i + 1
            before = text[i - 1] if i else "\n"
            if text[i] == "#" and before in " \t\n":
                end = text.find("\n", i)
                end = len(text) if end < 0 else end
            elif text[i] in "\"'" and text[:i].rstrip(" ")[-1:] in ("", ":", ",", "[", "{", "-", "\n"):
                end = self._quoted_end(text, i)
            self.depths += [depth] * (end - i)
            if end == i + 1:
                depth += (text[i] in "{[") - (text[i] in "}]")
            i = end
        self.depths.append(depth)

    @staticmethod
    def _quoted_end(text: str, start: int) -> int:
        i = start + 1
        while i < len(text):
            if text[i] == "\\" and text[start] == '"':
                i += 2
            elif text[i] == text[start]:
                if text[start] == "'" and text[i + 1 : i + 2] == "'":
                    i += 2
                    continue
                return i + 1
            else:
                i += 1
        return len(text)


def _offset(text: str, line: int, column: int) -> int:
    """Columns count characters."""
    start = 0
    for _ in range(line - 1):
        start = text.index("\n", start) + 1
    return start + column - 1


def _end(text: str, start: int, is_block: bool) -> int:
    """Behind the value that starts there."""
    scan = _Scanner(text)
    depth = scan.depths[start]
    if is_block:
        indent = start - (text.rfind("\n", 0, start) + 1)
        end = last = text.find("\n", start)
        while last >= 0:
            following = text.find("\n", last + 1)
            line = text[last + 1 : following if following >= 0 else len(text)]
            if line.strip() and not line.lstrip().startswith("#"):
                if len(line) - len(line.lstrip()) < indent:
                    break
                end = following if following >= 0 else len(text)
            last = following
        return end if end >= 0 else len(text)
    if text[start] in "{[":
        end = start + 1
        while end < len(text) and scan.depths[end] > depth:
            end += 1
        return end
    if text[start] in "\"'":
        return _Scanner._quoted_end(text, start)
    end = start
    while end < len(text) and text[end] != "\n" and not (depth and text[end] in ",}]"):
        if text[end] == "#" and text[end - 1] in " \t":
            break
        end += 1
    return start + len(text[start:end].rstrip())


def _inserted(text: str, places: Mapping[str, tuple[int, int]], key: str, value: str) -> tuple[int, str]:
    """A key that is not written: beside the first one of the map that it is of."""
    parts = key.split(".")
    for count in range(len(parts) - 1, 0, -1):
        parent = ".".join(parts[:count])
        if parent in places:
            break
    else:
        count = 0
    rest = parts[count:]
    item = rest[-1] + ": " + value
    for name in reversed(rest[:-1]):
        item = f"{name}: {{{item}}}"
    if count == 0:
        return len(text), ("" if text.endswith("\n") else "\n") + item + "\n"
    at = _offset(text, *places[parent])
    if text[at] == "{":
        return at + 1, item + ", "
    indent = at - (text.rfind("\n", 0, at) + 1)
    return at, item + "\n" + " " * indent


def with_values(text: str, places: Mapping[str, tuple[int, int]], values: Sequence[tuple[str, str]]) -> str:
    """The text with values in the places of those that are written, and with new keys where none is.

    Parameters
    ----------
    text : str
        A profile's.
    places : mapping
        Line and column of each value, from 1 on.
    values : sequence of (str, str)
        Keys, and what shall stand there.

    Returns
    -------
    str
    """
    edits = []
    for key, value in values:
        if key not in places:
            at, new = _inserted(text, places, key, value)
            edits.append((at, at, new))
            continue
        start = _offset(text, *places[key])
        is_block = text[start] not in "{[" and any(one.startswith(key + ".") for one in places)
        edits.append((start, _end(text, start, is_block), value))
    for start, end, new in sorted(edits, reverse=True):
        text = text[:start] + new + text[end:]
    return text
