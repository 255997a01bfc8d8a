//! What follows from each array, and what an edit of it must check. Arrays in no row decide how the model is built.

use crate::arrays::ArrayId as A;

/// What an edit of an array must check beyond sizes and numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Check {
    #[default]
    Nothing,
    /// Geoms and actuators: types, dimensions and parameters that must fit each other.
    Elements,
    /// Every reference and pattern.
    Structure,
}

/// Which derived quantities follow from an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Follow {
    Nothing,
    /// Whether rare features are used.
    Features,
    /// Bounds of bodies.
    Bounds,
    /// Offsets of cameras, lights and equality constraints.
    Viewpoints,
    /// What is attached to sites.
    Sites,
    /// Bounds, and what wraps around geoms.
    Geoms,
    /// Poses, and what hangs on bodies.
    Bodies,
    /// Damping that is given as a ratio.
    Servos,
    /// Everything that follows from inertia or lengths.
    Inertia,
    /// Everything.
    Structure,
}

impl Check {
    pub(super) fn of(array: A) -> Self {
        match array {
            A::geom_type | A::geom_contype | A::geom_conaffinity | A::geom_condim | A::pair_dim => {
                Check::Elements
            }
            _ => match Follow::of(array) {
                Follow::Servos => Check::Elements,
                Follow::Structure => Check::Structure,
                _ => Check::Nothing,
            },
        }
    }
}

impl Follow {
    pub(super) fn of(array: A) -> Self {
        if INDEPENDENT.contains(&array) {
            return Follow::Nothing;
        }
        match array {
            A::body_gravcomp | A::geom_surfacevel | A::geom_adhesion | A::pair_adhesion => Follow::Features,
            A::geom_margin | A::geom_gap | A::geom_contype | A::geom_conaffinity => Follow::Bounds,
            A::cam_pos | A::cam_quat | A::light_pos | A::light_dir | A::eq_data => Follow::Viewpoints,
            A::site_pos | A::site_quat => Follow::Sites,
            A::geom_type | A::geom_size | A::geom_pos | A::geom_quat | A::hfield_size => Follow::Geoms,
            A::body_pos | A::body_quat => Follow::Bodies,
            A::actuator_gainprm | A::actuator_biasprm | A::actuator_dynprm => Follow::Servos,
            A::body_mass | A::body_inertia | A::dof_armature | A::jnt_pos => Follow::Inertia,
            A::qpos0 | A::qpos_spring | A::actuator_gear | A::actuator_cranklength => Follow::Inertia,
            A::flex_damping => Follow::Inertia,
            _ => Follow::Structure,
        }
    }
}

/// Arrays from which nothing is derived, and which refer to nothing.
const INDEPENDENT: &[A] = &[
    A::body_user,
    A::jnt_group,
    A::jnt_limited,
    A::jnt_actfrclimited,
    A::jnt_actgravcomp,
    A::jnt_solref,
    A::jnt_solimp,
    A::jnt_stiffness,
    A::jnt_stiffnesspoly,
    A::jnt_range,
    A::jnt_actfrcrange,
    A::jnt_margin,
    A::jnt_user,
    A::dof_solref,
    A::dof_solimp,
    A::dof_frictionloss,
    A::dof_damping,
    A::dof_dampingpoly,
    A::geom_condim,
    A::geom_group,
    A::geom_priority,
    A::geom_solmix,
    A::geom_solref,
    A::geom_solimp,
    A::geom_friction,
    A::geom_fluid,
    A::geom_user,
    A::geom_rgba,
    A::site_type,
    A::site_group,
    A::site_size,
    A::site_user,
    A::site_rgba,
    A::cam_fovy,
    A::cam_ipd,
    A::cam_sensorsize,
    A::cam_intrinsic,
    A::cam_user,
    A::light_castshadow,
    A::light_bulbradius,
    A::light_intensity,
    A::light_range,
    A::light_active,
    A::light_attenuation,
    A::light_cutoff,
    A::light_softness,
    A::light_exponent,
    A::light_ambient,
    A::light_diffuse,
    A::light_specular,
    A::skin_group,
    A::skin_rgba,
    A::skin_inflate,
    A::skin_vert,
    A::skin_texcoord,
    A::skin_bonebindpos,
    A::skin_bonebindquat,
    A::skin_bonevertweight,
    A::flex_priority,
    A::flex_solmix,
    A::flex_solref,
    A::flex_solimp,
    A::flex_friction,
    A::flex_margin,
    A::flex_gap,
    A::flex_group,
    A::flex_flatskin,
    A::flex_edgestiffness,
    A::flex_edgedamping,
    A::flex_rgba,
    A::flex_texcoord,
    A::hfield_data,
    A::tex_data,
    A::mat_texuniform,
    A::mat_texrepeat,
    A::mat_emission,
    A::mat_specular,
    A::mat_shininess,
    A::mat_reflectance,
    A::mat_metallic,
    A::mat_roughness,
    A::mat_rgba,
    A::pair_dim,
    A::pair_solref,
    A::pair_solreffriction,
    A::pair_solimp,
    A::pair_margin,
    A::pair_gap,
    A::pair_friction,
    A::eq_active0,
    A::eq_solref,
    A::eq_solimp,
    A::tendon_group,
    A::tendon_limited,
    A::tendon_actfrclimited,
    A::tendon_width,
    A::tendon_solref_lim,
    A::tendon_solimp_lim,
    A::tendon_solref_fri,
    A::tendon_solimp_fri,
    A::tendon_range,
    A::tendon_actfrcrange,
    A::tendon_margin,
    A::tendon_frictionloss,
    A::tendon_user,
    A::tendon_rgba,
    A::actuator_actlimited,
    A::actuator_actrange,
    A::actuator_actearly,
    A::actuator_group,
    A::actuator_user,
    A::actuator_forcelimited,
    A::actuator_forcerange,
    A::actuator_ctrllimited,
    A::actuator_ctrlrange,
    A::actuator_lengthrange,
    A::actuator_delay,
    A::sensor_delay,
    A::sensor_cutoff,
    A::sensor_noise,
    A::sensor_user,
    A::numeric_data,
    A::key_time,
    A::key_qpos,
    A::key_qvel,
    A::key_act,
    A::key_mpos,
    A::key_mquat,
    A::key_ctrl,
];
