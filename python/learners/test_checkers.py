"""The checkers of Stable-Baselines3 and TorchRL, with the real packages."""

import sys
import warnings
from pathlib import Path

import gymnasium
import numpy as np
import pytest
import robohive
from stable_baselines3 import SAC
from stable_baselines3.common.env_checker import check_env
from stable_baselines3.common.vec_env import DummyVecEnv
from torchrl.envs import GymWrapper
from torchrl.envs.utils import check_env_specs

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from known_ids import CLASSES, OWN, make_or_skip


@pytest.mark.parametrize("id", [*OWN, *CLASSES])
def test_stable_baselines_accepts_it(id):
    make_or_skip(id).close()
    with warnings.catch_warnings():
        # It recommends 32-bit actions in -1 to 1, which they are, and warns of what it does not recommend.
        warnings.simplefilter("error")
        check_env(gymnasium.make(id), warn=True)


@pytest.mark.parametrize("id", [*OWN, *CLASSES])
def test_torchrl_accepts_it(id):
    make_or_skip(id).close()
    check_env_specs(GymWrapper(gymnasium.make(id)))


def test_stable_baselines_learns_for_a_few_steps():
    envs = DummyVecEnv([lambda: gymnasium.make("hive/ElbowPose-v0")] * 2)
    learner = SAC("MlpPolicy", envs, learning_starts=20, batch_size=16, seed=0)
    learner.learn(60)
    action, _ = learner.predict(envs.reset(), deterministic=True)
    assert action.shape == (2, envs.action_space.shape[0]) and np.isfinite(action).all()


def test_a_rollout_of_torchrl_is_ours():
    env = GymWrapper(gymnasium.make("hive/ElbowPose-v0"))
    env.set_seed(0)
    rollout = env.rollout(20)
    twin = robohive.make("hive/ElbowPose-v0")
    twin.reset()
    assert rollout["observation"].shape == (20, twin.observation_space.shape[0])
    assert rollout["action"].shape == (20, twin.action_space.shape[0])
