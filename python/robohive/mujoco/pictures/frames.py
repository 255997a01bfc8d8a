"""Where cameras stand and what they take in, and the way between a model's space and a room in which its scene is shown."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robohive.mujoco import _engine as _core
from robohive.mujoco._constants import mjMINVAL
from robohive.mujoco._errors import FatalError
from robohive.mujoco.enums.elements import mjtGeom
from robohive.mujoco.enums.view import mjtCamera, mjtMouse, mjtProjection
from robohive.mujoco.functions.out import destination, vector, write
from robohive.mujoco.functions.rotation import mju_mat2Quat, mju_mulPose, mju_negPose, mju_quatZ2Vec
from robohive.mujoco.pictures.scene import MjvGeom, MjvGLCamera, MjvScene
from robohive.mujoco.pictures.view import MjvCamera
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel

_Vector = NDArray[np.float64]
_CONNECTORS = (
    mjtGeom.mjGEOM_CAPSULE,
    mjtGeom.mjGEOM_CYLINDER,
    mjtGeom.mjGEOM_ARROW,
    mjtGeom.mjGEOM_ARROW1,
    mjtGeom.mjGEOM_ARROW2,
    mjtGeom.mjGEOM_LINE,
)


def _unit(values: ArrayLike) -> _Vector:
    array = np.asarray(values, np.float64)
    length = float(np.linalg.norm(array))
    return array / length if length > mjMINVAL else np.array([1.0, 0.0, 0.0])


def _give(outs: dict[str, tuple[Any, ArrayLike]]) -> None:
    """Writes vectors where they are asked for."""
    for name, (out, values) in outs.items():
        if out is not None:
            destination(out, name, f"size {np.size(values)}", (np.size(values),), np.asarray(out).dtype)
            write(out, values)


def _number(m: MjModel, cam: MjvCamera) -> int | None:
    """The camera of the model that this is, None for a free one.

    Raises:
        FatalError: there is none.
    """
    if cam.type in (mjtCamera.mjCAMERA_FREE, mjtCamera.mjCAMERA_TRACKING):
        return None
    if cam.type != mjtCamera.mjCAMERA_FIXED:
        raise FatalError(f"a camera of type {cam.type} stands nowhere")
    if not 0 <= cam.fixedcamid < m.ncam:
        raise FatalError(f"the model has {m.ncam} cameras, none of number {cam.fixedcamid}")
    return cam.fixedcamid


def _frame(d: MjData, cam: MjvCamera) -> tuple[_Vector, _Vector, _Vector, _Vector]:
    """Place, forward, up and right of a camera in the world."""
    number = _number(d.model, cam)
    if number is not None:
        right, up, back = d.cam_xmat[number].reshape(3, 3).T
        return d.cam_xpos[number], -back, up, right
    (ca, sa), (ce, se) = ((np.cos(angle), np.sin(angle)) for angle in np.radians((cam.azimuth, cam.elevation)))
    forward = np.array([ce * ca, ce * sa, se])
    follows = cam.type == mjtCamera.mjCAMERA_TRACKING and cam.trackbodyid >= 0
    target = d.subtree_com[cam.trackbodyid] if follows else cam.lookat
    return target - cam.distance * forward, forward, np.array([-se * ca, -se * sa, ce]), np.array([sa, -ca, 0.0])


def mjv_cameraFrame(
    headpos: _Vector | None, forward: _Vector | None, up: _Vector | None, right: _Vector | None, d: MjData, cam: MjvCamera
) -> None:
    """Place and directions of a camera in the world (3 each), as far as they are asked for."""
    frame = _frame(d, cam)
    _give(dict(zip(("headpos", "forward", "up", "right"), zip((headpos, forward, up, right), frame, strict=True), strict=True)))


def mjv_cameraFrustum(
    zver: NDArray[np.float32] | None,
    zhor: NDArray[np.float32] | None,
    zclip: NDArray[np.float32] | None,
    m: MjModel,
    cam: MjvCamera,
) -> None:
    """How far a camera sees up and down (2), to both sides (2, zeros where the window decides), and near and far (2) [m]."""
    number, near = _number(m, cam), m.vis.map.znear * m.stat.extent
    free = number is None
    fovy = m.vis.global_.fovy if free else m.cam_fovy[number]
    sides = np.zeros(2)
    if bool(m.vis.global_.orthographic) if free else m.cam_projection[number] == mjtProjection.mjPROJ_ORTHOGRAPHIC:
        heights = np.full(2, 0.5 * fovy)
    elif not free and m.cam_sensorsize[number, 1] > 0:
        size, lens = m.cam_sensorsize[number].astype(np.float64), m.cam_intrinsic[number].astype(np.float64)
        spans = near / lens[:2, None] * (0.5 * size[:, None] + np.array([-1.0, 1.0]) * lens[2:, None])
        sides, heights = spans
    else:
        heights = np.full(2, near * np.tan(np.radians(0.5 * fovy)))
    _give({"zver": (zver, heights), "zhor": (zhor, sides), "zclip": (zclip, [near, m.vis.map.zfar * m.stat.extent])})


def mjv_camera2GLCamera(m: MjModel, d: MjData, cam: MjvCamera) -> MjvGLCamera:
    """The same camera with its frustum."""
    out, (zver, zhor, zclip) = MjvGLCamera(), np.zeros((3, 2), np.float32)
    mjv_cameraFrustum(zver, zhor, zclip, m, cam)
    out.pos[:], out.forward[:], out.up[:] = _frame(d, cam)[:3]
    out.frustum_top, out.frustum_bottom = float(zver[0]), -float(zver[1])
    out.frustum_center, out.frustum_width = float(zhor[1] - zhor[0]) / 2, float(zhor[1] + zhor[0]) / 2
    out.frustum_near, out.frustum_far = map(float, zclip)
    number = _number(m, cam)
    parallel = m.vis.global_.orthographic if number is None else m.cam_projection[number] == mjtProjection.mjPROJ_ORTHOGRAPHIC
    out.orthographic = int(parallel)
    return out


def mjv_averageCamera(cam1: MjvGLCamera, cam2: MjvGLCamera) -> MjvGLCamera:
    """The camera between two, as between the eyes.

    Raises:
        FatalError: the rays of one are parallel and those of the other are not.
    """
    if cam1.orthographic != cam2.orthographic:
        raise FatalError("a camera with parallel rays and one without have no average")
    out = MjvGLCamera()
    forward = _unit(cam1.forward.astype(np.float64) + cam2.forward)
    up = cam1.up.astype(np.float64) + cam2.up
    out.pos[:] = 0.5 * (cam1.pos.astype(np.float64) + cam2.pos)
    out.forward[:], out.up[:] = forward, _unit(up - (up @ forward) * forward)
    for name in ("bottom", "top", "center", "width", "near", "far"):
        setattr(out, f"frustum_{name}", 0.5 * (getattr(cam1, f"frustum_{name}") + getattr(cam2, f"frustum_{name}")))
    out.orthographic = cam1.orthographic
    return out


def _eyes(scn: MjvScene) -> tuple[MjvGLCamera, MjvGLCamera]:
    """Both cameras of a scene.

    Raises:
        FatalError: the scene was never updated.
    """
    if any(eye.frustum_near < mjMINVAL for eye in scn.camera):
        raise FatalError("the cameras of the scene are not set: call mjv_updateScene first")
    return scn.camera


def mjv_frustumHeight(scn: MjvScene) -> float:
    """Height of what the cameras of a scene see at a distance of one; with parallel rays, at any distance [m].

    Raises:
        FatalError: the scene was never updated.
    """
    heights = [(eye.frustum_top - eye.frustum_bottom) / (1.0 if eye.orthographic else eye.frustum_near) for eye in _eyes(scn)]
    return float(np.mean(heights))


def mjv_cameraInRoom(headpos: _Vector | None, forward: _Vector | None, up: _Vector | None, scn: MjvScene) -> None:
    """Place and directions (3 each) between the cameras of a scene, in the room.

    Raises:
        FatalError: the scene was never updated.
    """
    eyes = _eyes(scn)
    middle = np.mean([np.asarray(eye.pos, np.float64) for eye in eyes], axis=0)
    ahead, above = (_unit(np.sum([np.asarray(getattr(eye, name), np.float64) for eye in eyes], axis=0)) for name in ("forward", "up"))
    _give({"headpos": (headpos, middle), "forward": (forward, ahead), "up": (up, above)})


def _in_model(scn: MjvScene) -> tuple[_Vector, _Vector, _Vector]:
    """Place, forward and up between the cameras of a scene, in the model's space."""
    parts = []
    for eye in _eyes(scn):
        forward, up = _unit(eye.forward), _unit(eye.up)
        axes = np.stack([_unit(np.cross(up, forward)), up, forward], axis=1)
        quat, pos, turn = np.zeros(4), np.zeros(3), np.zeros(4)
        mju_mat2Quat(quat, axes.ravel())
        mjv_room2model(pos, turn, np.asarray(eye.pos, np.float64), quat, scn)
        parts.append(np.vstack([pos, np.reshape(_core.matrix(turn), (3, 3)).T[[2, 1]]]))
    middle, forward, up = np.mean(parts, axis=0)
    return middle, _unit(forward), _unit(up)


