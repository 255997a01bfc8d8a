//! Sliders of controls, joints and mocap bodies, and switches of equality constraints.

use crate::session::Session;
use eframe::egui::{DragValue, Slider, Ui};
use physics::math::quat_normalize;
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

/// Position and orientation of each mocap body, which moves while the simulation runs, too.
pub fn mocaps(ui: &mut Ui, session: &mut Session) {
    let model = session.model();
    let state = &session.data().state;
    let (mut places, mut turns) = (state.mocap_pos.clone(), state.mocap_quat.clone());
    let mut changed = false;
    let mut row = |ui: &mut Ui, values: &mut [f64]| {
        ui.horizontal(|ui| {
            for value in values {
                changed |= ui.add(DragValue::new(value).speed(0.005).max_decimals(4)).changed();
            }
        });
    };
    for body in 0..model.nbody {
        let Ok(mocap) = usize::try_from(model.body_mocapid[body]) else { continue };
        ui.label(model.label_of(ObjType::Body, body));
        row(ui, &mut places[mocap]);
        row(ui, &mut turns[mocap]);
    }
    if changed {
        turns.iter_mut().for_each(|turn| *turn = quat_normalize(*turn));
        session.edit(|_, data| {
            data.state.mocap_pos.copy_from_slice(&places);
            data.state.mocap_quat.copy_from_slice(&turns);
        });
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
