//! Reads default classes: each starts as a copy of the one around it.

use super::reader::Reader;
use crate::schema::asset::{MATERIAL_ROWS, MESH_ROWS};
use crate::schema::constraint::{EQUALITY_ROWS, PAIR_ROWS, TENDON_LOOKS, TENDON_ROWS};
use crate::schema::tree::{CAMERA_ROWS, GEOM_ROWS, JOINT_ROWS, LIGHT_ROWS, SITE_ROWS};
use crate::spec::ClassId;
use crate::xml::Element;

impl Reader<'_> {
    /// A `default` section at the top adds to the class `main`.
    pub(super) fn top_default(&mut self, section: &Element) {
        if let Some(name) = section.attribute("class").filter(|n| n.value != "main") {
            let message = format!(
                "the outermost default class is 'main', not '{}': nest a <default> of that name in it",
                name.value
            );
            self.warning(name.loc, message);
        }
        self.default_class(section, 0);
    }

    fn default_class(&mut self, section: &Element, id: ClassId) {
        for element in section.children.iter().filter(|e| e.name != "default") {
            self.default_element(element, id);
        }
        for nested in section.children_named("default") {
            let name = nested.value("class").unwrap_or_default();
            if name.is_empty() {
                self.error(nested.loc, "a nested default class needs a name");
                continue;
            }
            self.spec.classes.list.push(self.spec.classes.list[id].clone());
            let child = self.spec.classes.list.len() - 1;
            // A repeated name is an error of the structural check; the first one stands.
            self.spec.classes.names.entry(name.to_string()).or_insert(child);
            self.default_class(nested, child);
        }
    }

    fn default_element(&mut self, element: &Element, id: ClassId) {
        let mut class = std::mem::take(&mut self.spec.classes.list[id]);
        match element.name.as_str() {
            "mesh" => self.default_rows(element, &MESH_ROWS, &mut class.mesh),
            "material" => {
                self.default_rows(element, &MATERIAL_ROWS, &mut class.material);
                self.layers(element, &mut class.material);
            }
            "joint" => self.default_rows(element, &JOINT_ROWS, &mut class.joint),
            "geom" => self.default_rows(element, &GEOM_ROWS, &mut class.geom),
            "site" => self.default_rows(element, &SITE_ROWS, &mut class.site),
            "camera" => self.default_rows(element, &CAMERA_ROWS, &mut class.camera),
            "light" => self.default_rows(element, &LIGHT_ROWS, &mut class.light),
            "pair" => self.default_rows(element, &PAIR_ROWS, &mut class.pair),
            "equality" => self.default_rows(element, &EQUALITY_ROWS, &mut class.equality),
            "tendon" => {
                self.default_rows(element, &TENDON_ROWS, &mut class.tendon);
                self.default_rows(element, &TENDON_LOOKS, &mut class.tendon);
                self.spring_length(element, &mut class.tendon);
            }
            // What remains are the actuators; anything else is an error of the structural check.
            _ => self.actuator_parameters(element, &mut class.actuator, true),
        }
        self.spec.classes.list[id] = class;
    }

    /// The class that an element names, or the one in force.
    pub(super) fn class_of(&mut self, element: &Element, attribute: &str, in_force: ClassId) -> ClassId {
        let Some(named) = element.attribute(attribute) else { return in_force };
        let found = self.spec.classes.names.get(&named.value).copied();
        if found.is_none() && !named.value.is_empty() {
            let names = self.spec.classes.names.keys().map(String::as_str);
            let near = self.expansion.diagnostics.nearest(&named.value, names);
            let message = format!("no default class is named '{}'", named.value);
            self.error_with(named.value_loc, message, near.map(|n| format!("did you mean '{n}'?")));
        }
        found.unwrap_or(in_force)
    }
}
