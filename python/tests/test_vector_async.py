"""Sending and receiving, as EnvPool does it; forks and threads."""

import os
import threading

import numpy as np
import pytest
from robohive.vector import RoboHiveVectorEnv

ID = "hive/ElbowPose-v0"


def make(num_envs=5, **kwargs):
    return RoboHiveVectorEnv(ID, num_envs, **{"max_episode_steps": 6, "num_threads": 2, **kwargs})


def action(index, step, envs):
    return np.sin(index * 31 + step * 7 + np.arange(envs.single_action_space.shape[0])).astype(np.float32)


def test_each_environment_yields_what_stepping_all_yields():
    envs = make()
    expected = [[(row, 0.0)] for row in envs.reset(seed=2)[0]]
    for step in range(15):
        observations, rewards, *_ = envs.step(np.array([action(k, step, envs) for k in range(5)]))
        for index in range(5):
            expected[index].append((observations[index], rewards[index]))
    envs = make(batch_size=2)
    envs.async_reset(seed=2)
    seen = [[] for _ in range(5)]
    while envs.under_way >= 2:
        observations, rewards, terminated, truncated, infos = envs.recv()
        assert observations.shape[0] == len(rewards) == len(terminated) == len(truncated) == 2
        ids = infos["env_id"]
        assert np.allclose(infos["time"], [len(seen[k]) % 7 * envs.get_attr("dt")[0] for k in ids])
        for row, index in enumerate(ids):
            seen[index].append((observations[row], rewards[row]))
        going = [index for index in ids if len(seen[index]) <= 15]
        envs.send(np.array([action(k, len(seen[k]) - 1, envs) for k in going]).reshape(len(going), envs.single_action_space.shape[0]), going)
    for ours, theirs in zip(seen, expected, strict=True):
        for one, other in zip(ours, theirs, strict=False):
            assert np.array_equal(one[0], other[0]) and one[1] == other[1]
    # A batch takes two: the last one may be left where it is.
    assert sum(len(rows) < 16 for rows in seen) <= 1


def test_what_cannot_be_sent_or_received():
    envs = make()
    envs.reset(seed=0)
    width = envs.single_action_space.shape[0]
    with pytest.raises(ValueError, match="5 environments were asked for, and 0 are under way"):
        envs.recv()
    envs.send(np.zeros((1, width)), [3])
    with pytest.raises(ValueError, match="environment 3 is still under way"):
        envs.send(np.zeros((1, width)), [3])
    with pytest.raises(ValueError, match="1 environments are still under way"):
        envs.step(np.zeros((5, width)))
    with pytest.raises(ValueError, match="there is no environment 5"):
        envs.send(np.zeros((1, width)), [5])
    with pytest.raises(IndexError, match="from 0 on"):
        envs.send(np.zeros((1, width)), [-1])
    with pytest.raises(ValueError, match="named twice"):
        envs.async_reset(env_id=[1, 1])
    with pytest.raises(ValueError, match="actions have shape"):
        envs.send(np.zeros((2, width)), [1])
    with pytest.raises(ValueError, match="environment 0: value 0 of the action is NaN"):
        envs.send(np.full((1, width), np.nan), [1])
    assert envs.recv(1)[4]["env_id"].tolist() == [3]
    envs.async_reset()
    envs.close()


def test_a_forked_process_has_threads_of_its_own():
    envs = make()
    envs.reset(seed=0)
    zeros = np.zeros(envs.action_space.shape, np.float32)
    first = envs.step(zeros)[0]
    envs.send(zeros)
    envs.recv()
    child = os.fork()
    if child == 0:
        # No exception may leave the child, whose tests would go on.
        code = 1
        try:
            ours = envs.reset(seed=0)[0]
            same = np.array_equal(envs.step(zeros)[0], first)
            envs.async_reset(seed=0)
            again = envs.recv()
            rows = again[0][np.argsort(again[4]["env_id"])]
            code = 0 if same and np.array_equal(rows, ours) else 2
        finally:
            os._exit(code)
    assert os.waitpid(child, 0)[1] == 0
    envs.step(zeros)


def test_calls_from_two_threads_are_refused_or_take_turns():
    envs = make(64, num_threads=1)
    envs.reset(seed=0)
    zeros = np.zeros(envs.action_space.shape, np.float32)
    errors = []

    def call():
        for _ in range(50):
            try:
                envs.step(zeros)
            except RuntimeError as error:
                errors.append(str(error))

    threads = [threading.Thread(target=call) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all("another thread" in error for error in errors)


def test_the_interpreter_runs_while_environments_step():
    envs = make(128, num_threads=1, infos="none")
    envs.reset(seed=0)
    zeros = np.zeros(envs.action_space.shape, np.float32)
    stop, count = threading.Event(), [0]

    def spin():
        while not stop.is_set():
            count[0] += 1

    thread = threading.Thread(target=spin)
    thread.start()
    for _ in range(20):
        envs.step(zeros)
    stop.set()
    thread.join()
    assert count[0] > 0 and envs._core.released_time() > 0
