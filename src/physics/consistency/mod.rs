//! The invariants between the arrays of a model: every reference leads to an element, every address into its array,
//! trees and paths are well formed. The compiler makes such models; what comes from a file is checked.
//!
//! ```
//! use robohive_physics::model::EditError;
//!
//! let mut model = robohive_mjcf::load_str("<mujoco><worldbody><geom size='.1'/></worldbody></mujoco>")?.model;
//! match model.edit(|m| m.geom_bodyid[0] = 7) {
//!     Err(EditError::Inconsistent(what)) => assert_eq!((what.array, what.index), ("geom_bodyid", 0)),
//!     other => panic!("{other:?}"),
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod device;
mod flex;
mod mesh;
mod patterns;
mod skin;
mod tree;

use crate::model::{Arrays, ObjType};
use crate::table::{Field, Slice};
use std::fmt;

/// An array that contradicts another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Inconsistent {
    /// Name of the array.
    pub array: &'static str,
    /// Place in it, rows flattened.
    pub index: usize,
    /// What it should be.
    pub expected: &'static str,
}

impl fmt::Display for Inconsistent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}] is not {}", self.array, self.index, self.expected)
    }
}

impl std::error::Error for Inconsistent {}

/// Checks all references and addresses, once every array has the size that the table of fields says.
///
/// # Errors
/// The first array found to contradict another.
pub fn check_consistency(m: &Arrays) -> Result<(), Inconsistent> {
    check_sizes(m)?;
    tree::check(m)?;
    plain_references(m)?;
    mesh::check(m)?;
    skin::check(m)?;
    flex::check(m)?;
    device::check(m)?;
    patterns::check(m)
}

/// Checks types, meshes and contact dimensions of geoms and pairs.
///
/// # Errors
/// As [`check_consistency`].
pub(crate) fn check_geoms(m: &Arrays) -> Result<(), Inconsistent> {
    mesh::geoms(m)?;
    dimensions(m)
}

/// Checks that types, parameters and targets of actuators fit each other.
///
/// # Errors
/// As [`check_consistency`].
pub(crate) fn check_actuators(m: &Arrays) -> Result<(), Inconsistent> {
    device::actuators(m)
}

/// Refuses unless `holds`.
fn require(
    holds: bool,
    array: &'static str,
    index: usize,
    expected: &'static str,
) -> Result<(), Inconsistent> {
    if holds { Ok(()) } else { Err(Inconsistent { array, index, expected }) }
}

/// Every value is at least `least` and below `end`.
fn within(array: &'static str, field: &impl Field, least: i32, end: usize) -> Result<(), Inconsistent> {
    let Slice::I32(values) = field.scalars() else { return Ok(()) };
    match values.iter().position(|&x| x < least || (x >= 0 && x as usize >= end)) {
        Some(index) => Err(Inconsistent { array, index, expected: "a reference to an element" }),
        None => Ok(()),
    }
}

/// Every range of `count` items from `first` lies in an array of `total`. An empty range may begin at -1.
fn spans(
    array: &'static str,
    first: &[i32],
    count: impl Fn(usize) -> i64,
    total: usize,
) -> Result<(), Inconsistent> {
    for (index, &first) in first.iter().enumerate() {
        let count = count(index);
        let fits = first >= 0 && count >= 0 && count <= total as i64 - i64::from(first);
        require(fits || (first == -1 && count == 0), array, index, "the address of a range in its array")?;
    }
    Ok(())
}

/// [`within`] for fields by name.
macro_rules! references {
    ($m:ident: $($field:ident $least:literal $end:expr;)*) => {
        $(within(stringify!($field), &$m.$field, $least, $end)?;)*
    };
}

/// [`spans`] for fields by name.
macro_rules! ranges {
    ($m:ident: $($first:ident $count:ident $total:expr;)*) => {
        $(spans(stringify!($first), &$m.$first, |i| i64::from($m.$count[i]), $total)?;)*
    };
}

use {ranges, references};

/// Sizes that contradict the arrays.
fn check_sizes(m: &Arrays) -> Result<(), Inconsistent> {
    require(m.nbody > 0, "nbody", 0, "at least the world")?;
    let nodes = m.nbvhstatic.checked_add(m.nbvhdynamic);
    require(nodes == Some(m.nbvh), "nbvhstatic", 0, "the number of all nodes but those of flexes")?;
    let lengths = [
        ("nsensordata", m.nsensordata, m.sensor_dim.iter().map(|&dim| i64::from(dim)).sum::<i64>()),
        ("nhistory", m.nhistory, device::history_length(m)),
        ("na", m.na, m.actuator_actnum.iter().map(|&n| i64::from(n)).sum()),
    ];
    for (name, size, expected) in lengths {
        require(i64::try_from(size) == Ok(expected), name, 0, "the sum of its parts")?;
    }
    let unbacked = [
        ("nsensordata", m.nsensordata),
        ("nhistory", m.nhistory),
        ("na", m.na),
        ("nuserdata", m.nuserdata),
        ("npluginstate", m.npluginstate),
    ];
    unbacked.into_iter().try_for_each(|(name, n)| require(n <= 1 << 24, name, 0, "at most 2^24"))
}

