//! How the elements of a flex hang together: edges, the triangles at them, the shell, layers below it, and pairs of elements
//! and vertices that are close by nature.

use std::collections::{HashMap, VecDeque};

/// Corners of the edges of an element, by dimension.
const LOCAL_EDGES: [&[[usize; 2]]; 3] =
    [&[[0, 1]], &[[1, 2], [2, 0], [0, 1]], &[[0, 1], [1, 2], [2, 0], [2, 3], [0, 3], [1, 3]]];

/// Corners of the sides of an element, by dimension, turning outwards.
const LOCAL_SIDES: [&[&[usize]]; 3] =
    [&[&[0], &[1]], &[&[0, 1], &[1, 2], &[2, 0]], &[&[0, 1, 2], &[0, 2, 3], &[0, 3, 1], &[1, 3, 2]]];

/// Edges of all elements, each once.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Edges {
    /// Vertices, the lower first.
    pub ends: Vec<[i32; 2]>,
    /// Edges of each element.
    pub of_element: Vec<i32>,
}

impl Edges {
    pub fn of(dim: usize, elem: &[i32]) -> Self {
        let mut edges = Edges::default();
        let mut known: HashMap<[i32; 2], i32> = HashMap::new();
        for corners in elem.chunks_exact(dim + 1) {
            for &[a, b] in LOCAL_EDGES[dim - 1] {
                let ends = [corners[a].min(corners[b]), corners[a].max(corners[b])];
                let next = edges.ends.len() as i32;
                let edge = *known.entry(ends).or_insert(next);
                if edge == next {
                    edges.ends.push(ends);
                }
                edges.of_element.push(edge);
            }
        }
        edges
    }
}

/// For each edge of triangles: its ends as the first triangle has them, then the corners opposite to it in the first and
/// the last of its triangles, -1 without a second.
pub(super) fn flaps(elem: &[i32], edges: &Edges) -> Vec<[i32; 4]> {
    let mut flaps: Vec<[i32; 4]> = Vec::with_capacity(edges.ends.len());
    for (corners, own) in elem.as_chunks::<3>().0.iter().zip(edges.of_element.as_chunks::<3>().0) {
        for (k, &edge) in own.iter().enumerate() {
            let [a, b] = LOCAL_EDGES[1][k];
            // The first triangle of an edge is the one that numbers it.
            match flaps.get_mut(edge as usize) {
                Some(flap) => flap[3] = corners[k],
                None => flaps.push([corners[a], corners[b], corners[k], -1]),
            }
        }
    }
    flaps
}

/// A side of an element. Sides of the same vertices sort together.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    sorted: Vec<i32>,
    element: usize,
    outwards: Vec<i32>,
}

/// Two elements and the vertices that they share.
struct Joint {
    elements: [usize; 2],
    shared: Vec<i32>,
}

/// What is outside, and how far elements are from it.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Shell {
    /// Vertices of the sides that one element alone has.
    pub fragments: Vec<i32>,
    /// Elements between each element and the surface; 0 for all but tetrahedra.
    pub layer: Vec<i32>,
    /// Elements at the border with the vertices opposite to them across a shared side, lines and triangles only.
    pub pairs: Vec<[i32; 2]>,
}

impl Shell {
    pub fn of(dim: usize, elem: &[i32]) -> Self {
        let count = elem.len() / (dim + 1);
        let sides = sides(dim, elem);
        let (mut border, mut shell) = (vec![false; count], Shell::default());
        let mut joints = Vec::new();
        for group in sides.chunk_by(|a, b| a.sorted == b.sorted) {
            if let [alone] = group {
                border[alone.element] = true;
                shell.fragments.extend(&alone.outwards);
            }
            joints.extend(group.windows(2).map(|pair| Joint {
                elements: [pair[0].element, pair[1].element],
                shared: pair[1].sorted.clone(),
            }));
        }
        if dim == 3 {
            shell.layer = layers(&border, &joints);
        } else {
            shell.layer = vec![0; count];
            shell.pairs = pairs(dim, elem, &border, &joints);
        }
        shell
    }
}

fn sides(dim: usize, elem: &[i32]) -> Vec<Side> {
    let mut sides = Vec::with_capacity(elem.len());
    for (element, corners) in elem.chunks_exact(dim + 1).enumerate() {
        for side in LOCAL_SIDES[dim - 1] {
            let outwards: Vec<i32> = side.iter().map(|&k| corners[k]).collect();
            let mut sorted = outwards.clone();
            sorted.sort_unstable();
            sides.push(Side { sorted, element, outwards });
        }
    }
    sides.sort_unstable();
    sides
}

/// Steps from the border; what no path reaches is beyond any.
fn layers(border: &[bool], joints: &[Joint]) -> Vec<i32> {
    let mut beside = vec![Vec::new(); border.len()];
    for Joint { elements: [a, b], .. } in joints {
        beside[*a].push(*b);
        beside[*b].push(*a);
    }
    let mut layer = vec![border.len() as i32 + 1; border.len()];
    let mut pending: VecDeque<usize> = (0..border.len()).filter(|&e| border[e]).collect();
    pending.iter().for_each(|&e| layer[e] = 0);
    while let Some(element) = pending.pop_front() {
        let next = layer[element] + 1;
        for &other in &beside[element] {
            if layer[other] > next {
                layer[other] = next;
                pending.push_back(other);
            }
        }
    }
    layer
}

fn pairs(dim: usize, elem: &[i32], border: &[bool], joints: &[Joint]) -> Vec<[i32; 2]> {
    let mut pairs = Vec::new();
    for Joint { elements, shared } in joints {
        if !elements.iter().any(|&e| border[e]) {
            continue;
        }
        for k in 0..2 {
            let corners = &elem[elements[k] * (dim + 1)..][..=dim];
            if let Some(&opposite) = corners.iter().find(|&corner| !shared.contains(corner)) {
                pairs.push([elements[1 - k] as i32, opposite]);
            }
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_triangles_share_an_edge() {
        let elem = [0, 1, 2, 0, 2, 3];
        let edges = Edges::of(2, &elem);
        assert_eq!(edges.ends, [[1, 2], [0, 2], [0, 1], [2, 3], [0, 3]]);
        assert_eq!(edges.of_element, [0, 1, 2, 3, 4, 1]);
        let flaps = flaps(&elem, &edges);
        assert_eq!(flaps[1], [2, 0, 1, 3]);
        assert!(flaps.iter().enumerate().all(|(e, flap)| (flap[3] < 0) == (e != 1)));
        let shell = Shell::of(2, &elem);
        assert_eq!(shell.fragments.len(), 8);
        assert_eq!(shell.pairs, [[1, 1], [0, 3]]);
    }

    #[test]
    fn layers_count_from_the_surface() {
        // A row of tetrahedra, each sharing a face with the next, is all surface.
        let elem: Vec<i32> = (0..4).flat_map(|i| [i, i + 1, i + 2, i + 3]).collect();
        assert_eq!(Shell::of(3, &elem).layer, [0; 4]);
        let border = [true, false, false, false];
        let joints: Vec<Joint> = (0..2).map(|i| Joint { elements: [i, i + 1], shared: Vec::new() }).collect();
        assert_eq!(layers(&border, &joints), [0, 1, 2, 5]);
    }

    #[test]
    fn lines_pair_with_their_neighbours() {
        let shell = Shell::of(1, &[0, 1, 1, 2]);
        assert_eq!((shell.fragments, shell.pairs), (vec![0, 2], vec![[1, 0], [0, 2]]));
    }
}
