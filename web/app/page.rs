//! The window as the page's script holds it.

use agents::Policy;
use env::{Env, Options, OwnModels};
use js_sys::{Function, Uint8Array};
use robohive_web::{Files, replay};
use std::cell::{RefCell, RefMut};
use std::io;
use viewer::window::eframe::{self, CreationContext, WebLogger, WebOptions, WebRunner};
use viewer::window::{App, Opened, Painters, Recipe, Source, setup};
use viewer::{Play, Session, shortcuts, text};
use wasm_bindgen::prelude::{JsError, JsValue, wasm_bindgen};
use web_sys::HtmlCanvasElement;

/// The window on a canvas.
#[wasm_bindgen]
pub struct Viewer {
    runner: WebRunner,
    /// What was open when it stopped.
    left: RefCell<Option<Opened>>,
}

/// Names of commands, in `Viewer.perform`.
#[wasm_bindgen]
pub fn commands() -> Vec<String> {
    shortcuts().into_iter().map(|shortcut| shortcut.name).collect()
}

impl Default for Viewer {
    fn default() -> Self {
        Self::new()
    }
}

#[wasm_bindgen]
impl Viewer {
    /// A window that has not started yet.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        // A second window finds the log there.
        let _ = WebLogger::init(log::LevelFilter::Warn);
        Viewer { runner: WebRunner::new(), left: RefCell::default() }
    }

    /// Draws on a canvas from now on, with what was open when it last stopped. `save(name, bytes)` takes the files that a
    /// person asks for.
    ///
    /// # Errors
    /// The browser has neither WebGPU nor WebGL 2.
    pub async fn start(&self, canvas: HtmlCanvasElement, save: Function) -> Result<(), JsValue> {
        let options = WebOptions { wgpu_options: setup(), dithering: false, ..WebOptions::default() };
        let left = self.left.take();
        let make = move |context: &CreationContext<'_>| {
            let mut app = App::drawn_by(Painters::of(context.wgpu_render_state.as_ref()), None);
            app.save_by(Box::new(move |name: &str, content: &[u8]| {
                let called = save.call2(&JsValue::NULL, &name.into(), &Uint8Array::from(content));
                called.map(|_| name.to_owned()).map_err(|error| io::Error::other(format!("{error:?}")))
            }));
            app.resume(left);
            let app: Box<dyn eframe::App> = Box::new(app);
            Ok(app)
        };
        self.runner.start(canvas, options, Box::new(make)).await
    }

    /// Leaves its canvas, which is of no use any more; what is open is kept for the next one.
    pub fn stop(&self) {
        if let Some(mut app) = self.runner.app_mut::<App>() {
            self.left.replace(app.leave());
        }
        self.runner.destroy();
    }

    /// What went wrong so badly that nothing works any more.
    #[wasm_bindgen(getter)]
    pub fn failure(&self) -> Option<String> {
        self.runner.panic_summary().map(|summary| summary.message())
    }

    fn app(&self) -> Result<RefMut<'_, App>, JsError> {
        self.runner.app_mut::<App>().ok_or_else(|| JsError::new("the window has not started, or has stopped"))
    }

    /// Opens the model at a path among files.
    ///
    /// # Errors
    /// All that is wrong with it, each with file, line and column; `files.missing` then lists what it lacks. What was open
    /// stays.
    pub fn open(&self, files: &Files, path: &str) -> Result<(), JsError> {
        let loaded = files.load(path)?;
        let source = Source::Among(files.all().clone().into(), path.to_owned());
        self.show(|app| app.open_loaded(source, loaded))
    }

    /// Opens a model of our own, by its name in `ownModels()`.
    ///
    /// # Errors
    /// There is none of that name.
    #[wasm_bindgen(js_name = openOwn)]
    pub fn open_own(&self, name: &str) -> Result<(), JsError> {
        match Source::own().find(|source| source.title() == name) {
            Some(source) => self.show(|app| app.open(source)),
            None => {
                let names: Vec<_> = viewer::own_models().map(|(name, _)| name).collect();
                Err(JsError::new(&format!("{name} is no model of our own: {}", names.join(", "))))
            }
        }
    }

    /// Opens an environment, by its id in `ownEnvironments()`, at the start of the episode of `seed`. With the bytes of a policy,
    /// one that `robohive train` wrote or one made for RoboHive (a pickle, which is not executed), the policy acts.
    ///
    /// # Errors
    /// There is no environment of that id, or the policy is not one that is understood.
    #[wasm_bindgen(js_name = openEnvironment)]
    pub fn open_environment(&self, id: &str, seed: u64, policy: Option<Vec<u8>>) -> Result<(), JsError> {
        let policy = policy.map(|bytes| Policy::parse(&bytes)).transpose()?;
        let name = id.to_owned();
        let make = move || {
            let env = Env::make(&name, &OwnModels, &Options::default())?;
            Play::new(env, policy.clone(), seed)
        };
        let source = Source::Environment(Recipe::new(id, make));
        self.show(|app| app.open(source))
    }

    /// Opens something. What is wrong with it the page says, not the window.
    fn show(&self, open: impl FnOnce(&mut App)) -> Result<(), JsError> {
        let mut app = self.app()?;
        open(&mut app);
        app.take_trouble().map_or(Ok(()), |why| Err(JsError::new(&why)))
    }

    /// Shows the recorded states in a numpy archive, as `Simulation.replay` does.
    ///
    /// # Errors
    /// The archive is damaged, or holds no states of the model that is open.
    pub fn replay(&self, name: &str, archive: &[u8]) -> Result<(), JsError> {
        let mut app = self.app()?;
        let session =
            app.opened_mut().ok_or_else(|| JsError::new("open the model first whose states these are"))?;
        replay(session, name, archive)
    }

    /// Uses a camera whose name contains a text. False where there is none.
    #[wasm_bindgen(js_name = useCamera)]
    pub fn use_camera(&self, name: &str) -> Result<bool, JsError> {
        self.with(|session| {
            let found =
                session.model().camera_names().find(|(_, known)| known.contains(name)).map(|(id, _)| id);
            found.map(|camera| session.camera = camera.into()).is_some()
        })
    }

    /// Does what a command of this name says, see `commands()`. False where there is none.
    pub fn perform(&self, command: &str) -> Result<bool, JsError> {
        Ok(self.app()?.perform_named(command))
    }

    /// Takes `count` steps at once. Returns how many were taken; fewer when one failed.
    pub fn step(&self, count: usize) -> Result<usize, JsError> {
        self.with(|session| {
            let step = |_: &usize| {
                session.step_forward();
                session.fault().is_none()
            };
            (0..count).take_while(step).count()
        })
    }

    /// Id of the environment that is open; nothing where none is.
    #[wasm_bindgen(getter)]
    pub fn environment(&self) -> Result<Option<String>, JsError> {
        let app = self.app()?;
        Ok(app.opened().and_then(Session::play).map(|play| play.env().spec().id.clone()))
    }

    /// Seed of the episode that is open; 0 where none is.
    #[wasm_bindgen(getter)]
    pub fn seed(&self) -> Result<u64, JsError> {
        Ok(self.app()?.opened().and_then(Session::play).map_or(0, |play| play.seed()))
    }

    /// Hash of the state, in 16 hexadecimal digits. Every build computes the same.
    pub fn hash(&self) -> Result<String, JsError> {
        self.with(|session| format!("{:016x}", session.hash()))
    }

    /// Simulated time \[s\].
    #[wasm_bindgen(getter)]
    pub fn time(&self) -> Result<f64, JsError> {
        self.with(|session| session.data().time())
    }

    /// Whether time goes by.
    #[wasm_bindgen(getter)]
    pub fn running(&self) -> Result<bool, JsError> {
        self.with(|session| session.is_running())
    }

    /// The present state as an element of `<keyframe>`, every number exact.
    #[wasm_bindgen(js_name = keyText)]
    pub fn key_text(&self) -> Result<String, JsError> {
        self.with(|session| text::key(session.model(), session.data(), true))
    }

    /// A sentence on what is shown.
    pub fn summary(&self) -> Result<String, JsError> {
        Ok(self.app()?.summary())
    }

    /// What went wrong last, if something did.
    pub fn trouble(&self) -> Result<Option<String>, JsError> {
        Ok(self.app()?.trouble().map(str::to_owned))
    }

    /// What draws the picture, then why it is not the GPU.
    #[wasm_bindgen(js_name = drawnBy)]
    pub fn drawn_by(&self) -> Result<Vec<String>, JsError> {
        let app = self.app()?;
        let (name, reason) = app.drawn();
        Ok(vec![name, reason.to_owned()])
    }

    /// Lets the GPU draw, where there is one, or the CPU.
    #[wasm_bindgen(js_name = useGpu)]
    pub fn use_gpu(&self, wanted: bool) -> Result<(), JsError> {
        self.app()?.use_gpu(wanted);
        Ok(())
    }

    /// Left, top, width and height of the picture in the canvas, in the last frame \[CSS pixel\].
    pub fn area(&self) -> Result<Vec<f32>, JsError> {
        let area = self.app()?.area();
        Ok(vec![area.left(), area.top(), area.width(), area.height()])
    }

    /// The picture of the present state as the CPU draws it: bytes R, G, B, A of each pixel, row by row from the top.
    ///
    /// # Errors
    /// Nothing is open, or the size is zero or too large.
    pub fn picture(&self, width: usize, height: usize) -> Result<Vec<u8>, JsError> {
        let picture =
            self.app()?.drawn_by_cpu([width, height])?.ok_or_else(|| JsError::new("nothing is open"))?;
        let (pixels, _) = picture.rgb.as_chunks::<3>();
        Ok(pixels.iter().flat_map(|&[r, g, b]| [r, g, b, 255]).collect())
    }

    /// Asks the open session.
    fn with<T>(&self, ask: impl FnOnce(&mut Session) -> T) -> Result<T, JsError> {
        let mut app = self.app()?;
        app.opened_mut().map(ask).ok_or_else(|| JsError::new("nothing is open"))
    }
}
