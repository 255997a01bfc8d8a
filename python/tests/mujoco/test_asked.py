"""Callbacks inside of stages: actuators of type `user`, and pairs of geoms that may touch, beside MuJoCo's own bindings where
these are installed."""

import numpy as np
import pytest
import robohive.mujoco as mj

ACTUATED = """
<mujoco>
  <option integrator="{integrator}" timestep="0.01"><flag sleep="{sleep}"/></option>
  <worldbody>
    <body><joint name="a" axis="0 1 0" damping=".1"/><geom size=".1" pos="1 0 0"/>
      <body pos="1 0 0"><joint name="b" axis="0 1 0" damping=".1"/><geom size=".1" pos="1 0 0"/></body></body>
  </worldbody>
  <actuator>
    <general joint="a" dyntype="user" actdim="2" gaintype="user" biastype="user" gainprm="3"/>
    <general joint="b" gaintype="user" forcelimited="true" forcerange="-2 2"/>
    <general joint="b" dyntype="user" actdim="1" gainprm="2" actearly="true"/>
    <general joint="a" biastype="user" group="3"/>
  </actuator>
</mujoco>
"""

#: A sphere on a plane and beside two others; the contact types of the last keep it from the plane.
TOUCHING = """
<mujoco>
  <worldbody>
    <geom type="plane" size="2 2 1"/>
    <body pos="0 0 .09"><freejoint/><geom name="one" size=".1"/></body>
    <body pos="0 .19 .09"><freejoint/><geom name="two" size=".1"/><geom size=".1" pos="0 0 .15"/></body>
    <body pos="0 .38 .09"><freejoint/><geom size=".1" contype="2" conaffinity="2"/></body>
  </worldbody>
  <contact><pair geom1="one" geom2="two"/></contact>
</mujoco>
"""


@pytest.fixture(autouse=True)
def reset():
    yield
    mj.mj_resetCallbacks()


def install(module):
    """Callbacks that depend on state, time and parameters."""

    def dynamics(m, d, i):
        if i == 0:
            d.act_dot[:2] = d.qvel[0] - d.act[0], d.ctrl[0] - d.act[1]
        return 0.5 * d.ctrl[i] - d.act[-1]

    module.set_mjcb_act_dyn(dynamics)
    module.set_mjcb_act_gain(lambda m, d, i: m.actuator_gainprm[i, 0] + d.actuator_length[i] + i)
    module.set_mjcb_act_bias(lambda m, d, i: -d.actuator_velocity[i] + 0.1 * i)


def clear(module):
    for name in ("act_dyn", "act_gain", "act_bias", "contactfilter"):
        getattr(module, f"set_mjcb_{name}")(None)


def run(module, text, disabled, steps=50):
    model = module.MjModel.from_xml_string(text)
    install(module)
    model.opt.disableactuator = disabled
    data = module.MjData(model)
    trace = []
    for i in range(steps):
        data.ctrl[:] = np.sin(0.1 * i + np.arange(model.nu))
        module.mj_step(model, data)
        trace.append(np.concatenate([data.qpos, data.qvel, data.act, data.act_dot, data.actuator_force, data.qfrc_actuator]))
    return np.array(trace)


@pytest.mark.parametrize("disabled", [0, 1 << 3])
@pytest.mark.parametrize("sleep", ["disable", "enable"])
@pytest.mark.parametrize("integrator", ["Euler", "RK4", "implicitfast", "implicit"])
def test_actuators_of_a_program_move_as_in_mujoco(truth, integrator, sleep, disabled):
    text = ACTUATED.format(integrator=integrator, sleep=sleep)
    traces = []
    for module in (truth, mj):
        traces.append(run(module, text, disabled))
        clear(module)
    assert np.abs(traces[0][:, :2]).max() > 0.3, "something moves"
    np.testing.assert_allclose(traces[1], traces[0], rtol=1e-9, atol=1e-10)


