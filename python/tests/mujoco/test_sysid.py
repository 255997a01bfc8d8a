"""System identification by laws: parameters that made a log are found in it, with the spread that noise gives them."""

import logging

import numpy as np
import pytest
import robohive.mujoco as mj
from robohive.mujoco import rollout, sysid

PENDULUM = """
<mujoco model="pendulum">
  <option timestep="0.004" integrator="implicitfast"/>
  <worldbody>
    <body name="arm">
      <joint name="hinge" axis="0 1 0" damping="0.3" armature="0.02"/>
      <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.03" mass="0.8"/>
    </body>
    <body name="still" pos="1 0 0"><joint name="idle" axis="0 0 1"/><geom size="0.05" mass="1"/></body>
  </worldbody>
  <actuator><position name="servo" joint="hinge" kp="20" kv="1"/></actuator>
  <sensor><jointpos name="angle" joint="hinge"/><jointvel name="speed" joint="hinge"/></sensor>
</mujoco>
"""


def log(noise=0.0, seed=0, seconds=3.0, delay=0):
    """Description, initial state, controls and readings of two sensors; `delay` in samples."""
    spec = mj.MjSpec.from_string(PENDULUM)
    model = spec.compile()
    t = np.arange(int(seconds / model.opt.timestep)) * model.opt.timestep
    control = (0.8 * np.sin(3 * t) + 0.3 * np.sin(11 * t)).reshape(-1, 1)
    start = sysid.create_initial_state(model, np.zeros(model.nq))
    state, sensors = rollout.rollout(model, mj.MjData(model), start, control[:-1])
    readings = sensors[0] + np.random.default_rng(seed).normal(size=sensors[0].shape) * noise
    times = state[0, :, 0] + delay * model.opt.timestep
    return spec, start, sysid.TimeSeries(t, control), sysid.TimeSeries.from_names(times, readings, model)


def joint_parameter(name, attribute, nominal, begin, high):
    def write(spec, param):
        target = spec.joint(name)
        if np.ndim(getattr(target, attribute)):
            getattr(target, attribute)[0] = param.value[0]
        else:
            setattr(target, attribute, param.value[0])

    param = sysid.Parameter(f"{name}.{attribute}", nominal, 0.0, high, modifier=write)
    param.value[:] = begin
    return param


def pendulum_parameters():
    return sysid.ParameterDict(
        {
            p.name: p
            for p in (
                joint_parameter("hinge", "damping", 0.3, 0.1, 2.0),
                joint_parameter("hinge", "armature", 0.02, 0.06, 0.5),
            )
        }
    )


@pytest.mark.parametrize("optimizer", ["mujoco", "scipy", "scipy_parallel_fd"])
def test_every_minimiser_finds_what_made_the_log(optimizer):
    spec, start, control, sensors = log()
    sequences = sysid.ModelSequences("pendulum", spec, "one", start, control, sensors)
    residual_fn = sysid.build_residual_fn(models_sequences=[sequences])
    scale = {} if optimizer == "mujoco" else {"x_scale": "jac", "xtol": 1e-12}
    found, result = sysid.optimize(pendulum_parameters(), residual_fn, optimizer, verbose=False, **scale)
    np.testing.assert_allclose(found.as_vector(), [0.3, 0.02], rtol=1e-6)
    assert result.jac.shape == (2 * len(sensors), 2)


def test_intervals_hold_the_truth_as_often_as_they_say():
    """Of 20 logs with noise at least 16 have the true damping within 95 % (the binomial law: fewer in 3 of a thousand)."""
    held = 0
    for seed in range(20):
        spec, start, control, sensors = log(noise=0.01, seed=seed, seconds=1.0)
        sequences = sysid.ModelSequences("pendulum", spec, "one", start, control, sensors)
        # Weights that make the noise of both columns one: what intervals assume.
        lengths = np.linalg.norm(sensors.data, axis=0)
        residual_fn = sysid.build_residual_fn(
            models_sequences=[sequences], sensor_weights={"angle": lengths[0], "speed": lengths[1]}
        )
        found, result = sysid.optimize(pendulum_parameters(), residual_fn, verbose=False)
        _, half = sysid.calculate_intervals(residual_fn(result.x, found)[0], result.jac)
        held += abs(found["hinge.damping"].value[0] - 0.3) <= half[0]
    assert held >= 16


