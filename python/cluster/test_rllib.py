"""An algorithm of RLlib over vectors that step in Rust."""

import os

import pytest

os.environ["RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER"] = "0"
ray = pytest.importorskip("ray")
pytest.importorskip("torch")
pytest.importorskip("ray.rllib")

from ray.rllib.algorithms.ppo import PPOConfig
from robohive.ray.rllib import RoboHiveEnvRunner, configure
from robohive.vector import RoboHiveVectorEnv


def test_ppo_samples_and_learns():
    ray.init(num_cpus=2, log_to_driver=False)
    try:
        config = configure(PPOConfig(), "hive/FrankaReach-v0", num_envs=8)
        config.env_runners(num_env_runners=1, rollout_fragment_length=60)
        config.training(train_batch_size_per_learner=480, minibatch_size=120, num_epochs=1)
        config.learners(num_learners=0).debugging(seed=1)
        algorithm = config.build_algo()
        vectors = algorithm.env_runner_group.foreach_env_runner(
            lambda runner: (type(runner).__name__, type(runner.env.unwrapped).__name__),
            local_env_runner=False,
        )
        assert set(vectors) == {(RoboHiveEnvRunner.__name__, RoboHiveVectorEnv.__name__)}
        results = algorithm.train()["env_runners"]
        assert results["num_env_steps_sampled"] >= 480
        assert results["num_episodes"] >= 8 and results["episode_len_mean"] == 50.0
        assert results["episode_return_mean"] < 0.0
        algorithm.stop()
    finally:
        ray.shutdown()
