//! From a configuration to the elements of a model that it names.

use super::config::{
    CameraRange, DistractorRange, LightRange, MaterialRange, TextureRange, VisualRandomization,
};
use super::target::Seen;
use crate::randomize::choice::{ANYTHING, Choice};
use crate::randomize::dial::{Dial, Draws};
use physics::Model;
use physics::model::ObjType;

/// Everything that a configuration changes, in its order.
///
/// # Errors
/// A name that no element has, a range that is empty or beyond its bounds, a distractor that touches something or moves.
pub(super) fn dials(config: &VisualRandomization, model: &Model) -> Result<Vec<Dial<Seen>>, String> {
    let mut found = Choice::of(model);
    config.textures.iter().try_for_each(|range| found.textures(range))?;
    config.materials.iter().try_for_each(|range| found.materials(range))?;
    config.lights.iter().try_for_each(|range| found.lights(range))?;
    config.cameras.iter().try_for_each(|range| found.cameras(range))?;
    config.distractors.iter().try_for_each(|range| found.distractors(range))?;
    Ok(found.dials)
}

/// Bounds of colours, and of angles of view \[deg\].
const UNIT: [f64; 2] = [0.0, 1.0];
const VIEWS: [f64; 2] = [0.1, 179.0];

impl Choice<'_, Seen> {
    fn textures(&mut self, range: &TextureRange) -> Result<(), String> {
        if range.patterns.is_empty() {
            return Err("textures of visual_randomization need at least one pattern".into());
        }
        let colors = self.bounds("textures colors", &range.colors, UNIT)?;
        let squares = self.bounds("textures squares", &range.squares, [1.0, 4096.0])?[0];
        for texture in self.named("textures", (ObjType::Texture, self.model.ntex), range.names.as_deref())? {
            let color = [colors[0], colors[1], colors[2]];
            let draws = Draws::Pixels {
                patterns: range.patterns.iter().map(|&pattern| pattern as u8).collect(),
                color,
                squares,
            };
            self.put((ObjType::Texture, texture, "pixels"), "", Seen::TexturePixels(texture), draws);
        }
        Ok(())
    }

    fn materials(&mut self, range: &MaterialRange) -> Result<(), String> {
        let rgba = self.bounds("materials rgba", &range.rgba, UNIT)?;
        for material in
            self.named("materials", (ObjType::Material, self.model.nmat), range.names.as_deref())?
        {
            let draws = Draws::Uniform(rgba.clone());
            self.put((ObjType::Material, material, "rgba"), "", Seen::MaterialColor(material), draws);
        }
        Ok(())
    }

    fn lights(&mut self, range: &LightRange) -> Result<(), String> {
        let pos = self.optional("lights pos", range.pos.as_ref(), ANYTHING)?;
        let dir = self.optional("lights dir", range.dir.as_ref(), ANYTHING)?;
        let diffuse = self.optional("lights diffuse", range.diffuse.as_ref(), UNIT)?;
        let on = self.chance("lights on", range.on)?;
        let shadow = self.chance("lights shadow", range.shadow)?;
        for light in self.named("lights", (ObjType::Light, self.model.nlight), range.names.as_deref())? {
            let parts = [
                ("pos", "m", Seen::LightPosition(light), &pos),
                ("dir", "", Seen::LightDirection(light), &dir),
                ("diffuse", "", Seen::LightColor(light), &diffuse),
                ("on", "", Seen::LightOn(light), &on),
                ("shadow", "", Seen::LightShadow(light), &shadow),
            ];
            self.put_all((ObjType::Light, light), parts);
        }
        Ok(())
    }

    fn cameras(&mut self, range: &CameraRange) -> Result<(), String> {
        let pos = self.optional("cameras pos", range.pos.as_ref(), ANYTHING)?;
        let turn = self.optional("cameras turn", range.turn.as_ref(), ANYTHING)?;
        let fovy = self.optional("cameras fovy", range.fovy.as_ref(), VIEWS)?;
        for camera in self.named("cameras", (ObjType::Camera, self.model.ncam), range.names.as_deref())? {
            let parts = [
                ("pos", "m", Seen::CameraPosition(camera), &pos),
                ("turn", "deg", Seen::CameraTurn(camera), &turn),
                ("fovy", "deg", Seen::CameraFovy(camera), &fovy),
            ];
            self.put_all((ObjType::Camera, camera), parts);
        }
        Ok(())
    }

    fn distractors(&mut self, range: &DistractorRange) -> Result<(), String> {
        let rgba = self.optional("distractors rgba", range.rgba.as_ref(), UNIT)?;
        let pos = self.optional("distractors pos", range.pos.as_ref(), ANYTHING)?;
        let turn = self.optional("distractors turn", range.turn.as_ref(), ANYTHING)?;
        for body in self.named("distractors", (ObjType::Body, self.model.nbody), Some(&range.names))? {
            self.check_distractor(body)?;
            let parts = [
                ("rgba", "", Seen::BodyColor(body), &rgba),
                ("pos", "m", Seen::BodyPosition(body), &pos),
                ("turn", "deg", Seen::BodyTurn(body), &turn),
            ];
            self.put_all((ObjType::Body, body), parts);
        }
        Ok(())
    }

    /// A body whose place no motion depends on.
    fn check_distractor(&self, body: usize) -> Result<(), String> {
        let m = self.model;
        let label = m.label_of(ObjType::Body, body);
        let wrong =
            |what: &str| Err(format!("{label} cannot be a distractor of visual_randomization: {what}"));
        let mut geoms = (0..m.ngeom).filter(|&geom| m.geom_bodyid[geom] == body as i32);
        if body == 0 || m.body_weldid[body] != 0 || m.body_mocapid[body] >= 0 {
            return wrong("it moves, or is the world");
        }
        if geoms.any(|geom| m.geom_contype[geom] != 0 || m.geom_conaffinity[geom] != 0) {
            return wrong("it touches; give its geoms contype=\"0\" conaffinity=\"0\"");
        }
        if (1..m.nbody).any(|child| m.body_parentid[child] == body as i32) {
            return wrong("other bodies are attached to it");
        }
        Ok(())
    }
}
