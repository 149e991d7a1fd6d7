# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Members of scene and camera by the rows of src/model: each goes to C++ and back, and its docstring says what its row says."""

from __future__ import annotations

import inspect
import pathlib
import re
import typing
from typing import Any

import pytest

import tofray
import tofray_rows
from tofray import _model, _native

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROWS: list[dict[str, Any]] = tofray_rows.rows()
MEMBERS: dict[str, list[str]] = {row["struct"]: [] for row in ROWS}
for _struct, _member in dict.fromkeys((row["struct"], row["member"]) for row in ROWS):
    MEMBERS[_struct].append(_member)
NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"
NO_ROWS = {"Curve": "a row of its own says what x and y are, wherever a curve stands", "Override": "words for keys of a profile",
           "SceneFile": "what the reader met"}


def hints(struct: str) -> dict[str, Any]:
    native = {name: getattr(tofray, name) for name in ("MeshMotion", "ReflectivityMap", "TriangleMesh", "VectorMap")}
    kind = getattr(tofray, struct)
    known = typing.get_type_hints(kind, {**vars(_model), **native, "Literal": typing.Literal})
    return {member: known[member] for member in kind.__slots__}


def another(hint: Any, value: Any) -> Any:
    """A value of that type which is not this one."""
    kind, parts = typing.get_origin(hint), typing.get_args(hint)
    if kind is typing.Literal:
        return next(word for word in parts if word != value)
    if kind is tuple:
        return tuple(another(part, k if value is None else value[k]) for k, part in enumerate(parts))
    if kind is list:
        return [another(parts[0], None), another(parts[0], another(parts[0], None))]
    if parts:  # of several types the last one that is none of its own
        return another([part for part in parts if part is not type(value) and part is not type(None)][-1], None)
    if hint is bool:
        return not value
    if hint is int:
        return 3 * (value or 0) + 1
    if hint is float:
        return 0.375 * (value or 0) + 0.125
    if hint is str:
        return f"{value}x"
    out = hint()
    name, first = next(iter(hints(hint.__name__).items()))
    setattr(out, name, another(first, getattr(out if value is None else value, name)))
    return out


@pytest.mark.parametrize("struct", MEMBERS)
def test_a_member_with_a_row_goes_to_cpp_and_back(struct: str) -> None:
    for member in MEMBERS[struct]:
        one = getattr(tofray, struct)()
        before = getattr(one, member)
        value = another(hints(struct)[member], before)
        assert value != before
        setattr(one, member, value)
        back = _native.round_trip(one)
        assert getattr(back, member) == value and type(getattr(back, member)) is type(value), f"{struct}.{member}"
        assert back == one, f"{struct}.{member} changes what it is not"
        assert back != _native.fresh(struct)


def test_each_member_of_scene_and_camera_has_a_row_or_is_no_users() -> None:
    found, waiting = set(), ["Camera", "Scene"]
    while waiting:
        struct = waiting.pop()
        found.add(struct)
        waiting += [name for kind in hints(struct).values() for name in re.findall(r"tofray\._model\.(\w+)", repr(kind)) if name not in found]
        waiting += [kind.__name__ for kind in hints(struct).values() if inspect.isclass(kind) and hasattr(_model, kind.__name__)
                    and kind.__name__ not in found]
    assert found - set(NO_ROWS) == set(MEMBERS) and set(NO_ROWS) < found
    with_row, without = {(row["struct"], row["member"]) for row in ROWS}, set(tofray_rows.without_row())
    assert not with_row & without
    assert with_row | without == {(struct, member) for struct in MEMBERS for member in getattr(tofray, struct).__slots__}


def said(struct: str, member: str) -> tuple[str, str]:
    """Type with unit, and sentences, of a member in its docstring."""
    doc = inspect.getdoc(getattr(tofray, struct)) or ""
    found = re.search(rf"^{member} : (.*)\n((?:    .*\n?)*)", doc, re.M)
    assert found, f"{struct}.{member}"
    return found[1], re.sub(r"\s+", " ", found[2]).strip()


def test_a_docstring_has_sentence_unit_and_range_of_the_row() -> None:
    assert said("Pixel", "full_well_e") == ("float, e", "Full-well capacity of a tap. From 1 to 1e30.")
    assert said("Pattern", "half_angle_rad") == ("float, rad", "cone: half angle of the cone, within which it is uniform. From 0.001 to 3.14159.")
    assert said("Adc", "gains")[1] == "Gains that modes may choose from; a mode's step is `step_e_per_dn` over its gain. From 0.01 to 100."
    assert said("Ambient", "amount")[0] == "float, 1 or lx or W/m2"
    for word in ("level: share of the tabulated spectrum", "illuminance_lx: illuminance of the surfaces", "From 0 to 1e7."):
        assert word in said("Ambient", "amount")[1]


@pytest.mark.parametrize("struct", MEMBERS)
def test_docstrings_say_what_rows_say(struct: str) -> None:
    keys = {part for row in ROWS if row["struct"] == struct for part in re.split(r"\W|_", row["key"])}
    for row in (row for row in ROWS if row["struct"] == struct):
        kind, text = said(struct, row["member"])
        name, numbers = f"{struct}.{row['member']}: {text}", row["numbers"]
        if "float" in kind and numbers[0][1]:
            assert numbers[0][1] in kind.partition(", ")[2].rpartition(", ")[2].split(" or "), name
        ranges = [(float(low), float(high)) for low, high in re.findall(rf"from ({NUMBER}) to ({NUMBER})", text, re.I)]
        for _, _, low, high in numbers:
            assert any(one == pytest.approx((low, high), rel=1e-5) for one in ranges), name
        words = set(re.findall(r"[a-z]{3,}", row["doc"])) - keys
        assert all(word in text.lower() for word in words), name
        assert not row["doc"] or not row["tag"] or re.search(r"\w: ", text), name


def test_what_holds_in_files_alone_is_said_to() -> None:
    # In code, a default is the struct's.
    assert "code of A-B = 0; in files the middle unless given." in said("Adc", "mid_code")[1].replace("Code", "code")
    assert said("Filter", "center_m")[1].startswith("Centre of the pass band; in files the illumination wavelength of the first light unless given.")


def test_no_list_of_members_or_units_is_left() -> None:
    # A member is written where its struct declares it and in its row: what names many of them is a list to forget one in.
    units = {f"_{unit.lower().replace('/', '_per_')}" for row in ROWS for _, unit, _, _ in row["numbers"] if unit}
    names = {member for members in MEMBERS.values() for member in members if any(member.endswith(unit) for unit in units)}
    assert len(names) > 60
    for file in [*(ROOT / "python/native").iterdir(), *(ROOT / "python/tools").iterdir()]:
        text = file.read_text(encoding="utf-8")
        assert len(names & set(re.findall(r"\w+", text))) <= 6, file.name
        assert len(re.findall(r"['\"](?:m|rad|e|px|W|Hz|DN|m/s|e/s|K)['\"]", text)) <= 2, f"{file.name} lists units"
