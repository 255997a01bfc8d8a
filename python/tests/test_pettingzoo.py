"""Environments of several agents keep PettingZoo's parallel API, and agree with their joint views."""

import numpy as np
import pytest

import robohive

pytest.importorskip("pettingzoo")
from pettingzoo.test import parallel_api_test, parallel_seed_test

from robohive.pettingzoo import parallel_env

IDS = robohive.ids("multi_agent")


@pytest.mark.parametrize("id", IDS)
def test_the_parallel_api_is_kept(id):
    parallel_api_test(parallel_env(id, max_episode_steps=20), num_cycles=50)
    parallel_seed_test(lambda: parallel_env(id), num_cycles=10)


@pytest.mark.parametrize("id", IDS)
def test_agents_are_parts_of_the_joint_view(id):
    env, joint = parallel_env(id, seed=0), robohive.make(id, seed=0)
    observations, _ = env.reset(seed=3)
    joint.reset(seed=3)
    first, second = env.agents
    assert not np.array_equal(observations[first], observations[second])
    for agent in env.agents:
        env.action_space(agent).seed(1)
        assert observations[agent].shape == (sum(length for _, length in env.rows(agent).values()),)
    for _ in range(5):
        actions = {agent: env.action_space(agent).sample() for agent in env.agents}
        whole = np.concatenate([actions[agent] for agent in env.possible_agents])
        _, rewards, _, _, _ = env.step(dict(reversed(actions.items())))
        observation, reward, *_ = joint.step(whole)
        np.testing.assert_array_equal(env.state(), observation)
        total = rewards[first] if "Tag" in id else sum(rewards.values())
        assert reward == pytest.approx(total, abs=1e-12)


def test_what_fits_no_agent_is_an_error():
    env = parallel_env("hive/DKittyPairPushBox-v0")
    env.reset(seed=0)
    still = np.zeros(12)
    with pytest.raises(ValueError, match="there is no agent middle; there are left, right"):
        env.step({"left": still, "middle": still})
    with pytest.raises(ValueError, match="the agent right has no action"):
        env.step({"left": still})
    with pytest.raises(ValueError, match=r"the agent left: an action has shape \(12,\)"):
        env.step({"left": still[1:], "right": still})
    with pytest.raises(ValueError, match="value 2 of the action of the agent right is nan|NaN"):
        env.step({"left": still, "right": np.where(np.arange(12) == 2, np.nan, 0.0)})
    with pytest.raises(ValueError, match="there is no agent middle"):
        env.action_space("middle")
    with pytest.raises(ValueError, match="hive/FrankaReach-v0 is an environment for one agent"):
        parallel_env("hive/FrankaReach-v0")
