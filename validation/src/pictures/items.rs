//! The list of what is to be drawn beside the one that MuJoCo assembled.

use super::recording::Recording;
use physics::model::ObjType;
use render::scene::{Category, Item, Light, LightKind, Object, Shape};
use render::{Scene, View};

/// Largest difference of a number that counts as agreement, relative to the larger of 1 and the recorded one: some units of
/// the last place of single precision.
pub const TOLERANCE: f64 = 2e-6;

/// MuJoCo's codes of shapes (`mjtGeom`).
mod code {
    pub const PLANE: i32 = 0;
    pub const HFIELD: i32 = 1;
    pub const FLEX: i32 = 105;
    pub const SKIN: i32 = 106;
    pub const SPHERE: i32 = 2;
    pub const CAPSULE: i32 = 3;
    pub const ELLIPSOID: i32 = 4;
    pub const CYLINDER: i32 = 5;
    pub const BOX: i32 = 6;
    pub const MESH: i32 = 7;
    pub const SDF: i32 = 8;
    pub const ARROW: i32 = 100;
    pub const THIN_ARROW: i32 = 101;
    pub const DOUBLE_ARROW: i32 = 102;
    pub const LINE: i32 = 103;
    pub const LINE_BOX: i32 = 104;
    pub const LABEL: i32 = 107;
    pub const TRIANGLE: i32 = 108;
}
/// MuJoCo's codes of lights that light (`mjtLightType`).
const SPOT: f64 = 0.0;
const DIRECTIONAL: f64 = 1.0;
/// Lights of the recorded list that OpenGL has place for.
const PLACES: usize = 8;

/// How an assembled scene differs from the recorded one.
#[derive(Clone, Debug, Default)]
pub struct Differences {
    /// Items compared.
    pub items: usize,
    /// What differs that is no number, and numbers of items or lights.
    pub kinds: Vec<String>,
    /// The largest difference of each field that differs by more than [`TOLERANCE`], and where it is.
    pub numbers: Vec<(&'static str, f64, String)>,
}

impl Differences {
    /// Nothing differs.
    pub fn none(&self) -> bool {
        self.kinds.is_empty() && self.numbers.is_empty()
    }

    /// One line.
    pub fn summary(&self) -> String {
        if self.none() {
            return format!("{} equal", self.items);
        }
        let number = |(field, worst, place): &(&str, f64, String)| format!("{field} {worst:.0e} ({place})");
        let mut parts: Vec<String> = self.kinds.iter().take(3).cloned().collect();
        parts.extend(self.kinds.len().checked_sub(4).map(|more| format!("{} more", more + 1)));
        parts.extend(self.numbers.iter().map(number));
        parts.join("; ")
    }

    fn differs(&mut self, kind: String) {
        self.kinds.push(kind);
    }

