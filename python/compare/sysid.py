"""Fits parameters to the same logs by MuJoCo's `sysid` and by that of the stand-in, and writes the table of what they find.

    python python/compare/sysid.py [--table validation/results/standin_sysid.md]

Needs `mujoco[sysid]` of the version that the stand-in follows, and `robohive[sysid]`. Logs are simulated by MuJoCo: those of the
tests of its `sysid`, whose models are read from the wheel, and one of an arm of seven joints with noise on its sensors.
"""

import argparse
import importlib.metadata
import importlib.util
import io
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

#: Axes of the arm's joints, and what is fitted of each: damping [N m s/rad], armature [kg m²], friction loss [N m].
AXES = ("0 0 1", "0 1 0", "0 0 1", "0 1 0", "0 0 1", "0 1 0", "0 0 1")
FITTED = {"damping": 1.2, "armature": 0.12, "frictionloss": 0.4}
#: Standard deviation of the noise of positions [rad] and velocities [rad/s].
NOISE = (1e-4, 2e-3)
SECONDS = 4.0


def arm() -> str:
    """The arm of seven joints, under servos; later joints are smaller."""
    head, tail = [], []
    for i, axis in enumerate(AXES):
        size = 0.85**i
        values = " ".join(f'{name}="{value * size:.6g}"' for name, value in FITTED.items())
        head.append(
            f'<body name="link{i}" pos="0 0 {0.0 if i == 0 else 0.2}"><joint name="joint{i}" axis="{axis}" {values}/>'
            f'<geom type="capsule" fromto="0 0 0 0.03 0 0.2" size="{0.05 * size:.4g}" density="800"/>'
        )
        tail.append("</body>")
    joints = range(len(AXES))
    motors = "".join(
        f'<position name="servo{i}" joint="joint{i}" kp="{250 * 0.75**i:.5g}" kv="{12 * 0.75**i:.5g}"/>' for i in joints
    )
    sensors = "".join(f'<jointpos name="pos{i}" joint="joint{i}"/>' for i in joints)
    sensors += "".join(f'<jointvel name="vel{i}" joint="joint{i}"/>' for i in joints)
    return (
        '<mujoco><option integrator="implicitfast" timestep="0.002"><flag contact="disable"/></option>'
        f"<worldbody>{''.join(head + tail)}</worldbody>"
        f"<actuator>{motors}</actuator><sensor>{sensors}</sensor></mujoco>"
    )


def problems() -> dict[str, dict[str, Any]]:
    """Models, controls over time, durations, and what is fitted: attributes of elements with true values, beginnings, bounds."""
    folder = Path(str(importlib.metadata.distribution("mujoco").locate_file("mujoco")))
    spec = importlib.util.spec_from_file_location("theirs", folder / "sysid/tests/test_integration.py")
    if spec is None or spec.loader is None:
        raise SystemExit(f"{folder} holds no tests of sysid")
    theirs = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(theirs)
    armature = {f"{name}.armature": (true, 0.01, 0.001, 1.0) for name, true in theirs.TRUE_ARMATURE.items()}
    joints = {
        f"joint{i}.{name}": (value * 0.85**i, value * 0.85**i * (1.6 if i % 2 else 0.5), 0.0, 4 * value)
        for name, value in FITTED.items()
        for i in range(len(AXES))
    }
    return {
        "mass of a spring's load": {
            "xml": theirs.SPRING_MASS_XML,
            "waves": [[(5.0, 1.5, 0.0), (3.0, 3.7, 0.0)]],
            "seconds": 3.0,
            "fitted": {"ball.mass": (1.0, 2.0, 0.3, 3.0)},
        },
        "armature of five joints": {
            "xml": theirs.ARM_XML,
            "waves": [[(5 - i, f, 0.5 * i)] for i, f in enumerate((0.5, 0.7, 0.4, 0.9, 0.6))],
            "seconds": 2.0,
            "fitted": armature,
        },
        "damping, armature and friction of seven joints, noise": {
            "xml": arm(),
            "waves": [[(0.6, 0.35 + 0.06 * i, 0.7 * i), (0.2, 1.3 + 0.17 * i, 0.4 * i)] for i in range(len(AXES))],
            "seconds": SECONDS,
            "noise": NOISE,
            "fitted": joints,
        },
    }


