"""Descriptions with flexes, skins and plugins, and which settings their texts give."""

import numpy as np
import pytest
import robohive.mujoco as mj

CABLES = """
<mujoco>
  <extension><plugin plugin="mujoco.elasticity.cable">
    <instance name="soft"><config key="twist" value="1e4"/><config key="bend" value="1e3"/></instance>
    <instance name="spare"/>
  </plugin></extension>
  <worldbody>
    <body name="first"><joint/><geom size=".1"/><plugin instance="soft"/></body>
    <body name="second"><joint/><geom size=".1"/>
      <plugin plugin="mujoco.elasticity.cable"><config key="bend" value="7"/></plugin>
    </body>
  </worldbody>
</mujoco>
"""

CLOTH = """
<mujoco>
  <worldbody>
    <body name="frame" pos="0 0 1">
      <flexcomp name="cloth" type="grid" count="4 3 1" spacing=".1 .1 .1" radius=".01" dim="2" mass=".3">
        <edge equality="true"/><pin id="0 3"/>
      </flexcomp>
    </body>
  </worldbody>
</mujoco>
"""


def instances(spec):
    return [(plugin.name, plugin.plugin_name, plugin.config) for plugin in spec.plugins]


def settings(model):
    return bytes(np.asarray(model.plugin_attr).astype(np.uint8)).decode().split("\0")


def test_plugins_are_read_compiled_copied_and_written():
    spec = mj.MjSpec.from_string(CABLES)
    cable = "mujoco.elasticity.cable"
    soft = {"twist": "1e4", "bend": "1e3"}
    assert instances(spec) == [("soft", cable, soft), ("spare", cable, {}), ("", "", {"bend": "7"})]
    first, second = spec.body("first").plugin, spec.body("second").plugin
    assert first.active and first.name == "soft" and first.config == soft and second.plugin_name == cable
    assert not spec.worldbody.plugin.active and spec.plugin("soft") is spec.plugins[0]
    for one in (spec, spec.copy(), mj.MjSpec.from_string(spec.to_xml())):
        model = one.compile()
        assert model.nplugin == 3 and model.body_plugin.tolist() == [-1, 0, 2]
    spec.plugins[0].config = {"bend": "5"}
    assert first.config == {"bend": "5"} and "5" in settings(spec.compile())
    spec.plugins[0].config = {"wrong": "5"}
    with pytest.raises(ValueError, match="no attribute 'wrong'"):
        spec.compile()


def test_plugins_are_added_and_taken_away():
    spec = mj.MjSpec()
    spec.activate_plugin("mujoco.elasticity.cable")
    plugin = spec.add_plugin(name="stiff", plugin_name="mujoco.elasticity.cable", active=True, info="made here")
    plugin.config = {"twist": "10", "bend": "1"}
    body = spec.worldbody.add_body(plugin=plugin)
    body.add_joint()
    body.add_geom(size=[0.1, 0, 0])
    assert body.plugin is not plugin and body.plugin.name == "stiff" and body.plugin.id == 0
    model = spec.compile()
    assert (model.nplugin, model.body_plugin[1], settings(model)[:2]) == (1, 0, ["10", "1"])
    body.plugin.active = False
    assert spec.compile().body_plugin[1] == -1
    spec.delete(plugin)
    assert spec.compile().nplugin == 0
    with pytest.raises(AttributeError):
        body.plugin.colour = 1
    other = spec.worldbody.add_body(name="other")
    other.plugin.active = True
    with pytest.raises(ValueError, match="plugin_name"):
        spec.compile()


def test_instances_come_with_what_uses_them():
    parent = mj.MjSpec()
    parent.attach(mj.MjSpec.from_string(CABLES), frame=parent.worldbody.add_frame(), prefix="one-")
    frame = parent.worldbody.add_frame(pos=[1, 0, 0])
    frame.attach_body(mj.MjSpec.from_string(CABLES).body("first"), prefix="two-")
    assert [plugin.name for plugin in parent.plugins] == ["one-soft", "", "two-soft"]
    model = parent.compile()
    assert model.nplugin == 3 and model.body_plugin.tolist() == [-1, 0, 2, 1]


def test_flexes_keep_what_their_text_says():
    spec = mj.MjSpec.from_string(CLOTH)
    flex = spec.flex("cloth")
    assert flex is spec.flexes[0] and len(flex.vertbody) == 12 and flex.dim == 2 and flex.radius == 0.01
    truth = mj.MjModel.from_xml_string(CLOTH)
    for one in (spec, spec.copy(), mj.MjSpec.from_string(spec.to_xml())):
        model = one.compile()
        for name in ("flex_vert0", "flex_elem", "flex_vertbodyid", "flexedge_length0", "eq_type", "body_mass"):
            np.testing.assert_array_equal(getattr(model, name), getattr(truth, name), err_msg=name)
    flex.friction[0] = 0.3
    flex.selfcollide = mj.mjtFlexSelf.mjFLEXSELF_NONE
    model = spec.compile()
    assert model.flex_friction[0, 0] == 0.3 and model.flex_selfcollide[0] == 0
    spec.delete(spec.body("frame"))
    assert not spec.flexes and not spec.equalities and spec.compile().nflex == 0


