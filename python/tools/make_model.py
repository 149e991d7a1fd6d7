#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Writes python/tofray/_model.py: the public structs as classes of Python, with types and docstrings; _model_names.py: their names, which
the package offers; and _arrays.py: the arrays of a frame.

Names, types and values come from the compiled module, which has them from the compiler; what a member is, its unit and its range come from
its row in src/model (tofray_rows, which the build puts beside the package). Classes, and members that have no row (results, and what readers write), are said by the comments of include/tofray.
Run after a change of them: PYTHONPATH=build/release/python python/tools/make_model.py
"""

from __future__ import annotations

import pathlib
import re
import sys
import textwrap
from typing import Any

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
HEAD = '''# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Scene and camera: what include/tofray/scene.h and camera.h hold. Written by python/tools/make_model.py; do not edit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Sequence

from ._pinhole import PinholeMethods
from ._pose import PlacementMethods, PoseMethods
from ._record import Record

if TYPE_CHECKING:
    from typing import Literal

    from ._native import MeshMotion, ReflectivityMap, TriangleMesh, VectorMap
'''


def declared(code: str) -> list[str]:
    """The members that a line declares: "double k1 = 0, k2 = 0;" has two."""
    code = re.sub(r"\{[^{}]*\}", "", code.strip())
    if not code.endswith((";", "=")) or code.startswith(("enum", "return", "static", "using")) or "(" in code:
        return []
    plain = re.sub(r"<[^;=]*>", "", code).rstrip(";=")
    first, *others = plain.split(",")
    words = first.partition("=")[0].split()
    return [words[-1], *(other.partition("=")[0].strip() for other in others)] if len(words) > 1 else []


def reasons() -> dict[str, str]:
    """What has happened where a flag is the reason, by its name: rows of flags.h, which are members where structs count them."""
    rows = (ROOT / "include/tofray/flags.h").read_text(encoding="utf-8").partition("#define TOFRAY_REASONS")[2].partition("#define")[0]
    return dict(re.findall(r"row\((\w+),[^\"]*\"[^\"]*\", *\"([^\"]*)\"", rows))


def comments() -> dict[str, dict[str, str]]:
    """The comment of each struct ('' is its key) and of each of its members."""
    out: dict[str, dict[str, str]] = {}
    for header in sorted((ROOT / "include/tofray").glob("*.h")):
        before: list[str] = []
        struct, members = "", [""]
        behind = False
        for line in header.read_text(encoding="utf-8").split("\n"):
            begins = re.match(r"struct (\w+) \{", line)
            if begins:
                struct = begins[1]
                out[struct] = {"": " ".join(before)}
                before = []
                continue
            alone = re.match(r"\s*/// ?(.*)", line)
            if alone:
                before.append(alone[1])
                behind = False
                continue
            ends = re.match(r"\};\s*(?:///< (.*))?", line)
            if ends and struct:
                if ends[1]:
                    out[struct][""] = (out[struct][""] + " " + ends[1]).strip()
                members, behind = [""], bool(ends[1])
                if not behind:
                    struct = ""
                continue
            goes_on = re.match(r"\s+///< (.*)", line)
            if goes_on and struct and behind:
                for name in members:
                    out[struct][name] += " " + goes_on[1]
                continue
            if struct and line.strip().startswith("TOFRAY_REASONS("):
                out[struct].update(reasons())
            code, _, comment = line.partition("//")
            names = declared(code) if struct else []
            if names:
                members = names
                what = " ".join([*before, comment.lstrip("/<").strip() if comment.startswith("/<") else ""]).strip()
                for name in members:
                    out[struct][name] = what
                behind = True
            before = []
    return out


def sentence(text: str) -> str:
    """A capital letter, unless the first word is a name or a symbol, and a full stop."""
    text = re.sub(r"^(\.\.\.|…) ", "", re.sub(r"\s+", " ", text).strip())
    if re.match(r"(a|[a-z]{2,})(?![\w:])", text):
        text = text[:1].upper() + text[1:]
    return text + ("" if not text or text[-1] in ".!?" else ".")


def wrapped(text: str, indent: int) -> str:
    """Lines of 100 columns at most. A citation of equations is one word, hyphens and all."""
    whole = re.sub(r"\[theory: [^\]]*\]", lambda found: found[0].replace(" ", "\1").replace("-", "\2"), text)
    lines = textwrap.fill(whole, 100, initial_indent=" " * indent, subsequent_indent=" " * indent)
    return lines.replace("\1", " ").replace("\2", "-")


# Classes that have more than their members.
BASES = {"Pinhole": "PinholeMethods", "Placement": "PlacementMethods", "Pose": "PoseMethods"}

IN_BRACKETS = re.compile(r"(?<!\])\B\[(?!theory)([^],]+)\](?!\[)")  # a unit, and no equation or shape


def short(number: float) -> str:
    """1e+06 is 1e6."""
    text = f"{number:.6g}"
    if number == int(number) and float(text) != number:
        text = str(int(number))
    return re.sub(r"e([+-])0*", lambda found: "e" + found[1].strip("+"), text)


class Rows:
    """What src/model says of members: sentences, units and ranges."""

    def __init__(self, structs: list[tuple[str, list[tuple[str, str, Any]]]], rows: list[dict[str, Any]]) -> None:
        self._types = {(struct, member): kind for struct, members in structs for member, kind, _ in members}
        self._rows: dict[tuple[str, str], list[dict[str, Any]]] = {}
        self._members: dict[tuple[str, str], set[str]] = {}
        for row in rows:
            self._rows.setdefault((row["struct"], row["member"]), []).append(row)
            self._members.setdefault((row["struct"], row["key"].rpartition(".")[2]), set()).add(row["member"])
        # A name ends in its unit, as the rows write that: _m_per_s is m/s.
        units = {unit for row in rows for _, unit, _, _ in row["numbers"] if unit}
        self._ends = {"_" + unit.lower().replace("/", "_per_"): unit for unit in units}

    def unit(self, struct: str, member: str, comment: str) -> str:
        """What follows the type in a docstring: ", m"; nothing for what is no number."""
        if "float" not in self._types[struct, member]:
            return ""
        rows = self._rows.get((struct, member), [])
        said = list(dict.fromkeys(row["numbers"][0][1] or "1" for row in rows))
        if said not in ([], ["1"]):
            return ", " + " or ".join(said)
        ends = [end for end in self._ends if member.endswith(end)]
        bracket = IN_BRACKETS.search(comment)
        if ends:
            return ", " + self._ends[max(ends, key=len)]
        if not bracket and not rows:
            raise SystemExit(f"python/tools/make_model.py: {struct}::{member} is a number without a row, and its name ends in no unit: its "
                             "comment has to have it, as in [m] or [1]")
        return ", " + (bracket[1] if bracket else "1")

    def text(self, struct: str, member: str, comment: str) -> str:
        """Its sentences: those of its rows, or else the comment's."""
        rows = self._rows.get((struct, member), [])
        ranges = [self._range(row["numbers"]) for row in rows]
        apart = len(set(ranges)) > 1
        said = [self._sentence(row) + (" " + values if apart else "") for row, values in zip(rows, ranges) if row["doc"]]
        # What holds where nothing is said is another matter in code.
        in_files = any(row["may_be_absent"] and "unless given" in row["doc"] for row in rows) and not self._types[struct, member].endswith(" | None")
        if in_files:
            said = [re.sub(r"(^|[;:] )(.)([^;:]* unless given)",
                           lambda found: f"{found[1]}{'in' if found[1] else 'In'} files {found[2].lower()}{found[3]}", one) for one in said]
        if comment and (in_files or not said):
            said.append(sentence(comment))
        if ranges and not apart:
            said.append(ranges[0])
        unit = self.unit(struct, member, comment)[2:]
        return " ".join(said).replace(f" [{unit}]", "").strip()

    def _sentence(self, row: dict[str, Any]) -> str:
        doc = self._in_code(row["struct"], row["doc"]).removeprefix("... ")
        if row["group"]:
            doc = row["group"].partition(";")[0] + ": " + doc
        if not row["tag"]:
            return sentence(doc)
        words = re.findall(r'"(\w+)"', self._types[row["struct"], row["tag"]])
        return (", ".join(words[kind] for kind in row["kinds"]) if words else row["tag"]) + ": " + doc + ("" if doc.endswith(".") else ".")

    def _range(self, numbers: list[tuple[str, str, float, float]]) -> str:
        if len(numbers) == 1:
            return f"From {short(numbers[0][2])} to {short(numbers[0][3])}."
        axes = [f"{name.replace('_', ' ')} from {short(low)} to {short(high)} {unit}".strip() for name, unit, low, high in numbers]
        return ", ".join(f"{letter}: {one}" for letter, one in zip("xy", axes)) + ("." if axes else "")

    def _in_code(self, struct: str, doc: str) -> str:
        """Keys of files that the sentence names, as Python calls them."""
        def name(found: re.Match[str]) -> str:
            word, ticks = found[2], found[1]
            members = self._members.get((struct, word), set())
            return f"{ticks}{next(iter(members))}{ticks}" if len(members) == 1 and (ticks or "_" in word) else found[0]

        return re.sub(r"(?<![\w.`])(`?)([a-z][a-z0-9_]*)\1(?![\w`]|\.\w)", name, doc)


