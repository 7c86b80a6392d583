"""What launch files in Python start."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.formats.xacro.files import ROOT
from checker.launch.ros2.graph import (
    LaunchFaultKind,
    LaunchGraph,
    NodeKind,
    Parameter,
    ParameterFile,
    display_path,
)
from checker.launch.ros2.package_launch import launch_files
from checker.package.inputs import open_input
from tests.ros2_launch.conftest import NAME, PACKAGE_XML, Read, python


def words(graph: LaunchGraph, number: int = 0) -> list[str]:
    return [display_path(word.value) for word in graph.nodes[number].arguments]


def test_a_node_with_all_its_parts(read: Read) -> None:
    graph = read(
        f"""
        share = get_package_share_directory('{NAME}')
        return LaunchDescription([
            Node(package='rviz2', executable='rviz2', name='view', namespace='r1',
                 arguments=['-d', os.path.join(share, 'config', 'view.rviz')],
                 parameters=[{{'use_sim_time': True, 'a': {{'b': 2.5}}}}, share + '/config/p.yaml'],
                 remappings=[('/tf', 'tf')]),
        ])
        """
    )
    (node,) = graph.nodes
    assert (node.package.value, node.executable.value) == ("rviz2", "rviz2")
    assert node.name is not None
    assert node.name.value == "view"
    assert node.namespace == "/r1"
    assert words(graph) == ["-d", f"$(find-pkg-share {NAME})/config/view.rviz"]
    values = {p.name: p.value for p in node.parameters if isinstance(p, Parameter)}
    assert values == {"use_sim_time": True, "a.b": 2.5}
    (file,) = (p for p in node.parameters if isinstance(p, ParameterFile))
    assert display_path(file.path) == f"$(find-pkg-share {NAME})/config/p.yaml"
    assert [(remap.source, remap.target) for remap in node.remaps] == [("/tf", "tf")]
    assert node.starts is True
    assert not graph.unread
    assert not graph.faults


def test_places_are_those_of_the_literals(read: Read) -> None:
    graph = read(
        """
        flag = '-d'
        return LaunchDescription([Node(package='é', executable='b', arguments=[flag, 'c' + 'd'])])
        """
    )
    flag, joined = graph.nodes[0].arguments
    assert (flag.span.text, joined.span.text) == ("'-d'", "'c' + 'd'")
    assert graph.nodes[0].span.text.startswith("Node(")
    assert graph.nodes[0].package.span.text == "'é'"


@pytest.mark.parametrize(
    ("statements", "expected"),
    [
        ("x = [f'{a}_{b}' for a in ('l', 'r') for b in range(2) if b]", ["l_1", "r_1"]),
        ("x = []\nfor n in ['a', 'b']:\n    x += [n.upper()]", ["A", "B"]),
        ("x = ['0'] * 2 + [*map(str, (1, 2))]", ["0", "0", "1", "2"]),
        ("x = ['-topic', {'robot_description': object()}]", ["-topic", "robot_description"]),
        ("d = dict(a='1', **{'b': '2'})\nx = [k + v for k, v in d.items()]", ["a1", "b2"]),
        ("def f(*a, k='z', **n):\n    return [*a, k, *n]\nx = f('p', q=1)", ["p", "z", "q"]),
        ("x = [(lambda v: v + '!')('a')]", ["a!"]),
        ("a, *b = 'one two three'.split()\nx = b", ["two", "three"]),
        ("x = ['%s-%d' % ('a', 3), '{}'.format(4)]", ["a-3", "4"]),
        ("x = ['a']\nx.extend(['b'])\nx.insert(0, 'c')", ["c", "a", "b"]),
        (
            "from pathlib import Path\nx = [str(Path('/a') / 'b' / 'c.txt'), Path('/a/b').name]",
            ["/a/b/c.txt", "b"],
        ),
        (
            "i = 0\nx = []\nwhile i < 3:\n    i += 1\n    if i == 2:\n        continue\n"
            "    x.append(str(i))",
            ["1", "3"],
        ),
        ("x = ['a' if 2 > 1 else 'b']", ["a"]),
        (
            "def f(v):\n    try:\n        return str(int(v) + 1)\n"
            "    except (KeyError, ValueError):\n        pass\n    return v\n"
            "x = [f('4'), f('left')]",
            ["5", "left"],
        ),
        (
            "x = []\ntry:\n    try:\n        x += ['%d' % (1 // 0)]\n"
            "    except ValueError:\n        x = ['inner']\n    finally:\n        x += ['end']\n"
            "except ArithmeticError:\n    x += ['outer']",
            ["end", "outer"],
        ),
        ("x = [str(v) for v in sorted({3, 1})]", ["1", "3"]),
        (
            "def f(v):\n    if v == 'a':\n        return 'A'\n    return 'B'\nx = [f('a'), f('b')]",
            ["A", "B"],
        ),
        ("from os import pathsep, path\nx = [path.join('a', 'b') + pathsep]", ["a/b:"]),
    ],
)
def test_python_is_evaluated(read: Read, statements: str, expected: list[str]) -> None:
    node = "return LaunchDescription([Node(package='p', executable='e', arguments=x)])"
    graph = read(f"{statements}\n{node}")
    assert words(graph) == expected
    assert not graph.unread


def test_arguments_have_their_defaults_unless_they_are_given(read: Read) -> None:
    text = """
        return LaunchDescription([
            DeclareLaunchArgument('gui', default_value='true', choices=['true', 'false']),
            DeclareLaunchArgument('name', description='which'),
            Node(package='p', executable='e', arguments=['-n', LaunchConfiguration('name')],
                 condition=IfCondition(LaunchConfiguration('gui'))),
            Node(package='p', executable='f',
                 condition=UnlessCondition(LaunchConfiguration('gui'))),
        ])
        """
    graph = read(text)
    assert [node.starts for node in graph.nodes] == [True, False]
    assert words(graph) == ["-n", "$(var name)"]
    assert [argument.name for argument in graph.arguments] == ["gui", "name"]
    given = read(text, gui="false", name="r2")
    assert [node.starts for node in given.nodes] == [False, True]
    assert words(given) == ["-n", "r2"]


def test_both_branches_are_taken_where_an_argument_decides(read: Read) -> None:
    graph = read(
        """
        def generate_launch_description():
            return LaunchDescription([
                DeclareLaunchArgument('sim', default_value='true'),
                OpaqueFunction(function=setup, args=['x'])])

        def setup(context, word):
            sim = LaunchConfiguration('sim').perform(context) == 'true'
            nodes = []
            if sim:
                nodes.append(Node(package='p', executable='simulated', arguments=[word]))
            else:
                nodes.append(Node(package='p', executable='real'))
            if os.environ['ROBOT'] == 'a':
                nodes.append(Node(package='p', executable='maybe'))
            return nodes
        """
    )
    starts = {node.executable.value: node.starts for node in graph.nodes}
    assert starts == {"simulated": True, "real": False, "maybe": None}
    assert words(graph) == ["x"]
    assert not graph.unread


def test_what_is_chosen_by_an_unknown_test_is_not_known(read: Read) -> None:
    graph = read(
        """
        robot = os.environ['ROBOT']
        name = 'one' if robot == 'a' else 'two'
        common = Node(package='p', executable='common')
        if robot == 'b':
            return LaunchDescription([common, Node(package='p', executable='b')])
        return LaunchDescription([common, Node(package='p', executable='c', arguments=[name])])
        """
    )
    starts = {node.executable.value: node.starts for node in graph.nodes}
    assert starts == {"common": True, "b": None, "c": None}
    assert [unread.reason for unread in graph.unread] == ["depends on \"robot == 'a'\""]


def test_an_include_that_is_left_out_sets_no_argument(read: Read) -> None:
    other = python("return LaunchDescription([])")
    graph = read(
        f"""
        path = PathJoinSubstitution([FindPackageShare('{NAME}'), 'launch', 'other.launch.py'])
        return LaunchDescription([
            DeclareLaunchArgument('robot', default_value='one'),
            IncludeLaunchDescription(PythonLaunchDescriptionSource(path),
                                     launch_arguments={{'robot': 'two'}}.items(),
                                     condition=IfCondition('false')),
            Node(package='p', executable='e', arguments=[LaunchConfiguration('robot')])])
        """,
        others={"launch/other.launch.py": other},
    )
    assert words(graph) == ["one"]


def test_scopes_includes_and_events(read: Read) -> None:
    other = python(
        """
        return LaunchDescription([
            DeclareLaunchArgument('robot', default_value='none'),
            Node(package='p', executable='inner', arguments=[LaunchConfiguration('robot')])])
        """
    )
    graph = read(
        f"""
        first = Node(package='p', executable='first', condition=IfCondition('true'))
        path = PathJoinSubstitution([FindPackageShare('{NAME}'), 'launch', 'other.launch.py'])
        return LaunchDescription([
            SetEnvironmentVariable('GZ_SIM_RESOURCE_PATH', '/a'),
            GroupAction([
                PushRosNamespace('r1'), SetRemap('/tf', 'tf'), SetParameter('use_sim_time', True),
                first,
                IncludeLaunchDescription(PythonLaunchDescriptionSource([path]),
                                         launch_arguments={{'robot': 'r1', 'extra': ''}}.items())]),
            RegisterEventHandler(OnProcessExit(target_action=first, on_exit=[
                Node(package='p', executable='then')])),
            TimerAction(period=5.0, actions=[ExecuteProcess(cmd=['ros2', 'topic', 'list'])]),
            Node(package='p', executable='outside'),
        ])
        """,
        others={"launch/other.launch.py": other},
    )
    placed = {n.executable.value: (n.namespace, n.after, len(n.remaps)) for n in graph.nodes}
    assert placed == {
        "first": ("/r1", False, 1),
        "inner": ("/r1", False, 1),
        "outside": ("/", False, 0),
        "then": ("/", True, 0),
    }
    assert words(graph, 1) == ["r1"]
    (include,) = graph.includes
    assert include.path == "launch/other.launch.py"
    assert include.accepts == frozenset({"robot"})
    assert set(include.arguments) == {"robot", "extra"}
    assert [word.value for word in graph.processes[0].words] == ["ros2", "topic", "list"]
    assert graph.processes[0].after
    assert [(e.name, e.value.value) for e in graph.environment] == [("GZ_SIM_RESOURCE_PATH", "/a")]


def test_components_and_parameter_values(read: Read) -> None:
    graph = read(
        """
        part = ComposableNode(package='image_proc', plugin='image_proc::RectifyNode', name='r')
        text = ParameterValue(Command(['xacro ', 'a.xacro']), value_type=str)
        return LaunchDescription([
            ComposableNodeContainer(package='rclcpp_components', executable='component_container',
                name='box', namespace='', composable_node_descriptions=[part]),
            LoadComposableNodes(target_container='box', composable_node_descriptions=[part]),
            Node(package='p', executable='e', parameters=[{'robot_description': text},
                ParameterFile('x.yaml', allow_substs=True)]),
        ])
        """
    )
    components = graph.nodes[1:3]
    assert [node.executable.value for node in components] == ["image_proc::RectifyNode"] * 2
    assert {node.kind for node in components} == {NodeKind.COMPONENT}
    parameter = graph.nodes[3].parameter("robot_description")
    assert parameter is not None
    assert parameter.as_text
    assert parameter.substituted
    assert parameter.value == "$(command xacro a.xacro)"
    assert graph.nodes[3].parameter_files[0].substitutes


@pytest.mark.parametrize(
    ("expression", "holds"),
    [
        ("'true'", True),
        (
            "PythonExpression(['\\'', LaunchConfiguration('x'), '\\' == \\'a\\' and not False'])",
            True,
        ),
        ("PythonExpression([LaunchConfiguration('n'), ' > 4'])", False),
        ("EnvironmentVariable('GUI')", None),
        ("PythonExpression(['unknown(1)'])", None),
    ],
)
def test_conditions(read: Read, expression: str, holds: bool | None) -> None:
    graph = read(
        f"""
        return LaunchDescription([
            DeclareLaunchArgument('x', default_value='a'),
            DeclareLaunchArgument('n', default_value='3'),
            Node(package='p', executable='e', condition=IfCondition({expression}))])
        """
    )
    assert graph.nodes[0].starts is holds


@pytest.mark.parametrize(
    ("entities", "kind", "name"),
    [
        ("Node(package='p', executable=LaunchConfiguration('x'))", "UNDECLARED_ARGUMENT", "x"),
        (
            "Node(package='p', executable=LaunchConfiguration('x')), "
            "DeclareLaunchArgument('x', default_value='a')",
            "LATE_ARGUMENT",
            "x",
        ),
        ("Node(package='p', node_executable='e')", "ATTRIBUTE", "node_executable"),
        ("Node(package='p')", "ATTRIBUTE", "executable"),
        ("Node(package='p', executable='e', condition=IfCondition('yes'))", "CONDITION", "yes"),
        ("DeclareLaunchArgument('x', default_value='c', choices=['a'])", "UNKNOWN_CHOICE", "x"),
    ],
)
def test_faults(read: Read, entities: str, kind: str, name: str) -> None:
    graph = read(f"return LaunchDescription([{entities}])")
    assert [(fault.kind, fault.name) for fault in graph.faults] == [(LaunchFaultKind[kind], name)]


@pytest.mark.parametrize(
    ("statements", "reason"),
    [
        ("import foo\nx = foo.make()", "foo.make is not evaluated"),
        ("x = open('/etc/passwd').readline()", "readline() is not evaluated"),
        ("x = [v for v in undefined]", "undefined is not defined"),
        ("x = ['a'.encode('rot13')]", "encode"),
        ("x = [eval('1')]", "eval is not defined"),
        ("class A:\n    pass\nx = A()", "class A is not evaluated"),
        ("x = [1 / 0]", "the expression raises ZeroDivisionError"),
        (
            "try:\n    x = [1 / 0]\nexcept KeyError:\n    x = []",
            "the expression raises ZeroDivisionError",
        ),
        (
            f"x = [open('{ROOT}/{NAME}/a.urdf').read().upper()]",
            f"$(file-content $(find-pkg-share {NAME})/a.urdf), which is not known",
        ),
        ("x = ['' + LaunchConfiguration('a')]", "a value that is only known when it is launched"),
    ],
)
def test_what_is_not_evaluated_is_told(read: Read, statements: str, reason: str) -> None:
    node = "return LaunchDescription([Node(package='p', executable='e', arguments=x)])"
    graph = read(f"{statements}\n{node}")
    assert len(graph.nodes) == 1
    assert any(reason in unread.reason for unread in graph.unread)
    assert graph.nodes[0].unread


@pytest.mark.parametrize(
    "statement",
    [
        "open('/tmp/note', 'w').write('started')",
        "import shutil\nshutil.rmtree('/tmp/old')",
        "import yaml\nyaml.dump({'a': 1}, open('/tmp/a.yaml', 'w'))",
        "import re\nre.compile('a').sub('b', 'a')",
    ],
)
def test_what_changes_no_action_is_passed_over(read: Read, statement: str) -> None:
    graph = read(f"{statement}\nreturn LaunchDescription([Node(package='p', executable='e')])")
    assert len(graph.nodes) == 1
    assert not graph.unread


def test_a_recursion_over_an_unknown_value_ends(read: Read) -> None:
    graph = read(
        "import foo\n"
        "def flat(value):\n"
        "    return sum(map(flat, value), []) if isinstance(value, list) else [value]\n"
        "words = flat([foo.style('a')])\n"
        "return LaunchDescription([Node(package='p', executable='e')])"
    )
    assert [node.executable.value for node in graph.nodes] == ["e"]
    assert not any("levels" in unread.reason for unread in graph.unread)


@pytest.mark.parametrize(
    "statement", ["import foo\nfoo.extend(ld)", "os.system('gz sim')", "ld.entities.clear()"]
)
def test_what_may_change_actions_is_told(read: Read, statement: str) -> None:
    graph = read(f"ld = LaunchDescription()\n{statement}\nreturn ld")
    assert graph.unread


def test_the_comments_of_a_robot_may_be_removed(read: Read) -> None:
    graph = read(
        f"""
        import re
        import xacro
        document = xacro.parse(open(get_package_share_directory('{NAME}') + '/a.xacro'))
        xacro.process_doc(document)
        text = re.sub('<!--(.*?)-->', '', document.toxml(), flags=re.DOTALL)
        return LaunchDescription([
            Node(package='p', executable='e', parameters=[{{'robot_description': text}}])])
        """
    )
    parameter = graph.nodes[0].parameter("robot_description")
    assert parameter is not None
    assert str(parameter.value).endswith("/a.xacro)")
    assert not graph.unread


def test_a_robot_whose_text_is_replaced_is_that_of_the_file(read: Read) -> None:
    graph = read(
        f"""
        with open(get_package_share_directory('{NAME}') + '/a.urdf') as file:
            text = file.read().replace('@FOLDER@', '/tmp')
        return LaunchDescription([
            Node(package='p', executable='e', parameters=[{{'robot_description': text}}])])
        """
    )
    parameter = graph.nodes[0].parameter("robot_description")
    assert parameter is not None
    assert str(parameter.value).endswith("/a.urdf replacing)")
    assert not graph.unread


_MOVEIT = f"""
from moveit_configs_utils import MoveItConfigsBuilder
from moveit_configs_utils.launches import generate_demo_launch, generate_spawn_controllers_launch
config = MoveItConfigsBuilder('arm', package_name='{NAME}').to_moveit_configs()
"""
_MOVEIT_FILES = {
    "config/moveit_controllers.yaml": "moveit_simple_controller_manager:\n"
    "  controller_names: [arm_controller]\n",
    "config/arm.srdf": '<robot name="arm"><virtual_joint name="v" type="fixed"'
    ' parent_frame="world" child_link="base"/></robot>',
}


def test_a_description_that_replaces_that_of_moveit(read: Read) -> None:
    graph = read(
        f"""{_MOVEIT}
