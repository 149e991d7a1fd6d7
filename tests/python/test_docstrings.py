# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Every public name says what it is, in numpydoc's form: each parameter, what comes back, when it fails; units and shapes of numbers."""

from __future__ import annotations

import inspect
import pathlib
import re
from typing import Any

import pytest

import tofray

# In the order in which numpydoc wants them.
SECTIONS = ["Parameters", "Attributes", "Returns", "Yields", "Raises"]
SAY_NOTHING = {"add_note", "args", "with_traceback"}  # of Exception
CANNOT_FAIL = {"order", "to_dict", "get", "stop", "demo", "full_sun", "View.close", "View.wait"}


def public() -> list[tuple[str, Any]]:
    """Classes and functions, and what is public of the classes."""
    out = []
    for name in tofray.__all__:
        one = getattr(tofray, name)
        if inspect.isclass(one):
            out += [(name, one)]
            out += [(f"{name}.{member}", what) for member, what in inspect.getmembers(one)
                    if not member.startswith("_") and member not in SAY_NOTHING and not inspect.ismemberdescriptor(what)
                    and (callable(what) or isinstance(what, property)) and what is not getattr(dict, member, None)]
        elif callable(one):
            out.append((name, one))
    return out


PUBLIC = public()
FUNCTIONS = [(name, one) for name, one in PUBLIC if inspect.isfunction(one)]
CLASSES = [(name, one) for name, one in PUBLIC if inspect.isclass(one)]


def names_of(pairs: list[tuple[str, Any]]) -> list[str]:
    return [name for name, _ in pairs]


def sections(doc: str) -> dict[str, list[str]]:
    """Each section's lines; a line of dashes that does not belong to one that numpydoc knows is a fault."""
    lines, out, last = doc.split("\n"), {"": [""]}, ""
    for i, line in enumerate(lines):
        if i + 1 < len(lines) and re.fullmatch("-{3,}", lines[i + 1]):
            assert line in SECTIONS and len(lines[i + 1]) == len(line), f"the section {line!r}"
            assert i == 0 or lines[i - 1] == "", "an empty line is before a section"
            last = line
            out[last] = []
        elif not re.fullmatch("-{3,}", line):
            out[last].append(line)
    order = [SECTIONS.index(name) for name in out if name]
    assert order == sorted(order)
    return out


def described(lines: list[str]) -> dict[str, str]:
    """Names of a section and what stands behind their colon; "first, count : int" are two."""
    out = {}
    for line in lines:
        if line and not line.startswith(" "):
            names, _, kind = line.partition(" : ")
            out.update({name: kind for name in names.split(", ")})
    return out


def doc_of(one: Any) -> str:
    return inspect.getdoc(one) or ""


@pytest.mark.parametrize("name", names_of(PUBLIC))
def test_a_public_name_begins_with_a_sentence(name: str) -> None:
    first = doc_of(dict(PUBLIC)[name]).partition("\n\n")[0]
    assert re.match(r"[A-Z`]|numpy's |(float|u?int)\d+ array", first), first
    assert first.endswith((".", ":")) and len(first) > 4, first


@pytest.mark.parametrize("name", names_of(FUNCTIONS))
def test_a_function_describes_what_goes_in_and_comes_out(name: str) -> None:
    function = dict(FUNCTIONS)[name]
    signature, said = inspect.signature(function), sections(doc_of(function))
    assert list(described(said.get("Parameters", []))) == [word for word in signature.parameters if word != "self"]
    returned = str(signature.return_annotation)
    expected = {"Yields"} if returned.startswith("Iterator") else set() if returned == "None" else {"Returns"}
    assert said.keys() & {"Returns", "Yields"} == expected, returned
    assert ("Raises" in said) == (not {name, name.rpartition(".")[2]} & CANNOT_FAIL)
    if "NDArray" in returned and not returned.startswith("dict"):
        assert re.match(r"(float|u?int)\d+ array \[.+\], \S+|array or None", said["Returns"][0]), said["Returns"]


@pytest.mark.parametrize("name", names_of(CLASSES))
def test_a_class_describes_what_it_is_made_of(name: str) -> None:
    kind = dict(CLASSES)[name]
    said = sections(doc_of(kind))
    known = described(said.get("Parameters", []) + said.get("Attributes", []))
    if name not in ("Error", "DeviceArray", "DeviceFrames", "LensCalibration", "View"):  # which nobody makes
        stub = (pathlib.Path(tofray.__file__).parent / "_native.pyi").read_text(encoding="utf-8")
        native = kind.__module__ == "tofray._native" and re.search(rf"^class {name}:.*?def __init__\(\s*self,(.*?)\) -> None", stub, re.M | re.S)
        words = re.findall(r"(\w+):", native[1]) if native else list(inspect.signature(kind).parameters)
        assert set(words) - {"arrays"} <= set(known) | {"width", "height", "phases", "bins", "modulations", "time_s"}
    for member, what in known.items():
        if "float" in what or "array" in what:
            assert re.search(r"(float|\])( \| None)?, [^],[]+(, optional)?$", what), f"{member} : {what}"
        if "array" in what and "arrays" not in what.split():
            assert re.search(r"(float|complex|u?int)\d+ array \[[^]]+\], ", what), f"{member} : {what}"


def test_the_rules_see_what_is_wrong() -> None:
    for doc in ("What.\n\nParameter\n---------\nx : float", "What.\n\nParameters\n-----\nx : float", "What.\nReturns\n-------\nint",
                "What.\n\nReturns\n-------\nint\n\nParameters\n----------\nx : int"):
        with pytest.raises(AssertionError):
            sections(doc)
    assert described(["first, count : int", "    How many.", "own : Geometry, optional"]) == {
        "first": "int", "count": "int", "own": "Geometry, optional"}


@pytest.mark.parametrize("one", [tofray, tofray.demo(), tofray.demo().depth, tofray.demo().truth, tofray.demo().raw,
                                 tofray.Simulator(tofray.load_scene("demo")), tofray.load_scene("demo"), tofray.load_camera("pico-flexx")],
                         ids=lambda one: type(one).__name__)
def test_completion_offers_public_names_alone(one: Any) -> None:
    # What editors and notebooks offer after a dot, before somebody types an underscore.
    offered = dir(one)
    assert [name for name in offered if name.startswith("_") and not re.fullmatch("__[a-z_]+__", name)] == []
    assert len(offered) > 3 and all(hasattr(one, name) or name in getattr(one, "units", {}) for name in offered)
