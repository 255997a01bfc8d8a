"""Functions with MuJoCo's signatures, and how they fail."""

import threading

import numpy as np
import pytest
import robohive.mujoco as mj
from robohive.mujoco import rollout
from scenes import ARM

FULL = mj.mjtState.mjSTATE_FULLPHYSICS


def test_errors_in_a_model_name_line_and_column():
    with pytest.raises(ValueError, match=r"<text>:2:5: error: unknown element <bad>"):
        mj.MjModel.from_xml_string("<mujoco>\n    <bad/></mujoco>")
    with pytest.raises(ValueError, match="nowhere.xml.*does not exist"):
        mj.MjModel.from_xml_path("nowhere.xml")
    with pytest.raises(ValueError, match="MuJoCo's own binary files cannot be read"):
        mj.MjModel.from_binary_path("x.mjb", {"x.mjb": b"\x01\x02\x03"})


def test_files_come_from_assets():
    text = '<mujoco><include file="parts/ball.xml"/></mujoco>'
    ball = b'<mujoco><worldbody><body name="b"><freejoint/><geom size=".1"/></body></worldbody></mujoco>'
    model = mj.MjModel.from_xml_string(text, {"parts/ball.xml": ball})
    assert model.body("b").id == 1


def test_unknown_names_list_those_that_there_are(model, data):
    with pytest.raises(KeyError, match=r"Invalid name 'leg'. Valid names: \['arm', 'ball', 'world'\]"):
        model.body("leg")
    with pytest.raises(IndexError, match="Invalid index 9. Valid indices from 0 to 2"):
        data.geom(9)
    assert mj.mj_name2id(model, mj.mjtObj.mjOBJ_BODY, "leg") == -1
    assert mj.mj_id2name(model, mj.mjtObj.mjOBJ_BODY, 2) == "arm"


def test_an_unstable_simulation_raises_or_resets(model, data):
    data.qvel[0] = np.nan
    with pytest.raises(mj.FatalError, match=r"qvel\[0\] of joint \"free\" is NaN"):
        mj.mj_step(model, data)
    assert mj.set_instability("reset") == "raise"
    try:
        with pytest.warns(RuntimeWarning, match="QVEL"):
            mj.mj_step(model, data)
        assert data.warning[mj.mjtWarning.mjWARN_BADQVEL].number == 1
        assert np.isfinite(data.qpos).all() and data.time == model.opt.timestep
        data.ctrl[0] = np.nan
        with pytest.warns(RuntimeWarning, match="actuator 0"):
            mj.mj_step(model, data, 3)
        warning = data.warning[mj.mjtWarning.mjWARN_BADCTRL]
        assert (warning.number, warning.lastinfo) == (3, 0) and np.isnan(data.ctrl[0])
        assert np.isfinite(data.qpos).all() and data.time == pytest.approx(4 * model.opt.timestep)
        mj.mj_step1(model, data)
        mj.mj_step2(model, data)
        assert data.warning[mj.mjtWarning.mjWARN_BADCTRL].number == 4
        mj.mj_resetData(model, data)
        assert data.warning[mj.mjtWarning.mjWARN_BADCTRL].number == 0
    finally:
        mj.set_instability("raise")
    with pytest.raises(ValueError, match="not 'ignore'"):
        mj.set_instability("ignore")


@pytest.mark.parametrize("integrator", ["Euler", "RK4", "implicit", "implicitfast"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e11])
def test_bad_controls_are_counted_as_in_mujoco(integrator, value):
    truth = pytest.importorskip("mujoco")
    text = (
        f"<mujoco><option integrator='{integrator}'/><worldbody><body><joint name='j'/><geom size='.1' pos='.3 0 0'/></body>"
        "</worldbody><actuator><motor joint='j'/><motor joint='j' gear='2'/></actuator></mujoco>"
    )

    def seen(engine):
        model = engine.MjModel.from_xml_string(text)
        data, found = engine.MjData(model), []

        def halves(model, data):
            engine.mj_step1(model, data)
            engine.mj_step2(model, data)

        for call in (engine.mj_step, engine.mj_forward, halves, engine.mj_inverse):
            data.ctrl[:] = 0.3, value
            call(model, data)
            found.append([warning.number for warning in data.warning] + [data.warning[6].lastinfo])
        return found, data.ctrl.tolist(), data.time

    mj.set_mju_user_warning(lambda text: None)
    mj.set_instability("reset")
    try:
        ours = seen(mj)
    finally:
        mj.set_instability("raise")
        mj.set_mju_user_warning(None)
    assert repr(ours) == repr(seen(truth))


