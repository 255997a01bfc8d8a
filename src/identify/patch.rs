//! The values found, written into a description.

use crate::error::IdentifyError;
use crate::fit::Found;
use crate::parameter::Parameter;
use crate::quantity::Quantity;
use mjcf::spec::{Inertial, Spec};
use physics::Model;
use physics::model::ObjType;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The model with the values found.
///
/// # Errors
/// The model refuses a value.
fn edited(model: &Model, found: &Found) -> Result<Model, IdentifyError> {
    let mut edited = model.clone();
    let values = found.parameters.iter().zip(&found.values);
    let written: Vec<_> = values.map(|(p, &x)| (p.quantity, p.element, x)).collect();
    Quantity::write(&mut edited, &written).map_err(|error| IdentifyError::Edit {
        values: crate::parameter::valued(&found.parameters, &found.values),
        error,
    })?;
    Ok(edited)
}

/// An element of a description, and its attributes with their texts.
type Changes = BTreeMap<(ObjTypeOrder, String), Vec<(&'static str, String)>>;

/// Kinds in the order in which the fragment lists them.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum ObjTypeOrder {
    Joint,
    Body,
    Actuator,
}

impl ObjTypeOrder {
    fn kind(self) -> ObjType {
        match self {
            ObjTypeOrder::Joint => ObjType::Joint,
            ObjTypeOrder::Body => ObjType::Body,
            ObjTypeOrder::Actuator => ObjType::Actuator,
        }
    }
}

/// What changes, element by element.
fn changes(model: &Model, found: &Found) -> Result<Changes, IdentifyError> {
    let m = edited(model, found)?;
    let mut all = Changes::new();
    for parameter in &found.parameters {
        let element = parameter.element;
        let (order, attributes): (_, Vec<(&'static str, String)>) = match parameter.quantity {
            Quantity::Delay => continue,
            Quantity::Mass => {
                let inertia = numbers(&m.body_inertia[element]);
                (
                    ObjTypeOrder::Body,
                    vec![("mass", m.body_mass[element].to_string()), ("diaginertia", inertia)],
                )
            }
            Quantity::Gain | Quantity::Kv => {
                let (gain, bias) = (&m.actuator_gainprm[element], &m.actuator_biasprm[element]);
                (ObjTypeOrder::Actuator, vec![("gainprm", numbers(gain)), ("biasprm", numbers(bias))])
            }
            Quantity::Damping | Quantity::Stiffness => {
                let poly = match parameter.quantity {
                    Quantity::Damping => m.dof_dampingpoly[m.jnt_dofadr[element] as usize],
                    _ => m.jnt_stiffnesspoly[element],
                };
                let value = parameter.quantity.read(&m, element);
                let text =
                    if poly == [0.0; 2] { value.to_string() } else { numbers(&[value, poly[0], poly[1]]) };
                (ObjTypeOrder::Joint, vec![(parameter.quantity.name(), text)])
            }
            quantity => {
                (ObjTypeOrder::Joint, vec![(quantity.name(), quantity.read(&m, element).to_string())])
            }
        };
        let name = named(model, parameter, order.kind())?;
        let entry = all.entry((order, name)).or_default();
        for (attribute, text) in attributes {
            entry.retain(|(old, _)| *old != attribute);
            entry.push((attribute, text));
        }
    }
    Ok(all)
}

/// The name of a parameter's element.
fn named(model: &Model, parameter: &Parameter, kind: ObjType) -> Result<String, IdentifyError> {
    match model.name_of(kind, parameter.element) {
        "" => Err(IdentifyError::Choice(format!(
            "{}: the element has no name by which its value can be written into the model: give it one in the MJCF",
            parameter.name
        ))),
        name => Ok(name.to_owned()),
    }
}

fn numbers(values: &[f64]) -> String {
    let used = values.iter().rposition(|x| *x != 0.0).map_or(1, |last| last + 1);
    values[..used].iter().map(f64::to_string).collect::<Vec<_>>().join(" ")
}

/// The changed attributes as a piece of MJCF, to be read and copied: elements by name, actuators in general form, deviations in
/// a comment.
///
/// # Errors
/// An element has no name, or the model refuses a value.
pub fn fragment(model: &Model, found: &Found) -> Result<String, IdentifyError> {
    let mut text = String::from(
        "<mujoco>\n  <!-- Identified values of attributes, to be copied to the elements of these names:\n",
    );
    for ((p, value), deviation) in found.parameters.iter().zip(&found.values).zip(&found.deviations) {
        let certain =
            if deviation.is_finite() { format!("± {deviation:.2e}") } else { "not told by the log".into() };
        // Writing into a text cannot fail.
        let _ = writeln!(
            text,
            "       {} = {value:.6e} {certain}, was {:.6e}",
            p.name.replace("--", "- -"),
            p.start
        );
    }
    text += "  -->\n";
    for ((order, name), attributes) in changes(model, found)? {
        let listed: String = attributes.iter().map(|(a, value)| format!(" {a}=\"{value}\"")).collect();
        let name = name.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
        let tag = match order {
            ObjTypeOrder::Joint => "joint",
            ObjTypeOrder::Actuator => "general",
            ObjTypeOrder::Body => "body",
        };
        let _ = match order {
            ObjTypeOrder::Body => writeln!(text, "  <body name=\"{name}\"><inertial{listed}/></body>"),
            _ => writeln!(text, "  <{tag} name=\"{name}\"{listed}/>"),
        };
    }
    text += "</mujoco>\n";
    Ok(text)
}

/// Writes the values found into the description that the model was compiled from. A delay of controls is no part of it.
///
/// # Errors
/// An element has no name, the model refuses a value, or the description does.
pub fn patched(spec: &mut Spec, model: &Model, found: &Found) -> Result<(), IdentifyError> {
    let m = edited(model, found)?;
    for ((order, name), attributes) in changes(model, found)? {
        if order == ObjTypeOrder::Body {
            let Some(id) = m.id_of(ObjType::Body, &name) else { continue };
            let body = spec.body_mut(&name)?;
            body.inertial = Some(Inertial {
                mass: m.body_mass[id],
                pos: m.body_ipos[id],
                quat: m.body_iquat[id],
                inertia: m.body_inertia[id],
                ..Inertial::default()
            });
            continue;
        }
        for (attribute, value) in attributes {
            spec.set(order.kind(), &name, attribute, &value)?;
        }
    }
    Ok(())
}
