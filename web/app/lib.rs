//! The window in a page, for the script around it: [`Viewer`](page::Viewer) draws on a canvas, opens [`Files`](files::Files)
//! and answers what is asked of it by name. It is a module of its own, so that pages which only simulate do not load it.

#[cfg(target_arch = "wasm32")]
mod files;
#[cfg(target_arch = "wasm32")]
mod page;
