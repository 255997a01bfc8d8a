//! Options of the physics, edited while it runs.

use crate::session::Session;
use eframe::egui::{ComboBox, DragValue, Ui};
use physics::model::{Cone, Disable, Enable, Integrator, Jacobian, Options, Solver};

/// Groups of actuators that can be switched.
const GROUPS: usize = 6;

/// A numeric option: its name, and where it stands.
type Number = (&'static str, fn(&mut Options) -> &mut f64);
/// An option that counts.
type Count = (&'static str, fn(&mut Options) -> &mut i32);

const NUMBERS: [Number; 10] = [
    ("timestep", |o| &mut o.timestep),
    ("tolerance", |o| &mut o.tolerance),
    ("ls_tolerance", |o| &mut o.ls_tolerance),
    ("noslip_tolerance", |o| &mut o.noslip_tolerance),
    ("ccd_tolerance", |o| &mut o.ccd_tolerance),
    ("sleep_tolerance", |o| &mut o.sleep_tolerance),
    ("impratio", |o| &mut o.impratio),
    ("density", |o| &mut o.density),
    ("viscosity", |o| &mut o.viscosity),
    ("o_margin", |o| &mut o.o_margin),
];

const COUNTS: [Count; 6] = [
    ("iterations", |o| &mut o.iterations),
    ("ls_iterations", |o| &mut o.ls_iterations),
    ("noslip_iterations", |o| &mut o.noslip_iterations),
    ("ccd_iterations", |o| &mut o.ccd_iterations),
    ("sdf_iterations", |o| &mut o.sdf_iterations),
    ("sdf_initpoints", |o| &mut o.sdf_initpoints),
];

const DISABLE: [(&str, Disable); 20] = [
    ("Constraint", Disable::CONSTRAINT),
    ("Equality", Disable::EQUALITY),
    ("Friction loss", Disable::FRICTIONLOSS),
    ("Limit", Disable::LIMIT),
    ("Contact", Disable::CONTACT),
    ("Spring", Disable::SPRING),
    ("Damper", Disable::DAMPER),
    ("Gravity", Disable::GRAVITY),
    ("Clamp controls", Disable::CLAMPCTRL),
    ("Warm start", Disable::WARMSTART),
    ("Filter parent", Disable::FILTERPARENT),
    ("Actuation", Disable::ACTUATION),
    ("Safe reference", Disable::REFSAFE),
    ("Sensor", Disable::SENSOR),
    ("Midphase", Disable::MIDPHASE),
    ("Euler damping", Disable::EULERDAMP),
    ("Automatic reset", Disable::AUTORESET),
    ("Native convex collision", Disable::NATIVECCD),
    ("Island", Disable::ISLAND),
    ("Multiple convex contacts", Disable::MULTICCD),
];

const ENABLE: [(&str, Enable); 6] = [
    ("Override", Enable::OVERRIDE),
    ("Energy", Enable::ENERGY),
    ("Forward and inverse", Enable::FWDINV),
    ("Discrete inverse", Enable::INVDISCRETE),
    ("Sleep", Enable::SLEEP),
    ("Exact diagonal", Enable::DIAGEXACT),
];

/// Solver, integrator, numbers, switches.
pub fn options(ui: &mut Ui, session: &mut Session) {
    let mut options = session.model().opt.clone();
    choice(ui, "Integrator", &mut options.integrator);
    choice(ui, "Cone", &mut options.cone);
    choice(ui, "Jacobian", &mut options.jacobian);
    choice(ui, "Solver", &mut options.solver);
    for (name, field) in NUMBERS {
        let value = field(&mut options);
        let speed = value.abs().max(1e-9) * 0.01;
        row(ui, name, DragValue::new(value).speed(speed).range(0.0..=1e6).max_decimals(12));
    }
    for (name, field) in COUNTS {
        row(ui, name, DragValue::new(field(&mut options)).range(0..=10_000));
    }
    for (name, vector) in
        [("gravity", &mut options.gravity), ("wind", &mut options.wind), ("magnetic", &mut options.magnetic)]
    {
        ui.horizontal(|ui| {
            vector.iter_mut().for_each(|x| drop(ui.add(DragValue::new(x).speed(0.05))));
            ui.label(name);
        });
    }
    ui.collapsing("Contact override", |ui| {
        for (name, values) in [
            ("o_solref", &mut options.o_solref[..]),
            ("o_solimp", &mut options.o_solimp[..]),
            ("o_friction", &mut options.o_friction[..]),
        ] {
            ui.horizontal(|ui| {
                values.iter_mut().for_each(|x| drop(ui.add(DragValue::new(x).speed(0.005).max_decimals(6))));
                ui.label(name);
            });
        }
    });
    ui.collapsing("Actuator groups", |ui| {
        ui.horizontal(|ui| {
            for group in 0..GROUPS {
                let mut on = options.disableactuator & (1 << group) == 0;
                let hint = format!("actuators of group {group} make force");
                if ui.toggle_value(&mut on, group.to_string()).on_hover_text(hint).changed() {
                    options.disableactuator ^= 1 << group;
                }
            }
        });
    });
    ui.collapsing("Disabled", |ui| {
        for (name, bit) in DISABLE {
            let mut on = options.disableflags.contains(bit);
            if ui.checkbox(&mut on, name).changed() {
                options.disableflags.set(bit, on);
            }
        }
    });
    ui.collapsing("Enabled", |ui| {
        for (name, bit) in ENABLE {
            let mut on = options.enableflags.contains(bit);
            if ui.checkbox(&mut on, name).changed() {
                options.enableflags.set(bit, on);
            }
        }
    });
    if options != session.model().opt {
        session.edit_options(|now| *now = options);
    }
}

fn row(ui: &mut Ui, name: &str, value: DragValue<'_>) {
    ui.horizontal(|ui| {
        ui.add(value);
        ui.label(name);
    });
}

/// An option with a few values.
trait Choice: Copy + PartialEq + 'static {
    const ALL: &'static [(&'static str, Self)];
}

impl Choice for Integrator {
    const ALL: &'static [(&'static str, Self)] = &[
        ("Euler", Integrator::Euler),
        ("RK4", Integrator::Rk4),
        ("implicit", Integrator::Implicit),
        ("implicitfast", Integrator::Implicitfast),
    ];
}

impl Choice for Cone {
    const ALL: &'static [(&'static str, Self)] =
        &[("pyramidal", Cone::Pyramidal), ("elliptic", Cone::Elliptic)];
}

impl Choice for Jacobian {
    const ALL: &'static [(&'static str, Self)] =
        &[("auto", Jacobian::Auto), ("dense", Jacobian::Dense), ("sparse", Jacobian::Sparse)];
}

impl Choice for Solver {
    const ALL: &'static [(&'static str, Self)] =
        &[("PGS", Solver::Pgs), ("CG", Solver::Cg), ("Newton", Solver::Newton)];
}

fn choice<T: Choice>(ui: &mut Ui, label: &str, value: &mut T) {
    let name = T::ALL.iter().find(|(_, each)| each == value).map_or("", |(name, _)| name);
    ComboBox::from_label(label).selected_text(name).show_ui(ui, |ui| {
        for (name, each) in T::ALL {
            ui.selectable_value(value, *each, *name);
        }
    });
}
