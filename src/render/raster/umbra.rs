//! The shadows of the opaque parts of pictures of one state, lamp by lamp.

use super::draws::{Draw, Draws};
use super::opaque::{Opaque, is_known};
use super::shadow::{Casting, Question, ShadowSettings, Shadows, maps};
use super::stage::Stage;
use super::still::Kept;

/// What finds out which fragments lie in shadow.
#[derive(Clone, Debug, Default)]
pub struct Umbra {
    shadows: Shadows,
    questions: Vec<Question>,
}

/// What casts shadows.
pub struct Cast<'a> {
    /// The first picture. Lamps and their maps are the same in all.
    pub stage: &'a Stage<'a>,
    /// The maps.
    pub settings: &'a ShadowSettings,
    /// Width of the lines that outline triangles \[texel\]; none where they are filled.
    pub wire: Option<f32>,
    /// Surfaces of each picture.
    pub draws: &'a [Draws],
}

impl<'a> Cast<'a> {
    /// The lamps that cast shadows.
    fn castings(&self, lamps: usize) -> impl Iterator<Item = Casting<'a>> + use<'a> {
        let Stage { assets, scene, .. } = *self.stage;
        let (settings, draws, wire) = (self.settings, self.draws, self.wire);
        scene.lights.iter().filter(|light| light.shadow).take(lamps).map(move |light| Casting {
            assets,
            draws,
            maps: maps(light, scene, settings),
            size: settings.size,
            wire,
        })
    }
}

impl Umbra {
    /// Marks the fragments of one picture that lamps reach past the draws that `casters` picks.
    pub fn fall_from(&mut self, cast: &Cast<'_>, casters: impl Fn(&Draw) -> bool, picture: &mut Opaque) {
        let Umbra { shadows, questions } = self;
        for (bit, casting) in cast.castings(picture.lamps()).enumerate() {
            questions.clear();
            picture.ask(bit, 0, questions);
            shadows.cast(&casting, &casters, questions);
            questions.iter().for_each(|question| picture.answer(bit, question));
        }
    }

    /// Marks the fragments of several pictures that lamps reach; those that a backdrop knows are in no shadow of what stands
    /// still in their own view, which is looked at for the others alone.
    pub fn fall<'k>(
        &mut self,
        cast: &Cast<'_>,
        pictures: &mut [Opaque],
        kept: impl Fn(usize) -> Option<&'k Kept>,
    ) {
        let Umbra { shadows, questions } = self;
        let any = (0..pictures.len()).any(|view| kept(view).is_some());
        // What stands still in every view that has a backdrop.
        let stands = |draw: &Draw| {
            any && (0..cast.draws.len()).all(|view| kept(view).is_none_or(|kept| kept.stills.has(draw)))
        };
        let lamps = pictures.iter().map(Opaque::lamps).max().unwrap_or(0);
        for (bit, casting) in cast.castings(lamps).enumerate() {
            questions.clear();
            for (view, picture) in (0..).zip(&mut *pictures) {
                picture.ask(bit, view, questions);
                if let Some(kept) = kept(view as usize) {
                    picture.ask_known(bit, view, kept, questions);
                }
            }
            shadows.cast(&casting, |draw| !stands(draw), questions);
            if any {
                questions.retain(|question| {
                    let known = is_known(question);
                    if known {
                        pictures[question.view as usize].answer(bit, question);
                    }
                    !known
                });
                shadows.cast(&casting, stands, questions);
            }
            questions.iter().for_each(|question| pictures[question.view as usize].answer(bit, question));
        }
    }
}
