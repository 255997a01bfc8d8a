//! Surfaces and textures of a model.

use super::flat::{self, PlaneShape};
use super::flex::{self, Wires};
use super::hfield::{self, Relief};
use super::mesh::{self, MeshRows};
use super::part::Part;
use super::round::{self, Side};
use super::skin;
use super::source::Source;
use super::surface::Surface;
use crate::error::RenderError;
use crate::profile::Profile;
use crate::scene::SceneOptions;
use crate::texture::Texture;
use physics::model::{GeomType, ObjType, TextureRole, VisualQuality};
use physics::{Data, Model};
use std::ops::Range;
use std::sync::Arc;

/// Surfaces that every model has, by their place in [`Assets::surfaces`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Builtin {
    Sphere,
    CapTop,
    CapBottom,
    Cylinder,
    Tube,
    Cuboid,
    Cone,
    Triangle,
}

const BUILTINS: usize = Builtin::Triangle as usize + 1;

/// Most slices, stacks or squares along a side of a shape (`visual/quality`).
const MAX_QUALITY: i32 = 1024;

/// Triangles and textures of a model, prepared once and shared by every picture of it. Clones share their memory.
#[derive(Clone, Debug, Default)]
pub struct Assets {
    /// Surfaces of the model and of the round shapes.
    pub surfaces: Vec<Arc<Surface>>,
    /// Textures of the model, in its order.
    pub textures: Vec<Arc<Texture>>,
    materials: Vec<Material>,
    /// Surface of every geom that is a plane.
    planes: Vec<Option<usize>>,
    /// What the grids of planes were made of, in the order of their surfaces.
    plane_shapes: Vec<PlaneShape>,
    first_hfield: usize,
    first_mesh: usize,
    first_hull: usize,
    first_skin: usize,
    first_flex: usize,
    /// Vertices and edges that are drawn of each flex.
    wires: Vec<Wires>,
    quality: [usize; 3],
    profile: Profile,
    source: Source,
}

/// How a material textures what it is put on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Material {
    /// Texture of the model.
    pub texture: Option<usize>,
    /// The texture repeats per metre instead of per object.
    pub uniform: bool,
    /// Repetitions of the texture.
    pub repeat: [f32; 2],
}

impl Assets {
    /// Prepares the triangles and textures of a model.
    ///
    /// # Errors
    /// [`RenderError::Model`] names the mesh, height field, texture or material whose rows are out of range, or the
    /// quality setting that is too low or too high.
    pub fn new(model: &Model, profile: Profile) -> Result<Assets, RenderError> {
        let quality @ [slices, stacks, quads] = quality(&model.vis.quality)?;
        let mut surfaces = builtins(slices, stacks, quads);
        let plane_shapes: Vec<PlaneShape> = plane_geoms(model).map(|geom| plane_shape(model, geom)).collect();
        let mut planes = vec![None; model.geom_type.len()];
        for (geom, surface) in plane_geoms(model).zip(BUILTINS..) {
            planes[geom] = Some(surface);
        }
        surfaces.extend(plane_shapes.iter().map(|&shape| flat::plane(shape)));
        let first_hfield = surfaces.len();
        for id in 0..model.hfield_nrow.len() {
            surfaces.push(hfield_of(model, id, quads)?);
        }
        let first_mesh = surfaces.len();
        for id in 0..model.mesh_vertadr.len() {
            surfaces.push(mesh_of(model, id)?);
        }
        let first_hull = surfaces.len();
        for id in 0..model.mesh_graphadr.len() {
            surfaces.push(hull_of(model, id)?);
        }
        let first_skin = surfaces.len();
        surfaces.extend((0..model.skin_vertadr.len()).map(|id| skin::unposed(model, id)));
        let first_flex = surfaces.len();
        let flexes = model.flex_vertadr.len();
        surfaces.resize_with(first_flex + flexes, Surface::default);
        let textures = (0..model.tex_type.len()).map(|id| Ok(Arc::new(Texture::new(model, id, profile)?)));
        Ok(Assets {
            surfaces: surfaces.into_iter().map(Arc::new).collect(),
            textures: textures.collect::<Result<_, RenderError>>()?,
            materials: materials(model)?,
            planes,
            plane_shapes,
            first_hfield,
            first_mesh,
            first_hull,
            first_skin,
            first_flex,
            wires: vec![Wires::default(); flexes],
            quality,
            profile,
            source: Source::of(model),
        })
    }

