//! The surfaces of a scene under one projection: window positions, and which triangles can be seen.

use super::clip::clip;
use super::coverage::{Extent, Facing, Pattern, Triangle};
use super::draws::{Draw, Draws};
use super::vertices::{HalfSpace, Vertex, distance, inside, project};
use super::window::{Columns, Projection};
use crate::geometry::{Assets, Surface};

/// What a layer shows.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    /// From the world to the window.
    pub projection: Projection,
    /// Size of the window [pixel].
    pub extent: Extent,
    /// Only points with `normal . p + shift >= 0` in the world are drawn, and the sides of all triangles are exchanged.
    pub mirror: Option<[f64; 4]>,
    /// Both sides of all triangles are seen.
    pub two_sided: bool,
}

/// Window positions of all surfaces.
#[derive(Clone, Debug, Default)]
pub struct Layer {
    vertices: Vec<Vertex>,
    reach: Vec<Reach>,
}

/// Where a surface lies, as its box tells.
#[derive(Clone, Debug, PartialEq)]
enum Reach {
    /// Beside the window, or left out.
    Unseen,
    /// Maybe in it: the map that its positions took, and the side of the mirror.
    Seen(Columns, Option<HalfSpace>),
}

impl Layer {
    /// Projects the surfaces that `wanted` picks and whose boxes are not beside the window.
    pub fn update(&mut self, assets: &Assets, draws: &Draws, lens: &Lens, wanted: impl Fn(&Draw) -> bool) {
        self.vertices.resize(draws.vertices, Vertex::default());
        self.reach.resize(draws.list.len(), Reach::Unseen);
        for (draw, reach) in draws.list.iter().zip(&mut self.reach) {
            *reach = Reach::Unseen;
            if !wanted(draw) {
                continue;
            }
            let surface = draw.surface(assets);
            let columns = lens.projection.after(&draw.world);
            let half = lens.mirror.map(|plane| local(plane, draw));
            if is_beside(&columns, half, lens.extent, surface) {
                continue;
            }
            let range = draw.first_vertex..draw.first_vertex + surface.positions.len();
            project(&columns, half, &surface.positions, &mut self.vertices[range]);
            *reach = Reach::Seen(columns, half);
        }
    }

    /// Calls `see(number, triangle)` for every triangle of a surface that covers samples; one that is cut gives several with the
    /// same number.
    #[inline]
    pub fn triangles(
        &self,
        assets: &Assets,
        (index, draw): (usize, &Draw),
        lens: &Lens,
        pattern: &Pattern,
        mut see: impl FnMut(u32, &Triangle),
    ) {
        let Reach::Seen(columns, half) = &self.reach[index] else { return };
        let facing = match (draw.facing, lens.mirror.is_some(), lens.two_sided) {
            (_, _, true) => Facing::Both,
            (facing, false, _) => facing,
            (Facing::Front, true, _) => Facing::Back,
            (Facing::Back, true, _) => Facing::Front,
            (Facing::Both, true, _) => Facing::Both,
        };
        let surface = draw.surface(assets);
        let vertices = &self.vertices[draw.first_vertex..draw.first_vertex + surface.positions.len()];
        for (number, face) in (draw.first_triangle..).zip(&surface.faces) {
            let v = face.map(|i| vertices[i as usize]);
            if (v[0].beyond | v[1].beyond | v[2].beyond) == 0 {
                if let Some(triangle) = Triangle::new(v, facing, pattern, lens.extent) {
                    see(number, &triangle);
                }
            } else if (v[0].beyond & v[1].beyond & v[2].beyond) == 0 {
                let corners = face.map(|i| {
                    let p = surface.positions[i as usize];
                    let [x, y, z, w] = columns.apply(p);
                    [x, y, z, w, half.map_or(1.0, |half| distance(half, p))]
                });
                for piece in clip(corners).triangles() {
                    let v = piece.map(|corner| inside(&corner));
                    if let Some(triangle) = Triangle::new(v, facing, pattern, lens.extent) {
                        see(number, &triangle);
                    }
                }
            }
        }
    }

    /// The map from a surface's coordinates to the window, where the surface was projected.
    pub fn columns(&self, index: usize) -> Option<&Columns> {
        match &self.reach[index] {
            Reach::Seen(columns, _) => Some(columns),
            Reach::Unseen => None,
        }
    }
}

/// A half space of the world in a surface's coordinates.
fn local(plane: [f64; 4], draw: &Draw) -> HalfSpace {
    std::array::from_fn(|j| {
        let along = (0..3).map(|i| plane[i] * draw.world[i][j]).sum::<f64>();
        (along + if j == 3 { plane[3] } else { 0.0 }) as f32
    })
}

/// Whether a surface's box lies beyond one side of the window, before the near plane, beyond the far one, or behind the
/// mirror.
fn is_beside(columns: &Columns, half: Option<HalfSpace>, extent: Extent, surface: &Surface) -> bool {
    let [middle, size] = surface.bounds;
    let mut beyond = u32::MAX;
    for corner in 0..8_u32 {
        let p: [f32; 3] =
            std::array::from_fn(
                |k| if corner >> k & 1 == 0 { middle[k] - size[k] } else { middle[k] + size[k] },
            );
        let [x, y, z, w] = columns.apply(p);
        let faces = [
            x < 0.0,
            x > w * extent.width as f32,
            y < 0.0,
            y > w * extent.height as f32,
            z > w,
            z < 0.0,
            half.is_some_and(|half| distance(half, p) < 0.0),
        ];
        beyond &= faces.iter().enumerate().fold(0, |bits, (bit, &is)| bits | u32::from(is) << bit);
    }
    beyond != 0
}
