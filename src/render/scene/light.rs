//! Lights: the headlight, and the model's.

use crate::RenderError;
use crate::view::View;
use physics::model::{LightType, ObjType};
use physics::{Data, Model};

/// Kind of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Parallel rays.
    Directional,
    /// Rays from a point within a cone.
    Spot {
        /// Half angle of the cone \[deg\].
        cutoff: f32,
        /// Fall of the intensity away from the axis.
        exponent: f32,
        /// Constant, linear and quadratic fall of the intensity with distance.
        attenuation: [f32; 3],
    },
}

/// One light, world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Kind of light.
    pub kind: LightKind,
    /// Position \[m\].
    pub pos: [f32; 3],
    /// Unit direction of its rays or its axis.
    pub dir: [f32; 3],
    /// Ambient colour.
    pub ambient: [f32; 3],
    /// Diffuse colour.
    pub diffuse: [f32; 3],
    /// Specular colour.
    pub specular: [f32; 3],
    /// It casts shadows.
    pub shadow: bool,
    /// It is the headlight.
    pub headlight: bool,
}

/// Places in the list of lights. Lights that are switched off take a place too.
const PLACES: usize = 8;

/// Ambient light where no light of the scene is of a kind that lights.
const GLOBAL: f32 = 0.3;

/// Fills `lights` with the first that light, the headlight in front. Returns the ambient light of the whole scene.
///
/// Point lights and images do not light, though they take places among the first eight. The ambient light stands in
/// only when the model has no light at all that could light, even behind the eighth place.
///
/// # Errors
/// The pose of a light is not finite.
pub(super) fn gather(m: &Model, d: &Data, view: &View, lights: &mut Vec<Light>) -> Result<f32, RenderError> {
    lights.clear();
    let headlight = m.vis.headlight.active != 0;
    if headlight {
        lights.push(self::headlight(m, view));
    }
    let mut kinds = usize::from(headlight);
    let active = (0..m.nlight).filter(|&i| m.light_active[i]);
    for (place, i) in active.enumerate().map(|(k, i)| (k + usize::from(headlight), i)) {
        let Some(kind) = kind(m, i) else { continue };
        kinds += 1;
        let (pos, dir) = (d.kin.light_xpos[i].map(|x| x as f32), d.kin.light_xdir[i].map(|x| x as f32));
        if !pos.iter().chain(&dir).all(|x| x.is_finite()) {
            return Err(RenderError::NotFinite { what: m.label_of(ObjType::Light, i) });
        }
        if place < PLACES {
            lights.push(Light {
                kind,
                pos,
                dir,
                ambient: m.light_ambient[i],
                diffuse: m.light_diffuse[i],
                specular: m.light_specular[i],
                shadow: m.light_castshadow[i],
                headlight: false,
            });
        }
    }
    Ok(if kinds == 0 { GLOBAL } else { 0.0 })
}

fn headlight(m: &Model, view: &View) -> Light {
    let light = &m.vis.headlight;
    Light {
        kind: LightKind::Directional,
        pos: view.eye.map(|x| x as f32),
        dir: view.forward.map(|x| x as f32),
        ambient: light.ambient,
        diffuse: light.diffuse,
        specular: light.specular,
        shadow: false,
        headlight: true,
    }
}

/// The kind of a light of the model; none for one that does not light.
fn kind(m: &Model, i: usize) -> Option<LightKind> {
    match LightType::from_code(m.light_type[i])? {
        LightType::Directional => Some(LightKind::Directional),
        LightType::Spot => Some(LightKind::Spot {
            cutoff: m.light_cutoff[i],
            exponent: m.light_exponent[i],
            attenuation: m.light_attenuation[i],
        }),
        LightType::Point | LightType::Image => None,
    }
}
