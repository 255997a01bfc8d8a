//! How plugins change the picture of a state.
//!
//! ```
//! use robohive_physics::pipeline::appearance::appearance;
//! use robohive_physics::model::Appearance;
//! use robohive_physics::{Data, forward};
//!
//! let text = "<mujoco><extension><plugin plugin='mujoco.elasticity.cable'><instance name='c'>
//!     <config key='bend' value='1e6'/><config key='vmax' value='1'/></instance></plugin></extension>
//!     <worldbody><composite type='cable' curve='s' count='5 1 1' size='1' initial='none'><plugin plugin='mujoco.elasticity.cable' instance='c'/>
//!     <joint kind='main' damping='.1'/><geom type='capsule' size='.01'/></composite></worldbody></mujoco>";
//! let model = robohive_mjcf::load_str(text)?.model;
//! let mut data = Data::new(&model);
//! forward(&model, &mut data)?;
//! let mut seen = Appearance::default();
//! appearance(&model, &data, &mut seen);
//! assert_eq!(seen.colour_of(0).map(|[r, g, b, _]| [r, g, b]), Some([0.0, 0.0, 1.0]), "without stress it is blue");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::data::Data;
use crate::model::{Appearance, AppearanceInputs, Model};
use crate::stages::AccelerationInputs;

/// Replaces `out` by what the plugins of a model show of a state that a forward pass has evaluated. Without plugins nothing is
/// allocated.
pub fn appearance(m: &Model, d: &Data, out: &mut Appearance) {
    out.clear();
    let at = AccelerationInputs {
        state: &d.state,
        kin: &d.kin,
        com: &d.com,
        con: &d.con,
        efc: &d.efc,
        vel: &d.vel,
        actuation: &d.actuation,
    };
    let inputs = AppearanceInputs { m, at, readings: &d.sensor.sensordata };
    for running in m.plugins().all() {
        running.instance.appearance(&inputs, out);
    }
}
