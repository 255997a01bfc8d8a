//! The models, with the solvers, cones and integrators that no asset asks for by itself.

use mjcf::Loader;
use mjcf::files::Memory;
use physics::Model;

/// A model and the options set in its text.
pub struct Case {
    /// Name in the table.
    pub name: &'static str,
    file: &'static str,
    options: &'static str,
}

const fn case(name: &'static str, file: &'static str, options: &'static str) -> Case {
    Case { name, file, options }
}

/// All models of the table, in its order.
pub const MODELS: [Case; 14] = [
    case("franka_table", "franka/franka_table.xml", ""),
    case("elbow", "elbow/elbow.xml", ""),
    case("quadruped", "quadruped/quadruped.xml", ""),
    case("humanoid", "humanoid/humanoid.xml", ""),
    case("pile", "pile/pile.xml", ""),
    case("workbench", "workbench/workbench.xml", ""),
    case("yard", "yard/yard.xml", ""),
    case("drape", "drape/drape.xml", ""),
    case("grasp", "grasp/grasp.xml", ""),
    case("franka_table_implicit", "franka/franka_table.xml", r#"integrator="implicit""#),
    case("elbow_rk4", "elbow/elbow.xml", r#"integrator="RK4""#),
    case("quadruped_cg_elliptic", "quadruped/quadruped.xml", r#"solver="CG" cone="elliptic""#),
    case("humanoid_implicitfast", "humanoid/humanoid.xml", r#"integrator="implicitfast" cone="elliptic""#),
    case("pile_pgs_noslip", "pile/pile.xml", r#"solver="PGS" noslip_iterations="3""#),
];

/// A model that shows everything that a picture can.
const GALLERY: (&str, &str) = ("gallery.xml", include_str!("gallery.xml"));

impl Case {
    /// A model as its file has it.
    pub(crate) const fn of(name: &'static str, file: &'static str) -> Case {
        case(name, file, "")
    }

    /// Compiles the model.
    ///
    /// # Errors
    /// What the reader says of it.
    pub fn load(&self) -> Result<Model, String> {
        let loader = Loader::default().substitute("<option ", format!("<option {} ", self.options));
        let (gallery, text) = GALLERY;
        let loader = if self.file == gallery {
            let mut files = Memory::default();
            files.insert(gallery, text.as_bytes());
            loader.files(files)
        } else {
            loader.files(assets::Own)
        };
        loader.load(self.file).map(|loaded| loaded.model).map_err(|e| e.to_string())
    }
}
