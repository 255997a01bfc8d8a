//! A surface of triangles, and what is done with parts.

use crate::Vec3;
use physics::math::{add, cross, dot, quat_from_axis_angle, quat_from_z, quat_rotate, scale, sub};
use std::collections::HashMap;

/// A closed surface of triangles, counter-clockwise seen from outside. Vertices are shared by the faces that meet there \[m\].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    vertices: Vec<Vec3>,
    faces: Vec<[usize; 3]>,
}

impl Mesh {
    /// A surface of corners that may coincide: equal ones become one vertex, faces without area because of that are left out.
    pub(crate) fn welded(corners: &[Vec3], faces: impl IntoIterator<Item = [usize; 3]>) -> Self {
        let (mut vertices, mut known) = (Vec::new(), HashMap::new());
        let mut index = |corner: &Vec3| {
            // Zeros of both signs are one number.
            let key = corner.map(|x| (x + 0.0).to_bits());
            *known.entry(key).or_insert_with(|| {
                vertices.push(*corner);
                vertices.len() - 1
            })
        };
        let places: Vec<_> = corners.iter().map(&mut index).collect();
        let faces = faces.into_iter().map(|face| face.map(|corner| places[corner]));
        let faces = faces.filter(|[a, b, c]| a != b && b != c && c != a).collect();
        Mesh { vertices, faces }
    }

    /// The corners of the faces, each once.
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// Three vertices a face, by their place in [`Mesh::vertices`].
    pub fn faces(&self) -> &[[usize; 3]] {
        &self.faces
    }

    /// This part and another as one mesh. They may touch or overlap: nothing is cut.
    pub fn with(mut self, other: &Mesh) -> Self {
        let first = self.vertices.len();
        self.vertices.extend(&other.vertices);
        self.faces.extend(other.faces.iter().map(|face| face.map(|vertex| first + vertex)));
        self
    }

    /// Several parts as one mesh.
    pub fn of<'a>(parts: impl IntoIterator<Item = &'a Mesh>) -> Self {
        parts.into_iter().fold(Mesh::default(), Mesh::with)
    }

    /// The part elsewhere.
    pub fn moved(self, offset: Vec3) -> Self {
        self.mapped(|vertex| add(vertex, offset))
    }

    /// The part turned about an axis through the origin, by the right-hand rule \[rad\].
    pub fn turned(self, axis: Vec3, angle: f64) -> Self {
        let length = dot(axis, axis).sqrt();
        let turn = quat_from_axis_angle(scale(axis, 1.0 / length), angle);
        self.mapped(|vertex| quat_rotate(turn, vertex))
    }

    /// The part with its z axis along `direction`, turned the shortest way, and its origin at `at`.
    pub fn along(self, direction: Vec3, at: Vec3) -> Self {
        let turn = quat_from_z(direction);
        self.mapped(|vertex| add(quat_rotate(turn, vertex), at))
    }

    /// The part stretched along each axis; all factors are positive.
    pub fn scaled(self, factors: Vec3) -> Self {
        self.mapped(|vertex| [0, 1, 2].map(|i| vertex[i] * factors[i]))
    }

    /// The mirror image across the plane through the origin whose normal is the axis of this number: 0 for x, 1 for y, 2 for z.
    pub fn mirrored(self, axis: usize) -> Self {
        let mut image = self.mapped(|mut vertex| {
            vertex[axis] = -vertex[axis];
            vertex
        });
        image.faces.iter_mut().for_each(|face| face.swap(1, 2));
        image
    }

    /// The part with every vertex moved by a function that keeps orientation: bends, tapers.
    pub fn mapped(mut self, place: impl Fn(Vec3) -> Vec3) -> Self {
        self.vertices.iter_mut().for_each(|vertex| *vertex = place(*vertex));
        self
    }

    /// The lowest and the highest coordinates \[m\]; of an empty mesh infinite ones, the wrong way round.
    pub fn bounds(&self) -> [Vec3; 2] {
        let start = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        self.vertices.iter().fold(start, |[low, high], vertex| {
            [[0, 1, 2].map(|i| low[i].min(vertex[i])), [0, 1, 2].map(|i| high[i].max(vertex[i]))]
        })
    }

    /// The volume inside \[m³\]; parts that overlap count twice.
    pub fn volume(&self) -> f64 {
        let corners = self.faces.iter().map(|face| face.map(|vertex| self.vertices[vertex]));
        corners.map(|[a, b, c]| dot(a, cross(b, c))).sum::<f64>() / 6.0
    }

    /// Whether each edge is run through as often one way as the other: no face is missing or turned over.
    pub fn is_closed(&self) -> bool {
        let mut balance: HashMap<[usize; 2], i64> = HashMap::new();
        for [a, b, c] in &self.faces {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                *balance.entry([*from.min(to), *from.max(to)]).or_default() += if from < to { 1 } else { -1 };
            }
        }
        !self.faces.is_empty() && balance.values().all(|balance| *balance == 0)
    }

    /// The normal of a face, as long as twice its area.
    pub(crate) fn normal(&self, face: [usize; 3]) -> Vec3 {
        let [a, b, c] = face.map(|vertex| self.vertices[vertex]);
        cross(sub(b, a), sub(c, a))
    }
}
