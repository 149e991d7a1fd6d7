# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""How good depth is: numbers of makers, and one image of depth against another."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Dict

from . import _native
from ._arrays import Depth, Truth
from ._errors import BadInput
from ._frame import Frame

if TYPE_CHECKING:
    from collections.abc import Iterable


class Quality(Dict[str, float]):
    """Numbers by name, each with its unit at the end; NaN: unknown.

    Parameters
    ----------
    metrics : dict
        The numbers, those of ``tofray quality``.
    frames : int
        How many frames they are of.
    region : (int, int, int, int)
        Column, row, width and height of what was measured.
    notes : list of str
        How the frames differ from a maker's conditions.
    """

    def __init__(self, metrics: dict[str, float], frames: int, region: tuple[int, int, int, int], notes: list[str]) -> None:
        super().__init__(metrics)
        self.frames = frames
        self.region = region
        self.notes = notes


class Comparison(Dict[str, Any]):
    """Of A - B: ``all``, ``flats``, ``edges`` (dicts of ``pixels``, ``bias_m``, ``median_m``, ``sigma_m``, ``spread_m``, ``rmse_m``, ``p50_m``,
    ``p95_m``, ``p99_m``), lists of such ``by_distance`` and ``by_flag``, counts ``both``, ``only_a``, ``only_b``, ``neither``, ``chi2`` of the
    noise, ``map_m`` (float32 [height, width], NaN: not in both) and ``histogram``.

    Parameters
    ----------
    numbers : dict
        These.
    """

    def __init__(self, numbers: dict[str, Any]) -> None:
        super().__init__(numbers)

    def plot(self) -> Any:
        """The map of A - B, and its histogram.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        ImportError
            Without matplotlib.
        """
        import importlib

        try:
            Figure = importlib.import_module("matplotlib.figure").Figure
        except ImportError as fault:
            raise ImportError("plot() needs the package matplotlib") from fault
        figure = Figure(figsize=(9.6, 4.0), layout="constrained")
        image, bars = figure.subplots(1, 2)
        step = 1e3 * self["histogram_step_m"]
        places = [1e3 * self["histogram_low_m"] + step * (0.5 + i) for i in range(len(self["histogram"]))]
        most = abs(places[0])
        shown = image.imshow(1e3 * self["map_m"], cmap="RdBu_r", vmin=-most, vmax=most, interpolation="nearest")
        figure.colorbar(shown, ax=image, label="A - B [mm]")
        image.set(xlabel="column", ylabel="row")
        bars.bar(places, self["histogram"], width=step)
        bars.set(xlabel="A - B [mm]", ylabel="pixels")
        return figure


def _frame(of: Frame | Depth | Truth) -> Frame:
    if isinstance(of, Frame):
        return of
    if isinstance(of, Depth):
        return Frame(depth=of)
    if isinstance(of, Truth):
        return Frame(truth=of)
    raise BadInput(f"frame: error: got {type(of).__name__}\n  expected a tofray.Frame, a Depth or a Truth; load_depth() reads files")


def quality(frames: Frame | Depth | Iterable[Frame | Depth], *, region: tuple[int, int, int, int] | None = None, like: str = "",
            truth_m: float = 0.0, truth: Frame | Truth | None = None) -> Quality:
    """How good depth is, in the words of makers: of a wall, over several frames, and at a step.

    RealSense's (``fill_rate_percent``, ``plane_fit_rms_m``, ``z_accuracy_percent``, ``temporal_noise_percent``) are those of its Depth Quality Tool:
    of each frame a plane z = a x + b y + c is fitted to all valid points; RMS = √(Σ d²/n) of the distances d to it, without the 0.5 % of least
    and of largest z; Z accuracy = median(plane on the axis - truth + d)/truth; temporal noise = median over pixels of σ/median over the frames,
    divisor n.

    Parameters
    ----------
    frames : Frame or Depth, or several
        Of a camera and a scene that stand still, of one size.
    region : (int, int, int, int), optional
        Column, row, width and height in pixels; None: the whole image, or that of ``like``.
    like : str
        Conditions of a maker: "realsense", "basler", "vzense", "azure", "adtf3175"; ``notes`` say where the frames do not meet them.
    truth_m : float
        True z of the wall on the optical axis in metres; 0: what the truth says.
    truth : Frame or Truth, optional
        None: that of the first frame, if it has any.

    Returns
    -------
    Quality
        Floats in m, rad, px, e and percent as their names say, e.g. ``temporal_noise_m``, ``spatial_noise_m``, ``bias_m``, ``edge_width_px``.

    Raises
    ------
    Error
        Without a frame or a depth, for other sizes, a region that is not in the image, another ``like``.
    """
    given = [frames] if isinstance(frames, (Frame, Depth, Truth)) else list(frames)
    all_frames = [_frame(one) for one in given]
    right = _frame(truth) if truth is not None else all_frames[0] if all_frames and all_frames[0].truth.get("z_m") is not None else None
    metrics, found, notes = _native.quality(all_frames, right, {"region": region, "like": like, "truth_m": truth_m})
    return Quality(metrics, len(all_frames), found, notes)


