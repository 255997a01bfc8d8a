//! `visual` and `collision`: geoms, and the meshes that they show.

use physics::model::GeomType;

use super::super::reader::Reader;
use super::Robot;
use crate::files::{base_name, join};
use crate::spec::{Body, Geom, Mesh, asset_name};
use crate::xml::{Attribute, Element};

/// What stands before the path of a mesh inside a package of ROS, or inside a model of Gazebo.
const SCHEMES: [&str; 3] = ["package://", "model://", "file://"];

impl Reader<'_> {
    /// Adds the geoms of a link in the order of the text. The colour of a visual holds for the geoms after it, too.
    pub(super) fn shapes(&mut self, link: &Element, body: &mut Body, robot: &mut Robot) {
        let mut rgba: Option<[f32; 4]> = None;
        for element in &link.children {
            let collides = match element.name.as_str() {
                "collision" => true,
                "visual" => {
                    rgba = self.material_color(element, robot).or(rgba);
                    if self.spec.compiler.discardvisual {
                        continue;
                    }
                    false
                }
                _ => continue,
            };
            let Some(mut geom) = self.shape(element, collides) else { continue };
            geom.rgba = rgba.filter(|rgba| rgba[0] >= 0.0).unwrap_or(geom.rgba);
            if let Some(name) = element.attribute("name").filter(|name| !name.value.is_empty()) {
                if robot.geoms.insert(name.value.clone()) {
                    geom.name.clone_from(&name.value);
                } else {
                    self.warning(
                        name.value_loc,
                        format!("a second geom '{}' goes without a name", name.value),
                    );
                }
            }
            body.geoms.push(geom);
        }
    }

    fn material_color(&mut self, visual: &Element, robot: &Robot) -> Option<[f32; 4]> {
        let material = self.only(visual, "material")?;
        if let Some(color) = self.only(material, "color") {
            return self.color(color);
        }
        let name = self.text(material, "name")?;
        robot.materials.get(name).copied()
    }

    /// The four numbers of a `color`.
    pub(super) fn color(&mut self, color: &Element) -> Option<[f32; 4]> {
        if self.text(color, "rgba").is_some_and(|text| text.trim().is_empty()) {
            self.error(color.loc, "<color> needs the attribute 'rgba'");
        }
        let attribute = color.attribute("rgba")?;
        self.between::<f32>(color, attribute, 4, 4)?.first_chunk().copied()
    }

    /// The geom that a `visual` or `collision` describes. Of several shapes the first in this order counts.
    fn shape(&mut self, element: &Element, collides: bool) -> Option<Geom> {
        let geometry = self.needed(element, "geometry")?;
        let mut geom = Geom { loc: element.loc, ..Geom::default() };
        if !collides {
            (geom.contype, geom.conaffinity, geom.group, geom.density) = (0, 0, 1, 0.0);
        }
        if let Some(shape) = self.only(geometry, "box") {
            geom.kind = GeomType::Box;
            geom.size = self.exactly_given::<3>(shape, "size")?.map(|length| length / 2.0);
        } else if let Some(shape) = self.only(geometry, "cylinder") {
            geom.kind = GeomType::Cylinder;
            self.round(shape, &mut geom)?;
        } else if let Some(shape) = self.only(geometry, "sphere") {
            geom.kind = GeomType::Sphere;
            [geom.size[0]] = self.exactly_given(shape, "radius")?;
        } else if let Some(shape) = self.only(geometry, "capsule") {
            geom.kind = GeomType::Capsule;
            self.round(shape, &mut geom)?;
        } else if let Some(shape) = self.only(geometry, "mesh") {
            geom.kind = GeomType::Mesh;
            geom.meshname = self.mesh_of(shape)?;
        } else {
            self.error(
                geometry.loc,
                "<geometry> needs one of <box>, <cylinder>, <sphere>, <capsule>, <mesh>",
            );
            return None;
        }
        (geom.pos, geom.quat) = self.origin(element);
        Some(geom)
    }

    fn round(&mut self, shape: &Element, geom: &mut Geom) -> Option<()> {
        let (radius, length) =
            (self.exactly_given::<1>(shape, "radius"), self.exactly_given::<1>(shape, "length"));
        (geom.size[0], geom.size[1]) = (radius?[0], length?[0] / 2.0);
        Some(())
    }

    /// The name of the mesh that `shape` shows. One file at several scales is several meshes, numbered from
    /// the second on; as in the reference, only the first can be used again.
    fn mesh_of(&mut self, shape: &Element) -> Option<String> {
        self.text(shape, "filename")?;
        let attribute = shape.attribute("filename")?;
        let scale = self.exact(shape, "scale").unwrap_or([1.0; 3]);
        let stem = asset_name("", &attribute.value);
        let (file, path) = self.mesh_file(attribute);
        let same: Vec<&Mesh> =
            self.spec.meshes.iter().filter(|mesh| asset_name("", &mesh.path) == stem).collect();
        if let Some(known) = same.iter().position(|mesh| mesh.scale == scale) {
            if known > 0 {
                let message = "MuJoCo shows a mesh that is used again at the scale of its first use: give it a file of its own";
                self.warning(attribute.value_loc, message);
            }
            return Some(stem);
        }
        let name = if same.is_empty() { stem } else { format!("{stem}{}", same.len()) };
        let mesh = Mesh { name: name.clone(), loc: shape.loc, file, path, scale, ..Mesh::default() };
        self.spec.meshes.push(mesh);
        Some(name)
    }

    /// What to open for a mesh, and the path that the model records. Where nothing has the name as it stands, a path inside
    /// a package is looked up below the folders around the file, and below the one with the package's name.
    fn mesh_file(&self, attribute: &Attribute) -> (String, String) {
        let meshdir = &self.spec.compiler.meshdir;
        let as_named = self.asset_file(attribute, meshdir);
        let inside = SCHEMES.iter().find_map(|scheme| attribute.value.strip_prefix(scheme));
        let Some(inside) = inside.filter(|_| !self.spec.compiler.strippath) else { return as_named };
        let (package, rest) = inside.split_once('/').unwrap_or((inside, ""));
        let mut folder = self.model_dir.trim_end_matches('/');
        let mut candidates = vec![join(&self.model_dir, &join(meshdir, inside))];
        loop {
            if base_name(folder) == package {
                candidates.push(join(folder, rest));
            }
            candidates.push(join(folder, inside));
            match folder.rsplit_once('/') {
                Some((above, _)) => folder = above,
                None => break,
            }
        }
        let found = candidates.into_iter().find(|path| self.expansion.files.exists(path));
        found.map_or(as_named, |file| (file.clone(), file))
    }
}
