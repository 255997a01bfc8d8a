"""A table of parameters before and after a fit."""

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]

#: How near to a bound is at it, relative to the bound.
_AT_BOUND = 1e-3


def at_bound(value: float, low: float, high: float) -> bool:
    """Whether a value is at one of its bounds, to a part in a thousand."""
    return any(abs(value - bound) < 1e-8 + _AT_BOUND * abs(bound) for bound in (low, high))


def comparison(names: list[str], columns: dict[str, Vector], bounds: tuple[Vector, Vector], digits: int) -> str:
    """The table, with the root of the mean square of changes and, of known values, of errors below it.

    Args:
        names: of the `n` numbers.
        columns: `initial` and `identified`, `nominal` where it is known, each `(n,)`.
        bounds: each `(n,)`.
        digits: how many are shown.
    """
    if not names:
        return "no parameter is fitted"
    found = columns["identified"]
    shown = {**columns, "lower": bounds[0], "upper": bounds[1]}
    head = ["parameter", *shown, "change", *(["error"] if "nominal" in columns else []), ""]
    rows = [head]
    for i, name in enumerate(names):
        row = [name, *(f"{column[i]:.{digits}g}" for column in shown.values()), _share(found[i], columns["initial"][i])]
        row += [_share(found[i], columns["nominal"][i])] if "nominal" in columns else []
        rows.append([*row, "at a bound" if at_bound(found[i], bounds[0][i], bounds[1][i]) else ""])
    widths = [max(len(row[column]) for row in rows) for column in range(len(head))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    for label, known in (("changes", "initial"), ("errors", "nominal")):
        if known in columns:
            lines.append(f"root mean square of {label}: {np.sqrt(np.mean((found - columns[known]) ** 2)):.4g}")
    return "\n".join(lines)


def _share(value: float, of: float) -> str:
    """The relative distance of two numbers; absolute, where the second is zero."""
    return f"{value - of:+.3g}" if of == 0 else f"{100 * (value - of) / abs(of):+.2f} %"
