# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The Python bridge of examples/mujoco, over the real libmujoco: MuJoCo's own rays say where things are, and C++'s film which bytes come of it.

MuJoCo's Python binding is not in Debian; tests/mujoco/stand_in/mujoco.py has the attributes of it that the bridge takes.
"""

from __future__ import annotations

import hashlib
import importlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import textwrap
from typing import Any, Iterator

import numpy as np
import pytest

import tofray

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLE, STAND_IN = ROOT / "examples/mujoco", ROOT / "tests/mujoco/stand_in"
HEIGHT_FIELD = """<mujoco><asset><hfield name="hills" nrow="2" ncol="2" size="1 1 1 1"/></asset>
<worldbody><geom name="hill" type="hfield" hfield="hills"/><camera name="eye"/></worldbody></mujoco>"""


@pytest.fixture(scope="module")
def binding(tmp_path_factory: pytest.TempPathFactory) -> str:
    """binding.c, built against the MuJoCo that is here."""
    compiler, library = shutil.which("cc"), tmp_path_factory.mktemp("binding") / "binding.so"
    if compiler is None:
        pytest.skip("there is no C compiler here (Debian: gcc)")
    headers = subprocess.run([compiler, "-E", "-x", "c", "-"], input="#include <mujoco/mujoco.h>\n", capture_output=True, text=True)
    if headers.returncode != 0:
        pytest.skip("MuJoCo is not here (Debian: libmujoco-dev)")
    subprocess.run([compiler, "-shared", "-fPIC", "-o", str(library), str(STAND_IN / "binding.c"), "-lmujoco"], check=True)
    return str(library)


@pytest.fixture
def bridge(binding: str, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """The modules mirror and film, with the stand-in in the place of MuJoCo's binding."""
    monkeypatch.setenv("TOFRAY_MUJOCO_BINDING", binding)
    for folder in (STAND_IN, EXAMPLE):
        monkeypatch.syspath_prepend(str(folder))
    yield importlib.import_module("film")
    for name in ("film", "mirror", "mujoco"):
        sys.modules.pop(name, None)


def pendulum(bridge: Any) -> tuple[Any, Any]:
    model = bridge.mujoco.MjModel.from_xml_path(str(EXAMPLE / "pendulum.xml"))
    data = bridge.mujoco.MjData(model)
    data.qvel[:] = 1   # rad/s and m/s: in a frame all of it moves by millimetres and more
    bridge.mujoco.mj_forward(model, data)
    return model, data


def step_until(bridge: Any, model: Any, data: Any, time_s: float) -> None:
    while data.time < time_s - 1e-9:
        model.opt.timestep = min(1e-4, time_s - data.time)
        bridge.mujoco.mj_step(model, data)
    bridge.mujoco.mj_forward(model, data)


def compare(bridge: Any, model: Any, data: Any, mirror: Any, truth: Any, rays: Any) -> tuple[float, float, set[str]]:
    """How far z is off [m], in which share of the pixels both see the same, and what was compared. Leaves out what is drawn by flat pieces, and
    pixels beside a rim, where a ray of floats and one of doubles may meet different things."""
    right, up, backward = data.cam_xmat[0].reshape(3, 3).T
    ways = rays[..., :1] * right - rays[..., 1:] * up - backward
    geoms, z = (one.reshape(rays.shape[:2]) for one in bridge.mujoco.meet(model, data, data.cam_xpos[0], ways.reshape(-1, 3)))
    same = np.where(truth.object_id >= 0, np.array(mirror.geoms)[truth.object_id], -2) == geoms
    whole = same.copy()
    for step in (-1, 1):
        whole &= (np.roll(geoms, step, 0) == geoms) & (np.roll(geoms, step, 1) == geoms)
    whole[[0, -1]] = whole[:, [0, -1]] = False
    whole &= (geoms >= 0) & (model.geom_type[geoms] != int(bridge.mujoco.mjtGeom.mjGEOM_ELLIPSOID))
    names = {mirror.scene.objects[i].name for i in np.unique(truth.object_id[whole])}
    return float(np.abs(truth.z_m[whole] - z[whole]).max()), float(same[geoms >= 0].mean()), names


def test_its_own_rays_see_what_tofray_sees_at_nine_times_of_one_frame(bridge: Any) -> None:
    model, data = pendulum(bridge)
    mirror, camera = bridge.Mirror(model, "eye"), tofray.load_camera("pico-flexx")
    times = tofray.exposure_times(camera, 0.1)
    assert len(times) == 9
    step_until(bridge, model, data, 0.1)
    mirror.look(data)
    places = []
    for when in times:
        step_until(bridge, model, data, when)
        mirror.look(data)
        places.append(data.qpos.copy())
    seen = mirror.seen()
    simulator = tofray.Simulator(mirror.scene, camera, noise="off", arrays=["gt_z_m", "gt_object_id"])
    truth_at, rays = simulator.frame(0, time_s=0.1, **seen).truth.time_s, np.asarray(tofray.pixel_rays(camera), np.float64)
    for when, place in zip(times, places):
        # Ground truth is that of the middle raw frame: the frame begins so that this one is now.
        truth: Any = simulator.frame(0, time_s=0.1 + when - truth_at, **seen).truth
        assert abs(truth.time_s - when) < 1e-12
        data.qpos[:] = place
        bridge.mujoco.mj_forward(model, data)
        off_m, same, names = compare(bridge, model, data, mirror, truth, rays)
        # Floats of 2 m are off by 0.1 um, of 10 m (the floor far away) and seen at 3 degrees by some um.
        assert off_m < 1e-5 and same > 0.995
        assert names == {"floor", "wall", "bin", "shelf", "rod", "bob", "wedge", "finger"}


