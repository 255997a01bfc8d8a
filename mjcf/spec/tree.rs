//! Elements of the kinematic tree (XML reference: `body` and its children).

use super::custom::Keyed;
use super::element::{Limited, SOLIMP, SOLREF, elements};
use super::orientation::Orientation;
use super::plugin::PluginUse;
use physics::model::{GeomType, JointType, LightType, Projection, SleepPolicy, TrackMode};

/// Whether a free joint is aligned with the inertial frame of its body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum AlignFree {
    /// Never.
    False,
    /// Always.
    True,
    /// As `compiler.alignfree` says.
    #[default]
    Auto,
}

/// The `inertial` element of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Inertial {
    /// Where the element stands in the sources.
    pub loc: crate::diagnostic::Loc,
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass, metres.
    pub pos: [f64; 3],
    /// Orientation.
    pub quat: [f64; 4],
    /// Orientation by axis and angle.
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
        /// Frame that the body stands in, index into [`Spec::frames`](super::Spec::frames).
        frame: Option<usize> = None,
        /// Position, metres.
        pos: [f64; 3] = [0.0; 3],
        /// Orientation.
        quat: [f64; 4] = [1.0, 0.0, 0.0, 0.0],
        /// Orientation by axis and angle.
        alt: Option<Orientation> = None,
        /// Mass and inertia, where the file gives them.
        inertial: Option<Inertial> = None,
        /// Moved by the user, not by the physics.
        mocap: bool = false,
        /// Share of the weight that is compensated.
        gravcomp: f64 = 0.0,
        /// Whether the tree may sleep.
        sleep: SleepPolicy = SleepPolicy::Auto,
        /// Allow the simple-body optimisation.
        simple: bool = true,
        /// User data.
        userdata: Vec<f64> = Vec::new(),
        /// Plugin that makes passive forces.
        plugin: Option<PluginUse> = None,
        /// Its share in the keyframes of an attached model.
        keyed: Vec<Keyed> = Vec::new(),
        /// Joints, in the order in which they move the body.
        joints: Vec<Joint> = Vec::new(),
        /// Geoms.
        geoms: Vec<Geom> = Vec::new(),
        /// Sites.
        sites: Vec<Site> = Vec::new(),
        /// Cameras.
        cameras: Vec<Camera> = Vec::new(),
        /// Lights.
        lights: Vec<Light> = Vec::new(),
        /// Children.
        bodies: Vec<Body> = Vec::new(),
    }
    /// A coordinate frame without inertia or degrees of freedom.
    Frame {
        /// The enclosing frame, if any, within the same body.
        parent: Option<usize> = None,
        /// Where the body that it stands in begins, nowhere for the world; tells the body of a frame that holds nothing.
        holder: crate::diagnostic::Loc = crate::diagnostic::Loc::NONE,
        /// Position, metres.
        pos: [f64; 3] = [0.0; 3],
        /// Orientation.
        quat: [f64; 4] = [1.0, 0.0, 0.0, 0.0],
        /// Orientation by axis and angle.
        alt: Option<Orientation> = None,
    }
    /// A joint of the enclosing body with its parent.
    Joint {
        /// Frame that it stands in, index into [`Spec::frames`](super::Spec::frames).
        frame: Option<usize> = None,
        /// Kind of motion.
        kind: JointType = JointType::Hinge,
        /// Anchor, metres.
        pos: [f64; 3] = [0.0; 3],
        /// Axis of hinge or slide.
        axis: [f64; 3] = [0.0, 0.0, 1.0],
        /// Position in the initial configuration.
        ref_: f64 = 0.0,
        /// Body frame is moved to the inertial frame.
        align: AlignFree = AlignFree::Auto,
        /// Spring polynomial.
        stiffness: [f64; 3] = [0.0; 3],
        /// Position without spring force.
        springref: f64 = 0.0,
        /// Time constant and damping ratio.
        springdamper: [f64; 2] = [0.0; 2],
        /// Has limits.
        limited: Limited = Limited::Auto,
        /// Limits, metres or angle.
        range: [f64; 2] = [0.0; 2],
        /// Distance at which the limit is detected.
        margin: f64 = 0.0,
        /// Solver reference of the limit.
        solref_limit: [f64; 2] = SOLREF,
        /// Solver impedance of the limit.
        solimp_limit: [f64; 5] = SOLIMP,
        /// Total actuator force has limits.
        actfrclimited: Limited = Limited::Auto,
        /// Limits of total actuator force.
        actfrcrange: [f64; 2] = [0.0; 2],
        /// Inertia of the rotor, kg m² or kg.
        armature: f64 = 0.0,
        /// Damper polynomial.
        damping: [f64; 3] = [0.0; 3],
        /// Dry friction, N or N m.
        frictionloss: f64 = 0.0,
        /// Solver reference of friction.
        solref_friction: [f64; 2] = SOLREF,
        /// Solver impedance of friction.
        solimp_friction: [f64; 5] = SOLIMP,
        /// Visual group.
        group: i32 = 0,
        /// Gravity compensation counts as actuator force.
        actgravcomp: bool = false,
        /// Its share in the keyframes of an attached model.
        keyed: Vec<Keyed> = Vec::new(),
        /// User data.
        userdata: Vec<f64> = Vec::new(),
    }
    /// A shape fixed to a body.
    Geom {
        /// Frame that it stands in, index into [`Spec::frames`](super::Spec::frames).
        frame: Option<usize> = None,
        /// Shape.
        kind: GeomType = GeomType::Sphere,
        /// Position, metres.
        pos: [f64; 3] = [0.0; 3],
        /// Orientation.
        quat: [f64; 4] = [1.0, 0.0, 0.0, 0.0],
        /// Orientation by axis and angle.
        alt: Option<Orientation> = None,
        /// Ends of capsule, cylinder, ellipsoid or box, metres.
        fromto: Option<[f64; 6]> = None,
        /// Radii or half lengths, metres.
        size: [f64; 3] = [0.0; 3],
        /// Contact bits.
        contype: i32 = 1,
        /// Contact bits that it meets.
        conaffinity: i32 = 1,
        /// Dimensions of the contact: 1, 3, 4 or 6.
        condim: i32 = 3,
        /// Whose contact parameters win.
        priority: i32 = 0,
        /// Sliding, torsional, rolling friction.
        friction: [f64; 3] = [1.0, 0.005, 0.0001],
        /// Weight in mixing contact parameters.
        solmix: f64 = 1.0,
        /// Solver reference.
        solref: [f64; 2] = SOLREF,
        /// Solver impedance.
        solimp: [f64; 5] = SOLIMP,
        /// Distance at which contacts push, metres.
        margin: f64 = 0.0,
        /// Further distance at which contacts are listed, metres.
        gap: f64 = 0.0,
        /// Velocity of the surface, m/s and rad/s.
        surfacevel: [f64; 6] = [0.0; 6],
        /// Attractive contact force, N.
        adhesion: f64 = 0.0,
        /// Mass, kg; replaces density.
        mass: Option<f64> = None,
        /// Density, kg/m³ or kg/m² for shells.
        density: f64 = 1000.0,
        /// Mass lies on the surface.
        shellinertia: bool = false,
        /// Fluid model.
        fluid_ellipsoid: f64 = 0.0,
        /// Fluid coefficients.
        fluid_coefs: [f64; 5] = [0.5, 0.25, 1.5, 1.0, 1.0],
        /// Material.
        material: String = String::new(),
        /// Colour and opacity.
        rgba: [f32; 4] = [0.5, 0.5, 0.5, 1.0],
        /// Visual group.
        group: i32 = 0,
        /// Height field.
        hfieldname: String = String::new(),
        /// Mesh.
        meshname: String = String::new(),
        /// Scale of a shape fitted to a mesh.
        fitscale: f64 = 1.0,
        /// Plugin that is its signed distance field.
        plugin: Option<PluginUse> = None,
        /// User data.
        userdata: Vec<f64> = Vec::new(),
    }
    /// A point with a frame and a shape, without mass or contact.
    Site {
        /// Frame that it stands in, index into [`Spec::frames`](super::Spec::frames).
        frame: Option<usize> = None,
        /// Position, metres.
        pos: [f64; 3] = [0.0; 3],
        /// Orientation.
        quat: [f64; 4] = [1.0, 0.0, 0.0, 0.0],
        /// Orientation by axis and angle.
        alt: Option<Orientation> = None,
        /// Ends of a long shape, metres.
        fromto: Option<[f64; 6]> = None,
        /// Radii or half lengths, metres.
        size: [f64; 3] = [0.005; 3],
        /// Shape.
        kind: GeomType = GeomType::Sphere,
        /// Material.
        material: String = String::new(),
        /// Visual group.
        group: i32 = 0,
        /// Colour and opacity.
        rgba: [f32; 4] = [0.5, 0.5, 0.5, 1.0],
        /// User data.
        userdata: Vec<f64> = Vec::new(),
    }
    /// A camera.
    Camera {
        /// Frame that it stands in, index into [`Spec::frames`](super::Spec::frames).
        frame: Option<usize> = None,
        /// Position, metres.
        pos: [f64; 3] = [0.0; 3],
        /// Orientation.
        quat: [f64; 4] = [1.0, 0.0, 0.0, 0.0],
        /// Orientation by axis and angle.
        alt: Option<Orientation> = None,
        /// What it follows.
        mode: TrackMode = TrackMode::Fixed,
        /// Body that it looks at.
        targetbody: String = String::new(),
        /// Kind of projection.
        proj: Projection = Projection::Perspective,
        /// Width and height, pixels.
        resolution: [i32; 2] = [1, 1],
        /// Bits: rgb 1, depth 2, distance 4, normal 8, segmentation 16.
        output: i32 = 1,
        /// Vertical field of view in degrees, metres when orthographic.
        fovy: f64 = 45.0,
        /// Distance between the eyes, metres.
        ipd: f64 = 0.068,
        /// Sensor width and height, metres.
        sensor_size: [f32; 2] = [0.0; 2],
        /// Focal lengths, metres.
        focal_length: [f32; 2] = [0.0; 2],
        /// Focal lengths, pixels.
        focal_pixel: [f32; 2] = [0.0; 2],
        /// Principal point offset, metres.
        principal_length: [f32; 2] = [0.0; 2],
        /// Principal point offset, pixels.
        principal_pixel: [f32; 2] = [0.0; 2],
        /// Focal length and principal point, metres.
        intrinsic: [f32; 4] = [0.0; 4],
        /// User data.
        userdata: Vec<f64> = Vec::new(),
    }
    /// A light.
    Light {
        /// Frame that it stands in, index into [`Spec::frames`](super::Spec::frames).
        frame: Option<usize> = None,
        /// Position, metres.
        pos: [f64; 3] = [0.0; 3],
        /// Direction.
        dir: [f64; 3] = [0.0, 0.0, -1.0],
        /// What it follows.
        mode: TrackMode = TrackMode::Fixed,
        /// Body that it shines on.
        targetbody: String = String::new(),
        /// Is on.
        active: bool = true,
        /// Parallel rays; older spelling of type.
        kind: LightType = LightType::Spot,
        /// Image of an image light.
        texture: String = String::new(),
        /// Casts shadows.
        castshadow: bool = true,
        /// Radius of the bulb, metres.
        bulbradius: f32 = 0.02,
        /// Intensity, candela.
        intensity: f32 = 0.0,
        /// Reach, metres.
        range: f32 = 10.0,
        /// Constant, linear, quadratic attenuation.
        attenuation: [f32; 3] = [1.0, 0.0, 0.0],
        /// Half angle of the cone, degrees.
        cutoff: f32 = 45.0,
        /// Softness of the cone's edge.
        softness: f32 = 0.2,
        /// Fall-off inside the cone.
        exponent: f32 = 10.0,
        /// Ambient colour.
        ambient: [f32; 3] = [0.0; 3],
        /// Diffuse colour.
        diffuse: [f32; 3] = [0.7; 3],
        /// Specular colour.
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
