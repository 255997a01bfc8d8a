//! Meshes, height fields, textures and materials: files are read here, compiled on all cores, and laid out in
//! the order of the file.

use super::body::append_hierarchy;
use super::lookup::Lookup;
use super::{Log, title};
use crate::asset::AssetError;
use crate::cache::Cache;
use crate::diagnostic::Loc;
use crate::files::{FileProvider, base_name};
use crate::image::{
    self, Colorspace, CompiledHfield, CompiledTexture, FileImage, HfieldSource, TextureKind, TextureSource,
};
use crate::mesh::{self, CompiledMesh, MeshInertia, MeshSource, RawMesh, Shape};
use crate::spec::{Body, Hfield, Mesh, Spec, Texture};
use crate::suggestion::Suggestions;
use physics::model::{Arrays, ColorSpace, GeomType, ObjType, TextureType};
use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// One asset: its name (that of its file when the element has none) and what it compiled to.
pub(super) struct Asset<T> {
    pub name: String,
    pub loc: Loc,
    pub path: String,
    pub material: String,
    pub compiled: T,
}

/// All assets of the model.
pub(super) struct Assets {
    pub meshes: Vec<Asset<CompiledMesh>>,
    pub hfields: Vec<Asset<CompiledHfield>>,
    pub textures: Vec<Asset<CompiledTexture>>,
    /// Materials hold no compiled data.
    pub materials: Vec<Asset<()>>,
    mesh_ids: BTreeMap<String, usize>,
    hfield_ids: BTreeMap<String, usize>,
    suggestions: Cell<Suggestions>,
}

impl Assets {
    /// Id of a mesh by name, before anything is discarded.
    pub(super) fn mesh_id(&self, name: &str) -> Result<usize, String> {
        self.find(&self.mesh_ids, "mesh", name)
    }

    /// Id of a height field by name.
    pub(super) fn hfield_id(&self, name: &str) -> Result<usize, String> {
        self.find(&self.hfield_ids, "hfield", name)
    }

    fn find(&self, ids: &BTreeMap<String, usize>, kind: &str, name: &str) -> Result<usize, String> {
        ids.get(name).copied().ok_or_else(|| {
            let mut suggestions = self.suggestions.get();
            let near = suggestions.nearest(name, ids.keys().map(String::as_str));
            self.suggestions.set(suggestions);
            match near {
                Some(near) => format!("there is no {kind} '{name}'; did you mean '{near}'?"),
                None => format!("there is no {kind} '{name}'"),
            }
        })
    }
}

/// Name of an asset: its own, or that of its file.
pub(crate) fn asset_name(name: &str, path: &str) -> String {
    if !name.is_empty() {
        return name.to_owned();
    }
    let base = base_name(path);
    base.rfind('.').map_or(base, |dot| &base[..dot]).to_owned()
}

/// Work for one core: everything an asset needs, with its bytes.
enum Job<'s> {
    Mesh { spec: &'s Mesh, name: String, bytes: Option<Arc<[u8]>>, needhull: bool, discard: bool },
    Texture { source: Box<TextureSource> },
    Hfield { source: HfieldSource },
}

enum Outcome {
    Mesh(Box<CompiledMesh>),
    Texture(CompiledTexture),
    Hfield(CompiledHfield),
}