def compare(a: Frame | Depth | Truth, b: Frame | Depth | Truth | None = None, *, region: tuple[int, int, int, int] | None = None,
            quantity: str = "z", fit_shift: bool = False, distances_m: Iterable[float] = (), edge_step_m: float = 0.05,
            edge_px: int = 2) -> Comparison:
    """Depth of A against that of B, pixel by pixel: bias, spread, by distance, by flag, at edges, and whether noise_m is honest.

    ``chi2`` is the mean over flat pixels of (range_A - range_B)²/(σ_A² + σ_B²) with σ = noise_m: 1 where noise_m is the noise and there is no bias.
    Pixels more than six σ off are left out of it and counted in ``chi2_outliers``.

    Parameters
    ----------
    a, b : Frame, Depth or Truth
        A Frame stands for its depth; b None: the truth of a.
    region : (int, int, int, int), optional
        Column, row, width and height in pixels; None: the whole image.
    quantity : {"z", "range"}
        Along the optical axis, or along the pixel's ray.
    fit_shift : bool
        The median difference is taken off A first; ``shift_m`` says it.
    distances_m : sequence of float
        Bounds of the classes by distance in B, rising; empty: eight as wide as each other.
    edge_step_m : float
        Neighbours in B that differ by more have an edge between them.
    edge_px : int
        How far from it a pixel is at the edge, in columns and rows.

    Returns
    -------
    Comparison

    Raises
    ------
    Error
        Where one has no depth, for other sizes, where no pixel has a depth in both.
    """
    if quantity not in ("z", "range"):
        raise BadInput(f"quantity: error: got {quantity!r}\n  expected z or range")
    of_a = _frame(a)
    if b is None and of_a.truth.get("z_m") is None:
        raise BadInput("compare: error: there is no ground truth in a\n  expected a frame with truth.z_m, or b")
    of_b = of_a if b is None else _frame(b)
    truths = (isinstance(a, Truth), b is None or isinstance(b, Truth))
    words = {"region": region, "range": quantity == "range", "fit_shift": fit_shift, "distances_m": [float(one) for one in distances_m],
             "edge_step_m": edge_step_m, "edge_px": edge_px}
    return Comparison(_native.compare(of_a, of_b, truths, words))


def load_depth(file: str | os.PathLike[str], *, unit_m: float = 0.0, intrinsics: tuple[float, float, float, float] | None = None) -> list[Frame]:
    """Images of depth out of a file, or out of all files of a folder: npz, npy, csv (z in m), png (grey, 16 bits, mm).

    Parameters
    ----------
    file : path
        A folder's frames come in the order of their names.
    unit_m : float
        Length of a file's 1 in metres; 0: 1 mm of png, 1 m of others.
    intrinsics : (float, float, float, float), optional
        fx, fy, cx, cy in pixels of a lens without distortion, for the points of an image of z alone.

    Returns
    -------
    list of Frame
        With ``depth`` and, where the file has it, ``truth``.

    Raises
    ------
    Error
        By file, for what cannot be read or has no depth in it.
    """
    return [Frame._of(memory, None, None, {}) for _, memory in _native.load_depths(os.fspath(file), unit_m, intrinsics)]
