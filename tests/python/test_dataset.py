# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""tofray.Dataset: draws by their documented address, and frames as `tofray render` makes them."""

from __future__ import annotations

import hashlib
import pathlib
import pickle

import numpy as np
import pytest

import tofray

TEXT = """
name: trial
license: CC0-1.0
samples: 300
seed: 1099511627777
views: 2
let: {wall: {uniform: [1 m, 2 m]}}
scene:
  camera: {profile: pico-flexx, pose: {position: [{uniform: [0 m, 1 cm]}, 0, 0]}}
  objects:
    - plane: {name: back, point: [0, 0, "= wall"], reflectivity: {choice: [20 %, 60 %]}}
    - sphere: {name: ball, center: [0, 0, 0.7 m], radius: {integer: [1, 3]}, reflectivity: 0.4}
set: {camera.sensor.width: 24, camera.sensor.height: 20, objects.1.sphere.radius: 5 cm}
"""


@pytest.fixture()
def dataset(tmp_path: pathlib.Path) -> tofray.Dataset:
    (tmp_path / "set.yaml").write_text(TEXT.replace("radius: {integer: [1, 3]}", "radius: {uniform: [3 cm, 9 cm]}").replace(", objects.1.sphere.radius: 5 cm", ""),
                                       encoding="utf-8")
    return tofray.Dataset(tmp_path / "set.yaml")


def philox(counter: list[int], key: list[int]) -> list[int]:
    """Philox4x32-10 after Salmon et al. 2011."""
    for _ in range(10):
        product_0, product_1 = 0xD2511F53 * counter[0], 0xCD9E8D57 * counter[2]
        counter = [(product_1 >> 32) ^ counter[1] ^ key[0], product_1 & 0xFFFFFFFF, (product_0 >> 32) ^ counter[3] ^ key[1], product_0 & 0xFFFFFFFF]
        key = [(key[0] + 0x9E3779B9) & 0xFFFFFFFF, (key[1] + 0xBB67AE85) & 0xFFFFFFFF]
    return counter


def unit(seed: int, sample: int, view: int, path: str) -> float:
    """A draw by its documented address: 53 bits in [0, 1)."""
    place = int.from_bytes(hashlib.sha256(path.encode()).digest()[:8], "big")
    words = philox([sample & 0xFFFFFFFF, (sample >> 32) << 24 | view << 16, place & 0xFFFFFFFF, place >> 32], [seed & 0xFFFFFFFF, seed >> 32])
    return float((words[0] << 32 | words[1]) >> 11) * 2.0**-53


def test_philox_has_the_known_answers() -> None:
    assert philox([0] * 4, [0] * 2) == [0x6627E8D5, 0xE169C58D, 0xBC57AC4C, 0x9B00DBD8]
    assert philox([0xFFFFFFFF] * 4, [0xFFFFFFFF] * 2) == [0x408F276D, 0x41C83B0E, 0xA20BC7C6, 0x6D5451FD]


def test_a_draw_is_that_of_its_address(dataset: tofray.Dataset) -> None:
    seed = 1099511627777
    for sample, view in ((0, 0), (1, 1), (299, 1)):
        drawn = {one.path: one for one in dataset.drawn(sample, view)}
        assert drawn["let/wall"].value == 1 + unit(seed, sample, 0, "let/wall")
        assert drawn["objects/ball/radius"].value == 3 + 6 * unit(seed, sample, 0, "objects/ball/radius")
        assert drawn["camera/pose/position[0]"].text == f"{unit(seed, sample, view, 'camera/pose/position[0]') * 0.01!r} m"
        assert drawn["objects/back/reflectivity"].value == (unit(seed, sample, 0, "objects/back/reflectivity") * 2 >= 1)
        assert dataset.noise_seed(sample, view) == int(unit(seed, sample, view, "noise") * 2.0**53)


def test_a_sample_is_what_render_makes_of_its_scene(dataset: tofray.Dataset, tmp_path: pathlib.Path) -> None:
    (tmp_path / "one.yaml").write_text(dataset.scene_yaml(7, 1), encoding="utf-8")
    tofray.render(tmp_path / "one.yaml", tmp_path / "out", seed=dataset.noise_seed(7, 1))
    rendered, frame = tofray.load(tmp_path / "out/frame.npz"), dataset.frame(7, 1)
    np.testing.assert_array_equal(frame.depth.z_m, rendered.depth.z_m)
    np.testing.assert_array_equal(frame.raw.raw, rendered.raw.raw)


def test_it_is_a_sequence_of_frames(dataset: tofray.Dataset) -> None:
    assert dataset.license == "CC0-1.0"
    assert (dataset.name, len(dataset), dataset.views, dataset.combinations) == ("trial", 300, 2, 1)
    np.testing.assert_array_equal(dataset[-1].raw.raw, dataset[299].raw.raw)
    assert (dataset[0].raw.raw != dataset[1].raw.raw).mean() > 0.5
    again = pickle.loads(pickle.dumps(dataset))
    assert again.scene_yaml(5) == dataset.scene_yaml(5)
    assert next(iter(dataset)).raw.raw.shape == dataset[0].raw.raw.shape
    for wrong in (300, -301):
        with pytest.raises(IndexError, match="expected 0 to 299"):
            dataset[wrong]
    with pytest.raises(tofray.Error, match="there is no view 2"):
        dataset.scene(0, 2)


def test_neighbouring_samples_have_noise_of_their_own(dataset: tofray.Dataset) -> None:
    # One scene twice: what is left of the difference is noise, and none of it is alike.
    scene = dataset.scene(0)
    frames = [tofray.Simulator(scene, seed=dataset.noise_seed(i)).frame(0).raw.raw.astype(float) for i in range(3)]
    one, other = frames[1] - frames[0], frames[2] - frames[0]
    assert one.std() > 0 and abs(np.corrcoef((frames[1] - frames[2]).ravel(), (one + other).ravel())[0, 1]) < 0.1


def test_what_is_wrong_is_told_with_its_place(tmp_path: pathlib.Path) -> None:
    (tmp_path / "bad.yaml").write_text("name: a\nsamples: 2\nscene:\n  objects:\n    - sphere: {center: [0, 0, 1], radius: {uniform: [2 cm, 1 cm]}, reflectivity: 0.5}\n",
                                       encoding="utf-8")
    with pytest.raises(tofray.Error, match=r"bad.yaml:5:\d+: error: the form uniform"):
        tofray.Dataset(tmp_path / "bad.yaml").scene(0)
