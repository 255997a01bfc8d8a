//! Convex hulls of every mesh file below given folders, as one line of hashes a mesh: to record what one
//! version computes and to compare another version with it.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use mjcf::mesh::{CompiledMesh, Hull, MeshInertia, MeshSource, RawMesh, convex_hull, decode, process};

/// Number of vertices of the second hull of each mesh, which stops early.
const LIMIT: i32 = 32;

/// What to do with the lines.
#[derive(Debug, Clone, Copy)]
pub enum Purpose<'a> {
    /// Print them.
    Print,
    /// Print them and write them to a file.
    Record(&'a Path),
    /// Compare them with a file that was recorded before.
    Compare(&'a Path),
}

/// Prints one line for each mesh file in `folders` (STL, OBJ, MSH) and returns the summary; the error says
/// which file or line is wrong, or how many meshes differ from the recorded ones.
pub fn measure(folders: &[PathBuf], purpose: Purpose) -> Result<String, String> {
    let recorded = match purpose {
        Purpose::Compare(path) => read_record(path)?,
        _ => BTreeMap::new(),
    };
    if folders.is_empty() {
        return Err(
            "name at least one folder with mesh files, as in: robohive-validation hulls meshes".into()
        );
    }
    let files = mesh_files(folders)?;
    let mut record = String::new();
    let mut time = Duration::ZERO;
    let (mut different, mut refused) = (0, 0);
    for (k, (name, path)) in files.iter().enumerate() {
        let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
        let result = describe(&bytes, name, &mut time).unwrap_or_else(|why| {
            refused += 1;
            format!("refused: {why}")
        });
        let verdict = match (purpose, recorded.get(name)) {
            (Purpose::Compare(_), Some(before)) if *before == result => "  equal",
            (Purpose::Compare(_), Some(_)) => "  DIFFERENT",
            (Purpose::Compare(_), None) => "  NOT RECORDED",
            _ => "",
        };
        different += usize::from(verdict.len() > "  equal".len());
        println!("{}/{}  {name}  {result}{verdict}", k + 1, files.len());
        writeln!(record, "{name}\t{result}").expect("a String accepts any text");
    }
    let total = format!("{} meshes, {refused} refused; {:.3} s in hulls", files.len(), time.as_secs_f64());
    match purpose {
        Purpose::Print => Ok(total),
        Purpose::Record(path) => {
            std::fs::write(path, record).map_err(|e| format!("{}: {e}", path.display()))?;
            Ok(format!("{total}; recorded in {}", path.display()))
        }
        Purpose::Compare(path) if different > 0 => {
            Err(format!("{total}; {different} differ from {} or are missing there", path.display()))
        }
        Purpose::Compare(path) => Ok(format!("{total}; all equal to {}", path.display())),
    }
}

/// Name and path of each mesh file, in order of names: the last part of the folder's path, then the path
/// inside the folder.
fn mesh_files(folders: &[PathBuf]) -> Result<BTreeMap<String, PathBuf>, String> {
    let mut files = BTreeMap::new();
    for folder in folders {
        let label = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let mut pending = vec![(folder.clone(), label)];
        while let Some((path, name)) = pending.pop() {
            let fail = |e: std::io::Error| format!("{}: {e}", path.display());
            for entry in std::fs::read_dir(&path).map_err(fail)? {
                let entry = entry.map_err(fail)?;
                let name = format!("{name}/{}", entry.file_name().to_string_lossy());
                if entry.file_type().map_err(fail)?.is_dir() {
                    pending.push((entry.path(), name));
                    continue;
                }
                let extension = entry.path().extension().unwrap_or_default().to_ascii_lowercase();
                let is_mesh = ["stl", "obj", "msh"].iter().any(|known| extension == *known);
                if is_mesh && let Some(other) = files.insert(name.clone(), entry.path()) {
                    return Err(format!("{name} stands for two files, one of them {}", other.display()));
                }
            }
        }
    }
    if files.is_empty() {
        return Err("no mesh file (.stl, .obj, .msh) in the given folders".into());
    }
    Ok(files)
}

/// Lines of a record by name of the mesh.
fn read_record(path: &Path) -> Result<BTreeMap<String, String>, String> {
    let text = std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
    let row = |(k, line): (usize, &str)| match line.split_once('\t') {
        Some((name, result)) => Ok((name.to_owned(), result.to_owned())),
        None => Err(format!("{}:{}: no tab between name and hashes", path.display(), k + 1)),
    };
    text.lines().enumerate().map(row).collect()
}

/// Sizes and hashes of the hull of a mesh file, of one with at most `LIMIT` vertices, and of the compiled
/// arrays that follow from it; adds the time spent in hulls.
fn describe(bytes: &[u8], name: &str, time: &mut Duration) -> Result<String, String> {
    let file = decode(bytes, name, "").map_err(|e| e.message)?;
    let points: Vec<[f64; 3]> = file.vert.as_chunks().0.iter().map(|p: &[f32; 3]| p.map(f64::from)).collect();
    let start = Instant::now();
    let hull = convex_hull(&points, -1).map_err(|error| error.to_string())?;
    let limited = convex_hull(&points, LIMIT).map_err(|error| error.to_string())?;
    *time += start.elapsed();
    Ok(format!(
        "{} vertices, {} triangles, {:016x}, limited {:016x}, {}",
        hull.vert.len(),
        hull.face.len(),
        hull_hash(&hull),
        hull_hash(&limited),
        compiled(file)?
    ))
}

fn hull_hash(hull: &Hull) -> u64 {
    let neighbours = hull.neighbours.iter().flat_map(|list| list.iter().copied().chain([-1]));
    hash(hull.vert.iter().copied().chain(hull.face.iter().flatten().copied()).chain(neighbours))
}

/// Hashes of the graph and of the polygons. Inertia of the surface needs no volume, so open meshes compile.
fn compiled(file: RawMesh) -> Result<String, String> {
    let source =
        MeshSource { file: Some(file), inertia: MeshInertia::Shell, needhull: true, ..MeshSource::default() };
    let CompiledMesh { graph, poly_vertnum, poly_vert, poly_map, poly_mapnum, extrema, .. } =
        process(source).map_err(|e| e.message)?;
    let polygons = [poly_vertnum, poly_vert, poly_mapnum, poly_map, extrema.to_vec()].concat();
    Ok(format!("graph {:016x}, polygons {:016x}", hash(graph.into_iter()), hash(polygons.into_iter())))
}

/// FNV-1a over the bytes of `numbers`.
fn hash(numbers: impl Iterator<Item = i32>) -> u64 {
    numbers
        .flat_map(i32::to_le_bytes)
        .fold(0xcbf2_9ce4_8422_2325, |state, byte| (state ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}
