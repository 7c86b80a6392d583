"""Classes of the launch system, and the names of the arguments that they take by position."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

ROOTS = frozenset(
    {"launch", "launch_ros", "launch_xml", "launch_yaml", "launch_param_builder", "nav2_common"}
    | {"ros_gz_bridge", "ros_gz_sim", "launch_testing", "launch_testing_ros"}
)
"""Python packages whose classes are meant."""

SUBSTITUTIONS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "TextSubstitution": (),
        "LaunchConfiguration": ("variable_name",),
        "PathJoinSubstitution": ("substitutions",),
        "PathSubstitution": ("path",),
        "FindPackageShare": ("package",),
        "FindPackagePrefix": ("package",),
        "FindPackage": ("package",),
        "FindExecutable": (),
        "ExecutableInPackage": ("executable", "package"),
        "Command": ("command",),
        "PythonExpression": ("expression", "python_modules"),
        "EnvironmentVariable": ("name",),
        "AnonName": ("name",),
        "ThisLaunchFile": (),
        "ThisLaunchFileDir": (),
        "LaunchLogDir": (),
        "LocalSubstitution": ("expression",),
        "FileContent": ("path",),
        "StringJoinSubstitution": ("substitutions", "delimiter"),
        "IfElseSubstitution": ("condition", "if_value", "else_value"),
        "EqualsSubstitution": ("left", "right"),
        "NotEqualsSubstitution": ("left", "right"),
        "AndSubstitution": ("left", "right"),
        "OrSubstitution": ("left", "right"),
        "NotSubstitution": ("value",),
        "AnySubstitution": (),
        "AllSubstitution": (),
        "BooleanSubstitution": ("value",),
        "Parameter": ("name",),
        "RewrittenYaml": ("source_file", "param_rewrites", "root_key", "key_rewrites"),
        "ReplaceString": ("source_file", "replacements"),
    }
)
"""Substitutions that a text may contain."""

ACTIONS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "LaunchDescription": ("initial_entities",),
        "DeclareLaunchArgument": ("name",),
        "SetLaunchConfiguration": ("name", "value"),
        "UnsetLaunchConfiguration": ("name",),
        "ResetLaunchConfigurations": ("launch_configurations",),
        "Node": (),
        "LifecycleNode": (),
        "ComposableNodeContainer": (),
        "ComposableNode": (),
        "LoadComposableNodes": (),
        "ExecuteProcess": (),
        "ExecuteLocal": (),
        "IncludeLaunchDescription": ("launch_description_source",),
        "GroupAction": ("actions",),
        "PushRosNamespace": ("namespace",),
        "PushROSNamespace": ("namespace",),
        "SetParameter": ("name", "value"),
        "SetParametersFromFile": ("filename",),
        "SetRemap": ("src", "dst"),
        "SetUseSimTime": ("value",),
        "SetEnvironmentVariable": ("name", "value"),
        "AppendEnvironmentVariable": ("name", "value"),
        "UnsetEnvironmentVariable": ("name",),
        "ResetEnvironment": (),
        "RegisterEventHandler": ("event_handler",),
        "UnregisterEventHandler": ("event_handler",),
        "TimerAction": (),
        "RosTimer": (),
        "ROSTimer": (),
        "OpaqueFunction": (),
        "LogInfo": (),
        "EmitEvent": (),
        "Shutdown": (),
        "PushLaunchConfigurations": (),
        "PopLaunchConfigurations": (),
        "PushEnvironment": (),
        "PopEnvironment": (),
        "SetROSLogDir": ("new_log_dir",),
        "RosGzBridge": (),
        "GzServer": (),
    }
)
"""Actions that a launch description may contain."""

OTHERS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "PythonLaunchDescriptionSource": ("launch_file_path",),
        "AnyLaunchDescriptionSource": ("launch_file_path",),
        "FrontendLaunchDescriptionSource": ("launch_file_path",),
        "XMLLaunchDescriptionSource": ("launch_file_path",),
        "YAMLLaunchDescriptionSource": ("launch_file_path",),
        "LaunchDescriptionSource": ("launch_description", "location"),
        "IfCondition": ("predicate_expression",),
        "UnlessCondition": ("predicate_expression",),
        "LaunchConfigurationEquals": ("launch_configuration_name", "expected_value"),
        "LaunchConfigurationNotEquals": ("launch_configuration_name", "expected_value"),
        "EqualsCondition": ("left", "right"),
        "ParameterValue": ("value",),
        "ParameterFile": ("param_file",),
        "OnProcessExit": (),
        "OnProcessStart": (),
        "OnProcessIO": (),
        "OnExecutionComplete": (),
        "OnShutdown": (),
        "OnStateTransition": (),
        "OnIncludeLaunchDescription": (),
        "EventHandler": (),
        "ComposableNodeDescription": (),
    }
)
"""Sources of included files, conditions, parameters, event handlers."""

CLASSES: Mapping[str, tuple[str, ...]] = MappingProxyType({**SUBSTITUTIONS, **ACTIONS, **OTHERS})
