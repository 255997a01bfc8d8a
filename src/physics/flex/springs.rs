//! Springs and dampers along edges, and the energy of those springs.

use super::edges;
use crate::model::Model;
use crate::model::flex::Flex;
use crate::stages::{Flexes, Passive, Velocity};

/// Edges of a flex whose length can change.
pub(crate) fn moving_edges<'a>(flex: Flex<'a>) -> impl Iterator<Item = usize> + use<'a> {
    flex.edges().filter(move |&e| !flex.m.flexedge_rigid[e])
}

/// Adds the forces of springs and dampers along edges.
pub(crate) fn edge_springs(
    m: &Model,
    flexes: &Flexes,
    vel: &Velocity,
    [springs, dampers]: [bool; 2],
    out: &mut Passive,
) {
    for flex in Flex::all(m).filter(|flex| !m.flex_rigid[flex.id]) {
        let stiffness = if springs { m.flex_edgestiffness[flex.id] } else { 0.0 };
        let damping = if dampers { m.flex_edgedamping[flex.id] } else { 0.0 };
        if stiffness == 0.0 && damping == 0.0 {
            continue;
        }
        for e in moving_edges(flex) {
            let spring = stiffness * (m.flexedge_length0[e] - flexes.flexedge_length[e]);
            let damper = -damping * vel.flexedge_velocity[e];
            for k in edges::row(m, e) {
                let dof = m.flexedge_J_colind[k] as usize;
                out.qfrc_spring[dof] += flexes.flexedge_J[k] * spring;
                out.qfrc_damper[dof] += flexes.flexedge_J[k] * damper;
            }
        }
    }
}

/// Adds the energy of the springs of lines.
pub(crate) fn add_energy(m: &Model, flexes: &Flexes, energy: &mut f64) {
    for flex in Flex::all(m).filter(|flex| !m.flex_rigid[flex.id] && flex.dim() == 1) {
        let stiffness = m.flex_edgestiffness[flex.id];
        if stiffness == 0.0 {
            continue;
        }
        for e in moving_edges(flex) {
            let stretch = m.flexedge_length0[e] - flexes.flexedge_length[e];
            *energy += 0.5 * stiffness * stretch * stretch;
        }
    }
}
