//! The opaque part of a picture: what is seen, lit, in shadow or not, painted.

use super::backdrop::Known;
use super::colour::paint::{Brush, Canvas, added};
use super::colour::seen::{Illumination, Seen};
use super::settings::Settings;
use super::shadow::Question;
use super::stage::Stage;
use super::still::{Kept, Plan};
use super::visibility::Visibility;

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
    /// Fragments that the backdrop knows.
    known: Vec<Known>,
}

/// Bit of a question's name that tells known fragments from the others.
const KNOWN: u32 = 1 << 31;

impl Opaque {
    /// Shows nothing.
    pub fn clear(&mut self) {
        self.known.clear();
        self.seen.begin(0);
    }

    /// Collects and lights what stands still in a view, which `visibility` shows.
    pub fn collect_still(&mut self, stage: &Stage<'_>, frame: &Frame<'_>, visibility: &Visibility) {
        self.known.clear();
        self.seen.collect(visibility, stage.lens.extent.width as usize, stage.draws.triangles, |_, _| false);
        self.light(stage, frame);
    }

    /// Makes the backdrop of a view from what stands still in it, collected and with its shadows.
    pub fn keep(&self, stage: &Stage<'_>, frame: &Frame<'_>, visibility: &Visibility, kept: &mut Kept) {
        kept.main.keep(visibility, &self.seen, stage.draws, frame.brush);
    }

    /// Collects and lights what `visibility` shows.
    pub fn collect(&mut self, stage: &Stage<'_>, frame: &Frame<'_>, visibility: &Visibility, kept: &Kept) {
        let width = stage.lens.extent.width as usize;
        let Opaque { seen, known, .. } = self;
        known.clear();
        if frame.plan == Plan::Without {
            seen.collect(visibility, width, stage.draws.triangles, |_, _| false);
        } else {
            seen.collect(visibility, width, stage.draws.triangles, |fragment, number| {
                let found = kept.main.find(fragment, number);
                known.extend(found);
                found.is_some()
            });
        }
        self.light(stage, frame);
    }

    /// Paints what has been collected; on the item that mirrors, over the mirror image.
    pub fn paint(
        &self,
        stage: &Stage<'_>,
        brush: &Brush<'_>,
        kept: &Kept,
        (reflective, canvas): (Option<usize>, &mut Canvas),
    ) {
        for fragment in &self.seen.fragments {
            let draw = &stage.draws.list[self.seen.triangles[fragment.triangle as usize].draw as usize];
            let colour = brush.colour(&self.seen, &draw.paint, 1.0, fragment);
            if reflective == Some(draw.item) {
                canvas.touch(fragment, |below| added(colour, below));
            } else {
                canvas.set(fragment, colour);
            }
        }
        for known in &self.known {
            let colour = kept.main.colour(known);
            if reflective == Some(kept.main.item(known)) {
                canvas.touch(&known.fragment, |below| added(colour, below));
            } else {
                canvas.set(&known.fragment, colour);
            }
        }
    }

    fn light(&mut self, stage: &Stage<'_>, frame: &Frame<'_>) {
        let shadows = stage.scene.shadows && frame.settings.shadow.size > 0;
        self.light.set(stage.scene, stage.scene.view.eye.map(|x| x as f32), shadows);
        self.seen.light(stage, &self.light);
    }

    /// How many lamps cast shadows.
    pub fn lamps(&self) -> usize {
        self.light.shadowed.len()
    }

    /// Asks, as picture number `view`, whether a lamp reaches the fragments collected that it would light.
    pub fn ask(&self, bit: usize, view: u32, questions: &mut Vec<Question>) {
        let seen = &self.seen;
        for (name, fragment) in (0..).zip(&seen.fragments) {
            if seen.is_lit(&seen.triangles[fragment.triangle as usize], 1 + bit) {
                questions.push(Question { view, name, position: seen.positions[name as usize] });
            }
        }
    }

    /// Asks the same about the fragments that the backdrop knows and that it reaches past what stands still.
    pub fn ask_known(&mut self, bit: usize, view: u32, kept: &Kept, questions: &mut Vec<Question>) {
        for (index, known) in (0..).zip(&mut self.known) {
            if known.fragment.lit >> bit & 1 != 0 {
                questions.push(Question { view, name: index | KNOWN, position: kept.main.position(known) });
                known.fragment.lit &= !(1 << bit);
            }
        }
    }

    /// Marks a fragment that the lamp reaches.
    #[inline]
    pub fn answer(&mut self, bit: usize, question: &Question) {
        let lit = match is_known(question) {
            true => &mut self.known[(question.name & !KNOWN) as usize].fragment.lit,
            false => &mut self.seen.fragments[question.name as usize].lit,
        };
        *lit |= 1 << bit;
    }
}

/// Whether a question is about a fragment that the backdrop knows.
#[inline]
pub fn is_known(question: &Question) -> bool {
    question.name & KNOWN != 0
}
