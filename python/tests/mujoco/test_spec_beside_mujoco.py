"""Scripts that edit descriptions give the same models with MuJoCo's bindings and with the stand-in."""

import numpy as np
import pytest
import robohive.mujoco as mj
from spec_scripts import SCRIPTS, two_legs

#: What is compared in another way, or differs by representation: names and paths, and MuJoCo's own bookkeeping.
SKIPPED = ("names", "paths", "names_map", "text_data", "signature", "oct_", "bvh_", "narena", "nbuffer", "B_", "D_", "M_", "map")


def names(module, model):
    kinds = {"body": "nbody", "jnt": "njnt", "geom": "ngeom", "site": "nsite", "actuator": "nactuator", "sensor": "nsensor"}
    kinds |= {"key": "nkey", "tendon": "ntendon", "mat": "nmat", "mesh": "nmesh", "eq": "neq", "tuple": "ntuple"}
    return {kind: [getattr(model, kind)(i).name for i in range(getattr(model, size))] for kind, size in kinds.items()}


def same(ours, theirs):
    compared = 0
    for name in sorted(ours._shapes):
        expected = getattr(theirs, name, None)
        if name.startswith(SKIPPED) or not isinstance(expected, np.ndarray):
            continue
        np.testing.assert_array_equal(np.asarray(getattr(ours, name)), expected, err_msg=name)
        compared += 1
    assert compared > 300


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.__name__)
def test_models_are_mujocos(truth, script):
    ours, theirs = script(mj).compile(), script(truth).compile()
    assert names(mj, ours) == names(truth, theirs)
    same(ours, theirs)
    for group in ("opt", "stat"):
        for field in getattr(ours, group)._fields:
            np.testing.assert_array_equal(getattr(getattr(ours, group), field), getattr(getattr(theirs, group), field), field)


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.__name__)
def test_ids_and_written_text_agree_with_the_model(script):
    spec = script(mj)
    model = spec.compile()
    for body in spec.bodies:
        assert model.body(body.id).name == body.name
        np.testing.assert_array_equal(model.bind(body).mass, model.body_mass[body.id])
    for actuator in spec.actuators:
        assert model.actuator(actuator.id).name == actuator.name
    again = mj.MjSpec.from_string(spec.to_xml(), assets=spec.assets).compile()
    same_sizes = [again._size_values[size] == model._size_values[size] for size in ("nbody", "nq", "ngeom", "nsensor", "nkey")]
    assert all(same_sizes)
    np.testing.assert_array_equal(again.body_mass, model.body_mass)
    np.testing.assert_array_equal(again.qpos0, model.qpos0)


def test_the_state_is_carried_as_mujoco_carries_it(truth):
    def run(module):
        spec = two_legs(module)
        model = spec.compile()
        data = module.MjData(model)
        data.ctrl[:] = 0.1
        module.mj_step(model, data, 20)
        hand = spec.body("right/shin").add_body(name="hand", pos=[0, 0, -0.4])
        hand.add_joint(name="wrist", axis=[1, 0, 0])
        hand.add_geom(size=[0.02, 0, 0])
        spec.delete(spec.body("left/shin"))
        model, data = spec.recompile(model, data)
        return spec, model, data

    ours, theirs = run(mj), run(truth)
    for name in ("qpos", "qvel", "act", "ctrl", "time"):
        np.testing.assert_array_equal(getattr(ours[2], name), getattr(theirs[2], name), err_msg=name)
    mj.mj_step(ours[1], ours[2], 20)
    truth.mj_step(theirs[1], theirs[2], 20)
    np.testing.assert_allclose(ours[2].qpos, theirs[2].qpos, rtol=0, atol=1e-12)
