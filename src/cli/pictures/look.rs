//! From where pictures are taken, how large they are, and what they show.

use crate::failure::Failure;
use crate::terminal::listed;
use clap::{Args, ValueEnum};
use physics::Model;
use render::Settings;
use render::raster::Samples;
use render::scene::{Camera, FrameChoice, FreeCamera, GROUPS, LabelChoice, SceneOptions};
use std::fmt;
use std::str::FromStr;

/// Most columns or rows of a picture.
pub const MAX_SIDE: usize = render::error::MAX_SIDE;

/// Columns and rows of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let side = |text: &str| text.parse().ok().filter(|side| (1..=MAX_SIDE).contains(side));
        let (width, height) = text.split_once('x').unwrap_or((text, text));
        match (side(width), side(height)) {
            (Some(width), Some(height)) => Ok(Size { width, height }),
            _ => Err(format!(
                "sizes read WIDTHxHEIGHT or SIDE, such as 640x480, with 1 to {MAX_SIDE} pixels a side"
            )),
        }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

/// Where pictures are taken from.
#[derive(Args)]
pub struct Viewpoint {
    /// Camera of the model, by name or number, or `free` [default: the first that an environment, or its visual
    /// variant, observes, else `free`]
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// Direction in which the free camera looks, about the vertical from x [deg]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    pub azimuth: Option<f64>,
    /// Angle of the free camera's gaze above the horizon [deg]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    pub elevation: Option<f64>,
    /// Distance of the free camera from the point it looks at [m]
    #[arg(long, value_name = "M")]
    pub distance: Option<f64>,
    /// The point that the free camera looks at [m]
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    pub lookat: Vec<f64>,
}

impl Viewpoint {
    /// Whether any of it is given.
    pub fn is_given(&self) -> bool {
        self.camera.is_some() || self.moved()
    }

    /// Whether the free camera stands elsewhere than the model puts it.
    fn moved(&self) -> bool {
        !self.lookat.is_empty() || [self.azimuth, self.elevation, self.distance].iter().any(Option::is_some)
    }

    /// The camera, and what messages call it; `default` is taken where none is named and the free one is not moved.
    pub fn camera(&self, model: &Model, default: &str) -> Result<(Camera, String), Failure> {
        let default = if self.moved() { "free" } else { default };
        let name = self.camera.as_deref().unwrap_or(default);
        let number = || name.parse().ok().filter(|&number| number < model.ncam).map(Camera::Fixed);
        let camera = match Camera::named(model, name) {
            Ok(camera) => camera,
            Err(error) => number().ok_or_else(|| Failure::usage(error))?,
        };
        let camera = match camera {
            Camera::Free(free) => Camera::Free(self.free(free)?),
            Camera::Fixed(_) if self.moved() => {
                return Err(Failure::usage(format!(
                    "--azimuth, --elevation, --distance and --lookat move the free camera, and {name} is one of the \
                     model's: leave them out, or ask for --camera free"
                )));
            }
            camera => camera,
        };
        Ok((camera, name.to_owned()))
    }

    /// The free camera where it is asked to be.
    fn free(&self, free: FreeCamera) -> Result<FreeCamera, Failure> {
        let lookat = match self.lookat[..] {
            [] => free.lookat,
            [x, y, z] => [x, y, z],
            _ => return Err(Failure::usage("--lookat takes three numbers, such as 0,0,0.5")),
        };
        let distance = self.distance.unwrap_or(free.distance);
        let (azimuth, elevation) =
            (self.azimuth.unwrap_or(free.azimuth), self.elevation.unwrap_or(free.elevation));
        let finite = lookat.iter().chain([&distance, &azimuth, &elevation]).all(|x| x.is_finite());
        if !(finite && distance > 0.0) {
            return Err(Failure::usage(
                "the free camera needs finite numbers, and a distance of more than 0",
            ));
        }
        Ok(FreeCamera { lookat, distance, azimuth, elevation, ..free })
    }
}

