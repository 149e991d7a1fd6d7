# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What the module does: the same numbers as the command line, views without copies, threads, forks, Ctrl-C."""

from __future__ import annotations

import base64
import copy
import gc
import json
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import threading
import time
import warnings
from typing import Any

import numpy as np
import pytest

import tofray
import tofray.__main__ as command_line
from tofray import _native

BALL = {"camera": {"profile": "pico-flexx", "mode": "MODE_9_5FPS_2000"},
        "objects": [{"plane": {"point": [0, 0, 2], "normal": [0, 0, -1], "reflectivity": 0.8}},
                    {"sphere": {"center": [0.1, 0, 1.3], "radius": "25 cm", "reflectivity": "40 %"}}]}


def same(a: tofray.Frame, b: tofray.Frame) -> bool:
    x, y = a.to_dict(), b.to_dict()
    return x.keys() == y.keys() and all(x[name].tobytes() == y[name].tobytes() for name in x)


def test_frame_is_that_of_the_command_line(tmp_path: pathlib.Path) -> None:
    command = command_line.command()
    assert command is not None
    subprocess.run([command, "render", "demo", "--seed", "7", "-o", str(tmp_path / "there"), "--emit", "npz"], check=True,
                   capture_output=True)
    tofray.Simulator(tofray.load_scene("demo"), seed=7).frame(0).save(tmp_path / "here")
    assert (tmp_path / "here/frame.npz").read_bytes() == (tmp_path / "there/frame.npz").read_bytes()


def test_a_dict_is_a_scene_as_its_file_is(tmp_path: pathlib.Path) -> None:
    file = tmp_path / "ball.yaml"
    file.write_text("""
camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000}
objects:
  - plane: {point: [0, 0, 2], normal: [0, 0, -1], reflectivity: 0.8}
  - sphere: {center: [0.1, 0, 1.3], radius: 25 cm, reflectivity: 40 %}
""")
    by_file, by_dict = tofray.load_scene(file), tofray.scene(BALL, name="ball", folder=tmp_path)
    by_file.camera.profile_where = by_dict.camera.profile_where = ""
    by_file.camera.mode_where = by_dict.camera.mode_where = ""
    for k, one in enumerate(by_file.objects):
        assert (one.key, one.where) == (f"objects.{k}", f"{file}:{4 + k}:5")
        one.where = ""
    assert by_file == by_dict


def test_a_wall_is_as_far_as_it_stands() -> None:
    wall = tofray.Scene(materials=[tofray.Material(diffuse=0.8)], objects=[tofray.Object(shape=tofray.Plane(point=(0, 0, 1.5)))])
    frame = tofray.Simulator(wall, tofray.load_camera("pico-flexx"), noise="off").frame()
    assert np.allclose(frame.truth.z_m, 1.5, atol=1e-6)
    # float32 at 1.5 m resolves 1.2e-7; a wiggling correction leaves its own residue, below a millimetre
    assert abs(float(np.nanmedian(frame.depth.z_m)) - 1.5) < 1e-3


@pytest.mark.parametrize("name", [name for name, _ in _native.structs()])
def test_a_struct_comes_back_from_cpp_as_it_went(name: str) -> None:
    native, mine = _native.fresh(name), getattr(tofray, name)()
    assert native == mine, "a fresh one of Python's is a fresh one of C++'s"
    for member in mine.__slots__:
        value = getattr(mine, member)
        if type(value) in (int, float):  # every member has its own place
            setattr(mine, member, value + 1)
    assert _native.round_trip(mine) == mine


def test_the_classes_are_what_the_structs_are() -> None:
    script = pathlib.Path(__file__).resolve().parents[2] / "python/tools/make_model.py"
    subprocess.run([sys.executable, str(script), "--check"], check=True)


def test_arrays_are_views_that_keep_their_frame_alive() -> None:
    frame = tofray.demo()
    z = frame.depth.z_m
    assert not z.flags.owndata and z.flags.writeable and z.flags.c_contiguous
    assert frame.depth.z_m is z
    assert np.shares_memory(frame.to_dict()["z_m"], z)
    before = z.copy()
    del frame
    gc.collect()
    others = [tofray.demo() for _ in range(4)]
    assert z.tobytes() == before.tobytes() and not any(np.shares_memory(z, one.depth.z_m) for one in others)


