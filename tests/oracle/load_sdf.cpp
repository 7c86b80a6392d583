// Prints the model that libsdformat makes of each file named on standard input: one line of JSON
// a file, either its errors or its links, joints and frames, with poses in the frame of the
// outermost model. With `--elements` also all that it holds, as SDF of its newest version.

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>

#include <ignition/math/Pose3.hh>
#include <sdf/sdf.hh>

using ignition::math::Pose3d;
using ignition::math::Vector3d;

static std::string Quoted(const std::string &text)
{
  std::ostringstream out;
  out << '"';
  for (unsigned char c : text)
  {
    if (c == '"' || c == '\\') out << '\\' << c;
    else if (c < 0x20) out << "\\u" << std::hex << std::setw(4) << std::setfill('0') << int(c) << std::dec;
    else out << c;
  }
  out << '"';
  return out.str();
}

static std::string Number(double value)
{
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
  std::ostringstream out;
  out << std::setprecision(17) << value;
  return out.str();
}

static std::string Numbers(std::initializer_list<double> values)
{
  std::string out = "[";
  for (double value : values) out += (out.size() > 1 ? "," : "") + Number(value);
  return out + "]";
}

static std::string Pose(const Pose3d &p)
{
  return Numbers({p.X(), p.Y(), p.Z(), p.Rot().W(), p.Rot().X(), p.Rot().Y(), p.Rot().Z()});
}

// A pose of something in a model, in the frame of the outermost model; null where it has none.
static std::string Placed(const sdf::SemanticPose &semantic, const Pose3d &model, const std::string &in)
{
  Pose3d pose;
  return semantic.Resolve(pose, in).empty() ? Pose(model * pose) : "null";
}

static std::string Axis(const sdf::Joint &joint, const sdf::JointAxis &axis, const Pose3d &model)
{
  Vector3d xyz;
  bool known = axis.ResolveXyz(xyz, "__model__").empty();
  Vector3d placed = model.Rot().RotateVector(xyz);
  return "{\"xyz\":" + (known ? Numbers({placed.X(), placed.Y(), placed.Z()}) : "null") +
    ",\"limits\":" + Numbers({axis.Lower(), axis.Upper(), axis.Effort(), axis.MaxVelocity()}) +
    ",\"dynamics\":" + Numbers({axis.Damping(), axis.Friction(), axis.SpringStiffness()}) + "}";
}

static std::string Link(const sdf::Link &link, const Pose3d &model, const std::string &scope)
{
  const auto &inertial = link.Inertial();
  const auto &mass = inertial.MassMatrix();
  auto d = mass.DiagonalMoments();
  auto o = mass.OffDiagonalMoments();
  return "{\"name\":" + Quoted(scope + link.Name()) +
    ",\"pose\":" + Placed(link.SemanticPose(), model, "__model__") +
    ",\"mass\":" + Number(mass.Mass()) +
    ",\"moments\":" + Numbers({d.X(), o.X(), o.Y(), d.Y(), o.Z(), d.Z()}) +
    ",\"centre\":" + Pose(inertial.Pose()) +
    ",\"collisions\":" + std::to_string(link.CollisionCount()) +
    ",\"visuals\":" + std::to_string(link.VisualCount()) +
    ",\"sensors\":" + std::to_string(link.SensorCount()) + "}";
}

static std::string Joint(const sdf::Joint &joint, const Pose3d &model, const std::string &scope)
{
  std::string parent, child, axes;
  joint.ResolveParentLink(parent);
  joint.ResolveChildLink(child);
  for (unsigned int i = 0; i < 2; ++i)
    if (const auto *axis = joint.Axis(i)) axes += (axes.empty() ? "" : ",") + Axis(joint, *axis, model);
  if (parent != "world") parent = scope + parent;
  return "{\"name\":" + Quoted(scope + joint.Name()) +
    ",\"type\":" + std::to_string(static_cast<int>(joint.Type())) +
    ",\"parent\":" + Quoted(parent) + ",\"child\":" + Quoted(scope + child) +
    ",\"pose\":" + Placed(joint.SemanticPose(), model, "__model__") +
    ",\"axes\":[" + axes + "]}";
}

