//! From a configuration to the elements of a model that it names.

use super::config::{
    CameraRange, DistractorRange, LightRange, MaterialRange, TextureRange, VisualRandomization,
};
use super::dial::{Dial, Draws, Target};
use crate::draws::Ranges;
use physics::Model;
use physics::math::Legible;
use physics::model::{ObjType, Suggestions};

/// Everything that a configuration changes, in its order.
///
/// # Errors
/// A name that no element has, a range that is empty or beyond its bounds, a distractor that touches something or moves.
pub(super) fn dials(config: &VisualRandomization, model: &Model) -> Result<Vec<Dial>, String> {
    let mut found = Found { model, dials: Vec::new() };
    config.textures.iter().try_for_each(|range| found.textures(range))?;
    config.materials.iter().try_for_each(|range| found.materials(range))?;
    config.lights.iter().try_for_each(|range| found.lights(range))?;
    config.cameras.iter().try_for_each(|range| found.cameras(range))?;
    config.distractors.iter().try_for_each(|range| found.distractors(range))?;
    Ok(found.dials)
}

struct Found<'a> {
    model: &'a Model,
    dials: Vec<Dial>,
}

/// Bounds of colours, and of angles of view \[deg\].
const UNIT: [f64; 2] = [0.0, 1.0];
const VIEWS: [f64; 2] = [0.1, 179.0];
const ANYTHING: [f64; 2] = [f64::MIN, f64::MAX];

