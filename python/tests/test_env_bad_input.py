"""Bad input ends in the exception that users of Gymnasium and numpy expect."""

import copy
import pickle
import threading

import gymnasium
import numpy as np
import pytest
import robohive


@pytest.mark.parametrize(
    ("action", "error", "message"),
    [
        (np.zeros(3), ValueError, r"shape \(8,\) here, and \(3,\) was given"),
        (np.zeros((1, 8)), ValueError, r"\(1, 8,\) was given"),
        (0.0, ValueError, r"\(\) was given"),
        ("left", TypeError, "not of <U4"),
        (np.zeros(8, complex), TypeError, "not of complex128"),
        (np.array([None] * 8), TypeError, "not of object"),
        ([[0], [0, 1]], ValueError, "inhomogeneous"),
        (np.array([0, 0, np.nan, 0, 0, 0, 0, 0]), ValueError, "value 2 of the action is NaN"),
        (np.full(8, np.inf), ValueError, "value 0 of the action is inf"),
    ],
)
def test_actions_are_checked(env, action, error, message):
    with pytest.raises(error, match=message):
        env.step(action)
    assert env.step(np.zeros(8))[1] != 0.0


@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.float64, np.int8, np.uint64, bool, ">f4", "longdouble"])
def test_all_real_numbers_are_actions(env, dtype):
    other = robohive.make("hive/FrankaReach-v0")
    other.reset(seed=0)
    action = np.array([0, 1, 0, 1, 0, 1, 1, 1])
    assert np.array_equal(env.step(action.astype(dtype))[0], other.step(list(action))[0])


def test_views_that_are_not_contiguous_are_actions(env):
    other = robohive.make("hive/FrankaReach-v0")
    other.reset(seed=0)
    wide = np.linspace(-1, 1, 24, dtype=np.float32)
    assert np.array_equal(env.step(wide[::-3])[0], other.step(wide[::-3].copy())[0])


def test_a_closed_environment_says_so(env):
    env.close()
    env.close()
    calls = [
        env.reset,
        lambda: env.step(np.zeros(8)),
        env.render,
        env.get_obs,
        env.get_env_infos,
        env.get_env_state,
        lambda: env.set_env_state({}),
        lambda: env.sim.data.qpos,
        lambda: env.seed(1),
        lambda: env.time,
    ]
    for call in calls:
        with pytest.raises(gymnasium.error.ClosedEnvironmentError, match="closed"):
            call()
    assert env.observation_space.shape == (60,)


def test_unknown_ids_name_the_nearest():
    with pytest.raises(gymnasium.error.NameNotFound, match=r"did you mean FrankaReachRandom-v0\?"):
        robohive.make("FrankaReachRandm-v0")
    with pytest.raises(gymnasium.error.NameNotFound, match="FrankaReachRandom"):
        gymnasium.make("FrankaReachRandm-v0")


