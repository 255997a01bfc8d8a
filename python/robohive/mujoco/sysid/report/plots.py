"""Curves as SVG."""

from __future__ import annotations

import html
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]

#: Size of a plot, and room for its axes [pixels].
_WIDTH, _HEIGHT, _LEFT, _BOTTOM, _TOP = 620, 170, 64, 22, 8
#: Points of a curve at most: more than there are columns of pixels cannot be seen.
_POINTS = 800
#: Colours that people with impaired colour vision tell apart (Okabe and Ito, "Color universal design", 2008).
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")


def curves(series: Mapping[str, tuple[Vector, Vector]], along: str, logarithmic: bool = False) -> str:
    """Curves over one axis, with a legend.

    Args:
        series: abscissas and ordinates by name, each `(n,)`; numbers that are not finite are left out.
        along: what the axis is.
        logarithmic: ordinates by their decimal logarithm; such as are not positive are left out.
    """
    shown = {name: _thinned(np.asarray(x, float), np.asarray(y, float), logarithmic) for name, (x, y) in series.items()}
    xs = np.concatenate([x for x, _ in shown.values()] or [np.empty(0)])
    ys = np.concatenate([y for _, y in shown.values()] or [np.empty(0)])
    if not xs.size:
        return "<p>nothing to show</p>"
    spans = [_span(xs), _span(ys)]
    lines = [_axis(spans, along, logarithmic)]
    for colour, (name, (x, y)) in zip(_cycled(len(shown)), shown.items(), strict=True):
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(*_placed(x, y, spans), strict=True))
        lines.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.2"/>')
    key = " ".join(
        f'<span style="color:{colour}">&#9644; {html.escape(name)}</span>'
        for colour, name in zip(_cycled(len(shown)), shown, strict=True)
    )
    return f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" width="{_WIDTH}" role="img">{"".join(lines)}</svg><p class="key">{key}</p>'


def _cycled(count: int) -> list[str]:
    return [COLOURS[i % len(COLOURS)] for i in range(count)]


def _thinned(x: Vector, y: Vector, logarithmic: bool) -> tuple[Vector, Vector]:
    if logarithmic:
        y = np.log10(np.where(y > 0, y, np.nan))
    good = np.isfinite(x) & np.isfinite(y)
    x, y = x[good], y[good]
    chosen = np.unique(np.linspace(0, max(len(x) - 1, 0), _POINTS).astype(int)) if len(x) else np.empty(0, int)
    return x[chosen], y[chosen]


def _span(values: Vector) -> tuple[float, float]:
    low, high = float(values.min()), float(values.max())
    return (low, high) if high > low else (low - 0.5, high + 0.5)


def _placed(x: Vector, y: Vector, spans: list[tuple[float, float]]) -> tuple[Vector, Vector]:
    (left, right), (low, high) = spans
    across = _LEFT + (x - left) / (right - left) * (_WIDTH - _LEFT - 8)
    down = _TOP + (high - y) / (high - low) * (_HEIGHT - _TOP - _BOTTOM)
    return across, down


def _axis(spans: list[tuple[float, float]], along: str, logarithmic: bool) -> str:
    bottom, right = _HEIGHT - _BOTTOM, _WIDTH - 8
    (first, last), (low, high) = spans
    ends = (f"{10**value:.2g}" if logarithmic else f"{value:.3g}" for value in (high, low))
    texts = [
        *((_LEFT - 6, y, "end", text) for y, text in zip((_TOP + 8, bottom), ends, strict=True)),
        (_LEFT, _HEIGHT - 6, "start", f"{first:.3g}"),
        (right, _HEIGHT - 6, "end", f"{last:.3g}"),
        ((_LEFT + right) / 2, _HEIGHT - 6, "middle", html.escape(along)),
    ]
    frame = f'<path d="M{_LEFT} {_TOP}V{bottom}H{right}" fill="none" stroke="#888"/>'
    return frame + "".join(
        f'<text x="{x}" y="{y}" text-anchor="{anchor}">{text}</text>' for x, y, anchor, text in texts
    )
