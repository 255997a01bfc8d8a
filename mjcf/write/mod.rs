//! A [`Spec`] as MJCF: defaults resolved, angles in radians, numbers as the shortest decimals that read alike.
//!
//! Elements go through the rows of the schema, which the reader goes through too; what a row cannot say is said in the
//! file of its family. The text of a model that compiles gives the same arrays, to the last bit, and is its own fixed
//! point: read and written again, it stays as it is.

mod actuator;
mod asset;
mod constraint;
mod files;
mod flex;
mod keys;
mod plugin;
mod rows;
mod sensor;
mod settings;
mod settled;
pub(crate) mod text;
mod tree;

use crate::diagnostic::Diagnostics;
use crate::spec::Spec;
use crate::xml::{Element, Limits};

impl Spec {
    /// The model as MJCF. Files of assets are named by their `path`, seen from where the text will stand; see
    /// [`Spec::place_assets`].
    ///
    /// ```
    /// let text = "<mujoco><worldbody><body name='a'><joint range='0 90'/><geom size='.1'/></body></worldbody></mujoco>";
    /// let parsed = robohive_mjcf::parse_str(text)?;
    /// let written = parsed.spec.to_xml()?;
    /// assert!(written.contains(r#"<joint range="0 1.5707963267948966"/>"#));
    /// assert_eq!(robohive_mjcf::parse_str(&written)?.spec.to_xml()?, written);
    /// # Ok::<(), robohive_mjcf::diagnostic::Diagnostics>(())
    /// ```
    ///
    /// # Errors
    /// A name that XML cannot hold; a number that is not one; settings of an attached model that differ and that no
    /// element can say; keyframes of attached models before [`Spec::settle_keys`].
    pub fn to_xml(&self) -> Result<String, Diagnostics> {
        let root = self.tree().map_err(Diagnostics::of_error)?;
        text::print(&root, Limits::default().depth).map_err(Diagnostics::of_error)
    }

    fn tree(&self) -> Result<Element, String> {
        let spec = settled::settled(self)?;
        let mut root = text::element("mujoco");
        if spec.modelname != UNNAMED {
            root.put("model", &spec.modelname);
        }
        root.add(settings::compiler(&spec.compiler));
        root.add(settings::option(&spec.option));
        root.add(settings::size(&spec.size));
        root.add(settings::visual(&spec.visual));
        root.add(settings::statistic(&spec.stat));
        root.add(plugin::extension(&spec));
        root.add(constraint::tendon_classes(&spec));
        root.add(asset::assets(&spec));
        root.add(tree::world(&spec.world, &spec.frames));
        root.add(flex::deformable(&spec)?);
        root.add(constraint::contact(&spec));
        root.add(constraint::equalities(&spec));
        root.add(constraint::tendons(&spec));
        root.add(actuator::actuators(&spec)?);
        root.add(sensor::sensors(&spec));
        root.add(settings::custom(&spec));
        root.add(settings::keyframe(&spec.keys));
        Ok(root)
    }
}

/// What a model without a name is called.
const UNNAMED: &str = "MuJoCo Model";

/// Single elements, for edits.
macro_rules! single {
    ($($name:ident $type:ident $write:path;)*) => {
        $(pub(crate) fn $name(element: &crate::spec::$type) -> Result<Element, String> {
            Ok($write(element))
        })*
    };
}

single! {
    joint Joint tree::joint;
    geom Geom tree::geom;
    site Site tree::site;
    camera Camera tree::camera;
    light Light tree::light;
    mesh Mesh asset::mesh;
    skin Skin asset::skin;
    hfield Hfield asset::hfield;
    texture Texture asset::texture;
    material Material asset::material;
    pair Pair constraint::pair;
    exclude Exclude constraint::exclude;
    equality Equality constraint::equality;
    tendon Tendon constraint::plain_tendon;
    numeric Numeric settings::numeric;
    text_of Text settings::custom_text;
    tuple Tuple settings::tuple;
    key Key settings::key;
}

pub(crate) use actuator::actuator;
pub(crate) use flex::flex;
pub(crate) fn sensor(sensor: &crate::spec::Sensor) -> Result<Element, String> {
    sensor::sensor(sensor).ok_or_else(|| format!("sensor '{}' has no element in MJCF", sensor.name))
}
