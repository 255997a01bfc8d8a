//! Random point sets that are hard for a convex hull: coplanar, cospherical, duplicate, nearly flat. Made with
//! sums, products, quotients and square roots only, so that they are the same on every machine.

/// Splitmix64: uniform numbers, the same on every machine.
pub struct Random(u64);

impl Random {
    /// Sequence number `seed`.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(0x5851_f42d_4c95_7f2d))
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [-1, 1).
    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// One over a power of ten, with an exponent in `from..to`.
    fn small(&mut self, from: usize, to: usize) -> f64 {
        (0..self.between(from, to)).fold(1.0, |x, _| x / 10.0)
    }

    /// Uniform in `from..to`.
    fn between(&mut self, from: usize, to: usize) -> usize {
        from + (self.bits() % (to - from) as u64) as usize
    }

    fn point(&mut self) -> [f64; 3] {
        [self.unit(), self.unit(), self.unit()]
    }
}

/// A point set and the largest number of hull vertices, -1 for no limit.
pub struct Cloud {
    pub kind: &'static str,
    pub points: Vec<[f64; 3]>,
    pub limit: i32,
}

/// Name and maker.
pub type Kind = (&'static str, fn(&mut Random) -> Vec<[f64; 3]>);

pub const KINDS: [Kind; 18] = [
    ("lattice", lattice),
    ("turned lattice", |r| turned(r, lattice)),
    ("cube of divided faces", divided_cube),
    ("turned cube of divided faces", |r| turned(r, divided_cube)),
    ("sphere", sphere),
    ("cospherical integers", cospherical),
    ("box", |r| (0..r.between(4, 200)).map(|_| r.point()).collect()),
    ("nearly coplanar", nearly_coplanar),
    ("duplicates", duplicates),
    ("collinear runs", collinear),
    ("thin slab", slab),
    ("prism", prism),
    ("single precision", single),
    ("bytes", bytes),
    ("shallow cap", shallow_cap),
    ("points on triangles", on_triangles),
    ("nearly cospherical", nearly_cospherical),
    ("many sides", many_sides),
];

/// Cloud number `seed`.
pub fn cloud(seed: u64) -> Cloud {
    let mut random = Random::new(seed);
    let (kind, make) = KINDS[(seed % KINDS.len() as u64) as usize];
    let mut points = make(&mut random);
    for k in (1..points.len()).rev() {
        points.swap(k, random.between(0, k + 1));
    }
    let limit = if random.between(0, 6) == 0 { random.between(4, 40) as i32 } else { -1 };
    Cloud { kind, points, limit }
}

fn turn(random: &mut Random, points: &mut [[f64; 3]]) {
    let (a, b) = (3.0 * random.unit(), 3.0 * random.unit());
    let (c, s) = ((1.0 - a * a) / (1.0 + a * a), 2.0 * a / (1.0 + a * a));
    let (d, t) = ((1.0 - b * b) / (1.0 + b * b), 2.0 * b / (1.0 + b * b));
    let shift = random.point();
    for p in points {
        let [x, y, z] = [c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]];
        *p = [x + shift[0], d * y - t * z + shift[1], t * y + d * z + shift[2]];
    }
}

fn turned(random: &mut Random, make: fn(&mut Random) -> Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    let mut points = make(random);
    turn(random, &mut points);
    points
}

fn lattice(random: &mut Random) -> Vec<[f64; 3]> {
    let [nx, ny, nz] = [random.between(2, 7), random.between(2, 7), random.between(2, 5)];
    let step = random.point();
    (0..nx * ny * nz)
        .map(|k| [k % nx, k / nx % ny, k / nx / ny])
        .map(|at| std::array::from_fn(|axis| at[axis] as f64 * step[axis]))
        .collect()
}

/// Points on the faces of a cube alone, on a grid.
fn divided_cube(random: &mut Random) -> Vec<[f64; 3]> {
    let n = random.between(2, 8);
    let on_face = |at: &[usize; 3]| at.iter().any(|&x| x == 0 || x == n);
    let size = random.unit();
    (0..(n + 1).pow(3))
        .map(|k| [k % (n + 1), k / (n + 1) % (n + 1), k / (n + 1).pow(2)])
        .filter(on_face)
        .map(|at| at.map(|x| size * x as f64 / n as f64))
        .collect()
}

fn sphere(random: &mut Random) -> Vec<[f64; 3]> {
    let radii = random.point();
    let count = random.between(4, 300);
    let mut points = Vec::new();
    while points.len() < count {
        let p = random.point();
        let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.1 && length < 1.0 {
            points.push(std::array::from_fn(|k| radii[k] * p[k] / length));
        }
    }
    points
}

/// All integer points at one distance from the origin.
fn cospherical(random: &mut Random) -> Vec<[f64; 3]> {
    let square = [3, 5, 6, 9, 14, 17, 21, 26, 27, 29, 33, 38, 41, 50, 54, 66, 81, 89][random.between(0, 18)];
    let mut points = Vec::new();
    for k in 0..21i32.pow(3) {
        let [x, y, z] = [k % 21 - 10, k / 21 % 21 - 10, k / 441 - 10];
        if x * x + y * y + z * z == square {
            points.push([x, y, z].map(f64::from));
        }
    }
    if random.between(0, 2) == 0 {
        turn(random, &mut points);
    }
    points
}

/// Any other cloud with noise of 1e-16 to 1e-12.
fn nearly_coplanar(random: &mut Random) -> Vec<[f64; 3]> {
    let base = [lattice, divided_cube, cospherical, prism][random.between(0, 4)];
    let mut points = base(random);
    if random.between(0, 2) == 0 {
        turn(random, &mut points);
    }
    let size = random.small(12, 17);
    points.iter_mut().flatten().for_each(|x| *x += size * random.unit());
    points
}

