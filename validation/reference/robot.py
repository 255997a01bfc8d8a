"""Records what RoboHive 0.7's own robot makes of actions and sensors: src/robot/tests/original.txt.

Needs RoboHive 0.7 with its models:  python validation/reference/robot.py src/robot/tests/original.txt
"""

import sys

import gymnasium
import numpy as np
import robohive  # registers the environments

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
    env = gymnasium.make(name, act_mode=mode).unwrapped
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


with open(sys.argv[1], "w") as file:
    for case in CASES:
        record(*case, file)
