"""Functions over numbers beside MuJoCo's own bindings, where these are installed."""

import numpy as np
import pytest
import robohive.mujoco as mj

SCENE = """
<mujoco>
  <option cone="{cone}" jacobian="{jacobian}"><flag energy="enable"/></option>
  <default><geom condim="4" friction="0.6 0.01 0.001"/></default>
  <worldbody>
    <geom type="plane" size="2 2 1"/>
    <body pos="0 0 .19" euler="0 20 0"><freejoint/><geom type="box" size=".1 .2 .2"/>
      <body pos=".3 0 0"><joint name="j" axis="0 1 0" frictionloss=".2" limited="true" range="0.1 1"/>
        <geom type="capsule" size=".05 .1" pos=".1 0 0"/></body>
    </body>
    <body pos="1 0 .1"><joint name="ball" type="ball"/><geom type="cylinder" size=".1 .1" pos="0 0 -.05"/></body>
    <body pos="0 1 1"><joint name="x" type="slide"/><joint name="y" type="slide" axis="0 1 0"/><geom type="ellipsoid" size=".1 .1 .2"/></body>
  </worldbody>
  <actuator>
    <motor joint="j"/><position joint="x" kp="20" kv="2"/><position joint="j" kp="20"/>
  </actuator>
</mujoco>
"""


def scene(module, cone="elliptic", jacobian="dense"):
    model = module.MjModel.from_xml_string(SCENE.format(cone=cone, jacobian=jacobian))
    data = module.MjData(model)
    data.qvel[:] = np.linspace(-1, 1, model.nv)
    module.mj_forward(model, data)
    return model, data


def same(truth, call, rtol=1e-12, atol=1e-12):
    """What `call(module)` returns, an array or several, is the same of both modules."""
    theirs, ours = (np.concatenate([np.ravel(part) for part in call(module)]) for module in (truth, mj))
    assert theirs.size and np.isfinite(theirs.astype(float)).all()
    np.testing.assert_allclose(ours, theirs, rtol=rtol, atol=atol)


@pytest.mark.parametrize("seed", range(5))
def test_scalars(truth, seed):
    draws = np.random.default_rng(seed)
    prm = np.array([0.75, 1.05, -1 if seed % 2 else 30, 200, 0.5, 1.6, 1.5, 1.3, 1.2])
    lengths, speeds = draws.uniform(0.2, 1.9, 30), draws.uniform(-3, 3, 30)

    def muscles(module):
        for length, speed in zip(lengths, speeds, strict=True):
            yield module.mju_muscleGain(length, speed, [0.4, 1.3], 2.5, prm)
            yield module.mju_muscleBias(length, [0.4, 1.3], 2.5, prm)
            yield module.mju_muscleDynamics(speed, length - 0.5, [0.01, 0.04, 0.3 * (seed % 2)])

    same(truth, muscles)
    springs = [(1.0, 0.5, 4.0, 4.0, 0.3), (1.0, 0.5, 4.0, 9.0, 0.3), (-1.0, 0.5, 4.0, 0.2, 0.7), tuple(draws.uniform(0.1, 3, 5))]
    same(truth, lambda module: [module.mju_springDamper(*spring) for spring in springs])
    force, mu = draws.normal(size=4) + [9, 0, 0, 0], draws.uniform(0.1, 1, 3)

    def cones(module):
        pyramid, back = np.zeros(6), np.zeros(4)
        module.mju_encodePyramid(pyramid, force, mu)
        module.mju_decodePyramid(back, pyramid, mu)
        return pyramid, back

    same(truth, cones)
    matrix, weights = draws.normal(size=(5, 3)), draws.normal(size=5)

    def matrices(module):
        plain, weighted = np.zeros((3, 3)), np.zeros((3, 3))
        module.mju_sqrMatTD(plain, matrix, None)
        module.mju_sqrMatTD(weighted, matrix, weights.copy())
        quat = np.array([1.0, 0.1, 0.2, 0.3]) / np.linalg.norm([1.0, 0.1, 0.2, 0.3])
        turns = module.mju_mat2Rot(quat, matrix[:3].ravel())
        return plain, weighted, quat * np.sign(quat[0]), turns

    same(truth, matrices, rtol=1e-9, atol=1e-8)


