//! `option`: settings of the physics.

use physics::model::{Cone, Disable, Enable, Integrator, Jacobian, Options, Solver};

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
        Keyword {
            words: INTEGRATORS,
            assign: |o, code| o.integrator = Integrator::from_code(code).unwrap_or(o.integrator),
        },
        "numerical integrator",
    ),
    row(
        "cone",
        Keyword { words: CONES, assign: |o, code| o.cone = Cone::from_code(code).unwrap_or(o.cone) },
        "shape of the friction cone",
    ),
    row(
        "jacobian",
        Keyword {
            words: JACOBIANS,
            assign: |o, code| o.jacobian = Jacobian::from_code(code).unwrap_or(o.jacobian),
        },
        "storage of the constraint Jacobian",
    ),
    row(
        "solver",
        Keyword { words: SOLVERS, assign: |o, code| o.solver = Solver::from_code(code).unwrap_or(o.solver) },
        "constraint solver",
    ),
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

/// Attributes of `option/flag`.
pub static FLAGS: [Row<Options>; 26] = [
    row(
        "constraint",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::CONSTRAINT, on == 0) },
        "the constraint solver",
    ),
    row(
        "equality",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::EQUALITY, on == 0) },
        "equality constraints",
    ),
    row(
        "frictionloss",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::FRICTIONLOSS, on == 0) },
        "joint and tendon friction loss",
    ),
    row(
        "limit",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::LIMIT, on == 0) },
        "joint and tendon limits",
    ),
    row(
        "contact",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::CONTACT, on == 0) },
        "contacts",
    ),
    row(
        "spring",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::SPRING, on == 0) },
        "joint and tendon springs",
    ),
    row(
        "damper",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::DAMPER, on == 0) },
        "joint and tendon dampers",
    ),
    row(
        "gravity",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::GRAVITY, on == 0) },
        "gravity",
    ),
    row(
        "clampctrl",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::CLAMPCTRL, on == 0) },
        "clamping of controls",
    ),
    row(
        "warmstart",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::WARMSTART, on == 0) },
        "warm start of the solver",
    ),
    row(
        "filterparent",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::FILTERPARENT, on == 0) },
        "no contacts between parent and child",
    ),
    row(
        "actuation",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::ACTUATION, on == 0) },
        "actuator forces",
    ),
    row(
        "refsafe",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::REFSAFE, on == 0) },
        "time constants kept above two time steps",
    ),
    row(
        "sensor",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::SENSOR, on == 0) },
        "sensors",
    ),
    row(
        "midphase",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::MIDPHASE, on == 0) },
        "bounding volume trees inside a pair of bodies",
    ),
    row(
        "eulerdamp",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::EULERDAMP, on == 0) },
        "implicit joint damping in Euler",
    ),
    row(
        "autoreset",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::AUTORESET, on == 0) },
        "reset on diverging state",
    ),
    row(
        "nativeccd",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::NATIVECCD, on == 0) },
        "the native convex collision pipeline",
    ),
    row(
        "island",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::ISLAND, on == 0) },
        "islands solved apart",
    ),
    row(
        "multiccd",
        Keyword { words: ENABLE, assign: |o, on| o.disableflags.set(Disable::MULTICCD, on == 0) },
        "several contacts per convex pair",
    ),
    row(
        "override",
        Keyword { words: ENABLE, assign: |o, on| o.enableflags.set(Enable::OVERRIDE, on == 1) },
        "one set of contact parameters for all",
    ),
    row(
        "energy",
        Keyword { words: ENABLE, assign: |o, on| o.enableflags.set(Enable::ENERGY, on == 1) },
        "energy computation",
    ),
    row(
        "fwdinv",
        Keyword { words: ENABLE, assign: |o, on| o.enableflags.set(Enable::FWDINV, on == 1) },
        "comparison of forward and inverse dynamics",
    ),
    row(
        "invdiscrete",
        Keyword { words: ENABLE, assign: |o, on| o.enableflags.set(Enable::INVDISCRETE, on == 1) },
        "inverse dynamics in discrete time",
    ),
    row(
        "sleep",
        Keyword { words: ENABLE, assign: |o, on| o.enableflags.set(Enable::SLEEP, on == 1) },
        "sleeping of resting trees",
    ),
    row(
        "diagexact",
        Keyword { words: ENABLE, assign: |o, on| o.enableflags.set(Enable::DIAGEXACT, on == 1) },
        "exact diagonal of the constraint inertia",
    ),
];
