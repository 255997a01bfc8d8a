"""One quantity that is fitted."""

from __future__ import annotations

import copy
import enum
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robohive.mujoco.spec import MjSpec

Vector: TypeAlias = NDArray[np.float64]
#: What writes a parameter into a description.
ModifierFn: TypeAlias = Callable[[MjSpec, "Parameter"], object]

#: What a file of parameters holds of each, beside its name.
_ARRAYS = ("nominal", "min_value", "max_value", "value")


class InertiaType(enum.Enum):
    """Which numbers describe a body's inertia: its mass; mass and centre of mass; or all ten, by `inertia.pi_from_theta`."""

    Mass = 0
    MassIpos = 1
    Pseudo = 2


class Parameter:
    """A number, or an array of numbers, with bounds; `modifier` writes it into a description.

    Attributes:
        nominal: what is held to be right before the fit; `reset` goes back to it.
        value: what it is now, of the shape of `nominal`.
        min_value: lower bounds, of that shape.
        max_value: upper bounds.
        frozen: it is left as it is: fits skip it, and so do modifiers.
        inertia_type: which inertia it is, None of other parameters.
        scale_rot_inertia: the rotational inertia grows with the mass.
    """

    inertia_type: InertiaType | None = None
    scale_rot_inertia: bool = False

    def __init__(
        self,
        name: str,
        nominal: ArrayLike,
        min_value: ArrayLike,
        max_value: ArrayLike,
        frozen: bool = False,
        modifier: ModifierFn | None = None,
    ) -> None:
        self.name, self.frozen, self.modifier = name, frozen, modifier
        self.nominal, self.min_value, self.max_value = (
            np.atleast_1d(np.array(numbers, np.float64)) for numbers in (nominal, min_value, max_value)
        )
        self.value: Vector = self.nominal.copy()

    @property
    def size(self) -> int:
        """How many numbers it is."""
        return int(self.nominal.size)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of its arrays, `(1,)` for a number."""
        return self.nominal.shape

    def apply_modifier(self, spec: MjSpec) -> None:
        """Writes it into a description, where it has a modifier."""
        if self.modifier is not None:
            self.modifier(spec, self)

    def as_vector(self) -> Vector:
        """A copy of its value, `(size,)`."""
        return self.value.flatten()

    def as_nominal_vector(self) -> Vector:
        """A copy of its nominal value, `(size,)`."""
        return self.nominal.flatten()

    def update_from_vector(self, vector: ArrayLike) -> None:
        """Sets its value.

        Args:
            vector: `(size,)`.

        Raises:
            ValueError: these are not as many numbers as the parameter has.
        """
        numbers = np.array(vector, np.float64).ravel()
        if numbers.size != self.size:
            raise ValueError(f"parameter '{self.name}' has {self.size} numbers, not {numbers.size}")
        self.value = numbers.reshape(self.shape)

    def get_bounds(self) -> tuple[Vector, Vector]:
        """Lower and upper bounds, each `(size,)`."""
        return self.min_value.flatten(), self.max_value.flatten()

    def reset(self) -> None:
        """Sets the value to the nominal one."""
        self.value = self.nominal.copy()

    def sample(self, rng: np.random.Generator | None = None) -> Vector:
        """Draws uniformly from within the bounds, `(size,)`; the value stays."""
        low, high = self.get_bounds()
        return (np.random.default_rng() if rng is None else rng).uniform(low, high)

    def move_off_bound(self, fraction: float = 0.05, at_bound_tol: float = 1e-3) -> None:
        """Moves numbers that are at a bound inside.

        Args:
            fraction: how far, as a share of the distance of the bounds.
            at_bound_tol: how near to a bound is at it, as such a share.
        """
        low, high = self.get_bounds()
        width = high - low
        near = at_bound_tol * np.where(width > 0, width, 1.0)
        value = self.as_vector()
        value[value - low <= near] = (low + fraction * width)[value - low <= near]
        value[high - value <= near] = (high - fraction * width)[high - value <= near]
        self.update_from_vector(value)

    def element_names(self) -> list[str]:
        """A name for each number: the parameter's own, with indices where it has several."""
        if self.size == 1:
            return [self.name]
        return [f"{self.name}[{','.join(map(str, index))}]" for index in np.ndindex(self.shape)]

    def __str__(self) -> str:
        low, high = self.get_bounds()
        numbers = zip(self.element_names(), self.as_vector(), low, high, strict=True)
        return "\n".join(f"{name}: {value:.3g} ∈ [{least:.3g}, {most:.3g}]" for name, value, least, most in numbers)

    __repr__ = __str__

    def __getstate__(self) -> dict[str, Any]:
        """Plain lists and numbers, for files and pickles; a modifier is code and stays behind."""
        return {"name": self.name, "frozen": bool(self.frozen), **{key: getattr(self, key).tolist() for key in _ARRAYS}}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(state["name"], *(state[key] for key in _ARRAYS[:3]), frozen=bool(state["frozen"]))  # type: ignore[misc]
        self.value = np.array(state["value"], np.float64).reshape(self.shape)

    def __deepcopy__(self, memo: dict[int, Any]) -> Parameter:
        other = Parameter.__new__(type(self))
        memo[id(self)] = other
        other.__dict__.update({key: copy.deepcopy(value, memo) for key, value in self.__dict__.items()})
        return other