def test_memory_of_frames_that_are_gone_is_used_again() -> None:
    simulator = tofray.Simulator(tofray.scene(BALL))
    first = simulator.frame(0)
    reference = {name: array.copy() for name, array in first.to_dict().items()}
    first.depth.z_m[...] = -7
    place = first.depth.z_m.__array_interface__["data"][0]
    del first
    gc.collect()
    again = simulator.frame(0)
    assert again.depth.z_m.__array_interface__["data"][0] == place
    assert all(again.to_dict()[name].tobytes() == array.tobytes() for name, array in reference.items())


def test_dlpack_shares_the_memory() -> None:
    z = tofray.demo().depth.z_m
    shared = np.from_dlpack(z)
    assert np.shares_memory(shared, z)


def test_units_and_shapes_are_those_of_the_table() -> None:
    frame = tofray.demo()
    assert frame.depth.units["z_m"] == "m" and frame.raw.units["raw"] == "DN" and frame.truth.units["power_w"] == "W"
    for name, part, member, dtype, shape, _, unit, _ in tofray.arrays:
        array = getattr(frame, part).get(member)
        assert getattr(frame, part).units[member] == unit
        if array is not None:
            assert array.dtype == dtype and array.ndim == shape.count(",") + 1


def test_what_a_frame_lacks_says_so() -> None:
    frame = tofray.Simulator(tofray.scene(BALL), truth=False).frame()
    assert not hasattr(frame.truth, "z_m") and "z_m" not in frame.truth and frame.truth.names == ()
    with pytest.raises(AttributeError, match="no truth.z_m"):
        frame.truth.z_m


def test_process_gives_the_depth_of_the_frame() -> None:
    frame = tofray.demo()
    assert frame.camera is not None
    depth = tofray.process(frame.raw, frame.camera)
    assert depth.z_m.tobytes() == frame.depth.z_m.tobytes()
    arrays: dict[str, Any] = {name: frame.raw[name].copy() for name in frame.raw}
    own = tofray.Raw(**arrays)
    assert tofray.process(own, frame.camera).flags.tobytes() == depth.flags.tobytes()


def test_own_geometry_and_light_take_the_place_of_the_scene() -> None:
    simulator = tofray.Simulator(tofray.scene(BALL), noise="off")
    frame = simulator.frame()
    seen = tofray.Geometry(frame.truth.z_m, frame.truth.normal, frame.truth.reflectivity)
    assert np.nanmedian(np.abs(simulator.frame(0, seen).depth.z_m - frame.depth.z_m)) < 1e-3
    light = tofray.PixelLight(frame.truth.power_w[np.newaxis].copy(), (2 * frame.truth.range_m)[np.newaxis].copy())
    assert np.nanmedian(np.abs(simulator.frame(0, light).depth.range_m - frame.depth.range_m)) < 0.02  # the light stands beside the lens


def test_load_reads_what_save_wrote(tmp_path: pathlib.Path) -> None:
    frame = tofray.demo()
    files = frame.save(tmp_path / "out")
    assert sorted(os.path.basename(file) for file in files) == sorted(os.listdir(tmp_path / "out"))
    back = tofray.load(tmp_path / "out/frame.npz")
    assert same(frame, back) and back.truth.time_s == frame.truth.time_s and back.meta["seed"] == 0


def test_frames_are_those_of_their_numbers() -> None:
    simulator = tofray.Simulator(tofray.scene(BALL), seed=5)
    two = list(simulator.frames(3, 2))
    assert [one.index for one in two] == [3, 4] and same(two[1], simulator.frame(4))
    asked = list(simulator.frames(requests=[tofray.FrameRequest(index=4), tofray.FrameRequest(index=0, seed=9)]))
    assert same(asked[0], two[1]) and asked[0].truth.time_s == pytest.approx(two[1].truth.time_s, rel=1e-12)
    assert same(asked[1], tofray.Simulator(tofray.scene(BALL), seed=9).frame(0))


def test_a_frame_remembers_what_it_was_made_of(tmp_path: pathlib.Path) -> None:
    scene = tofray.scene(BALL)
    simulator = tofray.Simulator(scene, seed=5)
    frame = simulator.frame(0)
    scene.objects.clear()
    assert frame.scene is not None and len(frame.scene.objects) == 2
    asked = next(simulator.frames(requests=[tofray.FrameRequest(index=0, seed=9)]))
    for one, seed in ((frame, 5), (asked, 9)):
        one.save(tmp_path / str(seed))
        assert tofray.load(tmp_path / f"{seed}/frame.npz").meta["seed"] == seed


