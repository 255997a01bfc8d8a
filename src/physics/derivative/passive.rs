//! Slope of passive forces over velocity: dampers of joints, edges of flexes and tendons, drag and lift of the fluid.

use super::fluid::{self, FluidScratch};
use super::inputs::{DerivativeInputs, add_square};
use crate::flex::{edges, springs};
use crate::model::flex::Flex;
use crate::model::reflected_load::{dof_damping, tendon_damping};
use crate::model::{Disable, Model};
use crate::position::tendon;

/// Adds `d qfrc_passive / d qvel`.
pub(super) fn add_passive(m: &Model, inputs: &DerivativeInputs, scratch: &mut FluidScratch, out: &mut [f64]) {
    let enabled = |flag: Disable| !m.opt.disableflags.contains(flag);
    let dampers = enabled(Disable::DAMPER);
    if (enabled(Disable::SPRING) || dampers) && (m.opt.viscosity > 0.0 || m.opt.density > 0.0) {
        fluid::add_fluid(m, inputs, scratch, out);
    }
    if !dampers {
        return;
    }
    for dof in 0..m.nv {
        let diagonal = (m.D_rowadr[dof] + m.D_diag[dof]) as usize;
        out[diagonal] -= dof_damping(m, dof).slope(inputs.state.qvel[dof].abs());
    }
    for flex in Flex::all(m).filter(|flex| !m.flex_rigid[flex.id]) {
        let slope = -m.flex_edgedamping[flex.id];
        if slope != 0.0 {
            for at in springs::moving_edges(flex).map(|e| edges::row(m, e)) {
                let columns = &m.flexedge_J_colind[at.clone()];
                add_square(m, columns, &inputs.flex.flexedge_J[at], slope, out);
            }
        }
    }
    for t in 0..m.ntendon {
        let slope = -tendon_damping(m, t).slope(inputs.vel.ten_velocity[t].abs());
        if slope != 0.0 {
            let at = tendon::row(m, t);
            add_square(m, &m.ten_J_colind[at.clone()], &inputs.ten.ten_J[at], slope, out);
        }
    }
}
