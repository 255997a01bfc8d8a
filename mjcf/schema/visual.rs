//! `visual`: everything that changes pictures and never motion.

use physics::model::{VisualGlobal, VisualHeadlight, VisualMap, VisualQuality, VisualRgba, VisualScale};

use super::Bind::{Int, Keyword, Single, Singles};
use super::{BOOL, ElementType, Row, leaf, once, row, section};

/// `visual`.
pub static VISUAL: ElementType = section(
    "visual",
    "How the model looks",
    &[once(&GLOBAL), once(&QUALITY), once(&HEADLIGHT), once(&MAP), once(&SCALE), once(&RGBA)],
);

static GLOBAL: ElementType = leaf("global", "Window and free camera", &[&VISUAL_GLOBAL]);

/// Attributes of `visual/global`.
pub static VISUAL_GLOBAL: [Row<VisualGlobal>; 13] = [
    row("cameraid", Int(|v| &mut v.cameraid), "model camera to start with, -1 for the free one"),
    row(
        "orthographic",
        Keyword { words: BOOL, assign: |v, code| v.orthographic = code },
        "free camera projects orthographically",
    ),
    row("fovy", Single(|v| &mut v.fovy), "vertical field of view of the free camera, degrees"),
    row("ipd", Single(|v| &mut v.ipd), "distance between the eyes of the free camera, metres"),
    row("azimuth", Single(|v| &mut v.azimuth), "first azimuth of the free camera, degrees"),
    row("elevation", Single(|v| &mut v.elevation), "first elevation of the free camera, degrees"),
    row("linewidth", Single(|v| &mut v.linewidth), "width of lines, pixels"),
    row("glow", Single(|v| &mut v.glow), "emission added to the selected body"),
    row("offwidth", Int(|v| &mut v.offwidth), "width of the off-screen buffer, pixels"),
    row("offheight", Int(|v| &mut v.offheight), "height of the off-screen buffer, pixels"),
    row("realtime", Single(|v| &mut v.realtime), "simulated seconds per second of wall clock"),
    row(
        "ellipsoidinertia",
        Keyword { words: BOOL, assign: |v, code| v.ellipsoidinertia = code },
        "draw inertias as ellipsoids instead of boxes",
    ),
    row(
        "bvactive",
        Keyword { words: BOOL, assign: |v, code| v.bvactive = code },
        "draw active bounding volumes",
    ),
];

static QUALITY: ElementType = leaf("quality", "Rendering effort", &[&VISUAL_QUALITY]);

/// Attributes of `visual/quality`.
pub static VISUAL_QUALITY: [Row<VisualQuality>; 5] = [
    row("shadowsize", Int(|v| &mut v.shadowsize), "side of the shadow map, pixels"),
    row("offsamples", Int(|v| &mut v.offsamples), "samples per pixel of the off-screen buffer"),
    row("numslices", Int(|v| &mut v.numslices), "slices of round shapes"),
    row("numstacks", Int(|v| &mut v.numstacks), "stacks of round shapes"),
    row("numquads", Int(|v| &mut v.numquads), "quads per side of a box"),
];

static HEADLIGHT: ElementType = leaf("headlight", "The light at the camera", &[&VISUAL_HEADLIGHT]);

/// Attributes of `visual/headlight`.
pub static VISUAL_HEADLIGHT: [Row<VisualHeadlight>; 4] = [
    row("ambient", Singles(|v| &mut v.ambient), "ambient colour"),
    row("diffuse", Singles(|v| &mut v.diffuse), "diffuse colour"),
    row("specular", Singles(|v| &mut v.specular), "specular colour"),
    row("active", Int(|v| &mut v.active), "nonzero when on"),
];

static MAP: ElementType = leaf("map", "Scales from physical to visual quantities", &[&VISUAL_MAP]);

/// Attributes of `visual/map`.
pub static VISUAL_MAP: [Row<VisualMap>; 13] = [
    row("stiffness", Single(|v| &mut v.stiffness), "mouse spring stiffness"),
    row("stiffnessrot", Single(|v| &mut v.stiffnessrot), "mouse spring stiffness, rotation"),
    row("force", Single(|v| &mut v.force), "arrow length per force"),
    row("torque", Single(|v| &mut v.torque), "arrow length per torque"),
    row("alpha", Single(|v| &mut v.alpha), "opacity of transparent geoms"),
    row("fogstart", Single(|v| &mut v.fogstart), "distance where fog starts, in extents"),
    row("fogend", Single(|v| &mut v.fogend), "distance where fog is full, in extents"),
    row("znear", Single(|v| &mut v.znear), "near plane, in extents"),
    row("zfar", Single(|v| &mut v.zfar), "far plane, in extents"),
    row("haze", Single(|v| &mut v.haze), "share of the horizon that hazes"),
    row("shadowclip", Single(|v| &mut v.shadowclip), "reach of directional shadows, in extents"),
    row("shadowscale", Single(|v| &mut v.shadowscale), "share of a spot light's cone that shadows"),
    row("actuatortendon", Single(|v| &mut v.actuatortendon), "width of an actuated tendon over its own"),
];

