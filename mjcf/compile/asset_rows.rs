//! The rows that assets fill.

use super::assets::{Asset, Assets};
use super::log::{Log, title};
use super::lookup::Lookup;
use crate::diagnostic::Loc;
use crate::mesh::{CompiledMesh, CompiledSkin};
use crate::spec::{Skin, Spec};
use physics::model::{ObjType, Rows};

/// Appends all assets except their hierarchies, which stand behind the hierarchies of bodies.
pub(super) fn fill(m: &mut Rows, assets: &Assets, spec: &Spec, lookup: &Lookup, log: &mut Log) {
    m.tex_data.reserve_exact(assets.textures.iter().map(|asset| asset.compiled.data.len()).sum());
    let total =
        |count: fn(&CompiledMesh) -> usize| assets.meshes.iter().map(|asset| count(&asset.compiled)).sum();
    m.mesh_vert.reserve_exact(total(|mesh| mesh.vert.len()));
    m.mesh_normal.reserve_exact(total(|mesh| mesh.normal.len()));
    for rows in [&mut m.mesh_face, &mut m.mesh_facenormal, &mut m.mesh_facetexcoord] {
        rows.reserve_exact(total(|mesh| mesh.face.len()));
    }
    assets.meshes.iter().for_each(|asset| fill_mesh(m, &asset.compiled));
    for asset in &assets.hfields {
        let hfield = &asset.compiled;
        m.hfield_size.push(hfield.size);
        m.hfield_nrow.push(hfield.nrow as i32);
        m.hfield_ncol.push(hfield.ncol as i32);
        m.hfield_adr.push(m.hfield_data.len() as i32);
        m.hfield_data.extend(&hfield.data);
    }
    for (asset, skin) in assets.skins.iter().zip(&spec.skins) {
        fill_skin(m, asset, skin, lookup, log);
    }
    for (asset, texture) in assets.textures.iter().zip(&spec.textures) {
        let t = &asset.compiled;
        m.tex_type.push(texture.kind.code());
        m.tex_colorspace.push(t.colorspace.code());
        m.tex_height.push(t.height as i32);
        m.tex_width.push(t.width as i32);
        m.tex_nchannel.push(t.nchannel as i32);
        m.tex_adr.push(m.tex_data.len() as i64);
        m.tex_data.extend(&t.data);
    }
    for material in spec.materials.iter().take(assets.materials.len()) {
        let what = title("material", &material.name);
        m.mat_texid.push(std::array::from_fn(|role| {
            lookup.reference(ObjType::Texture, &material.textures[role], material.loc, &what, log)
        }));
        m.mat_texuniform.push(material.texuniform);
        m.mat_texrepeat.push(material.texrepeat);
        m.mat_emission.push(material.emission);
        m.mat_specular.push(material.specular);
        m.mat_shininess.push(material.shininess);
        m.mat_reflectance.push(material.reflectance);
        m.mat_metallic.push(material.metallic);
        m.mat_roughness.push(material.roughness);
        m.mat_rgba.push(material.rgba);
    }
}

