//! Adding a point: the facets it sees, the horizon around them, and the cone from the horizon.

use super::Failure;
use super::polytope::{NONE, Polytope, TAIL, remove_unordered, replace_item};

impl Polytope<'_> {
    /// Extends the hull by an outside point of `facet`.
    pub(super) fn add_point(&mut self, point: usize, facet: usize) -> Result<(), Failure> {
        self.raise_outside_limit();
        self.find_horizon(point, facet)?;
        self.make_cone(point)?;
        self.match_new_facets()?;
        self.set_new_planes();
        self.update_vertices_of_cone();
        self.search_new = false;
        self.merge_new()?;
        self.search_new = self.many_merges()
            || self.facets_from(self.first_new).iter().any(|&f| !self.facets[f].simplicial);
        if self.first_new == TAIL || self.first_new == NONE {
            return Err(Failure("all new facets were merged away"));
        }
        self.partition_visible();
        self.search_new = false;
        self.new_not_sharp = false;
        self.delete_visible();
        self.settle();
        Ok(())
    }

    /// Moves the facets visible from the point to the end of the list, marks coplanar horizon facets.
    fn find_horizon(&mut self, point: usize, facet: usize) -> Result<(), Failure> {
        let p = self.points[point];
        self.see(facet);
        self.visible_count = 1;
        self.first_visible = facet;
        self.visit += 1;
        let visit = self.visit;
        let mut horizon = 0;
        let mut at = facet;
        while at != TAIL {
            self.facets[at].visit = visit;
            for k in 0..self.facets[at].neighbors.len() {
                let n = self.facets[at].neighbors[k];
                if self.facets[n].visit == visit {
                    continue;
                }
                self.facets[n].visit = visit;
                let distance = self.distance(p, n);
                if distance > self.tol.visible {
                    self.see(n);
                    self.visible_count += 1;
                    continue;
                }
                let coplanar = distance >= -self.tol.visible;
                self.facets[n].coplanar_horizon = coplanar;
                if coplanar && distance > 0.0 {
                    self.max_outside = self.max_outside.max(distance);
                }
                horizon += 1;
            }
            at = self.facets[at].next;
        }
        if horizon == 0 { Err(Failure("a point is above all facets")) } else { Ok(()) }
    }

    fn see(&mut self, facet: usize) {
        self.requeue(facet);
        self.facets[facet].visible = true;
        self.facets[facet].replace = NONE;
    }

    /// One triangle per horizon ridge, from the new vertex.
    fn make_cone(&mut self, point: usize) -> Result<(), Failure> {
        self.first_new = TAIL;
        self.first_new_vertex = TAIL;
        let apex = self.new_vertex(point);
        self.append_vertex(apex);
        self.visit += 1;
        let (mut latest, mut latest_ridged) = (NONE, NONE);
        let mut visible = self.first_visible;
        while visible != NONE && self.facets[visible].visible {
            for k in 0..self.facets[visible].neighbors.len() {
                let n = self.facets[visible].neighbors[k];
                self.facets[n].seen = false;
            }
            // A triangle that once had ridges forgets the latest facet of its predecessors.
            if self.facets[visible].ridged {
                self.facets[visible].visit = self.visit;
                latest_ridged = self.cone_from_ridges(visible, apex)?;
            }
            if self.facets[visible].simplicial {
                latest = self.cone_from_simplex(visible, apex)?;
            }
            if latest_ridged != NONE {
                latest = latest_ridged;
            }
            if latest != NONE {
                self.facets[visible].replace = latest;
            }
            self.facets[visible].ridges.clear();
            self.facets[visible].neighbors.clear();
            visible = self.facets[visible].next;
        }
        Ok(())
    }

    /// New facets over the ridges of a facet being removed; the latest, if any.
    pub(super) fn cone_from_ridges(&mut self, removed: usize, apex: usize) -> Result<usize, Failure> {
        let mut latest = NONE;
        for k in 0..self.facets[removed].ridges.len() {
            let r = self.facets[removed].ridges[k];
            let neighbor = self.ridges[r].other(removed);
            if self.facets[neighbor].visible {
                self.facets[neighbor].seen = true;
                continue;
            }
            let top = self.ridges[r].top == removed;
            let [a, b] = self.ridges[r].vertices;
            let new = self.new_facet([apex, a, b], top, neighbor);
            latest = new;
            if self.facets[neighbor].coplanar_horizon {
                self.join_cycle(new, neighbor);
            }
            if self.facets[neighbor].seen {
                if self.facets[neighbor].simplicial {
                    return Err(Failure("two ridges between a facet and a triangle"));
                }
                self.facets[neighbor].neighbors.push(new);
            } else {
                replace_item(&mut self.facets[neighbor].neighbors, removed, new)?;
            }
            if self.facets[neighbor].simplicial {
                remove_unordered(&mut self.facets[neighbor].ridges, r);
            } else {
                self.facets[new].ridges.push(r);
                self.facets[new].ridged = true;
                let ridge = &mut self.ridges[r];
                if top {
                    ridge.top = new;
                    ridge.simplicial_top = true;
                } else {
                    ridge.bottom = new;
                    ridge.simplicial_bottom = true;
                }
            }
            self.facets[neighbor].seen = true;
        }
        Ok(latest)
    }

    /// Links a new facet into the ring of those to be merged with a coplanar horizon facet.
    fn join_cycle(&mut self, new: usize, horizon: usize) {
        self.facets[new].merge_horizon = true;
        if !self.facets[horizon].seen || self.facets[horizon].new_cycle == NONE {
            self.facets[new].same_cycle = new;
            self.facets[horizon].new_cycle = new;
        } else {
            let ring = self.facets[horizon].new_cycle;
            self.facets[new].same_cycle = self.facets[ring].same_cycle;
            self.facets[ring].same_cycle = new;
        }
    }

    /// New facets over the edges a removed triangle shares with other triangles; the latest, if any.
    fn cone_from_simplex(&mut self, removed: usize, apex: usize) -> Result<usize, Failure> {
        let mut latest = NONE;
        for k in 0..self.facets[removed].neighbors.len() {
            let n = self.facets[removed].neighbors[k];
            if self.facets[n].seen || self.facets[n].visible {
                continue;
            }
            let horizon = &self.facets[n];
            let skip = horizon.neighbors.iter().position(|&f| f == removed).filter(|&at| at < 3);
            let skip = skip.ok_or(Failure("facets disagree about being neighbours"))?;
            let v = &horizon.vertices;
            let [a, b] = [[v[1], v[2]], [v[0], v[2]], [v[0], v[1]]][skip];
            let odd = skip % 2 == 1;
            let top = if horizon.top_oriented { odd } else { !odd };
            let coplanar = horizon.coplanar_horizon;
            let new = self.new_facet([apex, a, b], top, n);
            latest = new;
            if coplanar {
                self.facets[new].same_cycle = new;
                self.facets[new].merge_horizon = true;
            }
            self.facets[n].neighbors[skip] = new;
        }
        Ok(latest)
    }

    /// Pairs the new facets along the edges from the apex.
    pub(super) fn match_new_facets(&mut self) -> Result<(), Failure> {
        let new = self.facets_from(self.first_new);
        // Per edge: its base vertex, the facet, and the position of the vertex opposite.
        let mut edges: Vec<(usize, usize, usize)> = Vec::with_capacity(2 * new.len());
        for &f in &new {
            let facet = &mut self.facets[f];
            facet.neighbors.truncate(1);
            facet.neighbors.extend([NONE, NONE]);
            edges.push((facet.vertices[2], f, 1));
            edges.push((facet.vertices[1], f, 2));
        }
        edges.sort_by_key(|&(v, ..)| v);
        if edges.windows(3).any(|e| e[0].0 == e[1].0 && e[1].0 == e[2].0) {
            return Err(Failure("more than two new facets meet at an edge"));
        }
        for pair in edges.chunks(2) {
            let &[(v, f, skip), (w, g, other)] = pair else {
                return Err(Failure("an edge of a new facet has no partner"));
            };
            if v != w {
                return Err(Failure("an edge of a new facet has no partner"));
            }
            if (skip == other) != (self.facets[f].top_oriented ^ self.facets[g].top_oriented) {
                return Err(Failure("new facets meet with opposite orientation"));
            }
            self.facets[f].neighbors[skip] = g;
            self.facets[g].neighbors[other] = f;
        }
        Ok(())
    }

    fn set_new_planes(&mut self) {
        for f in self.facets_from(self.first_new) {
            if !self.facets[f].merge_horizon {
                self.set_plane(f);
            }
        }
    }

    /// Lists of facets around the vertices, and the vertices inside the cone.
    fn update_vertices_of_cone(&mut self) {
        if self.has_vertex_neighbors {
            for v in self.vertices_from(self.first_new_vertex) {
                let mut k = 0;
                while k < self.vertices[v].neighbors.len() {
                    if self.facets[self.vertices[v].neighbors[k]].visible {
                        self.vertices[v].neighbors.swap_remove(k);
                    } else {
                        k += 1;
                    }
                }
            }
            for f in self.facets_from(self.first_new) {
                for k in 0..self.facets[f].vertices.len() {
                    let v = self.facets[f].vertices[k];
                    self.vertices[v].neighbors.push(f);
                }
            }
        }
        let mut visible = self.first_visible;
        while visible != NONE && self.facets[visible].visible {
            for k in 0..self.facets[visible].vertices.len() {
                let v = self.facets[visible].vertices[k];
                if self.vertices[v].new || self.vertices[v].deleted {
                    continue;
                }
                let survives = self.has_vertex_neighbors
                    && self.vertices[v].neighbors.iter().any(|&n| !self.facets[n].visible);
                if survives {
                    remove_unordered(&mut self.vertices[v].neighbors, visible);
                } else {
                    self.mark_deleted(v);
                }
            }
            visible = self.facets[visible].next;
        }
    }

    /// Plane through a triangle; by Gaussian elimination if the cross product is too inaccurate.
    pub(super) fn set_plane(&mut self, facet: usize) {
        let corners: [[f64; 3]; 3] = std::array::from_fn(|k| self.point(self.facets[facet].vertices[k]));
        let top = self.facets[facet].top_oriented;
        let (normal, offset) = plane(corners, top);
        let height = |p: [f64; 3]| offset + (p[0] * normal[0] + p[1] * normal[1] + p[2] * normal[2]);
        let inaccurate = corners[1..].iter().any(|&p| height(p).abs() > self.tol.round);
        let f = &mut self.facets[facet];
        (f.normal, f.offset) = (Some(normal), offset);
        if inaccurate {
            let (normal, offset, singular) = plane_by_elimination(corners, top, &self.tol.near_zero);
            let f = &mut self.facets[facet];
            (f.normal, f.offset) = (Some(normal), offset);
            if singular {
                self.orient_outward(facet);
            }
        }
        let depth = self.distance(self.interior, facet);
        if !self.facets[facet].flipped && depth >= -self.tol.round {
            self.facets[facet].flipped = true;
        }
    }

    /// Turns the plane so that the interior is below it.
    pub(super) fn orient_outward(&mut self, facet: usize) {
        if self.distance(self.interior, facet) > 0.0 {
            let f = &mut self.facets[facet];
            f.normal = f.normal.map(|n| n.map(|x| -x));
            f.offset = -f.offset;
        }
    }
}