    /// Compares numbers of a field.
    fn see(&mut self, field: &'static str, place: &str, recorded: &[f64], ours: &[f32]) {
        for (&recorded, &ours) in recorded.iter().zip(ours) {
            let difference = (f64::from(ours) - recorded).abs() / recorded.abs().max(1.0);
            if difference <= TOLERANCE {
                continue;
            }
            match self.numbers.iter_mut().find(|(name, ..)| *name == field) {
                Some((_, worst, _)) if *worst >= difference => {}
                Some(entry) => (entry.1, entry.2) = (difference, place.to_owned()),
                None => self.numbers.push((field, difference, place.to_owned())),
            }
        }
    }
}

/// Compares a scene with the recorded one: items in their order, lights, camera.
///
/// # Errors
/// The recording lacks an array.
pub fn compare(recording: &Recording, scene: &Scene) -> Result<Differences, String> {
    let mut differences = Differences::default();
    compare_items(recording, &scene.items, &mut differences)?;
    compare_lights(recording, &scene.lights, &mut differences)?;
    compare_view(recording, &scene.view, &mut differences)?;
    Ok(differences)
}

fn compare_items(recording: &Recording, ours: &[Item], out: &mut Differences) -> Result<(), String> {
    let whole = |name: &str| {
        Ok::<_, String>(recording.numbers(name)?.into_iter().map(|x| x as i32).collect::<Vec<_>>())
    };
    let (shapes, data, categories) = (whole("item/type")?, whole("item/dataid")?, whole("item/category")?);
    let (kinds, numbers, segments) = (whole("item/objtype")?, whole("item/objid")?, whole("item/segid")?);
    let materials = if recording.has("item/matid") { Some(whole("item/matid")?) } else { None };
    let (size, pos) = (recording.rows::<3>("item/size")?, recording.rows::<3>("item/pos")?);
    let (mat, rgba) = (recording.rows::<9>("item/mat")?, recording.rows::<4>("item/rgba")?);
    let [emission, specular] = [recording.numbers("item/emission")?, recording.numbers("item/specular")?];
    let [shininess, reflectance] =
        [recording.numbers("item/shininess")?, recording.numbers("item/reflectance")?];
    let rbound = recording.numbers("item/modelrbound")?;
    if ours.len() != shapes.len() {
        out.differs(format!("{} items, not {}", ours.len(), shapes.len()));
    }
    for (k, item) in ours.iter().take(shapes.len()).enumerate() {
        let place = name(kinds[k], numbers[k]);
        out.items += 1;
        if object(item.object) != [kinds[k], numbers[k]] {
            out.differs(format!("item {k} is {}, not {place}", name(item.object.kind, item.object.id)));
            // After one that is missing or too much everything would differ.
            break;
        }
        if !same_shape(item.shape, shapes[k], data[k]) {
            out.differs(format!("{place} is {:?}, not type {} with data {}", item.shape, shapes[k], data[k]));
        }
        if category(item.category) != categories[k] {
            out.differs(format!("{place} is {:?}, not {}", item.category, categories[k]));
        }
        if item.unlisted != (segments[k] < 0) {
            out.differs(format!("{place} has the segment {}", segments[k]));
        }
        if let Some(materials) = &materials
            && item.material != usize::try_from(materials[k]).ok()
        {
            out.differs(format!("{place} has the material {:?}, not {}", item.material, materials[k]));
        }
        out.see("size", &place, &size[k], &item.size);
        out.see("pos", &place, &pos[k], &item.pos);
        out.see("mat", &place, &mat[k], &item.mat);
        out.see("rgba", &place, &rgba[k], &item.rgba);
        out.see("emission", &place, &emission[k..=k], &[item.look.emission]);
        out.see("specular", &place, &specular[k..=k], &[item.look.specular]);
        out.see("shininess", &place, &shininess[k..=k], &[item.look.shininess]);
        // For other items MuJoCo computes it when it draws them.
        if kinds[k] == ObjType::Geom.code() {
            out.see("rbound", &place, &rbound[k..=k], &[item.rbound]);
        }
        out.see("reflectance", &place, &reflectance[k..=k], &[item.look.reflectance]);
    }
    Ok(())
}

/// Type and number of an object; MuJoCo has the code 0 for none.
fn object(object: Object) -> [i32; 2] {
    [object.kind.max(0), object.id]
}

fn name(kind: i32, id: i32) -> String {
    let kind = ObjType::from_code(kind).map_or_else(|| kind.to_string(), |kind| format!("{kind:?}"));
    format!("{} {id}", kind.to_lowercase())
}

fn same_shape(shape: Shape, recorded: i32, data: i32) -> bool {
    match shape {
        Shape::Plane { .. } => recorded == code::PLANE,
        Shape::Skin { .. } => recorded == code::SKIN,
        Shape::Flex { .. } => recorded == code::FLEX,
        Shape::Hfield { hfield } => recorded == code::HFIELD && data == hfield as i32,
        Shape::Sphere => matches!(recorded, code::SPHERE | code::ELLIPSOID),
        Shape::Capsule => recorded == code::CAPSULE,
        Shape::Cylinder => recorded == code::CYLINDER,
        Shape::Box => recorded == code::BOX,
        Shape::Mesh { mesh } => matches!(recorded, code::MESH | code::SDF) && data == 2 * mesh as i32,
        Shape::Hull { mesh } => matches!(recorded, code::MESH | code::SDF) && data == 2 * mesh as i32 + 1,
        Shape::Arrow => recorded == code::ARROW,
        Shape::ThinArrow => recorded == code::THIN_ARROW,
        Shape::DoubleArrow => recorded == code::DOUBLE_ARROW,
        Shape::Line => recorded == code::LINE,
        Shape::LineBox => recorded == code::LINE_BOX,
        Shape::Triangle => recorded == code::TRIANGLE,
        Shape::Label => recorded == code::LABEL,
    }
}

/// MuJoCo's code (`mjtCatBit`).
fn category(category: Category) -> i32 {
    match category {
        Category::Static => 1,
        Category::Dynamic => 2,
        Category::Decor => 4,
    }
}

/// Numbers of a light by name, as recorded; `directional` stands for the type in older versions.
fn compare_lights(recording: &Recording, ours: &[Light], out: &mut Differences) -> Result<(), String> {
    let kinds = if recording.has("light/type") {
        recording.numbers("light/type")?
    } else {
        recording.numbers("light/directional")?
    };
    let rows = |field: &str| recording.rows::<3>(&format!("light/{field}"));
    let (pos, dir, attenuation) = (rows("pos")?, rows("dir")?, rows("attenuation")?);
    let (ambient, diffuse, specular) = (rows("ambient")?, rows("diffuse")?, rows("specular")?);
    let [cutoff, exponent] = [recording.numbers("light/cutoff")?, recording.numbers("light/exponent")?];
    let [shadow, headlight] = [recording.numbers("light/castshadow")?, recording.numbers("light/headlight")?];
    let lit: Vec<usize> =
        (0..kinds.len().min(PLACES)).filter(|&k| kinds[k] == SPOT || kinds[k] == DIRECTIONAL).collect();
    if lit.len() != ours.len() {
        out.differs(format!("{} lights, not {}", ours.len(), lit.len()));
    }
    for (light, k) in ours.iter().zip(lit) {
        let place = format!("light {k}");
        match light.kind {
            LightKind::Directional if kinds[k] == DIRECTIONAL => {}
            LightKind::Spot { cutoff: angle, exponent: power, attenuation: fall } if kinds[k] == SPOT => {
                out.see("cutoff", &place, &cutoff[k..=k], &[angle]);
                out.see("exponent", &place, &exponent[k..=k], &[power]);
                out.see("attenuation", &place, &attenuation[k], &fall);
            }
            _ => out.differs(format!("{place} is {:?}", light.kind)),
        }
        if (light.headlight, light.shadow) != (headlight[k] != 0.0, shadow[k] != 0.0) {
            out.differs(format!("{place}: headlight {}, shadow {}", light.headlight, light.shadow));
        }
        // The headlight follows the camera; where it is has no effect.
        if !light.headlight {
            out.see("light pos", &place, &pos[k], &light.pos);
        }
        out.see("light dir", &place, &dir[k], &light.dir);
        out.see("ambient", &place, &ambient[k], &light.ambient);
        out.see("diffuse", &place, &diffuse[k], &light.diffuse);
        out.see("light specular", &place, &specular[k], &light.specular);
    }
    Ok(())
}

/// The view is the mean of MuJoCo's two eyes.
fn compare_view(recording: &Recording, ours: &View, out: &mut Differences) -> Result<(), String> {
    let mean = |field: &str| -> Result<Vec<f64>, String> {
        let values = recording.numbers(&format!("camera/{field}"))?;
        let (left, right) = values.split_at(values.len() / 2);
        Ok(left.iter().zip(right).map(|(a, b)| (a + b) / 2.0).collect())
    };
    let single = |x: [f64; 3]| x.map(|x| x as f32);
    out.see("eye", "camera", &mean("pos")?, &single(ours.eye));
    out.see("forward", "camera", &mean("forward")?, &single(ours.forward));
    out.see("up", "camera", &mean("up")?, &single(ours.up));
    let frustum = &ours.frustum;
    let edges = [
        ("frustum_center", frustum.center),
        ("frustum_width", frustum.half_width.unwrap_or(0.0)),
        ("frustum_bottom", frustum.bottom),
        ("frustum_top", frustum.top),
        ("frustum_near", frustum.near),
        ("frustum_far", frustum.far),
    ];
    for (field, value) in edges {
        out.see(field, "camera", &mean(field)?, &[value as f32]);
    }
    if recording.has("camera/orthographic") {
        let orthographic = mean("orthographic")?.iter().any(|x| *x != 0.0);
        if orthographic != frustum.orthographic {
            out.differs(format!("the camera is orthographic: {}", frustum.orthographic));
        }
    }
    Ok(())
}
