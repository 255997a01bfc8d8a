"""How many of our sines and cosines are not correctly rounded, and how many differ from the C library's.

cargo run --release -p robohive-physics --example sines -- 300000 | python validation/reference/sines.py

Needs `pip install mpmath`. The C library is the one that Python calls.
"""

import math
import struct
import sys

import mpmath


def number(bits):
    return struct.unpack(">d", bytes.fromhex(bits))[0]


def main():
    mpmath.mp.prec = 200
    calls = misrounded = library = unlike = 0
    for line in sys.stdin:
        x, *ours = map(number, line.split())
        exact = mpmath.mpf(x)
        for value, true, theirs in zip(ours, (mpmath.sin(exact), mpmath.cos(exact)), (math.sin(x), math.cos(x))):
            calls += 1
            rounded = float(true)
            misrounded += value != rounded
            library += theirs != rounded
            unlike += value != theirs
    if calls == 0:
        sys.exit("sines.py: no lines on standard input")
    print(f"{calls} calls: ours not correctly rounded {misrounded}, the C library's {library}, different {unlike}")


if __name__ == "__main__":
    main()
