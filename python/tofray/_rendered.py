# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of other renderers, and of robots' simulators, as a Geometry."""

from __future__ import annotations

import math
import warnings
from typing import TYPE_CHECKING, Any, Mapping

import numpy as np

from . import _native
from ._errors import error_of
from ._model import Camera, Material, Pinhole, Pose
from ._own import Geometry
from ._pose import _OPTICAL_IN

if TYPE_CHECKING:
    from typing import Literal, Sequence

    from numpy.typing import ArrayLike, NDArray


def load_material(name: str) -> Material:
    """A material that scenes may name without describing it.

    Parameters
    ----------
    name : str
        Such as "skin"; ``tofray list materials`` shows all of them, with what was measured.

    Returns
    -------
    Material

    Raises
    ------
    Error
        For another name.
    """
    material: Material = _native.load_material(name)
    return material


def pinhole_for(camera: Camera, margin: float = 2, oversample: float = 2, *, pixel_centre: float = 0.5) -> Pinhole:
    """The picture to ask a renderer for: it covers all of the camera's rays, its middle is the optical axis, its pixels are square.

    Parameters
    ----------
    camera : Camera
        With its lens' distortion.
    margin : float, px
        Pixels beyond the outermost rays, on each side.
    oversample : float
        Of its pixels for one of the camera's, along rows and columns, on the axis. 1 takes a quarter of the time of 2, and edges are
        where they are to half a pixel.
    pixel_centre : float, px
        Where the middle of the first pixel is for the numbers ``cx_px`` and ``cy_px``, as in ``from_pictures``.

    Returns
    -------
    Pinhole
        ``width``, ``height``, ``fx_px`` … ``cy_px``, ``matrix``, ``angle_up_down_rad``.

    Raises
    ------
    Error
        For a camera that cannot be; of kind "limit" for one that sees so far off its axis that no picture of a usable size covers it.
    """
    pinhole: Pinhole = _native.pinhole_for(camera, float(margin), float(oversample), float(pixel_centre))
    return pinhole


def from_pictures(
    camera: Camera,
    z: ArrayLike,
    *,
    intrinsics: Pinhole | Sequence[float] | NDArray[Any],
    pixel_centre: float | None = None,
    distance: Literal["z", "range"] = "z",
    normal: ArrayLike | None = None,
    normal_axes: Literal["optical", "opengl", "body"] | Pose = "optical",
    albedo: ArrayLike | float | None = None,
    labels: ArrayLike | None = None,
    materials: Mapping[int, float | str | Material] | None = None,
    background: float | NDArray[np.bool_] = math.inf,
    still: bool = False,
) -> Geometry:
    """What the camera's own rays, bent by its lens, see in pictures that a renderer drew through a pinhole.

    Each ray takes its nearest pixel: that one's label, normal and reflectivity, and z of the plane through it with that normal::

        z = z_p (n . p) / (n . r),     p = (x_p, y_p, 1) of the pixel, r = (x, y, 1) of the ray           [theory: picture-ray]

    Nothing is a mean of several pixels, so that there is nothing between a near and a far surface. All arrays may have one axis more
    before the others: a moment for each raw frame, drawn at ``exposure_times``, where something moves. Row 0 is the topmost.

    Against a scene of tofray's own there are no bounces, no shadow of the camera's light (``Geometry.shadow`` takes one), and no pixels
    that an edge crosses.

    Parameters
    ----------
    camera : Camera
    z : float array [height, width], m
        Along the optical axis. Not above 0, infinite or NaN: nothing is seen.
    intrinsics : Pinhole, (fx, fy, cx, cy), or array [3, 3], px
        Of the pictures: what ``pinhole_for`` gave, or the renderer's own.
    pixel_centre : float, px
        Where the middle of the first pixel is for these numbers: 0.5 where they count from the picture's corner (OpenGL, Blender, Open3D,
        most simulators: cx is width / 2 in the middle), 0.0 where they count from that middle (OpenCV, ROS: (width - 1) / 2). A Pinhole
        says it; all others have to.
    distance : "z" or "range"
        Whether ``z`` is along the optical axis, or along each pixel's ray.
    normal : float array [height, width, 3], 1, optional
        Of any side and length; where 0 or NaN, and where left out, made of z [theory: normals-of-z].
    normal_axes : "optical", "opengl", "body", or Pose
        Which way the normals' axes point: x right, y down, z forward; x right, y up, z backward; x forward, y left, z up; or in the
        world, in which the camera has this pose.
    albedo : float array [height, width], float or uint8 array [height, width, 3], or one number, 1, optional
        Reflectivity at the illumination wavelength; or colour, whose mean stands for it: floats are linear, uint8 as screens take it (sRGB).
    labels : integer array [height, width], optional
        Of objects, materials or classes, for ``materials`` and ``truth.object_id``.
    materials : mapping of label to float, str or Material, optional
        Reflectivities, names out of ``tofray list materials``, or materials (lambert, phong). They count more than ``albedo``.
    background : float, m, or bool array [height, width]
        Nothing is seen from this z on (less 0.1 %): the renderer's far plane, 65.535 of whole millimetres in 16 bits; or where it is True.
    still : bool
        Nothing moves within the frame: one moment is all that there is.

    Returns
    -------
    Geometry
        For ``simulator.frame(i, geometry)``. A ``UserWarning`` says where rays look past the pictures, where colour stands for
        reflectivity and one moment for all raw frames, that normals do not fit z, or that z is too coarse
        to make any of.

    Raises
    ------
    Error
        For arrays of another shape or kind, intrinsics that cannot be, and a surface whose reflectivity nothing says.
    """
    words, by_moments = _words(z, intrinsics, pixel_centre, background)
    moments, shape = words["moments"], words["z"].shape[1:]
    if distance not in ("z", "range"):
        raise _fault("distance", f"got {distance!r}", '"z" or "range"')
    words["along_ray"] = distance == "range"
    words["still"] = bool(still)
    words["normal"] = None if normal is None else _floats("normal", normal, moments, (*shape, 3), by_moments)
    words["normal_axes"] = _axes(normal_axes)
    words["labels"] = None if labels is None else _labels(labels, moments, shape, by_moments)
    words["materials"] = [(_number(label), _material(label, one)) for label, one in dict(materials or {}).items()]
    words.update(_albedo(albedo, moments, shape, by_moments))
    z_m, normals, diffuse, specular, exponent, object_id, notices = _native.from_pictures(camera, words, by_moments)
    for notice in notices:
        warnings.warn("from_pictures: " + notice, stacklevel=2)
    return Geometry(z_m, normals, diffuse, specular=specular, exponent=exponent, object_id=object_id)


