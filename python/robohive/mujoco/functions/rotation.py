"""Quaternions (w, x, y, z), rotation matrices (row-major, 9) and poses; results are written into the first argument."""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robohive.mujoco import _engine as _core
from robohive.mujoco.functions.out import Vector, destination, vector, write


def _put(res: Any, name: str, size: int, values: ArrayLike) -> None:
    destination(res, name, f"size {size}", (size,))
    write(res, values)


def mju_mulQuat(res: Vector, quat1: ArrayLike, quat2: ArrayLike) -> None:
    """Product of two quaternions."""
    _put(res, "res", 4, _core.multiply(vector(quat1, "quat1", 4), vector(quat2, "quat2", 4)))


def mju_mulQuatAxis(res: Vector, quat: ArrayLike, axis: ArrayLike) -> None:
    """Product of a quaternion and `(0, axis)`."""
    _put(res, "res", 4, _core.multiply_axis(vector(quat, "quat", 4), vector(axis, "axis", 3)))


def mju_negQuat(res: Vector, quat: ArrayLike) -> None:
    """Conjugate."""
    _put(res, "res", 4, _core.conjugate(vector(quat, "quat", 4)))


def mju_rotVecQuat(res: Vector, vec: ArrayLike, quat: ArrayLike) -> None:
    """Turns a vector."""
    _put(res, "res", 3, _core.rotate(vector(vec, "vec", 3), vector(quat, "quat", 4)))


def mju_quat2Mat(res: Vector, quat: ArrayLike) -> None:
    """Rotation matrix of a quaternion."""
    _put(res, "res", 9, _core.matrix(vector(quat, "quat", 4)))


def mju_axisAngle2Quat(res: Vector, axis: ArrayLike, angle: float) -> None:
    """Quaternion of a rotation about a unit axis [rad]."""
    _put(res, "res", 4, _core.of_axis_angle(vector(axis, "axis", 3), angle))


def mju_quat2Vel(res: Vector, quat: ArrayLike, dt: float) -> None:
    """Angular velocity that makes this rotation in `dt` [s]."""
    _put(res, "res", 3, _core.velocity(vector(quat, "quat", 4), dt))


def mju_subQuat(res: Vector, qa: ArrayLike, qb: ArrayLike) -> None:
    """The rotation vector from `qb` to `qa`, in the frame of `qb`."""
    _put(res, "res", 3, _core.subtract(vector(qa, "qa", 4), vector(qb, "qb", 4)))


def mju_quatIntegrate(quat: Vector, vel: ArrayLike, scale: float) -> None:
    """Turns a quaternion by a local angular velocity for `scale` seconds."""
    _put(quat, "quat", 4, _core.integrate(vector(quat, "quat", 4), vector(vel, "vel", 3), scale))


def mju_normalize4(vec: Vector) -> float:
    """Scales to unit length and returns the length; zeros become the identity."""
    length = math.sqrt(sum(x * x for x in vector(vec, "vec", 4).tolist()))
    _put(vec, "vec", 4, _core.normalise(vector(vec, "vec", 4)))
    return length


def mju_unit4(res: Vector) -> None:
    """The identity."""
    _put(res, "res", 4, [1.0, 0.0, 0.0, 0.0])


def mju_derivQuat(res: Vector, quat: ArrayLike, vel: ArrayLike) -> None:
    """Rate of change of a quaternion that turns with a local angular velocity."""
    half = 0.5 * np.array(_core.multiply_axis(vector(quat, "quat", 4), vector(vel, "vel", 3)))
    _put(res, "res", 4, half)


def mju_mat2Quat(quat: Vector, mat: ArrayLike) -> None:
    """Quaternion of a rotation matrix, from its largest component."""
    r = vector(np.ravel(mat), "mat", 9).reshape(3, 3)
    trace = r[0, 0] + r[1, 1] + r[2, 2]
    skew = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    q = np.empty(4)
    if trace > 0:
        twice = math.sqrt(1 + trace)
        q[0], q[1:] = 0.5 * twice, 0.5 * skew / twice
    else:
        i = int(np.argmax(np.diag(r)))
        j, k = (i + 1) % 3, (i + 2) % 3
        twice = math.sqrt(1 + r[i, i] - r[j, j] - r[k, k])
        q[0], q[i + 1] = 0.5 * skew[i] / twice, 0.5 * twice
        q[j + 1], q[k + 1] = 0.5 * (r[i, j] + r[j, i]) / twice, 0.5 * (r[i, k] + r[k, i]) / twice
    _put(quat, "quat", 4, _core.normalise(q))


