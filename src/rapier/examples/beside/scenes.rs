//! Small scenes, each for one thing that engines do differently.

/// Name and text.
pub const SCENES: [(&str, &str); 11] = [
    ("pendulum", "<mujoco><option timestep='.002'/><worldbody><body name='a'><joint axis='0 1 0'/>
        <geom type='capsule' fromto='0 0 0 1 0 0' size='.05' mass='1'/><body name='tip' pos='1 0 0'/></body></worldbody></mujoco>"),
    ("double pendulum", "<mujoco><option timestep='.002'/><worldbody><body name='a'><joint axis='0 1 0'/>
        <geom type='capsule' fromto='0 0 0 1 0 0' size='.05' mass='1'/><body name='b' pos='1 0 0'><joint axis='0 1 0'/>
        <geom type='capsule' fromto='0 0 0 1 0 0' size='.05' mass='1'/></body></body></worldbody>
        <contact><exclude body1='a' body2='b'/></contact></mujoco>"),
    ("damped, sprung, armature", "<mujoco><option timestep='.002'/><worldbody><body name='a'>
        <joint axis='0 1 0' damping='.5' stiffness='5' armature='.1'/>
        <geom type='capsule' fromto='0 0 0 1 0 0' size='.05' mass='1'/><body name='tip' pos='1 0 0'/></body></worldbody></mujoco>"),
    ("limit", "<mujoco><option timestep='.002'/><worldbody><body name='a'><joint axis='0 1 0' range='-10 30'/>
        <geom type='capsule' fromto='0 0 0 1 0 0' size='.05' mass='1'/><body name='tip' pos='1 0 0'/></body></worldbody></mujoco>"),
    ("dry friction", "<mujoco><option timestep='.002'/><worldbody><body name='a'><joint axis='0 1 0' frictionloss='1'/>
        <geom type='capsule' fromto='0 0 0 1 0 0' size='.05' mass='1'/><body name='tip' pos='1 0 0'/></body></worldbody></mujoco>"),
    ("free, centre off, with a part", "<mujoco><option timestep='.002' gravity='0 0 0'/><worldbody><body name='a'>
        <freejoint/><inertial pos='.2 0 0' mass='1' diaginertia='.02 .02 .02'/><body name='b' pos='.5 0 0'>
        <joint axis='0 1 0'/><inertial pos='.1 0 0' mass='.5' diaginertia='.01 .01 .01'/></body></body></worldbody>
        <keyframe><key qpos='0 0 0 1 0 0 0 0' qvel='0 0 0 0 0 3 1'/></keyframe></mujoco>"),
    ("box drops flat", "<mujoco><option timestep='.002'/><worldbody><geom type='plane' size='5 5 1'/>
        <body name='a' pos='0 0 .3'><freejoint/><geom type='box' size='.1 .1 .1' mass='1'/></body></worldbody></mujoco>"),
    ("box drops tilted", "<mujoco><option timestep='.002'/><worldbody><geom type='plane' size='5 5 1'/>
        <body name='a' pos='0 0 .3' euler='20 30 0'><freejoint/><geom type='box' size='.1 .1 .1' mass='1'/></body>
        </worldbody></mujoco>"),
    ("box slides", "<mujoco><option timestep='.002'/><worldbody><geom type='plane' size='5 5 1' friction='.3'/>
        <body name='a' pos='0 0 .1'><freejoint/><geom type='box' size='.1 .1 .1' mass='1' friction='.3'/></body></worldbody>
        <keyframe><key qpos='0 0 .1 1 0 0 0' qvel='1.5 0 0 0 0 0'/></keyframe></mujoco>"),
    ("servo arm", "<mujoco><option timestep='.002'/><worldbody><body name='a'><joint name='a' axis='0 0 1' damping='1'/>
        <geom type='capsule' fromto='0 0 0 .4 0 0' size='.04' mass='1'/><body name='b' pos='.4 0 0'>
        <joint name='b' axis='0 1 0' damping='1'/><geom type='capsule' fromto='.1 0 0 .4 0 0' size='.03' mass='.5'/>
        <body name='c' pos='.4 0 0'><joint name='c' axis='0 1 0' damping='.5'/>
        <geom type='capsule' fromto='.1 0 0 .3 0 0' size='.02' mass='.3'/></body></body></body></worldbody>
        <actuator><position joint='a' kp='50' ctrlrange='-1 1'/><position joint='b' kp='50' ctrlrange='-1 1'/>
        <position joint='c' kp='20' ctrlrange='-1 1'/></actuator></mujoco>"),
    ("tendon and muscle", "<mujoco><option timestep='.002'/><worldbody><site name='o' pos='0 0 .1'/><body name='a'>
        <joint name='a' axis='0 1 0'/><geom type='capsule' fromto='0 0 0 .5 0 0' size='.05' mass='1'/>
        <site name='i' pos='.3 0 .05'/><body name='tip' pos='.5 0 0'/></body></worldbody>
        <tendon><spatial name='t'><site site='o'/><site site='i'/></spatial></tendon>
        <actuator><muscle tendon='t' force='200' lengthrange='.1 .5'/></actuator></mujoco>"),
];
