//! Actuators (XML reference: `actuator`); shortcuts are already expanded to the general form.

use super::{Keyed, Limited, elements};
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
