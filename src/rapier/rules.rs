//! MuJoCo's rules for contact pairs and friction, as hooks of rapier's narrow phase.

use physics::Model;
use physics::collision::filter::{Touching, touching};
use physics::collision::mixing::Mixture;
use rapier3d_f64::prelude::{
    ActiveHooks, CoefficientCombineRule, Collider, ColliderHandle, ContactModificationContext, Group,
    InteractionGroups, InteractionTestMode, PairFilterContext, PhysicsHooks, SolverFlags,
};
use std::collections::HashMap;

/// Contact parameters of two geoms; `None` where they never touch.
pub(crate) fn mixture(m: &Model, g1: usize, g2: usize) -> Option<Mixture> {
    match touching(m, g1, g2) {
        Touching::Never => None,
        Touching::Mixed => Some(Mixture::new(m, g1, g2, None)),
        Touching::Named(pair) => Some(Mixture::new(m, g1, g2, Some(pair))),
    }
}

/// Sliding friction, the only kind in rapier; 0 for contacts without tangents. Of a predefined pair's two coefficients the first is used.
fn friction(mixture: &Mixture) -> f64 {
    if mixture.dim() == 1 { 0.0 } else { mixture.friction()[0] }
}

/// Whether the friction of all pairs is the maximum, the rule that rapier applies without hooks.
pub(crate) fn mixes_plainly(m: &Model) -> bool {
    let mut first = None;
    m.npair == 0
        && !m.opt.enableflags.contains(physics::model::Enable::OVERRIDE)
        && (0..m.ngeom)
            .filter(|&g| m.geom_contype[g] | m.geom_conaffinity[g] != 0)
            .all(|g| *first.get_or_insert(m.geom_priority[g]) == m.geom_priority[g] && m.geom_condim[g] > 1)
}

/// Sets friction, groups and hooks of a collider. `decides`: contact types alone decide which geoms it touches, so no hook is
/// needed for that. `plainly`: no hook is needed for friction ([`mixes_plainly`]).
pub(crate) fn prepare(m: &Model, g: usize, decides: bool, plainly: bool, collider: &mut Collider) {
    collider.set_friction(m.geom_friction[g][0]);
    collider.set_friction_combine_rule(CoefficientCombineRule::Max);
    collider.set_restitution(0.0);
    let mut hooks = ActiveHooks::empty();
    let mut types = [Group::ALL; 2];
    if decides {
        types = [m.geom_contype[g], m.geom_conaffinity[g]].map(|bits| Group::from_bits_truncate(bits as u32));
    } else {
        hooks |= ActiveHooks::FILTER_CONTACT_PAIRS;
    }
    let [memberships, filter] = types;
    let test_mode = InteractionTestMode::Or;
    collider.set_collision_groups(InteractionGroups { memberships, filter, test_mode });
    if !plainly {
        hooks |= ActiveHooks::MODIFY_SOLVER_CONTACTS;
    }
    collider.set_active_hooks(hooks);
}

/// The geom of each collider of a model.
pub(crate) type Geoms = HashMap<ColliderHandle, usize>;

/// MuJoCo's rules for the colliders of one model. Pairs with other colliders are left to rapier.
pub(crate) struct Rules<'a> {
    pub m: &'a Model,
    pub geoms: &'a Geoms,
}

impl Rules<'_> {
    fn geoms(&self, pair: [ColliderHandle; 2]) -> Option<[usize; 2]> {
        Some([*self.geoms.get(&pair[0])?, *self.geoms.get(&pair[1])?])
    }
}

impl PhysicsHooks for Rules<'_> {
    fn filter_contact_pair(&self, at: &PairFilterContext) -> Option<SolverFlags> {
        match self.geoms([at.collider1, at.collider2]) {
            Some([g1, g2]) if touching(self.m, g1, g2) == Touching::Never => None,
            Some(_) | None => Some(SolverFlags::COMPUTE_RIGID_IMPULSES),
        }
    }

    fn modify_solver_contacts(&self, at: &mut ContactModificationContext) {
        let geoms = self.geoms([at.collider1, at.collider2]);
        let mixture = geoms.and_then(|[g1, g2]| mixture(self.m, g1, g2));
        if let (Some(mixture), Some(rigid)) = (mixture, at.rigid_mut()) {
            *rigid.friction = friction(&mixture);
        }
    }
}
