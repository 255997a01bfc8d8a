//! Meshes, height fields, textures, and the geoms that use them.

use super::requirement::{Inconsistent, ranges, require, spans};
use super::tree::{Inner, nodes_of};
use crate::arrays::{Arrays, GeomType};

pub(super) fn check(m: &Arrays) -> Result<(), Inconsistent> {
    ranges! { m:
        mesh_vertadr mesh_vertnum m.nmeshvert;
        mesh_faceadr mesh_facenum m.nmeshface;
        mesh_bvhadr mesh_bvhnum m.nbvh;
        mesh_normaladr mesh_normalnum m.nmeshnormal;
        mesh_texcoordadr mesh_texcoordnum m.nmeshtexcoord;
        mesh_polyadr mesh_polynum m.nmeshpoly;
        mesh_polyvertadr mesh_polyvertnum m.nmeshpolyvert;
        mesh_polymapadr mesh_polymapnum m.nmeshpolymap;
    }
    spans(
        "hfield_adr",
        &m.hfield_adr,
        |h| i64::from(m.hfield_nrow[h]) * i64::from(m.hfield_ncol[h]),
        m.nhfielddata,
    )?;
    for h in 0..m.nhfield {
        let grid = m.hfield_nrow[h] > 0 && m.hfield_ncol[h] > 0;
        require(grid, "hfield_nrow", h, "a positive number of rows and columns")?;
    }
    textures(m)?;
    (0..m.nmesh).try_for_each(|mesh| check_mesh(m, mesh))?;
    geoms(m)
}

/// Geoms have the mesh or height field that their type needs.
pub(super) fn geoms(m: &Arrays) -> Result<(), Inconsistent> {
    (0..m.ngeom).try_for_each(|geom| geom_data(m, geom))
}

fn textures(m: &Arrays) -> Result<(), Inconsistent> {
    for t in 0..m.ntex {
        let sides = [m.tex_height[t], m.tex_width[t], m.tex_nchannel[t]];
        let bytes = sides.iter().try_fold(1_i64, |product, &side| product.checked_mul(side.into()));
        let end = bytes.and_then(|bytes| m.tex_adr[t].checked_add(bytes));
        let fits = sides.iter().all(|&side| side >= 0)
            && m.tex_adr[t] >= 0
            && end.is_some_and(|end| end <= m.ntexdata as i64);
        require(fits, "tex_adr", t, "the address of its pixels")?;
    }
    Ok(())
}

/// Indices within one mesh.
fn check_mesh(m: &Arrays, mesh: usize) -> Result<(), Inconsistent> {
    let range = |first: i32, count: i32| first.max(0) as usize..(first.max(0) + count) as usize;
    let vertices = range(m.mesh_vertadr[mesh], m.mesh_vertnum[mesh]);
    require(!vertices.is_empty(), "mesh_vertnum", mesh, "positive")?;
    let inside = |values: &[i32], end: i32| values.iter().all(|&x| x >= 0 && x < end);
    for f in range(m.mesh_faceadr[mesh], m.mesh_facenum[mesh]) {
        require(inside(&m.mesh_face[f], m.mesh_vertnum[mesh]), "mesh_face", 3 * f, "a vertex of the mesh")?;
        let normals = inside(&m.mesh_facenormal[f], m.mesh_normalnum[mesh]);
        require(normals, "mesh_facenormal", 3 * f, "normals of the mesh")?;
        let coordinates =
            m.mesh_texcoordadr[mesh] < 0 || inside(&m.mesh_facetexcoord[f], m.mesh_texcoordnum[mesh]);
        require(coordinates, "mesh_facetexcoord", 3 * f, "texture coordinates of the mesh")?;
    }
    for p in range(m.mesh_polyadr[mesh], m.mesh_polynum[mesh]) {
        let corners = range(m.mesh_polyvertadr[p], m.mesh_polyvertnum[p]);
        require(corners.len() > 2, "mesh_polyvertnum", p, "at least 3")?;
        let known = inside(&m.mesh_polyvert[corners], m.mesh_vertnum[mesh]);
        require(known, "mesh_polyvertadr", p, "the address of vertices of the mesh")?;
    }
    for v in vertices {
        let polygons = range(m.mesh_polymapadr[v], m.mesh_polymapnum[v]);
        let known = inside(&m.mesh_polymap[polygons], m.mesh_polynum[mesh]);
        require(known, "mesh_polymapadr", v, "the address of polygons of the mesh")?;
    }
    if let Ok(first) = usize::try_from(m.mesh_bvhadr[mesh]) {
        let nodes = m.mesh_bvhnum[mesh] as usize;
        require(nodes > 0, "mesh_bvhnum", mesh, "at least the root")?;
        nodes_of(m, first, nodes, m.mesh_facenum[mesh] as usize, Inner::NamesNothing)?;
    }
    octree(m, mesh)?;
    hull(m, mesh)
}