def _fault(name: str, got: str, expected: str) -> Exception:
    fault: Exception = error_of("bad_input", f"from_pictures: error: {name}: {got}\n  expected {expected}")
    return fault


def _words(z: ArrayLike, intrinsics: Any, pixel_centre: float | None, background: Any) -> tuple[dict[str, Any], bool]:
    """z as [moment, height, width], what is looked at through, and whether it had moments."""
    given = np.asarray(z)
    if given.dtype.kind in "iu":
        raise _fault("z", f"got {given.dtype} values", "metres as floats; of millimetres z * 0.001, and of 16 bits background=65.535 where 65535 says that nothing is there")
    if given.dtype.kind != "f" or given.ndim not in (2, 3) or 0 in given.shape:
        raise _fault("z", f"got {given.dtype} of shape {given.shape}", "floats of shape (height, width) or (moments, height, width)")
    by_moments = given.ndim == 3
    z_m = np.ascontiguousarray(given if by_moments else given[None], np.float32)
    far = math.inf
    if isinstance(background, np.ndarray) and background.ndim > 0:
        if background.dtype != np.bool_ or background.shape != given.shape:
            raise _fault("background", f"got {background.dtype} of shape {background.shape}", f"a number, or bool of shape {given.shape}")
        z_m = np.where(background.reshape(z_m.shape), np.float32(0), z_m)
    else:
        far = float(background)
    return {"z": z_m, "moments": z_m.shape[0], "background": far, "pinhole": _pinhole(intrinsics, pixel_centre, z_m.shape[1:])}, by_moments


def _pinhole(intrinsics: Any, pixel_centre: float | None, shape: tuple[int, ...]) -> Pinhole:
    if isinstance(intrinsics, Pinhole):
        if (intrinsics.height, intrinsics.width) != shape:
            raise _fault("z", f"its pictures have {shape[1]} x {shape[0]} pixels, intrinsics {intrinsics.width} x {intrinsics.height}", "pictures of that size, rows first")
        if pixel_centre is not None and pixel_centre != intrinsics.pixel_centre:
            raise _fault("pixel_centre", f"got {pixel_centre!r}, and intrinsics with {intrinsics.pixel_centre!r}", "one of them: pinhole_for(camera, pixel_centre=…)")
        return intrinsics
    numbers = np.asarray(intrinsics, np.float64) if not isinstance(intrinsics, str) else np.empty(0)
    if numbers.shape == (3, 3):
        if not (numbers[0, 1] == numbers[1, 0] == numbers[2, 0] == numbers[2, 1] == 0 and numbers[2, 2] == 1):
            raise _fault("intrinsics", f"got {numbers.tolist()}", "[[fx, 0, cx], [0, fy, cy], [0, 0, 1]]")
        numbers = numbers[(0, 1, 0, 1), (0, 1, 2, 2)]
    if numbers.shape != (4,):
        raise _fault("intrinsics", f"got {type(intrinsics).__name__} of shape {numbers.shape}", "a tofray.Pinhole, (fx, fy, cx, cy), or a matrix of shape (3, 3)")
    if pixel_centre is None:
        raise _fault("pixel_centre", "is left out", "0.5 where cx is width / 2 in the middle (OpenGL, most simulators), or 0.0 where it is (width - 1) / 2 (OpenCV, ROS)")
    fx, fy, cx, cy = map(float, numbers)
    return Pinhole(width=shape[1], height=shape[0], fx_px=fx, fy_px=fy, cx_px=cx, cy_px=cy, pixel_centre=float(pixel_centre))


