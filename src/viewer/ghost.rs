//! What is drawn of a second state: its moving geoms, translucent and in a colour of their own.

use physics::{Data, Model};
use render::scene::{Category, Item, Scene, SceneOptions, Show};
use render::{RenderError, View};

/// The colour, and how much of the element's own is left in it.
const TINT: [f32; 3] = [1.0, 0.45, 0.1];
const OWN: f32 = 0.3;
/// Opacity.
const ALPHA: f32 = 0.4;

/// Items of a second state, kept to be filled again.
#[derive(Default)]
pub(crate) struct Ghost {
    scene: Scene,
}

impl Ghost {
    /// Adds the moving items of `data` to a scene of the same model seen from `view`.
    ///
    /// # Errors
    /// An item has no place.
    pub(crate) fn haunt(
        &mut self,
        scene: &mut Scene,
        model: &Model,
        data: &Data,
        view: View,
        options: &SceneOptions,
    ) -> Result<(), RenderError> {
        // Skins and flexes are posed for one state alone.
        let shown = Show { skins: false, flex_skins: false, flex_faces: false, ..Show::default() };
        let plain = SceneOptions::default().with_groups(options.groups).with_show(shown);
        self.scene.update(model, data, view, &plain)?;
        let moving = self.scene.items.drain(..).filter(|item| item.category == Category::Dynamic);
        scene.items.extend(moving.map(translucent));
        Ok(())
    }
}

fn translucent(mut item: Item) -> Item {
    let [r, g, b, alpha] = item.rgba;
    let mixed = [r, g, b].map(|c| OWN * c);
    let mixed: [f32; 3] = std::array::from_fn(|k| mixed[k] + (1.0 - OWN) * TINT[k]);
    item.rgba = [mixed[0], mixed[1], mixed[2], ALPHA * alpha];
    item.material = None;
    item.unlisted = true;
    item.label.clear();
    item
}
