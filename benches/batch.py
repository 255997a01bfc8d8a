"""Steps per second of 64 environments on two threads, beside one thread.

    python benches/batch.py [MODEL...]

Two processes, one a number of threads, step the same environments in turns, 100 steps with zero controls a turn. Wall
time: the machine must have both cores to spare. The ratio is that of the least times, which other work on the machine
does not change; the median of the turns' ratios stands beside it. Linux, `numpy`, and a release build of this repository.
"""

import json
import subprocess
import sys

import numpy as np

from step import OWN, ROOT, binary

ENVIRONMENTS, STEPS, ROUNDS = 64, 100, 15


class Batch:
    def __init__(self, path, threads):
        command = [binary(), "bench", path, "--requests", "--batch", str(ENVIRONMENTS), "--threads", str(threads)]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.rate()

    def rate(self):
        self.process.stdin.write(f"rate {STEPS}\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())["steps_per_second"]

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def main(paths):
    print(f"{'model':32} {'one thread':>12} {'two threads':>12} {'ratio':>6} {'median':>7}")
    for path in paths or [str(ROOT / "assets" / f"{name}.xml") for name in OWN]:
        sides = [Batch(path, threads) for threads in (1, 2)]
        rates = np.array([[side.rate() for side in sides] for _ in range(ROUNDS)])
        for side in sides:
            side.close()
        one, two = rates.max(axis=0)
        median = np.median(rates[:, 1] / rates[:, 0])
        print(f"{path.split('/')[-1][:-4]:32} {one:12.0f} {two:12.0f} {two / one:6.2f} {median:7.2f}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
