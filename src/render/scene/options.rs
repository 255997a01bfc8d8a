//! What a scene shows: groups, kinds of elements, decorations, effects (documentation: `mjvOption`).

use physics::math::{Quat, Vec3};

/// Groups that elements can be put into.
pub const GROUPS: usize = 6;

/// Groups that are visible unless somebody asks for others.
const VISIBLE: [bool; GROUPS] = [true, true, true, false, false, false];

/// Visible groups of each kind of element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Groups {
    /// Of geoms.
    pub geoms: [bool; GROUPS],
    /// Of sites.
    pub sites: [bool; GROUPS],
    /// Of joints.
    pub joints: [bool; GROUPS],
    /// Of tendons.
    pub tendons: [bool; GROUPS],
    /// Of actuators.
    pub actuators: [bool; GROUPS],
    /// Of skins.
    pub skins: [bool; GROUPS],
    /// Of flexes.
    pub flexes: [bool; GROUPS],
}

impl Default for Groups {
    /// The first three of each kind.
    fn default() -> Self {
        Groups {
            geoms: VISIBLE,
            sites: VISIBLE,
            joints: VISIBLE,
            tendons: VISIBLE,
            actuators: VISIBLE,
            skins: VISIBLE,
            flexes: VISIBLE,
        }
    }
}

/// True when an element of `group` is visible; groups beyond the last count as the last.
pub(super) fn is_visible(visible: &[bool; GROUPS], group: i32) -> bool {
    visible[group.clamp(0, GROUPS as i32 - 1) as usize]
}

/// Kinds of elements and decorations. All off but textures, tendons, rangefinders, static bodies, skins, edges and
/// skins of flexes, and the perturbation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Show {
    /// Textures of materials.
    pub textures: bool,
    /// Geoms, sites and decorations of bodies that are fixed to the world.
    pub static_bodies: bool,
    /// Spatial tendons.
    pub tendons: bool,
    /// Skins.
    pub skins: bool,
    /// Vertices of flexes that show no skin.
    pub flex_vertices: bool,
    /// Edges of flexes that show no skin.
    pub flex_edges: bool,
    /// Faces of flexes of triangles, and of the tetrahedra at [`SceneOptions::flex_layer`], where skins of flexes are off.
    pub flex_faces: bool,
    /// Smooth surfaces of flexes of triangles and tetrahedra.
    pub flex_skins: bool,
    /// Rays of rangefinders and nearest points of `fromto` sensors.
    pub rangefinders: bool,
    /// Convex hulls instead of the meshes that collide.
    pub convex_hulls: bool,
    /// Moving bodies in `visual/map alpha` of their opacity.
    pub transparent: bool,
    /// Colours by constraint island.
    pub islands: bool,
    /// Joint axes.
    pub joints: bool,
    /// Actuators, coloured by control.
    pub actuators: bool,
    /// Actuators are coloured by activation.
    pub activations: bool,
    /// Cameras, with their frustums where they have a resolution.
    pub cameras: bool,
    /// Lights.
    pub lights: bool,
    /// Anchors of connect and weld constraints.
    pub constraints: bool,
    /// Equivalent inertias as boxes or ellipsoids.
    pub inertias: bool,
    /// Equivalent inertias have the density of water.
    pub scaled_inertias: bool,
    /// Centres of mass of the kinematic trees.
    pub centers_of_mass: bool,
    /// Capsules from body to body through the joints.
    pub connections: bool,
    /// Contacts.
    pub contact_points: bool,
    /// Contact forces.
    pub contact_forces: bool,
    /// Normal and friction forces apart.
    pub split_forces: bool,
    /// User forces on bodies.
    pub applied_forces: bool,
    /// The spring or the target of a perturbation.
    pub perturbation: bool,
    /// The selected point.
    pub selected_point: bool,
    /// Bounding volumes of bodies, at [`SceneOptions::tree_depth`].
    pub body_trees: bool,
    /// Bounding volumes of meshes and flexes, at [`SceneOptions::tree_depth`], and lattices of flexes.
    pub mesh_trees: bool,
}