def argument(type_name: str, value: object) -> tuple[str, str, str]:
    """How a member is given to the constructor: its type, its default, and what is kept of it."""
    if type_name.startswith("list["):
        return f"Sequence[{type_name[5:-1]}]", "()", "list({})"
    if re.fullmatch(r"[A-Z]\w+", type_name):
        return f"{type_name} | None", "None", f"{type_name}() if {{0}} is None else {{0}}"
    if type_name.startswith("Plane | "):
        return f"{type_name} | None", "None", "Plane() if {0} is None else {0}"
    return type_name, repr(value), "{}"


def class_text(name: str, members: list[tuple[str, str, object]], said: dict[str, str], rows: Rows) -> str:
    out = [f"class {name}({BASES.get(name, 'Record')}):"]
    doc = [wrapped(sentence(said.get("", "")) or f"What C++ calls {name}.", 4).strip(), "", "    Attributes", "    ----------"]
    for member, type_name, _ in members:
        comment = said.get(member, "")
        doc.append(f"    {member} : {type_name}{rows.unit(name, member, comment)}")
        if text := rows.text(name, member, comment):
            doc.append(wrapped(text, 8))
    out.append('    """' + "\n".join(doc) + '\n    """')
    slots = "    __slots__ = (" + ", ".join(f'"{member}"' for member, _, _ in members) + ("," if len(members) == 1 else "") + ")"
    out.append(textwrap.fill(slots, 136, subsequent_indent=" " * 17, break_long_words=False))
    out += [f"    {member}: {type_name}" for member, type_name, _ in members]
    out += ["", "    def __init__(", "        self,", "        *,"]
    kept = []
    for member, type_name, value in members:
        given, default, keep = argument(type_name, value)
        line = f"        {member}: {given} = {default},"
        out.append(line if len(line) <= 140 else f"        {member}: {given}\n        = {default},")
        kept.append(f"        self.{member} = " + keep.format(member))
    return "\n".join([*out, "    ) -> None:", *kept])


