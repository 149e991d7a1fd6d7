# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""tofray.fit: known numbers come back with honest errors, and what rows do not say is refused by name."""

from __future__ import annotations

import json
import math
import os
import pathlib
import subprocess
import sys
from typing import Any

import numpy as np
import pytest

import tofray

pytest.importorskip("scipy")

ROOT = pathlib.Path(__file__).resolve().parents[2]
O3D303 = ROOT / "data/measured/ifm-o3d303/distance_noise_o3d303.dat"
POWER, READ, WAVE = "illumination.0.power", "pixel.read_noise", "illumination.0.waveform"
DISTANCES = np.geomspace(0.5, 4.5, 24)


def simulated(changes: dict[str, Any], distances: Any = DISTANCES, reflectivity: float = 0.8, camera: str = "o3d303", mode: str = "under5m_low", ambient: float = 0.0) -> dict[str, Any]:
    """Noise of a camera with known numbers, by another way than fit's: the whole budget."""
    got = tofray.budget(tofray.load_camera(camera, mode, set=changes), distances, [reflectivity], [ambient])
    return {"distance_m": np.asarray(distances), "sigma_mm": 1e3 * got["sigma_m"][0, 0], "intensity": got["amplitude_e"][0, 0], "bias_mm": 1e3 * got["bias_m"][0, 0]}


def noise_alone(rows: dict[str, Any], factor: Any = 1.0) -> dict[str, Any]:
    return {"distance_m": rows["distance_m"], "sigma_mm": rows["sigma_mm"] * factor}


def test_numbers_come_back_from_rows_without_errors_of_their_own() -> None:
    found = tofray.fit("o3d303", noise_alone(simulated({POWER: "2.2 W", READ: "140 e"})), [POWER, READ], mode="under5m_low")
    assert found[POWER].value == pytest.approx(2.2, rel=2e-3) and found[READ].value == pytest.approx(140, rel=2e-3)
    assert found[POWER].start == 1.65 and found[READ].unit == "e"
    assert found.scatter["sigma"] < 1e-3 < 0.05 < found.scatter_before["sigma"]


def test_errors_are_as_large_as_the_fits_scatter() -> None:
    many = 200 if os.environ.get("TOFRAY_LONG") else 40   # of a third of a second each
    true = {POWER: 2.2, READ: 140.0}
    rows = simulated({POWER: "2.2 W", READ: "140 e"}, np.geomspace(0.5, 4.5, 48))
    random = np.random.default_rng(7)
    off: dict[str, list[float]] = {POWER: [], READ: []}
    for _ in range(many):
        found = tofray.fit("o3d303", noise_alone(rows, np.exp(0.05 * random.standard_normal(48))), [POWER, READ], mode="under5m_low")
        for key, value in true.items():
            off[key].append(math.log(found[key].value / value) / (found[key].error / found[key].value))
    for key, values in off.items():
        # Of 46 degrees of freedom 94.9 % within two standard errors, with a standard deviation of 3.1 of 200 and 1.4 of 40: 3.2 of them below.
        # Errors that are half as large as they should be have 68 %.
        inside, least = int((np.abs(values) < 2).sum()), 0.949 * many - 3.2 * math.sqrt(0.949 * 0.051 * many)
        assert inside >= least, (key, inside)
        # 1.045 ± 0.24 of 40 (Student's t has a variance of 46/44): errors that are twice as large as they should be have 0.26, half as large 4.2.
        assert 0.5 < np.mean(np.square(values)) < 1.9, (key, np.mean(np.square(values)))
        assert abs(np.mean(values)) < 4.2 / math.sqrt(many), (key, np.mean(values))  # no bias: 4 standard errors


