"""What roslaunch would start: args, conditions, groups, includes, remaps."""

from __future__ import annotations

import pytest

from checker.launch.ros1.expansion import MAX_DEPTH
from checker.launch.ros1.graph import LaunchFaultKind as Kind

NODE = '<node pkg="p" type="t" name="n" args="{}"/>'


def faults(graph):
    return [(fault.kind, fault.span.text) for fault in graph.faults]


def test_an_arg_takes_its_value_its_given_value_or_its_default(expand):
    content = '<arg name="a" value="1"/><arg name="b" default="2"/><arg name="c" default="3"/>'
    graph = expand(content + NODE.format("$(arg a) $(arg b) $(arg c)"), {"c": "given"})
    assert [node.args for node in graph.nodes] == ["1 2 given"]
    assert {name: arg.value for name, arg in graph.arguments.items()} == {
        "a": "1",
        "b": "2",
        "c": "given",
    }
    assert graph.faults == ()


def test_an_arg_that_is_not_declared_is_a_fault_at_its_substitution(expand):
    graph = expand(NODE.format("x $(arg nobody) y"))
    assert faults(graph) == [(Kind.UNDECLARED_ARG, "$(arg nobody)")]
    assert graph.nodes[0].args == "x $(arg nobody) y"


def test_an_arg_cannot_refer_to_itself_or_to_a_later_one(expand):
    graph = expand('<arg name="a" value="$(arg a)"/><arg name="b" value="$(arg c)"/>')
    assert [kind for kind, _ in faults(graph)] == [Kind.UNDECLARED_ARG, Kind.UNDECLARED_ARG]


def test_a_required_arg_that_is_not_given_is_one_fault_however_often_it_is_used(expand):
    graph = expand('<arg name="a"/>' + NODE.format("$(arg a)") * 3)
    assert faults(graph) == [(Kind.MISSING_ARG, '<arg name="a"/>')]


def test_a_constant_cannot_be_given(expand):
    graph = expand('<arg name="a" value="1"/>', {"a": "2"})
    assert [kind for kind, _ in faults(graph)] == [Kind.CONSTANT_ARG]
    assert graph.arguments["a"].value == "1"


def test_an_arg_is_declared_once_unless_conditions_choose(expand):
    both = '<arg name="a" value="1"/><arg name="a" value="2"/>'
    assert [kind for kind, _ in faults(expand(both))] == [Kind.REPEATED_ARG]
    chosen = '<arg name="a" value="1" if="0"/><arg name="a" value="2" unless="0"/>'
    assert expand(chosen).arguments["a"].value == "2"
    assert expand(chosen).faults == ()


@pytest.mark.parametrize(
    ("condition", "started"),
    [
        ('if="1"', True),
        ('if="true"', True),
        ('if="True"', True),
        ('if="0"', False),
        ('unless="false"', True),
        ('unless="1"', False),
        ('if="1" unless="1"', False),
    ],
)
def test_conditions(expand, condition, started):
    graph = expand(f"<group {condition}>{NODE.format('')}</group>")
    assert bool(graph.nodes) is started
    assert graph.faults == ()


@pytest.mark.parametrize("text", ["maybe", "", "2", "yes"])
def test_a_condition_that_is_neither_true_nor_false_is_a_fault(expand, text):
    graph = expand(f'<group if="{text}">{NODE.format("")}</group>')
    assert [fault.kind for fault in graph.faults] == [Kind.CONDITION]
    assert graph.nodes == ()


def test_a_condition_that_the_machine_decides_is_undecided_and_no_fault(expand):
    graph = expand(f'<group if="$(optenv SIM 1)">{NODE.format("")}</group>')
    assert [condition.span.text for condition in graph.undecided] == ["$(optenv SIM 1)"]
    assert graph.nodes == ()
    assert graph.faults == ()


def test_groups_nest_namespaces_and_end_the_scope_of_their_args(expand):
    graph = expand(
        '<group ns="X1"><group ns="arm"><arg name="a" value="1"/>'
        '<node pkg="p" type="t" name="n" ns="deep"/></group></group>'
        '<group ns="/top"><node pkg="p" type="t" name="m"/></group>' + NODE.format("$(arg a)")
    )
    assert [node.full_name for node in graph.nodes] == ["/X1/arm/deep/n", "/top/m", "/n"]
    assert faults(graph) == [(Kind.UNDECLARED_ARG, "$(arg a)")]


def test_remaps_hold_from_their_line_to_the_end_of_their_group(expand):
    graph = expand(
        '<group ns="X1"><node pkg="p" type="t" name="before"/><remap from="a" to="b"/>'
        '<node pkg="p" type="t" name="after"><remap from="~c" to="/d"/></node></group>'
        '<node pkg="p" type="t" name="outside"/>'
    )
    before, after, outside = graph.nodes
    assert before.resolve("a") == "/X1/a"
    assert after.resolve("a") == "/X1/b"
    assert after.resolve("/X1/a") == "/X1/b"
    assert after.resolve("~c") == "/d"
    assert outside.resolve("a") == "/a"
    assert [remap.inherited for remap in after.remaps] == [False, True]


def test_the_nodes_own_remap_is_stronger_than_one_around_it(expand):
    graph = expand(
        '<remap from="a" to="outer"/>'
        '<node pkg="p" type="t" name="n"><remap from="a" to="inner"/></node>'
    )
    assert graph.nodes[0].resolve("a") == "/inner"


