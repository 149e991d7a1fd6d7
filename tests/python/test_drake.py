# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The render server of examples/drake, asked on loopback as Drake's client asks: multipart forms, TIFF and PNG read by Pillow and OpenCV."""

from __future__ import annotations

import base64
import hashlib
import io
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import urllib.error
import urllib.request
import uuid
from typing import Any, Iterator

import numpy as np
import pytest

import tofray

pytest.importorskip("flask")
PIL: Any = pytest.importorskip("PIL.Image")
SERVER = pathlib.Path(__file__).resolve().parents[2] / "examples/drake/server.py"
FORM = {"image_type": "depth", "width": "160", "height": "120", "near": "0.01", "far": "10", "min_depth": "0.3", "max_depth": "1.5",
        "focal_x": "150", "focal_y": "150", "fov_x": "0.98", "fov_y": "0.76", "center_x": "79.3", "center_y": "59.4"}


def panel(x: float, y: float, z: float, width: float, height: float) -> list[tuple[float, float, float]]:
    """Two triangles that face the camera, which looks along -z: from (x, y) to the right and up."""
    a, b, c, d = (x, y, z), (x + width, y, z), (x + width, y + height, z), (x, y + height, z)
    return [a, b, c, a, c, d]


def scene(camera: bool = True, **more: Any) -> bytes:
    """Panels at z = 0.2 m (left), 0.8 m (all), 2 m (behind its hole, right), of a camera that stands at (1, 2, 3) and looks along -z; above is nothing."""
    at, view, data = (1.0, 2.0, 3.0), [], b""
    parts = [panel(0.9, 1.9, 2.8, 0.05, 0.2), panel(0.7, 1.7, 2.2, 0.4, 0.4), panel(1.1, 1.0, 1.0, 1.5, 1.2)]
    accessors, meshes, materials = [], [], []
    for i, part in enumerate(parts):
        packed = b"".join(struct.pack("<3f", *corner) for corner in part)
        view.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
        data += packed
        low, high = ([extreme(column) for column in zip(*part)] for extreme in (min, max))
        accessors.append({"bufferView": i, "componentType": 5126, "type": "VEC3", "count": 6, "min": low, "max": high})
        label = 300 * (i + 1)
        colour = [(label & 255) / 255, (label >> 8) / 255, 0]
        meshes.append({"primitives": [{"attributes": {"POSITION": i}, "material": i}]})
        materials.append({"name": "material", "emissiveFactor": colour, "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.8, 1]},
                          "extras": {"nir_reflectivity": 0.8}})
    nodes: list[Any] = [{"mesh": i} for i in range(3)]
    if camera:
        nodes.append({"camera": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, *at, 1], "name": "Camera Node"})
    return json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes, "meshes": meshes,
                       "cameras": [{"type": "perspective", "perspective": {"yfov": 0.76, "znear": 0.01, "zfar": 10, "aspectRatio": 1.33}}],
                       "materials": materials, "accessors": accessors, "bufferViews": view,
                       "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
                       **more}).encode()


class Address:
    def __init__(self, url: str) -> None:
        self.url = url

    def ask(self, data: bytes | None = None, *, without: tuple[str, ...] = (), **changes: str) -> tuple[int, bytes, str]:
        """Status, body and type."""
        data = scene() if data is None else data
        fields = {**FORM, "scene_sha256": hashlib.sha256(data).hexdigest(), **changes}
        rim = uuid.uuid4().hex
        parts = [f'--{rim}\r\nContent-Disposition: form-data; name="{name}"\r\n\r\n{value}\r\n'.encode() for name, value in fields.items() if name not in without]
        if "scene" not in without:
            parts.append(f'--{rim}\r\nContent-Disposition: form-data; name="scene"; filename="1-depth.gltf"\r\nContent-Type: model/gltf+json\r\n\r\n'.encode()
                         + data + b"\r\n")
        body = b"".join(parts) + f"--{rim}--\r\n".encode()
        request = urllib.request.Request(self.url + "/render", body, {"Content-Type": f"multipart/form-data; boundary={rim}"})
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return answer.status, answer.read(), answer.headers["Content-Type"]
        except urllib.error.HTTPError as error:
            return error.code, error.read(), error.headers["Content-Type"]


