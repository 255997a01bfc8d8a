//! Convex collision against certificates, brute force and closed forms.

use robohive_physics::collision::PreContact;
use robohive_physics::collision::convex::{ConvexScratch, convex, convex_distance};
use robohive_physics::collision::gjk::Limits;
use robohive_physics::collision::mpr::overlap;
use robohive_physics::collision::support::ConvexBody;
use robohive_physics::collision::{Shape, distance::geom_distance};
use robohive_physics::data::Kinematics;
use robohive_physics::math::{
    Vec3, add_scaled, column, cross, distance, dot, mul_mat_vec, norm, normalize, quat_normalize,
    quat_to_mat, scale, sub,
};
use robohive_physics::model::{Arrays, GeomType, Model};

/// Fixed pseudo-random numbers in \[-1, 1\].
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
    fn vector(&mut self) -> Vec3 {
        std::array::from_fn(|_| self.next())
    }
    fn place(&mut self, kin: &mut Kinematics, g: usize, spread: f64) {
        kin.geom_xpos[g] = scale(self.vector(), spread);
        let q = std::array::from_fn(|_| self.next());
        kin.geom_xmat[g] = quat_to_mat(quat_normalize(q));
    }
}

/// Triangles of the hull of points in general position, counter-clockwise seen from outside.
fn hull(points: &[Vec3]) -> Vec<[usize; 3]> {
    let n = points.len();
    let mut faces = Vec::new();
    for i in 0..n {
        for j in 0..n {
            for k in j + 1..n {
                let normal = cross(sub(points[j], points[i]), sub(points[k], points[i]));
                if i < j && points.iter().all(|&p| dot(normal, sub(p, points[i])) <= 1e-12) {
                    faces.push([i, j, k]);
                } else if i < j && points.iter().all(|&p| dot(normal, sub(p, points[i])) >= -1e-12) {
                    faces.push([i, k, j]);
                }
            }
        }
    }
    faces
}

/// Geoms `kinds` with `sizes`; meshes take `points` with polygons `faces`.
fn model(kinds: &[(GeomType, Vec3)], points: &[Vec3], faces: &[Vec<usize>]) -> (Model, Kinematics) {
    let n = points.len();
    let neighbours: Vec<Vec<usize>> = (0..n)
        .map(|v| {
            let mut around: Vec<usize> = faces
                .iter()
                .filter_map(|f| f.iter().position(|&u| u == v).map(|i| (f, i)))
                .flat_map(|(f, i)| [f[(i + 1) % f.len()], f[(i + f.len() - 1) % f.len()]])
                .collect();
            around.sort_unstable();
            around.dedup();
            around
        })
        .collect();
    let corners: usize = faces.iter().map(Vec::len).sum();
    let mut m = Arrays {
        ngeom: kinds.len(),
        nmesh: 1,
        nmeshvert: n,
        nmeshpoly: faces.len(),
        nmeshpolyvert: corners,
        nmeshpolymap: corners,
        ..Arrays::default()
    };
    m.allocate();
    for (v, p) in points.iter().enumerate() {
        m.mesh_vert[v] = p.map(|x| x as f32);
    }
    m.mesh_vertnum[0] = n as i32;
    m.mesh_polynum[0] = faces.len() as i32;
    let mut graph = vec![n as i32, faces.len() as i32];
    let mut start = 0;
    for around in &neighbours {
        graph.push(start);
        start += around.len() as i32 + 1;
    }
    graph.extend(0..n as i32);
    for around in &neighbours {
        graph.extend(around.iter().map(|&v| v as i32));
        graph.push(-1);
    }
    m.mesh_graph = graph.into();
    let mut at = 0;
    for (f, face) in faces.iter().enumerate() {
        (m.mesh_polyvertadr[f], m.mesh_polyvertnum[f]) = (at as i32, face.len() as i32);
        for &v in face {
            m.mesh_polyvert[at] = v as i32;
            at += 1;
        }
        let [a, b, c] = [points[face[0]], points[face[1]], points[face[2]]];
        m.mesh_polynormal[f] = normalize(cross(sub(b, a), sub(c, a))).0;
    }
    at = 0;
    for v in 0..n {
        m.mesh_polymapadr[v] = at as i32;
        for (f, face) in faces.iter().enumerate() {
            if face.contains(&v) {
                m.mesh_polymap[at] = f as i32;
                m.mesh_polymapnum[v] += 1;
                at += 1;
            }
        }
    }
    for (g, &(kind, size)) in kinds.iter().enumerate() {
        m.geom_type[g] = kind.code();
        m.geom_size[g] = size;
        m.geom_rbound[g] = norm(size);
        m.geom_dataid[g] = if kind == GeomType::Mesh { 0 } else { -1 };
    }
    let m = Model::unchecked(m);
    let kin = Kinematics::new(&m);
    (m, kin)
}

