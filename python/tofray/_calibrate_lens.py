# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The lens of one specimen of a camera, out of its amplitude images of a chessboard."""

from __future__ import annotations

import copy
import math
import os
from typing import TYPE_CHECKING, Any, Literal

from ._board_views import View, views_of
from ._errors import BadInput
from ._lens_solve import NAMES, Bundle, with_lens

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from ._frame import Frame
    from ._model import Camera, Lens

    Model = Literal["plumb_bob", "rational_polynomial", "equidistant"]

_BLURRED = 0.01  # of the focal length: what is known worse than this is not known
_NEAR = 0.2  # of the image's half diagonal: so near to each of its corners a corner of the board should be


class LensCalibration:
    """What was found of a lens; ``str()`` of it is a report.

    Attributes
    ----------
    model : "plumb_bob", "rational_polynomial" or "equidistant"
    values, errors : dict of str to float, px or 1
        fx, fy, cx and cy in pixels, then the model's coefficients, and their standard errors.
    size : tuple of int
        Width and height of the images in pixels.
    views, corners : int
        How many images, and corners of the board in each.
    residual_px : float, px
        Of the corners found from the corners by the lens, rms of their distances.
    residuals_px : dict of str to float, px
        Residual of each image, by its name.
    held_out_px : float, px
        Residual of images from which the lens was not found (each image's pose is); NaN without such images.
    ray_error_px, worst_ray_error_px : float, px
        By the standard errors and their correlations: by how much pixels are taken to look elsewhere, rms over the image, and at its worst pixel.
    change_px, worst_change_px : float, px
        By how much pixels look elsewhere than the profile says, rms over the image, and at its worst pixel.
    notes : list of str
        What could not be known.
    """

    def __init__(self, camera: Camera, views: Sequence[View], bundle: Bundle) -> None:
        import numpy as np

        self.model: Model = bundle.model
        self.size = (int(camera.sensor.width), int(camera.sensor.height))
        self.values = dict(zip(NAMES[bundle.model], map(float, bundle.lens)))
        covariance = bundle.covariance()
        self.errors = dict(zip(NAMES[bundle.model], map(float, np.sqrt(np.diag(covariance)))))
        self.views, self.corners = len(views), len(views[0].corners)
        self.residual_px = bundle.rms_px()
        self.residuals_px = dict(zip((one.name for one in views), bundle.each_rms_px()))
        self.held_out_px = math.nan
        self.notes: list[str] = []
        self._camera = camera
        blur = bundle.ray_errors_px(self.lens, camera, covariance)
        self.ray_error_px, self.worst_ray_error_px = _rms(blur), float(np.nanmax(blur))
        away = bundle.apart_px(camera)
        self.change_px, self.worst_change_px = _rms(away), float(np.nanmax(away))

    @property
    def lens(self) -> Lens:
        """The profile's lens with what was found in it."""
        return with_lens(self._camera, self.model, self.values).lens

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the calibration as ROS does, which ``tofray calibration FILE --camera PROFILE`` makes a profile of.

        Parameters
        ----------
        file : path
            "lens.yaml".

        Raises
        ------
        Error
            Where it cannot be written.
        """
        from ._lens_file import write_lens

        write_lens(self, os.fspath(file))

    def __str__(self) -> str:
        from ._lens_file import report

        return report(self)


def _rms(values: NDArray[Any]) -> float:
    import numpy as np

    return float(np.sqrt(np.nanmean(values**2)))


def _model_of(camera: Camera, model: str | None) -> Model:
    lens = camera.lens
    own = "equidistant" if lens.distortion == "fisheye" else "rational_polynomial" if any((lens.k4, lens.k5, lens.k6)) else "plumb_bob"
    wanted = own if model is None else model
    for known in NAMES:
        if known == wanted:
            return known
    raise BadInput(f"error: got the model {model!r:.40}\n  expected plumb_bob, rational_polynomial or equidistant")


def _board(board: tuple[int, int], square_m: float) -> Any:
    """Corners of the board in metres, in its own frame."""
    import numpy as np

    columns, rows = board
    if columns < 3 or rows < 3 or columns > 100 or rows > 100:
        raise BadInput(f"error: got a board of {columns} x {rows} inner corners\n  expected 3 to 100 each way, such as 11 x 8 of a board of 12 x 9 squares")
    if not (math.isfinite(square_m) and 0 < square_m < 100):
        raise BadInput(f"error: got squares of {square_m:g} m\n  expected the length of a side, above 0")
    u, v = np.meshgrid(np.arange(columns) - (columns - 1) / 2, np.arange(rows) - (rows - 1) / 2)
    return square_m * np.stack([u.ravel(), v.ravel(), np.zeros(u.size)], axis=1)


def _determined(bundle: Bundle) -> None:
    """Refuses boards that are all seen from the front: twice as far away before a lens twice as long they look the same."""
    import numpy as np

    error = float(np.sqrt(np.diag(bundle.covariance())[:2]).max() / np.abs(bundle.lens[:2]).min())
    tilt = bundle.most_tilted_rad()
    if not error < _BLURRED or tilt < math.radians(3):
        known = f"it is known to {100 * error:.2g} % alone" if error < 1 else "it is not known at all"
        raise BadInput(f"error: the images do not say what the focal length is: {known}\n  the board is turned by {math.degrees(tilt):.1f} degrees at most; "
                       "expected boards turned by 20 to 40 degrees, to several sides: before a longer lens a board farther away looks the same from the front")


def _rim(views: Sequence[View], size: tuple[int, int]) -> list[str]:
    """Says which corners of the image no corner of the board comes near to."""
    import numpy as np

    seen = np.concatenate([one.corners for one in views])
    half = 0.5 * math.hypot(*size)
    away = []
    for v, vertical in ((0, "upper"), (size[1] - 1, "lower")):
        for u, horizontal in ((0, "left"), (size[0] - 1, "right")):
            nearest = float(np.hypot(*(seen - [u, v]).T).min())
            if nearest > _NEAR * half:
                away.append(f"{vertical} {horizontal} ({nearest:.0f} px)")
    return [f"no corner of the board comes near to these corners of the image: {', '.join(away)}; what the lens does there is carried on from further in"] if away else []


def _stand_out(residuals: dict[str, float]) -> list[str]:
    import numpy as np

    usual = float(np.median(list(residuals.values())))
    return [f"{name}: {value:.3f} px are left of it, of the others {usual:.3f} px: a corner is wrong, or the board is bent or moved"
            for name, value in residuals.items() if value > 4 * usual and value > 0.02]


def _held_out_of(count: int, held_out: Sequence[int] | None) -> list[int]:
    if held_out is None:
        return list(range(2, count - 1, 4)) if count >= 8 else []
    if any(not 0 <= one < count for one in held_out):
        raise BadInput(f"error: held_out has an image that there is not\n  got {list(held_out)}, expected numbers of 0 to {count - 1}")
    return sorted(set(held_out))


def calibrate_lens(camera: Camera, images: Iterable[Frame | str | os.PathLike[str] | NDArray[Any]], *, board: tuple[int, int], square_m: float,
                   model: Model | None = None, held_out: Sequence[int] | None = None) -> LensCalibration:
    """Focal lengths, principal point and distortion, from amplitude images of a chessboard.

    OpenCV finds the board; then two crossing edges are fitted to each corner, and by least squares over all corners the lens and the board's
    pose in each image are found together.

    Parameters
    ----------
    camera : Camera
        Its sensor's size, and its lens to start from.
    images : sequence of Frame, path or array [height, width]
        One of each view of the board, which stays within the image: frames with amplitudes, npz files of such frames, PNG files, arrays; of a
        folder with several frames the mean is taken.
    board : tuple of int
        Inner corners along a row and along a column: (11, 8) of 12 x 9 squares.
    square_m : float, m
        Side of a square.
    model : "plumb_bob", "rational_polynomial" or "equidistant", optional
        Distortion; left out: as the camera's lens has it.
    held_out : sequence of int, optional
        Numbers of images at which residuals are taken of a lens that was found without them; left out: every fourth, of 8 or more.

    Returns
    -------
    LensCalibration
        Of all images.

    Raises
    ------
    Error
        Where a board is not found, images are not of the sensor's size or too few, or do not say what the focal length is.
    ImportError
        Without OpenCV.
    """
    points = _board(board, float(square_m))
    wanted = _model_of(camera, model)
    given = list(images)
    kept_out = _held_out_of(len(given), held_out)
    if len(given) - len(kept_out) < 4:
        raise BadInput(f"error: too few images\n  got {len(given)}, {len(kept_out)} of them held out; expected four or more, such as 20, the board turned to all sides")
    views = views_of(given, camera, board)
    bundle = Bundle(wanted, camera, points, [one.corners for one in views])
    bundle.solve()
    _determined(bundle)
    out = LensCalibration(copy.deepcopy(camera), views, bundle)
    if kept_out:
        partly = Bundle(wanted, camera, points, [one.corners for i, one in enumerate(views) if i not in kept_out])
        partly.solve()
        out.held_out_px = partly.rms_elsewhere_px([views[i].corners for i in kept_out])
    out.notes = _rim(views, out.size) + _stand_out(out.residuals_px)
    return out


__all__ = ["LensCalibration", "calibrate_lens"]
