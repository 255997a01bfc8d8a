"""Fields of features that are refused by name: flexes. Sizes are zero and arrays empty, as in MuJoCo where a model has none
of them. All are read-only."""

from collections.abc import Callable
from typing import Any

import numpy as np

#: Sizes that are always zero.
SIZES = (
    "nflex nflexnode nflexvert nflexedge nflexelem nflexelemdata nflexelemedge nflexshelldata nflexevpair nflextexcoord "
    "nJfe nJfv nflexstiffness nflexbending nefm0dof nefm0L"
).split()

#: Arrays of a model without rows: by type, each with its columns.
_MODEL = {
    "float64": "efm0_L flex_bending flex_damping flex_edgedamping flex_edgestiffness flex_friction:3 flex_gap flex_margin "
    "flex_node:3 flex_node0:3 flex_radius flex_size:3 flex_solimp:5 flex_solmix flex_solref:2 flex_stiffness flex_vert:3 "
    "flex_vert0:3 flex_vertmetric:4 flexedge_invweight0 flexedge_length0",
    "float32": "flex_rgba:4 flex_texcoord:2",
    "int32": "efm0_L_colind efm0_L_rowadr efm0_L_rownnz efm0_dofid flex_activelayers flex_bendingadr flex_bvhadr flex_bvhnum "
    "flex_cellnum:3 flex_conaffinity flex_condim flex_contype flex_dim flex_edge:2 flex_edgeadr flex_edgeequality "
    "flex_edgeflap:2 flex_edgenum flex_elem flex_elemadr flex_elemdataadr flex_elemedge flex_elemedgeadr flex_elemlayer "
    "flex_elemnum flex_elemtexcoord flex_evpair:2 flex_evpairadr flex_evpairnum flex_group flex_interp flex_matid "
    "flex_nodeadr flex_nodebodyid flex_nodenum flex_passive flex_priority flex_selfcollide flex_shell flex_shelldataadr "
    "flex_shellnum flex_stiffnessadr flex_texcoordadr flex_vertadr flex_vertbodyid flex_vertedge:2 flex_vertedgeadr "
    "flex_vertedgenum flex_vertnum flexedge_J_colind flexedge_J_rowadr flexedge_J_rownnz flexvert_J_colind:2 "
    "flexvert_J_rowadr:2 flexvert_J_rownnz:2 name_flexadr",
    "bool": "flex_centered flex_flatskin flex_internal flex_rigid flexedge_rigid",
}

#: Arrays of a simulation without rows.
_DATA = {
    "float64": "bvh_aabb_dyn:6 flexedge_J flexedge_length flexedge_velocity flexelem_aabb:6 flexelem_krot flexvert_J:2 "
    "flexvert_length:2 flexvert_xpos:3",
    "uint64": "plugin_data",
}

#: What depends on the model: no bounding volume is marked.
_MARKS: dict[str, Callable[[Any], Any]] = {"bvh_active": lambda m: np.zeros(m.nbvh, bool)}

#: Copies of what the model has.
_COPIES: dict[str, Callable[[Any], Any]] = {"plugin": lambda m: np.array(m.plugin)}


def _parse(table: dict[str, str]) -> dict[str, tuple[str, tuple[int, ...]]]:
    """Type and columns by name."""
    rows = ((dtype, *entry.partition(":")) for dtype, entries in table.items() for entry in entries.split())
    return {name: (dtype, (int(columns),) if columns else ()) for dtype, name, _, columns in rows}


_MODEL_SHAPES, _DATA_SHAPES = _parse(_MODEL), _parse(_DATA)
MODEL_NAMES = tuple(_MODEL_SHAPES)
DATA_NAMES = (*_DATA_SHAPES, *_MARKS, *_COPIES)


def of_model(name: str, sizes: dict[str, int]) -> Any:
    """The array of a model called `name`, None when it is not among these."""
    return _without_rows(_MODEL_SHAPES, name)


def of_data(name: str, model: Any) -> Any:
    """The array or count of a simulation called `name`, None when it is not among these."""
    if name in _MARKS:
        return _fixed(_MARKS[name](model))
    if name in _COPIES:
        return _fixed(_COPIES[name](model))
    return _without_rows(_DATA_SHAPES, name)


def _without_rows(shapes: dict[str, tuple[str, tuple[int, ...]]], name: str) -> Any:
    if name not in shapes:
        return None
    dtype, columns = shapes[name]
    return _fixed(np.zeros((0, *columns), dtype))


def _fixed(values: Any) -> Any:
    if isinstance(values, np.ndarray):
        values.flags.writeable = False
    return values
