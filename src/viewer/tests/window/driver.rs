//! A window that a test drives.

use eframe::egui::accesskit::{Action, ActionRequest, Node, NodeId, TreeId, TreeUpdate};
use eframe::egui::{
    ColorImage, Context, DroppedFile, Event, ImageData, Key, Modifiers, PointerButton, Pos2, RawInput, Rect,
    Shape, TextureId, pos2, vec2,
};
use robohive_viewer::Session;
use robohive_viewer::window::{App, Source};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// An app and what a window would tell it.
pub struct Window {
    context: Context,
    /// The app.
    pub app: App,
    time: f64,
    tree: Option<TreeUpdate>,
    /// Textures, as the last upload of each left them.
    textures: BTreeMap<TextureId, ColorImage>,
    /// Textures that fill rectangles of the last frame.
    pictures: Vec<(Rect, TextureId)>,
    /// Texts of the last frame.
    pub texts: Vec<String>,
}

impl Window {
    pub fn of(source: Option<Source>) -> Self {
        let context = Context::default();
        context.enable_accesskit();
        let app = App::new(&context, source);
        let mut window = Window {
            context,
            app,
            time: 0.0,
            tree: None,
            textures: BTreeMap::new(),
            pictures: Vec::new(),
            texts: Vec::new(),
        };
        // Panels take their sizes in the first frames.
        (0..3).for_each(|_| window.frame(Vec::new()));
        window
    }

    pub fn own(name: &str) -> Self {
        Self::of(Source::own().find(|source| source.title() == name))
    }

    pub fn input(&mut self, input: RawInput) {
        self.time += 1.0 / 60.0;
        let screen = Rect::from_min_size(Pos2::ZERO, vec2(900.0, 560.0));
        let input = RawInput { screen_rect: Some(screen), time: Some(self.time), ..input };
        let app = &mut self.app;
        let mut output = self.context.run_ui(input, |ui| app.show(ui));
        for (texture, deltas) in &output.textures_delta.set {
            for delta in deltas.iter().filter(|delta| delta.is_whole()) {
                let ImageData::Color(image) = &delta.image;
                self.textures.insert(*texture, (**image).clone());
            }
        }
        output.textures_delta.clear();
        self.pictures = output
            .shapes
            .iter()
            .filter_map(|shown| match &shown.shape {
                Shape::Rect(rect) => Some((rect.rect, rect.brush.as_ref()?.fill_texture_id)),
                _ => None,
            })
            .collect();
        self.texts = output
            .shapes
            .iter()
            .filter_map(|shown| match &shown.shape {
                Shape::Text(text) => Some(text.galley.text().to_owned()),
                _ => None,
            })
            .collect();
        self.tree = output.platform_output.accesskit_update.or(self.tree.take());
    }

    pub fn frame(&mut self, events: Vec<Event>) {
        self.input(RawInput { events, ..RawInput::default() });
    }

    /// Size and colours of the picture that fills `place`.
    pub fn picture_at(&self, place: Rect) -> Option<([usize; 2], Vec<u8>)> {
        let (_, texture) = self.pictures.iter().find(|(rect, _)| *rect == place)?;
        let image = self.textures.get(texture)?;
        let colours = image.pixels.iter().flat_map(|pixel| [pixel.r(), pixel.g(), pixel.b()]);
        Some((image.size, colours.collect()))
    }

    pub fn session(&self) -> &Session {
        self.app.opened().expect("a model is open")
    }

    pub fn press(&mut self, key: Key, modifiers: Modifiers) {
        let event = |pressed| Event::Key { key, physical_key: None, pressed, repeat: false, modifiers };
        self.frame(vec![Event::ModifiersChanged(modifiers), event(true), event(false)]);
        self.frame(vec![Event::ModifiersChanged(Modifiers::NONE)]);
    }

    pub fn button(&mut self, at: Pos2, button: PointerButton, pressed: bool, modifiers: Modifiers) {
        let click = Event::PointerButton { pos: at, button, pressed, modifiers };
        self.frame(vec![Event::ModifiersChanged(modifiers), Event::PointerMoved(at), click]);
    }

    pub fn click(&mut self, at: Pos2) {
        self.button(at, PointerButton::Primary, true, Modifiers::NONE);
        self.button(at, PointerButton::Primary, false, Modifiers::NONE);
    }

    pub fn drag(&mut self, path: &[Pos2], button: PointerButton, modifiers: Modifiers) {
        self.button(path[0], button, true, modifiers);
        path.iter().for_each(|at| self.frame(vec![Event::PointerMoved(*at)]));
        self.button(path[path.len() - 1], button, false, modifiers);
        self.frame(vec![Event::ModifiersChanged(Modifiers::NONE)]);
    }

    /// The middle of what has this name, as a screen reader finds it.
    pub fn named(&self, name: &str) -> Pos2 {
        let tree = self.tree.as_ref().expect("a tree of what can be used");
        let nodes = || tree.nodes.iter().map(|(id, node): &(NodeId, _)| (id, node));
        let found = nodes().find(|(_, node)| text(node) == Some(name) && node.bounds().is_some());
        let names: Vec<&str> = nodes().filter_map(|(_, node)| text(node)).collect();
        let (_, node) = found.unwrap_or_else(|| panic!("nothing is called {name}: {names:?}"));
        let bounds = node.bounds().unwrap();
        pos2(((bounds.x0 + bounds.x1) / 2.0) as f32, ((bounds.y0 + bounds.y1) / 2.0) as f32)
    }

    /// What a screen reader says of what has this name, and does to it: a click.
    pub fn click_as_reader(&mut self, name: &str) {
        let tree = self.tree.as_ref().expect("a tree of what can be used");
        let found = tree.nodes.iter().find(|(_, node)| text(node) == Some(name));
        let (target_node, _) = found.unwrap_or_else(|| panic!("nothing is called {name}"));
        let request = ActionRequest {
            action: Action::Click,
            target_tree: TreeId::ROOT,
            target_node: *target_node,
            data: None,
        };
        self.frame(vec![Event::AccessKitActionRequest(request)]);
        self.frame(Vec::new());
    }

    pub fn use_named(&mut self, name: &str) {
        self.click(self.named(name));
        self.frame(Vec::new());
    }

    pub fn drop_file(&mut self, path: &Path) {
        let file: Arc<dyn DroppedFile + Send + Sync> = Arc::new(Dropped(path.to_owned()));
        self.input(RawInput { dropped_files: vec![file], ..RawInput::default() });
        self.frame(Vec::new());
    }
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

/// The name of what can be used, or what is written.
fn text(node: &Node) -> Option<&str> {
    node.label().or(node.value())
}
