"""Labels, frames, flags and pulled bodies of scenes, beside MuJoCo's own bindings."""

import numpy as np
import pytest
import robohive.mujoco as mj

TEXT = """<mujoco>
  <asset><mesh name="tet" vertex="0 0 0  1 0 0  0 1 0  0 0 1" scale=".2 .2 .2"/></asset>
  <visual><map force=".01"/></visual>
  <worldbody>
    <light name="lamp" pos="0 0 3"/>
    <camera name="front" pos="0 -2 1" xyaxes="1 0 0 0 0 1"/>
    <geom name="floor" type="plane" size="1 1 1"/>
    <body name="ball" pos="0 0 .1">
      <freejoint name="free"/>
      <geom name="shell" size=".1"/>
      <site name="top" pos="0 0 .1"/>
      <body name="arm" pos="0 0 .2">
        <joint name="hinge" axis="0 1 0" range="-90 90" limited="true"/>
        <geom name="rod" type="capsule" fromto="0 0 0 .2 0 0" size=".02"/>
        <geom name="stone" type="mesh" mesh="tet" pos=".3 0 .1"/>
        <site name="tip" pos=".2 0 0"/>
      </body>
    </body>
    <body name="box" pos="1 1 .1"><joint name="slide" type="slide" axis="0 0 1"/><geom type="box" size=".1 .1 .1"/><site name="eye" pos="0 0 -.2"/></body>
  </worldbody>
  <tendon><spatial name="rope"><site site="top"/><site site="tip"/></spatial></tendon>
  <equality><connect name="tie" body1="arm" body2="box" anchor=".2 0 0"/></equality>
  <actuator><motor name="motor" joint="hinge" gear="2"/><muscle name="pull" tendon="rope" lengthrange="0 1"/></actuator>
  <sensor><rangefinder site="eye"/></sensor>
</mujoco>"""

NAMES = [
    (kind, name)
    for kind in ("mjtLabel", "mjtFrame", "mjtVisFlag")
    for name in getattr(mj, kind).__members__
    if not name.startswith("mjN")
]


def simulation(module):
    """Something that fell on a floor and is pushed."""
    model = module.MjModel.from_xml_string(TEXT)
    data = module.MjData(model)
    module.mj_step(model, data, 30)
    data.xfrc_applied[1, :3] = [1, 2, 3]
    module.mj_forward(model, data)
    return model, data


def scene(module, model, data, option, hand):
    camera, out = module.MjvCamera(), module.MjvScene(model, 1000)
    module.mjv_defaultFreeCamera(model, camera)
    # The second update centres planes below the eye of the first, in MuJoCo.
    for _ in range(2):
        module.mjv_updateScene(model, data, option, hand, camera, 7, out)
    return out


def shown(module, option=None, pulled=None):
    """Geoms of a scene: what they belong to and their labels; their numbers. `pulled`: how body 2 is."""
    model, data = simulation(module)
    chosen, hand = module.MjvOption(), module.MjvPerturb()
    if option is not None:
        option(chosen)
    if pulled is not None:
        hand.select, hand.localpos[:] = 2, [0.1, 0.2, 0.3]
        module.mjv_initPerturb(model, data, scene(module, model, data, module.MjvOption(), None), hand)
        hand.active, hand.refselpos[:] = pulled, hand.refselpos + [0.1, 0.2, 0.3]
    out = scene(module, model, data, chosen, hand)
    geoms = out.geoms[: out.ngeom]
    whose = [(int(g.type), int(g.objtype), int(g.objid), int(g.category), int(g.segid), str(g.label)) for g in geoms]
    return whose, np.array([np.concatenate([np.ravel(part) for part in (g.pos, g.mat, g.size, g.rgba)]) for g in geoms])


def same(truth, option=None, pulled=None):
    theirs, ours = (shown(module, option, pulled) for module in (truth, mj))
    assert ours[0] == theirs[0]
    np.testing.assert_allclose(ours[1], theirs[1], atol=2e-5)


@pytest.mark.parametrize(("kind", "name"), NAMES)
def test_decorations_are_mujocos(truth, kind, name):
    def option(chosen):
        value = int(getattr(mj, kind).__members__[name])
        if kind == "mjtVisFlag":
            chosen.flags[value] = 1 - chosen.flags[value]
        else:
            setattr(chosen, {"mjtLabel": "label", "mjtFrame": "frame"}[kind], value)

    same(truth, option)


@pytest.mark.parametrize("label", ["mjLABEL_NONE", "mjLABEL_SELECTION", "mjLABEL_SELPNT"])
@pytest.mark.parametrize("pulled", range(4))
def test_pulled_bodies_are_mujocos(truth, label, pulled):
    def option(chosen):
        chosen.label = int(getattr(mj.mjtLabel, label))
        chosen.flags[int(mj.mjtVisFlag.mjVIS_SELECT)] = 1

    same(truth, option, pulled)


def test_what_there_is_not_is_named():
    model, data = simulation(mj)
    option, hand = mj.MjvOption(), mj.MjvPerturb()
    for field, last in (("label", 16), ("frame", 7)):
        for value in (-1, last + 1):
            setattr(option, field, value)
            with pytest.raises(ValueError, match=f"MjvOption.{field} is {value}, not one of 0 to {last}"):
                scene(mj, model, data, option, None)
        setattr(option, field, 0)
    hand.select = model.nbody
    with pytest.raises(ValueError, match="body 4 is out of range"):
        scene(mj, model, data, option, hand)


def test_labels_are_drawn():
    model, data = simulation(mj)
    option, pictures = mj.MjvOption(), []
    with mj.Renderer(model, 64, 64) as renderer:
        for label in (mj.mjtLabel.mjLABEL_NONE, mj.mjtLabel.mjLABEL_BODY):
            option.label = label
            renderer.update_scene(data, scene_option=option)
            pictures.append(renderer.render().astype(int))
    assert ((pictures[1] != pictures[0]).any(-1) & (pictures[1] == 255).all(-1)).sum() > 10
