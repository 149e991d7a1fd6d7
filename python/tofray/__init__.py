# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""tofray simulates indirect time-of-flight (PMD) 3D cameras.

>>> import tofray
>>> frame = tofray.Simulator(tofray.load_scene("demo"), seed=7).frame(0)
>>> frame.depth.z_m            # metres, float32 [height, width]

All numbers are in SI units, and names end in their unit.
"""

from __future__ import annotations

from ._model_names import MODEL as _MODEL

TYPE_CHECKING = False  # as a checker of types knows it, without typing, which costs more than all else here

if TYPE_CHECKING:
    from typing import Any

    from ._arrays import (
        Depth as Depth,
        Raw as Raw,
        Truth as Truth,
    )
    from ._budget import (
        Budget as Budget,
        budget as budget,
    )
    from ._calibrate import (
        SpecimenCalibration as SpecimenCalibration,
        calibrate_phase as calibrate_phase,
        calibrate_temperature as calibrate_temperature,
    )
    from ._calibrate_lens import (
        LensCalibration as LensCalibration,
        calibrate_lens as calibrate_lens,
    )
    from ._dataset import (
        Dataset as Dataset,
        Drawn as Drawn,
    )
    from ._errors import (
        Error as Error,
    )
    from ._fit import (
        Fit as Fit,
        FitParameter as FitParameter,
        fit as fit,
    )
    from ._film import (
        McapWriter as McapWriter,
        mcap_contents as mcap_contents,
    )
    from ._frame import (
        Frame as Frame,
        load as load,
    )
    from ._load import (
        camera as camera,
        load_camera as load_camera,
        load_scene as load_scene,
        scene as scene,
    )
    from ._model import *
    from ._native import (
        DeviceArray as DeviceArray,
        DeviceFrames as DeviceFrames,
        MeshMotion as MeshMotion,
        ReflectivityMap as ReflectivityMap,
        TriangleMesh as TriangleMesh,
        VectorMap as VectorMap,
    )
    from ._own import (
        Geometry as Geometry,
        PixelLight as PixelLight,
        Transient as Transient,
    )
    from ._quality import (
        Comparison as Comparison,
        Quality as Quality,
        compare as compare,
        load_depth as load_depth,
        quality as quality,
    )
    from ._rendered import (
        from_pictures as from_pictures,
        load_material as load_material,
        pinhole_for as pinhole_for,
    )
    from ._run import (
        load_inputs as load_inputs,
        pixel_bounces as pixel_bounces,
        pixel_chain as pixel_chain,
        render as render,
        render_again as render_again,
        validity as validity,
    )
    from ._samples import (
        Samples as Samples,
        open_dataset as open_dataset,
    )
    from ._simulator import (
        Simulator as Simulator,
        camera_pose as camera_pose,
        camera_report as camera_report,
        demo as demo,
        exposure_times as exposure_times,
        full_sun as full_sun,
        invalid_pixels as invalid_pixels,
        object_places as object_places,
        pixel_rays as pixel_rays,
        placed_scene as placed_scene,
        process as process,
        scene_report as scene_report,
    )

    from ._sweep import (
        Sweep as Sweep,
        sweep as sweep,
    )
    from ._view import (
        Page as Page,
        View as View,
        explore as explore,
        view as view,
    )

    __version__: str
    flags: dict[str, int]
    arrays: list[tuple[str, ...]]

# Where each name comes from, so that `import tofray` costs next to nothing: neither numpy nor the libraries are
# loaded before they are used.
_HOME = {
    "_arrays": ("Depth", "Raw", "Truth"),
    "_budget": ("Budget", "budget"),
    "_calibrate": ("SpecimenCalibration", "calibrate_phase", "calibrate_temperature"),
    "_calibrate_lens": ("LensCalibration", "calibrate_lens"),
    "_dataset": ("Dataset", "Drawn"),
    "_errors": ("Error",),
    "_fit": ("Fit", "FitParameter", "fit"),
    "_film": ("McapWriter", "mcap_contents"),
    "_frame": ("Frame", "load"),
    "_load": ("camera", "load_camera", "load_scene", "scene"),
    "_model": _MODEL,
    "_native": ("DeviceArray", "DeviceFrames", "MeshMotion", "ReflectivityMap", "TriangleMesh", "VectorMap"),
    "_own": ("Geometry", "PixelLight", "Transient"),
    "_quality": ("Comparison", "Quality", "compare", "load_depth", "quality"),
    "_rendered": ("from_pictures", "load_material", "pinhole_for"),
    "_run": ("load_inputs", "pixel_bounces", "pixel_chain", "render", "render_again", "validity"),
    "_samples": ("Samples", "open_dataset"),
    "_simulator": ("Simulator", "camera_pose", "camera_report", "demo", "exposure_times", "full_sun", "invalid_pixels", "object_places", "pixel_rays", "placed_scene", "process", "scene_report"),
    "_sweep": ("Sweep", "sweep"),
    "_view": ("Page", "View", "explore", "view"),
}

__all__ = sorted(name for names in _HOME.values() for name in names) + ["arrays", "flags"]


def __getattr__(name: str) -> Any:
    import importlib

    if name in ("__version__", "flags", "arrays"):
        from . import _native

        value: Any = {"__version__": _native.version, "flags": _native.flags, "arrays": _native.array_table}[name]()
    else:
        home = next((module for module, names in _HOME.items() if name in names), None)
        if home is None:
            raise AttributeError(f"module 'tofray' has no attribute {name!r}")
        value = getattr(importlib.import_module("." + home, __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