impl Show {
    /// Nothing but bare geoms, sites and slider cranks.
    pub const NOTHING: Self = Show {
        textures: false,
        static_bodies: false,
        tendons: false,
        skins: false,
        flex_vertices: false,
        flex_edges: false,
        flex_faces: false,
        flex_skins: false,
        rangefinders: false,
        convex_hulls: false,
        transparent: false,
        islands: false,
        joints: false,
        actuators: false,
        activations: false,
        cameras: false,
        lights: false,
        constraints: false,
        inertias: false,
        scaled_inertias: false,
        centers_of_mass: false,
        connections: false,
        contact_points: false,
        contact_forces: false,
        split_forces: false,
        applied_forces: false,
        perturbation: false,
        selected_point: false,
        body_trees: false,
        mesh_trees: false,
    };
}

impl Default for Show {
    fn default() -> Self {
        Show {
            textures: true,
            static_bodies: true,
            tendons: true,
            skins: true,
            flex_edges: true,
            flex_skins: true,
            rangefinders: true,
            perturbation: true,
            ..Show::NOTHING
        }
    }
}

/// Elements that get a label.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)]
#[non_exhaustive]
pub enum LabelChoice {
    #[default]
    None,
    Body,
    Joint,
    Geom,
    Site,
    Camera,
    Light,
    Tendon,
    Actuator,
    Skin,
    Flex,
    Constraint,
    /// The selected body.
    Selection,
    /// Coordinates of the selected point.
    SelectedPoint,
    /// Names of the geoms that touch.
    ContactPoint,
    /// Magnitude of contact forces \[N\].
    ContactForce,
    /// Numbers of constraint islands.
    Island,
}

/// Elements whose frames are shown. Frames of cameras and lights are shown only together with the elements.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)]
#[non_exhaustive]
pub enum FrameChoice {
    #[default]
    None,
    /// Of all bodies but the world.
    Body,
    Geom,
    Site,
    Camera,
    Light,
    Contact,
    World,
}

/// Categories of items that a scene holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Categories {
    /// Of bodies that are fixed to the world.
    pub fixed: bool,
    /// Of bodies that move, tendons and slider cranks.
    pub dynamic: bool,
    /// Decorations.
    pub decor: bool,
}

impl Default for Categories {
    /// All.
    fn default() -> Self {
        Categories { fixed: true, dynamic: true, decor: true }
    }
}

/// How a body is pulled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pull {
    /// Towards a position.
    pub translation: bool,
    /// Towards an orientation.
    pub rotation: bool,
}

/// A selected body, and where it is pulled to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Selection {
    /// Body of the model, not the world.
    pub body: usize,
    /// The selected point, body frame \[m\].
    pub point: Vec3,
    /// How the body is pulled.
    pub pull: Pull,
    /// How it is pulled by a second hand, shown in another colour.
    pub second_pull: Pull,
    /// Where the selected point is pulled to, world frame \[m\].
    pub target: Vec3,
    /// Orientation to which the body's inertial frame is pulled.
    pub orientation: Quat,
}

/// Effects of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Effects {
    /// Lights cast shadows.
    pub shadows: bool,
    /// The first reflective item is a mirror.
    pub reflections: bool,
    /// The texture of the sky.
    pub sky: bool,
    /// Haze at the horizon of an infinite plane.
    pub haze: bool,
    /// Fog in the distance.
    pub fog: bool,
    /// Surfaces are drawn as the outlines of their polygons.
    pub wireframe: bool,
    /// What is transparent is added to what is behind it, and does not weaken it.
    pub additive: bool,
    /// The backs of closed surfaces are left out.
    pub culling: bool,
}

impl Default for Effects {
    /// All but fog, wireframe and added transparency.
    fn default() -> Self {
        Effects {
            shadows: true,
            reflections: true,
            sky: true,
            haze: true,
            fog: false,
            wireframe: false,
            additive: false,
            culling: true,
        }
    }
}

