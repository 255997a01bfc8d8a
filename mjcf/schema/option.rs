//! `option`: settings of the physics.

use physics::model::Options;

use super::Bind::{Int, Keyword, Own, Real, Reals};
use super::{ElementType, Kind, Row, Words, leaf, once, row};

/// `option`.
pub static OPTION: ElementType = leaf("option", "Physics settings", &[&OPTIONS]).children(&[once(&FLAG)]);
static FLAG: ElementType = leaf("flag", "Parts of the physics to switch on and off", &[&FLAGS]);

const INTEGRATORS: Words = &[("Euler", 0), ("RK4", 1), ("implicit", 2), ("implicitfast", 3)];
const CONES: Words = &[("pyramidal", 0), ("elliptic", 1)];
const JACOBIANS: Words = &[("dense", 0), ("sparse", 1), ("auto", 2)];
const SOLVERS: Words = &[("PGS", 0), ("CG", 1), ("Newton", 2)];
const ENABLE: Words = &[("disable", 0), ("enable", 1)];

/// Attributes of `option`.
pub static OPTIONS: [Row<Options>; 27] = [
    row("timestep", Real(|o| &mut o.timestep), "simulation time step, seconds"),
    row("impratio", Real(|o| &mut o.impratio), "frictional over normal constraint impedance"),
    row("tolerance", Real(|o| &mut o.tolerance), "solver stops below this scaled improvement"),
    row("ls_tolerance", Real(|o| &mut o.ls_tolerance), "line search stops below this scaled gradient"),
    row(
        "noslip_tolerance",
        Real(|o| &mut o.noslip_tolerance),
        "no-slip solver stops below this scaled improvement",
    ),
    row("ccd_tolerance", Real(|o| &mut o.ccd_tolerance), "convex collision tolerance"),
    row(
        "sleep_tolerance",
        Real(|o| &mut o.sleep_tolerance),
        "trees slower than this may sleep, radians per second",
    ),
    row("gravity", Reals { min: 3, field: |o| &mut o.gravity }, "gravitational acceleration, m/s²"),
    row("wind", Reals { min: 3, field: |o| &mut o.wind }, "velocity of the medium, m/s"),
    row("magnetic", Reals { min: 3, field: |o| &mut o.magnetic }, "global magnetic flux"),
    row("density", Real(|o| &mut o.density), "density of the medium, kg/m³"),
    row("viscosity", Real(|o| &mut o.viscosity), "viscosity of the medium, Pa s"),
    row("o_margin", Real(|o| &mut o.o_margin), "contact margin when overriding, metres"),
    row("o_solref", Reals { min: 1, field: |o| &mut o.o_solref }, "solver reference when overriding"),
    row("o_solimp", Reals { min: 1, field: |o| &mut o.o_solimp }, "solver impedance when overriding"),
    row("o_friction", Reals { min: 1, field: |o| &mut o.o_friction }, "contact friction when overriding"),
    row(
        "integrator",
        Keyword { words: INTEGRATORS, assign: |o, code| o.integrator = code },
        "numerical integrator",
    ),
    row("cone", Keyword { words: CONES, assign: |o, code| o.cone = code }, "shape of the friction cone"),
    row(
        "jacobian",
        Keyword { words: JACOBIANS, assign: |o, code| o.jacobian = code },
        "storage of the constraint Jacobian",
    ),
    row("solver", Keyword { words: SOLVERS, assign: |o, code| o.solver = code }, "constraint solver"),
    row("iterations", Int(|o| &mut o.iterations), "most solver iterations"),
    row("ls_iterations", Int(|o| &mut o.ls_iterations), "most line search iterations"),
    row("noslip_iterations", Int(|o| &mut o.noslip_iterations), "most no-slip iterations"),
    row("ccd_iterations", Int(|o| &mut o.ccd_iterations), "most convex collision iterations"),
    row(
        "sdf_iterations",
        Int(|o| &mut o.sdf_iterations),
        "gradient descent steps of signed-distance collision",
    ),
    row("sdf_initpoints", Int(|o| &mut o.sdf_initpoints), "starting points of signed-distance collision"),
    row(
        "actuatorgroupdisable",
        Own(Kind::Int { min: 0, max: Some(31) }),
        "groups of actuators that exert no force, 0 to 30",
    ),
];

/// Sets or clears a bit of a disable mask, whose bits are set to switch off.
const fn disable(mask: i32, bit: u32, on: i32) -> i32 {
    if on == 0 { mask | 1 << bit } else { mask & !(1 << bit) }
}

/// Sets or clears a bit of an enable mask.
const fn enable(mask: i32, bit: u32, on: i32) -> i32 {
    if on == 1 { mask | 1 << bit } else { mask & !(1 << bit) }
}

/// Attributes of `option/flag`.
pub static FLAGS: [Row<Options>; 26] = [
    row(
        "constraint",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 0, on) },
        "the constraint solver",
    ),
    row(
        "equality",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 1, on) },
        "equality constraints",
    ),
    row(
        "frictionloss",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 2, on) },
        "joint and tendon friction loss",
    ),
    row(
        "limit",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 3, on) },
        "joint and tendon limits",
    ),
    row(
        "contact",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 4, on) },
        "contacts",
    ),
    row(
        "spring",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 5, on) },
        "joint and tendon springs",
    ),
    row(
        "damper",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 6, on) },
        "joint and tendon dampers",
    ),
    row(
        "gravity",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 7, on) },
        "gravity",
    ),
    row(
        "clampctrl",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 8, on) },
        "clamping of controls",
    ),
    row(
        "warmstart",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 9, on) },
        "warm start of the solver",
    ),
    row(
        "filterparent",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 10, on) },
        "no contacts between parent and child",
    ),
    row(
        "actuation",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 11, on) },
        "actuator forces",
    ),
    row(
        "refsafe",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 12, on) },
        "time constants kept above two time steps",
    ),
    row(
        "sensor",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 13, on) },
        "sensors",
    ),
    row(
        "midphase",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 14, on) },
        "bounding volume trees inside a pair of bodies",
    ),
    row(
        "eulerdamp",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 15, on) },
        "implicit joint damping in Euler",
    ),
    row(
        "autoreset",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 16, on) },
        "reset on diverging state",
    ),
    row(
        "nativeccd",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 17, on) },
        "the native convex collision pipeline",
    ),
    row(
        "island",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 18, on) },
        "islands solved apart",
    ),
    row(
        "multiccd",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags = disable(o.disableflags, 19, on) },
        "several contacts per convex pair",
    ),
    row(
        "override",
        Keyword { words: ENABLE, assign: |o, on| o.enableflags = enable(o.enableflags, 0, on) },
        "one set of contact parameters for all",
    ),
    row(
        "energy",
        Keyword { words: ENABLE, assign: |o, on| o.enableflags = enable(o.enableflags, 1, on) },
        "energy computation",
    ),
    row(
        "fwdinv",
        Keyword { words: ENABLE, assign: |o, on| o.enableflags = enable(o.enableflags, 2, on) },
        "comparison of forward and inverse dynamics",
    ),
    row(
        "invdiscrete",
        Keyword { words: ENABLE, assign: |o, on| o.enableflags = enable(o.enableflags, 3, on) },
        "inverse dynamics in discrete time",
    ),
    row(
        "sleep",
        Keyword { words: ENABLE, assign: |o, on| o.enableflags = enable(o.enableflags, 4, on) },
        "sleeping of resting trees",
    ),
    row(
        "diagexact",
        Keyword { words: ENABLE, assign: |o, on| o.enableflags = enable(o.enableflags, 5, on) },
        "exact diagonal of the constraint inertia",
    ),
];