def test_what_a_log_does_not_show_has_infinite_intervals():
    spec, start, control, sensors = log(noise=1e-3)
    params = pendulum_parameters()
    params.add(joint_parameter("idle", "armature", 0.1, 0.1, 1.0))
    sequences = sysid.ModelSequences("pendulum", spec, "one", start, control, sensors)
    residual_fn = sysid.build_residual_fn(models_sequences=[sequences])
    found, result = sysid.optimize(params, residual_fn, verbose=False)
    _, half = sysid.calculate_intervals(residual_fn(result.x, found)[0], result.jac)
    assert np.isfinite(half[:2]).all()
    assert np.isinf(half[2])


def test_covariance_is_that_of_a_straight_line():
    """Ordinary least squares, whose covariance is known in closed form."""
    x = np.linspace(0, 1, 50)
    design = np.column_stack([np.ones_like(x), x])
    left = np.random.default_rng(0).normal(size=50)
    covariance, half = sysid.calculate_intervals([left], design)
    variance = left @ left / 48
    expected = variance * np.linalg.inv(design.T @ design)
    np.testing.assert_allclose(covariance, expected, rtol=1e-9)
    # The quantile of Student's distribution with 48 degrees of freedom at 97.5 %.
    np.testing.assert_allclose(half, 2.0106348 * np.sqrt(np.diagonal(expected)), rtol=1e-6)


def test_delays_and_gains_are_fitted_with_the_model():
    spec, start, control, sensors = log(delay=3)
    gained = sysid.TimeSeries(sensors.times, sensors.data * [1.0, 1.3], sensors.signal_mapping)
    delay = sysid.Parameter("delay", 0.0, 0.0, 0.03)
    delay.value[:] = 0.005
    gain = sysid.Parameter("gain", 1.0, 0.5, 2.0)
    params = sysid.ParameterDict({"delay": delay, "gain": gain})
    transform = sysid.SignalTransform()
    transform.delay("*", delay)
    transform.gain("speed", gain, target="predicted")
    sequences = sysid.ModelSequences("pendulum", spec, "one", start, control, gained)
    residual_fn = sysid.build_residual_fn(models_sequences=[sequences], modify_residual=transform.apply)
    found, _ = sysid.optimize(params, residual_fn, verbose=False)
    np.testing.assert_allclose(found.as_vector(), [0.012, 1.3], rtol=1e-6)


def test_inertia_by_ten_numbers_comes_back():
    spec = mj.MjSpec.from_string(PENDULUM)
    model = spec.compile()
    before = model.body("arm")
    param = sysid.body_inertia_param(spec, model, "arm", sysid.InertiaType.Pseudo)
    after = sysid.apply_param_modifiers(sysid.ParameterDict({"inertia": param}), spec).body("arm")
    for name in ("mass", "ipos"):
        np.testing.assert_allclose(getattr(after, name), getattr(before, name), atol=1e-12)
    np.testing.assert_allclose(np.sort(after.inertia), np.sort(before.inertia), rtol=1e-9)
    low, high = param.get_bounds()
    assert ((low < param.value) & (param.value < high)).all()


def test_any_ten_numbers_are_an_inertia_that_a_body_can_have():
    draws = np.random.default_rng(1)
    for _ in range(20):
        theta = draws.normal(size=10)
        pi = sysid.model_modifier.pi_from_theta(theta)
        pseudo = sysid.model_modifier.pseudoinertia_from_pi(pi)
        assert np.linalg.eigvalsh(pseudo).min() > 0
        np.testing.assert_allclose(sysid.model_modifier.theta_from_pseudoinertia(pseudo), theta, rtol=1e-6, atol=1e-8)


def test_mass_scales_the_rotational_inertia_when_asked():
    spec = mj.MjSpec.from_string(PENDULUM)
    before = spec.compile().body("arm").inertia.copy()
    model = spec.compile()
    param = sysid.body_inertia_param(spec, model, "arm", sysid.InertiaType.MassIpos, scale_rot_inertia=True)
    param.value[0] *= 2
    after = sysid.apply_param_modifiers(sysid.ParameterDict({"arm": param}), spec).body("arm")
    np.testing.assert_allclose(after.inertia, 2 * before, rtol=1e-12)
    np.testing.assert_allclose(after.mass, 1.6)


