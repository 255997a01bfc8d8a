//! `asset`, and where the files of assets are.

use super::reader::Reader;
use crate::files::{is_absolute, join};
use crate::image::Builtin;
use crate::mesh::vertex_count;
use crate::schema::asset::{
    BONE_ROWS, HFIELD_ROWS, MATERIAL_ROWS, MESH_ROWS, ROLES, SIDES, SKIN_ROWS, TEXTURE_ROWS,
};
use crate::spec::{Bone, Hfield, Material, Mesh, Skin, Texture};
use crate::xml::{Attribute, Element};
use physics::model::TextureType;

/// Groups of skins.
const GROUPS: i32 = 6;

impl Reader<'_> {
    pub(super) fn asset(&mut self, section: &Element) {
        for element in &section.children {
            match element.name.as_str() {
                "mesh" => self.mesh(element),
                "hfield" => self.hfield(element),
                "texture" => self.texture(element),
                "material" => self.material(element),
                "skin" => self.skin(element),
                "model" => self.model_file(element),
                // Refused by the structural check.
                _ => {}
            }
        }
    }

    /// What to open for an asset, and the path that the model records.
    ///
    /// A relative name is looked up from the main file through `dir`; when nothing is there, it is taken from the
    /// directory of the file that holds the element, without `dir`. `strippath` keeps the last component and
    /// seeks from the main file only.
    pub(super) fn asset_file(&self, attribute: &Attribute, dir: &str) -> (String, String) {
        let name = attribute.value.as_str();
        let (file, path) = self.spec.compiler.asset_file(&self.model_dir, dir, name);
        if name.is_empty()
            || self.spec.compiler.strippath
            || is_absolute(name)
            || self.expansion.files.exists(&file)
        {
            return (file, path);
        }
        let including = self.expansion.sources.get(attribute.loc.file);
        match including.filter(|s| s.included_at.is_some()) {
            Some(source) => {
                let path = join(&source.dir, name);
                (path.clone(), path)
            }
            None => (file, path),
        }
    }

    fn mesh(&mut self, element: &Element) {
        let class = self.class_of(element, "class", 0);
        let mut mesh = Mesh { loc: element.loc, ..self.spec.classes.of(class).mesh.clone() };
        self.rows(element, &MESH_ROWS, &mut mesh);
        mesh.plugin = self.child_plugin(element);
        if let Some(file) = element.attribute("file") {
            (mesh.file, mesh.path) = self.asset_file(file, &self.spec.compiler.meshdir);
        }
        if let Some(limit) =
            element.attribute("maxhullvert").filter(|_| mesh.maxhullvert != -1 && mesh.maxhullvert < 4)
        {
            self.error(limit.value_loc, "attribute 'maxhullvert' of <mesh> must be -1 or at least 4");
        }
        let vertices = mesh.builtin.map_or(0.0, |shape| vertex_count(shape, &mesh.params));
        // Vertices, normals, faces and their boxes, in the asset and in the model.
        self.charge(element.loc, "built-in mesh", (vertices * 1000.0) as usize);
        self.spec.meshes.push(mesh);
    }

    fn hfield(&mut self, element: &Element) {
        let mut hfield = Hfield { loc: element.loc, ..Hfield::default() };
        self.rows(element, &HFIELD_ROWS, &mut hfield);
        let given = std::mem::take(&mut hfield.userdata);
        if let Some(file) = element.attribute("file") {
            (hfield.file, hfield.path) = self.asset_file(file, &self.spec.compiler.meshdir);
        } else if hfield.nrow > 0 && hfield.ncol > 0 {
            let cells = i64::from(hfield.nrow) * i64::from(hfield.ncol);
            if given.is_empty() {
                // Numbers of four bytes, in the asset and in the model.
                let what = format!("height field of {} x {} points", hfield.nrow, hfield.ncol);
                self.charge(
                    element.loc,
                    &what,
                    usize::try_from(cells).map_or(usize::MAX, |n| n.saturating_mul(8)),
                );
            } else if given.len() as i64 != cells {
                self.error(element.loc, format!("<hfield> has {} heights for {cells} points", given.len()));
            } else {
                // The text runs from the far row to the near one, data from the near row on.
                hfield.userdata = given.chunks(hfield.ncol as usize).rev().flatten().copied().collect();
            }
        }
        self.spec.hfields.push(hfield);
    }

    pub(super) fn skin(&mut self, element: &Element) {
        let mut skin = Skin { loc: element.loc, ..Skin::default() };
        self.rows(element, &SKIN_ROWS, &mut skin);
        if let Some(file) = element.attribute("file") {
            (skin.file, skin.path) = self.asset_file(file, &self.spec.compiler.meshdir);
        }
        if let Some(group) = element.attribute("group").filter(|_| !(0..GROUPS).contains(&skin.group)) {
            self.error(group.value_loc, format!("attribute 'group' of <skin> must be 0 to {}", GROUPS - 1));
        }
        for element in element.children_named("bone") {
            let mut bone = Bone { loc: element.loc, ..Bone::default() };
            self.rows(element, &BONE_ROWS, &mut bone);
            skin.bones.push(bone);
        }
        self.spec.skins.push(skin);
    }

    fn texture(&mut self, element: &Element) {
        let mut texture = Texture { loc: element.loc, ..Texture::default() };
        self.rows(element, &TEXTURE_ROWS, &mut texture);
        let dir = self.spec.compiler.texturedir.clone();
        if let Some(file) = element.attribute("file") {
            (texture.file, texture.path) = self.asset_file(file, &dir);
        }
        for (side, attribute) in SIDES.iter().enumerate() {
            if let Some(file) = element.attribute(attribute) {
                (texture.cubefiles[side], texture.cubepaths[side]) = self.asset_file(file, &dir);
            }
        }
        if let Some(layout) = element.attribute("gridlayout") {
            let cells = i64::from(texture.gridsize[0]) * i64::from(texture.gridsize[1]);
            if layout.value.len() as i64 != cells || layout.value.len() > 12 {
                self.error(
                    layout.value_loc,
                    format!("attribute 'gridlayout' must have {cells} letters, at most 12"),
                );
            } else {
                texture.gridlayout = format!("{:.<12}", layout.value);
            }
        }
        if texture.builtin != Builtin::None {
            let (width, height) = (i64::from(texture.width), i64::from(texture.height));
            let height =
                if texture.kind == TextureType::Texture2d { height } else { width.saturating_mul(6) };
            let pixels = width.max(0).saturating_mul(height.max(0));
            let what = format!("built-in texture of {width} x {height} pixels");
            // Bytes of three colours, in the asset and in the model.
            self.charge(
                element.loc,
                &what,
                usize::try_from(pixels).map_or(usize::MAX, |n| n.saturating_mul(6)),
            );
        }
        self.spec.textures.push(texture);
    }

    fn material(&mut self, element: &Element) {
        let class = self.class_of(element, "class", 0);
        let mut material = Material { loc: element.loc, ..self.spec.classes.of(class).material.clone() };
        self.rows(element, &MATERIAL_ROWS, &mut material);
        self.layers(element, &mut material);
        self.spec.materials.push(material);
    }

    /// The textures of a material by role.
    pub(super) fn layers(&mut self, element: &Element, material: &mut Material) {
        for layer in element.children_named("layer") {
            if element.attribute("texture").is_some() {
                self.error(
                    layer.loc,
                    "<material> takes the attribute 'texture' or <layer> elements, not both",
                );
                return;
            }
            let role = layer.attribute("role").and_then(|role| self.keyword(layer, role, ROLES));
            if let Some(role) = role {
                material.textures[role as usize] = layer.value("texture").unwrap_or_default().to_string();
            }
        }
    }
}
