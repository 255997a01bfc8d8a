//! Meshes of the model.

use super::surface::{Surface, face_normal};

/// The rows of a model's arrays that belong to one mesh.
#[derive(Clone, Copy)]
pub(super) struct MeshRows<'a> {
    /// Vertices.
    pub vertices: &'a [[f32; 3]],
    /// Vertex normals.
    pub normals: &'a [[f32; 3]],
    /// Texture coordinates; empty for none.
    pub texcoords: &'a [[f32; 2]],
    /// Vertices of the triangles.
    pub faces: &'a [[i32; 3]],
    /// Normals of the triangles.
    pub face_normals: &'a [[i32; 3]],
    /// Texture coordinates of the triangles; read only where there are any.
    pub face_texcoords: &'a [[i32; 3]],
}

/// Least cosine between a vertex normal and the normal of a face at which the vertex normal shades the face.
const SMOOTH: f32 = 0.8;

/// The surface of a mesh, its triangles in the order of the file. `Err` tells which face has an index out of range.
pub(super) fn mesh(rows: MeshRows) -> Result<Surface, usize> {
    let textured = !rows.texcoords.is_empty();
    let mut surface = Surface {
        positions: rows.vertices.to_vec(),
        texcoords: rows.texcoords.to_vec(),
        faces: Vec::with_capacity(rows.faces.len()),
        corners: Vec::with_capacity(rows.faces.len()),
        ..Surface::default()
    };
    let mut kept = vec![None; rows.normals.len()];
    for (face, (vertices, normals)) in rows.faces.iter().zip(rows.face_normals).enumerate() {
        let position = in_range(*vertices, rows.vertices.len()).ok_or(face)?;
        let normal = in_range(*normals, rows.normals.len()).ok_or(face)?;
        let texcoord = match textured {
            true => in_range(rows.face_texcoords[face], rows.texcoords.len()).ok_or(face)?,
            false => [0; 3],
        };
        let normal = if textured {
            normal.map(|row| keep(&mut surface.normals, &mut kept[row as usize], rows.normals[row as usize]))
        } else {
            let [a, b, c] = position.map(|row| rows.vertices[row as usize]);
            let flat = face_normal(a, b, c);
            let mut flat_row = None;
            normal.map(|row| {
                let smooth = rows.normals[row as usize];
                match smooth[0] * flat[0] + smooth[1] * flat[1] + smooth[2] * flat[2] < SMOOTH {
                    true => keep(&mut surface.normals, &mut flat_row, flat),
                    false => keep(&mut surface.normals, &mut kept[row as usize], smooth),
                }
            })
        };
        surface.push(position, normal, texcoord);
    }
    surface.finish();
    Ok(surface)
}

/// The convex hull of a mesh, flat-shaded, without texture coordinates. The graph begins with the numbers of the hull's
/// vertices and triangles; its triangles, by vertices of the mesh, come last. None where a number is out of range.
pub(super) fn hull(graph: &[i32], vertices: &[[f32; 3]]) -> Option<Surface> {
    let size = |i: usize| usize::try_from(*graph.get(i)?).ok();
    let (corners, faces) = (size(0)?.checked_mul(3)?, size(1)?.checked_mul(3)?);
    let first = corners.checked_add(faces)?.checked_add(2)?;
    let rows = graph.get(first..first.checked_add(faces)?)?;
    let mut surface = Surface::default();
    let mut kept = vec![None; vertices.len()];
    for face in rows.chunks_exact(3) {
        let face = in_range([face[0], face[1], face[2]], vertices.len())?;
        let [a, b, c] = face.map(|row| vertices[row as usize]);
        let normal = [surface.normals.len() as u32; 3];
        surface.normals.push(face_normal(a, b, c));
        let position =
            face.map(|row| keep(&mut surface.positions, &mut kept[row as usize], vertices[row as usize]));
        surface.push(position, normal, [0; 3]);
    }
    surface.finish();
    Some(surface)
}

/// The row of a normal or position, appended when it is used for the first time.
fn keep(rows: &mut Vec<[f32; 3]>, row: &mut Option<u32>, value: [f32; 3]) -> u32 {
    *row.get_or_insert_with(|| {
        rows.push(value);
        (rows.len() - 1) as u32
    })
}

fn in_range(indices: [i32; 3], length: usize) -> Option<[u32; 3]> {
    let valid = indices.iter().all(|&i| usize::try_from(i).is_ok_and(|i| i < length));
    valid.then(|| indices.map(|i| i as u32))
}