def test_remove_visuals_keeps_what_touches():
    spec = mj.MjSpec.from_string(
        "<mujoco><asset><material name='m'/></asset><worldbody><geom name='seen' size='1' contype='0' conaffinity='0' "
        "material='m'/><geom name='felt' size='1'/></worldbody></mujoco>"
    )
    bare = sysid.remove_visuals(spec)
    assert [geom.name for geom in bare.geoms] == ["felt"]
    assert len(spec.geoms) == 2


def test_series_may_be_logged_in_another_order_than_the_model_has():
    spec, start, control, sensors = log()
    model = spec.compile()
    swapped = sysid.TimeSeries.from_names(sensors.times, sensors.data[:, ::-1], model, ["speed", "angle"])
    sequences = sysid.ModelSequences("pendulum", spec, "one", start, control, swapped)
    params = sysid.ParameterDict({"p": sysid.Parameter("p", 0.0, -1.0, 1.0)})
    left = sysid.build_residual_fn(models_sequences=[sequences])(params.as_vector(), params)[0]
    assert np.abs(np.concatenate(left)).max() < 1e-12


def test_results_and_report_are_written(tmp_path):
    spec, start, control, sensors = log(noise=1e-3)
    sequences = sysid.ModelSequences("pendulum", spec, "one", start, control, sensors)
    residual_fn = sysid.build_residual_fn(models_sequences=[sequences])
    params = pendulum_parameters()
    found, result = sysid.optimize(params, residual_fn, verbose=False)
    sysid.save_results(tmp_path, [sequences], params, found, result, residual_fn)
    loaded = sysid.ParameterDict.load_from_disk(tmp_path / "params_x_hat.yaml")
    np.testing.assert_array_equal(loaded.as_vector(), found.as_vector())
    written = mj.MjModel.from_xml_path(str(tmp_path / "pendulum.xml"))
    np.testing.assert_allclose(written.joint("hinge").damping[0], found["hinge.damping"].value[0], rtol=1e-9)
    sysid.default_report([sequences], params, found, residual_fn, result, save_path=tmp_path)
    page = (tmp_path / "report.html").read_text()
    assert "hinge.damping" in page and page.count("<svg") >= 5 and "<script" not in page


def test_two_trajectories_are_drawn_in_one_picture():
    model = mj.MjSpec.from_string(PENDULUM).compile()
    states = np.stack([sysid.create_initial_state(model, [angle, 0.0]) for angle in (0.0, 0.0, 1.2)])
    data = mj.MjData(model)
    one, same, two = (
        sysid.render_rollout(model, data, np.stack([states[rows]] * 2, axis=1), 30, width=80, height=60)[0]
        for rows in ([0], [0, 1], [0, 2])
    )
    assert np.abs(one.astype(int) - same).mean() < np.abs(one.astype(int) - two).mean()


def test_mistakes_are_named(caplog):
    spec, start, control, sensors = log()
    model = spec.compile()
    for mistake, said in (
        (lambda: sysid.TimeSeries.from_names(sensors.times, sensors.data, model, ["angle", "sped"]), "sped"),
        (lambda: sysid.TimeSeries(np.array([0.0, 1.0, 1.0]), np.zeros(3)), "sample 2 at 1 s"),
        (lambda: sysid.create_initial_state(model, [0.0], qpos_names=["hing_qpos"]), "hinge_qpos"),
        (lambda: sysid.apply_pgain(spec, "servos", 1.0), "servos"),
        (lambda: sysid.ModelSequences("p", spec, ["a", "b"], [start, start], control, sensors), "each trajectory"),
        (lambda: sysid.optimize(pendulum_parameters(), None, "newton"), "newton"),
        (lambda: sensors.resample(target_dt=0.0), "positive"),
    ):
        with pytest.raises(ValueError, match=said):
            mistake()
    params = pendulum_parameters()
    params["hinge.damping"].value[:] = 0.0
    sequences = sysid.ModelSequences("pendulum", spec, "one", start, control, sensors)
    with caplog.at_level(logging.WARNING, logger="absl"):
        sysid.optimize(params, sysid.build_residual_fn(models_sequences=[sequences]), verbose=False, max_iters=1)
    assert "begin at a bound" in caplog.text
