# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of a profile out of measurements, with their errors, and what cannot be known."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Any

from . import _native
from ._errors import BadInput
from ._fit_model import Model, Unknown
from ._fit_rows import Rows, read_rows, rows_of, rows_of_arrays
from ._fit_solve import (FAR_OFF, Problem, covariance_of, kappa_of, outer_errors, refuse_what_is_not_known, refuse_what_is_not_said,
                         residuals, scipy_least_squares, solve, starts_of, weigh)
from ._load import _chosen
from ._run import _settings

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


class FitParameter:
    """A number that was looked for.

    Parameters
    ----------
    key : str
        Of the profile, or words for what is none: "reflectivity of black".
    unit : str
        Of all numbers here; empty: none.
    value, error : float, in unit
        What was found, and its standard error.
    start : float, in unit
        The value in force before.
    at_end : bool
        Whether it is at an end of its range, so that its error says little.
    """

    def __init__(self, key: str, unit: str, value: float, error: float, start: float, at_end: bool) -> None:
        self.key = key
        self.unit = unit
        self.value = value
        self.error = error
        self.start = start
        self.at_end = at_end

    def __repr__(self) -> str:
        return f"{self.key} = {self.text} +- {_rounded(self.error, self.error)}"

    @property
    def text(self) -> str:
        """The value as a profile has it, to a tenth of its error."""
        return _rounded(self.value, self.error) + (f" {self.unit}" if self.unit else "")


def _rounded(value: float, error: float) -> str:
    """With as many digits as two of the error's."""
    if not (error > 0 and math.isfinite(error)):
        return f"{value:.6g}"
    digits = 1 - math.floor(math.log10(error))
    rounded = round(value, digits)
    return f"{rounded:.{max(digits, 0)}f}" if 1e-4 <= abs(rounded) < 1e7 or rounded == 0 else f"{rounded:.6g}"


class Fit:
    """What was found, how well it is known, and how well it goes with the rows.

    ``str()`` of it is a report, ``fit["illumination.0.power"]`` a FitParameter.

    Parameters
    ----------
    model : Model
        What was fitted.
    values : sequence of numbers
        Of its unknowns.
    errors : sequence of numbers
        Their standard errors.
    correlation : float64 array [number, number], 1
        Of the errors.
    condition : float, 1
        Largest over least singular value of the derivatives of all rows, each of length 1: how near two numbers are to being one.
    robust_scatter : dict
        By kind of row ("sigma", "bias", "intensity"): 1.4826 times the median of the sizes of its residuals.
    kappa : pair of numbers, optional
        Electrons of a raw frame times the distance's square over the reflectivity, in e m^2, and its relative error. All that light,
        lens and pixel do to the signal is in this one number, and no more can be known of them by a wall in the dark.

    Attributes
    ----------
    parameters : list of FitParameter
    predicted, residuals : dict
        Of each row what the fit says (``sigma_m``, ``bias_m``, ``intensity``), and ln(fitted/measured), of bias metres of difference, by
        kind.
    scatter, scatter_before : dict
        Root mean square of the residuals by kind, with what was found and with the values in force.
    """

    def __init__(self, model: Model, values: Sequence[float], errors: Sequence[float], correlation: Any, condition: float,
                 robust_scatter: dict[str, float], kappa: tuple[float, float] | None) -> None:
        import numpy as np

        self._model = model
        self._values = list(values)
        self.rows = model.rows
        self.parameters = [FitParameter(one.name, one.unit, value, error, one.start, _at_end(one, value))
                           for one, value, error in zip(model.unknowns, values, errors)]
        self.correlation = correlation
        self.condition = condition
        self.kappa = kappa
        self.predicted = model.predict(values)
        before = model.predict([one.start for one in model.unknowns])
        self.residuals = residuals(model, self.predicted)
        self.scatter = {kind: float(np.sqrt(np.mean(array[np.isfinite(array)] ** 2))) for kind, array in self.residuals.items()}
        self.scatter_before = {kind: float(np.sqrt(np.mean(array[np.isfinite(array)] ** 2))) if np.isfinite(array).any() else math.nan
                               for kind, array in residuals(model, before).items()}
        self.robust_scatter = robust_scatter

    def __getitem__(self, key: str) -> FitParameter:
        for one in self.parameters:
            if key in (one.key, "camera." + one.key):
                return one
        raise KeyError(key)

    def __str__(self) -> str:
        from ._fit_report import report

        return report(self)

    @property
    def hump_period_m(self) -> float:
        """Period over the distance of what harmonics do to phase and noise: c/2Nf of N phases, c/4Nf where N is odd.

        NaN of several modulation frequencies.
        """
        lit = [one for one in self.camera().mode.sequence if one.lit]
        frequencies = {one.modulation_frequency_hz for one in lit}
        if len(frequencies) != 1:
            return math.nan
        count = len({round(one.reference_phase_rad, 6) for one in lit})
        return 299792458.0 / (2 * count * (1 + count % 2) * float(frequencies.pop()))

    def camera(self, mode: str = "") -> Any:
        """The camera with what was found.

        Parameters
        ----------
        mode : str
            One of the profile's; empty: that of the rows.

        Returns
        -------
        Camera

        Raises
        ------
        Error
            For a mode that the profile does not have.
        """
        return self._model.camera(self._values, mode or self._model.modes[0])

    def table(self, step: int = 10) -> str:
        """Medians of so many rows each, measured and as fitted, as a table of Markdown.

        Parameters
        ----------
        step : int
            1 or more.

        Returns
        -------
        str

        Raises
        ------
        Error
            For a step below 1.
        """
        if step < 1:
            raise BadInput(f"step: error: got {step}\n  expected 1 or more")
        from ._fit_report import table

        return table(self, step)

    def patch(self) -> str:
        """What was found as YAML: by key the value, its standard error and the source. Nothing is written in place.

        Returns
        -------
        str

        Raises
        ------
        Error
            Never of its own; of a profile that is gone since.
        """
        from ._fit_report import patch

        return patch(self)

    def diff(self) -> str:
        """What would change in the profile's file, as a unified diff; its comments stay. Empty where the fit found nothing of the profile.

        Returns
        -------
        str

        Raises
        ------
        Error
            Where the text with what was found is not read back as the fitted camera.
        """
        from ._fit_report import diff

        return diff(self)

    def plot(self) -> Any:
        """Rows and fit over the distance (or the intensity), and their ratio below.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        ImportError
            Without matplotlib.
        """
        from ._fit_report import figure

        return figure(self)