fn scaled_to_unit(n: [f64; 3], positive: bool) -> [f64; 3] {
    let norm = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    if norm == 0.0 {
        return [(1.0f64 / 3.0).sqrt(); 3];
    }
    let norm = if positive { norm } else { -norm };
    n.map(|x| x / norm)
}

/// Normal and offset from the cross product of two edges.
fn plane([p, q, r]: [[f64; 3]; 3], top: bool) -> ([f64; 3], f64) {
    let a = [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
    let b = [r[0] - p[0], r[1] - p[1], r[2] - p[2]];
    let cross = [b[1] * a[2] - b[2] * a[1], a[0] * b[2] - a[2] * b[0], b[0] * a[1] - b[1] * a[0]];
    let n = scaled_to_unit(cross, top);
    (n, -(p[0] * n[0] + p[1] * n[1] + p[2] * n[2]))
}

/// The same by elimination with row pivoting; also whether a pivot vanished within round-off.
fn plane_by_elimination([p, q, r]: [[f64; 3]; 3], top: bool, near_zero: &[f64; 3]) -> ([f64; 3], f64, bool) {
    let edge = |v: [f64; 3]| [v[0] - p[0], v[1] - p[1], v[2] - p[2]];
    let mut rows = [edge(q), edge(r)];
    let mut negative = top;
    let mut singular = false;
    for k in 0..2 {
        if k == 0 && rows[1][0].abs() > rows[0][0].abs() {
            rows.swap(0, 1);
            negative = !negative;
        }
        let pivot = rows[k][k];
        if pivot.abs() <= near_zero[k] {
            singular = true;
        }
        if k == 0 && pivot != 0.0 {
            let factor = rows[1][0] / pivot;
            rows[1][1] -= factor * rows[0][1];
            rows[1][2] -= factor * rows[0][2];
        }
    }
    for k in 0..2 {
        if rows[k][k] < 0.0 {
            negative = !negative;
        }
    }
    let unit = if negative { -1.0 } else { 1.0 };
    let mut n = [0.0, 0.0, unit];
    for k in [1, 0] {
        let mut sum = 0.0;
        for j in k + 1..3 {
            sum -= rows[k][j] * n[j];
        }
        if rows[k][k] != 0.0 {
            n[k] = sum / rows[k][k];
        } else {
            n[k] = unit;
            n[k + 1..].fill(0.0);
            singular = true;
        }
    }
    let n = scaled_to_unit(n, true);
    let mut offset = -(p[0] * n[0]);
    offset -= p[1] * n[1];
    offset -= p[2] * n[2];
    (n, offset, singular)
}
