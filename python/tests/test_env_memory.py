"""Environments give back their memory; python/benches/memory.py does the same with a million steps and ten thousand makes."""

import subprocess
import sys
from pathlib import Path

BENCH = Path(__file__).parents[1] / "benches" / "memory.py"


def test_memory_does_not_grow():
    done = subprocess.run(
        [sys.executable, BENCH, "20000", "400"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "made and closed" in done.stdout
