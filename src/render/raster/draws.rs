//! The surfaces of a scene, each with its place in the world.

use super::lines::{Line, OPAQUE, list};
use super::window::coverage::Facing;
use super::window::projection::Affine;
use crate::error::RenderError;
use crate::geometry::{Assets, Paint, Part, Surface};
use crate::scene::{Category, Item, Scene, Shape};
use std::ops::Range;

/// One surface to draw.
#[derive(Clone, Debug)]
pub struct Draw {
    /// The item that it is part of.
    pub item: usize,
    /// Index into the surfaces of the assets.
    pub surface: usize,
    /// How it is textured.
    pub paint: Paint,
    /// From the surface's coordinates to the world.
    pub world: Affine,
    /// The same for normals, which need to be brought to length 1 afterwards.
    pub normals: [[f32; 3]; 3],
    /// Which side of its triangles is seen.
    pub facing: Facing,
    /// It is a plane seen from behind.
    pub behind: bool,
    /// It is blended over what is behind it.
    pub transparent: bool,
    /// It casts shadows.
    pub casts: bool,
    /// It is the same in all pictures that are drawn together.
    pub shared: bool,
    /// Its first position in the layers.
    pub first_vertex: usize,
    /// Number of its first triangle; 0 is no triangle. In a wireframe every triangle has three numbers, one a side.
    pub first_triangle: u32,
}

/// Most triangles, and most positions, of a scene.
const MAX_TRIANGLES: usize = 1 << 27;

/// The error for a scene with more.
fn too_many(scene: &Scene) -> RenderError {
    let message = format!(
        "its {} items have more than {MAX_TRIANGLES} triangles; draw fewer items, or lower numslices, numstacks and numquads of \
         visual/quality",
        scene.items.len()
    );
    RenderError::Model { message }
}

/// Factor of a plane's opacity when it is seen from behind.
const BEHIND: f32 = 0.3;

impl Draw {
    /// The opacity that it is drawn with.
    pub fn alpha(&self, item: &Item) -> f32 {
        item.rgba[3] * if self.behind { BEHIND } else { 1.0 }
    }

    /// A point of the surface in the world.
    pub fn place(&self, p: [f32; 3]) -> [f32; 3] {
        self.world.map(|row| {
            (row[0] as f32) * p[0] + (row[1] as f32) * p[1] + (row[2] as f32) * p[2] + row[3] as f32
        })
    }

    /// The surface itself.
    pub fn surface<'a>(&self, assets: &'a Assets) -> &'a Surface {
        &assets.surfaces[self.surface]
    }
}

/// Everything to draw, in the order of the scene.
#[derive(Clone, Debug, Default)]
pub struct Draws {
    /// The surfaces.
    pub list: Vec<Draw>,
    /// Positions of all of them.
    pub vertices: usize,
    /// Triangles of all of them, and the number 0. Lines are numbered from here.
    pub triangles: u32,
    /// Lines, which have no surface.
    pub lines: Vec<Line>,
    /// Numbers that every triangle has: one, or one for each side.
    pub numbers_each: u32,
    parts: Vec<Part>,
}

impl Draws {
    /// Lists nothing.
    pub fn clear(&mut self) {
        self.list.clear();
        self.lines.clear();
        (self.vertices, self.triangles, self.numbers_each) = (0, 1, 1);
    }

    /// Lists the surfaces of a scene.
    ///
    /// # Errors
    /// There are more than `MAX_TRIANGLES` triangles or positions.
    pub fn update(&mut self, assets: &Assets, scene: &Scene) -> Result<(), RenderError> {
        self.clear();
        self.numbers_each = if scene.wireframe { 3 } else { 1 };
        list(scene, &mut self.lines);
        let eye = scene.view.eye.map(|x| x as f32);
        for (index, item) in scene.items.iter().enumerate() {
            self.parts.clear();
            assets.parts(item, &mut self.parts);
            let behind = matches!(item.shape, Shape::Plane { .. }) && is_behind(eye, item);
            let transparent = item.rgba[3] < OPAQUE || behind;
            for part in &self.parts {
                let world = place(item, part);
                let surface = &assets.surfaces[part.surface];
                let facing = match (part.two_sided || !scene.culling, behind) {
                    (true, _) => Facing::Both,
                    (false, true) => Facing::Back,
                    (false, false) => Facing::Front,
                };
                self.list.push(Draw {
                    item: index,
                    surface: part.surface,
                    paint: part.paint,
                    normals: cofactors(&world),
                    world,
                    facing,
                    behind,
                    transparent,
                    casts: item.category != Category::Decor,
                    shared: true,
                    first_vertex: self.vertices,
                    first_triangle: self.triangles,
                });
                self.vertices += surface.positions.len();
                let triangles = (self.triangles / self.numbers_each) as usize + surface.faces.len();
                if self.vertices.max(triangles) > MAX_TRIANGLES {
                    return Err(too_many(scene));
                }
                self.triangles += surface.faces.len() as u32 * self.numbers_each;
            }
        }
        Ok(())
    }

