//! Element names: MuJoCo keeps all names in one zero-separated buffer with an address a kind.

use super::fields::Arrays;
use super::types::ObjType;

impl Arrays {
    /// Name addresses of one kind of element; empty for kinds without names.
    pub(crate) fn name_addresses(&self, kind: ObjType) -> &[i32] {
        match kind {
            ObjType::Body | ObjType::Xbody => &self.name_bodyadr,
            ObjType::Joint => &self.name_jntadr,
            ObjType::Geom => &self.name_geomadr,
            ObjType::Site => &self.name_siteadr,
            ObjType::Camera => &self.name_camadr,
            ObjType::Light => &self.name_lightadr,
            ObjType::Mesh => &self.name_meshadr,
            ObjType::Flex => &self.name_flexadr,
            ObjType::Skin => &self.name_skinadr,
            ObjType::Hfield => &self.name_hfieldadr,
            ObjType::Texture => &self.name_texadr,
            ObjType::Material => &self.name_matadr,
            ObjType::Pair => &self.name_pairadr,
            ObjType::Exclude => &self.name_excludeadr,
            ObjType::Equality => &self.name_eqadr,
            ObjType::Tendon => &self.name_tendonadr,
            ObjType::Actuator => &self.name_actuatoradr,
            ObjType::Sensor => &self.name_sensoradr,
            ObjType::Numeric => &self.name_numericadr,
            ObjType::Text => &self.name_textadr,
            ObjType::Tuple => &self.name_tupleadr,
            ObjType::Key => &self.name_keyadr,
            ObjType::Plugin => &self.name_pluginadr,
            _ => &[],
        }
    }

    /// Name of element `id`, empty when it has none or does not exist.
    pub fn name_of(&self, kind: ObjType, id: usize) -> &str {
        let Some(&start) = self.name_addresses(kind).get(id) else { return "" };
        let tail = self.names.get(start as usize..).unwrap_or(&[]);
        let end = tail.iter().position(|&b| b == 0).unwrap_or(tail.len());
        std::str::from_utf8(&tail[..end]).unwrap_or("")
    }

    /// Kind and name as messages show them, `joint "elbow"`; the index stands in for a missing name, `joint 3`.
    pub fn label_of(&self, kind: ObjType, id: usize) -> String {
        let word = format!("{kind:?}").to_lowercase();
        match self.name_of(kind, id) {
            "" => format!("{word} {id}"),
            name => format!("{word} {name:?}"),
        }
    }
}
