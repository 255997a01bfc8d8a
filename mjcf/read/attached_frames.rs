//! Frames in what is attached: copies of those around it, and what stands in one.

use super::copy::{Affix, elements};
use crate::spec::{Body, Frame};
use std::collections::BTreeMap;

/// Frames copied when something asks for them.
pub(super) struct FrameCopies<'a> {
    pub from: &'a [Frame],
    pub to: &'a mut Vec<Frame>,
    pub copied: BTreeMap<usize, usize>,
    pub affix: &'a Affix<'a>,
}

impl FrameCopies<'_> {
    /// The copy of a frame; the outermost one stands in `base`.
    pub fn of(&mut self, frame: Option<usize>, base: Option<usize>) -> Option<usize> {
        let mut missing = Vec::new();
        let mut next = frame;
        let mut parent = base;
        while let Some(old) = next {
            if let Some(&new) = self.copied.get(&old) {
                parent = Some(new);
                break;
            }
            missing.push(old);
            next = self.from[old].parent;
        }
        for old in missing.into_iter().rev() {
            parent = Some(self.add(old, parent));
        }
        parent
    }

    pub fn add(&mut self, old: usize, parent: Option<usize>) -> usize {
        let mut frame = Frame { parent, ..self.from[old].clone() };
        self.affix.apply(&mut frame.name);
        self.to.push(frame);
        self.copied.insert(old, self.to.len() - 1);
        self.to.len() - 1
    }
}

pub(super) fn missing(kind: &str, name: &str) -> String {
    format!("no {kind} is named '{name}' in the model that parts are attached from")
}

pub(super) fn find_frame(frames: &[Frame], name: &str) -> Result<usize, String> {
    frames.iter().position(|f| f.name == name).ok_or_else(|| missing("frame", name))
}

/// Whether `frame` is `top` or stands inside it.
pub(super) fn within(frame: Option<usize>, top: usize, frames: &[Frame]) -> bool {
    let mut next = frame;
    while let Some(frame) = next {
        if frame == top {
            return true;
        }
        next = frames[frame].parent;
    }
    false
}

/// The contents of the frame `top`, which stands in `body` or below.
pub(super) fn holder(body: &Body, top: usize, frames: &[Frame]) -> Option<Body> {
    let inside = |frame| within(frame, top, frames);
    let contents = Body {
        joints: body.joints.iter().filter(|x| inside(x.frame)).cloned().collect(),
        geoms: body.geoms.iter().filter(|x| inside(x.frame)).cloned().collect(),
        sites: body.sites.iter().filter(|x| inside(x.frame)).cloned().collect(),
        cameras: body.cameras.iter().filter(|x| inside(x.frame)).cloned().collect(),
        lights: body.lights.iter().filter(|x| inside(x.frame)).cloned().collect(),
        bodies: body.bodies.iter().filter(|x| inside(x.frame)).cloned().collect(),
        ..Body::default()
    };
    if elements(&contents) > 1 {
        return Some(contents);
    }
    body.bodies.iter().find_map(|b| holder(b, top, frames))
}
