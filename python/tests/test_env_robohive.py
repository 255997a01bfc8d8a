"""RoboHive's methods by their names."""

import numpy as np
import pytest
import robohive
from known_ids import make_or_skip

METHODS = (
    "compute_path_rewards evaluate_success examine_policy forward get_env_infos get_env_state get_exteroception"
    " get_input_seed get_obs get_obs_dict get_proprioception get_reward_dict get_visuals mj_render reset seed"
    " set_env_state step truncate_paths"
).split()


class Drift:
    """A policy by mjrl's protocol: the exploring action differs from the one to evaluate."""

    def __init__(self, size):
        self.rng = np.random.default_rng(0)
        self.size = size

    def get_action(self, observation):
        mean = np.full(self.size, 0.2)
        return mean + 0.1 * self.rng.standard_normal(self.size), {"evaluation": mean}


class Log(dict):
    log_kv = dict.__setitem__


def test_methods_and_properties_are_there(env):
    assert all(callable(getattr(env, name)) for name in METHODS)
    assert (env.id, env.horizon, env.frame_skip) == ("hive/FrankaReach-v0", 50, 40)
    assert (env.dt, env.time) == (pytest.approx(0.08), 0.0)
    assert env.obs_keys == ["qp_robot", "qv_robot", "reach_err"]
    assert env.proprio_keys == ["qp_robot", "qv_robot"] and env.visual_keys is None
    assert (env.rwd_mode, env.normalize_act) == ("dense", True)
    assert env.rwd_keys_wt == {"reach": -1.0, "bonus": 4.0, "penalty": -50.0}


def test_observations_agree_with_each_other(env):
    env.step(np.full(8, 0.3))
    observation, reward, done, truncated, infos = env.forward()
    rows = env.get_obs_dict(env.sim)
    assert np.array_equal(np.concatenate([rows[key] for key in env.obs_keys]), observation)
    assert np.array_equal(env.get_obs(), observation)
    assert rows["time"].shape == (1,) and env.obs_dict["time"].shape == ()
    assert reward == env.get_reward_dict(rows)["dense"] == infos["rwd_dense"] and not (done or truncated)
    time, vector, parts = env.get_proprioception()
    assert time == env.time and np.array_equal(vector, np.concatenate([parts["qp_robot"], parts["qv_robot"]]))
    assert env.get_exteroception() is None and env.visual_dict == {}
    with pytest.raises(ValueError, match="compute_path_rewards"):
        env.get_reward_dict({**rows, "time": rows["time"] + 1})


def test_tasks_without_proprioception_have_none():
    env = make_or_skip("door-v1")
    assert env.get_proprioception() == (None, None, None) and env.proprio_dict is None


def test_states_are_returned_to(env):
    for _ in range(5):
        env.step(np.full(8, 0.3))
    state, before = env.get_env_state(), env.get_env_infos()
    for _ in range(5):
        env.step(np.full(8, -0.3))
    assert not np.array_equal(env.get_env_state()["qpos"], state["qpos"])
    env.set_env_state(state)
    after = env.get_env_infos()
    assert all(np.array_equal(after["state"][key], value) for key, value in state.items() if value is not None)
    assert after["rwd_dense"] == pytest.approx(before["rwd_dense"], abs=1e-12)
    assert env.get_env_state()["mocap_pos"] is None


@pytest.mark.parametrize(
    ("id", "key"),
    [("door-v1", "door_body_pos"), ("hammer-v1", "board_pos"), ("pen-v1", "desired_orien"), ("relocate-v1", "obj_pos")],
)
def test_the_hands_have_their_own_states(id, key):
    env = make_or_skip(id, seed=0)
    env.reset()
    states = [env.get_env_state()]
    env.reset()
    states.append(env.get_env_state())
    assert not np.array_equal(states[0][key], states[1][key])
    # As RoboHive's recordings have it: positions, velocities and the task's own key.
    env.set_env_state({name: states[0][name] for name in ("qpos", "qvel", key)})
    assert np.allclose(env.get_env_state()[key], states[0][key], atol=1e-12)


def test_a_reset_takes_positions(env):
    qpos = env.get_env_state()["qpos"]
    qpos[0] += 0.1
    for observation, infos in (
        env.reset(seed=1, reset_qpos=qpos),
        env.reset(seed=1, options={"reset_qpos": qpos, "reset_qvel": np.zeros(env.sim.model.nv)}),
    ):
        assert observation[0] == pytest.approx(qpos[0]) and infos["state"]["qpos"][0] == pytest.approx(qpos[0])


def test_seeds_are_roboHives(env):
    assert env.seed(5) == [5] and env.get_input_seed() == 5
    first = env.reset()[0]
    assert np.array_equal(env.reset(seed=5)[0], first)