@pytest.mark.parametrize("make", [lambda: tofray.load_scene("demo"), lambda: tofray.load_camera("pico-flexx"), tofray.demo,
                                  lambda: tofray.load_scene("bench-mesh")])
def test_pickles_and_copies_are_the_same(make) -> None:  # type: ignore[no-untyped-def]
    one = make()
    for again in (pickle.loads(pickle.dumps(one)), copy.deepcopy(one)):
        assert same(one, again) if isinstance(one, tofray.Frame) else one == again


def test_several_simulators_in_several_threads() -> None:
    expected = [tofray.Simulator(tofray.scene(BALL), seed=seed, threads=1).frame(seed) for seed in range(4)]
    got: list[tofray.Frame | None] = [None] * 4
    shared = tofray.Simulator(tofray.scene(BALL), seed=0)
    of_shared: list[tofray.Frame] = []

    def work(seed: int) -> None:
        got[seed] = tofray.Simulator(tofray.scene(BALL), seed=seed).frame(seed)
        of_shared.append(shared.frame(0))

    threads = [threading.Thread(target=work, args=(seed,)) for seed in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert all(one is not None and same(one, there) for one, there in zip(got, expected))
    assert len(of_shared) == 4 and all(same(one, expected[0]) for one in of_shared)


def slow(samples: int = 65536) -> tofray.Simulator:
    scene = tofray.load_scene("cornell-nir")
    scene.transport.bounces, scene.transport.samples = 3, samples
    return tofray.Simulator(scene)


def test_the_interpreter_goes_on_while_a_frame_is_computed() -> None:
    simulator = slow()
    faults: list[BaseException] = []

    def compute() -> None:
        try:
            simulator.frame(0)
        except BaseException as fault:
            faults.append(fault)

    thread = threading.Thread(target=compute)
    thread.start()
    ticks = 0
    deadline = time.monotonic() + 0.5
    while time.monotonic() < deadline:
        ticks += 1
        time.sleep(0.001)
    assert thread.is_alive() and ticks > 50
    assert simulator.progress[1] > 0
    simulator.stop()
    thread.join(30)
    assert not thread.is_alive() and isinstance(faults[0], tofray.Error) and faults[0].kind == "stopped"
    assert not isinstance(faults[0], MemoryError) and pickle.loads(pickle.dumps(faults[0])).kind == "stopped"


def test_ctrl_c_of_one_who_waits_is_not_for_the_frame_of_another() -> None:
    simulator = slow(4096)  # few enough for progress to be told several times a second
    faults: list[BaseException] = []

    def compute() -> None:
        try:
            simulator.frame(0)
        except BaseException as fault:
            faults.append(fault)

    thread = threading.Thread(target=compute)
    thread.start()
    while simulator.progress[1] == 0:
        time.sleep(0.001)
    before: list[int] = []

    def interrupt() -> None:
        before.append(simulator.progress[0])
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(1.5, interrupt)
    timer.start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        simulator.frame(1)
    assert time.monotonic() - begin < 5
    timer.join()
    time.sleep(0.5)  # a frame that began anew would not be so far again
    assert thread.is_alive() and not faults and simulator.progress[0] >= before[0] > 0
    simulator.stop()
    thread.join(30)
    assert not thread.is_alive() and getattr(faults[0], "kind", "") == "stopped"


def test_ctrl_c_ends_a_long_frame() -> None:
    simulator = slow(4096)  # minutes; a tile, after each of which it is asked, takes a second
    timer = threading.Timer(0.4, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        simulator.frame(0)
    assert time.monotonic() - begin < 20
    timer.join()
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_a_handler_that_raises_nothing_loses_no_frame() -> None:
    simulator = tofray.Simulator(tofray.scene(BALL), subpixel=8)
    expected = simulator.frame(1)
    heard: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: heard.append(number))
    try:
        timer = threading.Timer(0.02, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        assert same(simulator.frame(1), expected)
        timer.join()
        time.sleep(0.01)
    finally:
        signal.signal(signal.SIGINT, before)
    assert heard == [signal.SIGINT]


def test_a_handler_that_raises_nothing_loses_no_depth_of_process() -> None:
    camera = tofray.load_camera("pico-flexx", "MODE_9_5FPS_2000")
    raw = tofray.Simulator(tofray.scene(BALL), camera).frame(0).raw
    expected = tofray.process(raw, camera, threads=1)
    heard: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: heard.append(number))
    ended = threading.Event()

    def interrupt() -> None:
        while not ended.wait(0.0137):
            os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    try:
        thread.start()
        # Each of some 100 signals hits the part of a call in which C++ computes with a chance of some 10 % at the least.
        deadline = time.monotonic() + 1.5
        wrong = 0
        while time.monotonic() < deadline:
            wrong += tofray.process(raw, camera, threads=1).z_m.tobytes() != expected.z_m.tobytes()
    finally:
        ended.set()
        thread.join()
        time.sleep(0.01)
        signal.signal(signal.SIGINT, before)
    assert len(heard) > 20 and wrong == 0


def in_child(work) -> int:  # type: ignore[no-untyped-def]
    child = os.fork()
    if child == 0:
        try:
            os._exit(0 if work() else 1)
        except BaseException:
            os._exit(2)
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.01)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return -1


