//! A model changed by a program: elements added and renamed, numbers set, and the motion carried over.

use robohive::mjcf::{edit, files::Memory, parse_str};
use robohive::physics::model::ObjType;
use robohive::{Data, forward, step};

const ARM: &str = "
<mujoco>
  <worldbody>
    <body name='arm' pos='0 0 1'>
      <joint name='elbow' axis='0 1 0'/>
      <geom name='rod' type='capsule' fromto='0 0 0 .5 0 0' size='.03'/>
    </body>
  </worldbody>
</mujoco>";

/// Edits an arm and carries its motion over.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The elements of the text; compiling them gives a model, as loading it would.
    let parsed = parse_str(ARM)?;
    let mut spec = parsed.spec;
    let model = spec.compile(&Memory::default(), &parsed.sources)?.model;
    let mut data = Data::new(&model);
    (0..100).try_for_each(|_| step(&model, &mut data))?;
    let elbow = model.joint("elbow").ok_or("no elbow")?;
    let fallen = data.joint(elbow).qpos()[0];
    assert!(fallen > 0.1, "the arm falls");

    // The structure changes: a hand, and a motor that names it. The state is carried over by names.
    spec.add(
        "arm",
        "<body name='hand' pos='.5 0 0'><joint name='wrist' axis='0 1 0'/><geom size='.05'/></body>",
    )?;
    spec.extend("<actuator><position name='hold' joint='wrist' kp='5'/></actuator>")?;
    spec.set(ObjType::Geom, "rod", "rgba", "1 0 0 1")?;
    spec.rename(ObjType::Body, "hand", "gripper")?;
    let handed = spec.compile(&Memory::default(), &parsed.sources)?.model;
    let mut data = edit::carry_state(&model, &data, &handed);
    let (elbow, wrist) = (handed.joint("elbow").ok_or("no elbow")?, handed.joint("wrist").ok_or("no wrist")?);
    assert_eq!(data.joint(elbow).qpos(), [fallen]);
    assert_eq!(data.joint(wrist).qpos(), [0.0]);
    assert!(handed.body("gripper").is_some() && handed.body("hand").is_none());

    // A mistake is named, with the way out, and changes nothing.
    let wrong = spec.set(ObjType::Geom, "rod", "rgb", "1 0 0").err().ok_or("no such attribute")?;
    assert!(wrong.to_string().contains("did you mean 'rgba'?"), "{wrong}");

    // Numbers of a compiled model change in place; what follows from them is derived again.
    let mut heavy = handed.clone();
    let arm = heavy.body("arm").ok_or("no arm")?;
    let before = handed.body(arm).subtree_mass();
    heavy.edit(|m| m.body_mass[arm.index()] += 2.0)?;
    assert!((heavy.body(arm).subtree_mass() - before - 2.0).abs() < 1e-12);
    forward(&heavy, &mut data)?;

    // What was made is a text again.
    let text = spec.to_xml()?;
    assert!(text.contains("name=\"gripper\""), "{text}");
    Ok(())
}
