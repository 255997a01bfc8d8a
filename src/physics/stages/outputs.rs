//! Stage outputs: each struct is written by one stage and read by those after it.
//!
//! World frame unless said otherwise; spatial vectors are rotation first; `com-based` quantities are expressed
//! in the world orientation about the centre of mass of the kinematic tree (`subtree_com` of the root body).

use super::declare::stage;

stage! {
    /// Simulation state and user inputs: all that decides the next step.
    State {
        /// Generalised positions \[m, rad, unit quaternions\].
        qpos: f64 [nq],
        /// Generalised velocities \[m/s, rad/s\].
        qvel: f64 [nv],
        /// Actuator activations.
        act: f64 [na],
        /// Delay buffers of actuators and sensors.
        history: f64 [nhistory],
        /// Acceleration that starts the constraint solver.
        qacc_warmstart: f64 [nv],
        /// Control inputs.
        ctrl: f64 [nu],
        /// User forces in joint space \[N, N m\].
        qfrc_applied: f64 [nv],
        /// User wrenches on bodies at their centres of mass, force first \[N, N m\].
        xfrc_applied: f64 [nbody; 6],
        /// Which equality constraints are on.
        eq_active: bool [neq],
        /// Positions of mocap bodies \[m\].
        mocap_pos: f64 [nmocap; 3],
        /// Orientations of mocap bodies.
        mocap_quat: f64 [nmocap; 4],
        /// User storage.
        userdata: f64 [nuserdata],
        /// What plugins keep from step to step.
        plugin_state: f64 [npluginstate],
        /// Which trees sleep, and since when the others are slow (`sleep`).
        tree_asleep: i32 [ntree],
        /// 1 where a tree is awake, 0 where it sleeps. This and all below follows from `tree_asleep`.
        tree_awake: i32 [ntree],
        /// 1 where a body is awake, 0 where it sleeps, -1 where it cannot move.
        body_awake: i32 [nbody],
        /// Bodies that do not sleep; the first `nbody_awake` count.
        body_awake_ind: i32 [nbody],
        /// Bodies whose parent does not sleep; the first `nparent_awake` count.
        parent_awake_ind: i32 [nbody],
        /// Degrees of freedom that do not sleep; the first `nv_awake` count.
        dof_awake_ind: i32 [nv],
    } scalars {
        /// Simulation time \[s\].
        time: f64,
        /// Trees that are awake.
        ntree_awake: usize,
        /// Bodies that do not sleep.
        nbody_awake: usize,
        /// Bodies whose parent does not sleep.
        nparent_awake: usize,
        /// Degrees of freedom that do not sleep.
        nv_awake: usize,
    }
}

stage! {
    /// Global poses of bodies, joints, geoms, sites, cameras and lights (`kinematics`).
    Kinematics {
        /// Body frame position.
        xpos: f64 [nbody; 3],
        /// Body frame orientation.
        xquat: f64 [nbody; 4],
        /// Body frame orientation as a matrix.
        xmat: f64 [nbody; 9],
        /// Body centre of mass.
        xipos: f64 [nbody; 3],
        /// Orientation of the principal inertia axes.
        ximat: f64 [nbody; 9],
        /// Joint anchor.
        xanchor: f64 [njnt; 3],
        /// Joint axis.
        xaxis: f64 [njnt; 3],
        /// Geom position.
        geom_xpos: f64 [ngeom; 3],
        /// Geom orientation.
        geom_xmat: f64 [ngeom; 9],
        /// Site position.
        site_xpos: f64 [nsite; 3],
        /// Site orientation.
        site_xmat: f64 [nsite; 9],
        /// Camera position.
        cam_xpos: f64 [ncam; 3],
        /// Camera orientation.
        cam_xmat: f64 [ncam; 9],
        /// Light position.
        light_xpos: f64 [nlight; 3],
        /// Light direction.
        light_xdir: f64 [nlight; 3],
    }
}

stage! {
    /// Subtree centres of mass, motion axes and inertias about them (`com_pos`).
    Com {
        /// Centre of mass of the subtree of each body.
        subtree_com: f64 [nbody; 3],
        /// Com-based motion axis of each degree of freedom.
        cdof: f64 [nv; 6],
        /// Com-based body inertia: 6 of the symmetric matrix, mass times offset, mass.
        cinert: f64 [nbody; 10],
    }
}

stage! {
    /// Vertices, edges and boxes of flexes (`flex`).
    Flexes {
        /// Vertex positions.
        flexvert_xpos: f64 [nflexvert; 3],
        /// Bounding boxes of elements: centre, half sizes \[m\].
        flexelem_aabb: f64 [nflexelem; 6],
        /// Stiffness of elements, turned with them; integrators that are implicit in velocity alone fill it.
        flexelem_krot: f64 [nflexstiffness],
        /// Jacobian of edge lengths; structure in the model.
        flexedge_J: f64 [nJfe],
        /// Lengths of edges \[m\].
        flexedge_length: f64 [nflexedge],
        /// Jacobian of vertex strains; structure in the model.
        flexvert_J: f64 [nJfv; 2],
        /// Strains at vertices.
        flexvert_length: f64 [nflexvert; 2],
        /// Boxes of the moving bounding volume trees: centre, half sizes \[m\].
        bvh_aabb_dyn: f64 [nbvhdynamic; 6],
    }
}