def test_the_simulation_can_be_read(env):
    model, data = env.sim.model, env.sim.data
    assert data.qpos.shape == (model.nq,) and data.time == 0.0 and model.opt.timestep == 0.002
    assert data.site_xpos[model.site_name2id("grasp")].shape == (3,)
    for change in (
        lambda: data.qpos.__setitem__(0, 1.0),
        lambda: setattr(data, "qpos", 1.0),
        lambda: data.qpoz,
        lambda: model.body_name2id("nobody"),
    ):
        with pytest.raises((ValueError, AttributeError)):
            change()


def test_policies_are_examined(env, tmp_path):
    horizon = 12
    paths = env.examine_policy(Drift(8), horizon=horizon, num_episodes=2)
    assert len(paths) == 2
    path = paths[0]
    assert path["observations"].shape == (horizon, 60) and path["actions"].shape == (horizon, 8)
    assert path["rewards"].shape == (horizon,) and path["terminated"] is False
    assert path["env_infos"]["solved"].shape == (horizon,)
    assert path["env_infos"]["state"]["qpos"].shape == (horizon, env.sim.model.nq)
    for name, value in (("horizon", 0), ("horizon", -1), ("num_episodes", -1)):
        with pytest.raises(ValueError, match=f"^{name} is a whole number from"):
            env.examine_policy(Drift(8), **{name: value})
    evaluated = env.examine_policy(Drift(8), horizon=3, mode="evaluation")[0]
    assert (evaluated["actions"] == 0.2).all()
    env.examine_policy(
        Drift(8), horizon=3, render="offscreen", frame_size=(64, 48), output_dir=f"{tmp_path}/", filename="film"
    )
    assert (tmp_path / "film0.mp4").read_bytes()[4:8] == b"ftyp"
    with pytest.raises(ValueError, match="onscreen, offscreen or None"):
        env.examine_policy(Drift(8), render="aside")
    with pytest.raises(ValueError, match="exploration or evaluation"):
        env.examine_policy(Drift(8), mode="best")


def test_paths_are_rewarded_truncated_and_evaluated(env):
    path = env.examine_policy(Drift(8), horizon=20)[0]
    again = env.compute_path_rewards({"observations": path["observations"]})
    # The reward of a step belongs to the observation after it.
    assert np.allclose(again["rewards"][:-1], path["rewards"][:-1], atol=1e-12)
    both = env.compute_path_rewards({"observations": np.stack([path["observations"]] * 2)})
    assert both["rewards"].shape == both["done"].shape == (2, 20)
    done = {"done": np.array([False, True, True]), "rewards": np.arange(3.0), "env_infos": {"a": np.arange(3)}}
    open_ended = {"done": np.zeros(3, bool), "rewards": np.arange(3.0)}
    cut, whole = env.truncate_paths([done, open_ended])
    assert cut["terminated"] and len(cut["rewards"]) == len(cut["env_infos"]["a"]) == 2
    assert not whole["terminated"] and len(whole["rewards"]) == 3

    def solved(steps):
        infos = {"solved": np.arange(50) < steps, "rwd_sparse": np.ones(50), "rwd_dense": np.full(50, 2.0)}
        return {"env_infos": infos}

    log = Log()
    assert env.evaluate_success([solved(5), solved(6), solved(0), solved(50)], log) == 50.0
    assert log == {"rwd_sparse": 1.0, "rwd_dense": 2.0, "success_percentage": 50.0}
    assert env.evaluate_success([solved(6)], successful_steps=6) == 0.0
    with pytest.raises(ValueError, match="no paths"):
        env.evaluate_success([])


def test_a_script_that_examines_an_environment_runs():
    """As RoboHive's tutorials open an environment, with `robohive` imported for its ids."""
    import gymnasium as gym

    env = gym.make("hive/ElbowPose-v0", **{"reward_mode": "dense"})
    env = env.unwrapped
    env.seed(123)
    obs, *_ = env.reset()
    rollout = []
    for _ in range(2):
        obs, *_ = env.reset()
        done, t = False, 0
        obs, rwd, done, *_, env_info = env.forward(update_exteroception=True)
        while t < env.horizon and not done:
            action = env.action_space.sample()
            time, proprioception, parts = env.get_proprioception()
            obs, rwd, done, *_, env_info = env.step(action, update_exteroception=True)
            rollout.append((env_info["time"], rwd, env_info["state"]["qpos"], env_info["obs_dict"]))
            t += 1
    assert len(rollout) > 2 and rollout[0][0] == pytest.approx(env.dt)


def test_a_script_that_plays_back_states_runs():
    """As RoboHive's logs are played back: states are set, observed and compared."""
    env = robohive.make("hive/FrankaReach-v0", seed=0)
    env.reset()
    log = [env.step(env.action_space.sample())[-1] for _ in range(10)]
    replay = robohive.make("hive/FrankaReach-v0")
    replay.reset()
    for infos in log:
        replay.set_env_state(infos["state"])
        observation, reward, *_, again = replay.forward()
        for key, row in infos["obs_dict"].items():
            assert np.allclose(again["obs_dict"][key], row, atol=1e-9), key
        assert reward == pytest.approx(infos["rwd_dense"], abs=1e-9)
