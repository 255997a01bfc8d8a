//! Elements of the kinematic tree (XML reference: `body` and its children).

use super::custom::Keyed;
use super::element::{Limited, SOLIMP, SOLREF, elements};
use super::orientation::Orientation;
use physics::model::{GeomType, JointType, LightType, Projection, SleepPolicy, TrackMode};

/// Whether a free joint is aligned with the inertial frame of its body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[allow(missing_docs)]
pub enum AlignFree {
    False,
    True,
    /// As `compiler.alignfree` says.
    #[default]
    Auto,
}

/// The `inertial` element of a body.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct Inertial {
    pub loc: crate::diagnostic::Loc,
    pub mass: f64,
    pub pos: [f64; 3],
    pub quat: [f64; 4],
    pub alt: Option<Orientation>,
    /// Principal moments; zero when the file gives `fullinertia`.
    pub inertia: [f64; 3],
    /// xx, yy, zz, xy, xz, yz.
    pub fullinertia: Option<[f64; 6]>,
}

impl Default for Inertial {
    fn default() -> Self {
        Self {
            loc: crate::diagnostic::Loc::NONE,
            mass: 0.0,
            pos: [0.0; 3],
            quat: [1.0, 0.0, 0.0, 0.0],
            alt: None,
            inertia: [0.0; 3],
            fullinertia: None,
        }
    }
}

