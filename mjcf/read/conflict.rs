//! Conflicts between the settings of an attached model and of the model that attaches it (`compiler/conflict`).
//!
//! A setting counts as given when the text has the attribute, or, for sizes, when it is not the default. The
//! attaching model's value stands, is combined with the other, or the difference is an error.

use physics::model::{Disable, Enable};
use physics::table::Slice;

use super::authored::Authored;
use super::reader::Reader;
use crate::diagnostic::Loc;
use crate::spec::{Conflict, Size, Spec};

/// How two values become one.
#[derive(Clone, Copy, PartialEq)]
enum Merge {
    Least,
    Most,
    Never,
}
use Merge::{Least, Most, Never};

const SETTINGS: [(&str, Merge); 42] = [
    ("timestep", Least),
    ("tolerance", Least),
    ("ls_tolerance", Least),
    ("noslip_tolerance", Least),
    ("ccd_tolerance", Least),
    ("sleep_tolerance", Least),
    ("iterations", Most),
    ("ls_iterations", Most),
    ("noslip_iterations", Most),
    ("ccd_iterations", Most),
    ("sdf_iterations", Most),
    ("sdf_initpoints", Most),
    ("impratio", Never),
    ("density", Never),
    ("viscosity", Never),
    ("o_margin", Never),
    ("integrator", Never),
    ("cone", Never),
    ("jacobian", Never),
    ("solver", Never),
    ("gravity", Never),
    ("wind", Never),
    ("magnetic", Never),
    ("o_solref", Never),
    ("o_solimp", Never),
    ("o_friction", Never),
    ("znear", Least),
    ("realtime", Least),
    ("zfar", Most),
    ("memory", Most),
    ("njmax", Most),
    ("nconmax", Most),
    ("nuserdata", Most),
    ("nkey", Most),
    ("nuser_body", Most),
    ("nuser_jnt", Most),
    ("nuser_geom", Most),
    ("nuser_site", Most),
    ("nuser_cam", Most),
    ("nuser_tendon", Most),
    ("nuser_actuator", Most),
    ("nuser_sensor", Most),
];

/// What comes of one difference.
enum Finding {
    Warning(String),
    Error(String),
}

impl Reader<'_> {
    /// Settles the settings in which an attached model differs; `false` after an error.
    pub(crate) fn settle(&mut self, child: &Spec, child_authored: &Authored, loc: Loc) -> bool {
        let mode = self.spec.compiler.conflict;
        let mut findings = Vec::new();
        for (name, merge) in SETTINGS {
            findings.extend(self.settle_value(name, merge, mode, child, child_authored));
        }
        let (own, other) = (&self.authored, child_authored);
        let (mine, theirs) = (&mut self.spec.option, &child.option);
        let (mut off, mut on) = (mine.disableflags.bits(), mine.enableflags.bits());
        for (what, mine, theirs, authored) in [
            (
                "disabled flags",
                &mut off,
                theirs.disableflags.bits(),
                [own.disableflags.bits(), other.disableflags.bits()],
            ),
            (
                "enabled flags",
                &mut on,
                theirs.enableflags.bits(),
                [own.enableflags.bits(), other.enableflags.bits()],
            ),
            (
                "disabled actuator groups",
                &mut mine.disableactuator,
                theirs.disableactuator,
                [own.disableactuator, other.disableactuator],
            ),
        ] {
            findings.extend(settle_bits(what, mine, theirs, authored, mode));
        }
        (mine.disableflags, mine.enableflags) = (Disable::from_bits(off), Enable::from_bits(on));
        let mut settled = true;
        for finding in findings {
            match finding {
                Finding::Error(message) => {
                    settled = false;
                    self.error(loc, message);
                }
                Finding::Warning(message) => {
                    if self.warned.insert(message.clone()) {
                        self.warning(loc, message);
                    }
                }
            }
        }
        settled
    }

    fn settle_value(
        &mut self,
        name: &'static str,
        merge: Merge,
        mode: Conflict,
        child: &Spec,
        child_authored: &Authored,
    ) -> Option<Finding> {
        let (mine, theirs, default) =
            (value(&self.spec, name), value(child, name), value(&Spec::default(), name));
        if mine == theirs {
            return None;
        }
        let (mut own, mut other) = (self.authored.gives(name), child_authored.gives(name));
        if !own && !other {
            (own, other) = (mine != default, theirs != default);
        }
        if !other {
            return None;
        }
        let differ =
            format!("'{name}' is {mine:?} here and {:?} in the attached model '{}'", theirs, child.modelname);
        let taken = match (mode, own) {
            (Conflict::Error, true) => return Some(Finding::Error(differ)),
            (Conflict::Merge, true) if merge == Never => {
                return Some(Finding::Error(format!("{differ}: they cannot be merged")));
            }
            (Conflict::Merge, true) if merge == Least => theirs < mine,
            (Conflict::Merge, true) => theirs > mine,
            (Conflict::Merge, false) => true,
            _ => false,
        };
        if taken {
            set(&mut self.spec, name, &theirs);
        }
        let stands = if taken { "the attached model's value is taken" } else { "the value here stands" };
        Some(Finding::Warning(format!("{differ}: {stands}")))
    }
}

