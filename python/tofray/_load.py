# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes and cameras out of files, built-in names and plain dicts."""

from __future__ import annotations

import json
import os
import re
from typing import TYPE_CHECKING, Any, Mapping

from . import _native
from ._errors import BadInput, Error, error_of
from ._model import Scene

if TYPE_CHECKING:
    from ._model import Camera


def load_scene(file: str | os.PathLike[str], *, root: str | os.PathLike[str] = "") -> Scene:
    """Reads a scene file (YAML 1.2 or JSON), or a built-in scene by name.

    Parameters
    ----------
    file : path or name
        ``"room.yaml"``, or a name that ``tofray list scenes`` has: ``"demo"``. A file of the working directory that is called so, with or
        without ``.yaml``, counts more, and a ``UserWarning`` says so.
    root : path
        Files that the scene names have to lie in or below its own folder, or this one: a scene may be a stranger's.

    Returns
    -------
    Scene

    Raises
    ------
    Error
        With every fault of the file at once, by line and column.
    """
    name = _chosen(_native.choose_scene(os.fspath(file)))
    scene: Scene = _in_words_of_python(lambda: _native.load_scene(name, os.fspath(root)))
    return scene


def _in_words_of_python(read: Any) -> Any:
    """What an error says of the command line's options is said of the parameters that stand for them."""
    try:
        return read()
    except Error as fault:
        text = re.sub(r'--root ("[^"\n]*"|\S+)', lambda found: "root=" + (found[1] if found[1] == "DIR" else json.dumps(found[1].strip('"'))),
                      str(fault))
        text = re.sub(r"^--(mode|set)\b", r"\1", text, flags=re.M).replace("of --root", "of root")
        raise error_of(fault.kind, text) from None


def _chosen(choice: tuple[str, str]) -> str:
    """The file or name that is meant; whoever called the public function hears of it where there was a choice."""
    name, note = choice
    if note:
        import warnings

        warnings.warn(note, stacklevel=3)
    return name


def load_camera(camera: str | os.PathLike[str] | Scene, mode: str = "", *, set: Mapping[str, Any] | None = None,
                root: str | os.PathLike[str] = "") -> Camera:
    """Reads a camera profile: a file, a built-in name such as "pico-flexx", or what a scene asks for.

    Parameters
    ----------
    camera : path, name or Scene
        ``"camera.yaml"``, or a name that ``tofray list cameras`` has (files count more, as for ``load_scene``), or what the scene's own
        ``camera`` asks for.
    mode : str
        One of the profile's modes; empty: its first.
    set : mapping
        Keys of the profile and their values as written there: ``{"lens.f_number": 1.2, "integration_time": "500 us"}``.
    root : path
        A scene's profile file has to lie in or below the scene's folder, or this one.

    Returns
    -------
    Camera

    Raises
    ------
    Error
        With every fault of the file at once, by line and column, and for a mode that it does not have.
    """
    words = {key: value if isinstance(value, str) else _Text().text_of(value, key) for key, value in dict(set or {}).items()}
    if isinstance(camera, Scene):
        seen = camera
        out: Camera = _in_words_of_python(lambda: _native.load_camera_of(seen, mode, words, os.fspath(root)))
    else:
        name = _chosen(_native.choose_camera(os.fspath(camera)))
        out = _in_words_of_python(lambda: _native.load_camera(name, mode, words, os.fspath(root)))
    return out


def scene(description: Mapping[str, Any], *, name: str = "scene", folder: str | os.PathLike[str] = ".",
          root: str | os.PathLike[str] = "") -> Scene:
    """A scene out of a dict, exactly as in YAML: units in strings, the same keys, the same checks.

    Parameters
    ----------
    description : mapping
        ``{"objects": [{"sphere": {"center": [0, 0, 1.3], "radius": "25 cm", "reflectivity": "40 %"}}]}``
    name : str
        What pictures and files call it.
    folder : path
        Where meshes and profiles that it names lie.
    root : path
        They have to lie in or below that folder, or this one.

    Returns
    -------
    Scene

    Raises
    ------
    Error
        With every fault at once; each names its member: ``objects[0].sphere.radius: error: …``
    """
    out: Scene = _from_dict(description, os.path.join(os.fspath(folder), name + ".yaml"),
                            lambda text, source: _in_words_of_python(lambda: _native.load_scene_text(text, source, os.fspath(root))))
    for one in out.objects:
        one.where = ""  # a place in a text that nobody has seen: `key` says which it is
    return out


