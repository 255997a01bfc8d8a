//! Convex hulls of random point sets: laws that hold for every hull, and recorded results.

mod clouds;

use clouds::{Cloud, KINDS, cloud};
use robohive_mjcf::mesh::{Hull, convex_hull};

/// Clouds of each kind.
const CLOUDS: u64 = 60;
/// Kinds that are flat within round-off: the plane of a triangle, or the sign of the volume, may be noise.
const NEARLY_FLAT: [&str; 3] = ["thin slab", "shallow cap", "nearly cospherical"];

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// Every cloud that has a hull, with its number, largest coordinate and hull.
fn hulls() -> impl Iterator<Item = (u64, Cloud, f64, Hull)> {
    (0..CLOUDS * KINDS.len() as u64).filter_map(|seed| {
        let cloud = cloud(seed);
        let size = cloud.points.as_flattened().iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let hull = convex_hull(&cloud.points, cloud.limit).ok()?;
        Some((seed, cloud, size, hull))
    })
}

#[test]
fn hulls_are_closed_oriented_surfaces() {
    let mut count = 0;
    for (seed, Cloud { kind, points, limit }, size, hull) in hulls() {
        let name = format!("cloud {seed}, {kind}");
        count += 1;
        let mut vert = hull.vert.clone();
        vert.sort_unstable();
        vert.dedup();
        assert_eq!(vert.len(), hull.vert.len(), "{name}: a vertex is listed twice");
        assert!(limit < 0 || vert.len() <= limit as usize, "{name}: more vertices than allowed");

        let mut edges: Vec<[i32; 2]> =
            hull.face.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        edges.sort_unstable();
        assert!(edges.windows(2).all(|pair| pair[0] != pair[1]), "{name}: an edge is used twice one way");
        let twin = |&[a, b]: &[i32; 2]| edges.binary_search(&[b, a]).is_ok();
        assert!(edges.iter().all(twin), "{name}: the surface is open");
        let euler = hull.vert.len() + hull.face.len() - edges.len() / 2;
        assert_eq!(euler, 2, "{name}: no sphere");

        let listed = hull.vert.iter().zip(&hull.neighbours);
        let mut neighbours: Vec<[i32; 2]> =
            listed.flat_map(|(&v, list)| list.iter().map(move |&w| [v, w])).collect();
        neighbours.sort_unstable();
        assert_eq!(neighbours, edges, "{name}: neighbours are not those of the triangles");

        let six_volumes = |&[a, b, c]: &[i32; 3]| {
            let [a, b, c] = [a, b, c].map(|v| sub(points[v as usize], points[0]));
            dot(a, cross(b, c))
        };
        let volume: f64 = hull.face.iter().map(six_volumes).sum();
        let least = if NEARLY_FLAT.contains(&kind) { -1e-12 * size.powi(3) } else { 0.0 };
        assert!(volume > least, "{name}: inside out");
    }
    assert!(count > 1060, "only {count} clouds have a hull");
}

/// No point reaches farther in any of some directions than the vertices.
#[test]
fn hulls_reach_as_far_as_the_points() {
    let directions: Vec<[f64; 3]> = (0..125u32)
        .map(|k| [k % 5, k / 5 % 5, k / 25].map(|x| f64::from(x) - 2.0))
        .filter(|&d| d != [0.0; 3])
        .collect();
    for (seed, Cloud { kind, points, .. }, size, hull) in hulls().filter(|(_, cloud, ..)| cloud.limit < 0) {
        for &direction in &directions {
            let reach = |p: &[f64; 3]| dot(*p, direction) / length(direction);
            let all = points.iter().map(reach).fold(f64::MIN, f64::max);
            let ours = hull.vert.iter().map(|&v| reach(&points[v as usize])).fold(f64::MIN, f64::max);
            // Vertices within round-off of a facet are left out, and points may be moved by 1e-11.
            assert!(all - ours <= 1e-10 * size, "cloud {seed}, {kind}: {:e} beyond", all - ours);
        }
    }
}

/// All points are below all planes. Round-off in a corner tilts a plane the more the narrower the triangle.
#[test]
fn hulls_are_convex_and_contain_the_points() {
    let full = |cloud: &Cloud| cloud.limit < 0 && !NEARLY_FLAT.contains(&cloud.kind);
    for (seed, Cloud { kind, points, .. }, size, hull) in hulls().filter(|(_, cloud, ..)| full(cloud)) {
        for triangle in &hull.face {
            let [a, b, c] = triangle.map(|v| points[v as usize]);
            let edges = [sub(b, a), sub(c, b), sub(a, c)];
            let normal = cross(edges[0], sub(c, a));
            let longest = edges.map(length).into_iter().fold(0.0, f64::max);
            for &p in &points {
                let height_times_altitude = dot(normal, sub(p, a)) / longest;
                assert!(
                    height_times_altitude <= 1e-12 * size * size,
                    "cloud {seed}, {kind}: a point is {height_times_altitude:e} outside"
                );
            }
        }
    }
}

/// Vertices, triangles and neighbours of all clouds of a kind, in order, as FNV-1a.
#[test]
fn hulls_are_the_recorded_ones() {
    #[rustfmt::skip]
    const RECORDED: [u64; KINDS.len()] = [
        0x2f7d329f4fb0c35a, 0x7775bf508601c05e, 0x02432430e30d9912,
        0xa9713ad6a48313bf, 0x50524335690712e0, 0x3ee4d06b49c01479,
        0x07d236893805d794, 0x6ed778a685d2cddf, 0xc8b84771519ce23b,
        0xc2307fa8d901a911, 0xaca2414217cc1c7e, 0x2a46d9db59e1ce56,
        0x84a6d35d256a0279, 0xfe2fb3e65083d719, 0x8c372c42b5d2e210,
        0xa8e907879fde9f33, 0x94a0a5f3f2c10065, 0xc42d2992bda6ea0b,
    ];
    let mut sums = [0xcbf2_9ce4_8422_2325u64; KINDS.len()];
    for (seed, _, _, hull) in hulls() {
        let neighbours = hull.neighbours.into_iter().flat_map(|list| list.into_iter().chain([-1]));
        let numbers = hull.vert.into_iter().chain(hull.face.into_iter().flatten()).chain(neighbours);
        let sum = &mut sums[seed as usize % KINDS.len()];
        *sum = numbers.fold(*sum, |h, x| (h ^ u64::from(x as u32)).wrapping_mul(0x0100_0000_01b3));
    }
    for (k, (kind, _)) in KINDS.iter().enumerate() {
        assert_eq!(sums[k], RECORDED[k], "{kind}: {sums:#018x?}");
    }
}