@pytest.mark.parametrize(
    ("kwargs", "error", "message"),
    [
        ({"frame_skips": 3}, TypeError, "there is no frame_skips; did you mean frame_skip?"),
        # TorchRL leaves out what Python's words name.
        ({"frameskip": 1}, TypeError, "unexpected keyword argument 'frameskip'"),
        ({"frame_skip": 99999999999}, ValueError, "at most 10000"),
        ({"obs_range": [5, -5]}, ValueError, "the lower one first"),
        ({"obs_range": [float("nan"), 5]}, ValueError, "the lower one first"),
        ({"weighted_reward_keys": {"reach": float("nan")}}, ValueError, "the weight of reach is NaN"),
        ({"frame_skip": "a"}, ValueError, "frame_skip"),
        ({"frame_skip": 0}, ValueError, "1 or more"),
        ({"frame_skip": object()}, TypeError, "frame_skip: a object is no setting"),
        ({"obs_range": [0, {1: 2}]}, TypeError, r"obs_range\[1\]"),
        ({"obs_keys": ["qp_robt"]}, ValueError, "qp_robt"),
        ({"weighted_reward_keys": {"reach": 2**70}}, ValueError, "64 bits"),
        ({"weighted_reward_keys": {"raech": 1.0}}, ValueError, "raech"),
        ({"reward_mode": "densest"}, ValueError, "dense"),
        ({"compat": "robohive-0.6"}, ValueError, "robohive-0.7"),
        ({"render_mode": "ansi"}, ValueError, "rgb_array"),
        ({"renderer": "opengl"}, ValueError, "gpu:NAME .*, not 'opengl'|gpu:NAME .*, not \"opengl\""),
        ({"instability": "ignore"}, ValueError, "truncate or reset, not ignore"),
        ({"solver": "bullet"}, ValueError, "own or rapier, not \"bullet\""),
        ({"solver": "rapier"}, NotImplementedError, "--features rapier"),
        ({"seed": -1}, gymnasium.error.Error, "2\\*\\*64"),
        ({"max_episode_steps": 0}, ValueError, "1 or more"),
        ({"override_keys": ["nothing"]}, ValueError, "no setting nothing"),
        ({"visual_keys": ["rgb:nowhere:8x8:2d"]}, ValueError, "nowhere"),
        ({"config_path": "nowhere.config"}, FileNotFoundError, "nowhere.config"),
    ],
)
def test_settings_are_checked(kwargs, error, message):
    with pytest.raises(error, match=message):
        robohive.make("hive/FrankaReach-v0", **kwargs)


@pytest.mark.parametrize("making", [robohive.make, gymnasium.make, gymnasium.make_vec])
def test_cameras_are_checked_when_environments_are_made(making):
    for mode in (None, "rgb_array"):
        with pytest.raises(ValueError, match="nowhere"):
            making("hive/FrankaReach-v0", render_mode=mode, camera_name="nowhere")


@pytest.mark.parametrize("value", [-1, 0, 2**31, 10**30, 1.5, float("nan"), float("inf"), "wide"])
@pytest.mark.parametrize("name", ["width", "height"])
def test_sizes_are_refused_by_their_name(name, value):
    for making in (robohive.make, gymnasium.make_vec):
        with pytest.raises(ValueError, match=f"{name} is a whole number from 1 to"):
            making("hive/FrankaReach-v0", render_mode="rgb_array", **{name: value})
    with pytest.raises(TypeError, match=f"{name} is a whole number, not a list"):
        robohive.make("hive/FrankaReach-v0", **{name: [1]})


def test_a_step_needs_a_reset_before_it():
    env = robohive.make("hive/FrankaReach-v0")
    with pytest.raises(gymnasium.error.ResetNeeded, match="before calling env.reset"):
        env.step(np.zeros(8))
    with pytest.raises(gymnasium.error.ResetNeeded, match="before calling env.reset"):
        copy.deepcopy(env).step(np.zeros(8))
    env.reset(seed=0)
    env.step(np.zeros(8))
    pickle.loads(pickle.dumps(env)).step(np.zeros(8))
    # A state that is set can be stepped from, too.
    other = robohive.make("hive/FrankaReach-v0")
    other.set_env_state(env.get_env_state())
    other.step(np.zeros(8))
    env.close()
    with pytest.raises(gymnasium.error.ClosedEnvironmentError):
        env.step(np.zeros(8))


def test_spaces_have_the_bounds_that_are_declared():
    plain = robohive.make("hive/FrankaReach-v0")
    assert np.isinf(plain.observation_space.high).all()
    for env in (
        robohive.make("hive/FrankaReach-v0", obs_range=[-5, 4]),
        gymnasium.make_vec("hive/FrankaReach-v0", obs_range=[-5, 4]),
    ):
        space = getattr(env, "single_observation_space", env.observation_space)
        assert (space.low == -5).all() and (space.high == 4).all()
    original = robohive.make("hive/FrankaReach-v0", compat="robohive-0.7").observation_space
    assert (original.low == -10).all() and (original.high == 10).all()
    own = robohive.make("hive/FrankaReach-v0", normalize_act=False)
    assert (plain.action_space.low == -1).all() and (plain.action_space.high == 1).all()
    low, high = own.sim.model.actuator_ctrlrange.T
    np.testing.assert_array_equal(own.action_space.low, low.astype(np.float32))
    np.testing.assert_array_equal(own.action_space.high, high.astype(np.float32))


