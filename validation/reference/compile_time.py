#!/usr/bin/env python3
"""Compile times beside MuJoCo's, in one run.

    pip install mujoco==3.12.0
    python compile_time.py --binary target/release/robohive --corpus FOLDER --list FILE [--runs N]

Ours is the wall time of a whole `robohive inspect` process. MuJoCo's is the time of `MjModel.from_xml_path` alone, in
a fresh process each time, so that its asset cache is cold. Runs alternate; the table shows medians.
"""

import argparse
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from record import TEMPLATE_OBJECT, repair

CODE = ("import mujoco, sys, time; began = time.perf_counter(); mujoco.MjModel.from_xml_path(sys.argv[1]); "
        "print(time.perf_counter() - began)")


def fill(path):
    """Template text replaced, beside the template, so that relative paths keep their meaning."""
    text = path.read_text(errors="surrogateescape")
    if "OBJECT_NAME" not in text:
        return path
    filled = path.with_name(f"{path.stem}.{TEMPLATE_OBJECT}.xml")
    filled.write_text(text.replace("OBJECT_NAME", TEMPLATE_OBJECT), errors="surrogateescape")
    return filled


def theirs(path):
    run = subprocess.run([sys.executable, "-c", CODE, str(path)], capture_output=True, text=True)
    return float(run.stdout) if run.returncode == 0 else None


def ours(binary, path):
    began = time.perf_counter()
    run = subprocess.run([binary, "inspect", "--json", str(path)], capture_output=True)
    return time.perf_counter() - began if run.returncode == 0 else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", required=True)
    parser.add_argument("--corpus", required=True, type=Path, help="folder of models; it is copied, not changed")
    parser.add_argument("--list", required=True, type=Path)
    parser.add_argument("--runs", type=int, default=3)
    args = parser.parse_args()
    ratios = []
    with tempfile.TemporaryDirectory(prefix="corpus-") as copy:
        shutil.copytree(args.corpus, copy, dirs_exist_ok=True)
        repair(copy)
        print("| model | ours [s] | MuJoCo [s] | ratio |\n|---|---|---|---|")
        for line in args.list.read_text().split():
            path = fill(Path(copy) / line)
            pairs = [(ours(args.binary, path), theirs(path)) for _ in range(args.runs)]
            if any(value is None for pair in pairs for value in pair):
                print(f"| {line} | - | - | one side does not load it |", flush=True)
                continue
            a, b = (statistics.median(side) for side in zip(*pairs))
            ratios.append(a / b)
            print(f"| {line} | {a:.3f} | {b:.3f} | {a / b:.2f} |", flush=True)
    print(f"\nOf {len(ratios)} models: geometric mean of the ratios {statistics.geometric_mean(ratios):.2f}.")


if __name__ == "__main__":
    main()
