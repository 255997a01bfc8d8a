//! Colours of constraint islands.

use super::sink::{Coat, Source};
use physics::model::Enable;

/// A colour that hardly any other island has: hue, saturation and value are Halton sequences, so that neighbouring
/// numbers differ much. Grey without an island.
pub(super) fn color(island_dof: Option<usize>) -> [f32; 4] {
    let Some(dof) = island_dof else { return [0.7, 0.7, 0.7, 1.0] };
    let [hue, saturation, value] = shade(dof);
    let [r, g, b] = rgb(hue, saturation, value);
    [r, g, b, 1.0]
}

/// The same, paler and darker, of an island that sleeps.
fn sleeping_color(dof: usize) -> [f32; 4] {
    let [hue, saturation, value] = shade(dof);
    let [r, g, b] = rgb(hue, (f64::from(saturation) * 0.7) as f32, (f64::from(value) * 0.6) as f32);
    [r, g, b, 1.0]
}

/// Hue, saturation and value.
fn shade(dof: usize) -> [f32; 3] {
    let hue = radical_inverse(dof + 1, 7) as f32;
    let saturation = (0.5 + 0.5 * radical_inverse(dof + 1, 3)) as f32;
    let value = (0.6 + 0.4 * radical_inverse(dof + 1, 5)) as f32;
    [hue, saturation, value]
}

impl Source<'_> {
    /// Coat of something that moves with a body: its island's colour where islands are shown.
    pub fn island_coat(&self, body: i32, coat: Coat) -> Coat {
        let weld = self.m.body_weldid[body as usize] as usize;
        if !self.options.show.islands || self.m.body_dofnum[weld] == 0 {
            return coat;
        }
        let dof = self.m.body_dofadr[weld] as usize;
        let rgba = match self.first_dof(self.island_of_dof(dof)) {
            None if self.m.opt.enableflags.contains(Enable::SLEEP) => self.tree_color(dof),
            island => color(island),
        };
        Coat { rgba, material: None, ..coat }
    }

    /// Colour of the tree of a degree of freedom, or of the least tree of those that fell asleep with it.
    fn tree_color(&self, dof: usize) -> [f32; 4] {
        let (m, asleep) = (self.m, &self.d.state.tree_asleep);
        let tree = m.dof_treeid[dof] as usize;
        let first = |tree: usize| m.tree_dofadr[tree] as usize;
        if asleep[tree] < 0 {
            return color(Some(first(tree)));
        }
        let (mut least, mut next) = (tree, asleep[tree] as usize);
        while next != tree {
            (least, next) = (least.min(next), asleep[next] as usize);
        }
        sleeping_color(first(least))
    }

    /// Island of a degree of freedom.
    pub fn island_of_dof(&self, dof: usize) -> Option<usize> {
        let islands = &self.d.island;
        if islands.nisland == 0 { None } else { usize::try_from(*islands.dof_island.get(dof)?).ok() }
    }

    /// First degree of freedom of the island of a constraint row.
    pub fn first_dof_of_row(&self, row: i32) -> Option<usize> {
        let islands = &self.d.island;
        let row = usize::try_from(row).ok().filter(|_| islands.nisland > 0)?;
        self.first_dof(usize::try_from(*islands.efc_island.get(row)?).ok())
    }

    fn first_dof(&self, island: Option<usize>) -> Option<usize> {
        usize::try_from(self.d.island.island_dofadr[island?]).ok()
    }
}

/// The digits of `index` in `base`, mirrored at the point.
fn radical_inverse(mut index: usize, base: usize) -> f64 {
    let (mut place, mut sum) = (1.0 / base as f64, 0.0);
    while index > 0 {
        sum += place * (index % base) as f64;
        place /= base as f64;
        index /= base;
    }
    sum
}

/// Red, green and blue of hue, saturation and value, all from 0 to 1.
fn rgb(hue: f32, saturation: f32, value: f32) -> [f32; 3] {
    let sector = hue * 6.0;
    let part = sector - sector.floor();
    let low = value * (1.0 - saturation);
    let falling = value * (1.0 - saturation * part);
    let rising = value * (1.0 - saturation * (1.0 - part));
    match sector as usize {
        0 => [value, rising, low],
        1 => [falling, value, low],
        2 => [low, value, rising],
        3 => [low, falling, value],
        4 => [rising, low, value],
        _ => [value, low, falling],
    }
}
