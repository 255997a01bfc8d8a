//! Custom data and keyframes (XML reference: `custom`, `keyframe`).

use super::element::elements;
use physics::model::ObjType;

elements! {
    /// A custom array of numbers.
    Numeric {
        /// Numbers.
        data: Vec<f64> = Vec::new(),
        /// Array size; may exceed the data.
        size: i32 = 0,
    }
    /// A custom text.
    Text {
        /// The text.
        data: String = String::new(),
    }
    /// A custom list of references.
    Tuple {
        /// The references.
        entries: Vec<TupleEntry> = Vec::new(),
    }
    /// A state to reset to; an empty vector takes the default.
    Key {
        /// Time, seconds.
        time: f64 = 0.0,
        /// Positions.
        qpos: Vec<f64> = Vec::new(),
        /// Velocities.
        qvel: Vec<f64> = Vec::new(),
        /// Activations.
        act: Vec<f64> = Vec::new(),
        /// Positions of mocap bodies, metres.
        mpos: Vec<f64> = Vec::new(),
        /// Orientations of mocap bodies.
        mquat: Vec<f64> = Vec::new(),
        /// Controls.
        ctrl: Vec<f64> = Vec::new(),
    }
}

/// A keyframe whose numbers stand at the elements they belong to, because only a part of its model is here.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptKey {
    /// Name of the keyframe.
    pub name: String,
    /// Where it stands in the sources.
    pub loc: crate::diagnostic::Loc,
    /// Time, seconds.
    pub time: f64,
    /// Written in this model, not taken over with an attached one.
    pub own: bool,
}

/// The share of an element in a [`KeptKey`].
#[derive(Clone, Debug, PartialEq)]
pub struct Keyed {
    /// Index into `Spec::kept_keys`.
    pub key: usize,
    /// What the numbers are.
    pub part: KeyPart,
    /// The numbers of this element.
    pub values: Vec<f64>,
}

/// What the numbers of a keyframe are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeyPart {
    /// Positions of joints.
    Qpos,
    /// Velocities of joints.
    Qvel,
    /// Positions of mocap bodies.
    Mpos,
    /// Orientations of mocap bodies.
    Mquat,
    /// Activations.
    Act,
    /// Controls.
    Ctrl,
}

/// One reference of a tuple.
#[derive(Clone, Debug, PartialEq)]
pub struct TupleEntry {
    /// Kind of the object.
    pub objtype: ObjType,
    /// Object.
    pub objname: String,
    /// Number kept beside it.
    pub prm: f64,
}

impl Default for TupleEntry {
    fn default() -> Self {
        Self { objtype: ObjType::Unknown, objname: String::new(), prm: 0.0 }
    }
}
