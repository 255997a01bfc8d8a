//! Compiler settings, sizes and statistics (XML reference: `compiler`, `size`, `statistic`).

use crate::files::{base_name, join};
pub use physics::constants::length_range::LengthRangeOptions;

/// Whether body inertia comes from the geoms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum InertiaFromGeom {
    /// They do not: bodies without `inertial` have none.
    False,
    /// They do, whatever `inertial` says.
    True,
    /// Those of bodies without `inertial` do.
    #[default]
    Auto,
}

/// What happens when settings of an attached model differ from the settings of the model that attaches it.
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
pub struct Compiler {
    /// A range implies a limit.
    pub autolimits: bool,
    /// Least mass of a moving body, kg.
    pub boundmass: f64,
    /// Least moment of inertia of a moving body, kg m².
    pub boundinertia: f64,
    /// Total mass to scale to; not positive: off.
    pub settotalmass: f64,
    /// Repair impossible moments of inertia.
    pub balanceinertia: bool,
    /// Fit shapes to boxes instead of inertias.
    pub fitaabb: bool,
    /// Angles are in degrees instead of radians.
    pub degree: bool,
    /// Rotation order, lower case about moving axes, upper case about fixed axes.
    pub eulerseq: [u8; 3],
    /// Drop geoms without contact and mass.
    pub discardvisual: bool,
    /// Compile assets on all cores.
    pub usethread: bool,
    /// Merge bodies without joints into their parents.
    pub fusestatic: bool,
    /// Whether inertias follow from geoms.
    pub inertiafromgeom: InertiaFromGeom,
    /// Groups of geoms that have mass.
    pub inertiagrouprange: [i32; 2],
    /// Write inertias when saving.
    pub saveinertial: bool,
    /// Frames of free bodies move to their inertial frames.
    pub alignfree: bool,
    /// How length ranges of actuators are computed.
    pub lengthrange: LengthRangeOptions,
    /// Directory prefixes as written; the reader has applied them to asset files already.
    pub meshdir: String,
    /// Directory of textures.
    pub texturedir: String,
    /// Ignore directories in file names.
    pub strippath: bool,
    /// What becomes of settings that differ from an attached model's.
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

impl Compiler {
    /// What is opened for the file of an asset that a model in `folder` calls `name`, in the directory `dir` of such files,
    /// and the path that the model records.
    pub fn asset_file(&self, folder: &str, dir: &str, name: &str) -> (String, String) {
        if name.is_empty() {
            return (String::new(), String::new());
        }
        let name = if self.strippath { base_name(name) } else { name };
        let path = if self.strippath { name.to_owned() } else { join("", name) };
        (join(folder, &join(dir, name)), path)
    }
}

/// Array sizes (`size`); `None` lets the compiler choose.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Size {
    /// Where the element stands in the sources.
    pub loc: crate::diagnostic::Loc,
    /// Bytes of memory, which is allocated as needed whatever this says; `None` when not given.
    pub memory: Option<i64>,
    /// Older limit on constraints.
    pub njmax: Option<i32>,
    /// Older limit on contacts.
    pub nconmax: Option<i32>,
    /// Older limit on memory, without effect.
    pub nstack: Option<i64>,
    /// User numbers of the state.
    pub nuserdata: i32,
    /// Keyframes.
    pub nkey: i32,
    /// User numbers of a body.
    pub nuser_body: Option<i32>,
    /// User numbers of a joint.
    pub nuser_jnt: Option<i32>,
    /// User numbers of a geom.
    pub nuser_geom: Option<i32>,
    /// User numbers of a site.
    pub nuser_site: Option<i32>,
    /// User numbers of a camera.
    pub nuser_cam: Option<i32>,
    /// User numbers of a tendon.
    pub nuser_tendon: Option<i32>,
    /// User numbers of an actuator.
    pub nuser_actuator: Option<i32>,
    /// User numbers of a sensor.
    pub nuser_sensor: Option<i32>,
}

/// Statistics set by the file (`statistic`); `None` is computed at `qpos0`.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct StatisticOverride {
    /// Mean diagonal of the inertia matrix.
    pub meaninertia: Option<f64>,
    /// Mean mass of bodies, kg.
    pub meanmass: Option<f64>,
    /// Mean size of bodies, metres.
    pub meansize: Option<f64>,
    /// Half size of the model, metres.
    pub extent: Option<f64>,
    /// Centre of the model, metres.
    pub center: Option<[f64; 3]>,
}

crate::spec::field::fields!(Compiler: autolimits boundmass boundinertia settotalmass balanceinertia fitaabb degree eulerseq
    discardvisual usethread fusestatic inertiafromgeom inertiagrouprange saveinertial alignfree meshdir texturedir
    conflict);
crate::spec::field::fields!(Size: memory njmax nconmax nstack nuserdata nkey nuser_body nuser_jnt nuser_geom nuser_site
    nuser_cam nuser_tendon nuser_actuator nuser_sensor);
crate::spec::field::fields!(StatisticOverride: meaninertia meanmass meansize extent center);
crate::spec::field::fields!(LengthRangeOptions: mode useexisting uselimit accel maxforce timeconst timestep inttotal
    interval tolrange);
