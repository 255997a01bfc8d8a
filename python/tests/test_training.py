"""Trainings from Python: the files of the command, the same bits after an interruption, and clear errors."""

import pathlib

import pytest

import robohive
from robohive import training
from robohive.training import Run

ELBOW = "hive/myoElbowPose1D6MRandom-v0"
SMALL = {"episodes": 4, "hidden": [[8], [8]]}


def bytes_of(folder: pathlib.Path, name: str) -> bytes:
    return (folder / name).read_bytes()


@pytest.mark.parametrize("algorithm", training.ALGORITHMS)
def test_an_interrupted_run_ends_in_the_same_bytes(tmp_path, algorithm):
    options = {"algorithm": algorithm, "iterations": 3, "keep_every": 2, "settings": SMALL}
    if algorithm in ("bc", "dagger", "dapg"):
        options |= {"teacher": "muscle_pose", "demonstrations": 2}
    whole, parts = tmp_path / "whole", tmp_path / "parts"
    rows = list(Run.create(ELBOW, whole, threads=2, **options))
    assert [row["iteration"] for row in rows] == [1, 2, 3]
    run = Run.create(ELBOW, parts, threads=1, **options)
    for _ in range(2):
        run.iterate()
    del run
    run = Run.resume(parts)
    assert (run.iterations, run.is_finished) == (2, False)
    assert [row["num_samples"] for row in run] == [rows[2]["num_samples"]]
    for name in ("policy.safetensors", "checkpoint.safetensors", "run.toml"):
        assert bytes_of(whole, name) == bytes_of(parts, name)
    assert run.config == Run.resume(whole).config
    assert [row["stoc_pol_mean"] for row in run.rows] == [row["stoc_pol_mean"] for row in rows]


def test_a_policy_of_a_run_acts(tmp_path):
    run = Run.create(ELBOW, tmp_path / "run", iterations=1, settings=SMALL, environment={"max_episode_steps": 30})
    for row in run:
        assert row["episode_length"] == 30
    assert run.env.horizon == 30
    env = robohive.make(ELBOW)
    env.reset(seed=1)
    action = env.policy(run.policy).act()
    assert env.action_space.contains(action) and action.any()
    assert Run.resume(run.folder, iterations=2).is_finished is False


def test_what_is_wrong_is_refused(tmp_path):
    with pytest.raises(ValueError, match="algorithm is one of npg, .*, not \"ddpg\""):
        training.settings("ddpg")
    assert tuple(name for name in training.ALGORITHMS if training.settings(name)) == training.ALGORITHMS
    for settings, message in [
        ({"horizon": {"gamma": 2.0}}, "horizon.gamma must be from 0 to 1, and is 2"),
        ({"gamma": 0.9}, "unknown field `gamma`"),
        ({"episodes": "many"}, "episodes"),
    ]:
        with pytest.raises(ValueError, match=message):
            Run.create(ELBOW, tmp_path / "wrong", settings=settings)
    with pytest.raises(ValueError, match="bc, dagger and dapg learn from a teacher: name"):
        Run.create(ELBOW, tmp_path / "alone", algorithm="bc", settings=SMALL)
    with pytest.raises(ValueError, match="only bc, dagger and dapg learn from a teacher"):
        Run.create(ELBOW, tmp_path / "taught", teacher="muscle_pose", settings=SMALL)
    with pytest.raises(ValueError, match="run.toml"):
        Run.resume(tmp_path)


def test_variations_are_named_by_what_varies():
    vary = {"learning.fit.rate": [1e-3, 3e-4], "learning.episodes": [8]}
    found = training.variations(ELBOW, seeds=range(2), vary=vary, algorithm="ppo")
    assert list(found)[:2] == ["fit.rate=0.001-episodes=8-seed0", "fit.rate=0.001-episodes=8-seed1"]
    last = found["fit.rate=0.0003-episodes=8-seed1"]
    assert (last["seed"], last["learning"]["episodes"], last["learning"]["fit"]["rate"]) == (1, 8, 3e-4)
    assert training.complete(last)["learning"]["fit"]["rate"] == 3e-4
    for name in ("learning.fit.pace", "rate", "seed.many"):
        with pytest.raises(ValueError, match=f"the setting {name}: there is no|the setting {name}: seed is 1"):
            training.variations(ELBOW, seeds=[1], vary={name: [1]})
