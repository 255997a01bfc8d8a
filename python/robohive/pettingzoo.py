"""Environments of several agents, by PettingZoo's parallel API.

>>> from robohive.pettingzoo import parallel_env
>>> env = parallel_env("hive/DKittyPairPushBox-v0")
>>> observations, infos = env.reset(seed=0)
>>> actions = {agent: env.action_space(agent).sample() for agent in env.agents}
>>> observations, rewards, terminations, truncations, infos = env.step(actions)

`robohive.ids("multi_agent")` lists the ids. Each is an environment of Gymnasium too (`robohive.make`): the action has the
actions of all agents one after the other, the reward is the sum of theirs where they cooperate, and that of the first where
they compete. It needs `pip install robohive[pettingzoo]`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import ArrayLike, NDArray
from pettingzoo import ParallelEnv

import robohive
from robohive.envs import RoboHiveEnv

__all__ = ["TeamEnv", "parallel_env"]

Floats = NDArray[np.float64]


def parallel_env(id: str, **kwargs: Any) -> TeamEnv:
    """The environment of an id of several agents; its episodes end at the id's length.

    Args:
        id: An id of the suite `multi_agent`.
        kwargs: Those of `robohive.make`.

    Raises:
        gymnasium.error.NameNotFound: there is no such id; the nearest is named.
        ValueError: the id is one of a single agent.
        SettingError: a setting is unknown or wrong.
    """
    return TeamEnv(robohive.make(id, **kwargs))


class TeamEnv(ParallelEnv[str, Floats, NDArray[np.float32]]):
    """An environment whose agents act at the same time.

    Observations of an agent are vectors of 64-bit numbers: the rows of `rows(agent)` one after the other. Actions are vectors
    of 32 or 64 bits in -1 to 1, one number for each actuator of the agent's robot; larger ones are clipped. An episode ends for
    all agents at once, and `agents` is empty from then on until the next reset.

    `joint` is the same environment as one of Gymnasium, with RoboHive's methods.
    """

    metadata: dict[str, Any]

    def __init__(self, joint: RoboHiveEnv) -> None:
        """The agents of `joint`, which must be an environment for several."""
        about = joint._about
        if about["agents"] is None:
            several = ", ".join(robohive.ids("multi_agent"))
            raise ValueError(f"{about['id']} is an environment for one agent; for several there are {several}")
        self.joint = joint
        self._about = {agent["name"]: agent for agent in about["agents"]}
        self.metadata = {**joint.metadata, "name": about["id"], "is_parallelizable": True}
        self.render_mode = joint.render_mode
        self.possible_agents = list(self._about)
        self.agents: list[str] = []
        self.observation_spaces: dict[str, spaces.Space[Any]] = {}
        self.action_spaces: dict[str, spaces.Space[Any]] = {}
        for name, agent in self._about.items():
            size = sum(length for _, _, length in agent["rows"])
            low, high = (agent[f"action_{edge}"].astype(np.float32) for edge in ("low", "high"))
            self.observation_spaces[name] = spaces.Box(-np.inf, np.inf, (size,), dtype=np.float64)
            self.action_spaces[name] = spaces.Box(low, high, dtype=np.float32)

    @property
    def state_space(self) -> spaces.Space[Any]:
        """Space of `state`."""
        return self.joint.observation_space

    def observation_space(self, agent: str) -> spaces.Space[Any]:
        """Space of an agent's observations, the same object every time."""
        return self.observation_spaces[self._known(agent)]

    def action_space(self, agent: str) -> spaces.Space[Any]:
        """Space of an agent's actions, the same object every time."""
        return self.action_spaces[self._known(agent)]

    def rows(self, agent: str) -> dict[str, tuple[str, int]]:
        """Rows of an agent's observation in order, by name: unit and length."""
        return {name: (unit, length) for name, unit, length in self._about[self._known(agent)]["rows"]}

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Floats], dict[str, dict[str, Any]]]:
        """Starts an episode.

        Args:
            seed: Restarts all draws first.
            options: `reset_qpos` and `reset_qvel`, as `RoboHiveEnv.reset` has them. Others are left to wrappers: PettingZoo's
                tests pass some.

        Returns:
            Observations and infos by agent. Infos have `solved`, whether the task is solved in this state.
        """
        known = {key: value for key, value in (options or {}).items() if key in ("reset_qpos", "reset_qvel")}
        _, info = self.joint.reset(seed=seed, options=known)
        self.agents = list(self.possible_agents)
        observations, _ = self.joint._core.agents()
        return observations, self._infos(info)

    def step(
        self, actions: Mapping[str, ArrayLike]
    ) -> tuple[
        dict[str, Floats], dict[str, float], dict[str, bool], dict[str, bool], dict[str, dict[str, Any]]
    ]:
        """Applies one action for each agent for one control period.

        Returns:
            Observations, rewards, terminations, truncations and infos by agent. Where physics refuses the step, it is
            truncated, rewards are 0, and infos have the reason as `fault`. After the end of an episode, all are empty.

        Raises:
            ValueError: an agent that does not exist or has no action; an action of another length, or that is not finite.
        """
        if not self.agents:
            return {}, {}, {}, {}, {}
        joint = self.joint._core.join(dict(actions))
        _, _, terminated, truncated, info = self.joint.step(joint)
        observations, rewards = self.joint._core.agents()
        if "fault" in info:
            rewards = dict.fromkeys(rewards, 0.0)
        live = list(self.agents)
        if terminated or truncated:
            self.agents = []
        each = dict.fromkeys
        return observations, rewards, each(live, terminated), each(live, truncated), self._infos(info)

    def state(self) -> Floats:
        """The joint observation."""
        return self.joint.get_obs()

    def render(self) -> NDArray[Any] | None:
        """A picture as the render mode asks for it."""
        return self.joint.render()

    def close(self) -> None:
        """Frees the environment."""
        self.joint.close()

    def _infos(self, info: dict[str, Any]) -> dict[str, dict[str, Any]]:
        told = {"solved": bool(info["solved"])}
        if "fault" in info:
            told["fault"] = info["fault"]
        return {agent: dict(told) for agent in self.possible_agents}

    def _known(self, agent: str) -> str:
        if agent not in self._about:
            raise ValueError(f"there is no agent {agent}; there are {', '.join(self._about)}")
        return agent
