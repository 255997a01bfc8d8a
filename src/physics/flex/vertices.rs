//! Positions of vertices: fixed to bodies, or interpolated between nodes.

use super::lattice::{Lattice, track_interior};
use super::scratch::FlexScratch;
use crate::math::{Vec3, add, add_scaled, mul_mat_vec};
use crate::model::Model;
use crate::model::flex::Flex;
use crate::stages::{Flexes, Kinematics};

/// World position of a point fixed to a body.
pub(crate) fn placed(kin: &Kinematics, body: usize, local: Vec3, centred: bool) -> Vec3 {
    if centred || local == [0.0; 3] {
        kin.xpos[body]
    } else {
        add(mul_mat_vec(&kin.xmat[body], local), kin.xpos[body])
    }
}

/// Computes `flexvert_xpos`.
pub(super) fn vertices(m: &Model, kin: &Kinematics, out: &mut Flexes, scratch: &mut FlexScratch) {
    for flex in Flex::all(m) {
        if flex.is_interpolated() {
            interpolate(flex, kin, &mut scratch.nodes, &mut out.flexvert_xpos);
            continue;
        }
        let centred = m.flex_centered[flex.id];
        for v in flex.vertices() {
            let body = m.flex_vertbodyid[v] as usize;
            out.flexvert_xpos[v] = placed(kin, body, m.flex_vert[v], centred);
        }
    }
}

/// Positions of the nodes of an interpolated flex; those inside a shell follow from its faces.
pub(super) fn nodes(flex: Flex, kin: &Kinematics, out: &mut Vec<Vec3>) {
    let m = flex.m;
    let centred = m.flex_centered[flex.id];
    out.clear();
    out.extend(flex.nodes().map(|n| placed(kin, m.flex_nodebodyid[n] as usize, m.flex_node[n], centred)));
    let lattice = Lattice::new(flex);
    if lattice.is_shell {
        track_interior(lattice.size, out);
    }
}

fn interpolate(flex: Flex, kin: &Kinematics, positions: &mut Vec<Vec3>, out: &mut [Vec3]) {
    nodes(flex, kin, positions);
    let lattice = Lattice::new(flex);
    for v in flex.vertices() {
        let place = lattice.locate(flex.m.flex_vert0[v]);
        let mut sum = [0.0; 3];
        for (node, weight) in place.weights() {
            sum = add_scaled(sum, positions[node], weight);
        }
        out[v] = sum;
    }
}
