# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Least squares of `fit`: residuals, derivatives, standard errors, and what rows do not say."""

from __future__ import annotations

import importlib
import math
from typing import TYPE_CHECKING, Any

from ._errors import BadInput

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ._fit_model import Model

_HUBER = 1.345  # standard deviations, beyond which a row weighs less: 95 % efficiency where errors are normal
_USUAL = {"sigma": 0.1, "bias": 5e-3, "intensity": 0.1}  # first guess of the rows' own errors: 10 %, 5 mm
_LEAST = {"sigma": 1e-5, "bias": 1e-6, "intensity": 1e-5}  # no smaller: the budget's light is float32
FAR_OFF = 3.0  # of a row without a range noise: a factor of 20
_SINGULAR = 3e-3  # least over largest singular value of the derivatives, each of length 1
_UNKNOWABLE = math.log(3)  # standard error of a logarithm, beyond which nothing is known of its number


class Undetermined(BadInput):
    """The rows do not say what was asked for."""


Undetermined.__module__ = "tofray"


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


class Problem:
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
            far = FAR_OFF if kind != "bias" else 10 * self.scales[kind]
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


def scipy_least_squares() -> Any:
    try:
        return importlib.import_module("scipy.optimize").least_squares
    except ImportError as fault:
        raise ImportError("fit needs the package scipy (Debian: python3-scipy)") from fault


def solve(problem: Problem, starts: list[Any], least_squares: Any) -> Any:
    import numpy as np

    low, high = problem.bounds()
    inside = [np.clip(one, low + 1e-9 * (1 + abs(low)), high - 1e-9 * (1 + abs(high))) for one in starts]
    words = {"bounds": (low, high), "loss": "huber", "f_scale": _HUBER, "x_scale": "jac", "xtol": 1e-5, "ftol": 1e-6, "max_nfev": 60}
    found = [least_squares(problem, one, problem.jacobian, **words) for one in inside]
    return min(found, key=lambda one: float(one.cost)).x


def weigh(problem: Problem, inner: Any, least_squares: Any) -> Any:
    """Again, with each kind of row weighed by its own scatter, until that stays."""
    import numpy as np

    for _ in range(8):
        before = dict(problem.scales)
        for kind, array in problem.by_kind(inner).items():
            good = array[np.isfinite(array)]
            if good.size:
                freedom = good.size / max(good.size - len(inner), 1)  # what was fitted is nearer than what is true
                problem.scales[kind] = max(1.4826 * math.sqrt(freedom) * float(np.median(np.abs(good))), _LEAST[kind])
        inner = solve(problem, [inner], least_squares)
        if all(abs(problem.scales[kind] / before[kind] - 1) < 0.01 for kind in before):
            break
    return inner


def starts_of(problem: Problem, wide: bool) -> list[Any]:
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


def refuse_what_is_not_said(problem: Problem, inner: Any, jacobian: Any) -> float:
    """The condition number of the derivatives, each of length 1."""
    import numpy as np

    names = _names(problem.model)
    lengths = np.sqrt((jacobian ** 2).sum(axis=0))
    idle = [name for name, length, column in zip(names, lengths, jacobian.T) if np.abs(column).max() * max(problem.scales.values()) < 1e-4]
    if idle:
        them = "it" if len(idle) == 1 else "them"
        raise Undetermined(f"error: {' and '.join(idle)} cannot be known from these rows: none depends on {them}\n"
                           "  expected rows that do, or fewer numbers to look for")
    _, singular, directions = np.linalg.svd(jacobian / lengths, full_matrices=False)
    condition = float(singular[0] / max(singular[-1], 1e-300))
    if condition * _SINGULAR > 1:
        shares = np.abs(directions[-1])
        order = np.argsort(-shares)
        together = [names[i] for i in order if shares[i] > 0.3 * shares[order[0]]] or [names[i] for i in order[:2]]
        if len(together) == 1:
            together.append(names[order[1]])
        said = ", ".join(together[:-1]) + " and " + together[-1]
        by, free = ("either", "one of them") if len(together) == 2 else ("some of them", "fewer of them")
        raise Undetermined(f"error: {said} cannot be told apart by these rows\n"
                           f"  got the same change of all rows by {by}, to {1 / condition:.1g} of it; expected {free}\n"
                           "  free, or rows that they change in different ways")
    return condition


def _names(model: Model) -> list[str]:
    return [one.name for one in model.unknowns]


def covariance_of(problem: Problem, inner: Any, jacobian: Any) -> Any:
    """Of Huber's estimate: K^2 s^2 (J^T J)^-1, by the rows' own scatter (Huber 1981, 7.6)."""
    import numpy as np

    rows = problem(inner)
    n, p = jacobian.shape
    if n <= p:
        raise Undetermined(f"error: {n} measured values do not say {p} numbers and how well they are known\n"
                           "  expected more rows than numbers")
    clipped = np.clip(rows, -_HUBER, _HUBER)
    inside = float(np.mean(np.abs(rows) < _HUBER))
    correction = 1 + p / n * (1 - inside) / inside
    variance = correction ** 2 * float((clipped ** 2).sum()) / (n - p) / inside ** 2
    return variance * np.linalg.inv(jacobian.T @ jacobian)


def outer_errors(problem: Problem, values: Sequence[float], covariance: Any) -> list[float]:
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


def refuse_what_is_not_known(problem: Problem, covariance: Any) -> Any:
    import numpy as np

    names = _names(problem.model)
    errors = np.sqrt(np.diag(covariance))
    correlation = covariance / np.outer(errors, errors)
    for i, unknown in enumerate(problem.model.unknowns):
        if not unknown.log or errors[i] < _UNKNOWABLE:
            continue
        others = np.abs(correlation[i]) - np.eye(len(errors))[i]
        beside = int(np.argmax(others)) if len(errors) > 1 else i
        together = len(errors) > 1 and others[beside] > 0.9
        why = f"; it goes with {names[beside]}, correlation {correlation[i, beside]:.3f}" if together else ""
        raise Undetermined(f"error: {unknown.name} cannot be known from these rows{' beside ' + names[beside] if why else ''}\n"
                           f"  got a standard error of a factor of {math.exp(min(errors[i], 50)):.3g}{why}\n"
                           "  expected rows that it rules (read noise: dark ones), or it as given")
    return correlation


def kappa_of(problem: Problem, inner: Any, covariance: Any) -> tuple[float, float] | None:
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
