//! Cube textures, looked up by direction.

use super::halving::Halving;
use super::lerp::{lerp_f32, unpack};
use super::level_image::LevelImage;
use super::lod;
use super::source::Image;

/// The mip chains of six faces, in the order +x, -x, +y, -y, +z, -z. Every face has a frame of the texels beyond its
/// edges, which belong to its neighbours, so that filters need not leave it.
#[derive(Clone, Debug)]
pub(super) struct CubeMap {
    levels: Vec<Level>,
    texels: Vec<u32>,
}

/// One level of the six mip chains.
#[derive(Clone, Copy, Debug)]
struct Level {
    /// Columns and rows of a face, without its frame.
    side: usize,
    /// First texel of the first face.
    start: usize,
}

/// A point on a cube with corners at -1 and 1: a face and coordinates on it, from -1 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    face: usize,
    s: f32,
    t: f32,
}

/// The major axis of a direction, and the axes and signs of s and t on its face.
#[derive(Clone, Copy)]
struct Frame {
    face: usize,
    major: usize,
    s: (usize, f32),
    t: (usize, f32),
}

/// Frames of the six faces, by OpenGL's table of cube maps.
const FRAMES: [Frame; 6] = [
    Frame { face: 0, major: 0, s: (2, -1.0), t: (1, -1.0) },
    Frame { face: 1, major: 0, s: (2, 1.0), t: (1, -1.0) },
    Frame { face: 2, major: 1, s: (0, 1.0), t: (2, 1.0) },
    Frame { face: 3, major: 1, s: (0, 1.0), t: (2, -1.0) },
    Frame { face: 4, major: 2, s: (0, 1.0), t: (1, -1.0) },
    Frame { face: 5, major: 2, s: (0, -1.0), t: (1, -1.0) },
];

#[inline]
fn frame_of(direction: [f32; 3]) -> &'static Frame {
    let [x, y, z] = direction.map(f32::abs);
    let major = if x >= y && x >= z { 0 } else { 1 + usize::from(y < z) };
    &FRAMES[2 * major + usize::from(direction[major] < 0.0)]
}

#[inline]
fn place_of(direction: [f32; 3]) -> Place {
    let frame = frame_of(direction);
    let scale = 1.0 / direction[frame.major].abs();
    let on_face = |(axis, sign): (usize, f32)| sign * direction[axis] * scale;
    Place { face: frame.face, s: on_face(frame.s), t: on_face(frame.t) }
}

fn direction_of(place: Place) -> [f32; 3] {
    let frame = &FRAMES[place.face];
    let mut direction = [0.0; 3];
    direction[frame.major] = if place.face.is_multiple_of(2) { 1.0 } else { -1.0 };
    direction[frame.s.0] = frame.s.1 * place.s;
    direction[frame.t.0] = frame.t.1 * place.t;
    direction
}

impl CubeMap {
    /// Six faces one below the other, or one square for all of them.
    pub fn new(image: &Image) -> Self {
        let mut faces = Faces::of(image);
        let mut map = CubeMap { levels: levels(faces.side), texels: Vec::new() };
        map.texels.reserve_exact(map.levels.iter().map(Level::texels).sum());
        loop {
            map.push(&faces);
            if faces.side == 1 {
                return map;
            }
            faces = faces.halved();
        }
    }

    pub fn images(&self) -> impl Iterator<Item = LevelImage<'_>> {
        self.levels.iter().enumerate().flat_map(move |(level, &Level { side, start })| {
            let stride = side + 2;
            (0..6).map(move |face| LevelImage {
                level,
                face,
                width: side,
                height: side,
                stride,
                pixels: &self.texels[start + face * stride * stride + stride + 1..],
            })
        })
    }

    pub fn bytes(&self) -> usize {
        std::mem::size_of_val(&self.texels[..])
    }

    fn push(&mut self, faces: &Faces) {
        let side = faces.side as i32;
        for face in 0..6 {
            for row in -1..=side {
                self.texels.push(faces.framed_texel(face, [-1, row]));
                match usize::try_from(row).ok().filter(|&row| row < faces.side) {
                    Some(row) => self.texels.extend_from_slice(faces.row(face, row)),
                    None => {
                        self.texels.extend((0..side).map(|column| faces.framed_texel(face, [column, row])))
                    }
                }
                self.texels.push(faces.framed_texel(face, [side, row]));
            }
        }
    }

    #[inline]
    pub fn lod(&self, direction: [f32; 3], dx: [f32; 3], dy: [f32; 3]) -> f32 {
        let frame = frame_of(direction);
        let inverse = 1.0 / direction[frame.major];
        let half_side = 0.5 * self.levels[0].side as f32;
        let on_face = |d: [f32; 3]| {
            let approach = d[frame.major] * inverse;
            let moved = |axis: usize| (d[axis] - direction[axis] * approach) * inverse * half_side;
            [moved(frame.s.0), moved(frame.t.0)]
        };
        lod::of_footprint(on_face(dx), on_face(dy))
    }

    #[inline]
    pub fn sample(&self, direction: [f32; 3], lod: f32) -> [f32; 4] {
        let (level, weight) = lod::split(lod, self.levels.len() - 1);
        let place = place_of(direction);
        let fine = self.bilinear(level, place);
        if weight == 0.0 {
            return fine;
        }
        lerp_f32(fine, self.bilinear(level + 1, place), weight)
    }

    #[inline]
    fn bilinear(&self, level: usize, place: Place) -> [f32; 4] {
        let Level { side, start } = self.levels[level];
        let stride = side + 2;
        // Casts replace what is not a number by 0.
        let tap = |coordinate: f32| {
            let at = (0.5 * coordinate + 0.5) * side as f32 + 0.5;
            let first = (at as usize).min(side);
            (first, at - first as f32)
        };
        let (x, weight_x) = tap(place.s);
        let (y, weight_y) = tap(place.t);
        let corner = start + place.face * stride * stride + y * stride + x;
        let texels = &self.texels[corner..corner + stride + 2];
        let upper = lerp_f32(unpack(texels[0]), unpack(texels[1]), weight_x);
        let lower = lerp_f32(unpack(texels[stride]), unpack(texels[stride + 1]), weight_x);
        lerp_f32(upper, lower, weight_y)
    }
}

