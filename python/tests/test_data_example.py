"""The example runs as it stands."""

import subprocess
import sys
from pathlib import Path

EXAMPLE = Path(__file__).parents[1] / "examples" / "write_datasets.py"


def test_datasets(tmp_path):
    done = subprocess.run(
        [sys.executable, str(EXAMPLE), str(tmp_path), "--episodes", "3"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "3 trials, observations (51, 4)" in done.stdout and "returns from" in done.stdout
