//! From a configuration to the elements of a model that it names.

use super::config::{
    ActuatorRange, FrictionRange, JointRange, LayoutRange, MassRange, PhysicsRandomization, SensorRange,
    SizeRange,
};
use super::size::{check_body, check_geom};
use super::target::{Force, Quantity};
use crate::randomize::choice::{ANYTHING, Choice};
use crate::randomize::dial::{Dial, Draws};
use physics::Model;
use physics::model::ObjType;

/// Bounds of factors of what may vanish, and of what may not.
const FACTORS: [f64; 2] = [0.0, 1e3];
const POSITIVE: [f64; 2] = [1e-3, 1e3];
/// Oldest readings that a robot keeps \[time steps\].
pub(super) const OLDEST: usize = 10_000;

/// Everything that a configuration changes, in its order.
///
/// # Errors
/// A name that no element has, a range that is empty or beyond its bounds, an element that what is asked does not fit.
pub(super) fn dials(config: &PhysicsRandomization, model: &Model) -> Result<Vec<Dial<Quantity>>, String> {
    let mut found = Choice::of(model);
    config.masses.iter().try_for_each(|range| found.masses(range))?;
    config.friction.iter().try_for_each(|range| found.friction(range))?;
    config.joints.iter().try_for_each(|range| found.joints(range))?;
    config.actuators.iter().try_for_each(|range| found.actuators(range))?;
    config.sensors.iter().try_for_each(|range| found.sensors(range))?;
    found.whole_scene(config)?;
    config.sizes.iter().try_for_each(|range| found.sizes(range))?;
    config.layouts.iter().try_for_each(|range| found.layouts(range))?;
    found.order_layouts();
    Ok(found.dials)
}

