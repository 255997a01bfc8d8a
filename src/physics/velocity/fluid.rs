//! Forces of a surrounding fluid at rest or in uniform wind (documentation: Computation, "Fluid forces").
//!
//! A body is either a box with the body's inertia, or, when one of its geoms says so, the ellipsoids of its geoms.
//! Every model works in a local frame, on the velocity relative to the fluid, and applies its wrench at the origin.

use crate::math::{
    Spatial, Vec3, add, cross, linear, mul_mat_t_vec, mul_mat_vec, norm, ops, rotational, scale, spatial, sub,
};
use crate::model::bounds::MINVAL;
use crate::model::{GeomType, Model};
use crate::position::chain::apply_wrench;
use crate::position::frame::{Frame, geom_frame};
use crate::sleep::Awake;
use crate::stages::{Com, Kinematics, Velocity};
use std::f64::consts::PI;

/// Adds the fluid forces of all bodies to `qfrc`.
pub fn fluid(m: &Model, awake: Awake, kin: &Kinematics, com: &Com, vel: &Velocity, qfrc: &mut [f64]) {
    let (density, viscosity) = (m.opt.density, m.opt.viscosity);
    shapes(m, awake, kin, |shape, at| {
        let v = relative_velocity(m, com, vel, at);
        let wrench = match shape {
            FluidShape::InertiaBox => box_wrench(inertia_box(m, at.body), &v, density, viscosity),
            FluidShape::Ellipsoid(g) => Ellipsoid::of_geom(m, g).wrench(&v, density, viscosity),
        };
        apply(m, com, at, &wrench, qfrc);
    });
}

/// What stands for a body, or for one of its geoms, in the fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FluidShape {
    /// The box with the body's inertia.
    InertiaBox,
    /// The ellipsoid of a geom.
    Ellipsoid(usize),
}

/// Calls `f` for every shape that the fluid acts on, with its frame.
pub(crate) fn shapes(m: &Model, awake: Awake, kin: &Kinematics, mut f: impl FnMut(FluidShape, &Frame)) {
    for b in (0..m.nbody).filter(|&b| m.body_mass[b] >= MINVAL && !awake.sleeps(b)) {
        let first = usize::try_from(m.body_geomadr[b]).unwrap_or(0);
        let geoms = first..first + m.body_geomnum[b] as usize;
        if geoms.clone().any(|g| m.geom_fluid[g][0] > 0.0) {
            for g in geoms.filter(|&g| m.geom_fluid[g][0] != 0.0) {
                f(FluidShape::Ellipsoid(g), &geom_frame(m, kin, g));
            }
        } else {
            f(FluidShape::InertiaBox, &Frame { body: b, pos: kin.xipos[b], mat: kin.ximat[b] });
        }
    }
}

/// Velocity of a frame relative to the wind, in its own orientation.
pub(crate) fn relative_velocity(m: &Model, com: &Com, vel: &Velocity, at: &Frame) -> Spatial {
    let v = at.local(&at.velocity(m, com, &vel.cvel));
    spatial(rotational(&v), sub(linear(&v), mul_mat_t_vec(&at.mat, m.opt.wind)))
}

/// Applies a wrench given in the orientation of a frame at its origin.
fn apply(m: &Model, com: &Com, at: &Frame, wrench: &Spatial, qfrc: &mut [f64]) {
    let (torque, force) = (mul_mat_vec(&at.mat, rotational(wrench)), mul_mat_vec(&at.mat, linear(wrench)));
    apply_wrench(m, com, at.body, at.pos, force, torque, qfrc);
}

/// Side lengths of the homogeneous box with the mass and inertia of body `b`.
pub(crate) fn inertia_box(m: &Model, b: usize) -> Vec3 {
    let i = m.body_inertia[b];
    let side = |twice: f64| ops::sqrt(twice.max(MINVAL) / m.body_mass[b] * 6.0);
    [side(i[1] + i[2] - i[0]), side(i[0] + i[2] - i[1]), side(i[0] + i[1] - i[2])]
}

/// Stokes drag of a sphere of the mean size, and quadratic drag of the faces of the box.
fn box_wrench(side: Vec3, v: &Spatial, density: f64, viscosity: f64) -> Spatial {
    let mut f = [0.0; 6];
    if viscosity > 0.0 {
        let d = (side[0] + side[1] + side[2]) / 3.0;
        let (turn, shift) = (-PI * d * d * d * viscosity, -3.0 * PI * d * viscosity);
        f = spatial(scale(rotational(v), turn), scale(linear(v), shift));
    }
    if density > 0.0 {
        for k in 0..3 {
            let [a, b] = box_face(side, k);
            f[3 + k] -= 0.5 * density * a * b * v[3 + k].abs() * v[3 + k];
            f[k] -= box_turning(side, k, density) * v[k].abs() * v[k] / 64.0;
        }
    }
    f
}

/// Sides of the face across axis `k`, as they are numbered: MuJoCo's order of factors, to the last bit.
pub(crate) fn box_face(side: Vec3, k: usize) -> [f64; 2] {
    [[1, 2], [0, 2], [0, 1]][k].map(|i| side[i])
}

/// 64 times the coefficient of quadratic drag of a box against rotation about axis `k`.
pub(crate) fn box_turning(side: Vec3, k: usize, density: f64) -> f64 {
    let fourth = |x: f64| x * x * x * x;
    let [a, b] = box_face(side, k);
    density * side[k] * (fourth(a) + fourth(b))
}