def test_warnings_are_counted_since_a_reset_and_told_once(model, data):
    told, warning = [], data.warning
    mj.set_instability("reset")
    mj.set_mju_user_warning(told.append)
    try:
        for _ in range(2):
            data.qpos[1] = np.nan
            mj.mj_step(model, data)
        assert warning.number.tolist() == [0, 0, 0, 1, 0, 0, 0] and warning[3].lastinfo == 1
        data.qvel[2] = 1e20
        mj.mj_step(model, data)
        assert warning.number.tolist() == [0, 0, 0, 0, 1, 0, 0] and warning is data.warning
        assert [text.split()[0] for text in told] == ["QPOS", "QVEL"] and "time 0.0020" in told[1]
        warning[4].number = 0
        data.qvel[2] = np.nan
        mj.set_mju_user_warning(None)
        with pytest.warns(RuntimeWarning, match="QVEL is not finite or too large at degree of freedom 2"):
            mj.mj_step(model, data)
    finally:
        mj.set_instability("raise")
        mj.set_mju_user_warning(None)


def test_arguments_of_wrong_types_and_shapes(model, data):
    with pytest.raises(TypeError):
        mj.mj_step(model, 3)
    with pytest.raises(TypeError, match=r"jacp must have shape \(3, nv\)"):
        mj.mj_jac(model, data, np.zeros((2, 2)), None, np.zeros(3), 1)
    with pytest.raises(TypeError, match="point should be a vector of 3"):
        mj.mj_jac(model, data, np.zeros((3, model.nv)), None, np.zeros(2), 1)
    with pytest.raises(ValueError, match="no body 9"):
        mj.mj_jacBody(model, data, np.zeros((3, model.nv)), None, 9)
    other = mj.MjModel.from_xml_string("<mujoco/>")
    with pytest.raises(mj.FatalError, match="sizes differ"):
        mj.mj_step(other, data)


def test_one_simulation_in_two_threads_is_an_exception(model, data):
    failures, done = [], threading.Event()

    def step_long():
        mj.mj_step(model, data, 200_000)
        done.set()

    thread = threading.Thread(target=step_long)
    thread.start()
    while not done.is_set() and not failures:
        try:
            mj.mj_step(model, data)
        except RuntimeError as error:
            failures.append(str(error))
    thread.join()
    assert failures and "in use by another thread" in failures[0]


def test_jacobians_move_what_velocities_move(model, data):
    data.qvel[:] = np.arange(1, 8) / 10
    mj.mj_forward(model, data)
    jacp, jacr = np.zeros((3, model.nv)), np.zeros((3, model.nv))
    mj.mj_jacSite(model, data, jacp, jacr, model.site("top").id)
    assert np.allclose(jacp @ data.qvel, data.sensor("speed").data, atol=1e-14)
    velocity = np.zeros(6)
    mj.mj_objectVelocity(model, data, mj.mjtObj.mjOBJ_SITE, model.site("top").id, velocity, 0)
    assert np.allclose(velocity, np.concatenate((jacr @ data.qvel, jacp @ data.qvel)), atol=1e-14)


def test_inertia_is_one_matrix_in_all_its_forms(model, data):
    mj.mj_forward(model, data)
    full, product, solution = np.zeros((7, 7)), np.zeros(7), np.zeros((1, 7))
    vector = np.arange(7.0)
    mj.mj_fullM(model, data, full)
    mj.mj_mulM(model, data, product, vector)
    mj.mj_solveM(model, data, solution, product[None])
    assert np.allclose(full @ vector, product) and np.allclose(solution[0], vector)


def test_rays_and_distances(model, data):
    mj.mj_forward(model, data)
    geom = np.zeros(1, np.int32)
    down = mj.mj_ray(model, data, [0.05, 0, 2], [0, 0, -1], None, True, -1, geom)
    assert geom[0] == model.geom("rod").id and 1.4 < down < 1.6
    assert mj.mj_ray(model, data, [5, 5, 5], [0, 0, 1], None, True, -1, geom) == -1 and geom[0] == -1
    ids, distances = np.zeros(2, np.int32), np.zeros(2)
    mj.mj_multiRay(model, data, [0.05, 0, 2], [0, 0, -1, 0, 0, 1], None, True, -1, ids, distances, None, 2, 10.0)
    assert ids[1] == -1 and distances[0] == down
    points = np.zeros(6)
    gap = mj.mj_geomDistance(model, data, 0, model.geom("shell").id, 1.0, points)
    assert gap == pytest.approx(0.2) and abs(points[2]) < 1e-12


def test_positions_and_velocities_are_inverse(model, data):
    start, velocity, found = data.qpos.copy(), np.linspace(-1, 1, 7), np.zeros(7)
    end = start.copy()
    mj.mj_integratePos(model, end, velocity, 0.1)
    mj.mj_differentiatePos(model, found, 0.1, start, end)
    assert np.allclose(found, velocity)


def test_slopes_of_a_step_predict_it(model, data):
    a, b = np.zeros((14, 14)), np.zeros((14, 1))
    mj.mjd_transitionFD(model, data, 1e-6, True, a, b, None, None)
    base = _after(model, 0.0)
    assert np.allclose(b[7:, 0] * 0.01, (_after(model, 0.01) - base), atol=1e-9)


def _after(model, control):
    data = mj.MjData(model)
    data.ctrl[0] = control
    mj.mj_step(model, data)
    return data.qvel.copy()


