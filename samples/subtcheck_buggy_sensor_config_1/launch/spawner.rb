# What the competition needs to start this robot: its SDF with the plugins, and its ROS nodes.

def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-SDF
<spawn name="#{_name}">
  <name>#{_name}</name>
  <allow_renaming>false</allow_renaming>
  <!-- The wheels reach 0.1 m below base_link: they start 50 mm above the ground. -->
  <pose>#{_x} #{_y} #{_z + 0.15} #{_roll} #{_pitch} #{_yaw}</pose>
  <world>#{_worldName}</world>
  <is_performer>true</is_performer>
  <sdf version="1.6">
    <include>
      <name>#{_name}</name>
      <uri>#{_modelURI}</uri>
        <!-- All four wheels are driven, the front ones steered. -->
        <plugin filename="libignition-gazebo-ackermann-steering-system.so"
                name="ignition::gazebo::systems::AckermannSteering">
          <left_joint>front_left_wheel_joint</left_joint>
          <left_joint>rear_left_wheel_joint</left_joint>
          <right_joint>front_right_wheel_joint</right_joint>
          <right_joint>rear_right_wheel_joint</right_joint>
          <left_steering_joint>left_steering_joint</left_steering_joint>
          <right_steering_joint>right_steering_joint</right_steering_joint>
          <kingpin_width>0.3</kingpin_width>
          <steering_limit>0.5</steering_limit>
          <wheel_base>0.5</wheel_base>
          <wheel_separation>0.4</wheel_separation>
          <wheel_radius>0.1</wheel_radius>
          <topic>/model/#{_name}/cmd_vel_relay</topic>
          <min_velocity>-1</min_velocity>
          <max_velocity>1</max_velocity>
          <min_acceleration>-2</min_acceleration>
          <max_acceleration>2</max_acceleration>
        </plugin>
        <!-- Where the parts are; the true pose only when the organisers ask for it. -->
        <plugin filename="libignition-gazebo-pose-publisher-system.so"
                name="ignition::gazebo::systems::PosePublisher">
          <publish_link_pose>true</publish_link_pose>
          <publish_sensor_pose>true</publish_sensor_pose>
          <publish_collision_pose>false</publish_collision_pose>
          <publish_visual_pose>false</publish_visual_pose>
          <publish_nested_model_pose>#{$enableGroundTruth}</publish_nested_model_pose>
          <use_pose_vector_msg>true</use_pose_vector_msg>
          <static_publisher>true</static_publisher>
          <static_update_frequency>1</static_update_frequency>
        </plugin>
        <plugin filename="libGasEmitterDetectorPlugin.so" name="subt::GasDetector">
          <topic>/model/#{_name}/gas_detected</topic>
          <update_rate>10</update_rate>
          <type>gas</type>
        </plugin>
        <!-- One hour; it drains from the first command on. -->
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
          <power_load>9.9</power_load>
          <power_draining_topic>/model/#{_name}/cmd_vel_relay</power_draining_topic>
        </plugin>
    </include>
  </sdf>
</spawn>
  SDF
end

def rosExecutables(_name, _worldName)
  <<-EXECUTABLES
<executable name="robot_description">
  <command>roslaunch --wait subtcheck_buggy_sensor_config_1 description.launch world_name:=#{_worldName} name:=#{_name}</command>
</executable>
<executable name="topics">
  <command>roslaunch --wait subtcheck_buggy_sensor_config_1 vehicle_topics.launch world_name:=#{_worldName} name:=#{_name}</command>
</executable>
  EXECUTABLES
end
