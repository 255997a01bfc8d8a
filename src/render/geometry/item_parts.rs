//! The parts of each item of a scene.

use super::assets::{Assets, Builtin};
use super::part::{Paint, Part};
use crate::profile::Profile;
use crate::scene::{Item, Shape};

/// Width of an arrow's head in units of its shaft's.
const HEAD: f32 = 1.75;

impl Assets {
    /// Appends the parts of an item. Lines, the edges of boxes, and geoms, meshes or height fields that the model does
    /// not have, have none.
    pub fn parts(&self, item: &Item, out: &mut Vec<Part>) {
        let [x, y, z] = item.size;
        let origin = match item.shape {
            Shape::Skin { .. } | Shape::Flex { .. } => item.pos.map(|x| -x),
            _ => [0.0; 3],
        };
        if let Shape::Flex { flex } = item.shape {
            self.wire_parts(flex, item.pos, out);
        }
        let mut put = |surface: usize, diagonal: [f32; 3], height: f32| {
            out.push(Part {
                surface,
                linear: [[diagonal[0], 0.0, 0.0], [0.0, diagonal[1], 0.0], [0.0, 0.0, diagonal[2]]],
                offset: [origin[0], origin[1], origin[2] + height],
                paint: self.paint(item, surface),
                two_sided: item.shape == Shape::Triangle,
            });
        };
        let mut put_builtin =
            |shape: Builtin, diagonal: [f32; 3], height: f32| put(shape as usize, diagonal, height);
        match item.shape {
            Shape::Sphere => put_builtin(Builtin::Sphere, item.size, 0.0),
            Shape::Box => put_builtin(Builtin::Cuboid, item.size, 0.0),
            Shape::Cylinder => put_builtin(Builtin::Cylinder, item.size, 0.0),
            Shape::Triangle => put_builtin(Builtin::Triangle, [x, y, 1.0], 0.0),
            Shape::Capsule => {
                let radius = 0.5 * (x + y);
                put_builtin(Builtin::Tube, item.size, 0.0);
                put_builtin(Builtin::CapTop, [x, y, radius], z - radius);
                put_builtin(Builtin::CapBottom, [x, y, radius], radius - z);
            }
            Shape::Arrow => {
                put_builtin(Builtin::Cylinder, [x, y, z / 6.0], z / 6.0);
                put_builtin(Builtin::Cone, [HEAD * x, HEAD * y, z / 6.0], z / 3.0);
            }
            Shape::ThinArrow => {
                put_builtin(Builtin::Cylinder, [x, y, z / 6.0], z / 6.0);
                put_builtin(Builtin::Cone, [x, y, z / 6.0], z / 3.0);
            }
            Shape::DoubleArrow => {
                put_builtin(Builtin::Tube, [x, y, z / 3.0], 0.0);
                put_builtin(Builtin::Cone, [HEAD * x, -HEAD * y, -z / 6.0], -z / 3.0);
                put_builtin(Builtin::Cone, [HEAD * x, HEAD * y, z / 6.0], z / 3.0);
            }
            Shape::Plane { geom } => self.plane_surface(geom).into_iter().for_each(|s| put(s, [1.0; 3], 0.0)),
            Shape::Hfield { hfield } => {
                self.hfield_surface(hfield).into_iter().for_each(|s| put(s, [1.0; 3], 0.0))
            }
            Shape::Mesh { mesh } => self.mesh_surface(mesh).into_iter().for_each(|s| put(s, [1.0; 3], 0.0)),
            Shape::Hull { mesh } => self.hull_surface(mesh).into_iter().for_each(|s| put(s, [1.0; 3], 0.0)),
            Shape::Skin { skin } => self.skin_surface(skin).into_iter().for_each(|s| put(s, [1.0; 3], 0.0)),
            Shape::Flex { flex } => self.flex_surface(flex).into_iter().for_each(|s| put(s, [1.0; 3], 0.0)),
            Shape::Line | Shape::LineBox | Shape::Label => {}
        }
    }

    fn paint(&self, item: &Item, surface: usize) -> Paint {
        let Some(material) = item.material.and_then(|id| self.material(id)) else { return Paint::Plain };
        let Some(texture) = material.texture.filter(|&t| !self.textures[t].is_empty()) else {
            return Paint::Plain;
        };
        let is_cube = self.textures[texture].is_cube();
        let from_file = matches!(
            item.shape,
            Shape::Mesh { .. }
                | Shape::Hull { .. }
                | Shape::Hfield { .. }
                | Shape::Skin { .. }
                | Shape::Flex { .. }
        );
        let mapped_by_file = from_file && !self.surfaces[surface].texcoords.is_empty();
        let uniform = |axis: usize| match material.uniform && item.size[axis] > 0.0 {
            true => item.size[axis],
            false => 1.0,
        };
        let repeat = material.repeat;
        if is_cube && mapped_by_file {
            return Paint::Plain;
        }
        if is_cube {
            let scale = if material.uniform { item.size } else { [1.0; 3] };
            return Paint::Cube { texture, scale };
        }
        let projects = self.profile() == Profile::Mujoco313;
        if mapped_by_file && projects {
            return Paint::Explicit { texture, scale: [1.0; 2], offset: [0.0; 2] };
        }
        if mapped_by_file || !(from_file || projects) {
            let positive = |x: f32| if x > 0.0 { x } else { 1.0 };
            let scale = [0, 1].map(|axis| positive(repeat[axis]) * uniform(axis));
            let infinite =
                matches!(item.shape, Shape::Plane { .. }) && (item.size[0] <= 0.0 || item.size[1] <= 0.0);
            return Paint::Explicit { texture, scale, offset: [if infinite { -0.5 } else { 0.0 }; 2] };
        }
        let in_metres = from_file || matches!(item.shape, Shape::Plane { .. });
        let per_object = |axis: usize| match in_metres && item.size[axis] > 0.0 {
            true => repeat[axis] / item.size[axis],
            false => repeat[axis],
        };
        let [a, b] = [0, 1].map(|axis| per_object(axis) * uniform(axis));
        Paint::Planar { texture, scale: [0.5 * a, -0.5 * b] }
    }
}
