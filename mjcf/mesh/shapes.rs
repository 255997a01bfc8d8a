//! Computed meshes (`asset/mesh/builtin`): spheres, hemispheres, superquadrics, cones, and the point
//! grids of touch sensors.

use std::collections::HashMap;
use std::f64::consts::PI;

use physics::math::ops::{cos, pow, sin};

use super::source::RawMesh;
use crate::asset::AssetError;
use crate::vector::{cross, normalize};

/// Shape of a computed mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Subdivided icosahedron; parameter: subdivisions.
    Sphere,
    /// Closed half ball; parameter: resolution.
    Hemisphere,
    /// Cone or frustum; parameters: edges, top radius.
    Cone,
    /// Superellipsoid; parameters: resolution, two exponents.
    Supersphere,
    /// Supertoroid; parameters: resolution, tube radius, two exponents.
    Supertorus,
    /// Spherical grid of points; parameters: two resolutions, two fields of view, foveation.
    Wedge,
    /// Flat grid of points; parameters: two resolutions. Its inertia mode is shell.
    Plate,
}

/// Largest number of vertices of a computed mesh.
const MAX_VERTICES: f64 = 1e7;

/// About how many vertices a computed mesh has.
pub fn vertex_count(shape: Shape, params: &[f64]) -> f64 {
    let count = |k: usize| params.get(k).map_or(0.0, |p| p.clamp(0.0, MAX_VERTICES));
    match shape {
        // An icosahedron, its triangles cut in four.
        Shape::Sphere => 12.0 * f64::from(1 << (2 * count(0).min(4.0) as i32)),
        Shape::Hemisphere => 4.0 * count(0) * count(0),
        Shape::Supersphere | Shape::Supertorus => count(0) * count(0),
        Shape::Wedge | Shape::Plate => count(0) * count(1),
        Shape::Cone => 2.0 * count(0),
    }
}

/// The arrays of a computed mesh.
pub fn builtin(shape: Shape, params: &[f64]) -> Result<RawMesh, AssetError> {
    let fail = |why: &str| Err(AssetError::inconsistent(format!("builtin mesh {shape:?}: {why}")));
    let expected = match shape {
        Shape::Sphere | Shape::Hemisphere => 1,
        Shape::Cone | Shape::Plate => 2,
        Shape::Supersphere => 3,
        Shape::Supertorus => 4,
        Shape::Wedge => 5,
    };
    if params.len() != expected {
        return fail(&format!("{expected} parameters are required, not {}", params.len()));
    }
    if params.iter().any(|p| !p.is_finite()) {
        return fail("parameters must be finite");
    }
    // Resolutions are truncated to integers; negative ones become zero.
    let count = |k: usize| params[k].clamp(0.0, MAX_VERTICES) as usize;
    let mesh = match shape {
        Shape::Sphere if params[0] <= -1.0 || count(0) > 4 => return fail("subdivisions must be 0 to 4"),
        Shape::Sphere => sphere(count(0)),
        Shape::Hemisphere if params[0] <= -1.0 || count(0) > 10 => return fail("resolution must be 0 to 10"),
        Shape::Hemisphere => hemisphere(count(0)),
        Shape::Supersphere | Shape::Supertorus if count(0) < 3 => {
            return fail("resolution must be at least 3");
        }
        Shape::Supersphere | Shape::Supertorus if params[0] * params[0] > MAX_VERTICES => {
            return fail("resolution is too large");
        }
        Shape::Supersphere if params[1] < 0.0 || params[2] < 0.0 => {
            return fail("exponents must not be negative");
        }
        Shape::Supersphere => supersphere(count(0), params[1], params[2]),
        Shape::Supertorus if params[1] <= 0.0 || params[1] > 1.0 => {
            return fail("the radius must be above 0 and at most 1");
        }
        Shape::Supertorus if params[2] <= 0.0 || params[3] <= 0.0 => {
            return fail("both exponents must be above 0");
        }
        Shape::Supertorus => supertorus(count(0), params[1], params[2], params[3]),
        Shape::Wedge | Shape::Plate if count(0) == 0 || count(1) == 0 => {
            return fail("both resolutions must be 1 or more");
        }
        Shape::Wedge | Shape::Plate if params[0] * params[1] > MAX_VERTICES => {
            return fail("resolutions are too large");
        }
        Shape::Wedge if params[2] <= 0.0 || params[2] > 180.0 || params[3] <= 0.0 || params[3] > 90.0 => {
            return fail("fields of view must be in (0, 180] and (0, 90] degrees");
        }
        Shape::Wedge if !(0.0..=1.0).contains(&params[4]) => {
            return fail("the foveation must be from 0 to 1");
        }
        Shape::Wedge => wedge([count(0), count(1)], [params[2], params[3]], params[4]),
        Shape::Plate => plate([count(0), count(1)]),
        Shape::Cone if count(0) < 3 || params[0] > MAX_VERTICES => {
            return fail("at least 3 edges are required");
        }
        Shape::Cone => cone(count(0), params[1]),
    };
    Ok(mesh)
}

