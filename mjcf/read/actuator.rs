//! `actuator`: transmissions, and shortcuts expanded to gain, bias and dynamics
//! (XML reference: `actuator`; documentation: Computation, actuation model).

use physics::model::{BiasType, DynType, GainType, TrnType};

use super::dc_motor;
use super::reader::Reader;
use crate::diagnostic::Loc;
use crate::schema::actuator::{ALONE, BLOCKS, MOTOR_ROWS, Shortcut, TOGETHER, shortcut_blocks};
use crate::spec::{Actuator, Limited};
use crate::xml::{Attribute, Element};

/// Transmissions by attribute; when several are present the last in this order counts.
const TRANSMISSIONS: [(&str, TrnType); 6] = [
    ("joint", TrnType::Joint),
    ("jointinparent", TrnType::Jointinparent),
    ("tendon", TrnType::Tendon),
    ("cranksite", TrnType::Slidercrank),
    ("site", TrnType::Site),
    ("body", TrnType::Body),
];

/// Parameters of a muscle where nothing else is said: range, force, scale, lmin, lmax, vmax, fpmax, fvmax.
const MUSCLE: [f64; 9] = [0.75, 1.05, -1.0, 200.0, 0.5, 1.6, 1.5, 1.3, 1.2];

impl Reader<'_> {
    pub(super) fn actuator(&mut self, section: &Element) {
        for element in &section.children {
            let class = self.class_of(element, "class", 0);
            let mut actuator = Actuator { loc: element.loc, ..self.spec.classes.of(class).actuator.clone() };
            if element.name == "plugin" {
                actuator.plugin = Some(self.plugin_use(element));
            }
            self.actuator_parameters(element, &mut actuator, false);
            self.spec.actuators.push(actuator);
        }
    }

    /// Everything an actuator element sets, in a default class or not.
    pub(crate) fn actuator_parameters(&mut self, element: &Element, actuator: &mut Actuator, defaults: bool) {
        for block in BLOCKS {
            match defaults {
                true => self.default_rows(element, block, actuator),
                false => self.rows(element, block, actuator),
            }
        }
        if !defaults {
            self.transmission(element, actuator);
        }
        let mut shortcut = Shortcut::default();
        for block in shortcut_blocks(&element.name) {
            self.rows(element, block, &mut shortcut);
        }
        if let Err(message) = apply(&element.name, &shortcut, actuator) {
            self.error(element.loc, message);
        }
        if element.name == "dcmotor" {
            let mut motor = dc_motor::inherited(actuator);
            if actuator.gaintype != GainType::Dcmotor {
                actuator.ctrlspec = 0;
            }
            self.rows(element, &MOTOR_ROWS, &mut motor);
            if let Err(message) = dc_motor::apply(&motor, actuator) {
                self.error(element.loc, message);
            }
        }
        if let Some(input) = element.attribute("input") {
            actuator.ctrlspec = self.input_signature(element, input).unwrap_or(actuator.ctrlspec);
        }
        self.warn_of_callbacks(element.loc, actuator);
    }

    /// The code of an `input` attribute: a chart of orientations, nothing, or bits of inputs in their order.
    fn input_signature(&mut self, element: &Element, input: &Attribute) -> Option<i32> {
        if let Some((_, code)) = ALONE.iter().find(|(word, _)| *word == input.value.trim()) {
            return Some(*code);
        }
        let codes = self.keywords(element, input, TOGETHER)?;
        if !codes.is_sorted() {
            self.error(
                input.value_loc,
                "attribute 'input': write the words in the order pos, vel, ff, voltage",
            );
        }
        Some(codes.iter().fold(0, |all, code| all | code))
    }

    /// Warns of what a program's callbacks compute in MuJoCo.
    fn warn_of_callbacks(&mut self, loc: Loc, actuator: &Actuator) {
        let dynamics = actuator.dyntype == DynType::User && actuator.plugin.is_none();
        let parts = [
            (dynamics, "dyntype", "activations keep their values"),
            (actuator.gaintype == GainType::User, "gaintype", "the gain is 1"),
            (actuator.biastype == BiasType::User, "biastype", "the bias is 0"),
        ];
        for (_, attribute, effect) in parts.into_iter().filter(|(is_user, ..)| *is_user) {
            self.warning(
                loc,
                format!("{attribute}=\"user\" is for a program's callbacks; without one {effect}"),
            );
        }
    }

    fn transmission(&mut self, element: &Element, actuator: &mut Actuator) {
        for (attribute, kind) in TRANSMISSIONS {
            if let Some(target) = element.value(attribute) {
                actuator.target = target.to_string();
                actuator.trntype = kind;
            }
        }
        let free = |kind| actuator.trntype == kind || actuator.trntype == TrnType::Undefined;
        let crank = element.attribute("cranklength").or(element.attribute("slidersite"));
        if let Some(attribute) = crank.filter(|_| !free(TrnType::Slidercrank)) {
            self.error(
                attribute.loc,
                format!("attribute '{}' needs the attribute 'cranksite'", attribute.name),
            );
        }
        if let Some(attribute) = element.attribute("refsite").filter(|_| !free(TrnType::Site)) {
            self.error(attribute.loc, "attribute 'refsite' needs the attribute 'site'");
        }
        if let Some(site) = element.value("slidersite") {
            actuator.slidersite = site.to_string();
        }
        if let Some(site) = element.value("refsite") {
            actuator.refsite = site.to_string();
        }
    }
}

