"""Models of the tests of the stand-in for `mujoco`."""

#: A ball with an arm on a floor; every kind of element that the tests ask for.
ARM = """<mujoco>
  <option timestep=".002"/>
  <worldbody>
    <light name="lamp" pos="0 0 3"/>
    <camera name="front" pos="0 -2 1" xyaxes="1 0 0 0 0 1"/>
    <geom name="floor" type="plane" size="1 1 1"/>
    <body name="ball" pos="0 0 .3">
      <freejoint name="free"/>
      <geom name="shell" size=".1"/>
      <site name="top" pos="0 0 .1"/>
      <body name="arm" pos="0 0 .2">
        <joint name="hinge" axis="0 1 0" range="-90 90" limited="true"/>
        <geom name="rod" type="capsule" fromto="0 0 0 .2 0 0" size=".02"/>
      </body>
    </body>
  </worldbody>
  <actuator><motor name="motor" joint="hinge" gear="2"/></actuator>
  <sensor><jointpos name="angle" joint="hinge"/><framelinvel name="speed" objtype="site" objname="top"/></sensor>
  <keyframe><key name="high" qpos="0 0 1 1 0 0 0 .5" ctrl=".1"/></keyframe>
</mujoco>"""