    /// Follows an edit of the model, or another model: only what changed is prepared again. Costs a comparison of
    /// addresses where nothing did.
    ///
    /// # Errors
    /// As [`Assets::new`]; nothing changes then.
    pub fn refresh(&mut self, model: &Model) -> Result<(), RenderError> {
        let same_quality = quality(&model.vis.quality)? == self.quality;
        let same_far = self.plane_shapes.first().is_none_or(|shape| shape.far == far(model));
        if same_quality && same_far && self.source.is_current(model) {
            return Ok(());
        }
        if !same_quality || self.source.layout_moved(model) || !self.has_planes_of(model) {
            *self = Assets::new(model, self.profile)?;
            return Ok(());
        }
        let mut next = self.clone();
        if self.source.planes_moved(model) || !same_far {
            next.refresh_planes(model);
        }
        if self.source.hfields_moved(model) {
            next.refresh_hfields(model)?;
        }
        if self.source.pixels_moved(model) {
            next.refresh_textures(model)?;
        }
        if self.source.planes_moved(model) || self.source.materials_moved(model) {
            next.materials = materials(model)?;
        }
        next.source = Source::of(model);
        *self = next;
        Ok(())
    }

    /// Poses skins and flexes as in a state that has been evaluated; `options` say what is drawn of flexes, as in the scene.
    /// Costs nothing without skins and flexes.
    ///
    /// # Errors
    /// [`RenderError::NotFinite`] names a skin or flex that is nowhere.
    pub fn pose(&mut self, model: &Model, data: &Data, options: &SceneOptions) -> Result<(), RenderError> {
        let (skins, flexes) =
            self.surfaces[self.first_skin..].split_at_mut(self.first_flex - self.first_skin);
        for (skin, surface) in skins.iter_mut().enumerate() {
            if let Some(posed) = skin::posed(model, data, skin, surface)? {
                *surface = Arc::new(posed);
            }
        }
        for (flex, (surface, wires)) in flexes.iter_mut().zip(&mut self.wires).enumerate() {
            let (posed, drawn) = flex::posed(model, data, (flex, options), surface)?;
            *wires = drawn;
            if let Some(posed) = posed {
                *surface = Arc::new(posed);
            }
        }
        Ok(())
    }

    /// Bytes that triangles and textures take.
    pub fn bytes(&self) -> usize {
        self.surfaces.iter().map(|s| s.bytes()).sum::<usize>()
            + self.textures.iter().map(|t| t.bytes()).sum::<usize>()
    }

    /// The version of MuJoCo that is followed.
    pub fn profile(&self) -> Profile {
        self.profile
    }

    pub(super) fn material(&self, id: usize) -> Option<&Material> {
        self.materials.get(id)
    }

    pub(super) fn plane_surface(&self, geom: usize) -> Option<usize> {
        self.planes.get(geom).copied().flatten()
    }

    pub(super) fn hfield_surface(&self, hfield: usize) -> Option<usize> {
        self.first_hfield.checked_add(hfield).filter(|&surface| surface < self.first_mesh)
    }

    pub(super) fn mesh_surface(&self, mesh: usize) -> Option<usize> {
        self.first_mesh.checked_add(mesh).filter(|&surface| surface < self.first_hull)
    }

    /// The convex hull of a mesh; one without a hull has no triangles.
    pub(super) fn hull_surface(&self, mesh: usize) -> Option<usize> {
        self.first_hull.checked_add(mesh).filter(|&surface| surface < self.first_skin)
    }

    pub(super) fn skin_surface(&self, skin: usize) -> Option<usize> {
        self.first_skin.checked_add(skin).filter(|&surface| surface < self.first_flex)
    }

    pub(super) fn flex_surface(&self, flex: usize) -> Option<usize> {
        self.first_flex.checked_add(flex).filter(|&surface| surface < self.surfaces.len())
    }

    /// Appends the balls and tubes of a flex, for an item at `origin`.
    pub(super) fn wire_parts(&self, flex: usize, origin: [f32; 3], out: &mut Vec<Part>) {
        let surfaces = [Builtin::Sphere as usize, Builtin::Tube as usize];
        self.wires.get(flex).into_iter().for_each(|wires| wires.parts(surfaces, origin, out));
    }