/// How many elements of a kind there are.
fn count(m: &Arrays, kind: i32) -> usize {
    match ObjType::from_code(kind) {
        Some(ObjType::Body | ObjType::Xbody) => m.nbody,
        Some(ObjType::Joint) => m.njnt,
        Some(ObjType::Dof) => m.nv,
        Some(ObjType::Geom) => m.ngeom,
        Some(ObjType::Site) => m.nsite,
        Some(ObjType::Camera) => m.ncam,
        Some(ObjType::Light) => m.nlight,
        Some(ObjType::Flex) => m.nflex,
        Some(ObjType::Mesh) => m.nmesh,
        Some(ObjType::Skin) => m.nskin,
        Some(ObjType::Hfield) => m.nhfield,
        Some(ObjType::Texture) => m.ntex,
        Some(ObjType::Material) => m.nmat,
        Some(ObjType::Pair) => m.npair,
        Some(ObjType::Exclude) => m.nexclude,
        Some(ObjType::Equality) => m.neq,
        Some(ObjType::Tendon) => m.ntendon,
        Some(ObjType::Actuator) => m.nactuator,
        Some(ObjType::Sensor) => m.nsensor,
        Some(ObjType::Numeric) => m.nnumeric,
        Some(ObjType::Text) => m.ntext,
        Some(ObjType::Tuple) => m.ntuple,
        Some(ObjType::Key) => m.nkey,
        Some(ObjType::Plugin) => m.nplugin,
        _ => 0,
    }
}

/// References that need no more than the size of what they point into.
fn plain_references(m: &Arrays) -> Result<(), Inconsistent> {
    references! { m:
        jnt_actuatorid -2 m.nactuator;
        geom_bodyid 0 m.nbody;
        geom_matid -1 m.nmat;
        site_bodyid 0 m.nbody;
        site_matid -1 m.nmat;
        cam_bodyid 0 m.nbody;
        cam_targetbodyid -1 m.nbody;
        light_bodyid 0 m.nbody;
        light_targetbodyid -1 m.nbody;
        light_texid -1 m.ntex;
        mat_texid -1 m.ntex;
        pair_geom1 0 m.ngeom;
        pair_geom2 0 m.ngeom;
        tendon_matid -1 m.nmat;
        tendon_actuatorid -2 m.nactuator;
        tendon_treeid -1 m.ntree;
        mesh_pathadr -1 m.npaths;
        skin_matid -1 m.nmat;
        skin_bonebodyid 0 m.nbody;
        skin_pathadr -1 m.npaths;
        hfield_pathadr -1 m.npaths;
        tex_pathadr -1 m.npaths;
        name_bodyadr 0 m.nnames;
        name_jntadr 0 m.nnames;
        name_geomadr 0 m.nnames;
        name_siteadr 0 m.nnames;
        name_camadr 0 m.nnames;
        name_lightadr 0 m.nnames;
        name_flexadr 0 m.nnames;
        name_meshadr 0 m.nnames;
        name_skinadr 0 m.nnames;
        name_hfieldadr 0 m.nnames;
        name_texadr 0 m.nnames;
        name_matadr 0 m.nnames;
        name_pairadr 0 m.nnames;
        name_excludeadr 0 m.nnames;
        name_eqadr 0 m.nnames;
        name_tendonadr 0 m.nnames;
        name_actuatoradr 0 m.nnames;
        name_sensoradr 0 m.nnames;
        name_numericadr 0 m.nnames;
        name_textadr 0 m.nnames;
        name_tupleadr 0 m.nnames;
        name_keyadr 0 m.nnames;
        name_pluginadr 0 m.nnames;
        body_plugin -1 m.nplugin;
        geom_plugin -1 m.nplugin;
        actuator_plugin -1 m.nplugin;
        sensor_plugin -1 m.nplugin;
        plugin_attradr 0 m.npluginattr;
    }
    ranges! { m:
        numeric_adr numeric_size m.nnumericdata;
        text_adr text_size m.ntextdata;
        tuple_adr tuple_size m.ntupledata;
        tendon_adr tendon_num m.nwrap;
        ten_J_rowadr ten_J_rownnz m.nJten;
        plugin_stateadr plugin_statenum m.npluginstate;
    }
    dimensions(m)
}

/// Contacts have one of four dimensions.
fn dimensions(m: &Arrays) -> Result<(), Inconsistent> {
    let flexes = m.flex_condim.iter().map(|d| ("flex_condim", d));
    let dims = m.geom_condim.iter().map(|d| ("geom_condim", d)).chain(flexes);
    for (i, (array, dim)) in dims.chain(m.pair_dim.iter().map(|d| ("pair_dim", d))).enumerate() {
        require([1, 3, 4, 6].contains(dim), array, i, "a contact dimension")?;
    }
    Ok(())
}
