"""What RoboHive 0.7 returns, recorded by validation/reference/python_infos.py."""

from pathlib import Path

import numpy as np
import pytest
from known_ids import make_or_skip

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
    """Of states that RoboHive reached: its MuJoCo 3.1.3 moves otherwise than 3.12, which is followed here."""
    env = make_or_skip(id, compat="robohive-0.7")
    recorded = np.load(RECORDED / f"{id}.npz")
    first, _ = env.reset(seed=7)
    assert np.array_equal(first, recorded["reset"][0])
    kinds = dict(line.split(": ") for line in bytes(recorded["kinds"]).decode().splitlines())
    worlds = [key for key in recorded if key.startswith("world/")]
    assert len(recorded["reward"]) == 20
    for row, reward in enumerate(recorded["reward"]):
        env.set_env_state({key.removeprefix("world/"): recorded[key][row] for key in worlds})
        observation, ours, terminated, _, infos = env.forward()
        assert ours == pytest.approx(reward, abs=TOLERANCE)
        assert terminated == recorded["terminated"][row]
        assert np.abs(observation - recorded["observation"][row]).max() <= TOLERANCE
        values = dict(flat(infos))
        # The state of the original's hands lacks what the state of all other tasks has.
        beside = {key for key in values if not key.startswith("state/")}
        assert beside == {key for key in kinds if not key.startswith("state/")}
        for key, kind in kinds.items():
            value = np.asarray(values[key])
            if key not in UNCONVERTED:
                assert f"{value.dtype} {value.shape}" == kind, key
            assert np.abs(value.astype(float) - recorded[key][row]).max() <= TOLERANCE, key
