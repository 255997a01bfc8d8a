"""Samples between samples."""

from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.sysid.optional import needed

Vector: TypeAlias = NDArray[np.float64]
InterpolationMethod: TypeAlias = Literal["linear", "cubic", "quadratic", "quintic", "zero_order_hold", "zoh"]


def interpolated(times: Vector, data: Vector, at: Vector, method: InterpolationMethod) -> Vector:
    """Values at other times; before the first sample its value, after the last one that of the last.

    Args:
        times: `(n,)`, increasing [s].
        data: `(n, …)`.
        at: `(m,)` [s].
        method: `zoh` and `zero_order_hold` keep a sample until the next; the others are polynomials between or through samples.

    Returns:
        `(m, …)`.

    Raises:
        ImportError: scipy is not installed, for splines.
        ValueError: there is no such method.
    """
    if method in ("zero_order_hold", "zoh"):
        return data[np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(times) - 1)]
    inside = np.clip(at, times[0], times[-1])
    if method == "linear":
        return _linear(times, data, inside)
    degrees = {"quadratic": 2, "cubic": 3, "quintic": 5}
    if method not in degrees:
        raise ValueError(f"there is no interpolation {method!r}; there are linear, zoh, {', '.join(degrees)}")
    spline: Any = needed("scipy.interpolate", "scipy").make_interp_spline(times, data, k=degrees[method])
    return np.asarray(spline(inside), np.float64)


def _linear(times: Vector, data: Vector, at: Vector) -> Vector:
    if len(times) == 1:
        return np.repeat(data, len(at), axis=0)
    right = np.clip(np.searchsorted(times, at), 1, len(times) - 1)
    left = right - 1
    wide = (-1,) + (1,) * (data.ndim - 1)
    slope = (data[right] - data[left]) / (times[right] - times[left]).reshape(wide)
    return np.asarray(data[left] + slope * (at - times[left]).reshape(wide))