config.robot_description['robot_description'] = Command(['xacro ', 'a.xacro'])
given = config.robot_description['robot_description']
return LaunchDescription([
    Node(package='p', executable='e', parameters=[{{'robot_description': given}}])])"""
    )
    parameter = graph.nodes[0].parameter("robot_description")
    assert parameter is not None
    assert "a.xacro" in str(parameter.value)
    assert not graph.unread


def test_a_description_that_is_assigned_to_that_of_moveit(read: Read) -> None:
    graph = read(
        f"""{_MOVEIT}
config.robot_description = {{'robot_description': Command(['xacro ', 'a.xacro'])}}
return LaunchDescription([
    Node(package='p', executable='e', parameters=[config.robot_description, 'arm.yaml']),
    Node(package='p', executable='e', parameters=[config.to_dict()])])"""
    )
    for node in graph.nodes:
        parameter = node.parameter("robot_description")
        assert parameter is not None
        assert "a.xacro" in str(parameter.value)
    assert not graph.nodes[0].unread
    assert not graph.unread


def test_imports_of_all_names(read: Read) -> None:
    text = f"""
from launch.substitutions import *
from launch_ros.actions import *
from os.path import *
from {NAME}.parts import *

def generate_launch_description():
    words = [TextSubstitution(text=join('a', 'b'))]
    return LaunchDescription([
        LifecycleNode(package='p', executable=PROGRAM, name='n', namespace='', arguments=words)])