/// Points on a sphere of radius 0.1 m, and their hull.
fn pebble() -> (Vec<Vec3>, Vec<Vec<usize>>) {
    let mut noise = Noise(7);
    let points: Vec<Vec3> =
        (0..24).map(|_| scale(normalize(noise.vector()).0, 0.1).map(|x| f64::from(x as f32))).collect();
    let faces = hull(&points).iter().map(|f| f.to_vec()).collect();
    (points, faces)
}

const EVERY_KIND: [(GeomType, Vec3); 6] = [
    (GeomType::Sphere, [0.1, 0.0, 0.0]),
    (GeomType::Capsule, [0.05, 0.1, 0.0]),
    (GeomType::Ellipsoid, [0.05, 0.1, 0.15]),
    (GeomType::Cylinder, [0.08, 0.1, 0.0]),
    (GeomType::Box, [0.05, 0.1, 0.15]),
    (GeomType::Mesh, [0.1, 0.1, 0.1]),
];

fn body<'a>(m: &'a Model, kin: &Kinematics, g: usize) -> ConvexBody<'a> {
    ConvexBody::new(&Shape::new(m, kin, g), 0.0).expect("convex")
}

#[test]
fn climbing_the_hull_finds_the_farthest_vertex() {
    let (points, faces) = pebble();
    assert_eq!(faces.len(), 2 * points.len() - 4, "every point is on the hull");
    let (m, mut kin) = model(&EVERY_KIND, &points, &faces);
    let mut noise = Noise(1);
    for _ in 0..20 {
        noise.place(&mut kin, 5, 1.0);
        let mut mesh = body(&m, &kin, 5);
        for _ in 0..20 {
            let dir = normalize(noise.vector()).0;
            let height = |p: Vec3| dot(p, dir);
            let best = points
                .iter()
                .map(|&p| height(add_scaled(kin.geom_xpos[5], mul_mat_vec(&kin.geom_xmat[5], p), 1.0)))
                .fold(f64::MIN, f64::max);
            let farthest = mesh.support(dir);
            assert!((height(farthest) - best).abs() < 1e-15);
            assert_eq!(mesh.support([f64::NAN; 3]), farthest, "no direction, no change");
        }
    }
}

/// Nearest points prove themselves: each body lies wholly behind the plane through its own.
#[test]
fn distance_of_separated_shapes_has_a_separating_plane() {
    let (points, faces) = pebble();
    let (mut m, mut kin) = model(&EVERY_KIND, &points, &faces);
    m.options_mut().ccd_iterations = 100;
    let (mut noise, mut scratch) = (Noise(2), ConvexScratch::default());
    let mut separated = 0;
    for (g1, g2) in (0..6).flat_map(|i| (i + 1..6).map(move |j| (i, j))) {
        for _ in 0..20 {
            noise.place(&mut kin, g1, 0.1);
            noise.place(&mut kin, g2, 0.3);
            let (dist, segment) = convex_distance(&m, &kin, g1, g2, 1.0, &mut scratch);
            if dist < 1e-3 {
                continue;
            }
            separated += 1;
            let [x1, x2] = segment.expect("nearest points");
            assert!((distance(x1, x2) - dist).abs() < 1e-12);
            let normal = scale(sub(x2, x1), 1.0 / dist);
            let (mut a, mut b) = (body(&m, &kin, g1), body(&m, &kin, g2));
            let beyond_a = dot(sub(a.support(normal), x1), normal);
            let beyond_b = dot(sub(x2, b.support(scale(normal, -1.0))), normal);
            assert!(beyond_a < 2e-6 && beyond_b < 2e-6, "{g1} {g2}: {beyond_a:.1e} {beyond_b:.1e}");
        }
    }
    assert!(separated > 100);
}

