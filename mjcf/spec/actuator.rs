//! Actuators (XML reference: `actuator`); shortcuts are already expanded to the general form.

use super::custom::Keyed;
use super::element::{Limited, elements};
use physics::model::{BiasType, DynType, GainType, TrnType};

elements! {
    /// An actuator in general form.
    Actuator {
        gaintype: GainType = GainType::Fixed,
        gainprm: [f64; 10] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        biastype: BiasType = BiasType::None,
        /// `biasprm[2]` positive on a position servo is a damping ratio, resolved at `qpos0`.
        biasprm: [f64; 10] = [0.0; 10],
        dyntype: DynType = DynType::None,
        dynprm: [f64; 10] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        actdim: i32 = -1,
        ctrlspec: i32 = 0,
        velrange: [f64; 2] = [0.0; 2],
        ffrange: [f64; 2] = [0.0; 2],
        actearly: bool = false,
        trntype: TrnType = TrnType::Undefined,
        gear: [f64; 6] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        target: String = String::new(),
        refsite: String = String::new(),
        slidersite: String = String::new(),
        cranklength: f64 = 0.0,
        lengthrange: [f64; 2] = [0.0; 2],
        inheritrange: f64 = 0.0,
        damping: [f64; 3] = [0.0; 3],
        armature: f64 = 0.0,
        ctrllimited: Limited = Limited::Auto,
        ctrlrange: [f64; 2] = [0.0; 2],
        forcelimited: Limited = Limited::Auto,
        forcerange: [f64; 2] = [0.0; 2],
        actlimited: Limited = Limited::Auto,
        actrange: [f64; 2] = [0.0; 2],
        group: i32 = 0,
        nsample: i32 = 0,
        interp: i32 = 0,
        delay: f64 = 0.0,
        userdata: Vec<f64> = Vec::new(),
        keyed: Vec<Keyed> = Vec::new(),
    }
}

/// What the bits of [`Actuator::ctrlspec`] mean.
#[allow(missing_docs)]
pub(crate) mod input {
    /// Bits of an input signature.
    pub const POS: i32 = 1;
    pub const VEL: i32 = 2;
    pub const FF: i32 = 4;
    pub const VOLTAGE: i32 = 8;
    pub const NO_INPUT: i32 = 16;
    /// Orientation charts of an so3 servo.
    pub const EXPMAP: i32 = 1;
    pub const QUAT: i32 = 2;
}

impl Actuator {
    /// Numbers of activations and of controls as far as they show before references are resolved.
    pub(crate) fn sizes(&self) -> (usize, usize) {
        let states =
            if self.actdim > 0 { self.actdim as usize } else { usize::from(self.dyntype != DynType::None) };
        let given =
            (self.ctrlspec & (input::POS | input::VEL | input::FF | input::VOLTAGE)).count_ones() as usize;
        let inputs = match self.gaintype {
            GainType::So3 => {
                if self.ctrlspec == input::QUAT {
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