def _at_end(unknown: Unknown, value: float) -> bool:
    low, high = unknown.bounds
    inner = unknown.inner(value) if value > 0 or not unknown.log else low
    return min(inner - low, high - inner) < 1e-6 * (1 + abs(inner))


def _rows_of(measured: Any, columns: Sequence[str], where: str, profile: str, mode: str, words: dict[str, str]) -> Rows:
    alone = isinstance(measured, (str, os.PathLike))
    files: list[Any] = ["data"] if hasattr(measured, "items") else [measured] if alone else list(measured)
    rows: list[dict[str, Any]] = rows_of_arrays(measured) if hasattr(measured, "items") else []
    for file in files if not rows else []:
        rows += read_rows(file, columns)
    if any(row.get("recording") for row in rows):
        from ._fit_recordings import add_recordings

        add_recordings(rows, profile, mode, words)
    return rows_of(rows, [os.fspath(one) for one in files], where)


def fit(profile: str | os.PathLike[str], measured: str | os.PathLike[str] | Sequence[str | os.PathLike[str]] | Mapping[str, Any],
        free: Sequence[str], *, scale_free: Sequence[str] = (), mode: str = "", set: Mapping[str, Any] | None = None,
        reflectivity: float = 0.8, columns: Sequence[str] = (), where: str = "", search_frequency: bool = True) -> Fit:
    """Looks for numbers of a profile with which `budget` says what was measured of walls.

    Least squares of ln(fitted/measured) of range noise and intensity and of the difference of biases, by Huber's loss: rows that are far
    off weigh less. Each kind of row is weighed by its own scatter. Standard errors are those of Huber's estimate, by that scatter.

    Parameters
    ----------
    profile : path or name
        As of ``load_camera``. It is not changed.
    measured : path, paths or mapping
        Text files with the columns ``distance_m`` (or ``_mm``), ``sigma_mm``, ``bias_mm``, ``intensity``, ``reflectivity``, ``class``,
        ``mode``, ``ambient_lx``, ``recording`` (a folder of npz files beside the text: frames of a wall that stands still, whose noise is
        sigma); or arrays by these names. Of a row with an intensity and no distance the wall stands where it has that amplitude, and humps
        of the noise over the distance are left out.
    free : sequence of str
        Keys of the profile that are numbers, ``illumination.*.power`` for all lights together; ``illumination.0.waveform.a1``, ``.r3``,
        ``.psi3``: amplitude of the correlation's first harmonic, the third's over it and its phase.
    scale_free : sequence of str
        "reflectivity": that of each class is looked for, too. "intensity": how many units an electron of the amplitude is. "bias": its
        offset.
    mode : str
        Of rows that name none; empty: the profile's first.
    set : mapping
        Keys that are changed before, as of ``load_camera``.
    reflectivity : float
        Of rows that name none.
    columns : sequence of str
        Names of the columns of a file whose first line has none.
    where : str
        Which rows count: ``"distance_m>2.4, sigma_mm<250"``.
    search_frequency : bool
        Whether a free modulation frequency is begun 15 % lower and higher, too, for the period of humps has several hollows.

    Returns
    -------
    Fit

    Raises
    ------
    Error
        For what cannot be read, by file, line and column; where rows do not say what was asked for, by the pair of numbers that they
        cannot tell apart.
    ImportError
        Without scipy.
    """
    import numpy as np

    least_squares = scipy_least_squares()
    if not free:
        raise BadInput("free: error: there is nothing to look for\n  expected keys of the profile, such as illumination.0.power")
    words = {key.removeprefix("camera."): text for key, text in _settings(set)}
    name = _chosen(_native.choose_camera(os.fspath(profile)))
    rows = _rows_of(measured, columns, where, name, mode, words)
    model = Model(name, mode, words, rows, free, scale_free, reflectivity)
    problem = Problem(model)
    starts = starts_of(problem, search_frequency)
    first = problem(starts[0])
    if not (np.abs(first) < FAR_OFF / max(problem.scales.values())).any():
        raise BadInput(f"{rows.places[0]}: error: no row has a range noise with the values in force\n"
                       "  expected rows where the pixel is neither saturated nor dark, or a start by `set`")
    inner = solve(problem, starts, least_squares)
    inner = weigh(problem, inner, least_squares)
    jacobian = problem.jacobian(inner)
    condition = refuse_what_is_not_said(problem, inner, jacobian)
    covariance = covariance_of(problem, inner, jacobian)
    correlation = refuse_what_is_not_known(problem, covariance)
    values = problem.values(inner)
    used = {kind: problem.scales[kind] for kind in problem.by_kind(inner)}
    return Fit(model, values, outer_errors(problem, values, covariance), correlation, condition, used, kappa_of(problem, inner, covariance))
