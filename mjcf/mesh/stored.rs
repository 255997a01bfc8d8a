//! Processed meshes as bytes for a cache: a checksum, then every array behind its number of rows.

use super::compiled::CompiledMesh;
use crate::digest::Digest;
use physics::model::binary::checksum;

/// Where processed meshes are kept, each under the digest of its inputs.
pub(crate) trait MeshStore: Sync {
    /// The mesh compiled from `source`, if it is there and undamaged.
    fn find(&self, source: Digest) -> Option<CompiledMesh>;

    /// Keeps a mesh, where there is room for it.
    fn keep(&self, source: Digest, mesh: &CompiledMesh);
}

/// The fields of a mesh in the order of the bytes: `rows` are vectors, `row` is a single value.
macro_rules! fields {
    ($($kind:ident $($field:ident).+;)*) => {
        fn put(mesh: &CompiledMesh, to: &mut Vec<u8>) {
            $($kind::put(&mesh.$($field).+, to);)*
        }

        fn take(from: &mut &[u8]) -> Option<CompiledMesh> {
            let mut mesh = CompiledMesh::default();
            $(mesh.$($field).+ = $kind::take(from)?;)*
            Some(mesh)
        }
    };
}

fields! {
    rows vert;
    rows normal;
    rows texcoord;
    rows face;
    rows facenormal;
    rows facetexcoord;
    rows graph;
    row extrema;
    rows poly_normal;
    rows poly_vertadr;
    rows poly_vertnum;
    rows poly_vert;
    rows poly_mapadr;
    rows poly_mapnum;
    rows poly_map;
    rows octree.depth;
    rows octree.child;
    rows octree.aabb;
    rows octree.coeff;
    row scale;
    row pos;
    row boxsz;
    row quat;
    row aamm;
    row volume;
    rows bvh.depth;
    rows bvh.child;
    rows bvh.nodeid;
    rows bvh.aabb;
}

mod rows {
    use physics::table::Field;

    /// Appends the number of rows and the rows.
    pub(super) fn put<F: Field>(field: &F, to: &mut Vec<u8>) {
        let scalars = field.scalars();
        to.extend(((scalars.len() / F::COLUMNS) as u64).to_le_bytes());
        scalars.pieces(&mut |bytes| to.extend_from_slice(bytes));
    }

    /// The rows at the start of `from`, which then begins behind them.
    pub(super) fn take<F: Field + Default>(from: &mut &[u8]) -> Option<F> {
        let (rows, rest) = from.split_first_chunk()?;
        let rows = usize::try_from(u64::from_le_bytes(*rows)).ok()?;
        let (bytes, rest) = rest.split_at_checked(rows.checked_mul(F::ROW_BYTES)?)?;
        *from = rest;
        let mut field = F::default();
        field.allocate(rows, 1);
        field.write(0, bytes);
        Some(field)
    }
}

mod row {
    use super::rows;
    use physics::table::Field;

    /// Appends a single value.
    pub(super) fn put<T: Copy>(value: &T, to: &mut Vec<u8>)
    where
        Vec<T>: Field,
    {
        rows::put(&vec![*value], to);
    }

    /// The single value at the start of `from`.
    pub(super) fn take<T>(from: &mut &[u8]) -> Option<T>
    where
        Vec<T>: Field + Default,
    {
        let [value] = <[T; 1]>::try_from(rows::take::<Vec<T>>(from)?).ok()?;
        Some(value)
    }
}

/// A mesh as bytes.
pub(crate) fn to_bytes(mesh: &CompiledMesh) -> Vec<u8> {
    let mut out = vec![0; 8];
    put(mesh, &mut out);
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
    take(&mut from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::process::process;
    use crate::mesh::source::{MeshSource, RawMesh};

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
