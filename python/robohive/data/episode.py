"""An episode as learning programs expect it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Union

import numpy as np

from robohive.data._arrays import Array
from robohive.data.errors import DataError

Tree = Union[Array, Mapping[str, Any]]


@dataclass
class Episode:
    """An episode of ``n`` steps.

    Observations have ``n + 1`` rows, that after the last step included; where a dataset does not keep it, ``n``. Everything else
    that belongs to a step has ``n`` rows.
    """

    observations: Tree
    """An array, or a mapping of arrays."""
    actions: Tree
    """An array, or a mapping of arrays."""
    rewards: Array
    """Reward of each step, shape ``[n]``."""
    terminations: Array
    """Whether a step ended the episode for good, shape ``[n]``."""
    truncations: Array
    """Whether a step was the last one for another reason, shape ``[n]``."""
    infos: dict[str, Array] = field(default_factory=dict)
    """What else is known of the states: flat names with ``/`` in them, a row a state."""
    seed: int | None = None
    """Seed of the reset."""
    task: str | None = None
    """What the episode is an attempt at, in words."""

    def __len__(self) -> int:
        """Steps."""
        return len(self.rewards)

    def to_rows(self) -> dict[str, Array]:
        """The rows of RoboHive's layout, ``n + 1`` of them: that of the last state has NaN for its action.

        The first row has the reward 0, because no step led to it, unless ``infos`` have ``rwd_dense``, which is RoboHive's reward
        of every state.

        Raises:
            DataError: observations or actions are not one array, or the last observation is missing.
        """
        steps = len(self)
        parts = {}
        for name, tree, expected in (("observations", self.observations, steps + 1), ("actions", self.actions, steps)):
            if isinstance(tree, Mapping):
                raise DataError(f"{name}: RoboHive's layout has one array, not a mapping")
            array = np.asarray(tree)
            if len(array) != expected:
                raise DataError(f"{name}: {len(array)} rows, where {steps} steps need {expected}")
            parts[name] = array
        actions = parts["actions"]
        kind = actions.dtype if actions.dtype.kind == "f" else np.dtype(np.float64)
        last = np.full((1, *actions.shape[1:]), np.nan, dtype=kind)
        rewards = np.asarray(self.rewards, dtype=np.float64)
        first = self.infos["rwd_dense"].ravel()[:1] if "rwd_dense" in self.infos else np.zeros(1)
        ends = np.asarray(self.terminations, dtype=bool)
        rows = {
            "observations": parts["observations"],
            "actions": np.concatenate([actions.astype(kind), last]),
            "rewards": np.concatenate([first.astype(np.float64), rewards]),
            "done": np.concatenate([[False], ends]),
        }
        if "time" in self.infos:
            rows["time"] = np.asarray(self.infos["time"], dtype=np.float64).reshape(steps + 1)
        rows.update({f"env_infos/{key}": np.asarray(value) for key, value in self.infos.items()})
        return rows


def leaves(name: str, tree: Tree | tuple[Any, ...]) -> Iterator[tuple[str, Array]]:
    """Flat names and arrays of an array, or of mappings and tuples of arrays."""
    if isinstance(tree, Mapping):
        for key, value in tree.items():
            yield from leaves(f"{name}/{key}", value)
    elif isinstance(tree, tuple):
        for i, value in enumerate(tree):
            yield from leaves(f"{name}/_index_{i}", value)
    else:
        yield name, np.asarray(tree)


def nested(flat: Mapping[str, Array]) -> Tree:
    """Mappings of mappings from flat names with ``/`` in them."""
    out: dict[str, Any] = {}
    for key, array in flat.items():
        *folders, last = key.split("/")
        inner = out
        for folder in folders:
            inner = inner.setdefault(folder, {})
        inner[last] = array
    return out
