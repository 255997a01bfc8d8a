"""Scripts that build and edit descriptions with whichever bindings they are given, and return them."""

import numpy as np

CUBE = "\n".join(f"v {x} {y} {z}" for x in (-0.1, 0.1) for y in (-0.1, 0.1) for z in (-0.1, 0.1))

LEG = """
<mujoco model="leg">
  <compiler angle="radian" autolimits="true"/>
  <default><geom rgba="0.2 0.4 0.6 1"/><default class="soft"><geom solref="0.04 1"/></default></default>
  <asset>
    <texture name="check" type="2d" builtin="checker" width="8" height="8" rgb1=".1 .2 .3"/>
    <material name="skin" texture="check" shininess="0.3"/>
  </asset>
  <worldbody>
    <geom name="pad" type="box" size=".1 .1 .01" material="skin"/>
    <body name="thigh" pos="0 0 -.1">
      <joint name="hip" axis="0 1 0" range="-1 1"/>
      <geom name="thigh" type="capsule" fromto="0 0 0 0 0 -.3" size=".03"/>
      <site name="knee" pos="0 0 -.3"/>
      <frame name="below" pos="0 0 -.3" euler="0 0.3 0">
        <body name="shin">
          <joint name="knee" axis="0 1 0" springref="0.2" stiffness="3"/>
          <geom name="shin" class="soft" type="capsule" fromto="0 0 0 0 0 -.3" size=".02"/>
          <site name="foot" pos="0 0 -.3"/>
        </body>
      </frame>
    </body>
  </worldbody>
  <contact><exclude body1="thigh" body2="shin"/></contact>
  <equality><joint name="coupled" joint1="hip" joint2="knee" polycoef="0 .5 0 0 0" active="false"/></equality>
  <tendon><spatial name="cord"><site site="knee"/><site site="foot"/></spatial></tendon>
  <actuator><position name="hip" joint="hip" kp="20" kv="1"/><motor name="knee" joint="knee"/></actuator>
  <sensor><framepos name="foot" objtype="site" objname="foot"/><tendonpos name="cord" tendon="cord"/></sensor>
  <keyframe><key name="bent" qpos=".3 -.6" ctrl=".1 .2"/></keyframe>
</mujoco>
"""


def robot_of_nothing(mj):
    spec = mj.MjSpec()
    spec.modelname = "cart"
    spec.option.timestep = 0.004
    spec.option.gravity = [0, 0, -3.7]
    spec.compiler.degree = False
    spec.worldbody.add_light(pos=[0, 0, 3], dir=[0, 0, -1])
    spec.worldbody.add_geom(name="floor", type=mj.mjtGeom.mjGEOM_PLANE, size=[5, 5, 0.1], rgba=[0.3, 0.3, 0.3, 1])
    cart = spec.worldbody.add_body(name="cart", pos=[0, 0, 0.5])
    cart.add_joint(name="slide", type=mj.mjtJoint.mjJNT_SLIDE, axis=[1, 0, 0], range=[-2, 2], damping=0.3)
    cart.add_geom(name="box", type=mj.mjtGeom.mjGEOM_BOX, size=[0.2, 0.1, 0.1], mass=2)
    pole = cart.add_body(name="pole", euler=[0, 0.2, 0])
    hinge = pole.add_joint(name="hinge")
    hinge.axis = [0, 1, 0]
    hinge.axis[0] = 0.1
    rod = pole.add_geom(name="rod", type=mj.mjtGeom.mjGEOM_CAPSULE, fromto=[0, 0, 0, 0, 0, 0.6], size=[0.02])
    rod.friction[0] = 0.4
    pole.add_site(name="tip", pos=[0, 0, 0.6], type=mj.mjtGeom.mjGEOM_ELLIPSOID, size=[0.03, 0.02, 0.01])
    pole.add_camera(name="eye", pos=[0, -2, 0], xyaxes=[1, 0, 0, 0, 0, 1], fovy=60)
    drive = spec.add_actuator(name="drive", target="slide", trntype=mj.mjtTrn.mjTRN_JOINT, gear=[5, 0, 0, 0, 0, 0])
    drive.set_to_velocity(kv=3)
    drive.ctrlrange = [-1, 1]
    spec.add_sensor(name="pose", type=mj.mjtSensor.mjSENS_FRAMEQUAT, objtype=mj.mjtObj.mjOBJ_SITE, objname="tip")
    spec.add_sensor(name="rate", type=mj.mjtSensor.mjSENS_JOINTVEL, objtype=mj.mjtObj.mjOBJ_JOINT, objname="hinge", cutoff=4)
    spec.add_key(name="start", qpos=[0.1, 0.2], ctrl=[0.5], time=1.5)
    spec.add_numeric(name="gains", data=[1, 2, 3], size=5)
    spec.add_text(name="note", data="a cart")
    spec.add_tuple(name="both", objtype=[mj.mjtObj.mjOBJ_BODY, mj.mjtObj.mjOBJ_SITE], objname=["cart", "tip"], objprm=[0.5, 2])
    return spec