    /// Whether the model has the same planes as when it was prepared.
    fn has_planes_of(&self, model: &Model) -> bool {
        let known = (0..self.planes.len()).filter(|&geom| self.planes[geom].is_some());
        self.planes.len() == model.geom_type.len() && plane_geoms(model).eq(known)
    }

    fn refresh_planes(&mut self, model: &Model) {
        for (i, geom) in plane_geoms(model).enumerate() {
            let shape = plane_shape(model, geom);
            if shape != self.plane_shapes[i] {
                self.plane_shapes[i] = shape;
                self.surfaces[BUILTINS + i] = Arc::new(flat::plane(shape));
            }
        }
    }

    fn refresh_hfields(&mut self, model: &Model) -> Result<(), RenderError> {
        for id in 0..model.hfield_nrow.len() {
            let range = hfield_range(model, id)?;
            let moved = model.hfield_size[id] != self.source.hfield_size[id]
                || model.hfield_data[range.clone()] != self.source.hfield_data[range];
            if moved {
                self.surfaces[self.first_hfield + id] = Arc::new(hfield_of(model, id, self.quality[2])?);
            }
        }
        Ok(())
    }

    fn refresh_textures(&mut self, model: &Model) -> Result<(), RenderError> {
        for id in 0..self.textures.len() {
            let range = Texture::bytes_in(model, id)?;
            if model.tex_data.get(range.clone()) != self.source.tex_data.get(range) {
                self.textures[id] = Arc::new(Texture::new(model, id, self.profile)?);
            }
        }
        Ok(())
    }
}

/// Slices, stacks and squares along a side.
fn quality(quality: &VisualQuality) -> Result<[usize; 3], RenderError> {
    let checked = |name: &str, value: i32, least: i32| match (least..=MAX_QUALITY).contains(&value) {
        true => Ok(value as usize),
        false => Err(RenderError::Model {
            message: format!("visual/quality {name} is {value}; give {least} to {MAX_QUALITY}"),
        }),
    };
    Ok([
        checked("numslices", quality.numslices, 3)?,
        checked("numstacks", quality.numstacks, 2)?,
        checked("numquads", quality.numquads, 1)?,
    ])
}

/// The surfaces that every model has, in the order of [`Builtin`].
fn builtins(slices: usize, stacks: usize, quads: usize) -> Vec<Surface> {
    vec![
        round::sphere(slices, stacks),
        round::cap(Side::Top, slices, stacks / 2),
        round::cap(Side::Bottom, slices, stacks / 2),
        round::cylinder(slices, stacks),
        round::tube(slices, stacks),
        flat::cuboid(quads),
        round::cone(slices, stacks),
        flat::triangle(),
    ]
}

fn plane_geoms(model: &Model) -> impl Iterator<Item = usize> + '_ {
    (0..model.geom_type.len()).filter(|&geom| model.geom_type[geom] == GeomType::Plane as i32)
}

/// Distance of the far plane.
fn far(model: &Model) -> f64 {
    f64::from(model.vis.map.zfar) * model.stat.extent
}

fn plane_shape(model: &Model, geom: usize) -> PlaneShape {
    let material = usize::try_from(model.geom_matid[geom]).ok();
    let texrepeat = material.and_then(|id| model.mat_texrepeat.get(id)).copied().unwrap_or_default();
    PlaneShape { size: model.geom_size[geom], texrepeat, far: far(model) }
}

/// `first..first + count`, if these are rows of an array of `length`.
fn rows(first: i32, count: i32, length: usize) -> Option<Range<usize>> {
    let first = usize::try_from(first).ok()?;
    let end = first.checked_add(usize::try_from(count).ok()?)?;
    (end <= length).then_some(first..end)
}

fn hfield_range(model: &Model, id: usize) -> Result<Range<usize>, RenderError> {
    let [rows_y, columns] = [model.hfield_nrow[id], model.hfield_ncol[id]];
    let count = rows_y.checked_mul(columns).filter(|_| rows_y >= 2 && columns >= 2);
    let range = count.and_then(|count| rows(model.hfield_adr[id], count, model.hfield_data.len()));
    range.ok_or_else(|| RenderError::Model {
        message: format!(
            "{} has {rows_y} x {columns} elevations from {} on, of {} in the model; it needs at least 2 x 2",
            model.label_of(ObjType::Hfield, id),
            model.hfield_adr[id],
            model.hfield_data.len()
        ),
    })
}

