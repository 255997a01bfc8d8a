//! MJCF models under [rapier](https://rapier.rs), with tendons, muscles, actuators, sensors and MuJoCo's rules of contact.
//!
//! Rapier does not follow MuJoCo, so this project's own pipeline stays the default. This crate is for programs that already simulate
//! with rapier and need a robot from MJCF among their bodies ([`Robot`]), for programs that need the geoms of a model as shapes of parry
//! ([`shapes_of`]), and for running a whole environment with rapier's contact solver ([`engine`]). It contains no C, and is not built by
//! default.
//!
//! ```
//! use physics::Data;
//! use robohive_rapier::{Options, engine};
//!
//! let text = "<mujoco><worldbody><geom type='plane' size='1 1 1'/>
//!     <body pos='0 0 .3'><freejoint/><geom type='box' size='.1 .1 .1'/></body></worldbody></mujoco>";
//! let model = mjcf::load_str(text)?.model;
//! let mut mover = engine(Options::default()).start(&model)?;
//! let mut data = Data::new(&model);
//! (0..500).try_for_each(|_| mover.step(&model, &mut data))?;
//! assert!((data.state.qpos[2] - 0.1).abs() < 1e-3);
//! assert_eq!(data.con.contact.len(), 4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Division of work
//! In each substep our own stages compute all forces except contact forces from rapier's positions and velocities: weight,
//! Coriolis and fluid forces, springs and dampers, tendons with their wrapping, muscles with their activation, every actuator,
//! gravity compensation; and, with our own solver, joint limits, dry friction and equality constraints. Rapier has no input for
//! generalised forces, so their sum is passed in two parts through its public interface:
//!
//! 1. the generalised velocities of its multibodies are set to those that result from these forces at the end of the step;
//! 2. wrenches on its bodies cancel rapier's own gyroscopic and Coriolis terms at those velocities, which our stages already
//!    include. A joint's force is a torque, or a force through the moved centre of mass, on the body that the joint moves,
//!    and the opposite on its parent.
//!
//! Rapier computes the rest: collision detection, contacts with friction, and the resulting motion. So
//! motion without contacts equals that of our pipeline up to rounding (of poses, over the length of a step), for all types of joints; rapier's integration
//! (implicit in Coriolis forces and springs), damping, armature and limits have no effect. Where equality constraints are active and
//! there are contact forces, the step is repeated with the contact forces as given ones, because rapier solves contacts without these
//! constraints.
//!
//! After a step a [`Data`](physics::Data) has the same contents as after a step of our own pipeline: the new state, and poses, contacts, forces and
//! sensor readings of the previous state. Its constraint rows of contacts have a force and no Jacobian
//! ([`push_applied`](physics::constraint::push_applied)).
//!
//! # Corrections of stock rapier
//! | stock rapier 0.36.1 | here |
//! |---|---|
//! | 0.1 N m s of damping on every rotation of a multibody | none |
//! | a floating root whose centre of mass is not its origin breaks the conservation of momentum | its origin is put there |
//! | moments of inertia of about 1e-5 kg m² and less are permuted in bodies with colliders | the body lies along its principal axes |
//! | velocity of a floating body is that of its centre of mass, in the world | translated from and to MuJoCo's, exactly over a step |
//! | bodies that stand alone turn by a linearised rotation, in each iteration of `h` seconds `2 atan(h w / 2)` for `h w` | the velocity is scaled, and scaled back |
//! | bodies that stand alone get gyroscopic torques of their own | switched off: they are in our forces |
//! | 45 degrees and 400 m/s at most a step | no bound |
//! | looks 2 cm ahead, solves four parts of a step | 2 mm; one part where joints are, four for free bodies ([`Options`]) |
//! | bodies fall asleep; contacts are kept while bodies move less than 5 cm; fast bodies stop at obstacles | off |
//!
//! # Choices
//! | MuJoCo | here |
//! |---|---|
//! | contact types and affinities, excluded and predefined pairs, welded bodies, parents | the same |
//! | friction: maximum, or by priority, or the pair's | the same; only the first of a pair's two coefficients |
//! | `condim` 1 | no friction |
//! | `condim` 4 and 6 | as 3: rapier has no torsional or rolling friction |
//! | `solref`, `solimp`, `solmix`, `margin` and `gap` of contacts | one softness for all contacts ([`World::parameters_mut`]) |
//! | those of limits, dry friction and equality constraints | the same |
//! | pyramidal or elliptic cone | rapier's circular cone; forces are converted to the model's cone |
//! | integrator `RK4` | Euler's method; the other integrators are used as in the model |
//! | mocap bodies | moved to their pose, without a velocity |
//! | sleeping trees | no sleep |
//! | shapes | see [`shapes_of`] for which are exact |
//! | height fields | a surface without its base |
//!
//! Refused, with the name of the element: flexes, signed distance fields and meshes without volume that can collide, adhesion,
//! moving surfaces, joints below a mocap body.
//!
//! # What cannot be helped from outside
//! Defects with reproductions stand in `DEFECTS.md`.
//!
//! Rapier solves contacts by its own softness for the whole world, with a frozen Jacobian and a single sweep: resting depths and
//! the course of an impact differ from MuJoCo's (`validation/results/rapier.md` has by how much). Contacts do not see joint limits
//! in the same sweep, as limits are ours: a finger that is pushed against its limit gives by a step. A contact row in a direction
//! that the joints hardly move in is not regularised, and makes impulses without bound: RoboHive's `franka_robotiq.xml`, whose
//! gripper begins inside a table, is unstable. Each step costs two dense factorisations of
//! the joint-space inertia.
//!
//! # What is not here
//! Limits, dry friction and equality constraints solved by rapier in the same sweep as contacts; meshes decomposed into convex
//! parts ([`shapes_of`]); batches (`physics::Batch`) and the viewer under another engine than our own; contacts of a
//! [`Robot`] with other bodies among those of its `Data`; a state of this engine in what
//! environments pickle, which begin afresh there.

pub use parry3d_f64 as parry;
pub use rapier3d_f64 as rapier;

mod body;
mod convert;
mod floating;
mod forces;
mod groups;
mod links;
mod measure;
mod refuse;
mod robot;
mod rules;
mod shapes;
mod stepper;
mod touch;
mod world;

pub use measure::{Differences, Measures, refusals};
pub use refuse::check;
pub use robot::{Hooks, Robot};
pub use shapes::{GeomShape, shape_of, shapes_of};
pub use stepper::Rapier;
pub use world::{Options, World};

/// Rapier as an engine, named "rapier".
pub fn engine(options: Options) -> physics::Engine {
    physics::Engine::new("rapier", move |m| Ok(Box::new(Rapier::new(m, options)?)))
}