fn with_faces(vert: Vec<[f32; 3]>, face: Vec<[usize; 3]>) -> RawMesh {
    RawMesh {
        vert: vert.into_iter().flatten().collect(),
        face: face.into_iter().flatten().map(|v| v as i32).collect(),
        ..RawMesh::default()
    }
}

/// Icosahedron whose triangles are cut into four, `subdivisions` times; single precision throughout.
fn sphere(subdivisions: usize) -> RawMesh {
    let phi = ((1.0 + 5.0f64.sqrt()) / 2.0) as f32;
    let norm = (1.0 + f64::from(phi * phi)).sqrt();
    let corner = |p: [f32; 3]| p.map(|x| (f64::from(x) / norm) as f32);
    let (o, i) = (0.0, 1.0);
    #[rustfmt::skip]
    let mut vert: Vec<[f32; 3]> = [
        [-i, phi, o], [i, phi, o], [-i, -phi, o], [i, -phi, o],
        [o, -i, phi], [o, i, phi], [o, -i, -phi], [o, i, -phi],
        [phi, o, -i], [phi, o, i], [-phi, o, -i], [-phi, o, i],
    ]
    .map(corner)
    .to_vec();
    #[rustfmt::skip]
    let mut face = vec![
        [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11],
        [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
        [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9],
        [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1],
    ];
    for _ in 0..subdivisions {
        let mut between = HashMap::new();
        let mut midpoint = |a: usize, b: usize| {
            *between.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let m: [f32; 3] = std::array::from_fn(|k| (vert[a][k] + vert[b][k]) / 2.0);
                let length = (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]).sqrt();
                vert.push(m.map(|x| x / length));
                vert.len() - 1
            })
        };
        let mut finer = Vec::with_capacity(4 * face.len());
        for [a, b, c] in face {
            let ab = midpoint(a, b);
            let bc = midpoint(b, c);
            let ca = midpoint(c, a);
            finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        face = finer;
    }
    with_faces(vert, face)
}

/// Rings of an octahedron's upper half projected onto the sphere, and a cap.
fn hemisphere(resolution: usize) -> RawMesh {
    const EQUATOR: [[f64; 2]; 4] = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    let mut vert = vec![[0.0f32, 0.0, 1.0]];
    for row in 0..=resolution {
        let factor = (row + 1) as f64 / (resolution + 1) as f64;
        for side in 0..4 {
            let end = |k: usize| -> [f64; 3] {
                let [x, y] = EQUATOR[k % 4];
                [0.0 + factor * (x - 0.0), 0.0 + factor * (y - 0.0), 1.0 + factor * (0.0 - 1.0)]
            };
            let (from, to) = (end(side), end(side + 1));
            for step in 0..=row {
                let p: [f64; 3] =
                    std::array::from_fn(|k| from[k] + step as f64 * ((to[k] - from[k]) / (row + 1) as f64));
                let norm = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
                vert.push(p.map(|x| (x / norm) as f32));
            }
        }
    }
    let center = vert.len();
    vert.push([0.0; 3]);
    let mut face = vec![[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]];
    for row in 0..resolution {
        let (inner, inner_count) = (2 * row * (row + 1) + 1, 4 * (row + 1));
        let (outer, outer_count) = (inner + inner_count, 4 * (row + 2));
        for side in 0..4 {
            for k in 0..row + 2 {
                let (i, o) = (k + (row + 1) * side, k + (row + 2) * side);
                let here = inner + i % inner_count;
                let ahead = outer + (o + 1) % outer_count;
                face.push([here, outer + o % outer_count, ahead]);
                if k < row + 1 {
                    face.push([here, ahead, inner + (i + 1) % inner_count]);
                }
            }
        }
    }
    let (rim, rim_count) = (2 * resolution * (resolution + 1) + 1, 4 * (resolution + 1));
    face.extend((0..rim_count).map(|k| [rim + k, center, rim + (k + 1) % rim_count]));
    with_faces(vert, face)
}

/// Power of a cosine or sine that keeps its sign.
fn signed_power(x: f64, exponent: f64) -> f64 {
    pow(x.abs(), exponent).copysign(x)
}

