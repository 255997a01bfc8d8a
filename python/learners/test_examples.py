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


def test_ppo_of_torchrl_improves_on_random_actions():
    pytest.importorskip("torchrl")
    printed = run("ppo_torchrl.py", "--frames", "20000")
    returns = [float(found) for found in re.findall(r"mean return (-?[\d.]+), \d+ steps/s", printed)]
    assert len(returns) == 2 and returns[-1] > returns[0]


def test_action_chunking_transformer_of_lerobot(tmp_path):
    pytest.importorskip("lerobot", reason="not checked: the example of LeRobot (pip install lerobot==0.4.4)")
    printed = run("act_lerobot.py", str(tmp_path), "--demonstrations", "20", "--updates", "1000", "--episodes", "20")
    assert "20 episodes, 1000 steps by reach" in printed
    errors = [float(found) for found in re.findall(r"error of an action ([\d.]+)", printed)]
    solved = float(re.search(r"([\d.]+) % of 20 episodes", printed)[1])
    assert len(errors) == 10 and errors[-1] < 0.5 * errors[0] and solved >= 15.0