def test_a_flex_is_added_between_bodies():
    spec = mj.MjSpec()
    for k, pos in enumerate(([0, 0, 0], [1, 0, 0], [0, 1, 0])):
        body = spec.worldbody.add_body(name=f"corner{k}", pos=pos)
        body.add_joint(type=mj.mjtJoint.mjJNT_SLIDE)
        body.mass, body.inertia, body.ipos = 1, [1, 1, 1], [0, 0, 0]
    flex = spec.add_flex(name="sheet", dim=2, young=10, thickness=0.01, elastic2d=2, vertbody=[f"corner{k}" for k in range(3)], elem=[0, 1, 2], rgba=[1, 0, 0, 1])
    model = spec.compile()
    assert (model.nflex, model.nflexvert, model.nflexedge) == (1, 3, 3) and flex.id == 0
    assert sorted(model.flexedge_length0.tolist()) == pytest.approx([1, 1, 2**0.5])
    flex.vertbody[2] = "nowhere"
    with pytest.raises(ValueError, match="nowhere"):
        spec.compile()


def test_make_flex_makes_what_flexcomp_does():
    spec = mj.MjSpec()
    body = spec.worldbody.add_body(name="frame", pos=[0, 0, 1])
    flex = body.make_flex("cloth", dim=2, count=[4, 3, 1], spacing=[0.1, 0.1, 0.1], radius=0.01, mass=0.3, equality=1)
    text = CLOTH.replace('<pin id="0 3"/>', "")
    ours, truth = spec.compile(), mj.MjModel.from_xml_string(text)
    for name in ("flex_vert0", "flex_elem", "flex_vertbodyid", "body_mass", "body_pos", "eq_type", "jnt_axis"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(truth, name), err_msg=name)
    assert flex is spec.flexes[0] and flex.name == "cloth" and len(spec.bodies) == 14
    with pytest.raises(ValueError, match="repeated name"):
        body.make_flex("cloth", dim=2, count=[4, 3, 1], spacing=[0.1, 0.1, 0.1])
    with pytest.raises(ValueError, match="count must have 3"):
        body.make_flex("other", count=[4, 3])
    with pytest.raises(ValueError, match="equality is one of"):
        body.make_flex("other", equality=9)
    assert len(spec.bodies) == 14 and len(spec.flexes) == 1


def test_skins_have_their_bones():
    spec = mj.MjSpec()
    for name in ("left", "right"):
        body = spec.worldbody.add_body(name=name)
        body.add_joint()
        body.add_geom(size=[0.1, 0, 0])
    skin = spec.add_skin(
        name="hide",
        vert=[0, 0, 0, 1, 0, 0, 0, 1, 0],
        face=[0, 1, 2],
        bodyname=["left", "right"],
        bindpos=[0] * 6,
        bindquat=[1, 0, 0, 0] * 2,
        vertid=[[0, 1], [2]],
        vertweight=[[1, 1], [1]],
    )
    skin.inflate = 0.5
    assert [row.tolist() for row in skin.vertid] == [[0, 1], [2]]
    for one in (spec, spec.copy(), mj.MjSpec.from_string(spec.to_xml())):
        model = one.compile()
        assert (model.nskin, model.nskinvert, model.nskinbone) == (1, 3, 2) and model.skin_inflate[0] == 0.5
        assert model.skin_bonebodyid.tolist() == [1, 2] and model.skin_bonevertid.tolist() == [0, 1, 2]
    skin.bindpos = [0] * 3
    with pytest.raises(ValueError, match="as many"):
        spec.compile()


def test_a_description_knows_what_its_text_gives():
    text = "<mujoco><compiler boundmass='1'/><option timestep='.002' cone='elliptic' actuatorgroupdisable='3'><flag energy='enable'"
    text += " contact='enable'/></option><visual><global fovy='60'/><rgba bv='1 0 0 1'/></visual><worldbody/></mujoco>"
    spec = mj.MjSpec.from_string(text)
    given = spec.authored
    assert (given.option, given.visual_global, given.visual_rgba) == (1 | 1 << 17, 1 << 2, 1 << 23)
    assert (given.disableflags, given.enableflags) == (mj.mjtDisableBit.mjDSBL_CONTACT, mj.mjtEnableBit.mjENBL_ENERGY)
    assert (given.disableactuator, given.visual_map, spec.compiler.authored) == (8, 0, 2)
    assert spec.copy().authored.option == given.option and mj.MjSpec().authored.option == 0


def test_a_default_that_a_text_gives_is_not_overruled():
    texts = ("<mujoco><option timestep='.002'/></mujoco>", "<mujoco/>")
    steps = []
    for text in texts:
        parent, child = mj.MjSpec.from_string(text), mj.MjSpec.from_string("<mujoco><option timestep='.005'/></mujoco>")
        parent.compiler.conflict = mj.mjtConflict.mjCONFLICT_MERGE
        with pytest.warns(UserWarning, match="timestep"):
            parent.attach(child, frame=parent.worldbody.add_frame())
        steps.append(parent.option.timestep)
    assert steps == [0.002, 0.005]
