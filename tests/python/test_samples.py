# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""tofray.open_dataset: what is stored and what is computed are the same bytes, and an epoch has each row once."""

from __future__ import annotations

import importlib
import os
import pathlib
import pickle
import shutil
import subprocess
import sys

import numpy as np
import pytest

import tofray
from test_dataset import TEXT

TOOL = os.environ.get("TOFRAY") or shutil.which("tofray")
SET = TEXT.replace("samples: 300", "samples: 20").replace("radius: {integer: [1, 3]}", "radius: {uniform: [3 cm, 9 cm]}").replace(", objects.1.sphere.radius: 5 cm", "")

pytestmark = pytest.mark.skipif(TOOL is None, reason="no tofray on the path")


def mixed(number: int, key: int) -> int:
    """The finisher of splitmix64 of a number and a key."""
    z = (number + key * 0x9E3779B97F4A7C15) % 2**64
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9 % 2**64
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB % 2**64
    return z ^ (z >> 31)


def tool(*words: str | os.PathLike[str]) -> None:
    done = subprocess.run([str(TOOL), "dataset", *map(str, words)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.fixture(scope="module")
def planned(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    folder = tmp_path_factory.mktemp("set")
    (folder / "set.yaml").write_text(SET, encoding="utf-8")
    tool("plan", folder / "set.yaml", "-o", folder / "out", "--shard-samples", "3", "--pilot", "1")
    return folder / "out"


@pytest.fixture(scope="module")
def merged(planned: pathlib.Path) -> pathlib.Path:
    tool("run", planned)
    tool("merge", planned)
    return planned


def test_what_is_computed_has_the_bytes_of_what_is_stored(merged: pathlib.Path) -> None:
    stored, computed = tofray.open_dataset(merged), tofray.open_dataset(merged, computed=True)
    assert len(stored) == len(computed) == 40 and stored.arrays == ["raw", "z_m", "flags", "gt_z_m", "gt_object_id"]
    for row in (0, 1, 7, 39, -1):
        a, b = stored[row], computed[row]
        for name in stored.arrays:
            assert a[name].dtype == b[name].dtype and a[name].tobytes() == b[name].tobytes(), name
        assert all(a["json"][key] == value for key, value in b["json"].items())
        assert (a["json"]["sample"], a["json"]["view"]) == divmod(row % 40, 2)
    assert isinstance(stored[3]["raw"].base, np.memmap) or isinstance(stored[3]["raw"], np.memmap)
    assert not stored[3]["raw"].flags.writeable


def test_what_is_stored_as_whole_numbers_comes_as_what_these_stand_for(merged: pathlib.Path, tmp_path: pathlib.Path) -> None:
    text = SET.replace("samples: 20", "samples: 4\nas: {gt_z_m: {type: uint16, step: 0.5 mm}}")
    (tmp_path / "set.yaml").write_text(text, encoding="utf-8")
    tool("plan", tmp_path / "set.yaml", "-o", tmp_path / "out", "--pilot", "1")
    tool("run", tmp_path / "out")
    tool("merge", tmp_path / "out")
    stored, computed = tofray.open_dataset(tmp_path / "out"), tofray.open_dataset(tmp_path / "out", computed=True)
    exact = tofray.open_dataset(merged)
    for row in range(8):
        a, b = stored[row], computed[row]
        for name in stored.arrays:
            assert a[name].dtype == b[name].dtype and a[name].tobytes() == b[name].tobytes(), name
        z, true = a["gt_z_m"], exact[row]["gt_z_m"]
        assert z.dtype == np.float32 and np.array_equal(np.isnan(z), np.isnan(true))
        assert 0 < np.nanmax(abs(z - true)) <= 0.25e-3 + 1e-6
        assert a["json"]["arrays"]["gt_z_m"] == {"unit": "m", "dtype": "uint16", "shape": list(z.shape), "step": 0.0005, "no_value": 65535}


@pytest.mark.parametrize("world", [1, 3])
def test_an_epoch_has_each_row_once_of_all_ranks_together(merged: pathlib.Path, world: int) -> None:
    samples = tofray.open_dataset(merged)
    epochs = []
    for epoch in range(2):
        rows = [row for rank in range(world) for batch in samples.stream(4, rank=rank, world=world, seed=9, epoch=epoch) for row in batch["row"]]
        assert sorted(rows) == list(range(40))
        epochs.append(rows)
    assert epochs[0] != epochs[1]
    batches = list(samples.stream(4, world=world, seed=9))
    assert [b["row"] for b in samples.stream(4, world=world, seed=9, start=2)] == [b["row"] for b in batches[2:]]
    assert batches[0]["raw"].shape == (4, 9, 20, 24) and batches[0]["raw"].tobytes() == b"".join(samples[row]["raw"].tobytes() for row in batches[0]["row"])


def test_the_order_is_shard_after_shard_and_the_same_for_ever(merged: pathlib.Path) -> None:
    samples = tofray.open_dataset(merged)
    shards = samples.order(seed=1) // 6
    assert np.count_nonzero(np.diff(shards)) == 6, "each of the seven shards is left once"
    key = mixed(1, 1)
    assert samples.order(seed=1).tolist() == sorted(range(40), key=lambda row: (mixed(row // 6, key), mixed(row, key + 1)))
    assert samples.order(seed=2).tolist() != samples.order(seed=1).tolist()


def test_it_goes_to_another_process(merged: pathlib.Path) -> None:
    again = pickle.loads(pickle.dumps(tofray.open_dataset(merged)))
    assert again[5]["z_m"].tobytes() == tofray.open_dataset(merged)[5]["z_m"].tobytes() and "stored" in repr(again)


def test_torch_has_the_same_batches_from_shards_and_from_the_plan(tmp_path: pathlib.Path) -> None:
    torch = pytest.importorskip("torch")
    text = SET.replace("{choice: [MODE_9_5FPS_2000, MODE_5_45FPS_500]}", "MODE_5_45FPS_500")
    (tmp_path / "set.yaml").write_text(text, encoding="utf-8")
    tool("plan", tmp_path / "set.yaml", "-o", tmp_path / "out", "--pilot", "1")
    tool("run", tmp_path / "out")
    tool("merge", tmp_path / "out")
    sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "examples/python"))
    try:
        stream = importlib.import_module("torch_samples").SetStream
    finally:
        sys.path.pop(0)
    both = [list(stream(tmp_path / "out", 8, seed=3, computed=computed)) for computed in (False, True)]
    assert len(both[0]) == len(both[1]) == 5
    for (raw, z), (same_raw, same_z) in zip(*both):
        assert raw.dtype == z.dtype == torch.float32 and torch.equal(raw, same_raw) and torch.equal(z, same_z) and z.max() > 0
    parts = list(torch.utils.data.DataLoader(stream(tmp_path / "out", 8, seed=3), batch_size=None, num_workers=2))
    assert sorted(float(raw.sum()) for raws, _ in parts for raw in raws) == sorted(float(raw.sum()) for raws, _ in both[0] for raw in raws)


def test_check_says_what_is_seldom_meant_and_in_how_many_samples(tmp_path: pathlib.Path) -> None:
    ball = "{sphere: {name: ball, center: [0, 0, {uniform: [900 m, 1100 m]}], radius: 200 m, reflectivity: 0.5}}"
    (tmp_path / "set.yaml").write_text(f"name: far\nsamples: 6\nscene:\n  camera: {{profile: pico-flexx}}\n  objects: [{ball}]\n", encoding="utf-8")
    done = subprocess.run([str(TOOL), "dataset", "check", str(tmp_path / "set.yaml")], capture_output=True, text=True)
    assert done.returncode == 0 and "good in 6 that were drawn" in done.stdout
    assert "warning: " in done.stderr and "so in 6 of 6 samples that were looked at, first in 0; " in done.stderr, done.stderr


def test_a_hole_is_no_sample(merged: pathlib.Path, tmp_path: pathlib.Path) -> None:
    shutil.copytree(merged, tmp_path / "out")
    (tmp_path / "out/shards/000/000002.json").unlink()
    tool("merge", tmp_path / "out", "--partial")
    samples = tofray.open_dataset(tmp_path / "out")
    assert len(samples) == 40 and samples.rows.tolist() == [*range(12), *range(18, 40)]
    assert sorted(map(int, samples.order())) == [int(row) for row in samples.rows]
    with pytest.raises(LookupError, match="row: 13 is a hole"):
        samples[13]


def test_splits_are_apart_and_the_same_stored_and_computed(tmp_path: pathlib.Path) -> None:
    (tmp_path / "set.yaml").write_text(SET.replace("views: 2", "views: 2\nsplit: {by: scene, test: 30 %, validation: 20 %}"), encoding="utf-8")
    tool("plan", tmp_path / "set.yaml", "-o", tmp_path / "out", "--shard-samples", "3", "--pilot", "1")
    tool("run", tmp_path / "out")
    tool("merge", tmp_path / "out")
    a_set = tofray.Dataset(tmp_path / "set.yaml")
    rows: list[int] = []
    for split in ("train", "validation", "test"):
        stored, computed = (tofray.open_dataset(tmp_path / "out", computed=computed, split=split) for computed in (False, True))
        assert stored.rows.tolist() == computed.rows.tolist() == [row for row in range(40) if a_set.split(row // 2) == split]
        assert sorted(row for batch in stored.stream(4) for row in batch["row"]) == stored.rows.tolist()
        row = int(stored.rows[0])
        assert stored[row]["json"]["split"] == computed[row]["json"]["split"] == split
        assert pickle.loads(pickle.dumps(stored)).rows.tolist() == stored.rows.tolist()
        rows += map(int, stored.rows)
    assert sorted(rows) == list(range(40))
    with pytest.raises(ValueError, match="expected train, validation, test or None"):
        tofray.open_dataset(tmp_path / "out", split="training")


@pytest.mark.parametrize(("change", "message"), [
    (lambda folder: (folder / "plan.json").unlink(), "there is no plan in this folder"),
    (lambda folder: (folder.parent / "set.yaml").write_text("name: other\n", encoding="utf-8"), "this is not the set of"),
    (lambda folder: (folder / "plan.json").write_text((folder / "plan.json").read_text(encoding="utf-8").replace(tofray.__version__, "0.0.9", 1), encoding="utf-8"),
     "tofray 0.0.9 made it"),
])
def test_another_set_is_refused(merged: pathlib.Path, tmp_path: pathlib.Path, change: object, message: str) -> None:
    shutil.copytree(merged.parent, tmp_path / "set")
    change(tmp_path / "set/out")  # type: ignore[operator]
    with pytest.raises(tofray.Error, match=message):
        tofray.open_dataset(tmp_path / "set/out", computed=True)


def test_wrong_numbers_are_refused(planned: pathlib.Path, tmp_path: pathlib.Path) -> None:
    samples = tofray.open_dataset(planned, computed=True)
    for bad in (40, -41):
        with pytest.raises(IndexError, match="expected 0 to 39"):
            samples[bad]
    for words in ({"batch": 0}, {"batch": 1, "rank": 2, "world": 2}, {"batch": 1, "start": -1}):
        with pytest.raises(ValueError, match="expected at least 1"):
            next(samples.stream(**words))
    with pytest.raises(tofray.Error, match="there is no plan"):
        tofray.open_dataset(tmp_path)


SETS = sorted((pathlib.Path(__file__).resolve().parents[2] / "examples").glob("*/*.yaml"))
SETS = [one for one in SETS if "\nsamples: " in one.read_text(encoding="utf-8")]


def test_examples_have_the_sets_that_the_page_lists() -> None:
    page = (pathlib.Path(__file__).resolve().parents[2] / "docs/datasets.md").read_text(encoding="utf-8")
    assert len(SETS) == 6
    assert all(f"../examples/{one.parent.name}/{one.name}" in page for one in SETS)


@pytest.mark.parametrize("file", SETS, ids=[one.stem for one in SETS])
def test_sets_of_the_examples_show_something(file: pathlib.Path) -> None:
    a_set = tofray.Dataset(file)
    for i in (0, len(a_set) - 1):
        frame = a_set[i]
        assert frame.depth.z_m is not None and np.isfinite(frame.depth.z_m).mean() > 0.02
        assert frame.truth.object_id is not None and len(np.unique(frame.truth.object_id)) >= (1 if file.stem == "targets" else 2)
