//! Linear elasticity of finite elements: matrices of stiffness, negative as MuJoCo stores them.

use super::elasticity::Material;
use super::lattice::{FiniteElement, basis, quadrature};
use physics::math::Vec3;

/// What the integrand is multiplied by.
#[derive(Clone, Copy)]
struct Lame {
    first: f64,
    shear: f64,
}

/// The stiffness of an element, three rows a node; `node` has the positions of all nodes, along the axes of the lattice.
///
/// # Errors
/// A square has no extent along one of its axes.
pub(super) fn stiffness(
    element: &FiniteElement,
    node: &[Vec3],
    order: usize,
    material: Material,
    thickness: f64,
) -> Result<Vec<f64>, String> {
    let Material { young, poisson } = material;
    let n = element.nodes.len();
    let mut matrix = vec![0.0; 9 * n * n];
    let (first, last) = (node[element.nodes[0]], node[element.nodes[n - 1]]);
    let extent: Vec3 = std::array::from_fn(|k| last[k] - first[k]);
    let shear = young / (2.0 * (1.0 + poisson));
    let points = quadrature(order);
    match element.across {
        None => {
            let lame = Lame { first: young * poisson / (1.0 + poisson) / (1.0 - 2.0 * poisson), shear };
            let size = extent[0] * extent[1] * extent[2];
            for &[s, ws] in &points {
                for &[t, wt] in &points {
                    for &[u, wu] in &points {
                        let gradients = gradients([s, t, u], order, [0, 1, 2], extent);
                        add(&mut matrix, &gradients, &[0, 1, 2], lame, ws * wt * wu * size);
                    }
                }
            }
        }
        Some(across) => {
            let along = [(across + 1) % 3, (across + 2) % 3];
            if along.iter().any(|&axis| extent[axis] == 0.0) {
                return Err(
                    "a square of the lattice's surface has no extent: the flex needs some along each axis"
                        .into(),
                );
            }
            let lame = Lame { first: young * poisson / (1.0 - poisson * poisson), shear };
            let size = extent[along[0]] * extent[along[1]];
            for &[s, ws] in &points {
                for &[t, wt] in &points {
                    let gradients = plane_gradients([s, t], order, along, extent);
                    add(&mut matrix, &gradients, &along, lame, ws * wt * size * thickness);
                }
            }
        }
    }
    Ok(matrix)
}

/// Gradients of all basis functions of a cell.
fn gradients(at: [f64; 3], order: usize, axes: [usize; 3], extent: Vec3) -> Vec<Vec3> {
    let inverse = axes.map(|axis| 1.0 / extent[axis]);
    let values = at.map(|s| (0..=order).map(|i| basis(s, i, order)).collect::<Vec<_>>());
    let [x, y, z] = &values;
    let mut all = Vec::with_capacity((order + 1).pow(3));
    for a in x {
        for b in y {
            for c in z {
                all.push([
                    inverse[0] * (a[1] * b[0] * c[0]),
                    inverse[1] * (a[0] * b[1] * c[0]),
                    inverse[2] * (a[0] * b[0] * c[1]),
                ]);
            }
        }
    }
    all
}

/// Gradients of all basis functions of a square; none across it.
fn plane_gradients(at: [f64; 2], order: usize, along: [usize; 2], extent: Vec3) -> Vec<Vec3> {
    let mut all = Vec::with_capacity((order + 1).pow(2));
    for i in 0..=order {
        for j in 0..=order {
            let (a, b) = (basis(at[0], i, order), basis(at[1], j, order));
            let mut gradient = [0.0; 3];
            gradient[along[0]] = 1.0 / extent[along[0]] * (a[1] * b[0]);
            gradient[along[1]] = 1.0 / extent[along[1]] * (a[0] * b[1]);
            all.push(gradient);
        }
    }
    all
}

/// Subtracts what one point of the integration adds to the stiffness, for displacements along `axes`.
fn add(matrix: &mut [f64], gradients: &[Vec3], axes: &[usize], lame: Lame, weight: f64) {
    let width = 3 * gradients.len();
    for (i, g) in gradients.iter().enumerate() {
        for (j, h) in gradients.iter().enumerate() {
            for &k in axes {
                for &l in axes {
                    let entry = &mut matrix[width * (3 * i + k) + 3 * j + l];
                    *entry -= lame.first * g[k] * h[l] * weight;
                    *entry -= lame.shear * strain_product(g, h, k, l) * weight;
                }
            }
        }
    }
}

/// Trace of the product of the strains of a displacement along axis `k` with gradient `g`, and along `l` with `h`.
fn strain_product(g: &Vec3, h: &Vec3, k: usize, l: usize) -> f64 {
    if k != l {
        let shared = (g[l] / 2.0) * (h[k] / 2.0);
        return shared + shared;
    }
    let row = |v: &Vec3, b: usize| if b == k { v[b] } else { v[b] / 2.0 };
    let along = (0..3).fold(0.0, |sum, b| sum + row(g, b) * row(h, b));
    (0..3).fold(0.0, |sum, a| sum + if a == k { along } else { (g[a] / 2.0) * (h[a] / 2.0) })
}

#[cfg(test)]
mod tests {
    use super::super::lattice::Lattice;
    use super::*;

    const MATERIAL: Material = Material { young: 1000.0, poisson: 0.3 };

    fn unit_box(order: usize) -> (FiniteElement, Vec<Vec3>) {
        let lattice = Lattice { order, cells: [1; 3] };
        let n = order + 1;
        let step = |i: usize| i as f64 / order as f64;
        let node = (0..n.pow(3)).map(|p| [p / (n * n), p / n % n, p % n].map(step)).collect();
        (lattice.elements(false, &[])[0].clone().unwrap(), node)
    }

    /// Forces on nodes that are displaced so that strain is uniform add up, on the side of the box, to the stress of the
    /// matrix's own shear convention.
    #[test]
    fn forces_of_any_displacement_sum_to_zero() {
        for order in [1, 2] {
            let (element, node) = unit_box(order);
            let matrix = stiffness(&element, &node, order, MATERIAL, -1.0).unwrap();
            let width = 3 * node.len();
            for column in 0..width {
                for axis in 0..3 {
                    let sum: f64 = (0..node.len()).map(|i| matrix[width * (3 * i + axis) + column]).sum();
                    assert!(sum.abs() < 1e-9 * MATERIAL.young, "order {order}: {sum}");
                }
            }
        }
    }

    #[test]
    fn uniform_strain_has_the_closed_form() {
        let (element, node) = unit_box(1);
        let matrix = stiffness(&element, &node, 1, MATERIAL, -1.0).unwrap();
        let displacement: Vec<f64> = node.iter().flat_map(|p| [0.01 * p[0], 0.0, 0.0]).collect();
        let width = displacement.len();
        let energy: f64 =
            (0..width * width).map(|k| -matrix[k] * displacement[k / width] * displacement[k % width]).sum();
        let (lambda, mu) = (1000.0 * 0.3 / 1.3 / 0.4, 1000.0 / 2.6);
        assert!((energy / ((lambda + mu) * 1e-4) - 1.0).abs() < 1e-12);
    }
}
