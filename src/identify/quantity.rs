//! What can be identified of a model, and where it stands in its arrays.

use crate::error::IdentifyError;
use physics::Model;
use physics::model::{BiasType, DynType, EditError, GainType, JointType, ObjType};

/// A quantity of a joint, an actuator or a body; or of the whole robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Quantity {
    /// Viscous damping of a joint \[N s/m, N m s/rad\].
    Damping,
    /// Dry friction of a joint \[N, N m\].
    Frictionloss,
    /// Rotor inertia of a joint \[kg, kg m²\].
    Armature,
    /// Stiffness of a joint's spring \[N/m, N m/rad\].
    Stiffness,
    /// Gain of an actuator; of a position servo its stiffness too, of a velocity servo its damping.
    Gain,
    /// Velocity gain of a position servo.
    Kv,
    /// Mass of a body \[kg\]; its rotational inertia grows with it.
    Mass,
    /// By how much controls come later than they were recorded \[s\].
    Delay,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Quantity; 8] = [
        Quantity::Damping,
        Quantity::Frictionloss,
        Quantity::Armature,
        Quantity::Stiffness,
        Quantity::Gain,
        Quantity::Kv,
        Quantity::Mass,
        Quantity::Delay,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::Damping => "damping",
            Quantity::Frictionloss => "frictionloss",
            Quantity::Armature => "armature",
            Quantity::Stiffness => "stiffness",
            Quantity::Gain => "gain",
            Quantity::Kv => "kv",
            Quantity::Mass => "mass",
            Quantity::Delay => "delay",
        }
    }

    /// Kind of the elements that have it; none of the whole robot.
    pub fn kind(self) -> Option<ObjType> {
        match self {
            Quantity::Damping | Quantity::Frictionloss | Quantity::Armature | Quantity::Stiffness => {
                Some(ObjType::Joint)
            }
            Quantity::Gain | Quantity::Kv => Some(ObjType::Actuator),
            Quantity::Mass => Some(ObjType::Body),
            Quantity::Delay => None,
        }
    }

    /// The elements of a model that have it.
    pub(crate) fn elements(self, m: &Model) -> Vec<usize> {
        match self {
            Quantity::Stiffness => (0..m.njnt).filter(|&joint| m.jnt_stiffness[joint] > 0.0).collect(),
            Quantity::Damping | Quantity::Frictionloss | Quantity::Armature => (0..m.njnt).collect(),
            Quantity::Gain => {
                (0..m.nactuator).filter(|&a| m.actuator_gaintype[a] == GainType::Fixed.code()).collect()
            }
            Quantity::Kv => (0..m.nactuator).filter(|&a| servo(m, a) == Some(Servo::Position)).collect(),
            Quantity::Mass => {
                (1..m.nbody).filter(|&b| m.body_weldid[b] != 0 && m.body_mass[b] > 0.0).collect()
            }
            Quantity::Delay => vec![0],
        }
    }

    /// The value that a model has.
    pub(crate) fn read(self, m: &Model, element: usize) -> f64 {
        match self {
            Quantity::Damping => m.dof_damping[first_dof(m, element)],
            Quantity::Frictionloss => m.dof_frictionloss[first_dof(m, element)],
            Quantity::Armature => m.dof_armature[first_dof(m, element)],
            Quantity::Stiffness => m.jnt_stiffness[element],
            Quantity::Gain => m.actuator_gainprm[element][0],
            Quantity::Kv => -m.actuator_biasprm[element][2],
            Quantity::Mass => m.body_mass[element],
            Quantity::Delay => 0.0,
        }
    }

    /// A value of which a difference can be seen, where the model has none.
    pub(crate) fn typical(self, m: &Model) -> f64 {
        let values: Vec<f64> =
            self.elements(m).iter().map(|&e| self.read(m, e).abs()).filter(|&x| x > 0.0).collect();
        let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
        match self {
            Quantity::Delay => 10.0 * m.opt.timestep,
            _ if mean > 0.0 => mean,
            Quantity::Armature => 0.01,
            _ => 0.1,
        }
    }

    /// Writes values into a model, those of all elements of all quantities in one edit; delays are no part of it.
    pub(crate) fn write(m: &mut Model, values: &[(Quantity, usize, f64)]) -> Result<(), EditError> {
        let servos: Vec<_> = (0..m.nactuator).map(|actuator| servo(m, actuator)).collect();
        let dofs: Vec<_> =
            (0..m.njnt).map(|joint| first_dof(m, joint)..first_dof(m, joint) + width(m, joint)).collect();
        let before: Vec<_> = (0..m.nbody).map(|body| (m.body_mass[body], m.body_inertia[body])).collect();
        m.edit(|d| {
            for &(quantity, element, value) in values {
                match quantity {
                    Quantity::Damping => dofs[element].clone().for_each(|dof| d.dof_damping[dof] = value),
                    Quantity::Frictionloss => {
                        dofs[element].clone().for_each(|dof| d.dof_frictionloss[dof] = value)
                    }
                    Quantity::Armature => dofs[element].clone().for_each(|dof| d.dof_armature[dof] = value),
                    Quantity::Stiffness => d.jnt_stiffness[element] = value,
                    Quantity::Gain => {
                        d.actuator_gainprm[element][0] = value;
                        match servos[element] {
                            Some(Servo::Position) => d.actuator_biasprm[element][1] = -value,
                            Some(Servo::Velocity) => d.actuator_biasprm[element][2] = -value,
                            None => {}
                        }
                    }
                    Quantity::Kv => d.actuator_biasprm[element][2] = -value,
                    Quantity::Mass => {
                        let (mass, inertia) = before[element];
                        d.body_mass[element] = value;
                        d.body_inertia[element] = inertia.map(|moment| moment * value / mass);
                    }
                    Quantity::Delay => {}
                }
            }
        })
    }

    /// The quantity of a name.
    ///
    /// # Errors
    /// There is none; all are listed.
    pub fn named(name: &str) -> Result<Self, IdentifyError> {
        Self::ALL.into_iter().find(|quantity| quantity.name() == name).ok_or_else(|| {
            let all: Vec<_> = Self::ALL.iter().map(|quantity| quantity.name()).collect();
            IdentifyError::Choice(format!(
                "there is no quantity '{name}' to be fitted; there are {}",
                all.join(", ")
            ))
        })
    }
}

/// Actuators whose bias takes the gain up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Servo {
    Position,
    Velocity,
}

/// What servo an actuator is, by its numbers.
fn servo(m: &Model, actuator: usize) -> Option<Servo> {
    let (gain, bias) = (m.actuator_gainprm[actuator][0], m.actuator_biasprm[actuator]);
    let affine = m.actuator_biastype[actuator] == BiasType::Affine.code();
    let direct = m.actuator_dyntype[actuator] != DynType::Integrator.code();
    if !affine || !direct || gain == 0.0 {
        return None;
    }
    match bias {
        [_, stiffness, ..] if stiffness == -gain => Some(Servo::Position),
        [_, _, damping, ..] if damping == -gain => Some(Servo::Velocity),
        _ => None,
    }
}

fn first_dof(m: &Model, joint: usize) -> usize {
    m.jnt_dofadr[joint] as usize
}

fn width(m: &Model, joint: usize) -> usize {
    match m.jnt_type[joint] {
        kind if kind == JointType::Free.code() => 6,
        kind if kind == JointType::Ball.code() => 3,
        _ => 1,
    }
}
