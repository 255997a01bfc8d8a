//! Slope of fluid forces over velocity. In the local frame of `fluid` a wrench has a 6x6 Jacobian `B` with respect to
//! the velocity, so that joint space sees `J'BJ`.

use super::inputs::{DerivativeInputs, for_row, is_free_body};
use crate::math::{Mat3, Spatial, Vec3, cross_matrix, dot, linear, norm, ops, rotational, scale, spatial};
use crate::model::bounds::MINVAL;
use crate::model::{Integrator, Model};
use crate::position::chain::{chain, com_offset, point_column};
use crate::position::frame::Frame;
use crate::sleep::Awake;
use crate::velocity::fluid::{
    Ellipsoid, FluidShape, box_face, box_turning, inertia_box, relative_velocity, shapes, square,
};
use std::f64::consts::PI;

/// A 6x6 matrix: rows are torque and force, columns angular and linear velocity.
type Block = [[f64; 6]; 6];

/// Halves of rows and columns of a `Block`.
const ROTATION: usize = 0;
const TRANSLATION: usize = 3;

/// Working memory of the fluid's slope.
#[derive(Clone, Debug, Default)]
pub struct FluidScratch {
    dofs: Vec<i32>,
    /// Rows of the Jacobian.
    jac: [Vec<f64>; 6],
    sums: Vec<f64>,
}

/// Adds the slopes of the fluid forces of all bodies.
pub(super) fn add_fluid(m: &Model, inputs: &DerivativeInputs, scratch: &mut FluidScratch, out: &mut [f64]) {
    let (com, vel) = (inputs.com, inputs.vel);
    shapes(m, Awake::EVERYTHING, inputs.kin, |shape, at| {
        let v = relative_velocity(m, com, vel, at);
        let (density, viscosity) = (m.opt.density, m.opt.viscosity);
        let slope = match shape {
            FluidShape::InertiaBox => {
                let side = inertia_box(m, at.body);
                add_block(m, inputs, at, &box_viscous_slope(side, viscosity.max(0.0)), scratch, out);
                box_quadratic_slope(side, &v, density.max(0.0))
            }
            FluidShape::Ellipsoid(g) => {
                let slope = ellipsoid_slope(&Ellipsoid::of_geom(m, g), &v, density, viscosity);
                // The symmetric solver of this integrator solves only for free bodies separately.
                let symmetric = m.opt.integrator == Integrator::Implicitfast;
                if symmetric && !is_free_body(m, at.body) { symmetrized(&slope) } else { slope }
            }
        };
        add_block(m, inputs, at, &slope, scratch, out);
    });
}

fn symmetrized(b: &Block) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (b[i][j] + b[j][i])))
}

/// `out += J'BJ` with the Jacobian of a frame in its own orientation. As in MuJoCo, to the last bit, the terms of an
/// entry are added to it one by one, by rows of `B`.
fn add_block(
    m: &Model,
    inputs: &DerivativeInputs,
    at: &Frame,
    b: &Block,
    scratch: &mut FluidScratch,
    out: &mut [f64],
) {
    let FluidScratch { dofs, jac, sums } = scratch;
    let offset = com_offset(m, inputs.com, at.body, at.pos);
    dofs.clear();
    dofs.extend(chain(m, at.body).map(|dof| dof as i32));
    dofs.reverse();
    jac.iter_mut().for_each(Vec::clear);
    for &dof in &*dofs {
        let axis = rotational(&inputs.com.cdof[dof as usize]);
        let column = at.local(&spatial(axis, point_column(inputs.com, dof as usize, offset)));
        jac.iter_mut().zip(column).for_each(|(row, x)| row.push(x));
    }
    sums.resize(dofs.len(), 0.0);
    for (k, &dof) in dofs.iter().enumerate() {
        for_row(m, dof as usize, dofs, out, |entry, p| sums[p] = *entry);
        for (e, &value) in b.as_flattened().iter().enumerate().filter(|(_, value)| **value != 0.0) {
            let factor = jac[e / 6][k] * value;
            sums.iter_mut().zip(&jac[e % 6]).for_each(|(sum, x)| *sum += factor * x);
        }
        for_row(m, dof as usize, dofs, out, |entry, p| *entry = sums[p]);
    }
}

