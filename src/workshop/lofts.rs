//! Surfaces from profiles: given a height, turned about an axis, carried along a path, spanned over rings.

use crate::profile::angles;
use crate::{Mesh, Profile, Vec3};
use physics::math::{add, add_scaled, column, cross, dot, quat_from_z, quat_to_mat, scale, sub, unit};

/// A place that a swept profile passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Where the profile's origin is \[m\].
    pub at: Vec3,
    /// By how much the profile is stretched along its two axes.
    pub size: [f64; 2],
}

/// The surface over rings of equally many points, closed by a flat face at either end. Seen against the direction from the first
/// ring to the last, each runs counter-clockwise. A ring whose points coincide is a tip.
///
/// # Panics
/// There are fewer than two rings, or their numbers of points differ.
pub fn loft(rings: &[Vec<Vec3>]) -> Mesh {
    let [first, .., last] = rings else { panic!("a loft needs two rings") };
    let count = first.len();
    assert!(rings.iter().all(|ring| ring.len() == count), "rings of a loft have equally many points");
    let corners: Vec<Vec3> = rings.iter().flatten().copied().collect();
    let mut faces = Vec::new();
    for ring in 1..rings.len() {
        for point in 0..count {
            let next = (point + 1) % count;
            let [a, b] = [point, next].map(|point| (ring - 1) * count + point);
            let [c, d] = [next, point].map(|point| ring * count + point);
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    faces.extend(cap(&flat(first), &[]).into_iter().map(|[a, b, c]| [a, c, b]));
    let top = (rings.len() - 1) * count;
    faces.extend(cap(&flat(last), &[]).into_iter().map(|face| face.map(|point| top + point)));
    Mesh::welded(&corners, faces)
}

/// A profile between two heights, with `holes` through it.
pub fn extrude(outline: &Profile, holes: &[Profile], [low, high]: [f64; 2]) -> Mesh {
    let loops: Vec<_> =
        std::iter::once(outline).chain(holes).map(|profile| profile.points().to_vec()).collect();
    let flat: Vec<[f64; 2]> = loops.iter().flatten().copied().collect();
    let count = flat.len();
    let at = |height: f64| flat.iter().map(move |[x, y]| [*x, *y, height]);
    let corners: Vec<Vec3> = at(low).chain(at(high)).collect();
    let mut starts = Vec::new();
    let mut faces = Vec::new();
    let mut start = 0;
    for (hole, points) in loops.iter().enumerate() {
        for point in 0..points.len() {
            let [a, b] = [point, (point + 1) % points.len()].map(|point| start + point);
            // Holes run counter-clockwise too, so that their walls face the other way.
            let [a, b] = if hole == 0 { [a, b] } else { [b, a] };
            faces.extend([[a, b, count + b], [a, count + b, count + a]]);
        }
        if hole > 0 {
            starts.push(start);
        }
        start += points.len();
    }
    let lid = cap(&flat, &starts);
    faces.extend(lid.iter().map(|[a, b, c]| [*a, *c, *b]));
    faces.extend(lid.iter().map(|face| face.map(|point| count + point)));
    Mesh::welded(&corners, faces)
}

/// A line of radii and heights (`[r, z]`) turned about the z axis in `count` steps. Where it neither begins nor ends on the axis, it
/// is closed by flat faces there; where its first point is its last, it is a ring.
pub fn revolve(line: &[[f64; 2]], count: usize) -> Mesh {
    let mut line = line.to_vec();
    // Outside is on the right of a line that runs upwards.
    let turn: f64 = line.windows(2).map(|pair| (pair[1][1] - pair[0][1]) * (pair[0][0] + pair[1][0])).sum();
    if turn < 0.0 {
        line.reverse();
    }
    let ring = |[radius, height]: &[f64; 2]| -> Vec<Vec3> {
        angles(count).map(|(sine, cosine)| [radius * cosine, radius * sine, *height]).collect()
    };
    let rings: Vec<_> = line.iter().map(ring).collect();
    if line.first() != line.last() {
        return loft(&rings);
    }
    let corners: Vec<Vec3> = rings.iter().flatten().copied().collect();
    let faces = (1..rings.len()).flat_map(|ring| {
        (0..count).flat_map(move |point| {
            let next = (point + 1) % count;
            let [a, b] = [point, next].map(|point| (ring - 1) * count + point);
            let [c, d] = [next, point].map(|point| ring * count + point);
            [[a, b, c], [a, c, d]]
        })
    });
    Mesh::welded(&corners, faces)
}

/// A profile carried along a path, always across it, without twist: tubes, bones, cables. A size of zero makes a tip. At the first station
/// the profile's first axis is the x axis made perpendicular to the path, or the y axis where the path begins along x.
///
/// # Panics
/// There are fewer than two stations.
pub fn sweep(profile: &Profile, path: &[Station]) -> Mesh {
    assert!(path.len() > 1, "a path has two stations");
    let towards = |from: usize, to: usize| unit_of(sub(path[to].at, path[from].at));
    let last = path.len() - 1;
    let start = towards(0, 1);
    let mut across = if start[0].abs() < 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let mut rings = Vec::new();
    for (index, station) in path.iter().enumerate() {
        let ahead = towards(index.saturating_sub(1), (index + 1).min(last));
        // The nearest direction that is still across the path.
        across = unit_of(add_scaled(across, ahead, -dot(across, ahead)));
        let up = cross(ahead, across);
        let place = |[x, y]: &[f64; 2]| {
            let offset = add(scale(across, x * station.size[0]), scale(up, y * station.size[1]));
            add(station.at, offset)
        };
        rings.push(profile.points().iter().map(place).collect());
    }
    loft(&rings)
}

fn unit_of(v: Vec3) -> Vec3 {
    unit(v, dot(v, v).sqrt())
}

/// The points of a ring in the plane that fits it best, counter-clockwise about its normal.
fn flat(ring: &[Vec3]) -> Vec<[f64; 2]> {
    let next = ring.iter().cycle().skip(1);
    let normal = ring
        .iter()
        .zip(next)
        .fold([0.0; 3], |sum, (a, b)| add(sum, cross(sub(*a, ring[0]), sub(*b, ring[0]))));
    let length = dot(normal, normal).sqrt();
    if length < 1e-14 {
        return Vec::new();
    }
    let frame = quat_to_mat(quat_from_z(unit(normal, length)));
    let axes = [column(&frame, 0), column(&frame, 1)];
    ring.iter().map(|point| axes.map(|axis| dot(axis, sub(*point, ring[0])))).collect()
}

/// Triangles of a face with holes, counter-clockwise; `holes` are the places of their first points.
fn cap(points: &[[f64; 2]], holes: &[usize]) -> Vec<[usize; 3]> {
    let mut found: Vec<usize> = Vec::new();
    earcut::Earcut::new().earcut(points.iter().copied(), holes, &mut found);
    let corners = found.chunks_exact(3).map(|face| [face[0], face[1], face[2]]);
    let counter_clockwise = |face: [usize; 3]| {
        let [a, b, c] = face.map(|point| points[point]);
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area < 0.0 { [face[0], face[2], face[1]] } else { face }
    };
    corners.map(counter_clockwise).collect()
}
