//! The stages of a forward pass: what each reads and writes, and how it runs alone.

use physics::data::Configuration;
use physics::{
    Data, Model, actuation, actuation::transmission, collision, constraint, flex, inertia, on_demand::energy,
    on_demand::momentum, position::camera, position::com, position::kinematics, position::tendon, sensor,
    velocity::bias, velocity::com_vel, velocity::passive,
};

/// One stage: the recorded arrays it reads, how it runs, and the arrays it writes.
pub(crate) struct Stage {
    pub name: &'static str,
    pub reads: &'static [&'static str],
    pub run: fn(&Model, &mut Data),
    pub writes: &'static [&'static str],
}

/// Contacts as collision detection leaves them, but for `exclude`, which the rows complete; the friction cone's `mu` and
/// the row address belong to the rows.
macro_rules! contacts {
    ($($more:literal),*) => {
        &[
            "contact.dist", "contact.pos", "contact.frame", "contact.includemargin", "contact.friction",
            "contact.solref", "contact.solreffriction", "contact.solimp", "contact.adhesion", "contact.dim",
            "contact.geom", "contact.flex", "contact.elem", "contact.vert", $($more),*
        ]
    };
}

/// All stages, in their order.
pub(crate) const STAGES: &[Stage] = &[
    Stage {
        name: "kinematics",
        reads: &[],
        run: |m, d| kinematics::kinematics(m, &d.state, &mut d.kin),
        writes: &[
            "xpos",
            "xquat",
            "xmat",
            "xipos",
            "ximat",
            "xanchor",
            "xaxis",
            "geom_xpos",
            "geom_xmat",
            "site_xpos",
            "site_xmat",
        ],
    },
    Stage {
        name: "com",
        reads: &["xmat", "xipos", "ximat", "xanchor", "xaxis"],
        run: |m, d| com::com_pos(m, &d.kin, &mut d.com),
        writes: &["subtree_com", "cdof", "cinert"],
    },
    Stage {
        name: "cameras",
        reads: &["xpos", "xquat", "xmat", "xipos", "ximat", "subtree_com"],
        run: |m, d| camera::cameras_and_lights(m, &d.com, &mut d.kin),
        writes: &["cam_xpos", "cam_xmat", "light_xpos", "light_xdir"],
    },
    Stage {
        name: "flex",
        reads: &["xpos", "xmat", "subtree_com", "cdof"],
        run: |m, d| flex::flexes(m, &d.kin, &d.com, &mut d.flex, &mut d.scratch.flex),
        writes: &[
            "flexvert_xpos",
            "flexelem_aabb",
            "bvh_aabb_dyn",
            "flexedge_length",
            "flexedge_J",
            "flexvert_length",
            "flexvert_J",
        ],
    },
    Stage {
        name: "tendon",
        reads: &["xpos", "xmat", "geom_xpos", "geom_xmat", "site_xpos", "subtree_com", "cdof"],
        run: |m, d| tendon::tendon(m, &d.state, &d.kin, &d.com, &mut d.ten),
        writes: &["ten_wrapadr", "ten_wrapnum", "ten_J", "ten_length"],
    },
    Stage {
        name: "inertia",
        reads: &["cinert", "cdof", "ten_J"],
        run: |m, d| {
            inertia::make_inertia(m, &d.com, &d.ten, &mut d.inertia);
            inertia::factor_inertia(m, &mut d.inertia);
        },
        writes: &["crb", "M", "qLD", "qLDiagInv"],
    },
    Stage {
        name: "collision",
        reads: &[
            "xpos",
            "xquat",
            "xmat",
            "xipos",
            "ximat",
            "geom_xpos",
            "geom_xmat",
            "flexvert_xpos",
            "flexelem_aabb",
            "bvh_aabb_dyn",
        ],
        run: |m, d| {
            let scratch = &mut collision::CollisionScratch::default();
            let world = collision::World { m, kin: &d.kin, flexes: &d.flex };
            collision::collide_awake(world, &d.state, d.budget, scratch, &mut d.con)
                .expect("contacts within the budget");
        },
        writes: contacts!(),
    },
    Stage {
        name: "rows",
        reads: contacts!(
            "contact.exclude",
            "xpos",
            "xquat",
            "xmat",
            "geom_xpos",
            "geom_xmat",
            "site_xpos",
            "site_xmat",
            "subtree_com",
            "cdof",
            "flexvert_xpos",
            "flexedge_length",
            "flexedge_J",
            "flexvert_length",
            "flexvert_J",
            "ten_J",
            "ten_length",
            "M",
            "qLD",
            "qLDiagInv",
            "cvel",
            "cdof_dot"
        ),
        run: constraint_rows,
        writes: &[
            "ne",
            "nf",
            "nl",
            "nefc",
            "nisland",
            "efc_type",
            "efc_id",
            "efc_J",
            "efc_pos",
            "efc_margin",
            "efc_frictionloss",
            "efc_diagA",
            "efc_KBIP",
            "efc_D",
            "efc_R",
            "efc_vel",
            "efc_aref",
            "contact.mu",
            "contact.exclude",
            "contact.efc_address",
        ],
    },
    Stage {
        name: "transmission",
        reads: contacts!(
            "contact.efc_address",
            "contact.exclude",
            "xpos",
            "xquat",
            "xmat",
            "site_xpos",
            "site_xmat",
            "subtree_com",
            "cdof",
            "ten_J",
            "ten_length",
            "M",
            "qLD",
            "qLDiagInv"
        ),
        run: |m, d| {
            constraint_rows(m, d);
            transmission::transmission(
                m,
                &Configuration { state: &d.state, kin: &d.kin, com: &d.com, flex: &d.flex, ten: &d.ten },
                &d.con,
                &d.efc,
                &mut d.trn,
            )
        },
        writes: &["actuator_length", "moment_rownnz", "moment_rowadr", "moment_colind", "actuator_moment"],
    },
    Stage {
        name: "velocity",
        reads: &[
            "subtree_com",
            "cdof",
            "flexedge_J",
            "ten_J",
            "moment_rownnz",
            "moment_rowadr",
            "moment_colind",
            "actuator_moment",
        ],
        run: |m, d| {
            if m.nflex > 0 {
                flex::edge_velocities(m, &d.state, &d.flex, &mut d.vel.flexedge_velocity);
            }
            tendon::tendon_velocity(m, &d.state, &d.ten, &mut d.vel.ten_velocity);
            transmission::actuator_velocity(m, &d.state, &d.trn, &mut d.vel);
            com_vel::com_vel(m, &d.state, &d.com, &mut d.vel);
        },
        writes: &["flexedge_velocity", "ten_velocity", "actuator_velocity", "cvel", "cdof_dot"],
    },
    Stage {
        name: "passive",
        reads: contacts!(
            "contact.exclude",
            "xpos",
            "xquat",
            "xmat",
            "xipos",
            "ximat",
            "geom_xpos",
            "geom_xmat",
            "subtree_com",
            "cdof",
            "cinert",
            "M",
            "flexvert_xpos",
            "flexedge_length",
            "flexedge_J",
            "flexedge_velocity",
            "ten_J",
            "ten_length",
            "ten_velocity",
            "cvel"
        ),
        run: |m, d| {
            let poses = flex::Poses { kin: &d.kin, com: &d.com };
            d.metric.build(m, poses, &d.inertia, &mut d.con, &mut d.flex, &mut d.scratch.flex);
            passive::passive(
                m,
                &Configuration { state: &d.state, kin: &d.kin, com: &d.com, flex: &d.flex, ten: &d.ten },
                &d.con,
                &d.vel,
                (&d.metric, &mut d.scratch.flex),
                &mut d.passive,
            )
        },
        writes: &[
            "qfrc_spring",
            "qfrc_damper",
            "qfrc_gravcomp",
            "qfrc_fluid",
            "qfrc_adhesion",
            "qfrc_passive",
        ],
    },
    Stage {
        name: "bias",
        reads: &["xpos", "xmat", "subtree_com", "cdof", "cinert", "cvel", "cdof_dot", "ten_J"],
        run: |m, d| {
            bias::bias(m, &d.state, &d.kin, &d.com, &d.ten, &mut d.vel, &mut bias::RneScratch::default())
        },
        writes: &["qfrc_bias"],
    },
    Stage {
        name: "actuation",
        reads: &[
            "actuator_length",
            "moment_rownnz",
            "moment_rowadr",
            "moment_colind",
            "actuator_moment",
            "actuator_velocity",
            "ten_velocity",
            "qfrc_gravcomp",
            "qfrc_passive",
        ],
        run: |m, d| actuation::actuation(m, &d.state, &d.trn, &d.vel, &d.passive, &mut d.actuation),
        writes: &["act_dot", "actuator_force", "qfrc_actuator"],
    },
    Stage {
        name: "sensors",
        reads: contacts!(
            "contact.efc_address",
            "contact.exclude",
            "xpos",
            "xquat",
            "xmat",
            "xipos",
            "ximat",
            "geom_xpos",
            "geom_xmat",
            "site_xpos",
            "site_xmat",
            "cam_xpos",
            "cam_xmat",
            "subtree_com",
            "cdof",
            "flexedge_length",
            "M",
            "ten_length",
            "ten_velocity",
            "actuator_length",
            "actuator_velocity",
            "actuator_force",
            "qfrc_actuator",
            "cvel",
            "cacc",
            "cfrc_int",
            "ne",
            "nf",
            "nl",
            "nefc",
            "efc_type",
            "efc_id",
            "efc_pos",
            "efc_margin",
            "efc_vel",
            "efc_force"
        ),
        run: sensors,
        writes: &["sensordata", "energy", "subtree_linvel", "subtree_angmom"],
    },
];