fn supersphere(resolution: usize, east: f64, north: f64) -> RawMesh {
    let mut vert = vec![[0.0f32, 0.0, -1.0]];
    for i in 1..resolution {
        let v = -PI / 2.0 + i as f64 * PI / resolution as f64;
        for j in 0..resolution {
            let u = -PI + (2 * j) as f64 * PI / resolution as f64;
            let ring = signed_power(cos(v), north);
            let p = [
                ring * signed_power(cos(u), east),
                ring * signed_power(sin(u), east),
                signed_power(sin(v), north),
            ];
            vert.push(p.map(|x| x as f32));
        }
    }
    let pole = vert.len();
    vert.push([0.0, 0.0, 1.0]);
    let at = |ring: usize, k: usize| 1 + ring * resolution + k % resolution;
    let mut face: Vec<[usize; 3]> = (0..resolution).map(|j| [0, at(0, j + 1), at(0, j)]).collect();
    for ring in 0..resolution - 2 {
        for j in 0..resolution {
            let [a, b, c, d] = [at(ring, j), at(ring, j + 1), at(ring + 1, j + 1), at(ring + 1, j)];
            face.extend([[a, b, d], [b, c, d]]);
        }
    }
    face.extend((0..resolution).map(|j| [at(resolution - 2, j), at(resolution - 2, j + 1), pole]));
    with_faces(vert, face)
}

fn supertorus(resolution: usize, radius: f64, tube: f64, ring: f64) -> RawMesh {
    let angle = |k: usize| 2.0 * PI * k as f64 / resolution as f64;
    let at = |i: usize, j: usize| i % resolution * resolution + j % resolution;
    let (mut vert, mut face) = (Vec::new(), Vec::new());
    for i in 0..resolution {
        for j in 0..resolution {
            let (u, v) = (angle(i), angle(j));
            let reach = 1.0 + radius * signed_power(cos(v), tube);
            let p = [
                reach * signed_power(cos(u), ring),
                reach * signed_power(sin(u), ring),
                radius * signed_power(sin(v), tube),
            ];
            vert.push(p.map(|x| x as f32));
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            face.extend([[a, b, d], [b, c, d]]);
        }
    }
    with_faces(vert, face)
}

/// Points only; the hull gives the faces.
fn cone(edges: usize, radius: f64) -> RawMesh {
    let rim = |k: usize| {
        let angle = (2 * k) as f64 * PI / edges as f64;
        [cos(angle), sin(angle)]
    };
    let mut vert: Vec<[f32; 3]> = (0..edges).map(|k| [rim(k)[0] as f32, rim(k)[1] as f32, -1.0]).collect();
    if radius > 0.0 {
        vert.extend(
            (edges..2 * edges).map(|k| [(radius * rim(k)[0]) as f32, (radius * rim(k)[1]) as f32, 1.0]),
        );
    } else {
        vert.push([0.0, 0.0, 1.0]);
    }
    with_faces(vert, Vec::new())
}

/// `n + 1` bin edges from -1 to 1, by repeated addition.
fn bin_edges(n: usize) -> Vec<f64> {
    let step = 2.0 / n as f64;
    std::iter::successors(Some(-1.0), |x| Some(x + step)).take(n + 1).collect()
}

/// Bin centres on the unit sphere around -z, each with a tangent frame as its three normals.
fn wedge(resolution: [usize; 2], fov: [f64; 2], gamma: f64) -> RawMesh {
    let edges = [0, 1].map(|axis| -> Vec<f64> {
        let foveate = |x: f64| if gamma == 0.0 { x } else { gamma * pow(x, 5.0) + (1.0 - gamma) * x };
        bin_edges(resolution[axis]).into_iter().map(|x| fov[axis] * PI / 180.0 * foveate(x)).collect()
    });
    let mut mesh = RawMesh::default();
    for i in 0..resolution[0] {
        for j in 0..resolution[1] {
            let a = 0.5 * (edges[0][i + 1] + edges[0][i]);
            let e = 0.5 * (edges[1][j + 1] + edges[1][j]);
            let point = [cos(e) * sin(a), sin(e), -cos(e) * cos(a)];
            let mut across = [cos(e) * cos(a), 0.0, cos(e) * sin(a)];
            let mut along = [-sin(e) * sin(a), cos(e), sin(e) * cos(a)];
            normalize(&mut across);
            normalize(&mut along);
            let normal = cross(along, across);
            mesh.vert.extend(point.map(|x| x as f32));
            mesh.normal.extend([normal, across, along].into_iter().flatten().map(|x| x as f32));
        }
    }
    mesh
}

/// Bin centres on the square at z = -1.
fn plate([nx, ny]: [usize; 2]) -> RawMesh {
    let mut mesh = RawMesh::default();
    for i in 0..nx {
        for j in 0..ny {
            let center = |k: usize, n: usize| (-1.0 + (k as f64 + 0.5) * (2.0 / n as f64)) as f32;
            mesh.vert.extend([center(i, nx), center(j, ny), -1.0]);
            mesh.normal.extend([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
            if i > 0 && j > 0 {
                let at = |di: usize, dj: usize| ((i - 1 + di) * ny + j - 1 + dj) as i32;
                mesh.face.extend([at(0, 0), at(1, 0), at(0, 1), at(1, 1), at(0, 1), at(1, 0)]);
            }
        }
    }
    mesh
}
