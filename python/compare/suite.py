"""Runs the tasks of dm_control's suite with state observations, on MuJoCo and on the stand-in.

    python suite.py --table ../../validation/results/standin_suite.md

Each task plays 100 steps of seeded random actions. A task runs when it is made, reset and played without an exception.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path

import numpy as np

from names import rows_of

STEPS = 100


def play(domain: str, task: str) -> dict:
    """Whether the task runs, and the sums of its observations."""
    from dm_control import suite

    try:
        env = suite.load(domain, task, task_kwargs={"random": 0})
        spec, draws = env.action_spec(), np.random.default_rng(0)
        timestep, total = env.reset(), []
        for _ in range(STEPS):
            timestep = env.step(draws.uniform(spec.minimum, spec.maximum, spec.shape))
            values = [np.ravel(value) for value in timestep.observation.values()]
            total.append(np.concatenate(values).astype(float).tolist())
        return {"observations": total}
    except Exception as error:
        lines = str(error).splitlines() or [""]
        return {"error": f"{type(error).__name__}: {lines[0]}"}


def one_engine(engine: str) -> None:
    """Plays all tasks on one engine; results go to standard output."""
    if engine == "standin":
        import robohive.mujoco

        robohive.mujoco.install()
        # dm_control reads the counts of warnings and ends an episode that was unstable.
        robohive.mujoco.set_instability("reset")
    from dm_control import suite

    results = {f"{domain}/{task}": play(domain, task) for domain, task in suite.ALL_TASKS}
    json.dump(results, sys.stdout)


def name_rows() -> list[str]:
    """Every name of the bindings that dm_control uses, pictures included."""
    import dm_control

    root = Path(dm_control.__file__).parent
    return rows_of([root / "mujoco", root / "suite", root / "rl"])


def main() -> None:
    """Plays on both engines and compares."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--engine", choices=("mujoco", "standin"))
    parser.add_argument("--table", type=Path)
    options = parser.parse_args()
    if options.engine:
        one_engine(options.engine)
        return
    results = {}
    for engine in ("mujoco", "standin"):
        command = [sys.executable, "-W", "ignore", __file__, "--engine", engine]
        results[engine] = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
    rows, running = [], 0
    for name, ours in results["standin"].items():
        truth = results["mujoco"][name]
        if "error" in ours or "error" in truth:
            rows.append((name, "no" if "error" in ours else "yes", ours.get("error", "MuJoCo: " + truth.get("error", ""))))
            running += "error" not in ours
            continue
        running += 1
        a, b = np.array(truth["observations"]), np.array(ours["observations"])
        first, last = np.abs(a - b)[:10].max(), np.abs(a - b).max()
        rows.append((name, "yes", f"{first:.1e} over 10 steps, {last:.1e} over {STEPS}"))
    lines = [
        "# dm_control's suite on the stand-in for `mujoco`",
        "",
        f"`python python/compare/suite.py`: {running} of {len(rows)} tasks run with state observations. The difference is the "
        f"largest of any observation from MuJoCo's; motions with contacts amplify last bits.",
        "",
        "| task | runs | difference, or what stops it |",
        "|---|---|---|",
        *("| " + " | ".join(row) + " |" for row in rows),
        "",
        "## Names",
        "",
        *name_rows(),
        "",
    ]
    print("\n".join(lines))
    if options.table:
        options.table.write_text("\n".join(lines))


if __name__ == "__main__":
    main()
