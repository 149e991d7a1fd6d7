# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Every public name of the C++ API is reached from Python, or is in the list of those that are not, with the reason."""

from __future__ import annotations

import pathlib
import re

import numpy as np
import pytest

import tofray
from tofray import _native

INCLUDE = pathlib.Path(__file__).resolve().parents[2] / "include/tofray"
TEXT = {path.name: re.sub(r"//.*", "", path.read_text(encoding="utf-8")) for path in INCLUDE.glob("*.h")}

LEFT_OUT = {
    "FrameArrays": "a batch's frames are copied into Frame, since a view would outlive its memory",
    "FrameProgress": "Simulator.progress and Simulator.stop()",
    "SimulatorOptions": "Simulator's own words",
    "CameraOptions": "load_camera's own words",
    "ErrorKind": "Error.kind, a word",
    "Noise": "a word", "Isa": "a word", "Backend": "a word", "Stage": "a word", "PowerModel": "a word",
    "ArrayShape": "an array has its shape",
    "ArrayWhen": "a frame has an array, or None",
    "Array": "a numpy array", "AlignedMemory": "a numpy array",
    "Flag": "tofray.flags",
    "NoDepth": "members of InvalidPixels", "no_depth_name": "members of InvalidPixels",
    "NameChoice": "load_scene and load_camera warn", "choose_scene": "load_scene warns", "choose_camera": "load_camera warns",
    "load_scene_text": "tofray.scene", "load_camera_text": "tofray.camera",
    "BudgetRequest": "budget's own words", "BudgetRow": "arrays of Budget", "BudgetFrequency": "arrays of Budget",
    "VarianceShares": "arrays of Budget", "BudgetReach": "Budget.summary", "BudgetSummary": "Budget.summary",
    "budget_summary": "Budget.summary",
    "QualityRequest": "quality's own words", "QualityPreset": "the word like", "quality_presets": "likewise", "ImageRegion": "a tuple",
    "CompareRequest": "compare's own words", "Differences": "dicts of Comparison", "DifferencesAt": "likewise", "DifferencesOfFlag": "likewise",
    "depth_of": "compare and quality take a Truth", "DepthFile": "a Frame", "DepthFileOptions": "words of load_depth", "load_depths": "load_depth takes folders, too",
    "ProfileFile": "what fit stands on", "ProfileNumber": "likewise", "ProfilePlace": "likewise", "profile_file": "likewise",
    "solve_budget": "any root finder on budget()", "BudgetNeed": "likewise", "BudgetSolution": "likewise",
    "frame_npz": "Frame.save",
    "Driver": "a word of McapWriter", "StampAt": "likewise", "McapCompression": "likewise", "MessageOptions": "McapWriter's own words",
    "McapOptions": "McapWriter's own words", "usual_mcap_compression": "compression=None", "McapContents": "a dict of mcap_contents",
    "RenderedPictures": "from_pictures' own words", "LabelMaterial": "likewise", "SampledPictures": "from_pictures gives its Geometry and warns",
    "Messages": "what McapWriter writes", "Message": "likewise", "Topic": "likewise", "message_definition": "a schema in the file",
    "SweepAxis": "keys of Sweep.axes", "sweep_axis": "the mapping vary of sweep", "sweep_axis_of_numbers": "likewise", "SweepMetric": "arrays of Sweep", "sweep_metrics": "likewise",
    "SweepRequest": "sweep's own words", "SweepWatch": "sweep's own words", "best_cells": "Sweep.best", "save_sweep": "the word folder of sweep",
    "KeptFrames": "what sweep stands on", "KeptLight": "likewise", "KeptRaw": "likewise",
    "InputRequest": "load_inputs' own words", "FrameFileRequest": "render's own words", "RunRequest": "render's own words",
    "RunWatch": "render's own words", "request_of_manifest": "render_again",
    "PlanRequest": "the command dataset plan", "DatasetPlan": "likewise", "plan_dataset": "likewise", "read_plan": "open_dataset",
    "ShardChoice": "the command dataset run", "ShardRunRequest": "likewise", "ShardMade": "likewise", "ShardRunResult": "likewise", "ShardWatch": "likewise",
    "run_shards": "likewise", "DatasetStatus": "the command dataset status", "dataset_status": "likewise", "VerifyRequest": "the command dataset verify",
    "ShardFault": "likewise", "VerifyResult": "likewise", "verify_shards": "likewise", "MergeResult": "the command dataset merge", "merge_shards": "likewise",
    "PixelArrays": "a frame", "pixel_arrays": "a frame", "has_bounces": "pixel_bounces gives none",
    "correlation_curves": "what the viewer draws", "error_causes": "what the viewer's question `why` answers", "ErrorCauses": "likewise",
    "ErrorCause": "likewise", "ErrorSplit": "likewise", "PixelRegion": "likewise",
    "version": "tofray.__version__",
    "pose_matrix": "Pose.matrix", "pose_from_matrix": "Pose.from_matrix",
    "ImageSize": "the shape of pixel_rays", "image_size": "the shape of pixel_rays",
}