@pytest.mark.parametrize("plus", [1, 0])
def test_factors_are_updated(truth, plus):
    draws = np.random.default_rng(1)
    root = draws.normal(size=(6, 6))
    full, step = root @ root.T + 6 * np.eye(6), draws.normal(size=6) * 0.5

    def update(module):
        factor, x = np.linalg.cholesky(full), step.copy()
        rank = module.mju_cholUpdate(factor, x, plus)
        return np.tril(factor), [rank]

    same(truth, update, rtol=1e-10, atol=1e-10)
    factor = update(mj)[0]
    np.testing.assert_allclose(factor @ factor.T, full + (1 if plus else -1) * np.outer(step, step), atol=1e-10)
    lost = np.eye(2)
    assert mj.mju_cholUpdate(lost, np.array([2.0, 0.0]), 0) == truth.mju_cholUpdate(np.eye(2), np.array([2.0, 0.0]), 0) == 1


def test_lists_are_sorted_and_numbers_printed(truth, capfd):
    numbers, whole = np.array([3.0, -1.0, 2.0]), np.array([3, -1, 2], np.int32)
    mj.mju_insertionSort(numbers)
    mj.mju_insertionSortInt(whole)
    assert numbers.tolist() == [-1, 2, 3] and whole.tolist() == [-1, 2, 3]
    sizes = (0, 5, 1023, 1024, 1025, 3 << 20, 1 << 31, 1500, 1 << 60)
    assert [mj.mju_writeNumBytes(n) for n in sizes] == [truth.mju_writeNumBytes(n) for n in sizes]
    draws = np.array([mj.mju_standardNormal(None) for _ in range(4000)])
    assert abs(draws.mean()) < 0.06 and abs(draws.std() - 1) < 0.06
    mj.mju_printMat(np.arange(4.0).reshape(2, 2))
    pattern = (np.array([1, 2], np.int32), np.array([0, 1], np.int32), np.array([1, 0, 1], np.int32))
    mj.mju_printMatSparse(np.arange(3.0), *pattern)
    out = capfd.readouterr().out
    assert "2.00000000 3.00000000" in out and "(1 0):  1.000000" in out


@pytest.mark.parametrize("jacobian", ["dense", "sparse"])
def test_the_inertia_matrix_by_its_factor(truth, jacobian):
    draws = np.random.default_rng(2)

    def products(module):
        model, data = scene(module, jacobian=jacobian)
        vec, res, x = np.linspace(-1, 2, model.nv), np.zeros(model.nv), np.zeros((2, model.nv))
        module.mj_mulM2(model, data, res, vec)
        rows = np.vstack([vec, vec[::-1]])
        scale = 1 / np.sqrt(data.qLD[model.M_rowadr + model.M_rownnz - 1])
        module.mj_solveM2(model, data, x, rows, scale.reshape(1, -1))
        return res, x

    same(truth, products, rtol=1e-9, atol=1e-9)
    model, data = scene(mj)
    vec, res, product = draws.normal(size=model.nv), np.zeros(model.nv), np.zeros(model.nv)
    mj.mj_mulM2(model, data, res, vec)
    mj.mj_mulM(model, data, product, vec)
    assert res @ res == pytest.approx(vec @ product)
    dense, sparse = np.ones((model.nv, model.nv)), data.M.copy()
    mj.mj_addM(model, data, dense)
    mj.mj_addM(model, data, sparse, model.M_rownnz, model.M_rowadr, model.M_colind)
    full = np.zeros((model.nv, model.nv))
    mj.mj_fullM(model, data, full)
    np.testing.assert_allclose(dense, 1 + np.tril(full))
    np.testing.assert_allclose(sparse, 2 * data.M)


