# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Measurements of walls for `fit`: rows out of text files and arrays, and which of them count."""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING, Any

from ._errors import BadInput, IoError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

# Columns by name, the one that they become, and the factor to SI.
_COLUMNS = {
    **{f"distance_{unit}": ("distance_m", factor) for unit, factor in (("m", 1.0), ("cm", 1e-2), ("mm", 1e-3))},
    **{f"sigma_{unit}": ("sigma_m", factor) for unit, factor in (("m", 1.0), ("cm", 1e-2), ("mm", 1e-3))},
    **{f"bias_{unit}": ("bias_m", factor) for unit, factor in (("m", 1.0), ("cm", 1e-2), ("mm", 1e-3))},
    "intensity": ("intensity", 1.0), "reflectivity": ("reflectivity", 1.0), "reflectivity_percent": ("reflectivity", 1e-2),
    "ambient_lx": ("ambient_lx", 1.0), "ambient_klx": ("ambient_lx", 1e3),
}
_WORDS = ("class", "mode", "recording")
_POSITIVE = ("distance_m", "sigma_m", "intensity")
_NEEDS_UNIT = {"distance": "distance_m or distance_mm", "sigma": "sigma_mm", "bias": "bias_mm", "ambient": "ambient_lx"}


class Rows:
    """Measurements: arrays of float64 by column, NaN where a row says nothing, and words by column.

    Parameters
    ----------
    numbers : dict
        By column, in SI units.
    words : dict
        Lists of str by column.
    places : list of str
        Where each row stands: "noise.csv:12".
    sources : list of str
        Names of the files.
    total : int
        How many rows there were before some were left out.
    where : str
        The condition by which.
    """

    def __init__(self, numbers: dict[str, Any], words: dict[str, list[str]], places: list[str], sources: list[str], total: int = -1,
                 where: str = "") -> None:
        self.numbers = numbers
        self.words = words
        self.places = places
        self.sources = sources
        self.total = len(places) if total < 0 else total
        self.where = where

    def __len__(self) -> int:
        return len(self.places)

    def number(self, name: str, usual: float = float("nan")) -> Any:
        import numpy as np

        found = self.numbers.get(name)
        if found is None:
            return np.full(len(self), usual)
        return np.where(np.isnan(found), usual, found)

    def word(self, name: str, usual: str = "") -> list[str]:
        return [one or usual for one in self.words.get(name, [""] * len(self))]

    def said(self) -> str:
        """Files and how many of their rows: "noise.csv, 139 of 141 rows (sigma_mm<250)"."""
        files = ", ".join(os.path.basename(one) for one in self.sources)
        count = f"{len(self)} rows" if len(self) == self.total else f"{len(self)} of {self.total} rows"
        return f"{files}, {count}" + (f" ({self.where})" if self.where else "")


def _at(file: str, line: int, column: int, what: str, more: str) -> BadInput:
    return BadInput(f"{file}:{line}:{column}: error: {what}\n  {more}")


def _cells(line: str, separator: str) -> list[tuple[int, str]]:
    """Columns of text, from 1 on, and what stands there."""
    if separator == " ":
        return [(found.start() + 1, found.group()) for found in re.finditer(r"\S+", line)]
    out, start = [], 0
    for part in line.split(separator):
        out.append((start + 1 + len(part) - len(part.lstrip()), part.strip()))
        start += len(part) + 1
    return out


def _check_names(file: str, line: int, names: list[tuple[int, str]]) -> None:
    seen = set()
    for column, name in names:
        if name in _NEEDS_UNIT:
            raise _at(file, line, column, f"the column {name} needs its unit", f"expected {_NEEDS_UNIT[name]}")
        if name not in _COLUMNS and name not in _WORDS and not name.startswith("-"):
            raise _at(file, line, column, f"there is no column {name!r:.40}",
                      f"expected some of {', '.join(_COLUMNS)}, {', '.join(_WORDS)}; -{name[:40]} is read past")
        kind = _COLUMNS.get(name, (name,))[0]
        if kind in seen:
            raise _at(file, line, column, f"the column {name} is there twice", "expected each once")
        seen.add(kind)
    if not seen & {"sigma_m", "bias_m", "intensity", "recording"}:
        raise _at(file, line, 1, "nothing is measured", "expected a column sigma_mm, bias_mm, intensity or recording")
    if "distance_m" not in seen and "intensity" not in seen:
        raise _at(file, line, 1, "the rows say neither a distance nor an intensity",
                  "expected a column distance_m or distance_mm, or intensity beside sigma_mm")


def _number(file: str, line: int, column: int, name: str, text: str) -> float:
    kind, factor = _COLUMNS[name]
    if not text:
        return float("nan")
    percent = kind == "reflectivity" and text.endswith("%")
    try:
        value = float(text[:-1] if percent else text) * (0.01 if percent else factor)
    except ValueError:
        raise _at(file, line, column, f"{name} is no number", f"got {text!r:.40}") from None
    if value != value or abs(value) == float("inf") or (kind in _POSITIVE and not value > 0) or (kind == "ambient_lx" and value < 0):
        raise _at(file, line, column, f"{name} cannot be {text[:40]}",
                  "expected a finite number" + (" above 0" if kind in _POSITIVE else ""))
    if kind == "reflectivity" and not 0 < value <= 1:
        raise _at(file, line, column, f"{name} cannot be {text[:40]}", "expected above 0 and at most 1 (100 %)")
    return value