def types() -> list[str]:
    return sorted({name for text in TEXT.values()
                   for name in re.findall(r"^(?:struct|class|enum class|enum) (\w+)(?: :[^;{]*| final)? \{", text, re.M)})


def functions() -> list[str]:
    return sorted({name for text in TEXT.values() for name in re.findall(r"^(?! )[\w:<>,&* ]*[ &*](\w+)\([^;]*?\);", text, re.M)})


@pytest.mark.parametrize("name", types())
def test_a_type_is_reached_or_left_out_with_a_reason(name: str) -> None:
    assert (name in LEFT_OUT) != hasattr(tofray, name)


@pytest.mark.parametrize("name", functions())
def test_a_function_is_reached_or_left_out_with_a_reason(name: str) -> None:
    assert (name in LEFT_OUT) != hasattr(tofray, name)


def test_the_headers_were_read() -> None:
    assert {"Scene", "Camera", "Simulator", "Geometry", "Noise", "Flag", "Error"} <= set(types())
    assert {"load_scene", "load_camera", "process", "pixel_rays", "camera_pose", "frame_npz"} <= set(functions())
    assert all(name in {*types(), *functions()} for name in LEFT_OUT), "nothing is left out that there is not"


def test_a_simulators_functions_are_there() -> None:
    body = re.search(r"^class Simulator \{(.*?)^\};", TEXT["simulator.h"], re.M | re.S)
    assert body is not None
    names = set(re.findall(r"(\w+)\([^;]*\)(?: const)?;", body[1].split("private:")[0])) - {"Simulator"}
    assert names - {"operator"} == {"frame", "frames", "frames_on_device", "plan", "ran_on"}
    assert all(name in LEFT_OUT or hasattr(tofray.Simulator, name) for name in names if name != "operator")


def test_each_enumerator_is_a_word() -> None:
    words = {word for _, members in _native.structs() for _, kind, _ in members for word in re.findall(r'"(\w+)"', kind)}
    for wrap in ("repeat", "mirror", "clamp"):
        assert tofray.ReflectivityMap(np.zeros((1, 1), np.float32), wrap).wrap_u == wrap
        words.add(wrap)
    words |= {word for _, kind, _ in _native.options() for word in re.findall(r'"(\w+)"', kind)}
    found = 0
    for text in (TEXT["scene.h"], TEXT["camera.h"], TEXT["simulator.h"], TEXT["frame_arrays.h"]):
        for name, body in re.findall(r"enum class (\w+) \{([^}]*)\}", text):
            if name in ("ArrayShape", "ArrayWhen"):
                continue
            for word in re.findall(r"\w+", body):
                assert word in words, f"{name}::{word}"
                found += 1
    assert found > 40


def test_own_arrays_have_the_members_of_their_structs() -> None:
    for kind in (tofray.Geometry, tofray.PixelLight, tofray.Transient):
        body = re.search(rf"^struct {kind.__name__} \{{(.*?)^\}};", TEXT["stages.h"], re.M | re.S)
        assert body is not None
        members = set(re.findall(r"(\w+)(?: = [\d.]+)?[,;]", body[1])) - {"width", "height", "moments", "bins"}
        assert members == set(getattr(kind, "__slots__"))


def test_flags_are_those_of_the_header() -> None:
    rows = re.findall(r"row\((\w+), +(\d+), ([01]), '[A-Z]'", TEXT["flags.h"])
    assert len(rows) == 9
    invalid = sum(int(bit) for _, bit, ends in rows if ends == "1")
    assert {**{name: int(bit) for name, bit, _ in rows}, "invalid": invalid} == tofray.flags


def test_a_simulators_words_are_the_options() -> None:
    import inspect

    signature = inspect.signature(tofray.Simulator.__init__)
    mine = {name: one.default for name, one in signature.parameters.items() if name not in ("self", "scene", "camera")}
    assert mine == {name: tuple(value) if isinstance(value, list) else value for name, _, value in _native.options()}


def test_each_name_of_the_module_is_there() -> None:
    assert all(getattr(tofray, name) is not None for name in tofray.__all__)
