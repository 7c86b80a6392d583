# Starts the rover.

def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  wheel_base = 0.3
  <<-HEREDOC
<spawn name='#{_name}'>
  <name>${_name}</name>
  <allow_renaming>true</allow_renaming>
  <pose>#{_x} #{_y} #{_z + 2.0} #{_roll} #{_pitch} 0</pose>
  <world>#{_worldName}</world>
  <sdf version='1.6'>
    <include>
      <name>#{_name}</name>
      <uri>model://broken_rover_sensor_config_1</uri>
      <plugin filename="libignition-gazebo-linearbatteryplugin-system.so"
              name="ignition::gazebo::systems::LinearBatteryPlugin">
        <battery_name>linear_battery</battery_name>
        <voltage>12.694</voltage>
        <open_circuit_voltage_constant_coef>12.694</open_circuit_voltage_constant_coef>
        <open_circuit_voltage_linear_coef>-3.1424</open_circuit_voltage_linear_coef>
        <initial_charge>78.4</initial_charge>
        <capacity>78.4</capacity>
        <resistance>0.061523</resistance>
        <smooth_current_tau>1.9499</smooth_current_tau>
        <power_load>2.0</power_load>
      </plugin>
      <plugin filename="libignition-gazebo-diff-drive-system.so"
              name="ignition::gazebo::systems::DiffDrive">
        <left_joint>front_left_joint</left_joint>
        <left_joint>rear_left_wheel</left_joint>
        <right_joint>front_right_joint</right_joint>
        <right_joint>rear_right_joint</right_joint>
        <wheel_separation>0.15</wheel_separation>
        <wheel_radius>0.14</wheel_radius>
        <topic>/model/rover/cmd_vel_relay</topic>
        <odometry_topic>/model/#{_name}/odometry</odometry_topic>
        <min_velocity>-1</min_velocity>
        <max_velocity>2</max_velocity>
      </plugin>
      <plugin filename="libignition-gazebo-wheel-slip-system.so"
              name="ignition::gazebo::systems::WheelSlip">
        <wheel link_name="front_left_wheel">
          <slip_compliance_lateral>0</slip_compliance_lateral>
          <slip_compliance_longitudinal>0</slip_compliance_longitudinal>
          <wheel_normal_force>300</wheel_normal_force>
          <wheel_radius>0.2</wheel_radius>
        </wheel>
        <wheel link_name="front_right_tyre">
          <slip_compliance_lateral>0.1</slip_compliance_lateral>
          <slip_compliance_longitudinal>0</slip_compliance_longitudinal>
          <wheel_normal_force>30</wheel_normal_force>
          <wheel_radius>0.1</wheel_radius>
        </wheel>
      </plugin>
      <plugin filename="libignition-gazebo-pose-publisher-system.so"
              name="ignition::gazebo::systems::PosePublisher">
        <publish_link_pose>true</publish_link_pose>
        <publish_sensor_pose>true</publish_sensor_pose>
        <publish_nested_model_pose>true</publish_nested_model_pose>
        <static_pose_publisher>true</static_pose_publisher>
      </plugin>
      <plugin filename="libignition-gazebo-joint-state-publisher-system.so"
              name="ignition::gazebo::systems::JointStatePublisher"/>
      <plugin filename="libignition-gazebo-joint-controller-system.so"
              name="ignition::gazebo::systems::JointPositionController">
        <joint_name>mast_joint</joint_name>
      </plugin>
      <plugin filename="libGrubbyGripper.so" name="grubby::Gripper"/>
      <plugin filename="libignition-gazebo-breadcrumbs-system.so"
              name="ignition::gazebo::systems::Breadcrumbs">
        <topic>/model/#{_name}/breadcrumb/deploy</topic>
        <max_deployments>7</max_deployments>
        <breadcrumb>
          <sdf version="1.6">
            <model name="#{_name}__breadcrumb__">
              <pose>0 0 0.05 0 0 0</pose>
              <include>
                <uri>https://fuel.ignitionrobotics.org/1.0/OpenRobotics/models/Breadcrumb Node</uri>
              </include>
            </model>
          </sdf>
        </breadcrumb>
      </plugin>
    </include>
  </sdf>
</spawn>
the rover ends here
  HEREDOC
end

def rosExecutables(_name)
  <<-HEREDOC
<executable name='robot_description'>
  <command>roslaunch --wait x1_sensor_config_6 description.launch name:=#{_name}</command>
</executable>
<executable name='topics'>
  <command>roslaunch --wait broken_rover_sensor_config_1 vehicle_topics.launch</command>
</executable>
  HEREDOC
end