def everything_in_lists(mj):
    spec = robot_of_nothing(mj)
    spec.add_material(name="red", rgba=[1, 0, 0, 1], emission=0.5)
    spec.add_texture(name="grey", type=mj.mjtTexture.mjTEXTURE_2D, builtin=mj.mjtBuiltin.mjBUILTIN_FLAT, width=4, height=4)
    striped = spec.add_material(name="striped", texrepeat=[2, 3])
    striped.textures[mj.mjtTextureRole.mjTEXROLE_RGB] = "grey"
    spec.geom("box").material = "striped"
    spec.add_mesh(name="tetra", uservert=[0, 0, 0, 0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1], refpos=[0.01, 0, 0])
    spec.worldbody.add_geom(name="tetra", type=mj.mjtGeom.mjGEOM_MESH, meshname="tetra", pos=[1, 0, 1], material="red")
    spec.add_hfield(name="hills", size=[1, 1, 0.2, 0.1], nrow=2, ncol=3, userdata=[0, 0.5, 1, 0.2, 0.1, 0])
    spec.worldbody.add_geom(name="hills", type=mj.mjtGeom.mjGEOM_HFIELD, hfieldname="hills", pos=[3, 0, 0])
    spec.add_pair(name="touch", geomname1="floor", geomname2="rod", condim=4, margin=0.01)
    spec.add_exclude(name="apart", bodyname1="cart", bodyname2="pole")
    weld = spec.add_equality(name="hold", type=mj.mjtEq.mjEQ_JOINT, name1="hinge", active=False)
    weld.data[:2] = [0.1, 0.9]
    cord = spec.add_tendon(name="cord", stiffness=2, springlength=[0.1, 0.2])
    spec.worldbody.add_site(name="hook", pos=[0, 0, 2])
    cord.wrap_site("hook")
    cord.wrap_site("tip")
    cord.wrap_pulley(2)
    cord.wrap_site("hook")
    spec.worldbody.add_geom(name="knob", pos=[0.5, 0, 1.5], size=[0.1, 0, 0])
    cord.wrap_geom("knob", "")
    cord.wrap_site("tip")
    both = spec.add_tendon(name="both")
    both.wrap_joint("slide", 0.5)
    both.wrap_joint("hinge", -1.5)
    return spec


def two_legs(mj):
    spec = mj.MjSpec()
    torso = spec.worldbody.add_body(name="torso", pos=[0, 0, 1])
    torso.add_freejoint(name="root")
    torso.add_geom(size=[0.1, 0, 0])
    for number, side in enumerate(("left", "right")):
        frame = torso.add_frame(pos=[0, 0.2 - 0.4 * number, 0], euler=[0, 0, 20])
        spec.attach(mj.MjSpec.from_string(LEG), frame=frame, prefix=f"{side}/")
    return spec


def leg_on_a_site(mj):
    spec = mj.MjSpec.from_string(LEG)
    spec.body("shin").add_site(name="toe", pos=[0, 0, -0.3], zaxis=[0, 1, 1])
    leg = mj.MjSpec.from_string(LEG)
    moved = spec.site("toe").attach_body(leg.body("thigh"), prefix="x-", suffix="-y")
    moved.pos = [0, 0.1, 0]
    return spec


def edited_and_deleted(mj):
    spec = two_legs(mj)
    spec.compile()
    spec.delete(spec.body("left/shin"))
    spec.delete(spec.actuator("right/knee"))
    spec.joint("right/hip").name = "hip"
    spec.actuator("right/hip").target = "hip"
    spec.equality("right/coupled").name1 = "hip"
    spec.geom("right/thigh").size[0] = 0.05
    return spec


def defaults_by_hand(mj):
    spec = mj.MjSpec()
    spec.default.geom.size = [0.1, 0.2, 0.3]
    spec.default.joint.damping = [0.5, 0, 0]
    hard = spec.add_default("hard", spec.default)
    hard.geom.solref = [0.01, 1]
    hard.geom.type = mj.mjtGeom.mjGEOM_BOX
    body = spec.worldbody.add_body()
    body.add_joint()
    body.add_geom(hard)
    body.add_geom()
    body.add_geom(hard, size=[0.3, 0.3, 0.3])
    return spec


