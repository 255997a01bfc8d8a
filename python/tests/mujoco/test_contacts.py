"""Contacts and constraint rows: what is read is the present, what is written counts."""

import copy
import pickle

import numpy as np
import pytest
import robohive.mujoco as mj

BALLS = """
<mujoco>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 .1"/>
    <body pos="0 0 .049"><freejoint/><geom name="a" size=".05"/></body>
    <body pos=".5 0 .5"><freejoint/><geom name="b" size=".05"/></body>
  </worldbody>
</mujoco>
"""


@pytest.fixture
def scene():
    model = mj.MjModel.from_xml_string(BALLS)
    data = mj.MjData(model)
    mj.mj_forward(model, data)
    return model, data


def test_a_list_taken_before_is_live(scene):
    model, data = scene
    contacts, first = data.contact, data.contact[0]
    assert len(contacts) == 1 and contacts.geom.tolist() == [[0, 1]]
    data.qpos[9] = 0.049
    mj.mj_forward(model, data)
    assert len(contacts) == 2 and [c.geom2 for c in contacts] == [1, 2]
    assert first.dist == contacts[0].dist == pytest.approx(-0.001)
    assert [c.geom2 for c in contacts[1:]] == [2] and contacts[-1].geom1 == 0
    data.qpos[[2, 9]] = 1
    mj.mj_forward(model, data)
    assert len(contacts) == 0
    with pytest.raises(IndexError, match="is gone"):
        first.dist


@pytest.mark.parametrize(("before", "after", "passes"), [(2, 1, 1), (1, 2, 2)])
def test_a_list_may_change_while_it_is_gone_through(truth, before, after, passes):
    for module in (truth, mj):
        model = module.MjModel.from_xml_string(BALLS)
        data = module.MjData(model)

        def touch(count, model=model, data=data, module=module):
            data.qpos[9] = 0.049 if count == 2 else 0.5
            module.mj_forward(model, data)

        touch(before)
        seen = []
        for contact in data.contact:
            seen.append(contact.geom2)
            touch(after)
        assert len(seen) == passes, module.__name__


def test_what_is_written_into_a_contact_reaches_the_engine(scene):
    model, data = scene
    data.contact[0].friction[0] = 0.25
    data.contact.solref = [0.05, 1.0]
    assert data.contact[0].friction[0] == 0.25 and data.contact.solref.tolist() == [[0.05, 1.0]]
    mj.mj_makeConstraint(model, data)
    soft = data.efc_KBIP[0].copy()
    mj.mj_forward(model, data)
    assert data.contact[0].friction[0] == 1.0, "found again by collision detection"
    assert not np.array_equal(data.efc_KBIP[0], soft)


def test_what_is_written_into_rows_reaches_the_engine(scene):
    model, data = scene
    rows = data.efc_aref
    assert len(rows) == data.nefc == 4 and rows is data.efc_aref
    mj.mj_fwdConstraint(model, data)
    before = data.qacc[2].copy()
    data.efc_aref[:] += 5.0
    mj.mj_fwdConstraint(model, data)
    assert data.qacc[2] > before + 1


def test_copies_stand_alone(scene):
    _, data = scene
    kept = copy.copy(data.contact[0])
    again = pickle.loads(pickle.dumps(data.contact[0]))
    data.contact[0].pos[:] = 7
    assert kept == again and kept.pos[2] != 7 and data.contact[0].pos.tolist() == [7, 7, 7]
    assert isinstance(data.contact[0], mj.MjContact) and kept != data.contact[0]


def test_forces_before_any_was_computed_are_zero():
    model = mj.MjModel.from_xml_string(BALLS)
    data, force = mj.MjData(model), np.ones(6)
    mj.mj_fwdPosition(model, data)
    mj.mj_contactForce(model, data, 0, force)
    assert force.tolist() == [0.0] * 6


@pytest.mark.parametrize("jacobian", ["dense", "sparse"])
def test_what_is_written_into_the_jacobian_reaches_the_engine(truth, jacobian):
    text = BALLS.replace("<worldbody>", f'<option jacobian="{jacobian}" cone="pyramidal"><flag island="disable"/></option><worldbody>')
    ends = []
    for module in (truth, mj):
        model = module.MjModel.from_xml_string(text)
        data = module.MjData(model)
        data.qvel[:] = np.linspace(-0.1, 0.1, model.nv)
        module.mj_forward(model, data)
        rows = data.efc_J
        rows *= np.linspace(0.5, 2, len(rows))
        if jacobian == "dense":
            rows[-1] = 0.3  # A degree of freedom that the contact did not move.
        assert data.efc_J[0] == rows[0]
        module.mj_fwdConstraint(model, data)
        ends.append((data.efc_J.copy(), data.qacc.copy(), data.efc_force.copy()))
    assert len(ends[0][0]) > 10
    for ours, theirs in zip(ends[1], ends[0], strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=1e-6, atol=1e-9)


def test_pickles_and_copies_keep_what_was_counted(scene):
    model, data = scene
    mj.mj_step(model, data, 3)
    data.warning[mj.mjtWarning.mjWARN_BADCTRL].number = 2
    assert data.solver_niter[0] > 0 and data.timer.number[0] == 3
    for other in (copy.copy(data), copy.deepcopy(data), pickle.loads(pickle.dumps(data))):
        assert other.solver == data.solver and other.solver_niter.tolist() == data.solver_niter.tolist()
        assert other.timer == data.timer and other.warning == data.warning
        assert other.solver_nnz.tolist() == data.solver_nnz.tolist()


def test_room_for_rows_is_filled_by_programs(scene):
    model, data = scene
    forces, jacobian = data.efc_force.copy(), data.efc_J.copy()
    rows = {name: getattr(data, name).copy() for name in ("efc_D", "efc_aref", "efc_type", "efc_state", "efc_id")}
    acceleration = data.qacc.copy()
    mj._functions._realloc_con_efc(data, ncon=1, nefc=len(forces), nJ=len(jacobian))
    assert data.ncon == len(data.contact) == 1 and data.efc_force.tolist() == [0] * len(forces) and not data.efc_J.any()
    data.efc_force[:], data.efc_J[:] = forces, jacobian
    for name, values in rows.items():
        getattr(data, name)[:] = values
    out = np.zeros(model.nv)
    mj.mj_mulJacTVec(model, data, out, forces)
    np.testing.assert_allclose(out, jacobian.reshape(len(forces), -1).T @ forces)
    mj.mj_forward(model, data)
    np.testing.assert_array_equal(data.qacc, acceleration)
    mj._functions._realloc_con_efc(data, 13, 17, 21)
    assert data.efc_J.shape == (21,) and data.efc_KBIP.shape == (17, 4) and len(data.contact) == 13
    mj._functions._realloc_island(data, nisland=2, nidof=4)
    assert (data.nisland, data.nidof, data.island_nv.shape) == (2, 4, (2,))
    with pytest.raises(mj.FatalError, match="more than the budget"):
        mj._functions._realloc_con_efc(data, 100000000, 100000000)
    with pytest.raises(mj.FatalError, match="the model has 2 trees"):
        mj._functions._realloc_island(data, 3, 0)
    assert len(data.contact) == len(data.efc_id) == data.nisland == 0


def test_numbers_of_memory_are_kept_and_do_nothing(scene):
    model, data = scene
    data.pstack = 5
    mj.mj_forward(model, data)
    assert data.pstack == 5 and data.parena == 0
    with pytest.raises(AttributeError):
        data.ncollision = 3
