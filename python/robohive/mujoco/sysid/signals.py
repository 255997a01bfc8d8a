"""Which columns of an array are which signal: of sensors, of states, of controls."""

from __future__ import annotations

import enum
import json
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.enums.elements import mjtObj
from robohive.mujoco.functions.naming import mj_id2name, mj_name2id
from robohive.mujoco.structs.model import MjModel


class SignalType(enum.Enum):
    """What a signal is."""

    MjSensor = 0
    CustomObs = 1
    MjStateQPos = 2
    MjStateQVel = 3
    MjStateAct = 4
    MjCtrl = 5


#: Types and columns of signals, by their names.
SignalMappingType: TypeAlias = dict[str, tuple[SignalType, NDArray[np.int64]]]
#: The name of a signal, with its type where the name alone could be several.
SignalName: TypeAlias = "str | tuple[str, SignalType]"

#: What is appended to the name of a joint, body or actuator.
_ENDINGS = {
    SignalType.MjStateQPos: "_qpos",
    SignalType.MjStateQVel: "_qvel",
    SignalType.MjStateAct: "_act",
    SignalType.MjCtrl: "_ctrl",
}
#: Numbers of position and velocity by the type of a joint: free, ball, slide, hinge.
_WIDTHS = ((7, 6), (4, 3), (1, 1), (1, 1))
_FREE = 0


def encode_signal_mapping(signal_mapping: SignalMappingType) -> str:
    """A mapping as JSON, so that archives need no pickles."""
    return json.dumps(
        {name: [kind.value, np.asarray(at).astype(int).tolist()] for name, (kind, at) in signal_mapping.items()}
    )


def decode_signal_mapping(encoded: str) -> SignalMappingType:
    """Reads what `encode_signal_mapping` wrote."""
    return {name: (SignalType(kind), np.asarray(at, np.int64)) for name, (kind, at) in json.loads(encoded).items()}


def _run(start: int, count: int) -> NDArray[np.int64]:
    return np.arange(start, start + count, dtype=np.int64)


def _called(name: str | None, what: str, number: int) -> str:
    """A name for an element that may have none."""
    return name or f"{what} {number}"


def sensor_signals(model: MjModel) -> SignalMappingType:
    """Columns of `sensordata`."""
    places = zip(model.sensor_adr, model.sensor_dim, strict=True)
    return {
        _called(mj_id2name(model, mjtObj.mjOBJ_SENSOR, i), "sensor", i): (
            SignalType.MjSensor,
            _run(int(start), int(count)),
        )
        for i, (start, count) in enumerate(places)
    }


def control_signals(model: MjModel) -> SignalMappingType:
    """Columns of `ctrl`."""
    return {
        f"{_called(model.actuator(i).name, 'actuator', i)}_ctrl": (SignalType.MjCtrl, _run(i, 1))
        for i in range(model.nu)
    }


def joint_signals(model: MjModel) -> tuple[SignalMappingType, SignalMappingType]:
    """Columns of positions and velocities in `(qpos, qvel, act)`. Free joints have the names of their bodies, and come first."""
    positions: SignalMappingType = {}
    velocities: SignalMappingType = {}
    for joint in sorted(range(model.njnt), key=lambda i: model.jnt_type[i] != _FREE):
        kind = int(model.jnt_type[joint])
        body = int(model.jnt_bodyid[joint])
        free = kind == _FREE
        name = (
            _called(model.body(body).name, "body", body) if free else _called(model.joint(joint).name, "joint", joint)
        )
        wide, fast = _WIDTHS[kind]
        positions[f"{name}_qpos"] = (SignalType.MjStateQPos, _run(int(model.jnt_qposadr[joint]), wide))
        velocities[f"{name}_qvel"] = (SignalType.MjStateQVel, _run(model.nq + int(model.jnt_dofadr[joint]), fast))
    return positions, velocities


def activation_signals(model: MjModel) -> SignalMappingType:
    """Columns of activations in `(qpos, qvel, act)`, of actuators that have any."""
    offset = model.nq + model.nv
    return {
        f"{_called(model.actuator(i).name, 'actuator', i)}_act": (
            SignalType.MjStateAct,
            _run(offset + int(start), int(count)),
        )
        for i, (start, count) in enumerate(zip(model.actuator_actadr, model.actuator_actnum, strict=True))
        if start >= 0
    }


def named_signals(model: MjModel, names: Sequence[SignalName], allowed: set[SignalType]) -> SignalMappingType:
    """Signals whose columns stand one after the other, in the order of their names.

    Args:
        model: where sensors, actuators, joints and bodies are looked up, in this order.
        names: with or without `_qpos`, `_qvel`, `_act`, `_ctrl`.
        allowed: types that they may have.

    Raises:
        ValueError: there is no such signal, or it is of another type.
    """
    found: SignalMappingType = {}
    start = 0
    for item in names:
        name, wanted = (item, None) if isinstance(item, str) else item
        if wanted is not None and wanted not in allowed:
            raise ValueError(
                f"signal '{name}' is declared as {wanted.name}, which is not allowed here; {_listed(allowed)}"
            )
        kinds = [kind for kind in _ORDER if kind in allowed and wanted in (None, kind)]
        widths = ((kind, _width(model, _base(name, kind), kind)) for kind in kinds)
        match = next(((kind, width) for kind, width in widths if width), None)
        if match is None:
            raise ValueError(f"Could not resolve signal {item!r}: the model has none of this name; {_listed(allowed)}")
        kind, width = match
        found[_base(name, kind) + _ENDINGS.get(kind, "")] = (kind, _run(start, width))
        start += width
    return found


_ORDER = (
    SignalType.MjSensor,
    SignalType.MjCtrl,
    SignalType.MjStateQPos,
    SignalType.MjStateQVel,
    SignalType.MjStateAct,
)


def _listed(allowed: set[SignalType]) -> str:
    return "types are " + ", ".join(sorted(kind.name for kind in allowed))


def _base(name: str, kind: SignalType) -> str:
    return name.removesuffix(_ENDINGS[kind]) if kind in _ENDINGS else name


def _width(model: MjModel, name: str, kind: SignalType) -> int:
    """How many numbers a signal has, 0 where the model has no such."""
    if kind is SignalType.MjSensor:
        sensor = mj_name2id(model, mjtObj.mjOBJ_SENSOR, name)
        return int(model.sensor_dim[sensor]) if sensor >= 0 else 0
    if kind in (SignalType.MjCtrl, SignalType.MjStateAct):
        actuator = mj_name2id(model, mjtObj.mjOBJ_ACTUATOR, name)
        if actuator < 0:
            return 0
        return 1 if kind is SignalType.MjCtrl else int(model.actuator_actnum[actuator])
    side = 0 if kind is SignalType.MjStateQPos else 1
    joint = mj_name2id(model, mjtObj.mjOBJ_JOINT, name)
    if joint >= 0:
        return _WIDTHS[int(model.jnt_type[joint])][side]
    body = mj_name2id(model, mjtObj.mjOBJ_BODY, name)
    return _WIDTHS[_FREE][side] if body >= 0 and model.body_dofnum[body] == 6 else 0