struct Parts { std::string links, joints, frames, models; };

static void Add(std::string &list, const std::string &item)
{
  list += (list.empty() ? "" : ",") + item;
}

static void Collect(const sdf::Model &model, const Pose3d &at, const std::string &scope, Parts &parts)
{
  for (uint64_t i = 0; i < model.LinkCount(); ++i)
    Add(parts.links, Link(*model.LinkByIndex(i), at, scope));
  for (uint64_t i = 0; i < model.JointCount(); ++i)
    Add(parts.joints, Joint(*model.JointByIndex(i), at, scope));
  for (uint64_t i = 0; i < model.FrameCount(); ++i)
  {
    const auto &frame = *model.FrameByIndex(i);
    Add(parts.frames, "{\"name\":" + Quoted(scope + frame.Name()) + ",\"pose\":" +
        Placed(frame.SemanticPose(), at, "__model__") + "}");
  }
  for (uint64_t i = 0; i < model.ModelCount(); ++i)
  {
    const auto &inner = *model.ModelByIndex(i);
    Pose3d pose;
    inner.SemanticPose().Resolve(pose, "__model__");
    Add(parts.models, "{\"name\":" + Quoted(scope + inner.Name()) + ",\"pose\":" + Pose(at * pose) + "}");
    Collect(inner, at * pose, scope + inner.Name() + "::", parts);
  }
}

static std::string Robot(const sdf::Model &model)
{
  Parts parts;
  Collect(model, Pose3d::Zero, "", parts);
  return "{\"name\":" + Quoted(model.Name()) + ",\"static\":" + (model.Static() ? "true" : "false") +
    ",\"links\":[" + parts.links + "],\"joints\":[" + parts.joints +
    "],\"frames\":[" + parts.frames + "],\"models\":[" + parts.models + "]}";
}

static std::string Loaded(const std::string &path, bool elements)
{
  // The global one: libsdformat 12 reads what a merged model includes with that.
  auto &config = sdf::ParserConfig::GlobalConfig();
  // Models beside the file's own folder, as `model://name` or by their bare names.
  auto folder = path.substr(0, path.rfind('/'));
  auto above = folder.substr(0, folder.rfind('/'));
  config.SetFindCallback([folder, above](const std::string &uri) {
    auto name = uri.rfind("model://", 0) == 0 ? uri.substr(8) : uri;
    for (const auto &start : {above, folder})
      if (sdf::filesystem::exists(start + "/" + name)) return start + "/" + name;
    return std::string();
  });
  sdf::Root root;
  std::string errors, robots;
  for (const auto &error : root.Load(path, config))
    Add(errors, "{\"code\":" + std::to_string(static_cast<int>(error.Code())) +
      ",\"message\":" + Quoted(error.Message()) + ",\"file\":" + Quoted(error.FilePath().value_or("")) +
      ",\"line\":" + std::to_string(error.LineNumber().value_or(0)) + "}");
  if (errors.empty())
  {
    if (root.Model()) Add(robots, Robot(*root.Model()));
    for (uint64_t i = 0; i < root.WorldCount(); ++i)
      for (uint64_t j = 0; j < root.WorldByIndex(i)->ModelCount(); ++j)
        Add(robots, Robot(*root.WorldByIndex(i)->ModelByIndex(j)));
  }
  auto text = elements && errors.empty() ? root.Element()->ToString("") : "";
  return "{\"errors\":[" + errors + "],\"robots\":[" + robots + "],\"elements\":" + Quoted(text) + "}";
}

int main(int argc, char **argv)
{
  sdf::Console::Instance()->SetQuiet(true);
  bool elements = argc > 1 && std::string(argv[1]) == "--elements";
  for (std::string path; std::getline(std::cin, path);)
    std::cout << Loaded(path, elements) << std::endl;
}
