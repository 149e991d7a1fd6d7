# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Frames that stay on a real GPU, as PyTorch and CuPy see them. Where there is no GPU, or neither library, the tests say that they were skipped."""

from __future__ import annotations

import os
from typing import Any, Callable

import numpy as np
import pytest

import tofray


def through_torch(array: Any) -> Any:
    torch = pytest.importorskip("torch")
    seen = torch.from_dlpack(array)
    assert seen.is_cuda and seen.device.index == array.device and tuple(seen.shape) == array.shape
    return seen.cpu().numpy()


def through_cupy(array: Any) -> Any:
    cupy = pytest.importorskip("cupy")
    assert cupy.from_dlpack(array).data.ptr == cupy.asarray(array).data.ptr == array.__cuda_array_interface__["data"][0]
    return cupy.asnumpy(cupy.asarray(array))


def simulator_of(scene: str, **options: Any) -> tofray.Simulator:
    try:
        return tofray.Simulator(tofray.load_scene(scene), seed=5, backend="cuda", **options)
    except tofray.Error as error:
        if error.kind != "device" or "TOFRAY_EXPECT_GPU" in os.environ:
            raise
        pytest.skip(str(error).splitlines()[0])


@pytest.mark.parametrize("see", [through_torch, through_cupy])
@pytest.mark.parametrize("scene", ["demo", "flying-ball"])
def test_other_libraries_see_the_processors_frames(see: Callable[[Any], Any], scene: str) -> None:
    frames = simulator_of(scene).frames_on_device(3, 5)
    assert frames.seconds > 0
    there = {name: see(frames[name]) for name in frames.names}
    on_processor = tofray.Simulator(tofray.load_scene(scene), seed=5, backend="cpu")
    for i, index in enumerate(frames.indices):
        here = on_processor.frame(index).to_dict()
        for name, values in there.items():
            assert np.ascontiguousarray(values[i]).tobytes() == here[name].tobytes(), (name, index)


def test_what_a_library_looks_at_outlives_the_frames() -> None:
    torch = pytest.importorskip("torch")
    simulator = simulator_of("card")
    first = torch.from_dlpack(simulator.frames_on_device(0, 2)["z_m"])
    wanted = first.clone()
    second = torch.from_dlpack(simulator.frames_on_device(2, 2)["z_m"])
    del simulator
    assert first.data_ptr() != second.data_ptr()
    assert torch.equal(first.nan_to_num(-1), wanted.nan_to_num(-1))
