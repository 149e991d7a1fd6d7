# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Frames that stay on a GPU, on the stand-in for CUDA's runtime: its memory is the host's, so that a test can look."""

from __future__ import annotations

import copy
import ctypes
import gc
import pickle
from typing import Any

import numpy as np
import pytest

import tofray
from tofray import _native

CUDA = 2  # DLPack's number


class DlTensor(ctypes.Structure):
    """As DLPack's header has it."""

    _fields_ = [
        ("data", ctypes.c_void_p), ("device_type", ctypes.c_int32), ("device", ctypes.c_int32), ("axes", ctypes.c_int32),
        ("code", ctypes.c_uint8), ("bits", ctypes.c_uint8), ("lanes", ctypes.c_uint16),
        ("shape", ctypes.POINTER(ctypes.c_int64)), ("strides", ctypes.POINTER(ctypes.c_int64)), ("byte_offset", ctypes.c_uint64),
        ("owner", ctypes.c_void_p), ("give_back", ctypes.CFUNCTYPE(None, ctypes.c_void_p)),
    ]


api = ctypes.pythonapi
api.PyCapsule_GetPointer.restype = ctypes.c_void_p
api.PyCapsule_GetPointer.argtypes = [ctypes.py_object, ctypes.c_char_p]
api.PyCapsule_SetName.argtypes = [ctypes.py_object, ctypes.c_char_p]
USED = b"used_dltensor"


def held() -> int:
    function = ctypes.CDLL(_native.__file__).tofray_stand_in_held
    function.restype = ctypes.c_size_t
    return int(function())


def by_interface(array: Any) -> np.ndarray[Any, Any]:
    """What a library of CUDA's would see through __cuda_array_interface__."""

    class Host:
        __array_interface__ = {key: value for key, value in array.__cuda_array_interface__.items() if key != "stream"}

    return np.array(Host(), copy=True)


def tensor_of(capsule: Any) -> DlTensor:
    return DlTensor.from_address(api.PyCapsule_GetPointer(capsule, b"dltensor"))


def by_dlpack(array: Any) -> np.ndarray[Any, Any]:
    capsule = array.__dlpack__(stream=1)
    one = tensor_of(capsule)
    kind = {0: "i", 1: "u", 2: "f"}[one.code]
    dtype = np.dtype(f"<{kind}{one.bits // 8}")
    shape, strides = one.shape[: one.axes], one.strides[: one.axes]
    assert (one.device_type, one.device, one.lanes, one.byte_offset) == (CUDA, array.device, 1, 0)

    class Host:
        __array_interface__ = {
            "shape": tuple(shape), "typestr": dtype.str, "data": (one.data, True), "strides": tuple(dtype.itemsize * s for s in strides),
            "version": 3,
        }

    return np.array(Host(), copy=True)


@pytest.fixture()
def simulator() -> tofray.Simulator:
    scene = tofray.load_scene("demo")
    camera = tofray.load_camera("pico-flexx", set={"sensor.width": "48", "sensor.height": "36"})
    return tofray.Simulator(scene, camera, seed=5, backend="cuda", threads=1)


def host_arrays(frame: tofray.Frame) -> dict[str, np.ndarray[Any, Any]]:
    lists = {row[0] for row in tofray.arrays if row[4] == "[phase]"}
    return {name: array for name, array in frame.to_dict().items() if name not in lists}


def test_each_array_is_that_of_the_frames_in_the_host(simulator: tofray.Simulator) -> None:
    frames = simulator.frames_on_device(3, 4)
    assert simulator.ran_on.backend == "cuda"
    assert (len(frames), frames.indices, frames.device) == (4, [3, 4, 5, 6], 0)
    assert frames.seconds > 0
    wanted = [host_arrays(simulator.frame(index)) for index in frames.indices]
    assert set(frames.names) == set(wanted[0])
    for name in frames.names:
        array, all_of_it = frames[name], np.stack([one[name] for one in wanted])
        assert (array.name, array.dtype, array.shape) == (name, all_of_it.dtype.name, all_of_it.shape)
        assert (len(array), array.__dlpack_device__()) == (4, (CUDA, 0))
        for seen in (by_interface(array), by_dlpack(array)):
            assert seen.dtype == all_of_it.dtype and seen.tobytes() == all_of_it.tobytes(), name


def test_requests_have_seeds_and_poses_of_their_own(simulator: tofray.Simulator) -> None:
    pose = tofray.Pose(position=(0.1, 0.0, -0.2))
    requests = [tofray.FrameRequest(index=2, seed=9), tofray.FrameRequest(index=0, pose=pose), tofray.FrameRequest(index=7)]
    frames = simulator.frames_on_device(requests=iter(requests))
    assert frames.indices == [2, 0, 7]
    for i, frame in enumerate(simulator.frames(requests=requests)):
        assert by_interface(frames["raw"])[i].tobytes() == frame.raw.raw.tobytes()
        assert by_interface(frames["z_m"])[i].tobytes() == frame.depth.z_m.tobytes()


def test_a_single_frame_lies_without_gaps(simulator: tofray.Simulator) -> None:
    interface = simulator.frames_on_device(1)["points_m"].__cuda_array_interface__
    assert interface["shape"] == (1, 36, 48, 3) and interface["strides"] == (36 * 48 * 12, 48 * 12, 12, 4)
    assert interface["version"] == 3 and interface["stream"] is None and interface["data"][1] is False


def test_arrays_of_later_stages_are_not_there() -> None:
    simulator = tofray.Simulator(tofray.load_scene("sphere"), backend="cuda", last_stage="power", truth=True, threads=1)
    frames = simulator.frames_on_device()
    assert "gt_power_w" in frames and "gt_z_m" in frames
    assert "z_m" not in frames and "raw" not in frames
    with pytest.raises(KeyError, match="expected the name of an array: gt_range_m, gt_z_m"):
        frames["z_m"]