def inertias(mj):
    spec = mj.MjSpec()
    given = spec.worldbody.add_body(name="given", mass=2, ipos=[0, 0, 0.1], inertia=[0.1, 0.2, 0.25], explicitinertial=True)
    given.add_joint(type=mj.mjtJoint.mjJNT_BALL)
    given.add_geom(size=[0.1, 0, 0])
    full = spec.worldbody.add_body(name="full", mass=1, ipos=[0, 0, 0], fullinertia=[0.3, 0.3, 0.3, 0.01, 0.02, 0.03])
    full.add_freejoint(align=False)
    bare = spec.worldbody.add_body(name="bare", mass=1, inertia=[1, 1, 1])
    bare.add_joint(type=mj.mjtJoint.mjJNT_SLIDE)
    shown = spec.worldbody.add_body(name="shown", pos=[0, 1, 0])
    shown.add_freejoint()
    shown.add_geom(size=[0.2, 0, 0], density=500)
    return spec


def servos(mj):
    spec = mj.MjSpec()
    makers = (
        lambda a: a.set_to_motor(),
        lambda a: a.set_to_position(kp=4, kv=0.5),
        lambda a: a.set_to_position(kp=4, dampratio=0.7, timeconst=0.1),
        lambda a: a.set_to_intvelocity(kp=3, kv=0.2),
        lambda a: a.set_to_velocity(kv=2),
        lambda a: a.set_to_muscle(tausmooth=0.1, force=50),
        lambda a: a.set_to_cylinder(timeconst=0.2, bias=0.5, area=0.01),
        lambda a: a.set_to_pid(kp=2, kv=0.3, ki=0.5, imax=1.5),
        lambda a: a.set_to_dcmotor(motorconst=[0.05, 0.05], resistance=2),
    )
    parent = spec.worldbody
    for number, make in enumerate(makers):
        parent = parent.add_body(name=f"b{number}", pos=[0, 0, 0.3])
        parent.add_geom(size=[0.1, 0, 0])
        parent.add_joint(name=f"j{number}", axis=[1, 0, 0], range=[-90, 90])
        actuator = spec.add_actuator(name=f"a{number}", target=f"j{number}", trntype=mj.mjtTrn.mjTRN_JOINT)
        actuator.lengthrange = [-1.5, 1.5]
        make(actuator)
        if number == 3:
            actuator.actrange = [-1, 1]
    return spec


def frames_in_frames(mj):
    spec = mj.MjSpec()
    outer = spec.worldbody.add_frame(pos=[1, 0, 0], axisangle=[0, 0, 1, 30])
    inner = outer.add_frame(pos=[0, 1, 0], quat=[1, 1, 0, 0])
    inner.add_geom(size=[0.1, 0, 0])
    body = inner.add_body(name="b", pos=[0, 0, 1])
    body.add_geom(size=[0.1, 0.2, 0.3], type=mj.mjtGeom.mjGEOM_ELLIPSOID)
    sibling = spec.worldbody.add_body(name="c")
    sibling.set_frame(outer)
    sibling.add_geom(size=[0.1, 0, 0])
    sibling.add_body(name="d", pos=[0, 0, 2]).add_geom(size=[0.2, 0, 0])
    spec.body("d").to_frame()
    return spec


def mesh_of_memory(mj):
    spec = mj.MjSpec()
    spec.assets = {"cube.obj": CUBE}
    spec.add_mesh(name="cube", file="cube.obj", scale=[1, 2, 3])
    spec.worldbody.add_geom(type=mj.mjtGeom.mjGEOM_MESH, meshname="cube")
    ball = spec.add_mesh(name="ball")
    ball.make_sphere(subdivision=1)
    spec.worldbody.add_geom(type=mj.mjtGeom.mjGEOM_MESH, meshname="ball", pos=[0, 0, 2])
    return spec


def copied(mj):
    original = two_legs(mj)
    duplicate = original.copy()
    original.delete(original.body("left/thigh"))
    duplicate.body("torso").pos = np.array([0.0, 0.0, 2.0])
    return duplicate


def copied_while_attaching(mj):
    spec = mj.MjSpec()
    spec.copy_during_attach = True
    leg = mj.MjSpec.from_string(LEG)
    for number in range(3):
        frame = spec.worldbody.add_frame(pos=[number, 0, 1])
        frame.attach_body(leg.body("thigh"), prefix=f"{number}-")
    return spec


