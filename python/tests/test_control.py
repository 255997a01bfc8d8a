"""Controllers from Python: they solve what they solve from Rust, and say what they do not serve."""

import numpy as np
import pytest

import robohive
from robohive.control import controllers

REACH = "hive/FrankaReach-v0"


def played(env, controller, seed):
    """Actions of an episode until it is solved, and whether it was."""
    _, info = env.reset(seed=seed)
    controller.reset(seed=seed)
    actions = []
    while not info["solved"]:
        actions.append(controller.act())
        _, _, _, truncated, info = env.step(actions[-1])
        if truncated:
            break
    return np.array(actions), bool(info["solved"])


def test_the_best_controller_solves_its_task_and_repeats():
    env = robohive.make(REACH)
    first, solved = played(env, env.controller(), 3)
    assert solved and 5 < len(first) < 50
    assert env.action_space.contains(first[0])
    again, _ = played(env, env.controller("reach"), 3)
    np.testing.assert_array_equal(first, again)
    other, _ = played(env, env.controller("reach"), 4)
    assert not np.array_equal(first, other)


def test_a_controller_is_a_policy_that_notices_new_episodes():
    env = robohive.make(REACH)
    env.reset(seed=5)
    paths = env.examine_policy(env.controller(), horizon=50, num_episodes=3, mode="evaluation")
    assert env.evaluate_success(paths) == 100.0
    assert not np.array_equal(paths[0]["actions"][0], paths[1]["actions"][0])


def test_the_planner_plays_what_no_controller_is_made_for():
    env = robohive.make("hive/QuadrupedWalk-v0")
    assert controllers(env.id) == []
    planner = env.controller("planner")

    def acted(seed):
        env.reset(seed=1)
        planner.reset(seed=seed)
        return planner.act()

    first, other = acted(3), acted(4)
    assert env.action_space.contains(first) and not np.array_equal(first, other)
    np.testing.assert_array_equal(acted(3), first)


def test_lists_name_what_serves_an_id():
    assert [name for name, _ in controllers("hive/SpotTurn-v0")] == ["trot"]
    assert [name for name, _ in controllers("hive/AtlasTurn-v0")] == ["walk"]
    everything = controllers()
    assert len(everything) == len({name for name, _ in everything}) > 10
    assert all(summary for _, summary in everything)


def test_errors_name_what_would_do():
    env = robohive.make(REACH)
    with pytest.raises(ValueError, match="no controller rech; hive/FrankaReach-v0 is served by reach"):
        env.controller("rech")
    with pytest.raises(ValueError, match="serves acrobot, not hive/FrankaReach-v0"):
        env.controller("acrobot")
    with pytest.raises(ValueError, match="no controller is made for hive/QuadrupedWalk-v0"):
        robohive.make("hive/QuadrupedWalk-v0").controller()
    with pytest.raises(ValueError, match="seed"):
        env.controller().reset(seed=-1)
