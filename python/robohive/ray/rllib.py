"""RLlib's environment runner over vectors that step in Rust."""

from __future__ import annotations

from typing import Any

import gymnasium as gym
from ray.rllib.algorithms.algorithm_config import AlgorithmConfig
from ray.rllib.env.single_agent_env_runner import SingleAgentEnvRunner


class RoboHiveEnvRunner(SingleAgentEnvRunner):
    """Samples from one vector of environments, stepped in Rust, instead of a Python environment each.

    Everything else, modules, connectors, episodes, metrics, state, is RLlib's own `SingleAgentEnvRunner`.
    """

    def make_env(self) -> None:
        """Makes the vector that `config.env` names, `num_envs_per_env_runner` wide."""
        # Importing registers the ids in this process, which may be a worker that has seen no user code.
        import robohive  # noqa: F401

        super().make_env()


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