def test_memory_lives_as_long_as_what_looks_at_it() -> None:
    gc.collect()
    before = held()
    camera = tofray.load_camera("pico-flexx", set={"sensor.width": "48", "sensor.height": "36"})
    simulator = tofray.Simulator(tofray.load_scene("sphere"), camera, backend="cuda", threads=1)
    array = simulator.frames_on_device(0, 2)["z_m"]
    seen = by_interface(array)
    del simulator
    gc.collect()
    assert held() > before, "the array still holds it"
    assert by_interface(array).tobytes() == seen.tobytes()
    capsule = array.__dlpack__()
    del array
    gc.collect()
    assert held() > before, "the capsule still holds it"
    one = tensor_of(capsule)
    api.PyCapsule_SetName(capsule, USED)  # as who takes the tensor does: it is theirs to give back
    address = api.PyCapsule_GetPointer(capsule, USED)
    del capsule
    gc.collect()
    assert held() > before, "the tensor still holds it"
    one.give_back(address)
    assert held() == before, "all is given back"


def test_a_capsule_that_nobody_takes_gives_back() -> None:
    gc.collect()
    before = held()
    simulator = tofray.Simulator(tofray.load_scene("sphere"), backend="cuda", threads=1)
    capsule = simulator.frames_on_device()["z_m"].__dlpack__()
    del simulator
    gc.collect()
    assert held() > before
    del capsule
    gc.collect()
    assert held() == before


def test_memory_that_nobody_looks_at_is_used_again(simulator: tofray.Simulator) -> None:
    first = simulator.frames_on_device(0, 2)
    at = first["z_m"].__cuda_array_interface__["data"][0]
    second = simulator.frames_on_device(0, 2)
    assert second["z_m"].__cuda_array_interface__["data"][0] != at, "the first is still looked at"
    array = first["z_m"]
    del first
    third = simulator.frames_on_device(0, 2)
    assert third["z_m"].__cuda_array_interface__["data"][0] != at, "an array of it is"
    del array
    gc.collect()
    assert simulator.frames_on_device(4, 1)["z_m"].__cuda_array_interface__["data"][0] == at


def test_wrong_uses_say_what_is_wanted(simulator: tofray.Simulator) -> None:
    frames = simulator.frames_on_device(0, 1)
    array = frames["z_m"]
    for wrong in (0, "zm", None, b"z_m", ("z_m",), "start_time_s"):
        with pytest.raises(KeyError, match="expected the name of an array: tap_a"):
            frames[wrong]  # type: ignore[index]
    with pytest.raises(TypeError):
        iter(frames)  # type: ignore[call-overload]
    with pytest.raises(BufferError, match="stays on GPU 0"):
        array.__dlpack__(dl_device=(1, 0))
    with pytest.raises(BufferError, match="copy=True"):
        array.__dlpack__(copy=True)
    with pytest.raises(TypeError):
        array.__dlpack__(1)  # type: ignore[misc]
    assert array.__dlpack__(dl_device=(CUDA, 0), copy=False, max_version=(1, 0), stream=None)
    either: Any
    for either in (frames, array):
        with pytest.raises(TypeError, match="pickle"):
            pickle.dumps(either)
        with pytest.raises(TypeError, match="pickle"):
            copy.deepcopy(either)
        with pytest.raises(TypeError, match="No constructor"):
            type(either)()
        with pytest.raises(AttributeError):
            either.device = 1


@pytest.mark.parametrize("first, count, text", [
    (0, 0, "count: got 0"), (0, -1, "count: got -1"), (-1, 1, "first: got -1"), (0, 1.5, "count: got 1.5"), (0, True, "count: got True"),
    (0, 10**9, "expected 1 to 1000000"), (2**64, 1, "expected 0 or more"), ("0", 1, "first: got '0'"), (0, None, "count: got None"),
])
def test_wrong_numbers_are_refused(simulator: tofray.Simulator, first: Any, count: Any, text: str) -> None:
    with pytest.raises(tofray.Error, match=text) as caught:
        simulator.frames_on_device(first, count)
    assert caught.value.kind == "bad_input"


def test_no_request_is_refused(simulator: tofray.Simulator) -> None:
    with pytest.raises(tofray.Error, match="got no frame"):
        simulator.frames_on_device(requests=[])


def test_more_than_the_memory_is_a_fault_of_the_device(simulator: tofray.Simulator) -> None:
    with pytest.raises(tofray.Error) as caught:
        simulator.frames_on_device(0, 1_000_000)
    assert caught.value.kind == "device"
    assert simulator.frames_on_device(0, 1).indices == [0], "and the next call is good"


def test_a_processor_has_no_such_frames() -> None:
    simulator = tofray.Simulator(tofray.load_scene("sphere"), backend="cpu", threads=1)
    with pytest.raises(tofray.Error) as caught:
        simulator.frames_on_device()
    assert caught.value.kind == "device"


def test_names_are_in_the_table_of_arrays_and_completion_is_short(simulator: tofray.Simulator) -> None:
    frames = simulator.frames_on_device()
    assert set(frames.names) <= {row[0] for row in tofray.arrays}
    assert [name for name in dir(frames) if not name.startswith("_")] == ["device", "indices", "names", "seconds"]
    assert [name for name in dir(frames["z_m"]) if not name.startswith("_")] == ["device", "dtype", "name", "shape"]
    assert repr(frames) == "<tofray.DeviceFrames: 1 of 48 x 36 pixels on GPU 0>"
    assert repr(frames["z_m"]) == "<tofray.DeviceArray z_m: float32 (1, 36, 48) on GPU 0>"
