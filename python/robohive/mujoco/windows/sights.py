"""Cameras, visual options, geoms and overlays as a window takes them and tells of them."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robohive import _core as _windows
from robohive.mujoco._constants import mjRNDSTRING
from robohive.mujoco.enums.view import mjtCamera, mjtFont
from robohive.mujoco.pictures.context import MjrRect
from robohive.mujoco.pictures.figure import MjvFigure
from robohive.mujoco.pictures.looking import free_camera
from robohive.mujoco.pictures.scene import MjvScene
from robohive.mujoco.pictures.view import MjvCamera, MjvOption

_GROUPS = tuple(f"{kind}group" for kind in ("geom", "site", "joint", "tendon", "actuator", "flex", "skin"))
_NAMES, _SHOWN = _windows.effect_names()
_FLAGS = {row[0].casefold(): place for place, row in enumerate(mjRNDSTRING)}
#: Places of the window's effects among the flags of a scene.
_EFFECTS = [_FLAGS[name.casefold()] for name in _NAMES]


def sight(cam: MjvCamera, opt: MjvOption, flags: NDArray[np.uint8] | None) -> dict[str, Any]:
    """Camera, options and flags of a scene as a window takes them."""
    fixed = cam.type == mjtCamera.mjCAMERA_FIXED
    free = None if fixed else free_camera(cam)
    return {
        "camera": cam.fixedcamid if fixed else None,
        "free": None if free is None else {**free, "lookat": [float(x) for x in cam.lookat]},
        "groups": [[bool(x) for x in getattr(opt, kind)] for kind in _GROUPS],
        "show": [bool(x) for x in opt.flags[:_SHOWN]],
        "effects": [mjRNDSTRING[place][1] == "1" if flags is None else bool(flags[place]) for place in _EFFECTS],
        "label": int(opt.label),
        "frame": int(opt.frame),
        "tree_depth": int(opt.bvh_depth),
        "flex_layer": int(opt.flex_layer),
    }


def take_sight(seen: dict[str, Any], cam: MjvCamera, opt: MjvOption, flags: NDArray[np.uint8] | None) -> None:
    """Writes what a person has chosen in a window."""
    free = seen["free"]
    if free is None:
        cam.type, cam.fixedcamid, cam.trackbodyid = int(mjtCamera.mjCAMERA_FIXED), seen["camera"], -1
    else:
        track = free["track"]
        cam.type = int(mjtCamera.mjCAMERA_FREE if track is None else mjtCamera.mjCAMERA_TRACKING)
        cam.fixedcamid, cam.trackbodyid = -1, -1 if track is None else track
        cam.lookat[:] = free["lookat"]
        cam.distance, cam.azimuth, cam.elevation = free["distance"], free["azimuth"], free["elevation"]
        cam.orthographic = int(free["orthographic"])
    for kind, groups in zip(_GROUPS, seen["groups"], strict=True):
        getattr(opt, kind)[:] = groups
    opt.flags[:_SHOWN] = seen["show"]
    opt.label, opt.frame = seen["label"], seen["frame"]
    opt.bvh_depth, opt.flex_layer = seen["tree_depth"], seen["flex_layer"]
    if flags is not None:
        flags[_EFFECTS] = seen["effects"]


def guests(scn: MjvScene) -> list[dict[str, Any]]:
    """The geoms of a program's own scene."""
    return scn._guests()


def _rectangle(rect: MjrRect) -> tuple[int, int, int, int]:
    return int(rect.left), int(rect.bottom), int(rect.width), int(rect.height)


def text(font: int | None, gridpos: int | None, first: str | None, second: str | None) -> tuple[bool, int, str, str]:
    """A text in a corner, as a window takes it.

    Raises:
        ValueError: there is no such corner.
    """
    corner = 0 if gridpos is None else int(gridpos)
    if not 0 <= corner <= 7:
        raise ValueError(f"gridpos is a value of mjtGridPos, 0 to 7, not {gridpos!r}")
    return font == mjtFont.mjFONT_BIG, corner, first or "", second or ""


def image(viewport: MjrRect, pixels: NDArray[Any]) -> tuple[tuple[int, int, int, int], bytes]:
    """An image over the picture, as a window takes it.

    Raises:
        ValueError: it has another size than its viewport, or is no image of three bytes a pixel.
    """
    size = (viewport.height, viewport.width)
    if pixels.shape[:2] != size:
        raise ValueError(f"Image shape {pixels.shape[:2]} does not match target shape {size}")
    if pixels.shape != (*size, 3) or pixels.dtype != np.uint8:
        raise ValueError(f"an image has the shape (height, width, 3) and bytes, not {pixels.shape} of {pixels.dtype}")
    return _rectangle(viewport), np.ascontiguousarray(pixels).tobytes()


def figure(viewport: MjrRect, fig: MjvFigure) -> dict[str, Any]:
    """A figure over the picture, as a window takes it."""
    lines: list[tuple[str, list[float], list[list[float]]]] = []
    for number, count in enumerate(fig.linepnt):
        if count > 0:
            name = fig.linename[number]
            points = fig.linedata[number, : 2 * int(count)].reshape(-1, 2)
            lines.append((_text(name), [float(x) for x in fig.linergb[number]], points.tolist()))
    return {
        "place": _rectangle(viewport),
        "title": _text(fig.title),
        "across": _text(fig.xlabel),
        "bars": bool(fig.flg_barplot),
        "legend": bool(fig.flg_legend) and any(name for name, _, _ in lines),
        "grows": bool(fig.flg_extend),
        "range": [[float(x) for x in row] for row in fig.range],
        "background": [float(x) for x in fig.figurergba],
        "lines": _coloured(lines),
    }


def _text(given: Any) -> str:
    return given.decode(errors="replace") if isinstance(given, bytes) else str(given)


def _coloured(
    lines: Iterable[tuple[str, list[float], list[list[float]]]],
) -> Sequence[tuple[str, list[float], list[list[float]]]]:
    """Lines without a colour get those of MuJoCo's figures: a hue each."""
    hues = ([1, 0, 0], [0, 1, 0], [0, 0.5, 1], [1, 1, 0], [1, 0, 1], [0, 1, 1])
    return [
        (name, rgb if any(rgb) else [float(x) for x in hues[number % len(hues)]], points)
        for number, (name, rgb, points) in enumerate(lines)
    ]
