// Drives a robot in the physics of Gazebo Fortress: ign-physics 5 with its DART plugin, loaded and
// commanded as the systems Physics, DiffDrive and JointPositionController do it, without Gazebo.
//
//   drive MODEL HEIGHT SECONDS GRAVITY FOLDER... < COMMANDS
//
// MODEL is an SDF or URDF file; its frame starts HEIGHT metres above a plane. GRAVITY is "x y z" in
// m/s²; where it is not vertical, the plane is a slope. Folders hold what
// `model://` and `package://` name. Each command is a line "speed JOINT TIME VALUE TIME VALUE …" or
// "place …": piecewise linear, rad/s, rad or m. A sample each 50 ms is a line of CSV: the time, the
// pose of the model's frame (x y z qw qx qy qz).

#include <filesystem>
#include <iostream>
#include <sstream>
#include <vector>

#include <ignition/common/Mesh.hh>
#include <ignition/common/MeshManager.hh>
#include <ignition/math/eigen3/Conversions.hh>
#include <ignition/physics/FrameSemantics.hh>
#include <ignition/physics/ForwardStep.hh>
#include <ignition/physics/GetEntities.hh>
#include <ignition/physics/Joint.hh>
#include <ignition/physics/RequestEngine.hh>
#include <ignition/physics/mesh/MeshShape.hh>
#include <ignition/physics/sdf/ConstructModel.hh>
#include <ignition/physics/sdf/ConstructWorld.hh>
#include <ignition/plugin/Loader.hh>
#include <sdf/sdf.hh>

namespace physics = ignition::physics;
namespace math = ignition::math;
namespace fs = std::filesystem;

using Features = physics::FeatureList<
    physics::ForwardStep, physics::GetEntities, physics::LinkFrameSemantics,
    physics::GetBasicJointState, physics::SetJointVelocityCommandFeature,
    physics::mesh::AttachMeshShapeFeature, physics::sdf::ConstructSdfModel,
    physics::sdf::ConstructSdfWorld>;

static const double STEP = 0.001;    // seconds, Gazebo's default
static const int EVERY = 50;         // steps between samples
static const double GAIN = 10.0;     // 1/s, of commanded places

static const char *WORLD = R"(<sdf version="1.9"><world name="flat">
  <gravity>GRAVITY</gravity>
  <physics name="1ms" type="ode"><max_step_size>0.001</max_step_size></physics>
  <model name="ground"><static>true</static><link name="link"><collision name="plane">
    <geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry>
  </collision></link></model>
  <include><uri>ROBOT</uri><name>robot</name><pose>0 0 HEIGHT 0 0 0</pose></include>
</world></sdf>)";

struct Command
{
  bool speed;
  physics::Joint3dPtr<Features> joint;
  std::vector<std::pair<double, double>> knots;

  double At(double time) const
  {
    for (size_t i = 1; i < knots.size(); ++i)
      if (time < knots[i].first)
      {
        auto [t, v] = knots[i - 1];
        auto [u, w] = knots[i];
        return u > t ? v + (w - v) * (time - t) / (u - t) : w;
      }
    return knots.back().second;
  }
};

static std::string Found(std::string uri, const std::vector<fs::path> &folders)
{
  if (auto scheme = uri.find("://"); scheme != std::string::npos) uri = uri.substr(scheme + 3);
  if (fs::exists(uri)) return uri;
  for (auto &folder : folders)
    if (fs::exists(folder / uri)) return folder / uri;
  return "";
}

