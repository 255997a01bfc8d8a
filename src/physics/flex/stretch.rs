//! Elasticity of triangles and tetrahedra: the Saint Venant–Kirchhoff energy, written in the squared lengths of an
//! element's edges (Weischedel, A discrete geometric view on shear-deformable shell models, 2012), with damping
//! proportional to stiffness (Kharevych et al., Geometric, Variational Integrators for Computer Animation, section 5.2).

use super::scratch::FlexScratch;
use crate::math::{Vec3, mul_mat_t_vec};
use crate::model::flex::Flex;
use crate::position::chain::apply_wrench;
use crate::stages::{Com, Flexes, Kinematics, Velocity};

/// Numbers of an element in `flex_stiffness`: the upper triangle of a 6x6 matrix.
pub(crate) const METRIC: usize = 21;

/// Vertices of the edges of a triangle and of a tetrahedron, in the order of `flex_elemedge`.
pub(crate) const TRIANGLE: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];
pub(crate) const TETRAHEDRON: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [2, 3], [0, 3], [1, 3]];

/// Stage outputs that elasticity reads.
#[derive(Clone, Copy)]
pub(crate) struct Inputs<'a> {
    pub kin: &'a Kinematics,
    pub com: &'a Com,
    pub flexes: &'a Flexes,
    pub vel: &'a Velocity,
}

/// Adds the force of the stretched elements of a flex to `qfrc`.
pub(crate) fn stretch(flex: Flex, at: Inputs, scratch: &mut FlexScratch, qfrc: &mut [f64]) {
    let Some(first) = flex.stiffness() else { return };
    let FlexScratch { force, elongation, .. } = scratch;
    force.clear();
    force.resize(flex.vertices().len(), [0.0; 3]);
    elongations(flex, at, elongation);
    match flex.dim() {
        2 => elements(flex, first, &TRIANGLE, at.flexes, elongation, force),
        3 => elements(flex, first, &TETRAHEDRON, at.flexes, elongation, force),
        _ => return,
    }
    for ((&force, v), &body) in force.iter().zip(flex.vertices()).zip(flex.vertex_bodies()) {
        push(flex, at, body as usize, at.flexes.flexvert_xpos[v], force, qfrc);
    }
}

/// Adds a force at a vertex to `qfrc`, directly where the body does nothing but slide.
fn push(flex: Flex, at: Inputs, body: usize, point: Vec3, force: Vec3, qfrc: &mut [f64]) {
    let m = flex.m;
    if m.body_simple[body] != 2 {
        apply_wrench(m, at.com, body, point, force, [0.0; 3], qfrc);
        return;
    }
    let local = mul_mat_t_vec(&at.kin.xmat[body], force);
    let first = m.body_dofadr[body].max(0) as usize;
    for (x, &f) in local.iter().enumerate().take(m.body_dofnum[body] as usize) {
        qfrc[first + x] += f;
    }
}

/// The symmetric matrix whose upper triangle is stored row by row.
#[inline]
pub(crate) fn unpack<const E: usize>(packed: &[f64]) -> [[f64; E]; E] {
    let (mut metric, mut next) = ([[0.0; E]; E], 0);
    for a in 0..E {
        for b in a..E {
            let value = packed[next];
            (metric[a][b], metric[b][a]) = (value, value);
            next += 1;
        }
    }
    metric
}

/// How much longer the square of each edge is than at rest, ahead of time by the damping.
fn elongations(flex: Flex, at: Inputs, out: &mut Vec<f64>) {
    let (m, own) = (flex.m, flex.edges());
    let dt = m.opt.timestep;
    let damping = if dt > 0.0 { m.flex_damping[flex.id] / dt } else { 0.0 };
    let (length, speed) = (&at.flexes.flexedge_length[own.clone()], &at.vel.flexedge_velocity[own.clone()]);
    out.clear();
    out.extend(length.iter().zip(speed).zip(&m.flexedge_length0[own]).map(|((&now, speed), rest)| {
        let before = now - speed * dt;
        now * now - rest * rest + (now * now - before * before) * damping
    }));
}

