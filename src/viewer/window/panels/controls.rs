//! Sliders of controls and joints, and switches of equality constraints.

use crate::session::Session;
use eframe::egui::{Slider, Ui};
use physics::model::{JointType, ObjType};
use std::f64::consts::PI;

/// A slider for each control.
pub fn controls(ui: &mut Ui, session: &mut Session) {
    if ui.button("Clear all").clicked() {
        session.edit(|_, data| data.state.ctrl.fill(0.0));
    }
    let model = session.model();
    let mut values = session.data().state.ctrl.clone();
    let mut changed = false;
    for actuator in 0..model.nactuator {
        let first = model.actuator_ctrladr[actuator] as usize;
        let name = model.label_of(ObjType::Actuator, actuator);
        for (place, control) in (first..first + model.actuator_ctrlnum[actuator] as usize).enumerate() {
            let [low, high] = model.actuator_ctrlrange[control];
            let range = if low < high { low..=high } else { -1.0..=1.0 };
            let label = if place == 0 { name.clone() } else { format!("{name} {place}") };
            changed |= ui.add(Slider::new(&mut values[control], range).text(label)).changed();
        }
    }
    if changed {
        session.edit(|_, data| data.state.ctrl.copy_from_slice(&values));
    }
}

/// A slider for each hinge and slide joint, which moves while the simulation is paused.
pub fn joints(ui: &mut Ui, session: &mut Session) {
    let (model, paused) = (session.model(), !session.is_running());
    let mut values = session.data().state.qpos.clone();
    let mut changed = false;
    for joint in 0..model.njnt {
        let around = match JointType::from_code(model.jnt_type[joint]) {
            Some(JointType::Hinge) => PI,
            Some(JointType::Slide) => 1.0,
            _ => continue,
        };
        let [low, high] = model.jnt_range[joint];
        let range = if model.jnt_limited[joint] { low..=high } else { -around..=around };
        let value = &mut values[model.jnt_qposadr[joint] as usize];
        let label = model.label_of(ObjType::Joint, joint);
        changed |= ui.add_enabled(paused, Slider::new(value, range).text(label)).changed();
    }
    if changed {
        session.edit(|_, data| data.state.qpos.copy_from_slice(&values));
    }
}

/// A switch for each equality constraint.
pub fn equalities(ui: &mut Ui, session: &mut Session) {
    let model = session.model();
    let mut active = session.data().state.eq_active.clone();
    let mut changed = false;
    for equality in 0..model.neq {
        changed |= ui.checkbox(&mut active[equality], model.label_of(ObjType::Equality, equality)).changed();
    }
    if changed {
        session.edit(|_, data| data.state.eq_active.copy_from_slice(&active));
    }
}