def _shaped(name: str, given: NDArray[Any], moments: int, shape: tuple[int, ...], by_moments: bool) -> NDArray[Any]:
    wanted = (moments, *shape) if by_moments else shape
    if given.shape != wanted:
        raise _fault(name, f"got shape {given.shape}", f"{wanted}, as z has")
    return given.reshape((moments, *shape))


def _floats(name: str, given: ArrayLike, moments: int, shape: tuple[int, ...], by_moments: bool) -> NDArray[np.float32]:
    array = np.asarray(given)
    if array.dtype.kind != "f":
        raise _fault(name, f"got {array.dtype}", "floats" + ("; of 8 bits x / 127.5 - 1, or as the renderer's pages say" if name == "normal" else ""))
    return np.ascontiguousarray(_shaped(name, array, moments, shape, by_moments), np.float32)


def _labels(given: ArrayLike, moments: int, shape: tuple[int, ...], by_moments: bool) -> NDArray[np.int32]:
    array = np.asarray(given)
    if array.dtype.kind not in "iub":
        raise _fault("labels", f"got {array.dtype}", "integers")
    array = _shaped("labels", array, moments, shape, by_moments)
    if array.dtype.itemsize == 4:  # of unsigned ones 2**32 - 1, which says that nothing is there, becomes -1
        return np.ascontiguousarray(array).view(np.int32)
    if array.dtype.itemsize > 4 and array.size and (array.max() > 2**31 - 1 or array.min() < -2**31):
        raise _fault("labels", f"got {int(array.max())} and {int(array.min())}", "numbers of 32 bits")
    return np.ascontiguousarray(array, np.int32)


def _axes(axes: Any) -> list[float]:
    """Rows of the rotation from the normals' axes to the optical ones."""
    if isinstance(axes, Pose):
        matrix = axes.matrix[:3, :3].T
    elif isinstance(axes, str) and axes in _OPTICAL_IN:
        matrix = np.array(_OPTICAL_IN[axes], np.float64).T
    else:
        raise _fault("normal_axes", f"got {axes!r:.60}", "optical, opengl, body, or a tofray.Pose")
    return [float(one) for one in matrix.ravel()]


def _number(label: Any) -> int:
    number = int(label)
    return number - 2**32 if 2**31 <= number < 2**32 else number


def _material(label: Any, one: Any) -> Material:
    if isinstance(one, Material):
        return one
    if isinstance(one, str):
        return load_material(one)
    try:
        return Material(diffuse=float(one))
    except (TypeError, ValueError):
        raise _fault(f"materials[{label!r}]", f"got {one!r:.60}", "a reflectivity, a name such as \"skin\", or a tofray.Material") from None


def _albedo(albedo: Any, moments: int, shape: tuple[int, ...], by_moments: bool) -> dict[str, Any]:
    out: dict[str, Any] = {"reflectivity": None, "colour": None, "screen_colour": None, "other_reflectivity": None}
    if albedo is None:
        return out
    array = np.asarray(albedo)
    if array.ndim == 0:
        out["other_reflectivity"] = float(array)
    elif array.dtype == np.uint8 and array.ndim == 3 + by_moments and array.shape[-1] in (3, 4):
        out["screen_colour"] = np.ascontiguousarray(_shaped("albedo", array[..., :3], moments, (*shape, 3), by_moments))
    elif array.dtype.kind == "f" and array.ndim == 3 + by_moments and array.shape[-1] in (3, 4):
        out["colour"] = _floats("albedo", array[..., :3], moments, (*shape, 3), by_moments)
    elif array.dtype.kind == "f":
        out["reflectivity"] = _floats("albedo", array, moments, shape, by_moments)
    else:
        raise _fault("albedo", f"got {array.dtype} of shape {array.shape}", "a number, floats (height, width), or a colour of floats or uint8 (height, width, 3)")
    return out
