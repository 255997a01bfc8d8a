//! `sensor`.

use physics::model::{ObjType, SensorType};

use super::reader::Reader;
use crate::schema::Words;
use crate::schema::sensor::{
    CONTACT_DATA, MEASUREMENTS, PLUGIN_OBJECTS, PLUGIN_ROWS, RAY_DATA, USER_DATA, blocks,
};
use crate::spec::Sensor;
use crate::xml::Element;

impl Reader<'_> {
    pub(super) fn sensor(&mut self, section: &Element) {
        for element in &section.children {
            if element.name == "plugin" {
                let sensor = self.plugin_sensor(element);
                self.spec.sensors.push(sensor);
                continue;
            }
            // The structural check refuses all others.
            let Some(simple) = MEASUREMENTS.iter().find(|m| m.element.tag == element.name) else { continue };
            let mut sensor =
                Sensor { loc: element.loc, kind: simple.kind, objtype: simple.target, ..Sensor::default() };
            if simple.kind == SensorType::Contact {
                sensor.intprm[2] = 1;
            }
            for block in blocks(simple.kind, simple.target) {
                self.rows(element, block, &mut sensor);
            }
            self.sides(element, &mut sensor);
            self.spec.sensors.push(sensor);
        }
    }

    fn plugin_sensor(&mut self, element: &Element) -> Sensor {
        let mut sensor = Sensor { loc: element.loc, kind: SensorType::Plugin, ..Sensor::default() };
        for block in [&PLUGIN_ROWS as &[_], &PLUGIN_OBJECTS, &USER_DATA] {
            self.rows(element, block, &mut sensor);
        }
        sensor.objtype = self.object_type(element, "objtype");
        sensor.reftype = self.object_type(element, "reftype");
        sensor.plugin = Some(self.plugin_use(element));
        sensor
    }

    /// Kinds of the objects, and data lists, that depend on which attributes are present.
    fn sides(&mut self, element: &Element, sensor: &mut Sensor) {
        let first = |list: &[(&str, ObjType)]| {
            list.iter()
                .find(|(name, _)| element.attribute(name).is_some())
                .map_or(ObjType::Unknown, |(_, kind)| *kind)
        };
        match sensor.kind {
            SensorType::Camprojection => sensor.reftype = ObjType::Camera,
            SensorType::Insidesite => sensor.reftype = ObjType::Site,
            SensorType::Tactile => sensor.reftype = ObjType::Geom,
            SensorType::Rangefinder => {
                sensor.objtype = first(&[("site", ObjType::Site), ("camera", ObjType::Camera)]);
                sensor.intprm[0] = self.data_bits(element, RAY_DATA);
            }
            SensorType::Geomdist | SensorType::Geomnormal | SensorType::Geomfromto => {
                sensor.objtype = first(&[("body1", ObjType::Body), ("geom1", ObjType::Geom)]);
                sensor.reftype = first(&[("body2", ObjType::Body), ("geom2", ObjType::Geom)]);
            }
            SensorType::Contact => {
                let (site, geom) = (("site", ObjType::Site), ("geom1", ObjType::Geom));
                sensor.objtype = first(&[site, ("body1", ObjType::Body), ("subtree1", ObjType::Xbody), geom]);
                let geom = ("geom2", ObjType::Geom);
                sensor.reftype = first(&[("body2", ObjType::Body), ("subtree2", ObjType::Xbody), geom]);
                sensor.intprm[0] = self.data_bits(element, CONTACT_DATA);
                if let Some(num) = element.attribute("num").filter(|_| sensor.intprm[2] <= 0) {
                    self.error(num.value_loc, "attribute 'num' of <contact> must be positive");
                }
            }
            SensorType::User => sensor.objtype = self.object_type(element, "objtype"),
            // The tables tell all about the others.
            _ => {}
        }
    }

    /// The bits of `data`, whose words must stand in the order of the list; the first word if absent.
    fn data_bits(&mut self, element: &Element, list: Words) -> i32 {
        let Some(attribute) = element.attribute("data") else { return 1 };
        let Some(codes) = self.keywords(element, attribute, list) else { return 1 };
        if !codes.is_sorted() {
            let order = list.iter().map(|(word, _)| *word).collect::<Vec<_>>().join(", ");
            self.error(attribute.value_loc, format!("words of 'data' must stand in the order {order}"));
        }
        codes.iter().fold(0, |bits, code| bits | 1 << code)
    }
}