static SCALE: ElementType = leaf("scale", "Sizes of decorations, in mean body sizes", &[&VISUAL_SCALE]);

/// Attributes of `visual/scale`.
pub static VISUAL_SCALE: [Row<VisualScale>; 17] = [
    row("forcewidth", Single(|v| &mut v.forcewidth), "force arrows"),
    row("contactwidth", Single(|v| &mut v.contactwidth), "contact discs, width"),
    row("contactheight", Single(|v| &mut v.contactheight), "contact discs, height"),
    row("connect", Single(|v| &mut v.connect), "connect constraints"),
    row("com", Single(|v| &mut v.com), "centres of mass"),
    row("camera", Single(|v| &mut v.camera), "cameras"),
    row("light", Single(|v| &mut v.light), "lights"),
    row("selectpoint", Single(|v| &mut v.selectpoint), "the selection"),
    row("jointlength", Single(|v| &mut v.jointlength), "joint axes, length"),
    row("jointwidth", Single(|v| &mut v.jointwidth), "joint axes, width"),
    row("actuatorlength", Single(|v| &mut v.actuatorlength), "actuators, length"),
    row("actuatorwidth", Single(|v| &mut v.actuatorwidth), "actuators, width"),
    row("framelength", Single(|v| &mut v.framelength), "frame axes, length"),
    row("framewidth", Single(|v| &mut v.framewidth), "frame axes, width"),
    row("constraint", Single(|v| &mut v.constraint), "constraint errors"),
    row("slidercrank", Single(|v| &mut v.slidercrank), "slider-cranks"),
    row("frustum", Single(|v| &mut v.frustum), "camera frusta, far plane"),
];

static RGBA: ElementType = leaf("rgba", "Colours of decorations", &[&VISUAL_RGBA]);

/// Attributes of `visual/rgba`.
pub static VISUAL_RGBA: [Row<VisualRgba>; 25] = [
    row("fog", Singles(|v| &mut v.fog), "fog"),
    row("haze", Singles(|v| &mut v.haze), "haze"),
    row("force", Singles(|v| &mut v.force), "force arrows"),
    row("inertia", Singles(|v| &mut v.inertia), "inertia boxes"),
    row("joint", Singles(|v| &mut v.joint), "joint axes"),
    row("actuator", Singles(|v| &mut v.actuator), "actuators"),
    row("actuatornegative", Singles(|v| &mut v.actuatornegative), "actuators at negative control"),
    row("actuatorpositive", Singles(|v| &mut v.actuatorpositive), "actuators at positive control"),
    row("com", Singles(|v| &mut v.com), "centres of mass"),
    row("camera", Singles(|v| &mut v.camera), "cameras"),
    row("light", Singles(|v| &mut v.light), "lights"),
    row("selectpoint", Singles(|v| &mut v.selectpoint), "the selection"),
    row("connect", Singles(|v| &mut v.connect), "connect constraints"),
    row("contactpoint", Singles(|v| &mut v.contactpoint), "contact points"),
    row("contactforce", Singles(|v| &mut v.contactforce), "contact forces"),
    row("contactfriction", Singles(|v| &mut v.contactfriction), "contact friction"),
    row("contacttorque", Singles(|v| &mut v.contacttorque), "contact torques"),
    row("contactgap", Singles(|v| &mut v.contactgap), "contacts inside their gap"),
    row("rangefinder", Singles(|v| &mut v.rangefinder), "rangefinder rays"),
    row("constraint", Singles(|v| &mut v.constraint), "constraint errors"),
    row("slidercrank", Singles(|v| &mut v.slidercrank), "slider-cranks"),
    row("crankbroken", Singles(|v| &mut v.crankbroken), "broken slider-cranks"),
    row("frustum", Singles(|v| &mut v.frustum), "camera frusta"),
    row("bv", Singles(|v| &mut v.bv), "bounding volumes"),
    row("bvactive", Singles(|v| &mut v.bvactive), "active bounding volumes"),
];
