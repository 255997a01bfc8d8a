//! The stiffness of bent edges, applied edge by edge.

use super::pattern::bent_edges;
use super::stiffened::Rates;
use crate::math::{Mat3, Vec3, mul_mat_t_vec, mul_mat_vec};
use crate::model::Model;
use crate::model::flex::Flex;
use crate::stages::Kinematics;

const UPRIGHT: Mat3 = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// First degree of freedom of a vertex that does not move freely.
const HELD: u32 = u32::MAX;

/// The bent edges of all sheets in one configuration.
#[derive(Clone, Debug, Default)]
pub(super) struct Bends {
    edges: Vec<Bend>,
    /// The axes of all bodies are the world's.
    upright: bool,
}

/// An edge between two triangles.
#[derive(Clone, Copy, Debug)]
struct Bend {
    /// First degree of freedom of its four vertices, and their bodies.
    dof: [u32; 4],
    body: [u32; 4],
    /// Stiffness between them.
    stencil: [f64; 16],
    /// Damping of the flex.
    damping: f64,
}

impl Bends {
    /// Finds the edges.
    pub fn find(&mut self, m: &Model, kin: &Kinematics) {
        self.edges.clear();
        self.upright = true;
        for flex in Flex::all(m).filter(|flex| flex.has_edges() && flex.dim() == 2) {
            let bodies = flex.vertex_bodies();
            for (corners, stencil) in bent_edges(flex) {
                let body = corners.map(|v| bodies[v] as usize);
                let free = body.map(|b| m.body_dofnum[b] == 3);
                let dof = std::array::from_fn(|k| if free[k] { m.body_dofadr[body[k]] as u32 } else { HELD });
                self.upright &= (0..4).all(|k| !free[k] || kin.xmat[body[k]] == UPRIGHT);
                let stencil = std::array::from_fn(|k| stencil[k]);
                let body = body.map(|b| b as u32);
                self.edges.push(Bend { dof, body, stencil, damping: m.flex_damping[flex.id] });
            }
        }
    }

    /// Adds the stiffness times `v`.
    pub fn add_product(&self, kin: &Kinematics, rates: Rates, v: &[f64], out: &mut [f64]) {
        if self.upright {
            self.add::<true>(kin, rates, v, out);
        } else {
            self.add::<false>(kin, rates, v, out);
        }
    }

    #[inline]
    fn add<const UPRIGHT: bool>(&self, kin: &Kinematics, rates: Rates, v: &[f64], out: &mut [f64]) {
        for Bend { dof, body, stencil, damping } in &self.edges {
            let scale = rates.constant + rates.damping * damping;
            if scale == 0.0 {
                continue;
            }
            let mut moved = [[0.0; 3]; 4];
            for (k, moved) in moved.iter_mut().enumerate().filter(|&(k, _)| dof[k] != HELD) {
                moved.copy_from_slice(&v[dof[k] as usize..dof[k] as usize + 3]);
                if !UPRIGHT {
                    *moved = mul_mat_vec(&kin.xmat[body[k] as usize], *moved);
                }
            }
            for (i, row) in stencil.as_chunks::<4>().0.iter().enumerate().filter(|&(i, _)| dof[i] != HELD) {
                let mut force: Vec3 = [0.0; 3];
                for (share, moved) in row.iter().zip(&moved) {
                    (0..3).for_each(|x| force[x] += moved[x] * share);
                }
                if !UPRIGHT {
                    force = mul_mat_t_vec(&kin.xmat[body[i] as usize], force);
                }
                let out = &mut out[dof[i] as usize..dof[i] as usize + 3];
                (0..3).for_each(|x| out[x] += scale * force[x]);
            }
        }
    }
}
