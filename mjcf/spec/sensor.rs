//! Sensors (XML reference: `sensor`).

use super::element::elements;
use physics::model::{DataType, ObjType, SensorType, Stage};

elements! {
    /// A sensor.
    Sensor {
        kind: SensorType = SensorType::Touch,
        objtype: ObjType = ObjType::Unknown,
        objname: String = String::new(),
        reftype: ObjType = ObjType::Unknown,
        refname: String = String::new(),
        intprm: [i32; 3] = [0; 3],
        /// Data type, stage and dimension of user sensors; derived for all others.
        datatype: DataType = DataType::Real,
        needstage: Stage = Stage::Acc,
        dim: i32 = 0,
        cutoff: f64 = 0.0,
        noise: f64 = 0.0,
        nsample: i32 = 0,
        interp: i32 = 0,
        delay: f64 = 0.0,
        interval: [f64; 2] = [0.0; 2],
        userdata: Vec<f64> = Vec::new(),
    }
}
