//! Items that a program adds to a scene, on their way between processes.

use super::wire::{Wire, WireError, record};
use render::scene::{Category, Item, Look, Object, Shape};

record!(Item { shape, pos, mat, size, rgba, look, material, rbound, object, category, unlisted, label });
record!(Look { emission, specular, shininess, reflectance });
record!(Object { kind, id });

impl Wire for Category {
    fn put(&self, out: &mut Vec<u8>) {
        out.push(match self {
            Category::Static => 0,
            Category::Dynamic => 1,
            Category::Decor => 2,
        });
    }

    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        match u8::take(from)? {
            0 => Ok(Category::Static),
            1 => Ok(Category::Dynamic),
            2 => Ok(Category::Decor),
            code => Err(WireError::Unknown("category", code.into())),
        }
    }
}

/// Shapes without a number of the model.
const PLAIN: [Shape; 11] = [
    Shape::Sphere,
    Shape::Capsule,
    Shape::Cylinder,
    Shape::Box,
    Shape::Arrow,
    Shape::ThinArrow,
    Shape::DoubleArrow,
    Shape::Line,
    Shape::LineBox,
    Shape::Triangle,
    Shape::Label,
];

impl Wire for Shape {
    fn put(&self, out: &mut Vec<u8>) {
        let (code, number) = match *self {
            Shape::Plane { geom } => (100, geom),
            Shape::Hfield { hfield } => (101, hfield),
            Shape::Mesh { mesh } => (102, mesh),
            Shape::Hull { mesh } => (103, mesh),
            Shape::Skin { skin } => (104, skin),
            Shape::Flex { flex } => (105, flex),
            plain => (PLAIN.iter().position(|shape| *shape == plain).unwrap_or(0) as u8, 0),
        };
        out.push(code);
        number.put(out);
    }

    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        let (code, number) = (u8::take(from)?, usize::take(from)?);
        Ok(match code {
            100 => Shape::Plane { geom: number },
            101 => Shape::Hfield { hfield: number },
            102 => Shape::Mesh { mesh: number },
            103 => Shape::Hull { mesh: number },
            104 => Shape::Skin { skin: number },
            105 => Shape::Flex { flex: number },
            code => match PLAIN.get(usize::from(code)) {
                Some(shape) => *shape,
                None => return Err(WireError::Unknown("shape", code.into())),
            },
        })
    }
}
