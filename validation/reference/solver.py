#!/usr/bin/env python3
"""Records constraint problems and the solutions of MuJoCo 3.12.0's solvers.

    pip install mujoco==3.12.0
    python solver.py --out DIR --problems 5000 [MODEL.xml ...] [--corpus FOLDER --list FILE]

Each model is driven by random controls from keyframe 0, or qpos0, and from disturbed poses; states that make constraint
rows are kept, evenly spread over the models. A state makes one problem with pyramidal and one with elliptic cones; each
is solved by PGS, CG and Newton. Every second problem starts cold, every third is solved as a whole instead of island by
island, and every third, counted by pairs, removes slip. One archive a model; the model itself is in the archive that record.py writes:

    count.NAME      contacts, rows, row entries and islands of each problem: they cut the concatenated arrays
    problem.NAME    options and inputs of fixed size, a row each
    contact.NAME, efc_NAME                       contacts and rows, concatenated
    solved.NAME     solutions, [problem, solver, ...]
    statistics      of the iterations of the three solvers one after another, concatenated
"""

import zlib

import mujoco
import numpy as np

from record import arguments, dense_jacobian, jobs, load

SOLVERS = [mujoco.mjtSolver.mjSOL_PGS, mujoco.mjtSolver.mjSOL_CG, mujoco.mjtSolver.mjSOL_NEWTON]
CONES = [mujoco.mjtCone.mjCONE_PYRAMIDAL, mujoco.mjtCone.mjCONE_ELLIPTIC]
NOSLIP_ITERATIONS = 10

STATE = ["qpos", "qvel", "act", "ctrl", "mocap_pos", "mocap_quat", "eq_active", "qacc_warmstart"]
FIXED = ["qacc_warmstart", "qacc_smooth", "qfrc_smooth", "M", "qLD", "qLDiagInv"]
ROWS = ["efc_type", "efc_id", "efc_frictionloss", "efc_diagA", "efc_D", "efc_R", "efc_aref"]
CONTACT = ["dim", "geom", "friction", "mu", "exclude", "efc_address"]
SOLVED = ["qacc", "solver_niter"]
STATISTICS = ["improvement", "gradient", "lineslope", "nactive", "nchange", "neval", "nupdate"]

HOLD = 15       # steps between changes of the controls
RESTART = 400   # steps between disturbed starts
ATTEMPTS = 40   # steps tried for each state wanted


def reset(model, data, rng, disturbance):
    mujoco.mj_resetData(model, data)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_integratePos(model, data.qpos, rng.normal(0, disturbance, model.nv), 1.0)


def states(model, number, rng):
    """Random-control rollouts: up to `number` states that make rows."""
    data = mujoco.MjData(model)
    limited = model.actuator_ctrllimited.astype(bool)
    low = np.where(limited, model.actuator_ctrlrange[:, 0], -1.0)
    high = np.where(limited, model.actuator_ctrlrange[:, 1], 1.0)
    every, kept, disturbance = 5, [], 0.0
    for step in range(ATTEMPTS * number):
        if step % RESTART == 0:
            reset(model, data, rng, disturbance)
            disturbance = 0.02 + 0.1 * rng.uniform()
        if step % HOLD == 0:
            data.ctrl[:] = rng.uniform(low, high)
        mujoco.mj_step(model, data)
        if step % every == every - 1 and data.nefc:
            kept.append({name: np.array(getattr(data, name)) for name in STATE} | {"time": data.time})
            if len(kept) == number:
                break
    return kept


def set_state(model, data, state):
    mujoco.mj_resetData(model, data)
    for name, value in state.items():
        if name == "time":
            data.time = value
        else:
            getattr(data, name)[:] = value


def jacobian(model, data):
    """Row lengths, columns and entries; a dense Jacobian without its zeros."""
    if mujoco.mj_isSparse(model):
        nnz = np.array(data.efc_J_rownnz)[:data.nefc]
        at = np.concatenate([np.arange(a, a + n) for a, n in zip(data.efc_J_rowadr, nnz)]).astype(int)
        return nnz, np.array(data.efc_J_colind)[at], np.array(data.efc_J)[at]
    dense = dense_jacobian(model, data)
    rows, columns = np.nonzero(dense)
    return np.bincount(rows, minlength=data.nefc), columns, dense[rows, columns]


def iterations(data):
    """Statistics of every iteration, island after island."""
    table = np.stack([getattr(data.solver, name) for name in STATISTICS], axis=-1).astype(float)
    table = table.reshape(mujoco.mjNISLAND, mujoco.mjNSOLVER, len(STATISTICS))
    return np.concatenate([rows[:n] for rows, n in zip(table, data.solver_niter)])


def record(model, number, seed):
    rng = np.random.default_rng(seed)
    data = mujoco.MjData(model)
    flags = model.opt.disableflags
    kept = states(model, number, rng)
    out = {}

    def put(name, value):
        out.setdefault(name, []).append(np.array(value))

    for k, state in enumerate(kept):
        model.opt.disableflags = flags
        if k % 2:
            model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_WARMSTART
        if k % 3 == 2:
            model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ISLAND
        model.opt.noslip_iterations = NOSLIP_ITERATIONS if k // 2 % 3 == 2 else 0
        for cone in CONES:
            solved, statistics = {name: [] for name in SOLVED}, []
            for solver in SOLVERS:
                model.opt.cone, model.opt.solver = cone, solver
                set_state(model, data, state)
                mujoco.mj_forward(model, data)
                for name in SOLVED:
                    solved[name].append(np.array(getattr(data, name)))
                statistics.append(iterations(data))
            if not data.nefc:
                continue
            for name in SOLVED:
                put("solved." + name, solved[name])
            put("count.statistics", [len(rows) for rows in statistics])
            put("statistics", np.concatenate(statistics))
            for name in ["cone", "noslip_iterations", "disableflags"]:
                put("problem." + name, getattr(model.opt, name))
            for name in FIXED:
                put("problem." + name, getattr(data, name))
            for name in ["ncon", "ne", "nf", "nl", "nefc", "nisland"]:
                put("count." + name, getattr(data, name))
            for name in ROWS:
                put(name, np.array(getattr(data, name))[:data.nefc])
            for name in CONTACT:
                put("contact." + name, getattr(data.contact, name))
            nnz, columns, entries = jacobian(model, data)
            put("count.entries", len(entries))
            put("efc_J_rownnz", nnz)
            put("efc_J_colind", columns)
            put("efc_J", entries)
    fixed = ("solved.", "problem.", "count.")
    return {name: np.array(v) if name.startswith(fixed) else np.concatenate(v) for name, v in out.items()}


def main():
    parser = arguments(__doc__)
    parser.add_argument("--problems", type=int, default=5000, help="problems of each solver with each cone")
    parser.add_argument("--seed", type=int, default=0)
    args = parser.parse_args()
    with jobs(args) as found:
        # Models that rarely touch come first: what they leave is shared by the others.
        rarity = {name: len(states(load(path), 20, np.random.default_rng(0))) for name, path in found}
        left = args.problems
        for rank, (name, path) in enumerate(sorted(found, key=lambda job: (rarity[job[0]], job[0]))):
            share = -(-left // (len(found) - rank)) if rarity[name] else 0
            if share:
                arrays = record(load(path), share, zlib.crc32(name.encode()) + args.seed)
                made = len(arrays.get("problem.cone", []))
                if made:
                    np.savez_compressed(args.out / (name + ".npz"), **arrays)
                left -= made // 2
                print("recorded", name, made, flush=True)
    print("problems of each solver with each cone:", args.problems - left)


if __name__ == "__main__":
    main()