/// Reads and compiles all assets.
pub(super) fn compile(spec: &Spec, files: &dyn FileProvider, cache: Option<&Cache>, log: &mut Log) -> Assets {
    let colliding = colliding_meshes(spec);
    let textures: &[Texture] = if spec.compiler.discardvisual { &[] } else { &spec.textures };
    let mut jobs = Vec::new();
    let mut heads: Vec<(String, Loc, String, String)> = Vec::new();
    for mesh in &spec.meshes {
        let name = asset_name(&mesh.name, &mesh.path);
        let bytes = read(files, &mesh.file, mesh.loc, &title("mesh", &name), log);
        let needhull = mesh.inertia == MeshInertia::Convex || colliding.contains(&*name);
        jobs.push(Job::Mesh {
            spec: mesh,
            name: name.clone(),
            bytes,
            needhull,
            discard: spec.compiler.discardvisual,
        });
        heads.push((name, mesh.loc, mesh.path.clone(), mesh.material.clone()));
    }
    for texture in textures {
        let name = asset_name(&texture.name, &texture.path);
        jobs.push(Job::Texture { source: Box::new(texture_source(texture, &name, files, log)) });
        heads.push((name, texture.loc, texture.path.clone(), String::new()));
    }
    for hfield in &spec.hfields {
        let name = asset_name(&hfield.name, &hfield.path);
        let bytes = read(files, &hfield.file, hfield.loc, &title("hfield", &name), log);
        jobs.push(Job::Hfield { source: hfield_source(hfield, &name, bytes) });
        heads.push((name, hfield.loc, hfield.path.clone(), String::new()));
    }
    let outcomes = if log.diagnostics.has_errors() {
        Vec::new()
    } else {
        run_all(&jobs, cache, spec.compiler.usethread)
    };
    let mut assets = Assets {
        meshes: Vec::new(),
        hfields: Vec::new(),
        textures: Vec::new(),
        materials: Vec::new(),
        mesh_ids: BTreeMap::new(),
        hfield_ids: BTreeMap::new(),
        suggestions: Cell::default(),
    };
    let mut outcomes = outcomes.into_iter();
    for ((name, loc, path, material), job) in heads.into_iter().zip(&jobs) {
        let outcome = outcomes.next().and_then(|outcome| match outcome {
            Ok(outcome) => Some(outcome),
            Err(error) => {
                log.error(loc, error.message);
                None
            }
        });
        check_name(&name, loc, job, log);
        match job {
            Job::Mesh { .. } => {
                let compiled =
                    if let Some(Outcome::Mesh(mesh)) = outcome { *mesh } else { CompiledMesh::default() };
                assets.mesh_ids.entry(name.clone()).or_insert(assets.meshes.len());
                assets.meshes.push(Asset { name, loc, path, material, compiled });
            }
            Job::Texture { .. } => {
                let compiled =
                    if let Some(Outcome::Texture(t)) = outcome { t } else { CompiledTexture::default() };
                assets.textures.push(Asset { name, loc, path, material, compiled });
            }
            Job::Hfield { .. } => {
                let compiled =
                    if let Some(Outcome::Hfield(h)) = outcome { h } else { CompiledHfield::default() };
                assets.hfield_ids.entry(name.clone()).or_insert(assets.hfields.len());
                assets.hfields.push(Asset { name, loc, path, material, compiled });
            }
        }
    }
    if !spec.compiler.discardvisual {
        for material in &spec.materials {
            if material.name.is_empty() {
                log.error(material.loc, "material without a name");
            }
            let (name, loc) = (material.name.clone(), material.loc);
            assets.materials.push(Asset {
                name,
                loc,
                path: String::new(),
                material: String::new(),
                compiled: (),
            });
        }
    }
    assets
}

fn check_name(name: &str, loc: Loc, job: &Job, log: &mut Log) {
    let skybox = matches!(job, Job::Texture { source } if source.kind == TextureKind::Skybox);
    if name.is_empty() && !skybox {
        let kind = match job {
            Job::Mesh { .. } => "mesh",
            Job::Texture { .. } => "texture",
            Job::Hfield { .. } => "hfield",
        };
        log.error(loc, format!("{kind} without a name"));
    }
}

/// Meshes of geoms that may collide: they need a convex hull.
fn colliding_meshes(spec: &Spec) -> BTreeSet<&str> {
    let paired: BTreeSet<&str> = spec.pairs.iter().flat_map(|p| [&*p.geomname1, &*p.geomname2]).collect();
    let mut names = BTreeSet::new();
    let mut pending: Vec<&Body> = vec![&spec.world];
    while let Some(body) = pending.pop() {
        let geoms = body.geoms.iter().filter(|g| g.kind == GeomType::Mesh);
        names.extend(
            geoms
                .filter(|g| {
                    g.contype != 0 || g.conaffinity != 0 || (!g.name.is_empty() && paired.contains(&*g.name))
                })
                .map(|g| &*g.meshname),
        );
        pending.extend(&body.bodies);
    }
    names
}