impl Choice<'_, Quantity> {
    fn masses(&mut self, range: &MassRange) -> Result<(), String> {
        let factor = Draws::Uniform(self.bounds("masses factor", &range.factor, POSITIVE)?);
        let bodies = self.named("masses", (ObjType::Body, self.model.nbody), range.names.as_deref())?;
        for body in bodies.into_iter().filter(|&body| body > 0) {
            self.put((ObjType::Body, body, "mass"), "", Quantity::Mass(body), factor.clone());
        }
        Ok(())
    }

    fn friction(&mut self, range: &FrictionRange) -> Result<(), String> {
        let factor = Draws::Uniform(self.bounds("friction factor", &range.factor, FACTORS)?);
        for geom in self.named("friction", (ObjType::Geom, self.model.ngeom), range.names.as_deref())? {
            self.put((ObjType::Geom, geom, "friction"), "", Quantity::Friction(geom), factor.clone());
        }
        Ok(())
    }

    fn joints(&mut self, range: &JointRange) -> Result<(), String> {
        let damping = self.optional("joints damping", range.damping.as_ref(), FACTORS)?;
        let loss = self.optional("joints frictionloss", range.frictionloss.as_ref(), FACTORS)?;
        let armature = self.optional("joints armature", range.armature.as_ref(), FACTORS)?;
        for joint in self.named("joints", (ObjType::Joint, self.model.njnt), range.names.as_deref())? {
            let parts = [
                ("damping", "", Quantity::Damping(joint), &damping),
                ("frictionloss", "", Quantity::FrictionLoss(joint), &loss),
                ("armature", "", Quantity::Armature(joint), &armature),
            ];
            self.put_all((ObjType::Joint, joint), parts);
        }
        Ok(())
    }

    fn actuators(&mut self, range: &ActuatorRange) -> Result<(), String> {
        let m = self.model;
        let gain = self.optional("actuators gain", range.gain.as_ref(), FACTORS)?;
        let named = range.names.is_some();
        for actuator in self.named("actuators", (ObjType::Actuator, m.nactuator), range.names.as_deref())? {
            let label = m.label_of(ObjType::Actuator, actuator);
            let known = Force::of(m, actuator).is_some();
            if gain.is_some() && !known && named {
                return Err(format!(
                    "actuators gain of physics_randomization names the {label}, which is no motor, servo or muscle: no one number \
                     is its gain"
                ));
            }
            let gain = gain.clone().filter(|_| known);
            let samples = m.actuator_history[actuator][0];
            let delay = self.delay("actuators", &label, samples, range.delay.as_ref(), named)?;
            let parts = [
                ("gain", "", Quantity::Gain(actuator), &gain),
                ("delay", "s", Quantity::ControlDelay(actuator), &delay),
            ];
            self.put_all((ObjType::Actuator, actuator), parts);
        }
        Ok(())
    }

    fn sensors(&mut self, range: &SensorRange) -> Result<(), String> {
        let m = self.model;
        for sensor in self.named("sensors", (ObjType::Sensor, m.nsensor), range.names.as_deref())? {
            let (label, samples) = (m.label_of(ObjType::Sensor, sensor), m.sensor_history[sensor][0]);
            let delay = self.delay("sensors", &label, samples, Some(&range.delay), range.names.is_some())?;
            self.put_all((ObjType::Sensor, sensor), [("delay", "s", Quantity::SensorDelay(sensor), &delay)]);
        }
        Ok(())
    }

    /// Delays within what a buffer of `samples` time steps holds; nothing where there is none and the element is not named.
    fn delay(
        &self,
        key: &str,
        label: &str,
        samples: i32,
        range: Option<&crate::Ranges<1>>,
        named: bool,
    ) -> Result<Option<Draws>, String> {
        if range.is_some() && samples <= 0 && named {
            return Err(format!(
                "{key} delay of physics_randomization names the {label}, which keeps no past values: give it nsample in the model"
            ));
        }
        let longest = f64::from(samples) * self.model.opt.timestep;
        let key = format!("{key} delay ({label})");
        self.optional(&key, range.filter(|_| samples > 0), [0.0, longest])
    }

    /// What belongs to no element.
    fn whole_scene(&mut self, config: &PhysicsRandomization) -> Result<(), String> {
        if let Some(draws) = self.optional("gravity", config.gravity.as_ref(), ANYTHING)? {
            let name = "option/gravity".to_owned();
            self.add(Dial { name, unit: "m/s^2", target: Quantity::Gravity, draws });
        }
        if let Some(ages) = &config.readings {
            let [low, high] = self.bounds("readings", ages, [0.0, OLDEST as f64])?[0];
            if low.fract() != 0.0 || high.fract() != 0.0 {
                return Err(format!(
                    "readings of physics_randomization are whole time steps, not {low} to {high}"
                ));
            }
            let draws = Draws::Whole([low as u64, high as u64]);
            self.add(Dial { name: "robot/readings".into(), unit: "", target: Quantity::Readings, draws });
        }
        Ok(())
    }

    fn sizes(&mut self, range: &SizeRange) -> Result<(), String> {
        let wrong = |why: String| format!("sizes of physics_randomization: {why}");
        if range.names.is_empty() && range.bodies.is_empty() {
            return Err(wrong("names of geoms, or of bodies, are needed".into()));
        }
        let factor = Draws::Uniform(self.bounds("sizes factor", &range.factor, POSITIVE)?);
        for geom in self.named("sizes", (ObjType::Geom, self.model.ngeom), Some(&range.names))? {
            check_geom(self.model, geom, range.keeps).map_err(wrong)?;
            let target = Quantity::GeomSize(geom, range.keeps);
            self.put((ObjType::Geom, geom, "size"), "", target, factor.clone());
        }
        for body in self.named("sizes", (ObjType::Body, self.model.nbody), Some(&range.bodies))? {
            check_body(self.model, body).map_err(wrong)?;
            let target = Quantity::BodySize(body, range.keeps);
            self.put((ObjType::Body, body, "size"), "", target, factor.clone());
        }
        Ok(())
    }

    fn layouts(&mut self, range: &LayoutRange) -> Result<(), String> {
        let pos = range.pos.as_ref().map(|range| self.bounds("layouts pos", range, ANYTHING)).transpose()?;
        let shift = self.optional("layouts shift", range.shift.as_ref(), ANYTHING)?;
        let yaw = self.optional("layouts yaw", range.yaw.as_ref(), ANYTHING)?;
        let bodies = self.named("layouts", (ObjType::Body, self.model.nbody), Some(&range.names))?;
        self.check_layout(range, &bodies)?;
        let mut others = Vec::new();
        for body in bodies {
            let place = pos.clone().map(|bounds| match range.distance {
                Some(distance) => Draws::Apart { bounds, distance, others: others.clone() },
                None => Draws::Uniform(bounds),
            });
            let parts = [
                ("pos", "m", Quantity::Place(body), &place),
                ("shift", "m", Quantity::Shift(body), &shift),
                ("yaw", "deg", Quantity::Yaw(body), &yaw),
            ];
            self.put_all((ObjType::Body, body), parts);
            others.push(self.name((ObjType::Body, body, "pos")));
        }
        Ok(())
    }

    fn check_layout(&self, range: &LayoutRange, bodies: &[usize]) -> Result<(), String> {
        let wrong = |why: &str| Err(format!("layouts of physics_randomization: {why}"));
        if bodies.contains(&0) {
            return wrong("the world has no place");
        }
        let Some(distance) = range.distance else { return Ok(()) };
        if range.pos.is_none() {
            return wrong("a distance is one between positions, and pos is missing");
        }
        if !(distance >= 0.0 && distance.is_finite()) {
            return wrong("the distance is a finite number, 0 or more");
        }
        let parent = |&body: &usize| self.model.body_parentid[body];
        if bodies.windows(2).any(|pair| parent(&pair[0]) != parent(&pair[1])) {
            return wrong("bodies with a distance between them hang on one body");
        }
        Ok(())
    }

    /// Leaves out distances to bodies that a later entry places.
    fn order_layouts(&mut self) {
        let names: Vec<_> = self.dials.iter().map(|dial| dial.name.clone()).collect();
        for (dial, place) in self.dials.iter_mut().zip(0..) {
            if let Draws::Apart { others, .. } = &mut dial.draws {
                others.retain(|other| names[..place].contains(other));
            }
        }
    }
}