"""
    parts = {f"{NAME}/parts.py": "PROGRAM = 'e'\n_OWN = 1\n", f"{NAME}/__init__.py": ""}
    graph = read(text, others=parts)
    assert graph.nodes[0].executable.value == "e"
    assert words(graph) == ["a/b"]
    assert not graph.unread


def test_the_stock_functions_of_moveit(read: Read) -> None:
    graph = read(f"{_MOVEIT}\nreturn generate_demo_launch(config)", others=_MOVEIT_FILES)
    assert [node.executable.value for node in graph.nodes] == ["ros2_control_node"]
    names = [include.target.value.rpartition("/")[2] for include in graph.includes]
    assert names == [
        f"{name}.launch.py" for name in ("rsp", "move_group", "moveit_rviz", "spawn_controllers")
    ]
    graph = read(
        f"{_MOVEIT}\nreturn generate_spawn_controllers_launch(config)", others=_MOVEIT_FILES
    )
    assert [words(graph, n) for n in (0, 1)] == [["arm_controller"], ["joint_state_broadcaster"]]


@pytest.mark.parametrize(
    ("name", "program"),
    [
        ("rsp", "robot_state_publisher"),
        ("move_group", "move_group"),
        ("moveit_rviz", "rviz2"),
        ("static_virtual_joint_tfs", "static_transform_publisher"),
        ("warehouse_db", "mongo_wrapper_ros.py"),
        ("setup_assistant", "moveit_setup_assistant"),
    ],
)
def test_each_stock_function_of_moveit(read: Read, name: str, program: str) -> None:
    call = f"from moveit_configs_utils.launches import generate_{name}_launch as make"
    graph = read(f"{_MOVEIT}{call}\nreturn make(config)", others=_MOVEIT_FILES)
    assert [node.executable.value for node in graph.nodes] == [program]
    assert graph.nodes[0].starts is True
    assert not graph.unread
    assert not graph.faults


def test_debuggable_nodes_of_moveit(read: Read) -> None:
    graph = read(
        """
        from moveit_configs_utils.launch_utils import DeclareBooleanLaunchArg, add_debuggable_node
        ld = LaunchDescription([DeclareBooleanLaunchArg('debug', default_value=False)])
        add_debuggable_node(ld, package='p', executable='e', arguments=['-x'])
        return ld
        """
    )
    assert [node.starts for node in graph.nodes] == [True]
    assert words(graph) == ["-x"]
    assert not graph.unread


def test_modules_of_packages_at_hand_are_followed(read: Read) -> None:
    graph = read(
        f"""
        def generate_launch_description():
            from {NAME}.helpers import make
            return LaunchDescription([make('a')])
        """,
        others={
            f"{NAME}/helpers.py": "from launch_ros.actions import Node\n"
            "def make(name):\n    return Node(package=name, executable='e')\n"
        },
    )
    assert [node.package.value for node in graph.nodes] == ["a"]


def test_what_a_file_that_is_not_at_hand_declares_is_not_missed(read: Read) -> None:
    graph = read(
        """
        source = PythonLaunchDescriptionSource([FindPackageShare('other'), '/launch/a.launch.py'])
        return LaunchDescription([
            IncludeLaunchDescription(source),
            Node(package='p', executable='e', arguments=[LaunchConfiguration('x')])])
        """
    )
    assert not graph.faults
    assert words(graph) == ["$(var x)"]
    assert graph.includes[0].reason == "package other is not found"


def test_packages_of_both_generations_keep_the_files_of_both(tmp_path: Path) -> None:
    files = {
        "package.xml": PACKAGE_XML.replace("</license>", "</license><depend>catkin</depend>"),
        "launch/one.launch": '<launch><arg name="a"/><include file="$(find p)/b"/></launch>',
        "launch/two.launch": '<launch><node pkg="p" exec="e"/></launch>',
    }
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(exist_ok=True)
        (tmp_path / path).write_text(text)
    with open_input(tmp_path) as opened:
        assert [*launch_files(opened.packages[0])] == ["launch/two.launch"]


@pytest.mark.parametrize("others", [{"Dockerfile": "FROM ros:jazzy\n"}, {}])
def test_the_distribution_that_is_judged_is_that_of_the_environment(
    read: Read, others: dict[str, str]
) -> None:
    graph = read(
        "name = 'new' if os.environ['ROS_DISTRO'] == 'jazzy' else 'old'\n"
        "return LaunchDescription([Node(package='p', executable=name),\n"
        "    Node(package='p', executable=EnvironmentVariable('ROS_DISTRO'))])",
        others=others,
    )
    assert [node.executable.value for node in graph.nodes] == ["new", "jazzy"]


def test_a_variable_is_what_the_readme_tells_to_export(read: Read) -> None:
    graph = read(
        "model = os.environ['LIDAR']\n"
        "if model == 'flat':\n"
        "    name = 'flat_driver'\n"
        "else:\n"
        "    name = 'deep_driver'\n"
        "return LaunchDescription([Node(package='p', executable=name)])",
        others={"README.md": "```\necho 'export LIDAR=deep' >> ~/.bashrc\n```\n"},
    )
    assert [node.executable.value for node in graph.nodes] == ["deep_driver"]
    assert not graph.unread


@pytest.mark.parametrize("given", ["'config/arm.srdf'", "os.path.join(SHARE, 'config/arm.srdf')"])
def test_the_files_of_moveit_are_read(given: str, read: Read) -> None:
    graph = read(
        f"""from moveit_configs_utils import MoveItConfigsBuilder
