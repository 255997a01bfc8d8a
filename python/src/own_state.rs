//! Keys that RoboHive's four DAPG tasks have in their states: what their resets draw, and what follows from it.

use env::{Scene, WorldState};
use numpy::PyArray1;
use physics::elements::{BodyId, SiteId};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

/// What a key shows.
enum Part {
    /// Position of a body in its parent [m].
    BodyPos(BodyId),
    /// Orientation of a body in its parent.
    BodyQuat(BodyId),
    /// Position of a body in the world [m].
    BodyXpos(BodyId),
    /// Position of a site in the world [m].
    SiteXpos(SiteId),
    /// The first joint positions.
    Hand(usize),
}

/// The keys of one task's own.
pub struct OwnState(Vec<(Py<PyString>, Part)>);

impl OwnState {
    /// Those of a task, on its model.
    pub fn of(py: Python<'_>, task: &str, scene: &Scene) -> Self {
        let body = |name: &str| scene.model.body(name);
        let site = |name: &str| scene.model.site(name).map(Part::SiteXpos);
        let keys = match task {
            "adroit_door" => vec![("door_body_pos", body("frame").map(Part::BodyPos))],
            "adroit_hammer" => {
                vec![("board_pos", body("nail_board").map(Part::BodyPos)), ("target_pos", site("S_target"))]
            }
            "adroit_pen" => vec![("desired_orien", body("target").map(Part::BodyQuat))],
            "adroit_relocate" => vec![
                ("hand_qpos", Some(Part::Hand(30))),
                ("obj_pos", body("Object").map(Part::BodyXpos)),
                ("palm_pos", site("S_grasp")),
                ("target_pos", site("target")),
            ],
            _ => Vec::new(),
        };
        let found =
            keys.into_iter().filter_map(|(key, part)| Some((PyString::intern(py, key).unbind(), part?)));
        OwnState(found.collect())
    }

    /// Adds them to a state.
    pub fn show(&self, py: Python<'_>, scene: &Scene, dict: &Bound<'_, PyDict>) -> PyResult<()> {
        let (model, data) = (&scene.model, &scene.data);
        self.0.iter().try_for_each(|(key, part)| {
            let values: &[f64] = match part {
                Part::BodyPos(id) => &model.body_pos[*id],
                Part::BodyQuat(id) => &model.body_quat[*id],
                Part::BodyXpos(id) => data.body(*id).xpos(),
                Part::SiteXpos(id) => data.site(*id).xpos(),
                Part::Hand(count) => &data.state.qpos[..*count],
            };
            dict.set_item(key, PyArray1::from_slice(py, values))
        })
    }

    /// Puts the value of a key into the arrays of a state where these are not given; `false` where there is no such key.
    /// Places in the world become places in the parent, as RoboHive sets them; what follows from the rest is not read.
    ///
    /// # Errors
    /// Another number of values.
    pub fn read(
        &self,
        py: Python<'_>,
        scene: &Scene,
        (key, values): (&str, &[f64]),
        world: &mut WorldState,
    ) -> PyResult<bool> {
        let found = |(name, _): &&(Py<PyString>, Part)| name.bind(py) == key;
        let Some((_, part)) = self.0.iter().find(found) else { return Ok(false) };
        let model = &scene.model;
        let (array, all, index, width) = match part {
            Part::BodyPos(id) | Part::BodyXpos(id) => {
                (&mut world.body_pos, model.body_pos.as_flattened(), id.index(), 3)
            }
            Part::BodyQuat(id) => (&mut world.body_quat, model.body_quat.as_flattened(), id.index(), 4),
            Part::SiteXpos(id) if key == "target_pos" && self.0.len() == 4 => {
                (&mut world.site_pos, model.site_pos.as_flattened(), id.index(), 3)
            }
            Part::SiteXpos(_) | Part::Hand(_) => return Ok(true),
        };
        if values.len() != width {
            let count = values.len();
            return Err(PyValueError::new_err(format!("{key} has {width} values, and {count} were given")));
        }
        if array.is_none() {
            let mut all = all.to_vec();
            all[index * width..][..width].copy_from_slice(values);
            *array = Some(all);
        }
        Ok(true)
    }
}
