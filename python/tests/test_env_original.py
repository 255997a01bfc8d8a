"""What RoboHive 0.7 returns, recorded by validation/reference/python_infos.py."""

from pathlib import Path

import numpy as np
import pytest
from conftest import make_or_skip

RECORDED = Path(__file__).parent / "recorded"
#: Terms that RoboHive leaves as the integers and truth values that it computes them from; here all terms are numbers.
UNCONVERTED = {"rwd_dict/bonus", "rwd_dict/penalty"}
TOLERANCE = 1e-9


def flat(infos, above=""):
    for key, value in infos.items():
        if isinstance(value, dict):
            yield from flat(value, f"{above}{key}/")
        elif value is not None:
            yield above + key, value


@pytest.mark.parametrize("id", ["door-v1", "FrankaReachRandom-v0"])
def test_infos_are_the_originals(id):
    env = make_or_skip(id, compat="robohive-0.7", seed=7)
    recorded = np.load(RECORDED / f"{id}.npz")
    first, _ = env.reset(seed=7)
    assert np.abs(first - recorded["reset"][0]).max() <= TOLERANCE
    rng = np.random.default_rng(7)
    env = env.unwrapped
    kinds = dict(line.split(": ") for line in bytes(recorded["kinds"]).decode().splitlines())
    for step in range(100):
        observation, reward, terminated, _, infos = env.step(rng.uniform(-1, 1, env.action_space.shape))
        assert reward == pytest.approx(recorded["reward"][step], abs=TOLERANCE)
        assert terminated == recorded["terminated"][step]
        if step % 10 != 9:
            continue
        assert np.abs(observation - recorded["observation"][step // 10]).max() <= TOLERANCE
        ours = dict(flat(infos))
        # The state of the original's hands lacks what the state of all other tasks has.
        assert {key for key in ours if not key.startswith("state/")} == {
            key for key in kinds if not key.startswith("state/")
        }
        for key, kind in kinds.items():
            value = np.asarray(ours[key])
            if key not in UNCONVERTED:
                assert f"{value.dtype} {value.shape}" == kind, key
            assert np.abs(value.astype(float) - recorded[key][step // 10]).max() <= TOLERANCE, key
