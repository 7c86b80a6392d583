"""A xacro expression that compares a boolean with text.

xacro reads the values `true` and `false` of properties, arguments and parameters as booleans. So
`${gz == 'true'}` compares True with a text: it is always false, whatever `gz` is, and the part that
depends on it never appears. `${gz != 'true'}` is always true.

Fix: write `${gz}`, or `${not gz}`. `${'$(arg gz)' == 'true'}` compares two texts, and works.
Source: xacro, `Table._eval_literal`, since version 1.13 (ROS Noetic and ROS 2).
"""

import re
from collections.abc import Iterator

from checker.formats.xacro.names import EXPRESSION
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.xml import Element, XmlDocument

_NAME = r"(?<![\w.\])'\"])([A-Za-z_]\w{0,80})"
_TRUTH = "(?:true|True|false|False)"
_COMPARISON = re.compile(
    rf"{_NAME}\s{{0,9}}(==|!=)\s{{0,9}}(['\"]){_TRUTH}\3"
    rf"|(['\"]){_TRUTH}\4\s{{0,9}}(==|!=)\s{{0,9}}([A-Za-z_]\w{{0,80}})(?![\w.\[('\"])"
)


@rule("URD023", "comparison-never-true", Severity.WARNING, Concern.ROBOT)
def check(package: Package) -> Findings:
    """Report comparisons of a name with `'true'` or `'false'` in the xacro files of a package."""
    for file in package.index.with_suffix(".xacro"):
        document = package.xml(file.path)
        if isinstance(document, XmlDocument):
            for element in document.elements:
                yield from _compared(element)


def _compared(element: Element) -> Iterator[Finding]:
    for attribute, value in element.attributes.items():
        for expression in EXPRESSION.finditer(value):
            for found in _COMPARISON.finditer(expression[1]):
                operator, name = found[2] or found[5], found[1] or found[6]
                result = "false" if operator == "==" else "true"
                yield finding(
                    element.attribute(attribute) or element,
                    f"{found.group()} is always {result}: xacro reads the text true or false of "
                    f"{name} as a boolean; write {name} or not {name}",
                    key=found.group(),
                )


def _arm(condition: str) -> object:
    return {
        "@urdf": True,
        "urdf/cell.urdf.xacro": f"""<robot name="cell" xmlns:xacro="http://ros.org/wiki/xacro">
<xacro:arg name="gz" default="true"/>
<xacro:property name="gz" value="$(arg gz)"/>
<link name="base_link"/>
<xacro:if value="{condition}
  <gazebo reference="base_link"><mu1>1</mu1></gazebo>
</xacro:if>
</robot>
""",
    }


_MARK = '">  <!-- ^ URD023 -->'
GOOD = [
    _arm('${gz}">'),
    _arm("${'$(arg gz)' == 'true'}\">"),
    _arm("${xacro.arg('gz') == 'true' or gz == 'sim'}\">"),
]
BAD = [
    _arm(f"${{gz == 'true'}}{_MARK}"),
    _arm(f"${{not gz != 'false'}}{_MARK}"),
    _arm(f"${{'True' == gz}}{_MARK}"),
]
