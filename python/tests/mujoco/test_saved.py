"""Models that a program changed, written by `mj_saveLastXML`, beside MuJoCo's own bindings."""

import numpy as np
import pytest
import robohive.mujoco as mj

TEXT = """<mujoco>
  <compiler angle="degree"/>
  <size nuser_body="1" nuser_geom="2" nuser_jnt="1"/>
  <default><default class="soft"><joint damping="1"/></default></default>
  <asset>
    <material name="m" rgba="1 1 0 1"/>
    <mesh name="tetrahedron" vertex="0 0 0  1 0 0  0 1 0  0 0 1"/>
  </asset>
  <worldbody>
    <light name="lamp" pos="0 0 3"/>
    <camera name="eye" pos="0 0 2" euler="10 0 0"/>
    <geom name="floor" type="plane" size="1 1 1" material="m"/>
    <frame pos="0 0 1" euler="0 0 90">
      <body name="a" pos="1 0 0" childclass="soft">
        <joint name="j1" axis="0 1 0" range="-90 90" ref="10" springref="20" stiffness="2"/>
        <geom name="rod" type="capsule" size=".1" fromto="0 0 0 0 0 .5"/>
        <frame pos=".1 0 0" euler="30 0 0"><site name="s" pos="0 0 .5" size=".02"/></frame>
        <body name="b" pos="0 0 .5" euler="0 30 0">
          <inertial pos="0 0 .1" mass="2" diaginertia=".1 .2 .25"/>
          <joint name="j2" type="slide" axis="0 0 1" range="0 1" armature=".1"/>
          <geom name="stone" type="mesh" mesh="tetrahedron" pos=".1 .2 .3" euler="20 0 0"/>
        </body>
      </body>
    </frame>
    <body name="f" pos="0 0 3"><freejoint name="free"/><geom name="shell" size=".1"/></body>
    <body name="hand" mocap="true" pos="0 0 5"/>
  </worldbody>
  <contact><pair name="p" geom1="rod" geom2="shell"/></contact>
  <tendon><fixed name="t" range="0 1"><joint joint="j1" coef="1"/><joint joint="j2" coef="2"/></fixed></tendon>
  <equality><joint name="e" joint1="j1" joint2="j2" polycoef="0 1 0 0 0"/></equality>
  <actuator><motor name="motor" joint="j1" ctrlrange="-1 1" gear="3"/><position name="servo" joint="j2" kp="10"/></actuator>
  <sensor><gyro name="g" site="s"/><jointpos name="angle" joint="j1" cutoff="1"/></sensor>
  <custom><numeric name="n" data="1 2 3"/><tuple name="pair"><element objtype="body" objname="a" prm="2"/></tuple></custom>
  <keyframe><key name="k" time="1"/></keyframe>
</mujoco>"""

#: Arrays that MuJoCo writes, in part at least.
ARRAYS = """
body_pos body_quat body_mass body_inertia body_ipos body_iquat body_user jnt_pos jnt_axis jnt_stiffness jnt_stiffnesspoly jnt_solref
jnt_solimp jnt_margin jnt_user qpos0 qpos_spring dof_armature dof_damping dof_dampingpoly dof_frictionloss dof_solref dof_solimp geom_pos
geom_quat geom_size geom_friction geom_solmix geom_solref geom_solimp geom_margin geom_gap geom_rgba geom_user geom_surfacevel geom_adhesion
site_pos site_quat site_size site_rgba cam_pos cam_quat cam_fovy cam_ipd light_pos light_dir light_attenuation light_cutoff
light_exponent light_ambient light_diffuse light_specular mat_texrepeat mat_emission mat_specular mat_shininess mat_reflectance mat_rgba
pair_solref pair_solreffriction pair_solimp pair_margin pair_gap pair_friction eq_data eq_solref eq_solimp tendon_range tendon_solref_lim
tendon_solimp_lim tendon_solref_fri tendon_solimp_fri tendon_margin tendon_stiffness tendon_damping tendon_frictionloss tendon_armature
actuator_dynprm actuator_gainprm actuator_biasprm actuator_ctrlrange actuator_forcerange actuator_gear actuator_damping
actuator_armature sensor_cutoff sensor_noise numeric_data tuple_objprm key_time key_qpos key_qvel key_ctrl key_mpos key_mquat
""".split()


def changed(module, name):
    """A model of which one array was changed."""
    model = module.MjModel.from_xml_string(TEXT)
    array = getattr(model, name)
    array[...] += (0.01 * np.random.default_rng(3).random(array.shape)).astype(array.dtype)
    if name.endswith(("quat", "axis", "dir")):
        array /= np.linalg.norm(array, axis=-1, keepdims=True)
    return model


def saved(module, model, path):
    """What is compiled of the text that the model was saved as."""
    module.mj_saveLastXML(str(path), model)
    return module.MjModel.from_xml_path(str(path))


@pytest.mark.filterwarnings("ignore:these arrays were written")
@pytest.mark.parametrize("name", ARRAYS)
def test_what_mujoco_saves_is_saved(truth, tmp_path, name):
    written = np.array(getattr(changed(truth, name), name))
    theirs, ours = (getattr(saved(module, changed(module, name), tmp_path / "m.xml"), name) for module in (truth, mj))
    before = getattr(mj.MjModel.from_xml_string(TEXT), name)
    # MuJoCo writes six digits.
    by_mujoco, by_us = (np.isclose(array, written, rtol=1e-5, atol=1e-6) for array in (theirs, ours))
    assert (by_mujoco & ~np.isclose(before, written, rtol=1e-5, atol=1e-6)).any(), "MuJoCo saves nothing of it"
    assert (by_us >= by_mujoco).all(), (ours, theirs, written)


def test_settings_are_saved(tmp_path):
    model = mj.MjModel.from_xml_string(TEXT)
    model.opt.timestep, model.opt.gravity[:], model.opt.iterations = 0.003, [1, 2, 3], 7
    model.stat.extent, model.vis.map.znear, model.vis.headlight.ambient[:] = 5, 0.02, [0.1, 0.2, 0.3]
    again = saved(mj, model, tmp_path / "m.xml")
    assert (again.opt.timestep, again.opt.iterations, again.stat.extent) == (0.003, 7, 5)
    assert again.opt.gravity.tolist() == [1, 2, 3]
    np.testing.assert_allclose([again.vis.map.znear, *again.vis.headlight.ambient], [0.02, 0.1, 0.2, 0.3], rtol=1e-6)


def test_what_is_not_saved_is_named(tmp_path):
    model = mj.MjModel.from_xml_string(TEXT)
    model.geom_group[1], model.geom_pos[1, 0], model.body_subtreemass[1] = 3, 0.25, 9
    with pytest.warns(UserWarning, match=r"does not get them: (body_subtreemass, geom_group|geom_group, body_subtreemass)$"):
        again = saved(mj, model, tmp_path / "m.xml")
    assert (again.geom_group[1], again.geom_pos[1, 0]) == (0, 0.25)


def test_a_model_of_another_description_is_refused(tmp_path):
    model = mj.MjModel.from_xml_string("<mujoco><worldbody><geom name='x' size='1'/></worldbody></mujoco>")
    for other in ("<geom name='y' size='1'/>", "<geom name='x' size='1'/><geom size='1'/>"):
        mj.MjModel.from_xml_string(f"<mujoco><worldbody>{other}</worldbody></mujoco>")
        with pytest.raises(mj.FatalError, match="another description"):
            mj.mj_saveLastXML(str(tmp_path / "other.xml"), model)
    assert not (tmp_path / "other.xml").exists()
