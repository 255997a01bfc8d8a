//! The name buffer, its hash table, and the paths of asset files.

use super::assets::{Asset, Assets};
use super::elements::sorted_names;
use super::lookup::Lookup;
use super::nodes::Tree;
use super::plugins::Plugins;
use crate::spec::Spec;
use physics::model::{ObjType, Rows};

/// Fills names, hash table and paths.
pub(super) fn fill(
    m: &mut Rows,
    (spec, plugins): (&Spec, &Plugins),
    tree: &Tree,
    assets: &Assets,
    lookup: &Lookup,
) {
    m.names.extend(spec.modelname.bytes());
    m.names.push(0);
    let pairs = sorted_names(spec, m, ObjType::Pair, lookup);
    let excludes = sorted_names(spec, m, ObjType::Exclude, lookup);
    macro_rules! list {
        ($field:ident, $names:expr) => {
            let names: Vec<&str> = $names.collect();
            m.$field = append(&mut m.names, &names);
            append_table(&mut m.names_map, &names);
        };
    }
    list!(name_bodyadr, tree.bodies.iter().map(|b| b.name()));
    list!(name_jntadr, tree.joints().map(|j| &*j.spec.name));
    list!(name_geomadr, tree.geoms().map(|g| &*g.spec.name));
    list!(name_siteadr, tree.sites().map(|s| &*s.spec.name));
    list!(name_camadr, tree.cameras().map(|c| &*c.spec.name));
    list!(name_lightadr, tree.lights().map(|l| &*l.spec.name));
    list!(name_flexadr, spec.flexes.iter().map(|f| &*f.name));
    list!(name_meshadr, assets.meshes.iter().map(|a| &*a.name));
    list!(name_skinadr, assets.skins.iter().map(|a| &*a.name));
    list!(name_hfieldadr, assets.hfields.iter().map(|a| &*a.name));
    list!(name_texadr, assets.textures.iter().map(|a| &*a.name));
    list!(name_matadr, assets.materials.iter().map(|a| &*a.name));
    list!(name_pairadr, pairs.iter().map(|n| &**n));
    list!(name_excludeadr, excludes.iter().map(|n| &**n));
    list!(name_eqadr, spec.equalities.iter().map(|e| &*e.name));
    list!(name_tendonadr, spec.tendons.iter().map(|t| &*t.name));
    list!(name_actuatoradr, spec.actuators.iter().map(|a| &*a.name));
    list!(name_sensoradr, spec.sensors.iter().map(|s| &*s.name));
    list!(name_numericadr, spec.numerics.iter().map(|n| &*n.name));
    list!(name_textadr, spec.texts.iter().map(|t| &*t.name));
    list!(name_tupleadr, spec.tuples.iter().map(|t| &*t.name));
    list!(name_keyadr, super::keyframe::names(spec).map(|(name, _)| name));
    list!(name_pluginadr, plugins.list.iter().map(|one| &*one.name));
    m.hfield_pathadr = append_paths(&mut m.paths, &assets.hfields);
    m.mesh_pathadr = append_paths(&mut m.paths, &assets.meshes);
    m.skin_pathadr = append_paths(&mut m.paths, &assets.skins);
    m.tex_pathadr = append_paths(&mut m.paths, &assets.textures);
    if m.paths.is_empty() {
        m.paths.push(0);
    }
}

fn append(buffer: &mut Vec<u8>, names: &[&str]) -> Vec<i32> {
    let mut addresses = Vec::with_capacity(names.len());
    for name in names {
        addresses.push(buffer.len() as i32);
        buffer.extend(name.bytes());
        buffer.push(0);
    }
    addresses
}

/// Appends a hash table with two slots an element, open addressing, -1 for empty slots.
fn append_table(map: &mut Vec<i32>, names: &[&str]) {
    let size = 2 * names.len();
    let mut table = vec![-1; size];
    for (id, name) in names.iter().enumerate().filter(|(_, name)| !name.is_empty()) {
        let mut slot = (hash(name) % size as u64) as usize;
        while table[slot] != -1 {
            slot = (slot + 1) % size;
        }
        table[slot] = id as i32;
    }
    map.extend(table);
}

/// Bernstein's string hash, xor variant; bytes are signed as C characters are.
fn hash(name: &str) -> u64 {
    name.bytes().fold(5381, |h: u64, byte| (h << 5).wrapping_add(h) ^ byte as i8 as u64)
}

fn append_paths<T>(paths: &mut Vec<u8>, assets: &[Asset<T>]) -> Vec<i32> {
    let mut addresses = Vec::with_capacity(assets.len());
    for asset in assets {
        addresses.push(if asset.path.is_empty() { -1 } else { paths.len() as i32 });
        if !asset.path.is_empty() {
            paths.extend(asset.path.bytes());
            paths.push(0);
        }
    }
    addresses
}
