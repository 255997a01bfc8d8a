//! Meshes, skins, height fields, textures and materials: files are read here, compiled on all cores, and laid out in
//! the order of the file.

use super::log::{Log, title};
use super::plugins::Plugins;
use super::resources::Resources;
use crate::asset::AssetError;
use crate::budget::{Content, decoded};
use crate::diagnostic::Loc;
use crate::digest::digest_parts;
use crate::files::FileProvider;
use crate::image::{self, CompiledHfield, CompiledTexture, FileImage, HfieldSource, TextureSource};
use crate::mesh::stored::MeshStore;
use crate::mesh::{
    self, CompiledMesh, CompiledSkin, MeshInertia, MeshSource, RawMesh, RawSkin, Shape, SkinSource,
};
use crate::spec::{Body, Hfield, Mesh, Skin, Spec, Texture, asset_name};
use physics::model::{GeomType, Suggestions, TextureType};
use physics::plugin::{Capability, Field};
use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// One asset: its name (the file's name when the element has none) and what it compiled to.
pub(super) struct Asset<T> {
    pub name: String,
    pub loc: Loc,
    pub path: String,
    pub material: String,
    pub compiled: T,
}

/// All assets of the model.
#[derive(Default)]
pub(super) struct Assets {
    pub meshes: Vec<Asset<CompiledMesh>>,
    pub skins: Vec<Asset<CompiledSkin>>,
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

/// Work for one core: everything an asset needs, with its bytes.
enum Job<'s> {
    Mesh {
        spec: &'s Mesh,
        name: String,
        bytes: Option<Arc<[u8]>>,
        field: Option<Box<dyn Field>>,
        needs: Needs,
    },
    Texture {
        source: Box<TextureSource>,
    },
    Hfield {
        source: HfieldSource,
    },
    Skin {
        source: SkinSource,
    },
}

/// What of a mesh is used.
#[derive(Clone, Copy)]
struct Needs {
    hull: bool,
    /// For signed distances.
    octree: bool,
    texcoord: bool,
}

/// Weight of a job that samples a field.
const FIELD_WEIGHT: usize = 1 << 22;

enum Outcome {
    Mesh(Box<CompiledMesh>),
    Texture(CompiledTexture),
    Hfield(CompiledHfield),
    Skin(CompiledSkin),
}

/// What an asset is called and where it comes from.
struct Head {
    name: String,
    loc: Loc,
    path: String,
    material: String,
}

impl Head {
    fn with<T>(self, compiled: T) -> Asset<T> {
        let Head { name, loc, path, material } = self;
        Asset { name, loc, path, material, compiled }
    }
}

/// Reads and compiles all assets.
pub(super) fn compile(spec: &Spec, resources: Resources<'_>, plugins: &Plugins, log: &mut Log) -> Assets {
    let Resources { files, meshes, .. } = resources;
    let jobs = read_all(spec, files, plugins, log);
    let mut outcomes = if log.diagnostics.has_errors() {
        Vec::new()
    } else {
        run_all(&jobs, meshes, spec.compiler.usethread)
    }
    .into_iter();
    let mut assets = Assets::default();
    for (head, job) in jobs {
        let outcome = outcomes.next().and_then(|outcome| match outcome {
            Ok(outcome) => Some(outcome),
            Err(error) => {
                log.error(head.loc, error.message);
                None
            }
        });
        check_name(&head.name, head.loc, &job, log);
        match job {
            Job::Mesh { .. } => {
                let mesh =
                    if let Some(Outcome::Mesh(mesh)) = outcome { *mesh } else { CompiledMesh::default() };
                assets.mesh_ids.entry(head.name.clone()).or_insert(assets.meshes.len());
                assets.meshes.push(head.with(mesh));
            }
            Job::Texture { .. } => {
                let texture =
                    if let Some(Outcome::Texture(t)) = outcome { t } else { CompiledTexture::default() };
                assets.textures.push(head.with(texture));
            }
            Job::Hfield { .. } => {
                let hfield =
                    if let Some(Outcome::Hfield(h)) = outcome { h } else { CompiledHfield::default() };
                assets.hfield_ids.entry(head.name.clone()).or_insert(assets.hfields.len());
                assets.hfields.push(head.with(hfield));
            }
            Job::Skin { .. } => {
                let skin = if let Some(Outcome::Skin(s)) = outcome { s } else { CompiledSkin::default() };
                assets.skins.push(head.with(skin));
            }
        }
    }
    if !spec.compiler.discardvisual {
        for material in &spec.materials {
            if material.name.is_empty() {
                log.error(material.loc, "material without a name");
            }
            let (name, loc) = (material.name.clone(), material.loc);
            assets.materials.push(Head { name, loc, path: String::new(), material: String::new() }.with(()));
        }
    }
    assets
}

