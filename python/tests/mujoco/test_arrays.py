"""Arrays are views that calls keep up to date, and that calls read."""

import copy
import pickle

import numpy as np
import pytest
import robohive.mujoco as mj


def test_an_array_keeps_its_identity_and_shows_the_next_state(model, data):
    qpos = data.qpos
    before = qpos.copy()
    mj.mj_step(model, data, 5)
    assert data.qpos is qpos and not np.array_equal(qpos, before)
    assert data.time == pytest.approx(5 * model.opt.timestep)


def test_what_is_written_takes_effect_in_the_next_call(model, data):
    data.qvel[:] = 1.0
    data.qpos = [0, 0, 2, 1, 0, 0, 0, 0.25]
    data.joint("hinge").qvel[0] = -1.0
    mj.mj_forward(model, data)
    assert data.sensor("angle").data[0] == 0.25
    assert data.body("ball").xpos[2] == 2.0
    assert data.qvel[6] == -1.0


def test_writes_into_a_model_take_effect_and_derive_nothing(model, data):
    mj.mj_forward(model, data)
    weight = data.qfrc_bias[2]
    subtree = model.body_subtreemass[1]
    model.body("ball").mass *= 2
    model.opt.gravity[:] = [0, 0, -1]
    mj.mj_forward(model, data)
    assert data.qfrc_bias[2] < weight / 4
    assert model.body_subtreemass[1] == subtree
    mj.mj_setConst(model, data)
    assert model.body_subtreemass[1] > subtree


def test_options_are_read_and_written_at_once(model, data):
    model.opt.timestep = 0.01
    mj.mj_step(model, data)
    assert data.time == 0.01 and model.opt.timestep == 0.01
    model.opt.disableflags |= mj.mjtDisableBit.mjDSBL_GRAVITY
    assert model.opt.disableflags == mj.mjtDisableBit.mjDSBL_GRAVITY
    with pytest.raises(ValueError, match="no value of opt.integrator"):
        model.opt.integrator = 77
    with pytest.raises(AttributeError, match="timestap"):
        model.opt.timestap = 1.0


def test_numbers_that_do_not_fit_name_array_and_place(model, data):
    model.body_mass[1] = np.nan
    with pytest.raises(ValueError, match=r"body_mass\[1\] to NaN"):
        mj.mj_step(model, data)
    model.body_mass[1] = 1.0
    mj.mj_step(model, data)


def test_shapes_and_names_that_do_not_fit_are_refused(model, data):
    with pytest.raises(ValueError, match="could not broadcast"):
        data.qpos = [1.0, 2.0]
    with pytest.raises(AttributeError, match="no attribute 'qqpos'"):
        data.qqpos = 1.0
    with pytest.raises(AttributeError, match="cannot be set"):
        model.nq = 3
    with pytest.raises(AttributeError, match="no attribute 'body_weight'"):
        model.body_weight  # noqa: B018
    with pytest.raises(AttributeError, match="no attribute 'flg_weight'"):
        model.flg_weight = True
    with pytest.raises(AttributeError, match="_state"):
        model.body(0)._state  # noqa: B018
    with pytest.raises(ValueError, match="read-only"):
        model.M_rownnz[0] = 1


def test_copies_go_their_own_way(model, data):
    mj.mj_step(model, data, 10)
    twin, far = copy.copy(data), copy.deepcopy(data)
    again = pickle.loads(pickle.dumps(data))
    assert twin.model is model and far.model is not model
    mj.mj_step(model, data)
    for other in (twin, far, again):
        assert other.time < data.time
        mj.mj_step(other.model, other)
        assert np.array_equal(other.qpos, data.qpos) and np.array_equal(other.qacc, data.qacc)
    heavy = copy.copy(model)
    heavy.body_mass[1] = 7.0
    assert model.body_mass[1] != 7.0
    assert pickle.loads(pickle.dumps(heavy)).body_mass[1] == 7.0


def test_states_as_vectors(model, data):
    everything = mj.mjtState.mjSTATE_INTEGRATION
    state = np.zeros(mj.mj_stateSize(model, everything))
    data.ctrl[0] = 0.7
    mj.mj_step(model, data, 3)
    mj.mj_getState(model, data, state, everything)
    mj.mj_step(model, data)
    after = data.qpos.copy()
    mj.mj_resetData(model, data)
    assert data.ctrl[0] == 0.0 and data.time == 0.0
    mj.mj_setState(model, data, state, everything)
    mj.mj_step(model, data)
    assert np.array_equal(data.qpos, after)
    with pytest.raises(mj.FatalError, match="invalid state signature"):
        mj.mj_stateSize(model, 1 << 20)
    with pytest.raises(TypeError, match="state"):
        mj.mj_setState(model, data, state[:-1], everything)


def test_keyframes(model, data):
    mj.mj_resetDataKeyframe(model, data, 0)
    assert data.qpos[2] == 1.0 and data.ctrl[0] == 0.1
    assert np.array_equal(model.key("high").qpos, data.qpos)
    data.qpos[2] = 3.0
    mj.mj_setKeyframe(model, data, 0)
    mj.mj_resetDataKeyframe(model, data, 0)
    assert data.qpos[2] == 3.0


def test_contacts_show_the_last_collisions(model, data):
    mj.mj_step(model, data)
    assert data.ncon == len(data.contact) == 0
    data.qpos[2] = 0.09
    mj.mj_forward(model, data)
    assert data.ncon == 1
    contact = data.contact[0]
    names = [mj.mj_id2name(model, mj.mjtObj.mjOBJ_GEOM, g) for g in (contact.geom1, contact.geom2)]
    assert names == ["floor", "shell"] and contact.dist == pytest.approx(-0.01)
    assert data.contact.dist.shape == (1,) and data.efc_J.shape == (data.nefc * model.nv,)
    force = np.zeros(6)
    mj.mj_contactForce(model, data, 0, force)
    assert force[0] > 0
    with pytest.raises(ValueError, match="no contact 5"):
        mj.mj_contactForce(model, data, 5, force)


CUSHION = """
<mujoco>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 .1"/>
    <body name="cushion" pos="0 0 .045">
      <flexcomp name="cushion" type="grid" count="3 3 3" spacing=".05 .05 .05" radius=".01" dim="3" mass=".2">
        <contact selfcollide="none" internal="false"/><edge equality="true"/>
      </flexcomp>
    </body>
    <body pos="0 0 .5"><freejoint/><geom size=".02"/></body>
  </worldbody>
</mujoco>
"""


def test_contacts_of_flexes_name_flex_element_and_vertex():
    model = mj.MjModel.from_xml_string(CUSHION)
    data = mj.MjData(model)
    data.qpos[-5] = 0.112
    mj.mj_forward(model, data)
    contact = data.contact
    ball, floor = 1, 0
    assert set(contact.geom[:, 0].tolist()) <= {floor, ball} and (contact.geom[:, 1] == -1).all()
    assert (contact.flex == [-1, 0]).all() and len(contact) > 9
    vertices, elements = contact.vert[:, 1], contact.elem[:, 1]
    # A partner of a geom is a vertex or an element of the flex.
    assert ((vertices >= 0) != (elements >= 0)).all()
    assert vertices[contact.geom[:, 0] == floor].tolist() == list(range(0, 27, 3))
    assert elements[contact.geom[:, 0] == ball].tolist() == [11, 22, 23, 31, 33, 34, 35, 46]
    one = contact[0]
    assert one.flex.tolist() == [-1, 0] and one.geom2 == -1 and one.vert[0] == -1
