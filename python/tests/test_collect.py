"""Episodes by number, in one process."""

import numpy as np
import pytest
from robohive.collect import EpisodeRunner, RandomPolicy, collect

ID = "hive/FrankaReach-v0"


def by_number(**settings):
    episodes = list(collect(ID, 5, policy=RandomPolicy, seed=3, **settings))
    return sorted(episodes, key=lambda episode: episode.index)


def test_an_episode_depends_on_its_number_alone():
    alone, together = by_number(num_envs=1, threads=1), by_number(num_envs=4, threads=2)
    assert [episode.index for episode in together] == [0, 1, 2, 3, 4]
    assert len({episode.seed for episode in alone}) == 5
    for a, b in zip(alone, together):
        assert a.seed == b.seed and a.length == b.length == 50
        assert a.observations.shape == (51, a.observations.shape[1])
        for name in ("observations", "actions", "rewards"):
            np.testing.assert_array_equal(getattr(a, name), getattr(b, name))
        assert a.truncated and a.fault is None


class Thrown(RandomPolicy):
    """Gives the joints of environment 1 an impossible speed before its fourth step."""

    envs = None
    steps = 0

    def act(self, observations):
        self.steps += 1
        if self.steps == 4:
            states = self.envs.get_attr("env_state")
            states[1]["qvel"][:] = 1e9
            self.envs.set_attr("env_state", states)
        return super().act(observations)


def test_an_episode_says_why_physics_refused_its_last_step():
    runner = EpisodeRunner(ID, Thrown, num_envs=2)
    runner.policy.envs = runner._envs
    first, second = runner.run(range(2))
    runner.close()
    assert (first.index, first.length, first.terminated, first.truncated) == (1, 4, False, True)
    assert "qvel" in first.fault or "qpos" in first.fault or "qacc" in first.fault
    assert (second.index, second.length, second.fault) == (0, 50, None)


@pytest.mark.parametrize("numbers", [[], [7], [3, 1]])
def test_episodes_are_those_asked_for(numbers):
    episodes = list(collect(ID, numbers, policy=RandomPolicy, num_envs=2, threads=1))
    assert sorted(episode.index for episode in episodes) == sorted(numbers)


@pytest.mark.parametrize(("name", "value"), [("episodes", -1), ("num_envs", 0), ("num_envs", -3), ("threads", -1)])
def test_counts_are_refused_by_their_name(name, value):
    arguments = {"episodes": 1, name: value}
    with pytest.raises(ValueError, match=f"^{name} is a whole number from"):
        list(collect(ID, policy=RandomPolicy, **arguments))
