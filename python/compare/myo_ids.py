"""Plays every id of MyoSuite on MuJoCo and on the stand-in, and writes the table.

    python python/compare/myo_ids.py [--ids ID…] [--exact PYTHON] [--table validation/results/standin_myosuite.md]

Needs `myosuite`, `mujoco` of the version that the stand-in follows, and this package. Each id plays 100 steps of seeded random
actions. One that differs by more than 1e-6 plays again: on MuJoCo from positions that are moved by 1e-12, which shows how far
MuJoCo leaves itself; and, where `--exact` names the Python of an environment whose wheel was built with
RUSTFLAGS="--cfg system_math", on the stand-in with the C library's sine and its like.
"""

import argparse
import contextlib
import importlib.metadata
import json
import subprocess
import sys
import zlib
from pathlib import Path
from typing import Any

import numpy as np

STEPS = 100
#: How far observations and rewards may differ.
BAR = 1e-6
#: How far MuJoCo is moved to see how far it leaves itself, and how many times.
NUDGE, NUDGES = 1e-12, 3
#: Ids that one process plays, and how long it may take [s].
AT_ONCE, LIMIT = 8, 900


def play(name: str, nudge: int) -> dict[str, Any]:
    """Observations and rewards, or what was raised."""
    import mujoco
    from myosuite.utils import gym

    try:
        np.random.seed(0)
        env = gym.make(name)
        draws = np.random.default_rng(zlib.crc32(name.encode()))
        env.reset(seed=0)
        if nudge:
            model, data = env.unwrapped.mj_model, env.unwrapped.mj_data
            data.qpos[:] += NUDGE * np.random.default_rng(nudge).choice([-1.0, 1.0], len(data.qpos))
            mujoco.mj_forward(model, data)
        rows = []
        for _ in range(STEPS):
            action = draws.uniform(env.action_space.low, env.action_space.high)
            observation, reward, terminated, truncated, _ = env.step(action.astype(env.action_space.dtype))
            rows.append([*np.ravel(observation).astype(float).tolist(), float(np.ravel(reward)[0])])
            if terminated or truncated:
                break
        return {"rows": rows}
    except Exception as error:
        lines = str(error).splitlines() or [""]
        return {"error": f"{type(error).__name__}: {lines[0][:160]}"}


def one_process(engine: str, nudge: int, ids: list[str]) -> None:
    """Plays ids on one engine; results go to standard output, a line each."""
    if engine == "standin":
        import robohive.mujoco

        robohive.mujoco.install()
        robohive.mujoco.set_instability("reset")
    out = sys.stdout
    with contextlib.redirect_stdout(sys.stderr):
        import myosuite

        if not ids:
            suites = myosuite.register_all_envs()
            print(json.dumps(sorted({name for suite in suites.values() for name in suite})), file=out)
        for name in ids:
            print(json.dumps([name, play(name, nudge)]), file=out, flush=True)


def run(engine: str, nudge: int, ids: list[str], python: str = sys.executable) -> dict[str, dict[str, Any]]:
    """Plays ids in processes of their own."""
    results: dict[str, dict[str, Any]] = {}
    for first in range(0, len(ids), AT_ONCE):
        some = ids[first : first + AT_ONCE]
        command = [python, __file__, "--process", engine, str(nudge), "--ids", *some]
        try:
            said = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT, check=False)
            printed, fault = said.stdout, (said.stderr.strip().splitlines() or ["it ended"])[-1]
        except subprocess.TimeoutExpired as error:
            printed = error.stdout.decode() if isinstance(error.stdout, bytes) else ""
            fault = f"more than {LIMIT} s"
        results.update(json.loads(line) for line in printed.splitlines() if line.startswith("["))
        results.update((name, {"error": fault[:160]}) for name in some if name not in results)
        print(f"{engine} {nudge}: {first + len(some)} of {len(ids)}", file=sys.stderr)
    return results


