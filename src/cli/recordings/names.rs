//! Names of layouts, precisions and forms of pictures in arguments.

use clap::ValueEnum;
use dataset::trace::{Layout, Precision};
use exchange::lerobot::Pictures;

/// Names of rows in the files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LayoutName {
    /// By environment: time, observations, actions, rewards, done, env_infos/...
    Robohive,
    /// By robot: data/..., derived/..., config/...
    Roboset,
}

impl From<LayoutName> for Layout {
    fn from(name: LayoutName) -> Self {
        match name {
            LayoutName::Robohive => Layout::RoboHive,
            LayoutName::Roboset => Layout::RoboSet,
        }
    }
}

/// How a dataset of LeRobot keeps pictures.
#[derive(Clone, Copy, ValueEnum)]
pub enum PictureForm {
    /// H.264 in MP4 files, with a small loss
    Video,
    /// PNG in the tables, without loss
    Png,
}

impl From<PictureForm> for Pictures {
    fn from(form: PictureForm) -> Self {
        match form {
            PictureForm::Video => Pictures::Video,
            PictureForm::Png => Pictures::Png,
        }
    }
}

/// Bits of numbers in the files.
#[derive(Clone, Copy, ValueEnum)]
pub enum PrecisionName {
    /// All bits
    Full,
    /// Uint8, int8, float16
    Reduced,
}

impl From<PrecisionName> for Precision {
    fn from(name: PrecisionName) -> Self {
        match name {
            PrecisionName::Full => Precision::Full,
            PrecisionName::Reduced => Precision::Reduced,
        }
    }
}
