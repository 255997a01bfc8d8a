"""Policies from Python: those that are shipped solve their tasks, and files that hold none are refused."""

import numpy as np
import pytest

import robohive
from robohive.policy import policies

ELBOW = "hive/myoElbowPose1D6MRandom-v0"


def test_a_shipped_policy_solves_its_task_and_repeats():
    assert ELBOW in policies()
    env = robohive.make(ELBOW)
    env.reset(seed=5)
    paths = env.examine_policy(env.policy(), horizon=100, num_episodes=5, mode="evaluation")
    assert env.evaluate_success(paths) == 100.0
    action = env.policy().act()
    assert env.action_space.contains(action) and np.ptp(action) > 0.1
    np.testing.assert_array_equal(action, env.policy().act())


def test_a_policy_is_refused_where_it_does_not_belong(tmp_path):
    env = robohive.make("hive/QuadrupedWalk-v0")
    with pytest.raises(ValueError, match=f"no policy is shipped for .*; there are some for .*{ELBOW}"):
        env.policy()
    with pytest.raises(OSError, match="missing.safetensors"):
        env.policy(tmp_path / "missing.safetensors")
    (tmp_path / "text").write_text("no policy")
    with pytest.raises(ValueError, match="text"):
        env.policy(tmp_path / "text")
