"""How many of our sines, cosines and the like are not correctly rounded, and how many differ from the C library's.

cargo run --release -p robohive-physics --example sines -- 300000 | python validation/reference/sines.py

Needs `pip install mpmath`. The C library is the one that Python calls.
"""

import math
import struct
import sys

import mpmath

# In the order of the columns, of arguments x and y: exactly and by the C library.
FUNCTIONS = {
    "sin": (lambda x, y: mpmath.sin(x), lambda x, y: math.sin(x)),
    "cos": (lambda x, y: mpmath.cos(x), lambda x, y: math.cos(x)),
    "tan": (lambda x, y: mpmath.tan(x), lambda x, y: math.tan(x)),
    "acos": (lambda x, y: mpmath.acos(x / 4), lambda x, y: math.acos(x / 4)),
    "atan2": (lambda x, y: mpmath.atan2(x, y), lambda x, y: math.atan2(x, y)),
}


def number(bits):
    return struct.unpack(">d", bytes.fromhex(bits))[0]


def main():
    mpmath.mp.prec = 200
    calls = 0
    counts = {name: [0, 0, 0] for name in FUNCTIONS}
    for line in sys.stdin:
        x, y, *ours = map(number, line.split())
        calls += 1
        for value, (name, (exact, library)) in zip(ours, FUNCTIONS.items(), strict=True):
            rounded, theirs = float(exact(mpmath.mpf(x), mpmath.mpf(y))), library(x, y)
            for k, differs in enumerate([value != rounded, theirs != rounded, value != theirs]):
                counts[name][k] += differs
    if calls == 0:
        sys.exit("sines.py: no lines on standard input")
    for name, (misrounded, library, unlike) in counts.items():
        print(f"{name}: {calls} calls, ours not correctly rounded {misrounded}, the C library's {library}, different {unlike}")


if __name__ == "__main__":
    main()