/// Decorations that a picture can have.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Decoration {
    /// Points of contact
    Contacts,
    /// Contact forces
    Forces,
    /// Normal and friction parts of contact forces
    SplitForces,
    /// Forces that users apply to bodies
    AppliedForces,
    /// Joint axes
    Joints,
    /// Actuators, coloured by their controls
    Actuators,
    /// Actuators, coloured by their activations
    Activations,
    /// Frames of bodies
    Frames,
    /// Frames of geoms
    GeomFrames,
    /// Frames of sites
    SiteFrames,
    /// The frame of the world
    WorldFrame,
    /// Cameras
    Cameras,
    /// Lights
    Lights,
    /// Anchors of equality constraints
    Constraints,
    /// Inertias of bodies
    Inertias,
    /// Centres of mass
    CentersOfMass,
    /// Lines from body to body
    Skeleton,
    /// Convex hulls instead of meshes
    Hulls,
    /// Moving bodies see-through
    Transparent,
    /// Colours by constraint island
    Islands,
    /// Bounding volumes
    Bounds,
    /// Fog in the distance
    Fog,
    /// Outlines of polygons instead of surfaces
    Wireframe,
    /// Transparent items added to what is behind them
    Additive,
}

impl Decoration {
    /// Adds it to what is shown.
    fn add(self, options: &mut SceneOptions) {
        let show = &mut options.show;
        match self {
            Decoration::Contacts => show.contact_points = true,
            Decoration::Forces => show.contact_forces = true,
            Decoration::SplitForces => (show.contact_forces, show.split_forces) = (true, true),
            Decoration::AppliedForces => show.applied_forces = true,
            Decoration::Joints => show.joints = true,
            Decoration::Actuators => show.actuators = true,
            Decoration::Activations => (show.actuators, show.activations) = (true, true),
            Decoration::Cameras => show.cameras = true,
            Decoration::Lights => show.lights = true,
            Decoration::Constraints => show.constraints = true,
            Decoration::Inertias => show.inertias = true,
            Decoration::CentersOfMass => show.centers_of_mass = true,
            Decoration::Skeleton => show.connections = true,
            Decoration::Hulls => show.convex_hulls = true,
            Decoration::Transparent => show.transparent = true,
            Decoration::Islands => show.islands = true,
            Decoration::Bounds => (show.body_trees, show.mesh_trees) = (true, true),
            Decoration::Fog => options.effects.fog = true,
            Decoration::Wireframe => options.effects.wireframe = true,
            Decoration::Additive => options.effects.additive = true,
            Decoration::Frames => options.frame = FrameChoice::Body,
            Decoration::GeomFrames => options.frame = FrameChoice::Geom,
            Decoration::SiteFrames => options.frame = FrameChoice::Site,
            Decoration::WorldFrame => options.frame = FrameChoice::World,
        }
    }

    fn is_frame(self) -> bool {
        use Decoration::{Frames, GeomFrames, SiteFrames, WorldFrame};
        [Frames, GeomFrames, SiteFrames, WorldFrame].contains(&self)
    }
}

/// What a picture can name.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Label {
    /// Bodies
    Bodies,
    /// Joints, with their axes
    Joints,
    /// Geoms
    Geoms,
    /// Sites
    Sites,
    /// Cameras, which are shown
    Cameras,
    /// Lights, which are shown
    Lights,
    /// Tendons
    Tendons,
    /// Skins
    Skins,
    /// Actuators, which are shown
    Actuators,
    /// Equality constraints, with their anchors
    Constraints,
    /// Geoms that touch, with their contacts
    Contacts,
    /// Contact forces, with their strength [N]
    Forces,
    /// Constraint islands, by number
    Islands,
}

impl Label {
    /// Adds it, and the decoration that carries it, to what is shown.
    fn add(self, options: &mut SceneOptions) {
        use Decoration as Shown;
        let (label, shown) = match self {
            Label::Bodies => (LabelChoice::Body, None),
            Label::Joints => (LabelChoice::Joint, Some(Shown::Joints)),
            Label::Geoms => (LabelChoice::Geom, None),
            Label::Sites => (LabelChoice::Site, None),
            Label::Cameras => (LabelChoice::Camera, Some(Shown::Cameras)),
            Label::Lights => (LabelChoice::Light, Some(Shown::Lights)),
            Label::Tendons => (LabelChoice::Tendon, None),
            Label::Skins => (LabelChoice::Skin, None),
            Label::Actuators => (LabelChoice::Actuator, Some(Shown::Actuators)),
            Label::Constraints => (LabelChoice::Constraint, Some(Shown::Constraints)),
            Label::Contacts => (LabelChoice::ContactPoint, Some(Shown::Contacts)),
            Label::Forces => (LabelChoice::ContactForce, Some(Shown::Forces)),
            Label::Islands => (LabelChoice::Island, Some(Shown::Islands)),
        };
        options.label = label;
        shown.into_iter().for_each(|shown| shown.add(options));
    }
}