def test_the_published_o3d303_has_a_period_of_1_25_m_and_a_third_harmonic() -> None:
    start = {WAVE: "{kind: sine, modulation_depth: 90 %}", POWER: "1 W", READ: "60 e", "modes.under5m_low.sequence.0.modulation_frequency": "26 MHz"}
    found = tofray.fit("o3d303", O3D303, [POWER, READ, WAVE + ".r3", WAVE + ".psi3", "modes.under5m_low.sequence.0.modulation_frequency"], mode="under5m_low",
                       set=start, columns=["distance_mm", "sigma_mm"], where="sigma_mm<250")
    frequency = found["modes.under5m_low.sequence.0.modulation_frequency"]
    assert abs(frequency.value - 30) < 2 * frequency.error < 2, frequency
    assert found.hump_period_m == pytest.approx(1.25, abs=0.03)
    assert 0.04 < found[WAVE + ".r3"].value < 0.06, found[WAVE + ".r3"]
    assert found.scatter["sigma"] < 0.12 and found.rows.said() == "distance_noise_o3d303.dat, 139 of 141 rows (sigma_mm<250)"


def test_a_third_harmonic_comes_back_out_of_the_noise_alone() -> None:
    curve = ", ".join(f"{0.45 * math.cos(x) + 0.45 * 0.07 * math.cos(3 * x + 1.2):.7f}" for x in np.arange(16) * math.pi / 8)
    rows = simulated({WAVE: f"{{kind: measured, correlation: [{curve}], harmonics: 2}}"}, np.linspace(0.6, 4, 40))
    found = tofray.fit("o3d303", noise_alone(rows), [WAVE + ".a1", WAVE + ".r3", WAVE + ".psi3"], mode="under5m_low", set={WAVE: "{kind: sine, modulation_depth: 70 %}"})
    assert found[WAVE + ".r3"].value == pytest.approx(0.07, abs=5e-4)
    assert found[WAVE + ".psi3"].value == pytest.approx(math.degrees(1.2), abs=0.5)
    assert found[WAVE + ".a1"].value == pytest.approx(0.45, rel=2e-3)


def test_rows_may_have_modes_light_and_reflectivities_of_their_own() -> None:
    parts = [(0.2, "upto30m_low", 0.0), (0.8, "under5m_low", 0.0), (0.5, "under5m_low", 30e3)]
    data: dict[str, list[Any]] = {name: [] for name in ("distance_m", "sigma_mm", "reflectivity", "mode", "ambient_lx")}
    for reflectivity, mode, ambient in parts:
        rows = simulated({READ: "140 e"}, DISTANCES, reflectivity, "o3d303", mode, ambient)
        for name, values in {"distance_m": rows["distance_m"], "sigma_mm": rows["sigma_mm"], "reflectivity": [reflectivity] * 24, "mode": [mode] * 24, "ambient_lx": [ambient] * 24}.items():
            data[name] += list(values)
    found = tofray.fit("o3d303", data, [READ])
    assert found[READ].value == pytest.approx(140, rel=2e-3) and found.scatter["sigma"] < 1e-3


def test_reflectivity_of_each_class_is_found_where_it_is_not_known() -> None:
    white, black = (simulated({}, DISTANCES, share) for share in (0.75, 0.3))
    data = {"distance_m": np.tile(DISTANCES, 2), "sigma_mm": np.concatenate([white["sigma_mm"], black["sigma_mm"]]), "class": ["white"] * 24 + ["black"] * 24}
    found = tofray.fit("o3d303", data, [READ], mode="under5m_low", scale_free=["reflectivity"])
    assert found["reflectivity of white"].value == pytest.approx(0.75, rel=5e-3) and found["reflectivity of black"].value == pytest.approx(0.3, rel=5e-3)
    assert found[READ].value == pytest.approx(86.5, rel=5e-3)


def test_an_intensity_is_a_measure_up_to_its_unit() -> None:
    rows = simulated({POWER: "2.2 W"})
    both = {"distance_m": DISTANCES, "sigma_mm": rows["sigma_mm"], "intensity": 0.04 * rows["intensity"]}
    found = tofray.fit("o3d303", both, [POWER], mode="under5m_low", scale_free=["intensity"])
    assert found["intensity per electron"].value == pytest.approx(0.04, rel=5e-3) and found[POWER].value == pytest.approx(2.2, rel=5e-3)
    sine = {WAVE: "{kind: sine, modulation_depth: 90 %}"}  # no humps: noise follows from the intensity alone
    rows = simulated({**sine, READ: "140 e"})
    alone = tofray.fit("o3d303", {"intensity": 0.04 * rows["intensity"], "sigma_mm": rows["sigma_mm"]}, [READ], mode="under5m_low", scale_free=["intensity"], set=sine)
    assert alone[READ].value == pytest.approx(140, rel=0.02) and alone["intensity per electron"].value == pytest.approx(0.04, rel=0.02)


