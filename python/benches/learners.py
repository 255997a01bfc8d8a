#!/usr/bin/env python3
"""Other people's learners on environments of this package: their examples in `python/examples`, one after another.

    python python/benches/learners.py [--only TEXT] [--write FILE]

This interpreter has this repository's wheel, torch, stable-baselines3, torchrl and lerobot. Each learner has one thread. Prints,
as a table, how many steps of the environment or samples of a dataset a learner takes in a second of its learning, and what
its first report says beside its last.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass

EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"
BEGIN, END = "<!-- learners table begins -->", "<!-- learners table ends -->"


@dataclass
class Learner:
    """An example, and how its speed and results read in what it prints."""

    name: str
    example: str
    words: list[str]
    speed: str
    result: str


LEARNERS = [
    Learner("PPO, one file on a vector", "ppo.py", ["--updates", "30"], r"(\d+) steps/s", r"mean return -?[\d.]+, solved \d+%"),
    Learner("PPO of TorchRL", "ppo_torchrl.py", ["--frames", "20000"], r"(\d+) steps/s", r"mean return -?[\d.]+"),
    Learner("SAC of Stable-Baselines3", "sac_sb3.py", ["--steps", "5000"], r"(\d+) steps/s", r"-?[\d.]+ (?:before|after)"),
    Learner("ACT of LeRobot", "act_lerobot.py", ["FOLDER"], r"(\d+) samples a second", r"error of an action [\d.]+|[\d.]+ % of \d+ episodes"),
]


def row(learner: Learner) -> str:
    """Runs an example: its row of the table."""
    with tempfile.TemporaryDirectory() as folder:
        words = [folder if word == "FOLDER" else word for word in learner.words]
        command = [sys.executable, "-u", str(EXAMPLES / learner.example), *words]
        environment = os.environ | {"OMP_NUM_THREADS": "1", "RAYON_NUM_THREADS": "1"}
        printed = ""
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as running:
            for line in running.stdout:
                print(line, end="", flush=True)
                printed += line
        if running.returncode:
            raise SystemExit(f"{learner.example} ended with {running.returncode}")
    speed, results = re.findall(learner.speed, printed)[-1], re.findall(learner.result, printed)
    shown = " ".join([learner.example, *learner.words])
    return f"| {learner.name} | `{shown}` | {speed} | {results[0]} | {results[-1]} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="learners whose name contains this")
    parser.add_argument("--write", type=pathlib.Path, help="file whose table is replaced")
    chosen = parser.parse_args()
    rows = [row(learner) for learner in LEARNERS if chosen.only in learner.name]
    table = "\n".join(["| learner | example | steps or samples a second | first report | last report |", "|---|---|---|---|---|", *rows])
    print(table)
    if chosen.write:
        text = chosen.write.read_text()
        begin, end = text.index(BEGIN) + len(BEGIN), text.index(END)
        chosen.write.write_text(f"{text[:begin]}\n{table}\n{text[end:]}")


if __name__ == "__main__":
    main()
