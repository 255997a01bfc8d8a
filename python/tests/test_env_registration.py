"""Ids in Gymnasium's registry."""

import subprocess
import sys

import gymnasium
import pytest
import robohive
from robohive.guests import MODELS

ARM = "hive/FrankaReach-v0"


def run(code: str) -> str:
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_every_id_is_registered_with_the_length_of_its_episodes():
    for id in robohive.ids():
        spec = gymnasium.spec(id)
        assert spec.entry_point == "robohive.envs:RoboHiveEnv" and spec.max_episode_steps > 0
        assert spec.vector_entry_point == "robohive.vector:make_vec"
    assert gymnasium.spec("door-v1").max_episode_steps == 200 and gymnasium.spec("door-v1").namespace is None
    assert gymnasium.spec(ARM).namespace == "hive"


@pytest.mark.parametrize("id", sorted(MODELS))
def test_gymnasiums_own_tasks_are_made_by_their_ids(id):
    env = gymnasium.make(f"robohive:{id}")
    theirs = gymnasium.spec(id.removeprefix("gymnasium/"))
    assert env.spec is not None and env.spec.entry_point == "robohive.envs:RoboHiveEnv"
    assert env.spec.max_episode_steps == theirs.max_episode_steps
    observation, _ = env.reset(seed=0)
    assert env.observation_space.contains(observation)
    vectors = gymnasium.make_vec(f"robohive:{id}", 2, vectorization_mode="vector_entry_point")
    observations, _ = vectors.reset(seed=0)
    assert observations.shape == (2, *observation.shape) and (observations[0] == observation).all()


@pytest.mark.parametrize(
    "code",
    [
        f"import robohive, gymnasium; gymnasium.make('{ARM}')",
        f"import gymnasium, robohive; gymnasium.make('{ARM}')",
        f"import gymnasium; gymnasium.make('robohive:{ARM}')",
        f"import robohive; robohive.make('{ARM}'); import gymnasium; gymnasium.make('{ARM}')",
        f"import robohive, gymnasium as g; g.register(id='{ARM}', entry_point='a:b'); robohive.make('{ARM}')",
        "import gymnasium as g; g.register(id='door-v1', entry_point='a:b'); import robohive;"
        " assert g.spec('door-v1').entry_point == 'a:b'",
    ],
)
def test_imports_in_any_order_register(code):
    run(code)


def test_gymnasium_is_imported_when_an_environment_is_made_and_not_before():
    code = "import robohive, sys; robohive.ids(); print('gymnasium' in sys.modules, len(sys.meta_path))"
    assert run(code).split()[0] == "False"
    missing = (
        "import sys; sys.modules['gymnasium'] = None; import robohive; print(len(robohive.ids()))\n"
        f"try: robohive.make('{ARM}')\nexcept ImportError as error: print(error)"
    )
    assert "gymnasium" in run(missing)


def test_variants_merge_and_override(capsys):
    id = robohive.register_env_variant(
        ARM, {"max_episode_steps": 7, "weighted_reward_keys": {"reach": -2.0}, "frame_skip": 20}
    )
    assert id == "hive/FrankaReach-hor_7-weighted_reward_keys.reach_-2.0-frame_skip_20-v0"
    assert id in capsys.readouterr().out
    variant = robohive.make(id)
    # The id has the weights of its task, which a setting replaces, as in RoboHive.
    assert variant.rwd_keys_wt == {"reach": -2.0}
    assert (variant.horizon, variant.frame_skip, variant.id) == (7, 20, id)
    assert gymnasium.make(id).spec.max_episode_steps == 7
    merged = robohive.register_env_variant(id, {"weighted_reward_keys": {"bonus": 3}}, "hive/Merged-v0", True)
    assert robohive.make(merged).rwd_keys_wt == {"reach": -2.0, "bonus": 3.0}
    bare = robohive.register_env_variant(
        id, {"weighted_reward_keys": {"bonus": 3}}, "hive/Bare-v0", True, override_keys="weighted_reward_keys"
    )
    assert robohive.make(bare).rwd_keys_wt == {"bonus": 3.0}
    assert robohive.make(bare).frame_skip == 20 and robohive.make(bare).horizon == 7
    assert capsys.readouterr().out == ""
    with pytest.raises(gymnasium.error.NameNotFound):
        robohive.register_env_variant("FrankaReachFixd-v0", {})


def test_an_environment_of_its_spec_is_the_same():
    env = robohive.make(ARM, reward_mode="sparse", seed=3)
    again = gymnasium.make(env.spec).unwrapped
    assert again.rwd_mode == "sparse" and again.spec.id == env.spec.id
