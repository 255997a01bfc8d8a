//! Statistics of a model at `qpos0` (documentation: XML reference, `statistic`).

use super::flex_pattern;
use crate::data::{Inertia, Kinematics};
use crate::math::{Vec3, add, distance, scale};
use crate::model::{Arrays, GeomType, JointType};

/// Smallest size a body or a model can have \[m\].
const MIN_SIZE: f64 = 1e-5;

/// Share of its size with which an infinite or static shape counts.
const BACKGROUND_SHARE: f64 = 0.1;

/// Radius with which an infinite plane counts \[m\].
const INFINITE_PLANE: f64 = 0.01;

/// Sets `dof_length` and all of `stat` but the mean inertia, from poses at `qpos0` and masses.
pub fn set_geometry(m: &mut Arrays, kin: &Kinematics) {
    extent(m, kin);
    let sizes = body_sizes(m, kin);
    if m.nbody > 1 {
        let bodies = (m.nbody - 1) as f64;
        m.stat.meansize = 0.0;
        m.stat.meanmass = 0.0;
        for b in 1..m.nbody {
            m.stat.meansize += sizes[b] / bodies;
            m.stat.meanmass += m.body_mass[b];
        }
        m.stat.meanmass /= bodies;
    }
    m.stat.extent = m.stat.extent.max(2.0 * m.stat.meansize);
    for v in 0..m.nv {
        let joint = m.dof_jntid[v] as usize;
        let offset = v as i32 - m.jnt_dofadr[joint];
        let angular = match JointType::from_code(m.jnt_type[joint]) {
            Some(JointType::Ball | JointType::Hinge) => true,
            Some(JointType::Free) => offset >= 3,
            _ => false,
        };
        let length = if angular { sizes[m.dof_bodyid[v] as usize] } else { 1.0 };
        m.dof_length.update_row(v, length);
    }
}

/// Sets the mean inertia, from the inertia matrix at `qpos0`.
pub fn set_inertia(m: &mut Arrays, inertia: &Inertia) {
    if m.nv > 0 {
        let diagonal = |v: usize| inertia.M[(m.M_rowadr[v] + m.M_rownnz[v] - 1) as usize];
        m.stat.meaninertia = (0..m.nv).map(diagonal).sum::<f64>() / m.nv as f64;
    }
}

/// Centre and longest edge of the box around bodies, joints, sites and geoms.
fn extent(m: &mut Arrays, kin: &Kinematics) {
    let (mut low, mut high) = ([1e10; 3], [-1e10; 3]);
    let mut include = |p: Vec3, radius: f64| {
        for k in 0..3 {
            low[k] = f64::min(low[k], p[k] - radius);
            high[k] = f64::max(high[k], p[k] + radius);
        }
    };
    for b in 1..m.nbody {
        include(kin.xpos[b], 0.0);
        include(kin.xipos[b], 0.0);
    }
    kin.xanchor.iter().chain(&kin.site_xpos).for_each(|&p| include(p, 0.0));
    for g in 0..m.ngeom {
        include(kin.geom_xpos[g], geom_radius(m, g));
    }
    m.stat.center = scale(add(low, high), 0.5);
    if high[0] > low[0] {
        let longest = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
        m.stat.extent = longest.max(MIN_SIZE);
    }
}

fn geom_radius(m: &Arrays, g: usize) -> f64 {
    let size = m.geom_size[g];
    match GeomType::from_code(m.geom_type[g]) {
        _ if m.geom_rbound[g] > 0.0 => m.geom_rbound[g],
        Some(GeomType::Plane) if size[0] != 0.0 || size[1] != 0.0 => size[0].max(size[1]) * BACKGROUND_SHARE,
        Some(GeomType::Plane) => INFINITE_PLANE,
        Some(GeomType::Hfield) => {
            let size = m.hfield_size[m.geom_dataid[g] as usize];
            size.into_iter().fold(f64::MIN, f64::max) * BACKGROUND_SHARE
        }
        _ => 0.0,
    }
}

/// Bodies of a flex reach along its edges; bodies of a lattice reach all its nodes.
fn flex_reach(m: &Arrays, kin: &Kinematics, sizes: &mut [f64]) {
    for f in 0..m.nflex {
        if m.flex_interp[f] != 0 {
            let first = m.flex_nodeadr[f] as usize;
            let bodies = &m.flex_nodebodyid[first..first + m.flex_nodenum[f] as usize];
            for a in bodies.iter().map(|&b| b as usize) {
                for b in bodies.iter().map(|&b| b as usize) {
                    sizes[a] = sizes[a].max(distance(kin.xpos[a], kin.xpos[b]));
                }
            }
            continue;
        }
        for e in flex_pattern::edges(m, f) {
            for v in flex_pattern::ends(m, f, e) {
                let body = m.flex_vertbodyid[v] as usize;
                sizes[body] = sizes[body].max(m.flexedge_length0[e]);
            }
        }
    }
}

/// Size of each body: the farthest reach of its joints, its children's joints and its geoms from its centre of mass.
fn body_sizes(m: &Arrays, kin: &Kinematics) -> Vec<f64> {
    let mut sizes = vec![0.0_f64; m.nbody];
    for j in 0..m.njnt {
        let body = m.jnt_bodyid[j] as usize;
        for b in [body, m.body_parentid[body] as usize] {
            sizes[b] = sizes[b].max(distance(kin.xipos[b], kin.xanchor[j]));
        }
    }
    sizes[0] = 0.0;
    for g in 0..m.ngeom {
        let b = m.geom_bodyid[g] as usize;
        if b > 0 && m.geom_rbound[g] > 0.0 {
            sizes[b] = sizes[b].max(m.geom_rbound[g] + distance(kin.xipos[b], kin.geom_xpos[g]));
        }
    }
    flex_reach(m, kin, &mut sizes);
    sizes[1..].iter_mut().for_each(|s| *s = s.max(MIN_SIZE));
    sizes
}
