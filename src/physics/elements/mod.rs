//! Elements of a model by name: typed ids, and views of what the model says of an element and of what a simulation
//! makes of it.
//!
//! A name is looked up once, in the model; the id it yields holds all addresses of the element, so that
//! [`Data`](crate::Data), which does not know its model, can be read and written with it at the cost of an index:
//!
//! | call | result |
//! |---|---|
//! | `m.joint("elbow")` | `Option<JointId>`, by a hash table |
//! | `m.joint(id)` | what the model says: `.name()`, `.range()`, `.body()` |
//! | `m.joints()`, `m.joint_names()` | all of them |
//! | `d.joint(id)` | what a simulation says: `.qpos()`, `.qvel()` |
//! | `d.joint_mut(id)` | the same to write: `.set_qpos(…)` |
//!
//! An id also indexes the arrays of its kind: `m.jnt_range[id]`, and to write, `m.edit(|m| m.jnt_range[id] = [0.0, 1.0])`.
//!
//! The same holds for bodies, geoms, sites, cameras, lights, tendons, actuators, sensors and equality constraints;
//! meshes, textures and the like have ids and names. An id belongs to its model, to clones of it, to
//! models edited from it, and to models of the same structure: the same elements, with the same names, in the same order,
//! as when a text is loaded twice. Debug builds keep a digest of the structure in ids and data, and the calls above panic
//! with an id of another model. Release builds do not check: a view then shows another element, or panics where there is
//! none. Arrays indexed by an id are checked in neither, since they do not know their model.
//!
//! ```
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><body name='arm'><joint name='elbow' axis='0 1 0'/>
//!        <geom type='capsule' fromto='0 0 0 .3 0 0' size='.02'/></body></worldbody>
//!      <actuator><motor name='pull' joint='elbow'/></actuator></mujoco>",
//! )?
//! .model;
//! let elbow = model.joint("elbow").ok_or("no elbow")?;
//! let pull = model.actuator("pull").ok_or("no pull")?;
//! assert!(model.joint("knee").is_none());
//! assert_eq!(model.joint(elbow).body(), model.body("arm").unwrap());
//!
//! let mut data = robohive_physics::Data::new(&model);
//! data.actuator_mut(pull).set_ctrl(2.0);
//! robohive_physics::step(&model, &mut data)?;
//! assert!(data.joint(elbow).qvel()[0] > 0.0);
//! assert_eq!(data.actuator(pull).force(), [2.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod contact;
mod data;
mod element;
mod find;
mod ids;
mod model;
mod query;

pub use contact::ContactView;
pub use data::{DataView, DataViewMut, MocapPose};
pub use element::Element;
pub use find::Key;
pub use ids::{
    ActuatorId, BodyId, CameraId, EqualityId, ExcludeId, GeomId, HfieldId, JointId, KeyId, LightId,
    MaterialId, MeshId, NumericId, PairId, SensorId, SiteId, SkinId, TendonId, TextId, TextureId, TupleId,
};
pub use model::ModelView;
