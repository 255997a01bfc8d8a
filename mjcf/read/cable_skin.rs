//! The skin over the boxes of a cable (XML reference, `body/composite/skin`): two layers of points, below and above, which
//! lie on each other and are inflated by half of the boxes' thickness when drawn.
//!
//! Every cross-section of the cable has a row of bones, one at each edge. With a subgrid there is one on the middle line
//! too, and more points between bones: bicubic interpolation of the sixteen bones around a cell, whose slopes are central
//! differences, and one-sided at the rim of the grid.

use crate::schema::composite::CompositeSkin;
use crate::spec::{Bone, Skin};

/// Powers of a cubic on \[0, 1\] (rows), from its values and slopes at both ends (columns: values, then slopes).
const CUBIC: [[f64; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [-3.0, 3.0, -2.0, -1.0], [2.0, -2.0, 1.0, 1.0]];

/// What a bicubic patch is made of, as columns of [`CUBIC`] along and across: values, slopes along, slopes across, both;
/// each at the four corners.
const CORNERS: [[usize; 2]; 16] = {
    let mut out = [[0; 2]; 16];
    let (kinds, corners) = ([[0, 0], [2, 0], [0, 2], [2, 2]], [[0, 0], [1, 0], [1, 1], [0, 1]]);
    let mut k = 0;
    while k < 16 {
        let (kind, corner) = (kinds[k / 4], corners[k % 4]);
        out[k] = [kind[0] + corner[0], kind[1] + corner[1]];
        k += 1;
    }
    out
};

/// A grid of points: cross-sections along the cable, points across it.
#[derive(Clone, Copy)]
struct Grid {
    along: usize,
    across: usize,
}

/// Vertices of the skin over a cable with `bodies` bodies; `None` where they cannot be counted.
pub(super) fn vertex_count(wanted: &CompositeSkin, bodies: usize) -> Option<usize> {
    let between = usize::try_from(wanted.subgrid).unwrap_or(0);
    let bones = bone_grid(between, bodies);
    let refined = |n: usize| (n - 1).checked_mul(between)?.checked_add(n);
    refined(bones.along)?.checked_mul(refined(bones.across)?)?.checked_mul(2)
}

/// The skin over boxes of these half lengths, the one of the text and not of single bodies, named in the order of the cable.
pub(super) fn cable_skin(wanted: &CompositeSkin, name: String, half: [f64; 3], bodies: &[String]) -> Skin {
    let between = usize::try_from(wanted.subgrid).unwrap_or(0);
    let bones = bone_grid(between, bodies.len());
    let points = Grid {
        along: bones.along + (bones.along - 1) * between,
        across: bones.across + (bones.across - 1) * between,
    };
    let layer = points.along * points.across;
    let mut skin = Skin {
        name,
        material: wanted.material.clone(),
        rgba: wanted.rgba,
        inflate: (2.0 * half[2]) as f32,
        group: wanted.group,
        vert: vec![0.0; 6 * layer],
        texcoord: if wanted.texcoord { texture_coordinates(points) } else { Vec::new() },
        face: faces(points),
        bones: bone_frames(bones, half, bodies),
        ..Skin::default()
    };
    if between == 0 {
        for (k, bone) in skin.bones.iter_mut().enumerate() {
            (bone.vertid, bone.vertweight) = (vec![k as i32, (layer + k) as i32], vec![1.0; 2]);
        }
    } else {
        interpolate(&mut skin.bones, bones, between);
    }
    skin
}

fn bone_grid(between: usize, bodies: usize) -> Grid {
    Grid { along: bodies + 1, across: if between > 0 { 3 } else { 2 } }
}

fn texture_coordinates(grid: Grid) -> Vec<f32> {
    let [long, wide] = [grid.along, grid.across].map(|n| (n - 1) as f32);
    let point = |k: usize| [(k / grid.across) as f32 / long, (k % grid.across) as f32 / wide];
    let layer: Vec<f32> = (0..grid.along * grid.across).flat_map(point).collect();
    layer.repeat(2)
}

/// Triangles of the lower layer, of the upper one the other way round, then those between the layers along the four rims.
fn faces(grid: Grid) -> Vec<i32> {
    let Grid { along, across } = grid;
    let at = |layer: usize, i: usize, j: usize| ((layer * along + i) * across + j) as i32;
    let mut out = Vec::new();
    for layer in [0, 1] {
        for (i, j) in (0..along - 1).flat_map(|i| (0..across - 1).map(move |j| (i, j))) {
            let [a, b] = [at(layer, i, j), at(layer, i + 1, j)];
            let [d, c] = [a + 1, b + 1];
            out.extend(if layer == 0 { [a, b, c, a, c, d] } else { [a, c, b, a, d, c] });
        }
    }
    let mut rim = |forward: bool, from: [usize; 2], to: [usize; 2]| {
        let [a, b] = [from, to].map(|[i, j]| at(0, i, j));
        let [above_a, above_b] = [from, to].map(|[i, j]| at(1, i, j));
        out.extend(if forward {
            [a, b, above_b, a, above_b, above_a]
        } else {
            [a, above_b, b, a, above_a, above_b]
        });
    };
    for (forward, j) in [(false, 0), (true, across - 1)] {
        (0..along - 1).for_each(|i| rim(forward, [i, j], [i + 1, j]));
    }
    for (forward, i) in [(true, 0), (false, along - 1)] {
        (0..across - 1).for_each(|j| rim(forward, [i, j], [i, j + 1]));
    }
    out
}

/// Bones without vertices. The last body has those at its far end too.
fn bone_frames(grid: Grid, half: [f64; 3], bodies: &[String]) -> Vec<Bone> {
    let last = bodies.len() - 1;
    let bone = |k: usize| {
        let (section, place) = (k / grid.across, k % grid.across);
        let x = if section > last { -2.0 * half[0] } else { 0.0 };
        let y = match place {
            0 => -half[1],
            _ if place + 1 == grid.across => half[1],
            _ => 0.0,
        };
        Bone {
            body: bodies[section.min(last)].clone(),
            bindpos: [x as f32, y as f32, 0.0],
            bindquat: [1.0, 0.0, 0.0, 0.0],
            ..Bone::default()
        }
    };
    (0..grid.along * grid.across).map(bone).collect()
}

/// Gives bones their vertices: cell by cell, each point to the bones that move it, at most sixteen.
fn interpolate(bones: &mut [Bone], grid: Grid, between: usize) {
    let across = grid.across + (grid.across - 1) * between;
    let layer = (grid.along + (grid.along - 1) * between) * across;
    let shapes = cell_shapes(between);
    for (i, j) in (0..grid.along - 1).flat_map(|i| (0..grid.across - 1).map(move |j| (i, j))) {
        let stencil = patch_stencil(stencil(i, grid.along), stencil(j, grid.across));
        // A cell has the points of its near sides; at the far rim also those.
        let [long, wide] =
            [(i, grid.along), (j, grid.across)].map(|(k, n)| 1 + between + usize::from(k + 2 == n));
        for (x, y) in (0..long).flat_map(|x| (0..wide).map(move |y| (x, y))) {
            let vertex = (i * (1 + between) + x) * across + j * (1 + between) + y;
            let weights = product(&shapes[x * (2 + between) + y], &stencil);
            for (k, &weight) in weights.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
                // Bones beyond the rim have no weight.
                let bone = &mut bones[(i + k / 4 - 1) * grid.across + j + k % 4 - 1];
                bone.vertid.extend([vertex as i32, (layer + vertex) as i32]);
                bone.vertweight.extend([weight as f32; 2]);
            }
        }
    }
}

