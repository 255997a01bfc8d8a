//! Joints that go where another one is: a knee that slides as it bends, a kneecap.

use physics::Model;
use physics::model::EqType;

/// A joint that an equality of the model holds at a polynomial of another one.
#[derive(Clone, Copy, Debug)]
pub struct Coupling {
    /// Places in `qpos` of the joint that follows, and of the one that leads.
    pub places: [usize; 2],
    /// Their places in `qvel`.
    pub dofs: [usize; 2],
    /// Where the model has both \[rad, m\].
    zero: [f64; 2],
    polynomial: [f64; 5],
}

impl Coupling {
    /// The couplings of a model that hold from the start.
    pub fn all(m: &Model) -> Vec<Self> {
        let holds = |&eq: &usize| m.eq_type[eq] == EqType::Joint as i32 && m.eq_active0[eq];
        let of = |eq: usize| {
            // Without a second joint the first one stays where it is.
            if m.eq_obj2id[eq] < 0 {
                return None;
            }
            let joints = [m.eq_obj1id[eq], m.eq_obj2id[eq]].map(|joint| joint as usize);
            let places = joints.map(|joint| m.jnt_qposadr[joint] as usize);
            let dofs = joints.map(|joint| m.jnt_dofadr[joint] as usize);
            let polynomial = std::array::from_fn(|i| m.eq_data[eq][i]);
            Some(Coupling { places, dofs, zero: places.map(|place| m.qpos0[place]), polynomial })
        };
        (0..m.neq).filter(holds).filter_map(of).collect()
    }

    /// Where the joint that follows is to be \[rad, m\].
    pub fn position(&self, qpos: &[f64]) -> f64 {
        let lead = qpos[self.places[1]] - self.zero[1];
        self.zero[0] + self.polynomial.iter().rfold(0.0, |sum, factor| sum * lead + factor)
    }

    /// How far it goes for each unit of the one that leads.
    pub fn slope(&self, qpos: &[f64]) -> f64 {
        let lead = qpos[self.places[1]] - self.zero[1];
        (1..5).rev().fold(0.0, |sum, i| sum * lead + i as f64 * self.polynomial[i])
    }
}

/// Puts every joint that follows another one where it is to be.
pub fn follow(couplings: &[Coupling], qpos: &mut [f64]) {
    for coupling in couplings {
        qpos[coupling.places[0]] = coupling.position(qpos);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_joint_follows_another_by_its_polynomial() {
        let text = "<mujoco><worldbody><body><joint name='a'/><geom size='1'/><body><joint name='b' type='slide' ref='0.5'/>\
                    <geom size='1'/></body></body></worldbody><equality><joint joint1='b' joint2='a' polycoef='0.1 2 3 4 5'/>\
                    <joint joint1='a'/></equality></mujoco>";
        let model = mjcf::load_str(text).unwrap().model;
        let couplings = Coupling::all(&model);
        let mut qpos = [0.3, 7.0];
        follow(&couplings, &mut qpos);
        let expected = 0.5 + 0.1 + 2.0 * 0.3 + 3.0 * 0.09 + 4.0 * 0.027 + 5.0 * 0.0081;
        assert!(couplings.len() == 1 && qpos[0] == 0.3 && (qpos[1] - expected).abs() < 1e-12, "{qpos:?}");
        let [low, high] = [-1e-5, 1e-5].map(|off| couplings[0].position(&[0.3 + off, 0.0]));
        assert!((couplings[0].slope(&qpos) - (high - low) / 2e-5).abs() < 1e-6);
    }
}