fn hfield_of(model: &Model, id: usize, quads: usize) -> Result<Surface, RenderError> {
    let data = &model.hfield_data[hfield_range(model, id)?];
    let size = model.hfield_size[id].map(|x| x as f32);
    let [rows, columns] = [model.hfield_nrow[id] as usize, model.hfield_ncol[id] as usize];
    if let Some(place) = data.iter().position(|x| !x.is_finite()) {
        let label = model.label_of(ObjType::Hfield, id);
        let message = format!("elevation {place} of {label} is {}, not a finite number", data[place]);
        return Err(RenderError::Model { message });
    }
    Ok(hfield::hfield(&Relief { size, rows, columns, data, quads }))
}

fn mesh_of(model: &Model, id: usize) -> Result<Surface, RenderError> {
    let fail =
        |what: &str| RenderError::Model { message: format!("{}: {what}", model.label_of(ObjType::Mesh, id)) };
    let range = |what: &str, first: i32, count: i32, length: usize| {
        rows(first, count, length)
            .ok_or_else(|| fail(&format!("{count} {what} from {first} on, of {length} in the model")))
    };
    let m = model;
    let vertices = range("vertices", m.mesh_vertadr[id], m.mesh_vertnum[id], m.mesh_vert.len())?;
    let normals = range("normals", m.mesh_normaladr[id], m.mesh_normalnum[id], m.mesh_normal.len())?;
    let least = m.mesh_face.len().min(m.mesh_facenormal.len()).min(m.mesh_facetexcoord.len());
    let faces = range("triangles", m.mesh_faceadr[id], m.mesh_facenum[id], least)?;
    let texcoords = match m.mesh_texcoordadr[id] {
        ..0 => 0..0,
        first => range("texture coordinates", first, m.mesh_texcoordnum[id], m.mesh_texcoord.len())?,
    };
    if let Some(vertex) = m.mesh_vert[vertices.clone()].iter().position(|p| !p.iter().all(|x| x.is_finite()))
    {
        return Err(fail(&format!("vertex {vertex} is not finite")));
    }
    let rows = MeshRows {
        vertices: &m.mesh_vert[vertices],
        normals: &m.mesh_normal[normals],
        texcoords: &m.mesh_texcoord[texcoords],
        faces: &m.mesh_face[faces.clone()],
        face_normals: &m.mesh_facenormal[faces.clone()],
        face_texcoords: &m.mesh_facetexcoord[faces],
    };
    mesh::mesh(rows).map_err(|face| {
        fail(&format!(
            "triangle {face} has a vertex, normal or texture coordinate that the mesh does not have"
        ))
    })
}

fn hull_of(model: &Model, id: usize) -> Result<Surface, RenderError> {
    let Ok(start) = usize::try_from(model.mesh_graphadr[id]) else { return Ok(Surface::default()) };
    let surface = (|| {
        let first = usize::try_from(model.mesh_vertadr[id]).ok()?;
        let count = usize::try_from(model.mesh_vertnum[id]).ok()?;
        let vertices = model.mesh_vert.get(first..first.checked_add(count)?)?;
        mesh::hull(model.mesh_graph.get(start..)?, vertices)
    })();
    surface.ok_or_else(|| RenderError::Model {
        message: format!(
            "{}: its convex hull, from row {start} of mesh_graph on, has numbers out of range",
            model.label_of(ObjType::Mesh, id)
        ),
    })
}

fn materials(model: &Model) -> Result<Vec<Material>, RenderError> {
    let material = |id: usize| {
        let given = model.mat_texid[id][TextureRole::Rgb as usize];
        let texture = usize::try_from(given).ok();
        if texture.is_some_and(|texture| texture >= model.tex_type.len()) {
            let label = model.label_of(ObjType::Material, id);
            let message = format!("{label} has texture {given}, but the model has {}", model.tex_type.len());
            return Err(RenderError::Model { message });
        }
        Ok(Material { texture, uniform: model.mat_texuniform[id], repeat: model.mat_texrepeat[id] })
    };
    (0..model.mat_texid.len()).map(material).collect()
}
