"""Copies of environments go on to the last bit: in the same process, in another, and after a fork."""

import copy
import multiprocessing
import pickle
import threading

import gymnasium
import numpy as np
import pytest
import robohive
from known_ids import CLASSES, OWN, make_or_skip
from gymnasium.utils.env_checker import data_equivalence

#: Lights that move from episode to episode.
RANDOMISED = {"lights": [{"pos": {"low": [-1, -1, 0], "high": [1, 1, 0.5]}, "on": 0.5}]}


def advance(env, steps=7):
    env.reset(seed=1)
    env.action_space.seed(1)
    for _ in range(steps):
        env.step(env.action_space.sample())


def goes_on(env, steps=5):
    """What follows: steps, a reset without a seed, and more steps."""
    space = copy.deepcopy(env.action_space)
    space.seed(2)
    results = [env.step(space.sample()) for _ in range(steps)]
    results.append(env.reset())
    results.extend(env.step(space.sample()) for _ in range(steps))
    results.append(env.np_random.random())
    return results


@pytest.mark.parametrize("compat", ["fixed", "robohive-0.7"])
@pytest.mark.parametrize("id", [*OWN, *CLASSES])
def test_pickles_and_deep_copies_are_exact(id, compat):
    env = make_or_skip(id, compat=compat)
    advance(env)
    pickled, copied = pickle.loads(pickle.dumps(env)), copy.deepcopy(env)
    assert data_equivalence(env.get_env_infos(), pickled.get_env_infos(), exact=True)
    expected = goes_on(env)
    assert data_equivalence(goes_on(pickled), expected, exact=True)
    assert data_equivalence(goes_on(copied), expected, exact=True)
    assert pickled.spec == env.spec and pickled.observation_space == env.observation_space


def test_looks_are_copied():
    env = robohive.make(
        "hive/FrankaReach-v0",
        visual_randomization=RANDOMISED,
        render_mode="rgb_array",
        width=48,
        height=32,
    )
    advance(env)
    for other in (pickle.loads(pickle.dumps(env)), copy.deepcopy(env)):
        twin = copy.deepcopy(env)
        looks = []
        for _ in range(3):
            assert np.array_equal(other.render(), twin.render())
            looks.append(twin.render())
            assert data_equivalence(other.reset(), twin.reset(), exact=True)
        assert not np.array_equal(looks[0], looks[1])


def test_drawn_physics_is_copied():
    factor = {"low": [0.5], "high": [2]}
    drawn = {"masses": [{"factor": factor}], "gravity": {"low": [0, 0, -12], "high": [0, 0, -8]}}
    env = robohive.make("hive/FrankaReach-v0", physics_randomization=drawn)
    advance(env)
    pickled, copied = pickle.loads(pickle.dumps(env)), copy.deepcopy(env)
    expected = goes_on(env)
    assert data_equivalence(goes_on(pickled), expected, exact=True)
    assert data_equivalence(goes_on(copied), expected, exact=True)


def test_settings_and_options_travel():
    env = robohive.make("hive/FrankaReach-v0", reward_mode="sparse", render_mode="rgb_array", width=32, height=24)
    env.reset(seed=0)
    other = pickle.loads(pickle.dumps(env))
    assert other.rwd_mode == "sparse" and other.render_mode == "rgb_array"
    assert np.array_equal(other.render(), env.render())


def test_wrapped_environments_are_copied_and_pickled():
    env = gymnasium.make("hive/ElbowPose-v0")
    env.reset(seed=0)
    env.step(env.action_space.sample())
    for other in (copy.deepcopy(env), pickle.loads(pickle.dumps(env))):
        assert data_equivalence(
            other.step(np.zeros(env.action_space.shape)),
            copy.deepcopy(env).step(np.zeros(env.action_space.shape)),
            exact=True,
        )


def test_a_closed_environment_is_copied_closed():
    env = robohive.make("hive/ElbowPose-v0")
    env.close()
    for other in (copy.deepcopy(env), pickle.loads(pickle.dumps(env))):
        with pytest.raises(gymnasium.error.ClosedEnvironmentError):
            other.reset()


def test_a_pickle_of_another_environment_is_refused():
    env, other = robohive.make("hive/ElbowPose-v0"), robohive.make("hive/FrankaReach-v0")
    edits, words = env._core.memory()
    with pytest.raises(ValueError, match="does not fit"):
        other._core.set_memory(list(edits.items()), words)


def _child(env, queue):
    results = goes_on(env)
    pixels = env.render()
    queue.put((results, pixels))


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes_go_on(method):
    context = multiprocessing.get_context(method)
    env = robohive.make("hive/FrankaReach-v0", render_mode="rgb_array", width=32, height=24)
    advance(env)
    # Whatever threads the renderer has are running when the process forks.
    env.render()
    queue = context.Queue()
    process = context.Process(target=_child, args=(env, queue))
    process.start()
    results, pixels = queue.get(timeout=120)
    process.join(timeout=120)
    assert process.exitcode == 0
    assert data_equivalence(results, goes_on(env), exact=True)
    assert np.array_equal(pixels, env.render())


@pytest.mark.parametrize("context", ["fork", "spawn"])
def test_gymnasiums_vectors_of_processes_run(context):
    def make():
        return gymnasium.make("robohive:hive/ElbowPose-v0")

    sync = gymnasium.vector.SyncVectorEnv([make] * 2)
    other = gymnasium.vector.AsyncVectorEnv([make] * 2, context=context)
    try:
        assert data_equivalence(sync.reset(seed=4), other.reset(seed=4), exact=True)
        sync.action_space.seed(0)
        for _ in range(120):
            actions = sync.action_space.sample()
            one, two = sync.step(actions), other.step(actions)
            assert all(np.array_equal(a, b) for a, b in zip(one[:4], two[:4], strict=True))
    finally:
        other.close()
        sync.close()


def test_threads_with_an_environment_each_get_what_they_get_alone():
    def play(seed):
        env = robohive.make("hive/ElbowPose-v0")
        env.reset(seed=seed)
        return [env.step(np.zeros(env.action_space.shape))[0] for _ in range(50)]

    found = {}
    threads = [threading.Thread(target=lambda k=k: found.update({k: play(k)})) for k in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert all(np.array_equal(found[seed], play(seed)) for seed in range(4))
