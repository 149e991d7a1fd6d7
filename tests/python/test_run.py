# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""tofray.render and tofray.pixel_chain: what the command line says and writes."""

from __future__ import annotations

import hashlib
import json
import pathlib
import subprocess
import sys
from typing import Any

import numpy as np
import pytest

import tofray

SMALL = {"camera.sensor.width": 24, "camera.sensor.height": 20}


def tool(*words: str) -> str:
    """The command line in this module's own process, as `python -m tofray`; skipped where it is not beside the module."""
    found = pathlib.Path(tofray.__file__).resolve().parents[2]
    for place in (pathlib.Path(sys.path[0]), found, *(pathlib.Path(one) for one in sys.path)):
        program = place.parent / "apps/tofray/tofray"
        if program.is_file():
            return subprocess.run([str(program), *words], check=True, capture_output=True, text=True).stdout
    pytest.skip("no program tofray beside the module")


def hashes(folder: pathlib.Path) -> dict[str, str]:
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.iterdir() if path.name != "manifest.json"}


def test_a_run_has_the_command_lines_bytes(tmp_path: pathlib.Path) -> None:
    done: list[int] = []
    result = tofray.render("flying-ball", tmp_path / "python", set=SMALL, frames=3, first_frame=5, seed=7, emit=["npz", "png"],
                           arrays=["z_m", "raw"], each=done.append)
    tool("render", "flying-ball", "-o", str(tmp_path / "typed"), "--set", "camera.sensor.width=24", "--set", "camera.sensor.height=20",
         "--frames", "3", "--first-frame", "5", "--seed", "7", "--emit", "npz,png", "--arrays", "z_m,raw")
    assert hashes(tmp_path / "python") == hashes(tmp_path / "typed") and len(hashes(tmp_path / "python")) == 15
    assert done == [1, 2, 3] and result.frames == 3 and not result.interrupted
    assert {one.name: one.sha256 for one in result.files if one.name != "manifest.json"} == hashes(tmp_path / "python")
    assert result.last.pixels.pixels == 24 * 20 and result.ran_on.backend == "cpu"
    assert [name for name, _ in result.timings_s] == ["prepare", "write", "simulate"]


def test_a_run_is_made_again_from_its_manifest(tmp_path: pathlib.Path) -> None:
    scene = tmp_path / "wall.yaml"
    scene.write_text("objects:\n  - plane: {point: [0, 0, 1], normal: [0, 0, -1], reflectivity: 0.5}\n", encoding="utf-8")
    first = tofray.render(scene, tmp_path / "one", set=SMALL, noise="off", subpixel=2, theme="light", scale=2)
    manifest = json.loads((tmp_path / "one/manifest.json").read_text(encoding="utf-8"))
    assert dict(manifest["options"]) == {"noise": "off", "subpixel": "2", "theme": "light", "scale": "2"}
    scene.unlink()
    again = tofray.render_again(tmp_path / "one/manifest.json", tmp_path / "two", threads=1)
    assert hashes(tmp_path / "one") == hashes(tmp_path / "two") and again.frames == first.frames == 1


def test_a_callback_that_raises_leaves_what_is_complete(tmp_path: pathlib.Path) -> None:
    def stop(done: int) -> None:
        if done == 2:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        tofray.render("flying-ball", tmp_path / "out", set=SMALL, frames=50, each=stop)
    manifest = json.loads((tmp_path / "out/manifest.json").read_text(encoding="utf-8"))
    kept = manifest["interrupted_after_frames"]
    assert 2 <= kept < 50 and len(hashes(tmp_path / "out")) == kept


def test_remarks_say_what_is_odd(tmp_path: pathlib.Path) -> None:
    scene = tmp_path / "dark.yaml"
    scene.write_text("objects: []\n", encoding="utf-8")
    inputs = tofray.load_inputs(scene, set={"camera.illumination": []})
    assert [one.what for one in inputs.remarks] == ["the scene has no objects: objects is []",
                                                    "the camera has no light source: camera.illumination is []"]
    assert inputs.remarks[0].warning and "noise" in inputs.remarks[0].more
    assert [one.role for one in inputs.files] == ["scene"] and inputs.files[0].text == "objects: []\n"
    result = tofray.render(scene, tmp_path / "out", set=SMALL)
    assert any("no pixel has a valid depth in 1 of 1 frame" in one.what for one in result.remarks)
    assert result.last.pixels.valid == 0 and "no surface" in result.last.reasons and "hit nothing" in result.last.advice


