//! Small scenes, each for one thing that engines do differently, and how models are driven for a second.

use physics::math::ops::sin;
use physics::{Data, Model};

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

/// Controls at a time: sines over half of each control's range, each with a phase of its own. A control without a range has
/// that of -0.5 to 0.5.
pub fn controls(m: &Model, time: f64, out: &mut [f64]) {
    for (i, control) in out.iter_mut().enumerate() {
        let [low, high] = if m.actuator_ctrllimited[i] { m.actuator_ctrlrange[i] } else { [-0.5, 0.5] };
        let wave = sin(3.0 * time + i as f64) - sin(i as f64);
        *control = 0.5 * (low + high) + 0.25 * (high - low) * wave;
    }
}

/// The first keyframe, or the reference configuration of a model without any.
pub fn start(m: &Model) -> Data {
    let mut d = Data::new(m);
    if m.nkey > 0 {
        d.reset_to_key(m, 0).expect("the model has a key");
    }
    d
}

/// Steps in a second.
pub fn steps(m: &Model) -> usize {
    (1.0 / m.opt.timestep).round() as usize
}
