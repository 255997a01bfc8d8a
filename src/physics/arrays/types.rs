//! Enumerations behind the integers of the model, with MuJoCo's values.

macro_rules! codes {
    ($($(#[$meta:meta])* $name:ident { $($variant:ident = $value:literal,)* })*) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(i32)]
        #[allow(missing_docs)]
        pub enum $name { $($variant = $value,)* }

        impl $name {
            /// The variant with integer value `code`.
            pub const fn from_code(code: i32) -> Option<Self> {
                match code {
                    $($value => Some(Self::$variant),)*
                    _ => None,
                }
            }

            /// The integer that arrays hold.
            pub const fn code(self) -> i32 {
                self as i32
            }
        }
    )*};
}

codes! {
    /// Type of joint.
    JointType {
        Free = 0,
        Ball = 1,
        Slide = 2,
        Hinge = 3,
    }
    /// Shape of a geom.
    GeomType {
        Plane = 0,
        Hfield = 1,
        Sphere = 2,
        Capsule = 3,
        Ellipsoid = 4,
        Cylinder = 5,
        Box = 6,
        Mesh = 7,
        Sdf = 8,
        None = 1001,
    }
    /// Tracking mode of a camera or light.
    TrackMode {
        Fixed = 0,
        Track = 1,
        Trackcom = 2,
        Targetbody = 3,
        Targetbodycom = 4,
    }
    /// Type of light.
    LightType {
        Spot = 0,
        Directional = 1,
        Point = 2,
        Image = 3,
    }
    /// Type of texture.
    TextureType {
        Texture2d = 0,
        Cube = 1,
        Skybox = 2,
    }
    /// Role of a texture in a material.
    TextureRole {
        User = 0,
        Rgb = 1,
        Occlusion = 2,
        Roughness = 3,
        Metallic = 4,
        Normal = 5,
        Opacity = 6,
        Emissive = 7,
        Rgba = 8,
        Orm = 9,
    }
    /// Colour space of a texture.
    ColorSpace {
        Auto = 0,
        Linear = 1,
        Srgb = 2,
    }
    /// Camera projection.
    Projection {
        Perspective = 0,
        Orthographic = 1,
    }
    /// Numerical integrator.
    Integrator {
        Euler = 0,
        Rk4 = 1,
        Implicit = 2,
        Implicitfast = 3,
    }
    /// Friction cone.
    Cone {
        Pyramidal = 0,
        Elliptic = 1,
    }
    /// Storage of the constraint Jacobian.
    Jacobian {
        Dense = 0,
        Sparse = 1,
        Auto = 2,
    }
    /// Constraint solver.
    Solver {
        Pgs = 0,
        Cg = 1,
        Newton = 2,
    }
    /// Type of equality constraint.
    EqType {
        Connect = 0,
        Weld = 1,
        Joint = 2,
        Tendon = 3,
        Flex = 4,
        Flexvert = 5,
        Flexstrain = 6,
        Distance = 7,
    }
    /// Element of a tendon path.
    WrapType {
        None = 0,
        Joint = 1,
        Pulley = 2,
        Site = 3,
        Sphere = 4,
        Cylinder = 5,
    }
    /// Actuator transmission.
    TrnType {
        Joint = 0,
        Jointinparent = 1,
        Slidercrank = 2,
        Tendon = 3,
        Site = 4,
        Body = 5,
        So3 = 6,
        Undefined = 1000,
    }
    /// Actuator dynamics.
    DynType {
        None = 0,
        Integrator = 1,
        Filter = 2,
        Filterexact = 3,
        Muscle = 4,
        Dcmotor = 5,
        Pid = 6,
        User = 7,
    }
    /// Actuator gain.
    GainType {
        Fixed = 0,
        Affine = 1,
        Muscle = 2,
        Dcmotor = 3,
        So3 = 4,
        Pid = 5,
        User = 6,
    }
    /// Actuator bias.
    BiasType {
        None = 0,
        Affine = 1,
        Muscle = 2,
        Dcmotor = 3,
        So3 = 4,
        User = 5,
    }
    /// Kind of model element.
    ObjType {
        Unknown = 0,
        Body = 1,
        Xbody = 2,
        Joint = 3,
        Dof = 4,
        Geom = 5,
        Site = 6,
        Camera = 7,
        Light = 8,
        Flex = 9,
        Mesh = 10,
        Skin = 11,
        Hfield = 12,
        Texture = 13,
        Material = 14,
        Pair = 15,
        Exclude = 16,
        Equality = 17,
        Tendon = 18,
        Actuator = 19,
        Sensor = 20,
        Numeric = 21,
        Text = 22,
        Tuple = 23,
        Key = 24,
        Plugin = 25,
        Frame = 100,
        Default = 101,
        Model = 102,
    }
    /// Type of sensor.
    SensorType {
        Touch = 0,
        Accelerometer = 1,
        Velocimeter = 2,
        Gyro = 3,
        Force = 4,
        Torque = 5,
        Magnetometer = 6,
        Rangefinder = 7,
        Camprojection = 8,
        Jointpos = 9,
        Jointvel = 10,
        Tendonpos = 11,
        Tendonvel = 12,
        Actuatorpos = 13,
        Actuatorvel = 14,
        Actuatorfrc = 15,
        Jointactfrc = 16,
        Tendonactfrc = 17,
        Ballquat = 18,
        Ballangvel = 19,
        Jointlimitpos = 20,
        Jointlimitvel = 21,
        Jointlimitfrc = 22,
        Tendonlimitpos = 23,
        Tendonlimitvel = 24,
        Tendonlimitfrc = 25,
        Framepos = 26,
        Framequat = 27,
        Framexaxis = 28,
        Frameyaxis = 29,
        Framezaxis = 30,
        Framelinvel = 31,
        Frameangvel = 32,
        Framelinacc = 33,
        Frameangacc = 34,
        Subtreecom = 35,
        Subtreelinvel = 36,
        Subtreeangmom = 37,
        Insidesite = 38,
        Geomdist = 39,
        Geomnormal = 40,
        Geomfromto = 41,
        Contact = 42,
        EPotential = 43,
        EKinetic = 44,
        Clock = 45,
        Tactile = 46,
        Plugin = 47,
        User = 48,
    }
    /// Stage of the computation.
    Stage {
        None = 0,
        Pos = 1,
        Vel = 2,
        Acc = 3,
    }
    /// Kind of sensor data.
    DataType {
        Real = 0,
        Positive = 1,
        Axis = 2,
        Quaternion = 3,
    }
    /// Alignment of a frame with its body.
    SameFrame {
        None = 0,
        Body = 1,
        Inertia = 2,
        Bodyrot = 3,
        Inertiarot = 4,
    }
    /// Sleep policy of a tree.
    SleepPolicy {
        Auto = 0,
        AutoNever = 1,
        AutoAllowed = 2,
        Never = 3,
        Allowed = 4,
        Init = 5,
    }
    /// Actuators whose length range is computed.
    LengthRangeMode {
        None = 0,
        Muscle = 1,
        Muscleuser = 2,
        All = 3,
    }
    /// How the elements of a flex that share no vertex are tested against each other.
    FlexSelf {
        None = 0,
        Narrow = 1,
        Bvh = 2,
        Sap = 3,
        Auto = 4,
    }
    /// Type of constraint row.
    ConstraintType {
        Equality = 0,
        FrictionDof = 1,
        FrictionTendon = 2,
        LimitJoint = 3,
        LimitTendon = 4,
        ContactFrictionless = 5,
        ContactPyramidal = 6,
        ContactElliptic = 7,
    }
    /// State of a constraint row.
    ConstraintState {
        Satisfied = 0,
        Quadratic = 1,
        Linearneg = 2,
        Linearpos = 3,
        Cone = 4,
    }
    /// Data field of a contact sensor.
    ContactField {
        Found = 0,
        Force = 1,
        Torque = 2,
        Dist = 3,
        Pos = 4,
        Normal = 5,
        Tangent = 6,
    }
    /// Data field of a rangefinder.
    RayField {
        Dist = 0,
        Dir = 1,
        Origin = 2,
        Point = 3,
        Normal = 4,
        Depth = 5,
    }
}

impl Default for ColorSpace {
    /// As the file says, linear if it does not.
    fn default() -> Self {
        ColorSpace::Auto
    }
}

/// Numerical bounds shared by all stages (documentation: `mjMINVAL` and its neighbours).
pub mod bounds {
    pub use crate::math::MINVAL;
    /// Largest magnitude of a position, velocity or acceleration.
    pub const MAXVAL: f64 = 1e10;
    /// Smallest friction coefficient.
    pub const MINMU: f64 = 1e-5;
    /// Smallest constraint impedance.
    pub const MINIMP: f64 = 1e-4;
    /// Largest constraint impedance.
    pub const MAXIMP: f64 = 0.9999;
    /// Most contacts one pair of geoms can make.
    pub const MAXCONPAIR: usize = 50;
}

/// What `actuator_ctrlspec` says of the controls of an actuator: bits of the inputs of a servo or motor in the order of
/// its controls, or the chart of the orientation that an so3 servo follows.
pub mod input {
    /// Bit: a position setpoint.
    pub const POSITION: i32 = 1;
    /// Bit: a velocity setpoint.
    pub const VELOCITY: i32 = 2;
    /// Bit: a force or torque to add.
    pub const FEED_FORWARD: i32 = 4;
    /// Bit: a terminal voltage.
    pub const VOLTAGE: i32 = 8;
    /// All bits of inputs.
    pub const ALL: i32 = POSITION | VELOCITY | FEED_FORWARD | VOLTAGE;
    /// No input.
    pub const NONE: i32 = 16;
    /// Chart: axis times angle, three numbers.
    pub const EXPONENTIAL_MAP: i32 = 1;
    /// Chart: a quaternion, four numbers.
    pub const QUATERNION: i32 = 2;
}
