"""The examples that learn, at a small size."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[1] / "examples"


def run(name, *arguments):
    """What an example prints."""
    command = [sys.executable, str(EXAMPLES / name), *arguments]
    return subprocess.run(command, check=True, capture_output=True, text=True, timeout=600).stdout


def test_ppo_improves_on_random_actions():
    pytest.importorskip("torch")
    returns = [float(found) for found in re.findall(r"mean return (-?[\d.]+)", run("ppo.py", "--updates", "60", "--envs", "16"))]
    assert len(returns) == 6 and returns[-1] > returns[0]


def test_soft_actor_critic():
    pytest.importorskip("stable_baselines3")
    assert re.search(r"after 300 steps", run("sac_sb3.py", "--steps", "300"))


def test_collector_of_torchrl():
    pytest.importorskip("torchrl")
    assert run("torchrl_collector.py", "--frames", "1000").count("500 frames, ") == 2
