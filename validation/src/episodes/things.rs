//! Bodies with a free joint, which neither fall out of the world nor through a table.

use env::Env;
use physics::Model;
use physics::math::quat_to_mat;
use physics::model::{GeomType, JointType};

/// How far below a floor a body is lost \[m\].
const BELOW: f64 = 0.05;
/// How far below the surface of a table, and how far within its edges, a point is inside it \[m\].
const INSIDE: f64 = 0.01;

/// The free bodies of a model, and its mass.
pub struct Things {
    bodies: Vec<usize>,
    mass: f64,
    floor: Option<f64>,
    table: Option<Table>,
}

impl Things {
    /// Those of an environment.
    pub fn of(env: &Env) -> Self {
        let m = &env.scene().model;
        let free = |&body: &usize| {
            let joint = usize::try_from(m.body_jntadr[body]);
            joint.is_ok_and(|joint| m.jnt_type[joint] == JointType::Free as i32)
        };
        Things {
            bodies: (1..m.nbody).filter(free).collect(),
            mass: m.body_subtreemass[0],
            floor: floor(m),
            table: Table::of(env),
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.bodies.len()
    }

    /// Whether one is below the floor or inside the table, or the mass of all is another.
    pub fn are_lost(&self, env: &Env) -> bool {
        let data = &env.scene().data;
        let out = |&body: &usize| {
            let place = data.kin.xpos[body];
            self.floor.is_some_and(|floor| place[2] < floor - BELOW)
                || self.table.as_ref().is_some_and(|table| table.holds(place))
        };
        self.bodies.iter().any(out) || env.scene().model.body_subtreemass[0] != self.mass
    }
}

/// Height of the lowest level plane, if height fields do not go deeper \[m\].
fn floor(m: &Model) -> Option<f64> {
    if (0..m.ngeom).any(|geom| m.geom_type[geom] == GeomType::Hfield as i32) {
        return None;
    }
    let plane = |&geom: &usize| {
        let level = quat_to_mat(m.geom_quat[geom])[8] > 0.999;
        m.geom_type[geom] == GeomType::Plane as i32 && m.geom_bodyid[geom] == 0 && level
    };
    (0..m.ngeom).filter(plane).map(|geom| m.geom_pos[geom][2]).reduce(f64::min)
}

/// The board of a table.
pub struct Table {
    middle: [f64; 3],
    half: [f64; 3],
}

impl Table {
    /// The box `table_top`, where there is one.
    pub fn of(env: &Env) -> Option<Self> {
        let (model, data) = (&env.scene().model, &env.scene().data);
        let top = model.geom("table_top")?.index();
        let is_box = model.geom_type[top] == GeomType::Box as i32;
        is_box.then(|| Table { middle: data.kin.geom_xpos[top], half: model.geom_size[top] })
    }

    /// Whether a point is inside the board.
    pub fn holds(&self, point: [f64; 3]) -> bool {
        let from = |k: usize| point[k] - self.middle[k];
        let within = |k: usize| from(k).abs() < self.half[k] - INSIDE;
        within(0) && within(1) && from(2) < self.half[2] - INSIDE && from(2) > -self.half[2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use env::{Options, OwnModels};

    #[test]
    fn bodies_are_lost_in_the_table_and_below_the_floor() {
        let mut env = Env::make("hive/PandaStack-v0", &OwnModels, &Options::default()).unwrap();
        env.reset(Some(0)).unwrap();
        let things = Things::of(&env);
        assert_eq!((things.count(), things.are_lost(&env)), (2, false));
        let cube = env.scene().model.body("cube_a").unwrap();
        let joint = env.scene().model.body_jntadr[cube] as usize;
        let place = env.scene().model.jnt_qposadr[joint] as usize + 2;
        for (height, lost) in [(0.9, false), (0.745, true), (0.3, false), (-1.0, true)] {
            let mut world = env.world();
            world.qpos.as_mut().unwrap()[place] = height;
            env.set_world(&world).unwrap();
            assert_eq!(things.are_lost(&env), lost, "{height} m");
        }
    }
}
