// What `web.mjs` measures, in node and in a browser alike.

/** Width and height of pictures. */
const SIZE = [640, 360];

const timed = (action) => {
  const began = performance.now();
  action();
  return (performance.now() - began) / 1000;
};

/** Opens the models of `texts` in both engines: functions from a model's name and a count to seconds. */
export async function sides({ openText }, loadMujoco, texts) {
  const mujoco = await loadMujoco();
  const [ours, theirs] = [{}, {}];
  for (const [name, text] of Object.entries(texts)) {
    ours[name] = await openText(text);
    mujoco.FS.writeFile(`/${name}.xml`, text);
    const model = mujoco.MjModel.from_xml_path(`/${name}.xml`);
    const data = new mujoco.MjData(model);
    if (model.nkey > 0) mujoco.mj_resetDataKeyframe(model, data, 0);
    theirs[name] = { model, data };
  }
  const framed = (simulation) => {
    simulation.step(5);
    simulation.draw(...SIZE);
  };
  return {
    robohive: (name, steps) => timed(() => ours[name].step(steps)),
    mujoco: (name, steps) => timed(() => {
      const { model, data } = theirs[name];
      for (let k = 0; k < steps; k++) mujoco.mj_step(model, data);
    }),
    frames: (name, count) => timed(() => {
      for (let k = 0; k < count; k++) framed(ours[name]);
    }),
  };
}
