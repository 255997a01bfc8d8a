"""`MjData`: one simulation, whose arrays are numpy arrays that may be written."""

import copy
from typing import TYPE_CHECKING, Any, NoReturn
from weakref import WeakValueDictionary

import numpy as np

from robohive.mujoco import _engine as _core
from robohive.mujoco.structs import absent, named
from robohive.mujoco.structs.fields import declare
from robohive.mujoco.structs.contacts import MjContactList, contact_arrays
from robohive.mujoco.structs.lists import MjSolverStatList, MjTimerStatList, MjWarningStatList
from robohive.mujoco.structs.model import MjModel, _refuse

#: Numbers of MuJoCo's memory management, for which there is nothing here: what is written is kept, and has no effect.
_ZEROS = (
    "maxuse_arena maxuse_con maxuse_efc maxuse_stack narena nbuffer nplugin parena pbase pstack threadpool"
).split()
#: Attributes that may be set and are no arrays.
_SCALARS = ("time",)


class MjData(_core.Data, named.DataElements):
    """One simulation of a model.

    Arrays are attributes of MuJoCo's names, with MuJoCo's shapes. They keep their identity: `q = data.qpos` shows the
    new positions after `mj_step`. What is written is taken over by the next call that is given the data. Contacts and
    constraint rows (`contact`, `efc_*`, `island_*`) change their number with every step: their arrays are others after a
    call that changes the data.

    A call in one thread while another is at work with the same data raises a `RuntimeError`.
    """

    _shapes: dict[str, list[int]]
    _views: WeakValueDictionary[Any, Any]
    #: Arrays of elements that were asked for.
    _slices: dict[tuple[str, int, str], Any]

    def __new__(cls, model: MjModel) -> "MjData":
        if not isinstance(model, MjModel):
            raise TypeError(f"MjData is made of an MjModel, not of {type(model).__name__}")
        return super().__new__(cls, model)

    def __init__(self, model: MjModel) -> None:
        inner = self.__dict__
        inner["_views"] = WeakValueDictionary()
        inner["_slices"] = {}
        inner["_shapes"] = {name: shape for name, (_, shape) in self._describe().items()}

    @property
    def model(self) -> MjModel:
        """The model that the simulation was made of."""
        model: MjModel = self._model
        return model

    @property
    def _address(self) -> int:
        return id(self)

    def _look_up(self, name: str) -> Any:
        inner = self.__dict__
        if name in inner["_shapes"]:
            value = inner[name] = self._array(name)
            return value
        if name in _ZEROS:
            return inner.get(f"_{name}", 0)
        value = absent.of_data(name, self.model)
        if value is None:
            return self._changing(name)
        inner[name] = value
        return value

    if not TYPE_CHECKING:  # for checkers, what is not declared is an error

        def __getattr__(self, name: str) -> NoReturn:
            raise AttributeError(f"'mujoco.MjData' object has no attribute '{name}'")

    def _changing(self, name: str) -> Any:
        """What changes its length or value with every step."""
        counts = self._counts()
        if name in counts:
            return counts[name]
        if name.startswith("efc_J") and not self._is_sparse():
            return self._dense_jacobian(name, counts["nefc"])
        arrays = _core.constraints(self)
        if name == "nJ":
            return len(arrays["efc_J"]) if self._is_sparse() else counts["nefc"] * self.model.nv
        if name in arrays:
            # MuJoCo's arrays without rows own their (no) memory.
            return arrays[name] if len(arrays[name]) else np.zeros_like(arrays[name])
        islands = np.zeros(20, np.int32)
        values = _core.solver(self)[name][:20]
        islands[: len(values)] = values
        return _fixed(islands)

    def _dense_jacobian(self, name: str, rows: int) -> Any:
        """The Jacobian as MuJoCo has it with dense matrices, which the engine keeps in compressed rows all the same."""
        columns, kept = self.model.nv, _core.constraints(self)
        if name == "efc_J" and kept["efc_J_rownnz"].sum() != len(kept["efc_J"]):
            return kept["efc_J"]  # Room that was made, of which no row is filled yet.
        if name == "efc_J":
            return _core.dense_jacobian(self, columns)
        # The pattern is computed for sparse matrices only.
        return _fixed(np.zeros(rows * columns if name == "efc_J_colind" else rows, np.int32))

    def _is_sparse(self) -> bool:
        jacobian = self.model.opt.jacobian
        return jacobian == 1 or (jacobian == 2 and self.model.nv >= 60)

    def __setattr__(self, name: str, value: Any) -> None:
        if name in _SCALARS:
            super().__setattr__(name, value)
        elif name in self._shapes:
            getattr(self, name)[...] = value
        elif name in _ZEROS:
            self.__dict__[f"_{name}"] = int(value)
        else:
            _refuse(self, name)

    @property
    def contact(self) -> MjContactList:
        """The contacts of the last collision detection: a sequence, and an array for each field."""
        return MjContactList(lambda: contact_arrays(_core.contacts(self)))

    @property
    def warning(self) -> MjWarningStatList:
        """Counts of warnings since the last reset, by `mjtWarning`; they stay up to date and may be written."""
        inner = self.__dict__
        if "_warning" not in inner:
            inner["_warning"] = MjWarningStatList(self._array("warning.lastinfo"), self._array("warning.number"))
        warning: MjWarningStatList = inner["_warning"]
        return warning

    @property
    def timer(self) -> MjTimerStatList:
        """Timers [s], by `mjtTimer`: calls of `mj_step`, `mj_forward` and `mj_inverse`; all others are zero."""
        return MjTimerStatList(*self._timers())

    @property
    def solver(self) -> MjSolverStatList:
        """Statistics of the constraint solver: 200 iterations for each of 20 islands, zeros where there were fewer."""
        return MjSolverStatList(_core.solver(self))

    @property
    def signature(self) -> int:
        """The signature of the model."""
        return self.model.signature

    def bind(self, specs: Any) -> Any:
        """What the simulation says of an element of the `MjSpec` that its model was compiled of, or of a list of them.

        Raises:
            ValueError: the description was compiled again, or is another one.
        """
        from robohive.mujoco.spec.bind import bound

        return bound(self, self.model, specs)

    def __copy__(self) -> "MjData":
        duplicate = type(self)(self.model)
        duplicate._assign(self)
        return duplicate

    def __deepcopy__(self, memo: dict[int, Any]) -> "MjData":
        duplicate = type(self)(copy.deepcopy(self.model, memo))
        duplicate._assign(self)
        memo[id(self)] = duplicate
        return duplicate

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickle, (self.model, self._dump())


_ARRAYS, _CHANGING = _core.data_fields()
declare(MjData, (*_ARRAYS, *_CHANGING, *_ZEROS, *absent.DATA_NAMES, "model", "nJ", "solver_niter", "solver_nnz"))


def _unpickle(model: MjModel, arrays: dict[str, Any]) -> MjData:
    data = MjData(model)
    data._restore(arrays)
    return data


def _fixed(array: Any) -> Any:
    array.flags.writeable = False
    return array
