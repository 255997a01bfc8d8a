//! Shapes of revolution about the z axis.

use super::{Field, fields, length, positive};
use crate::math::Legible;
use crate::math::Vec3;
use crate::model::AttributeError;
use crate::model::bounds::MINVAL;

fields! {
    /// `mujoco.sdf.torus`: a ring.
    Torus = "mujoco.sdf.torus" { radius1 = 0.35, radius2 = 0.15, } Ring;
    /// `mujoco.sdf.bowl`: a spherical shell, cut off.
    Bowl = "mujoco.sdf.bowl" { height = 0.4, radius = 1.0, thickness = 0.02, } Shell;
}

#[derive(Debug)]
struct Ring {
    /// Of the circle at its centre.
    radius1: f64,
    /// Of the tube.
    radius2: f64,
}

impl Ring {
    fn check(&self) -> Result<(), AttributeError> {
        positive("radius2", self.radius2)?;
        match self.radius1 >= 0.0 {
            true => Ok(()),
            false => {
                Err(format!("attribute 'radius1' is {}: set it to 0 or more", Legible(self.radius1)).into())
            }
        }
    }
}

impl Field for Ring {
    fn distance(&self, [x, y, z]: Vec3) -> f64 {
        length(length(x, y) - self.radius1, z) - self.radius2
    }

    fn gradient(&self, [x, y, z]: Vec3) -> Vec3 {
        let from_axis = length(x, y);
        let outward = from_axis - self.radius1;
        let reach = length(outward, z);
        let reach = if reach > MINVAL { reach } else { MINVAL };
        [outward * (x / from_axis) / reach, outward * (y / from_axis) / reach, z / reach]
    }

    fn bounds(&self) -> [f64; 6] {
        let across = self.radius1 + self.radius2;
        [0.0, 0.0, 0.0, across, across, self.radius2]
    }
}

#[derive(Debug)]
struct Shell {
    /// Of the rim above the centre of the sphere.
    height: f64,
    radius: f64,
    /// Half the wall.
    thickness: f64,
}

impl Shell {
    fn check(&self) -> Result<(), AttributeError> {
        positive("radius", self.radius)?;
        positive("thickness", self.thickness)?;
        match self.height.abs() <= self.radius {
            true => Ok(()),
            false => Err(format!(
                "attribute 'height' is {}: the rim lies on the sphere, at most the radius, {}, from its centre",
                Legible(self.height),
                Legible(self.radius)
            )
            .into()),
        }
    }
}

impl Field for Shell {
    fn distance(&self, [x, y, z]: Vec3) -> f64 {
        let width = (self.radius * self.radius - self.height * self.height).sqrt();
        let from_axis = length(x, y);
        let to_wall = if self.height * from_axis < width * z {
            length(from_axis - width, z - self.height)
        } else {
            (length(from_axis, z) - self.radius).abs()
        };
        to_wall - self.thickness
    }

    fn bounds(&self) -> [f64; 6] {
        let half = self.radius + self.thickness;
        [0.0, 0.0, 0.0, half, half, half]
    }
}