/// Slope of the viscous part of `fluid::box_wrench`.
fn box_viscous_slope(side: Vec3, viscosity: f64) -> Block {
    let mut b = [[0.0; 6]; 6];
    let d = (side[0] + side[1] + side[2]) / 3.0;
    for k in 0..3 {
        b[k][k] = -PI * d * d * d * viscosity;
        b[3 + k][3 + k] = -3.0 * PI * d * viscosity;
    }
    b
}

/// Slope of the quadratic part of `fluid::box_wrench`.
fn box_quadratic_slope(side: Vec3, v: &Spatial, density: f64) -> Block {
    let mut b = [[0.0; 6]; 6];
    for k in 0..3 {
        let [p, q] = box_face(side, k);
        b[k][k] = -box_turning(side, k, density) * 2.0 * v[k].abs() / 64.0;
        b[3 + k][3 + k] = -density * p * q * v[3 + k].abs();
    }
    b
}

/// Adds `part * diag(column_scale)` to a quadrant of `b`.
fn add_quadrant(b: &mut Block, (row, column): (usize, usize), part: &Mat3, column_scale: Vec3) {
    for i in 0..3 {
        for j in 0..3 {
            b[row + i][column + j] += part[3 * i + j] * column_scale[j];
        }
    }
}

/// Slope of `Ellipsoid::wrench`.
fn ellipsoid_slope(e: &Ellipsoid, v: &Spatial, density: f64, viscosity: f64) -> Block {
    let mut b = [[0.0; 6]; 6];
    add_magnus(&mut b, e, v, density);
    let flow = Flow::new(e.size, linear(v));
    let lift = flow.lift_slope(PI * e.kutta_lift * density);
    let drag = flow.drag_slope(e, density, viscosity);
    let torque = torque_slope(e, rotational(v), density, viscosity);
    add_quadrant(&mut b, (TRANSLATION, TRANSLATION), &lift, [1.0; 3]);
    add_quadrant(&mut b, (TRANSLATION, TRANSLATION), &drag, [1.0; 3]);
    add_quadrant(&mut b, (ROTATION, ROTATION), &torque, [1.0; 3]);
    add_added_mass(&mut b, e, v, density);
    b.map(|row| row.map(|x| x * e.interaction))
}

/// Magnus force `c w × l`.
fn add_magnus(b: &mut Block, e: &Ellipsoid, v: &Spatial, density: f64) {
    let c = e.magnus_lift * density * e.volume();
    add_quadrant(b, (TRANSLATION, ROTATION), &cross_matrix(linear(v)), [-c; 3]);
    add_quadrant(b, (TRANSLATION, TRANSLATION), &cross_matrix(rotational(v)), [c; 3]);
}

/// Gyroscopic wrench of the fluid that moves along: torque `p × l + q × w`, force `p × w`, where `p` and `q` are its
/// momenta.
fn add_added_mass(b: &mut Block, e: &Ellipsoid, v: &Spatial, density: f64) {
    let (w, l) = (rotational(v), linear(v));
    let (mass, inertia) = (scale(e.virtual_mass, density), scale(e.virtual_inertia, density));
    let p: Vec3 = std::array::from_fn(|k| mass[k] * l[k]);
    let q: Vec3 = std::array::from_fn(|k| inertia[k] * w[k]);
    let (p, q, w, l) = (cross_matrix(p), cross_matrix(q), cross_matrix(w), cross_matrix(l));
    let one = [1.0; 3];
    let (minus_mass, minus_inertia) = (scale(mass, -1.0), scale(inertia, -1.0));
    add_quadrant(b, (ROTATION, ROTATION), &q, one);
    add_quadrant(b, (ROTATION, ROTATION), &w, minus_inertia);
    add_quadrant(b, (ROTATION, TRANSLATION), &p, one);
    add_quadrant(b, (ROTATION, TRANSLATION), &l, minus_mass);
    add_quadrant(b, (TRANSLATION, ROTATION), &p, one);
    add_quadrant(b, (TRANSLATION, TRANSLATION), &w, minus_mass);
}