@pytest.mark.parametrize("cone", ["elliptic", "pyramidal"])
def test_inverse_dynamics_in_parts(truth, cone):
    def parts(module):
        model, data = scene(module, cone)
        rows = []
        for residual in (np.linspace(-3, 0.5, data.nefc), np.linspace(0.5, -8, data.nefc)):
            cost = np.zeros(1)
            module.mj_constraintUpdate(model, data, residual, cost, 0)
            rows += [cost, data.efc_force.copy(), data.efc_state.copy(), data.qfrc_constraint.copy()]
        module.mj_invPosition(model, data)
        module.mj_invVelocity(model, data)
        module.mj_invConstraint(model, data)
        rows += [data.efc_force.copy(), data.qfrc_bias.copy()]
        for stage in (0, 1, 2):
            data.qacc[:] = np.linspace(-2, 2, model.nv)
            module.mj_inverseSkip(model, data, stage, 1)
            rows.append(data.qfrc_inverse.copy())
        return rows

    same(truth, parts, rtol=1e-8, atol=1e-7)


def test_elements_are_asked_about(truth):
    def answers(module):
        model, data = scene(module)
        data.ctrl[:] = 3
        module.mj_resetCtrl(model, data)
        pairs = [(a, b) for a in range(model.ngeom) for b in range(model.ngeom)]
        most = [module.mj_maxContact(model, a, b, margin) for a, b in pairs for margin in (-1, 0, 1)]
        return data.ctrl, most

    same(truth, answers)
    models = [scene(module)[0] for module in (truth, mj)]
    asked = [(i, k) for i in range(-1, 4) for k in range(-1, 3)]
    theirs, ours = ([module.mj_actuatorInputName(m, i, k) for i, k in asked] for module, m in zip((truth, mj), models, strict=True))
    assert ours == theirs


def test_a_contact_is_added(truth):
    def added(module):
        model, data = scene(module)
        module.mj_collision(model, data)
        contact = module.MjContact()
        first = data.contact[0]
        for name in ("dist", "pos", "frame", "friction", "solref", "solimp", "dim", "geom", "flex", "elem", "vert"):
            setattr(contact, name, getattr(first, name))
        contact.dist = -0.02
        before = data.ncon
        assert module.mj_addContact(model, data, contact) == 0 and data.ncon == before + 1
        module.mj_makeConstraint(model, data)
        return [data.nefc], data.efc_pos, data.contact.pos

    same(truth, added, rtol=1e-9, atol=1e-9)


def test_settings_go_back_to_their_defaults():
    model, data = scene(mj)
    model.opt.timestep, model.vis.map.znear = 0.5, 0.3
    model.vis.rgba.fog[:] = 0.5
    mj.mj_defaultOption(model.opt)
    mj.mj_defaultVisual(model.vis)
    assert model.opt == mj.MjOption() and model.opt.timestep == 0.002
    assert model.vis.map.znear == pytest.approx(0.01) and model.vis.rgba.fog[:3].tolist() == [0, 0, 0]
    lengths = mj.MjSpec().compiler.LRopt
    lengths.accel = 3
    mj.mj_defaultLROpt(lengths)
    assert lengths.accel == 20
    data.qpos[:] = 0.3
    mj.mj_resetDataDebug(model, data, 7)
    assert data.qpos.tolist() == model.qpos0.tolist()


def test_models_and_data_are_printed(tmp_path):
    model, data = scene(mj)
    path = tmp_path / "out.txt"
    mj.mj_printFormattedModel(model, str(path), "%.3f")
    text = path.read_text()
    assert "body_mass\n  0.000\n" in text and "opt.timestep" in text and f"nq {'':21} {model.nq}" in text
    mj.mj_printModel(model, str(path))
    assert "geom_size" in path.read_text()
    mj.mj_printFormattedData(model, data, str(path), "%.17g")
    lines = path.read_text().splitlines()
    at = lines.index("qvel")
    assert [float(x) for x in lines[at + 1 : at + 1 + model.nv]] == data.qvel.tolist()
    mj.mj_printData(model, data, str(path))
    scene_ = mj.MjvScene(model, 100)
    mj.mjv_updateScene(model, data, mj.MjvOption(), None, mj.MjvCamera(), mj.mjtCatBit.mjCAT_ALL, scene_)
    mj.mj_printScene(scene_, str(path))
    assert "geom[0].rgba" in path.read_text()
    with pytest.raises(ValueError, match="no format of one number"):
        mj.mj_printFormattedModel(model, str(path), "%d %d")
    with pytest.raises(OSError):
        mj.mj_printData(model, data, str(tmp_path / "none" / "out.txt"))
