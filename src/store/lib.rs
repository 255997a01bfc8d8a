//! Model files that belong to others, imported once and then found by virtual path.
//!
//! RoboHive's models, meshes and motions come from its own repositories. An import takes them from a checkout, a wheel or an
//! archive into a store on the user's disk; from then on `envs/…` and `simhive/…` name them, and no network is needed.
//!
//! A store is a folder:
//!
//! | inside | what it holds |
//! |---|---|
//! | `manifest` | one line a file: digest, size, licence, source, virtual path; renamed into place, so always whole |
//! | `objects/` | contents, each named by its SHA-256 digest |
//! | `tree/` | the virtual paths as real ones, hard links to objects where the file system has them, else copies |
//! | `tree.stamp` | digest of the manifest that `tree/` shows |
//! | `staging/` | what a running import has read; the next import removes what a killed one left |
//! | `lock` | held by an import while it runs, released by the system when its process ends |
//!
//! The manifest decides. An import that is killed before its manifest is in place has changed nothing that can be
//! resolved; killed after that, the next [`Store::open`] completes the tree. Writes are not forced to the disk: what a
//! failure of power lost, [`Store::verify`] names, and the same import repairs.
//!
//! ```
//! use robohive_store::{ImportOptions, Store};
//!
//! let folder = std::env::temp_dir().join(format!("robohive-store-{}", std::process::id()));
//! let source = folder.join("checkout/robohive/envs/arms");
//! std::fs::create_dir_all(&source)?;
//! std::fs::write(source.join("reach.xml"), "<mujoco/>")?;
//!
//! let mut store = Store::open(folder.join("store"))?;
//! let imported = store.import(&folder.join("checkout"), &ImportOptions::default(), &mut |_| ())?;
//! assert_eq!(imported.added, 1);
//! let path = store.resolve("envs/arms/reach.xml")?;
//! assert_eq!(std::fs::read_to_string(path)?, "<mujoco/>");
//! # std::fs::remove_dir_all(folder)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod commit;
mod digest;
mod entry_path;
mod error;
mod folder;
mod import;
mod intake;
mod layout;
mod licence;
mod limits;
mod lock;
mod manifest;
mod merge;
mod progress;
mod resolve;
mod source;
mod store;
mod surroundings;
mod tar;
mod tree;
mod verify;
mod zip_archive;

pub use digest::Digest;
pub use error::StoreError;
pub use import::{ImportOptions, Imported};
pub use intake::Skipped;
pub use licence::Licence;
pub use limits::Limits;
pub use manifest::Entry;
pub use progress::Progress;
pub use resolve::{Search, default_folder};
pub use store::Store;
pub use verify::{Damage, Fault};
