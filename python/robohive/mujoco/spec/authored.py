"""Which settings a text gives, as opposed to those left at their defaults: bits in MuJoCo's order."""

from typing import Any

#: Attributes by their bits. Those of the compiler that no text has a single attribute for are left out.
_GROUPS = {
    "option": (
        "timestep impratio tolerance ls_tolerance noslip_tolerance ccd_tolerance sleep_tolerance gravity wind magnetic density "
        "viscosity o_margin o_solref o_solimp o_friction integrator cone jacobian solver iterations ls_iterations "
        "noslip_iterations ccd_iterations - - - sdf_initpoints sdf_iterations"
    ),
    "compiler": (
        "autolimits boundmass boundinertia settotalmass balanceinertia fitaabb angle eulerseq discardvisual usethread "
        "fusestatic inertiafromgeom inertiagrouprange saveinertial alignfree conflict - meshdir texturedir"
    ),
    "global": (
        "cameraid orthographic fovy ipd azimuth elevation linewidth glow realtime offwidth offheight ellipsoidinertia bvactive"
    ),
    "quality": "shadowsize offsamples numslices numstacks numquads",
    "headlight": "ambient diffuse specular active",
    "map": (
        "stiffness stiffnessrot force torque alpha fogstart fogend znear zfar haze shadowclip shadowscale actuatortendon"
    ),
    "scale": (
        "forcewidth contactwidth contactheight connect com camera light selectpoint jointlength jointwidth actuatorlength "
        "actuatorwidth framelength framewidth constraint slidercrank frustum"
    ),
    "rgba": (
        "fog haze force inertia joint actuator actuatornegative actuatorpositive com camera light selectpoint connect "
        "contactpoint contactforce contactfriction contacttorque contactgap rangefinder constraint slidercrank crankbroken "
        "frustum bv bvactive"
    ),
}
_BITS = {group: {name: bit for bit, name in enumerate(names.split()) if name != "-"} for group, names in _GROUPS.items()}
_FLAGS = ("disableflags", "enableflags", "disableactuator")

#: Elements with the attributes that a text gives, disable flags, enable flags, actuator groups.
Given = tuple[set[tuple[str, str]], int, int, int]


def _field(group: str) -> str:
    return group if group == "option" else f"visual_{group}"


class MjsAuthored:
    """Settings that the text of a description gives: a bit for each field of `option` and of the groups of `visual`, and for
    each flag and actuator group."""

    option: int
    disableflags: int
    enableflags: int
    disableactuator: int
    visual_global: int
    visual_quality: int
    visual_headlight: int
    visual_map: int
    visual_scale: int
    visual_rgba: int

    __slots__ = (*_FLAGS, *(_field(group) for group in _GROUPS if group != "compiler"))

    def __init__(self) -> None:
        for name in self.__slots__:
            setattr(self, name, 0)

    def __setattr__(self, name: str, value: Any) -> None:
        object.__setattr__(self, name, int(value))

    def _take(self, other: "MjsAuthored") -> None:
        for name in self.__slots__:
            setattr(self, name, getattr(other, name))


def read(given: Given) -> tuple[MjsAuthored, int]:
    """What the engine found given, and the same for settings of the compiler."""
    values, *flags = given
    authored, compiler = MjsAuthored(), 0
    for name, bits in zip(_FLAGS, flags, strict=True):
        setattr(authored, name, bits)
    for group, attribute in values:
        bit = _BITS[group].get(attribute)
        if bit is None:
            continue
        if group == "compiler":
            compiler |= 1 << bit
        else:
            setattr(authored, _field(group), getattr(authored, _field(group)) | 1 << bit)
    return authored, compiler


def shown(authored: MjsAuthored) -> Given:
    """What is given, for the engine."""
    values = {
        (group, name)
        for group, bits in _BITS.items()
        if group != "compiler"
        for name, bit in bits.items()
        if getattr(authored, _field(group)) >> bit & 1
    }
    return values, authored.disableflags, authored.enableflags, authored.disableactuator
