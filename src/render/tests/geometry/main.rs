//! Surfaces: counts, closedness, winding, normals, and how items are put together and painted.

mod edits;
mod paint;
mod shapes;

use physics::Model;
use robohive_render::geometry::{Assets, Part, Surface};
use robohive_render::scene::{Category, Item, Look, Object, Shape};
use robohive_render::{Profile, RenderError};
use std::collections::HashMap;

fn load(text: &str) -> Model {
    robohive_mjcf::load_str(text).unwrap().model
}

fn assets(text: &str) -> Assets {
    Assets::new(&load(text), Profile::Mujoco312).unwrap()
}

fn item(shape: Shape, size: [f32; 3], material: Option<usize>) -> Item {
    Item {
        shape,
        pos: [0.0; 3],
        mat: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        size,
        rgba: [1.0; 4],
        look: Look::default(),
        material,
        object: Object { kind: -1, id: -1 },
        category: Category::Dynamic,
        unlisted: false,
        rbound: 0.0,
        label: String::new(),
    }
}

fn parts(assets: &Assets, shape: Shape, size: [f32; 3]) -> Vec<Part> {
    let mut out = Vec::new();
    assets.parts(&item(shape, size, None), &mut out);
    out
}

/// Corners of an item's triangles in its frame.
fn triangles(assets: &Assets, shape: Shape, size: [f32; 3]) -> Vec<[[f64; 3]; 3]> {
    let mut out = Vec::new();
    for part in parts(assets, shape, size) {
        let surface = &assets.surfaces[part.surface];
        let place = |row: u32| {
            let p = surface.positions[row as usize];
            [0, 1, 2].map(|i| {
                let linear = part.linear[i];
                f64::from(part.offset[i] + linear[0] * p[0] + linear[1] * p[1] + linear[2] * p[2])
            })
        };
        out.extend(surface.faces.iter().map(|face| face.map(place)));
    }
    out
}

/// Area and signed volume.
fn measure(triangles: &[[[f64; 3]; 3]]) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for [a, b, c] in triangles {
        let side = |p: &[f64; 3]| [0, 1, 2].map(|i| p[i] - a[i]);
        let cross = cross(side(b), side(c));
        sum[0] += 0.5 * dot(cross, cross).sqrt();
        sum[1] += dot(*a, cross) / 6.0;
    }
    sum
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Every edge of the surface belongs to two triangles that run along it in opposite directions.
fn is_closed(triangles: &[[[f64; 3]; 3]]) -> bool {
    let key = |p: [f64; 3]| p.map(|x| (x * 1e5).round() as i64);
    let mut edges: HashMap<[[i64; 3]; 2], i32> = HashMap::new();
    for corners in triangles {
        for i in 0..3 {
            let [from, to] = [key(corners[i]), key(corners[(i + 1) % 3])];
            *edges.entry([from, to]).or_default() += 1;
            *edges.entry([to, from]).or_default() -= 1;
        }
    }
    edges.values().all(|&balance| balance == 0)
}

/// Normals are unit vectors on the outer side of their triangles, and no two rows of an array are equal.
fn check_surface(surface: &Surface) {
    for (face, triangle) in surface.faces.iter().zip(&surface.corners) {
        let [a, b, c] = face.map(|row| surface.positions[row as usize].map(f64::from));
        let side = |p: [f64; 3]| [0, 1, 2].map(|i| p[i] - a[i]);
        let outward = cross(side(b), side(c));
        for row in triangle.normal {
            let normal = surface.normals[row as usize].map(f64::from);
            assert!((dot(normal, normal) - 1.0).abs() < 1e-5);
            assert!(dot(normal, outward) > 0.0);
        }
        assert!(
            surface.texcoords.is_empty()
                || triangle.texcoord.iter().all(|&t| (t as usize) < surface.texcoords.len())
        );
    }
    let mut rows: Vec<_> = surface.positions.iter().map(|p| p.map(f32::to_bits)).collect();
    rows.sort_unstable();
    rows.dedup();
    assert_eq!(rows.len(), surface.positions.len());
    for p in &surface.positions {
        assert!((0..3).all(|i| (p[i] - surface.bounds[0][i]).abs() <= surface.bounds[1][i] + 1e-5));
    }
}

const EMPTY: &str = "<mujoco><worldbody/></mujoco>";

fn message(result: Result<Assets, RenderError>) -> String {
    match result {
        Err(RenderError::Model { message }) => message,
        other => panic!("{:?}", other.map(|_| ())),
    }
}
