//! Vertex normals: area-weighted means of the adjacent face normals, unless the file gives them.

use crate::vector::{cross, dot, normalize, sub};
use physics::model::bounds::MINVAL;

/// Faces whose normal has a smaller cosine with the vertex normal do not count unless smoothing is on.
const SHARP_COSINE: f64 = 0.8;

/// One unit normal per vertex.
pub(super) fn vertex_normals(vert: &[[f64; 3]], face: &[[i32; 3]], smooth: bool) -> Vec<[f32; 3]> {
    let mut normals = vec![[0.0f32; 3]; vert.len()];
    for f in face {
        let (n, area) = face_normal(vert, f);
        for &v in f {
            accumulate(&mut normals[v as usize], n, area);
        }
    }
    if !smooth {
        let mut removed = vec![[0.0f32; 3]; vert.len()];
        for f in face {
            let (n, area) = face_normal(vert, f);
            for &v in f {
                let mut mean = normals[v as usize].map(f64::from);
                normalize(&mut mean);
                if dot(n, mean) < SHARP_COSINE {
                    accumulate(&mut removed[v as usize], n, area);
                }
            }
        }
        for (normal, removed) in normals.iter_mut().zip(&removed) {
            for k in 0..3 {
                normal[k] -= removed[k];
            }
        }
    }
    for n in &mut normals {
        let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
        *n = if f64::from(length) > MINVAL { n.map(|x| x / length) } else { [0.0, 0.0, 1.0] };
    }
    normals
}

/// Unit normal of a face and twice its area; zero area for tiny faces.
fn face_normal(vert: &[[f64; 3]], f: &[i32; 3]) -> ([f64; 3], f64) {
    let [a, b, c] = f.map(|v| vert[v as usize]);
    let mut n = cross(sub(b, a), sub(c, a));
    let area = normalize(&mut n);
    (n, area)
}

/// The sum is single precision, each term double.
fn accumulate(sum: &mut [f32; 3], n: [f64; 3], weight: f64) {
    for k in 0..3 {
        sum[k] = (f64::from(sum[k]) + n[k] * weight) as f32;
    }
}

/// Given normals scaled to unit length; zero ones become +z.
pub(super) fn normalize_given(normals: &mut [[f32; 3]]) {
    for n in normals {
        let squared = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        if f64::from(squared) > MINVAL {
            let factor = 1.0 / squared.sqrt();
            *n = n.map(|x| x * factor);
        } else {
            *n = [0.0, 0.0, 1.0];
        }
    }
}
