//! The plugins that every program knows.

use super::{cable, pid, sdf, touch_grid};
use crate::model::{Plugin, Registry};
use std::sync::{Arc, OnceLock};

impl Default for Registry {
    fn default() -> Self {
        static BUILT_IN: OnceLock<Registry> = OnceLock::new();
        BUILT_IN.get_or_init(built_in).clone()
    }
}

/// MuJoCo's plugins, in the order in which its Python package registers them.
fn built_in() -> Registry {
    let plugins: Vec<Arc<dyn Plugin>> = vec![
        Arc::new(pid::Pid),
        Arc::new(cable::Cable),
        Arc::new(touch_grid::TouchGrid),
        Arc::new(sdf::Bolt),
        Arc::new(sdf::Bowl),
        Arc::new(sdf::Gear),
        Arc::new(sdf::Nut),
        Arc::new(sdf::Torus),
    ];
    Registry::of(plugins)
}