def test_each_callback_is_asked_of_its_actuators():
    model = mj.MjModel.from_xml_string(ACTUATED.format(integrator="Euler", sleep="disable"))
    data = mj.MjData(model)
    asked = []
    mj.set_mjcb_act_dyn(lambda m, d, i: asked.append(("dyn", i)) or 2.0)
    mj.set_mjcb_act_gain(lambda m, d, i: asked.append(("gain", i)) or 3.0)
    mj.set_mjcb_act_bias(lambda m, d, i: asked.append(("bias", i)) or 4.0)
    data.ctrl[:] = 0.5
    mj.mj_fwdActuation(model, data)
    assert asked == [("dyn", 0), ("dyn", 2), ("gain", 0), ("gain", 1), ("bias", 0), ("bias", 3)]
    # The first has two activations, whose rates its callback would write; the second is limited to 2 [N m], the third acts
    # early, with what its activation is after a step.
    assert data.act_dot.tolist() == [0, 0, 2]
    mj.mj_forward(model, data)
    np.testing.assert_allclose(data.actuator_force, [4, 1.5, 2 * 0.02, 4.5])


def test_without_callbacks_the_input_passes_through():
    model = mj.MjModel.from_xml_string(ACTUATED.format(integrator="Euler", sleep="disable"))
    data = mj.MjData(model)
    data.ctrl[1] = 0.7
    mj.mj_forward(model, data)
    plain = data.actuator_force.copy()
    mj.set_mjcb_control(lambda m, d: None)
    mj.mj_forward(model, data)
    assert plain[1] == 0.7 and data.actuator_force.tolist() == plain.tolist()


@pytest.mark.parametrize("name", ["act_dyn", "act_gain", "act_bias"])
def test_what_is_no_number_is_refused(name):
    model = mj.MjModel.from_xml_string(ACTUATED.format(integrator="Euler", sleep="disable"))
    data = mj.MjData(model)
    getattr(mj, f"set_mjcb_{name}")(lambda m, d, i: "much")
    with pytest.raises(TypeError, match=f"mjcb_{name} callback did not return a number"):
        mj.mj_step(model, data)
    getattr(mj, f"set_mjcb_{name}")(None)
    mj.mj_step(model, data)


def apart(a, b):
    """Pairs that a program keeps apart."""
    return int((a, b) in ((0, 1), (3, 4)))


@pytest.mark.parametrize("keeps_apart", [lambda a, b: 0, lambda a, b: 1, apart])
def test_pairs_are_filtered_as_in_mujoco(truth, keeps_apart):
    ends = []
    for module in (truth, mj):
        model = module.MjModel.from_xml_string(TOUCHING)
        data = module.MjData(model)
        asked = set()
        module.set_mjcb_contactfilter(lambda m, d, a, b, asked=asked: asked.add((a, b)) or keeps_apart(a, b))
        module.mj_forward(model, data)
        contacts = sorted(map(tuple, data.contact.geom.tolist()))
        first = (asked.copy(), contacts)
        module.mj_step(model, data, 20)
        ends.append((first, data.qpos.copy()))
        clear(module)
    assert ends[1][0] == ends[0][0]
    np.testing.assert_allclose(ends[1][1], ends[0][1], rtol=0, atol=1e-9)


def test_a_filter_in_place_of_contact_types_meets_sleeping_bodies(truth):
    text = TOUCHING.replace("<worldbody>", '<option sleep_tolerance="1e-2"><flag sleep="enable"/></option><worldbody>')
    text = text.replace('<body pos="0 .38 .09">', '<body pos="0 .38 .9">').replace('size=".1"', 'type="box" size=".1 .1 .1"')
    ends = []
    for module in (truth, mj):
        model = module.MjModel.from_xml_string(text)
        data = module.MjData(model)
        module.set_mjcb_contactfilter(lambda m, d, a, b: int(a == 1 and b == 3))
        trace = []
        for _ in range(400):
            module.mj_step(model, data)
            trace.append(np.concatenate([data.qpos, data.tree_asleep]))
        ends.append(np.array(trace))
        clear(module)
    assert (ends[0][:, -3:] >= 0).any(), "something sleeps"
    np.testing.assert_allclose(ends[1], ends[0], rtol=0, atol=1e-6)


def test_collision_alone_asks_too():
    model = mj.MjModel.from_xml_string(TOUCHING)
    data = mj.MjData(model)
    mj.mj_kinematics(model, data)
    mj.mj_comPos(model, data)
    mj.set_mjcb_contactfilter(lambda m, d, a, b: a == 0)
    mj.mj_collision(model, data)
    assert all(0 not in pair for pair in data.contact.geom.tolist()) and data.ncon == 1
    for wrong in (None, 0.5, "no"):
        mj.set_mjcb_contactfilter(lambda m, d, a, b, wrong=wrong: wrong)
        with pytest.raises(TypeError, match="did not return an integer"):
            mj.mj_forward(model, data)
