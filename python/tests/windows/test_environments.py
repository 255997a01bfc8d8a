"""`render_mode="human"`: the window of an environment."""

import copy
import pickle
import warnings

import gymnasium
import numpy as np
import pytest
import robohive
from displays import eventually
from gymnasium.utils.env_checker import check_env
from robohive.errors import WindowError


def test_without_a_display_the_error_says_what_is_missing(no_display):
    env = robohive.make("hive/FrankaReach-v0", render_mode="human")
    with pytest.raises(WindowError, match="DISPLAY or WAYLAND_DISPLAY.*rgb_array.*xvfb-run"):
        env.reset(seed=0)
    env.close()


def test_the_window_follows_every_step_and_closes_with_the_environment(display):
    env = gymnasium.make("hive/FrankaReach-v0", render_mode="human")
    assert "human" in env.metadata["render_modes"] and env.render_mode == "human"
    quiet = gymnasium.make("hive/FrankaReach-v0")
    seen, unseen = env.reset(seed=3), quiet.reset(seed=3)
    assert np.array_equal(seen[0], unseen[0])
    inner = env.unwrapped
    window = inner._screen._window
    assert window.is_open()
    eventually(lambda: display.pixels().std() > 20, "the robot is seen")
    for action in np.random.default_rng(0).uniform(-1, 1, (5, *env.action_space.shape)):
        assert np.array_equal(env.step(action)[0], quiet.step(action)[0])
    assert env.render() is None
    # Copies have no window, and open their own when they go on.
    assert copy.deepcopy(inner)._screen is None and pickle.loads(pickle.dumps(inner))._screen is None
    window.close()
    env.step(env.action_space.sample())
    env.close()
    assert not window.is_open()


def test_gymnasiums_checker_accepts_the_window(display):
    with warnings.catch_warnings():
        # Observations are unbounded, and RoboHive's `seed` is there: the checker remarks both.
        warnings.filterwarnings("ignore", message=".*infinity.*|.*`seed` function.*")
        check_env(gymnasium.make("hive/FrankaReach-v0").unwrapped)


def test_robohives_methods_open_the_window(env, display):
    class Rest:
        def get_action(self, observation):
            return np.zeros(env.action_space.shape), {"evaluation": np.zeros(env.action_space.shape)}

    paths = env.examine_policy(Rest(), horizon=2, render="onscreen")
    assert len(paths[0]["rewards"]) == 2 and env._screen._window.is_open()
