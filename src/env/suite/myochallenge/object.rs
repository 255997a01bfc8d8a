//! An object of random shapes: three geoms of any kind, rigidly joined.

use crate::Compat;
use crate::draws::Ranges;
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::quat_of_euler;
use crate::scene::Scene;
use physics::elements::BodyId;
use physics::geometry::shape;
use physics::math::{Quat, Vec3, inertia_about, principal_axes, quat_to_mat};
use physics::model::{Draft, GeomType};
use std::f64::consts::FRAC_PI_2;

/// Shapes that a geom can have, in the order in which the original lists them.
const KINDS: [GeomType; 5] =
    [GeomType::Sphere, GeomType::Capsule, GeomType::Ellipsoid, GeomType::Cylinder, GeomType::Box];

/// Darkest and lightest colours, opaque.
const DARKEST: [f64; 4] = [0.2, 0.2, 0.2, 1.0];
const LIGHTEST: [f64; 4] = [0.9, 0.9, 0.9, 1.0];

/// What may vary; `None` keeps what the model has.
#[derive(Clone)]
pub struct ObjectArgs {
    /// Positions of the object \[m\].
    pub places: Option<Ranges>,
    /// Sizes of its geoms \[m\], which then have random shapes and places; without them only the position varies.
    pub sizes: Option<Ranges>,
    /// Its mass \[kg\].
    pub mass: Option<[f64; 2]>,
    /// Coefficients of friction.
    pub friction: Option<Ranges>,
}

/// The object of a model, and what was drawn for it.
#[derive(Clone)]
pub struct Object {
    args: ObjectArgs,
    body: BodyId,
    /// The first of its geoms, and how many there are.
    geoms: [usize; 2],
    place: Option<Vec3>,
    shapes: Vec<Shape>,
    mass: Option<f64>,
}

/// A geom as it was drawn.
#[derive(Clone)]
struct Shape {
    kind: GeomType,
    size: Vec3,
    pos: Vec3,
    quat: Quat,
    color: [f64; 4],
    friction: Option<Vec3>,
}

impl Object {
    /// The body `Object` of a model.
    ///
    /// # Errors
    /// The model has no such body.
    pub fn new(args: ObjectArgs, scene: &Scene) -> Result<Self, EnvError> {
        let body = scene.body("Object")?;
        let count = scene.model.body_geomnum[body.index()] as usize;
        let first = scene.model.body_geomadr[body.index()].max(0) as usize;
        let shapes = Vec::with_capacity(count);
        Ok(Object { args, body, geoms: [first, count], place: None, shapes, mass: None })
    }

    /// Draws place, shapes and mass, in this order; what does not vary draws nothing.
    ///
    /// # Errors
    /// A range that cannot be drawn from.
    pub fn draw(&mut self, rng: &mut Rng) -> Result<(), EnvError> {
        self.place = self.args.places.map(|places| places.draw(rng)).transpose()?;
        let Some(sizes) = self.args.sizes else { return Ok(()) };
        self.shapes.clear();
        for _ in 0..self.geoms[1] {
            self.shapes.push(Shape::draw(&sizes, self.args.friction.as_ref(), rng)?);
        }
        self.mass = self.args.mass.map(|[low, high]| rng.uniform(low, high)).transpose()?;
        Ok(())
    }

    /// Writes what was drawn into a model, and the centre of mass and the moments of inertia of shapes of equal density. The
    /// original leaves those as they were, and writes bounds that hold for every shape of these sizes.
    pub fn impose(&self, m: &mut Draft<'_>, compat: Compat) {
        let body = self.body.index();
        if let Some(place) = self.place {
            m.body_pos[body] = place;
        }
        let Some(sizes) = &self.args.sizes else { return };
        for (geom, shape) in (self.geoms[0]..).zip(&self.shapes) {
            shape.impose(m, geom);
            if compat == Compat::RoboHive07 {
                m.geom_aabb[geom][3..].copy_from_slice(&sizes.high);
                m.geom_rbound[geom] = 2.0 * sizes.high.into_iter().fold(0.0, f64::max);
            }
        }
        if let Some(mass) = self.mass {
            m.body_mass[body] = mass;
        }
        if compat == Compat::Fixed {
            let (center, moments, axes) = mass_properties(&self.shapes, m.body_mass[body]);
            m.body_ipos[body] = center;
            m.body_inertia[body] = moments;
            m.body_iquat[body] = axes;
        }
    }
}

