//! Pre-trained picture encoders as RoboHive's visual keys name them: `1d` and `2d` pass the bytes of a picture on; `r3m18`,
//! `r3m34`, `r3m50` (R3M) and `rrl18`, `rrl34`, `rrl50` (RRL) are ResNets, `vc1s` and `vc1l` (VC-1) vision transformers.
//!
//! The networks need the feature `networks` and weights that their authors publish. Nothing is downloaded: [`locate`] searches
//! the folders in which a user, R3M or torchvision keeps them, and says which file from where is missing.
//!
//! ```
//! use robohive_encoders::{Encoder, Encoding, Picture, Profile};
//!
//! let encoding = Encoding::parse("1d")?;
//! assert_eq!(encoding.output_len(2, 1), 6);
//! let encoder = Encoder::identity(encoding)?;
//! let picture = Picture::new(2, 1, &[1, 2, 3, 4, 5, 6])?;
//! assert_eq!(encoder.encode(&[picture]), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
//! # Ok::<(), robohive_encoders::EncoderError>(())
//! ```
//!
//! | step | module | result |
//! |---|---|---|
//! | name | [`Encoding`] | which network, how many numbers |
//! | search | [`locate`] | the file with its weights |
//! | read | `weights` | tensors of a safetensors file or PyTorch archive, by name and shape |
//! | prepare | `prepare`, `resample` | 3 × 224 × 224 numbers, as torchvision and Pillow compute them |
//! | run | `networks` | features of the picture |

mod encoder;
mod encoding;
mod error;
pub mod locate;
mod picture;

// Steps of an encoder, one at a time: what tests and comparisons call, and programs do not need.
#[cfg(feature = "networks")]
#[doc(hidden)]
pub mod networks;
#[doc(hidden)]
pub mod prepare;
#[doc(hidden)]
pub mod resample;
#[cfg(feature = "networks")]
#[doc(hidden)]
pub mod weights;

pub use encoder::Encoder;
pub use encoding::{Depth, Encoding, Size};
pub use error::EncoderError;
pub use picture::Picture;
pub use prepare::Profile;