/// Smallest overlap of two boxes over the 15 axes that can separate them (Gottschalk et al., 1996).
fn separating_axis_depth(kin: &Kinematics, half: [Vec3; 2]) -> f64 {
    let axes = |g: usize| (0..3).map(move |i| column(&kin.geom_xmat[g], i));
    let mut candidates: Vec<Vec3> = axes(0).chain(axes(1)).collect();
    for a in axes(0) {
        candidates.extend(axes(1).map(|b| cross(a, b)).filter(|c| norm(*c) > 1e-6));
    }
    let offset = sub(kin.geom_xpos[1], kin.geom_xpos[0]);
    let reach = |g: usize, n: Vec3| axes(g).zip(half[g]).map(|(a, h)| h * dot(a, n).abs()).sum::<f64>();
    candidates
        .into_iter()
        .map(|n| normalize(n).0)
        .map(|n| reach(0, n) + reach(1, n) - dot(offset, n).abs())
        .fold(f64::MAX, f64::min)
}

#[test]
fn depth_of_boxes_is_the_smallest_overlap_of_separating_axes() {
    let half = [[0.05, 0.1, 0.15], [0.08, 0.06, 0.12]];
    let (m, mut kin) = model(&[(GeomType::Box, half[0]), (GeomType::Box, half[1])], &[], &[]);
    let (mut noise, mut scratch) = (Noise(3), ConvexScratch::default());
    let mut overlapping = 0;
    for _ in 0..300 {
        noise.place(&mut kin, 0, 0.1);
        noise.place(&mut kin, 1, 0.1);
        let (dist, _) = convex_distance(&m, &kin, 0, 1, 1.0, &mut scratch);
        let depth = separating_axis_depth(&kin, half);
        if depth > 1e-6 {
            overlapping += 1;
            assert!((dist + depth).abs() < 1e-12, "{dist} {depth}");
        } else {
            assert!(dist >= 0.0);
        }
    }
    assert!(overlapping > 50);
}

fn contacts(m: &Model, kin: &Kinematics, margin: f64) -> Vec<PreContact> {
    let mut out = Vec::new();
    convex(m, kin, 0, 1, margin, &mut ConvexScratch::default(), &mut out);
    out
}

/// A unit-like cube as a mesh of 8 vertices and 6 quadrilaterals.
fn cube(half: f64) -> (Vec<Vec3>, Vec<Vec<usize>>) {
    let points =
        (0..8).map(|v| std::array::from_fn(|i| if v & (1 << i) != 0 { half } else { -half })).collect();
    let faces = [[1, 3, 7, 5], [0, 4, 6, 2], [2, 6, 7, 3], [0, 1, 5, 4], [4, 5, 7, 6], [0, 2, 3, 1]];
    (points, faces.iter().map(|f| f.to_vec()).collect())
}

#[test]
fn mesh_cube_on_a_box_touches_at_the_corners_of_the_overlap() {
    let (points, faces) = cube(0.125);
    let (m, mut kin) =
        model(&[(GeomType::Box, [0.5, 0.5, 0.25]), (GeomType::Mesh, [0.125; 3])], &points, &faces);
    let upright = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    kin.geom_xmat = vec![upright; 2];
    // Half over the edge of the box, sunk by 1/256.
    kin.geom_xpos = vec![[0.0; 3], [0.5, 0.1, 0.375 - 1.0 / 256.0]];
    let found = contacts(&m, &kin, 0.0);
    assert_eq!(found.len(), 4);
    for c in &found {
        assert!((c.dist + 1.0 / 256.0).abs() < 1e-15);
        assert!(distance(c.normal, [0.0, 0.0, 1.0]) < 1e-12);
        assert!((c.pos[2] - (0.25 - 0.5 / 256.0)).abs() < 1e-15);
    }
    for corner in [[0.375, -0.025], [0.375, 0.225], [0.5, -0.025], [0.5, 0.225]] {
        assert!(found.iter().any(|c| (c.pos[0] - corner[0]).hypot(c.pos[1] - corner[1]) < 1e-12));
    }
}