/// Cells of an octree come before their parts.
fn octree(m: &Arrays, mesh: usize) -> Result<(), Inconsistent> {
    let Ok(first) = usize::try_from(m.mesh_octadr[mesh]) else { return Ok(()) };
    let cells = m.mesh_octnum[mesh];
    let fits = cells > 0 && first.checked_add(cells as usize).is_some_and(|end| end <= m.noct);
    require(fits, "mesh_octadr", mesh, "the address of an octree")?;
    for (k, child) in m.oct_child[first..first + cells as usize].iter().enumerate() {
        let known = child.iter().all(|&c| c == -1 || (c > k as i32 && c < cells));
        require(known, "oct_child", 8 * (first + k), "parts behind their cell")?;
    }
    Ok(())
}

/// Graph of the hull: counts of vertices and faces, starts of the neighbour lists, vertices, lists that end in -1,
/// faces.
fn hull(m: &Arrays, mesh: usize) -> Result<(), Inconsistent> {
    let Ok(start) = usize::try_from(m.mesh_graphadr[mesh]) else { return Ok(()) };
    let fault = |holds: bool, expected| require(holds, "mesh_graph", start, expected);
    let Some([n, faces, rest @ ..]) = m.mesh_graph.get(start..) else {
        return fault(false, "the address of a hull");
    };
    fault(*n > 0 && *faces >= 0, "a positive number of vertices")?;
    let (n, lists) = (*n as usize, i64::from(*n) + 3 * i64::from(*faces));
    if 2 * n as i64 + lists > rest.len() as i64 {
        return fault(false, "as long as its counts say");
    }
    let lists = lists as usize;
    let (starts, vertices, neighbours) = (&rest[..n], &rest[n..2 * n], &rest[2 * n..2 * n + lists]);
    fault(starts.iter().all(|&s| s >= 0 && (s as usize) < lists), "the start of a list inside the graph")?;
    fault(vertices.iter().all(|&v| v >= 0 && v < m.mesh_vertnum[mesh]), "a vertex of the mesh")?;
    fault(neighbours.iter().all(|&h| h >= -1 && h < n as i32), "a vertex of the hull")?;
    fault(neighbours.last() == Some(&-1), "ended by -1")?;
    let extrema = m.mesh_extrema[mesh].iter().all(|&h| h >= 0 && (h as usize) < n);
    require(extrema, "mesh_extrema", 27 * mesh, "a vertex of the hull")
}

/// A mesh geom has a mesh, a height field geom a height field.
fn geom_data(m: &Arrays, geom: usize) -> Result<(), Inconsistent> {
    let id = m.geom_dataid[geom];
    let (least, end) = match GeomType::from_code(m.geom_type[geom]) {
        Some(GeomType::Mesh | GeomType::Sdf) => (0, m.nmesh),
        Some(GeomType::Hfield) => (0, m.nhfield),
        Some(_) => (-1, m.nmesh.max(m.nhfield)),
        None => return require(false, "geom_type", geom, "a type of geom"),
    };
    let known = id >= least && (id < 0 || (id as usize) < end);
    require(known, "geom_dataid", geom, "a mesh or height field")
}
