//! States: written, saved, restored.

use crate::simulation::{Simulation, exception};
use dataset::{Array, NpzReader, NpzWriter};
use physics::{Data, Snapshot};
use std::io::Cursor;
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// What scripts may write between steps.
const INPUTS: [&str; 9] =
    ["qpos", "qvel", "act", "ctrl", "qfrc_applied", "mocap_pos", "mocap_quat", "eq_active", "userdata"];

/// What else decides the steps to come.
const MEMORY: [&str; 3] = ["history", "qacc_warmstart", "plugin_state"];

/// A saved state of a simulation.
#[wasm_bindgen]
pub struct State {
    snapshot: Snapshot,
}

#[wasm_bindgen]
impl State {
    /// Simulated time \[s\].
    #[wasm_bindgen(getter)]
    pub fn time(&self) -> f64 {
        self.snapshot.time()
    }
}

#[wasm_bindgen]
impl Simulation {
    /// Writes an input of the next step by MuJoCo's name: `qpos`, `qvel`, `act`, `ctrl`, `qfrc_applied`, `mocap_pos`,
    /// `mocap_quat`, `eq_active` or `userdata`, and evaluates what follows.
    ///
    /// # Errors
    /// There is no such input; it has another length; a number is not finite; this is an environment.
    pub fn write(&mut self, name: &str, values: &[f64]) -> Result<(), JsError> {
        self.refuse_environment("actions decide what happens: use act")?;
        if !INPUTS.contains(&name) {
            return Err(exception(format!("{name:?} cannot be written, but {}", INPUTS.join(", "))));
        }
        if let Some(wrong) = values.iter().find(|value| !value.is_finite()) {
            return Err(exception(format!("{name}: {wrong} is no number that a state can have")));
        }
        let mut fits = false;
        self.session.edit(|_, data| fits = data.state.assign(name, values).unwrap_or(false));
        match fits {
            true => Ok(()),
            false => Err(exception(format!("{name} has another length than {}", values.len()))),
        }
    }

    /// Returns to a keyframe, by its place in `names("key")`, or to the reference (-1).
    ///
    /// # Errors
    /// There is no such keyframe; this is an environment.
    #[wasm_bindgen(js_name = resetToKey)]
    pub fn reset_to_key(&mut self, key: i32) -> Result<(), JsError> {
        self.refuse_environment("its task says how episodes begin: use resetTo")?;
        let keys = self.session.model().nkey;
        match usize::try_from(key) {
            Ok(key) if key >= keys => {
                Err(exception(format!("there are {keys} keyframes, and none is {key}")))
            }
            key => {
                self.session.reset_to(key.ok());
                Ok(())
            }
        }
    }

    /// Saves all that decides the steps to come.
    ///
    /// # Errors
    /// This is an environment.
    pub fn save(&self) -> Result<State, JsError> {
        self.refuse_environment("its episode is more than a state: use resetTo and act")?;
        let mut snapshot = Snapshot::default();
        self.session.data().save(&mut snapshot);
        Ok(State { snapshot })
    }

    /// Returns to a saved state: the steps that follow are those that followed it, to the last bit.
    ///
    /// # Errors
    /// The state is one of another model; this is an environment.
    pub fn restore(&mut self, state: &State) -> Result<(), JsError> {
        self.refuse_environment("its episode is more than a state: use resetTo and act")?;
        self.session.restore(&state.snapshot).map_err(exception)
    }

    /// The present state as a numpy archive (`.npz`), one array a quantity.
    ///
    /// # Errors
    /// A tree of the model sleeps, which an archive cannot say; this is an environment.
    #[wasm_bindgen(js_name = stateBytes)]
    pub fn state_bytes(&self) -> Result<Vec<u8>, JsError> {
        self.refuse_environment("its episode is more than a state: use resetTo and act")?;
        let (model, state) = (self.session.model(), &self.session.data().state);
        if state.ntree_awake < model.ntree {
            return Err(exception("a part of the model sleeps, which an archive cannot say: use save()"));
        }
        let mut bytes = Cursor::new(Vec::new());
        let mut archive = NpzWriter::new(&mut bytes);
        let mut wrote = archive.add("time", &Array::f64(vec![], vec![state.time]));
        state.visit(model, &mut |name, shape, values| {
            if wrote.is_ok() && (INPUTS.contains(&name) || MEMORY.contains(&name)) {
                wrote = archive.add(name, &Array::f64(shape, values.to_f64()));
            }
        });
        wrote.and_then(|()| archive.finish()).map_err(exception)?;
        Ok(bytes.into_inner())
    }

    /// Returns to a state that `stateBytes` wrote, or to any archive with some of its arrays: others stay as they are.
    ///
    /// # Errors
    /// The archive is damaged, or an array is of another model or not finite; this is an environment.
    #[wasm_bindgen(js_name = restoreBytes)]
    pub fn restore_bytes(&mut self, archive: &[u8]) -> Result<(), JsError> {
        self.refuse_environment("its episode is more than a state: use resetTo and act")?;
        let mut data = self.session.data().clone();
        read_state(archive, &mut data).map_err(exception)?;
        let mut snapshot = Snapshot::default();
        data.save(&mut snapshot);
        self.session.restore(&snapshot).map_err(exception)
    }

    /// An error with what to do instead, where this is an environment.
    fn refuse_environment(&self, instead: &str) -> Result<(), JsError> {
        match self.session.play() {
            Some(_) => Err(exception(format!("in an environment {instead}"))),
            None => Ok(()),
        }
    }
}

/// Writes the arrays of an archive into a state.
fn read_state(archive: &[u8], data: &mut Data) -> Result<(), String> {
    let archive = NpzReader::read(Cursor::new(archive)).map_err(|error| error.to_string())?;
    let names: Vec<String> = archive.names().map(str::to_owned).collect();
    for name in names.iter().map(String::as_str) {
        let values = archive.require(name).map_err(|error| error.to_string())?.values.to_f64();
        if values.iter().any(|value| !value.is_finite()) {
            return Err(format!("{name}: not all numbers are finite"));
        }
        let fits = match (name, &values[..]) {
            ("time", &[time]) => {
                data.state.time = time;
                true
            }
            _ if INPUTS.contains(&name) || MEMORY.contains(&name) => {
                data.state.assign(name, &values).unwrap_or(false)
            }
            _ => return Err(format!("{name:?} is no part of a state")),
        };
        if !fits {
            return Err(format!("{name}: this model has another number of them than {}", values.len()));
        }
    }
    Ok(())
}