stage! {
    /// Tendon paths, lengths and sparse Jacobian (`tendon`).
    Tendons {
        /// First wrap point of each tendon.
        ten_wrapadr: i32 [ntendon],
        /// Number of wrap points of each tendon.
        ten_wrapnum: i32 [ntendon],
        /// Jacobian values; structure in the model.
        ten_J: f64 [nJten],
        /// Lengths \[m, rad\].
        ten_length: f64 [ntendon],
        /// Geom of each wrap point; -1 site, -2 pulley.
        wrap_obj: i32 [nwrap; 2],
        /// Wrap points.
        wrap_xpos: f64 [nwrap; 6],
    }
}

stage! {
    /// Actuator lengths and moment arms (`transmission`).
    Transmission {
        /// Actuator lengths.
        actuator_length: f64 [nout],
        /// Non-zeros of each moment row.
        moment_rownnz: i32 [nout],
        /// Start of each moment row.
        moment_rowadr: i32 [nout],
        /// Columns of moment entries.
        moment_colind: i32 [nJmom],
        /// Moment entries.
        actuator_moment: f64 [nJmom],
    }
}

stage! {
    /// Joint-space inertia and its factor (`make_inertia`, `factor_inertia`).
    Inertia {
        /// Com-based composite inertia of each subtree.
        crb: f64 [nbody; 10],
        /// Joint-space inertia, lower triangle in compressed rows (`M_rownnz`, `M_rowadr`, `M_colind`).
        M: f64 [nC],
        /// L'DL factor of `M`, same layout.
        qLD: f64 [nC],
        /// Reciprocal diagonal of D.
        qLDiagInv: f64 [nv],
    }
}

stage! {
    /// Velocities derived from `qvel` (`com_vel` and the tendon and actuator products).
    Velocity {
        /// Velocities of flex edges \[m/s\].
        flexedge_velocity: f64 [nflexedge],
        /// Tendon velocities.
        ten_velocity: f64 [ntendon],
        /// Actuator velocities.
        actuator_velocity: f64 [nout],
        /// Com-based body velocity.
        cvel: f64 [nbody; 6],
        /// Time derivative of `cdof`.
        cdof_dot: f64 [nv; 6],
        /// Coriolis, centrifugal and gravity force.
        qfrc_bias: f64 [nv],
    }
}

stage! {
    /// Passive forces in joint space (`passive`).
    Passive {
        /// Springs.
        qfrc_spring: f64 [nv],
        /// Dampers.
        qfrc_damper: f64 [nv],
        /// Gravity compensation.
        qfrc_gravcomp: f64 [nv],
        /// Fluid drag and lift.
        qfrc_fluid: f64 [nv],
        /// Contact adhesion.
        qfrc_adhesion: f64 [nv],
        /// Total.
        qfrc_passive: f64 [nv],
    }
}

stage! {
    /// Actuator forces (`actuation`).
    Actuation {
        /// Time derivative of activations.
        act_dot: f64 [na],
        /// Force of each actuator output.
        actuator_force: f64 [nout],
        /// Actuator force in joint space.
        qfrc_actuator: f64 [nv],
    }
}

stage! {
    /// Accelerations without and with constraints (`acceleration`, `solve_constraints`).
    Acceleration {
        /// Net force without constraints.
        qfrc_smooth: f64 [nv],
        /// Acceleration without constraints.
        qacc_smooth: f64 [nv],
        /// Constraint force.
        qfrc_constraint: f64 [nv],
        /// Acceleration.
        qacc: f64 [nv],
    }
}

stage! {
    /// Quantities that only sensors ask for, and their readings.
    Sensors {
        /// Sensor readings.
        sensordata: f64 [nsensordata],
        /// Linear velocity of each subtree's centre of mass.
        subtree_linvel: f64 [nbody; 3],
        /// Angular momentum about each subtree's centre of mass.
        subtree_angmom: f64 [nbody; 3],
        /// Com-based body acceleration.
        cacc: f64 [nbody; 6],
        /// Com-based force between a body and its parent.
        cfrc_int: f64 [nbody; 6],
        /// Com-based external force on each body.
        cfrc_ext: f64 [nbody; 6],
    }
}

stage! {
    /// Factors that implicit integration needs (`integrate`).
    Implicit {
        /// L'DL factor of the modified inertia.
        qH: f64 [nC],
        /// Reciprocal diagonal of that factor.
        qHDiagInv: f64 [nv],
        /// Derivative of smooth forces with respect to velocity.
        qDeriv: f64 [nD],
        /// Sparse LU factor of `M - dt qDeriv`.
        qLU: f64 [nD],
        /// Force found by inverse dynamics.
        qfrc_inverse: f64 [nv],
    }
}