fn read(files: &dyn FileProvider, file: &str, loc: Loc, what: &str, log: &mut Log) -> Option<Arc<[u8]>> {
    if file.is_empty() {
        return None;
    }
    let bytes = files.read(file).map_err(|error| format!("cannot read '{file}': {error}"));
    log.check(loc, what, bytes)
}

fn texture_source(spec: &Texture, name: &str, files: &dyn FileProvider, log: &mut Log) -> TextureSource {
    let what = title("texture", name);
    let mut image = |file: &String| {
        let bytes = read(files, file, spec.loc, &what, log)?;
        Some(FileImage { bytes: bytes.to_vec(), path: file.clone() })
    };
    TextureSource {
        name: name.to_owned(),
        kind: match spec.kind {
            TextureType::Texture2d => TextureKind::Image2d,
            TextureType::Cube => TextureKind::Cube,
            TextureType::Skybox => TextureKind::Skybox,
        },
        colorspace: match spec.colorspace {
            ColorSpace::Auto => Colorspace::Auto,
            ColorSpace::Linear => Colorspace::Linear,
            ColorSpace::Srgb => Colorspace::Srgb,
        },
        file: image(&spec.file),
        cubefiles: std::array::from_fn(|k| image(&spec.cubefiles[k])),
        content_type: spec.content_type.clone(),
        gridsize: spec.gridsize.map(|n| n.max(0) as usize),
        gridlayout: spec.gridlayout.clone(),
        builtin: spec.builtin,
        mark: spec.mark,
        rgb1: spec.rgb1,
        rgb2: spec.rgb2,
        markrgb: spec.markrgb,
        random: spec.random,
        width: spec.width.max(0) as usize,
        height: spec.height.max(0) as usize,
        hflip: spec.hflip,
        vflip: spec.vflip,
        nchannel: spec.nchannel.max(0) as usize,
    }
}

fn hfield_source(spec: &Hfield, name: &str, bytes: Option<Arc<[u8]>>) -> HfieldSource {
    // A file brings its own dimensions.
    let (nrow, ncol) =
        if bytes.is_some() { (0, 0) } else { (spec.nrow.max(0) as usize, spec.ncol.max(0) as usize) };
    HfieldSource {
        name: name.to_owned(),
        file: bytes.map(|b| (b.to_vec(), spec.file.clone())),
        content_type: spec.content_type.clone(),
        nrow,
        ncol,
        elevation: spec.userdata.clone(),
        size: spec.size,
    }
}

/// The arrays of a mesh that is given in place or computed.
fn inline_mesh(spec: &Mesh, discard: bool) -> Result<RawMesh, AssetError> {
    if let Some(shape) = spec.builtin {
        return mesh::builtin(shape, &spec.params);
    }
    Ok(RawMesh {
        vert: spec.uservert.clone(),
        normal: spec.usernormal.clone(),
        texcoord: if discard { Vec::new() } else { spec.usertexcoord.clone() },
        face: spec.userface.clone(),
        facenormal: spec.userfacenormal.clone(),
        facetexcoord: if discard { Vec::new() } else { spec.userfacetexcoord.clone() },
        ..RawMesh::default()
    })
}