def difference(a: dict[str, Any], b: dict[str, Any]) -> float:
    """The largest difference, infinite where episodes differ in length."""
    if len(a["rows"]) != len(b["rows"]):
        return float("inf")
    return float(np.nan_to_num(np.abs(np.array(a["rows"]) - np.array(b["rows"])), nan=np.inf).max(initial=0.0))


def explanation(far: dict[str, float]) -> str:
    """What makes an id agree that differs, by the differences of its further runs."""
    if far.get("exact", float("inf")) <= BAR:
        return f"yes, with the C library's functions ({far['exact']:.1e})"
    return "as MuJoCo leaves itself" if far["own"] > BAR else "no"


def rows_of(ids: list[str], exact: str | None) -> tuple[list[str], list[str]]:
    """The rows of the table, and the counts."""
    theirs, ours = run("mujoco", 0, ids), run("standin", 0, ids)
    running = [name for name in ids if "rows" in theirs[name]]
    worst = {name: difference(theirs[name], ours[name]) for name in running if "rows" in ours[name]}
    differing = [name for name, far in worst.items() if far > BAR]
    moved = [run("mujoco", nudge, differing) for nudge in range(1, NUDGES + 1)]
    again = run("standin", 0, differing, exact) if exact else {}
    rows, verdicts = [], []
    for name in ids:
        if name not in running:
            rows.append(f"| {name} | | | not on MuJoCo: {theirs[name]['error']} |")
            continue
        if name not in worst:
            rows.append(f"| {name} | | | does not run: {ours[name]['error']} |")
            continue
        far = {"own": 0.0}
        if name in differing:
            far["own"] = max(difference(theirs[name], one[name]) for one in moved if "rows" in one[name])
            if "rows" in again.get(name, {}):
                far["exact"] = difference(theirs[name], again[name])
        verdicts.append(explanation(far) if name in differing else "yes")
        own = f"{far['own']:.1e}" if name in differing else ""
        rows.append(f"| {name} | {worst[name]:.1e} | {own} | {verdicts[-1]} |")
    starts = ("yes, with", "as MuJoCo", "no")
    kinds = [sum(verdict.startswith(start) for verdict in verdicts) for start in starts]
    agree, total = verdicts.count("yes"), max(len(running), 1)
    counts = [
        f"{len(ids)} ids; {len(running)} run on MuJoCo, {len(worst)} of these on the stand-in. {agree} ({100 * agree / total:.1f} %) "
        f"have the same observations and rewards within {BAR:g} over {STEPS} steps as shipped, and {agree + kinds[0]} "
        f"({100 * (agree + kinds[0]) / total:.1f} %) when both call the C library's sine and its like, whose last bits these "
        f"motions amplify. Left: {kinds[1]} that differ as MuJoCo does from itself, {kinds[2]} others.",
    ]
    return rows, counts


def main() -> None:
    """Plays, compares, writes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ids", nargs="*", default=[])
    parser.add_argument("--exact", metavar="PYTHON")
    parser.add_argument("--table", type=Path)
    parser.add_argument("--process", nargs=2, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.process:
        one_process(options.process[0], int(options.process[1]), options.ids)
        return
    ids = options.ids
    if not ids:
        listed = subprocess.run([sys.executable, __file__, "--process", "mujoco", "0"], capture_output=True, text=True, check=True)
        ids = json.loads(listed.stdout)
    rows, counts = rows_of(ids, options.exact)
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("myosuite", "mujoco", "numpy"))
    lines = [
        "# MyoSuite's ids on the stand-in for `mujoco`",
        "",
        f"`python python/compare/myo_ids.py --exact PYTHON --table validation/results/standin_myosuite.md`, with {versions}.",
        "",
        *counts,
        "",
        f"Difference: the largest of any observation or reward. Own: the same between MuJoCo and MuJoCo from {NUDGES} starts, of "
        f"which every position is moved by {NUDGE:g}.",
        "",
        "| id | difference | own | agrees |",
        "|---|---|---|---|",
        *rows,
        "",
    ]
    print("\n".join(lines))
    if options.table:
        options.table.write_text("\n".join(lines))


if __name__ == "__main__":
    main()
