//! One function for each decoder that reads bytes of unknown origin, and for the renderer, whose scenes and models are made
//! up from bytes, as flexes are. It may refuse them, quickly and within little memory; a panic, more than a second or more than a gigabyte
//! is a finding.

mod bytes;
pub mod flexes;
mod models;
pub mod pictures;
pub mod robots;
pub mod tasks;

use std::io::Cursor;

use dataset::trace::{TraceReader, summarise};
use dataset::{Array, NpzReader};
use mjcf::files::Memory;
use mjcf::image::{CompiledHfield, FileImage, HfieldSource, TextureSource, TextureType};
use mjcf::mesh::{MeshInertia, MeshSource, RawMesh, SkinSource, convex_hull, decode, process, skin};
use physics::Model;
use physics::model::binary::seal;

/// What decodes one input.
pub type Target = fn(&[u8]);

/// Every target by name.
pub const TARGETS: [(&str, Target); 18] = [
    ("mjcf", mjcf),
    ("urdf", urdf),
    ("stl", stl),
    ("obj", obj),
    ("msh", msh),
    ("skn", skn),
    ("gmsh", gmsh),
    ("hull", hull),
    ("image", image),
    ("hfield", hfield),
    ("npz", npz),
    ("hdf5", hdf5),
    ("binary", binary),
    ("render", pictures::render),
    ("flex", flexes::flex),
    ("robot", robots::robot),
    ("settings", tasks::settings),
    ("policy", tasks::policy),
];

/// Files that a model of the `mjcf` target may name, in the order in which the input gives them.
const FILES: [&str; 6] = ["model.xml", "a.xml", "b.xml", "m.obj", "t.png", "h.bin"];

/// A model and what it includes, attaches and shows: contents of [`FILES`], a zero byte between two.
pub fn mjcf(data: &[u8]) {
    let mut memory = Memory::default();
    for (path, content) in FILES.iter().zip(data.split(|&byte| byte == 0)) {
        memory.insert(path, content);
    }
    models::come_back(memory, FILES[0]);
}

/// A robot and the mesh that it may show: two texts, a zero byte between them.
pub fn urdf(data: &[u8]) {
    let mut memory = Memory::default();
    for (path, content) in ["r.urdf", "m.obj"].iter().zip(data.split(|&byte| byte == 0)) {
        memory.insert(path, content);
    }
    models::come_back(memory, "r.urdf");
}

/// A mesh of GMSH in either format, binary or text; elements that are read have the points they name.
pub fn gmsh(data: &[u8]) {
    if let Ok(cloud) = mjcf::flex::decode_gmsh(data, "f.msh") {
        let points = cloud.point.len() / 3;
        assert!(cloud.element.iter().all(|&p| p >= 0 && (p as usize) < points));
        assert!(cloud.element.len().is_multiple_of(cloud.dim as usize + 1));
    }
}

/// A mesh file in STL, binary or text.
pub fn stl(data: &[u8]) {
    mesh_file(data, "m.stl");
}

/// A mesh file in OBJ.
pub fn obj(data: &[u8]) {
    mesh_file(data, "m.obj");
}

/// A mesh file in MSH.
pub fn msh(data: &[u8]) {
    mesh_file(data, "m.msh");
}

/// A skin file.
pub fn skn(data: &[u8]) {
    let source = SkinSource { file: Some((data.to_vec(), "s.skn".into())), ..SkinSource::default() };
    let Ok(skin) = skin(source) else { return };
    let vertices = skin.vert.len() as i32;
    assert!(skin.face.iter().flatten().all(|v| (0..vertices).contains(v)));
    let weights = skin.bones.iter().map(|bone| (bone.vertid.len(), bone.vertweight.len()));
    assert!(weights.into_iter().all(|(ids, weights)| ids == weights && ids > 0));
}

/// Decodes and processes; hulls of clouds of any shape are the `hull` target's.
fn mesh_file(data: &[u8], path: &str) {
    let Ok(file) = decode(data, path, "") else { return };
    let Ok(mesh) = process(MeshSource { file: Some(file), needhull: true, ..MeshSource::default() }) else {
        return;
    };
    let vertices = mesh.vert.len() as i32;
    assert!(mesh.face.iter().flatten().all(|v| (0..vertices).contains(v)));
    assert!(mesh.vert.as_flattened().iter().all(|x| x.is_finite()));
}

