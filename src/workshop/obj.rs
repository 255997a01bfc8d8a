//! Meshes as Wavefront OBJ, the format that MJCF and every modelling program read.

use crate::{Mesh, Vec3};
use physics::math::{add_scaled, dot, scale, sub};
use std::collections::HashMap;
use std::fmt::Write;

/// Coordinates are written to a thousandth of a millimetre.
const PLACES: f64 = 1e6;
/// Components of normals are written to this part of one.
const DIRECTIONS: f64 = 1e4;

impl Mesh {
    /// The text of an OBJ file. Faces that meet at an angle below `crease` \[rad\] are shaded as one smooth surface.
    pub fn to_obj(&self, crease: f64) -> String {
        let mut text = String::new();
        let mut line = |kind: &str, numbers: [f64; 3]| {
            writeln!(text, "{kind} {} {} {}", numbers[0], numbers[1], numbers[2]).expect("text has no end");
        };
        self.vertices().iter().for_each(|vertex| line("v", rounded(*vertex, PLACES)));
        let mut known: HashMap<[i64; 3], usize> = HashMap::new();
        let corners = self.corner_normals(crease);
        let mut places = Vec::with_capacity(corners.len());
        for normal in corners.iter().flatten() {
            let key = normal.map(|x| (x * DIRECTIONS).round() as i64);
            let count = known.len();
            places.push(*known.entry(key).or_insert_with(|| {
                line("vn", rounded(*normal, DIRECTIONS));
                count
            }));
        }
        for (face, normals) in self.faces().iter().zip(places.chunks_exact(3)) {
            let [a, b, c] = [0, 1, 2].map(|i| format!("{}//{}", face[i] + 1, normals[i] + 1));
            writeln!(text, "f {a} {b} {c}").expect("text has no end");
        }
        text
    }

    /// For each corner of each face the mean of the normals, weighted by their angles there, of those faces at its vertex that meet
    /// its own at an angle below `crease`.
    fn corner_normals(&self, crease: f64) -> Vec<[Vec3; 3]> {
        let normals: Vec<Vec3> = self.faces().iter().map(|face| self.normal(*face)).map(direction).collect();
        let mut around = vec![Vec::new(); self.vertices().len()];
        for (face, corners) in self.faces().iter().enumerate() {
            (0..3).for_each(|corner| around[corners[corner]].push((face, self.angle(*corners, corner))));
        }
        let cosine = physics::math::ops::cos(crease);
        let corner = |own: Vec3, vertex: usize| {
            let smooth = around[vertex].iter().filter(|(face, _)| dot(own, normals[*face]) >= cosine);
            direction(smooth.fold([0.0; 3], |sum, (face, angle)| add_scaled(sum, normals[*face], *angle)))
        };
        self.faces().iter().zip(&normals).map(|(face, own)| face.map(|vertex| corner(*own, vertex))).collect()
    }

    /// The angle of a face at one of its corners \[rad\].
    fn angle(&self, face: [usize; 3], corner: usize) -> f64 {
        let [here, next, last] = [0, 1, 2].map(|step| self.vertices()[face[(corner + step) % 3]]);
        physics::math::ops::acos(dot(direction(sub(next, here)), direction(sub(last, here))).clamp(-1.0, 1.0))
    }
}

fn direction(v: Vec3) -> Vec3 {
    scale(v, 1.0 / dot(v, v).sqrt().max(1e-300))
}

/// Numbers to whole parts of one, without a negative zero.
fn rounded(numbers: Vec3, parts: f64) -> Vec3 {
    numbers.map(|x| (x * parts).round() / parts + 0.0)
}
