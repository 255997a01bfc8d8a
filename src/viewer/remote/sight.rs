//! Cameras and visual options on their way between processes, by MuJoCo's numbers.

use super::wire::{Wire, WireError, record};
use crate::command::{FRAMES, LABELS};
use crate::flags::{EFFECTS, SHOW};
use render::scene::{Camera, Effects, FreeCamera, GROUPS, Groups, SceneOptions, Show};

/// What a person sees a simulation with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// The camera.
    pub camera: Camera,
    /// What is shown.
    pub options: SceneOptions,
}

record!(Sight { camera, options });
record!(FreeCamera { lookat, track, distance, azimuth, elevation, orthographic, fovy });
record!(Groups { geoms, sites, joints, tendons, actuators, skins, flexes });

/// The numbers of visual options, in MuJoCo's order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OptionCodes {
    /// Visible groups of geoms, sites, joints, tendons, actuators, flexes and skins, as `mjvOption` has them.
    pub groups: [[bool; GROUPS]; 7],
    /// Rows of [`SHOW`].
    pub show: [bool; SHOW.len()],
    /// Rows of [`EFFECTS`].
    pub effects: [bool; EFFECTS.len()],
    /// Place in [`LABELS`].
    pub label: usize,
    /// Place in [`FRAMES`].
    pub frame: usize,
    /// Depth of bounding volumes.
    pub tree_depth: i32,
    /// Layer of flexes.
    pub flex_layer: i32,
}

record!(OptionCodes { groups, show, effects, label, frame, tree_depth, flex_layer });

impl OptionCodes {
    /// The numbers of these options.
    pub fn of(options: &SceneOptions) -> Self {
        let Groups { geoms, sites, joints, tendons, actuators, skins, flexes } = options.groups;
        OptionCodes {
            groups: [geoms, sites, joints, tendons, actuators, flexes, skins],
            show: SHOW.map(|flag| flag.get(options.show)),
            effects: EFFECTS.map(|flag| flag.get(options.effects)),
            label: LABELS.iter().position(|(_, label)| *label == options.label).unwrap_or(0),
            frame: FRAMES.iter().position(|(_, frame)| *frame == options.frame).unwrap_or(0),
            tree_depth: options.tree_depth,
            flex_layer: options.flex_layer,
        }
    }

    /// The options of these numbers; kinds of labels and frames that there are not count as none.
    pub fn options(&self) -> SceneOptions {
        let [geoms, sites, joints, tendons, actuators, flexes, skins] = self.groups;
        let (mut show, mut effects) = (Show::default(), Effects::default());
        SHOW.iter().zip(self.show).for_each(|(flag, on)| *flag.of(&mut show) = on);
        EFFECTS.iter().zip(self.effects).for_each(|(flag, on)| *flag.of(&mut effects) = on);
        SceneOptions::default()
            .with_groups(Groups { geoms, sites, joints, tendons, actuators, skins, flexes })
            .with_show(show)
            .with_effects(effects)
            .with_label(LABELS.get(self.label).unwrap_or(&LABELS[0]).1)
            .with_frame(FRAMES.get(self.frame).unwrap_or(&FRAMES[0]).1)
            .with_tree_depth(self.tree_depth)
            .with_flex_layer(self.flex_layer)
    }
}

impl Wire for SceneOptions {
    fn put(&self, out: &mut Vec<u8>) {
        OptionCodes::of(self).put(out);
    }

    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        OptionCodes::take(from).map(|codes| codes.options())
    }
}

impl Wire for Camera {
    fn put(&self, out: &mut Vec<u8>) {
        match self {
            Camera::Free(free) => Some(*free).put(out),
            Camera::Fixed(camera) => {
                None::<FreeCamera>.put(out);
                camera.put(out);
            }
        }
    }

    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        Ok(match <Option<FreeCamera> as Wire>::take(from)? {
            Some(free) => Camera::Free(free),
            None => Camera::Fixed(usize::take(from)?),
        })
    }
}