/// Weights of the sixteen corner quantities of a patch at every point of a cell, row by row.
fn cell_shapes(between: usize) -> Vec<[f64; 16]> {
    let step = 1.0 / (1 + between) as f64;
    let patch: [[f64; 16]; 16] = std::array::from_fn(|power| {
        std::array::from_fn(|k| CUBIC[power / 4][CORNERS[k][0]] * CUBIC[power % 4][CORNERS[k][1]])
    });
    let place = |k: usize| k as f64 * step;
    let points = (0..2 + between).flat_map(|x| (0..2 + between).map(move |y| (place(x), place(y))));
    let powers = |(x, y): (f64, f64)| -> [f64; 16] {
        std::array::from_fn(|k| {
            let along = std::iter::repeat_n(x, k / 4);
            along.chain(std::iter::repeat_n(y, k % 4)).fold(1.0, |product, factor| product * factor)
        })
    };
    points.map(|point| product(&powers(point), &patch)).collect()
}

/// Values and slopes at both ends of cell `k` of a line of `n` bones, from the four bones around it.
fn stencil(k: usize, n: usize) -> [[f64; 4]; 4] {
    let one_sided = [0.0, -1.0, 1.0, 0.0];
    [
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        if k == 0 { one_sided } else { [-0.5, 0.0, 0.5, 0.0] },
        if k + 2 == n { one_sided } else { [0.0, -0.5, 0.0, 0.5] },
    ]
}

/// The corner quantities of a patch from its sixteen bones.
fn patch_stencil(along: [[f64; 4]; 4], across: [[f64; 4]; 4]) -> [[f64; 16]; 16] {
    CORNERS.map(|[a, b]| std::array::from_fn(|bone| along[a][bone / 4] * across[b][bone % 4]))
}

/// Product of a row and a matrix, its terms added in the order of the row, as MuJoCo rounds them.
fn product(row: &[f64; 16], matrix: &[[f64; 16]; 16]) -> [f64; 16] {
    let mut out = [0.0; 16];
    for (factor, line) in row.iter().zip(matrix) {
        out.iter_mut().zip(line).for_each(|(sum, x)| *sum += x * factor);
    }
    out
}
