//! Sheets on signed distance geoms.

use robohive_physics::{Data, forward};

#[test]
fn a_sheet_touches_a_field_from_outside() {
    for option in ["", "<flag midphase='disable'/>"] {
        let m = robohive_mjcf::load_str(format!(
            "<mujoco><option>{option}</option><asset><mesh name='ball' builtin='sphere' params='3'/></asset><worldbody>
             <geom name='ball' type='sdf' mesh='ball'/><body name='holder' pos='0 0 .98'>
             <flexcomp name='sheet' type='grid' dim='2' count='7 7 1' spacing='.1 .1 .1' radius='.01' mass='.1'>
             <contact selfcollide='none' internal='false'/></flexcomp></body></worldbody></mujoco>"
        ))
        .unwrap_or_else(|e| panic!("{e}"))
        .model;
        let mut d = Data::new(&m);
        forward(&m, &mut d).unwrap();
        assert!(!d.con.contact.is_empty());
        for contact in &d.con.contact {
            assert_eq!((contact.geom, contact.flex), ([0, -1], [-1, 0]));
            assert!(contact.dist < 0.0 && contact.dist > -0.03, "{}", contact.dist);
            // The normal points from the ball to the sheet.
            let outward: f64 = (0..3).map(|k| contact.frame[k] * contact.pos[k]).sum();
            assert!(outward > 0.9, "{outward}");
        }
    }
}
