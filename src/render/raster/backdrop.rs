//! What one view shows of the surfaces that stand still: kept from picture to picture, so that only what moves is drawn again.
//!
//! Nearness decides what is seen, and colours under different lamps are added in eight bits: neither depends on whether a part
//! comes from here or is drawn, so pictures have the same bits with a backdrop as without.

use super::colour::paint::{Brush, Rgba, added};
use super::colour::seen::{Fragment, Seen};
use super::draws::{Draw, Draws};
use super::visibility::Visibility;

/// A window in which only what stands still is seen.
#[derive(Clone, Debug)]
pub struct Backdrop {
    /// What is seen at its samples.
    pub visibility: Visibility,
    /// First fragment of each group, and one more.
    starts: Vec<u32>,
    kept: Vec<Kept>,
    /// Colours of every fragment, pass by pass.
    colours: Vec<Rgba>,
    passes: usize,
}

/// A fragment of what stands still.
#[derive(Clone, Copy, Debug)]
struct Kept {
    /// Number of its triangle.
    number: u32,
    /// Its item.
    item: u32,
    /// Bits of its samples in its group.
    lanes: u8,
    /// Bits of the lamps that reach it past what stands still.
    lit: u8,
    /// Its colour under those.
    colour: Rgba,
    /// Where it lies, world frame \[m\]; the origin where no lamp casts shadows, and nobody asks.
    position: [f32; 3],
}

/// A fragment of the picture that a backdrop knows.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// Where it is.
    pub fragment: Fragment,
    /// Index into the backdrop's fragments.
    index: u32,
}

impl Default for Backdrop {
    fn default() -> Self {
        Backdrop {
            visibility: Visibility::new(super::window::coverage::Pattern::CENTER),
            starts: Vec::new(),
            kept: Vec::new(),
            colours: Vec::new(),
            passes: 1,
        }
    }
}

impl Backdrop {
    /// Keeps what `seen` has collected and lit of `visibility`.
    pub fn keep(&mut self, visibility: &Visibility, seen: &Seen, draws: &Draws, brush: &Brush<'_>) {
        self.visibility.copy(visibility);
        self.passes = seen.passes();
        self.kept.clear();
        self.colours.clear();
        self.starts.clear();
        self.starts.resize(visibility.groups.len() + 1, 0);
        for (index, fragment) in seen.fragments.iter().enumerate() {
            let triangle = &seen.triangles[fragment.triangle as usize];
            let draw = &draws.list[triangle.draw as usize];
            let first = self.colours.len();
            brush.passes(seen, &draw.paint, fragment, self.passes, &mut self.colours);
            self.kept.push(Kept {
                number: seen.number(fragment),
                item: draw.item as u32,
                lanes: fragment.lanes,
                lit: fragment.lit,
                colour: sum(&self.colours[first..], fragment.lit),
                position: if self.passes > 1 { seen.positions[index] } else { [0.0; 3] },
            });
            self.starts[fragment.group as usize + 1] = self.kept.len() as u32;
        }
        // Groups without fragments begin where the one before ends.
        for group in 1..self.starts.len() {
            self.starts[group] = self.starts[group].max(self.starts[group - 1]);
        }
    }

    /// The backdrop's fragment of a triangle in a group, lit by what reaches it past what stands still.
    #[inline]
    pub fn find(&self, fragment: Fragment, number: u32) -> Option<Known> {
        let group = fragment.group as usize;
        let (first, end) = (self.starts[group], self.starts[group + 1]);
        (first..end).find_map(|index| {
            let kept = &self.kept[index as usize];
            let found = kept.number == number && kept.lanes & fragment.lanes != 0;
            found.then_some(Known { fragment: Fragment { lit: kept.lit, ..fragment }, index })
        })
    }

    /// Where a fragment lies, world frame \[m\].
    pub fn position(&self, known: &Known) -> [f32; 3] {
        self.kept[known.index as usize].position
    }

    /// The item that a fragment belongs to.
    pub fn item(&self, known: &Known) -> usize {
        self.kept[known.index as usize].item as usize
    }

    /// The colour of a fragment under the lamps that reach it.
    #[inline]
    pub fn colour(&self, known: &Known) -> Rgba {
        let kept = &self.kept[known.index as usize];
        if known.fragment.lit == kept.lit {
            return kept.colour;
        }
        sum(&self.colours[known.index as usize * self.passes..], known.fragment.lit)
    }
}

/// The colour of a fragment: the lamps without shadows, plus the lamps with shadows that reach it.
#[inline]
fn sum(colours: &[Rgba], mut lit: u8) -> Rgba {
    let mut sum = colours[0];
    while lit != 0 {
        sum = added(sum, colours[1 + lit.trailing_zeros() as usize]);
        lit &= lit - 1;
    }
    sum
}

/// Which items stand still.
#[derive(Clone, Debug, Default)]
pub struct Stills {
    still: Vec<bool>,
}

impl Stills {
    /// Marks the items that `rests` picks as standing still.
    pub fn set(&mut self, items: usize, rests: impl Fn(usize) -> bool) {
        self.still.clear();
        self.still.extend((0..items).map(rests));
    }

    /// Whether anything stands still.
    pub fn any(&self) -> bool {
        self.still.contains(&true)
    }

    /// Whether all that stand still are `right`.
    pub fn all(&self, right: impl Fn(usize) -> bool) -> bool {
        self.still.iter().enumerate().all(|(item, &still)| !still || right(item))
    }

    /// Whether an item stands still.
    #[inline]
    pub fn has_item(&self, item: usize) -> bool {
        self.still.get(item).copied().unwrap_or(false)
    }

    /// Whether what a surface belongs to stands still.
    #[inline]
    pub fn has(&self, draw: &Draw) -> bool {
        self.has_item(draw.item)
    }
}