def test_a_bias_says_the_drift_where_its_offset_is_known() -> None:
    warm = {"temperature.drift": "0.4 mm/K", "temperature.actual": "45 degC"}
    data = {"distance_m": DISTANCES, "bias_mm": simulated(warm)["bias_mm"]}
    found = tofray.fit("o3d303", data, ["temperature.drift"], mode="under5m_low", set={"temperature.actual": "45 degC", "temperature.drift": "0.1 mm/K"})
    assert found["temperature.drift"].value == pytest.approx(0.4, rel=0.01)
    with pytest.raises(tofray.Error, match="offset of bias"):
        tofray.fit("o3d303", data, ["temperature.drift"], mode="under5m_low", set={"temperature.actual": "45 degC", "temperature.drift": "0.1 mm/K"}, scale_free=["bias"])


def test_outliers_weigh_little() -> None:
    factor = np.exp(0.02 * np.random.default_rng(3).standard_normal(24))
    factor[[4, 17]] = 5
    found = tofray.fit("o3d303", noise_alone(simulated({POWER: "2.2 W"}), factor), [POWER], mode="under5m_low")
    assert found[POWER].value == pytest.approx(2.2, rel=0.03)


@pytest.mark.parametrize(("free", "scale_free", "names"), [
    ([POWER, "lens.transmission"], [], [POWER, "lens.transmission"]),
    ([POWER, READ], ["reflectivity"], [POWER, "reflectivity"]),
    (["pixel.quantum_efficiency", READ, "integration_time"], [], ["pixel.quantum_efficiency", "integration_time"]),
    ([READ, "pixel.reset_noise.sigma"], [], [READ, "pixel.reset_noise.sigma"]),
    ([POWER, "pixel.full_well"], [], ["pixel.full_well"]),
])
def test_what_rows_cannot_tell_apart_is_refused_by_name(free: list[str], scale_free: list[str], names: list[str]) -> None:
    rows = noise_alone(simulated({"pixel.reset_noise.sigma": "40 e"}), np.exp(0.05 * np.random.default_rng(5).standard_normal(24)))
    with pytest.raises(tofray.Error) as fault:
        tofray.fit("o3d303", rows, free, mode="under5m_low", scale_free=scale_free, set={"pixel.reset_noise.sigma": "40 e"})
    first = str(fault.value).split("\n")[0]
    assert all(name in first for name in names), first
    assert "cannot be told apart" in first or "none depends on it" in first
    assert not any(one in first for one in {POWER, READ, "pixel.quantum_efficiency"} - set(names)), first


def test_a_number_that_rules_no_row_is_not_known() -> None:
    near = noise_alone(simulated({READ: "2 e"}, np.linspace(0.5, 0.7, 12)), np.exp(0.1 * np.random.default_rng(5).standard_normal(12)))
    with pytest.raises(tofray.Error, match="pixel.read_noise cannot be known from these rows: none depends on it"):
        tofray.fit("o3d303", near, [READ], mode="under5m_low", set={READ: "2 e"})
    rows = simulated({READ: "30 e"}, np.linspace(0.5, 0.9, 12))
    for seed, free, said in ((4, [READ], "rows\n  got a standard error of a factor of"), (3, [READ, POWER], "rows beside illumination.0.power")):
        noisy = noise_alone(rows, np.exp(0.2 * np.random.default_rng(seed).standard_normal(12)))
        with pytest.raises(tofray.Error, match="pixel.read_noise cannot be known from these " + said):
            tofray.fit("o3d303", noisy, free, mode="under5m_low", set={READ: "30 e"})


