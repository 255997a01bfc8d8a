"""Text over a picture: boxes at places of a grid, and labels.

Boxes stand where MuJoCo's do. The letters are those of the public font8x8, of whole multiples of its pixels, not MuJoCo's.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco import _engine as _core
from robohive.mujoco.enums.view import mjtFont, mjtGridPos
from robohive.mujoco.pictures.context import MjrContext, MjrRect

#: Pixels between a box and the border of the viewport, and between two lines.
_PAD = 5
#: Pixels of a box beside its text, and left of it.
_BESIDE, _LEFT = 13, 3
#: Pixels by which the boxes of two columns overlap.
_OVERLAP = 2
#: Font scale for each pixel of a letter's pixel.
_SCALE = 75
_LETTER = 8
#: Most letters of a text.
_MOST = 500
_TITLE, _CONTENT = (0.7, 0.7, 0.7), (1.0, 1.0, 1.0)
_Places = mjtGridPos
_LEFT_CORNERS = (_Places.mjGRID_TOPLEFT, _Places.mjGRID_BOTTOMLEFT)

_Colour = tuple[float, float, float]


def _side(font: int, con: MjrContext) -> int:
    """Pixels along a side of a letter."""
    scale = max(1, round(con.fontScale / _SCALE))
    return _LETTER * scale * (2 if font == mjtFont.mjFONT_BIG else 1)


@cache
def _letter(letter: str) -> NDArray[np.bool_]:
    rows = np.array([list(row) for row in _core.letter_rows(letter)], np.uint8)[0]
    return np.unpackbits(rows[:, None], axis=1, bitorder="little").astype(bool)


def _line(text: str, side: int) -> NDArray[np.bool_]:
    """Pixels of a line, rows from below."""
    if not text:
        return np.zeros((side, 0), bool)
    whole = np.concatenate([_letter(letter) for letter in text], axis=1)
    times = side // _LETTER
    enlarged: NDArray[np.bool_] = whole.repeat(times, axis=0).repeat(times, axis=1)[::-1]
    return enlarged


def _cut(start: int, length: int, within: tuple[int, int]) -> tuple[slice, slice]:
    """The part of an interval that lies within another one: there, and seen from its own start."""
    first, last = max(start, within[0]), max(start, within[0], min(start + length, within[1]))
    return slice(first, last), slice(first - start, last - start)


def _blend(con: MjrContext, box: MjrRect, colour: _Colour, opacity: float) -> None:
    rows, columns = con._within(box)
    old = con._rgb[rows, columns]
    mixed = old * (1.0 - opacity) + 255.0 * opacity * np.array(colour)
    con._rgb[rows, columns] = np.round(mixed).astype(np.uint8)


def _write(con: MjrContext, box: MjrRect, place: tuple[int, int], line: NDArray[np.bool_], colour: _Colour) -> None:
    """Writes a line whose lower left corner is `place`, in pixels from that of the box, as far as it is in the box."""
    bounds = con._within(box)
    rows, from_rows = _cut(box.bottom + place[1], line.shape[0], (bounds[0].start, bounds[0].stop))
    columns, from_columns = _cut(box.left + place[0], line.shape[1], (bounds[1].start, bounds[1].stop))
    con._rgb[rows, columns][line[from_rows, from_columns]] = np.round(255.0 * np.array(colour)).astype(np.uint8)


def _text(
    con: MjrContext, font: int, box: MjrRect, place: tuple[int, int], text: str, colour: _Colour
) -> None:
    line = _line(text, _side(font, con))
    if font == mjtFont.mjFONT_SHADOW:
        _write(con, box, (place[0] + 1, place[1] - 1), line, (0.0, 0.0, 0.0))
    _write(con, box, place, line, colour)


def _place(gridpos: int, viewport: MjrRect, size: tuple[int, int], skip: int) -> MjrRect:
    """The box of a text of this size, `skip` pixels further from the side."""
    word = _Places(int(gridpos)).name.removeprefix("mjGRID_")
    width, height = size
    if word.endswith("LEFT"):
        left = skip + _PAD
    elif word.endswith("RIGHT"):
        left = viewport.width - skip - 1 - _PAD - width
    else:
        left = (viewport.width - skip - width) // 2 - 1 - _PAD
    if word.startswith("TOP"):
        bottom = viewport.height - 1 - _PAD - height
    elif word.startswith("BOTTOM"):
        bottom = _PAD
    else:
        bottom = (viewport.height - height) // 2 - 1 - _PAD
    return MjrRect(viewport.left + left, viewport.bottom + bottom, width, height)


def _column(font: int, gridpos: int, viewport: MjrRect, text: str, colour: _Colour, skip: int, con: MjrContext) -> int:
    """Draws a box with text; returns how far the next one is from the side."""
    lines, side = text[:_MOST].split("\n"), _side(font, con)
    size = _BESIDE + side * max(map(len, lines)), _PAD + side * len(lines) + _PAD * (len(lines) - 1)
    box = _place(gridpos, viewport, size, skip)
    _blend(con, box, (0.0, 0.0, 0.0), 0.5)
    for number, line in enumerate(lines):
        _text(con, font, box, (_LEFT, size[1] - side - number * (side + _PAD)), line, colour)
    return skip + size[0] - _OVERLAP


def _decoded(text: str | bytes | None) -> str:
    return text.decode() if isinstance(text, bytes) else text or ""


def mjr_overlay(
    font: int, gridpos: int, viewport: MjrRect, overlay: str | bytes, overlay2: str | bytes | None, con: MjrContext
) -> None:
    """Draws text into what was drawn last, white on a darkened box; lines end with a line feed.

    Args:
        font: `mjtFont`: normal, with a shadow, or big.
        gridpos: `mjtGridPos`: the corner or the side of the viewport.
        viewport: the rectangle of the picture [pixels].
        overlay: the text; the titles, in grey, where there is a second column.
        overlay2: the second column, "" or None for none.
        con: the context with the picture.

    Raises:
        ValueError: `gridpos` is no value of `mjtGridPos`.
    """
    if viewport.width <= 0 or viewport.height <= 0:
        return
    first, second = _decoded(overlay), _decoded(overlay2)
    if not second:
        _column(font, gridpos, viewport, first, _CONTENT, 0, con)
        return
    columns = [(first, _TITLE), (second, _CONTENT)]
    skip = 0
    for text, colour in columns if int(gridpos) in _LEFT_CORNERS else reversed(columns):
        skip = _column(font, gridpos, viewport, text, colour, skip, con)


def mjr_label(
    viewport: MjrRect,
    font: int,
    txt: str,
    r: float,
    g: float,
    b: float,
    a: float,
    rt: float,
    gt: float,
    bt: float,
    con: MjrContext,
) -> None:
    """Fills a rectangle with the colour `r`, `g`, `b` of opacity `a`, and writes a line of the colour `rt`, `gt`, `bt` in its
    middle."""
    if viewport.width <= 0 or viewport.height <= 0:
        return
    side = _side(font, con)
    _blend(con, viewport, (r, g, b), a)
    left, bottom = (viewport.width - side * len(txt)) // 2, (viewport.height - side) // 2
    _text(con, font, viewport, (max(0, left), bottom), txt, (rt, gt, bt))


def mjr_text(font: int, txt: str, con: MjrContext, x: float, y: float, r: float, g: float, b: float) -> None:
    """Writes a line of the colour `r`, `g`, `b` whose lower left corner is at `x`, `y`, shares of the picture's size."""
    whole = MjrRect(0, 0, con.offWidth, con.offHeight)
    _text(con, font, whole, (int(x * con.offWidth), int(y * con.offHeight)), txt, (r, g, b))


def mjr_changeFont(fontscale: int, con: MjrContext) -> None:
    """Sets the size of letters [%]."""
    con.fontScale = int(fontscale)