fn fill_skin(m: &mut Rows, asset: &Asset<CompiledSkin>, spec: &Skin, lookup: &Lookup, log: &mut Log) {
    let (skin, what) = (&asset.compiled, title("skin", &asset.name));
    m.skin_matid.push(lookup.reference(ObjType::Material, &asset.material, asset.loc, &what, log));
    m.skin_group.push(spec.group);
    m.skin_rgba.push(spec.rgba);
    m.skin_inflate.push(spec.inflate);
    m.skin_vertadr.push(m.skin_vert.len() as i32);
    m.skin_vertnum.push(skin.vert.len() as i32);
    m.skin_texcoordadr.push(if skin.texcoord.is_empty() { -1 } else { m.skin_texcoord.len() as i32 });
    m.skin_faceadr.push(m.skin_face.len() as i32);
    m.skin_facenum.push(skin.face.len() as i32);
    m.skin_boneadr.push(m.skin_bonebodyid.len() as i32);
    m.skin_bonenum.push(skin.bones.len() as i32);
    m.skin_vert.extend(&skin.vert);
    m.skin_texcoord.extend(&skin.texcoord);
    m.skin_face.extend(&skin.face);
    for bone in &skin.bones {
        // The bones of a file have no place in the text.
        let loc = if bone.loc == Loc::NONE { asset.loc } else { bone.loc };
        let body = lookup.require(ObjType::Body, &bone.body, loc, &what, log);
        m.skin_bonebodyid.push(body.map_or(0, |id| id as i32));
        m.skin_bonebindpos.push(bone.bindpos);
        m.skin_bonebindquat.push(bone.bindquat);
        m.skin_bonevertadr.push(m.skin_bonevertid.len() as i32);
        m.skin_bonevertnum.push(bone.vertid.len() as i32);
        m.skin_bonevertid.extend(&bone.vertid);
        m.skin_bonevertweight.extend(&bone.vertweight);
    }
}

fn fill_mesh(m: &mut Rows, mesh: &CompiledMesh) {
    let address = |count: usize, next: usize| if count == 0 { -1 } else { next as i32 };
    m.mesh_vertadr.push(m.mesh_vert.len() as i32);
    m.mesh_vertnum.push(mesh.vert.len() as i32);
    m.mesh_faceadr.push(m.mesh_face.len() as i32);
    m.mesh_facenum.push(mesh.face.len() as i32);
    m.mesh_octadr.push(address(mesh.octree.depth.len(), m.oct_depth.len()));
    m.mesh_octnum.push(mesh.octree.depth.len() as i32);
    m.oct_depth.extend(&mesh.octree.depth);
    m.oct_child.extend(&mesh.octree.child);
    m.oct_aabb.extend(&mesh.octree.aabb);
    m.oct_coeff.extend(&mesh.octree.coeff);
    m.mesh_normaladr.push(m.mesh_normal.len() as i32);
    m.mesh_normalnum.push(mesh.normal.len() as i32);
    m.mesh_texcoordadr.push(address(mesh.texcoord.len(), m.mesh_texcoord.len()));
    m.mesh_texcoordnum.push(mesh.texcoord.len() as i32);
    m.mesh_graphadr.push(address(mesh.graph.len(), m.mesh_graph.len()));
    m.mesh_extrema.push(mesh.extrema);
    m.mesh_polyadr.push(m.mesh_polynormal.len() as i32);
    m.mesh_polynum.push(mesh.poly_normal.len() as i32);
    m.mesh_scale.push(mesh.scale);
    m.mesh_pos.push(mesh.pos);
    m.mesh_quat.push(mesh.quat);
    let (first_vert, first_map) = (m.mesh_polyvert.len() as i32, m.mesh_polymap.len() as i32);
    m.mesh_polyvertadr.extend(mesh.poly_vertadr.iter().map(|a| a + first_vert));
    m.mesh_polyvertnum.extend(&mesh.poly_vertnum);
    m.mesh_polyvert.extend(&mesh.poly_vert);
    m.mesh_polymapadr.extend(mesh.poly_mapadr.iter().map(|a| a + first_map));
    m.mesh_polymapnum.extend(&mesh.poly_mapnum);
    m.mesh_polymap.extend(&mesh.poly_map);
    m.mesh_polynormal.extend(&mesh.poly_normal);
    m.mesh_vert.extend(&mesh.vert);
    m.mesh_normal.extend(&mesh.normal);
    m.mesh_texcoord.extend(&mesh.texcoord);
    m.mesh_face.extend(&mesh.face);
    m.mesh_facenormal.extend(&mesh.facenormal);
    m.mesh_facetexcoord.extend(&mesh.facetexcoord);
    m.mesh_graph.extend(&mesh.graph);
}
