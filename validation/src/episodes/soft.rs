//! Cloths, solids and ropes, which stretch no more than they should.

use super::things::Table;
use env::Env;
use physics::elements::BodyId;
use physics::math::{norm, sub};

/// What was seen of the soft things of a model.
#[derive(Clone, Debug, Default)]
pub struct Soft {
    /// Greatest length of an edge of a flex, as a multiple of its length at rest, or at the start where the model does not say it.
    pub stretch: Option<f64>,
    /// Most vertices inside the table at once.
    pub through: usize,
    /// Greatest length of a rope of links, as a multiple of its length at rest.
    pub rope: Option<f64>,
    edges: Vec<Edge>,
    links: Vec<BodyId>,
    rest: f64,
}

/// An edge of a flex: its vertices among those of all flexes, and its length at rest \[m\].
#[derive(Clone, Debug)]
struct Edge {
    ends: [usize; 2],
    rest: f64,
}

impl Soft {
    /// Of an environment at the start of an episode; `None` where nothing is soft.
    pub fn of(env: &Env) -> Option<Self> {
        let m = &env.scene().model;
        let links: Vec<_> = (0..).map_while(|k| m.body(&format!("rope_{k}"))).collect();
        let mut soft = Soft { edges: edges(env), links, ..Soft::default() };
        soft.rest = soft.length(env);
        (m.nflex > 0 || soft.links.len() > 1).then_some(soft)
    }

    /// Takes in the current state.
    pub fn look(&mut self, env: &Env) {
        let data = &env.scene().data;
        let ratios = self.edges.iter().map(|edge| length(env, edge.ends) / edge.rest);
        self.stretch = self.stretch.into_iter().chain(ratios).reduce(f64::max);
        if let Some(table) = Table::of(env) {
            let inside = data.flex.flexvert_xpos.iter().filter(|&&vertex| table.holds(vertex)).count();
            self.through = self.through.max(inside);
        }
        if self.links.len() > 1 {
            self.rope = Some(self.rope.unwrap_or(0.0).max(self.length(env) / self.rest));
        }
    }

    /// Together with what was seen before.
    pub fn with(self, before: Option<Soft>) -> Soft {
        let Some(before) = before else { return self };
        let greatest = |a: Option<f64>, b: Option<f64>| a.into_iter().chain(b).reduce(f64::max);
        Soft {
            stretch: greatest(self.stretch, before.stretch),
            through: self.through.max(before.through),
            rope: greatest(self.rope, before.rope),
            ..self
        }
    }

    fn length(&self, env: &Env) -> f64 {
        let place = |body: &BodyId| *env.scene().data.body(*body).xpos();
        self.links.windows(2).map(|pair| norm(sub(place(&pair[1]), place(&pair[0])))).sum()
    }
}

fn edges(env: &Env) -> Vec<Edge> {
    let m = &env.scene().model;
    let all = (0..m.nflex).flat_map(|flex| {
        let first = m.flex_edgeadr[flex].max(0) as usize;
        (first..first + m.flex_edgenum[flex] as usize).map(move |edge| (flex, edge))
    });
    let edge = |(flex, edge): (usize, usize)| {
        let ends = m.flex_edge[edge].map(|vertex| (m.flex_vertadr[flex] + vertex) as usize);
        let rest = Some(m.flexedge_length0[edge]).filter(|&rest| rest > 0.0);
        Edge { ends, rest: rest.unwrap_or_else(|| length(env, ends)) }
    };
    all.filter(|&(_, edge)| !m.flexedge_rigid[edge]).map(edge).collect()
}

fn length(env: &Env, ends: [usize; 2]) -> f64 {
    let [a, b] = ends.map(|vertex| env.scene().data.flex.flexvert_xpos[vertex]);
    norm(sub(b, a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use env::{Options, OwnModels};

    #[test]
    fn what_is_pulled_is_longer() {
        let mut env = Env::make("hive/SpongePress-v0", &OwnModels, &Options::default()).unwrap();
        env.reset(Some(0)).unwrap();
        let mut soft = Soft::of(&env).unwrap();
        soft.look(&env);
        let rest = soft.stretch.unwrap();
        assert!((rest - 1.0).abs() < 0.05 && soft.through == 0, "{soft:?}");
        let (model, mut world) = (&env.scene().model, env.world());
        // A corner of the lattice of nodes goes a side further up, and another one into the table.
        let [up, down] = [0, 1].map(|k| model.jnt_qposadr[model.njnt - 1 - 3 * k] as usize);
        let qpos = world.qpos.as_mut().unwrap();
        (qpos[up], qpos[down]) = (0.1, -0.05);
        env.set_world(&world).unwrap();
        soft.look(&env);
        assert!(soft.stretch.unwrap() > 1.3, "{:?}", soft.stretch);
    }
}
