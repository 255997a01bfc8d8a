//! What a configuration says about the physics of a scene: the setting `physics_randomization` of an environment.

use crate::draws::Ranges;
use serde::Deserialize;

/// What changes in the physics of a scene at every reset. Off, and empty, unless an environment sets it.
///
/// ```toml
/// [physics_randomization]
/// masses = [{ names = ["cube*"], factor = { low = [0.5], high = [2] } }]
/// friction = [{ factor = { low = [0.7], high = [1.3] } }]
/// joints = [{ damping = { low = [0.5], high = [2] }, frictionloss = { low = [0.5], high = [2] } }]
/// actuators = [{ gain = { low = [0.8], high = [1.2] } }]
/// gravity = { low = [0, 0, -10], high = [0, 0, -9.6] }
/// readings = { low = [0], high = [5] }
/// sizes = [{ bodies = ["cube*"], factor = { low = [0.9], high = [1.1] } }]
/// layouts = [{ names = ["cube*"], pos = { low = [-0.2, 0.3], high = [0.2, 0.6] }, distance = 0.1 }]
/// ```
///
/// `names` are names of the model's elements, where a `*` at the end stands for any ending; without `names` all elements of
/// the kind are meant, those without a name too. Of each entry, only what is given changes; an element that several entries
/// of one kind name follows the last of them, and entries of different kinds act together, as `masses` and `sizes` on one mass. A task draws first, from
/// the model as it is without this setting; factors apply to what it leaves. What a task places at the very end
/// of a reset stays there.
///
/// Whatever the compiler derives from what changes is derived again: masses of subtrees, inverse weights, lengths, bounds of
/// geoms and bodies. What it fills in where a text gives nothing stays: friction of explicit pairs, damping from damping ratios,
/// length ranges of actuators.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PhysicsRandomization {
    /// Masses of bodies.
    pub masses: Vec<MassRange>,
    /// Friction of geoms.
    pub friction: Vec<FrictionRange>,
    /// What resists the motion of joints.
    pub joints: Vec<JointRange>,
    /// Gains and delays of actuators.
    pub actuators: Vec<ActuatorRange>,
    /// Delays of the model's sensors.
    pub sensors: Vec<SensorRange>,
    /// Age of the robot's readings \[time steps\], whole numbers.
    pub readings: Option<Ranges<1>>,
    /// Acceleration of gravity in the world \[m/s²\].
    pub gravity: Option<Ranges<3>>,
    /// Sizes of geoms and bodies.
    pub sizes: Vec<SizeRange>,
    /// Where bodies are.
    pub layouts: Vec<LayoutRange>,
}

/// Bodies, and what their masses are multiplied by; their moments of inertia follow.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MassRange {
    /// Names of bodies.
    #[serde(default)]
    pub names: Option<Vec<String>>,
    /// Factor, 0.001 to 1000.
    pub factor: Ranges<1>,
}

/// Geoms, and what their coefficients of friction are multiplied by: sliding, torsional and rolling alike.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FrictionRange {
    /// Names of geoms.
    #[serde(default)]
    pub names: Option<Vec<String>>,
    /// Factor, 0 to 1000.
    pub factor: Ranges<1>,
}

/// Joints, and what resists their motion. All are factors, 0 to 1000.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointRange {
    /// Names of joints.
    #[serde(default)]
    pub names: Option<Vec<String>>,
    /// Factor of the damping, its higher orders included.
    #[serde(default)]
    pub damping: Option<Ranges<1>>,
    /// Factor of the friction loss.
    #[serde(default)]
    pub frictionloss: Option<Ranges<1>>,
    /// Factor of the armature.
    #[serde(default)]
    pub armature: Option<Ranges<1>>,
}

/// Actuators.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ActuatorRange {
    /// Names of actuators.
    #[serde(default)]
    pub names: Option<Vec<String>>,
    /// Factor of the force at the same control, length and velocity, 0 to 1000: of the gain of motors; of stiffness and damping of
    /// servos; of the peak force of muscles. Limits of forces stay. Without `names`, actuators with other gains (DC motors, those of
    /// programs) are left out.
    #[serde(default)]
    pub gain: Option<Ranges<1>>,
    /// Delay of the control \[s\], within the buffer that the model keeps (`nsample` time steps). Without `names`, actuators
    /// without a buffer are left out.
    #[serde(default)]
    pub delay: Option<Ranges<1>>,
}

/// Sensors of the model.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SensorRange {
    /// Names of sensors.
    #[serde(default)]
    pub names: Option<Vec<String>>,
    /// Delay of the reading \[s\], within the buffer that the model keeps (`nsample` time steps). Without `names`, sensors
    /// without a buffer are left out.
    pub delay: Ranges<1>,
}

/// What stays as it is when a thing grows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Keeps {
    /// The density: the mass grows with the volume.
    #[default]
    Density,
    /// The mass: moments of inertia grow with the area.
    Mass,
    /// Mass and moments of inertia, as where a model gives them whatever its geoms are.
    Inertia,
}

/// Things, and what their lengths are multiplied by. They must be primitives; meshes that touch nothing keep their size.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SizeRange {
    /// Names of geoms, which grow about their own centres.
    #[serde(default)]
    pub names: Vec<String>,
    /// Names of bodies that no other body hangs on, which grow about their own frames with all geoms and sites. A body with a free joint
    /// starts so much higher that its lowest point stays where the task put it.
    #[serde(default)]
    pub bodies: Vec<String>,
    /// Factor, 0.001 to 1000.
    pub factor: Ranges<1>,
    /// What stays as it is.
    #[serde(default)]
    pub keeps: Keeps,
}

/// Bodies, and where they are: those with a free joint at the start of an episode, others always. Positions are in the frame of
/// the body that they hang on, which is the world for those with a free joint.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LayoutRange {
    /// Names of bodies.
    pub names: Vec<String>,
    /// Their x and y \[m\]; the height stays.
    #[serde(default)]
    pub pos: Option<Ranges<2>>,
    /// Least distance in x and y between the positions of this entry's bodies \[m\].
    #[serde(default)]
    pub distance: Option<f64>,
    /// What is added to their positions \[m\].
    #[serde(default)]
    pub shift: Option<Ranges<3>>,
    /// Angle that they are turned by about the vertical \[deg\].
    #[serde(default)]
    pub yaw: Option<Ranges<1>>,
}
