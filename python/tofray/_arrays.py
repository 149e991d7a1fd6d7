# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The arrays of a frame: the rows of include/tofray/frame_arrays.h. Written by python/tools/make_model.py; do not edit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._part import Part

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Raw(Part):
    """What the sensor hands out: raw frames, and when and how each was exposed.

    An array that this frame does not have raises AttributeError; ``names`` lists those that it has.

    Attributes
    ----------
    tap_a : float32 array [phase, height, width], e
        Electrons of tap A, after the charge model.
    tap_b : float32 array [phase, height, width], e
        Electrons of tap B, after the charge model.
    raw : uint16 array [phase, height, width], DN
        The ADC's code of A-B.
    modulation_frequency_hz : float64 array [phase], Hz
        Modulation frequency, 0 where unlit.
    reference_phase_rad : float64 array [phase], rad
        Reference phase tau, 0 where unlit.
    integration_time_s : float64 array [phase], s
        Time for which light is collected.
    start_time_s : float64 array [phase], s
        Start of the exposure; at 0 the scene is as written.
    lit : uint8 array [phase], 1
        The camera's illumination is on.
    """

    __slots__ = ()
    _rows = {
        "tap_a": ("tap_a", "float32", "[phase, height, width]", "raw", "e"),
        "tap_b": ("tap_b", "float32", "[phase, height, width]", "raw", "e"),
        "raw": ("raw", "uint16", "[phase, height, width]", "raw", "DN"),
        "modulation_frequency_hz": ("modulation_frequency_hz", "float64", "[phase]", "raw", "Hz"),
        "reference_phase_rad": ("reference_phase_rad", "float64", "[phase]", "raw", "rad"),
        "integration_time_s": ("integration_time_s", "float64", "[phase]", "raw", "s"),
        "start_time_s": ("start_time_s", "float64", "[phase]", "raw", "s"),
        "lit": ("lit", "uint8", "[phase]", "raw", "1"),
    }

    if TYPE_CHECKING:
        tap_a: NDArray[np.float32]
        tap_b: NDArray[np.float32]
        raw: NDArray[np.uint16]
        modulation_frequency_hz: NDArray[np.float64]
        reference_phase_rad: NDArray[np.float64]
        integration_time_s: NDArray[np.float64]
        start_time_s: NDArray[np.float64]
        lit: NDArray[np.uint8]


class Depth(Part):
    """The depth frame, in the camera's frame: x right, y down, z forward. Invalid values: NaN in floats, 0 in integers.

    An array that this frame does not have raises AttributeError; ``names`` lists those that it has.

    Attributes
    ----------
    z_m : float32 array [height, width], m
        Depth along the optical axis.
    range_m : float32 array [height, width], m
        Range along the pixel's ray.
    points_m : float32 array [height, width, 3], m
        x, y, z of the surface point.
    amplitude_e : float32 array [height, width], e
        Mean of the modulation frequencies' amplitudes.
    ambient_e : float32 array [height, width], e
        Ambient charge of both taps, per lit exposure (if none is lit: per mean exposure).
    noise_m : float32 array [height, width], m
        The camera's estimate of the range's noise, 1 sigma; without wrong cycles, and too low of weak signals (theory 4.4).
    confidence : uint8 array [height, width], 1
        0 to 255, by the noise and the certainty of the cycle.
    amplitude_by_frequency_e : float32 array [frequency, height, width], e
        Amplitude of each modulation frequency; asked.
    range_by_frequency_m : float32 array [frequency, height, width], m
        Range by each modulation frequency alone, in the cycle of cycle_by_frequency; asked.
    cycle_by_frequency : int32 array [frequency, height, width], 1
        Whole cycles that unwrapping added, or -1; asked.
    flags : uint16 array [height, width], 1
        Bits of Flag: why a depth is invalid, and warnings.
    """

    __slots__ = ()
    _rows = {
        "z_m": ("z_m", "float32", "[height, width]", "depth", "m"),
        "range_m": ("range_m", "float32", "[height, width]", "depth", "m"),
        "points_m": ("points_m", "float32", "[height, width, 3]", "depth", "m"),
        "amplitude_e": ("amplitude_e", "float32", "[height, width]", "depth", "e"),
        "ambient_e": ("ambient_e", "float32", "[height, width]", "depth", "e"),
        "noise_m": ("noise_m", "float32", "[height, width]", "depth", "m"),
        "confidence": ("confidence", "uint8", "[height, width]", "depth", "1"),
        "amplitude_by_frequency_e": ("amplitude_by_frequency_e", "float32", "[frequency, height, width]", "depth", "e"),
        "range_by_frequency_m": ("range_by_frequency_m", "float32", "[frequency, height, width]", "depth", "m"),
        "cycle_by_frequency": ("cycle_by_frequency", "int32", "[frequency, height, width]", "depth", "1"),
        "flags": ("flags", "uint16", "[height, width]", "depth", "1"),
    }

    if TYPE_CHECKING:
        z_m: NDArray[np.float32]
        range_m: NDArray[np.float32]
        points_m: NDArray[np.float32]
        amplitude_e: NDArray[np.float32]
        ambient_e: NDArray[np.float32]
        noise_m: NDArray[np.float32]
        confidence: NDArray[np.uint8]
        amplitude_by_frequency_e: NDArray[np.float32]
        range_by_frequency_m: NDArray[np.float32]
        cycle_by_frequency: NDArray[np.int32]
        flags: NDArray[np.uint16]


