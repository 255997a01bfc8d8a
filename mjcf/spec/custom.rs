//! Custom data and keyframes (XML reference: `custom`, `keyframe`).

use super::element::elements;
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

/// A keyframe whose numbers stand at the elements they belong to, because only a part of its model is here.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct KeptKey {
    pub name: String,
    pub loc: crate::diagnostic::Loc,
    pub time: f64,
    /// Written in this model, not taken over with an attached one.
    pub own: bool,
}

/// The share of an element in a [`KeptKey`].
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct Keyed {
    /// Index into `Spec::kept_keys`.
    pub key: usize,
    pub part: KeyPart,
    pub values: Vec<f64>,
}

/// What the numbers of a keyframe are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum KeyPart {
    Qpos,
    Qvel,
    Mpos,
    Mquat,
    Act,
    Ctrl,
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
