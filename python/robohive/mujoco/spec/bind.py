"""Elements of a description in the model that was compiled of it, and in simulations: `model.bind(geom).pos`."""

from typing import Any

import numpy as np

#: What accessors call kinds of elements that descriptions call otherwise.
_ACCESSORS = {"key": "keyframe"}
_MISMATCH = "The mjSpec does not match mjModel. Please recompile the mjSpec."


def bound(owner: Any, model: Any, elements: Any) -> Any:
    """The view of an element, or of several, in a model or a simulation.

    Raises:
        ValueError: an element is not part of the description as the model was compiled of it.
    """
    if not isinstance(elements, (list, tuple)):
        return _view(owner, model, elements)
    return _Several([_view(owner, model, element) for element in elements], type(owner).__name__)


def _view(owner: Any, model: Any, element: Any) -> Any:
    stamp = model.__dict__.get("_stamp")
    if stamp is None or element._stamp is not stamp:
        raise ValueError(_MISMATCH)
    kind: str = element._kind
    return getattr(owner, _ACCESSORS.get(kind, kind))(element._id)


class _Several:
    """Several elements; their attributes are arrays with the rows of all."""

    __slots__ = ("_owner", "_views")

    def __init__(self, views: list[Any], owner: str) -> None:
        object.__setattr__(self, "_views", views)
        object.__setattr__(self, "_owner", owner)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        if not self._views:
            return np.zeros(0)
        if not all(hasattr(view, name) for view in self._views):
            raise AttributeError(f"'{self._owner}' object has no attribute '{name}'")
        rows = [np.atleast_1d(getattr(view, name)) for view in self._views]
        together = all(row.ndim == 1 and row.size == 1 for row in rows) or len({row.shape for row in rows}) > 1
        return np.concatenate(rows) if together else np.stack(rows)

    def __setattr__(self, name: str, value: Any) -> None:
        rows = [np.atleast_1d(getattr(view, name)) for view in self._views]
        given = np.asarray(value)
        if given.ndim == 0 or len(given) != len(rows):
            given = np.broadcast_to(given, (len(rows), *given.shape)) if given.ndim == 0 else given
        taken = 0
        flat = len(given) == sum(row.size for row in rows) and given.ndim == 1
        for index, row in enumerate(rows):
            row[...] = given[taken : taken + row.size] if flat else given[index]
            taken += row.size