class Truth(Part):
    """Ground truth at the middle of the middle raw frame, and the power of the camera's illumination.

    An array that this frame does not have raises AttributeError; ``names`` lists those that it has.

    Attributes
    ----------
    range_m : float32 array [height, width], m
        Range along the pixel's ray.
    z_m : float32 array [height, width], m
        Depth along the optical axis.
    reflectivity : float32 array [height, width], 1
        Albedo (Phong: diffuse + specular).
    position_m : float32 array [height, width, 3], m
        x, y, z of the surface point.
    normal : float32 array [height, width, 3], 1
        Unit normal, toward the camera.
    object_id : int32 array [height, width], 1
        instance: index in Scene::objects, or -1.
    material_id : int32 array [height, width], 1
        Index in Scene::materials, or -1.
    class_id : int32 array [height, width], 1
        Class of the object: index in Scene::classes, or -1; asked.
    triangle_id : int32 array [height, width], 1
        face: index in mesh triangles, or -1.
    texcoord : float32 array [height, width, 2], 1
        u, v of TriangleMesh::texcoords, v down the picture, or NaN.
    velocity_m_per_s : float32 array [height, width, 3], m/s
        Scene flow: velocity of the point, camera frame.
    flow_px : float32 array [height, width, 2], px
        u, v: optical flow to one frame later.
    mixed : uint8 array [height, width], 1
        The pixel sees several objects or > 5 cm of range; sub-pixel samples.
    object_share : float32 array [height, width], 1
        Share of the pixel that sees gt_object_id; sub-pixel samples.
    irradiance_w_m2 : float32 array [height, width], W/m2
        Irradiance of the surface by the camera's illumination.
    radiance_w_m2_sr : float32 array [height, width], W/(m2 sr)
        Radiance toward the camera by the camera's illumination.
    power_w : float32 array [height, width], W
        Power on the pixel by the camera's illumination.
    ambient_e_per_s : float32 array [height, width], e/s
        Ambient light on the pixel, both taps.
    signal_e : float32 array [phase, height, width], e
        Expected electrons by the camera's illumination, both taps, 0 unlit.
    direct_e : float32 array [phase, height, width], e
        Expected electrons by one surface alone, before lens scatter; bounces.
    indirect_e : float32 array [phase, height, width], e
        Expected electrons by several surfaces, before lens scatter; bounces.
    raw_dn : float32 array [phase, height, width], DN
        Raw without noise, before rounding; asked.
    raw_direct_dn : float32 array [phase, height, width], DN
        Raw without noise and of light by one surface alone, before rounding and lens scatter; bounces, asked.
    phase_flow_px : float32 array [phase, height, width, 2], px
        u, v: optical flow from each raw frame to gt_time_s; asked.
    multipath_m : float32 array [phase, height, width], m
        Half path of all light less that of direct light, NaN unlit; bounces.
    path_noise_m : float32 array [phase, height, width], m
        Standard error of gt_multipath_m; bounces.
    path_count : int32 array [height, width], 1
        Light paths that were followed (Monte Carlo samples); bounces.
    transient_e_per_s : float32 array [bin, height, width], e/s
        Light of the camera's illumination by path length, before lens scatter; transient.
    transient_lost_e_per_s : float32 array [height, width], e/s
        Light of the camera's illumination outside all bins; transient.
    """

    __slots__ = ()
    _rows = {
        "range_m": ("gt_range_m", "float32", "[height, width]", "trace", "m"),
        "z_m": ("gt_z_m", "float32", "[height, width]", "trace", "m"),
        "reflectivity": ("gt_reflectivity", "float32", "[height, width]", "trace", "1"),
        "position_m": ("gt_position_m", "float32", "[height, width, 3]", "trace", "m"),
        "normal": ("gt_normal", "float32", "[height, width, 3]", "trace", "1"),
        "object_id": ("gt_object_id", "int32", "[height, width]", "trace", "1"),
        "material_id": ("gt_material_id", "int32", "[height, width]", "trace", "1"),
        "class_id": ("gt_class_id", "int32", "[height, width]", "trace", "1"),
        "triangle_id": ("gt_triangle_id", "int32", "[height, width]", "trace", "1"),
        "texcoord": ("gt_texcoord", "float32", "[height, width, 2]", "trace", "1"),
        "velocity_m_per_s": ("gt_velocity_m_per_s", "float32", "[height, width, 3]", "trace", "m/s"),
        "flow_px": ("gt_flow_px", "float32", "[height, width, 2]", "trace", "px"),
        "mixed": ("gt_mixed", "uint8", "[height, width]", "trace", "1"),
        "object_share": ("gt_object_share", "float32", "[height, width]", "trace", "1"),
        "irradiance_w_m2": ("gt_irradiance_w_m2", "float32", "[height, width]", "power", "W/m2"),
        "radiance_w_m2_sr": ("gt_radiance_w_m2_sr", "float32", "[height, width]", "power", "W/(m2 sr)"),
        "power_w": ("gt_power_w", "float32", "[height, width]", "power", "W"),
        "ambient_e_per_s": ("gt_ambient_e_per_s", "float32", "[height, width]", "power", "e/s"),
        "signal_e": ("gt_signal_e", "float32", "[phase, height, width]", "raw", "e"),
        "direct_e": ("gt_direct_e", "float32", "[phase, height, width]", "raw", "e"),
        "indirect_e": ("gt_indirect_e", "float32", "[phase, height, width]", "raw", "e"),
        "raw_dn": ("gt_raw_dn", "float32", "[phase, height, width]", "raw", "DN"),
        "raw_direct_dn": ("gt_raw_direct_dn", "float32", "[phase, height, width]", "raw", "DN"),
        "phase_flow_px": ("gt_phase_flow_px", "float32", "[phase, height, width, 2]", "trace", "px"),
        "multipath_m": ("gt_multipath_m", "float32", "[phase, height, width]", "raw", "m"),
        "path_noise_m": ("gt_path_noise_m", "float32", "[phase, height, width]", "raw", "m"),
        "path_count": ("gt_path_count", "int32", "[height, width]", "raw", "1"),
        "transient_e_per_s": ("transient_e_per_s", "float32", "[bin, height, width]", "power", "e/s"),
        "transient_lost_e_per_s": ("transient_lost_e_per_s", "float32", "[height, width]", "power", "e/s"),
    }

    if TYPE_CHECKING:
        range_m: NDArray[np.float32]
        z_m: NDArray[np.float32]
        reflectivity: NDArray[np.float32]
        position_m: NDArray[np.float32]
        normal: NDArray[np.float32]
        object_id: NDArray[np.int32]
        material_id: NDArray[np.int32]
        class_id: NDArray[np.int32]
        triangle_id: NDArray[np.int32]
        texcoord: NDArray[np.float32]
        velocity_m_per_s: NDArray[np.float32]
        flow_px: NDArray[np.float32]
        mixed: NDArray[np.uint8]
        object_share: NDArray[np.float32]
        irradiance_w_m2: NDArray[np.float32]
        radiance_w_m2_sr: NDArray[np.float32]
        power_w: NDArray[np.float32]
        ambient_e_per_s: NDArray[np.float32]
        signal_e: NDArray[np.float32]
        direct_e: NDArray[np.float32]
        indirect_e: NDArray[np.float32]
        raw_dn: NDArray[np.float32]
        raw_direct_dn: NDArray[np.float32]
        phase_flow_px: NDArray[np.float32]
        multipath_m: NDArray[np.float32]
        path_noise_m: NDArray[np.float32]
        path_count: NDArray[np.int32]
        transient_e_per_s: NDArray[np.float32]
        transient_lost_e_per_s: NDArray[np.float32]