/// Settles bit masks; `authored` are the bits that each text gives.
fn settle_bits(
    what: &str,
    mine: &mut i32,
    theirs: i32,
    authored: [i32; 2],
    mode: Conflict,
) -> Option<Finding> {
    let [own, other] = if authored == [0, 0] { [!0, !0] } else { authored };
    let given = theirs & other;
    if given == 0 {
        return None;
    }
    if mode == Conflict::Merge {
        let added = given & !*mine;
        *mine |= given;
        return (added != 0)
            .then(|| Finding::Warning(format!("{what} of the attached model are added: {added:#b}")));
    }
    let differ = (*mine ^ theirs) & own & other;
    let message = format!("{what} differ from those of the attached model: {differ:#b}");
    match mode {
        _ if differ == 0 => None,
        Conflict::Error => Some(Finding::Error(message)),
        _ => Some(Finding::Warning(format!("{message}; those here stand"))),
    }
}

/// The numbers of a setting.
fn value(spec: &Spec, name: &str) -> Vec<f64> {
    let mut found = None;
    let mut look = |field: &'static str, values: Slice<'_>| {
        if field == name {
            found = Some(values.to_f64());
        }
    };
    spec.option.visit(&mut look);
    spec.visual.map.visit(&mut look);
    spec.visual.global.visit(&mut look);
    found.unwrap_or_else(|| vec![size(&spec.size, name)])
}

fn set(spec: &mut Spec, name: &str, values: &[f64]) {
    let found = spec
        .option
        .assign(name, values)
        .or_else(|| spec.visual.map.assign(name, values))
        .or_else(|| spec.visual.global.assign(name, values));
    if found.is_none() {
        set_size(&mut spec.size, name, values[0]);
    }
}

macro_rules! sizes {
    ($($optional:ident)*) => {
        fn size(size: &Size, name: &str) -> f64 {
            match name {
                "memory" => size.memory.map_or(-1.0, |v| v as f64),
                "nuserdata" => f64::from(size.nuserdata),
                "nkey" => f64::from(size.nkey),
                $(stringify!($optional) => size.$optional.map_or(-1.0, f64::from),)*
                _ => 0.0,
            }
        }

        fn set_size(size: &mut Size, name: &str, value: f64) {
            match name {
                "memory" => size.memory = Some(value as i64),
                "nuserdata" => size.nuserdata = value as i32,
                "nkey" => size.nkey = value as i32,
                $(stringify!($optional) => size.$optional = Some(value as i32),)*
                _ => {}
            }
        }
    };
}
sizes!(njmax nconmax nuser_body nuser_jnt nuser_geom nuser_site nuser_cam nuser_tendon nuser_actuator nuser_sensor);