/// Sets gain, bias and dynamics as the shortcut with this tag means them.
fn apply(tag: &str, s: &Shortcut, a: &mut Actuator) -> Result<(), String> {
    match tag {
        "motor" => {
            a.gainprm[0] = 1.0;
            kinds(a, DynType::None, GainType::Fixed, BiasType::None);
            Ok(())
        }
        "position" => position(s, a),
        "intvelocity" => {
            position(s, a)?;
            a.dyntype = DynType::Integrator;
            not_both(s, a.actrange, "actrange")
        }
        "velocity" => {
            let kv = s.kv.unwrap_or(a.gainprm[0]);
            a.biasprm = [0.0; 10];
            a.gainprm[0] = kv;
            a.biasprm[2] = -kv;
            kinds(a, DynType::None, GainType::Fixed, BiasType::Affine);
            Ok(())
        }
        "damper" => damper(s, a),
        "cylinder" => {
            cylinder(s, a);
            Ok(())
        }
        "muscle" => muscle(s, a),
        "adhesion" => adhesion(s, a),
        "orientation" => {
            servo_damping(s, a)?;
            let kp = s.kp.unwrap_or(a.gainprm[0]);
            (a.gainprm[0], a.biasprm[1]) = (kp, -kp);
            kinds(a, DynType::None, GainType::So3, BiasType::So3);
            Ok(())
        }
        "pid" => pid(s, a),
        // `general` says it all itself.
        _ => Ok(()),
    }
}

fn kinds(a: &mut Actuator, dynamics: DynType, gain: GainType, bias: BiasType) {
    a.dyntype = dynamics;
    a.gaintype = gain;
    a.biastype = bias;
}

fn not_negative(value: Option<f64>, name: &str) -> Result<(), String> {
    match value {
        Some(x) if x < 0.0 => Err(format!("attribute '{name}' is negative: set it to 0 or more")),
        _ => Ok(()),
    }
}

fn not_both(s: &Shortcut, range: [f64; 2], name: &str) -> Result<(), String> {
    let inherits = s.inheritrange.is_some_and(|x| x > 0.0);
    match inherits && range != [0.0; 2] {
        true => Err(format!("attributes '{name}' and 'inheritrange' exclude each other")),
        false => Ok(()),
    }
}

/// A negative `biasprm[2]` is damping, a positive one a damping ratio to be resolved by the compiler.
fn servo_damping(s: &Shortcut, a: &mut Actuator) -> Result<(), String> {
    if s.kv.is_some() && s.dampratio.is_some() {
        return Err("attributes 'kv' and 'dampratio' exclude each other".into());
    }
    not_negative(s.kv, "kv")?;
    not_negative(s.dampratio, "dampratio")?;
    if let Some(damping) = s.kv.map(|kv| -kv).or(s.dampratio) {
        a.biasprm[2] = damping;
    }
    Ok(())
}

fn pid(s: &Shortcut, a: &mut Actuator) -> Result<(), String> {
    let inherited = if a.dyntype == DynType::Pid { 1.0 } else { 0.0 };
    a.biasprm[1] = -s.kp.unwrap_or(-a.biasprm[1]);
    servo_damping(s, a)?;
    not_negative(s.slewmax, "slewmax")?;
    let ki = s.ki.unwrap_or(a.gainprm[0] * inherited);
    let slewmax = s.slewmax.unwrap_or(a.dynprm[1] * inherited);
    let imax = s.imax.unwrap_or(a.dynprm[0] * inherited);
    (a.gainprm[0], a.dynprm[1]) = (ki, slewmax);
    if ki != 0.0 {
        a.dynprm[0] = imax;
    }
    let dynamics = if ki != 0.0 || slewmax != 0.0 { DynType::Pid } else { DynType::None };
    a.inheritrange = s.inheritrange.unwrap_or(a.inheritrange);
    kinds(a, dynamics, GainType::Pid, BiasType::Affine);
    let inherits = Shortcut { inheritrange: Some(a.inheritrange), ..Shortcut::default() };
    not_both(&inherits, a.ctrlrange, "ctrlrange")
}