impl Effects {
    /// Whether lights cast shadows.
    #[must_use]
    pub fn with_shadows(mut self, shadows: bool) -> Self {
        self.shadows = shadows;
        self
    }

    /// Whether the first reflective item is a mirror.
    #[must_use]
    pub fn with_reflections(mut self, reflections: bool) -> Self {
        self.reflections = reflections;
        self
    }

    /// Whether there is a sky.
    #[must_use]
    pub fn with_sky(mut self, sky: bool) -> Self {
        self.sky = sky;
        self
    }

    /// Whether there is haze at the horizon of an infinite plane.
    #[must_use]
    pub fn with_haze(mut self, haze: bool) -> Self {
        self.haze = haze;
        self
    }

    /// Whether there is fog in the distance.
    #[must_use]
    pub fn with_fog(mut self, fog: bool) -> Self {
        self.fog = fog;
        self
    }

    /// Whether surfaces are drawn as the outlines of their polygons.
    #[must_use]
    pub fn with_wireframe(mut self, wireframe: bool) -> Self {
        self.wireframe = wireframe;
        self
    }

    /// Whether what is transparent is added to what is behind it.
    #[must_use]
    pub fn with_additive(mut self, additive: bool) -> Self {
        self.additive = additive;
        self
    }

    /// Whether the backs of closed surfaces are left out.
    #[must_use]
    pub fn with_culling(mut self, culling: bool) -> Self {
        self.culling = culling;
        self
    }
}

/// What a scene shows. The defaults are those of MuJoCo's renderer.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SceneOptions {
    /// Visible groups.
    pub groups: Groups,
    /// Kinds of elements and decorations.
    pub show: Show,
    /// Elements that get a label.
    pub label: LabelChoice,
    /// Elements whose frames are shown.
    pub frame: FrameChoice,
    /// Categories of items.
    pub categories: Categories,
    /// The selected body.
    pub selection: Option<Selection>,
    /// Depth at which bounding volume trees are shown.
    pub tree_depth: i32,
    /// Layer of the tetrahedra of flexes whose faces are shown, 0 at the surface.
    pub flex_layer: i32,
    /// Effects of the picture.
    pub effects: Effects,
}

impl Default for SceneOptions {
    fn default() -> Self {
        SceneOptions {
            groups: Groups::default(),
            show: Show::default(),
            label: LabelChoice::None,
            frame: FrameChoice::None,
            categories: Categories::default(),
            selection: None,
            tree_depth: 1,
            flex_layer: 0,
            effects: Effects::default(),
        }
    }
}

impl SceneOptions {
    /// Visible groups.
    #[must_use]
    pub fn with_groups(mut self, groups: Groups) -> Self {
        self.groups = groups;
        self
    }

    /// Kinds of elements and decorations.
    #[must_use]
    pub fn with_show(mut self, show: Show) -> Self {
        self.show = show;
        self
    }

    /// Elements that get a label.
    #[must_use]
    pub fn with_label(mut self, label: LabelChoice) -> Self {
        self.label = label;
        self
    }

    /// Elements whose frames are shown.
    #[must_use]
    pub fn with_frame(mut self, frame: FrameChoice) -> Self {
        self.frame = frame;
        self
    }

    /// Categories of items.
    #[must_use]
    pub fn with_categories(mut self, categories: Categories) -> Self {
        self.categories = categories;
        self
    }

    /// The selected body.
    #[must_use]
    pub fn with_selection(mut self, selection: Option<Selection>) -> Self {
        self.selection = selection;
        self
    }

    /// Depth at which bounding volume trees are shown.
    #[must_use]
    pub fn with_tree_depth(mut self, tree_depth: i32) -> Self {
        self.tree_depth = tree_depth;
        self
    }

    /// Layer of the tetrahedra of flexes whose faces are shown, 0 at the surface.
    #[must_use]
    pub fn with_flex_layer(mut self, flex_layer: i32) -> Self {
        self.flex_layer = flex_layer;
        self
    }

    /// Effects of the picture.
    #[must_use]
    pub fn with_effects(mut self, effects: Effects) -> Self {
        self.effects = effects;
        self
    }
}