def mjv_cameraInModel(headpos: _Vector | None, forward: _Vector | None, up: _Vector | None, scn: MjvScene) -> None:
    """Place and directions (3 each) between the cameras of a scene, in the model's space.

    Raises:
        FatalError: the scene was never updated.
    """
    frame = _in_model(scn)
    _give(dict(zip(("headpos", "forward", "up"), zip((headpos, forward, up), frame, strict=True), strict=True)))


def _scale(scn: MjvScene) -> float:
    if scn.scale < mjMINVAL:
        raise FatalError(f"the scene is shown at scale {scn.scale}")
    return float(scn.scale)


def mjv_room2model(modelpos: _Vector, modelquat: _Vector, roompos: ArrayLike, roomquat: ArrayLike, scn: MjvScene) -> None:
    """The pose in the model's space of one in the room; the same without `scn.enabletransform`.

    Raises:
        FatalError: the scale of the scene is zero.
    """
    scale, pos, quat = _scale(scn), vector(roompos, "roompos", 3), vector(roomquat, "roomquat", 4)
    if scn.enabletransform:
        back, turn = np.zeros(3), np.zeros(4)
        mju_negPose(back, turn, scn.translate, scn.rotate)
        mju_mulPose(modelpos, modelquat, back, turn, pos, quat)
        pos, quat = np.ravel(modelpos) / scale, np.ravel(modelquat)
    _give({"modelpos": (modelpos, pos), "modelquat": (modelquat, quat)})