/// Slope of the viscous and quadratic drag torque `-w (c + density |k ∘ w|)`.
fn torque_slope(e: &Ellipsoid, w: Vec3, density: f64, viscosity: f64) -> Mat3 {
    let (largest, middle) = e.broad_axes();
    let k = e.drag_moments(8.0 / 15.0 * PI * middle * square(largest) * square(largest));
    let size = norm([w[0] * k[0], w[1] * k[1], w[2] * k[2]]).max(MINVAL);
    let gradient: Vec3 = std::array::from_fn(|i| -density / size * w[i] * k[i] * k[i]);
    let d = e.diameter();
    let diagonal = dot(w, gradient) - viscosity * (PI * d * d * d);
    std::array::from_fn(|n| w[n / 3] * gradient[n % 3] + if n % 4 == 0 { diagonal } else { 0.0 })
}

/// Linear flow past an ellipsoid. With `a` the squares of products of two semi-axes, `n = Σ a l²` and `d = Σ a² l²`,
/// the area that the flow sees is `π sqrt(d / n)`.
struct Flow {
    a: Vec3,
    l: Vec3,
    n: f64,
    d: f64,
    /// Squared speed.
    speed2: f64,
}

impl Flow {
    fn new(size: Vec3, l: Vec3) -> Self {
        let a: Vec3 = std::array::from_fn(|k| square(size[(k + 1) % 3] * size[(k + 2) % 3]));
        let sum = |weight: Vec3| (0..3).fold(0.0, |s, k| s + weight[k] * square(l[k]));
        Flow { a, l, n: sum(a), d: sum(a.map(square)), speed2: sum([1.0; 3]) }
    }

    /// Slope of the Kutta lift, `factor / π` times circulation `× l`.
    fn lift_slope(&self, factor: f64) -> Mat3 {
        let Flow { a, l, n, d, speed2 } = *self;
        let factor = factor / ops::sqrt(d * n * speed2).max(MINVAL);
        let bend: Vec3 = std::array::from_fn(|i| (0..3).fold(0.0, |s, j| s + square(l[j]) * (a[i] - a[j])));
        let (ratio, cosine) = (n / d.max(MINVAL), n / speed2.max(MINVAL));
        let inner: Vec3 = std::array::from_fn(|j| a[j] * a[j] * ratio - a[j] + cosine);
        std::array::from_fn(|e| {
            let (i, j) = (e / 3, e % 3);
            let value = (2.0 * n * (a[j] - a[i]) + inner[j] * bend[i]) * (l[i] * l[j]);
            factor * if i == j { value - bend[i] * n } else { value }
        })
    }

    /// Slope of the linear and quadratic drag force.
    fn drag_slope(&self, e: &Ellipsoid, density: f64, viscosity: f64) -> Mat3 {
        let Flow { a, l, n, d, speed2 } = *self;
        let area = PI * ops::sqrt(d / n.max(MINVAL));
        let speed = ops::sqrt(speed2);
        let quadratic = density * (area * e.blunt_drag + e.slender_drag * (e.max_area() - area));
        let per_area = density * speed * (e.blunt_drag - e.slender_drag);
        let area_factor = PI / ops::sqrt(n * n * n * d).max(MINVAL);
        let area_slope: Vec3 = std::array::from_fn(|i| {
            let turn = (0..3).fold(0.0, |s, j| s + a[j] * square(l[j]) * (a[i] - a[j]));
            per_area * area_factor * a[i] * l[i] * turn
        });
        let factor = -quadratic * (1.0 / speed.max(MINVAL));
        let viscous = viscosity * 3.0 * PI * e.diameter();
        std::array::from_fn(|k| {
            let (i, j) = (k / 3, k % 3);
            let (diagonal, drag) = if i == j { (speed2, viscous) } else { (0.0, 0.0) };
            factor * (l[i] * l[j] + diagonal) - l[i] * area_slope[j] - drag
        })
    }
}
