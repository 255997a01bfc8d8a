//! The effective inertia `M + K` of flexes that are implicit in positions: `K = (dt² + dt d) S` with `S` the stiffness of
//! elasticity and of soft contacts at the present positions, and `d` the damping of a flex.
//!
//! The step solves `(M + K) a = f - dt S v` instead of `M a = f`, so that stiff cloth is stable at time steps that are usual
//! for rigid bodies. It is in use with the solver `CG` and an integrator that is implicit in velocity (MuJoCo documentation,
//! Computation, "Deformable objects").
//!
//! `matrix.rs` keeps `K` in rows that `pattern.rs` lays out, `bends.rs` and `terms.rs` apply what has none, `touch.rs` makes
//! springs of contacts. Where bending is all there is, a factor that the model keeps preconditions.

mod bends;
mod matrix;
mod pattern;
mod stiffened;
mod terms;
mod touch;

use super::scratch::FlexScratch;
use super::vertices;
use crate::inertia::{mul_inertia_matrix, solve_ld};
use crate::math::add_scaled_slice;
use crate::math::dense::dot_slice;
use crate::model::Model;
use crate::model::bounds::MINVAL;
use crate::model::flex::Flex;
use crate::stages::{Contacts, Flexes, Inertia, Poses};
use bends::Bends;
use matrix::Matrix;
pub(crate) use stiffened::is_asked_for;
use stiffened::{Rates, is_elastic_lattice};
pub(super) use stiffened::{allowed, has_soft_contacts};
pub(crate) use touch::{Touches, mark};

/// The stiffness in the inertia of one configuration. Empty while nothing asks for it.
#[derive(Clone, Debug, Default)]
pub struct Metric {
    is_on: bool,
    /// Soft contacts.
    pub(crate) touches: Touches,
    matrix: Matrix,
    /// `- dt S v`, the change of the force over a step at the present velocity.
    pub(crate) shift: Vec<f64>,
    bends: Bends,
    solution: Solution,
}

/// Working memory of conjugate gradients.
#[derive(Clone, Debug, Default)]
struct Solution {
    force: Vec<f64>,
    residual: Vec<f64>,
    preconditioned: Vec<f64>,
    direction: Vec<f64>,
    product: Vec<f64>,
}

/// What makes up the effective inertia.
#[derive(Clone, Copy, Debug)]
pub struct Effective<'a> {
    m: &'a Model,
    poses: Poses<'a>,
    flexes: &'a Flexes,
    inertia: &'a Inertia,
    metric: &'a Metric,
}

impl Metric {
    /// True when the inertia of this model has stiffness in it.
    pub(crate) fn is_on(&self) -> bool {
        self.is_on
    }

    /// Computes the stiffness at the present positions, and `flexelem_krot`, if the model's options ask for it.
    pub fn build(
        &mut self,
        m: &Model,
        Poses { kin, com }: Poses,
        inertia: &Inertia,
        con: &mut Contacts,
        flexes: &mut Flexes,
        scratch: &mut FlexScratch,
    ) {
        self.is_on = is_asked_for(m);
        self.touches.clear();
        if !self.is_on {
            return;
        }
        self.touches.find(m, com, flexes, inertia, con);
        flexes.flexelem_krot.fill(0.0);
        for flex in Flex::all(m).filter(|flex| is_elastic_lattice(*flex)) {
            vertices::nodes(flex, kin, &mut scratch.nodes);
            terms::turn_cells(flex, &scratch.nodes, &mut flexes.flexelem_krot);
        }
        self.matrix.assemble(m, kin, flexes, &self.touches, con);
        self.matrix.factor_blocks(m, inertia);
        self.bends.find(m, kin);
    }

    /// Computes `- dt S v` at the present velocity.
    pub(crate) fn set_shift(&mut self, m: &Model, poses: Poses, flexes: &Flexes, qvel: &[f64]) {
        self.shift.clear();
        self.shift.resize(m.nv, 0.0);
        let rates = Rates { constant: -m.opt.timestep, damping: 0.0 };
        terms::add_cells(m, poses, flexes, rates, qvel, &mut self.shift);
        self.bends.add_product(poses.kin, rates, qvel, &mut self.shift);
        terms::add_stretch(m, poses.kin, flexes, rates, qvel, &mut self.shift);
        self.touches.add_product(rates.constant, qvel, &mut self.shift);
    }

