//! Custom data and keyframes (XML reference: `custom`, `keyframe`).

use super::elements;
use physics::model::ObjType;

elements! {
    /// A custom array of numbers.
    Numeric {
        data: Vec<f64> = Vec::new(),
        /// Array size; may exceed the data.
        size: i32 = 0,
    }
    /// A custom text.
    Text {
        data: String = String::new(),
    }
    /// A custom list of references.
    Tuple {
        entries: Vec<TupleEntry> = Vec::new(),
    }
    /// A state to reset to; an empty vector takes the default.
    Key {
        time: f64 = 0.0,
        qpos: Vec<f64> = Vec::new(),
        qvel: Vec<f64> = Vec::new(),
        act: Vec<f64> = Vec::new(),
        mpos: Vec<f64> = Vec::new(),
        mquat: Vec<f64> = Vec::new(),
        ctrl: Vec<f64> = Vec::new(),
    }
}

/// One reference of a tuple.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct TupleEntry {
    pub objtype: ObjType,
    pub objname: String,
    pub prm: f64,
}

impl Default for TupleEntry {
    fn default() -> Self {
        Self { objtype: ObjType::Unknown, objname: String::new(), prm: 0.0 }
    }
}
