//! Where the weights of an encoder are on the disk. Nothing is downloaded.
//!
//! ```
//! use robohive_encoders::{Encoding, locate::Search};
//!
//! // What is not there is an error that says where it was looked for.
//! let folder = std::env::temp_dir().join("no-weights-here");
//! let error = Search::folders(vec![folder]).find(Encoding::parse("r3m18")?).unwrap_err();
//! assert!(error.to_string().contains("no-weights-here"), "{error}");
//! # Ok::<(), robohive_encoders::EncoderError>(())
//! ```

use crate::encoding::{Depth, Encoding, Size};
use crate::error::EncoderError;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Environment variable with folders of weights, separated as in `PATH`.
pub const VARIABLE: &str = "ROBOHIVE_WEIGHTS";

/// Folders that are searched for weights.
#[derive(Clone, Debug, Default)]
pub struct Search {
    /// Folders of the user, in which any name of a file will do.
    folders: Vec<PathBuf>,
    /// Where R3M keeps its downloads: `~/.r3m`.
    r3m: Option<PathBuf>,
    /// Where torchvision keeps its downloads: `~/.cache/torch/hub/checkpoints`.
    torch: Option<PathBuf>,
}

impl Search {
    /// Searches these folders only.
    pub fn folders(folders: Vec<PathBuf>) -> Self {
        Search { folders, ..Search::default() }
    }

    /// Searches the folders of [`VARIABLE`], the folder `weights` of the project's data folder, then those in which R3M and
    /// torchvision keep what they downloaded.
    pub fn from_environment(data: Option<&Path>) -> Self {
        Self::by(|name| std::env::var_os(name), data)
    }

    fn by(variable: impl Fn(&str) -> Option<OsString>, data: Option<&Path>) -> Self {
        let set = |name: &str| variable(name).filter(|value| !value.is_empty());
        let listed = set(VARIABLE).unwrap_or_default();
        let listed = std::env::split_paths(&listed).filter(|folder| !folder.as_os_str().is_empty());
        let home = set("HOME").or_else(|| set("USERPROFILE")).map(PathBuf::from);
        let cache = set("XDG_CACHE_HOME").map(PathBuf::from).or_else(|| Some(home.as_ref()?.join(".cache")));
        let torch = set("TORCH_HOME").map(PathBuf::from).or_else(|| Some(cache?.join("torch")));
        Search {
            folders: listed.chain(data.map(|folder| folder.join("weights"))).collect(),
            r3m: home.map(|home| home.join(".r3m")),
            torch: torch.map(|torch| torch.join("hub").join("checkpoints")),
        }
    }

    /// Files that may hold the weights of an encoder, in the order in which they are tried.
    pub fn candidates(&self, encoding: Encoding) -> Vec<PathBuf> {
        let Some(published) = Published::of(encoding) else { return Vec::new() };
        let own = ["safetensors", "pt", "pth", "ckpt"].map(|ending| format!("{encoding}.{ending}"));
        let names: Vec<&str> = own.iter().map(String::as_str).chain([published.file]).collect();
        let named = self.folders.iter().flat_map(|folder| names.iter().map(move |name| folder.join(name)));
        let kept = match encoding {
            Encoding::R3m(_) => &self.r3m,
            Encoding::Rrl(_) => &self.torch,
            _ => &None,
        };
        named.chain(kept.iter().map(|folder| folder.join(published.file))).collect()
    }

    /// The file with the weights of an encoder.
    ///
    /// # Errors
    /// [`EncoderError::NotFound`]: there is none; which file from which project to put where.
    /// [`EncoderError::TakesNoWeights`]: the encoder is no network.
    pub fn find(&self, encoding: Encoding) -> Result<PathBuf, EncoderError> {
        let published =
            Published::of(encoding).ok_or(EncoderError::TakesNoWeights { encoding: encoding.name() })?;
        let searched = self.candidates(encoding);
        if let Some(path) = searched.iter().find(|path| path.is_file()) {
            return Ok(path.clone());
        }
        let place = match self.folders.first() {
            Some(folder) => format!("in {}", folder.display()),
            None => format!("in a folder that {VARIABLE} names"),
        };
        let remedy = format!(
            "download {} of {} ({}) and put it {place}; {encoding}.safetensors with the same tensors will do as well",
            published.file, published.project, published.source
        );
        Err(EncoderError::NotFound { encoding: encoding.name(), searched, remedy })
    }
}

/// What the authors of a network published.
struct Published {
    file: &'static str,
    project: &'static str,
    source: &'static str,
}

impl Published {
    fn of(encoding: Encoding) -> Option<Self> {
        let (file, project, source) = match encoding {
            Encoding::Flat | Encoding::Picture => return None,
            Encoding::R3m(depth) => {
                let file = match depth {
                    Depth::D18 => "r3m_18/model.pt",
                    Depth::D34 => "r3m_34/model.pt",
                    Depth::D50 => "r3m_50/model.pt",
                };
                (file, "R3M", "https://github.com/facebookresearch/r3m, function load_r3m")
            }
            Encoding::Rrl(depth) => {
                let (file, source) = match depth {
                    Depth::D18 => {
                        ("resnet18-f37072fd.pth", "https://download.pytorch.org/models/resnet18-f37072fd.pth")
                    }
                    Depth::D34 => {
                        ("resnet34-b627a593.pth", "https://download.pytorch.org/models/resnet34-b627a593.pth")
                    }
                    Depth::D50 => {
                        ("resnet50-0676ba61.pth", "https://download.pytorch.org/models/resnet50-0676ba61.pth")
                    }
                };
                (file, "torchvision", source)
            }
            Encoding::Vc1(size) => {
                let (file, source) = match size {
                    Size::Base => ("vc1_vitb.pth", "https://dl.fbaipublicfiles.com/eai-vc/vc1_vitb.pth"),
                    Size::Large => ("vc1_vitl.pth", "https://dl.fbaipublicfiles.com/eai-vc/vc1_vitl.pth"),
                };
                (file, "VC-1", source)
            }
        };
        Some(Published { file, project, source })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_follow_the_environment() {
        let variable = |name: &str| match name {
            "HOME" => Some("/home/me".into()),
            VARIABLE => Some(std::env::join_paths(["/first", "/second"]).unwrap()),
            _ => None,
        };
        let search = Search::by(variable, Some(Path::new("/data")));
        let r3m = search.candidates(Encoding::R3m(Depth::D18));
        assert_eq!(r3m[0], Path::new("/first/r3m18.safetensors"));
        assert!(
            r3m.contains(&"/second/r3m_18/model.pt".into()) && r3m.contains(&"/data/weights/r3m18.pt".into())
        );
        assert_eq!(r3m.last().unwrap(), Path::new("/home/me/.r3m/r3m_18/model.pt"));
        let rrl = search.candidates(Encoding::Rrl(Depth::D50));
        let kept = Path::new("/home/me/.cache/torch/hub/checkpoints/resnet50-0676ba61.pth");
        assert_eq!(rrl.last().unwrap(), kept);
    }

    #[test]
    fn what_is_missing_is_named_with_its_source_and_place() {
        let search = Search::folders(vec!["/no/such/folder".into()]);
        let message = search.find(Encoding::Vc1(Size::Base)).unwrap_err().to_string();
        for part in ["vc1s", "vc1_vitb.pth", "VC-1", "https://dl.fbaipublicfiles.com", "/no/such/folder"] {
            assert!(message.contains(part), "{part} in {message}");
        }
        let error = search.find(Encoding::Flat).unwrap_err();
        assert_eq!(error, EncoderError::TakesNoWeights { encoding: "1d" });
    }
}
