//! `replicate`: numbered copies of a piece of the tree, and of everything that refers into it.

use super::Reader;
use super::tree::Place;
use crate::schema::tree::{REPLICATE_ROWS, Replicate};
use crate::spec::{Body, Frame};
use crate::xml::Element;

impl Reader<'_> {
    pub(super) fn replicate(&mut self, element: &Element, body: &mut Body, place: Place) {
        let class = self.class_of(element, "childclass", place.class);
        let mut wanted = Replicate::default();
        self.rows(element, &REPLICATE_ROWS, &mut wanted);
        let _ = (class, body, Frame::default());
        self.unsupported(element.loc, "replicated bodies");
    }
}