elements! {
    /// A body with what is fixed to it, in file order within each kind.
    Body {
        frame: Option<usize> = None,
        pos: [f64; 3] = [0.0; 3],
        quat: [f64; 4] = [1.0, 0.0, 0.0, 0.0],
        alt: Option<Orientation> = None,
        inertial: Option<Inertial> = None,
        mocap: bool = false,
        gravcomp: f64 = 0.0,
        sleep: SleepPolicy = SleepPolicy::Auto,
        /// Allow the simple-body optimisation.
        simple: bool = true,
        userdata: Vec<f64> = Vec::new(),
        keyed: Vec<Keyed> = Vec::new(),
        joints: Vec<Joint> = Vec::new(),
        geoms: Vec<Geom> = Vec::new(),
        sites: Vec<Site> = Vec::new(),
        cameras: Vec<Camera> = Vec::new(),
        lights: Vec<Light> = Vec::new(),
        bodies: Vec<Body> = Vec::new(),
    }
    /// A coordinate frame without inertia or degrees of freedom.
    Frame {
        /// The enclosing frame, if any, within the same body.
        parent: Option<usize> = None,
        pos: [f64; 3] = [0.0; 3],
        quat: [f64; 4] = [1.0, 0.0, 0.0, 0.0],
        alt: Option<Orientation> = None,
    }
    /// A joint of the enclosing body with its parent.
    Joint {
        frame: Option<usize> = None,
        kind: JointType = JointType::Hinge,
        pos: [f64; 3] = [0.0; 3],
        axis: [f64; 3] = [0.0, 0.0, 1.0],
        ref_: f64 = 0.0,
        align: AlignFree = AlignFree::Auto,
        stiffness: [f64; 3] = [0.0; 3],
        springref: f64 = 0.0,
        springdamper: [f64; 2] = [0.0; 2],
        limited: Limited = Limited::Auto,
        range: [f64; 2] = [0.0; 2],
        margin: f64 = 0.0,
        solref_limit: [f64; 2] = SOLREF,
        solimp_limit: [f64; 5] = SOLIMP,
        actfrclimited: Limited = Limited::Auto,
        actfrcrange: [f64; 2] = [0.0; 2],
        armature: f64 = 0.0,
        damping: [f64; 3] = [0.0; 3],
        frictionloss: f64 = 0.0,
        solref_friction: [f64; 2] = SOLREF,
        solimp_friction: [f64; 5] = SOLIMP,
        group: i32 = 0,
        actgravcomp: bool = false,
        keyed: Vec<Keyed> = Vec::new(),
        userdata: Vec<f64> = Vec::new(),
    }
    /// A shape fixed to a body.
    Geom {
        frame: Option<usize> = None,
        kind: GeomType = GeomType::Sphere,
        pos: [f64; 3] = [0.0; 3],
        quat: [f64; 4] = [1.0, 0.0, 0.0, 0.0],
        alt: Option<Orientation> = None,
        fromto: Option<[f64; 6]> = None,
        size: [f64; 3] = [0.0; 3],
        contype: i32 = 1,
        conaffinity: i32 = 1,
        condim: i32 = 3,
        priority: i32 = 0,
        friction: [f64; 3] = [1.0, 0.005, 0.0001],
        solmix: f64 = 1.0,
        solref: [f64; 2] = SOLREF,
        solimp: [f64; 5] = SOLIMP,
        margin: f64 = 0.0,
        gap: f64 = 0.0,
        surfacevel: [f64; 6] = [0.0; 6],
        adhesion: f64 = 0.0,
        mass: Option<f64> = None,
        density: f64 = 1000.0,
        shellinertia: bool = false,
        fluid_ellipsoid: f64 = 0.0,
        fluid_coefs: [f64; 5] = [0.5, 0.25, 1.5, 1.0, 1.0],
        material: String = String::new(),
        rgba: [f32; 4] = [0.5, 0.5, 0.5, 1.0],
        group: i32 = 0,
        hfieldname: String = String::new(),
        meshname: String = String::new(),
        fitscale: f64 = 1.0,
        userdata: Vec<f64> = Vec::new(),
    }
    /// A point with a frame and a shape, without mass or contact.
    Site {
        frame: Option<usize> = None,
        pos: [f64; 3] = [0.0; 3],
        quat: [f64; 4] = [1.0, 0.0, 0.0, 0.0],
        alt: Option<Orientation> = None,
        fromto: Option<[f64; 6]> = None,
        size: [f64; 3] = [0.005; 3],
        kind: GeomType = GeomType::Sphere,
        material: String = String::new(),
        group: i32 = 0,
        rgba: [f32; 4] = [0.5, 0.5, 0.5, 1.0],
        userdata: Vec<f64> = Vec::new(),
    }
    /// A camera.
    Camera {
        frame: Option<usize> = None,
        pos: [f64; 3] = [0.0; 3],
        quat: [f64; 4] = [1.0, 0.0, 0.0, 0.0],
        alt: Option<Orientation> = None,
        mode: TrackMode = TrackMode::Fixed,
        targetbody: String = String::new(),
        proj: Projection = Projection::Perspective,
        resolution: [i32; 2] = [1, 1],
        /// Bits: rgb 1, depth 2, distance 4, normal 8, segmentation 16.
        output: i32 = 1,
        /// Vertical field of view in degrees, metres when orthographic.
        fovy: f64 = 45.0,
        ipd: f64 = 0.068,
        sensor_size: [f32; 2] = [0.0; 2],
        focal_length: [f32; 2] = [0.0; 2],
        focal_pixel: [f32; 2] = [0.0; 2],
        principal_length: [f32; 2] = [0.0; 2],
        principal_pixel: [f32; 2] = [0.0; 2],
        intrinsic: [f32; 4] = [0.0; 4],
        userdata: Vec<f64> = Vec::new(),
    }
    /// A light.
    Light {
        frame: Option<usize> = None,
        pos: [f64; 3] = [0.0; 3],
        dir: [f64; 3] = [0.0, 0.0, -1.0],
        mode: TrackMode = TrackMode::Fixed,
        targetbody: String = String::new(),
        active: bool = true,
        kind: LightType = LightType::Spot,
        texture: String = String::new(),
        castshadow: bool = true,
        bulbradius: f32 = 0.02,
        intensity: f32 = 0.0,
        range: f32 = 10.0,
        attenuation: [f32; 3] = [1.0, 0.0, 0.0],
        cutoff: f32 = 45.0,
        softness: f32 = 0.2,
        exponent: f32 = 10.0,
        ambient: [f32; 3] = [0.0; 3],
        diffuse: [f32; 3] = [0.7; 3],
        specular: [f32; 3] = [0.3; 3],
    }
}

/// Number of positions and of velocities of a joint type.
pub(crate) fn joint_dimensions(kind: JointType) -> (usize, usize) {
    match kind {
        JointType::Free => (7, 6),
        JointType::Ball => (4, 3),
        JointType::Slide | JointType::Hinge => (1, 1),
    }
}
