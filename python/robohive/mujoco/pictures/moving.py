"""Free cameras moved by a mouse, and what a click in a picture hits."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco._errors import FatalError
from robohive.mujoco.enums.view import mjtCamera, mjtMouse, mjtVisFlag
from robohive.mujoco.functions.query import mj_ray
from robohive.mujoco.pictures.scene import MjvScene
from robohive.mujoco.pictures.view import MjvCamera, MjvOption
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel

_Vector = NDArray[np.float64]

#: Share of the frustum's height that a drag moves a camera with parallel rays by.
_PARALLEL = 0.15


def _axes(cam: MjvCamera) -> tuple[_Vector, _Vector, _Vector]:
    """Right, up and forward of a free camera, world frame."""
    azimuth, elevation = np.radians((cam.azimuth, cam.elevation))
    level = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    vertical = np.array([0.0, 0.0, 1.0])
    forward = np.cos(elevation) * level + np.sin(elevation) * vertical
    up = np.cos(elevation) * vertical - np.sin(elevation) * level
    return np.cross(forward, up), up, forward


def _rotate(m: MjModel, cam: MjvCamera, x: float, y: float) -> None:
    cam.azimuth -= 180.0 * x
    cam.elevation -= 180.0 * y


def _zoom(m: MjModel, cam: MjvCamera, x: float, y: float) -> None:
    extent = m.stat.extent
    cam.distance -= 9.0 * extent * y * np.log1p(cam.distance / (3.0 * extent))


def _drag(vertical: bool) -> Callable[[MjModel, MjvCamera, float, float], None]:
    """The point looked at follows the mouse, in a vertical plane or in the horizontal one."""

    def drag(m: MjModel, cam: MjvCamera, x: float, y: float) -> None:
        right, _, forward = _axes(cam)
        height = m.vis.global_.fovy
        if not cam.orthographic:
            height = 2.0 * np.tan(np.radians(height) / 2.0)
        away = np.array([0.0, 0.0, 1.0]) if vertical else np.cross([0.0, 0.0, 1.0], right)
        share = height * cam.distance * (_PARALLEL if cam.orthographic else 1.0)
        cam.lookat -= share * (x * right - y * away)

    return drag


def _slide(vertical: bool) -> Callable[[MjModel, MjvCamera, float, float], None]:
    """The camera moves in its own frame: up or forward, and to the right."""

    def slide(m: MjModel, cam: MjvCamera, x: float, y: float) -> None:
        right, up, forward = _axes(cam)
        cam.lookat += x * right + y * (up if vertical else forward)

    return slide


def _turn(vertical: bool) -> Callable[[MjModel, MjvCamera, float, float], None]:
    """The camera stays where it is and looks elsewhere."""

    def turn(m: MjModel, cam: MjvCamera, x: float, y: float) -> None:
        head = cam.lookat - cam.distance * _axes(cam)[2]
        _rotate(m, cam, 0.0 if vertical else x, y if vertical else 0.0)
        cam.lookat[:] = head + cam.distance * _axes(cam)[2]

    return turn


_MOVES: dict[int, Callable[[MjModel, MjvCamera, float, float], None]] = {
    mjtMouse.mjMOUSE_ROTATE_V: _rotate,
    mjtMouse.mjMOUSE_ROTATE_H: _rotate,
    mjtMouse.mjMOUSE_MOVE_V: _drag(True),
    mjtMouse.mjMOUSE_MOVE_H: _drag(False),
    mjtMouse.mjMOUSE_ZOOM: _zoom,
    mjtMouse.mjMOUSE_MOVE_V_REL: _slide(True),
    mjtMouse.mjMOUSE_MOVE_H_REL: _slide(False),
    mjtMouse.mjMOUSE_TURN_V: _turn(True),
    mjtMouse.mjMOUSE_TURN_H: _turn(False),
}


def mjv_moveCamera(m: MjModel, action: int, reldx: float, reldy: float, cam: MjvCamera) -> None:
    """Moves a camera that is not fixed as a drag of the mouse does; `reldx` and `reldy` are shares of the window's height.

    Raises:
        FatalError: `action` is no value of `mjtMouse` that moves.
    """
    if cam.type == mjtCamera.mjCAMERA_FIXED:
        return
    move = _MOVES.get(int(action))
    if move is None:
        raise FatalError(f"mjv_moveCamera: unexpected action {int(action)}")
    if cam.type == mjtCamera.mjCAMERA_TRACKING and move not in (_rotate, _zoom):
        return
    move(m, cam, float(reldx), float(reldy))
    if abs(cam.azimuth) > 180.0:
        cam.azimuth -= float(np.copysign(360.0, cam.azimuth))
    cam.elevation = float(np.clip(cam.elevation, -89.0, 89.0))
    cam.distance = float(np.clip(cam.distance, 0.01 * m.stat.extent, 100.0 * m.stat.extent))


def mjv_select(
    m: MjModel,
    d: MjData,
    vopt: MjvOption,
    aspectratio: float,
    relx: float,
    rely: float,
    scn: MjvScene,
    selpnt: _Vector,
    geomid: NDArray[np.int32],
    flexid: NDArray[np.int32],
    skinid: NDArray[np.int32],
) -> int:
    """The body whose geom is seen at a point of the last picture of a scene; -1 for none.

    Args:
        m: the model.
        d: the simulation.
        vopt: which groups are visible.
        aspectratio: width of the picture by its height.
        relx: place from the left, 0 to 1.
        rely: place from below, 0 to 1.
        scn: the scene.
        selpnt: takes the point that was hit (3) [m].
        geomid: takes the geom (1), -1 for none.
        flexid: takes -1.
        skinid: takes -1; skins cannot be hit.
    """
    eye = scn.camera[0]
    head, forward, up = (np.array(vector, np.float64) for vector in (eye.pos, eye.forward, eye.up))
    right = np.cross(forward, up)
    half_width = 0.5 * aspectratio * (eye.frustum_top - eye.frustum_bottom)
    across = eye.frustum_center + (2.0 * relx - 1.0) * half_width
    along = eye.frustum_bottom + rely * (eye.frustum_top - eye.frustum_bottom)
    offset = across * right + along * up
    if eye.orthographic:
        head, ray = head + offset, forward
    else:
        ray = eye.frustum_near * forward + offset
        ray /= np.linalg.norm(ray)
    flexid[...] = skinid[...] = -1
    distance = mj_ray(m, d, head, ray, vopt.geomgroup, bool(vopt.flags[mjtVisFlag.mjVIS_STATIC]), -1, geomid)
    if distance < 0:
        return -1
    selpnt[:] = head + distance * ray
    return int(m.geom_bodyid[int(np.ravel(geomid)[0])])
