"""Steps per second of 64 environments on two threads, beside one thread and beside two processes.

    python benches/batch.py [MODEL...]

Processes that hold the environments step them in turns, 500 steps with zero controls a turn: one thread with half of
them, two such processes at once, two threads with all. Wall time, medians of the ratios within a turn. Two processes
share nothing but the machine, so they show what its second core is worth. Needs two idle cores, `numpy`, Linux, and the
command built with `cargo build --profile dist`.
"""

import json
import subprocess
import sys

import numpy as np

from step import OWN, ROOT, binary

ENVIRONMENTS, STEPS, ROUNDS = 64, 500, 7


class Batch:
    def __init__(self, path, threads):
        command = [binary(), "bench", path, "--requests", "--batch", str(ENVIRONMENTS * threads // 2),
                   "--threads", str(threads)]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        rates([self], 50)

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def rates(sides, steps=STEPS):
    """Steps per second of batches that run at the same time, summed."""
    for side in sides:
        side.process.stdin.write(f"rate {steps}\n")
        side.process.stdin.flush()
    return sum(json.loads(side.process.stdout.readline())["steps_per_second"] for side in sides)


def main(paths):
    print("| model | one thread [steps/s] | two processes | two threads | threads / processes |\n|---|---|---|---|---|")
    for path in paths or [str(ROOT / "assets" / f"{name}.xml") for name in OWN]:
        one, other, two = (Batch(path, threads) for threads in (1, 1, 2))
        turns = np.array([[rates([one]), rates([one, other]), rates([two])] for _ in range(ROUNDS)])
        for side in (one, other, two):
            side.close()
        alone, processes, threads = turns.T
        ratios = [np.median(x) for x in (alone, processes / alone, threads / alone, threads / processes)]
        print("| {} | {:.0f} | {:.2f} x | {:.2f} x | {:.2f} |".format(path.split("/")[-1][:-4], *ratios), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