def test_stages_in_turn_make_a_forward_pass(model, data):
    data.qvel[:] = 0.3
    whole = mj.MjData(model)
    mj.mj_copyState(model, data, whole, mj.mjtState.mjSTATE_INTEGRATION)
    mj.mj_forward(model, whole)
    for stage in ("fwdPosition", "fwdVelocity", "fwdActuation", "fwdAcceleration", "fwdConstraint"):
        getattr(mj, f"mj_{stage}")(model, data)
    assert np.array_equal(data.qacc, whole.qacc)


def test_rollouts_are_those_of_single_steps(model, data):
    start = np.zeros(mj.mj_stateSize(model, FULL))
    mj.mj_getState(model, data, start, FULL)
    controls = np.random.default_rng(0).normal(size=(5, 20, 1))
    states, sensors = rollout.rollout(model, [mj.MjData(model) for _ in range(3)], start, controls)
    assert states.shape == (5, 20, start.size) and sensors.shape == (5, 20, model.nsensordata)
    data = mj.MjData(model)
    state = np.zeros(start.size)
    for step, control in enumerate(controls[3]):
        data.ctrl[:] = control
        mj.mj_step(model, data)
        mj.mj_getState(model, data, state, FULL)
        assert np.array_equal(states[3, step], state)
    with pytest.raises(ValueError, match="trailing dimension of control must be 1, got 4"):
        rollout.rollout(model, data, start, np.zeros((1, 2, 4)))


def test_quaternions(model):
    rng = np.random.default_rng(1)
    for _ in range(20):
        quat = rng.normal(size=4)
        mj.mju_normalize4(quat)
        matrix, back = np.zeros(9), np.zeros(4)
        mj.mju_quat2Mat(matrix, quat)
        mj.mju_mat2Quat(back, matrix)
        assert np.allclose(np.abs(back @ quat), 1.0)
        vector, turned = rng.normal(size=3), np.zeros(3)
        mj.mju_rotVecQuat(turned, vector, quat)
        assert np.allclose(matrix.reshape(3, 3) @ vector, turned)
        axis = np.zeros(4)
        mj.mju_quatZ2Vec(axis, vector)
        mj.mju_rotVecQuat(turned, [0.0, 0.0, 1.0], axis)
        assert np.allclose(turned, vector / np.linalg.norm(vector))


def test_names_without_anything_behind_them_say_so(model):
    with pytest.raises(NotImplementedError, match="has no mjr_figure"):
        mj.mjr_figure(None, None, None)
    assert mj.MjPreContact().pos.tolist() == [0, 0, 0] and mj.MjrVertexAttribute(3).usage == 3
    with pytest.raises(TypeError, match="made by the engine only"):
        mj.MjIntVec([1])
    with pytest.raises(NotImplementedError, match="Rust.s allocator"):
        mj.set_mju_user_malloc(lambda size: None)
    assert mj.MjSpec.from_string(ARM).compile().nbody == 3


def test_pictures(model, data):
    mj.mj_forward(model, data)
    with mj.Renderer(model, 48, 64) as renderer:
        renderer.update_scene(data, "front")
        colours = renderer.render()
        assert colours.shape == (48, 64, 3) and colours.dtype == np.uint8 and colours.std() > 1
        renderer.enable_depth_rendering()
        assert 1.5 < renderer.render().min() < 2.0
        renderer.enable_segmentation_rendering()
        shell = [model.geom("shell").id, mj.mjtObj.mjOBJ_GEOM]
        assert (renderer.render() == shell).all(axis=2).any()
        with pytest.raises(ValueError, match='"back" does not exist'):
            renderer.update_scene(data, "back")
    with pytest.raises(RuntimeError, match="is closed"):
        renderer.render()
    with pytest.raises(ValueError, match="framebuffer"):
        mj.Renderer(model, 4000, 64)


def test_a_pass_with_bad_controls_warns_and_counts_them_as_zero(model, data):
    mj.set_instability("reset")
    try:
        mj.mj_forward(model, data)
        without = data.qacc.copy()
        data.ctrl[0] = np.nan
        with pytest.warns(RuntimeWarning, match="CTRL is not finite or too large at actuator 0"):
            mj.mj_forward(model, data)
    finally:
        mj.set_instability("raise")
    assert data.warning.number.tolist() == [0, 0, 0, 0, 0, 0, 1]
    np.testing.assert_array_equal(data.qacc, without)
    assert np.isnan(data.ctrl[0])


@pytest.mark.parametrize("value", [-1, 10**30, 1.5])
def test_sizes_and_counts_are_refused_by_their_name(model, data, value):
    start = np.zeros((1, mj.mj_stateSize(model, mj.mjtState.mjSTATE_FULLPHYSICS)))
    calls = {
        "height": lambda: mj.Renderer(model, value, 16),
        "width": lambda: mj.Renderer(model, 16, value),
        "max_geom": lambda: mj.Renderer(model, 16, 16, max_geom=value),
        "maxgeom": lambda: mj.MjvScene(model, value),
        "nstep": lambda: rollout.rollout(model, data, start, nstep=value),
        "nthread": lambda: rollout.Rollout(nthread=value),
    }
    for name, call in calls.items():
        with pytest.raises(ValueError, match=f"^{name} is a whole number from"):
            call()
