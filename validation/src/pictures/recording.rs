//! What `reference/pictures.py` recorded of a scene.

use super::measures::Geometry;
use super::plan::{Effect, SceneRow};
use dataset::{Array, NpzReader, Values};
use render::Profile;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The recorded pictures of one scene.
pub struct Recording {
    archive: NpzReader,
    meta: Value,
    path: PathBuf,
}

impl Recording {
    /// Reads the recording of a scene from a folder.
    ///
    /// # Errors
    /// There is none, or it is of another model or camera.
    pub fn open(folder: &Path, scene: &SceneRow) -> Result<Self, String> {
        let path = folder.join(format!("{}.npz", scene.name));
        let archive = NpzReader::open(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let mut recording = Recording { archive, meta: Value::Null, path };
        let meta = recording.bytes("meta")?;
        recording.meta =
            serde_json::from_slice(&meta).map_err(|error| recording.error(&error.to_string()))?;
        let recorded = |key: &str| recording.meta["scene"][key].as_str();
        let effects: Vec<Effect> = match &recording.meta["scene"]["effects"] {
            // Recordings from before there were effects name none.
            Value::Null => Vec::new(),
            named => serde_json::from_value(named.clone())
                .map_err(|error| recording.error(&format!("effects: {error}")))?,
        };
        let same = recorded("file") == Some(&scene.file) && recorded("camera") == scene.camera.as_deref();
        if !same || effects != scene.effects {
            return Err(recording
                .error("recorded of another model or camera, or with other effects; record it again"));
        }
        Ok(recording)
    }

    /// An array; an error names the file.
    fn require(&self, name: &str) -> Result<Array, String> {
        self.archive.require(name).map_err(|error| self.error(&error.to_string()))
    }

    fn error(&self, message: &str) -> String {
        format!("{}: {message}", self.path.display())
    }

    fn bytes(&self, name: &str) -> Result<Vec<u8>, String> {
        match self.require(name)?.values {
            Values::U8(bytes) => Ok(bytes),
            _ => Err(self.error(&format!("{name} holds no bytes"))),
        }
    }

    /// Which MuJoCo drew it.
    ///
    /// # Errors
    /// A version that we do not follow.
    pub fn profile(&self) -> Result<Profile, String> {
        match self.meta["mujoco"].as_str() {
            Some("3.12.0") => Ok(Profile::Mujoco312),
            Some("3.1.3") => Ok(Profile::Mujoco313),
            other => Err(self.error(&format!("drawn by version {other:?} of MuJoCo"))),
        }
    }

    /// Whether there is an array of this name.
    pub fn has(&self, name: &str) -> bool {
        self.archive.contains(name)
    }

    /// Numbers of an array.
    ///
    /// # Errors
    /// There is no such array.
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, String> {
        Ok(self.require(name)?.values.to_f64())
    }

    /// Rows of `N` numbers.
    ///
    /// # Errors
    /// There is no such array, or its rows are of another length.
    pub fn rows<const N: usize>(&self, name: &str) -> Result<Vec<[f64; N]>, String> {
        let values = self.numbers(name)?;
        let (rows, rest) = values.as_chunks::<N>();
        if rest.is_empty() {
            Ok(rows.to_vec())
        } else {
            Err(self.error(&format!("{name} has no rows of {N}")))
        }
    }

    /// Colours of a square picture, `kind` as recorded: `rgb`, `rgb_no_shadow` or `rgb_1`.
    ///
    /// # Errors
    /// There is none, or it is of another size.
    pub fn colours(&self, side: usize, kind: &str) -> Result<Vec<u8>, String> {
        let bytes = self.bytes(&format!("{side}/{kind}"))?;
        if bytes.len() == 3 * side * side {
            Ok(bytes)
        } else {
            Err(self.error(&format!("{side}/{kind} is of another size")))
        }
    }

    /// Depth and segmentation of a square picture.
    ///
    /// # Errors
    /// There are none, or of another size.
    pub fn geometry(&self, side: usize) -> Result<Geometry, String> {
        let depth =
            self.numbers(&format!("{side}/depth"))?.into_iter().map(|depth| depth as f32).collect::<Vec<_>>();
        let ids: Vec<_> =
            self.rows::<2>(&format!("{side}/ids"))?.into_iter().map(|id| id.map(|x| x as i32)).collect();
        if depth.len() == side * side && ids.len() == side * side {
            Ok(Geometry { width: side, depth, ids })
        } else {
            Err(self.error(&format!("{side}/depth or {side}/ids is of another size")))
        }
    }
}
