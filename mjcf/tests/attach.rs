//! Attached models: what goes wrong is said with its place, and settings in conflict are settled as asked.

use physics::model::Disable;
use robohive_mjcf::files::Memory;
use robohive_mjcf::{Loaded, Loader};

const CHILD: &str = r#"
<mujoco model="child">
  <option timestep=".004" gravity="0 0 -3" iterations="7"><flag damper="disable"/></option>
  <default><default class="thick"><geom size=".3"/></default></default>
  <worldbody>
    <frame name="inner"><body name="part"><joint name="turn"/><geom name="ball" size=".1"/></body></frame>
    <body name="rest"><geom size=".2"/></body>
  </worldbody>
  <sensor><jointpos name="angle" joint="turn"/></sensor>
</mujoco>"#;

fn load(child: &str, settings: &str, body: &str) -> Result<Loaded, String> {
    let parent = format!(
        "<mujoco model='parent'>{settings}<asset><model name='m' file='child.xml'/></asset>\n\
         <worldbody>{body}</worldbody></mujoco>"
    );
    let mut files = Memory::default();
    files.insert("parent.xml", parent.as_bytes());
    files.insert("child.xml", child.as_bytes());
    Loader::default().files(files).load("parent.xml").map_err(|errors| errors.to_string())
}

fn refusal(child: &str, settings: &str, body: &str) -> String {
    load(child, settings, body).map(|_| ()).expect_err("the model must be refused")
}

#[test]
fn what_goes_wrong_is_said_with_its_place() {
    let cases = [
        ("<attach model='n' prefix='a_'/>", "parent.xml:2:12: error: no model asset is named 'n'"),
        ("<attach model='m' body='prat' prefix='a_'/>", "no body is named 'prat'"),
        ("<attach model='m' frame='outer' prefix='a_'/>", "no frame is named 'outer'"),
        ("<attach model='m' body='part'/>", "needs the attribute 'prefix'"),
        ("<attach model='m' body='part' frame='inner' prefix=''/>", "takes only one of"),
        ("<attach prefix='a_'/>", "needs the attribute 'body' or 'frame'"),
        ("<body name='b'><geom size='1'/><attach body='b' prefix='a_'/></body>", "no body is named 'b'"),
        ("<frame name='f'><attach frame='f' prefix='a_'/></frame>", "inside itself"),
        (
            "<attach model='m' body='part' prefix='a_'/><attach model='m' body='part' prefix='a_'/>",
            "already: another prefix",
        ),
        ("<geom class='a_thick'/><attach model='m' prefix='a_'/>", "no default class is named 'a_thick'"),
    ];
    for (body, expected) in cases {
        let message = refusal(CHILD, "", body);
        assert!(message.contains(expected), "{body}: {message}");
    }
    let broken = CHILD.replace("<geom size=\".2\"/>", "<geom sise=\".2\"/>");
    assert!(refusal(&broken, "", "").contains("child.xml:7:29: error: unknown attribute 'sise'"));
    let endless = "<mujoco><asset><model file='child.xml'/></asset></mujoco>";
    assert!(refusal(endless, "", "").contains("is an asset of itself"));
    let mut files = Memory::default();
    files.insert("parent.xml", "<mujoco><asset><model file='gone.xml'/></asset></mujoco>".as_bytes());
    let missing = Loader::default().files(files).load("parent.xml").unwrap_err().to_string();
    assert!(missing.contains("parent.xml:1:29: error: cannot read model 'gone.xml'"), "{missing}");
}

#[test]
fn joints_of_an_attached_frame_cannot_come_into_the_world() {
    let child = "<mujoco><worldbody><body><frame name='f'><joint/><geom size='1'/></frame></body></worldbody></mujoco>";
    let message = refusal(child, "", "<attach model='m' frame='f' prefix='a_'/>");
    assert!(message.contains("the world cannot have the joints"), "{message}");
    let model = load(child, "", "<body><attach model='m' frame='f' prefix='a_'/></body>").unwrap().model;
    assert_eq!((model.nbody, model.njnt, model.ngeom), (2, 1, 1));
}

#[test]
fn conflicts_are_settled_as_asked() {
    let attach = "<attach model='m' body='part' prefix='a_'/><geom class='a_thick'/>";
    let option = "<option timestep='.002' iterations='9'/>";
    let kept = load(CHILD, option, attach).unwrap();
    assert_eq!((kept.model.opt.timestep, kept.model.opt.iterations), (0.002, 9));
    assert_eq!((kept.model.opt.gravity[2], kept.model.opt.disableflags), (-9.81, Disable::NONE));
    assert_eq!(kept.warnings.warnings().count(), 3);
    assert_eq!(kept.model.geom_size[0][0], 0.3);
    assert_eq!(kept.model.nsensor, 1);

    let merge = "<compiler conflict='merge'/>";
    let merged = load(CHILD, &format!("{merge}{option}"), attach).unwrap().model.opt.clone();
    assert_eq!((merged.timestep, merged.iterations, merged.gravity[2]), (0.002, 9, -3.0));
    assert_eq!(merged.disableflags, Disable::DAMPER);
    let gravity = "<option gravity='0 0 -1'/>";
    assert!(refusal(CHILD, &format!("{merge}{gravity}"), attach).contains("cannot be merged"));

    let error = "<compiler conflict='error'/>";
    let message = refusal(CHILD, &format!("{error}{gravity}"), attach);
    assert!(message.contains("'gravity' is [0.0, 0.0, -1.0] here and [0.0, 0.0, -3.0]"), "{message}");
    assert!(load(CHILD, error, attach).is_ok());
}