def read_rows(file: str | os.PathLike[str], columns: Sequence[str] = ()) -> list[dict[str, Any]]:
    """Rows of a text file with a line of names, or with the names given where it has none. A dict each, with "file" and "line".

    Between columns stand commas, semicolons, tabs or blanks; lines that begin with # are read past.
    """
    name = os.fspath(file)
    try:
        with open(name, encoding="utf-8") as read:
            lines = read.read().split("\n")
    except OSError as fault:
        raise IoError(f"{name}: error: it cannot be read\n  {fault.strerror}") from None
    except UnicodeDecodeError:
        raise BadInput(f"{name}: error: this is no text\n"
                       "  expected columns of numbers, their names in the first line; npz files stand in a column `recording`") from None
    names = [(1, one) for one in columns]
    if columns:
        _check_names("--columns", 1, names)
    separator, out = "", []
    for number, line in enumerate(lines, 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        if not separator:
            separator = next((one for one in ",;\t" if one in line), " ")
        cells = _cells(line, separator)
        if not names:
            names = cells
            if re.fullmatch(r"[-+.\d].*", cells[0][1]):
                raise _at(name, number, 1, "the columns have no names",
                          "expected a first line such as distance_mm,sigma_mm; or the names as --columns distance_mm,sigma_mm")
            _check_names(name, number, names)
            continue
        if len(cells) != len(names):
            raise _at(name, number, cells[-1][0], f"there are {len(cells)} columns",
                      f"expected {len(names)}: {', '.join(one for _, one in names)}")
        row: dict[str, Any] = {"file": name, "line": number}
        for (_, column_name), (column, text) in zip(names, cells):
            if column_name in _COLUMNS:
                row[_COLUMNS[column_name][0]] = _number(name, number, column, column_name, text)
            elif column_name in _WORDS:
                row[column_name] = text
        out.append(row)
    if not out:
        raise BadInput(f"{name}: error: there are no rows\n  expected one for each distance, below a line of names")
    return out


def _condition(text: str) -> list[tuple[str, str, str]]:
    out = []
    for part in text.split(","):
        found = re.fullmatch(r"\s*(\w+)\s*(<=|>=|<|>|=)\s*(.+?)\s*", part)
        name = found[1] if found else ""
        if found is None or (name not in _COLUMNS and name not in _WORDS):
            raise BadInput(f"where: error: got {part.strip()!r:.60}\n"
                           "  expected a column, one of < <= > >= =, and a value, as in \"distance_m>2.4, sigma_mm<250\"")
        if name in _COLUMNS:
            try:
                float(found[3])
            except ValueError:
                raise BadInput(f"where: error: {name} is compared with {found[3]!r:.40}\n"
                               "  expected a number in the unit that the column's name ends in") from None
        out.append((name, found[2], found[3]))
    return out


def _holds(row: dict[str, Any], name: str, sign: str, text: str) -> bool:
    if name in _WORDS:
        return bool((row.get(name, "") == text) == (sign == "="))
    kind, factor = _COLUMNS[name]
    value = row.get(kind)
    if value is None or value != value:
        return False
    value, limit = value / factor, float(text)
    return bool({"<": value < limit, "<=": value <= limit * (1 + 1e-12), ">": value > limit, ">=": value >= limit * (1 - 1e-12),
                 "=": abs(value - limit) <= 1e-9 * abs(limit)}[sign])


def rows_of(given: Sequence[dict[str, Any]], sources: list[str], where: str = "") -> Rows:
    """Rows as columns, without those that a condition leaves out."""
    import numpy as np

    conditions = _condition(where) if where else []
    kept = [row for row in given if all(_holds(row, *one) for one in conditions)]
    if not kept:
        raise BadInput(f"where: error: it leaves no row of {len(given)}\n  got {where}")
    kinds = {kind for kind, _ in _COLUMNS.values()}
    numbers = {kind: np.array([row.get(kind, np.nan) for row in kept], float) for kind in kinds if any(kind in row for row in kept)}
    words = {name: [row.get(name, "") for row in kept] for name in _WORDS if any(name in row for row in kept)}
    places = [f"{row['file']}:{row['line']}" if row["line"] else f"row {i}" for i, row in enumerate(kept)]
    return Rows(numbers, words, places, sources, len(given), where)


def rows_of_arrays(data: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Rows out of arrays by column's name."""
    _check_names("data", 1, [(1, str(one)) for one in data])
    lengths = {name: len(values) for name, values in data.items()}
    if len(set(lengths.values())) != 1 or not next(iter(lengths.values())):
        raise BadInput(f"data: error: the columns have other lengths\n"
                       f"  got {', '.join(f'{name}: {count}' for name, count in lengths.items())}")
    out = []
    for i in range(next(iter(lengths.values()))):
        row: dict[str, Any] = {"file": "data", "line": 0}
        for name, values in data.items():
            if name in _COLUMNS:
                text = repr(float(values[i]))
                row[_COLUMNS[name][0]] = float("nan") if text == "nan" else _number("data", i, 1, name, text)
            elif name in _WORDS:
                row[name] = str(values[i])
        out.append(row)
    return out
