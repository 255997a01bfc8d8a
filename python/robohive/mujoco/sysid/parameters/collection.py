"""Parameters that are fitted together, as one vector."""

from __future__ import annotations

import copy
import os
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robohive.mujoco.sysid.optional import needed
from robohive.mujoco.sysid.parameters.comparison import comparison
from robohive.mujoco.sysid.parameters.value import Parameter, Vector


class ParameterDict:
    """Parameters by their names, in the order in which they were added. Vectors have the numbers of those that are not
    frozen, one parameter after the other."""

    def __init__(self, parameters: dict[str, Parameter] | None = None) -> None:
        self.parameters: dict[str, Parameter] = {} if parameters is None else parameters

    def __getitem__(self, key: str) -> Parameter:
        return self.parameters[key]

    def __setitem__(self, key: str, value: Parameter) -> None:
        self.parameters[key] = value

    def __contains__(self, key: str) -> bool:
        return key in self.parameters

    def __len__(self) -> int:
        return len(self.parameters)

    def copy(self) -> ParameterDict:
        """A copy of all parameters."""
        return copy.deepcopy(self)

    def add(self, param: Parameter) -> None:
        """Adds one, in the place of that of the same name if there is one."""
        self.parameters[param.name] = param

    def update(self, pdict: ParameterDict) -> None:
        """Adds those of another.

        Raises:
            ValueError: both have one of the same name.
        """
        for name, param in pdict.items():
            if name in self.parameters:
                raise ValueError(f"there is a parameter '{name}' already; rename one of the two")
            self.parameters[name] = param

    def keys(self) -> list[str]:
        """Names."""
        return list(self.parameters)

    def values(self) -> list[Parameter]:
        """Parameters."""
        return list(self.parameters.values())

    def items(self) -> list[tuple[str, Parameter]]:
        """Names and parameters."""
        return list(self.parameters.items())

    def _free(self) -> Iterator[Parameter]:
        return (param for param in self.parameters.values() if not param.frozen)

    @property
    def size(self) -> int:
        """How many numbers are fitted."""
        return sum(param.size for param in self._free())

    def as_vector(self, include_frozen: bool = False) -> Vector:
        """Values, `(size,)`, or of frozen parameters too."""
        chosen = self.values() if include_frozen else self._free()
        return np.concatenate([np.empty(0), *(param.as_vector() for param in chosen)])

    def as_nominal_vector(self, include_frozen: bool = False) -> Vector:
        """Nominal values, `(size,)`, or of frozen parameters too."""
        chosen = self.values() if include_frozen else self._free()
        return np.concatenate([np.empty(0), *(param.as_nominal_vector() for param in chosen)])

    def update_from_vector(self, vector: ArrayLike) -> None:
        """Sets the values of parameters that are not frozen.

        Args:
            vector: `(size,)`.

        Raises:
            ValueError: these are too few numbers.
        """
        numbers = np.asarray(vector, np.float64)
        ends = np.cumsum([param.size for param in self._free()])
        for param, end in zip(self._free(), ends, strict=True):
            param.update_from_vector(numbers[end - param.size : end])

    def move_off_bounds(self, fraction: float = 0.05, at_bound_tol: float = 1e-3) -> ParameterDict:
        """Moves parameters that are not frozen off their bounds (`Parameter.move_off_bound`), and returns itself."""
        for param in self._free():
            param.move_off_bound(fraction, at_bound_tol)
        return self

    def save_to_disk(self, path: str | os.PathLike[str]) -> None:
        """Writes a file of YAML.

        Raises:
            ImportError: pyyaml is not installed.
            OSError: the file cannot be written.
        """
        records = {name: param.__getstate__() for name, param in self.items()}
        text = needed("yaml", "pyyaml").safe_dump(records, sort_keys=False)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    @classmethod
    def load_from_disk(cls, path: str | os.PathLike[str]) -> ParameterDict:
        """Reads what `save_to_disk` wrote; parameters have no modifiers then.

        Raises:
            ImportError: pyyaml is not installed.
            OSError: the file cannot be read.
            ValueError: it is not a file of parameters.
        """
        with open(path, encoding="utf-8") as file:
            records: Any = needed("yaml", "pyyaml").safe_load(file)
        found = cls()
        try:
            for name, record in records.items():
                param = Parameter.__new__(Parameter)
                param.__setstate__(record)
                found[name] = param
        except (AttributeError, KeyError, TypeError) as error:
            raise ValueError(f"{os.fspath(path)} is not a file of parameters: {error!r}") from error
        return found

    def get_bounds(self) -> tuple[Vector, Vector]:
        """Lower and upper bounds, each `(size,)`."""
        bounds = [param.get_bounds() for param in self._free()]
        low, high = ([bound[side] for bound in bounds] for side in (0, 1))
        return np.concatenate([np.empty(0), *low]), np.concatenate([np.empty(0), *high])

    def reset(self) -> None:
        """Sets all values, of frozen parameters too, to the nominal ones."""
        for param in self.values():
            param.reset()

    def sample(self, rng: np.random.Generator | None = None) -> Vector:
        """Draws uniformly from within the bounds, `(size,)`; values stay."""
        low, high = self.get_bounds()
        return (np.random.default_rng() if rng is None else rng).uniform(low, high)

    def randomize(self, rng: np.random.Generator | None = None) -> None:
        """Sets the values of parameters that are not frozen to draws from within their bounds."""
        rng = np.random.default_rng() if rng is None else rng
        for param in self._free():
            param.update_from_vector(param.sample(rng))

    def compare_parameters(
        self,
        init_params: ArrayLike,
        predicted_params: ArrayLike,
        measured_params: ArrayLike | None = None,
        sig_digits: int = 4,
    ) -> str:
        """A table of values before and after a fit.

        Args:
            init_params: values before, `(size,)`.
            predicted_params: values after.
            measured_params: true values, if these are known.
            sig_digits: digits that are shown.

        Raises:
            ValueError: these are not as many numbers as are fitted.
        """
        columns = {"initial": init_params, "identified": predicted_params, "nominal": measured_params}
        numbers = {name: np.asarray(column, np.float64) for name, column in columns.items() if column is not None}
        for name, column in numbers.items():
            if column.size != self.size:
                raise ValueError(f"{name} values are {column.size} numbers, but {self.size} are fitted")
        return comparison(self.get_non_frozen_parameter_names(), numbers, self.get_bounds(), sig_digits)

    def get_non_frozen_parameter_names(self) -> list[str]:
        """A name for each number that is fitted, `hand_inertia[2]` for those of arrays."""
        return [name for param in self._free() for name in param.element_names()]

    def get_parameter_info(self) -> str:
        """A table of names, sizes and shapes."""
        rows = [f"{'name':<24}{'size':<8}{'shape':<12}frozen"]
        rows += [
            f"{name:<24}{param.size:<8}{param.shape!s:<12}{'yes' if param.frozen else 'no'}"
            for name, param in self.items()
        ]
        return "\n".join(rows)

    def __str__(self) -> str:
        lines = [f"  {line}" for param in self.values() for line in str(param).splitlines()]
        return "\n".join(["ParameterDict(", *lines, ")"])

    __repr__ = __str__
