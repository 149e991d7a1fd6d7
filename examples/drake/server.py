# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A render server for Drake (MakeRenderEngineGltfClient): scenes come as glTF by POST /render, and a time-of-flight camera's picture goes back.

python3 server.py --camera pico-flexx, then MakeRenderEngineGltfClient(params) with params.base_url = "http://127.0.0.1:8000".
Needs flask and Pillow (Debian: python3-flask python3-pil).
"""

from __future__ import annotations

import argparse
import hashlib
import io
import itertools
import json
import math
import pathlib
import tempfile
import threading
import warnings
from typing import Any

import flask
import numpy as np
from PIL import Image

import tofray

TOO_CLOSE, TOO_FAR = np.float32(0), np.float32(np.inf)   # as Drake reads pictures of depth
EMPTY = 32766                                            # its label of what is nothing
LARGEST_PIXELS, LARGEST_BYTES = 4_000_000, 256_000_000


class Wrong(ValueError):
    """Of the request, in words for whom sent it."""


def number(form: Any, name: str, least: float) -> float:
    if name not in form:
        raise Wrong(f"{name} is missing in the form")
    try:
        value = float(form[name])
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value >= least):
        raise Wrong(f"{name} is {form[name]!r}: expected a number from {least:g} on")
    return value


def whole(form: Any, name: str) -> int:
    value = number(form, name, 1)
    if value != int(value) or value > LARGEST_PIXELS:
        raise Wrong(f"{name} is {form[name]!r}: expected a whole number up to {LARGEST_PIXELS}")
    return int(value)


def looking_through(camera: tofray.Camera, form: Any) -> tofray.Camera:
    """The camera, with as many pixels and the pinhole that the form asks for; Drake's pixels have their centres at whole numbers, as tofray's."""
    width, height = whole(form, "width"), whole(form, "height")
    if width * height > LARGEST_PIXELS:
        raise Wrong(f"a picture of {width} x {height} pixels: expected {LARGEST_PIXELS} pixels at most")
    lens = camera.lens
    camera.sensor.width, camera.sensor.height = width, height
    lens.fx_px, lens.fy_px = (number(form, f"focal_{axis}", 1e-3) for axis in "xy")
    lens.cx_px, lens.cy_px = (number(form, f"center_{axis}", -1e6) for axis in "xy")
    lens.distortion = "brown_conrady"
    for name in ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"):
        setattr(lens, name, 0.0)
    return camera


def scene_of(data: bytes, folder: str) -> tuple[tofray.Scene, list[int]]:
    """The scene, seen from its camera, and the label of each of its objects."""
    try:
        document = json.loads(data)
        materials = document.get("materials", [])
        labels = {f"scene/{i}": label_of(material) for i, material in enumerate(materials)}
        for i, material in enumerate(materials):
            material["name"] = str(i)   # names of objects are those of materials, which may not differ
        has_camera = any("camera" in node for node in document.get("nodes", []))
    except (ValueError, AttributeError, TypeError) as error:
        raise Wrong(f"scene is no glTF file as JSON: {error}") from None
    if not has_camera:
        raise Wrong("no node of the scene has a camera")
    file = pathlib.Path(folder) / "scene.gltf"
    file.write_text(json.dumps(document), encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")   # that visible colour stands for reflectivity: the page says so
        scene = tofray.load_inputs(file).scene
    return scene, [labels.get(one.name, 0) for one in scene.objects]


def label_of(material: dict[str, Any]) -> int:
    """Drake writes labels as flat colours: red has the low byte, green the high one."""
    red, green, *_ = material.get("emissiveFactor") or material.get("pbrMetallicRoughness", {}).get("baseColorFactor", (0, 0))
    return int(round(255 * red)) | int(round(255 * green)) << 8


class Server:
    def __init__(self, camera: str, mode: str, depth: str, seed: int, white_e: float) -> None:
        self._camera, self._mode, self._depth, self._seed, self._white_e = camera, mode, depth, seed, white_e
        self._indices, self._one_at_a_time = itertools.count(), threading.Lock()
        tofray.load_camera(camera, mode)   # a name that is wrong is told now

    def render(self, form: Any, files: Any) -> tuple[bytes, str]:
        """The picture's bytes, and their type."""
        kind = form.get("image_type", "")
        if kind not in ("depth", "label", "color"):
            raise Wrong(f"image_type is {kind!r}: expected depth, label or color")
        near, far = (number(form, name, 0) for name in ("min_depth", "max_depth")) if kind == "depth" else (0.0, 0.0)
        camera = looking_through(tofray.load_camera(self._camera, self._mode), form)
        if "scene" not in files:
            raise Wrong("the file scene is missing in the form")
        data = files["scene"].read()
        if hashlib.sha256(data).hexdigest() != form.get("scene_sha256", "").lower():
            raise Wrong("scene_sha256 is not that of the scene that came")
        with tempfile.TemporaryDirectory() as folder:
            scene, labels = scene_of(data, folder)
        frame = self._frame(scene, camera, kind)
        if kind == "depth":
            return encoded(self._depth_of(frame, near, far, number(form, "far", 0)), "TIFF"), "image/tiff"
        if kind == "label":
            return encoded(np.array([*labels, EMPTY], np.uint16)[frame.truth.object_id], "PNG"), "image/png"
        grey = np.nan_to_num(np.clip(255 * np.sqrt(frame.depth.amplitude_e / self._white_e), 0, 255)).astype(np.uint8)
        return encoded(np.stack([grey] * 3, -1), "PNG"), "image/png"

    def _frame(self, scene: tofray.Scene, camera: tofray.Camera, kind: str) -> tofray.Frame:
        of_truth = {"label": ["gt_object_id"], "depth": ["gt_z_m"] if self._depth == "true" else []}.get(kind, [])
        simulator = tofray.Simulator(scene, camera, seed=self._seed, arrays=of_truth)
        return simulator.frame(next(self._indices))

    def _depth_of(self, frame: tofray.Frame, near: float, far: float, clipped: float) -> Any:
        """z, with 0 for what is too close, or is there and has no valid depth, and infinite for what is too far, or nothing."""
        true = frame.truth.z_m
        z = (true if self._depth == "true" else frame.depth.z_m).copy()
        nothing = np.isnan(true) | (true > clipped)
        z[np.isnan(z) | (z < near)] = TOO_CLOSE
        z[nothing | (z > far)] = TOO_FAR
        return z

    def answer(self) -> Any:
        try:
            with self._one_at_a_time:
                body, kind = self.render(flask.request.form, flask.request.files)
        except (Wrong, tofray.Error) as error:
            return flask.Response(f"{error}\n", 400, mimetype="text/plain")
        return flask.Response(body, 200, mimetype=kind)