impl Found<'_> {
    fn textures(&mut self, range: &TextureRange) -> Result<(), String> {
        if range.patterns.is_empty() {
            return Err("textures of visual_randomization need at least one pattern".into());
        }
        let colors = bounds("textures colors", &range.colors, UNIT)?;
        let squares = bounds("textures squares", &range.squares, [1.0, 4096.0])?[0];
        for texture in self.named(ObjType::Texture, self.model.ntex, range.names.as_deref())? {
            let color = [colors[0], colors[1], colors[2]];
            let draws = Draws::Pixels { patterns: range.patterns.clone(), color, squares };
            self.put((ObjType::Texture, texture, "pixels"), "", Target::TexturePixels(texture), draws);
        }
        Ok(())
    }

    fn materials(&mut self, range: &MaterialRange) -> Result<(), String> {
        let rgba = bounds("materials rgba", &range.rgba, UNIT)?;
        for material in self.named(ObjType::Material, self.model.nmat, range.names.as_deref())? {
            let draws = Draws::Uniform(rgba.clone());
            self.put((ObjType::Material, material, "rgba"), "", Target::MaterialColor(material), draws);
        }
        Ok(())
    }

    fn lights(&mut self, range: &LightRange) -> Result<(), String> {
        let pos = optional("lights pos", range.pos.as_ref(), ANYTHING)?;
        let dir = optional("lights dir", range.dir.as_ref(), ANYTHING)?;
        let diffuse = optional("lights diffuse", range.diffuse.as_ref(), UNIT)?;
        let on = chance("lights on", range.on)?;
        let shadow = chance("lights shadow", range.shadow)?;
        for light in self.named(ObjType::Light, self.model.nlight, range.names.as_deref())? {
            let parts = [
                ("pos", "m", Target::LightPosition(light), &pos),
                ("dir", "", Target::LightDirection(light), &dir),
                ("diffuse", "", Target::LightColor(light), &diffuse),
                ("on", "", Target::LightOn(light), &on),
                ("shadow", "", Target::LightShadow(light), &shadow),
            ];
            self.put_all((ObjType::Light, light), parts);
        }
        Ok(())
    }

    fn cameras(&mut self, range: &CameraRange) -> Result<(), String> {
        let pos = optional("cameras pos", range.pos.as_ref(), ANYTHING)?;
        let turn = optional("cameras turn", range.turn.as_ref(), ANYTHING)?;
        let fovy = optional("cameras fovy", range.fovy.as_ref(), VIEWS)?;
        for camera in self.named(ObjType::Camera, self.model.ncam, range.names.as_deref())? {
            let parts = [
                ("pos", "m", Target::CameraPosition(camera), &pos),
                ("turn", "deg", Target::CameraTurn(camera), &turn),
                ("fovy", "deg", Target::CameraFovy(camera), &fovy),
            ];
            self.put_all((ObjType::Camera, camera), parts);
        }
        Ok(())
    }

    fn distractors(&mut self, range: &DistractorRange) -> Result<(), String> {
        let rgba = optional("distractors rgba", range.rgba.as_ref(), UNIT)?;
        let pos = optional("distractors pos", range.pos.as_ref(), ANYTHING)?;
        let turn = optional("distractors turn", range.turn.as_ref(), ANYTHING)?;
        for body in self.named(ObjType::Body, self.model.nbody, Some(&range.names))? {
            self.check_distractor(body)?;
            let parts = [
                ("rgba", "", Target::BodyColor(body), &rgba),
                ("pos", "m", Target::BodyPosition(body), &pos),
                ("turn", "deg", Target::BodyTurn(body), &turn),
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

    /// The elements that patterns name; all without patterns.
    fn named(&self, kind: ObjType, count: usize, patterns: Option<&[String]>) -> Result<Vec<usize>, String> {
        let Some(patterns) = patterns else { return Ok((0..count).collect()) };
        let name = |id: usize| self.model.name_of(kind, id);
        for pattern in patterns {
            if !(0..count).any(|id| fits(pattern, name(id))) {
                let nearest = Suggestions::default().nearest(pattern, (0..count).map(name));
                let hint = nearest.map_or_else(String::new, |nearest| format!("; did you mean {nearest}?"));
                let word = format!("{kind:?}").to_lowercase();
                return Err(format!(
                    "visual_randomization names the {word} {pattern}, which the model does not have{hint}"
                ));
            }
        }
        Ok((0..count).filter(|&id| patterns.iter().any(|pattern| fits(pattern, name(id)))).collect())
    }

    fn put_all<const N: usize>(
        &mut self,
        (kind, id): (ObjType, usize),
        parts: [(&str, &'static str, Target, &Option<Draws>); N],
    ) {
        for (part, unit, target, draws) in parts {
            if let Some(draws) = draws {
                self.put((kind, id, part), unit, target, draws.clone());
            }
        }
    }

    /// Adds a dial, or replaces the one that turns the same.
    fn put(
        &mut self,
        (kind, id, part): (ObjType, usize, &str),
        unit: &'static str,
        target: Target,
        draws: Draws,
    ) {
        let element = match self.model.name_of(kind, id) {
            "" => id.to_string(),
            name => name.to_owned(),
        };
        let name = format!("{}/{element}/{part}", format!("{kind:?}").to_lowercase());
        self.dials.retain(|dial| dial.target != target);
        self.dials.push(Dial { name, unit, target, draws });
    }
}

/// Whether a name is the pattern, or begins like one that ends with `*`.
fn fits(pattern: &str, name: &str) -> bool {
    pattern.strip_suffix('*').map_or(name == pattern, |start| name.starts_with(start))
}

fn optional<const N: usize>(
    what: &str,
    range: Option<&Ranges<N>>,
    within: [f64; 2],
) -> Result<Option<Draws>, String> {
    range.map(|range| bounds(what, range, within).map(Draws::Uniform)).transpose()
}

fn bounds<const N: usize>(what: &str, range: &Ranges<N>, within: [f64; 2]) -> Result<Vec<[f64; 2]>, String> {
    let pairs: Vec<[f64; 2]> = range.low.into_iter().zip(range.high).map(|(low, high)| [low, high]).collect();
    let good = |[low, high]: &[f64; 2]| {
        within[0] <= *low && low <= high && *high <= within[1] && (high - low).is_finite()
    };
    if pairs.iter().all(good) {
        return Ok(pairs);
    }
    let [low, high] = within;
    let limits = if within == ANYTHING {
        String::new()
    } else {
        format!(", within {} and {}", Legible(low), Legible(high))
    };
    Err(format!("{what} of visual_randomization needs finite bounds, low not above high{limits}"))
}

fn chance(what: &str, probability: Option<f64>) -> Result<Option<Draws>, String> {
    match probability {
        None => Ok(None),
        Some(p) if (0.0..=1.0).contains(&p) => Ok(Some(Draws::Chance(p))),
        Some(p) => Err(format!("{what} of visual_randomization is a probability, 0 to 1, not {p}")),
    }
}
