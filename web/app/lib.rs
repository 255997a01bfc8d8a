//! The window in a page, for the script around it: `Viewer` draws on a canvas, opens `Files` and answers what is asked of it by
//! name. It is a module of its own, twice as large as the one without a window, so that pages which only simulate do not
//! load it.

#[cfg(target_arch = "wasm32")]
mod page;
