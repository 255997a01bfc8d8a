//! Cameras and hands of a session.

use super::{Look, Selected, Session};
use crate::camera::{Plane, orbit, pan, zoom};
use crate::hand::{Grip, Hand};
use crate::pointer::{Picked, pick};
use physics::math::{norm, sub};
use render::scene::{Camera, FreeCamera, SceneOptions};
use render::{RenderError, View};

impl Session {
    /// What the camera sees now.
    ///
    /// # Errors
    /// It stands or looks nowhere.
    pub fn view(&self) -> Result<View, RenderError> {
        self.camera.view(&self.model, &self.data)
    }

    /// What is drawn: the options, with the hand.
    pub fn shown(&self) -> SceneOptions {
        self.options.with_selection(self.hand.as_ref().map(Hand::selection))
    }

    /// Moves the camera by a drag in heights of the view. Fixed cameras stay.
    pub fn look(&mut self, look: Look, drag: [f64; 2]) {
        if let Camera::Free(free) = &mut self.camera {
            match look {
                Look::Orbit => orbit(free, drag),
                Look::Pan(plane) => pan(free, plane, drag),
                Look::Zoom => zoom(free, &self.model, drag[1]),
            }
        }
    }

    /// The selected body.
    pub fn selected(&self) -> Option<Selected> {
        self.selected
    }

    /// Selects another body, at its origin, or none.
    pub fn set_selected(&mut self, body: Option<usize>) {
        let is_there = |&body: &usize| (1..self.model.nbody).contains(&body);
        self.selected = body.filter(is_there).map(|body| Selected { body, point: [0.0; 3] });
        self.release();
    }

    /// Selects the parent of the selected body, unless that is the world.
    pub fn select_parent(&mut self) {
        let parent = self.selected.map(|selected| self.model.body_parentid[selected.body] as usize);
        if let Some(parent) = parent.filter(|&parent| parent > 0) {
            self.set_selected(Some(parent));
        }
    }

    /// Selects what is at a place of the picture, from its lower left corner to 1, or nothing.
    pub fn select(&mut self, aspect: f64, at: [f64; 2]) -> Option<Picked> {
        let view = self.view().ok()?;
        let picked =
            pick(&self.model, &self.data, &view, &self.options, aspect, at).filter(|picked| picked.body > 0);
        self.release();
        self.selected = picked.map(|picked| Selected { body: picked.body, point: picked.local });
        picked
    }

    /// Looks at a place of the picture; with `track`, follows its body from now on.
    pub fn look_at(&mut self, aspect: f64, at: [f64; 2], track: bool) {
        let Ok(view) = self.view() else { return };
        let Some(picked) = pick(&self.model, &self.data, &view, &self.options, aspect, at) else { return };
        let distance = sub(picked.point, view.eye);
        let mut free = match self.camera {
            Camera::Free(free) => free,
            Camera::Fixed(_) => FreeCamera { distance: norm(distance), ..FreeCamera::of(&self.model) },
        };
        free.lookat = picked.point;
        free.track = (track && picked.body > 0).then_some(picked.body);
        self.camera = Camera::Free(free);
    }

    /// The next camera: the free one, then those of the model; back with `-1`.
    pub fn cycle_camera(&mut self, by: isize) {
        let count = self.model.ncam as isize + 1;
        let now = match self.camera {
            Camera::Free(_) => 0,
            Camera::Fixed(camera) => camera as isize + 1,
        };
        self.camera = match (now + by).rem_euclid(count) {
            0 => Camera::free(&self.model),
            camera => Camera::Fixed(camera as usize - 1),
        };
    }

    /// Takes hold of what is selected.
    pub fn grab(&mut self, grip: Grip) {
        let (Some(selected), Ok(view)) = (self.selected, self.view()) else { return };
        self.hand = Hand::grab(&self.model, &self.data, &view, grip, selected.body, selected.point);
    }

    /// Moves the hand by a drag in heights of the view.
    pub fn drag(&mut self, plane: Plane, drag: [f64; 2]) {
        let Ok(view) = self.view() else { return };
        if let Some(hand) = &mut self.hand {
            hand.drag(&self.model, &self.data, &view, plane, drag);
        }
    }

    /// Lets go. Forces of the hand end.
    pub fn release(&mut self) {
        if let Some(hand) = self.hand.take() {
            self.data.state.xfrc_applied[hand.body()] = [0.0; 6];
        }
    }

    /// The hand.
    pub fn hand(&self) -> Option<&Hand> {
        self.hand.as_ref()
    }

    /// Whether something is held.
    pub fn holds(&self) -> bool {
        self.hand.is_some()
    }
}