def test_inputs_are_what_a_simulator_takes() -> None:
    inputs = tofray.load_inputs("card", set={"camera.lens.f_number": 2, "objects.0.plane.reflectivity": "20 %"}, mode="MODE_5_45FPS_500")
    assert inputs.camera.lens.f_number == 2 and inputs.camera.mode.name == "MODE_5_45FPS_500" and inputs.remarks == []
    frame = tofray.Simulator(inputs.scene, inputs.camera).frame(0)
    assert np.nanmedian(frame.truth.reflectivity) == np.float32(0.2)


def test_wrong_requests_say_what_is_wrong(tmp_path: pathlib.Path) -> None:
    for words, said in (({"emit": ["tiff"]}, "expected npz, png, ply or mcap"), ({"scale": 9}, "1 to 8"), ({"arrays": ["nothing"]}, "nothing"),
                        ({"frames": 0}, "a run of 0 frames"), ({"frames": 2, "first_frame": 2**64 - 1}, "from 0 to"), ({"frames": 2**63}, "1 to 1000000000000"), ({"mode": "NONE"}, "NONE"), ({"set": {"camera.lens.f_numer": 1}}, "f_number"),
                        ({"theme": "pink"}, "dark or light"), ({"emit": ["png"], "compress": True}, "npz")):
        with pytest.raises(tofray.Error, match=said):
            tofray.render("card", tmp_path / "out", **words)  # type: ignore[arg-type]
        assert not (tmp_path / "out").exists() or not hashes(tmp_path / "out")
    with pytest.raises(tofray.Error):
        tofray.render_again(tmp_path / "manifest.json", tmp_path / "out")
    scene: Any = tofray.load_scene("card")
    with pytest.raises(TypeError, match=r"Simulator\(scene\)"):
        tofray.render(scene, tmp_path / "out")
    with pytest.raises(TypeError, match=r"Simulator\(scene\)"):
        tofray.load_inputs(scene)


def test_a_pixels_chain_is_what_inspect_prints(tmp_path: pathlib.Path) -> None:
    inputs = tofray.load_inputs("demo", set=SMALL)
    frame = tofray.Simulator(inputs.scene, inputs.camera, seed=3).frame(0)
    frame.save(tmp_path)
    for u, v in ((0, 0), (12, 10), (23, 19)):
        chain = tofray.pixel_chain(frame, u, v)
        said = json.loads(tool("inspect", str(tmp_path / "frame.npz"), "--pixel", f"{u},{v}", "--json"))
        assert [one.difference_e for one in chain.raw_frames] == [one["difference_e"] for one in said["raw_frames"]]
        assert [one.half_path_m if np.isfinite(one.half_path_m) else None for one in chain.phases] == [one["half_path_m"] for one in said["phases"]]
        assert chain.object == said["truth"]["object_id"] and (chain.z_m if chain.flags == 0 else None) == said["depth"]["z_m"]
        assert 2 * np.pi * chain.phases[0].measured_turns == said["phases"][0]["measured_phase_rad"]
        assert [(one.cycles, one.range_m, one.cost_m2, one.chosen) for one in chain.candidates] == [
            (one["cycles"], one["range_m"], one["cost"], one["chosen"]) for one in said["unwrapping"]["candidates"]]
        assert [one.noise_e for one in chain.phases] == [one["noise_e"] for one in said["phases"]]
    uncalibrated = tofray.pixel_chain(tofray.load(tmp_path / "frame.npz"), 12, 10)
    assert [one.modulation_frequency_hz for one in uncalibrated.phases] == [80.32e6, 60.24e6]
    assert not uncalibrated.candidates
    assert np.isnan(uncalibrated.phases[0].calibrated_turns) and np.isfinite(uncalibrated.phases[0].measured_turns)
    with pytest.raises(tofray.Error, match="outside the image"):
        tofray.pixel_chain(frame, 24, 0)


def test_a_pixels_bounces_sum_to_its_light() -> None:
    inputs = tofray.load_inputs("corner", set={**SMALL, "transport.bounces": 3, "transport.samples": 8})
    frame = tofray.Simulator(inputs.scene, inputs.camera).frame(0)
    bounces = tofray.pixel_bounces(frame, 12, 10)
    assert not bounces.unknown and len(bounces.shares) >= 3 and bounces.shares[0].last == 0
    assert sum(one.share for one in bounces.shares) == pytest.approx(1)
    assert [sum(one.electrons[k] for one in bounces.shares) for k in range(1, 5)] == pytest.approx(
        [float(frame.truth.direct_e[k, 10, 12] + frame.truth.indirect_e[k, 10, 12]) for k in range(1, 5)])
    assert tofray.validity(frame).pixels.valid == tofray.invalid_pixels(frame, inputs.camera).valid
    with pytest.raises(tofray.Error, match="not known"):
        tofray.pixel_bounces(tofray.Frame(depth=frame.depth), 0, 0)
