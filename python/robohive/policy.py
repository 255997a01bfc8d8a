"""Policies: what was trained, by `robohive train` or for the original RoboHive.

>>> import robohive
>>> env = robohive.make("hive/myoElbowPose1D6MRandom-v0")
>>> policy = env.policy()
>>> observation, info = env.reset(seed=3)
>>> for _ in range(50):
...     observation, reward, terminated, truncated, info = env.step(policy.act())
>>> bool(info["solved"])
True
"""

from __future__ import annotations

from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from robohive import _core

__all__ = ["TrainedPolicy", "policies"]

if TYPE_CHECKING:
    from robohive.envs import RoboHiveEnv


def policies() -> list[str]:
    """Ids that a trained policy is shipped for."""
    return _core.policies()


class TrainedPolicy:
    """Acts in one environment by what is observed there.

    Actions are the means of the policy's distribution, so that episodes repeat. It is a policy of
    `RoboHiveEnv.examine_policy` too, by `get_action`.
    """

    def __init__(self, env: RoboHiveEnv, file: str | PathLike[str] | None = None) -> None:
        """Reads a policy for an environment; `RoboHiveEnv.policy` does the same.

        Args:
            file: A policy that `robohive train` wrote (safetensors), or a pickle of mjrl, which is not executed; without
                it, the policy that is shipped for the environment's id.

        Raises:
            ValueError: none is shipped for the id, or the file holds no policy.
            OSError: the file cannot be read.
        """
        self._env = env
        self._core = _core.Policy(str(env._about["id"]), file)

    def act(self) -> NDArray[np.float32]:
        """The action for the present observation, as long as the environment's and in the units of its action space.

        Raises:
            ValueError: the policy is one for another environment.
        """
        return self._core.act(self._env._core).astype(np.float32)

    def get_action(self, observation: NDArray[Any]) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """The action for the present state, by mjrl's protocol; `observation` is not looked at."""
        action = self.act()
        return action, {"evaluation": action}
