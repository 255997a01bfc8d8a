//! Values that can be read and mean nothing: each is refused at its place, with what to write instead.

use robohive_mjcf::{Limits, Loader, load_str};

/// What is said about `text`: the first line, the advice below it included.
fn refused(text: &str) -> String {
    let Err(findings) = load_str(text) else { panic!("accepted: {text}") };
    findings.to_string()
}

fn flexcomp(attributes: &str, content: &str) -> String {
    format!(
        "<mujoco>\n<worldbody><body name='b'>\n<flexcomp name='f' type='grid' count='4 4 1' dim='2' {attributes}>\n\
         {content}</flexcomp></body></worldbody></mujoco>"
    )
}

#[test]
fn the_radius_of_a_flex_is_not_negative() {
    let said = refused(&flexcomp("radius='-1'", "<contact selfcollide='sap'/>"));
    assert!(
        said.starts_with("<text>:3:1: error: <flexcomp> 'f': 'radius' is -1: set it to 0 or more"),
        "{said}"
    );
    let flex = "<mujoco><worldbody><body name='a'/></worldbody><deformable>\n\
                <flex name='f' dim='1' body='a' vertex='0 0 0 1 0 0' element='0 1' radius='-.1'/></deformable></mujoco>";
    let said = refused(flex);
    assert!(said.starts_with("<text>:2:1: error: flex 'f': radius is -0.1: set it to 0 or more"), "{said}");
}

/// Its bodies' positions could not be read again from the text that is written.
#[test]
fn points_of_a_flexcomp_are_no_farther_than_a_text_can_say() {
    let said = refused(&flexcomp("spacing='1e100 1e100 1'", ""));
    assert!(
        said.starts_with("<text>:3:1: error: <flexcomp> 'f': a coordinate of a point is")
            && said.contains("at most 5e99 can be: lower 'spacing', 'scale' or 'pos'"),
        "{said}"
    );
}

#[test]
fn a_plugin_of_a_flexcomp_must_be_known_and_fit() {
    let said = refused(&flexcomp("", "<plugin plugin='mujoco.elasticity.shel'/>"));
    assert!(said.contains("<text>:4:1: error: plugin 'mujoco.elasticity.shel' is not declared"), "{said}");
    let said = refused(&flexcomp("", "<plugin instance='none'/>"));
    assert!(
        said.contains("<text>:4:1: error:") && said.contains("there is no plugin instance 'none'"),
        "{said}"
    );
    let declared = "<mujoco><extension><plugin plugin='mujoco.pid'/></extension>";
    let text = flexcomp("", "<plugin plugin='mujoco.pid'/>").replace("<mujoco>", declared);
    let said = refused(&text);
    assert!(said.contains("plugin 'mujoco.pid' makes no passive forces"), "{said}");
}

fn pid(config: &str) -> String {
    format!(
        "<mujoco><extension><plugin plugin='mujoco.pid'><instance name='i'>\n{config}</instance></plugin></extension>\
         <worldbody><body><joint name='j'/><geom size='.1'/></body></worldbody>\
         <actuator><plugin joint='j' plugin='mujoco.pid' instance='i'/></actuator></mujoco>"
    )
}

#[test]
fn attributes_of_plugins_have_values_that_mean_something() {
    let said = refused(&pid("<config key='kp' value=''/>"));
    assert!(said.starts_with("<text>:2:1: error: <config> gives 'kp' no value: write one"), "{said}");
    let said = refused(&pid("<config key='imax' value='-5'/>"));
    assert!(
        said.contains("<text>:1:48: error:") && said.contains("'imax' is negative: set it to 0 or more"),
        "{said}"
    );
    // With a negative integral gain the bound is positive.
    assert!(
        load_str(
            pid("<config key='ki' value='-1'/><config key='imax' value='-5'/>")
                .replace("joint='j' p", "joint='j' actdim='1' p")
        )
        .is_ok()
    );
    let said = refused(&pid("<config key='kp' value='1e300'/>"));
    assert!(said.contains("attribute 'kp' is '1e300': write one number, at most 1e100"), "{said}");
}

