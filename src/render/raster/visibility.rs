//! Which triangle is seen at every sample.
//!
//! The nearest wins, and of equally near ones that with the larger number, which is drawn later: the result does not depend on
//! the order in which triangles come.

use super::window::coverage::{Pattern, Triangle};
use wide::bytemuck::cast;
use wide::{f32x4, i32x4, u32x4};

/// The number of what is seen in the mirror of a wireframe; larger than that of any triangle or line.
pub const MIRRORED: u32 = i32::MAX as u32;

/// Four samples.
#[derive(Clone, Copy, Debug, Default)]
pub struct Group {
    /// Reversed depth of the nearest triangle; 0 without a triangle.
    pub depth: f32x4,
    /// Its number; 0 for none.
    pub triangle: u32x4,
}

/// A window of samples.
#[derive(Clone, Debug)]
pub struct Visibility {
    /// Where the samples lie.
    pub pattern: Pattern,
    /// Groups in a row.
    pub per_row: usize,
    /// The samples, row by row from below.
    pub groups: Vec<Group>,
}

impl Visibility {
    /// A window without pixels.
    pub fn new(pattern: Pattern) -> Self {
        Visibility { pattern, per_row: 0, groups: Vec::new() }
    }

    /// A window in which nothing is seen yet.
    pub fn clear(&mut self, pattern: Pattern, width: usize, height: usize) {
        (self.pattern, self.per_row) = (pattern, pattern.groups(width));
        self.groups.clear();
        self.groups.resize(self.per_row * height, Group::default());
    }

    /// A window of the shape of another, in which nothing is seen yet.
    pub fn copy_shape(&mut self, other: &Visibility) {
        (self.pattern, self.per_row) = (other.pattern, other.per_row);
        self.groups.clear();
        self.groups.resize(other.groups.len(), Group::default());
    }

    /// A window that shows the same as another, in its own memory.
    pub fn copy(&mut self, other: &Visibility) {
        (self.pattern, self.per_row) = (other.pattern, other.per_row);
        self.groups.clone_from(&other.groups);
    }

    /// Draws a triangle.
    #[inline]
    pub fn draw(&mut self, number: u32, triangle: &Triangle) {
        let (pattern, per_row, groups) = (self.pattern, self.per_row, &mut self.groups[..]);
        let (number, rank) = (u32x4::splat(number), i32x4::splat(number as i32));
        triangle.cover(&pattern, |row, group, mask, depth| {
            let at = &mut groups[row * per_row + group];
            let nearer: i32x4 = cast(depth.simd_gt(at.depth));
            let as_near: i32x4 = cast(depth.simd_eq(at.depth));
            // Numbers are less than 2^31.
            let later = rank.simd_gt(cast::<_, i32x4>(at.triangle));
            let mask: u32x4 = cast(mask & (nearer | (as_near & later)));
            at.triangle = mask.select(number, at.triangle);
            at.depth = cast::<_, f32x4>(mask).select(depth, at.depth);
        });
    }
}