/// A geom as an ellipsoid with its coefficients of interaction.
pub(crate) struct Ellipsoid {
    /// Semi-axes.
    pub size: Vec3,
    /// Factor of the whole wrench.
    pub interaction: f64,
    pub blunt_drag: f64,
    pub slender_drag: f64,
    pub angular_drag: f64,
    pub kutta_lift: f64,
    pub magnus_lift: f64,
    pub virtual_mass: Vec3,
    pub virtual_inertia: Vec3,
}

impl Ellipsoid {
    pub fn of_geom(m: &Model, g: usize) -> Self {
        let [
            interaction,
            blunt_drag,
            slender_drag,
            angular_drag,
            kutta_lift,
            magnus_lift,
            mx,
            my,
            mz,
            ix,
            iy,
            iz,
        ] = m.geom_fluid[g];
        Ellipsoid {
            size: semi_axes(GeomType::from_code(m.geom_type[g]), m.geom_size[g]),
            interaction,
            blunt_drag,
            slender_drag,
            angular_drag,
            kutta_lift,
            magnus_lift,
            virtual_mass: [mx, my, mz],
            virtual_inertia: [ix, iy, iz],
        }
    }

    fn wrench(&self, v: &Spatial, density: f64, viscosity: f64) -> Spatial {
        let mut f = self.added_mass(v, density);
        let viscous = self.viscous(v, density, viscosity);
        (0..6).for_each(|k| f[k] += viscous[k]);
        f.map(|x| x * self.interaction)
    }

    /// Gyroscopic wrench of the fluid that moves along.
    fn added_mass(&self, v: &Spatial, density: f64) -> Spatial {
        let (w, l) = (rotational(v), linear(v));
        let momentum: Vec3 = std::array::from_fn(|k| density * self.virtual_mass[k] * l[k]);
        let spin: Vec3 = std::array::from_fn(|k| density * self.virtual_inertia[k] * w[k]);
        spatial(add(cross(momentum, l), cross(spin, w)), cross(momentum, w))
    }

    /// Lift (Magnus, Kutta) and drag (linear and quadratic).
    fn viscous(&self, v: &Spatial, density: f64, viscosity: f64) -> Spatial {
        let (w, l) = (rotational(v), linear(v));
        let (s, max_area) = (self.size, self.max_area());

        let pair = [s[1] * s[2], s[2] * s[0], s[0] * s[1]];
        let denominator =
            pow4(pair[0]) * square(l[0]) + pow4(pair[1]) * square(l[1]) + pow4(pair[2]) * square(l[2]);
        let numerator = square(pair[0] * l[0]) + square(pair[1] * l[1]) + square(pair[2] * l[2]);
        let area = PI * ops::sqrt(denominator / numerator.max(MINVAL));
        let normal: Vec3 = std::array::from_fn(|k| square(pair[k]) * l[k]);
        let cosine = numerator / (norm(l) * denominator).max(MINVAL);

        let magnus = scale(cross(w, l), self.magnus_lift * density * self.volume());
        let circulation = scale(cross(normal, l), self.kutta_lift * density * cosine * area);
        let kutta = cross(circulation, l);

        let (largest, middle) = self.broad_axes();
        let max_moment = 8.0 / 15.0 * PI * middle * pow4(largest);
        let (diameter, moments) = (self.diameter(), self.drag_moments(max_moment));
        let moment: Vec3 = std::array::from_fn(|k| w[k] * moments[k]);
        let linear_drag = viscosity * (3.0 * PI * diameter)
            + density * norm(l) * (area * self.blunt_drag + self.slender_drag * (max_area - area));
        let angular_drag = viscosity * (PI * diameter * diameter * diameter) + density * norm(moment);
        spatial(scale(w, -angular_drag), sub(add(magnus, kutta), scale(l, linear_drag)))
    }

    /// Volume.
    pub fn volume(&self) -> f64 {
        4.0 / 3.0 * PI * self.size[0] * self.size[1] * self.size[2]
    }

    /// Diameter of the sphere of the mean size.
    pub fn diameter(&self) -> f64 {
        2.0 / 3.0 * (self.size[0] + self.size[1] + self.size[2])
    }

    /// Largest and middle semi-axis.
    pub fn broad_axes(&self) -> (f64, f64) {
        let s = self.size;
        let (largest, smallest) = (s[0].max(s[1]).max(s[2]), s[0].min(s[1]).min(s[2]));
        (largest, s[0] + s[1] + s[2] - largest - smallest)
    }

    /// Largest area that a flow can see.
    pub fn max_area(&self) -> f64 {
        let (largest, middle) = self.broad_axes();
        PI * largest * middle
    }

    /// Coefficients of quadratic drag against rotation about each axis. `max_moment`, the largest that a rotation can
    /// see, is the caller's: MuJoCo multiplies its factors in another order for the force than for its slope.
    pub fn drag_moments(&self, max_moment: f64) -> Vec3 {
        let s = self.size;
        std::array::from_fn(|k| {
            let own = 8.0 / 15.0 * PI * s[k] * pow4(s[(k + 1) % 3].max(s[(k + 2) % 3]));
            self.angular_drag * own + self.slender_drag * (max_moment - own)
        })
    }
}

/// Semi-axes of the ellipsoid that stands for a geom.
pub fn semi_axes(kind: Option<GeomType>, size: Vec3) -> Vec3 {
    match kind {
        Some(GeomType::Sphere) => [size[0]; 3],
        Some(GeomType::Capsule) => [size[0], size[0], size[1] + size[0]],
        Some(GeomType::Cylinder) => [size[0], size[0], size[1]],
        _ => size,
    }
}

pub(crate) fn square(x: f64) -> f64 {
    x * x
}

pub(crate) fn pow4(x: f64) -> f64 {
    (x * x) * (x * x)
}