def test_after_a_fork_a_simulator_is_made_anew() -> None:
    scene, simulator = tofray.scene(BALL), tofray.Simulator(tofray.scene(BALL), seed=2)
    expected = simulator.frame(0)

    def old_one_refuses() -> bool:
        try:
            simulator.frame(0)
        except tofray.Error as fault:
            return "forked" in str(fault)
        return False

    assert in_child(old_one_refuses) == 0
    assert in_child(lambda: same(tofray.Simulator(scene, seed=2).frame(0), expected)) == 0
    assert in_child(lambda: same(tofray.Simulator(scene, seed=2, threads=1).frame(0), expected)) == 0


def test_a_mesh_of_numpy_moves_by_a_function() -> None:
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=np.float32)
    mesh = tofray.TriangleMesh(corners, np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32))
    assert not mesh.vertices.flags.writeable

    def at(time_s: float) -> Any:
        return corners + np.array([0, 0, time_s], dtype=np.float32)

    scene = tofray.scene(BALL)
    scene.objects = [tofray.Object(shape=tofray.Mesh(triangles=mesh, motion=tofray.MeshMotion(at)),
                                   position=(0, 0, 1))]
    simulator = tofray.Simulator(scene, noise="off")
    frame = simulator.frame(5)
    assert np.nanmedian(frame.truth.z_m) == pytest.approx(1 + frame.truth.time_s, abs=1e-5)


def test_pictures_points_and_plots() -> None:
    frame = tofray.demo()
    png, html = frame._repr_png_(), frame._repr_html_()
    assert png is not None and png.startswith(b"\x89PNG") and "80.32 MHz" in html
    # Jupyter shows the HTML alone where there is some
    assert '<img alt="preview" src="data:image/png;base64,' + base64.b64encode(png).decode() + '"' in html
    valid = (frame.depth.flags & tofray.flags["invalid"]) == 0
    assert frame.points().shape == (valid.sum(), 3) and len(frame.points(valid_only=False)) == valid.size
    pytest.importorskip("matplotlib")
    for what in ("z", "amplitude", "error", "raw", "cloud"):
        figure = frame.plot(what)
        figure.canvas.draw()
        assert len(figure.axes) > 0


def test_a_plot_of_raw_frames_has_one_scale_their_phases_and_a_bar() -> None:
    pytest.importorskip("matplotlib")
    frame = tofray.demo()
    figure = frame.plot("raw")
    images, titles = [axes.images[0] for axes in figure.axes if axes.images], [axes.get_title() for axes in figure.axes]
    assert len(images) == frame.raw.phases and len({image.get_clim() for image in images}) == 1
    assert titles[:3] == ["unlit", "80.32 MHz, 0 deg", "80.32 MHz, 90 deg"] and "60.24 MHz, 270 deg" in titles
    assert [axes.get_ylabel() for axes in figure.axes if axes.get_ylabel()] == ["raw [DN]"]


def test_red_is_too_far_as_in_the_preview() -> None:
    pytest.importorskip("matplotlib")
    image = tofray.demo().plot("error").axes[0].images[0]
    high = image.get_clim()[1]
    red, _, blue, _ = image.cmap(image.norm(high))
    assert red > 2 * blue