impl Job<'_> {
    /// Bytes to process, a measure of the time it takes.
    fn weight(&self) -> usize {
        match self {
            Job::Mesh { spec, bytes, .. } => bytes.as_ref().map_or(spec.uservert.len(), |b| b.len()),
            Job::Texture { source } => {
                source.file.iter().chain(source.cubefiles.iter().flatten()).map(|f| 8 * f.bytes.len()).sum()
            }
            Job::Hfield { source } => source.elevation.len(),
        }
    }

    fn run(&self, cache: Option<&Cache>) -> Result<Outcome, AssetError> {
        match self {
            Job::Mesh { spec, name, bytes, needhull, discard } => {
                let inline = inline_mesh(spec, *discard)?;
                let source = MeshSource {
                    name: String::new(),
                    file: None,
                    inline,
                    scale: spec.scale,
                    refpos: spec.refpos,
                    refquat: spec.refquat,
                    // A plate has no volume.
                    inertia: if spec.builtin == Some(Shape::Plate) {
                        MeshInertia::Shell
                    } else {
                        spec.inertia
                    },
                    smoothnormal: spec.smoothnormal,
                    maxhullvert: spec.maxhullvert,
                    needhull: *needhull,
                };
                let process = |source, file| mesh::process(MeshSource { name: name.clone(), file, ..source });
                let Some(bytes) = bytes else {
                    return process(source, None).map(|mesh| Outcome::Mesh(Box::new(mesh)));
                };
                // All but the content that enters; names and paths stand in messages only.
                let extension = spec.file.rsplit('.').next();
                let attributes = cache.map(|_| format!("{extension:?} {:?} {source:?}", spec.content_type));
                let make = || process(source, Some(mesh::decode(bytes, &spec.file, &spec.content_type)?));
                match (cache, attributes) {
                    (Some(cache), Some(attributes)) => cache.mesh(bytes, &attributes, make),
                    _ => make(),
                }
                .map(|mesh| Outcome::Mesh(Box::new(mesh)))
            }
            Job::Texture { source } => image::texture(source).map(Outcome::Texture),
            Job::Hfield { source } => image::hfield(source.clone()).map(Outcome::Hfield),
        }
    }
}

