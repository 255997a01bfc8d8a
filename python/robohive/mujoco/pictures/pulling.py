"""Bodies pulled and turned with the mouse: what `MjvPerturb` holds, and what it does to a simulation."""

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco import _engine as _core
from robohive.mujoco._constants import mjMINVAL
from robohive.mujoco._errors import FatalError
from robohive.mujoco.enums.elements import mjtJoint, mjtObj
from robohive.mujoco.enums.view import mjtMouse, mjtPertBit
from robohive.mujoco.functions.query import mj_jac, mj_objectVelocity
from robohive.mujoco.functions.inertia import mj_solveM2
from robohive.mujoco.functions.rotation import mju_mulPose, mju_negPose
from robohive.mujoco.pictures.frames import _in_model, mjv_alignToCamera, mjv_frustumHeight
from robohive.mujoco.pictures.scene import MjvPerturb, MjvScene
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel

_Vector = NDArray[np.float64]

#: Part of the frustum's height that a pull with parallel rays moves by.
_PARALLEL = 0.15


def _inertial_turn(m: MjModel, d: MjData, body: int) -> list[float]:
    return _core.multiply(d.xquat[body], m.body_iquat[body])


def _grip(d: MjData, pert: MjvPerturb) -> _Vector:
    """The point that is pulled, in the world [m]."""
    grip: _Vector = d.xpos[pert.select] + d.xmat[pert.select].reshape(3, 3) @ pert.localpos
    return grip


def mjv_initPerturb(m: MjModel, d: MjData, scn: MjvScene, pert: MjvPerturb) -> None:
    """Begins to pull the selected body where it is: reference poses, the mass that is felt there, and metres for each height of
    the window.

    Raises:
        FatalError: the scene was never updated.
    """
    if not 0 < pert.select < m.nbody:
        return
    grip, jacobian, roots = _grip(d, pert), np.zeros((3, m.nv)), np.zeros((3, m.nv))
    mj_jac(m, d, jacobian, None, grip, pert.select)
    mj_solveM2(m, d, roots, jacobian, np.sqrt(d.qLDiagInv))
    mobility = float((roots**2).sum())
    pert.localmass = 3.0 / max(mobility, mjMINVAL) if mobility else 1.0
    flex = pert.flexselect
    if flex >= 0 and not m.flex_rigid[flex]:
        pert.localmass *= 2.0 * m.flex_edgenum[flex] / m.flex_vertnum[flex]
    pert.refpos[:], pert.refselpos[:] = d.xipos[pert.select], grip
    pert.refquat[:] = _inertial_turn(m, d, pert.select)
    head, forward, _ = _in_model(scn)
    pert.scale = float(mjv_frustumHeight(scn) * ((grip - head) @ forward))
    if scn.camera[0].orthographic:
        pert.scale *= _PARALLEL


def _drag(action: int, x: float, y: float, forward: _Vector) -> _Vector:
    """A drag of the mouse as a vector in the world, seen along `forward`.

    Raises:
        FatalError: `action` is no value of `mjtMouse` that moves.
    """
    plain = {
        mjtMouse.mjMOUSE_ROTATE_V: (y, 0.0, x),
        mjtMouse.mjMOUSE_ROTATE_H: (y, x, 0.0),
        mjtMouse.mjMOUSE_MOVE_V: (x, 0.0, -y),
        mjtMouse.mjMOUSE_MOVE_V_REL: (x, 0.0, -y),
        mjtMouse.mjMOUSE_MOVE_H: (x, -y, 0.0),
        mjtMouse.mjMOUSE_MOVE_H_REL: (x, -y, 0.0),
        mjtMouse.mjMOUSE_ZOOM: (0.0, 0.0, 0.0),
    }.get(action)  # type: ignore[call-overload]
    if plain is None:
        raise FatalError(f"mjv_movePerturb: unexpected action {action}")
    out = np.zeros(3)
    mjv_alignToCamera(out, plain, forward)
    return out


def _turn(m: MjModel, d: MjData, drag: _Vector, pert: MjvPerturb) -> None:
    """Turns the reference, at most a quarter turn away from the body."""
    length = float(np.linalg.norm(drag))
    axis = drag / length if length > mjMINVAL else np.array([1.0, 0.0, 0.0])
    pert.refquat[:] = _core.normalise(_core.multiply(_core.of_axis_angle(axis, 2.0 * np.pi * length), pert.refquat))
    if not 0 < pert.select < m.nbody:
        return
    present = _inertial_turn(m, d, pert.select)
    away = np.asarray(_core.velocity(_core.multiply(_core.conjugate(present), pert.refquat), 1.0))
    angle = float(np.linalg.norm(away))
    if angle > 0.5 * np.pi:
        pert.refquat[:] = _core.multiply(present, _core.of_axis_angle(away / angle, 0.5 * np.pi))