def record(mujoco: Any, problem: dict[str, Any], path: Path) -> None:
    """Simulates a log."""
    from mujoco import rollout  # type: ignore[attr-defined]

    model = mujoco.MjSpec.from_string(problem["xml"]).compile()
    data = mujoco.MjData(model)
    t = np.arange(int(problem["seconds"] / model.opt.timestep)) * model.opt.timestep
    waves = [[(amp, f, phase) for amp, f, phase in channel] for channel in problem["waves"]]
    ctrl = np.column_stack([sum(a * np.sin(2 * np.pi * f * t + p) for a, f, p in channel) for channel in waves])
    start = np.zeros(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS))
    state, sensors = rollout.rollout(model, data, start, ctrl[:-1])
    readings = sensors[0]
    if "noise" in problem:
        deviations = np.repeat(problem["noise"], readings.shape[1] // 2)
        readings = readings + np.random.default_rng(0).normal(size=readings.shape) * deviations
    np.savez(path, t=t, ctrl=ctrl, start=start, times=state[0, :, 0], readings=readings)


def fit(mujoco: Any, problem: dict[str, Any], path: Path) -> dict[str, Any]:
    """Fits a log: the parameters found, the half of their 95 % intervals, and how long it takes [s]."""
    from mujoco import sysid  # type: ignore[attr-defined]

    spec = mujoco.MjSpec.from_string(problem["xml"])
    model = spec.compile()
    params = sysid.ParameterDict()
    for name, (true, begin, low, high) in problem["fitted"].items():
        element, attribute = name.split(".")
        kind = "joint" if attribute in ("damping", "armature", "frictionloss") else "body"

        def write(s: Any, p: Any, kind: str = kind, element: str = element, attribute: str = attribute) -> None:
            target = getattr(s, kind)(element)
            if np.ndim(getattr(target, attribute)):
                getattr(target, attribute)[0] = p.value[0]
            else:
                setattr(target, attribute, p.value[0])

        params.add(sysid.Parameter(name, true, low, high, modifier=write))
        params[name].value[:] = begin
    with np.load(path) as log:
        control = sysid.TimeSeries(log["t"], log["ctrl"])
        measured = sysid.TimeSeries.from_names(log["times"], log["readings"], model)
        sequences = sysid.ModelSequences("model", spec, "log", log["start"], control, measured)
    residual_fn = sysid.build_residual_fn(models_sequences=[sequences])
    began = time.perf_counter()
    found, result = sysid.optimize(params, residual_fn)
    seconds = time.perf_counter() - began
    left = residual_fn(result.x, found)[0]
    intervals = (
        sysid.calculate_intervals(left, result.jac)[1] if result.jac is not None else np.full(len(result.x), np.nan)
    )
    rest = float(np.sqrt(np.mean(np.concatenate(left) ** 2)))
    return {"x": result.x.tolist(), "half": intervals.tolist(), "seconds": seconds, "rest": rest}


def run(engine: str, name: str, folder: Path) -> None:
    """Fits one log in this process."""
    if engine == "standin":
        import robohive.mujoco

        robohive.mujoco.install()
    import mujoco

    problem, log = problems()[name], folder / "log.npz"
    if engine == "mujoco":
        record(mujoco, problem, log)
    (folder / f"{engine}.json").write_text(json.dumps(fit(mujoco, problem, log)))


def rows(name: str, problem: dict[str, Any], fits: dict[str, dict[str, Any]]) -> tuple[str, list[str]]:
    """A row of the summary, and one for each parameter."""
    true = np.array([value[0] for value in problem["fitted"].values()])
    cells, single = [name, str(len(true))], []
    for found in fits.values():
        error = np.abs(np.array(found["x"]) - true) / true
        cells += [f"{100 * error.max():.2g} %", f"{found['rest']:.3g}", f"{found['seconds']:.1f}"]
    apart = np.abs(np.subtract(*(found["x"] for found in fits.values()))) / true
    for i, parameter in enumerate(problem["fitted"]):
        both = [f"{found['x'][i]:.6g}" for found in fits.values()]
        both += [f"{fits['standin']['half'][i]:.2g}"]
        single.append(f"| {name} | {parameter} | {true[i]:.6g} | {' | '.join(both)} |")
    return f"| {' | '.join([*cells, f'{apart.max():.1g}'])} |", single


def main() -> None:
    """Runs, prints, writes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", type=Path)
    parser.add_argument("--run", nargs=3, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.run:
        engine, name, folder = options.run
        run(engine, name, Path(folder))
        return
    out, single = io.StringIO(), []
    head = ["problem", "parameters"]
    head += [f"{who}: {what}" for who in ("MuJoCo", "stand-in") for what in ("largest error", "residual", "time [s]")]
    print(f"| {' | '.join([*head, 'largest difference'])} |\n|{'---|' * (len(head) + 1)}", file=out)
    for name, problem in problems().items():
        with tempfile.TemporaryDirectory() as folder:
            fits = {}
            for engine in ("mujoco", "standin"):
                command = [sys.executable, __file__, "--run", engine, name, folder]
                subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
                fits[engine] = json.loads((Path(folder) / f"{engine}.json").read_text())
        line, more = rows(name, problem, fits)
        print(line, file=out)
        single += more
    print("\n| problem | parameter | true | MuJoCo | stand-in | ± (95 %) |\n|---|---|---|---|---|---|", file=out)
    print("\n".join(single), file=out)
    print(out.getvalue(), end="")
    if options.table:
        version = importlib.metadata.version("mujoco")
        options.table.write_text(
            "# System identification: MuJoCo's `sysid` and the stand-in's\n\n"
            "`python python/compare/sysid.py --table validation/results/standin_sysid.md`: the same logs, simulated by MuJoCo "
            f"{version}, fitted by both with the default minimiser. Errors and differences are relative to the true values, the "
            "residual is the root of the mean square of what is left, signals over their lengths. The last column of the second "
            "table is the stand-in's confidence interval.\n\n" + out.getvalue()
        )


if __name__ == "__main__":
    main()