def camera(description: Mapping[str, Any], mode: str = "", *, folder: str | os.PathLike[str] = ".") -> Camera:
    """A camera out of a dict, exactly as a profile in YAML.

    Parameters
    ----------
    description : mapping
        A profile's keys and values, units in strings.
    mode : str
        One of its modes; empty: the first.
    folder : path
        Where its table files lie.

    Returns
    -------
    Camera

    Raises
    ------
    Error
        With every fault at once, each by its member.
    """
    out: Camera = _from_dict(description, os.path.join(os.fspath(folder), "camera.yaml"),
                             lambda text, source: _native.load_camera_text(text, source, mode, {}))
    return out


class _Text:
    """JSON, which YAML has in it, with each value on a line of its own, so that a line says where in the dict it is."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.places: list[str] = []
        self.depth = 0

    def text_of(self, value: Any, place: str) -> str:
        self.write(value, place, "", "")
        return " ".join(self.lines)

    def line(self, text: str, place: str) -> None:
        self.lines.append(text)
        self.places.append(place)

    def write(self, value: Any, place: str, before: str, after: str) -> None:
        if self.depth > 100:
            raise BadInput(f"{place[:80]}: error: is nested too deeply\n  expected dicts and lists within 100 others at most")
        self.depth += 1
        if hasattr(value, "tolist") and hasattr(value, "dtype"):
            value = value.tolist()
        if isinstance(value, Mapping):
            self.line(before + "{", place)
            said = ((json.dumps(self._key(key, place), ensure_ascii=False) + ": ", f"{place}.{key}".lstrip("."), one)
                    for key, one in value.items())
            self._items(said, len(value))
            self.line("}" + after, place)
        elif isinstance(value, (list, tuple)):
            self.line(before + "[", place)
            self._items((("", f"{place}[{i}]", one) for i, one in enumerate(value)), len(value))
            self.line("]" + after, place)
        else:
            self.line(before + self._scalar(value, place) + after, place)
        self.depth -= 1

    def _items(self, items: Any, count: int) -> None:
        for i, (before, place, one) in enumerate(items):
            self.write(one, place, before, "," if i + 1 < count else "")

    @staticmethod
    def _key(key: Any, place: str) -> str:
        if not isinstance(key, str):
            raise BadInput(f"{place or 'top level'}: error: got the key {key!r}\n  expected a text")
        return key

    @staticmethod
    def _scalar(value: Any, place: str) -> str:
        if isinstance(value, float) and (value != value or value in (float("inf"), float("-inf"))):
            return {"nan": ".nan", "inf": ".inf", "-inf": "-.inf"}[str(value)]
        if value is None or isinstance(value, (bool, int, float, str)):
            return json.dumps(value, ensure_ascii=False)
        if hasattr(value, "__fspath__"):
            return json.dumps(os.fspath(value), ensure_ascii=False)
        raise BadInput(f"{place}: error: got {value!r:.60} ({type(value).__name__})\n"
                       "  expected a number, a text with a unit, True or False, a list or a dict")


def _from_dict(description: Mapping[str, Any], source: str, read: Any) -> Any:
    if not isinstance(description, Mapping):
        raise BadInput(f"error: got {type(description).__name__}\n  expected a dict, as of the YAML file")
    text = _Text()
    text.write(description, "", "", "")
    try:
        return read("\n".join(text.lines) + "\n", source)
    except Error as fault:
        message = str(fault)

        def member(found: re.Match[str]) -> str:
            line = int(found[1])
            place = text.places[line - 1] if line <= len(text.places) else ""
            return (place or "top level") + ": "

        raise error_of(fault.kind, re.sub(rf"^{re.escape(source)}:(\d+):\d+: ", member, message, flags=re.M)) from None
