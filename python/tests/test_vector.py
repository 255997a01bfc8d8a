"""Batches: Gymnasium's contract, equality with single environments, resets, arrays, copies."""

import copy
import pickle
import time

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import data_equivalence
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from robohive.envs import RoboHiveEnv
from robohive.vector import RoboHiveVectorEnv

ID = "hive/ElbowPose-v0"
MODES = list(AutoresetMode)


def make(num_envs=3, **kwargs):
    return RoboHiveVectorEnv(ID, num_envs, **{"max_episode_steps": 4, "num_threads": 2, **kwargs})


def draws(envs, steps, seed=0):
    rng = np.random.default_rng(seed)
    low, high = envs.action_space.low, envs.action_space.high
    return [rng.uniform(low, high).astype(np.float32) for _ in range(steps)]


def single():
    return RoboHiveEnv(ID, time_limit=True, max_episode_steps=4)


@pytest.mark.parametrize("mode", MODES)
def test_results_and_infos_are_those_of_gymnasiums_vector_of_single_environments(mode):
    ours = make(autoreset_mode=mode, infos="full")
    theirs = SyncVectorEnv([single] * 3, autoreset_mode=mode)
    assert ours.single_observation_space == theirs.single_observation_space
    assert ours.single_action_space == theirs.single_action_space
    expected, found = theirs.reset(seed=7), ours.reset(seed=7)
    assert np.array_equal(found[0], expected[0])
    same_infos(found[1], expected[1])
    for action in draws(ours, 9):
        expected, found = theirs.step(action), ours.step(action)
        for one, other in zip(found[:4], expected[:4], strict=True):
            assert data_equivalence(one, other, exact=True)
        same_infos(found[4], expected[4])
        if mode is AutoresetMode.DISABLED and expected[3].any():
            mask = expected[3].copy()
            expected = theirs.reset(options={"reset_mask": mask.copy()})
            found = ours.reset(options={"reset_mask": mask})
            assert np.array_equal(found[0], expected[0])


def same_infos(found, expected, where=""):
    """Ours leave states and images out of the infos of ends."""
    if where == ".final_info":
        dropped = {"state", "_state", "visual_dict", "_visual_dict"}
        expected = {key: value for key, value in expected.items() if key not in dropped}
    found = {key: value for key, value in found.items() if not key.endswith("visual_dict")}
    expected = {key: value for key, value in expected.items() if not key.endswith("visual_dict")}
    assert found.keys() == expected.keys(), where
    for key, value in expected.items():
        if isinstance(value, dict):
            same_infos(found[key], value, f"{where}.{key}")
        elif value.dtype == object:
            pairs = zip(found[key], value, strict=True)
            assert all(np.array_equal(one, other) for one, other in pairs), f"{where}.{key}"
        else:
            assert np.array_equal(found[key], value), f"{where}.{key}"
            assert found[key].dtype == value.dtype and found[key].shape == value.shape, f"{where}.{key}"


def test_threads_change_no_bit():
    runs = []
    for threads in (1, 3):
        envs = make(5, num_threads=threads)
        runs.append([envs.reset(seed=1)[0]] + [envs.step(action)[0] for action in draws(envs, 9)])
    assert np.array_equal(runs[0], runs[1])


def test_levels_of_infos():
    for level, keys in {"none": set(), "sparse": {"time", "rwd_dense", "rwd_sparse", "solved", "done"}}.items():
        envs = make(infos=level)
        infos = envs.reset(seed=0)[1]
        assert infos.keys() == keys | {f"_{key}" for key in keys}
    envs = make(autoreset_mode="SameStep", infos="none")
    envs.reset(seed=0)
    for action in draws(envs, 4):
        infos = envs.step(action)[4]
    assert infos.keys() == {"final_obs", "_final_obs"} and infos["_final_obs"].all()
    assert infos["final_obs"][2].shape == envs.single_observation_space.shape


def test_seeds_one_for_each_and_masks():
    envs = make()
    first = envs.reset(seed=[5, None, 9])[0]
    assert envs.np_random_seed[0] == 5 and envs.np_random_seed[2] == 9
    again = envs.reset(seed=5)[0]
    assert np.array_equal(first[0], again[0])
    stepped = envs.step(draws(envs, 1)[0])[0]
    mask = np.array([False, True, False])
    reset, infos = envs.reset(seed=[None, 9, None], options={"reset_mask": mask})
    assert np.array_equal(reset[1], first[2]) and np.array_equal(reset[[0, 2]], stepped[[0, 2]])
    assert np.array_equal(infos["_time"], mask) and infos["time"][1] == 0


