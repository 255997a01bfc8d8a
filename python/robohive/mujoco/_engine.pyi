"""Types of `_engine.py`, the part of the extension module that the stand-in calls.

Printed by `python/compare/stubs.py` from the engine's tables of fields.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

_F64 = NDArray[np.float64]
_F32 = NDArray[np.float32]
_I32 = NDArray[np.int32]
_I64 = NDArray[np.int64]
_U8 = NDArray[np.uint8]
_Bool = NDArray[np.bool_]
_Vec3 = tuple[float, float, float] | list[float]
_Filter = tuple[list[bool] | None, bool, int]

class FatalError(Exception): ...
class UnexpectedError(Exception): ...

class CompiledModel:
    @staticmethod
    def from_bytes(bytes: bytes) -> CompiledModel: ...

class Description:
    folder: str
    def __new__(cls) -> Self: ...
    @staticmethod
    def of_path(path: str, assets: Mapping[str, bytes]) -> tuple[Description, list[str]]: ...
    @staticmethod
    def of_text(text: str, assets: Mapping[str, bytes]) -> tuple[Description, list[str]]: ...
    def elements(self) -> dict[str, list[Any]]: ...
    def settings(self) -> dict[str, dict[str, Any]]: ...
    def classes(self) -> list[tuple[str, dict[str, dict[str, Any]]]]: ...
    def options(self) -> dict[str, dict[str, list[float]]]: ...
    def given(self) -> tuple[set[tuple[str, str]], int, int, int]: ...
    def compile(
        self, tree: Any, assets: Mapping[str, bytes], pixels: Sequence[int]
    ) -> tuple[CompiledModel, list[str]]: ...
    def write(self, tree: Any, model: CompiledModel) -> str: ...
    @staticmethod
    def settle(
        tree: Any, child: Any, given: Sequence[tuple[set[tuple[str, str]], int, int, int]]
    ) -> tuple[dict[str, dict[str, list[float]]], dict[str, Any], list[str]]: ...
    @staticmethod
    def spread(tree: Any) -> list[list[list[tuple[int, int, list[float]]]]]: ...

def spec_forms() -> dict[str, list[tuple[str, str, str, int | None, Any]]]: ...
def actuator_shortcut(values: dict[str, Any], tag: str, attributes: list[tuple[str, str]]) -> dict[str, Any]: ...
def orientation(degree: bool, sequence: list[int], alt: dict[str, Any]) -> list[float]: ...

class Painter:
    def __new__(cls, width: int, height: int) -> Self: ...
    def look(self, m: Model, d: Data, look: Mapping[str, Any]) -> None: ...
    def draw(self, channel: str, effects: Sequence[bool]) -> NDArray[Any]: ...
    def draw_all(
        self, size: tuple[int, int], guests: Sequence[Mapping[str, Any]], effects: Sequence[bool]
    ) -> tuple[NDArray[np.uint8], NDArray[np.float32], NDArray[np.int32]]: ...
    def items(self) -> tuple[dict[str, Any], dict[str, Any]]: ...

def letter_rows(text: str) -> list[Sequence[int]]: ...
def load_path(path: str, assets: Mapping[str, bytes]) -> tuple[CompiledModel, list[str]]: ...
def load_text(text: str, assets: Mapping[str, bytes]) -> tuple[CompiledModel, list[str]]: ...
def dependencies(path: str) -> list[str]: ...
def schema() -> str: ...
def model_fields() -> tuple[list[str], list[str]]: ...
def data_fields() -> tuple[list[str], list[str]]: ...
def default_settings(group: str) -> dict[str, Any]: ...
def set_resets(resets: bool) -> bool: ...
def resets() -> bool: ...
def set_called(called: bool) -> None: ...
def mj_step(m: Model, d: Data, nstep: int = 1) -> None: ...
def mj_step1(m: Model, d: Data) -> None: ...
def mj_step2(m: Model, d: Data) -> None: ...
def mj_forward(m: Model, d: Data) -> None: ...
def mj_forwardSkip(m: Model, d: Data, skipstage: int, skipsensor: int) -> None: ...
def mj_inverse(m: Model, d: Data) -> None: ...
def mj_resetData(m: Model, d: Data) -> None: ...
def mj_resetDataKeyframe(m: Model, d: Data, key: int) -> None: ...
def stage(m: Model, d: Data, name: str) -> None: ...
def actuator_rates(m: Model, d: Data) -> tuple[list[int], list[int], list[int]]: ...
def actuator_forces(m: Model, d: Data, gain: list[float], bias: list[float]) -> None: ...
def collide_known(
    m: Model, d: Data, alone: bool, known: Mapping[tuple[int, int], bool]
) -> list[tuple[int, int]]: ...
def inverse_skip(m: Model, d: Data, skipstage: int, sensors: bool) -> None: ...
def forces_at(m: Model, d: Data, residual: list[float]) -> None: ...
def newton_euler(m: Model, d: Data, with_acceleration: bool) -> _F64: ...
def roll_out(models: Sequence[Model], datas: Sequence[Data], plan: Mapping[str, Any]) -> tuple[_F64, _F64]: ...
def contacts(d: Data) -> dict[str, NDArray[Any]]: ...
def constraints(d: Data) -> dict[str, NDArray[Any]]: ...
def dense_jacobian(d: Data, nv: int) -> _F64: ...
def make_rows(m: Model, d: Data, sizes: tuple[int, int, int]) -> None: ...
def set_contacts(m: Model, d: Data, fields: Mapping[str, list[float]]) -> None: ...
def make_islands(m: Model, d: Data, sizes: tuple[int, int]) -> None: ...
def solver(d: Data) -> dict[str, list[float]]: ...
def state_size(m: Model, signature: int) -> int: ...
def get_state(m: Model, d: Data, signature: int) -> _F64: ...
def set_state(m: Model, d: Data, values: _F64, signature: int) -> None: ...
def full_matrix(m: Model, d: Data) -> _F64: ...
def mul_inertia(m: Model, d: Data, v: _F64) -> _F64: ...
def solve_inertia(m: Model, d: Data, x: _F64) -> _F64: ...
def moved(m: Model, qpos: _F64, qvel: _F64, dt: float) -> _F64: ...
def difference(m: Model, from_: _F64, to: _F64, dt: float) -> _F64: ...
def step_slopes(m: Model, d: Data, eps: float, centred: bool) -> list[_F64]: ...
def inverse_slopes(m: Model, d: Data, eps: float) -> list[_F64]: ...
def jacobian(m: Model, d: Data, what: str, id: int, point: ArrayLike) -> tuple[_F64, _F64]: ...
def joint_forces(m: Model, d: Data, wrench: Sequence[ArrayLike], point: ArrayLike, body: int) -> _F64: ...
def axis_rates(m: Model, d: Data) -> _F64: ...
def cast_ray(
    m: Model, d: Data, origin: ArrayLike, direction: ArrayLike, what: _Filter
) -> tuple[int, float, list[float]]: ...
def cast_rays(
    m: Model, d: Data, origin: ArrayLike, directions: _F64, what: _Filter, cutoff: float
) -> list[tuple[int, float, list[float]]]: ...
def cast_at_geom(
    m: Model, d: Data, geom: int, origin: ArrayLike, direction: ArrayLike
) -> tuple[float, list[float]]: ...
def cast_at_shape(
    shape: tuple[int, ArrayLike], pose: tuple[ArrayLike, ArrayLike], origin: ArrayLike, direction: ArrayLike
) -> tuple[float, list[float]]: ...
def geom_distance(
    m: Model, d: Data, geoms: Sequence[int], limit: float
) -> tuple[float, list[list[float]]]: ...
def object_motion(m: Model, d: Data, object: tuple[int, int], acceleration: bool, local: bool) -> list[float]: ...
def muscle_forces(
    length: float, velocity: float, lengthrange: ArrayLike, acc0: float, parameters: ArrayLike
) -> tuple[float, float]: ...
def muscle_rate(ctrl: float, act: float, parameters: ArrayLike) -> float: ...
def contact_force(m: Model, d: Data, id: int) -> list[float]: ...
def recall(m: Model, d: Data, of: tuple[bool, int], time: float, interp: int) -> list[float] | None: ...
def multiply(a: ArrayLike, b: ArrayLike) -> list[float]: ...
def multiply_axis(q: ArrayLike, axis: ArrayLike) -> list[float]: ...
def conjugate(q: ArrayLike) -> list[float]: ...
def rotate(v: ArrayLike, q: ArrayLike) -> list[float]: ...
def normalise(q: ArrayLike) -> list[float]: ...
def matrix(q: ArrayLike) -> list[float]: ...
def of_axis_angle(axis: ArrayLike, angle: float) -> list[float]: ...
def velocity(q: ArrayLike, dt: float) -> list[float]: ...
def subtract(a: ArrayLike, b: ArrayLike) -> list[float]: ...
def integrate(q: ArrayLike, w: ArrayLike, dt: float) -> list[float]: ...
def eigen(matrix: ArrayLike) -> tuple[list[float], list[float]]: ...

class Model:
    def __new__(cls, compiled: CompiledModel) -> Self: ...
    def _compiled(self) -> CompiledModel: ...
    def _to_bytes(self) -> bytes: ...
    def _array(self, name: str) -> NDArray[Any]: ...
    def _copied(self, name: str) -> NDArray[Any]: ...
    def _describe(self) -> dict[str, tuple[str, list[int]]]: ...
    def _size_table(self) -> dict[str, int]: ...
    def _bytes(self, name: str) -> bytes: ...
    def _setting(self, group: str, name: str) -> float: ...
    def _set_setting(self, group: str, name: str, value: float) -> None: ...
    def _id(self, kind: int, name: str) -> int: ...
    def _name(self, kind: int, id: int) -> str: ...
    def _set_const(self) -> None: ...
    qpos0: _F64
    qpos_spring: _F64
    body_parentid: _I32
    body_rootid: _I32
    body_weldid: _I32
    body_mocapid: _I32
    body_jntnum: _I32
    body_jntadr: _I32
    body_dofnum: _I32
    body_dofadr: _I32
    body_treeid: _I32
    body_geomnum: _I32
    body_geomadr: _I32
    body_simple: _U8
    body_sameframe: _U8
    body_pos: _F64
    body_quat: _F64
    body_ipos: _F64
    body_iquat: _F64
    body_mass: _F64
    body_subtreemass: _F64
    body_inertia: _F64
    body_invweight0: _F64
    body_gravcomp: _F64
    body_margin: _F64
    body_user: _F64
    body_plugin: _I32
    body_contype: _I32
    body_conaffinity: _I32
    body_bvhadr: _I32
    body_bvhnum: _I32
    bvh_depth: _I32
    bvh_child: _I32
    bvh_nodeid: _I32
    bvh_aabb: _F64
    oct_depth: _I32
    oct_child: _I32
    oct_aabb: _F64
    oct_coeff: _F64
    jnt_type: _I32
    jnt_qposadr: _I32
    jnt_dofadr: _I32
    jnt_bodyid: _I32
    jnt_actuatorid: _I32
    jnt_group: _I32
    jnt_limited: _Bool
    jnt_actfrclimited: _Bool
    jnt_actgravcomp: _Bool
    jnt_solref: _F64
    jnt_solimp: _F64
    jnt_pos: _F64
    jnt_axis: _F64
    jnt_stiffness: _F64
    jnt_stiffnesspoly: _F64
    jnt_range: _F64
    jnt_actfrcrange: _F64
    jnt_margin: _F64
    jnt_user: _F64
    dof_bodyid: _I32
    dof_jntid: _I32
    dof_parentid: _I32
    dof_treeid: _I32
    dof_Madr: _I32
    dof_simplenum: _I32
    dof_solref: _F64
    dof_solimp: _F64
    dof_frictionloss: _F64
    dof_armature: _F64
    dof_damping: _F64
    dof_dampingpoly: _F64
    dof_invweight0: _F64
    dof_M0: _F64
    dof_length: _F64
    tree_bodyadr: _I32
    tree_bodynum: _I32
    tree_dofadr: _I32
    tree_dofnum: _I32
    tree_sleep_policy: _I32
    geom_type: _I32
    geom_contype: _I32
    geom_conaffinity: _I32
    geom_condim: _I32
    geom_bodyid: _I32
    geom_dataid: _I32
    geom_matid: _I32
    geom_group: _I32
    geom_priority: _I32
    geom_plugin: _I32
    geom_sameframe: _U8
    geom_solmix: _F64
    geom_solref: _F64
    geom_solimp: _F64
    geom_size: _F64
    geom_aabb: _F64
    geom_rbound: _F64
    geom_pos: _F64
    geom_quat: _F64
    geom_friction: _F64
    geom_margin: _F64
    geom_gap: _F64
    geom_surfacevel: _F64
    geom_adhesion: _F64
    geom_fluid: _F64
    geom_user: _F64
    geom_rgba: _F32
    site_type: _I32
    site_bodyid: _I32
    site_matid: _I32
    site_group: _I32
    site_sameframe: _U8
    site_size: _F64
    site_pos: _F64
    site_quat: _F64
    site_user: _F64
    site_rgba: _F32
    cam_mode: _I32
    cam_bodyid: _I32
    cam_targetbodyid: _I32
    cam_pos: _F64
    cam_quat: _F64
    cam_poscom0: _F64
    cam_pos0: _F64
    cam_mat0: _F64
    cam_projection: _I32
    cam_fovy: _F64
    cam_ipd: _F64
    cam_resolution: _I32
    cam_output: _I32
    cam_sensorsize: _F32
    cam_intrinsic: _F32
    cam_user: _F64
    light_mode: _I32
    light_bodyid: _I32
    light_targetbodyid: _I32
    light_type: _I32
    light_texid: _I32
    light_castshadow: _Bool
    light_bulbradius: _F32
    light_intensity: _F32
    light_range: _F32
    light_active: _Bool
    light_pos: _F64
    light_dir: _F64
    light_poscom0: _F64
    light_pos0: _F64
    light_dir0: _F64
    light_attenuation: _F32
    light_cutoff: _F32
    light_softness: _F32
    light_exponent: _F32
    light_ambient: _F32
    light_diffuse: _F32
    light_specular: _F32
    mesh_vertadr: _I32
    mesh_vertnum: _I32
    mesh_faceadr: _I32
    mesh_facenum: _I32
    mesh_bvhadr: _I32
    mesh_bvhnum: _I32
    mesh_octadr: _I32
    mesh_octnum: _I32
    mesh_normaladr: _I32
    mesh_normalnum: _I32
    mesh_texcoordadr: _I32
    mesh_texcoordnum: _I32
    mesh_graphadr: _I32
    mesh_extrema: _I32
    mesh_vert: _F32
    mesh_normal: _F32
    mesh_texcoord: _F32
    mesh_face: _I32
    mesh_facenormal: _I32
    mesh_facetexcoord: _I32
    mesh_graph: _I32
    mesh_scale: _F64
    mesh_pos: _F64
    mesh_quat: _F64
    mesh_pathadr: _I32
    mesh_polynum: _I32
    mesh_polyadr: _I32
    mesh_polynormal: _F64
    mesh_polyvertadr: _I32
    mesh_polyvertnum: _I32
    mesh_polyvert: _I32
    mesh_polymapadr: _I32
    mesh_polymapnum: _I32
    mesh_polymap: _I32
    hfield_size: _F64
    hfield_nrow: _I32
    hfield_ncol: _I32
    hfield_adr: _I32
    hfield_data: _F32
    hfield_pathadr: _I32
    tex_type: _I32
    tex_colorspace: _I32
    tex_height: _I32
    tex_width: _I32
    tex_nchannel: _I32
    tex_adr: _I64
    tex_data: _U8
    tex_pathadr: _I32
    mat_texid: _I32
    mat_texuniform: _Bool
    mat_texrepeat: _F32
    mat_emission: _F32
    mat_specular: _F32
    mat_shininess: _F32
    mat_reflectance: _F32
    mat_metallic: _F32
    mat_roughness: _F32
    mat_rgba: _F32
    pair_dim: _I32
    pair_geom1: _I32
    pair_geom2: _I32
    pair_signature: _I32
    pair_solref: _F64
    pair_solreffriction: _F64
    pair_solimp: _F64
    pair_margin: _F64
    pair_gap: _F64
    pair_adhesion: _F64
    pair_friction: _F64
    exclude_signature: _I32
    eq_type: _I32
    eq_obj1id: _I32
    eq_obj2id: _I32
    eq_objtype: _I32
    eq_active0: _Bool
    eq_solref: _F64
    eq_solimp: _F64
    eq_data: _F64
    tendon_adr: _I32
    tendon_num: _I32
    tendon_matid: _I32
    tendon_actuatorid: _I32
    tendon_group: _I32
    tendon_treenum: _I32
    tendon_treeid: _I32
    ten_J_rownnz: _I32
    ten_J_rowadr: _I32
    ten_J_colind: _I32
    tendon_limited: _Bool
    tendon_actfrclimited: _Bool
    tendon_width: _F64
    tendon_solref_lim: _F64
    tendon_solimp_lim: _F64
    tendon_solref_fri: _F64
    tendon_solimp_fri: _F64
    tendon_range: _F64
    tendon_actfrcrange: _F64
    tendon_margin: _F64
    tendon_stiffness: _F64
    tendon_stiffnesspoly: _F64
    tendon_damping: _F64
    tendon_dampingpoly: _F64
    tendon_armature: _F64
    tendon_frictionloss: _F64
    tendon_lengthspring: _F64
    tendon_length0: _F64
    tendon_invweight0: _F64
    tendon_user: _F64
    tendon_rgba: _F32
    wrap_type: _I32
    wrap_objid: _I32
    wrap_prm: _F64
    actuator_trntype: _I32
    actuator_dyntype: _I32
    actuator_gaintype: _I32
    actuator_biastype: _I32
    actuator_ctrladr: _I32
    actuator_ctrlnum: _I32
    actuator_ctrlspec: _I32
    actuator_outadr: _I32
    actuator_outnum: _I32
    actuator_actadr: _I32
    actuator_actnum: _I32
    actuator_trnid: _I32
    actuator_cranklength: _F64
    actuator_dynprm: _F64
    actuator_gainprm: _F64
    actuator_biasprm: _F64
    actuator_actlimited: _Bool
    actuator_actrange: _F64
    actuator_actearly: _Bool
    actuator_history: _I32
    actuator_historyadr: _I32
    actuator_delay: _F64
    actuator_damping: _F64
    actuator_dampingpoly: _F64
    actuator_armature: _F64
    actuator_group: _I32
    actuator_user: _F64
    actuator_plugin: _I32
    actuator_forcelimited: _Bool
    actuator_forcerange: _F64
    actuator_ctrllimited: _Bool
    actuator_ctrlrange: _F64
    actuator_gear: _F64
    actuator_acc0: _F64
    actuator_length0: _F64
    actuator_lengthrange: _F64
    sensor_type: _I32
    sensor_datatype: _I32
    sensor_needstage: _I32
    sensor_objtype: _I32
    sensor_objid: _I32
    sensor_reftype: _I32
    sensor_refid: _I32
    sensor_intprm: _I32
    sensor_dim: _I32
    sensor_adr: _I32
    sensor_cutoff: _F64
    sensor_noise: _F64
    sensor_history: _I32
    sensor_historyadr: _I32
    sensor_delay: _F64
    sensor_interval: _F64
    sensor_user: _F64
    sensor_plugin: _I32
    plugin: _I32
    plugin_stateadr: _I32
    plugin_statenum: _I32
    plugin_attr: NDArray[np.int8]
    plugin_attradr: _I32
    numeric_adr: _I32
    numeric_size: _I32
    numeric_data: _F64
    text_adr: _I32
    text_size: _I32
    text_data: bytes
    tuple_adr: _I32
    tuple_size: _I32
    tuple_objtype: _I32
    tuple_objid: _I32
    tuple_objprm: _F64
    key_time: _F64
    key_qpos: _F64
    key_qvel: _F64
    key_act: _F64
    key_mpos: _F64
    key_mquat: _F64
    key_ctrl: _F64
    name_bodyadr: _I32
    name_jntadr: _I32
    name_geomadr: _I32
    name_siteadr: _I32
    name_camadr: _I32
    name_lightadr: _I32
    name_meshadr: _I32
    name_hfieldadr: _I32
    name_texadr: _I32
    name_matadr: _I32
    name_pairadr: _I32
    name_excludeadr: _I32
    name_eqadr: _I32
    name_tendonadr: _I32
    name_actuatoradr: _I32
    name_sensoradr: _I32
    name_numericadr: _I32
    name_textadr: _I32
    name_tupleadr: _I32
    name_keyadr: _I32
    name_pluginadr: _I32
    names: bytes
    names_map: _I32
    paths: bytes
    B_rownnz: _I32
    B_rowadr: _I32
    B_colind: _I32
    M_rownnz: _I32
    M_rowadr: _I32
    M_colind: _I32
    mapM2M: _I32
    D_rownnz: _I32
    D_rowadr: _I32
    D_diag: _I32
    D_colind: _I32
    mapM2D: _I32
    mapD2M: _I32
    nq: int
    nv: int
    nu: int
    nactuator: int
    nout: int
    na: int
    nbody: int
    nbvh: int
    nbvhstatic: int
    nbvhdynamic: int
    noct: int
    njnt: int
    ntree: int
    nM: int
    nB: int
    nC: int
    nD: int
    ngeom: int
    nsite: int
    ncam: int
    nlight: int
    nmesh: int
    nmeshvert: int
    nmeshnormal: int
    nmeshtexcoord: int
    nmeshface: int
    nmeshgraph: int
    nmeshpoly: int
    nmeshpolyvert: int
    nmeshpolymap: int
    nhfield: int
    nhfielddata: int
    ntex: int
    ntexdata: int
    nmat: int
    npair: int
    nexclude: int
    neq: int
    ntendon: int
    nJten: int
    nwrap: int
    nsensor: int
    nnumeric: int
    nnumericdata: int
    ntext: int
    ntextdata: int
    ntuple: int
    ntupledata: int
    nkey: int
    nmocap: int
    nplugin: int
    npluginattr: int
    nuser_body: int
    nuser_jnt: int
    nuser_geom: int
    nuser_site: int
    nuser_cam: int
    nuser_tendon: int
    nuser_actuator: int
    nuser_sensor: int
    nnames: int
    npaths: int
    nnames_map: int
    nJmom: int
    ngravcomp: int
    nemax: int
    njmax: int
    nconmax: int
    npolygonmax: int
    nmeshdegmax: int
    nuserdata: int
    nsensordata: int
    npluginstate: int
    nhistory: int
    narena: int
    nbuffer: int
    flex_activelayers: _I32
    flex_bending: _F64
    flex_bendingadr: _I32
    flex_bvhadr: _I32
    flex_bvhnum: _I32
    flex_cellnum: _I32
    flex_centered: _Bool
    flex_conaffinity: _I32
    flex_condim: _I32
    flex_contype: _I32
    flex_damping: _F64
    flex_dim: _I32
    flex_edge: _I32
    flex_edgeadr: _I32
    flex_edgedamping: _F64
    flex_edgeequality: _I32
    flex_edgeflap: _I32
    flex_edgenum: _I32
    flex_edgestiffness: _F64
    flex_elem: _I32
    flex_elemadr: _I32
    flex_elemdataadr: _I32
    flex_elemedge: _I32
    flex_elemedgeadr: _I32
    flex_elemlayer: _I32
    flex_elemnum: _I32
    flex_elemtexcoord: _I32
    flex_evpair: _I32
    flex_evpairadr: _I32
    flex_evpairnum: _I32
    flex_flatskin: _Bool
    flex_friction: _F64
    flex_gap: _F64
    flex_group: _I32
    flex_internal: _Bool
    flex_interp: _I32
    flex_margin: _F64
    flex_matid: _I32
    flex_node: _F64
    flex_node0: _F64
    flex_nodeadr: _I32
    flex_nodebodyid: _I32
    flex_nodenum: _I32
    flex_passive: _I32
    flex_priority: _I32
    flex_radius: _F64
    flex_rgba: _F32
    flex_rigid: _Bool
    flex_selfcollide: _I32
    flex_shell: _I32
    flex_shelldataadr: _I32
    flex_shellnum: _I32
    flex_size: _F64
    flex_solimp: _F64
    flex_solmix: _F64
    flex_solref: _F64
    flex_stiffness: _F64
    flex_stiffnessadr: _I32
    flex_texcoord: _F32
    flex_texcoordadr: _I32
    flex_vert: _F64
    flex_vert0: _F64
    flex_vertadr: _I32
    flex_vertbodyid: _I32
    flex_vertedge: _I32
    flex_vertedgeadr: _I32
    flex_vertedgenum: _I32
    flex_vertmetric: _F64
    flex_vertnum: _I32
    flexedge_J_colind: _I32
    flexedge_J_rowadr: _I32
    flexedge_J_rownnz: _I32
    flexedge_invweight0: _F64
    flexedge_length0: _F64
    flexedge_rigid: _Bool
    flexvert_J_colind: _I32
    flexvert_J_rowadr: _I32
    flexvert_J_rownnz: _I32
    nJfe: int
    nJfv: int
    name_flexadr: _I32
    name_skinadr: _I32
    nefm0L: int
    nefm0dof: int
    nflex: int
    nflexbending: int
    nflexedge: int
    nflexelem: int
    nflexelemdata: int
    nflexelemedge: int
    nflexevpair: int
    nflexnode: int
    nflexshelldata: int
    nflexstiffness: int
    nflextexcoord: int
    nflexvert: int
    nskin: int
    nskinbone: int
    nskinbonevert: int
    nskinface: int
    nskintexvert: int
    nskinvert: int
    skin_boneadr: _I32
    skin_bonebindpos: _F32
    skin_bonebindquat: _F32
    skin_bonebodyid: _I32
    skin_bonenum: _I32
    skin_bonevertadr: _I32
    skin_bonevertid: _I32
    skin_bonevertnum: _I32
    skin_bonevertweight: _F32
    skin_face: _I32
    skin_faceadr: _I32
    skin_facenum: _I32
    skin_group: _I32
    skin_inflate: _F32
    skin_matid: _I32
    skin_pathadr: _I32
    skin_rgba: _F32
    skin_texcoord: _F32
    skin_texcoordadr: _I32
    skin_vert: _F32
    skin_vertadr: _I32
    skin_vertnum: _I32

class Data:
    def __new__(cls, model: Model) -> Self: ...
    @property
    def _model(self) -> Any: ...
    def _array(self, name: str) -> NDArray[Any]: ...
    def _describe(self) -> dict[str, tuple[str, list[int]]]: ...
    def _carry(self, other: Data) -> None: ...
    def _assign(self, other: Data) -> None: ...
    def _counts(self) -> dict[str, int]: ...
    def _timers(self) -> tuple[_F64, _I32]: ...
    def _dump(self) -> dict[str, _F64]: ...
    def _restore(self, arrays: Mapping[str, _F64]) -> None: ...
    time: float
    @property
    def ncon(self) -> int: ...
    qpos: _F64
    qvel: _F64
    act: _F64
    history: _F64
    qacc_warmstart: _F64
    ctrl: _F64
    qfrc_applied: _F64
    xfrc_applied: _F64
    eq_active: _Bool
    mocap_pos: _F64
    mocap_quat: _F64
    userdata: _F64
    plugin_state: _F64
    xpos: _F64
    xquat: _F64
    xmat: _F64
    xipos: _F64
    ximat: _F64
    xanchor: _F64
    xaxis: _F64
    geom_xpos: _F64
    geom_xmat: _F64
    site_xpos: _F64
    site_xmat: _F64
    cam_xpos: _F64
    cam_xmat: _F64
    light_xpos: _F64
    light_xdir: _F64
    subtree_com: _F64
    cdof: _F64
    cinert: _F64
    ten_wrapadr: _I32
    ten_wrapnum: _I32
    ten_J: _F64
    ten_length: _F64
    wrap_obj: _I32
    wrap_xpos: _F64
    actuator_length: _F64
    moment_rownnz: _I32
    moment_rowadr: _I32
    moment_colind: _I32
    actuator_moment: _F64
    crb: _F64
    M: _F64
    qLD: _F64
    qLDiagInv: _F64
    ten_velocity: _F64
    actuator_velocity: _F64
    cvel: _F64
    cdof_dot: _F64
    qfrc_bias: _F64
    qfrc_spring: _F64
    qfrc_damper: _F64
    qfrc_gravcomp: _F64
    qfrc_fluid: _F64
    qfrc_adhesion: _F64
    qfrc_passive: _F64
    act_dot: _F64
    actuator_force: _F64
    qfrc_actuator: _F64
    qfrc_smooth: _F64
    qacc_smooth: _F64
    qfrc_constraint: _F64
    qacc: _F64
    sensordata: _F64
    subtree_linvel: _F64
    subtree_angmom: _F64
    cacc: _F64
    cfrc_int: _F64
    cfrc_ext: _F64
    qH: _F64
    qHDiagInv: _F64
    qDeriv: _F64
    qLU: _F64
    qfrc_inverse: _F64
    energy: _F64
    solver_fwdinv: _F64
    efc_type: _I32
    efc_id: _I32
    efc_J_rownnz: _I32
    efc_J_rowadr: _I32
    efc_J_colind: _I32
    efc_J: _F64
    efc_pos: _F64
    efc_margin: _F64
    efc_frictionloss: _F64
    efc_diagA: _F64
    efc_KBIP: _F64
    efc_D: _F64
    efc_R: _F64
    tendon_efcadr: _I32
    efc_vel: _F64
    efc_aref: _F64
    efc_b: _F64
    efc_state: _I32
    efc_force: _F64
    ne: int
    nf: int
    nl: int
    nefc: int
    tree_island: _I32
    island_ntree: _I32
    island_itreeadr: _I32
    map_itree2tree: _I32
    dof_island: _I32
    island_nv: _I32
    island_idofadr: _I32
    island_dofadr: _I32
    map_dof2idof: _I32
    map_idof2dof: _I32
    efc_island: _I32
    island_ne: _I32
    island_nf: _I32
    island_nefc: _I32
    island_iefcadr: _I32
    map_efc2iefc: _I32
    map_iefc2efc: _I32
    nisland: int
    nidof: int
    nJ: int
    solver_niter: _I32
    solver_nnz: _I32
