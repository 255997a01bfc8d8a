"""Gymnasium's contract."""

import warnings

import gymnasium
import numpy as np
import pytest
import robohive
from known_ids import CLASSES, OWN, make_or_skip
from gymnasium.utils.env_checker import check_env, data_equivalence

KEYS = {
    "time",
    "rwd_dense",
    "rwd_sparse",
    "solved",
    "done",
    "obs_dict",
    "visual_dict",
    "proprio_dict",
    "rwd_dict",
    "state",
}


@pytest.mark.parametrize("id", [*OWN, *CLASSES])
def test_gymnasiums_checker_accepts_it(id):
    env = make_or_skip(id)
    env.close()
    with warnings.catch_warnings():
        # Observations are unbounded, and RoboHive's `seed` is there: the checker remarks both.
        warnings.filterwarnings("ignore", message=".*infinity.*|.*`seed` function.*")
        env = gymnasium.make(id).unwrapped
        # Windows are checked where there is a display: windows/test_environments.py.
        modes = [mode for mode in env.metadata["render_modes"] if mode != "human"]
        env.metadata = {**env.metadata, "render_modes": modes}
        check_env(env)


@pytest.mark.parametrize("id", OWN)
def test_two_environments_with_one_seed_are_one(id):
    first, second = robohive.make(id), robohive.make(id, seed=5)
    assert data_equivalence(first.reset(seed=3), second.reset(seed=3), exact=True)
    first.action_space.seed(0)
    for _ in range(70):
        action = first.action_space.sample()
        one, two = first.step(action), second.step(action)
        assert data_equivalence(one, two, exact=True)
        if one[2] or one[3]:
            assert data_equivalence(first.reset(), second.reset(), exact=True)


def test_without_a_seed_episodes_differ():
    first, second = (robohive.make("hive/FrankaReach-v0").reset()[0] for _ in range(2))
    assert not np.array_equal(first, second)


def test_infos_are_roboHives(env):
    observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
    assert info.keys() == KEYS
    assert type(info) is dict and all(type(info[key]) is dict for key in KEYS if key.endswith("_dict"))
    assert observation in env.observation_space and observation.dtype == np.float64
    assert type(reward) is float and type(terminated) is bool and type(truncated) is bool
    rows = [np.ravel(info["obs_dict"][key]) for key in env.obs_keys]
    assert np.array_equal(np.concatenate(rows), observation)
    terms = sum(weight * info["rwd_dict"][key] for key, weight in env.rwd_keys_wt.items())
    assert reward == info["rwd_dense"] == info["rwd_dict"]["dense"] == pytest.approx(terms)
    assert info["state"]["qpos"].shape == (env.sim.model.nq,)


def test_an_episode_is_truncated_at_its_length_and_not_by_gymnasiums_inner_environment():
    for make, wrapped in [(robohive.make, False), (gymnasium.make, True)]:
        env = make("hive/ElbowPose-v0")
        env.reset(seed=0)
        flags = [env.step(env.action_space.sample())[2:4] for _ in range(env.unwrapped.horizon)]
        assert [truncated for _, truncated in flags] == [False] * (len(flags) - 1) + [True]
        assert env.unwrapped.step(np.zeros(env.action_space.shape))[3] is not wrapped
    longer = gymnasium.make("hive/ElbowPose-v0", max_episode_steps=1000)
    longer.reset(seed=0)
    assert not any(longer.step(longer.action_space.sample())[3] for _ in range(300))


def test_bounds_are_those_of_the_original_where_it_is_asked_for():
    env = make_or_skip("FrankaReachRandom-v0", compat="robohive-0.7")
    assert env.observation_space == gymnasium.spaces.Box(-10, 10, (21,), np.float32)
    assert env.action_space == gymnasium.spaces.Box(-1, 1, (9,), np.float32)


def test_actions_without_normalisation_have_the_controls_ranges():
    env = robohive.make("hive/FrankaReach-v0", normalize_act=False)
    ranges = env.sim.model.actuator_ctrlrange
    assert np.array_equal(env.action_space.low, ranges[:, 0].astype(np.float32))


def test_pictures_follow_the_render_mode():
    size = {"width": 64, "height": 48}
    colours = robohive.make("hive/FrankaReach-v0", render_mode="rgb_array", **size)
    colours.reset(seed=0)
    picture = colours.render()
    assert picture.shape == (48, 64, 3) and picture.dtype == np.uint8 and picture.std() > 10
    depths = robohive.make("hive/FrankaReach-v0", render_mode="depth_array", **size)
    depths.reset(seed=0)
    assert depths.render().shape == (48, 64) and depths.render().dtype == np.float32
    both = colours.sim.renderer.render_offscreen(64, 48, depth=True)
    assert np.array_equal(both[0], picture) and np.array_equal(both[1], depths.render())
    frames = gymnasium.make("hive/FrankaReach-v0", render_mode="rgb_array_list", **size)
    frames.reset(seed=0)
    assert len(frames.render()) == 1


def test_images_are_drawn_when_they_are_asked_for():
    env = robohive.make("hive/FrankaReach_v2d-v0")
    env.reset(seed=0)
    quiet = env.step(env.action_space.sample())[4]
    seen = env.step(env.action_space.sample(), update_exteroception=True)[4]
    assert quiet["visual_dict"] == {}
    assert seen["visual_dict"].keys() == {"time", *env.visual_keys}
    assert seen["visual_dict"]["time"] == seen["time"]
    images = env.get_exteroception()
    assert all(np.array_equal(images[key], seen["visual_dict"][key]) for key in env.visual_keys)


def test_the_generator_of_gymnasium_is_one_of_its_own(env):
    env.reset(seed=11)
    drawn = env.np_random.random(100)
    state = env.reset(seed=11)[0]
    env.np_random.random(3)
    again = robohive.make("hive/FrankaReach-v0")
    assert np.array_equal(again.reset(seed=11)[0], state)
    assert np.array_equal(again.np_random.random(100), drawn)
    assert np.array_equal(env.reset()[0], again.reset()[0])
