//! Saint Venant–Kirchhoff elasticity of triangles and tetrahedra as quadratic forms in squared lengths of edges, in MuJoCo's
//! scaling (`mu |E|² + lambda (tr E)²`, where textbooks halve the second term), and of bending as quadratic forms in vertices (Weischedel 2012, section 4.1; Wardetzky et al. 2007; Garg et al. 2007).

use crate::vector::{cross, dot, normalize, sub};
use physics::math::{Vec3, ops};

/// Numbers that an element has in `flex_stiffness`.
pub(super) const METRIC: usize = 21;

/// Numbers that an edge has in `flex_bending`.
pub(super) const BENDING: usize = 17;

/// Sides of a triangle, and those beside each edge: edges and sides are numbered alike.
const TRIANGLE: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];
/// Sides of a tetrahedron.
const FACES: [[usize; 3]; 4] = [[2, 1, 0], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
/// Sides of a tetrahedron that an edge is not part of.
const ACROSS: [[usize; 2]; 6] = [[2, 3], [1, 3], [2, 1], [1, 0], [0, 2], [0, 3]];

/// What a material is made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Material {
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
}

impl Material {
    /// Shear modulus \[Pa\].
    pub fn shear(self) -> f64 {
        self.young / (2.0 * (1.0 + self.poisson))
    }
}

/// The form of a triangle of some thickness; `None` where it has no area.
pub(super) fn triangle(x: [Vec3; 3], material: Material, thickness: f64) -> Option<Vec<f64>> {
    let mut normal = cross(sub(x[1], x[0]), sub(x[2], x[0]));
    let area = normalize(&mut normal) / 2.0;
    let basis: Vec<[f64; 9]> = TRIANGLE
        .iter()
        .map(|&[left, right]| {
            let [left, right] = [TRIANGLE[left], TRIANGLE[right]];
            let (l, r) = (sub(x[left[0]], x[left[1]]), sub(x[right[1]], x[right[0]]));
            let mut normal = cross(r, l);
            normalize(&mut normal);
            symmetric(cross(normal, l), cross(r, normal), 8.0 * area * area)
        })
        .collect();
    (area > 0.0).then(|| metric(&basis, material, area, thickness))
}

/// The form of a tetrahedron; `None` where it has no volume.
pub(super) fn tetrahedron(x: [Vec3; 4], material: Material) -> Option<Vec<f64>> {
    let volume = dot(cross(sub(x[1], x[0]), sub(x[2], x[0])), sub(x[3], x[0])) / 6.0;
    let normal = |[a, b, c]: [usize; 3]| cross(sub(x[b], x[a]), sub(x[c], x[a]));
    let basis: Vec<[f64; 9]> = ACROSS
        .iter()
        .map(|&[left, right]| symmetric(normal(FACES[left]), normal(FACES[right]), 72.0 * volume * volume))
        .collect();
    // Elasticity of solids has no thickness; this cancels the fourth part below.
    (volume != 0.0).then(|| metric(&basis, material, volume.abs(), 4.0))
}

/// The symmetric product of two vectors, divided.
fn symmetric(a: Vec3, b: Vec3, by: f64) -> [f64; 9] {
    std::array::from_fn(|k| (a[k / 3] * b[k % 3] + b[k / 3] * a[k % 3]) / by)
}

/// The upper triangle of the form, row by row.
fn metric(basis: &[[f64; 9]], material: Material, size: f64, thickness: f64) -> Vec<f64> {
    let Material { young, poisson } = material;
    let mu = material.shear() * size / 4.0 * thickness;
    let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)) * size / 4.0 * thickness;
    let trace = |e: &[f64; 9]| e[0] + e[4] + e[8];
    let product = |a: &[f64; 9], b: &[f64; 9]| (0..9).fold(0.0, |sum, k| sum + a[k] * b[3 * (k % 3) + k / 3]);
    let mut form = Vec::with_capacity(METRIC);
    for (i, a) in basis.iter().enumerate() {
        for b in &basis[i..] {
            form.push(mu * product(a, b) + lambda * trace(b) * trace(a));
        }
    }
    form
}

/// The form of bending at an edge between two triangles: 16 numbers for its vertices, and one for the curvature at rest.
/// `flap` has the ends of the edge and the corners opposite to it.
pub(super) fn bending(flap: [Vec3; 4], shear: f64, thickness: f64) -> [f64; BENDING] {
    let [x0, x1, x2, x3] = flap;
    let (a01, a02) = (cotangent(x0, x1, x2), cotangent(x0, x3, x1));
    let (a03, a04) = (cotangent(x1, x2, x0), cotangent(x1, x0, x3));
    let weights = [a03 + a04, a01 + a02, -(a01 + a03), -(a02 + a04)];
    let area = area(x0, x1, x2) + area(x1, x0, x3);
    let stiffness = 3.0 * shear * ops::cube(thickness) / (24.0 * area);
    let [e0, e1, e2] = [sub(x1, x0), sub(x2, x0), sub(x3, x0)];
    let [e3, e4] = [sub(x2, x1), sub(x3, x1)];
    let height =
        |a: f64, e: Vec3, b: f64, f: Vec3| -> Vec3 { std::array::from_fn(|k| -(a * e[k] + b * f[k])) };
    let squared = dot(e0, e0);
    let cosine = -dot(height(a03, e1, a01, e3), height(a04, e2, a02, e4)) / squared;
    let mut form = [0.0; BENDING];
    for k in 0..16 {
        form[k] += weights[k / 4] * weights[k % 4] * cosine * stiffness;
    }
    let twist = dot(cross(e0, e1), e2) * (a01 - a03) * (a04 - a02);
    form[16] = twist * stiffness / (squared * squared.sqrt());
    form
}

