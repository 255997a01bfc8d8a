#!/usr/bin/env python3
"""Moment arms, strength and collapse of models of legs, by MuJoCo 3.12.0.

    pip install mujoco==3.12.0
    robohive assets own MODELS
    python legs.py MODELS/myolegs/scene.xml CORPUS/simhive/myo_sim/leg/myolegs.xml

For each model: moment arms of some muscles [mm] at eleven angles over the range of a joint, the joints that equalities tie to it
following; the torque [N m] of muscles with full activation; and when the pelvis has sunk by 0.2 m from the first keyframe without
excitation.
"""

import sys

import mujoco
import numpy as np

ARMS = {
    "knee_angle_r": ["vasint_r", "recfem_r", "semimem_r", "gasmed_r", "gaslat_r", "bfsh_r"],
    "ankle_angle_r": ["soleus_r", "gasmed_r", "tibant_r"],
    "hip_flexion_r": ["psoas_r", "iliacus_r", "glmax2_r"],
}
EXTENSORS = ["vasint_r", "vaslat_r", "vasmed_r", "recfem_r"]
PLANTARFLEXORS = ["soleus_r", "gasmed_r", "gaslat_r", "tibpost_r", "fdl_r", "fhl_r", "perlong_r", "perbrev_r"]
STRENGTH = [
    ("knee_angle_r", EXTENSORS, {"knee_angle_r": 60, "hip_flexion_r": 80}),
    ("ankle_angle_r", PLANTARFLEXORS, {}),
]
STEP = 1e-4


class Legs:
    def __init__(self, path):
        self.m = mujoco.MjModel.from_xml_path(path)
        self.d = mujoco.MjData(self.m)

    def pose(self, angles):
        """Positions with these angles [rad], and what follows from them."""
        qpos = self.m.qpos0.copy()
        for name, angle in angles.items():
            qpos[self.m.joint(name).qposadr[0]] = angle
        for eq in range(self.m.neq):
            follower, leader = (self.m.jnt_qposadr[j] for j in (self.m.eq_obj1id[eq], self.m.eq_obj2id[eq]))
            qpos[follower] = np.polynomial.Polynomial(self.m.eq_data[eq][:5])(qpos[leader])
        return qpos

    def lengths(self, angles):
        self.d.qpos[:] = self.pose(angles)
        mujoco.mj_forward(self.m, self.d)
        return self.d.actuator_length.copy()

    def arms(self, joint, angles):
        """Moment arms of all muscles [m], positive where a pull leads to larger angles."""
        at = angles.get(joint, 0)
        ends = [self.lengths({**angles, joint: at + way * STEP}) for way in (-1, 1)]
        return (ends[0] - ends[1]) / (2 * STEP)

    def strength(self, joint, muscles, degrees):
        angles = {name: np.radians(angle) for name, angle in degrees.items()}
        arms = self.arms(joint, angles)
        self.d.qpos[:], self.d.qvel[:], self.d.act[:] = self.pose(angles), 0, 0
        self.d.act[[self.m.actuator(name).id for name in muscles]] = 1
        mujoco.mj_forward(self.m, self.d)
        return abs(arms @ self.d.actuator_force)

    def collapse(self):
        mujoco.mj_resetDataKeyframe(self.m, self.d, 0)
        mujoco.mj_forward(self.m, self.d)
        start = self.d.body("pelvis").xpos[2]
        while self.d.body("pelvis").xpos[2] > start - 0.2:
            mujoco.mj_step(self.m, self.d)
        return self.d.time


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for path in sys.argv[1:]:
        legs = Legs(path)
        print(path)
        for joint, muscles in ARMS.items():
            angles = np.linspace(*legs.m.joint(joint).range, 11)
            rows = np.array([legs.arms(joint, {joint: angle}) for angle in angles]) * 1e3
            for muscle in muscles:
                values = " ".join(f"{arm:4.0f}" for arm in rows[:, legs.m.actuator(muscle).id])
                print(f"  {joint:14} {muscle:10} {values}")
        for joint, muscles, degrees in STRENGTH:
            print(f"  {joint:14} {legs.strength(joint, muscles, degrees):.0f} N m")
        print(f"  sunk after {legs.collapse():.3f} s")


if __name__ == "__main__":
    main()
