//! Wavefront OBJ: all `v`, `vn` and `vt` of the file, and the faces and lines of its first shape. Larger polygons
//! become triangles; groups, materials and smoothing are ignored.

use super::ear_clipping;
use super::source::{Format, RawMesh};
use crate::asset::{AssetError, AssetErrorKind};
use crate::encoding::foreign;

/// Corners of the largest polygon that is drawn.
const MOST_CORNERS: usize = 100;

/// One `v/vt/vn` reference, zero-based; absent parts are -1.
type Corner = [i32; 3];

pub(super) fn decode(bytes: &[u8], path: &str) -> Result<RawMesh, AssetError> {
    if let Some(what) = foreign(bytes) {
        return Err(AssetError::malformed(format!("OBJ file '{path}' is {what}: OBJ is text in UTF-8")));
    }
    let text = String::from_utf8_lossy(bytes);
    let mut mesh = RawMesh { format: Format::Obj, ..RawMesh::default() };
    let mut polygons: Vec<Vec<Corner>> = Vec::new();
    let mut first_shape = true;
    for (index, line) in text.lines().enumerate() {
        let line = Line { text: line, number: index + 1, path };
        let mut words = line.text.split_ascii_whitespace();
        match words.next() {
            Some("v") => coordinates(&mut mesh.vert, 3, words, &line)?,
            Some("vn") => coordinates(&mut mesh.normal, 3, words, &line)?,
            Some("vt") => coordinates(&mut mesh.texcoord, 2, words, &line)?,
            Some("f") if first_shape => {
                let counts = [mesh.vert.len() / 3, mesh.texcoord.len() / 2, mesh.normal.len() / 3];
                let polygon: Option<Vec<Corner>> = words.map(|w| corner(w, counts)).collect();
                let polygon = polygon.filter(|p| p.len() >= 3).ok_or_else(|| line.unreadable())?;
                polygons.push(polygon);
            }
            Some("l") if first_shape => {
                let counts = [mesh.vert.len() / 3, mesh.texcoord.len() / 2, mesh.normal.len() / 3];
                let path: Option<Vec<Corner>> = words.map(|w| corner(w, counts)).collect();
                let path = path.ok_or_else(|| line.unreadable())?;
                mesh.line.extend(path.windows(2).flat_map(|pair| [pair[0][0], pair[1][0]]));
            }
            Some("o" | "g") if !polygons.is_empty() => first_shape = false,
            Some("curv" | "surf" | "cstype") => {
                let why = "free-form geometry is not supported";
                return Err(line.error(AssetErrorKind::Unsupported, why));
            }
            // Comments, materials, groups, smoothing and points do not change the surface.
            _ => {}
        }
    }
    polygons.iter().for_each(|polygon| triangulate(polygon, &mut mesh));
    for v in mesh.texcoord.iter_mut().skip(1).step_by(2) {
        *v = 1.0 - *v;
    }
    Ok(mesh)
}

/// A line of a file, for messages.
struct Line<'a> {
    text: &'a str,
    /// From one.
    number: usize,
    path: &'a str,
}

impl Line<'_> {
    fn error(&self, kind: AssetErrorKind, why: &str) -> AssetError {
        let Line { number, path, .. } = self;
        AssetError::new(kind, format!("OBJ file '{path}', line {number}: {why}")).on_line(*number)
    }

    fn unreadable(&self) -> AssetError {
        let shown: String = self.text.chars().take(60).collect();
        self.error(AssetErrorKind::Malformed, &format!("cannot read '{shown}'"))
    }
}

/// Appends the first `n` numbers of a line; further ones (weights, colours) are ignored, a missing
/// second texture coordinate is zero.
fn coordinates<'a>(
    to: &mut Vec<f32>,
    n: usize,
    mut words: impl Iterator<Item = &'a str>,
    line: &Line,
) -> Result<(), AssetError> {
    for k in 0..n {
        let x = match words.next() {
            Some(word) => word.parse().map_err(|_| line.unreadable())?,
            None if n == 2 && k == 1 => 0.0,
            None => return Err(line.unreadable()),
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

/// Cuts a polygon into triangles. One with too many corners leaves a hole, as in the reference.
fn triangulate(polygon: &[Corner], mesh: &mut RawMesh) {
    if polygon.len() > MOST_CORNERS {
        return;
    }
    if let [a, b, c] = *polygon {
        return push_triangle(mesh, [a, b, c]);
    }
    let points = flatten(polygon, mesh);
    ear_clipping::triangulate(&points, |triangle| push_triangle(mesh, triangle.map(|k| polygon[k])));
}

/// The two coordinates of each corner in which the first proper corner is widest. Vertices that do not
/// exist are at the origin; the index check of the compiler reports them.
fn flatten(polygon: &[Corner], mesh: &RawMesh) -> Vec<[f32; 2]> {
    let vertex = |c: Corner| -> [f32; 3] {
        let at = 3 * c[0] as usize;
        mesh.vert.get(at..at + 3).map_or([0.0; 3], |v| [v[0], v[1], v[2]])
    };
    let n = polygon.len();
    let normals = (0..n).map(|k| {
        let [a, b, c] = [0, 1, 2].map(|j| vertex(polygon[(k + j) % n]));
        let [e, f] = [std::array::from_fn(|j| b[j] - a[j]), std::array::from_fn(|j| c[j] - b[j])];
        let (e, f): ([f32; 3], [f32; 3]) = (e, f);
        [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]].map(f32::abs)
    });
    let proper = normals.into_iter().find(|c| c.iter().any(|&x| x > f32::EPSILON));
    let [x, y, z] = proper.unwrap_or([1.0, 0.0, 0.0]);
    let axes = if x > y && x > z {
        [1, 2]
    } else if z > x && z > y {
        [0, 1]
    } else {
        [0, 2]
    };
    polygon.iter().map(|&c| axes.map(|axis| vertex(c)[axis])).collect()
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