def mjv_movePerturb(
    m: MjModel, d: MjData, action: int, reldx: float, reldy: float, scn: MjvScene, pert: MjvPerturb
) -> None:
    """Moves the reference of a pull as a drag of the mouse does; `reldx` and `reldy` are shares of the window's height.

    Raises:
        FatalError: `action` is no value of `mjtMouse` that moves, or the scene was never updated.
    """
    action = int(action)
    drag = _drag(action, reldx, reldy, _in_model(scn)[1])
    if action in (mjtMouse.mjMOUSE_ROTATE_V, mjtMouse.mjMOUSE_ROTATE_H):
        _turn(m, d, drag, pert)
        return
    if action in (mjtMouse.mjMOUSE_MOVE_V_REL, mjtMouse.mjMOUSE_MOVE_H_REL):
        x, y, z = d.xmat[pert.select].reshape(3, 3).T
        drag = (x if action == mjtMouse.mjMOUSE_MOVE_H_REL else z) * reldy + y * reldx
    pert.refpos += pert.scale * drag
    pert.refselpos += pert.scale * drag


def mjv_applyPerturbForce(m: MjModel, d: MjData, pert: MjvPerturb) -> None:
    """Sets `xfrc_applied` of the selected body: critically damped springs towards the references of an active pull."""
    body, active = pert.select, pert.active | pert.active2
    if not 0 <= body < m.nbody or not active:
        return
    velocity, wrench = np.zeros(6), d.xfrc_applied[body]
    mj_objectVelocity(m, d, mjtObj.mjOBJ_BODY, body, velocity, 0)
    spin, speed = velocity[:3], velocity[3:]
    weight = float(m.body_invweight0[body, 1])
    inertia = 1.0 / max(mjMINVAL, weight) if weight else 1.0
    if active & mjtPertBit.mjPERT_TRANSLATE:
        grip = _grip(d, pert)
        away, arm, stiffness = grip - pert.refselpos, grip - d.xipos[body], m.vis.map.stiffness
        moving = np.cross(spin, arm) + speed
        wrench[:3] = -pert.localmass * (stiffness * away + np.sqrt(stiffness) * moving)
        length = float(np.linalg.norm(away))
        axis = away / length if length > mjMINVAL else np.array([1.0, 0.0, 0.0])
        wrench[3:] = np.cross(arm, wrench[:3]) - np.sqrt(m.vis.map.stiffnessrot) * inertia * (axis @ spin) * axis
    if active & mjtPertBit.mjPERT_ROTATE:
        stiffness = m.vis.map.stiffnessrot
        turn = _core.multiply(pert.refquat, _core.conjugate(_inertial_turn(m, d, body)))
        wrench[3:] = np.asarray(_core.velocity(turn, 1.0 / (stiffness * inertia))) - np.sqrt(stiffness) * inertia * spin


def mjv_applyPerturbPose(m: MjModel, d: MjData, pert: MjvPerturb, flg_paused: int) -> None:
    """Puts the selected body where its reference is: a mocap body; where `flg_paused`, also one that floats, or whose root does."""
    body = pert.select
    if not 0 < body < m.nbody or not pert.active | pert.active2:
        return
    back, pose, spare = ((np.zeros(3), np.zeros(4)) for _ in range(3))
    mju_negPose(*back, m.body_ipos[body], m.body_iquat[body])
    mju_mulPose(*pose, pert.refpos, pert.refquat, *back)
    if m.body_mocapid[body] >= 0:
        d.mocap_pos[m.body_mocapid[body]], d.mocap_quat[m.body_mocapid[body]] = pose
        return
    for owner in (body, int(m.body_rootid[body])) if flg_paused else ():
        joint = m.body_jntadr[owner]
        if m.body_jntnum[owner] != 1 or m.jnt_type[joint] != mjtJoint.mjJNT_FREE:
            continue
        at = m.jnt_qposadr[joint]
        if owner != body:
            mju_negPose(*back, d.xpos[body], d.xquat[body])
            mju_mulPose(*spare, *back, d.qpos[at : at + 3], d.qpos[at + 3 : at + 7])
            mju_mulPose(*back, *pose, *spare)
            pose = back
        d.qpos[at : at + 3], d.qpos[at + 3 : at + 7] = pose
        return
