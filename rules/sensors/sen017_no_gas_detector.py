"""A robot without the gas detector.

Gas is one of the artifacts of the SubT challenge, and every robot detects it: without the plugin a
robot drives through gas and reports nothing.

Fix: add the plugin `subt::GasDetector` of `libGasEmitterDetectorPlugin.so` to what the spawner
emits, with topic `/model/<name>/gas_detected`, update_rate 10 and type gas; bridge that topic.
Source: SubT maintainers require it on every robot (`subt_standards.json`, gas_sensor).
"""

from checker.base.resources import table
from checker.finding import Fix, Place, Safety
from checker.model.plugin_library import library_stem
from checker.model.robot import Robot
from checker.package.inheritance import SPAWNER
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.text import SourceText
from checker.source.xml_insertion import insert_behind

_ROBOTS = (PackageKind.ROBOT, PackageKind.CONFIGURATION)


_NAME = "#{_name}"
"""The robot's name, as the guide's spawner writes it."""


@rule("SEN017", "no-gas-detector", Severity.ERROR, Concern.INTERFACE)
def check(package: Package, robot: Robot) -> Findings:
    """Report robots without the gas detector; packages for others to build on need none."""
    standard = table("subt_standards")["gas_sensor"]["plugin"]
    wanted = (standard["name"].rsplit("::", 1)[-1], library_stem(standard["filename"]))
    if package.kind not in _ROBOTS:
        return
    for plugin in robot.all_plugins:
        if plugin.class_name == wanted[0] or library_stem(plugin.filename.value) == wanted[1]:
            return
    reason = robot.unread_plugins or robot.missing_parts
    if reason:
        yield unchecked(reason)
        return
    yield finding(
        Place(SPAWNER) if package.exists(SPAWNER) else robot,
        f"robot {robot.name.value!r} has no gas detector; add the plugin {standard['name']!r} of "
        f"{standard['filename']!r}",
        fix=_added(package, robot),
    )


def _added(package: Package, robot: Robot) -> Fix | None:
    """Return the fix that puts the plugin behind the last one that the spawner adds."""
    emitted = [each for each in robot.plugins if each.span.place().file == SPAWNER]
    source = package.read(SPAWNER)
    if not emitted or not isinstance(source, SourceText) or _NAME not in source.text:
        return None
    standard = table("subt_standards")["gas_sensor"]
    plugin, parameters = standard["plugin"], standard["parameters"]
    lines = [
        f'<plugin filename="{plugin["filename"]}"',
        f'        name="{plugin["name"]}">',
        *(f"  <{tag}>{value}</{tag}>" for tag, value in parameters.items()),
        "</plugin>",
    ]
    texts = [line.replace("{name}", _NAME) for line in lines]
    return Fix(Safety.UNSAFE, (insert_behind(emitted[-1].element, texts),))


_DETECTOR = '<plugin filename="libGasEmitterDetectorPlugin.so" name="subt::GasDetector"/>'
_SPAWNER = """def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
  <spawn name="#{_name}">
    <sdf version="1.6">
      <include>
        <uri>#{_modelURI}</uri>
        {plugin}
      </include>
    </sdf>
  </spawn>
  HEREDOC
end
"""

GOOD = [
    _DETECTOR,
    {"launch/spawner.rb": _SPAWNER.replace("{plugin}", _DETECTOR)},
    {"@name": "acme_rover_base", "launch/spawner.rb": None, "launch/vehicle_topics.launch": None},
]
BAD = [
    {"@reported": ["launch/spawner.rb:1"]},
    {
        "launch/spawner.rb": "# No plugin.  ^ SEN017\n" + _SPAWNER.replace("{plugin}", ""),
        "@fragment": '<plugin filename="libGasEmitter.so" name="subt::GasEmitter"/>',
    },
]