/// Rows and islands from contacts that have no row yet. Collision detection excludes those in the gap; the mark of those
/// that move nothing is an output here.
fn constraint_rows(m: &Model, d: &mut Data) {
    let mut scratch = constraint::ConstraintScratch::default();
    for c in &mut d.con.contact {
        c.efc_address = -1;
        c.exclude = if c.exclude == constraint::NO_DOF { 0 } else { c.exclude };
    }
    let Data { state, kin, com, flex, ten, inertia, con, efc, island, vel, .. } = d;
    let at = Configuration { state, kin, com, flex, ten };
    constraint::make_constraint(m, &at, inertia, con, efc, &mut scratch);
    constraint::find_islands(m, state, con, efc, island, &mut constraint::IslandScratch::default());
    constraint::reference(m, &at, vel, con, efc, &mut scratch);
}

fn sensors(m: &Model, d: &mut Data) {
    let Data { state, kin, com, flex, ten, trn, inertia, con, efc, vel, actuation, sensor: out, .. } = d;
    let mut scratch = sensor::SensorScratch::default();
    let inputs = sensor::PositionInputs { state, kin, com, flex, ten, trn, inertia, efc };
    let past = sensor::Past { state };
    sensor::position_sensors(m, &inputs, past, &mut scratch, out);
    let inputs = sensor::VelocityInputs { state, kin, com, trn, vel, efc };
    sensor::velocity_sensors(m, &inputs, past, &mut scratch, out);
    let inputs = sensor::AccelerationInputs { state, kin, com, con, efc, vel, actuation };
    sensor::acceleration_sensors(m, &inputs, past, &mut scratch, out);
    momentum::subtree_momentum(m, state, kin, com, vel, out);
    let at = Configuration { state, kin, com, flex, ten };
    d.energy = [energy::potential(m, &at), energy::kinetic(m, state, inertia, &mut Vec::new())];
}
