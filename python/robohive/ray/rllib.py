"""RLlib's environment runner over vectors that step in Rust."""

from __future__ import annotations

from typing import Any

import gymnasium as gym
from ray.rllib.algorithms.algorithm_config import AlgorithmConfig
from ray.rllib.env.single_agent_env_runner import SingleAgentEnvRunner


class RoboHiveEnvRunner(SingleAgentEnvRunner):
    """RLlib's `SingleAgentEnvRunner` in processes that know the ids: unpickling the class imports this package, which registers
    them. With `configure`, it samples from one vector that steps in Rust instead of from a Python environment each.
    """


def configure(config: AlgorithmConfig, id: str, *, num_envs: int = 16, **settings: Any) -> AlgorithmConfig:
    """Sets environment and runner of an algorithm's configuration.

    >>> config = configure(PPOConfig(), "hive/FrankaReach-v0", num_envs=32)  # doctest: +SKIP
    >>> config.build_algo().train()                                          # doctest: +SKIP

    Args:
        config: A configuration of RLlib's, as `PPOConfig()`.
        id: Id of the environment.
        num_envs: Environments of each runner.
        settings: Settings of the environment that differ from the id's, and arguments of `make_vec`.
    """
    config.environment(id, env_config=settings)
    config.env_runners(
        env_runner_cls=RoboHiveEnvRunner,
        num_envs_per_env_runner=num_envs,
        gym_env_vectorize_mode=gym.VectorizeMode.VECTOR_ENTRY_POINT,
    )
    return config
