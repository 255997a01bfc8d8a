"""Trajectories of many initial states under given controls, on threads."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robohive.mujoco import _engine as _core
from robohive.mujoco.enums.physics import mjtState
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel
from robohive.whole_numbers import whole

_FULL = int(mjtState.mjSTATE_FULLPHYSICS)


def rollout(
    model: MjModel | Sequence[MjModel],
    data: MjData | Sequence[MjData],
    initial_state: ArrayLike,
    control: ArrayLike | None = None,
    *,
    control_spec: int = mjtState.mjSTATE_CTRL,
    skip_checks: bool = False,
    nstep: int | None = None,
    initial_warmstart: ArrayLike | None = None,
    state: NDArray[np.float64] | None = None,
    sensordata: NDArray[np.float64] | None = None,
    chunk_size: int | None = None,
    persistent_pool: bool = False,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Rolls out trajectories.

    Args:
        model: one model, or one for each trajectory, all of the same sizes.
        data: one simulation for each thread.
        initial_state: `(nbatch, nstate)`, states of signature `mjSTATE_FULLPHYSICS`; one row serves all trajectories.
        control: `(nbatch, nstep, ncontrol)`; one trajectory or one step serves all.
        control_spec: what the controls set (`mjtState`).
        skip_checks: more models than initial states are no error; shapes are always checked.
        nstep: steps of a trajectory where `control` does not say.
        initial_warmstart: `(nbatch, nv)`.
        state: takes the states, `(nbatch, nstep, nstate)`.
        sensordata: takes the sensor readings, `(nbatch, nstep, nsensordata)`.
        chunk_size: accepted; threads take trajectories in turn.
        persistent_pool: accepted; threads cost less than a trajectory.

    Returns:
        States and sensor readings after every step.

    Raises:
        ValueError: shapes contradict each other; `nstep` is no number of steps.
        FatalError: a trajectory is unstable. Where unstable simulations are reset, it ends there, and its last state is
            repeated.
    """
    if int(control_spec) & ~int(mjtState.mjSTATE_USER):
        raise ValueError("control_spec can only contain bits in mjSTATE_USER")
    datas = [data] if isinstance(data, MjData) else list(data)
    models = [model] if isinstance(model, MjModel) else list(model)
    if not datas:
        raise ValueError("The list of data instances is empty")
    first = models[0]
    nstate, ncontrol = _core.state_size(first, _FULL), _core.state_size(first, int(control_spec))
    start = _shaped("initial_state", initial_state, 2, nstate)
    warm = None if initial_warmstart is None else _shaped("initial_warmstart", initial_warmstart, 2, first.nv)
    inputs = None if control is None else _shaped("control", control, 3, ncontrol)
    outs = {
        "state": None if state is None else _shaped("state", state, 3, nstate),
        "sensordata": None if sensordata is None else _shaped("sensordata", sensordata, 3, first.nsensordata),
    }
    arrays = {"initial_state": start, "initial_warmstart": warm, "control": inputs, **outs}
    if skip_checks and len(models) > 1:
        models = models[: len(start)]
    nbatch = _common(0, max(len(models), 1), arrays)
    steps = _common(1, whole("nstep", nstep or 1, 1), {"control": inputs, **outs})
    if len(models) not in (1, nbatch):
        raise ValueError(f"{nbatch} trajectories need one model or {nbatch}, not {len(models)}")
    plan = {
        "nstep": steps,
        "state_spec": _FULL,
        "control_spec": int(control_spec),
        "initial_state": _tiled(start, (nbatch, nstate)),
        "initial_warmstart": None if warm is None else _tiled(warm, (nbatch, first.nv)),
        "control": None if inputs is None else _tiled(inputs, (nbatch, steps, ncontrol)),
    }
    states, sensors = _core.roll_out(models * nbatch if len(models) == 1 else models, datas, plan)
    states, sensors = states.reshape(nbatch, steps, nstate), sensors.reshape(nbatch, steps, first.nsensordata)
    if state is not None:
        state[...] = states.reshape(state.shape)
        states = state
    if sensordata is not None:
        sensordata[...] = sensors.reshape(sensordata.shape)
        sensors = sensordata
    return states, sensors


def _shaped(name: str, values: ArrayLike, axes: int, last: int) -> NDArray[np.float64]:
    array = np.asarray(values)
    if not np.issubdtype(array.dtype, np.number):
        raise ValueError(f"{name} must be a numpy array or float")
    if array.ndim > axes:
        raise ValueError(f"{name} can have at most {axes} dimensions")
    array = np.array(array, np.float64, ndmin=axes)
    if array.shape[-1] != last:
        raise ValueError(f"trailing dimension of {name} must be {last}, got {array.shape[-1]}")
    return array


def _common(axis: int, least: int, arrays: dict[str, Any]) -> int:
    """The length of an axis that all arrays agree on; one is as good as any."""
    found = least
    for name, array in arrays.items():
        length = 1 if array is None else array.shape[axis]
        if length not in (1, found) and found != 1:
            raise ValueError(f"dimension {axis} inferred as {found} but {name} has {length}")
        found = max(found, length) if length != 1 else found
    return found


def _tiled(array: NDArray[np.float64], shape: tuple[int, ...]) -> NDArray[np.float64]:
    return np.ascontiguousarray(np.broadcast_to(array, shape))


class Rollout:
    """Rolls out with a number of threads, one for each simulation of a call; with `nthread` 0, in the caller's. A context
    manager."""

    def __init__(self, *, nthread: int | None = None) -> None:
        self.nthread = whole("nthread", nthread or 0)
        self._open = True

    def rollout(self, *args: Any, **options: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """See `rollout`.

        Raises:
            RuntimeError: the object is closed.
            ValueError: there are not as many simulations as threads.
        """
        if not self._open:
            raise RuntimeError("this Rollout is closed")
        data = args[1] if len(args) > 1 else options.get("data")
        count = 1 if isinstance(data, MjData) or data is None else len(data)
        if count and self.nthread == 0 and count > 1:
            raise ValueError("More than one data instance passed but rollout is configured to run on main thread")
        if count and self.nthread and count != self.nthread:
            raise ValueError(f"Length of data: {count} not equal to nthread: {self.nthread}")
        return rollout(*args, **options)

    def close(self) -> None:
        """Ends the use."""
        self._open = False

    def __enter__(self) -> "Rollout":
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


def shutdown_persistent_pool() -> None:
    """There is no pool that persists."""
