#!/usr/bin/env python3
"""What the robots of this project cost: steps per second and cold compile beside MuJoCo 3.12.0, triangles, first steps.

    python benches/robots.py [--only TEXT] [--write FILE]

Every scene that `robohive assets own` writes is stepped as in `step.py` (both sides in turns, medians of processor time)
and compiled as in `compile.py` (a fresh process each, wall time around the load, the least of RUNS). Then every id on
these models makes its first step as a newcomer would see it: the wall time of the whole process of `robohive run` with
an empty cache of compiled models, the least of two. Needs `mujoco`, Linux and the command built with
`cargo build --profile dist`.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import mujoco

import compile as compiling
import step

RUNS = 3
SUITES = ["hive", "classical", "locomotion", "tabletop", "deformable", "in_hand", "multi_agent"]
# Bounds of cold compiles and first steps [s].
COMPILE, FIRST = 0.150, 0.300
BEGIN, END = "<!-- robots begin -->", "<!-- robots end -->"


def triangles(model):
    """Triangles of the geoms that are drawn and touch nothing."""
    seen = (model.geom_contype == 0) & (model.geom_conaffinity == 0) & (model.geom_type == mujoco.mjtGeom.mjGEOM_MESH)
    return int(model.mesh_facenum[model.geom_dataid[seen]].sum())


def robots(binary, folder, only):
    """Rows of the first table, and the ratios of speed."""
    lines = ["| scene | robohive steps/s | MuJoCo steps/s | ratio | motion | cold compile [ms] | MuJoCo's [ms] | triangles seen |",
             "|---|---|---|---|---|---|---|---|"]
    ratios, slow = [], []
    for path in sorted(folder.glob(f"*{only}*/scene.xml")):
        model = step.record.load(path)
        row = step.compare(path, model, argparse.Namespace(stages=False, jitter=False))
        ours, theirs = [min(side[0] for side in sides) for sides in zip(
            *((compiling.ours(binary, path), compiling.theirs(path)) for _ in range(RUNS)))]
        ratios.append(row["ratio"])
        if ours > COMPILE:
            slow.append(path.parent.name)
        lines.append(f"| {path.parent.name} | {row['ours']:.0f} | {row['theirs']:.0f} | {row['ratio']:.2f} | {row['motion']:.0e} | "
                     f"{1e3 * ours:.0f} | {1e3 * theirs:.0f} | {triangles(model)} |")
        print(lines[-1], file=sys.stderr, flush=True)
    lines += ["", f"Geometric mean {step.geometric_mean(ratios):.2f}, least {min(ratios):.2f}, {sum(r < 1 for r in ratios)} of "
              f"{len(ratios)} lost; compile over {1e3 * COMPILE:.0f} ms: {', '.join(slow) or 'none'}."]
    return lines


def first_step(binary, name):
    """Wall seconds of a process that makes one step of an environment."""
    with tempfile.TemporaryDirectory(prefix="cache-") as cache:
        command = [binary, "run", name, "--episodes", "1", "--policy", "zero", "--set", "max_episode_steps=1", "--cache", cache]
        began = time.perf_counter()
        run = subprocess.run(command, capture_output=True, text=True)
        spent = time.perf_counter() - began
    if run.returncode != 0:
        sys.exit(f"{name}: {run.stderr}")
    return spent


def first_steps(binary, only):
    """The second table: how long ids take to their first step, by suite."""
    lines = ["| suite | ids | median [ms] | slowest [ms] | of | over 300 ms |", "|---|---|---|---|---|---|"]
    for suite in SUITES:
        listed = json.loads(subprocess.run([binary, "list", suite, "--json"], capture_output=True, check=True).stdout)
        names = [one["id"] for one in listed if only in one["id"].lower()]
        spent = {name: min(first_step(binary, name) for _ in range(2)) for name in names}
        if spent:
            slowest = max(spent, key=spent.get)
            over = sum(seconds > FIRST for seconds in spent.values())
            lines.append(f"| {suite} | {len(spent)} | {1e3 * statistics.median(spent.values()):.0f} | {1e3 * spent[slowest]:.0f} | "
                         f"`{slowest}` | {over} |")
            print(lines[-1], file=sys.stderr, flush=True)
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="scenes and ids whose name contains this")
    parser.add_argument("--write", type=pathlib.Path, help=f"file with the marks {BEGIN} and {END}")
    args = parser.parse_args()
    binary = step.binary()
    with tempfile.TemporaryDirectory(prefix="own-") as folder:
        subprocess.run([binary, "assets", "own", folder], check=True, capture_output=True)
        lines = robots(binary, pathlib.Path(folder), args.only)
    table = "\n".join(lines + [""] + first_steps(binary, args.only))
    print(table)
    if args.write:
        before, rest = args.write.read_text().split(BEGIN)
        args.write.write_text(f"{before}{BEGIN}\n{table}\n{END}{rest.split(END)[1]}")


if __name__ == "__main__":
    main()
