//! What a key, a button or a script can ask a session for.

use crate::flags::{EFFECTS, SHOW};
use crate::session::Session;
use render::scene::{Camera, FrameChoice, GROUPS, LabelChoice};

/// A command without arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Lets time go by, or stops it.
    Run,
    /// One state forward.
    StepForward,
    /// One state back.
    StepBack,
    /// The next faster speed.
    Faster,
    /// The next slower speed.
    Slower,
    /// The first keyframe, or the reference.
    Reset,
    /// The camera that stands free, at its start.
    AlignCamera,
    /// From a camera of the model to the free one.
    FreeCamera,
    /// The next camera.
    NextCamera,
    /// The camera before.
    PreviousCamera,
    /// The parent of the selected body.
    SelectParent,
    /// Frames of the next kind of elements.
    NextFrames,
    /// Labels of the next kind of elements.
    NextLabels,
    /// A row of [`SHOW`].
    Show(usize),
    /// A row of [`EFFECTS`].
    Effect(usize),
    /// A group of geoms.
    Geoms(usize),
    /// A group of sites.
    Sites(usize),
}

/// A command with its key and its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shortcut {
    /// The key, as egui and browsers name it; `Shift+` and `Ctrl+` go before it.
    pub key: String,
    /// What people call it.
    pub name: String,
    /// The command.
    pub command: Command,
}

/// Commands that are no switches.
const PLAIN: [(&str, &str, Command); 13] = [
    ("Space", "Run or pause", Command::Run),
    ("ArrowRight", "One step forward", Command::StepForward),
    ("ArrowLeft", "One state back", Command::StepBack),
    ("Equals", "Faster", Command::Faster),
    ("Minus", "Slower", Command::Slower),
    ("Backspace", "Reset", Command::Reset),
    ("Ctrl+A", "Align the free camera", Command::AlignCamera),
    ("Escape", "Free camera", Command::FreeCamera),
    ("CloseBracket", "Next camera", Command::NextCamera),
    ("OpenBracket", "Camera before", Command::PreviousCamera),
    ("PageUp", "Select the parent", Command::SelectParent),
    ("F6", "Frames of the next kind", Command::NextFrames),
    ("F7", "Labels of the next kind", Command::NextLabels),
];

/// Every command that has a key.
pub fn shortcuts() -> Vec<Shortcut> {
    let row = |key: String, name: String, command| Shortcut { key, name, command };
    let plain = PLAIN.into_iter().map(|(key, name, command)| row(key.into(), name.into(), command));
    let shown = SHOW.iter().map(|flag| (flag.name, flag.key)).enumerate();
    let shown = shown.filter_map(|(i, (name, key))| Some(row(key?.into(), name.into(), Command::Show(i))));
    let effects = EFFECTS.iter().map(|flag| (flag.name, flag.key)).enumerate();
    let effects =
        effects.filter_map(|(i, (name, key))| Some(row(key?.into(), name.into(), Command::Effect(i))));
    let geoms = (0..GROUPS).map(|i| row(format!("{i}"), format!("Geoms of group {i}"), Command::Geoms(i)));
    let sites =
        (0..GROUPS).map(|i| row(format!("Shift+{i}"), format!("Sites of group {i}"), Command::Sites(i)));
    plain.chain(shown).chain(effects).chain(geoms).chain(sites).collect()
}

/// Kinds of elements that can have labels, with their names, in the order of [`Command::NextLabels`].
pub const LABELS: [(&str, LabelChoice); 17] = [
    ("None", LabelChoice::None),
    ("Body", LabelChoice::Body),
    ("Joint", LabelChoice::Joint),
    ("Geom", LabelChoice::Geom),
    ("Site", LabelChoice::Site),
    ("Camera", LabelChoice::Camera),
    ("Light", LabelChoice::Light),
    ("Tendon", LabelChoice::Tendon),
    ("Actuator", LabelChoice::Actuator),
    ("Constraint", LabelChoice::Constraint),
    ("Flex", LabelChoice::Flex),
    ("Skin", LabelChoice::Skin),
    ("Selection", LabelChoice::Selection),
    ("Selected point", LabelChoice::SelectedPoint),
    ("Contact point", LabelChoice::ContactPoint),
    ("Contact force", LabelChoice::ContactForce),
    ("Island", LabelChoice::Island),
];

/// Kinds of elements that can show their frames, with their names, in the order of [`Command::NextFrames`].
pub const FRAMES: [(&str, FrameChoice); 8] = [
    ("None", FrameChoice::None),
    ("Body", FrameChoice::Body),
    ("Geom", FrameChoice::Geom),
    ("Site", FrameChoice::Site),
    ("Camera", FrameChoice::Camera),
    ("Light", FrameChoice::Light),
    ("Contact", FrameChoice::Contact),
    ("World", FrameChoice::World),
];

/// What follows `now` in a list, the first after the last.
fn next<T: Copy + PartialEq>(list: &[(&str, T)], now: T) -> T {
    let at = list.iter().position(|&(_, value)| value == now).unwrap_or(0);
    list[(at + 1) % list.len()].1
}

impl Session {
    /// Does what a command says.
    pub fn perform(&mut self, command: Command) {
        let options = &mut self.options;
        let turn = |on: &mut bool| *on = !*on;
        match command {
            Command::Run => self.run(!self.is_running()),
            Command::StepForward => self.step_forward(),
            Command::StepBack => self.step_back(),
            Command::Faster => self.pace_mut().faster(),
            Command::Slower => self.pace_mut().slower(),
            Command::Reset => self.reset(),
            Command::AlignCamera => self.camera = Camera::free(self.model()),
            Command::FreeCamera => {
                if let Camera::Fixed(_) = self.camera {
                    self.camera = Camera::free(self.model());
                }
            }
            Command::NextCamera => self.cycle_camera(1),
            Command::PreviousCamera => self.cycle_camera(-1),
            Command::SelectParent => self.select_parent(),
            Command::NextFrames => options.frame = next(&FRAMES, options.frame),
            Command::NextLabels => options.label = next(&LABELS, options.label),
            Command::Show(row) => SHOW.get(row).map(|flag| flag.of(&mut options.show)).map_or((), turn),
            Command::Effect(row) => {
                EFFECTS.get(row).map(|flag| flag.of(&mut options.effects)).map_or((), turn)
            }
            Command::Geoms(group) => options.groups.geoms.get_mut(group).map_or((), turn),
            Command::Sites(group) => options.groups.sites.get_mut(group).map_or((), turn),
        }
    }
}