impl Level {
    /// How many texels its six faces take, with their frames.
    fn texels(&self) -> usize {
        6 * (self.side + 2) * (self.side + 2)
    }
}

/// The levels of a cube, down to faces of a single pixel.
fn levels(side: usize) -> Vec<Level> {
    let mut levels = vec![Level { side, start: 0 }];
    while let &[.., level] = &levels[..]
        && level.side > 1
    {
        levels.push(Level { side: level.side / 2, start: level.start + level.texels() });
    }
    levels
}

/// The faces of one level without frames; a single one stands for all six.
struct Faces {
    side: usize,
    images: Vec<Vec<u32>>,
}

impl Faces {
    fn of(image: &Image) -> Self {
        let side = image.width;
        let face = |first: usize| {
            let mut pixels = vec![0; side * side];
            for (row, line) in pixels.chunks_exact_mut(side).enumerate() {
                image.write_row(first + row, line);
            }
            pixels
        };
        Faces { side, images: (0..image.height / side).map(|i| face(i * side)).collect() }
    }

    /// The next level.
    fn halved(&self) -> Self {
        let (side, half) = (self.side, self.side / 2);
        let halving = Halving::new([side; 2], [half; 2], false);
        let face = |pixels: &Vec<u32>| {
            let mut out = vec![0; half * half];
            for (y, line) in out.chunks_exact_mut(half).enumerate() {
                halving.row(y, |y| &pixels[y * side..(y + 1) * side], line);
            }
            out
        };
        Faces { side: half, images: self.images.iter().map(face).collect() }
    }

    fn row(&self, face: usize, row: usize) -> &[u32] {
        &self.images[face % self.images.len()][row * self.side..(row + 1) * self.side]
    }

    /// A texel of a face or of its frame. At the corners of the cube three texels meet: the frame gets their mean.
    fn framed_texel(&self, face: usize, [column, row]: [i32; 2]) -> u32 {
        let last = self.side as i32 - 1;
        let [inner_column, inner_row] = [column, row].map(|x| x.clamp(0, last));
        let own = self.row(face, inner_row as usize)[inner_column as usize];
        match (column == inner_column, row == inner_row) {
            (true, true) => own,
            (false, true) | (true, false) => self.neighbour(face, [column, row]),
            (false, false) => {
                let beside = self.neighbour(face, [column, inner_row]).to_le_bytes();
                let above = self.neighbour(face, [inner_column, row]).to_le_bytes();
                let own = own.to_le_bytes();
                let sum =
                    [0, 1, 2, 3].map(|i| u32::from(own[i]) + u32::from(beside[i]) + u32::from(above[i]));
                u32::from_le_bytes(sum.map(|sum| ((sum * 2 + 3) / 6) as u8))
            }
        }
    }

    /// The texel of the neighbouring face that touches a texel just beyond an edge.
    fn neighbour(&self, face: usize, texel: [i32; 2]) -> u32 {
        let side = self.side as f32;
        let beyond = |index: i32| match index {
            ..0 => -1.0 - 1e-6,
            _ if index as usize >= self.side => 1.0 + 1e-6,
            _ => (2 * index + 1) as f32 / side - 1.0,
        };
        let [s, t] = texel.map(beyond);
        let place = place_of(direction_of(Place { face, s, t }));
        let index = |x: f32| (((0.5 * x + 0.5) * side) as usize).min(self.side - 1);
        self.row(place.face, index(place.t))[index(place.s)]
    }
}