    /// Replaces force `x` by the acceleration that it makes without constraints.
    pub(crate) fn accelerate(
        &mut self,
        m: &Model,
        poses: Poses,
        flexes: &Flexes,
        inertia: &Inertia,
        x: &mut [f64],
    ) {
        let mut memory = std::mem::take(&mut self.solution);
        memory.force.clear();
        memory.force.extend(x.iter().zip(&self.shift).map(|(f, c)| f + c));
        self.effective(m, poses, flexes, inertia).solve(&mut memory, x);
        self.solution = memory;
    }

    /// The effective inertia.
    pub(crate) fn effective<'a>(
        &'a self,
        m: &'a Model,
        poses: Poses<'a>,
        flexes: &'a Flexes,
        inertia: &'a Inertia,
    ) -> Effective<'a> {
        Effective { m, poses, flexes, inertia, metric: self }
    }
}

impl Effective<'_> {
    /// `- dt S v`, which comes on top of the forces.
    pub(crate) fn shift(&self) -> &[f64] {
        &self.metric.shift
    }

    /// Adds `K v` to `out`.
    pub(crate) fn add_product(self, v: &[f64], out: &mut [f64]) {
        let Effective { m, poses, flexes, metric, .. } = self;
        let h = m.opt.timestep;
        let rates = Rates { constant: h * h, damping: h };
        metric.matrix.add_product(v, out);
        if metric.matrix.is_empty() {
            metric.bends.add_product(poses.kin, rates, v, out);
        }
        if metric.matrix.is_empty() || !metric.matrix.has_cells() {
            terms::add_cells(m, poses, flexes, rates, v, out);
        }
    }

    /// Sets `x` to an approximation of the acceleration that force `b` makes.
    ///
    /// Points with stiffness have a block of their own each, or all together the constant factor of bending; all other
    /// degrees of freedom have their inertia.
    pub(crate) fn precondition(self, b: &[f64], x: &mut [f64]) {
        let Effective { m, inertia, metric, .. } = self;
        x.copy_from_slice(b);
        let bending = (metric.matrix.is_empty() && m.nefm0dof > 0).then(|| m.bending_factor());
        match bending {
            Some(factor) => factor.dofs().for_each(|dof| x[dof..dof + 3].fill(0.0)),
            None => metric.matrix.clear_points(x),
        }
        solve_ld(m, &inertia.qLD, &inertia.qLDiagInv, x);
        match bending {
            Some(factor) => {
                factor.dofs().for_each(|dof| x[dof..dof + 3].copy_from_slice(&b[dof..dof + 3]));
                factor.solve(x);
            }
            None => metric.matrix.solve_blocks(b, x),
        }
    }

    /// Solves `(M + K) x = force` by conjugate gradients, to the solver's tolerance relative to the force.
    fn solve(self, memory: &mut Solution, x: &mut [f64]) {
        let (m, options) = (self.m, &self.m.opt);
        let Solution { force, residual, preconditioned, direction, product } = memory;
        x.fill(0.0);
        let square = dot_slice(force, force);
        if square <= MINVAL {
            return;
        }
        let enough = options.tolerance * options.tolerance * square;
        residual.clone_from(force);
        [&mut *preconditioned, product].into_iter().for_each(|v| v.resize(m.nv, 0.0));
        self.precondition(residual, preconditioned);
        direction.clone_from(preconditioned);
        let mut slope = dot_slice(residual, preconditioned);
        for _ in 0..options.iterations {
            mul_inertia_matrix(m, &self.inertia.M, direction, product);
            self.add_product(direction, product);
            let curvature = dot_slice(direction, product);
            if curvature <= 0.0 {
                return;
            }
            let length = slope / curvature;
            add_scaled_slice(x, direction, length);
            add_scaled_slice(residual, product, -length);
            if dot_slice(residual, residual) < enough {
                return;
            }
            self.precondition(residual, preconditioned);
            let next = dot_slice(residual, preconditioned);
            let weight = next / slope;
            direction.iter_mut().zip(preconditioned.iter()).for_each(|(d, z)| *d = z + *d * weight);
            slope = next;
        }
    }
}