def encoded(pixels: Any, form: str) -> bytes:
    out = io.BytesIO()
    Image.fromarray(pixels).save(out, form)
    return out.getvalue()


def application(server: Server) -> flask.Flask:
    app = flask.Flask("tofray")
    app.config["MAX_CONTENT_LENGTH"] = LARGEST_BYTES
    app.add_url_rule("/render", view_func=server.answer, methods=["POST"])
    app.register_error_handler(Exception, fault)
    return app


def fault(error: Exception) -> Any:
    """What no request should cause, as one sentence; flask's own of HTTP as they are."""
    code = getattr(error, "code", 500)
    return flask.Response(f"{getattr(error, 'description', '') or f'{type(error).__name__}: {error}'}\n", code, mimetype="text/plain")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--camera", default="pico-flexx", help="a profile: all of the camera but its lens and its number of pixels, which Drake says")
    parser.add_argument("--mode", default="", help="of that profile")
    parser.add_argument("--depth", choices=("measured", "true"), default="measured", help="with the camera's noise and errors, or ground truth")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--white", type=float, default=4000, metavar="E", help="electrons of amplitude that are white in pictures of kind color")
    parser.add_argument("--host", default="127.0.0.1", help="who may ask: this machine alone, unless another address stands here")
    parser.add_argument("--port", type=int, default=8000)
    words = parser.parse_args()
    app = application(Server(words.camera, words.mode, words.depth, words.seed, words.white))
    app.run(words.host, words.port, threaded=True)


if __name__ == "__main__":
    main()