fn duplicates(random: &mut Random) -> Vec<[f64; 3]> {
    let mut points: Vec<[f64; 3]> = match random.between(0, 2) {
        0 => divided_cube(random),
        _ => (0..random.between(4, 30)).map(|_| random.point()).collect(),
    };
    for _ in 0..random.between(1, 60) {
        let p = points[random.between(0, points.len())];
        points.push(if random.between(0, 2) == 0 { p } else { p.map(|x| x * (1.0 + f64::EPSILON)) });
    }
    points
}

/// Points along the segments between a few corners.
fn collinear(random: &mut Random) -> Vec<[f64; 3]> {
    let corners: Vec<_> = (0..random.between(4, 9)).map(|_| random.point()).collect();
    let mut points = corners.clone();
    for _ in 0..random.between(1, 9) {
        let [a, b] = [0; 2].map(|_| corners[random.between(0, corners.len())]);
        let count = random.between(2, 12);
        for k in 1..count {
            let t = k as f64 / count as f64;
            points.push(std::array::from_fn(|axis| a[axis] + t * (b[axis] - a[axis])));
        }
    }
    points
}

fn slab(random: &mut Random) -> Vec<[f64; 3]> {
    let mut points: Vec<[f64; 3]> = match random.between(0, 3) {
        0 => lattice(random),
        1 => prism(random),
        _ => (0..random.between(4, 120)).map(|_| random.point()).collect(),
    };
    let thickness = random.small(1, 16);
    points.iter_mut().for_each(|p| p[2] *= thickness);
    if random.between(0, 2) == 0 {
        turn(random, &mut points);
    }
    points
}

/// Rings of a regular polygon, each with its centre.
fn prism(random: &mut Random) -> Vec<[f64; 3]> {
    let (sides, rings) = (random.between(3, 40), random.between(2, 5));
    let radii: Vec<f64> = (0..rings).map(|_| [1.0, 1.0, 0.5 * random.unit()][random.between(0, 3)]).collect();
    let mut points = Vec::new();
    for (ring, radius) in radii.iter().enumerate() {
        let z = ring as f64 / 3.0;
        points.push([0.0, 0.0, z]);
        for side in 0..sides {
            // A rational parametrisation of the circle needs no function that machines compute differently.
            let t = 2.0 * side as f64 / sides as f64 - 1.0;
            let (s, c) = if side % 2 == 0 { (1.0, t) } else { (-1.0, t) };
            let (x, y) = ((1.0 - c * c) / (1.0 + c * c) * s, 2.0 * c / (1.0 + c * c));
            points.push([radius * x, radius * y, z]);
        }
    }
    points
}

/// Any other cloud as a mesh file would store it.
fn single(random: &mut Random) -> Vec<[f64; 3]> {
    let base = [lattice, divided_cube, cospherical, prism, sphere, collinear][random.between(0, 6)];
    let mut points = base(random);
    turn(random, &mut points);
    points.iter_mut().flatten().for_each(|x| *x = f64::from(*x as f32));
    points
}

/// Small integers, many of them equal.
fn bytes(random: &mut Random) -> Vec<[f64; 3]> {
    let range = random.between(2, 12);
    (0..random.between(5, 150)).map(|_| std::array::from_fn(|_| random.between(0, range) as f64)).collect()
}

/// A plane bent by about the round-off, over a few points below.
fn shallow_cap(random: &mut Random) -> Vec<[f64; 3]> {
    let height = random.small(12, 17);
    let bend = |x: f64, y: f64| -height * (x * x + y * y);
    let mut points: Vec<[f64; 3]> = (0..random.between(10, 400))
        .map(|_| [random.unit(), random.unit()])
        .map(|[x, y]| [x, y, bend(x, y)])
        .collect();
    for _ in 0..random.between(1, 5) {
        points.push([random.unit(), random.unit(), -1.0]);
    }
    if random.between(0, 3) > 0 {
        turn(random, &mut points);
    }
    points
}

/// Points inside the triangles between a few corners.
fn on_triangles(random: &mut Random) -> Vec<[f64; 3]> {
    let corners: Vec<_> = (0..random.between(4, 8)).map(|_| random.point()).collect();
    let mut points = corners.clone();
    for _ in 0..random.between(1, 20) {
        let [a, b, c] = [0; 3].map(|_| corners[random.between(0, corners.len())]);
        for _ in 0..random.between(1, 20) {
            let (s, t) = (random.unit().abs(), random.unit().abs());
            let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
            points.push(std::array::from_fn(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k])));
        }
    }
    points
}

/// Points of a sphere so close to each other that its bend is about the round-off.
fn nearly_cospherical(random: &mut Random) -> Vec<[f64; 3]> {
    let spread = random.small(5, 9);
    let count = random.between(10, 300);
    let mut points: Vec<[f64; 3]> = (0..count)
        .map(|_| [random.unit() * spread, random.unit() * spread])
        .map(|[x, y]| [x, y, (1.0 - x * x - y * y).sqrt()])
        .collect();
    points.push([0.0, 0.0, -1.0]);
    turn(random, &mut points);
    points
}

/// A prism with enough sides that unions of its ends are compared by their centres, with noise of the order of round-off.
fn many_sides(random: &mut Random) -> Vec<[f64; 3]> {
    let (sides, size) = (random.between(30, 70), random.small(14, 17));
    let mut points = Vec::new();
    for k in 0..2 * sides {
        let t = 2.0 * (k / 2) as f64 / sides as f64 - 1.0;
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        let [x, y] = [side * (1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t)];
        points.extend([[x, y, 0.0], [x, y, 1.0]]);
    }
    turn(random, &mut points);
    points.iter_mut().flatten().for_each(|x| *x += size * random.unit());
    points
}
