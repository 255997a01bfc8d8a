"""Room for contacts, constraint rows and islands that a program fills in itself, as MJX does with what it computed."""

import numpy as np

from robohive.mujoco import _engine as _core
from robohive.mujoco.structs.data import MjData

__all__ = ["_realloc_con_efc", "_realloc_island"]


def _realloc_con_efc(data: MjData, ncon: int, nefc: int, nJ: int = -1) -> None:
    """Makes `ncon` contacts and `nefc` constraint rows, all zero, with `nJ` entries of the Jacobian (as many as now for -1).

    Raises:
        FatalError: they need more memory than a step may take. Then there are none.
    """
    entries = len(_core.constraints(data)["efc_J"]) if nJ < 0 else nJ
    _core.make_rows(data.model, data, (ncon, nefc, entries))
    columns = data.model.nv
    if not data._is_sparse() and entries == nefc * columns:
        rows = _core.constraints(data)
        rows["efc_J_rownnz"][:], rows["efc_J_rowadr"][:] = columns, np.arange(nefc) * columns
        rows["efc_J_colind"][:] = np.tile(np.arange(columns), nefc)


def _realloc_island(data: MjData, nisland: int, nidof: int) -> None:
    """Makes `nisland` islands of `nidof` degrees of freedom in sum, all zero.

    Raises:
        FatalError: the model has fewer trees or degrees of freedom. Then there are none.
    """
    _core.make_islands(data.model, data, (nisland, nidof))