@pytest.mark.parametrize(
    ("mask", "error"),
    [([True] * 3, TypeError), (np.ones(3), TypeError), (np.ones(2, bool), ValueError), (np.zeros(3, bool), ValueError)],
)
def test_wrong_masks_are_refused_as_gymnasium_does(mask, error):
    with pytest.raises(error, match="reset_mask"):
        make().reset(options={"reset_mask": mask})


def test_observations_are_fresh_unless_asked_for():
    envs = make()
    first = envs.reset(seed=0)[0]
    kept = first.copy()
    envs.step(draws(envs, 1)[0])
    assert np.array_equal(first, kept)
    envs = make(copy=False)
    first = envs.reset(seed=0)[0]
    assert envs.step(draws(envs, 1)[0])[0] is first


def test_the_callers_array_is_written():
    envs = make(dtype=np.float32)
    out = np.zeros(envs.observation_space.shape, np.float32)
    assert envs.reset(seed=0, out=out)[0] is out
    assert np.array_equal(out, make().reset(seed=0)[0].astype(np.float32))
    assert envs.step(draws(envs, 1)[0], out=out)[0] is out
    assert envs.observation_space.contains(out) and out.dtype == np.float32
    frozen = out.copy()
    frozen.flags.writeable = False
    wrong = [(out.astype(float), TypeError), (out[:2], ValueError), (np.asfortranarray(out), ValueError)]
    for array, error in [*wrong, (frozen, ValueError), ([0.0], TypeError)]:
        with pytest.raises(error, match="out"):
            envs.step(draws(envs, 1)[0], out=array)


def test_arrays_cross_by_dlpack():
    envs = make()
    observation = envs.reset(seed=0)[0]
    assert np.shares_memory(np.from_dlpack(observation), observation)
    torch = pytest.importorskip("torch")
    tensor = torch.from_dlpack(observation)
    assert tensor.dtype == torch.float64 and tensor.data_ptr() == observation.ctypes.data
    action = torch.zeros(envs.action_space.shape)
    assert np.array_equal(envs.step(action)[0], envs_at_rest(envs.reset(seed=0)[0], envs))


def test_counts_are_refused_by_their_name():
    for name, value in [("num_envs", -1), ("num_envs", 0), ("num_threads", -1), ("num_threads", 10**6), ("batch_size", -2)]:
        with pytest.raises(ValueError, match=f"{name} is a whole number from"):
            RoboHiveVectorEnv("hive/FrankaReach-v0", **{"num_envs": 2, name: value})


def test_environments_are_counted_before_they_are_made():
    """A billion environments grew to 20 GB and were killed; a million aborted the interpreter."""
    for count in (10**6, 10**9):
        start = time.monotonic()
        with pytest.raises(MemoryError, match=r"MiB are free: give num_envs at most \d+"):
            gymnasium.make_vec("hive/FrankaReach-v0", num_envs=count)
        assert time.monotonic() - start < 5


def test_a_step_needs_a_reset_before_it():
    envs = RoboHiveVectorEnv("hive/FrankaReach-v0", 2)
    for call in (envs.step, envs.send):
        with pytest.raises(gymnasium.error.ResetNeeded, match="before calling env.reset"):
            call(np.zeros((2, 8)))
    envs.async_reset(seed=0)
    envs.recv()
    envs.step(np.zeros((2, 8)))


def envs_at_rest(_, envs):
    return envs.step(np.zeros(envs.action_space.shape, np.float32))[0]


@pytest.mark.parametrize(
    ("actions", "error", "message"),
    [
        (np.zeros((2, 6)), ValueError, r"actions have shape \(3, \d+\) here, and \(2, 6\)"),
        (np.zeros(6), ValueError, "two axes"),
        ("rest", TypeError, "array of numbers"),
        (np.zeros((3, 6), complex), TypeError, "array of numbers"),
        ([["a"] * 6] * 3, TypeError, "array of numbers"),
    ],
)
def test_wrong_actions_are_refused(actions, error, message):
    envs = make()
    envs.reset(seed=0)
    with pytest.raises(error, match=message):
        envs.step(actions)


def test_actions_that_are_not_finite_change_nothing():
    envs = make()
    envs.reset(seed=0)
    action = np.zeros(envs.action_space.shape)
    action[1, 2] = np.nan
    with pytest.raises(ValueError, match="environment 1: value 2 of the action is NaN"):
        envs.step(action)
    assert np.array_equal(envs.get_attr("obs_dict")[0]["time"], 0)


