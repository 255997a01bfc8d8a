"""Records what RoboHive 0.7's own robot makes of actions and sensors, and what its inverse kinematics find.

Needs RoboHive 0.7 with its models:  python validation/reference/robot.py src/robot/tests
writes original.txt and inverse_kinematics.txt there.
"""

import sys
from pathlib import Path

import gymnasium
import numpy as np
import robohive  # registers the environments
from robohive.physics.sim_scene import SimScene
from robohive.utils.inverse_kinematics import qpos_from_site_pose

CASES = [
    ("FrankaReachFixed-v0", "pos"),
    ("FrankaPushFixed-v0", "pos"),
    ("FrankaPickPlaceFixed-v0", "pos"),
    ("FK1_RelaxFixed-v4", "vel"),
    ("DKittyWalkFixed-v0", "pos"),
    ("rpFrankaDmanusPoseFixed-v0", "pos"),
    ("door-v1", "pos"),
]


def numbers(values):
    return " ".join(repr(float(value)) for value in values)


def record(name, mode, out):
    env = gymnasium.make(name, act_mode=mode, seed=7).unwrapped
    env.reset()
    robot, model, data = env.robot, env.sim.model, env.sim.data
    print("case", name, mode, repr(float(env.dt)), model.nq, model.nu, model.nsensordata, file=out)
    for limits in model.actuator_ctrlrange:
        print("limits", numbers(limits), file=out)
    devices = [] if "default_robot" in robot.robot_config else robot.robot_config.values()
    for actuator in (a for device in devices for a in device["actuator"]):
        ranges = numbers([*actuator["pos_range"], *actuator["vel_range"]])
        print("actuator", actuator["sim_id"], actuator["data_id"], ranges, file=out)
    for sensor in (s for device in devices for s in device["sensor"]):
        row = numbers([*sensor["range"], sensor["noise"]])
        print("sensor", sensor["sim_id"], row, file=out)

    rng = np.random.default_rng(7)
    for _ in range(2):
        action = rng.uniform(-1.2, 1.2, model.nu)
        data.qpos[:] += rng.uniform(-0.4, 0.4, model.nq)
        data.sensordata[:] = rng.uniform(-4, 4, model.nsensordata)
        unnormalized = robot.normalize_actions(action, unnormalize=True)
        vectors = {
            "action": action,
            "qpos": data.qpos,
            "control": robot.process_actuator(action, env.dt, normalized=True),
            "raw": robot.process_actuator(action, env.dt, normalized=False),
            "unnormalized": unnormalized,
            "normalized": robot.normalize_actions(unnormalized * 0.9),
        }
        if devices:
            robot.np_random = np.random.default_rng(11)
            readings = robot.get_sensors(noise_scale=2.0)
            vectors["sensordata"] = data.sensordata
            vectors["readings"] = np.concatenate([readings[name] for name in robot.robot_config])
        for key, values in vectors.items():
            print(key, numbers(values), file=out)


def record_searches(out):
    model_path = Path(__file__).parents[2] / "assets/franka/franka_table.xml"
    sim = SimScene.get_sim(str(model_path))
    rng = np.random.default_rng(3)
    arm = sim.model.jnt_range[:7]
    for row in range(24):
        start, goal = sim.model.qpos0.copy(), sim.model.qpos0.copy()
        start[:7] = rng.uniform(arm[:, 0], arm[:, 1])
        goal[:7] = np.clip(start[:7] + rng.uniform(-0.6, 0.6, 7), arm[:, 0], arm[:, 1])
        sim.data.qpos[:] = goal
        sim.forward()
        site = sim.model.site_name2id("grasp")
        position = sim.data.site_xpos[site].copy()
        orientation = np.empty(4)
        sim.get_mjlib().mju_mat2Quat(orientation, sim.data.site_xmat[site])
        asked = [(True, True), (True, False), (False, True)][row % 3]
        # The last few are out of reach.
        position *= 1.0 if row < 18 else 3.0
        damping = [3e-2, 1.0][row // 3 % 2]
        sim.data.qpos[:] = start
        sim.forward()
        result = qpos_from_site_pose(
            sim, "grasp", position if asked[0] else None, orientation if asked[1] else None,
            tol=1e-9, regularization_strength=damping, max_steps=200)
        print("search", *(int(a) for a in asked), repr(damping), file=out)
        print("start", numbers(start), file=out)
        print("pose", numbers([*position, *orientation]), file=out)
        print("found", int(result.success), result.steps, repr(float(result.err_norm)), numbers(result.qpos), file=out)


folder = Path(sys.argv[1])
with open(folder / "original.txt", "w") as file:
    for case in CASES:
        record(*case, file)
with open(folder / "inverse_kinematics.txt", "w") as file:
    record_searches(file)
