//! Compiler settings, sizes and statistics (XML reference: `compiler`, `size`, `statistic`).

pub use physics::constants::length_range::LengthRangeOptions;

/// Whether body inertia comes from the geoms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[allow(missing_docs)]
pub enum InertiaFromGeom {
    False,
    True,
    #[default]
    Auto,
}

/// What becomes of settings of an attached model that differ from those of the model that attaches it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Conflict {
    /// The attaching model's stand, with a warning.
    #[default]
    Warning,
    /// Both are combined where that is possible, with a warning.
    Merge,
    /// An error where both models give a value.
    Error,
}

/// Compiler settings (`compiler`).
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct Compiler {
    pub autolimits: bool,
    pub boundmass: f64,
    pub boundinertia: f64,
    /// Total mass to scale to; not positive: off.
    pub settotalmass: f64,
    pub balanceinertia: bool,
    pub fitaabb: bool,
    pub degree: bool,
    /// Rotation order, lower case about moving axes, upper case about fixed axes.
    pub eulerseq: [u8; 3],
    pub discardvisual: bool,
    pub usethread: bool,
    pub fusestatic: bool,
    pub inertiafromgeom: InertiaFromGeom,
    pub inertiagrouprange: [i32; 2],
    pub saveinertial: bool,
    pub alignfree: bool,
    pub lengthrange: LengthRangeOptions,
    /// Directory prefixes as written; the reader has applied them to asset files already.
    pub meshdir: String,
    pub texturedir: String,
    pub strippath: bool,
    pub conflict: Conflict,
}

impl Default for Compiler {
    fn default() -> Self {
        Self {
            autolimits: true,
            boundmass: 0.0,
            boundinertia: 0.0,
            settotalmass: -1.0,
            balanceinertia: false,
            fitaabb: false,
            degree: true,
            eulerseq: *b"xyz",
            discardvisual: false,
            usethread: true,
            fusestatic: false,
            inertiafromgeom: InertiaFromGeom::Auto,
            inertiagrouprange: [0, 5],
            saveinertial: false,
            alignfree: false,
            lengthrange: LengthRangeOptions::default(),
            meshdir: String::new(),
            texturedir: String::new(),
            strippath: false,
            conflict: Conflict::Warning,
        }
    }
}

/// Array sizes (`size`); `None` lets the compiler choose.
#[derive(Clone, Debug, PartialEq, Default)]
#[allow(missing_docs)]
pub struct Size {
    pub memory: Option<i64>,
    pub njmax: Option<i32>,
    pub nconmax: Option<i32>,
    pub nstack: Option<i64>,
    pub nuserdata: i32,
    pub nkey: i32,
    pub nuser_body: Option<i32>,
    pub nuser_jnt: Option<i32>,
    pub nuser_geom: Option<i32>,
    pub nuser_site: Option<i32>,
    pub nuser_cam: Option<i32>,
    pub nuser_tendon: Option<i32>,
    pub nuser_actuator: Option<i32>,
    pub nuser_sensor: Option<i32>,
}

/// Statistics set by the file (`statistic`); `None` is computed at `qpos0`.
#[derive(Clone, Debug, PartialEq, Default)]
#[allow(missing_docs)]
pub struct StatisticOverride {
    pub meaninertia: Option<f64>,
    pub meanmass: Option<f64>,
    pub meansize: Option<f64>,
    pub extent: Option<f64>,
    pub center: Option<[f64; 3]>,
}
