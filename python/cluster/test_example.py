"""The example of a collection, on a local cluster."""

import re
import subprocess
import sys
from pathlib import Path

EXAMPLE = Path(__file__).parents[1] / "examples" / "ray_collection.py"


def test_a_small_collection():
    command = [sys.executable, str(EXAMPLE), "--episodes", "24", "--nodes", "2"]
    printed = subprocess.run(command, check=True, capture_output=True, text=True, timeout=300).stdout
    assert re.search(r"24 episodes, \d+ steps/s, mean return -\d", printed), printed
