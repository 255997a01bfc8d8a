//! `dcmotor`: data sheet values to the parameters of the general actuator (XML reference: `actuator/dcmotor`).

use physics::model::{BiasType, DynType, GainType};

use crate::schema::actuator::Motor;
use crate::spec::{Actuator, Limited};

/// What a default class says already.
pub(super) fn inherited(a: &Actuator) -> Motor {
    if a.gaintype != GainType::Dcmotor {
        return Motor::default();
    }
    let (g, d, b) = (&a.gainprm, &a.dynprm, &a.biasprm);
    Motor {
        motorconst: [g[1], 0.0],
        resistance: g[0],
        nominal: [0.0; 3],
        saturation: [0.0, 0.0, d[1]],
        inductance: [0.0, d[0]],
        cogging: [b[0], b[1], b[2]],
        controller: [g[4], g[5], g[6], d[7], d[8], g[7]],
        thermal: [d[2], d[3], 0.0, g[2], g[3], d[4]],
        lugre: [d[5], d[6], b[3], b[4], b[5]],
    }
}

/// Sets gain, bias and dynamics of a motor.
pub(super) fn apply(motor: &Motor, a: &mut Actuator) -> Result<(), String> {
    let (constant, resistance) = constants(motor, a.damping[0])?;
    let [kp, ki, kd, slewmax, integral_max, supply] = motor.controller;
    (a.dyntype, a.gaintype, a.biastype) = (DynType::Dcmotor, GainType::Dcmotor, BiasType::Dcmotor);
    (a.gainprm[0], a.gainprm[1]) = (resistance, constant);
    a.gainprm[4..7].copy_from_slice(&[kp, ki, kd]);
    (a.dynprm[7], a.dynprm[8]) = (slewmax, integral_max);
    if supply > 0.0 {
        a.gainprm[7] = supply;
    }
    let [most_torque, most_current, most_rate] = motor.saturation;
    if most_torque > 0.0 || most_current > 0.0 {
        let most = if most_torque == 0.0 { constant * most_current } else { most_torque };
        a.forcerange = [-most, most];
        a.forcelimited = Limited::True;
    }
    if most_rate > 0.0 {
        a.dynprm[1] = most_rate;
    }
    a.biasprm[..3].copy_from_slice(&motor.cogging);
    let [inductance, time] = motor.inductance;
    if inductance < 0.0 || time < 0.0 {
        return Err("attribute 'inductance' is negative: set it to 0 or more".into());
    }
    a.dynprm[0] = if inductance > 0.0 { inductance / resistance } else { time };
    let heats = heat(motor, a)?;
    let rubs = motor.lugre[0] > 0.0;
    if rubs {
        a.dynprm[5..7].copy_from_slice(&motor.lugre[..2]);
        a.biasprm[3..6].copy_from_slice(&motor.lugre[2..]);
    }
    let states = [a.dynprm[0] > 0.0, slewmax > 0.0, ki > 0.0, heats, rubs];
    a.actdim = states.iter().filter(|&&s| s).count() as i32;
    a.gainprm[8] = 0.0;
    a.actlimited = Limited::False;
    a.actearly = true;
    Ok(())
}

/// Motor constant and resistance, given or derived from nominal voltage, stall torque and no-load speed.
fn constants(motor: &Motor, damping: f64) -> Result<(f64, f64), String> {
    let [torque_constant, mut back_emf] = motor.motorconst;
    let [volts, stall, speed] = motor.nominal;
    let mut r = motor.resistance;
    if volts > 0.0 && back_emf <= 0.0 && speed > 0.0 {
        back_emf = volts / speed;
        if damping > 0.0 && r > 0.0 {
            let root = volts * volts - 4.0 * r * damping * speed * speed;
            if root > 0.0 {
                back_emf = (volts + root.sqrt()) / (2.0 * speed);
            }
        } else if damping > 0.0 && stall > 0.0 {
            let exact = volts / speed - volts * damping / stall;
            if exact > 0.0 {
                back_emf = exact;
            }
        }
    }
    let constant = if torque_constant > 0.0 && back_emf > 0.0 {
        (torque_constant * back_emf).sqrt()
    } else if torque_constant > 0.0 {
        torque_constant
    } else {
        back_emf
    };
    if r == 0.0 && volts > 0.0 && stall > 0.0 && constant > 0.0 {
        r = constant * volts / stall;
    }
    match (constant > 0.0, r > 0.0) {
        (false, _) => Err("a DC motor needs a positive motor constant".into()),
        (_, false) => Err("a DC motor needs a positive resistance".into()),
        _ => Ok((constant, r)),
    }
}

/// Sets the thermal parameters; whether the motor heats up.
fn heat(motor: &Motor, a: &mut Actuator) -> Result<bool, String> {
    let [mut resistance, mut capacity, time, coefficient, reference, ambient] = motor.thermal;
    if resistance <= 0.0 && capacity <= 0.0 && time <= 0.0 {
        return Ok(false);
    }
    if time > 0.0 && resistance > 0.0 && capacity == 0.0 {
        capacity = time / resistance;
    } else if time > 0.0 && capacity > 0.0 && resistance == 0.0 {
        resistance = time / capacity;
    }
    if resistance <= 0.0 || capacity <= 0.0 {
        return Err("thermal resistance and capacity of a DC motor must be positive".into());
    }
    a.dynprm[2..5].copy_from_slice(&[resistance, capacity, ambient]);
    a.gainprm[2..4].copy_from_slice(&[coefficient, reference]);
    Ok(true)
}
