"""Enumerations, constants and attributes beside MuJoCo's own bindings, where these are installed."""

import sys

import numpy as np
import pytest
import robohive.mujoco as mj
from scenes import ARM

#: Fields of MuJoCo's own solver and memory that nothing here corresponds to.
INTERNAL = ("efc_AR", "efc_Y", "efc_J_rowsuper", "efm", "iefc", "iacc", "ifrc", "nA", "nY", "nefm", "flg_", "_")
#: What MuJoCo leaves as the memory was where the Jacobian is dense, as in this model.
UNWRITTEN = ("efc_J_colind", "efc_J_rowadr", "efc_J_rownnz")


def test_enumerations_have_mujocos_numbers(truth):
    kinds = [name for name in dir(truth) if hasattr(getattr(truth, name), "__members__")]
    assert len(kinds) > 70
    for kind in kinds:
        theirs = {name: int(value.value) for name, value in getattr(truth, kind).__members__.items()}
        ours = {name: int(value) for name, value in getattr(mj, kind).__members__.items()}
        assert ours == theirs, kind


def test_constants_are_mujocos(truth):
    for name in dir(truth):
        value = getattr(truth, name)
        if name.startswith("mj") and isinstance(value, int | float | tuple) and not isinstance(value, type):
            assert getattr(mj, name) == value, name


def test_every_function_and_class_is_there_or_says_that_it_is_not(truth):
    for name in dir(truth):
        if name.startswith(("mj", "Mj", "set_mj", "get_mj")) and name != "MjStruct":
            assert hasattr(mj, name), name
    for name in mj.MISSING:
        assert hasattr(truth, name), name


def test_arrays_have_mujocos_shapes_types_and_numbers(truth):
    theirs, ours = truth.MjModel.from_xml_string(ARM), mj.MjModel.from_xml_string(ARM)
    their_data, our_data = truth.MjData(theirs), mj.MjData(ours)
    for module, model, data in ((truth, theirs, their_data), (mj, ours, our_data)):
        data.qpos[2] = 0.09
        for _ in range(3):
            module.mj_step(model, data)
    compared = sum(_same(*pair) for pair in ((theirs, ours), (their_data, our_data)))
    assert compared > 500


def _same(theirs, ours):
    """Number of arrays that were compared."""
    count = 0
    for name in dir(theirs):
        value = None if name.startswith(INTERNAL) else getattr(theirs, name)
        if isinstance(value, np.ndarray):
            own = getattr(ours, name)
            assert (own.shape, own.dtype) == (value.shape, value.dtype), name
            assert name in UNWRITTEN or np.allclose(own, value, rtol=1e-9, atol=1e-12), name
            count += 1
    return count


def test_elements_have_mujocos_views(truth):
    theirs, ours = truth.MjModel.from_xml_string(ARM), mj.MjModel.from_xml_string(ARM)
    pairs = [(theirs, ours), (truth.MjData(theirs), mj.MjData(ours))]
    for kind in ("body", "joint", "geom", "site", "camera", "light", "actuator", "sensor", "key"):
        for their_owner, our_owner in pairs:
            if not hasattr(their_owner, kind):
                continue
            one, other = getattr(their_owner, kind)(0), getattr(our_owner, kind)(0)
            for name in dir(one):
                value = getattr(one, name)
                # MuJoCo reads its sparse moments as dense ones.
                if isinstance(value, np.ndarray) and name not in ("moment", "bodyid"):
                    assert np.shape(getattr(other, name)) == value.shape, (kind, name)
                    assert np.allclose(getattr(other, name), value, atol=1e-12), (kind, name)


def test_install_puts_the_module_where_mujoco_is_looked_for(monkeypatch):
    monkeypatch.delitem(sys.modules, "mujoco", raising=False)
    for name in ("_enums", "_functions", "_structs", "_errors", "_constants", "rollout"):
        monkeypatch.delitem(sys.modules, f"mujoco.{name}", raising=False)
    mj.install()
    import mujoco
    from mujoco import rollout
    from mujoco._enums import mjtGeom

    assert mujoco is mj and mjtGeom is mj.mjtGeom and rollout.rollout is mj.rollout.rollout
    mj.install()
    monkeypatch.setitem(sys.modules, "mujoco", object())
    with pytest.raises(ImportError, match="imported already"):
        mj.install()


#: What programs write with a member `e` (1) of an enumeration, and one of another, `f` (1).
COMPARISONS = (
    "e == 1",
    "1 == e",
    "e != 1",
    "e == True",
    "e == 1.0",
    "e != 1.0",
    "e == np.int32(1)",
    "e != np.int32(1)",
    "np.int32(1) == e",
    "np.int32(2) != e",
    "np.array([1, 2]) == e",
    "e == np.array([1, 2])",
    "e == f",
    "e != f",
    "f == e",
    "e == type(e)(1)",
    "e == None",
    "e != 'x'",
    "e in (np.int32(1),)",
    "np.int32(1) in (e,)",
    "1 in (e,)",
    "{e: 1}.get(1)",
    "{1: 1}.get(e)",
    "{e: 1}.get(np.int32(1))",
    "hash(e) == hash(1)",
    "str(e)",
    "repr(e)",
    "f'{e}'",
    "int(e) + e",
    "np.arange(3)[e]",
)


@pytest.mark.parametrize("expression", COMPARISONS)
def test_members_compare_as_mujocos(truth, expression):
    def value(module):
        return eval(expression, {"np": np, "e": module.mjtObj.mjOBJ_BODY, "f": module.mjtJoint.mjJNT_BALL})

    assert np.array_equal(value(mj), value(truth))
