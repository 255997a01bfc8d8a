"""The state in which a simulation begins."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robohive.mujoco.enums.physics import mjtState
from robohive.mujoco.functions.algebra import mj_getState, mj_stateSize
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.sysid.signals import SignalMappingType, activation_signals, joint_signals

Vector = NDArray[np.float64]


def create_initial_state(
    model: MjModel,
    qpos: ArrayLike,
    qvel: ArrayLike | None = None,
    act: ArrayLike | None = None,
    qpos_names: Sequence[str] | None = None,
    qvel_names: Sequence[str] | None = None,
    act_names: Sequence[str] | None = None,
) -> Vector:
    """A state of signature `mjSTATE_FULLPHYSICS`.

    Args:
        model: the model.
        qpos: positions, `(nq,)`, or those of `qpos_names` one after the other.
        qvel: velocities, `(nv,)`, or those of `qvel_names`; zeros where it is None.
        act: activations, `(na,)`, or those of `act_names`; zeros where it is None.
        qpos_names: signals, `elbow_qpos`; positions without one are as in the model.
        qvel_names: signals, `elbow_qvel`.
        act_names: signals, `muscle_act`.

    Raises:
        ValueError: numbers are too few or too many, or there is no such signal.
    """
    data = MjData(model)
    positions, velocities = joint_signals(model)
    parts = (
        ("qpos", data.qpos, qpos, qpos_names, positions, 0),
        ("qvel", data.qvel, qvel, qvel_names, velocities, model.nq),
        ("act", data.act, act, act_names, activation_signals(model), model.nq + model.nv),
    )
    for name, target, given, names, signals, offset in parts:
        if given is not None:
            _fill(
                name,
                target,
                np.ravel(np.asarray(given, np.float64)),
                _places(name, names, signals, offset, len(target)),
            )
        elif names is not None:
            raise ValueError(f"{name}_names name numbers of {name}, which is not given")
    state = np.empty(mj_stateSize(model, mjtState.mjSTATE_FULLPHYSICS))
    mj_getState(model, data, state, mjtState.mjSTATE_FULLPHYSICS)
    return state


def _places(
    what: str, names: Sequence[str] | None, signals: SignalMappingType, offset: int, count: int
) -> NDArray[np.int64]:
    """Where numbers go."""
    if names is None:
        return np.arange(count)
    unknown = [name for name in names if name not in signals]
    if unknown:
        raise ValueError(f"{what}_names: there is no signal '{unknown[0]}'; there are: {', '.join(signals) or 'none'}")
    return np.concatenate([np.empty(0, np.int64), *(signals[name][1] - offset for name in names)])


def _fill(what: str, target: Vector, numbers: Vector, places: NDArray[np.int64]) -> None:
    if len(numbers) != len(places):
        raise ValueError(f"{what} has {len(numbers)} numbers instead of {len(places)}")
    target[places] = numbers
