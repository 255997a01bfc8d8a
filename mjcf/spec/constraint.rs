//! Contact pairs, excluded pairs, equality constraints and tendons.

use super::element::{Limited, SOLIMP, SOLREF, elements};
use physics::model::{EqType, ObjType};

elements! {
    /// A contact pair; `None` is derived from the two geoms.
    Pair {
        /// First geom.
        geomname1: String = String::new(),
        /// Second geom.
        geomname2: String = String::new(),
        /// Dimensions of the contact: 1, 3, 4 or 6.
        condim: Option<i32> = None,
        /// Solver reference.
        solref: Option<[f64; 2]> = None,
        /// Solver reference of friction.
        solreffriction: Option<[f64; 2]> = None,
        /// Solver impedance.
        solimp: Option<[f64; 5]> = None,
        /// Distance at which contacts push, metres.
        margin: Option<f64> = None,
        /// Further distance at which contacts are listed, metres.
        gap: Option<f64> = None,
        /// Attractive contact force, N.
        adhesion: Option<f64> = None,
        /// Two sliding, one torsional, two rolling frictions.
        friction: Option<[f64; 5]> = None,
    }
    /// Two bodies that do not collide.
    Exclude {
        /// First body.
        bodyname1: String = String::new(),
        /// Second body.
        bodyname2: String = String::new(),
    }
    /// An equality constraint.
    ///
    /// `data` as in `mjSpec`: connect `[anchor 3]`; weld `[anchor 3, relpose pos 3, relpose quat 4, torquescale]`
    /// (a zero quaternion: relative pose from `qpos0`); joint and tendon `[polycoef 5]`.
    Equality {
        /// What is kept equal.
        kind: EqType = EqType::Connect,
        /// Shared point in the frame of a body, metres.
        data: [f64; 11] = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        /// Holds from the start.
        active: bool = true,
        /// First body.
        name1: String = String::new(),
        /// Second body, the world if absent.
        name2: String = String::new(),
        /// Body or site for connect and weld, joint, tendon.
        objtype: ObjType = ObjType::Unknown,
        /// Solver reference.
        solref: [f64; 2] = SOLREF,
        /// Solver impedance.
        solimp: [f64; 5] = SOLIMP,
    }
    /// A tendon with its path.
    Tendon {
        /// What the tendon passes, in order.
        path: Vec<Wrap> = Vec::new(),
        /// Spring polynomial.
        stiffness: [f64; 3] = [0.0; 3],
        /// Range of lengths without spring force, metres or radians; -1 for the length at `qpos0`.
        springlength: [f64; 2] = [-1.0, -1.0],
        /// Damper polynomial.
        damping: [f64; 3] = [0.0; 3],
        /// Dry friction, N.
        frictionloss: f64 = 0.0,
        /// Solver reference of friction.
        solref_friction: [f64; 2] = SOLREF,
        /// Solver impedance of friction.
        solimp_friction: [f64; 5] = SOLIMP,
        /// Inertia of length changes, kg.
        armature: f64 = 0.0,
        /// Has limits.
        limited: Limited = Limited::Auto,
        /// Total actuator force has limits.
        actfrclimited: Limited = Limited::False,
        /// Limits of length, metres.
        range: [f64; 2] = [0.0; 2],
        /// Limits of total actuator force, N.
        actfrcrange: [f64; 2] = [0.0; 2],
        /// Distance at which the limit is detected, metres.
        margin: f64 = 0.0,
        /// Solver reference of the limit.
        solref_limit: [f64; 2] = SOLREF,
        /// Solver impedance of the limit.
        solimp_limit: [f64; 5] = SOLIMP,
        /// Material.
        material: String = String::new(),
        /// Width drawn, metres.
        width: f64 = 0.003,
        /// Colour and opacity.
        rgba: [f32; 4] = [0.5, 0.5, 0.5, 1.0],
        /// Visual group.
        group: i32 = 0,
        /// User data.
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
pub enum WrapKind {
    /// A point that the tendon passes through.
    Site {
        /// Name of the site.
        site: String,
    },
    /// A sphere or cylinder that the tendon wraps around.
    Geom {
        /// Name of the geom.
        geom: String,
        /// Name of the site on the side that the tendon passes, empty for either side.
        sidesite: String,
    },
    /// A joint whose position adds to the length of a fixed tendon.
    Joint {
        /// Name of the joint.
        joint: String,
        /// Length per position.
        coef: f64,
    },
    /// The tendon divides into branches that share its force.
    Pulley {
        /// Number of branches.
        divisor: f64,
    },
}
