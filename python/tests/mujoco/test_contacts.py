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
