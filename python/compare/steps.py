"""What a call of `mj_step` costs beyond the step itself, on the stand-in and in MuJoCo's own bindings.

    python steps.py

A call with `nstep=1` a thousand times, less one call with `nstep=1000`: least of many repetitions, in microseconds a call. Times of
the whole step stand beside. Columns say which arrays the program has asked for: none, `qpos qvel ctrl sensordata`, or all.
"""

import subprocess
import sys
import time

import numpy as np

CALLS, REPEATS = 1000, 20
FEW = ("qpos", "qvel", "ctrl", "sensordata")
PENDULUM = "<mujoco><worldbody><body><joint axis='0 1 0'/><geom size='.1' pos='0 0 -1'/></body></worldbody></mujoco>"


def models() -> dict[str, str]:
    """A pendulum, and models of Gymnasium by their files."""
    import gymnasium
    from pathlib import Path

    assets = Path(gymnasium.__file__).parent / "envs" / "mujoco" / "assets"
    return {"pendulum": PENDULUM, **{name: (assets / f"{name}.xml").read_text() for name in ("hopper", "ant")}}


def least(run, start) -> float:
    """Least processor time of a run [s]."""
    times = []
    for _ in range(REPEATS):
        start()
        begin = time.process_time()
        run()
        times.append(time.process_time() - begin)
    return min(times)


def measure(engine: str) -> None:
    """Prints a line for each model and choice of arrays."""
    if engine == "standin":
        import robohive.mujoco

        robohive.mujoco.install()
    import mujoco

    for name, text in models().items():
        for what in ("none", "few", "all"):
            model = mujoco.MjModel.from_xml_string(text)
            data = mujoco.MjData(model)
            names = {"none": (), "few": FEW, "all": tuple(dir(data)) + tuple(dir(model))}[what]
            held = [getattr(owner, n, None) for n in names for owner in (data, model) if not n.startswith("_")]
            held = [array for array in held if isinstance(array, np.ndarray)]

            def start() -> None:
                mujoco.mj_resetData(model, data)

            def singly() -> None:
                for _ in range(CALLS):
                    mujoco.mj_step(model, data)

            def at_once() -> None:
                mujoco.mj_step(model, data, nstep=CALLS)

            one, many = least(singly, start), least(at_once, start)
            print(f"{engine},{name},{what},{len(held)},{1e6 * many / CALLS:.2f},{1e6 * (one - many) / CALLS:.2f}", flush=True)


def main() -> None:
    """Measures both engines, each in a process of its own."""
    if len(sys.argv) > 1:
        measure(sys.argv[1])
        return
    print("engine,model,arrays,held,step [us],call [us]")
    for engine in ("mujoco", "standin"):
        subprocess.run([sys.executable, "-W", "ignore", __file__, engine], check=True)


if __name__ == "__main__":
    main()