def test_an_episode_that_is_over_needs_a_reset_where_nothing_resets():
    envs = make(autoreset_mode=AutoresetMode.DISABLED)
    envs.reset(seed=0)
    for action in draws(envs, 4):
        truncated = envs.step(action)[3]
    assert truncated.all()
    with pytest.raises(gymnasium.error.ResetNeeded, match="environment 0"):
        envs.step(action)


def test_closed_environments():
    envs = make()
    envs.close()
    envs.close()
    for call in (envs.reset, lambda: envs.step(np.zeros((3, 6))), envs.recv, envs.render):
        with pytest.raises(gymnasium.error.ClosedEnvironmentError):
            call()


def test_copies_go_on_by_themselves():
    envs = make()
    envs.reset(seed=0)
    actions = draws(envs, 6)
    envs.step(actions[0])
    other = copy.deepcopy(envs)
    ours = [envs.step(action)[0] for action in actions[1:]]
    theirs = [other.step(action)[0] for action in actions[1:]]
    assert np.array_equal(ours, theirs)


def test_pickles_are_made_again():
    envs = make(dtype=np.float32, autoreset_mode="SameStep")
    other = pickle.loads(pickle.dumps(envs))
    assert other.metadata == envs.metadata and other.observation_space == envs.observation_space
    assert np.array_equal(other.reset(seed=3)[0], envs.reset(seed=3)[0])


def test_methods_and_attributes_of_single_environments():
    envs = make()
    envs.reset(seed=0)
    assert envs.get_attr("horizon") == (4, 4, 4) and envs.get_attr("dt")[0] > 0
    states = envs.call("get_env_state")
    observations = np.array(envs.call("get_obs"))
    envs.step(draws(envs, 1)[0])
    envs.set_attr("env_state", states)
    assert np.array_equal(np.array(envs.call("get_obs")), observations)
    with pytest.raises(AttributeError, match="no attribute colour; there are"):
        envs.get_attr("colour")
    with pytest.raises(AttributeError, match="dt cannot be set"):
        envs.set_attr("dt", 1)


@pytest.mark.parametrize("kwargs", [{"dtype": int}, {"infos": "all"}, {"batch_size": 9}, {"num_envs": 0}])
def test_wrong_options_are_refused(kwargs):
    with pytest.raises(ValueError, match="dtype|infos|batch_size|num_envs"):
        make(**kwargs)


def test_make_vec_of_gymnasium():
    import robohive

    assert ID in robohive.ids()
    envs = gymnasium.make_vec(ID, 2, vectorization_mode="vector_entry_point", num_threads=1)
    assert isinstance(envs, RoboHiveVectorEnv) and envs.spec.id == ID
    assert envs.reset(seed=0)[0].shape == envs.observation_space.shape
    wrapped = gymnasium.wrappers.vector.RecordEpisodeStatistics(envs)
    wrapped.reset(seed=0)
    for action in draws(envs, 120):
        infos = wrapped.step(action)[4]
        if "episode" in infos:
            break
    assert infos["episode"]["l"].tolist() == [100, 100]


def test_images_of_the_batch():
    envs = RoboHiveVectorEnv("hive/FrankaReach_v2d-v0", 2, exteroception=True, num_threads=2)
    infos = envs.reset(seed=0)[1]
    images = infos["visual_dict"]["rgb:front:224x224:2d"]
    assert images.shape == (2, 224, 224, 3) and images.dtype == np.uint8 and images.std() > 0
    one = RoboHiveEnv("hive/FrankaReach_v2d-v0")
    one.reset(seed=1)
    assert np.array_equal(one.get_exteroception()["rgb:front:224x224:2d"], images[1])


def test_pictures():
    envs = make(2, render_mode="rgb_array", width=32, height=24)
    envs.reset(seed=0)
    frames = envs.render()
    assert len(frames) == 2 and frames[0].shape == (24, 32, 3)


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
def test_a_step_that_physics_refuses_ends_the_episode_and_says_why(mode):
    envs = RoboHiveVectorEnv("hive/FrankaReach-v0", 2, autoreset_mode=mode, infos="none", num_threads=1)
    envs.reset(seed=1)
    states = envs.get_attr("env_state")
    states[1]["qvel"][0] = 1e9
    envs.set_attr("env_state", states)
    zeros = np.zeros(envs.action_space.shape, np.float32)
    _, rewards, terminated, truncated, infos = envs.step(zeros)
    assert truncated.tolist() == infos["_fault"].tolist() == [False, True] and not terminated.any()
    assert infos["fault"][0] is None and len(infos["fault"][1]) > 20 and rewards[1] == 0
    observations, _, _, truncated, infos = envs.step(zeros)
    assert np.isfinite(observations).all() and not truncated.any() and "fault" not in infos