def mju_quatZ2Vec(quat: Vector, vec: ArrayLike) -> None:
    """The shortest rotation from the z axis to `vec`."""
    target = vector(vec, "vec", 3)
    length = float(np.linalg.norm(target))
    if length < 1e-15:
        mju_unit4(quat)
        return
    target = target / length
    axis = np.array([-target[1], target[0], 0.0])
    sine = float(np.linalg.norm(axis))
    # Along the axis, upwards or downwards, any axis across it serves.
    axis = axis / sine if sine > 1e-10 else np.array([1.0, 0.0, 0.0])
    _put(quat, "quat", 4, _core.of_axis_angle(axis, math.atan2(sine, target[2])))


def mju_euler2Quat(quat: Vector, euler: ArrayLike, seq: str) -> None:
    """Quaternion of three rotations [rad] about the axes of `seq`: xyz of the moving frame, XYZ of the fixed one.

    Raises:
        FatalError: `seq` is not three of these letters.
    """
    if len(seq) != 3:
        raise _core.FatalError("mju_euler2Quat: seq must contain exactly 3 characters")
    for place, letter in enumerate(seq):
        if letter not in "xyzXYZ":
            raise _core.FatalError(f"mju_euler2Quat: seq[{place}] is '{letter}', should be one of x, y, z, X, Y, Z")
    total = [1.0, 0.0, 0.0, 0.0]
    for letter, angle in zip(seq, vector(euler, "euler", 3).tolist(), strict=True):
        axis = np.eye(3)["xyz".index(letter.lower())]
        turn = _core.of_axis_angle(axis, angle)
        total = _core.multiply(total, turn) if letter.islower() else _core.multiply(turn, total)
    _put(quat, "quat", 4, total)


def mju_mulPose(
    posres: Vector, quatres: Vector, pos1: ArrayLike, quat1: ArrayLike, pos2: ArrayLike, quat2: ArrayLike
) -> None:
    """One pose after another."""
    q1, p1 = vector(quat1, "quat1", 4), vector(pos1, "pos1", 3)
    pos = p1 + np.array(_core.rotate(vector(pos2, "pos2", 3), q1))
    mju_mulQuat(quatres, q1, quat2)
    _put(posres, "posres", 3, pos)


def mju_negPose(posres: Vector, quatres: Vector, pos: ArrayLike, quat: ArrayLike) -> None:
    """The inverse of a pose."""
    back = _core.conjugate(vector(quat, "quat", 4))
    _put(posres, "posres", 3, -np.array(_core.rotate(vector(pos, "pos", 3), back)))
    _put(quatres, "quatres", 4, back)


def mju_trnVecPose(res: Vector, pos: ArrayLike, quat: ArrayLike, vec: ArrayLike) -> None:
    """A point of a frame in the frame around it."""
    _put(res, "res", 3, vector(pos, "pos", 3) + np.array(_core.rotate(vector(vec, "vec", 3), vector(quat, "quat", 4))))


def mju_eig3(eigval: Vector, eigvec: Vector, quat: Vector, mat: ArrayLike) -> int:
    """Eigenvalues of a symmetric matrix, falling, eigenvectors as columns, and the quaternion of these."""
    values, frame = _core.eigen(vector(np.ravel(mat), "mat", 9))
    _put(eigval, "eigval", 3, values)
    _put(eigvec, "eigvec", 9, _core.matrix(frame))
    _put(quat, "quat", 4, frame)
    return 0


def mj_local2Global(d: Any, xpos: Vector, xmat: Vector, pos: ArrayLike, quat: ArrayLike, body: int, sameframe: int) -> None:
    """Pose in the world of a frame given in that of a body.

    Raises:
        NotImplementedError: `sameframe` is not 0; then nothing is to compute, and MuJoCo copies the body's pose.
    """
    if sameframe:
        raise NotImplementedError("mj_local2Global with sameframe other than 0")
    turned = _core.multiply(d.xquat[body], vector(quat, "quat", 4))
    mju_quat2Mat(xmat, turned)
    _put(xpos, "xpos", 3, d.xpos[body] + d.xmat[body].reshape(3, 3) @ vector(pos, "pos", 3))
