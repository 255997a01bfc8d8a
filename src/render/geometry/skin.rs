//! Skins: surfaces whose vertices follow bodies (MuJoCo documentation, XML reference, "deformable/skin").

use super::surface::Surface;
use crate::error::RenderError;
use physics::math::{Mat3, Vec3, add, cross, mul_mat_vec, quat_mul, quat_to_mat, sub};
use physics::model::ObjType;
use physics::model::bounds::MINVAL;
use physics::{Data, Model};
use std::ops::Range;

/// The triangles of a skin, in the world. They have no place before a state gives them one.
pub(super) fn unposed(model: &Model, skin: usize) -> Surface {
    let textured = model.skin_texcoordadr[skin] >= 0;
    let texcoords = range(model.skin_texcoordadr[skin], model.skin_vertnum[skin]);
    let mut surface = Surface::default();
    if textured {
        surface.texcoords = model.skin_texcoord[texcoords].to_vec();
    }
    for face in &model.skin_face[range(model.skin_faceadr[skin], model.skin_facenum[skin])] {
        let rows = face.map(|vertex| vertex as u32);
        surface.push(rows, rows, if textured { rows } else { [0; 3] });
    }
    surface.positions = vec![[0.0; 3]; model.skin_vertnum[skin].max(0) as usize];
    surface.normals = surface.positions.clone();
    surface.finish();
    surface
}

/// The skin with its vertices where the bodies put them; none where they are there already.
///
/// # Errors
/// [`RenderError::NotFinite`] where a vertex is nowhere.
pub(super) fn posed(
    model: &Model,
    data: &Data,
    skin: usize,
    last: &Surface,
) -> Result<Option<Surface>, RenderError> {
    let mut positions = vertices(model, data, skin);
    let normals = normals(&positions, &last.faces);
    let inflate = model.skin_inflate[skin];
    if inflate != 0.0 {
        for (p, n) in positions.iter_mut().zip(&normals) {
            (0..3).for_each(|k| p[k] += inflate * n[k]);
        }
    }
    if !positions.as_flattened().iter().all(|x| x.is_finite()) {
        return Err(RenderError::NotFinite { what: model.label_of(ObjType::Skin, skin) });
    }
    if positions == last.positions && normals == last.normals {
        return Ok(None);
    }
    let mut surface = Surface {
        positions,
        normals,
        texcoords: last.texcoords.clone(),
        faces: last.faces.clone(),
        corners: last.corners.clone(),
        outlines: last.outlines.clone(),
        ..Surface::default()
    };
    surface.finish();
    Ok(Some(surface))
}

/// Vertices moved by the bones, each by its weight, world frame \[m\].
fn vertices(model: &Model, data: &Data, skin: usize) -> Vec<[f32; 3]> {
    let rest = &model.skin_vert[range(model.skin_vertadr[skin], model.skin_vertnum[skin])];
    let mut moved = vec![[0.0_f32; 3]; rest.len()];
    for bone in range(model.skin_boneadr[skin], model.skin_bonenum[skin]) {
        let (turn, shift) = motion(model, data, bone);
        for k in range(model.skin_bonevertadr[bone], model.skin_bonevertnum[bone]) {
            let (vertex, weight) = (model.skin_bonevertid[k] as usize, model.skin_bonevertweight[k]);
            let place = add(mul_mat_vec(&turn, rest[vertex].map(f64::from)), shift);
            (0..3).for_each(|axis| moved[vertex][axis] += weight * place[axis] as f32);
        }
    }
    moved
}

/// How a bone has moved since the bind pose: first turned, then shifted.
fn motion(model: &Model, data: &Data, bone: usize) -> (Mat3, Vec3) {
    let body = model.skin_bonebodyid[bone] as usize;
    let [w, x, y, z] = model.skin_bonebindquat[bone].map(f64::from);
    let turn = quat_to_mat(quat_mul(data.kin.xquat[body], [w, -x, -y, -z]));
    let bound = model.skin_bonebindpos[bone].map(f64::from);
    (turn, sub(data.kin.xpos[body], mul_mat_vec(&turn, bound)))
}

/// Unit normals of vertices, the sum of the triangles' by area; single precision, as MuJoCo adds them up.
fn normals(positions: &[[f32; 3]], faces: &[[u32; 3]]) -> Vec<[f32; 3]> {
    let mut normals = vec![[0.0_f32; 3]; positions.len()];
    for face in faces {
        let [a, b, c] = face.map(|row| positions[row as usize]);
        let side = |p: [f32; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]].map(f64::from);
        let area = cross(side(b), side(c));
        for row in face {
            let sum = &mut normals[*row as usize];
            (0..3).for_each(|k| sum[k] = (f64::from(sum[k]) + area[k]) as f32);
        }
    }
    for n in &mut normals {
        let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
        let scale = (1.0 / f64::from(length).max(MINVAL)) as f32;
        *n = n.map(|x| x * scale);
    }
    normals
}

fn range(first: i32, count: i32) -> Range<usize> {
    let first = first.max(0) as usize;
    first..first + count.max(0) as usize
}
