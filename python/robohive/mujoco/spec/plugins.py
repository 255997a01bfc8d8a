"""Plugins: instances that a description declares, and those that elements use."""

from typing import TYPE_CHECKING, Any

from robohive.mujoco.spec.element import MjsElement
from robohive.mujoco.spec.forms import all_forms, forms

if TYPE_CHECKING:
    from typing_extensions import Self


class MjsPlugin(MjsElement):
    """An instance of a plugin, with the texts of its attributes by name in `config`.

    Of the description (`spec.plugins`), or of an element: `body.plugin` names the plugin or the instance that the body uses,
    while it is `active`.
    """

    _kind = "plugin"

    def __init__(self, owner: Any, values: dict[str, Any] | None = None) -> None:
        super().__init__(owner, values)
        self.__dict__["_config"] = dict((values or {}).get("_config", ()))

    def _number(self) -> int:
        if self._owner is None or self._id >= 0:
            return super()._number()
        return next((i for i, other in enumerate(self._owner._lists[self._kind]) if other is self), -1)

    @property
    def config(self) -> dict[str, str]:
        """A copy of the attributes; assigned, it replaces all."""
        return dict(self._settings())

    @config.setter
    def config(self, config: dict[str, str]) -> None:
        if not all(isinstance(text, str) for entry in config.items() for text in entry):
            raise TypeError("names and values of attributes of plugins are texts")
        settings = self._settings()
        settings.clear()
        settings.update(config)

    def _settings(self) -> dict[str, str]:
        settings: dict[str, str] = self._config
        return settings


class _Used(MjsPlugin):
    """The plugin of an element: its attributes are those of the instance that was assigned."""

    def __init__(self, element: Any, given: MjsPlugin | None = None) -> None:
        super().__init__(element._owner)
        self.__dict__["_instance"] = getattr(given, "_instance", given)
        if given is not None:
            self.__dict__.update({name: given.__dict__[name] for name in all_forms("plugin")})

    def __setattr__(self, name: str, value: Any) -> None:
        if name == "config":
            MjsPlugin.config.__set__(self, value)  # type: ignore[attr-defined]
            return
        form = forms("plugin").get(name)
        if form is None:
            raise AttributeError(f"'mujoco.MjsPlugin' object has no attribute '{name}'")
        self.__dict__[name] = form.accept(value)

    def _number(self) -> int:
        return -1 if self._instance is None else int(self._instance.id)

    def _settings(self) -> dict[str, str]:
        settings: dict[str, str] = self._config if self._instance is None else self._instance._config
        return settings

    def row(self, element: Any) -> tuple[str, str, list[tuple[str, str]]] | None:
        """What the element uses, for the engine: name of the plugin, name of the instance, attributes of one without a name.

        Raises:
            ValueError: it names neither plugin nor instance.
        """
        if not self.active:
            return None
        if self.name:
            return "", self.name, []
        plugin = self.plugin_name or (self._instance.plugin_name if self._instance is not None else "")
        if not plugin:
            kind, name = element._kind, element.name
            raise ValueError(f"Error: {kind} '{name}': its plugin is active; give it plugin_name, or the name of an instance")
        return plugin, "", list(self._settings().items())


class Plugged(MjsElement):
    """An element that may use a plugin."""

    _inner = MjsElement._inner | {"_plugin"}

    def __init__(self, owner: Any, values: dict[str, Any] | None = None) -> None:
        super().__init__(owner, values)
        self.__dict__["_plugin"] = None
        shown = (values or {}).get("_plugin")
        if shown is not None:
            plugin, name, config = shown
            self.plugin.__dict__.update(active=True, plugin_name=plugin, name=name, _config=dict(config))

    @property
    def plugin(self) -> MjsPlugin:
        """The plugin that the element uses while `plugin.active`; an assigned instance shares its `config`."""
        inner = self.__dict__
        if inner["_plugin"] is None:
            inner["_plugin"] = _Used(self)
        used: MjsPlugin = inner["_plugin"]
        return used

    @plugin.setter
    def plugin(self, plugin: MjsPlugin) -> None:
        if not isinstance(plugin, MjsPlugin):
            raise TypeError(f"plugin cannot be a {type(plugin).__name__}")
        self.__dict__["_plugin"] = _Used(self, plugin)

    def _duplicate(self, owner: Any, origin: Any, default: Any) -> "Self":
        other = super()._duplicate(owner, origin, default)
        used = self._plugin
        other.__dict__["_plugin"] = None
        if used is not None:
            other.plugin = used
            other.plugin.__dict__["_config"] = dict(used._config)
        return other


def own_instances(elements: list[Any]) -> list[MjsPlugin]:
    """Instances for the elements that were read with one of their own; the elements share their attributes."""
    found = []
    for element in elements:
        used = element.__dict__.get("_plugin")
        if used is not None and not used.name and used._instance is None:
            instance = MjsPlugin(element._owner, {"_config": used._config})
            used.__dict__["_instance"] = instance
            found.append(instance)
    return found


def used_instances(source: Any, elements: list[Any]) -> list[Any]:
    """The instances of a description that elements use, each once."""
    found: dict[int, Any] = {}
    for element in elements:
        used = element.__dict__.get("_plugin")
        if used is not None:
            instance = source._names["plugin"].get(used.name) if used.name else used._instance
            if instance is not None and instance._owner is source:
                found[id(instance)] = instance
    return list(found.values())


def numbered(spec: Any) -> list[Any]:
    """The instances that a compiled model has, in the order of their ids: those with names, those that elements declare, and
    those that the reader made of a composite."""
    declared = spec._lists["plugin"]
    named = [plugin for plugin in declared if plugin.name and not plugin.expanded]
    holders = [*spec._lists["mesh"], *spec._lists["actuator"], *spec._lists["sensor"]]
    for body in spec._world._below():
        holders += [body, *body._contents["geom"]]
    used = [element.__dict__["_plugin"] for element in holders]
    inner = [one._instance for one in used if one is not None and one.active and not one.name]
    return [*named, *inner, *(plugin for plugin in declared if plugin.name and plugin.expanded)]
