//! What plugins change in pictures: colours of geoms, and shapes of their own.

use crate::arrays::GeomType;
use crate::math::{Mat3, Vec3};

/// What the plugins of a model show of one state, beside what the model says. Made by
/// [`appearance`](crate::pipeline::appearance::appearance) when a scene is put together; physics never reads it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Appearance {
    /// By geom.
    colours: Vec<(usize, [f32; 4])>,
    marks: Vec<Mark>,
}

/// A shape that a plugin adds to a picture. It casts no shadow.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Sphere, ellipsoid, capsule, cylinder or box; nothing else has a shape that its size tells.
    pub shape: GeomType,
    /// Size, as that of a geom of this type \[m\].
    pub size: Vec3,
    /// Position, world frame \[m\].
    pub pos: Vec3,
    /// Orientation, row-major.
    pub mat: Mat3,
    /// Colour and opacity, 0 to 1.
    pub rgba: [f32; 4],
    /// Number of the object in segmentation; its type is unknown.
    pub id: usize,
}

impl Appearance {
    /// Nothing is changed any more.
    pub fn clear(&mut self) {
        self.colours.clear();
        self.marks.clear();
    }

    /// Gives a geom a colour and an opacity, 0 to 1, in place of those of the model; the last one given counts. As in the model,
    /// a geom of the default grey shows the colour of its material. Numbers that the model has no geom for change nothing.
    pub fn colour_geom(&mut self, geom: usize, rgba: [f32; 4]) {
        match self.colours.binary_search_by_key(&geom, |&(geom, _)| geom) {
            Ok(place) => self.colours[place].1 = rgba,
            Err(place) => self.colours.insert(place, (geom, rgba)),
        }
    }

    /// The colour given to a geom.
    pub fn colour_of(&self, geom: usize) -> Option<[f32; 4]> {
        let place = self.colours.binary_search_by_key(&geom, |&(geom, _)| geom).ok()?;
        Some(self.colours[place].1)
    }

    /// Adds a shape.
    pub fn add_mark(&mut self, mark: Mark) {
        self.marks.push(mark);
    }

    /// The shapes added, in their order.
    pub fn marks(&self) -> &[Mark] {
        &self.marks
    }
}
