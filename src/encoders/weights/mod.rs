//! Tensors of files with weights: safetensors, and what `torch.save` wrote, as a zip archive or in its form before 1.6.
//!
//! Opening a file reads its list of tensors; their numbers are read one tensor at a time. The pickles in files of PyTorch are
//! read without being executed. What a file may ask for is bounded by its own length and by these limits:
//!
//! | what | bound |
//! |---|---|
//! | header of a safetensors file | 4 MiB |
//! | pickle of a PyTorch file, or what precedes its storages | 4 MiB |
//! | tensors | 65,536 |
//! | numbers of a tensor | 2²⁶ |

mod file;
mod parameters;
mod safetensors;
mod tensor;
mod torch;

pub use file::{MAX_TENSORS, WeightFile};
pub use parameters::{Naming, Parameter, Parameters};
pub use safetensors::MAX_HEADER;
pub use tensor::MAX_NUMBERS;
pub use torch::MAX_PICKLE;
