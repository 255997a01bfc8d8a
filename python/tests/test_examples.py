"""The examples that need nothing beside Gymnasium, at a small size."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[1] / "examples"


def run(name, *arguments):
    """What an example prints."""
    command = [sys.executable, str(EXAMPLES / name), *arguments]
    return subprocess.run(command, check=True, capture_output=True, text=True, timeout=300).stdout


def test_random_rollout():
    printed = run("random_rollout.py", "--episodes", "2")
    returns = [float(found) for found in re.findall(r"return (-?[\d.]+)", printed)]
    assert len(returns) == 2 and all(-100 < found < 100 for found in returns)


def test_vector_rollout():
    printed = run("vector_rollout.py", "--envs", "4", "--steps", "10")
    assert printed.startswith("40 steps in ")


def test_agents():
    pytest.importorskip("pettingzoo")
    printed = run("agents.py", "--steps", "20")
    chaser, evader = (float(found) for found in re.findall(r"return (-?[\d.]+)", printed))
    assert chaser == -evader != 0, "what one wins the other loses"


def test_notebook():
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    notebook = nbformat.read(EXAMPLES / "plot.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=300).execute()
    pictures = [out for cell in notebook.cells for out in cell.get("outputs", []) if "image/png" in out.get("data", {})]
    assert len(pictures) == 3


def test_a_script_for_mujoco():
    printed = run("mujoco_script.py")
    energies = [float(found) for found in re.findall(r"energy ([+-][\d.e+-]+) J", printed)]
    assert len(energies) == 5 and all(abs(found) < 1e-3 for found in energies)
    assert "Jacobian of the tip" in printed
