"""Stages with callbacks inside: gains, biases and dynamics of actuators of type `user`, and pairs of geoms that may touch."""

from numbers import Real
from operator import index

import numpy as np

from robohive.mujoco import _engine as _core
from robohive.mujoco import callbacks
from robohive.mujoco.functions.out import Vector
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel


def _ask(name: str, numbers: list[int], m: MjModel, d: MjData, default: float) -> Vector:
    """What a callback says of these actuators; of the others, and without a callback, the default."""
    out = np.full(m.nactuator, default)
    callback = callbacks._set.get(name)
    if callback is None:
        return out
    for i in numbers:
        value = callback(m, d, i)
        if not isinstance(value, Real):
            raise TypeError(f"{name} callback did not return a number")
        out[i] = value
    return out


def actuation(m: MjModel, d: MjData) -> None:
    """`mj_fwdActuation`: rates of activation are asked for first, one for each actuator with one activation; a callback of
    an actuator with more writes them into `act_dot`. Then all gains and all biases are asked for."""
    dynamics, gains, biases = _core.actuator_rates(m, d)
    if dynamics and callbacks._set.get("mjcb_act_dyn") is not None:
        first, count = m.actuator_actadr, m.actuator_actnum
        for i in dynamics:
            rate = _ask("mjcb_act_dyn", [i], m, d, 0.0)[i]
            if count[i] == 1:
                d.act_dot[first[i]] = rate
    gain = _ask("mjcb_act_gain", gains, m, d, 1.0)
    _core.actuator_forces(m, d, gain.tolist(), _ask("mjcb_act_bias", biases, m, d, 0.0).tolist())


def contacts(m: MjModel, d: MjData, alone: bool) -> None:
    """`mj_collision`, or `mj_fwdPosition` where not `alone`, with the pairs of geoms that `mjcb_contactfilter` lets through.
    While it is asked there are no contacts yet; bodies and predefined pairs are chosen without it."""
    known: dict[tuple[int, int], bool] = {}
    while unknown := _core.collide_known(m, d, alone, known):
        callback = callbacks._set.get("mjcb_contactfilter")
        for pair in unknown:
            answer = 0 if callback is None else callback(m, d, *pair)
            try:
                known[pair] = index(answer) == 0
            except TypeError:
                raise TypeError("mjcb_contactfilter callback did not return an integer") from None