def test_params_and_environment_are_gathered_with_full_names(expand):
    graph = expand(
        '<env name="E" value="1"/><group ns="X1"><param name="robot_description" command="xacro"/>'
        '<node pkg="p" type="t" name="n"><param name="rate" value="5"/>'
        '<rosparam file="f.yaml" command="load"/></node>'
        '<rosparam param="gains">[1, 2]</rosparam></group>'
    )
    assert [(param.name, param.value, param.kind) for param in graph.params] == [
        ("/X1/robot_description", "xacro", "command"),
        ("/X1/n/rate", "5", "value"),
        ("/X1/n", "f.yaml", "load"),
        ("/X1/gains", "[1, 2]", "yaml"),
    ]
    assert [(each.name, each.value) for each in graph.environment] == [("E", "1")]


def test_an_include_gets_its_args_and_no_others(expand):
    graph = expand(
        '<arg name="name" value="X1"/><arg name="b" value="mine"/><group ns="$(arg name)">'
        '<include file="$(dirname)/part.launch"><arg name="a" value="$(arg name)!"/></include>'
        "</group>",
        files={
            "launch/part.launch": '<launch><arg name="a"/><arg name="b" default="its own"/>'
            + NODE.format("$(arg a) $(arg b)")
            + "</launch>"
        },
    )
    assert [(node.args, node.namespace, node.file) for node in graph.nodes] == [
        ("X1! its own", "/X1", "launch/part.launch")
    ]
    assert [include.file for include in graph.includes] == ["launch/part.launch"]
    assert graph.faults == ()


def test_pass_all_args_hands_everything_over_and_overrides_constants_silently(expand):
    graph = expand(
        '<arg name="a" value="1"/><arg name="b" value="2"/>'
        '<include file="$(find other)/launch/part.launch" pass_all_args="true"/>',
        files={
            "../other/launch/part.launch": '<launch><arg name="a" value="0"/><arg name="b"/>'
            + NODE.format("$(arg a)$(arg b)")
            + "</launch>"
        },
    )
    assert [node.args for node in graph.nodes] == ["02"]
    assert graph.faults == ()


def test_an_include_must_give_what_is_required_and_only_what_is_declared(expand):
    include = '<include file="$(dirname)/part.launch">'
    graph = expand(
        include + '<arg name="typo" value="1"/></include>',
        files={"launch/part.launch": '<launch><arg name="a"/></launch>'},
    )
    assert faults(graph) == [
        (Kind.MISSING_ARG, include),
        (Kind.UNKNOWN_ARG, '<arg name="typo" value="1"/>'),
    ]


def test_a_file_of_a_package_that_is_not_at_hand_is_recorded_with_its_args(expand):
    graph = expand(
        '<group ns="X1"><include file="$(find elsewhere)/launch/all_robots.launch">'
        '<arg name="name" value="X1"/></include></group>'
    )
    (include,) = graph.unresolved_includes
    assert (include.package, include.file) == ("elsewhere", "launch/all_robots.launch")
    assert dict(include.arguments) == {"name": "X1"}
    assert include.namespace == "/X1"
    assert include.reason == "package elsewhere is not available"
    assert graph.faults == ()


def test_a_file_that_its_package_lacks_is_a_fault(expand):
    graph = expand('<include file="$(dirname)/nowhere.launch"/>')
    assert faults(graph) == [(Kind.MISSING_FILE, "$(dirname)/nowhere.launch")]
    assert graph.unresolved_includes[0].file == "launch/nowhere.launch"


@pytest.mark.parametrize("path", ["/opt/x.launch", "$(env HOME)/x.launch", "../x.launch", ""])
def test_a_path_that_is_known_only_at_the_launch_is_not_looked_for(expand, path):
    graph = expand(f'<include file="{path}"/>')
    assert graph.faults == ()
    assert graph.unresolved_includes[0].file == path


def test_a_file_that_includes_itself_is_a_fault(expand):
    graph = expand('<include file="$(dirname)/main.launch"/>', files={
        "launch/main.launch": '<launch><include file="$(dirname)/main.launch"/></launch>'
    })  # fmt: skip
    assert [fault.kind for fault in graph.faults] == [Kind.INCLUDE_LOOP]


def test_an_endless_chain_of_includes_ends_at_the_greatest_depth(expand):
    graph = expand(
        '<include file="$(dirname)/a.launch"><arg name="n" value="0"/></include>',
        files={
            "launch/a.launch": '<launch><arg name="n"/><include file="$(dirname)/a.launch">'
            '<arg name="n" value="$(eval n + 1)"/></include></launch>'
        },
    )
    assert [fault.kind for fault in graph.faults] == [Kind.LIMIT]
    assert len(graph.includes) == MAX_DEPTH + 1


@pytest.mark.slow
def test_includes_that_double_at_each_level_end_at_the_count_of_steps(expand):
    twice = '<include file="$(dirname)/{0}.launch"><arg name="n" value="{1}$(arg n)"/></include>'
    files = {
        f"launch/{level}.launch": '<launch><arg name="n"/>'
        + "".join(twice.format(level + 1, digit) for digit in "01")
        + "</launch>"
        for level in range(30)
    }
    files["launch/30.launch"] = '<launch><arg name="n"/></launch>'
    graph = expand('<arg name="n" value=""/>' + twice.format(0, 0), files=files)
    assert [fault.kind for fault in graph.faults] == [Kind.LIMIT]


def test_deeply_nested_groups_end_at_the_greatest_depth(expand):
    graph = expand("<group>" * 200 + NODE.format("") + "</group>" * 200)
    assert [fault.kind for fault in graph.faults] == [Kind.LIMIT]
    assert graph.nodes == ()


def test_args_that_double_their_length_are_stopped(expand):
    doubling = "".join(f'<arg name="a{n + 1}" value="$(arg a{n})$(arg a{n})"/>' for n in range(40))
    graph = expand(f'<arg name="a0" value="xx"/>{doubling}')
    assert {fault.kind for fault in graph.faults} == {Kind.LIMIT}
    assert max(len(arg.value) for arg in graph.arguments.values()) < 50_000