/// Cotangent of the angle at `x` between the directions to `a` and `b`.
fn cotangent(x: Vec3, a: Vec3, b: Vec3) -> f64 {
    let (e, f) = (sub(a, x), sub(b, x));
    let normal = cross(e, f);
    dot(e, f) / dot(normal, normal).sqrt()
}

fn area(a: Vec3, b: Vec3, c: Vec3) -> f64 {
    let normal = cross(sub(b, a), sub(c, a));
    dot(normal, normal).sqrt() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const MATERIAL: Material = Material { young: 100.0, poisson: 0.25 };

    /// Energy of a form whose squared edges grow from `rest` to `now`.
    fn energy(form: &[f64], rest: &[f64], now: &[f64]) -> f64 {
        let grown: Vec<f64> = rest.iter().zip(now).map(|(a, b)| b - a).collect();
        let n = grown.len();
        let mut k = form.iter();
        let mut sum = 0.0;
        for i in 0..n {
            for j in i..n {
                let both = if i == j { 1.0 } else { 2.0 };
                sum += both * k.next().unwrap() * grown[i] * grown[j];
            }
        }
        sum
    }

    fn squared(x: &[Vec3], edges: &[[usize; 2]]) -> Vec<f64> {
        edges.iter().map(|&[a, b]| dot(sub(x[a], x[b]), sub(x[a], x[b]))).collect()
    }

    /// Uniform strain has the energy of the closed form in MuJoCo's scaling, `mu |E|² + lambda (tr E)²` a volume with
    /// Green's strain `E`, up to a factor that does not depend on the strain.
    #[test]
    fn uniform_strain_of_a_tetrahedron_has_the_closed_form() {
        let x = [[0.0; 3], [1.0, 0.1, 0.0], [0.2, 0.9, 0.1], [0.1, 0.2, 1.1]];
        let edges = [[0, 1], [1, 2], [2, 0], [2, 3], [0, 3], [1, 3]];
        let form = tetrahedron(x, MATERIAL).unwrap();
        let (mu, lambda) = (40.0, 40.0);
        let ratios: Vec<f64> = [[0.1, 0.0, 0.0], [0.05, -0.02, 0.0], [0.03, 0.03, 0.03], [0.0, 0.0, -0.2]]
            .iter()
            .map(|stretch| {
                let y = x.map(|p| std::array::from_fn(|k| p[k] * (1.0 + stretch[k])));
                let green = stretch.map(|s| ((1.0 + s) * (1.0 + s) - 1.0) / 2.0);
                let trace: f64 = green.iter().sum();
                let closed = mu * green.iter().map(|g| g * g).sum::<f64>() + lambda * trace * trace;
                energy(&form, &squared(&x, &edges), &squared(&y, &edges)) / closed
            })
            .collect();
        assert!(ratios.iter().all(|r| (r / ratios[0] - 1.0).abs() < 1e-12), "{ratios:?}");
    }

    #[test]
    fn uniform_strain_of_a_triangle_has_the_closed_form() {
        let x = [[0.0; 3], [1.0, 0.1, 0.0], [0.2, 0.9, 0.0]];
        let form = triangle(x, MATERIAL, 0.1).unwrap();
        let (mu, lambda) = (40.0, 40.0);
        let ratios: Vec<f64> = [[0.1, 0.0], [0.05, -0.02], [0.03, 0.03]]
            .iter()
            .map(|stretch| {
                let y = x.map(|p| [p[0] * (1.0 + stretch[0]), p[1] * (1.0 + stretch[1]), 0.0]);
                let green = stretch.map(|s| ((1.0 + s) * (1.0 + s) - 1.0) / 2.0);
                let trace = green[0] + green[1];
                let closed = mu * (green[0] * green[0] + green[1] * green[1]) + lambda * trace * trace;
                energy(&form, &squared(&x, &TRIANGLE), &squared(&y, &TRIANGLE)) / closed
            })
            .collect();
        assert!(ratios.iter().all(|r| (r / ratios[0] - 1.0).abs() < 1e-12), "{ratios:?}");
    }

    #[test]
    fn bending_resists_no_motion_of_the_whole() {
        let flap = [[0.0; 3], [1.0, 0.0, 0.0], [0.4, 0.8, 0.0], [0.5, -0.7, 0.0]];
        let form = bending(flap, MATERIAL.shear(), 0.1);
        for row in form[..16].as_chunks::<4>().0 {
            assert!(row.iter().sum::<f64>().abs() < 1e-12 * form[0].abs());
        }
        assert!(form[0] > 0.0 && form[16].abs() < 1e-15);
    }
}