/// Reads the files of all assets, which wait to be compiled.
fn read_all<'s>(
    spec: &'s Spec,
    files: &dyn FileProvider,
    plugins: &Plugins,
    log: &mut Log,
) -> Vec<(Head, Job<'s>)> {
    let colliding = colliding_meshes(spec);
    let measured = measured_meshes(spec);
    let discard = spec.compiler.discardvisual;
    let textures: &[Texture] = if discard { &[] } else { &spec.textures };
    let mut jobs = Vec::new();
    for mesh in &spec.meshes {
        let name = asset_name(&mesh.name, &mesh.path);
        let bytes = read(files, (Content::Mesh, &mesh.file), mesh.loc, &title("mesh", &name), log);
        let hull = mesh.inertia == MeshInertia::Convex || colliding.contains(&*name);
        let octree = measured.contains(&*name) && mesh.plugin.is_none();
        let field = surface_field(mesh, &name, plugins, log);
        let needs = Needs { hull, octree, texcoord: !discard };
        let job = Job::Mesh { spec: mesh, name: name.clone(), bytes, field, needs };
        let (path, material) = (mesh.path.clone(), mesh.material.clone());
        jobs.push((Head { name, loc: mesh.loc, path, material }, job));
    }
    for texture in textures {
        let name = asset_name(&texture.name, &texture.path);
        let job = Job::Texture { source: Box::new(texture_source(texture, &name, files, log)) };
        let (path, material) = (texture.path.clone(), String::new());
        jobs.push((Head { name, loc: texture.loc, path, material }, job));
    }
    for hfield in &spec.hfields {
        let name = asset_name(&hfield.name, &hfield.path);
        let bytes = read(files, (Content::Hfield, &hfield.file), hfield.loc, &title("hfield", &name), log);
        let job = Job::Hfield { source: hfield_source(hfield, &name, bytes) };
        let (path, material) = (hfield.path.clone(), String::new());
        jobs.push((Head { name, loc: hfield.loc, path, material }, job));
    }
    for skin in &spec.skins {
        let name = asset_name(&skin.name, &skin.path);
        let bytes = read(files, (Content::Skin, &skin.file), skin.loc, &title("skin", &name), log);
        let job = Job::Skin { source: skin_source(skin, &name, bytes) };
        let (path, material) = (skin.path.clone(), skin.material.clone());
        jobs.push((Head { name, loc: skin.loc, path, material }, job));
    }
    jobs
}

