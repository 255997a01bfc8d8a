"""What all elements of a description have: attributes, a name, a place."""

from typing import TYPE_CHECKING, Any, ClassVar

from robohive.mujoco.spec.forms import all_forms, forms
from robohive.mujoco.spec.orientation import WAYS, MjsOrientation

if TYPE_CHECKING:
    from typing_extensions import Self

    from robohive.mujoco.spec.defaults import MjsDefault
    from robohive.mujoco.spec.settings import MjsCompiler
    from robohive.mujoco.spec.tree import MjSpec


class MjsElement:
    """An element of a description. Its attributes have the names of MuJoCo's `mjSpec`; arrays may be written in place.

    Elements are made by `add_...` of a description, a body or a frame.
    """

    _kind: ClassVar[str]
    #: Orientations other than quaternions: attribute, and prefix of the arguments that set it.
    _turns: ClassVar[dict[str, str]] = {}
    #: What a copy shares or sets by itself, as opposed to values.
    _inner: ClassVar[frozenset[str]] = frozenset(
        ("_owner", "_origin", "_class", "_loc", "_id", "_stamp", "_parent", "_frame", "_shares", "_contents")
    )

    def __init__(self, owner: "MjSpec | None", values: dict[str, Any] | None = None) -> None:
        inner = self.__dict__
        inner.update(
            _owner=owner, _origin=owner, _class=None, _loc=None, _id=-1, _stamp=None, _parent=None, _frame=None, _shares=[]
        )
        given = values or {}
        for name, form in all_forms(self._kind).items():
            inner[name] = form.fresh(given.get(name, form.default))
        for name in self._turns:
            inner[name] = MjsOrientation()
            if name in given:
                inner[name].take(*given[name])

    def __setattr__(self, name: str, value: Any) -> None:
        form = forms(self._kind).get(name)
        if name == "name" and self._owner is not None:
            self._owner._rename(self, value)
        elif form is not None:
            try:
                accepted = form.accept(value)
            except ValueError as error:
                if form.word in ("texts", "letters"):
                    raise
                raise TypeError(f"incompatible value: {error}") from None
            if form.length is not None and form.word in ("reals", "singles", "integers"):
                self.__dict__[name][:] = accepted
            else:
                self.__dict__[name] = accepted
        elif isinstance(getattr(type(self), name, None), property):
            object.__setattr__(self, name, value)
        else:
            raise AttributeError(f"'mujoco.{type(self).__name__}' object has no attribute '{name}'")

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any: ...

    else:

        def __getattr__(self, name: str) -> Any:
            raise AttributeError(f"'mujoco.{type(self).__name__}' object has no attribute '{name}'")

    def _fill(self, arguments: dict[str, Any]) -> "Self":
        """Sets attributes from the arguments of `add_...`."""
        known = forms(self._kind)
        for attribute, prefix in self._turns.items():
            given = [way for way in WAYS if arguments.get(prefix + way) is not None]
            if len(given) > 1:
                names = [prefix + way for way in WAYS]
                raise ValueError(f"Only one of: {', '.join(names[:-1])}, or {names[-1]} can be set.")
            for way in given:
                self.__dict__[attribute].set(way, arguments[prefix + way], prefix + way)
        turns = {prefix + way for prefix in self._turns.values() for way in WAYS}
        for name, value in arguments.items():
            if value is None or name in turns or name == "name":
                continue
            if name == "plugin" and hasattr(type(self), "plugin"):
                self.plugin = value
                continue
            if name not in known:
                raise TypeError(f"{type(self).__name__} has no attribute '{name}'; it has {', '.join(known)}")
            self.__dict__[name] = known[name].accept(value)
        if arguments.get("name"):
            self.name = arguments["name"]
        return self

    def _home(self) -> "MjSpec":
        """The description that the element is part of.

        Raises:
            ValueError: it was deleted.
        """
        if self._owner is None:
            name = getattr(self, "name", "")
            raise ValueError(f"the {self._kind}{name and f' {name!r}'} was deleted from its description")
        owner: MjSpec = self._owner
        return owner

    @property
    def id(self) -> int:
        """Number of the element in the model that was compiled last, -1 before that."""
        return self._number()

    def _number(self) -> int:
        number: int = self._id
        return number

    @property
    def signature(self) -> int:
        """A number that elements share that were compiled together; 0 before that."""
        return 0 if self._stamp is None else id(self._stamp)

    @property
    def classname(self) -> "MjsDefault":
        """The default class of the element."""
        found: MjsDefault = self._class or self._origin.default
        return found

    @classname.setter
    def classname(self, default: "MjsDefault") -> None:
        self.__dict__["_class"] = default

    @property
    def compiler(self) -> "MjsCompiler":
        """Settings that the element is compiled with: those of the description that it was made in."""
        settings: MjsCompiler = self._origin.compiler
        return settings

    def _values(self) -> dict[str, Any]:
        """Copies of all values that are the element's own."""
        return {name: _copied(value) for name, value in self.__dict__.items() if name not in self._inner}

    def _duplicate(self, owner: "MjSpec | None", origin: "MjSpec | None", default: "MjsDefault | None") -> "Self":
        """A copy, as part of another description and yet without a place in it."""
        other = type(self).__new__(type(self))
        other.__dict__.update(
            self._values(),
            _owner=owner,
            _origin=origin,
            _class=default,
            _loc=self._loc,
            _id=self._id,
            _stamp=self._stamp,
            _parent=None,
            _frame=None,
            _shares=list(self._shares),
        )
        return other


def _copied(value: Any) -> Any:
    if isinstance(value, MjsOrientation):
        return value.copied()
    if isinstance(value, list):
        return type(value)(value)
    return value.copy() if hasattr(value, "copy") else value
