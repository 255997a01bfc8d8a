//! Regular grids of lines, triangles and tetrahedra, and what is bent from them: circles and discs.

use super::cloud::Cloud;
use super::regular::{Regular, Shape};
use crate::vector::{EPS, normalize};
use physics::math::ops;
use std::f64::consts::PI;

/// Six tetrahedra that fill a cell; its corners run around the bottom, then around the top.
const CELL: [[usize; 4]; 6] =
    [[0, 3, 1, 7], [0, 1, 4, 7], [1, 3, 2, 7], [1, 2, 6, 7], [1, 5, 4, 7], [1, 6, 5, 7]];

/// Two triangles that fill a cell; its corners run around it.
const HALVES: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// The same along the other diagonal.
const OTHER_HALVES: [[usize; 3]; 2] = [[0, 1, 3], [1, 2, 3]];

/// A grid of the dimension asked for.
///
/// # Errors
/// Triangles lie in a plane, so that there is one point along z.
pub(super) fn build(wanted: &Regular) -> Result<Cloud, String> {
    match (wanted.dim, wanted.shape) {
        (1, Shape::Circle) => Ok(circle(wanted)),
        (1, _) => Ok(line(wanted)),
        (2, _) if wanted.count[2] != 1 => {
            Err("a grid of triangles lies in a plane: the third number of 'count' must be 1".into())
        }
        (2, _) => Ok(triangles(wanted)),
        _ => Ok(tetrahedra(wanted)),
    }
}

/// Place `i` along an axis, the middle at zero.
fn place(wanted: &Regular, axis: usize, i: usize) -> f64 {
    wanted.spacing[axis] * (i as f64 - 0.5 * (wanted.count[axis] as f64 - 1.0))
}

fn line(wanted: &Regular) -> Cloud {
    let n = wanted.count[0];
    Cloud {
        dim: 1,
        point: (0..n).flat_map(|i| [place(wanted, 0, i), 0.0, 0.0]).collect(),
        element: (1..n as i32).flat_map(|i| [i - 1, i]).collect(),
        ..Cloud::default()
    }
}

/// A ring; the last point counted is the first.
fn circle(wanted: &Regular) -> Cloud {
    let n = wanted.count[0] - 1;
    let step = 2.0 * PI / n as f64;
    let radius = wanted.spacing[0] / ops::sin(step / 2.0) / 2.0;
    let on_ring = |i: usize| {
        let angle = step * i as f64;
        [radius * ops::cos(angle), radius * ops::sin(angle), 0.0]
    };
    Cloud {
        dim: 1,
        point: (0..n).flat_map(on_ring).collect(),
        element: (0..n).flat_map(|i| [i as i32, if i + 1 == n { 0 } else { i as i32 + 1 }]).collect(),
        ..Cloud::default()
    }
}

fn triangles(wanted: &Regular) -> Cloud {
    let [nx, ny, _] = wanted.count;
    let mut cloud = Cloud { dim: 2, ..Cloud::default() };
    let id = |ix: usize, iy: usize| (ny * ix + iy) as i32;
    for ix in 0..nx {
        for iy in 0..ny {
            let (x, y) = (place(wanted, 0, ix), place(wanted, 1, iy));
            cloud.point.extend([x, y, 0.0]);
            if wanted.textured {
                cloud.texcoord.extend([wanted.share(ix, 0), wanted.share(iy, 1)]);
            }
            if ix + 1 == nx || iy + 1 == ny {
                continue;
            }
            // Diagonals of a disc run around its centre.
            let turns = (x < -EPS && y > -EPS) || (x > -EPS && y < -EPS);
            let halves = if turns && wanted.shape == Shape::Disc { OTHER_HALVES } else { HALVES };
            let corners = [id(ix, iy), id(ix + 1, iy), id(ix + 1, iy + 1), id(ix, iy + 1)];
            cloud.element.extend(halves.as_flattened().iter().map(|&k| corners[k]));
        }
    }
    cloud
}

fn tetrahedra(wanted: &Regular) -> Cloud {
    let [nx, ny, nz] = wanted.count;
    let mut cloud = Cloud { dim: 3, ..Cloud::default() };
    let id = |ix: usize, iy: usize, iz: usize| ((ix * ny + iy) * nz + iz) as i32;
    for ix in 0..nx {
        for iy in 0..ny {
            for iz in 0..nz {
                cloud.point.extend([place(wanted, 0, ix), place(wanted, 1, iy), place(wanted, 2, iz)]);
                if wanted.textured {
                    cloud.texcoord.extend([wanted.share(ix, 0), wanted.share(iy, 1)]);
                }
                if ix + 1 == nx || iy + 1 == ny || iz + 1 == nz {
                    continue;
                }
                let around = [(ix, iy), (ix + 1, iy), (ix + 1, iy + 1), (ix, iy + 1)];
                let corner = |k: usize| id(around[k % 4].0, around[k % 4].1, iz + k / 4);
                cloud.element.extend(CELL.as_flattened().iter().map(|&k| corner(k)));
            }
        }
    }
    cloud
}

/// A square of triangles; a disc is one whose points are moved towards circles.
///
/// # Errors
/// As [`build`].
pub(super) fn projected(wanted: &Regular) -> Result<Cloud, String> {
    let mut cloud = build(&Regular { dim: 2, ..*wanted })?;
    if wanted.shape == Shape::Disc {
        let half = wanted.half();
        for point in cloud.point.as_chunks_mut::<3>().0 {
            let reach = point[0].abs().max(point[1].abs());
            let mut direction = [point[0], point[1]];
            normalize(&mut direction);
            (point[0], point[1]) = (direction[0] * (half[0] * reach), direction[1] * (half[1] * reach));
        }
    }
    Ok(cloud)
}