def model_text() -> str:
    import tofray_rows
    from tofray import _native

    said = comments()
    parts = [HEAD]
    structs = _native.structs()
    rows = Rows(structs, tofray_rows.rows())
    for name, members in structs:
        parts.append("\n\n" + class_text(name, members, said.get(name, {}), rows) + "\n")
    names = ", ".join(f'"{name}"' for name, _ in structs)
    parts.append("\n\n__all__ = [\n" + textwrap.fill(names, 100, initial_indent="    ", subsequent_indent="    ") + ",\n]\n")
    return "".join(parts)


def names_text() -> str:
    from tofray import _native

    names = ", ".join(f'"{name}"' for name in sorted(name for name, _ in _native.structs()))
    return '''# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Names of the classes of _model.py, for who does not read all of it. Written by python/tools/make_model.py; do not edit."""

MODEL = (
''' + textwrap.fill(names, 136, initial_indent="    ", subsequent_indent="    ") + ",\n)\n"


def arrays_text() -> str:
    from tofray import _native

    parts = ['''# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The arrays of a frame: the rows of include/tofray/frame_arrays.h. Written by python/tools/make_model.py; do not edit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._part import Part

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
''']
    about = {
        "raw": "What the sensor hands out: raw frames, and when and how each was exposed.",
        "depth": "The depth frame, in the camera's frame: x right, y down, z forward. Invalid values: NaN in floats, 0 in integers.",
        "truth": "Ground truth at the middle of the middle raw frame, and the power of the camera's illumination.",
    }
    for part, doc in about.items():
        rows = [row for row in _native.array_table() if row[1] == part]
        lines = [f"    {member} : {dtype} array {shape}, {unit}\n        {sentence(what)}"
                 for _, _, member, dtype, shape, _, unit, what in rows]
        parts.append(f'\n\nclass {part.capitalize()}(Part):\n    """{doc}\n\n'
                     f'    An array that this frame does not have raises AttributeError; '
                     f'``names`` lists those that it has.\n\n    Attributes\n    ----------\n' + "\n".join(lines) + '\n    """\n\n')
        table = [f'        "{member}": ("{name}", "{dtype}", "{shape}", "{stage}", "{unit}"),'
                 for name, _, member, dtype, shape, stage, unit, _ in rows]
        parts.append("    __slots__ = ()\n    _rows = {\n" + "\n".join(table) + "\n    }\n\n    if TYPE_CHECKING:\n")
        parts.append("\n".join(f"        {member}: NDArray[np.{dtype}]" for _, _, member, dtype, *_ in rows) + "\n")
    return "".join(parts)


def main() -> None:
    folder = ROOT / "python/tofray"
    for file, text in ((folder / "_model.py", model_text()), (folder / "_model_names.py", names_text()), (folder / "_arrays.py", arrays_text())):
        if "--check" in sys.argv:
            if file.read_text(encoding="utf-8") != text:
                sys.exit(f"{file} is not what python/tools/make_model.py writes")
        else:
            file.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
