//! `compiler`, `option`, `size`, `visual`, `statistic`, `custom` and `keyframe`. Repeated sections merge, the
//! later attribute wins.

use physics::math::Legible;
use physics::model::ObjType;

use super::reader::Reader;
use crate::schema::option::{FLAGS, OPTIONS};
use crate::schema::settings::{
    COMPILER_ROWS, ENTRY_ROWS, KEY_ROWS, LENGTHRANGE_ROWS, NUMERIC_ROWS, SIZE_ROWS, STATISTIC_ROWS,
    TEXT_ROWS, TUPLE_ROWS,
};
use crate::schema::visual::{
    VISUAL_GLOBAL, VISUAL_HEADLIGHT, VISUAL_MAP, VISUAL_QUALITY, VISUAL_RGBA, VISUAL_SCALE,
};
use crate::schema::words::OBJECT_TYPES;
use crate::spec::{Key, Numeric, Text, Tuple, TupleEntry};
use crate::xml::{Attribute, Element};

/// Numbers of a custom array.
const MAX_NUMERIC: usize = 500;

impl Reader<'_> {
    pub(super) fn compiler(&mut self, section: &Element) {
        let mut compiler = std::mem::take(&mut self.spec.compiler);
        if let Some(dir) = section.value("assetdir") {
            compiler.meshdir = dir.to_string();
            compiler.texturedir = dir.to_string();
        }
        self.rows(section, &COMPILER_ROWS, &mut compiler);
        self.authored.attributes(section);
        if let Some(attribute) = section.attribute("eulerseq") {
            match <[u8; 3]>::try_from(attribute.value.as_bytes()) {
                Ok(sequence) if sequence.iter().all(|c| b"xyzXYZ".contains(c)) => {
                    compiler.eulerseq = sequence
                }
                _ => {
                    self.error(attribute.value_loc, "attribute 'eulerseq' takes three of the letters xyzXYZ")
                }
            }
        }
        if let Some(attribute) = section.attribute("coordinate").filter(|a| a.value != "local") {
            self.error(attribute.value_loc, "attribute 'coordinate' of <compiler> can only be 'local'");
        }
        for element in section.children_named("lengthrange") {
            self.rows(element, &LENGTHRANGE_ROWS, &mut compiler.lengthrange);
        }
        self.spec.compiler = compiler;
    }

    pub(super) fn option(&mut self, section: &Element) {
        let mut option = std::mem::take(&mut self.spec.option);
        self.rows(section, &OPTIONS, &mut option);
        if let Some(attribute) = section.attribute("timestep").filter(|_| option.timestep <= 0.0) {
            let message =
                format!("attribute 'timestep' of <option> must be positive, is {}", Legible(option.timestep));
            self.error(attribute.value_loc, message);
        }
        self.authored.attributes(section);
        if let Some(attribute) = section.attribute("actuatorgroupdisable") {
            for group in self.numbers::<i32>(section, attribute).unwrap_or_default() {
                match group {
                    0..=30 => {
                        option.disableactuator |= 1 << group;
                        self.authored.disableactuator |= 1 << group;
                    }
                    _ => self.error(
                        attribute.value_loc,
                        format!("actuator group {group} is not between 0 and 30"),
                    ),
                }
            }
        }
        for flag in section.children_named("flag") {
            self.rows(flag, &FLAGS, &mut option);
            self.authored.flags(flag);
        }
        self.spec.option = option;
    }

    pub(super) fn size(&mut self, section: &Element) {
        let mut size = std::mem::take(&mut self.spec.size);
        self.rows(section, &SIZE_ROWS, &mut size);
        size.loc = section.loc;
        if let Some(attribute) = section.attribute("memory").filter(|a| a.value.trim() != "-1") {
            size.memory = memory_bytes(attribute.value.trim());
            if size.memory.is_none() {
                self.error(
                    attribute.value_loc,
                    "attribute 'memory' takes a number of bytes such as 512K or 15M",
                );
            }
        }
        if let Some(attribute) = section.attribute("nstack") {
            size.nstack = self.between::<i32>(section, attribute, 1, 1).map(|v| i64::from(v[0]));
        }
        for attribute in section.attributes.iter().filter(|a| a.name != "memory") {
            if attribute.value.trim().parse::<i64>().is_ok_and(|n| n < -1) {
                self.error(
                    attribute.value_loc,
                    format!("attribute '{}' of <size> is below -1", attribute.name),
                );
            }
        }
        self.spec.size = size;
    }

    pub(super) fn visual(&mut self, section: &Element) {
        let mut visual = std::mem::take(&mut self.spec.visual);
        for element in &section.children {
            self.authored.attributes(element);
            match element.name.as_str() {
                "global" => self.rows(element, &VISUAL_GLOBAL, &mut visual.global),
                "quality" => self.rows(element, &VISUAL_QUALITY, &mut visual.quality),
                "headlight" => self.rows(element, &VISUAL_HEADLIGHT, &mut visual.headlight),
                "map" => self.rows(element, &VISUAL_MAP, &mut visual.map),
                "scale" => self.rows(element, &VISUAL_SCALE, &mut visual.scale),
                // The structural check leaves only this one.
                _ => self.rows(element, &VISUAL_RGBA, &mut visual.rgba),
            }
            for (name, value) in [("realtime", visual.global.realtime), ("znear", visual.map.znear)] {
                self.positive(element.attribute(name), f64::from(value));
            }
        }
        self.spec.visual = visual;
    }

    pub(super) fn statistic(&mut self, section: &Element) {
        let mut statistic = std::mem::take(&mut self.spec.stat);
        self.rows(section, &STATISTIC_ROWS, &mut statistic);
        self.positive(section.attribute("extent"), statistic.extent.unwrap_or(1.0));
        self.spec.stat = statistic;
    }

    fn positive(&mut self, attribute: Option<&Attribute>, value: f64) {
        if let Some(attribute) = attribute.filter(|_| value <= 0.0) {
            self.error(attribute.value_loc, format!("attribute '{}' must be positive", attribute.name));
        }
    }

    pub(super) fn custom(&mut self, section: &Element) {
        for element in &section.children {
            match element.name.as_str() {
                "numeric" => self.numeric(element),
                "text" => {
                    let mut text = Text { loc: element.loc, ..Text::default() };
                    self.rows(element, &TEXT_ROWS, &mut text);
                    if let Some(data) = element.attribute("data").filter(|a| a.value.is_empty()) {
                        self.error(
                            data.value_loc,
                            "attribute 'data' of <text> is empty: write the text, or remove the element",
                        );
                    }
                    self.spec.texts.push(text);
                }
                // The structural check leaves only this one.
                _ => self.tuple(element),
            }
        }
    }

    fn numeric(&mut self, element: &Element) {
        let mut numeric = Numeric { loc: element.loc, ..Numeric::default() };
        self.rows(element, &NUMERIC_ROWS, &mut numeric);
        let given = element.attribute("size").and_then(|a| self.between::<i32>(element, a, 1, 1));
        numeric.size = given.map_or(numeric.data.len() as i32, |v| v[0]);
        if !(1..=MAX_NUMERIC as i32).contains(&numeric.size) {
            self.error(
                element.loc,
                format!("<numeric> takes 1 to {MAX_NUMERIC} numbers, not {}", numeric.size),
            );
        } else if numeric.data.len() > numeric.size as usize {
            let message =
                format!("<numeric> has {} numbers and a size of {}", numeric.data.len(), numeric.size);
            self.error(element.loc, message);
        }
        self.spec.numerics.push(numeric);
    }

    fn tuple(&mut self, element: &Element) {
        let mut tuple = Tuple { loc: element.loc, ..Tuple::default() };
        self.rows(element, &TUPLE_ROWS, &mut tuple);
        for child in element.children_named("element") {
            let mut entry = TupleEntry::default();
            self.rows(child, &ENTRY_ROWS, &mut entry);
            entry.objtype = self.object_type(child, "objtype");
            tuple.entries.push(entry);
        }
        self.spec.tuples.push(tuple);
    }

    /// The kind of object that an attribute of free text names.
    pub(super) fn object_type(&mut self, element: &Element, name: &str) -> ObjType {
        let Some(attribute) = element.attribute(name) else { return ObjType::Unknown };
        let found = OBJECT_TYPES.iter().position(|word| *word == attribute.value);
        let found = found.and_then(|i| ObjType::from_code(i as i32 + 1));
        if found.is_none() {
            let near = self.expansion.diagnostics.nearest(&attribute.value, OBJECT_TYPES.iter().copied());
            let message = format!("'{}' is not a kind of object", attribute.value);
            self.error_with(attribute.value_loc, message, near.map(|n| format!("did you mean '{n}'?")));
        }
        found.unwrap_or(ObjType::Unknown)
    }

    pub(super) fn keyframe(&mut self, section: &Element) {
        for element in section.children_named("key") {
            let mut key = Key { loc: element.loc, ..Key::default() };
            self.rows(element, &KEY_ROWS, &mut key);
            self.spec.keys.push(key);
        }
    }
}

/// Bytes of a size such as `15M`, whose suffix multiplies by a power of 1024.
fn memory_bytes(text: &str) -> Option<i64> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let power = match text[digits.len()..].to_ascii_uppercase().as_str() {
        "" => 0,
        suffix if suffix.len() == 1 => "KMGTPE".find(suffix)? as u32 + 1,
        _ => return None,
    };
    let number: i64 = digits.parse().ok().filter(|n| *n >= 0)?;
    number.checked_mul(1_i64.checked_shl(10 * power)?)
}
