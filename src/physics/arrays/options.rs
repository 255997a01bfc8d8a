//! Options, statistics and visual settings: scalars and short vectors with their defaults
//! (documentation: XML reference, `option`, `statistic`, `visual`).

use super::flags::{Disable, Enable};
use super::reader::{ReadError, Reader};
use super::setting::Setting;
use super::types::{Cone, Integrator, Jacobian, Solver};
use crate::table::Slice;

macro_rules! settings {
    ($($(#[$meta:meta])* $name:ident { $($(#[$doc:meta])* $field:ident : $t:ty = $default:expr,)* })*) => {$(
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name { $($(#[$doc])* pub $field: $t,)* }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }

        impl $name {
            /// Calls `f(name, values)` for every setting.
            pub fn visit(&self, f: &mut dyn FnMut(&'static str, Slice<'_>)) {
                $(f(stringify!($field), Setting::scalars(&self.$field));)*
            }

            /// Overwrites a setting by name; `None` when there is none, `Some(false)` when the numbers do not fit it.
            pub fn assign(&mut self, name: &str, values: &[f64]) -> Option<bool> {
                match name {
                    $(stringify!($field) => Some(Setting::assign(&mut self.$field, values)),)*
                    _ => None,
                }
            }

            /// Name and type of every setting.
            pub(crate) const LAYOUT: &str = concat!($(stringify!($field), ":", stringify!($t), "\n",)*);

            /// Reads every setting in declaration order.
            pub(crate) fn read(&mut self, from: &mut Reader<'_>) -> Result<(), ReadError> {
                $(from.setting(stringify!($field), &mut self.$field)?;)*
                Ok(())
            }
        }
    )*};
}

settings! {
    /// Simulation options (`<option>`).
    Options {
        /// Duration of a step \[s\].
        timestep: f64 = 0.002,
        /// Ratio of frictional to normal impedance of elliptic contacts.
        impratio: f64 = 1.0,
        /// Improvement below which the constraint solver stops.
        tolerance: f64 = 1e-08,
        /// Relative slope at which the line search stops.
        ls_tolerance: f64 = 0.01,
        /// Improvement below which the no-slip pass stops.
        noslip_tolerance: f64 = 1e-06,
        /// Accuracy of convex collision \[m\].
        ccd_tolerance: f64 = 1e-06,
        /// Speed below which a tree may sleep.
        sleep_tolerance: f64 = 0.001,
        /// Acceleration of gravity, world frame \[m/s²\].
        gravity: [f64; 3] = [0.0, 0.0, -9.81],
        /// Velocity of the medium, world frame \[m/s\].
        wind: [f64; 3] = [0.0, 0.0, 0.0],
        /// Magnetic flux, world frame.
        magnetic: [f64; 3] = [0.0, -0.5, 0.0],
        /// Density of the medium \[kg/m³\].
        density: f64 = 0.0,
        /// Viscosity of the medium \[Pa s\].
        viscosity: f64 = 0.0,
        /// Contact margin under the override flag \[m\].
        o_margin: f64 = 0.0,
        /// Contact reference under the override flag.
        o_solref: [f64; 2] = [0.02, 1.0],
        /// Contact impedance under the override flag.
        o_solimp: [f64; 5] = [0.9, 0.95, 0.001, 0.5, 2.0],
        /// Contact friction under the override flag.
        o_friction: [f64; 5] = [1.0, 1.0, 0.005, 0.0001, 0.0001],
        /// How velocities are integrated.
        integrator: Integrator = Integrator::Euler,
        /// Friction cone.
        cone: Cone = Cone::Pyramidal,
        /// Storage of the constraint Jacobian; results do not depend on it.
        jacobian: Jacobian = Jacobian::Auto,
        /// Constraint solver.
        solver: Solver = Solver::Newton,
        /// Most iterations of the constraint solver.
        iterations: i32 = 100,
        /// Most iterations of the line search.
        ls_iterations: i32 = 50,
        /// Iterations of the no-slip pass, 0 for none.
        noslip_iterations: i32 = 0,
        /// Most iterations of convex collision.
        ccd_iterations: i32 = 35,
        /// Parts of the physics that are off.
        disableflags: Disable = Disable::NONE,
        /// Additional computations that are on.
        enableflags: Enable = Enable::NONE,
        /// Bits of the actuator groups that are off.
        disableactuator: i32 = 0,
        /// Starting points of signed distance collision.
        sdf_initpoints: i32 = 40,
        /// Most iterations of signed distance collision.
        sdf_iterations: i32 = 10,
    }
    /// Statistics of the model at `qpos0` (`<statistic>`), lengths in metres.
    Statistic {
        /// Mean diagonal of the inertia matrix.
        meaninertia: f64 = 1.0,
        /// Mean body mass \[kg\].
        meanmass: f64 = 1.0,
        /// Mean body size \[m\].
        meansize: f64 = 0.2,
        /// Half extent of the model \[m\].
        extent: f64 = 2.0,
        /// Centre of the model, world frame \[m\].
        center: [f64; 3] = [0.0; 3],
    }
    /// General settings (`<visual/global>`).
    VisualGlobal {
        /// Camera at the start, -1 for the free one.
        cameraid: i32 = -1,
        /// The free camera is orthographic.
        orthographic: i32 = 0,
        /// Vertical field of view of the free camera, or extent when orthographic \[deg, m\].
        fovy: f32 = 45.0,
        /// Distance between the eyes of the free camera \[m\].
        ipd: f32 = 0.068,
        /// Azimuth of the free camera at the start \[deg\].
        azimuth: f32 = 90.0,
        /// Elevation of the free camera at the start \[deg\].
        elevation: f32 = -45.0,
        /// Width of lines.
        linewidth: f32 = 1.0,
        /// Emission added to the selected body.
        glow: f32 = 0.3,
        /// Speed of the simulation relative to the clock.
        realtime: f32 = 1.0,
        /// Width of the off-screen buffer \[pixel\].
        offwidth: i32 = 640,
        /// Height of the off-screen buffer \[pixel\].
        offheight: i32 = 480,
        /// Inertias are drawn as ellipsoids instead of boxes.
        ellipsoidinertia: i32 = 0,
        /// Active bounding volumes are drawn.
        bvactive: i32 = 0,
    }
    /// Rendering quality (`<visual/quality>`).
    VisualQuality {
        /// Size of the shadow map \[pixel\].
        shadowsize: i32 = 4096,
        /// Samples a pixel, off screen.
        offsamples: i32 = 4,
        /// Slices of round shapes.
        numslices: i32 = 28,
        /// Stacks of round shapes.
        numstacks: i32 = 16,
        /// Squares along a side of a box.
        numquads: i32 = 4,
    }
    /// The light at the camera (`<visual/headlight>`).
    VisualHeadlight {
        /// Ambient colour.
        ambient: [f32; 3] = [0.1, 0.1, 0.1],
        /// Diffuse colour.
        diffuse: [f32; 3] = [0.4, 0.4, 0.4],
        /// Specular colour.
        specular: [f32; 3] = [0.5, 0.5, 0.5],
        /// It is on.
        active: i32 = 1,
    }
    /// Scale factors from physical to visual quantities (`<visual/map>`).
    VisualMap {
        /// Stiffness of the mouse spring for translation.
        stiffness: f32 = 100.0,
        /// Stiffness of the mouse spring for rotation.
        stiffnessrot: f32 = 500.0,
        /// Length of an arrow a unit of force.
        force: f32 = 0.005,
        /// Length of an arrow a unit of torque.
        torque: f32 = 0.1,
        /// Opacity of transparent bodies.
        alpha: f32 = 0.3,
        /// Where fog begins, in extents.
        fogstart: f32 = 3.0,
        /// Where fog is complete, in extents.
        fogend: f32 = 10.0,
        /// Near clipping plane, in extents.
        znear: f32 = 0.01,
        /// Far clipping plane, in extents.
        zfar: f32 = 50.0,
        /// Share of the horizon that haze covers.
        haze: f32 = 0.3,
        /// Reach of directional shadows, in extents.
        shadowclip: f32 = 1.0,
        /// Share of a spot's cone that casts shadows.
        shadowscale: f32 = 0.6,
        /// Width of actuated tendons.
        actuatortendon: f32 = 2.0,
    }
    /// Sizes of decorative elements in units of `stat.meansize` (`<visual/scale>`).
    VisualScale {
        /// Width of force arrows.
        forcewidth: f32 = 0.1,
        /// Width of contacts.
        contactwidth: f32 = 0.3,
        /// Height of contacts.
        contactheight: f32 = 0.1,
        /// Size of body connections.
        connect: f32 = 0.2,
        /// Size of centres of mass.
        com: f32 = 0.4,
        /// Size of cameras.
        camera: f32 = 0.3,
        /// Size of lights.
        light: f32 = 0.3,
        /// Size of the selection.
        selectpoint: f32 = 0.2,
        /// Length of joints.
        jointlength: f32 = 1.0,
        /// Width of joints.
        jointwidth: f32 = 0.1,
        /// Length of actuators.
        actuatorlength: f32 = 0.7,
        /// Width of actuators.
        actuatorwidth: f32 = 0.2,
        /// Length of frame axes.
        framelength: f32 = 1.0,
        /// Width of frame axes.
        framewidth: f32 = 0.1,
        /// Width of violated constraints.
        constraint: f32 = 0.1,
        /// Width of slider cranks.
        slidercrank: f32 = 0.2,
        /// Depth of camera frustums.
        frustum: f32 = 10.0,
    }
    /// Colours of decorative elements (`<visual/rgba>`).
    VisualRgba {
        /// Fog.
        fog: [f32; 4] = [0.0, 0.0, 0.0, 1.0],
        /// Haze.
        haze: [f32; 4] = [1.0, 1.0, 1.0, 1.0],
        /// External forces.
        force: [f32; 4] = [1.0, 0.5, 0.5, 1.0],
        /// Equivalent inertias.
        inertia: [f32; 4] = [0.8, 0.2, 0.2, 0.6],
        /// Joints.
        joint: [f32; 4] = [0.2, 0.6, 0.8, 1.0],
        /// Actuators without force.
        actuator: [f32; 4] = [0.2, 0.25, 0.2, 1.0],
        /// Actuators at their smallest control.
        actuatornegative: [f32; 4] = [0.2, 0.6, 0.9, 1.0],
        /// Actuators at their largest control.
        actuatorpositive: [f32; 4] = [0.9, 0.4, 0.2, 1.0],
        /// Centres of mass.
        com: [f32; 4] = [0.9, 0.9, 0.9, 1.0],
        /// Cameras.
        camera: [f32; 4] = [0.6, 0.9, 0.6, 1.0],
        /// Lights.
        light: [f32; 4] = [0.6, 0.6, 0.9, 1.0],
        /// The selection.
        selectpoint: [f32; 4] = [0.9, 0.9, 0.1, 1.0],
        /// Body connections.
        connect: [f32; 4] = [0.2, 0.2, 0.8, 1.0],
        /// Contacts.
        contactpoint: [f32; 4] = [0.9, 0.6, 0.2, 1.0],
        /// Contact forces.
        contactforce: [f32; 4] = [0.7, 0.9, 0.9, 1.0],
        /// Friction forces of contacts.
        contactfriction: [f32; 4] = [0.9, 0.8, 0.4, 1.0],
        /// Torques of contacts.
        contacttorque: [f32; 4] = [0.9, 0.7, 0.9, 1.0],
        /// Contacts without force.
        contactgap: [f32; 4] = [0.5, 0.8, 0.9, 1.0],
        /// Rays of rangefinders.
        rangefinder: [f32; 4] = [1.0, 1.0, 0.1, 1.0],
        /// Violated constraints.
        constraint: [f32; 4] = [0.9, 0.0, 0.0, 1.0],
        /// Slider cranks.
        slidercrank: [f32; 4] = [0.5, 0.3, 0.8, 1.0],
        /// Slider cranks that cannot reach.
        crankbroken: [f32; 4] = [0.9, 0.0, 0.0, 1.0],
        /// Camera frustums.
        frustum: [f32; 4] = [1.0, 1.0, 0.0, 0.2],
        /// Bounding volumes.
        bv: [f32; 4] = [0.0, 1.0, 0.0, 0.5],
        /// Active bounding volumes.
        bvactive: [f32; 4] = [1.0, 0.0, 0.0, 0.5],
    }
}

/// Visualisation options (`<visual>`).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Visual {
    /// General settings.
    pub global: VisualGlobal,
    /// Rendering quality.
    pub quality: VisualQuality,
    /// The light at the camera.
    pub headlight: VisualHeadlight,
    /// Scale factors from physical to visual quantities.
    pub map: VisualMap,
    /// Sizes of decorative elements.
    pub scale: VisualScale,
    /// Colours of decorative elements.
    pub rgba: VisualRgba,
}

impl Visual {
    /// Calls `f(group, name, values)` for every setting, group by group.
    pub fn visit(&self, f: &mut dyn FnMut(&'static str, &'static str, Slice<'_>)) {
        self.global.visit(&mut |name, values| f("global", name, values));
        self.quality.visit(&mut |name, values| f("quality", name, values));
        self.headlight.visit(&mut |name, values| f("headlight", name, values));
        self.map.visit(&mut |name, values| f("map", name, values));
        self.scale.visit(&mut |name, values| f("scale", name, values));
        self.rgba.visit(&mut |name, values| f("rgba", name, values));
    }
}
