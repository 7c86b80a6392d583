"""A window of Gazebo that shows an empty scene, since nothing puts the models into it.

`MinimalScene` makes the 3D view alone; `GzSceneManager` adds what the server sends. Where `<gui>`
of a world, or a file `*.config` with `<gui>`, lists plugins, no others are loaded, and without it
the view stays grey. `GzScene3D` of Fortress and older releases does both.

Fix: add `<plugin filename="GzSceneManager" name="Scene Manager"/>` beside `MinimalScene`.
Source: gz-sim, gui.config and GzSceneManager; gz-gui, MinimalScene.
"""

from collections.abc import Iterator

from checker.model.world import World
from checker.package.package import Package
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.source.xml import Element, XmlDocument

_VIEW = "MinimalScene"
_FILLS = ("GzSceneManager", "IgnSceneManager", "GzScene3D", "Scene3D")


@rule("WLD015", "window-without-scene", Severity.WARNING, Concern.INTERFACE)
def check(package: Package, world: World | None, context: Context) -> Findings:
    """Report each 3D view into which no plugin of its list puts the models."""
    if not context.is_gazebo_sim:
        return
    for gui in (*(world.element.all("gui") if world is not None else ()), *_files(package)):
        plugins = {plugin.get("filename") or "": plugin for plugin in gui.all("plugin")}
        view = plugins.get(_VIEW)
        if view is not None and plugins.keys().isdisjoint(_FILLS):
            yield finding(
                view,
                f"Gazebo's window stays empty: <gui> lists {_VIEW} without GzSceneManager, which "
                "puts the models into it",
            )


def _files(package: Package) -> Iterator[Element]:
    """Yield the root of each file with a configuration of Gazebo's window."""
    for file in package.index.with_suffix(".config"):
        document = package.xml(file.path)
        if isinstance(document, XmlDocument) and document.root.tag == "gui":
            yield document.root


def _gui(*plugins: str, mark: str = "") -> str:
    listed = "".join(f'<plugin filename="{name}" name="{name}"/>{mark}\n' for name in plugins)
    return f"<gui>\n{listed}</gui>"


def _world(gui: str) -> dict[str, str]:
    world = f'<sdf version="1.9">\n<world name="hall">\n{gui}\n</world>\n</sdf>\n'
    return {"@fragment": world, "@profile": "gazebo-harmonic"}


_MARK = "  <!-- ^ WLD015 -->"
GOOD = [
    _world(_gui("MinimalScene", "GzSceneManager")),
    _world(_gui("WorldControl")),
    _world(""),
]
BAD = [
    _world(_gui("MinimalScene", mark=_MARK)),
    {"@profile": "gazebo-harmonic", "config/gui.config": _gui("MinimalScene", mark=_MARK)},
]
