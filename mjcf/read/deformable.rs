//! `deformable`: flexes between existing bodies, and skins.

use super::reader::Reader;
use crate::schema::flex::{CONTACT_ROWS, EDGE_ROWS, ELASTICITY_ROWS, FLEX_ROWS, LATTICE_ROWS};
use crate::spec::Flex;
use crate::xml::Element;

impl Reader<'_> {
    pub(super) fn deformable(&mut self, section: &Element) {
        section.children_named("skin").for_each(|element| self.skin(element));
        for element in section.children_named("flex") {
            let mut flex = Flex { loc: element.loc, ..Flex::default() };
            self.rows(element, &FLEX_ROWS, &mut flex);
            self.rows(element, &LATTICE_ROWS, &mut flex);
            for child in &element.children {
                match child.name.as_str() {
                    "contact" => self.rows(child, &CONTACT_ROWS, &mut flex),
                    "edge" => self.rows(child, &EDGE_ROWS, &mut flex),
                    "elasticity" => self.rows(child, &ELASTICITY_ROWS, &mut flex),
                    // Refused by the structural check.
                    _ => {}
                }
            }
            self.spec.flexes.push(flex);
        }
    }
}
