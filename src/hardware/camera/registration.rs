//! Depth in the image of another imager.

/// A pinhole camera without distortion: x = fx · X/Z + cx, y = fy · Y/Z + cy, with X to the right, Y
/// down and Z forward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intrinsics {
    /// Width, height \[pixels\].
    pub size: [usize; 2],
    /// fx, fy \[pixels\].
    pub focal: [f64; 2],
    /// cx, cy \[pixels\], from the centre of the first pixel.
    pub centre: [f64; 2],
}

/// Two imagers on one body: the depth imager, and the imager to which depth is aligned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Registration {
    /// The imager that measures depth.
    pub from: Intrinsics,
    /// The imager to which it is aligned.
    pub to: Intrinsics,
    /// Rotation from the first imager's frame to the second's, row by row.
    pub rotation: [[f64; 3]; 3],
    /// Position of the first imager in the second's frame \[m\].
    pub translation: [f64; 3],
}

/// Largest side of the square that one depth covers \[pixels\], which bounds the time that an alignment takes.
const WIDEST: f64 = 64.0;

impl Registration {
    /// `[height, width]` of the result of [`Registration::align`].
    pub fn size(&self) -> [usize; 2] {
        [self.to.size[1], self.to.size[0]]
    }

    /// Fills `aligned` with the depths \[m\] in the image of the second imager, from the `[height, width]` depths of the
    /// first. Each depth covers the square of its pixel; where several fall on one pixel the nearest
    /// counts, and where none does the depth is 0. Points so close to the second imager that their square covers more than 64
    /// pixels along a side are left out: they are nearer than any camera measures.
    pub fn align(&self, depths: &[f32], [height, width]: [usize; 2], aligned: &mut Vec<f32>) {
        let [rows, columns] = self.size();
        aligned.clear();
        aligned.resize(rows * columns, 0.0);
        for (row, line) in depths.chunks_exact(width).take(height).enumerate() {
            for (column, depth) in line.iter().enumerate().filter(|(_, depth)| **depth > 0.0) {
                let corner = |dx, dy| self.project([column as f64 + dx, row as f64 + dy], f64::from(*depth));
                let Some((low, high, z)) =
                    corner(-0.5, -0.5).zip(corner(0.5, 0.5)).map(|((a, z), (b, _))| (a, b, z))
                else {
                    continue;
                };
                if [0, 1].iter().any(|&k| (high[k] - low[k]).abs() > WIDEST) {
                    continue;
                }
                let [xs, ys] =
                    [0, 1].map(|k| pixels(low[k].min(high[k]), low[k].max(high[k]), [columns, rows][k]));
                for y in ys {
                    for pixel in &mut aligned[y * columns..][xs.clone()] {
                        if *pixel == 0.0 || z < *pixel {
                            *pixel = z;
                        }
                    }
                }
            }
        }
    }

    /// Pixel and depth \[m\] in the second image of a point of the first; `None` behind the second imager.
    fn project(&self, pixel: [f64; 2], depth: f64) -> Option<([f64; 2], f32)> {
        let [x, y] = [0, 1].map(|k| (pixel[k] - self.from.centre[k]) / self.from.focal[k] * depth);
        let point = [0, 1, 2].map(|k| {
            let [a, b, c] = self.rotation[k];
            a * x + b * y + c * depth + self.translation[k]
        });
        let seen = [0, 1].map(|k| self.to.focal[k] * point[k] / point[2] + self.to.centre[k]);
        (point[2] > 0.0).then_some((seen, point[2] as f32))
    }
}

/// The pixels, of `count`, whose centres lie between `low` and `high`; at least the one nearest to the midpoint.
fn pixels(low: f64, high: f64, count: usize) -> std::ops::Range<usize> {
    let middle = (0.5 * (low + high)).round();
    let first = low.ceil().min(middle).max(0.0) as usize;
    let end = ((high.floor().max(middle) + 1.0).max(0.0) as usize).min(count);
    first.min(end)..end
}
