# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of a profile out of measurements, with their errors, and what cannot be known."""

from __future__ import annotations

import importlib
import math
import os
from typing import TYPE_CHECKING, Any

from . import _native
from ._errors import BadInput
from ._fit_model import Model, Unknown
from ._fit_rows import Rows, read_rows, rows_of, rows_of_arrays
from ._load import _chosen
from ._run import _settings

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

_HUBER = 1.345  # standard deviations, beyond which a row weighs less: 95 % efficiency where errors are normal
_USUAL = {"sigma": 0.1, "bias": 5e-3, "intensity": 0.1}  # first guess of the rows' own errors: 10 %, 5 mm
_LEAST = {"sigma": 1e-5, "bias": 1e-6, "intensity": 1e-5}  # no smaller: the budget's light is float32
_FAR_OFF = 3.0  # of a row without a range noise: a factor of 20
_SINGULAR = 3e-3  # least over largest singular value of the derivatives, each of length 1
_UNKNOWABLE = math.log(3)  # standard error of a logarithm, beyond which nothing is known of its number


class Undetermined(BadInput):
    """The rows do not say what was asked for."""


Undetermined.__module__ = "tofray"


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
    """What was found, how well it is known, and how well it goes with the rows: ``str()`` of it is a report, ``fit["illumination.0.power"]`` a number.

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
        Electrons of a raw frame times the distance's square over the reflectivity, in e m^2, and its relative error. All that light, lens and pixel do to the
        signal is in this one number, and no more can be known of them by a wall in the dark.

    Attributes
    ----------
    parameters : list of FitParameter
    predicted, residuals : dict
        Of each row what the fit says (``sigma_m``, ``bias_m``, ``intensity``), and ln(fitted/measured), of bias metres of difference, by kind.
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
        """Period over the distance of what harmonics do to phase and noise, c/2Nf of N phases, c/4Nf where N is odd; NaN of several modulation frequencies."""
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


def residuals(model: Model, predicted: dict[str, Any]) -> dict[str, Any]:
    """ln(fitted/measured) of range noise and of intensity, metres of bias; NaN where a row has none of both."""
    import numpy as np

    out = {}
    rows = model.rows
    with np.errstate(invalid="ignore", divide="ignore"):
        if "sigma_m" in rows.numbers:
            out["sigma"] = np.log(predicted["sigma_m"] / rows.number("sigma_m"))
        if "bias_m" in rows.numbers:
            out["bias"] = predicted["bias_m"] - rows.number("bias_m")
        if "intensity" in rows.numbers and np.isfinite(model.distance).any():
            out["intensity"] = np.log(predicted["intensity"] / rows.number("intensity"))
    return out


class _Problem:
    """Residuals as one vector, over what is free inside: r_m and psi_m of a pair as the two parts of a number."""

    def __init__(self, model: Model) -> None:
        import numpy as np

        self.model = model
        self.scales = dict(_USUAL)
        self.begun = False
        rows = model.rows
        measured = {"sigma": rows.number("sigma_m"), "bias": rows.number("bias_m"),
                    "intensity": np.where(np.isnan(model.distance), np.nan, rows.number("intensity"))}
        self.counted = {kind: np.isfinite(array) for kind, array in measured.items()}

    def values(self, inner: Any) -> list[float]:
        out = [one.outer(float(value)) for one, value in zip(self.model.unknowns, inner)]
        for i, j in self.model.pairs:
            out[i] = min(math.hypot(inner[i], inner[j]), 0.95)
            out[j] = math.degrees(math.atan2(inner[j], inner[i])) % 360
        return out

    def inner(self, values: Sequence[float]) -> Any:
        import numpy as np

        out = np.array([one.inner(value) for one, value in zip(self.model.unknowns, values)])
        for i, j in self.model.pairs:
            out[i], out[j] = values[i] * math.cos(math.radians(values[j])), values[i] * math.sin(math.radians(values[j]))
        return out

    def bounds(self) -> tuple[Any, Any]:
        import numpy as np

        ends = np.array([one.bounds for one in self.model.unknowns])
        for i, j in self.model.pairs:
            ends[i] = ends[j] = (-0.95, 0.95)
        return ends[:, 0], ends[:, 1]

    def by_kind(self, inner: Any) -> dict[str, Any]:
        """Of what counts; NaN where no camera has these numbers, so that a step there is taken back."""
        try:
            predicted = self.model.predict(self.values(inner))
        except BadInput:
            if not self.begun:
                raise
            predicted = self.model.nothing()
        self.begun = True
        return {kind: array[self.counted[kind]] for kind, array in residuals(self.model, predicted).items()}

    def __call__(self, inner: Any) -> Any:
        import numpy as np

        parts = []
        for kind, array in self.by_kind(inner).items():
            far = _FAR_OFF if kind != "bias" else 10 * self.scales[kind]
            parts.append(np.where(np.isfinite(array), array, far) / self.scales[kind])
        return np.concatenate(parts)

    def jacobian(self, inner: Any) -> Any:
        import numpy as np

        low, high = self.bounds()
        columns = []
        for i, unknown in enumerate(self.model.unknowns):
            step = 0.003 if any(i in pair for pair in self.model.pairs) else unknown.step
            ahead, back = np.array(inner, float), np.array(inner, float)
            ahead[i], back[i] = min(inner[i] + step, high[i]), max(inner[i] - step, low[i])
            columns.append((self(ahead) - self(back)) / (ahead[i] - back[i]))
        return np.stack(columns, axis=1)


def _least_squares() -> Any:
    try:
        return importlib.import_module("scipy.optimize").least_squares
    except ImportError as fault:
        raise ImportError("fit needs the package scipy (Debian: python3-scipy)") from fault


def _solve(problem: _Problem, starts: list[Any], least_squares: Any) -> Any:
    import numpy as np

    low, high = problem.bounds()
    inside = [np.clip(one, low + 1e-9 * (1 + abs(low)), high - 1e-9 * (1 + abs(high))) for one in starts]
    found = [least_squares(problem, one, problem.jacobian, bounds=(low, high), loss="huber", f_scale=_HUBER, x_scale="jac", xtol=1e-5, ftol=1e-6, max_nfev=60)
             for one in inside]
    return min(found, key=lambda one: float(one.cost)).x


def _weigh(problem: _Problem, inner: Any, least_squares: Any) -> Any:
    """Again, with each kind of row weighed by its own scatter, until that stays."""
    import numpy as np

    for _ in range(8):
        before = dict(problem.scales)
        for kind, array in problem.by_kind(inner).items():
            good = array[np.isfinite(array)]
            if good.size:
                problem.scales[kind] = max(1.4826 * float(np.median(np.abs(good))), _LEAST[kind])
        inner = _solve(problem, [inner], least_squares)
        if all(abs(problem.scales[kind] / before[kind] - 1) < 0.01 for kind in before):
            break
    return inner


def _starts(problem: _Problem, wide: bool) -> list[Any]:
    """The values in force; of harmonics four phases beside it, for those have several hollows."""
    import numpy as np

    first = problem.inner([one.start for one in problem.model.unknowns])
    unit = problem.model.scale.get("intensity per electron")
    if unit is not None:  # of nobody knows which size: what is nearest, of twelve decades
        tries = [np.where(np.arange(len(first)) == unit, 2.302585 * power / 3, first) for power in range(-18, 19)]
        first = min(tries, key=lambda one: float(np.abs(problem(one)).sum()))
    out = [first]
    for i, j in problem.model.pairs:
        for turn in range(4):
            other = first.copy()
            other[i], other[j] = 0.05 * math.cos(0.5 * math.pi * turn), 0.05 * math.sin(0.5 * math.pi * turn)
            out.append(other)
    if wide:
        for k, unknown in enumerate(problem.model.unknowns):
            for move in (-0.15, 0.15):
                if unknown.log and unknown.name.endswith("modulation_frequency"):
                    for one in list(out[: 1 + 4 * len(problem.model.pairs)]):
                        other = one.copy()
                        other[k] += move
                        out.append(other)
    return out


def _refuse_what_is_not_said(problem: _Problem, inner: Any, jacobian: Any) -> float:
    """The condition number of the derivatives, each of length 1."""
    import numpy as np

    names = _names(problem.model)
    lengths = np.sqrt((jacobian ** 2).sum(axis=0))
    idle = [name for name, length, column in zip(names, lengths, jacobian.T) if np.abs(column).max() * max(problem.scales.values()) < 1e-4]
    if idle:
        raise Undetermined(f"error: {' and '.join(idle)} cannot be known from these rows: none depends on {'it' if len(idle) == 1 else 'them'}\n"
                           "  expected rows that do, or fewer numbers to look for")
    _, singular, directions = np.linalg.svd(jacobian / lengths, full_matrices=False)
    condition = float(singular[0] / max(singular[-1], 1e-300))
    if condition * _SINGULAR > 1:
        shares = np.abs(directions[-1])
        order = np.argsort(-shares)
        together = [names[i] for i in order if shares[i] > 0.3 * shares[order[0]]] or [names[i] for i in order[:2]]
        if len(together) == 1:
            together.append(names[order[1]])
        said = " and ".join(together) if len(together) == 2 else ", ".join(together[:-1]) + " and " + together[-1]
        raise Undetermined(f"error: {said} cannot be told apart by these rows\n"
                           f"  got the same change of all rows by {'either' if len(together) == 2 else 'some of them'}, to {1 / condition:.1g} of it; expected "
                           f"{'one of them' if len(together) == 2 else 'fewer of them'} free, or rows that they change in different ways")
    return condition


def _names(model: Model) -> list[str]:
    return [one.name for one in model.unknowns]


def _covariance(problem: _Problem, inner: Any, jacobian: Any) -> Any:
    """Of Huber's estimate: K^2 s^2 (J^T J)^-1, by the rows' own scatter (Huber 1981, 7.6)."""
    import numpy as np

    rows = problem(inner)
    n, p = jacobian.shape
    if n <= p:
        raise Undetermined(f"error: {n} measured values do not say {p} numbers and how well they are known\n  expected more rows than numbers")
    clipped = np.clip(rows, -_HUBER, _HUBER)
    inside = float(np.mean(np.abs(rows) < _HUBER))
    correction = 1 + p / n * (1 - inside) / inside
    variance = correction ** 2 * float((clipped ** 2).sum()) / (n - p) / inside ** 2
    return variance * np.linalg.inv(jacobian.T @ jacobian)


def _outer_errors(problem: _Problem, values: Sequence[float], covariance: Any) -> list[float]:
    import numpy as np

    out = []
    for i, (unknown, value) in enumerate(zip(problem.model.unknowns, values)):
        out.append(math.sqrt(covariance[i, i]) * (value if unknown.log else unknown.size))
    for i, j in problem.model.pairs:  # by the slopes of amplitude and phase
        turn, size = math.radians(values[j]), max(values[i], 1e-12)
        along, across = np.array([math.cos(turn), math.sin(turn)]), np.array([-math.sin(turn), math.cos(turn)])
        part = covariance[np.ix_([i, j], [i, j])]
        out[i] = math.sqrt(along @ part @ along)
        out[j] = min(math.degrees(math.sqrt(across @ part @ across) / size), 180.0)
    return out


def _refuse_what_is_not_known(problem: _Problem, covariance: Any) -> Any:
    import numpy as np

    names = _names(problem.model)
    errors = np.sqrt(np.diag(covariance))
    correlation = covariance / np.outer(errors, errors)
    for i, unknown in enumerate(problem.model.unknowns):
        if not unknown.log or errors[i] < _UNKNOWABLE:
            continue
        others = np.abs(correlation[i]) - np.eye(len(errors))[i]
        beside = int(np.argmax(others)) if len(errors) > 1 else i
        why = f"; it goes with {names[beside]}, correlation {correlation[i, beside]:.3f}" if len(errors) > 1 and others[beside] > 0.9 else ""
        raise Undetermined(f"error: {unknown.name} cannot be known from these rows{' beside ' + names[beside] if why else ''}\n"
                           f"  got a standard error of a factor of {math.exp(min(errors[i], 50)):.3g}{why}; expected rows that it rules (read noise: dark ones), or it as given")
    return correlation


def _kappa(problem: _Problem, inner: Any, covariance: Any) -> tuple[float, float] | None:
    """Electrons of a raw frame times the distance's square over the reflectivity [e m^2], and its relative error."""
    import numpy as np

    if not problem.model.has_kappa or not np.isfinite(problem.model.distance).any():
        return None

    def at(x: Any) -> float:
        return math.log(float(np.nanmedian(problem.model.predict(problem.values(x))["kappa"])))

    slope = np.zeros(len(inner))
    for i in range(len(inner)):
        ahead, back = inner.copy(), inner.copy()
        ahead[i], back[i] = ahead[i] + 0.003, back[i] - 0.003
        slope[i] = (at(ahead) - at(back)) / 0.006
    return math.exp(at(inner)), float(math.sqrt(slope @ covariance @ slope))


