"""Environments whose robot is hardware: simulated servos behind the real driver, in virtual time."""

import copy
import pickle
from pathlib import Path

import gymnasium
import numpy as np
import pytest
import robohive

ID = "hive/QuadrupedWalk-v0"
CONFIG = Path(__file__).parents[2] / "assets/quadruped/servos.toml"
REHEARSED = {"is_hardware": True, "robot_config": CONFIG, "rehearse": True}


def played(env, steps=20):
    env.reset(seed=1)
    rows = [env.step(np.zeros(12))[:3] for _ in range(steps)]
    env.close()
    return np.array([row[0] for row in rows]), np.array([row[1] for row in rows])


def test_a_rehearsed_episode_is_the_simulated_one_within_what_servos_count():
    rehearsed = robohive.make(ID, arm=True, **REHEARSED)
    joints = slice(7, 19)
    simulated = robohive.make(ID)
    rehearsed.reset(seed=1)
    simulated.reset(seed=1)
    for _ in range(20):
        live = rehearsed.step(np.zeros(12))
        simulated.step(np.zeros(12))
        mirrored, model = rehearsed.get_env_state()["qpos"], simulated.get_env_state()["qpos"]
        assert live[0].shape == simulated.get_obs().shape
        assert np.isfinite(live[1]) and not live[2]
    # A servo counts in 1.5 mrad, and the legs of both stand on the ground under the same weight.
    assert np.abs(mirrored[joints] - model[joints]).max() < 0.05
    assert not np.array_equal(mirrored[joints], model[joints])


def test_a_rehearsal_is_the_same_every_time_and_config_path_means_the_same():
    first = played(robohive.make(ID, arm=True, **REHEARSED))
    settings = {"is_hardware": True, "config_path": str(CONFIG), "rehearse": True, "arm": True}
    second = played(gymnasium.make(ID, **settings))
    for one, other in zip(first, second, strict=True):
        assert np.array_equal(one, other)


def test_nothing_moves_unarmed_and_the_error_names_the_device():
    env = robohive.make(ID, **REHEARSED)
    with pytest.raises(robohive.HardwareError, match="nothing moves before it is armed") as raised:
        env.reset(seed=1)
    assert (raised.value.device, raised.value.kind) == ("legs", "refusal")
    restored = pickle.loads(pickle.dumps(raised.value))
    assert (str(restored), restored.device, restored.kind) == (str(raised.value), "legs", "refusal")
    assert isinstance(raised.value, RuntimeError)


def test_a_dry_run_says_what_it_would_send(capfd):
    env = robohive.make(ID, dry_run=True, **REHEARSED)
    env.reset(seed=1)
    env.step(np.zeros(12))
    assert "legs: would be sent [3.1416" in capfd.readouterr().err


def test_ready_gets_the_start_pose_and_its_exception_passes():
    poses = []
    env = robohive.make(ID, arm=True, ready=poses.append, **REHEARSED)
    env.reset(seed=1)
    env.reset()
    assert [pose.shape for pose in poses] == [(19,), (19,)]
    assert 0.1 < poses[0][2] < 1.0

    class Absent(Exception):
        pass

    def refuse(_):
        raise Absent("nobody is here")

    env = robohive.make(ID, arm=True, ready=refuse, **REHEARSED)
    with pytest.raises(Absent, match="nobody is here"):
        env.reset(seed=1)


def test_the_terminal_asks_between_episodes(monkeypatch):
    from robohive import live

    asked = live.asked(True, {}, CONFIG, True, False, False, None, None)
    questions = []
    monkeypatch.setattr("builtins.input", questions.append)
    asked["ready"](np.zeros(19))
    assert "press Enter" in questions[0]


def test_a_port_that_is_not_there_is_named(tmp_path):
    config = tmp_path / "absent.toml"
    config.write_text(CONFIG.read_text().replace("/dev/ttyUSB0", "/dev/ttyNONE"))
    with pytest.raises(robohive.HardwareError, match="/dev/ttyNONE") as raised:
        robohive.make(ID, is_hardware=True, robot_config=config, arm=True)
    assert (raised.value.device, raised.value.kind) == ("legs", "connection")
    config.write_text(CONFIG.read_text().replace('"dynamixel"', '"dinamixel"'))
    with pytest.raises(robohive.HardwareError, match="did you mean 'dynamixel'") as raised:
        robohive.make(ID, is_hardware=True, robot_config=config)
    assert (raised.value.device, raised.value.kind) == ("legs", "")


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"arm": True}, ValueError, "arm is about devices: give is_hardware=True"),
        ({"robot_config": CONFIG}, ValueError, "robot_config is about devices"),
        ({**REHEARSED, "arm": True, "dry_run": True}, ValueError, "choose one"),
        ({**REHEARSED, "flight": "folder"}, ValueError, "rehearse=True has none"),
        ({"is_hardware": True, "rehearse": True}, ValueError, "name it as robot_config"),
        ({**REHEARSED, "robot_config": "no.toml"}, FileNotFoundError, "there is no file no.toml"),
        ({**REHEARSED, "robot_config": __file__}, ValueError, "test_env_hardware.py"),
    ],
)
def test_arguments_are_checked(arguments, error, message):
    with pytest.raises(error, match=message):
        robohive.make(ID, **arguments)


def test_one_robot_is_neither_copied_nor_many():
    env = robohive.make(ID, **REHEARSED)
    for copied in (copy.deepcopy, pickle.dumps):
        with pytest.raises(TypeError, match="the robot is there only once"):
            copied(env)
    with pytest.raises(ValueError, match="a robot is there only once, and a vector has many"):
        gymnasium.make_vec(ID, 2, **REHEARSED)
    assert gymnasium.make_vec(ID, 2, is_hardware=False).num_envs == 2
