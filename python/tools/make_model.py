#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Writes python/tofray/_model.py: the public structs as classes of Python, with types and docstrings.

Names, types and values come from the compiled module, whose table (python/native/fields.h) the compiler compares with the structs; what a
member is comes from the comments of include/tofray. Run after a change of them: PYTHONPATH=build/release/python python/tools/make_model.py
"""

from __future__ import annotations

import pathlib
import re
import sys
import textwrap

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


def comments() -> dict[str, dict[str, str]]:
    """The comment of each struct ('' is its key) and of each of its members."""
    out: dict[str, dict[str, str]] = {}
    for header in ("scene.h", "camera.h", "simulator.h", "rendered.h", "options.h", "analysis.h", "camera_report.h", "pixel.h", "file_record.h", "run.h"):
        before: list[str] = []
        struct, members = "", [""]
        behind = False
        for line in (ROOT / "include/tofray" / header).read_text(encoding="utf-8").split("\n"):
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
    text = re.sub(r"\s+", " ", text).strip()
    return text[:1].upper() + text[1:] + ("" if not text or text[-1] in ".!?" else ".")


def wrapped(text: str, indent: int) -> str:
    return textwrap.fill(text, 100, initial_indent=" " * indent, subsequent_indent=" " * indent)


# Classes that have more than their members.
BASES = {"Pinhole": "PinholeMethods", "Placement": "PlacementMethods", "Pose": "PoseMethods"}

# Units that a number's name ends in …
ENDS = {"m": "m", "m2": "m²", "deg": "°", "px": "px", "rad": "rad", "s": "s", "hz": "Hz", "w": "W", "e": "e", "k": "K", "dn": "DN", "celsius": "°C",
        "e_per_s": "e/s", "e_per_dn": "e/DN", "m_per_s": "m/s", "m_per_kelvin": "m/K", "rad_per_s": "rad/s", "w_per_m3": "W/m³", "turns": "turns", "w_m2": "W/m²", "w_m2_sr": "W/(m² sr)"}
# … and of those that end in none: scene.h says metres, where it is not a direction or a ratio.
METRES = {"position", "point", "center", "radius", "min", "max", "vertices", "height", "size", "start", "end", "base", "look_at", "low", "high"}
RATIOS = {"fill_factor", "share", "weights", "kernel", "k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2", "f_number", "transmission", "peak",
          "exponent", "duty", "modulation_depth", "correlation", "emission", "axis", "normal", "direction", "up", "samples", "scale", "active",
          "tap_gain_mismatch", "crosstalk_left_right", "crosstalk_up_down", "prnu", "suppression_noise_factor", "sigmas", "flying_sigmas",
          "asymmetry_sigmas", "multipath_sigmas", "temporal_sigmas", "quaternion", "refractive_index", "diffuse", "specular", "alpha", "retro", "occupancy",
          "blooming_share", "reflectivities", "reflectivity", "wrong_cycle", "outside", "unlit", "darkest", "gain", "gains", "speed", "aim", "bright",
          "object_share", "mixed", "cycles", "confidence"}
OTHERS = {"pixel_centre": "px", "mid_code": "DN", "celsius": "°C", "Ambient.amount": "by its quantity", "Curve.x": "any unit", "Curve.y": "any unit",
          "SpreadSpectrum.width": "1", "BounceShare.electrons": "e", "ObjectPlace.rotation": "1", "RunResult.timings_s": "s"}


def unit(struct: str, member: str, type_name: str) -> str:
    """What follows the type in a docstring: ", m"; nothing for what is no number."""
    if "float" not in type_name:
        return ""
    for name in (f"{struct}.{member}", member):
        if name in OTHERS:
            return ", " + OTHERS[name]
    for length in (3, 2, 1):
        words = member.split("_")
        if len(words) > length and "_".join(words[-length:]) in ENDS:
            return ", " + ENDS["_".join(words[-length:])]
    if member not in METRES | RATIOS:
        raise SystemExit(f"python/tools/make_model.py: say the unit of {struct}.{member}")
    return ", m" if member in METRES else ", 1"


def argument(type_name: str, value: object) -> tuple[str, str, str]:
    """How a member is given to the constructor: its type, its default, and what is kept of it."""
    if type_name.startswith("list["):
        return f"Sequence[{type_name[5:-1]}]", "()", "list({})"
    if re.fullmatch(r"[A-Z]\w+", type_name):
        return f"{type_name} | None", "None", f"{type_name}() if {{0}} is None else {{0}}"
    if type_name.startswith("Plane | "):
        return f"{type_name} | None", "None", "Plane() if {0} is None else {0}"
    return type_name, repr(value), "{}"


def class_text(name: str, members: list[tuple[str, str, object]], said: dict[str, str]) -> str:
    out = [f"class {name}({BASES.get(name, 'Record')}):"]
    doc = [wrapped(sentence(said.get("", "")) or f"What C++ calls {name}.", 4).strip(), "", "    Attributes", "    ----------"]
    for member, type_name, _ in members:
        doc.append(f"    {member} : {type_name}{unit(name, member, type_name)}")
        if said.get(member):
            doc.append(wrapped(sentence(said[member]), 8))
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
    from tofray import _native

    said = comments()
    parts = [HEAD]
    structs = _native.structs()
    for name, members in structs:
        parts.append("\n\n" + class_text(name, members, said.get(name, {})) + "\n")
    names = ", ".join(f'"{name}"' for name, _ in structs)
    parts.append("\n\n__all__ = [\n" + textwrap.fill(names, 100, initial_indent="    ", subsequent_indent="    ") + ",\n]\n")
    return "".join(parts)


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
        "truth": "Ground truth at the middle of the middle raw frame, and the power of the camera's own light.",
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
    for file, text in ((folder / "_model.py", model_text()), (folder / "_arrays.py", arrays_text())):
        if "--check" in sys.argv:
            if file.read_text(encoding="utf-8") != text:
                sys.exit(f"{file} is not what python/tools/make_model.py writes")
        else:
            file.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