def test_recordings_of_walls_are_measured(tmp_path: pathlib.Path) -> None:
    small = {"sensor.width": 15, "sensor.height": 15, "lens.cx": "7 px", "lens.cy": "7 px"}
    camera = tofray.load_camera("o3d303", "under5m_low", set={**small, READ: "130 e"})
    lines = ["distance_m,reflectivity,recording"]
    for distance in (0.8, 1.3, 2.0):
        scene = tofray.scene({"objects": [{"plane": {"point": [0, 0, distance], "normal": [0, 0, -1], "reflectivity": 0.5}}]})
        simulator = tofray.Simulator(scene, camera, seed=3)
        folder = tmp_path / f"{distance}"
        folder.mkdir()
        for i in range(40):
            frame = simulator.frame(i)
            np.savez(folder / f"frame_{i:04}.npz", raw=frame.raw.raw, modulation_frequency_hz=frame.raw.modulation_frequency_hz,
                     reference_phase_rad=frame.raw.reference_phase_rad, integration_time_s=frame.raw.integration_time_s, lit=frame.raw.lit)
        lines.append(f"{distance},50%,{distance}")
    (tmp_path / "walls.csv").write_text("\n".join(lines) + "\n")
    found = tofray.fit("o3d303", tmp_path / "walls.csv", [READ], mode="under5m_low", set=small)
    # 40 frames of 121 pixels: each deviation to 1/sqrt(2 * 39 * 121) = 1.0 %, and the read noise of three of them to about that.
    assert found[READ].value == pytest.approx(130, rel=0.05)


@pytest.mark.parametrize(("text", "said"), [
    ("distance,sigma_mm\n1,2\n", "f.csv:1:1: error: the column distance needs its unit"),
    ("distance_m, noise\n1,2\n", "f.csv:1:13: error: there is no column 'noise'"),
    ("distance_m,sigma_mm\n1,2\n2,\n3,x\n", "f.csv:4:3: error: sigma_mm is no number"),
    ("distance_m,sigma_mm\n1,-2\n", "f.csv:2:3: error: sigma_mm cannot be -2"),
    ("distance_m,sigma_mm\n1,2,3\n", "f.csv:2:5: error: there are 3 columns"),
    ("1,2\n", "f.csv:1:1: error: the columns have no names"),
    ("distance_m,reflectivity\n1,0.5\n", "f.csv:1:1: error: nothing is measured"),
    ("sigma_mm\n1\n", "f.csv:1:1: error: the rows say neither"),
    ("distance_m,sigma_mm,reflectivity\n1,2,80\n", "f.csv:2:5: error: reflectivity cannot be 80"),
    ("distance_m,sigma_mm\n", "f.csv: error: there are no rows"),
    ("distance_m,distance_mm,sigma_mm\n1,1,1\n", "f.csv:1:12: error: the column distance_mm is there twice"),
])
def test_faults_of_a_file_have_line_and_column(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch, text: str, said: str) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "f.csv").write_text(text)
    with pytest.raises(tofray.Error) as fault:
        tofray.fit("o3d303", "f.csv", [POWER], mode="under5m_low")
    assert str(fault.value).split("\n")[0].startswith(said)


@pytest.mark.parametrize(("words", "said"), [
    ({"free": ["illumination.0.powr"]}, "did you mean 'illumination.0.power'"),
    ({"free": []}, "nothing to look for"), ({"free": ["adc.bits"]}, "whole number"), ({"free": ["illumination.3.waveform.r3"]}, "is of light 3"),
    ({"where": "distance_m<0.1"}, "leaves no row"), ({"where": "far"}, "expected a column"), ({"scale_free": ["all"]}, "expected reflectivity"),
    ({"scale_free": ["intensity"]}, "intensity is no column"), ({"set": {WAVE: "{kind: rectangular}"}, "free": [WAVE + ".r3"]}, "its kind, rectangular"),
    ({"set": {POWER: "900 W"}}, "no row has a range noise"),
])
def test_what_cannot_be_asked_is_refused(words: dict[str, Any], said: str) -> None:
    with pytest.raises(tofray.Error, match=said):
        tofray.fit("o3d303", noise_alone(simulated({})), words.pop("free", [POWER]), mode="under5m_low", **words)