/// Adds the forces of all elements, whose edges have the given ends, to their vertices.
#[inline(always)]
fn elements<const E: usize>(
    flex: Flex,
    first: usize,
    ends: &[[usize; 2]; E],
    flexes: &Flexes,
    elongation: &[f64],
    force: &mut [Vec3],
) {
    let m = flex.m;
    let points = &flexes.flexvert_xpos[flex.vertices()];
    let edges = &m.flex_elemedge[m.flex_elemedgeadr[flex.id].max(0) as usize..];
    let metrics = m.flex_stiffness[first..].chunks_exact(METRIC);
    let corners = flex.corners().chunks_exact(flex.dim() + 1);
    for ((corners, edges), packed) in corners.zip(edges.chunks_exact(E)).zip(metrics) {
        let metric: [[f64; E]; E] = unpack(packed);
        let mut placed = [[0.0; 4]; 4];
        for (placed, &corner) in placed.iter_mut().zip(corners) {
            placed[..3].copy_from_slice(&points[corner as usize]);
        }
        let mut span = [[0.0; 4]; E];
        for (span, &[a, b]) in span.iter_mut().zip(ends) {
            (0..4).for_each(|x| span[x] = placed[a][x] - placed[b][x]);
        }
        // Four numbers a vector, the last of them zero: they share a register.
        let mut local = [[0.0; 4]; 4];
        for a in 0..E {
            let stretched = elongation[edges[a] as usize];
            for b in 0..E {
                let [begin, end] = ends[b];
                for x in 0..4 {
                    let pull = stretched * span[b][x] * metric[a][b];
                    local[begin][x] -= pull;
                    local[end][x] += pull;
                }
            }
        }
        for (&corner, local) in corners.iter().zip(&local) {
            let sum = &mut force[corner as usize];
            (0..3).for_each(|x| sum[x] += local[x]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Mat3, dot, mul_mat, mul_mat_t_mat, mul_mat_vec, sub};
    use crate::model::{Arrays, Model};

    const LAME: [f64; 2] = [3.0, 2.0];

    /// One element whose vertices are bodies with three slides; `metric` is its stiffness.
    fn model(dim: usize, metric: &[f64], rest: &[Vec3], edges: &[[usize; 2]]) -> Model {
        let (n, e) = (rest.len(), edges.len());
        let mut m =
            Arrays { nflex: 1, nbody: n + 1, nv: 3 * n, nflexvert: n, nflexedge: e, ..Arrays::default() };
        (m.nflexelem, m.nflexelemdata, m.nflexelemedge, m.nflexstiffness) = (1, n, e, METRIC);
        m.allocate();
        m.opt.timestep = 0.01;
        m.flex_dim[0] = dim as i32;
        (m.flex_vertnum[0], m.flex_edgenum[0], m.flex_elemnum[0]) = (n as i32, e as i32, 1);
        for v in 0..n {
            (m.flex_elem[v], m.flex_vertbodyid[v]) = (v as i32, v as i32 + 1);
            (m.body_simple[v + 1], m.body_dofnum[v + 1], m.body_dofadr[v + 1]) = (2, 3, 3 * v as i32);
        }
        for (k, &[a, b]) in edges.iter().enumerate() {
            m.flex_elemedge[k] = k as i32;
            let side = sub(rest[a], rest[b]);
            m.flexedge_length0[k] = dot(side, side).sqrt();
        }
        m.flex_stiffness[..metric.len()].copy_from_slice(metric);
        Model::unchecked(m)
    }

    /// Force on the vertices at `points`.
    fn force(m: &Model, points: &[Vec3], edges: &[[usize; 2]]) -> Vec<f64> {
        let (mut kin, com) = (Kinematics::new(m), Com::new(m));
        let (mut flexes, vel) = (Flexes::new(m), Velocity::new(m));
        kin.xmat.fill([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
        flexes.flexvert_xpos.copy_from_slice(points);
        for (k, &[a, b]) in edges.iter().enumerate() {
            let side = sub(points[a], points[b]);
            flexes.flexedge_length[k] = dot(side, side).sqrt();
        }
        let at = Inputs { kin: &kin, com: &com, flexes: &flexes, vel: &vel };
        let mut qfrc = vec![0.0; m.nv];
        stretch(Flex { m, id: 0 }, at, &mut FlexScratch::default(), &mut qfrc);
        qfrc
    }

    /// Gradients of the shape functions of a simplex whose edges from vertex 0 are the rows of `sides`, with the third side
    /// perpendicular to a triangle.
    fn gradients(sides: [Vec3; 3], count: usize) -> Vec<Vec3> {
        let volume = dot(sides[0], crate::math::cross(sides[1], sides[2]));
        let dual = |k: usize| {
            let normal = crate::math::cross(sides[(k + 1) % 3], sides[(k + 2) % 3]);
            crate::math::scale(normal, 1.0 / volume)
        };
        let others: Vec<Vec3> = (0..count - 1).map(dual).collect();
        let first = others.iter().fold([0.0; 3], |sum, &g| sub(sum, g));
        std::iter::once(first).chain(others).collect()
    }

    fn trace(a: &Mat3) -> f64 {
        a[0] + a[4] + a[8]
    }

    /// Upper triangle of the energy's matrix over squared edge lengths: an edge between vertices `a` and `b` stretches along
    /// the symmetric product of their gradients.
    fn metric(grad: &[Vec3], edges: &[[usize; 2]], content: f64) -> Vec<f64> {
        let tensor = |&[a, b]: &[usize; 2]| -> Mat3 {
            std::array::from_fn(|k| {
                let (i, j) = (k / 3, k % 3);
                -0.25 * (grad[a][i] * grad[b][j] + grad[a][j] * grad[b][i])
            })
        };
        let mut packed = Vec::new();
        for (k, a) in edges.iter().enumerate() {
            for b in &edges[k..] {
                let (s, t) = (tensor(a), tensor(b));
                let inner: f64 = s.iter().zip(&t).map(|(x, y)| x * y).sum();
                packed.push(2.0 * content * (LAME[0] * trace(&s) * trace(&t) + 2.0 * LAME[1] * inner));
            }
        }
        packed
    }

    /// Uniform strain: the force at each vertex is the first Piola-Kirchhoff stress times the gradient of its shape function.
    fn patch(dim: usize, sides: [Vec3; 3], edges: &[[usize; 2]], content: f64, gradient: Mat3) {
        let count = dim + 1;
        let rest: Vec<Vec3> = std::iter::once([0.0; 3]).chain(sides).take(count).collect();
        let grad = gradients(sides, count);
        let m = model(dim, &metric(&grad, edges, content), &rest, edges);
        let points: Vec<Vec3> = rest.iter().map(|&p| mul_mat_vec(&gradient, p)).collect();
        let found = force(&m, &points, edges);

        let mut strain = mul_mat_t_mat(&gradient, &gradient);
        (0..3).for_each(|i| strain[4 * i] -= 1.0);
        let strain = strain.map(|x| 0.5 * x);
        let stress: Mat3 = std::array::from_fn(|k| {
            2.0 * LAME[1] * strain[k] + if k % 4 == 0 { LAME[0] * trace(&strain) } else { 0.0 }
        });
        let stress = mul_mat(&gradient, &stress);
        for (v, grad) in grad.iter().enumerate() {
            let expected = mul_mat_vec(&stress, *grad).map(|x| -content * x);
            for k in 0..3 {
                assert!((found[3 * v + k] - expected[k]).abs() < 1e-12, "{found:?} {expected:?}");
            }
        }
        for k in 0..3 {
            assert!(found.iter().skip(k).step_by(3).sum::<f64>().abs() < 1e-12);
        }
    }

    #[test]
    fn a_tetrahedron_under_uniform_strain_has_the_stress_of_its_material() {
        let sides = [[1.0, 0.1, 0.0], [0.2, 0.8, -0.1], [0.1, 0.3, 1.2]];
        let volume = dot(sides[0], crate::math::cross(sides[1], sides[2])) / 6.0;
        patch(3, sides, &TETRAHEDRON, volume, [1.1, 0.2, 0.0, -0.1, 0.9, 0.05, 0.3, 0.0, 1.2]);
        // A rotation strains nothing.
        patch(3, sides, &TETRAHEDRON, volume, [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    }

    #[test]
    fn a_triangle_under_uniform_strain_has_the_stress_of_its_material() {
        let sides = [[1.0, 0.1, 0.0], [0.2, 0.8, 0.0], [0.0, 0.0, 1.0]];
        patch(2, sides, &TRIANGLE, 0.39, [1.1, 0.2, 0.0, -0.1, 0.9, 0.0, 0.0, 0.0, 1.0]);
    }
}