/// What a picture can go without.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Omission {
    /// Textures of materials
    Textures,
    /// What is fixed to the world
    Static,
    /// Tendons
    Tendons,
    /// Skins
    Skins,
    /// Rays of rangefinders
    Rays,
    /// Shadows
    Shadows,
    /// Mirrors
    Reflections,
    /// The sky
    Sky,
    /// Haze at the horizon
    Haze,
}

impl Omission {
    /// Takes it out of what is shown.
    fn remove(self, options: &mut SceneOptions) {
        let (show, effects) = (&mut options.show, &mut options.effects);
        match self {
            Omission::Textures => show.textures = false,
            Omission::Static => show.static_bodies = false,
            Omission::Tendons => show.tendons = false,
            Omission::Skins => show.skins = false,
            Omission::Rays => show.rangefinders = false,
            Omission::Shadows => effects.shadows = false,
            Omission::Reflections => effects.reflections = false,
            Omission::Sky => effects.sky = false,
            Omission::Haze => effects.haze = false,
        }
    }
}

/// What pictures show, and how finely.
#[derive(Args)]
pub struct Look {
    /// Samples of a pixel: 4 smooth edges [default: 4, or what the model's visual/quality says]
    #[arg(long, value_name = "1|4", value_parser = samples)]
    pub samples: Option<Samples>,
    /// Draw no shadows; a part of --hide
    #[arg(long)]
    pub no_shadows: bool,
    /// Decorations, separated by commas
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    pub show: Vec<Decoration>,
    /// Names to write beside what they belong to
    #[arg(long, value_name = "WHAT")]
    pub label: Option<Label>,
    /// What to leave out, separated by commas
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    pub hide: Vec<Omission>,
    /// Groups of geoms, sites, joints, tendons and actuators to show, 0 to 5 [default: 0,1,2]
    #[arg(long, value_name = "N,…", value_delimiter = ',', value_parser = clap::value_parser!(u8).range(0..GROUPS as i64))]
    pub groups: Vec<u8>,
}

fn samples(text: &str) -> Result<Samples, String> {
    match text {
        "1" => Ok(Samples::One),
        "4" => Ok(Samples::Four),
        _ => Err("a pixel has 1 or 4 samples".into()),
    }
}

impl Look {
    /// What scenes of this look show.
    pub fn options(&self) -> Result<SceneOptions, Failure> {
        let mut options = SceneOptions::default();
        let frames: Vec<_> = self.show.iter().filter(|decoration| decoration.is_frame()).collect();
        if frames.len() > 1 {
            let names = frames.iter().filter_map(|frame| frame.to_possible_value());
            let names = listed(names.map(|name| name.get_name().to_owned()), frames.len());
            return Err(Failure::usage(format!("--show {names}: a picture shows one kind of frames")));
        }
        self.show.iter().for_each(|decoration| decoration.add(&mut options));
        self.label.iter().for_each(|label| label.add(&mut options));
        self.hide.iter().for_each(|omission| omission.remove(&mut options));
        options.effects.shadows &= !self.no_shadows;
        if !self.groups.is_empty() {
            let visible =
                std::array::from_fn(|group| self.groups.iter().any(|&asked| usize::from(asked) == group));
            let groups = &mut options.groups;
            let kinds = [
                &mut groups.geoms,
                &mut groups.sites,
                &mut groups.joints,
                &mut groups.tendons,
                &mut groups.actuators,
                &mut groups.skins,
                &mut groups.flexes,
            ];
            kinds.into_iter().for_each(|kind| *kind = visible);
        }
        Ok(options)
    }

    /// How finely pictures of a model are drawn.
    pub fn settings(&self, model: &Model) -> Settings {
        let settings = Settings::of(model);
        settings.with_samples(self.samples.unwrap_or(settings.samples))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_two_sides_or_one() {
        assert_eq!("640x480".parse(), Ok(Size { width: 640, height: 480 }));
        assert_eq!("84".parse(), Ok(Size { width: 84, height: 84 }));
        for wrong in ["", "0", "0x5", "5x0", "4097x1", "1x1x1", "-1x4", "ax4", "99999999999999999999"] {
            assert!(wrong.parse::<Size>().is_err_and(|error| error.contains("640x480")), "{wrong}");
        }
    }
}