SHARE = get_package_share_directory('{NAME}')
builder = MoveItConfigsBuilder('arm', package_name='{NAME}')
builder.robot_description(mappings={{'tool': 'none'}})
config = builder.robot_description_semantic(file_path={given}).to_moveit_configs()
text = config.robot_description['robot_description'].replace('old', 'new')
return LaunchDescription([
    Node(package='p', executable='e', parameters=[{{'robot_description': text}}])])""",
        others={"config/arm.urdf.xacro": "<robot/>", "config/arm.srdf": "<robot/>"},
    )
    paths = [use.text.value for use in graph.files]
    assert f"{ROOT}/{NAME}/config/arm.srdf" in paths
    assert f"{ROOT}/{NAME}/config/kinematics.yaml" in paths
    (parameter,) = graph.nodes[0].parameters
    assert isinstance(parameter, Parameter)
    assert str(parameter.value).endswith("config/arm.urdf.xacro tool:=none)")
    assert not parameter.substituted  # a text is not parsed as YAML


def test_a_file_named_launch_may_be_in_python(read: Read, tmp_path: Path) -> None:
    text = python("return LaunchDescription([Node(package='rviz2', executable='rviz2')])")
    graph = read(text, "launch/arm.launch")
    assert [node.package.value for node in graph.nodes] == ["rviz2"]
    assert not graph.faults
    with open_input(tmp_path / NAME) as opened:
        assert [*launch_files(opened.packages[0])] == ["launch/arm.launch"]