def test_without_scipy_the_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    gone: Any = None
    monkeypatch.setitem(sys.modules, "scipy.optimize", gone)
    with pytest.raises(ImportError, match="Debian: python3-scipy"):
        tofray.fit("o3d303", noise_alone(simulated({})), [POWER])


def test_the_diff_changes_a_profile_into_the_fitted_camera_and_leaves_its_comments(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    own = tmp_path / "own.yaml"
    text = (ROOT / "profiles/o3d303.yaml").read_text().replace("name: o3d303", "name: own").replace("  dark_current: 2000 e/s\n", "")
    own.write_text(text)
    free = [POWER, READ, WAVE + ".r3", WAVE + ".psi3", "modes.under5m_low.sequence.0.modulation_frequency"]
    found = tofray.fit("own.yaml", noise_alone(simulated({POWER: "2.2 W"}), 1.01), free, mode="under5m_low", set={"pixel.dark_current": "5000 e/s"})
    assert own.read_text() == text
    (tmp_path / "fit.diff").write_text(found.diff())
    subprocess.run(["patch", "-s", "own.yaml", "fit.diff"], check=True)
    changed = tofray.load_camera("own.yaml", "under5m_low")
    assert changed.illumination[0].power_w == pytest.approx(found[POWER].value, abs=0.1 * found[POWER].error)
    assert changed.pixel.read_noise_e == pytest.approx(found[READ].value, abs=0.1 * found[READ].error)
    assert changed.pixel.dark_current_e_per_s == 5000
    assert changed.mode.sequence[0].modulation_frequency_hz == pytest.approx(found[free[4]].value * 1e6, rel=1e-4)
    other = tofray.load_camera("own.yaml", "upto30m_low")
    assert [one.modulation_frequency_hz for one in other.mode.sequence][::4] == [30e6, 25e6]
    now = own.read_text()
    assert [line for line in text.split("\n") if line.startswith("#")] == [line for line in now.split("\n") if line.startswith("#")]
    assert 'source: "fitted to data, 24 rows' in now and "standard_error:" in found.patch()


def run(folder: pathlib.Path, *words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "tofray", "fit", *words], cwd=folder, capture_output=True, text=True, env={**os.environ, "PYTHONPATH": os.path.abspath(os.environ["PYTHONPATH"])})


def test_the_command_writes_files_and_says_by_its_exit_code_what_happened(tmp_path: pathlib.Path) -> None:
    pytest.importorskip("matplotlib")
    rows = simulated({POWER: "2.2 W"})
    random = np.exp(0.05 * np.random.default_rng(2).standard_normal(24))
    (tmp_path / "noise.csv").write_text("distance_m,sigma_mm\n" + "".join(f"{d:.4f},{s:.4f}\n" for d, s in zip(DISTANCES, rows["sigma_mm"] * random)))
    done = run(tmp_path, "o3d303", "noise.csv", "--mode", "under5m_low", "--free", POWER, "-o", "fitted", "--plot")
    assert done.returncode == 0, done.stderr
    assert "fitted to noise.csv, 24 rows" in done.stdout and "kappa" in done.stdout and "correlations" in done.stdout
    assert sorted(one.name for one in (tmp_path / "fitted").iterdir()) == ["fit.json", "fit.png", "patch.yaml", "profile.diff", "rows.csv", "table.md"]
    told = json.loads((tmp_path / "fitted/fit.json").read_text())
    assert told["parameters"][0]["key"] == POWER and abs(told["parameters"][0]["value"] - 2.2) < 3 * told["parameters"][0]["standard_error"]
    assert (tmp_path / "fitted/rows.csv").read_text().count("\n") == 25 and "| fitted |" in (tmp_path / "fitted/table.md").read_text()
    assert run(tmp_path, "o3d303", "noise.csv", "--mode", "under5m_low", "--free", f"{POWER},lens.transmission").returncode == 1
    assert run(tmp_path, "o3d303", "noise.csv", "--free", "nothing").returncode == 2
    assert run(tmp_path, "o3d303", "none.csv", "--free", POWER).returncode == 3