impl Shape {
    fn draw(sizes: &Ranges, friction: Option<&Ranges>, rng: &mut Rng) -> Result<Self, EnvError> {
        let kind = *rng.choose(&KINDS)?;
        let size = sizes.draw(rng)?;
        let pos = Ranges { low: size.map(|extent| -extent), high: size }.draw(rng)?;
        let turn = Ranges { low: [-FRAC_PI_2; 3], high: [FRAC_PI_2; 3] }.draw(rng)?;
        let color = Ranges { low: DARKEST, high: LIGHTEST }.draw(rng)?;
        let friction = friction.map(|range| range.draw(rng)).transpose()?;
        Ok(Shape { kind, size, pos, quat: quat_of_euler(turn), color, friction })
    }

    fn impose(&self, m: &mut Draft<'_>, geom: usize) {
        m.geom_type[geom] = self.kind as i32;
        m.geom_size[geom] = self.size;
        m.geom_pos[geom] = self.pos;
        m.geom_quat[geom] = self.quat;
        m.geom_rgba[geom] = self.color.map(|part| part as f32);
        if let Some(friction) = self.friction {
            m.geom_friction[geom] = friction;
        }
    }
}

/// Centre of mass, principal moments of inertia and their axes of shapes of equal density and this mass together.
fn mass_properties(shapes: &[Shape], mass: f64) -> (Vec3, Vec3, Quat) {
    let volume = |shape: &Shape| shape::volume(shape.kind, shape.size, false);
    let density = mass / shapes.iter().map(volume).sum::<f64>();
    let mut total = [0.0; 10];
    for shape in shapes {
        let mass = density * volume(shape);
        let moments = shape::inertia(shape.kind, shape.size, mass, false);
        let part = inertia_about(moments, &quat_to_mat(shape.quat), shape.pos, mass);
        total.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
    }
    let [xx, yy, zz, xy, xz, yz, x, y, z, mass] = total;
    let center = [x / mass, y / mass, z / mass];
    let [x, y, z] = center;
    let about_center = [
        [xx - mass * (y * y + z * z), xy + mass * x * y, xz + mass * x * z],
        [xy + mass * x * y, yy - mass * (x * x + z * z), yz + mass * y * z],
        [xz + mass * x * z, yz + mass * y * z, zz - mass * (x * x + y * y)],
    ];
    let mut matrix = [0.0; 9];
    matrix.copy_from_slice(about_center.as_flattened());
    let (moments, axes) = principal_axes(&matrix);
    (center, moments, axes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(pos: Vec3) -> Shape {
        let quat = quat_of_euler([0.0; 3]);
        Shape { kind: GeomType::Box, size: [0.01; 3], pos, quat, color: [1.0; 4], friction: None }
    }

    #[test]
    fn two_cubes_side_by_side_are_a_bar() {
        let bar = shape::inertia(GeomType::Box, [0.02, 0.01, 0.01], 0.3, false);
        let (center, moments, axes) = mass_properties(&[cube([0.0, 0.0, 0.1]), cube([0.02, 0.0, 0.1])], 0.3);
        assert!(center.iter().zip([0.01, 0.0, 0.1]).all(|(a, b)| (a - b).abs() < 1e-15), "{center:?}");
        let frame = quat_to_mat(axes);
        // Moments come in decreasing order: the axis of the smallest one is that along the bar.
        assert!((frame[2].abs() - 1.0).abs() < 1e-12, "{frame:?}");
        for (moment, expected) in moments.iter().zip([bar[1], bar[2], bar[0]]) {
            assert!((moment - expected).abs() < 1e-15, "{moments:?}, not {bar:?}");
        }
    }
}
