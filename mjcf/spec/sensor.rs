//! Sensors (XML reference: `sensor`).

use super::element::elements;
use super::plugin::PluginUse;
use physics::model::{DataType, ObjType, SensorType, Stage};

elements! {
    /// A sensor.
    Sensor {
        /// What is measured.
        kind: SensorType = SensorType::Touch,
        /// Kind of the object measured.
        objtype: ObjType = ObjType::Unknown,
        /// Site measured.
        objname: String = String::new(),
        /// Kind of the frame of reference.
        reftype: ObjType = ObjType::Unknown,
        /// Frame of reference, the world if absent.
        refname: String = String::new(),
        /// Contacts reported.
        intprm: [i32; 3] = [0; 3],
        /// Data type, stage and dimension of user sensors; derived for all others.
        datatype: DataType = DataType::Real,
        /// Stage of the computation it needs.
        needstage: Stage = Stage::Acc,
        /// Number of outputs.
        dim: i32 = 0,
        /// Readings are clamped to this size; 0 for none.
        cutoff: f64 = 0.0,
        /// Standard deviation that a user may add.
        noise: f64 = 0.0,
        /// Samples of history kept.
        nsample: i32 = 0,
        /// Interpolation of the history.
        interp: i32 = 0,
        /// Delay of the reading, seconds.
        delay: f64 = 0.0,
        /// Period and phase of measurement, seconds.
        interval: [f64; 2] = [0.0; 2],
        /// Plugin that reads.
        plugin: Option<PluginUse> = None,
        /// User data.
        userdata: Vec<f64> = Vec::new(),
    }
}