fn position(s: &Shortcut, a: &mut Actuator) -> Result<(), String> {
    let kp = s.kp.unwrap_or(a.gainprm[0]);
    a.gainprm[0] = kp;
    a.biasprm[1] = -kp;
    servo_damping(s, a)?;
    not_negative(s.timeconst, "timeconst")?;
    if let Some(timeconst) = s.timeconst {
        a.dynprm[0] = timeconst;
        a.dyntype = if timeconst == 0.0 { DynType::None } else { DynType::Filterexact };
    }
    a.inheritrange = s.inheritrange.unwrap_or(a.inheritrange);
    a.gaintype = GainType::Fixed;
    a.biastype = BiasType::Affine;
    let inherits = Shortcut { inheritrange: Some(a.inheritrange), ..Shortcut::default() };
    not_both(&inherits, a.ctrlrange, "ctrlrange")
}

fn damper(s: &Shortcut, a: &mut Actuator) -> Result<(), String> {
    let inherited = if a.gaintype == GainType::Affine { -a.gainprm[2] } else { 0.0 };
    let kv = s.kv.unwrap_or(inherited);
    a.gainprm = [0.0; 10];
    a.gainprm[2] = -kv;
    a.ctrllimited = Limited::True;
    kinds(a, DynType::None, GainType::Affine, BiasType::None);
    not_negative(Some(kv), "kv")?;
    not_negative(Some(a.ctrlrange[0].min(a.ctrlrange[1])), "ctrlrange")
}

fn cylinder(s: &Shortcut, a: &mut Actuator) {
    a.dynprm[0] = s.timeconst.unwrap_or(a.dynprm[0]);
    if let Some(bias) = s.bias {
        a.biasprm[..3].copy_from_slice(&bias);
    }
    a.gainprm[0] = s.area.unwrap_or(a.gainprm[0]);
    if let Some(diameter) = s.diameter.filter(|d| *d >= 0.0) {
        a.gainprm[0] = std::f64::consts::PI / 4.0 * diameter * diameter;
    }
    kinds(a, DynType::Filter, GainType::Fixed, BiasType::Affine);
}

/// Values equal to a plain actuator's count as unset; negative ones leave what the class has.
fn muscle(s: &Shortcut, a: &mut Actuator) -> Result<(), String> {
    let plain = |i: usize| if i == 0 { 1.0 } else { 0.0 };
    for (i, default) in [0.01, 0.04].into_iter().enumerate() {
        if a.dynprm[i] == plain(i) {
            a.dynprm[i] = default;
        }
    }
    for (i, default) in MUSCLE.into_iter().enumerate() {
        if a.gainprm[i] == plain(i) {
            a.gainprm[i] = default;
        }
    }
    not_negative(s.tausmooth, "tausmooth")?;
    a.dynprm[2] = s.tausmooth.unwrap_or(a.dynprm[2]);
    let set = |slot: &mut f64, value: Option<f64>| {
        if let Some(x) = value.filter(|x| *x >= 0.0) {
            *slot = x;
        }
    };
    for i in 0..2 {
        set(&mut a.dynprm[i], s.muscle_timeconst.map(|t| t[i]));
        set(&mut a.gainprm[i], s.range.map(|r| r[i]));
    }
    for (slot, value) in a.gainprm[2..9].iter_mut().zip(s.curve) {
        set(slot, value);
    }
    a.biasprm[..9].copy_from_slice(&a.gainprm[..9]);
    kinds(a, DynType::Muscle, GainType::Muscle, BiasType::Muscle);
    Ok(())
}

fn adhesion(s: &Shortcut, a: &mut Actuator) -> Result<(), String> {
    a.gainprm[0] = s.gain.unwrap_or(a.gainprm[0]);
    a.ctrllimited = Limited::True;
    a.gaintype = GainType::Fixed;
    a.biastype = BiasType::None;
    not_negative(Some(a.gainprm[0]), "gain")?;
    not_negative(Some(a.ctrlrange[0].min(a.ctrlrange[1])), "ctrlrange")
}
