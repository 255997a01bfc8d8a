"""Controllers: what solves tasks without learning.

>>> import robohive
>>> from robohive.control import controllers
>>> env = robohive.make("hive/FrankaReach-v0")
>>> [name for name, _ in controllers("hive/FrankaReach-v0")]
['reach']
>>> controller = env.controller("reach")
>>> observation, info = env.reset(seed=3)
>>> controller.reset(seed=3)
>>> while not info["solved"]:
...     observation, reward, terminated, truncated, info = env.step(controller.act())
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from robohive import _core
from robohive.whole_numbers import whole

__all__ = ["Controller", "controllers"]

if TYPE_CHECKING:
    from robohive.envs import RoboHiveEnv


def controllers(id: str | None = None) -> list[tuple[str, str]]:
    """Names and one-line summaries of the controllers that serve an id, the best first; of all, without an id.

    Raises:
        gymnasium.error.NameNotFound: there is no such id; the nearest is named.
    """
    return _core.controllers(id)


class Controller:
    """Acts in one environment, whose model and state it sees.

    Actions follow from the environment's state, from what the controller remembers since `reset`, and from the seed given
    there alone, so that episodes repeat. It is a policy of `RoboHiveEnv.examine_policy` too, by `get_action`.
    """

    def __init__(self, env: RoboHiveEnv, name: str) -> None:
        """Makes the controller of a name for an environment; `RoboHiveEnv.controller` does the same.

        Raises:
            ValueError: there is no such controller, it serves other tasks, or the environment lacks what it needs.
        """
        self.name = name
        self._env = env
        self._core = _core.Controller(name, env._core)
        # Time of the environment at the last call, which only a new episode sets back.
        self._time = float("inf")

    def reset(self, seed: int = 0) -> None:
        """Prepares for the episode that the environment's `reset` has just begun.

        Args:
            seed: Decides the controller's own draws, if it makes any.

        Raises:
            ValueError: the state admits no plan.
            RuntimeError: a method found no solution.
        """
        self._core.reset(self._env._core, whole("seed", seed, 0, 2**64 - 1))
        self._time = self._env.time

    def act(self) -> NDArray[np.float32]:
        """The action for the present state, as long as the environment's and in the units of its action space.

        In an episode for which it was not reset, it calls `reset()` first.

        Raises:
            RuntimeError: no action can be computed.
        """
        if self._env.time < self._time:
            self.reset()
        self._time = self._env.time
        return self._core.act(self._env._core).astype(np.float32)

    def get_action(self, observation: NDArray[Any]) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """The action for the present state, by mjrl's protocol; `observation` is not looked at."""
        action = self.act()
        return action, {"evaluation": action}
