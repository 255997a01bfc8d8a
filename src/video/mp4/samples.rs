//! What is known of a video and of its samples before their description is written.

/// Samples that lie together. A table gives the position of each such group.
pub(super) const GROUP: usize = 32;

/// What is constant throughout a video.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    /// Pixels a row, even.
    pub(crate) width: u32,
    /// Rows, even.
    pub(crate) height: u32,
    /// Units of time a second.
    pub(crate) units_per_second: u32,
    /// Units of time that a sample is shown.
    pub(crate) units_per_sample: u32,
}

/// What is known of the samples.
#[derive(Debug, Default)]
pub(crate) struct Samples {
    /// Bytes of each.
    pub(crate) sizes: Vec<u32>,
    /// Numbers of those that decoding can start at, from 1.
    pub(crate) keys: Vec<u32>,
    /// Position of the first in the file.
    pub(crate) start: u64,
}

impl Samples {
    /// Positions in the file of the groups of [`GROUP`] samples; the last group may have fewer.
    pub(crate) fn groups(&self) -> Vec<u64> {
        let lengths =
            self.sizes.chunks(GROUP).map(|group| group.iter().map(|&size| u64::from(size)).sum::<u64>());
        lengths
            .scan(self.start, |next, length| {
                let position = *next;
                *next += length;
                Some(position)
            })
            .collect()
    }
}
