//! The opaque part of a picture: what is seen, lit, in shadow or not, painted.

use super::backdrop::Known;
use super::draws::Draw;
use super::paint::{Brush, Canvas, added};
use super::seen::{Illumination, Seen};
use super::settings::Settings;
use super::shadow::{Question, Shadows};
use super::stage::Stage;
use super::still::{Kept, Plan};
use super::visibility::Visibility;
use crate::scene::Light;

/// What holds for all passes of a picture.
pub struct Frame<'a> {
    /// How finely it is drawn.
    pub settings: &'a Settings,
    /// Textures and fog.
    pub brush: &'a Brush<'a>,
    /// What to do with the backdrop.
    pub plan: Plan,
}

/// The opaque part of a picture.
#[derive(Clone, Debug, Default)]
pub struct Opaque {
    seen: Seen,
    light: Illumination,
    shadows: Shadows,
    /// Fragments that the backdrop knows.
    known: Vec<Known>,
    questions: Vec<Question>,
}

/// Bit of a question's name that tells known fragments from the others.
const KNOWN: u32 = 1 << 31;

impl Opaque {
    /// Makes the backdrop of a view from what stands still in it, which `visibility` shows.
    pub fn keep(&mut self, stage: &Stage<'_>, frame: &Frame<'_>, visibility: &Visibility, kept: &mut Kept) {
        self.known.clear();
        self.seen.collect(visibility, stage.lens.extent.width as usize, stage.draws.triangles, |_, _| false);
        self.light(stage, frame);
        for (bit, light) in self.shadowed(stage).enumerate() {
            self.ask(bit);
            self.shadows.cast(
                stage,
                light,
                &frame.settings.shadow,
                |draw| kept.stills.has(draw),
                &mut self.questions,
            );
            self.answer(bit);
        }
        kept.main.keep(visibility, &self.seen, stage.draws, frame.brush);
    }

    /// Paints what `visibility` shows; on the item that mirrors, over the mirror image.
    pub fn draw(
        &mut self,
        stage: &Stage<'_>,
        frame: &Frame<'_>,
        visibility: &Visibility,
        kept: &Kept,
        (reflective, canvas): (Option<usize>, &mut Canvas),
    ) {
        let width = stage.lens.extent.width as usize;
        let Opaque { seen, known, .. } = self;
        known.clear();
        seen.collect(visibility, width, stage.draws.triangles, |fragment, number| {
            let found = if frame.plan == Plan::Without { None } else { kept.main.find(fragment, number) };
            known.extend(found);
            found.is_some()
        });
        self.light(stage, frame);
        let moves = |draw: &Draw| !kept.stills.has(draw);
        let settings = &frame.settings.shadow;
        for (bit, light) in self.shadowed(stage).enumerate() {
            self.ask(bit);
            // What moves may shade everything; what stands still shades what the backdrop does not know.
            for (index, known) in (0..).zip(&mut self.known) {
                if known.fragment.lit >> bit & 1 != 0 {
                    self.questions.push((index | KNOWN, kept.main.position(known)));
                    known.fragment.lit &= !(1 << bit);
                }
            }
            self.shadows.cast(stage, light, settings, moves, &mut self.questions);
            self.questions.retain(|&(name, _)| {
                let is_known = name & KNOWN != 0;
                if is_known {
                    self.known[(name & !KNOWN) as usize].fragment.lit |= 1 << bit;
                }
                !is_known
            });
            if frame.plan != Plan::Without {
                self.shadows.cast(stage, light, settings, |draw| !moves(draw), &mut self.questions);
            }
            self.answer(bit);
        }
        for fragment in &self.seen.fragments {
            let draw = &stage.draws.list[self.seen.triangles[fragment.triangle as usize].draw as usize];
            let colour = frame.brush.colour(&self.seen, &draw.paint, 1.0, fragment);
            let mirrors = reflective == Some(draw.item);
            canvas.touch(fragment, |below| if mirrors { added(colour, below) } else { colour });
        }
        for known in &self.known {
            let colour = kept.main.colour(known);
            let mirrors = reflective == Some(kept.main.item(known));
            canvas.touch(&known.fragment, |below| if mirrors { added(colour, below) } else { colour });
        }
    }

    fn light(&mut self, stage: &Stage<'_>, frame: &Frame<'_>) {
        let shadows = stage.scene.shadows && frame.settings.shadow.size > 0;
        self.light.set(stage.scene, stage.scene.view.eye.map(|x| x as f32), shadows);
        self.seen.light(stage, &self.light);
    }

    /// The lights whose shadows are drawn.
    fn shadowed<'a>(&self, stage: &Stage<'a>) -> impl Iterator<Item = &'a Light> + use<'a> {
        stage.scene.lights.iter().filter(|light| light.shadow).take(self.light.shadowed.len())
    }

    /// Asks whether a lamp reaches the fragments collected that it would light.
    fn ask(&mut self, bit: usize) {
        let Opaque { seen, questions, .. } = self;
        questions.clear();
        for (index, fragment) in (0..).zip(&seen.fragments) {
            if seen.is_lit(&seen.triangles[fragment.triangle as usize], 1 + bit) {
                questions.push((index, seen.positions[index as usize]));
            }
        }
    }

    /// Marks the fragments that the lamp reaches.
    fn answer(&mut self, bit: usize) {
        for &(index, _) in &self.questions {
            self.seen.fragments[index as usize].lit |= 1 << bit;
        }
    }
}