/// A cloud of vertices: one byte of choices, one of grid size, then coordinates as bytes on a grid, which
/// makes ties, or as 32-bit floats.
pub fn hull(data: &[u8]) {
    let [choice, step, body @ ..] = data else { return };
    let vert: Vec<f32> = match choice & 1 {
        0 => body.iter().map(|&b| f32::from(b as i8) * (f32::from(*step) + 1.0) * 1e-3).collect(),
        _ => body.as_chunks().0.iter().map(|&word| f32::from_le_bytes(word)).collect(),
    };
    let vert = vert[..vert.len() / 3 * 3].to_vec();
    let most = [-1, 4, 7, 20][usize::from(choice >> 1 & 3)];
    let points: Vec<[f64; 3]> = vert.as_chunks().0.iter().map(|p: &[f32; 3]| p.map(f64::from)).collect();
    if points.as_flattened().iter().all(|x| x.is_finite())
        && let Ok(hull) = convex_hull(&points, most)
    {
        assert!(hull.face.len() >= 4 && hull.vert.len() == hull.neighbours.len());
        assert!(hull.face.iter().flatten().all(|&v| hull.vert.contains(&v)));
    }
    let inertia = [MeshInertia::Legacy, MeshInertia::Convex, MeshInertia::Exact, MeshInertia::Shell];
    let inline = RawMesh { vert, ..RawMesh::default() };
    let inertia = inertia[usize::from(choice >> 3 & 3)];
    let _ =
        process(MeshSource { inline, inertia, maxhullvert: most, needhull: true, ..MeshSource::default() });
}

/// A texture file: one byte of choices, then PNG or KTX.
pub fn image(data: &[u8]) {
    let [choice, bytes @ ..] = data else { return };
    let bit = |k: u8| choice >> k & 1 == 1;
    let path = if choice & 7 == 7 { "t.ktx" } else { "t.png" };
    let file = FileImage { bytes: bytes.to_vec(), path: path.into() };
    let (file, cubefiles) = match bit(3) {
        true => (Some(file), Default::default()),
        false => (None, std::array::from_fn(|k| (k % 2 == 0).then(|| file.clone()))),
    };
    let source = TextureSource {
        file,
        cubefiles,
        kind: if bit(4) { TextureType::Texture2d } else { TextureType::Skybox },
        nchannel: if bit(4) { [1, 3, 4, 2][usize::from(choice & 3)] } else { 3 },
        gridsize: if bit(5) { [3, 4] } else { [1, 1] },
        gridlayout: ".U..LFRB.D..".into(),
        hflip: bit(6),
        vflip: bit(7),
        ..TextureSource::default()
    };
    if let Ok(texture) = mjcf::image::texture(&source) {
        assert_eq!(texture.data.len(), texture.width * texture.height * texture.nchannel);
    }
}

/// A height field file: one byte that chooses PNG or MuJoCo's own format, then the file.
pub fn hfield(data: &[u8]) {
    let [choice, bytes @ ..] = data else { return };
    let path = if choice & 1 == 0 { "h.png" } else { "h.bin" };
    let source =
        HfieldSource { file: Some((bytes.to_vec(), path.into())), size: [1.0; 4], ..HfieldSource::default() };
    if let Ok(CompiledHfield { nrow, ncol, data, .. }) = mjcf::image::hfield(source) {
        assert_eq!(data.len(), nrow * ncol);
        assert!(data.iter().all(|x| x.is_finite()), "{data:?}");
    }
}

/// A numpy archive, or a numpy array.
pub fn npz(data: &[u8]) {
    if let Ok(reader) = NpzReader::read(Cursor::new(data)) {
        for name in reader.names() {
            let _ = reader.get(name);
        }
    }
    if let Ok(array) = Array::decode(data) {
        assert_eq!(array.values.len(), array.shape.iter().product::<usize>());
        assert_eq!(Array::decode(&array.encode()).map(|again| again.shape), Ok(array.shape));
    }
}

/// A recording of episodes, read whole.
pub fn hdf5(data: &[u8]) {
    if let Ok(trace) = TraceReader::memory("recording", data.to_vec()) {
        let _ = summarise(&trace);
    }
}

/// A compiled model, whose header is made to fit: else nothing would pass the checksum. What is read is stepped.
pub fn binary(data: &[u8]) {
    let mut bytes = data.to_vec();
    seal(&mut bytes);
    if let Ok(model) = Model::from_bytes(&bytes) {
        // Not `bytes` themselves: any byte but zero is a truth.
        let written = model.to_bytes();
        assert!(Model::from_bytes(&written).is_ok_and(|again| again.to_bytes() == written));
        models::steps(model);
    }
    let _ = Model::from_bytes(data);
}
