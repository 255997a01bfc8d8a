//! Distances of primitive shapes (Quilez, "3D distance functions"); inside a box the field turns from radial in the
//! middle to the normals of the faces.

use super::order::{larger, smaller};
use crate::math::{Vec3, norm, normalize};
use crate::model::GeomType;
use crate::model::bounds::MAXVAL;

/// Least denominator.
const LEAST: f64 = 1.0 / MAXVAL;

/// Signed distance of `x` from a shape; zero for shapes that have none.
pub(super) fn distance(kind: GeomType, size: Vec3, x: Vec3) -> f64 {
    match kind {
        GeomType::Plane => x[2],
        GeomType::Sphere => norm(x) - size[0],
        GeomType::Box => cuboid(size, x),
        GeomType::Capsule => norm(from_segment(size[1], x)) - size[0],
        GeomType::Ellipsoid => {
            let Ellipsoid { first, second, .. } = Ellipsoid::at(size, x);
            first * (first - 1.0) / second
        }
        GeomType::Cylinder => {
            let [across, along] = [(x[0] * x[0] + x[1] * x[1]).sqrt() - size[0], x[2].abs() - size[1]];
            let outside = length([larger(across, 0.0), larger(along, 0.0)]);
            smaller(larger(across, along), 0.0) + outside
        }
        _ => 0.0,
    }
}

/// Slope of [`distance`].
pub(super) fn gradient(kind: GeomType, size: Vec3, x: Vec3) -> Vec3 {
    match kind {
        GeomType::Plane => [0.0, 0.0, 1.0],
        GeomType::Sphere => {
            let inverse = 1.0 / norm(x);
            x.map(|x| x * inverse)
        }
        GeomType::Box => cuboid_gradient(size, x),
        GeomType::Capsule => {
            let from = from_segment(size[1], x);
            let length = norm(from);
            from.map(|x| x / length)
        }
        GeomType::Ellipsoid => Ellipsoid::at(size, x).gradient(size),
        GeomType::Cylinder => cylinder_gradient(size, x),
        _ => [0.0; 3],
    }
}

fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

/// From the nearest point of the axis of a capsule.
fn from_segment(half: f64, x: Vec3) -> Vec3 {
    let nearest = if x[2] < -half {
        -half
    } else if x[2] > half {
        half
    } else {
        x[2]
    };
    [x[0], x[1], x[2] - nearest]
}

/// Direction of the field inside a box; `beyond` are the negative distances from its faces.
fn radial(size: Vec3, beyond: Vec3, x: Vec3) -> Vec3 {
    let (field, _) = normalize(std::array::from_fn(|k| -size[k] / beyond[k]));
    std::array::from_fn(|k| if x[k] < 0.0 { -field[k] } else { field[k] })
}

fn cuboid(size: Vec3, x: Vec3) -> f64 {
    let beyond: Vec3 = std::array::from_fn(|k| x[k].abs() - size[k]);
    if beyond.iter().any(|&a| a >= 0.0) {
        let largest = larger(beyond[0], larger(beyond[1], beyond[2]));
        return norm(beyond.map(|a| larger(a, 0.0))) + smaller(largest, 0.0);
    }
    let field = radial(size, beyond, x);
    let to_face: Vec3 = std::array::from_fn(|k| -beyond[k] / field[k].abs());
    -smaller(to_face[0], smaller(to_face[1], to_face[2])) * norm(field)
}

fn cuboid_gradient(size: Vec3, x: Vec3) -> Vec3 {
    let beyond: Vec3 = std::array::from_fn(|k| x[k].abs() - size[k]);
    if beyond.iter().all(|&a| a < 0.0) {
        return radial(size, beyond, x);
    }
    let outside = beyond.map(|a| larger(a, 0.0));
    let reach = norm(outside);
    std::array::from_fn(|k| if beyond[k] > 0.0 { outside[k] / reach * x[k] / x[k].abs() } else { 0.0 })
}

fn cylinder_gradient(size: Vec3, x: Vec3) -> Vec3 {
    let (radius, height) = ((x[0] * x[0] + x[1] * x[1]).sqrt(), x[2].abs());
    let [across, along] = [radius - size[0], height - size[1]];
    let from_axis = larger(radius, LEAST);
    let unit = [x[0] / from_axis, x[1] / from_axis, x[2] / larger(height, LEAST)];
    let side = across > along;
    if (if side { across } else { along }) < 0.0 {
        return if side { [unit[0], unit[1], 0.0] } else { [0.0, 0.0, unit[2]] };
    }
    let outside = [larger(across, 0.0), larger(along, 0.0)];
    let reach = larger(length(outside), LEAST);
    [unit[0] * outside[0] / reach, unit[1] * outside[0] / reach, unit[2] * outside[1] / reach]
}

/// A point in units of the axes of an ellipsoid, once and twice.
struct Ellipsoid {
    twice: Vec3,
    first: f64,
    second: f64,
}

impl Ellipsoid {
    fn at(size: Vec3, x: Vec3) -> Self {
        let once: Vec3 = std::array::from_fn(|k| x[k] / size[k]);
        let twice: Vec3 = std::array::from_fn(|k| once[k] / size[k]);
        Ellipsoid { twice, first: norm(once), second: norm(twice) }
    }

    fn gradient(&self, size: Vec3) -> Vec3 {
        let Ellipsoid { twice, first, second } = self;
        let (inverse_first, inverse_second) = (1.0 / first, 1.0 / second);
        let by_first = (2.0 * first - 1.0) * inverse_second;
        let by_second = first * (first - 1.0) * inverse_second * inverse_second;
        let sum = std::array::from_fn(|k| {
            let of_first = twice[k] * inverse_first;
            let of_second = twice[k] * inverse_second / (size[k] * size[k]);
            of_first * by_first - of_second * by_second
        });
        normalize(sum).0
    }
}