/// Runs the jobs, results in their order whatever the number of threads.
fn run_all(jobs: &[Job], cache: Option<&Cache>, threads: bool) -> Vec<Result<Outcome, AssetError>> {
    let cores = std::thread::available_parallelism().map_or(1, |n| n.get()).min(jobs.len());
    if !threads || cores < 2 {
        return jobs.iter().map(|job| job.run(cache)).collect();
    }
    // Largest first, so that no core is left with a long job at the end.
    let mut order: Vec<usize> = (0..jobs.len()).collect();
    order.sort_by_key(|&index| std::cmp::Reverse(jobs[index].weight()));
    let next = AtomicUsize::new(0);
    let worker = || {
        let mut done = Vec::new();
        loop {
            let Some(&index) = order.get(next.fetch_add(1, Ordering::Relaxed)) else { return done };
            done.push((index, jobs[index].run(cache)));
        }
    };
    let mut results: Vec<_> = std::thread::scope(|scope| {
        let handles: Vec<_> = (1..cores).map(|_| scope.spawn(worker)).collect();
        let mut all = worker();
        for handle in handles {
            match handle.join() {
                Ok(done) => all.extend(done),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        all
    });
    results.sort_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}

/// Appends all assets except the hierarchies, which follow those of the bodies.
pub(super) fn fill(m: &mut Arrays, assets: &Assets, spec: &Spec, lookup: &Lookup, log: &mut Log) {
    m.tex_data.reserve_exact(assets.textures.iter().map(|asset| asset.compiled.data.len()).sum());
    let total =
        |count: fn(&CompiledMesh) -> usize| assets.meshes.iter().map(|asset| count(&asset.compiled)).sum();
    m.mesh_vert.reserve_exact(total(|mesh| mesh.vert.len()));
    m.mesh_normal.reserve_exact(total(|mesh| mesh.normal.len()));
    for rows in [&mut m.mesh_face, &mut m.mesh_facenormal, &mut m.mesh_facetexcoord] {
        rows.reserve_exact(total(|mesh| mesh.face.len()));
    }
    assets.meshes.iter().for_each(|asset| fill_mesh(m, &asset.compiled));
    for asset in &assets.hfields {
        let hfield = &asset.compiled;
        m.hfield_size.push(hfield.size);
        m.hfield_nrow.push(hfield.nrow as i32);
        m.hfield_ncol.push(hfield.ncol as i32);
        m.hfield_adr.push(m.hfield_data.len() as i32);
        m.hfield_data.extend(&hfield.data);
    }
    for (asset, texture) in assets.textures.iter().zip(&spec.textures) {
        let t = &asset.compiled;
        m.tex_type.push(texture.kind.code());
        m.tex_colorspace.push(t.colorspace as i32);
        m.tex_height.push(t.height as i32);
        m.tex_width.push(t.width as i32);
        m.tex_nchannel.push(t.nchannel as i32);
        m.tex_adr.push(m.tex_data.len() as i64);
        m.tex_data.extend(&t.data);
    }
    for material in spec.materials.iter().take(assets.materials.len()) {
        let what = title("material", &material.name);
        m.mat_texid.push(std::array::from_fn(|role| {
            lookup.reference(ObjType::Texture, &material.textures[role], material.loc, &what, log)
        }));
        m.mat_texuniform.push(material.texuniform);
        m.mat_texrepeat.push(material.texrepeat);
        m.mat_emission.push(material.emission);
        m.mat_specular.push(material.specular);
        m.mat_shininess.push(material.shininess);
        m.mat_reflectance.push(material.reflectance);
        m.mat_metallic.push(material.metallic);
        m.mat_roughness.push(material.roughness);
        m.mat_rgba.push(material.rgba);
    }
}

fn fill_mesh(m: &mut Arrays, mesh: &CompiledMesh) {
    let address = |count: usize, next: usize| if count == 0 { -1 } else { next as i32 };
    m.mesh_vertadr.push(m.mesh_vert.len() as i32);
    m.mesh_vertnum.push(mesh.vert.len() as i32);
    m.mesh_faceadr.push(m.mesh_face.len() as i32);
    m.mesh_facenum.push(mesh.face.len() as i32);
    m.mesh_octadr.push(-1);
    m.mesh_octnum.push(0);
    m.mesh_normaladr.push(m.mesh_normal.len() as i32);
    m.mesh_normalnum.push(mesh.normal.len() as i32);
    m.mesh_texcoordadr.push(address(mesh.texcoord.len(), m.mesh_texcoord.len()));
    m.mesh_texcoordnum.push(mesh.texcoord.len() as i32);
    m.mesh_graphadr.push(address(mesh.graph.len(), m.mesh_graph.len()));
    m.mesh_extrema.push(mesh.extrema);
    m.mesh_polyadr.push(m.mesh_polynormal.len() as i32);
    m.mesh_polynum.push(mesh.poly_normal.len() as i32);
    m.mesh_scale.push(mesh.scale);
    m.mesh_pos.push(mesh.pos);
    m.mesh_quat.push(mesh.quat);
    let (first_vert, first_map) = (m.mesh_polyvert.len() as i32, m.mesh_polymap.len() as i32);
    m.mesh_polyvertadr.extend(mesh.poly_vertadr.iter().map(|a| a + first_vert));
    m.mesh_polyvertnum.extend(&mesh.poly_vertnum);
    m.mesh_polyvert.extend(&mesh.poly_vert);
    m.mesh_polymapadr.extend(mesh.poly_mapadr.iter().map(|a| a + first_map));
    m.mesh_polymapnum.extend(&mesh.poly_mapnum);
    m.mesh_polymap.extend(&mesh.poly_map);
    m.mesh_polynormal.extend(&mesh.poly_normal);
    m.mesh_vert.extend(&mesh.vert);
    m.mesh_normal.extend(&mesh.normal);
    m.mesh_texcoord.extend(&mesh.texcoord);
    m.mesh_face.extend(&mesh.face);
    m.mesh_facenormal.extend(&mesh.facenormal);
    m.mesh_facetexcoord.extend(&mesh.facetexcoord);
    m.mesh_graph.extend(&mesh.graph);
}

/// Appends the hierarchies of meshes.
pub(super) fn fill_hierarchies(m: &mut Arrays, assets: &Assets) {
    let nodes = assets.meshes.iter().map(|asset| asset.compiled.bvh.depth.len()).sum();
    m.bvh_depth.reserve_exact(nodes);
    m.bvh_child.reserve_exact(nodes);
    m.bvh_nodeid.reserve_exact(nodes);
    m.bvh_aabb.reserve_exact(nodes);
    for asset in &assets.meshes {
        let count = asset.compiled.bvh.depth.len();
        m.mesh_bvhadr.push(if count == 0 { -1 } else { m.bvh_depth.len() as i32 });
        m.mesh_bvhnum.push(count as i32);
        append_hierarchy(m, &asset.compiled.bvh);
    }
}
