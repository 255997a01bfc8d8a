//! Assets.

use super::plugin;
use super::rows::{put_rows, put_some};
use super::text::{element, numbers};
use crate::schema::asset::{
    BONE_ROWS, HFIELD_ROWS, MATERIAL_ROWS, MESH_ROWS, ROLES, SIDES, SKIN_ROWS, TEXTURE_ROWS,
};
use crate::spec::{Bone, Hfield, Material, Mesh, Skin, Spec, Texture};
use crate::xml::Element;

pub(super) fn assets(spec: &Spec) -> Element {
    let mut out = element("asset");
    out.children.extend(spec.textures.iter().map(texture));
    out.children.extend(spec.materials.iter().map(material));
    out.children.extend(spec.meshes.iter().map(mesh));
    out.children.extend(spec.hfields.iter().map(hfield));
    out
}

fn put_file(out: &mut Element, path: &str) {
    if !path.is_empty() {
        out.put("file", path);
    }
}

pub(super) fn mesh(mesh: &Mesh) -> Element {
    let mut out = element("mesh");
    put_rows(&mut out, &MESH_ROWS, mesh, &Mesh::default());
    put_file(&mut out, &mesh.path);
    out.children.extend(plugin::child(mesh.plugin.as_ref()));
    out
}

pub(super) fn skin(skin: &Skin) -> Element {
    let mut out = element("skin");
    put_rows(&mut out, &SKIN_ROWS, skin, &Skin::default());
    put_file(&mut out, &skin.path);
    for bone in &skin.bones {
        let mut child = element("bone");
        put_rows(&mut child, &BONE_ROWS, bone, &Bone::default());
        out.children.push(child);
    }
    out
}

pub(super) fn hfield(hfield: &Hfield) -> Element {
    let mut out = element("hfield");
    put_some(&mut out, &HFIELD_ROWS, hfield, &Hfield::default(), &|name| name != "elevation");
    put_file(&mut out, &hfield.path);
    // The text runs from the far row to the near one, data from the near row on.
    if let (true, Ok(columns @ 1..)) = (hfield.path.is_empty(), usize::try_from(hfield.ncol)) {
        let rows: Vec<f32> = hfield.userdata.chunks(columns).rev().flatten().copied().collect();
        if !rows.is_empty() {
            out.put("elevation", numbers(&rows));
        }
    }
    out
}

pub(super) fn texture(texture: &Texture) -> Element {
    let mut out = element("texture");
    put_rows(&mut out, &TEXTURE_ROWS, texture, &Texture::default());
    put_file(&mut out, &texture.path);
    for (side, file) in SIDES.iter().zip(&texture.cubepaths) {
        if !file.is_empty() {
            out.put(side, file);
        }
    }
    let cells = i64::from(texture.gridsize[0]) * i64::from(texture.gridsize[1]);
    let cells = usize::try_from(cells).unwrap_or(0).min(texture.gridlayout.len());
    if texture.gridlayout != Texture::default().gridlayout {
        out.put("gridlayout", &texture.gridlayout[..cells]);
    }
    out
}

/// One texture of the surface colour is an attribute; other roles are layers.
pub(super) fn material(material: &Material) -> Element {
    let mut out = element("material");
    let layered = material.textures.iter().enumerate().any(|(role, name)| role != 1 && !name.is_empty());
    put_some(&mut out, &MATERIAL_ROWS, material, &Material::default(), &|name| !layered || name != "texture");
    for (word, role) in ROLES.iter().filter(|_| layered) {
        let texture = &material.textures[*role as usize];
        if !texture.is_empty() {
            let mut layer = element("layer");
            layer.put("texture", texture);
            layer.put("role", *word);
            out.children.push(layer);
        }
    }
    out
}