fn check_name(name: &str, loc: Loc, job: &Job, log: &mut Log) {
    let skybox = matches!(job, Job::Texture { source } if source.kind == TextureType::Skybox);
    if name.is_empty() && !skybox {
        let kind = match job {
            Job::Skin { .. } => return,
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
        let geoms = body.geoms.iter().filter(|g| matches!(g.kind, GeomType::Mesh | GeomType::Sdf));
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

/// Meshes of signed distance geoms.
fn measured_meshes(spec: &Spec) -> BTreeSet<&str> {
    let mut names = BTreeSet::new();
    let mut pending: Vec<&Body> = vec![&spec.world];
    while let Some(body) = pending.pop() {
        names.extend(body.geoms.iter().filter(|g| g.kind == GeomType::Sdf).map(|g| &*g.meshname));
        pending.extend(&body.bodies);
    }
    names
}

/// The field whose surface a mesh is.
fn surface_field(mesh: &Mesh, name: &str, plugins: &Plugins, log: &mut Log) -> Option<Box<dyn Field>> {
    let used = mesh.plugin.as_ref()?;
    let what = title("mesh", name);
    let id = usize::try_from(plugins.id(Some(used), (Capability::Sdf, &what), log)).ok()?;
    if !mesh.file.is_empty() || !mesh.uservert.is_empty() || mesh.builtin.is_some() {
        log.error(mesh.loc, format!("{what}: it has vertices already: remove its <plugin>"));
        return None;
    }
    if mesh.scale != [1.0; 3] {
        log.error(mesh.loc, format!("{what}: attribute 'scale' does not apply to the surface of a plugin"));
        return None;
    }
    let (kind, config) = plugins.list[id].config();
    let field = log.check(used.loc, &what, kind.field(&config).map_err(|error| error.to_string()))?;
    if field.is_none() {
        log.error(used.loc, format!("{what}: plugin '{}' has no field", kind.name()));
    }
    field
}

/// The bytes of the file of an asset, charged with what they take when decoded.
fn read(
    files: &dyn FileProvider,
    (content, file): (Content, &str),
    loc: Loc,
    what: &str,
    log: &mut Log,
) -> Option<Arc<[u8]>> {
    if file.is_empty() {
        return None;
    }
    let bytes = files.read(file).map_err(|error| format!("cannot read '{file}': {error}"));
    let bytes = log.check(loc, what, bytes)?;
    log.charge(loc, what, decoded(content, &bytes)).then_some(bytes)
}

fn texture_source(spec: &Texture, name: &str, files: &dyn FileProvider, log: &mut Log) -> TextureSource {
    let what = title("texture", name);
    let mut image = |file: &String| {
        let bytes = read(files, (Content::Texture, file), spec.loc, &what, log)?;
        Some(FileImage { bytes: bytes.to_vec(), path: file.clone() })
    };
    TextureSource {
        name: name.to_owned(),
        kind: spec.kind,
        colorspace: spec.colorspace,
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

fn skin_source(spec: &Skin, name: &str, bytes: Option<Arc<[u8]>>) -> SkinSource {
    SkinSource {
        name: name.to_owned(),
        file: bytes.map(|b| (b.to_vec(), spec.file.clone())),
        inline: RawSkin {
            vert: spec.vert.clone(),
            texcoord: spec.texcoord.clone(),
            face: spec.face.clone(),
            bones: spec.bones.clone(),
        },
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
            Job::Mesh { field: Some(_), .. } => FIELD_WEIGHT,
            Job::Mesh { spec, bytes, .. } => bytes.as_ref().map_or(spec.uservert.len(), |b| b.len()),
            Job::Texture { source } => {
                source.file.iter().chain(source.cubefiles.iter().flatten()).map(|f| 8 * f.bytes.len()).sum()
            }
            Job::Hfield { source } => source.elevation.len(),
            Job::Skin { source } => source.inline.vert.len(),
        }
    }

    fn run(&self, meshes: Option<&dyn MeshStore>) -> Result<Outcome, AssetError> {
        match self {
            Job::Mesh { spec, name, bytes, field, needs } => {
                let inline = match field {
                    Some(field) => mesh::surface(&**field)?,
                    None => inline_mesh(spec, !needs.texcoord)?,
                };
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
                    needhull: needs.hull,
                    octree: needs.octree.then_some(spec.octree_maxdepth),
                    keep_frame: field.is_some(),
                };
                let process = |source, file| mesh::process(MeshSource { name: name.clone(), file, ..source });
                let Some(bytes) = bytes else {
                    return process(source, None).map(|mesh| Outcome::Mesh(Box::new(mesh)));
                };
                // All but the content that enters; names and paths stand in messages only.
                let extension = spec.file.rsplit('.').next();
                let key = meshes.map(|meshes| {
                    let attributes = format!("{extension:?} {:?} {source:?}", spec.content_type);
                    (meshes, digest_parts([bytes, attributes.as_bytes()]))
                });
                if let Some(mesh) = key.and_then(|(meshes, digest)| meshes.find(digest)) {
                    return Ok(Outcome::Mesh(Box::new(mesh)));
                }
                let mesh = process(source, Some(mesh::decode(bytes, &spec.file, &spec.content_type)?))?;
                key.iter().for_each(|(meshes, digest)| meshes.keep(*digest, &mesh));
                Ok(Outcome::Mesh(Box::new(mesh)))
            }
            Job::Texture { source } => image::texture(source).map(Outcome::Texture),
            Job::Hfield { source } => image::hfield(source.clone()).map(Outcome::Hfield),
            Job::Skin { source } => mesh::skin(source.clone()).map(Outcome::Skin),
        }
    }
}

/// Runs the jobs, results in their order whatever the number of threads.
fn run_all(
    jobs: &[(Head, Job)],
    meshes: Option<&dyn MeshStore>,
    threads: bool,
) -> Vec<Result<Outcome, AssetError>> {
    let cores = std::thread::available_parallelism().map_or(1, |n| n.get()).min(jobs.len());
    if !threads || cores < 2 {
        return jobs.iter().map(|(_, job)| job.run(meshes)).collect();
    }
    // Largest first, so that no core is left with a long job at the end.
    let mut order: Vec<usize> = (0..jobs.len()).collect();
    order.sort_by_key(|&index| std::cmp::Reverse(jobs[index].1.weight()));
    let next = AtomicUsize::new(0);
    let worker = || {
        let mut done = Vec::new();
        loop {
            let Some(&index) = order.get(next.fetch_add(1, Ordering::Relaxed)) else { return done };
            done.push((index, jobs[index].1.run(meshes)));
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
