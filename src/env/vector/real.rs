//! The two precisions in which batches are handed over.

/// A number of 32 or 64 bits.
pub trait Real: Copy + Default + Send + Sync + 'static {
    /// The nearest number of this precision.
    fn from_f64(value: f64) -> Self;

    /// The same number with 64 bits.
    fn to_f64(self) -> f64;
}

impl Real for f64 {
    fn from_f64(value: f64) -> Self {
        value
    }

    fn to_f64(self) -> f64 {
        self
    }
}

impl Real for f32 {
    fn from_f64(value: f64) -> Self {
        value as f32
    }

    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}
