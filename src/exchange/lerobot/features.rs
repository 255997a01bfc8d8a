//! What a frame consists of.

use serde_json::{Value, json};

/// Type of a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FeatureKind {
    /// Single precision.
    F32,
    /// Double precision.
    F64,
    /// Integers.
    I64,
    /// Truth values.
    Bool,
    /// Pictures, in the Parquet files.
    Image,
    /// Pictures, in MP4 files.
    Video,
}

/// Names of the types in `info.json`.
const KINDS: [(FeatureKind, &str); 6] = [
    (FeatureKind::F32, "float32"),
    (FeatureKind::F64, "float64"),
    (FeatureKind::I64, "int64"),
    (FeatureKind::Bool, "bool"),
    (FeatureKind::Image, "image"),
    (FeatureKind::Video, "video"),
];

impl FeatureKind {
    /// Its name in `info.json`.
    pub fn name(self) -> &'static str {
        KINDS.iter().find(|(kind, _)| *kind == self).map_or("", |(_, name)| name)
    }

    /// The type of a name in `info.json`.
    pub fn of(name: &str) -> Option<Self> {
        KINDS.iter().find(|(_, other)| *other == name).map(|(kind, _)| *kind)
    }

    /// Whether its values are pictures.
    pub fn is_picture(self) -> bool {
        matches!(self, FeatureKind::Image | FeatureKind::Video)
    }
}

/// A part of every frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Feature {
    /// Name, such as `observation.state`.
    pub name: String,
    /// Type.
    pub kind: FeatureKind,
    /// Shape of a value; height, width, 3 for pictures.
    pub shape: Vec<usize>,
}

/// The features that number the frames of every dataset.
pub const NUMBERING: [(&str, FeatureKind); 5] = [
    ("timestamp", FeatureKind::F32),
    ("frame_index", FeatureKind::I64),
    ("episode_index", FeatureKind::I64),
    ("index", FeatureKind::I64),
    ("task_index", FeatureKind::I64),
];

impl Feature {
    /// As in `info.json`; `fps` are the frames a second.
    pub fn to_json(&self, fps: &Value) -> Value {
        let mut out = json!({ "dtype": self.kind.name(), "shape": self.shape, "names": null });
        if self.kind.is_picture() {
            out["names"] = json!(["height", "width", "channels"]);
        }
        if self.kind == FeatureKind::Video {
            out["info"] = json!({
                "video.height": self.shape[0],
                "video.width": self.shape[1],
                "video.codec": "h264",
                "video.pix_fmt": "yuv420p",
                "video.is_depth_map": false,
                "video.fps": fps,
                "video.channels": 3,
                "has_audio": false,
            });
        }
        out
    }

    /// From an entry of `info.json`; `None` for a type that is not known.
    pub fn from_json(name: &str, entry: &Value) -> Option<Self> {
        let kind = FeatureKind::of(entry.get("dtype")?.as_str()?)?;
        let shape = entry.get("shape")?.as_array()?;
        let shape: Vec<usize> = shape
            .iter()
            .map(|axis| axis.as_u64().and_then(|n| usize::try_from(n).ok()))
            .collect::<Option<_>>()?;
        Some(Feature { name: name.to_owned(), kind, shape })
    }
}
