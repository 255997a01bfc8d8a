//! Triangles of one shape.

/// Which rows of a surface's arrays light and paint the three corners of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corners {
    /// Rows of `normals`.
    pub normal: [u32; 3],
    /// Rows of `texcoords`; all 0 where a surface has none.
    pub texcoord: [u32; 3],
}

/// Triangles of one shape, in its own coordinates, counter-clockwise from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Positions, every one once.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates; empty where the shape has none.
    pub texcoords: Vec<[f32; 2]>,
    /// Rows of `positions` of the corners of each triangle, in the order of drawing.
    pub faces: Vec<[u32; 3]>,
    /// The same triangles' light and paint, which only those seen need.
    pub corners: Vec<Corners>,
    /// Bits of the sides of each triangle that outline its polygon; side k runs from corner k to the next one. The diagonal
    /// along which a quadrilateral is cut is none.
    pub outlines: Vec<u8>,
    /// Middle and half sides of the box about the positions.
    pub bounds: Bounds,
    /// Each run of [`CLUSTER`] triangles.
    pub clusters: Vec<Cluster>,
    /// Rows of `positions` that each cluster uses, cluster by cluster, every one once.
    pub rows: Vec<u32>,
    /// The faces again, as places among the rows of their cluster.
    pub places: Vec<[u8; 3]>,
}

/// A run of triangles, which are looked at together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cluster {
    /// The box about its triangles.
    pub bounds: Bounds,
    /// Its first place in [`Surface::rows`].
    pub first_row: u32,
}

/// Middle and half sides of a box.
pub type Bounds = [[f32; 3]; 2];

/// Triangles of a cluster: few enough for their corners to be numbered by bytes.
pub const CLUSTER: usize = 64;

/// All sides of a triangle.
const ALL_SIDES: u8 = 0b111;
/// The two triangles of a quadrilateral, cut along the diagonal that OpenGL drivers use, from its second to its fourth corner: their
/// corners, and their sides but the diagonal.
pub(super) const HALVES: [([usize; 3], u8); 2] = [([0, 1, 3], 0b101), ([1, 2, 3], 0b011)];

impl Surface {
    /// Bytes that its arrays take.
    pub fn bytes(&self) -> usize {
        std::mem::size_of_val(&self.positions[..])
            + std::mem::size_of_val(&self.normals[..])
            + std::mem::size_of_val(&self.texcoords[..])
            + std::mem::size_of_val(&self.faces[..])
            + std::mem::size_of_val(&self.corners[..])
            + std::mem::size_of_val(&self.outlines[..])
            + std::mem::size_of_val(&self.rows[..])
            + std::mem::size_of_val(&self.places[..])
    }

    /// Adds a triangle by the rows of its positions, normals and texture coordinates.
    pub(super) fn push(&mut self, position: [u32; 3], normal: [u32; 3], texcoord: [u32; 3]) {
        self.push_part(position, Corners { normal, texcoord }, ALL_SIDES);
    }

    /// Adds a triangle of a polygon, with the sides that outline it.
    pub(super) fn push_part(&mut self, position: [u32; 3], corners: Corners, sides: u8) {
        self.faces.push(position);
        self.corners.push(corners);
        self.outlines.push(sides);
    }

    /// Adds a quadrilateral as two triangles.
    pub(super) fn push_quad(&mut self, position: [u32; 4], normal: u32, texcoord: [u32; 4]) {
        for (corners, sides) in HALVES {
            let lit = Corners { normal: [normal; 3], texcoord: corners.map(|k| texcoord[k]) };
            self.push_part(corners.map(|k| position[k]), lit, sides);
        }
    }

    /// Sets the box, and gathers the triangles into clusters.
    pub(super) fn finish(&mut self) {
        self.bounds = bounds(&self.faces, &self.positions);
        self.places.reserve_exact(self.faces.len());
        // For each position the cluster that used it last, counted from 1, and its place there.
        let mut last = vec![(0, 0); self.positions.len()];
        for (number, faces) in (1_u32..).zip(self.faces.chunks(CLUSTER)) {
            let first_row = self.rows.len();
            self.clusters
                .push(Cluster { bounds: bounds(faces, &self.positions), first_row: first_row as u32 });
            for face in faces {
                self.places.push(face.map(|row| {
                    let (user, place) = &mut last[row as usize];
                    if *user != number {
                        (*user, *place) = (number, (self.rows.len() - first_row) as u8);
                        self.rows.push(row);
                    }
                    *place
                }));
            }
        }
        self.rows.shrink_to_fit();
    }

    /// The rows of `positions` that a cluster uses.
    pub fn rows_of(&self, cluster: usize) -> &[u32] {
        let first = |cluster: &Cluster| cluster.first_row as usize;
        let end = self.clusters.get(cluster + 1).map_or(self.rows.len(), first);
        &self.rows[first(&self.clusters[cluster])..end]
    }
}

/// The box about some triangles; without them a point.
fn bounds(faces: &[[u32; 3]], positions: &[[f32; 3]]) -> Bounds {
    if faces.is_empty() {
        return [[0.0; 3]; 2];
    }
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for p in faces.iter().flatten().map(|&row| positions[row as usize]) {
        for axis in 0..3 {
            low[axis] = low[axis].min(p[axis]);
            high[axis] = high[axis].max(p[axis]);
        }
    }
    [
        [0, 1, 2].map(|axis| 0.5 * (low[axis] + high[axis])),
        [0, 1, 2].map(|axis| 0.5 * (high[axis] - low[axis])),
    ]
}

/// Unit normal of a triangle, or +z where its area vanishes.
pub(super) fn face_normal(a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> [f32; 3] {
    let side = |p: [f32; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
    let (u, v) = (side(b), side(c));
    unit([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])
}

/// The vector scaled to length 1, or +z for one shorter than 1e-10.
pub(super) fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    if length < 1e-10 {
        return [0.0, 0.0, 1.0];
    }
    let scale = 1.0 / length;
    v.map(|x| x * scale)
}