def _rows_of(measured: Any, columns: Sequence[str], where: str, profile: str, mode: str, words: dict[str, str]) -> Rows:
    files: list[Any] = ["data"] if hasattr(measured, "items") else [measured] if isinstance(measured, (str, os.PathLike)) else list(measured)
    rows: list[dict[str, Any]] = rows_of_arrays(measured) if hasattr(measured, "items") else []
    for file in files if not rows else []:
        rows += read_rows(file, columns)
    if any(row.get("recording") for row in rows):
        from ._fit_recordings import add_recordings

        add_recordings(rows, profile, mode, words)
    return rows_of(rows, [os.fspath(one) for one in files], where)


def fit(profile: str | os.PathLike[str], measured: str | os.PathLike[str] | Sequence[str | os.PathLike[str]] | Mapping[str, Any], free: Sequence[str], *,
        scale_free: Sequence[str] = (), mode: str = "", set: Mapping[str, Any] | None = None, reflectivity: float = 0.8, columns: Sequence[str] = (),
        where: str = "", search_frequency: bool = True) -> Fit:
    """Looks for numbers of a profile with which `budget` says what was measured of walls.

    Least squares of ln(fitted/measured) of range noise and intensity and of the difference of biases, by Huber's loss: rows that are far off weigh less.
    Each kind of row is weighed by its own scatter. Standard errors are those of Huber's estimate, by that scatter.

    Parameters
    ----------
    profile : path or name
        As of ``load_camera``. It is not changed.
    measured : path, paths or mapping
        Text files with the columns ``distance_m`` (or ``_mm``), ``sigma_mm``, ``bias_mm``, ``intensity``, ``reflectivity``, ``class``, ``mode``, ``ambient_lx``,
        ``recording`` (a folder of npz files beside the text: frames of a wall that stands still, whose noise is sigma); or arrays by these names. Of a row with an intensity and no distance the
        wall stands where it has that amplitude, and humps of the noise over the distance are left out.
    free : sequence of str
        Keys of the profile that are numbers, ``illumination.*.power`` for all lights together; ``illumination.0.waveform.a1``, ``.r3``, ``.psi3``: amplitude of the
        correlation's first harmonic, the third's over it and its phase.
    scale_free : sequence of str
        "reflectivity": that of each class is looked for, too. "intensity": how many units an electron of the amplitude is. "bias": its offset.
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
        For what cannot be read, by file, line and column; where rows do not say what was asked for, by the pair of numbers that they cannot tell apart.
    ImportError
        Without scipy.
    """
    import numpy as np

    least_squares = _least_squares()
    if not free:
        raise BadInput("free: error: there is nothing to look for\n  expected keys of the profile, such as illumination.0.power")
    words = {key.removeprefix("camera."): text for key, text in _settings(set)}
    name = _chosen(_native.choose_camera(os.fspath(profile)))
    rows = _rows_of(measured, columns, where, name, mode, words)
    model = Model(name, mode, words, rows, free, scale_free, reflectivity)
    problem = _Problem(model)
    starts = _starts(problem, search_frequency)
    first = problem(starts[0])
    if not (np.abs(first) < _FAR_OFF / max(problem.scales.values())).any():
        raise BadInput(f"{rows.places[0]}: error: no row has a range noise with the values in force\n  expected rows where the pixel is neither saturated nor dark, or a start by `set`")
    inner = _solve(problem, starts, least_squares)
    inner = _weigh(problem, inner, least_squares)
    jacobian = problem.jacobian(inner)
    condition = _refuse_what_is_not_said(problem, inner, jacobian)
    covariance = _covariance(problem, inner, jacobian)
    correlation = _refuse_what_is_not_known(problem, covariance)
    values = problem.values(inner)
    used = {kind: problem.scales[kind] for kind in problem.by_kind(inner)}
    return Fit(model, values, _outer_errors(problem, values, covariance), correlation, condition, used, _kappa(problem, inner, covariance))
