//! Processed meshes as bytes for a cache: a checksum, then every array behind its number of rows.

use super::CompiledMesh;
use crate::bvh::Bvh;
use physics::model::binary::checksum;
use physics::table::Field;

/// A mesh as bytes.
pub(crate) fn to_bytes(mesh: &CompiledMesh) -> Vec<u8> {
    let mut out = vec![0; 8];
    let to = &mut out;
    put(&mesh.vert, to);
    put(&mesh.normal, to);
    put(&mesh.texcoord, to);
    put(&mesh.face, to);
    put(&mesh.facenormal, to);
    put(&mesh.facetexcoord, to);
    put(&mesh.graph, to);
    put(&vec![mesh.extrema], to);
    put(&mesh.poly_normal, to);
    put(&mesh.poly_vertadr, to);
    put(&mesh.poly_vertnum, to);
    put(&mesh.poly_vert, to);
    put(&mesh.poly_mapadr, to);
    put(&mesh.poly_mapnum, to);
    put(&mesh.poly_map, to);
    put(&vec![mesh.scale, mesh.pos, mesh.boxsz], to);
    put(&vec![mesh.quat], to);
    put(&vec![mesh.aamm], to);
    put(&vec![mesh.volume], to);
    put(&mesh.bvh.depth, to);
    put(&mesh.bvh.child, to);
    put(&mesh.bvh.nodeid, to);
    put(&mesh.bvh.aabb, to);
    let digest = checksum(&out[8..]);
    out[..8].copy_from_slice(&digest.to_le_bytes());
    out
}

/// The mesh that [`to_bytes`] made `bytes` of; `None` when they are damaged.
pub(crate) fn from_bytes(bytes: &[u8]) -> Option<CompiledMesh> {
    let (digest, mut from) = bytes.split_first_chunk::<8>()?;
    if checksum(from).to_le_bytes() != *digest {
        return None;
    }
    let from = &mut from;
    let mut mesh = CompiledMesh {
        vert: take(from)?,
        normal: take(from)?,
        texcoord: take(from)?,
        face: take(from)?,
        facenormal: take(from)?,
        facetexcoord: take(from)?,
        graph: take(from)?,
        extrema: take::<Vec<_>>(from)?.pop()?,
        poly_normal: take(from)?,
        poly_vertadr: take(from)?,
        poly_vertnum: take(from)?,
        poly_vert: take(from)?,
        poly_mapadr: take(from)?,
        poly_mapnum: take(from)?,
        poly_map: take(from)?,
        ..CompiledMesh::default()
    };
    [mesh.scale, mesh.pos, mesh.boxsz] = take::<Vec<_>>(from)?.try_into().ok()?;
    mesh.quat = take::<Vec<_>>(from)?.pop()?;
    mesh.aamm = take::<Vec<_>>(from)?.pop()?;
    mesh.volume = take::<Vec<_>>(from)?.pop()?;
    mesh.bvh = Bvh { depth: take(from)?, child: take(from)?, nodeid: take(from)?, aabb: take(from)? };
    Some(mesh)
}

fn put<F: Field>(field: &F, to: &mut Vec<u8>) {
    let scalars = field.scalars();
    to.extend(((scalars.len() / F::COLUMNS) as u64).to_le_bytes());
    scalars.pieces(&mut |bytes| to.extend_from_slice(bytes));
}

fn take<F: Field + Default>(from: &mut &[u8]) -> Option<F> {
    let (rows, rest) = from.split_first_chunk()?;
    let rows = usize::try_from(u64::from_le_bytes(*rows)).ok()?;
    let (bytes, rest) = rest.split_at_checked(rows.checked_mul(F::ROW_BYTES)?)?;
    *from = rest;
    let mut field = F::default();
    field.restart(rows);
    field.append(bytes);
    Some(field)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{MeshSource, RawMesh, process};

    #[test]
    fn a_mesh_comes_back_and_a_damaged_one_does_not() {
        let inline = RawMesh {
            vert: vec![0., 0., 0., 2., 0., 0., 0., 1., 0., 0., 0., 3., 1., 1., 1.],
            texcoord: vec![0., 0., 1., 0., 0., 1., 1., 1., 0.5, 0.5],
            ..RawMesh::default()
        };
        let source = MeshSource { inline, scale: [1.0, 2.0, 0.5], needhull: true, ..MeshSource::default() };
        let mesh = process(source).unwrap();
        assert!(mesh.graph.len() > 20 && mesh.bvh.depth.len() > 5 && !mesh.texcoord.is_empty());
        let bytes = to_bytes(&mesh);
        assert_eq!(from_bytes(&bytes), Some(mesh));
        for at in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[at] ^= 4;
            assert_eq!(from_bytes(&damaged), None, "byte {at}");
            assert_eq!(from_bytes(&bytes[..at]), None, "{at} bytes");
        }
    }
}
