//! The convex hull in the layout of `mesh_graph`, and its extreme vertices in `mesh_extrema`.

use super::hull::Hull;

/// Number of vertices, number of faces, edge address per vertex, mesh vertex per hull vertex,
/// neighbours of each vertex as hull vertices ending in -1, mesh vertices of the faces.
pub(super) fn graph_array(hull: &Hull) -> Vec<i32> {
    let mut local = vec![-1; hull.vert.iter().max().map_or(0, |&v| v as usize + 1)];
    for (k, &v) in hull.vert.iter().enumerate() {
        local[v as usize] = k as i32;
    }
    let mut graph = vec![hull.vert.len() as i32, hull.face.len() as i32];
    let mut adr = 0;
    for neighbours in &hull.neighbours {
        graph.push(adr);
        adr += neighbours.len() as i32 + 1;
    }
    graph.extend(&hull.vert);
    for neighbours in &hull.neighbours {
        graph.extend(neighbours.iter().map(|&v| local[v as usize]));
        graph.push(-1);
    }
    graph.extend(hull.face.iter().flatten());
    graph
}

/// For each corner, edge and face direction of a cube, in lexicographic order of (x, y, z) in
/// {-1, 0, 1}³, the first hull vertex that is farthest.
pub(super) fn extrema(vert: &[[f32; 3]], hull: &[i32]) -> [i32; 27] {
    let mut best = [f32::MIN; 27];
    let mut farthest = [0; 27];
    for (k, &v) in hull.iter().enumerate() {
        let [x, y, z] = vert[v as usize];
        for direction in 0..27 {
            let [cx, cy, cz] = [direction / 9, direction / 3 % 3, direction % 3].map(|c| c as f32 - 1.0);
            let reach = x * cx + y * cy + z * cz;
            if reach > best[direction] {
                best[direction] = reach;
                farthest[direction] = k as i32;
            }
        }
    }
    farthest
}
