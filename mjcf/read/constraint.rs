//! `contact`, `equality` and `tendon`.

use physics::model::{EqType, ObjType};

use super::reader::Reader;
use crate::schema::constraint::{
    EQUALITIES, EQUALITY_ROWS, EXCLUDE_ROWS, PAIR_ROWS, PATH_GEOM_ROWS, PATH_JOINT_ROWS, PATH_SITE_ROWS,
    PULLEY_ROWS, PathElement, TENDON_LOOKS, TENDON_ROWS, equality_blocks,
};
use crate::spec::{Equality, Exclude, Pair, Tendon, Wrap, WrapKind};
use crate::xml::Element;

impl Reader<'_> {
    pub(super) fn contact(&mut self, section: &Element) {
        for element in section.children_named("pair") {
            let class = self.class_of(element, "class", 0);
            let mut pair = Pair { loc: element.loc, ..self.spec.classes.of(class).pair.clone() };
            self.rows(element, &PAIR_ROWS, &mut pair);
            self.spec.pairs.push(pair);
        }
        for element in section.children_named("exclude") {
            let mut exclude = Exclude { loc: element.loc, ..Exclude::default() };
            self.rows(element, &EXCLUDE_ROWS, &mut exclude);
            self.spec.excludes.push(exclude);
        }
    }

    pub(super) fn equality(&mut self, section: &Element) {
        for element in &section.children {
            // The structural check refuses all others.
            let Some((_, kind)) = EQUALITIES.iter().find(|(tag, _)| *tag == element.name) else { continue };
            let class = self.class_of(element, "class", 0);
            let inherited = self.spec.classes.of(class).equality.clone();
            let mut equality = Equality { loc: element.loc, kind: *kind, ..inherited };
            self.rows(element, &EQUALITY_ROWS, &mut equality);
            for block in equality_blocks(*kind) {
                self.rows(element, block, &mut equality);
            }
            equality.objtype = match kind {
                EqType::Joint => ObjType::Joint,
                EqType::Tendon => ObjType::Tendon,
                EqType::Flex | EqType::Flexvert | EqType::Flexstrain => ObjType::Flex,
                _ if element.attribute("site1").is_some() => ObjType::Site,
                _ => ObjType::Body,
            };
            let welds_bodies = *kind == EqType::Weld && equality.objtype == ObjType::Body;
            if welds_bodies && element.attribute("anchor").is_none() {
                equality.data[..3].fill(0.0);
            }
            self.spec.equalities.push(equality);
        }
    }

    pub(super) fn tendon(&mut self, section: &Element) {
        for element in &section.children {
            let class = self.class_of(element, "class", 0);
            let mut tendon = Tendon { loc: element.loc, ..self.spec.classes.of(class).tendon.clone() };
            self.rows(element, &TENDON_ROWS, &mut tendon);
            self.rows(element, &TENDON_LOOKS, &mut tendon);
            self.spring_length(element, &mut tendon);
            tendon.path = element.children.iter().filter_map(|child| self.path_element(child)).collect();
            self.spec.tendons.push(tendon);
        }
    }

    /// One number is the length at rest; two span a range without force.
    pub(super) fn spring_length(&mut self, element: &Element, tendon: &mut Tendon) {
        if let Some(attribute) = element.attribute("springlength")
            && let Some(values) = self.between::<f64>(element, attribute, 1, 2)
        {
            tendon.springlength = [values[0], values[values.len() - 1]];
        }
    }

    fn path_element(&mut self, element: &Element) -> Option<Wrap> {
        let mut path = PathElement::default();
        let kind = match element.name.as_str() {
            "site" => {
                self.rows(element, &PATH_SITE_ROWS, &mut path);
                WrapKind::Site { site: path.target }
            }
            "geom" => {
                self.rows(element, &PATH_GEOM_ROWS, &mut path);
                WrapKind::Geom { geom: path.target, sidesite: path.sidesite }
            }
            "pulley" => {
                self.rows(element, &PULLEY_ROWS, &mut path);
                WrapKind::Pulley { divisor: path.number }
            }
            "joint" => {
                self.rows(element, &PATH_JOINT_ROWS, &mut path);
                WrapKind::Joint { joint: path.target, coef: path.number }
            }
            // Refused by the structural check.
            _ => return None,
        };
        Some(Wrap { loc: element.loc, kind })
    }
}
