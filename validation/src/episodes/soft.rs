//! Cloths, solids and ropes, which stretch no more than they should.

use super::things::Table;
use env::Env;
use physics::elements::BodyId;
use physics::math::{cross, dot, norm, sub};

/// Greatest length of an edge that constraints hold, as a multiple of its length at rest. Edges of an elastic solid have no such bound.
const STRETCH: f64 = 1.1;
/// Greatest length of a rope, as a multiple of its length at rest: joints hold it, to rounding.
const ROPE: f64 = 1.0 + 1e-9;

/// What was seen of the soft things of a model.
#[derive(Clone, Debug, Default)]
pub struct Soft {
    /// Greatest length of an edge of a flex, as a multiple of its length at rest, or at the start where the model does not say it.
    pub stretch: Option<f64>,
    /// The same of edges that constraints hold.
    pub held: Option<f64>,
    /// Most vertices inside the table at once.
    pub through: usize,
    /// Most edges of a cloth that went through one of its triangles at once.
    pub pierced: usize,
    /// Greatest length of a rope of links, as a multiple of its length at rest.
    pub rope: Option<f64>,
    edges: Vec<Edge>,
    triangles: Vec<[usize; 3]>,
    links: Vec<BodyId>,
    rest: f64,
}

/// An edge of a flex: its vertices among those of all flexes, its length at rest \[m\], and whether constraints hold it.
#[derive(Clone, Debug)]
struct Edge {
    ends: [usize; 2],
    rest: f64,
    held: bool,
}

impl Soft {
    /// Of an environment at the start of an episode; `None` where nothing is soft.
    pub fn of(env: &Env) -> Option<Self> {
        let m = &env.scene().model;
        let links: Vec<_> = (0..).map_while(|k| m.body(&format!("rope_{k}"))).collect();
        let mut soft = Soft { edges: edges(env), triangles: triangles(env), links, ..Soft::default() };
        soft.rest = soft.length(env);
        (m.nflex > 0 || soft.links.len() > 1).then_some(soft)
    }

    /// Takes in the current state.
    pub fn look(&mut self, env: &Env) {
        let data = &env.scene().data;
        for edge in &self.edges {
            let ratio = Some(length(env, edge.ends) / edge.rest);
            self.stretch = greatest(self.stretch, ratio);
            self.held = greatest(self.held, ratio.filter(|_| edge.held));
        }
        if let Some(table) = Table::of(env) {
            let inside = data.flex.flexvert_xpos.iter().filter(|&&vertex| table.holds(vertex)).count();
            self.through = self.through.max(inside);
        }
        self.pierced = self.pierced.max(self.piercing(&data.flex.flexvert_xpos));
        if self.links.len() > 1 {
            self.rope = Some(self.rope.unwrap_or(0.0).max(self.length(env) / self.rest));
        }
    }

    /// Together with what was seen before.
    pub fn with(self, before: Option<Soft>) -> Soft {
        let Some(before) = before else { return self };
        Soft {
            stretch: greatest(self.stretch, before.stretch),
            held: greatest(self.held, before.held),
            through: self.through.max(before.through),
            pierced: self.pierced.max(before.pierced),
            rope: greatest(self.rope, before.rope),
            ..self
        }
    }

    /// No edge that constraints hold is longer than [`STRETCH`] allows, nothing went through the table or the cloth, and a rope kept its length.
    pub fn is_whole(&self) -> bool {
        let (edge, rope) = (self.held.unwrap_or(1.0), self.rope.unwrap_or(1.0));
        edge <= STRETCH && rope <= ROPE && self.through + self.pierced == 0
    }

    /// Longest edge, vertices inside the table, edges through the cloth, length of the rope; `-` of what the model has not.
    pub fn cells(&self) -> [String; 4] {
        let ratio = |ratio: Option<f64>| ratio.map(|ratio| format!("{ratio:.4}"));
        let vertices = self.stretch.map(|_| self.through.to_string());
        let cloth = (!self.triangles.is_empty()).then(|| self.pierced.to_string());
        [ratio(self.stretch), vertices, cloth, ratio(self.rope)]
            .map(|cell| cell.unwrap_or_else(|| "-".into()))
    }

