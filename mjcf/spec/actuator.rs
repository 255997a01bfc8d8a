//! Actuators (XML reference: `actuator`); shortcuts are already expanded to the general form.

use super::custom::Keyed;
use super::element::{Limited, elements};
use super::plugin::PluginUse;
use physics::model::{BiasType, DynType, GainType, TrnType, input};

elements! {
    /// An actuator in general form.
    Actuator {
        /// Kind of gain.
        gaintype: GainType = GainType::Fixed,
        /// Parameters of the gain.
        gainprm: [f64; 10] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        /// Kind of bias.
        biastype: BiasType = BiasType::None,
        /// `biasprm[2]` positive on a position servo is a damping ratio, resolved at `qpos0`.
        biasprm: [f64; 10] = [0.0; 10],
        /// Activation dynamics.
        dyntype: DynType = DynType::None,
        /// Parameters of the dynamics.
        dynprm: [f64; 10] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        /// Activation variables, -1 for as many as the dynamics need.
        actdim: i32 = -1,
        /// Which inputs the actuator takes, as bits (MuJoCo's `ctrlspec`); 0 for the default of its type.
        ctrlspec: i32 = 0,
        /// Limits of the velocity set point.
        velrange: [f64; 2] = [0.0; 2],
        /// Limits of the feed-forward.
        ffrange: [f64; 2] = [0.0; 2],
        /// Force uses the next activation.
        actearly: bool = false,
        /// Kind of transmission.
        trntype: TrnType = TrnType::Undefined,
        /// Ratio of length to transmission; for joints and sites six, along and about the axes.
        gear: [f64; 6] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        /// Name of the joint, tendon, site or body that it acts on.
        target: String = String::new(),
        /// Name of the site relative to which forces on a site are measured.
        refsite: String = String::new(),
        /// Name of the site that the slider of a slider-crank moves along.
        slidersite: String = String::new(),
        /// Length of the connecting rod, metres.
        cranklength: f64 = 0.0,
        /// Range of the length.
        lengthrange: [f64; 2] = [0.0; 2],
        /// The range of control or activation is the target's range times this; 0 for no range.
        inheritrange: f64 = 0.0,
        /// Damper polynomial.
        damping: [f64; 3] = [0.0; 3],
        /// Inertia of the actuator.
        armature: f64 = 0.0,
        /// Control has limits.
        ctrllimited: Limited = Limited::Auto,
        /// Limits of the control.
        ctrlrange: [f64; 2] = [0.0; 2],
        /// Force has limits.
        forcelimited: Limited = Limited::Auto,
        /// Limits of the force.
        forcerange: [f64; 2] = [0.0; 2],
        /// Activation has limits.
        actlimited: Limited = Limited::Auto,
        /// Limits of the activation.
        actrange: [f64; 2] = [0.0; 2],
        /// Group, for switching off.
        group: i32 = 0,
        /// Samples of control history kept.
        nsample: i32 = 0,
        /// Interpolation of the history.
        interp: i32 = 0,
        /// Delay of the control, seconds.
        delay: f64 = 0.0,
        /// Plugin that makes its force.
        plugin: Option<PluginUse> = None,
        /// User data.
        userdata: Vec<f64> = Vec::new(),
        /// Its share in the keyframes of an attached model.
        keyed: Vec<Keyed> = Vec::new(),
    }
}

impl Actuator {
    /// Numbers of activations and of controls as far as they show before references are resolved.
    pub(crate) fn sizes(&self) -> (usize, usize) {
        let states =
            if self.actdim > 0 { self.actdim as usize } else { usize::from(self.dyntype != DynType::None) };
        let given = (self.ctrlspec & input::ALL).count_ones() as usize;
        let inputs = match self.gaintype {
            GainType::So3 => {
                if self.ctrlspec == input::QUATERNION {
                    4
                } else {
                    3
                }
            }
            GainType::Pid if self.ctrlspec == 0 => 2,
            GainType::Dcmotor if self.ctrlspec == 0 => 1,
            GainType::Pid | GainType::Dcmotor => given,
            _ => 1,
        };
        (states, inputs)
    }
}
