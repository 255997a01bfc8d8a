"""`MjSpec`: a description of a model that programs build and edit."""

import os
import time
import warnings
from collections.abc import Mapping
from os import PathLike, fspath
from typing import IO, TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco import _engine as _core
from robohive.mujoco._errors import FatalError
from robohive.mujoco.enums.physics import mjtCTimer
from robohive.mujoco.spec import archive, attach, authored, exchange
from robohive.mujoco.spec.attach import affixed
from robohive.mujoco.spec.bodies import MjsBody, MjsFrame
from robohive.mujoco.spec.defaults import KINDS as DEFAULTS
from robohive.mujoco.spec.defaults import MjsDefault
from robohive.mujoco.spec.element import MjsElement
from robohive.mujoco.spec.forms import forms
from robohive.mujoco.spec.lists import Lists
from robohive.mujoco.spec.orientation import MjsOrientation
from robohive.mujoco.spec.plugins import numbered
from robohive.mujoco.spec.settings import MjsCompiler, MjStatistic
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.structs.options import MjOption, MjVisual
from robohive.mujoco.vfs import MjVfs, given_files

_MAIN = "main"
_PARTS = ("qpos", "qvel", "act", "mpos", "mquat", "ctrl")


class MjSpec(Lists):
    """A model as its text describes it, to be built, edited and compiled.

    Elements are added by `add_...` of the description, of its `worldbody` and of bodies and frames in it, found by name
    (`spec.body("arm")`) or listed (`spec.geoms`). Their attributes have the names of MuJoCo's `mjSpec`.
    """

    def __init__(self) -> None:
        self._begin(_core.Description())

    def _begin(self, description: _core.Description) -> None:
        groups = description.settings()
        general = groups["general"]
        given, compiler = authored.read(description.given())
        inner = self.__dict__
        inner.update(
            _description=description,
            _lists={kind: [] for kind in exchange.LISTED},
            _names={kind: {} for kind in (*MjsBody.HELD, *exchange.LISTED)},
            _extensions={},
            authored=given,
            _sizes={name: general[name] for name in forms("size")},
            _parent=None,
            _copies=False,
            _stamp=None,
            _seconds=0.0,
            modelname=general["modelname"] or "MuJoCo Model",
            comment="",
            modelfiledir=description.folder,
            assets={},
            override_assets=True,
            compiler=MjsCompiler(groups["compiler"], groups["lengthrange"], compiler),
            stat=MjStatistic(groups["stat"]),
            option=MjOption(),
            visual=MjVisual(),
        )
        inner["_classes"] = {name: MjsDefault(self, name, None, values) for name, values in description.classes()}
        for default in self._classes.values():
            default.__dict__["parent"] = self._classes[_MAIN] if default.name != _MAIN else None
        exchange.take_options(self, description.options())
        exchange.fill(self, description.elements())

    @classmethod
    def from_file(
        cls,
        filename: str | PathLike[str],
        include: Mapping[str, Any] | None = None,
        assets: Mapping[str, Any] | None = None,
        vfs: MjVfs | None = None,
    ) -> "MjSpec":
        """The description in a file, MJCF or URDF; files that it names are looked for in the mappings or in `vfs` first.

        Raises:
            ValueError: what is wrong with it, every finding with file, line, column and element.
        """
        files = _content(given_files(vfs, include, assets))
        return cls._read(_core.Description.of_path(fspath(filename), files), assets)

    @classmethod
    def from_string(
        cls,
        xml: str,
        include: Mapping[str, Any] | None = None,
        assets: Mapping[str, Any] | None = None,
        vfs: MjVfs | None = None,
    ) -> "MjSpec":
        """The description in a text; see `from_file`."""
        files = _content(given_files(vfs, include, assets))
        return cls._read(_core.Description.of_text(xml, files), assets)

    @classmethod
    def _read(cls, found: tuple[_core.Description, list[str]], assets: Mapping[str, Any] | None) -> "MjSpec":
        description, findings = found
        for finding in findings:
            warnings.warn(finding, stacklevel=3)
        spec = cls.__new__(cls)
        spec._begin(description)
        spec.assets.update(assets or {})
        return spec

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any: ...

    else:

        def __getattr__(self, name: str) -> Any:
            sizes = self.__dict__.get("_sizes", {})
            if name in sizes:
                return sizes[name]
            raise AttributeError(f"'mujoco.MjSpec' object has no attribute '{name}'")

    def __setattr__(self, name: str, value: Any) -> None:
        inner = self.__dict__
        if name in inner["_sizes"]:
            inner["_sizes"][name] = forms("size")[name].accept(value)
        elif name == "assets":
            inner["assets"].update(value)
        elif name in ("meshdir", "texturedir", "strippath"):
            setattr(self.compiler, name, value)
        elif name == "copy_during_attach":
            inner["_copies"] = bool(value)
        elif name in ("modelname", "comment", "modelfiledir"):
            if not isinstance(value, str):
                raise TypeError(f"{name} cannot be a {type(value).__name__}")
            inner[name] = value
        elif name == "override_assets":
            inner[name] = bool(value)
        elif name in ("option", "visual", "stat", "compiler", "authored"):
            inner[name] = value
        else:
            raise AttributeError(f"'mujoco.MjSpec' attribute '{name}' cannot be set")

    @property
    def meshdir(self) -> str:
        """Directory of meshes and height fields."""
        return str(self.compiler.meshdir)

    @property
    def texturedir(self) -> str:
        """Directory of textures."""
        return str(self.compiler.texturedir)

    @property
    def strippath(self) -> bool:
        """Directories in names of files are ignored."""
        return bool(self.compiler.strippath)

    @property
    def nemax(self) -> int:
        """Older limit, without effect."""
        return 0

    @property
    def worldbody(self) -> MjsBody:
        """The body in which all others stand."""
        world: MjsBody = self._world
        return world

    @property
    def parent(self) -> "MjSpec | None":
        """The description that this one is attached to."""
        parent: MjSpec | None = self._parent
        return parent

    @property
    def default(self) -> MjsDefault:
        """The default class of elements for which no other is named."""
        main: MjsDefault = self._classes[_MAIN]
        return main

    @property
    def timer(self) -> NDArray[np.float64]:
        """Seconds that the last compile took; its parts are not measured."""
        seconds = np.zeros(int(mjtCTimer.mjNCTIMER))
        seconds[mjtCTimer.mjCTIMER_TOTAL] = self._seconds
        return seconds

    @property
    def _address(self) -> int:
        return id(self)

    def find_default(self, classname: str) -> MjsDefault | None:
        """The default class of a name."""
        found: MjsDefault | None = self._classes.get(classname)
        return found

    def add_default(self, classname: str, parent: MjsDefault | None = None) -> MjsDefault | None:
        """Adds a default class that starts as a copy of `parent`; None when there is one of this name."""
        if not classname or classname in self._classes:
            return None
        added = self._classes[classname] = MjsDefault(self, classname, parent or self.default)
        return added

    def _rename_class(self, default: MjsDefault, name: str) -> None:
        if name in self._classes:
            raise ValueError(f"Error: repeated name '{name}' in default")
        self._classes.pop(default.name, None)
        default.__dict__["name"] = name
        self._classes[name] = default

    def _check_open(self) -> None:
        if self._parent is not None:
            raise ValueError("the description is attached to another one: add elements there")

    def _made(self, kind: type[Any], default: MjsDefault | None) -> Any:
        if kind._kind in DEFAULTS:
            found = default or self.default
            return getattr(found, kind._kind)._duplicate(self, self, found)
        made = kind(self)
        made.__dict__["_class"] = default
        return made

    def _append(self, kind: type[Any], default: MjsDefault | None, attributes: dict[str, Any]) -> Any:
        self._check_open()
        made = self._made(kind, default)._fill(attributes)
        self._lists[kind._kind].append(made)
        return made

    def activate_plugin(self, name: str) -> None:
        """Lets elements use a plugin; unknown ones are reported by `compile`."""
        self._extensions.setdefault(str(name), (self, None))

    def _register(self, element: MjsElement) -> None:
        if element.name:
            self._names[element._kind][element.name] = element

    def _rename(self, element: MjsElement, name: Any) -> None:
        if not isinstance(name, str):
            raise TypeError(f"name cannot be a {type(name).__name__}")
        names = self._names[element._kind]
        if names.get(name, element) is not element:
            raise ValueError(f"Error: repeated name '{name}' in {element._kind}")
        if element is self._world and name != "world":
            raise ValueError("the world cannot be renamed")
        names.pop(element.name, None)
        element.__dict__["name"] = name
        if name:
            names[name] = element

    def delete(self, element: Any) -> None:
        """Takes an element out, or a default class. With a body goes what is in it, and what refers to that.

        Raises:
            ValueError: it is the world, or not part of this description, or the description is attached.
        """
        if self._parent is not None:
            raise ValueError("Cannot delete element from an attached mjSpec.")
        if isinstance(element, MjsDefault):
            if element is self.default:
                raise ValueError("the default class of all elements cannot be deleted")
            self._classes.pop(element.name, None)
        elif element._owner is not self:
            raise ValueError("the element is not part of this description")
        else:
            attach.remove(self, element)

    def attach(
        self, child: "MjSpec", prefix: str | None = None, suffix: str | None = None, site: Any = None, frame: Any = None
    ) -> MjsFrame:
        """Attaches all of another description to a frame or a site, given by itself or by its name; returns the frame around it.

        Names get the prefix, "/" by default, and the suffix. The elements of `child` move: it cannot be compiled or
        attached again. With `copy_during_attach` they are copied.

        Raises:
            ValueError: there is no such frame or site, a name is taken, or settings conflict.
        """
        if (frame is None) == (site is None):
            raise ValueError(
                "give the frame or the site to attach to" if frame is None else "give a frame or a site to attach to, not both"
            )
        kind = "frame" if site is None else "site"
        onto = frame if site is None else site
        found = self._names[kind].get(onto) if isinstance(onto, str) else onto
        if found is None:
            raise ValueError(f"{kind.capitalize()} not found.")
        if found._home() is not self:
            raise ValueError(f"the {kind} is part of another description")
        before, after = "/" if prefix is None else prefix, suffix or ""
        files = {affixed(name, before, after): content for name, content in child.assets.items()}
        taken = [name for name in files if name in self.assets]
        if taken and not self.override_assets:
            raise ValueError(f"this description has a file called {taken[0]} already")
        around = attach.attach_spec(found, child, before, after)
        self.assets.update(files)
        return around

    def _parent_spec(self, parent: "MjSpec") -> None:
        self.__dict__["_parent"] = parent

    def copy(self) -> "MjSpec":
        """A copy, with elements of its own."""
        other: MjSpec = exchange.duplicate(self)[0]
        return other

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> "MjSpec":
        return self.copy()

    def _copy_settings(self, other: "MjSpec", classes: dict[int, MjsDefault]) -> None:
        """Takes over all of another description but its elements; notes the copies of its classes by their identity."""
        inner = self.__dict__
        inner["_description"] = other._description
        inner["_names"] = {kind: {} for kind in other._names}
        inner["_sizes"] = dict(other._sizes)
        inner["_extensions"] = {
            name: (self if origin is other else origin, place) for name, (origin, place) in other._extensions.items()
        }
        inner["assets"] = dict(other.assets)
        for name in ("modelname", "comment", "modelfiledir", "override_assets", "_copies"):
            inner[name] = getattr(other, name)
        inner["compiler"] = other.compiler._copied()
        self.authored._take(other.authored)
        inner["stat"] = MjStatistic(other.stat.__dict__)
        exchange.take_options(self, exchange._options(other))
        inner["_classes"] = {}
        for name, default in other._classes.items():
            copied = MjsDefault(self, default.name, None)
            copied.__dict__["parent"] = classes.get(id(default.parent), default.parent)
            for kind in DEFAULTS:
                copied.__dict__[kind] = getattr(default, kind)._duplicate(None, self, copied)
            classes[id(default)] = self._classes[name] = copied

    def compile(self, vfs: MjVfs | None = None) -> MjModel:
        """The model; files that the description names are looked for in `assets` and in `vfs` first.

        Raises:
            ValueError: what is wrong with the description; this one is attached to another.
        """
        return self._compiled(vfs)[0]

    def _compiled(self, vfs: MjVfs | None = None) -> tuple[MjModel, exchange.Tree, _core.CompiledModel]:
        if self._parent is not None:
            raise ValueError("Error: cannot compile child spec if attached by reference to a parent spec")
        began = time.perf_counter()
        tree = exchange.Tree(self)
        found: list[_core.CompiledModel] = []

        def load() -> tuple[_core.CompiledModel, list[str]]:
            compiled, findings = self._run(tree, given_files(vfs))
            found.append(compiled)
            return compiled, findings

        model = MjModel._of(load)
        self.__dict__["_seconds"] = time.perf_counter() - began
        self._number(model)
        return model, tree, found[0]

    def _run(self, tree: exchange.Tree, more: Mapping[str, Any] | None = None) -> tuple[_core.CompiledModel, list[str]]:
        try:
            found: tuple[_core.CompiledModel, list[str]]
            files = {**_content(more), **_content(self.assets), **tree.pictures}
            found = self._description.compile(tree.parts(), files, tree.drawn)
            return found
        except ValueError as error:
            # What programs note of an element goes with what is wrong with it.
            text = str(error)
            known = ((kind, element) for kind in (*MjsBody.HELD, *exchange.LISTED) for element in self._all(kind))
            notes = [e.info for kind, e in known if e.info and f"{kind} '{e.name}'" in text]
            raise ValueError("\n".join((text, *notes))) from None

    def _number(self, model: MjModel) -> None:
        """Gives elements their ids, and keyframes the numbers that stood at other elements."""
        stamp = self.__dict__["_stamp"] = object()
        model.__dict__["_stamp"] = stamp
        kept = [key for key in self._lists["key"] if key._kept]
        self._lists["key"].sort(key=lambda key: key._kept)
        for kind in (*MjsBody.HELD, *exchange.LISTED):
            elements = self._all(kind) if kind != "plugin" else numbered(self)
            for number, element in enumerate(elements):
                element.__dict__.update(_id=number, _stamp=stamp)
        for key in kept:
            place = key._id + max(0, self._sizes["nkey"] - len(self._lists["key"]) + len(kept))
            key.__dict__.update(_kept=False)
            for part in _PARTS:
                numbers = getattr(model, f"key_{part}")[place]
                key.__dict__[part] = np.array(numbers, float).ravel()
        if kept:
            for element in (*self._all("body"), *self._all("joint"), *self._lists["actuator"]):
                element.__dict__["_shares"] = []

    def recompile(self, model: MjModel, data: MjData) -> tuple[MjModel, MjData]:
        """The model, and data of it in the state of `data`, for every element that both models have."""
        if not isinstance(model, MjModel) or not isinstance(data, MjData):
            raise TypeError("recompile takes an MjModel and an MjData of it")
        fresh = self.compile()
        carried = MjData(fresh)
        carried._carry(data)
        return fresh, carried

    def to_xml(self) -> str:
        """The description as MJCF, with classes resolved and angles in radians.

        Raises:
            ValueError: what is wrong with the description, or a texture has pixels that the program gave, which no text holds.
        """
        tree = exchange.Tree(self)
        if tree.pictures:
            raise ValueError("Error: no text can hold texture.data; write a picture, and give its name as texture.file")
        compiled, _ = self._run(tree)
        text: str = self._description.write(tree.parts(), compiled)
        return text

    def to_file(self, file: str | PathLike[str]) -> None:
        """Writes the description as MJCF."""
        text = self.to_xml()
        with open(file, "w", encoding="utf-8") as out:
            out.write(text)

    def encode(self, filename: str, model: MjModel | None = None, content_type: str | None = None) -> int:
        """Writes the description as MJCF into a file whose name ends in `.xml`; returns its length in bytes.

        Raises:
            FatalError: the file is of another kind.
        """
        if content_type not in (None, "text/xml") or not filename.lower().endswith(".xml"):
            raise FatalError(f"{filename}: descriptions are written as MJCF, to files that end in .xml")
        self.to_file(filename)
        return os.path.getsize(filename)

    @classmethod
    def from_zip(cls, file: str | IO[bytes]) -> "MjSpec":
        """The description in an archive of a text and the files that it names.

        Raises:
            ValueError: it is no archive, or holds no text.
        """
        return cls.from_string(*archive.read(file))

    def to_zip(self, file: str | IO[bytes]) -> None:
        """Writes an archive of the description's text and the files in `assets`."""
        archive.write(file, self.modelname, self.to_xml(), _content(self.assets))

    @staticmethod
    def resolve_orientation(degree: bool, sequence: Any = None, orientation: MjsOrientation | None = None) -> list[float]:
        """The quaternion of an orientation."""
        letters = "".join(sequence or "xyz").encode()
        return list(_core.orientation(degree, list(letters), {"alt": orientation or MjsOrientation()}))


def _content(files: Mapping[str, Any] | None) -> dict[str, bytes]:
    return {name: content.encode() if isinstance(content, str) else bytes(content) for name, content in (files or {}).items()}