def settings(mj):
    spec = mj.MjSpec.from_string(LEG)
    spec.option.integrator = mj.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.disableflags |= int(mj.mjtDisableBit.mjDSBL_GRAVITY)
    spec.visual.headlight.diffuse = [0.1, 0.2, 0.3]
    spec.visual.global_.fovy = 50
    spec.stat.extent = 3
    spec.stat.center = [0, 0, 1]
    spec.nuserdata = 4
    spec.nkey = 3
    spec.compiler.boundmass = 0.5
    return spec


def cloth_and_cushion(mj):
    spec = mj.MjSpec()
    frame = spec.worldbody.add_body(name="frame", pos=[0, 0, 1])
    cloth = frame.make_flex("cloth", dim=2, count=[4, 3, 1], spacing=[0.1] * 3, radius=0.01, mass=0.3, equality=1)
    cloth.rgba = [0.8, 0.2, 0.1, 1]
    cloth.friction[0] = 0.4
    block = spec.worldbody.add_body(name="block", pos=[1, 0, 1])
    cushion = block.make_flex("cushion", count=[3, 3, 4], spacing=[0.1] * 3, radius=0.01, dof="trilinear", mass=2)
    cushion.young, cushion.poisson, cushion.damping = 5e4, 0.2, 0.1
    cushion.selfcollide = mj.mjtFlexSelf.mjFLEXSELF_NONE
    line = spec.worldbody.add_body(name="line", pos=[2, 0, 1])
    line.make_flex("line", dim=1, count=[5, 1, 1], spacing=[0.1] * 3, radius=0.01, equality=1, pos=[0, 0, 0.5])
    return spec


def sheet_by_hand(mj):
    spec = mj.MjSpec()
    for k, pos in enumerate(([0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.1])):
        body = spec.worldbody.add_body(name=f"corner{k}", pos=pos, mass=1, inertia=[0.1, 0.1, 0.1], ipos=[0, 0, 0])
        body.explicitinertial = True
        body.add_joint(type=mj.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])
    sheet = spec.add_flex(name="sheet", dim=2, elem=[0, 1, 2, 1, 3, 2], young=10, thickness=0.01, elastic2d=2)
    sheet.vertbody = [f"corner{k}" for k in range(4)]
    sheet.contype = 3
    sheet.internal = False
    skin = spec.add_skin(name="hide", vert=[0, 0, 0, 1, 0, 0, 0, 1, 0], face=[0, 1, 2], inflate=0.1, group=2)
    skin.bodyname = ["corner0", "corner1"]
    skin.bindpos, skin.bindquat = [0] * 6, [1, 0, 0, 0] * 2
    skin.vertid, skin.vertweight = [[0, 1], [1, 2]], [[1, 0.5], [0.5, 2]]
    return spec


def cloth_attached(mj):
    spec, other = mj.MjSpec(), sheet_by_hand(mj)
    spec.attach(cloth_and_cushion(mj), frame=spec.worldbody.add_frame(pos=[0, 0, 2], euler=[0, 0, 30]), prefix="a-")
    spec.attach(other, frame=spec.worldbody.add_frame(pos=[0, 3, 0]), prefix="b-", suffix="-s")
    return spec


def cables(mj):
    spec = mj.MjSpec()
    spec.activate_plugin("mujoco.elasticity.cable")
    plugin = spec.add_plugin(name="cable", plugin_name="mujoco.elasticity.cable", active=True)
    plugin.config = {"twist": "1e4", "bend": "2e3"}
    body = spec.worldbody
    for k in range(3):
        body = body.add_body(name=f"link{k}", pos=[0.1, 0, 0])
        body.plugin = plugin
        body.plugin.name, body.plugin.active = "cable", True
        body.add_joint(type=mj.mjtJoint.mjJNT_BALL, damping=[0.1, 0, 0])
        body.add_geom(type=mj.mjtGeom.mjGEOM_CAPSULE, fromto=[0, 0, 0, 0.1, 0, 0], size=[0.01, 0, 0])
    return spec


SCRIPTS = (
    robot_of_nothing,
    everything_in_lists,
    two_legs,
    leg_on_a_site,
    edited_and_deleted,
    defaults_by_hand,
    inertias,
    servos,
    frames_in_frames,
    mesh_of_memory,
    copied,
    copied_while_attaching,
    settings,
    cloth_and_cushion,
    sheet_by_hand,
    cloth_attached,
    cables,
)