#[test]
fn shapes_by_formula_have_sizes_that_make_a_shape() {
    let shape = |kind: &str, key: &str, value: &str| {
        format!(
            "<mujoco><extension><plugin plugin='mujoco.sdf.{kind}'>\n<instance name='i'><config key='{key}' value='{value}'/>\
             </instance></plugin></extension><asset><mesh name='m'><plugin instance='i'/></mesh></asset><worldbody>\
             <body><freejoint/><geom type='sdf' mesh='m'><plugin instance='i'/></geom></body></worldbody></mujoco>"
        )
    };
    for (kind, key, value, reason) in [
        ("bolt", "radius", "0", "'radius' is 0: a positive number is needed"),
        ("nut", "radius", "-1", "'radius' is -1: a positive number is needed"),
        ("bowl", "height", "1e300", "'height' is '1e300': write one number, at most 1e100 in magnitude"),
        ("bowl", "height", "1e30", "'height' is 1e30: the rim lies on the sphere"),
        ("bowl", "radius", "0", "'radius' is 0: a positive number is needed"),
        ("bowl", "thickness", "-1", "'thickness' is -1: a positive number is needed"),
        ("torus", "radius1", "-1", "'radius1' is -1: set it to 0 or more"),
        ("torus", "radius2", "0", "'radius2' is 0: a positive number is needed"),
        ("gear", "teeth", "0", "'teeth' is 0: set it to 1 or more"),
        ("gear", "diameter", "0", "'diameter' is 0: a positive number is needed"),
        ("gear", "thickness", "-1", "'thickness' is -1: a positive number is needed"),
    ] {
        let said = refused(&shape(kind, key, value));
        assert!(said.contains("error:") && said.contains("<text>:") && said.contains(reason), "{said}");
    }
}

#[test]
fn a_urdf_that_simulates_nothing_says_so() {
    let said = refused("<robot name='r'>\n</robot>");
    assert!(said.starts_with("<text>:1:1: error: <robot> has no <link>"), "{said}");
    let loaded = load_str("<robot name='r'>\n<link name='a'/></robot>").unwrap();
    let warned: Vec<_> = loaded.warnings.warnings().map(ToString::to_string).collect();
    assert!(warned.len() == 1 && warned[0].contains("nothing is simulated"), "{warned:?}");
    let ball = "<collision><geometry><sphere radius='1'/></geometry></collision>";
    let loaded = load_str(format!("<robot name='r'><link name='a'>{ball}</link></robot>")).unwrap();
    assert_eq!(loaded.warnings.warnings().count(), 0);
}

/// The vertices of a hundred million would take a gigabyte before they are counted.
#[test]
fn vertices_of_a_composite_are_counted_before_they_are_made() {
    let cable = |count: &str| {
        format!(
            "<mujoco><worldbody>\n<composite type='cable' curve='s' size='1' count='{count} 1 1'>\
             <geom type='capsule' size='.01'/></composite></worldbody></mujoco>"
        )
    };
    let said = refused(&cable("100000000"));
    assert!(said.starts_with("<text>:2:1: error: <composite> makes more than 1000000 elements"), "{said}");
    let limits = Limits::default().with_memory(1 << 20);
    let said = Loader::default().limits(limits).load_str(cable("1000")).unwrap_err().to_string();
    assert!(said.contains("parts of <composite>: needs"), "{said}");
}

/// A number of three hundred digits hides what is wrong with it.
#[test]
fn large_numbers_are_shown_in_powers_of_ten() {
    let in_world = |element: &str| format!("<mujoco><worldbody>{element}</worldbody></mujoco>");
    let tendon = |attribute: &str| {
        let joint = "<worldbody><body><joint name='j'/><geom size='1'/></body></worldbody>";
        format!(
            "<mujoco>{joint}<tendon><fixed {attribute}><joint joint='j' coef='1'/></fixed></tendon></mujoco>"
        )
    };
    for text in [
        in_world("<geom size='-1e90'/>"),
        in_world("<camera fovy='1e90'/>"),
        tendon("limited='true' range='1e90 -1e90'"),
        "<mujoco><option timestep='-1e90'/></mujoco>".into(),
        flexcomp("radius='-1e90'", ""),
        flexcomp("radius='1e90'", ""),
    ] {
        let said = refused(&text);
        assert!(said.contains("e90") && !said.contains("00000"), "{said}");
    }
    let model = load_str(in_world("<body><joint/><geom size='1'/></body>")).unwrap().model;
    let mut data = physics::Data::new(&model);
    data.state.qpos[0] = 1e300;
    let said = physics::step(&model, &mut data).unwrap_err().to_string();
    assert!(said.contains("is 1e300 at time 0 s, which is too large"), "{said}");
}
