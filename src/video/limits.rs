//! What pictures and videos of every format keep to.

use std::ops::RangeInclusive;

/// Most pixels of a side of any picture.
pub const MAX_SIDE: u32 = 16384;

/// Frames per second of a video.
pub const FRAME_RATES: RangeInclusive<f64> = 0.1..=1000.0;
