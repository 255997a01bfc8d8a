//! Contact pairs, excluded pairs, equality constraints and tendons.

use super::element::{Limited, SOLIMP, SOLREF, elements};
use physics::model::{EqType, ObjType};

elements! {
    /// A contact pair; `None` is derived from the two geoms.
    Pair {
        geomname1: String = String::new(),
        geomname2: String = String::new(),
        condim: Option<i32> = None,
        solref: Option<[f64; 2]> = None,
        solreffriction: Option<[f64; 2]> = None,
        solimp: Option<[f64; 5]> = None,
        margin: Option<f64> = None,
        gap: Option<f64> = None,
        adhesion: Option<f64> = None,
        friction: Option<[f64; 5]> = None,
    }
    /// Two bodies that do not collide.
    Exclude {
        bodyname1: String = String::new(),
        bodyname2: String = String::new(),
    }
    /// An equality constraint.
    ///
    /// `data` as in `mjSpec`: connect `[anchor 3]`; weld `[anchor 3, relpose pos 3, relpose quat 4, torquescale]`
    /// (a zero quaternion: relative pose from `qpos0`); joint and tendon `[polycoef 5]`.
    Equality {
        kind: EqType = EqType::Connect,
        data: [f64; 11] = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        active: bool = true,
        name1: String = String::new(),
        name2: String = String::new(),
        /// Body or site for connect and weld, joint, tendon.
        objtype: ObjType = ObjType::Unknown,
        solref: [f64; 2] = SOLREF,
        solimp: [f64; 5] = SOLIMP,
    }
    /// A tendon with its path.
    Tendon {
        path: Vec<Wrap> = Vec::new(),
        stiffness: [f64; 3] = [0.0; 3],
        springlength: [f64; 2] = [-1.0, -1.0],
        damping: [f64; 3] = [0.0; 3],
        frictionloss: f64 = 0.0,
        solref_friction: [f64; 2] = SOLREF,
        solimp_friction: [f64; 5] = SOLIMP,
        armature: f64 = 0.0,
        limited: Limited = Limited::Auto,
        actfrclimited: Limited = Limited::False,
        range: [f64; 2] = [0.0; 2],
        actfrcrange: [f64; 2] = [0.0; 2],
        margin: f64 = 0.0,
        solref_limit: [f64; 2] = SOLREF,
        solimp_limit: [f64; 5] = SOLIMP,
        material: String = String::new(),
        width: f64 = 0.003,
        rgba: [f32; 4] = [0.5, 0.5, 0.5, 1.0],
        group: i32 = 0,
        userdata: Vec<f64> = Vec::new(),
    }
}

/// One element of a tendon path.
#[derive(Clone, Debug, PartialEq)]
pub struct Wrap {
    /// Where the element stands in the sources.
    pub loc: crate::diagnostic::Loc,
    /// What it is.
    pub kind: WrapKind,
}

/// Kinds of tendon path elements.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum WrapKind {
    Site { site: String },
    Geom { geom: String, sidesite: String },
    Joint { joint: String, coef: f64 },
    Pulley { divisor: f64 },
}