def mjv_model2room(roompos: _Vector, roomquat: _Vector, modelpos: ArrayLike, modelquat: ArrayLike, scn: MjvScene) -> None:
    """The pose in the room of one in the model's space; the same without `scn.enabletransform`.

    Raises:
        FatalError: the scale of the scene is zero.
    """
    scale, pos, quat = _scale(scn), vector(modelpos, "modelpos", 3), vector(modelquat, "modelquat", 4)
    if scn.enabletransform:
        mju_mulPose(roompos, roomquat, scn.translate, scn.rotate, pos, quat)
        pos, quat = np.ravel(roompos) * scale, np.ravel(roomquat)
    _give({"roompos": (roompos, pos), "roomquat": (roomquat, quat)})


def mjv_moveModel(m: MjModel, action: int, reldx: float, reldy: float, roomup: ArrayLike, scn: MjvScene) -> None:
    """Moves a scene in its room as a drag of the mouse does; of no effect without `scn.enabletransform`.

    Raises:
        FatalError: `action` is no value of `mjtMouse` that moves.
    """
    if not scn.enabletransform:
        return
    action = int(action)
    above, ahead = vector(roomup, "roomup", 3), np.zeros(3)
    mjv_cameraInRoom(None, ahead, None, scn)
    ahead = _unit(ahead - (ahead @ above) * above)
    right = _unit(np.cross(ahead, above))
    if action in (mjtMouse.mjMOUSE_ROTATE_V, mjtMouse.mjMOUSE_ROTATE_H):
        turn = (above if action == mjtMouse.mjMOUSE_ROTATE_V else ahead) * reldx + right * reldy
        angle = float(np.linalg.norm(turn)) * np.pi
        scn.rotate[:] = _core.normalise(_core.multiply(_core.of_axis_angle(_unit(turn), angle), scn.rotate.astype(np.float64)))
    elif action in (mjtMouse.mjMOUSE_MOVE_V, mjtMouse.mjMOUSE_MOVE_V_REL):
        scn.translate += ((right * reldx - above * reldy) * m.stat.extent).astype(np.float32)
    elif action in (mjtMouse.mjMOUSE_MOVE_H, mjtMouse.mjMOUSE_MOVE_H_REL):
        scn.translate += ((right * reldx - ahead * reldy) * m.stat.extent).astype(np.float32)
    elif action == mjtMouse.mjMOUSE_ZOOM:
        scn.scale = float(np.clip(scn.scale + 3.0 * reldy * np.log1p(scn.scale / 3.0), 0.01, 100.0))
    else:
        raise FatalError(f"mjv_moveModel: unexpected action {action}")


def mjv_alignToCamera(res: _Vector, vec: ArrayLike, forward: ArrayLike) -> None:
    """Turns a vector about the vertical, as the y axis turns to the horizontal part of `forward` (3)."""
    x, y, z = vector(vec, "vec", 3).tolist()
    level = vector(forward, "forward", 3)[:2]
    length = float(np.linalg.norm(level))
    ahead = level / length if length > mjMINVAL else np.array([1.0, 0.0])
    _give({"res": (res, [x * ahead[1] + y * ahead[0], y * ahead[1] - x * ahead[0], z])})


def mjv_connector(geom: MjvGeom, type: int, width: float, from_: ArrayLike, to: ArrayLike) -> None:
    """Makes a geom lead from a point to another (3 each) [m]: a capsule, a cylinder, an arrow or a line of radius `width`.

    Colour and look stay: `mjv_initGeom` sets those.

    Raises:
        FatalError: geoms of this type connect nothing.
    """
    if int(type) not in _CONNECTORS:
        raise FatalError(f"mjv_connector: invalid geom type {int(type)}")
    start, end = vector(from_, "from", 3), vector(to, "to", 3)
    centred = int(type) in (mjtGeom.mjGEOM_CAPSULE, mjtGeom.mjGEOM_CYLINDER)
    turn = np.zeros(4)
    mju_quatZ2Vec(turn, end - start)
    length = float(np.linalg.norm(end - start))
    geom.type = int(type)
    geom.size = [width, width, 0.5 * length if centred else length]  # type: ignore[assignment]
    geom.pos = 0.5 * (start + end) if centred else start  # type: ignore[assignment]
    geom.mat = _core.matrix(turn)  # type: ignore[assignment]