    /// The item that mirrors the others: the first plane or box that is opaque and has a reflectance.
    pub fn reflective(&self, scene: &Scene) -> Option<usize> {
        let can = |draw: &&Draw| {
            let item = &scene.items[draw.item];
            let flat = matches!(item.shape, Shape::Plane { .. } | Shape::Box);
            flat && !draw.transparent && item.look.reflectance > 0.0
        };
        self.list.iter().find(can).filter(|_| scene.reflections).map(|draw| draw.item)
    }

    /// The item that a triangle or line belongs to, and the numbers that belong to the same.
    pub fn item_of(&self, number: u32) -> (usize, Range<u32>) {
        if number >= self.triangles {
            return (self.lines[(number - self.triangles) as usize].item, number..number + 1);
        }
        let index = self.of_triangle(number);
        let end = self.list.get(index + 1).map_or(self.triangles, |draw| draw.first_triangle);
        (self.list[index].item, self.list[index].first_triangle..end)
    }

    /// The lines of an item.
    pub fn lines_of(&self, item: usize) -> impl Iterator<Item = &Line> {
        let first = self.lines.partition_point(|line| line.item < item);
        self.lines[first..].iter().take_while(move |line| line.item == item)
    }

    /// The surface that a triangle belongs to.
    fn of_triangle(&self, triangle: u32) -> usize {
        self.list.partition_point(|draw| draw.first_triangle <= triangle) - 1
    }
}

/// Marks the surfaces that the pictures have in common: the same item, with the same shape, in the same place.
pub fn mark_shared(all: &mut [Draws]) {
    let Some((first, others)) = all.split_first_mut() else { return };
    for draws in &*others {
        let same_length = draws.list.len() == first.list.len();
        for (a, b) in first.list.iter_mut().zip(&draws.list) {
            a.shared &= same_length
                && a.item == b.item
                && a.surface == b.surface
                && a.world == b.world
                && a.casts == b.casts;
        }
        if !same_length {
            first.list.iter_mut().for_each(|draw| draw.shared = false);
        }
    }
    for draws in others {
        for (index, draw) in draws.list.iter_mut().enumerate() {
            draw.shared = first.list.get(index).is_some_and(|first| first.shared);
        }
    }
}

/// Whether a point is below an item's xy plane.
pub fn is_behind(eye: [f32; 3], item: &Item) -> bool {
    (0..3).map(|k| (eye[k] - item.pos[k]) * item.mat[3 * k + 2]).sum::<f32>() < 0.0
}

/// The item's pose after the part's place in the item.
fn place(item: &Item, part: &Part) -> Affine {
    std::array::from_fn(|i| {
        let turn = &item.mat[3 * i..3 * i + 3];
        let along = |v: [f32; 3]| (0..3).map(|k| f64::from(turn[k]) * f64::from(v[k])).sum::<f64>();
        let column = |j: usize| along([part.linear[0][j], part.linear[1][j], part.linear[2][j]]);
        [column(0), column(1), column(2), along(part.offset) + f64::from(item.pos[i])]
    })
}

/// The transposed inverse of a linear map, up to its size.
fn cofactors(map: &Affine) -> [[f32; 3]; 3] {
    let minor = |i: usize, j: usize| {
        let (a, b, c, d) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        map[a][c] * map[b][d] - map[a][d] * map[b][c]
    };
    let determinant: f64 = (0..3).map(|j| map[0][j] * minor(0, j)).sum();
    // Cofactors of small bodies are products of millimetres: brought to size 1 for single precision.
    let size = (0..9).map(|k| minor(k / 3, k % 3).abs()).fold(0.0, f64::max);
    let scale = if size > 0.0 { determinant.signum() / size } else { 0.0 };
    std::array::from_fn(|i| std::array::from_fn(|j| (minor(i, j) * scale) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_stay_normal_to_stretched_surfaces() {
        // x is stretched by 2 and z by 1/2, and x mirrored: the plane x + z = 0 keeps its tangent (1, 0, -1).
        let map = [[-2.0, 0.0, 0.0, 5.0], [0.0, 1.0, 0.0, 6.0], [0.0, 0.0, 0.5, 7.0]];
        let normals = cofactors(&map);
        let normal: [f32; 3] = std::array::from_fn(|i| normals[i][0] + normals[i][2]);
        let tangent: [f32; 3] = [-2.0, 0.0, -0.5];
        let dot: f32 = (0..3).map(|k| normal[k] * tangent[k]).sum();
        assert!(dot.abs() < 1e-6 && normal[2] > 0.0 && normal[0] < 0.0, "{normal:?}");
    }
}
