#!/usr/bin/env python3
"""Records what MuJoCo 3.12.0 computes for the own models beyond Euler steps and forward dynamics.

    pip install mujoco==3.12.0
    python record_implicit.py --out DIR MODEL.xml [MODEL.xml ...]

One small archive a model; the compiled arrays and the states are those that `record.py` recorded:

    ctrl                        controls of STEPS steps from keyframe 0, or qpos0
    INTEGRATOR.qpos             every EVERY-th position of a rollout with that integrator
    INTEGRATOR.twin             how far MuJoCo is from itself by then when it starts 1e-12 away
    INTEGRATOR.qDeriv, .qvel    derivative of smooth forces at some states, row by row; velocity one step later
    inverse.qacc, .qfrc_inverse, .qfrc_constraint    inverse dynamics of made-up accelerations at those states
    discrete.INTEGRATOR         qfrc_inverse of the same accelerations taken as changes of velocity over a step
    transition.INTEGRATOR.A ... finite-difference transition matrices at the first state, small models only
    slope.position ...          finite differences of inverse dynamics there
"""

from pathlib import Path

import mujoco
import numpy as np

from record import INPUTS, TWIN_OFFSET, arguments, controls, jobs, load, rollout

STEPS = 200
EVERY = 5
STATES = [0, 2, 4]
SMALL = 30
INTEGRATORS = {"implicit": mujoco.mjtIntegrator.mjINT_IMPLICIT,
               "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
               "Euler": mujoco.mjtIntegrator.mjINT_EULER}


def set_state(data, model, states, row):
    mujoco.mj_resetData(model, data)
    data.time = states["state.time"][row]
    for name in INPUTS:
        if "state." + name in states:
            getattr(data, name)[:] = states["state." + name][row]


def derivatives(model, states):
    data = mujoco.MjData(model)
    rows, qvel = [], []
    for row in STATES:
        set_state(data, model, states, row)
        mujoco.mj_forward(model, data)
        mujoco.mj_implicit(model, data)
        rows.append(data.qDeriv.copy())
        qvel.append(data.qvel.copy())
    return np.array(rows), np.array(qvel)


def inverse(model, states, qacc):
    data = mujoco.MjData(model)
    force, constraint = [], []
    for row, acceleration in zip(STATES, qacc):
        set_state(data, model, states, row)
        data.qacc[:] = acceleration
        mujoco.mj_inverse(model, data)
        force.append(data.qfrc_inverse.copy())
        constraint.append(data.qfrc_constraint.copy())
    return np.array(force), np.array(constraint)


def transition(model, states):
    data = mujoco.MjData(model)
    set_state(data, model, states, STATES[0])
    n, nu, ns = 2 * model.nv + model.na, model.nu, model.nsensordata
    a, b, c, d = np.zeros((n, n)), np.zeros((n, nu)), np.zeros((ns, n)), np.zeros((ns, nu))
    mujoco.mjd_transitionFD(model, data, 1e-6, True, a, b, c, d)
    return {"A": a, "B": b, "C": c, "D": d}


def inverse_slope(model, states, qacc):
    data = mujoco.MjData(model)
    set_state(data, model, states, STATES[0])
    data.qacc[:] = qacc[0]
    parts = {k: np.zeros((model.nv, model.nv)) for k in ["position", "velocity", "acceleration"]}
    mujoco.mjd_inverseFD(model, data, 1e-6, False, *parts.values(), None, None, None, None)
    return parts


def record(model, states):
    """All arrays of one model, at rows STATES of recorded `states`."""
    ctrl = controls(model, STEPS, 0)
    rng = np.random.default_rng(1)
    qacc = rng.normal(0, 3, (len(STATES), model.nv))
    out = {"ctrl": ctrl, "inverse.qacc": qacc}
    out["inverse.qfrc_inverse"], out["inverse.qfrc_constraint"] = inverse(model, states, qacc)
    if model.nv <= SMALL:
        out |= {"slope." + k: v for k, v in inverse_slope(model, states, qacc).items()}
    for name, code in INTEGRATORS.items():
        model.opt.integrator = code
        if name != "Euler":
            qpos = rollout(model, ctrl)[0]
            twin = np.abs(rollout(model, ctrl, TWIN_OFFSET)[0] - qpos)
            out[name + ".qpos"] = qpos[EVERY - 1::EVERY]
            out[name + ".twin"] = np.maximum.accumulate(twin.max(axis=1))[EVERY - 1::EVERY]
            out[name + ".qDeriv"], out[name + ".qvel"] = derivatives(model, states)
        flags = model.opt.enableflags
        model.opt.enableflags = flags | int(mujoco.mjtEnableBit.mjENBL_INVDISCRETE)
        out["discrete." + name] = inverse(model, states, qacc)[0]
        model.opt.enableflags = flags
        if model.nv <= SMALL:
            out |= {f"transition.{name}.{k}": v for k, v in transition(model, states).items()}
    return out


def main():
    args = arguments(__doc__).parse_args()
    with jobs(args) as found:
        for name, path in found:
            model = load(path)
            states = np.load(Path(__file__).parent / "own" / (name + ".npz"))
            np.savez_compressed(args.out / (name + ".npz"), **record(model, states))
            print("recorded", name, "nv", model.nv)


if __name__ == "__main__":
    main()
