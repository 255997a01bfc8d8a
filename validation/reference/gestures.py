"""Records what MuJoCo's viewer does with gestures: cameras moved, geoms picked, bodies pulled, turned and placed.

    pip install mujoco==3.12.0
    python validation/reference/gestures.py --out src/viewer/tests/gestures.json

Models are those of `assets/`. Drags are in heights of the view, to the right and up; MuJoCo counts down.
"""

import argparse
import json
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

MODELS = ("pile/pile", "franka/franka_table", "humanoid/humanoid", "workbench/workbench")
MOCAP = """<mujoco><worldbody><geom type="plane" size="2 2 .1"/>
<body mocap="true" pos=".3 .2 .5" euler="10 20 30"><geom type="box" size=".1 .2 .3" pos=".1 .05 0"/></body>
<body pos="-.4 0 .6" euler="40 0 0"><freejoint/><geom type="capsule" size=".1 .3" pos=".1 0 0"/>
<body pos="0 0 .4"><joint axis="0 1 0"/><geom type="box" size=".05 .1 .2" pos=".1 0 .2"/></body></body>
</worldbody></mujoco>
"""
ASPECT = 16 / 9
MOUSE = mujoco.mjtMouse
LOOKS = {
    "orbit": MOUSE.mjMOUSE_ROTATE_V,
    "pan vertical": MOUSE.mjMOUSE_MOVE_V,
    "pan horizontal": MOUSE.mjMOUSE_MOVE_H,
    "zoom": MOUSE.mjMOUSE_ZOOM,
}
GRIPS = {
    "pull vertical": (MOUSE.mjMOUSE_MOVE_V, mujoco.mjtPertBit.mjPERT_TRANSLATE),
    "pull horizontal": (MOUSE.mjMOUSE_MOVE_H, mujoco.mjtPertBit.mjPERT_TRANSLATE),
    "turn vertical": (MOUSE.mjMOUSE_ROTATE_V, mujoco.mjtPertBit.mjPERT_ROTATE),
    "turn horizontal": (MOUSE.mjMOUSE_ROTATE_H, mujoco.mjtPertBit.mjPERT_ROTATE),
}


class Viewer:
    """A model with a camera and a scene, moved for a while."""

    def __init__(self, text: str, orthographic: bool) -> None:
        """A model of a text, or of a file whose path is given."""
        read = mujoco.MjModel.from_xml_string if text.startswith("<") else mujoco.MjModel.from_xml_path
        self.model = read(text)
        self.data = mujoco.MjData(self.model)
        if self.model.nkey:
            mujoco.mj_resetDataKeyframe(self.model, self.data, 0)
        for _ in range(20):
            mujoco.mj_step(self.model, self.data)
        mujoco.mj_forward(self.model, self.data)
        self.camera = mujoco.MjvCamera()
        mujoco.mjv_defaultFreeCamera(self.model, self.camera)
        if orthographic:
            self.model.vis.global_.orthographic = 1
            self.model.vis.global_.fovy = 1.5 * self.model.stat.extent
            self.camera.orthographic = 1
        self.options = mujoco.MjvOption()
        self.scene = mujoco.MjvScene(self.model, 2000)

    def update(self) -> None:
        """Fills the scene, whose camera picking and pulling read."""
        everything = mujoco.mjtCatBit.mjCAT_ALL
        mujoco.mjv_updateScene(self.model, self.data, self.options, None, self.camera, everything, self.scene)

    def pose(self) -> list[float]:
        """Where the camera looks, from how far, and in which direction."""
        c = self.camera
        return [*c.lookat, c.distance, c.azimuth, c.elevation]

    def moves(self, draws: np.random.Generator) -> list[dict[str, Any]]:
        """Camera moves, one after the other."""
        rows = []
        for name in draws.choice(list(LOOKS), 12):
            drag = draws.uniform(-0.4, 0.4, 2)
            mujoco.mjv_moveCamera(self.model, LOOKS[name], drag[0], -drag[1], self.camera)
            rows.append({"look": name, "drag": drag.tolist(), "camera": self.pose()})
        return rows

    def picks(self, draws: np.random.Generator) -> list[dict[str, Any]]:
        """Geoms at places of the picture."""
        self.update()
        rows = []
        for at in draws.uniform(0.05, 0.95, (40, 2)):
            point, geom, flex, skin = np.zeros(3), *(np.array([-1], np.int32) for _ in range(3))
            body = mujoco.mjv_select(
                self.model, self.data, self.options, ASPECT, at[0], at[1], self.scene, point, geom, flex, skin
            )
            if flex[0] < 0 and skin[0] < 0:
                rows.append({"at": at.tolist(), "body": body, "geom": int(geom[0]), "point": point.tolist()})
        return rows

    def pulls(self, draws: np.random.Generator) -> list[dict[str, Any]]:
        """Forces of pulled bodies, and states of placed ones."""
        self.update()
        rows = []
        for body in range(1, self.model.nbody):
            for name, (action, bit) in GRIPS.items():
                hand = mujoco.MjvPerturb()
                hand.select, hand.active = body, bit
                hand.localpos[:] = draws.uniform(-0.1, 0.1, 3)
                mujoco.mjv_initPerturb(self.model, self.data, self.scene, hand)
                drags = draws.uniform(-0.3, 0.3, (3, 2))
                for right, up in drags:
                    mujoco.mjv_movePerturb(self.model, self.data, action, right, -up, self.scene, hand)
                row = {"body": body, "point": hand.localpos.tolist(), "grip": name, "drags": drags.tolist()}
                self.data.xfrc_applied[:] = 0
                mujoco.mjv_applyPerturbForce(self.model, self.data, hand)
                row["wrench"] = self.data.xfrc_applied[body].tolist()
                self.data.xfrc_applied[:] = 0
                before = self.data.qpos.copy(), self.data.mocap_pos.copy(), self.data.mocap_quat.copy()
                mujoco.mjv_applyPerturbPose(self.model, self.data, hand, 1)
                changed = not np.array_equal(self.data.qpos, before[0])
                row["qpos"] = self.data.qpos.tolist() if changed else []
                row["mocap"] = [*self.data.mocap_pos.ravel(), *self.data.mocap_quat.ravel()]
                self.data.qpos[:], self.data.mocap_pos[:], self.data.mocap_quat[:] = before
                rows.append(row)
        return rows


def main() -> None:
    """Records all models."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--assets", type=Path, default=Path("assets"))
    options = parser.parse_args()
    records = []
    models = {f"{name}.xml": str(options.assets / f"{name}.xml") for name in MODELS} | {MOCAP: MOCAP}
    for number, (name, text) in enumerate(models.items()):
        for orthographic in (False, True):
            draws = np.random.default_rng(10 * number + orthographic)
            viewer = Viewer(text, orthographic)
            record = {
                "model": name,
                "orthographic": orthographic,
                "qpos": viewer.data.qpos.tolist(),
                "qvel": viewer.data.qvel.tolist(),
                "mocap": [*viewer.data.mocap_pos.ravel(), *viewer.data.mocap_quat.ravel()],
                "picks": viewer.picks(draws),
                "pulls": viewer.pulls(draws)[:: 1 if viewer.model.nbody < 12 else 5],
                "moves": viewer.moves(draws),
            }
            records.append(record)
    lines = ",\n".join(json.dumps(record) for record in records)
    options.out.write_text(f"[\n{lines}\n]\n")


if __name__ == "__main__":
    main()