def test_sizes_beyond_pictures_are_refused_when_one_is_drawn():
    env = robohive.make("hive/FrankaReach-v0", render_mode="rgb_array", width=10**9)
    with pytest.raises(ValueError):
        env.render()


def test_states_are_checked(env):
    state = env.get_env_state()
    with pytest.raises(ValueError, match="qpos has 2 values"):
        env.set_env_state({"qpos": [1.0, 2.0]})
    with pytest.raises(KeyError, match="qpoz"):
        env.set_env_state({"qpoz": [1.0]})
    with pytest.raises((TypeError, ValueError)):
        env.set_env_state({"qpos": "left"})
    env.set_env_state(state)
    with pytest.raises(ValueError, match="value 0 of qpos is NaN"):
        env.set_env_state({**state, "qpos": state["qpos"] * np.nan})
    env.reset(seed=0)


def test_resets_are_checked(env):
    with pytest.raises(gymnasium.error.Error):
        env.reset(seed=-1)
    with pytest.raises(gymnasium.error.Error, match="2\\*\\*64"):
        env.reset(seed=2**64)
    with pytest.raises(ValueError, match="no reset has an option start"):
        env.reset(options={"start": 1})


def test_a_step_that_physics_refuses_ends_the_episode(env):
    state = env.get_env_state()
    env.set_env_state({"qvel": np.full_like(state["qvel"], 1e9)})
    for _ in range(200):
        _, reward, terminated, truncated, info = env.step(np.ones(8))
        if "fault" in info:
            break
    assert (reward, terminated, truncated) == (0.0, False, True) and info["fault"]
    with pytest.raises(gymnasium.error.ResetNeeded, match="reset first"):
        env.step(np.zeros(8))
    assert "fault" not in env.reset(seed=0)[1]
    env.step(np.zeros(8))


def test_two_threads_are_refused_or_take_turns(env):
    """No call is lost: each steps or raises, and what steps is in some order."""
    outcomes = []

    def work():
        for _ in range(100):
            try:
                env.step(np.zeros(8))
                outcomes.append("stepped")
            except RuntimeError as error:
                assert "another thread" in str(error)
                outcomes.append("refused")

    threads = [threading.Thread(target=work) for _ in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert len(outcomes) == 400
    assert env.time == pytest.approx(outcomes.count("stepped") * env.dt)


def test_a_state_that_physics_refuses_can_be_reset_as_mujoco_does():
    env = robohive.make("hive/FrankaReach-v0", instability="reset")
    env.reset(seed=0)
    for _ in range(10):
        env.step(np.zeros(8))
    env.set_env_state({"qvel": np.full_like(env.get_env_state()["qvel"], 1e9)})
    for step in range(11, env.horizon + 1):
        observation, _, _, truncated, info = env.step(np.zeros(8))
        assert "fault" not in info and truncated == (step == env.horizon)
    assert np.isfinite(observation).all() and env.time < (env.horizon - 9) * env.dt


def test_a_gpu_is_asked_for_by_its_name_or_not_there():
    env_id, options = "hive/FrankaReach-v0", {"render_mode": "rgb_array", "width": 32, "height": 24}
    try:
        env = robohive.make(env_id, renderer="gpu:no such card", **options)
    except NotImplementedError as error:
        assert "--features gpu" in str(error)
        return
    # The CPU stands in.
    expected = robohive.make(env_id, **options)
    env.reset(seed=0)
    expected.reset(seed=0)
    assert np.array_equal(env.render(), expected.render())
