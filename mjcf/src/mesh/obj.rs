//! Wavefront OBJ: all `v`, `vn` and `vt` of the file, and the faces of its first shape. Larger polygons
//! become triangles; groups, materials and smoothing are ignored.

use super::decode::{Format, RawMesh};
use crate::asset::AssetError;

/// One `v/vt/vn` reference, zero-based; absent parts are -1.
type Corner = [i32; 3];

pub(super) fn decode(bytes: &[u8], path: &str) -> Result<RawMesh, AssetError> {
    let text = String::from_utf8_lossy(bytes);
    let mut mesh = RawMesh { format: Format::Obj, ..RawMesh::default() };
    let mut polygons: Vec<Vec<Corner>> = Vec::new();
    let mut first_shape = true;
    for line in text.lines() {
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => coordinates(&mut mesh.vert, 3, words, line, path)?,
            Some("vn") => coordinates(&mut mesh.normal, 3, words, line, path)?,
            Some("vt") => coordinates(&mut mesh.texcoord, 2, words, line, path)?,
            Some("f") if first_shape => {
                let counts = [mesh.vert.len() / 3, mesh.texcoord.len() / 2, mesh.normal.len() / 3];
                let polygon: Option<Vec<Corner>> = words.map(|w| corner(w, counts)).collect();
                let polygon = polygon.filter(|p| p.len() >= 3).ok_or_else(|| bad(line, path))?;
                polygons.push(polygon);
            }
            Some("o" | "g") if !polygons.is_empty() => first_shape = false,
            Some("curv" | "surf" | "cstype") => {
                return Err(AssetError::unsupported(format!("free-form geometry in OBJ file '{path}'")));
            }
            // Comments, materials, groups, smoothing, lines and points do not change the surface.
            _ => {}
        }
    }
    for polygon in &polygons {
        triangulate(polygon, &mut mesh);
    }
    for v in mesh.texcoord.iter_mut().skip(1).step_by(2) {
        *v = 1.0 - *v;
    }
    Ok(mesh)
}

fn bad(line: &str, path: &str) -> AssetError {
    let line: String = line.chars().take(60).collect();
    AssetError::malformed(format!("OBJ file '{path}': cannot read '{line}'"))
}

/// Appends the first `n` numbers of a line; further ones (weights, colours) are ignored, a missing
/// second texture coordinate is zero.
fn coordinates<'a>(
    to: &mut Vec<f32>,
    n: usize,
    mut words: impl Iterator<Item = &'a str>,
    line: &str,
    path: &str,
) -> Result<(), AssetError> {
    for k in 0..n {
        let x = match words.next() {
            Some(word) => word.parse().map_err(|_| bad(line, path))?,
            None if n == 2 && k == 1 => 0.0,
            None => return Err(bad(line, path)),
        };
        to.push(x);
    }
    Ok(())
}

/// Parses `v`, `v/vt`, `v//vn` or `v/vt/vn`; negative numbers count back from the latest entry.
fn corner(word: &str, counts: [usize; 3]) -> Option<Corner> {
    let mut corner = [-1; 3];
    for (k, part) in word.split('/').enumerate() {
        if k > 2 {
            return None;
        }
        if part.is_empty() {
            continue;
        }
        let index: i64 = part.parse().ok()?;
        let zero_based = if index < 0 { counts[k] as i64 + index } else { index - 1 };
        if zero_based < 0 {
            return None;
        }
        corner[k] = i32::try_from(zero_based).ok()?;
    }
    (corner[0] >= 0).then_some(corner)
}

/// A quad is cut along its shorter diagonal, anything larger is fanned from its first corner.
fn triangulate(polygon: &[Corner], mesh: &mut RawMesh) {
    if polygon.len() == 4 && squared_distance(mesh, polygon, 1, 3) <= squared_distance(mesh, polygon, 0, 2) {
        push_triangle(mesh, [polygon[0], polygon[1], polygon[3]]);
        push_triangle(mesh, [polygon[1], polygon[2], polygon[3]]);
        return;
    }
    for k in 1..polygon.len() - 1 {
        push_triangle(mesh, [polygon[0], polygon[k], polygon[k + 1]]);
    }
}

/// Infinite when a vertex does not exist; the index check of the compiler reports it.
fn squared_distance(mesh: &RawMesh, polygon: &[Corner], a: usize, b: usize) -> f32 {
    let vertex = |c: Corner| mesh.vert.get(3 * c[0] as usize..3 * c[0] as usize + 3);
    match (vertex(polygon[a]), vertex(polygon[b])) {
        (Some(a), Some(b)) => {
            let [x, y, z] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
            x * x + y * y + z * z
        }
        _ => f32::INFINITY,
    }
}

fn push_triangle(mesh: &mut RawMesh, corners: [Corner; 3]) {
    mesh.face.extend(corners.map(|c| c[0]));
    if !mesh.texcoord.is_empty() {
        mesh.facetexcoord.extend(corners.map(|c| c[1]));
    }
    if !mesh.normal.is_empty() {
        mesh.facenormal.extend(corners.map(|c| c[2]));
    }
}
