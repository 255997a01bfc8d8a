"""Fields of features that are refused by name: flexes, skins, plugins. Their sizes are zero and their arrays empty, as in a
model of MuJoCo without them."""

import numpy as np
from numpy.typing import NDArray

#: Sizes that are always zero.
SIZES = (
    "nflex nflexnode nflexvert nflexedge nflexelem nflexelemdata nflexelemedge nflexshelldata nflexevpair nflextexcoord "
    "nJfe nJfv nflexstiffness nflexbending nskin nskinvert nskintexvert nskinface nskinbone nskinbonevert nplugin npluginattr npluginstate"
).split()

#: Arrays without rows: type, columns.
_ARRAYS = {
    "float32": "skin_vert:3 skin_texcoord:2 skin_bonebindpos:3 skin_bonebindquat:4 skin_bonevertweight skin_rgba:4 "
    "skin_inflate flex_rgba:4 flex_texcoord:2",
    "int32": "skin_face:3 skin_matid skin_group skin_vertadr skin_vertnum skin_texcoordadr skin_faceadr skin_facenum "
    "skin_boneadr skin_bonenum skin_bonevertadr skin_bonevertnum skin_bonebodyid skin_bonevertid skin_pathadr "
    "plugin plugin_stateadr plugin_statenum plugin_attradr name_pluginadr name_skinadr name_flexadr",
    "int8": "plugin_attr",
}

#: Plugins of elements that exist: none.
_NO_PLUGIN = {"body_plugin": "nbody", "geom_plugin": "ngeom", "actuator_plugin": "nactuator", "sensor_plugin": "nsensor"}

_SHAPES = {
    name.partition(":")[0]: (dtype, tuple(int(n) for n in name.partition(":")[2].split() if n))
    for dtype, names in _ARRAYS.items()
    for name in names.split()
}

NAMES = (*_SHAPES, *_NO_PLUGIN)


def array(name: str, sizes: dict[str, int]) -> NDArray | None:
    """The array called `name`, read-only, or None when it is not among these."""
    if name in _SHAPES:
        dtype, columns = _SHAPES[name]
        values = np.zeros((0, *columns), dtype)
    elif name in _NO_PLUGIN:
        values = np.full(sizes[_NO_PLUGIN[name]], -1, np.int32)
    else:
        return None
    values.flags.writeable = False
    return values
