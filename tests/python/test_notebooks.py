# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The notebooks of examples/python/notebooks run to their end, show pictures, warn of nothing, and are stored without outputs."""

from __future__ import annotations

import importlib
import os
import pathlib
import sys
from typing import Any

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs/site"))

notebooks: Any = importlib.import_module("notebooks")  # beside the site that shows them

ALL: list[pathlib.Path] = notebooks.notebooks_of(ROOT)


def stem_of(path: pathlib.Path) -> str:
    return path.stem


def test_there_are_five() -> None:
    assert {path.stem for path in ALL} == {"first_frame", "why_raw_phases", "wiggling", "unwrapping", "multipath"}


@pytest.mark.parametrize("path", ALL, ids=stem_of)
def test_a_notebook_is_stored_without_outputs(path: pathlib.Path) -> None:
    assert notebooks.faults_of_stored(path) == []


@pytest.mark.parametrize("path", ALL, ids=stem_of)
def test_a_notebook_runs_to_its_end(path: pathlib.Path, tmp_path: pathlib.Path) -> None:
    for needed in ("nbconvert", "ipykernel", "matplotlib"):
        pytest.importorskip(needed)
    assert notebooks.run(path, os.environ["PYTHONPATH"], tmp_path / "out") == []
    assert (tmp_path / f"out/{path.stem}.md").exists()
    assert len(list((tmp_path / f"out/{path.stem}_files").glob("*.png"))) >= 3
