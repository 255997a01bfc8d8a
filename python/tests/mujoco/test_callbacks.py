"""Callbacks between the stages of passes."""

import numpy as np
import pytest
import robohive.mujoco as mj

ARM = """
<mujoco>
  <option integrator="implicitfast"/>
  <worldbody>
    <body><joint name="j" axis="0 1 0" damping=".1"/><geom size=".1" pos="1 0 0"/></body>
  </worldbody>
  <actuator><motor joint="j"/></actuator>
  <sensor><user dim="2" needstage="vel"/></sensor>
</mujoco>
"""


@pytest.fixture
def scene():
    model = mj.MjModel.from_xml_string(ARM)
    yield model, mj.MjData(model)
    mj.mj_resetCallbacks()


def run(model, steps):
    data = mj.MjData(model)
    mj.mj_step(model, data, steps)
    return data


@pytest.mark.parametrize("integrator", [0, 2, 3])
def test_a_callback_that_does_nothing_changes_no_bit(scene, integrator):
    model, _ = scene
    model.opt.integrator = integrator
    plain = run(model, 20)
    mj.set_mjcb_control(lambda m, d: None)
    called = run(model, 20)
    assert plain.qpos[0] != 0
    np.testing.assert_array_equal(called.qpos, plain.qpos)
    np.testing.assert_array_equal(called.qvel, plain.qvel)
    assert called.time == plain.time


@pytest.mark.parametrize("dynamics", ["none", "integrator", "filter", "filterexact", "muscle"])
def test_runge_kutta_with_a_callback_is_the_engines(dynamics):
    model = mj.MjModel.from_xml_string(
        f"""<mujoco><option integrator="RK4" timestep="0.01"/><worldbody><body><freejoint/><geom size=".1 .2 .3" type="box"/>
        <body pos=".3 0 0"><joint name="j" axis="0 1 0"/><geom size=".1" pos=".2 0 0"/></body></body></worldbody>
        <actuator><general joint="j" dyntype="{dynamics}" actlimited="{'false' if dynamics == 'none' else 'true'}"
        actrange="0 0.8" dynprm="0.05 0.1" ctrlrange="0 1"/></actuator></mujoco>"""
    )
    ends = []
    for callback in (None, lambda m, d: None):
        data = mj.MjData(model)
        data.qvel[:] = np.linspace(-1, 1, model.nv)
        data.ctrl[0] = 0.9
        mj.set_mjcb_control(callback)
        mj.mj_step(model, data, 30)
        ends.append(np.concatenate([data.qpos, data.qvel, data.act, [data.time]]))
    mj.mj_resetCallbacks()
    assert np.abs(ends[0]).max() > 0.5
    np.testing.assert_allclose(ends[1], ends[0], rtol=0, atol=1e-12)


def test_control_and_passive_forces_are_asked_for(scene):
    model, data = scene
    mj.set_mjcb_control(lambda m, d: d.ctrl.fill(d.qfrc_bias[0]))
    mj.mj_step(model, data, 50)
    assert abs(data.qpos[0]) < 1e-12, "the motor carries the weight"
    mj.set_mjcb_control(None)
    data.ctrl[:] = 0
    weight = float(data.qfrc_bias[0])
    mj.set_mjcb_passive(lambda m, d: d.qfrc_passive.__iadd__(weight))
    mj.mj_forward(model, data)
    assert abs(data.qacc[0]) < 1e-9 and weight != 0


def test_controllers_between_the_halves_of_a_step_are_asked_too(scene):
    model, data = scene
    calls = []
    mj.set_mjcb_control(lambda m, d: calls.append(d.time))
    mj.mj_step1(model, data)
    mj.mj_step2(model, data)
    mj.mj_forwardSkip(model, data, 2, 0)
    assert calls == [0.0, data.time]


def test_user_sensors_are_read_at_their_stage(scene):
    model, data = scene
    stages = []

    def read(m, d, stage):
        stages.append(stage)
        d.sensordata[:] = 3.0, d.qvel[0]

    mj.set_mjcb_sensor(read)
    data.qvel[0] = 0.5
    mj.mj_forward(model, data)
    assert stages == [mj.mjtStage.mjSTAGE_VEL] and data.sensordata.tolist() == [3.0, 0.5]


def test_exceptions_pass_through_and_leave_the_data_usable(scene):
    model, data = scene

    def fail(m, d):
        raise KeyError("no controller")

    mj.set_mjcb_control(fail)
    with pytest.raises(KeyError, match="no controller"):
        mj.mj_step(model, data)
    mj.set_mjcb_control(None)
    mj.mj_step(model, data)
    assert data.time > 0


def test_what_cannot_be_called_is_refused():
    with pytest.raises(TypeError, match="Optional"):
        mj.set_mjcb_control(3)
    with pytest.raises(NotImplementedError, match="mju_user_malloc"):
        mj.set_mju_user_malloc(lambda size: None)


def test_the_clock_is_asked_and_timers_count(scene):
    model, data = scene
    mj.mj_step(model, data, 5)
    mj.mj_forward(model, data)
    assert data.timer.number[:3].tolist() == [5, 1, 0] and data.timer[0].duration > 0
    ticks = []
    mj.set_mjcb_time(lambda: ticks.append(1) or float(len(ticks)))
    mj.mj_forward(model, data)
    assert len(ticks) >= 2
    for reset in (mj.mj_resetData, lambda m, d: mj.mj_resetDataKeyframe(m, d, 0)):
        mj.set_mjcb_time(None)
        mj.mj_step(model, data)
        reset(model, data)
        assert data.timer.number.tolist() == [0] * 15
