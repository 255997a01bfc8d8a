"""Gains of position actuators, in descriptions and models."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robohive.mujoco.enums.elements import mjtBias, mjtDyn, mjtGain, mjtObj
from robohive.mujoco.functions.naming import mj_name2id
from robohive.mujoco.spec import MjSpec
from robohive.mujoco.structs.model import MjModel


def is_position_actuator(actuator: Any) -> bool:
    """Whether an actuator, of a model or of a description, is a position actuator: `force = kp (ctrl - length) - kv velocity`."""
    kinds = (int(np.asarray(kind).item()) for kind in (actuator.gaintype, actuator.biastype, actuator.dyntype))
    gain, bias, dynamics = kinds
    return (
        (gain, bias) == (int(mjtGain.mjGAIN_FIXED), int(mjtBias.mjBIAS_AFFINE))
        and dynamics in (int(mjtDyn.mjDYN_NONE), int(mjtDyn.mjDYN_FILTEREXACT))
        and bool(np.ravel(actuator.gainprm)[0] == -np.ravel(actuator.biasprm)[1])
    )


def get_actuator_pd_gains(model: MjModel, actuator_name: str) -> tuple[float, float]:
    """`kp` and `kv` of a position actuator [N/m or N m/rad, times s].

    Raises:
        ValueError: there is no such actuator, or it is of another kind.
    """
    number = mj_name2id(model, mjtObj.mjOBJ_ACTUATOR, actuator_name)
    if number < 0:
        raise ValueError(f"the model has no actuator '{actuator_name}'")
    actuator = model.actuator(number)
    if not is_position_actuator(actuator):
        raise ValueError(_other(actuator_name))
    return -float(actuator.biasprm[1]), -float(actuator.biasprm[2])


def apply_pgain(spec: MjSpec, actuator_name: str, value: ArrayLike) -> MjSpec:
    """Sets `kp` of a position actuator, and returns the description.

    Raises:
        ValueError: there is no such actuator, it is of another kind, or the value is not one number.
    """
    actuator, gain = _position(spec, actuator_name), _number(value)
    actuator.gainprm[0], actuator.biasprm[1] = gain, -gain
    return spec


def apply_dgain(spec: MjSpec, actuator_name: str, value: ArrayLike) -> MjSpec:
    """Sets `kv` of a position actuator, and returns the description.

    Raises:
        ValueError: there is no such actuator, it is of another kind, or the value is not one number.
    """
    _position(spec, actuator_name).biasprm[2] = -_number(value)
    return spec


def apply_pdgain(spec: MjSpec, actuator_name: str, value: ArrayLike) -> MjSpec:
    """Sets `kp` and `kv` of a position actuator, and returns the description.

    Raises:
        ValueError: there is no such actuator, it is of another kind, or these are not two numbers.
    """
    gains = np.ravel(np.asarray(value, np.float64))
    if gains.size != 2:
        raise ValueError(f"kp and kv are two numbers, not {gains.size}")
    return apply_dgain(apply_pgain(spec, actuator_name, gains[0]), actuator_name, gains[1])


def _number(value: ArrayLike) -> float:
    numbers = np.asarray(value, np.float64)
    if numbers.size != 1:
        raise ValueError(f"a gain is one number, not {numbers.size}")
    return float(numbers.item())


def _position(spec: MjSpec, name: str) -> Any:
    actuator = spec.actuator(name)
    if actuator is None:
        raise ValueError(f"the description has no actuator '{name}'")
    if not is_position_actuator(actuator):
        raise ValueError(_other(name))
    return actuator


def _other(name: str) -> str:
    return f"actuator '{name}' is no position actuator: its force is not kp (ctrl - length) - kv velocity"