def test_a_wrong_pixel_does_not_set_the_scale_of_a_plot_and_no_valid_one_is_none_either() -> None:
    pytest.importorskip("matplotlib")
    frame = tofray.demo()
    v, u = np.argwhere(np.isfinite(frame.depth.z_m))[0]
    frame.depth.z_m[v, u] = frame.depth.points_m[v, u, 2] = 500
    low, high = frame.plot("z").axes[0].images[0].get_clim()
    assert np.nanmin(frame.depth.z_m) <= low < high < 2
    figure = frame.plot("cloud")
    figure.canvas.draw()
    assert figure.axes[0].get_ylim()[1] < 2, "z is the axis into the picture"
    frame.depth.z_m[...] = np.nan
    frame.depth.flags[...] = tofray.flags["no_return"]
    for what in ("z", "error", "cloud"):
        frame.plot(what).canvas.draw()


def test_no_private_name_is_offered() -> None:
    frame = tofray.demo()
    offered = [*dir(tofray), *dir(frame), *dir(frame.depth), *dir(tofray.Simulator(tofray.scene(BALL)))]
    assert [name for name in offered if name.startswith("_")] == ["__version__"]


def test_the_import_is_quick_and_loads_no_numpy() -> None:
    code = "import sys, time; a = time.perf_counter(); import tofray; print(time.perf_counter() - a, 'numpy' in sys.modules)"
    runs = [subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout.split() for _ in range(5)]
    assert min(float(seconds) for seconds, _ in runs) < 0.06
    assert all(numpy == "False" for _, numpy in runs)


def test_the_module_is_the_command_line_too() -> None:
    done = subprocess.run([sys.executable, "-m", "tofray", "list", "scenes"], check=True, capture_output=True, text=True)
    assert "bench-primitives" in done.stdout
    assert subprocess.run([sys.executable, "-m", "tofray", "render"], capture_output=True).returncode == 2


def test_a_file_here_is_taken_before_what_is_built_in(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "room.yaml").write_text("objects: [{sphere: {center: [0, 0, 1], radius: 20 cm, reflectivity: 0.5}}]\n", encoding="utf-8")
    profile = pathlib.Path(__file__).resolve().parents[2] / "profiles/pico-flexx.yaml"
    (tmp_path / "pico-flexx").write_text(profile.read_text(encoding="utf-8").replace("width: 224", "width: 222"), encoding="utf-8")
    with pytest.warns(UserWarning, match="^room.yaml of this folder is taken, not the built-in scene room\n") as told:
        assert len(tofray.load_scene("room").objects) == 1
    assert told[0].filename == __file__, "at the line that asked"
    with pytest.warns(UserWarning, match="^./pico-flexx of this folder is taken, not the built-in camera pico-flexx\n") as told:
        assert tofray.load_camera("pico-flexx").sensor.width == 222
    assert told[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert len(tofray.load_scene("room.yaml").objects) == 1
        assert tofray.load_camera(tofray.load_scene("demo")).sensor.width == 224


def test_a_file_outside_of_the_scenes_folder_is_refused_with_the_root_that_lets_it(tmp_path: pathlib.Path,
                                                                                 monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for folder in ("scenes", "my robot"):
        (tmp_path / folder).mkdir()
    (tmp_path / "my robot/a.obj").write_text("v -1 -1 2\nv 1 -1 2\nv 0 1 2\nf 1 2 3\n", encoding="utf-8")
    mesh = {"mesh": {"file": "../my robot/a.obj", "reflectivity": 0.5, "up": "none"}}
    (tmp_path / "scenes/s.yaml").write_text(json.dumps({"objects": [mesh]}), encoding="utf-8")

    def of_file(root: str = "") -> tofray.Scene:
        return tofray.load_scene("scenes/s.yaml", root=root)

    def of_dict(root: str = "") -> tofray.Scene:
        return tofray.scene({"objects": [mesh]}, folder="scenes", root=root)

    for read in (of_file, of_dict):
        with pytest.raises(tofray.Error, match='leads out of the folder .*: if this one is yours, add root="my robot"\n'):
            read()
        with pytest.raises(tofray.Error, match="of this folder and of that of root|of this file and of that of root"):
            read(root="scenes")
        assert len(read(root="my robot").objects) == 1
    with pytest.raises(tofray.Error, match="^mode: error: "):
        tofray.load_camera("pico-flexx", "FAST")
