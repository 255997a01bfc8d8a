"""Models and simulations are freed when nobody holds them."""

import gc
import resource

import robohive.mujoco as mj
from scenes import ARM


def test_making_and_dropping_holds_no_memory():
    def make(times):
        for _ in range(times):
            model = mj.MjModel.from_xml_string(ARM)
            data = mj.MjData(model)
            assert model.opt.timestep > 0 and data.joint("hinge").qpos.size == 1
            mj.mj_step(model, data)

    gc.collect()
    gc.disable()
    try:
        make(200)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        make(800)
        after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    finally:
        gc.enable()
    assert after < 1.05 * before