#[test]
fn standing_cylinder_is_supported_all_around() {
    let kinds = [(GeomType::Cylinder, [0.1, 0.2, 0.0]), (GeomType::Box, [0.5, 0.5, 0.25])];
    let (m, mut kin) = model(&kinds, &[], &[]);
    kin.geom_xmat = vec![[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]; 2];
    kin.geom_xpos = vec![[0.03, 0.02, 0.449], [0.0; 3]];
    let found = contacts(&m, &kin, 0.0);
    assert!(found.len() >= 4, "{}", found.len());
    for dir in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] {
        let reach = |c: &PreContact| dir[0] * (c.pos[0] - 0.03) + dir[1] * (c.pos[1] - 0.02);
        assert!(found.iter().map(reach).fold(f64::MIN, f64::max) > 0.05, "{dir:?}");
    }
    for c in &found {
        assert!((c.dist + 0.001).abs() < 1e-6 && (c.normal[2] + 1.0).abs() < 1e-5);
    }
}

#[test]
fn moving_out_by_the_portal_depth_separates() {
    let (points, faces) = pebble();
    let (m, mut kin) = model(&EVERY_KIND, &points, &faces);
    let limits = Limits::new(&m.opt, 0.0);
    let (mut noise, mut scratch) = (Noise(4), ConvexScratch::default());
    let mut overlapping = 0;
    for (g1, g2) in (0..6).flat_map(|i| (i + 1..6).map(move |j| (i, j))) {
        for _ in 0..10 {
            noise.place(&mut kin, g1, 0.1);
            noise.place(&mut kin, g2, 0.1);
            let apart = convex_distance(&m, &kin, g1, g2, 1.0, &mut scratch).0;
            let Some(found) = overlap(&mut body(&m, &kin, g1), &mut body(&m, &kin, g2), &limits) else {
                assert!(apart > -1e-5);
                continue;
            };
            overlapping += 1;
            assert!(found.depth > -apart - 1e-5, "no direction is shorter than the penetration");
            kin.geom_xpos[g2] = add_scaled(kin.geom_xpos[g2], found.direction, found.depth + 1e-5);
            assert!(convex_distance(&m, &kin, g1, g2, 1.0, &mut scratch).0 >= 0.0, "{g1} {g2}");
        }
    }
    assert!(overlapping > 50);
}

#[test]
fn margin_brings_contacts_of_separated_shapes() {
    let (points, faces) = pebble();
    let (m, mut kin) = model(&[(GeomType::Sphere, [0.1, 0.0, 0.0]), EVERY_KIND[5]], &points, &faces);
    let mut noise = Noise(5);
    noise.place(&mut kin, 0, 0.0);
    noise.place(&mut kin, 1, 0.0);
    kin.geom_xpos[1] = [0.25, 0.02, 0.01];
    let (dist, [x1, x2]) = geom_distance(&m, &kin, 0, 1, 1.0, &mut Default::default());
    assert!(dist > 0.01);
    assert!(contacts(&m, &kin, 0.999 * dist).is_empty());
    let found = contacts(&m, &kin, 1.001 * dist);
    assert_eq!(found.len(), 1);
    assert!((found[0].dist - dist).abs() < 1e-6);
    assert!(distance(found[0].pos, scale(add_scaled(x1, x2, 1.0), 0.5)) < 1e-4);
    assert!(distance(found[0].normal, normalize(sub(x2, x1)).0) < 1e-4);
}
