//! Names, numbers and ranges of what a page shows beside the picture.

use crate::simulation::{Simulation, called, exception};
use physics::model::ObjType;
use render::scene::Camera;
use viewer::{EFFECTS, SHOW};
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

#[wasm_bindgen]
impl Simulation {
    /// Positions, `[nq]` \[m, rad\].
    #[wasm_bindgen(getter)]
    pub fn qpos(&self) -> Vec<f64> {
        self.session.data().state.qpos.clone()
    }

    /// Velocities, `[nv]` \[m/s, rad/s\].
    #[wasm_bindgen(getter)]
    pub fn qvel(&self) -> Vec<f64> {
        self.session.data().state.qvel.clone()
    }

    /// Readings of all sensors, `[nsensordata]`.
    #[wasm_bindgen(getter)]
    pub fn sensors(&self) -> Vec<f64> {
        self.session.data().sensor.sensordata.clone()
    }

    /// The readings of one sensor, by its name.
    ///
    /// # Errors
    /// There is no such sensor.
    pub fn sensor(&self, name: &str) -> Result<Vec<f64>, JsError> {
        let sensor = self.id("sensor", name)?;
        let model = self.session.model();
        let (first, count) = (model.sensor_adr[sensor] as usize, model.sensor_dim[sensor] as usize);
        Ok(self.session.data().sensor.sensordata[first..first + count].to_vec())
    }

    /// Controls, `[nu]`.
    #[wasm_bindgen(getter)]
    pub fn controls(&self) -> Vec<f64> {
        self.session.data().state.ctrl.clone()
    }

    /// Names of the controls: those of their actuators.
    #[wasm_bindgen(js_name = controlNames)]
    pub fn control_names(&self) -> Vec<String> {
        let model = self.session.model();
        let names = (0..model.nactuator).flat_map(|actuator| {
            let name = called(model, ObjType::Actuator, actuator);
            (0..model.actuator_ctrlnum[actuator]).map(move |place| match place {
                0 => name.clone(),
                _ => format!("{name} {place}"),
            })
        });
        names.collect()
    }

    /// Lowest and highest value of each control, one pair after the other; -1 and 1 where the model names none.
    #[wasm_bindgen(js_name = controlRanges)]
    pub fn control_ranges(&self) -> Vec<f64> {
        let ranges = self.session.model().actuator_ctrlrange.iter();
        ranges.flat_map(|&[low, high]| if low < high { [low, high] } else { [-1.0, 1.0] }).collect()
    }

    /// Writes a control.
    ///
    /// # Errors
    /// There is no such control; the value is not finite; in an environment actions decide the controls.
    #[wasm_bindgen(js_name = setControl)]
    pub fn set_control(&mut self, index: usize, value: f64) -> Result<(), JsError> {
        let count = self.session.data().state.ctrl.len();
        if self.session.play().is_some() {
            return Err(exception("in an environment actions decide the controls: use act"));
        }
        if index >= count || !value.is_finite() {
            return Err(exception(format!(
                "there are {count} controls: {value} cannot be written to {index}"
            )));
        }
        self.session.edit(|_, data| data.state.ctrl[index] = value);
        Ok(())
    }

    /// Names of the model's cameras.
    pub fn cameras(&self) -> Vec<String> {
        let model = self.session.model();
        (0..model.ncam).map(|camera| called(model, ObjType::Camera, camera)).collect()
    }

    /// Looks through a camera of the model, by its place in `cameras()`, or through the free one (-1).
    ///
    /// # Errors
    /// There is no such camera.
    #[wasm_bindgen(js_name = useCamera)]
    pub fn use_camera(&mut self, index: i32) -> Result<(), JsError> {
        let model = self.session.model();
        self.session.camera = match usize::try_from(index) {
            Err(_) => Camera::free(model),
            Ok(camera) if camera < model.ncam => Camera::Fixed(camera),
            Ok(camera) => {
                return Err(exception(format!("there are {} cameras, and none is {camera}", model.ncam)));
            }
        };
        Ok(())
    }

    /// The camera in use, by its place in `cameras()`; -1 is the free one.
    #[wasm_bindgen(getter)]
    pub fn camera(&self) -> i32 {
        match self.session.camera {
            Camera::Free(_) => -1,
            Camera::Fixed(camera) => camera as i32,
        }
    }

    /// Names of what can be shown or hidden.
    pub fn switches(&self) -> Vec<String> {
        SHOW.iter()
            .map(|flag| flag.name)
            .chain(EFFECTS.iter().map(|flag| flag.name))
            .map(str::to_owned)
            .collect()
    }

    /// Whether something is shown, by its name in `switches()`.
    ///
    /// # Errors
    /// Nothing has that name.
    pub fn shows(&self, name: &str) -> Result<bool, JsError> {
        let options = &self.session.options;
        let shown = SHOW.iter().find(|flag| flag.name == name).map(|flag| flag.get(options.show));
        let effect = || EFFECTS.iter().find(|flag| flag.name == name).map(|flag| flag.get(options.effects));
        shown.or_else(effect).ok_or_else(|| exception(format!("nothing is called {name}")))
    }

    /// Shows or hides something.
    ///
    /// # Errors
    /// Nothing has that name.
    pub fn show(&mut self, name: &str, shown: bool) -> Result<(), JsError> {
        let options = &mut self.session.options;
        let switch = SHOW.iter().find(|flag| flag.name == name).map(|flag| flag.of(&mut options.show));
        let effect = EFFECTS.iter().find(|flag| flag.name == name);
        match (switch, effect) {
            (Some(switch), _) => *switch = shown,
            (None, Some(flag)) => *flag.of(&mut options.effects) = shown,
            (None, None) => return Err(exception(format!("nothing is called {name}"))),
        }
        Ok(())
    }
}