    /// Edges that go through a triangle of which they have no vertex.
    fn piercing(&self, vertices: &[[f64; 3]]) -> usize {
        let pierces = |edge: &&Edge| {
            let apart = |triangle: &&[usize; 3]| !triangle.iter().any(|vertex| edge.ends.contains(vertex));
            let through = |triangle: &[usize; 3]| {
                crosses(edge.ends.map(|v| vertices[v]), triangle.map(|v| vertices[v]))
            };
            self.triangles.iter().filter(apart).any(through)
        };
        self.edges.iter().filter(pierces).count()
    }

    fn length(&self, env: &Env) -> f64 {
        let place = |body: &BodyId| *env.scene().data.body(*body).xpos();
        self.links.windows(2).map(|pair| norm(sub(place(&pair[1]), place(&pair[0])))).sum()
    }
}

fn greatest(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    a.into_iter().chain(b).reduce(f64::max)
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
        let held = m.flex_edgeequality[flex] != 0;
        Edge { ends, rest: rest.unwrap_or_else(|| length(env, ends)), held }
    };
    all.filter(|&(_, edge)| !m.flexedge_rigid[edge]).map(edge).collect()
}

/// Triangles of the flexes that are surfaces, as vertices among those of all flexes.
fn triangles(env: &Env) -> Vec<[usize; 3]> {
    let m = &env.scene().model;
    let surfaces = (0..m.nflex).filter(|&flex| m.flex_dim[flex] == 2);
    let of = |flex: usize| {
        let first = m.flex_elemdataadr[flex] as usize;
        let corners = m.flex_elem[first..first + 3 * m.flex_elemnum[flex] as usize].as_chunks::<3>().0;
        corners.iter().map(move |corners| corners.map(|vertex| (m.flex_vertadr[flex] + vertex) as usize))
    };
    surfaces.flat_map(of).collect()
}

/// Whether a segment goes through the inside of a triangle: its ends are on either side of the plane, and all sides of the triangle turn the same
/// way round it.
fn crosses([a, b]: [[f64; 3]; 2], [p, q, r]: [[f64; 3]; 3]) -> bool {
    let volume = |o, u, v, w| dot(cross(sub(u, o), sub(v, o)), sub(w, o));
    let turns = [volume(a, p, q, b), volume(a, q, r, b), volume(a, r, p, b)];
    let either_side = volume(p, q, r, a) * volume(p, q, r, b) < 0.0;
    either_side && (turns.iter().all(|turn| *turn > 0.0) || turns.iter().all(|turn| *turn < 0.0))
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
        assert!(soft.stretch.unwrap() > 1.3 && soft.held.is_none(), "{:?}", soft.stretch);
        assert!(soft.cells()[2..] == ["-", "-"], "{:?}", soft.cells());
    }

    #[test]
    fn a_cloth_that_is_pulled_through_itself_is_pierced() {
        let mut env = Env::make("hive/ClothFold-v0", &OwnModels, &Options::default()).unwrap();
        env.reset(Some(0)).unwrap();
        let mut soft = Soft::of(&env).unwrap();
        soft.look(&env);
        assert_eq!((soft.pierced, soft.triangles.len()), (0, 72));
        let mut vertices = env.scene().data.flex.flexvert_xpos.clone();
        // A vertex inside the cloth is led over the middle of a triangle two squares away, and down through it.
        let far = soft.triangles.iter().find(|t| t.iter().all(|v| !(8..=24).contains(v))).unwrap();
        let middle = [0, 1, 2].map(|i| far.iter().map(|v| vertices[*v][i]).sum::<f64>() / 3.0);
        vertices[16] = [middle[0], middle[1], middle[2] - 0.01];
        assert_eq!(
            soft.piercing(&vertices),
            0,
            "it is below, and no edge that leads to it has to go through"
        );
        vertices[17] = [middle[0], middle[1], middle[2] + 0.01];
        assert!(soft.piercing(&vertices) > 0);
        assert!(soft.edges.iter().all(|edge| edge.held), "constraints hold the edges of the cloth");
        soft.held = Some(1.09);
        assert!(soft.is_whole());
        soft.held = Some(1.11);
        assert!(!soft.is_whole());
    }
}
