"""A script written for MuJoCo, run by the stand-in: the call of install() is all that differs.

python examples/mujoco_script.py [--mujoco]   # with --mujoco, by MuJoCo itself, to compare
"""

import sys

if "--mujoco" not in sys.argv:
    import robohive.mujoco

    robohive.mujoco.install()

import mujoco
import numpy as np

PENDULUM = """
<mujoco model="double pendulum">
  <option timestep="0.002" integrator="RK4"><flag energy="enable"/></option>
  <worldbody>
    <body name="upper" pos="0 0 2">
      <joint name="shoulder" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0 0 -.6" size=".04"/>
      <body name="lower" pos="0 0 -.6">
        <joint name="elbow" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0 0 -.6" size=".03"/>
        <site name="tip" pos="0 0 -.6"/>
      </body>
    </body>
  </worldbody>
  <sensor><framepos name="tip" objtype="site" objname="tip"/></sensor>
</mujoco>
"""


def main() -> None:
    model = mujoco.MjModel.from_xml_string(PENDULUM)
    data = mujoco.MjData(model)
    data.joint("shoulder").qpos[0] = 2.0
    mujoco.mj_forward(model, data)
    start = float(np.sum(data.energy))
    for _ in range(5):
        mujoco.mj_step(model, data, nstep=100)
        tip = data.sensor("tip").data
        print(f"t={data.time:.1f} s  tip {tip[0]:+.6f} {tip[2]:+.6f}  energy {np.sum(data.energy) - start:+.2e} J")
    jacobian = np.zeros((3, model.nv))
    mujoco.mj_jacSite(model, data, jacobian, None, model.site("tip").id)
    print("Jacobian of the tip:", np.array2string(jacobian, precision=4, suppress_small=True).replace("\n", ""))


if __name__ == "__main__":
    main()
