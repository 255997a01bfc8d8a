//! What depends on accelerations: forces of contacts and between bodies once the constraints are solved.

pub mod contact_force;
pub mod rne_post;