// The DART plugin leaves meshes to its user; like Gazebo's, none of their surfaces' friction counts.
static void AttachMeshes(const sdf::Model &model, physics::Model3dPtr<Features> made,
                         const std::vector<fs::path> &folders)
{
  for (uint64_t l = 0; l < model.LinkCount(); ++l)
  {
    auto &link = *model.LinkByIndex(l);
    for (uint64_t c = 0; c < link.CollisionCount(); ++c)
    {
      auto &collision = *link.CollisionByIndex(c);
      auto *shape = collision.Geom()->MeshShape();
      if (!shape) continue;
      auto *mesh = ignition::common::MeshManager::Instance()->Load(Found(shape->Uri(), folders));
      math::Pose3d pose;
      if (!mesh || !collision.SemanticPose().Resolve(pose, link.Name()).empty())
        throw std::runtime_error("mesh '" + shape->Uri() + "' is not loaded");
      made->GetLink(link.Name())->AttachMeshShape(
          collision.Name(), *mesh, math::eigen3::convert(pose), math::eigen3::convert(shape->Scale()));
    }
  }
}

static void Read(std::istream &in, physics::Model3dPtr<Features> made, std::vector<Command> &commands)
{
  for (std::string line; std::getline(in, line);)
  {
    std::istringstream words(line);
    std::string kind, name;
    words >> kind >> name;
    auto joint = made->GetJoint(name);
    if (!joint) throw std::runtime_error("joint '" + name + "' does not exist");
    Command command{kind == "speed", joint, {}};
    for (double time, value; words >> time >> value;) command.knots.emplace_back(time, value);
    commands.push_back(command);
  }
}

int main(int count, char **words) try
{
  std::vector<fs::path> folders(words + 5, words + count);
  folders.push_back(fs::path(words[1]).parent_path());
  sdf::setFindCallback([&](const std::string &uri) { return Found(uri, folders); });

  ignition::plugin::Loader loader;
  loader.LoadLib("libignition-physics5-dartsim-plugin.so");
  auto plugin = loader.Instantiate("ignition::physics::dartsim::Plugin");
  auto engine = physics::RequestEngine3d<Features>::From(plugin);
  if (!engine) throw std::runtime_error("the DART plugin lacks features");

  std::string text = WORLD;
  text.replace(text.find("ROBOT"), 5, fs::absolute(words[1]));
  text.replace(text.find("HEIGHT"), 6, words[2]);
  text.replace(text.find("GRAVITY"), 7, words[4]);
  sdf::Root root;
  for (auto &error : root.LoadSdfString(text)) throw std::runtime_error(error.Message());
  auto &model = *root.WorldByIndex(0)->ModelByName("robot");
  auto [canonical, name] = model.CanonicalLinkAndRelativeName();
  auto world = engine->ConstructWorld(*root.WorldByIndex(0));
  auto made = world ? world->GetModel("robot") : nullptr;
  if (!made) throw std::runtime_error("the model is refused");
  AttachMeshes(model, made, folders);
  std::vector<Command> commands;
  Read(std::cin, made, commands);

  math::Pose3d in_model;
  canonical->SemanticPose().Resolve(in_model, "__model__");
  auto base = made->GetLink(name);
  physics::ForwardStep::Input input;
  input.Get<std::chrono::steady_clock::duration>() = std::chrono::milliseconds(1);
  physics::ForwardStep::State state;
  physics::ForwardStep::Output output;
  const int steps = std::lround(std::stod(words[3]) / STEP);
  for (int step = 0; step <= steps; ++step)
  {
    if (step % EVERY == 0)
    {
      auto frame = base->FrameDataRelativeToWorld().pose;
      auto pose = math::eigen3::convert(frame) * in_model.Inverse();
      std::cout << step * STEP << ',' << pose.Pos().X() << ',' << pose.Pos().Y() << ',' << pose.Pos().Z()
                << ',' << pose.Rot().W() << ',' << pose.Rot().X() << ',' << pose.Rot().Y() << ','
                << pose.Rot().Z() << '\n';
    }
    for (auto &command : commands)
    {
      double wanted = command.At(step * STEP);
      if (!command.speed) wanted = GAIN * (wanted - command.joint->GetPosition(0));
      command.joint->SetVelocityCommand(0, wanted);
    }
    world->Step(output, state, input);
  }
}
catch (const std::exception &error)
{
  std::cerr << error.what() << '\n';
  return 1;
}
