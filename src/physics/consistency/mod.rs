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
mod requirement;
mod skin;
mod tree;

pub use requirement::Inconsistent;

use crate::arrays::Arrays;
use requirement::{ranges, references, require, spans, within};

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