def serve(*words: str) -> Iterator[Address]:
    running = subprocess.Popen([sys.executable, str(SERVER), "--port", "0", *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=os.environ)
    try:
        assert running.stdout is not None
        for line in running.stdout:   # until it says where it listens
            found = re.search(r"http://127\.0\.0\.1:\d+", line)
            if found:
                yield Address(found[0])
                return
        raise AssertionError("the server ended")
    finally:
        running.kill()
        running.communicate()


@pytest.fixture(scope="module")
def measured() -> Iterator[Address]:
    yield from serve("--seed", "5")


@pytest.fixture(scope="module")
def true() -> Iterator[Address]:
    yield from serve("--depth", "true")


def picture(answer: tuple[int, bytes, str], kind: str) -> Any:
    status, body, content = answer
    assert (status, content) == (200, kind), body
    return np.asarray(PIL.open(io.BytesIO(body)))


def expected_z() -> Any:
    """By arithmetic: what stands at each pixel, and infinite where nothing is. In pixels: x right, y down."""
    v, u = np.mgrid[0:120, 0:160]
    x, up = (u - 79.3) / 150, (59.4 - v) / 150
    z = np.full((120, 160), np.inf, np.float32)
    for distance, left, right, low, high in ((2.0, 0.1, 1.6, -1.0, 0.2), (0.8, -0.3, 0.1, -0.3, 0.1), (0.2, -0.1, -0.05, -0.1, 0.1)):
        z[(x * distance > left) & (x * distance < right) & (up * distance > low) & (up * distance < high)] = distance
    return z


def test_true_depth_is_where_the_panels_are(true: Address) -> None:
    z = picture(true.ask(), "image/tiff")
    assert z.dtype == np.float32 and z.shape == (120, 160)
    by_hand = expected_z()
    wanted = np.where(by_hand == 2, np.float32(np.inf), np.where(by_hand == np.float32(0.2), 0, by_hand))   # farther than max_depth, nearer than min_depth
    assert len(np.unique(wanted)) == 3
    assert np.array_equal(np.isinf(z), np.isinf(wanted)) and np.array_equal(z == 0, wanted == 0)
    seen = np.isfinite(wanted)
    assert np.abs(z[seen] - wanted[seen]).max() < 1e-6
    far = picture(true.ask(max_depth="3"), "image/tiff")
    assert np.abs(far[by_hand == 2] - 2).max() < 1e-6


def test_opencv_reads_the_same(true: Address) -> None:
    cv2: Any = pytest.importorskip("cv2")
    status, body, _ = true.ask()
    assert status == 200
    read = cv2.imdecode(np.frombuffer(body, np.uint8), cv2.IMREAD_UNCHANGED)
    assert read.dtype == np.float32 and np.array_equal(read, np.asarray(PIL.open(io.BytesIO(body))))


def test_measured_depth_is_the_cameras_own_frame(measured: Address, tmp_path: pathlib.Path) -> None:
    (tmp_path / "scene.gltf").write_bytes(scene())
    world = tofray.load_inputs(tmp_path / "scene.gltf").scene
    camera = tofray.load_camera("pico-flexx")
    camera.sensor.width, camera.sensor.height = 160, 120
    camera.lens = tofray.Lens(fx_px=150, fy_px=150, cx_px=79.3, cy_px=59.4, f_number=camera.lens.f_number, transmission=camera.lens.transmission)
    simulator = tofray.Simulator(world, camera, seed=5)
    for index in range(2):   # the noise is another one in each
        z, own = picture(measured.ask(max_depth="9"), "image/tiff"), simulator.frame(index)
        known = np.isfinite(own.depth.z_m) & (own.depth.z_m >= np.float32(0.3)) & np.isfinite(own.truth.z_m)
        assert known.mean() > 0.3 and np.array_equal(z[known], own.depth.z_m[known])
        assert np.isinf(z[np.isnan(own.truth.z_m)]).all(), "nothing is too far"
        assert (z[np.isnan(own.depth.z_m) & np.isfinite(own.truth.z_m)] == 0).all(), "what has no depth is 0"


def test_labels_are_drakes(measured: Address) -> None:
    answer = measured.ask(image_type="label", without=("min_depth", "max_depth"))
    labels = picture(answer, "image/png")
    assert answer[1][24:26] == b"\x10\x00", "one channel of 16 bits"
    by_hand = expected_z()
    wanted = np.select([by_hand == np.float32(0.2), by_hand == np.float32(0.8), by_hand == 2], [300, 600, 900], 32766)
    assert labels.shape == (120, 160) and np.array_equal(labels, wanted)


def test_colour_is_the_near_infrared_picture(measured: Address) -> None:
    grey = picture(measured.ask(image_type="color"), "image/png")
    assert grey.shape == (120, 160, 3) and grey.dtype == np.uint8 and np.ptp(grey) > 100
    assert (grey[..., 0] == grey[..., 2]).all() and grey[0, 0, 0] < 30


WRONG: list[tuple[dict[str, Any], str]] = [
    ({"without": ("scene",)}, "the file scene is missing"), ({"without": ("min_depth",)}, "min_depth is missing"), ({"without": ("width",)}, "width is missing"),
    ({"image_type": "infrared"}, "image_type is 'infrared': expected depth, label or color"), ({"width": "12.5"}, "width is '12.5': expected a whole number"),
    ({"width": "4000", "height": "4000"}, "expected 4000000 pixels at most"), ({"focal_x": "nan"}, "focal_x is 'nan': expected a number from 0.001 on"),
    ({"focal_y": "-3"}, "focal_y"), ({"scene_sha256": "00"}, "scene_sha256 is not that of the scene"), ({"data": b"solid"}, "no glTF file as JSON"),
    ({"data": b"[1]"}, "no glTF file as JSON"), ({"data": scene(camera=False)}, "no node of the scene has a camera"),
    ({"data": scene(meshes=[{"primitives": [{"attributes": {"POSITION": 7}}]}] * 3)}, "accessor"),
    ({"data": scene(buffers=[{"byteLength": 216, "uri": "../../secret.bin"}])}, "secret.bin"),
]


@pytest.mark.parametrize("asked, said", WRONG, ids=[said[:20] for _, said in WRONG])
def test_what_cannot_be_is_refused_with_a_sentence(measured: Address, asked: dict[str, Any], said: str) -> None:
    status, body, kind = measured.ask(**asked)
    assert status == 400 and said in body.decode() and kind.startswith("text/plain"), body
    assert "Traceback" not in body.decode()


def test_it_listens_on_this_machine_alone(measured: Address) -> None:
    assert measured.url.startswith("http://127.0.0.1:")
    with pytest.raises(urllib.error.HTTPError, match="404"):
        urllib.request.urlopen(measured.url + "/", timeout=120)