def test_it_moves_what_joints_move_and_leaves_out_what_is_not_drawn(bridge: Any) -> None:
    model, data = pendulum(bridge)
    mirror = bridge.Mirror(model, "eye", {"wood": tofray.load_material("wood"), "egg": tofray.load_material("skin")})
    mirror.look(data)
    seen = mirror.seen()
    assert set(seen["objects"]) == {"rod", "bob", "wedge", "finger", "geom.10"} and len(seen["camera"]) == 1
    assert {one.name for one in mirror.scene.objects} >= {"egg", "floor"} and "unseen" not in {one.name for one in mirror.scene.objects}
    diffuse = {one.name: mirror.scene.materials[one.material].diffuse for one in mirror.scene.objects}
    assert diffuse["wall"] == 0.634 and diffuse["egg"] == 0.603   # by MuJoCo's material, by the geom's name
    assert diffuse["floor"] == pytest.approx(0.214, abs=1e-3)     # ((0.5 + 0.055)/1.055)^2.4
    assert mirror.seen() == {"camera": None, "objects": {}}, "what was seen is of one frame"


def test_what_it_cannot_mirror_is_refused(bridge: Any, tmp_path: pathlib.Path) -> None:
    model, _ = pendulum(bridge)
    with pytest.raises(ValueError, match='the model has no camera "ear"'):
        bridge.Mirror(model, "ear")
    (tmp_path / "hill.xml").write_text(HEIGHT_FIELD, encoding="utf-8")
    with pytest.raises(ValueError, match="hill is a height field or of an unknown type: expected planes"):
        bridge.Mirror(bridge.mujoco.MjModel.from_xml_path(str(tmp_path / "hill.xml")), "eye")


def film(binding: str, folder: pathlib.Path, *words: object) -> str:
    env = {**os.environ, "TOFRAY_MUJOCO_BINDING": binding, "PYTHONPATH": f"{STAND_IN}{os.pathsep}{os.environ['PYTHONPATH']}"}
    done = subprocess.run([sys.executable, str(EXAMPLE / "film.py"), *map(str, words)], cwd=folder, capture_output=True, text=True, env=env)
    assert done.returncode == 0, done.stderr
    return done.stdout


def sha256(file: pathlib.Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()


@pytest.mark.parametrize("model, camera", [("pendulum", "eye"), ("arm", "hand")])
def test_a_film_has_the_bytes_of_the_one_by_cpp(binding: str, tmp_path: pathlib.Path, model: str, camera: str) -> None:
    said = film(binding, tmp_path, EXAMPLE / f"{model}.xml", camera)
    lines = re.findall(r"off by (\d+\.\d) mm in the median; motion moves that of (\d+)% of the pixels, by (\d+\.\d) mm", said)
    assert len(lines) == 10 and all(float(off) < 60 for off, _, _ in lines) and max(float(by) for _, _, by in lines) > 1
    if model == "arm":
        assert min(int(share) for _, share, _ in lines) > 50, "all is seen from a hand that moves"
    assert tofray.mcap_contents(tmp_path / "film.mcap")["topics"]["/camera/points"]["messages"] == 10
    program = os.environ.get("TOFRAY_MUJOCO_FILM", "")
    if not program:
        pytest.skip("the C++ example was not built here")
    (tmp_path / "cpp").mkdir()
    subprocess.run([program, str(EXAMPLE / f"{model}.xml"), camera], cwd=tmp_path / "cpp", check=True, capture_output=True)
    assert sha256(tmp_path / "film.mcap") == sha256(tmp_path / "cpp/film.mcap")


def test_the_lines_of_the_page_are_a_program(bridge: Any) -> None:
    page = (ROOT / "docs/robots.md").read_text(encoding="utf-8")
    block = re.search(r"```text\n(mirror = Mirror.*?)```", page, re.S)
    assert block is not None
    model, data = pendulum(bridge)
    names: dict[str, Any] = {"Mirror": bridge.Mirror, "tofray": tofray, "model": model, "data": data, "step_until": bridge.step_until,
                             "camera": tofray.load_camera("pico-flexx")}
    exec(textwrap.dedent(block[1]), names)
    assert names["frame"].index == 2 and np.isfinite(names["frame"].depth.z_m).mean() > 0.5
