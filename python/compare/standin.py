"""Compares other people's environments on the stand-in with the same on MuJoCo 3.12, and writes the table.

    python standin.py gymnasium --table ../../validation/results/standin.md [--keep FOLDER]
    python standin.py metaworld --table ../../validation/results/standin_metaworld.md [--keep FOLDER]

Needs `mujoco==3.12.0`, the packages of the set (`gymnasium` and `gymnasium-robotics`, or `metaworld`) and this package. Each environment plays 1000 steps of seeded random
actions on MuJoCo, on MuJoCo from several starts 1e-12 away, and on the stand-in. Up to every step of an episode, observations
and rewards may differ by 1e-9 or ten times what MuJoCo differs from itself.
"""

import argparse
import importlib.metadata
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from environment_sets import SETS, EnvironmentSet
from names import rows_of

#: How far observations may differ whatever MuJoCo's own divergence is.
BAR = 1e-9
#: How many times MuJoCo's own divergence they may differ.
TIMES = 10.0
NUDGE = 1e-12
#: Starts that MuJoCo's own divergence is measured from: near contacts that come or go it differs from one to the other.
STARTS = 5


def play(folder: Path, engine: str, start: int, ids: list[str], steps: int) -> dict:
    """Plays all environments in a process of its own; start 0 is the true one."""
    out = folder / f"{engine}_{start}.npz"
    if not out.exists():
        script = Path(__file__).with_name("episodes.py")
        nudge = ["--nudge", NUDGE, "--signs", start] if start else []
        command = [sys.executable, script, engine, out, "--steps", steps, *nudge, "--ids", *ids]
        subprocess.run([str(part) for part in command], check=True)
    return dict(np.load(out))


def compare(name: str, truth: dict, nudged: list[dict], ours: dict) -> list[str]:
    """A row of the table: largest differences, and the verdict."""
    runs = (("MuJoCo", truth), ("stand-in", ours))
    errors = [f"{who}: {arrays[f'{name}/error']}" for who, arrays in runs if f"{name}/error" in arrays]
    if errors:
        return [name, "", "", "", "", "; ".join(errors)]
    episodes = truth[f"{name}/episodes"]
    count = str(int(episodes[-1]) + 1)
    if not np.array_equal(episodes, ours[f"{name}/episodes"]):
        return [name, count, "", "", "", "no, episodes end at other steps"]
    worst, own, share, first_bad = 0.0, 0.0, 0.0, None
    for key in ("observations", "rewards"):
        a, b, *others = (
            arrays[f"{name}/{key}"].reshape(len(episodes), -1) for arrays in (truth, ours, *nudged)
        )
        difference = np.abs(a - b).max(1)
        divergence = np.max([np.abs(a - other).max(1) for other in others], axis=0)
        for episode in np.unique(episodes):
            at = episodes == episode
            ratio = difference[at] / np.maximum(BAR, TIMES * np.maximum.accumulate(divergence[at]))
            share = max(share, float(ratio.max()))
            if ratio.max() > 1 and first_bad is None:
                first_bad = int(np.flatnonzero(at)[np.argmax(ratio > 1)])
        worst, own = max(worst, float(difference.max())), max(own, float(divergence.max()))
    verdict = "yes" if share <= 1 else f"no, from step {first_bad}"
    return [name, count, f"{worst:.1e}", f"{own:.1e}", f"{share:.2g}", verdict]


def version(package: str) -> str:
    """Installed version of a package."""
    return f"{package} {importlib.metadata.version(package)}"


def page(environments: EnvironmentSet, rows: list[list[str]], command: str, steps: int) -> str:
    """The page of results."""
    agree = sum(row[-1] == "yes" for row in rows)
    lines = [
        f"# {environments.title} on the stand-in for `mujoco`",
        "",
        f"`{command}`, with " + ", ".join(version(p) for p in ("mujoco", *environments.packages, "numpy")) + ".",
        "",
        f"{agree} of {len(rows)} environments agree over {steps} steps of seeded random actions. A new episode, of the "
        "next seed, begins where one ends. Difference: the largest of any observation or reward between the stand-in and "
        f"MuJoCo; own divergence: the same between MuJoCo and MuJoCo from {STARTS} starts, of which every position is moved by "
        "1e-12 (of robots that settle in their reset, before they do). Share: the largest difference in units of what is "
        "allowed, 1e-9 or ten times the own divergence up to that step of the episode. Where that is exceeded, the stand-in "
        f"plays from the same {STARTS} starts too: contacts of smooth shapes, found to a tolerance, split motions in two "
        f"branches by their last bits, and sparse rewards are steps. {environments.note}",
        "",
        "| environment | episodes | difference | own divergence | share | agrees |",
        "|---|---|---|---|---|---|",
        *("| " + " | ".join(row) + " |" for row in rows),
        "",
        "## Names",
        "",
        *rows_of(environments.sources()),
        "",
    ]
    return "\n".join(lines)


def main() -> None:
    """Plays, compares, writes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("set", choices=SETS)
    parser.add_argument("--table", type=Path)
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--steps", type=int, default=1000)
    options = parser.parse_args()
    environments = SETS[options.set]
    ids = environments.ids()
    folder = options.keep or Path(tempfile.mkdtemp())
    folder.mkdir(exist_ok=True)
    truth, *nudged = (play(folder, "mujoco", start, ids, options.steps) for start in range(STARTS + 1))
    ours = play(folder, "standin", 0, ids, options.steps)
    rows = [compare(name, truth, nudged, ours) for name in ids]
    again = [row[0] for row in rows if row[-1].startswith("no, from")]
    if again:
        others = [play(folder, "standin", start, again, options.steps) for start in range(1, STARTS + 1)]
        for row in rows:
            if row[0] in again:
                agreeing = sum(compare(row[0], truth, nudged, other)[-1] == "yes" for other in others)
                row[-1] += f"; {agreeing} of {STARTS} starts of its own agree"
    table = f" --table validation/results/{options.table.name}" if options.table else ""
    text = page(environments, rows, f"python python/compare/standin.py {options.set}{table}", options.steps)
    print(text)
    if options.table:
        options.table.write_text(text)


if __name__ == "__main__":
    main()
