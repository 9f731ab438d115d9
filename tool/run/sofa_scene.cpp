// The collision part of a scene of SOFA, a .scn file (pugixml).
#include "tool/run/sofa_scene.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <pugixml.hpp>
#include <sstream>
#include <unordered_map>
#include <variant>

#include "formats/input_error.hpp"
#include "formats/json.hpp"
#include "formats/whole_number.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

namespace fs = std::filesystem;
using formats::InputError;
using formats::Location;
using pugi::xml_node;

using Quaternions = std::vector<Eigen::Quaterniond>;
using Pipelines = std::shared_ptr<const std::set<std::string>>;

constexpr std::size_t kDeepest = 100;  // scenes of SOFA nest some ten deep
constexpr std::size_t kMostSpheres =
    10'000'000;  // of a file: a model takes all positions of its state, which may be a grid's

/// What SOFA's loaders and states hold before the first step.
struct Positions {
  std::vector<Vector3> centers;
  std::optional<Quaternions> orientations;  ///< of a rigid state, one a centre
};
struct Spheres {
  std::vector<Vector3> centers;
  std::vector<double> radii;
};
/// Why something is not read.
struct Unread {
  std::string why;
};
template <class T>
using Read = std::variant<T, Unread>;

template <class T>
const Unread* unread(const Read<T>& read) {
  return std::get_if<Unread>(&read);
}

bool is_node(const xml_node& element) { return std::string_view(element.name()) == "Node"; }
bool is(const xml_node& element, std::string_view type) { return element.name() == type; }

/// A value as a message has it: its beginning.
std::string excerpt(std::string_view text) {
  constexpr std::size_t kMost = 60;
  return text.size() <= kMost ? std::string(text) : fmt::format("{}...", text.substr(0, kMost));
}

/// From Euler angles in degrees, about x, then y, then z.
Eigen::Quaterniond turn(const Vector3& degrees) {
  const Eigen::Vector3d half = degrees * std::numbers::pi / 180.0 / 2;
  const Eigen::Array3d c = half.array().cos();
  const Eigen::Array3d s = half.array().sin();
  return {c[0] * c[1] * c[2] + s[0] * s[1] * s[2], s[0] * c[1] * c[2] - c[0] * s[1] * s[2],
          c[0] * s[1] * c[2] + s[0] * c[1] * s[2], c[0] * c[1] * s[2] - s[0] * s[1] * c[2]};
}

class Reader {
 public:
  Reader(const std::string& path, const ModelFactory& factory)
      : path_(path), text_(formats::read_text(path)), factory_(factory) {
    for (std::size_t at = text_.find('\n'); at != std::string::npos; at = text_.find('\n', at + 1))
      feeds_.push_back(at);
  }

  SofaScene read() {
    const auto parsed = document_.load_buffer(text_.data(), text_.size());
    if (!parsed)
      throw InputError(at_offset(parsed.offset), "", std::string("not well-formed XML: ") + parsed.description());
    const xml_node root = document_.child("Node");
    if (!root) throw InputError({path_, 0}, "", "a scene of SOFA is a <Node>, and here is none");
    require_shallow();
    read_distances(root);
    find_pipelines(root);
    read_node(root, "", pipelines_.empty() ? nullptr : std::make_shared<const std::set<std::string>>());
    return std::move(scene_);
  }

 private:
  [[nodiscard]] Location at_offset(std::ptrdiff_t offset) const {
    const std::size_t at = formats::whole_number<std::size_t>(offset).value_or(0);
    return {path_, 1 + static_cast<std::size_t>(std::lower_bound(feeds_.begin(), feeds_.end(), at) - feeds_.begin())};
  }
  [[nodiscard]] Location where(const xml_node& element) const { return at_offset(element.offset_debug()); }

  /// What follows calls itself once for each element that another stands in.
  void require_shallow() const {
    std::size_t depth = 0;
    for (xml_node at = document_.first_child(); at;) {
      if (const xml_node below = at.first_child()) {
        if (++depth > kDeepest)
          throw InputError(where(at), "", fmt::format("elements stand more than {} deep in each other", kDeepest));
        at = below;
        continue;
      }
      for (; at && !at.next_sibling(); --depth) {
        at = at.parent();
        if (depth == 0) return;
      }
      at = at.next_sibling();
    }
  }

  void tell(const xml_node& element, std::string_view what) {
    ++scene_.left_out.all;
    if (scene_.left_out.is_full()) return;
    const std::string_view name = element.attribute("name").value();
    scene_.left_out.first.push_back(fmt::format("{}: {}{} {}", where(element).text(), excerpt(element.name()),
                                                name.empty() ? "" : fmt::format(" '{}'", excerpt(name)), what));
  }
  void leave_out(const xml_node& element, const std::string& why) { tell(element, "is not read: " + why); }

  // Attributes.

  [[nodiscard]] std::vector<double> numbers(const xml_node& element, const char* key) const {
    const std::string_view text = element.attribute(key).value();
    std::vector<double> all;
    const auto space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ','; };
    for (const char* at = text.data(); at != text.data() + text.size();) {
      if (space(*at)) {
        ++at;
        continue;
      }
      const char* end = std::find_if(at, text.data() + text.size(), space);
      double x = 0;
      const char* digits = *at == '+' ? at + 1 : at;
      const auto [stop, error] = std::from_chars(digits, end, x);
      if (error != std::errc() || stop != end || !std::isfinite(x))
        throw InputError(where(element), key, fmt::format("expected finite numbers, got '{}'", excerpt({at, end})));
      all.push_back(x);
      at = end;
    }
    return all;
  }
  [[nodiscard]] double number(const xml_node& element, const char* key, double otherwise) const {
    if (!element.attribute(key)) return otherwise;
    const auto all = numbers(element, key);
    if (all.size() != 1)
      throw InputError(where(element), key,
                       fmt::format("expected a number, got '{}'", excerpt(element.attribute(key).value())));
    return all.front();
  }
  /// SOFA reads these attributes as single precision, and as no more than their first number.
  [[nodiscard]] double single(const xml_node& element, const char* key, double otherwise) const {
    const auto all = numbers(element, key);
    return static_cast<double>(static_cast<float>(all.empty() ? otherwise : all.front()));
  }
  [[nodiscard]] Vector3 vector(const xml_node& element, const char* key, const Vector3& otherwise) const {
    if (!element.attribute(key)) return otherwise;
    const auto all = numbers(element, key);
    if (all.size() != 3)
      throw InputError(where(element), key,
                       fmt::format("expected 3 numbers, got '{}'", excerpt(element.attribute(key).value())));
    return {all[0], all[1], all[2]};
  }
  [[nodiscard]] bool truth(const xml_node& element, const char* key, bool otherwise) const {
    const std::string_view text = element.attribute(key).value();
    if (text.empty()) return otherwise;
    if (text == "1" || text == "true" || text == "True" || text == "TRUE") return true;
    if (text == "0" || text == "false" || text == "False" || text == "FALSE") return false;
    throw InputError(where(element), key, fmt::format("expected 0, 1, true or false, got '{}'", excerpt(text)));
  }
  [[nodiscard]] double distance(const xml_node& element, const char* key, double otherwise) const {
    const double x = number(element, key, otherwise);
    if (const auto error = outside_domain(key, x))
      throw InputError(where(element), key, fmt::format("{}, got {}", error->rule, x));
    return x;
  }

  // The component that a link names: @[-2].position, @name.position, @../node/name.position.

  /// What stands in a node, by name and in order. Where names are given twice, the first counts.
  struct Inside {
    std::unordered_map<std::string_view, xml_node> nodes;
    std::unordered_map<std::string_view, xml_node> named;
    std::vector<xml_node> components;
    std::unordered_map<const void*, std::size_t> place;  ///< of a component
  };
  static const void* key(const xml_node& node) { return node.internal_object(); }
  [[nodiscard]] const Inside& inside(const xml_node& node) {
    const auto [found, is_new] = inside_.try_emplace(key(node));
    if (!is_new) return found->second;
    for (const xml_node& element : node.children()) {
      if (element.type() != pugi::node_element) continue;
      const std::string_view name = element.attribute("name").value();
      if (is_node(element)) {
        found->second.nodes.emplace(name, element);
        continue;
      }
      found->second.named.emplace(name, element);
      found->second.place.emplace(key(element), found->second.components.size());
      found->second.components.push_back(element);
    }
    return found->second;
  }
  static xml_node at(const std::unordered_map<std::string_view, xml_node>& all, std::string_view name) {
    const auto found = all.find(name);
    return found == all.end() ? xml_node() : found->second;
  }
  [[nodiscard]] xml_node component(const xml_node& from, std::string_view path) {
    xml_node node = from.parent();
    if (path.starts_with("[-")) {
      const Inside& beside = inside(node);
      const auto back = formats::whole_number<std::size_t>(path.substr(2, path.find(']') - 2));
      const auto own = beside.place.find(key(from));
      if (!back || own == beside.place.end() || *back > own->second) return {};
      return beside.components[own->second - *back];
    }
    if (path.starts_with('/')) {
      node = document_.child("Node");
      path.remove_prefix(1);
    }
    const bool upwards = path.find('/') == std::string_view::npos;
    for (std::size_t slash = path.find('/'); slash != std::string_view::npos; slash = path.find('/')) {
      const std::string_view part = path.substr(0, slash);
      path.remove_prefix(slash + 1);
      if (part == "..")
        node = node.parent();
      else if (part != ".")
        node = at(inside(node).nodes, part);
    }
    for (xml_node in = node; in; in = in.parent()) {
      if (const xml_node found = at(inside(in).named, path)) return found;
      if (!upwards) break;
    }
    return {};
  }
  struct Link {
    xml_node to;
    std::string data;
  };
  /// Nothing where the attribute is no link.
  [[nodiscard]] std::optional<Link> link(const xml_node& element, const char* key) {
    std::string_view text = element.attribute(key).value();
    if (!text.starts_with('@')) return std::nullopt;
    text.remove_prefix(1);
    const std::size_t dot = text.rfind('.');
    const bool has_data =
        dot != std::string_view::npos && dot + 1 < text.size() && text[dot + 1] != '/' && text[dot + 1] != '.';
    return Link{component(element, has_data ? text.substr(0, dot) : text),
                std::string(has_data ? text.substr(dot + 1) : std::string_view())};
  }

  // Loaders.

  /// Where SOFA looks for a file: beside the scene, and in the folder `share` of a checkout around it.
  [[nodiscard]] std::optional<fs::path> found(const std::string& name) const {
    std::error_code error;
    const fs::path beside = fs::absolute(fs::path(path_), error).parent_path();
    if (fs::exists(beside / name, error)) return beside / name;
    for (fs::path above = beside; above.has_relative_path(); above = above.parent_path())
      for (const char* share : {"share", "share/sofa"})
        if (fs::exists(above / share / name, error)) return above / share / name;
    return std::nullopt;
  }
  /// As the loader has them: read once, whoever asks.
  [[nodiscard]] const Read<Spheres>& spheres_of(const xml_node& loader) {
    const auto [found, is_new] = spheres_.try_emplace(key(loader));
    if (is_new) found->second = loaded(loader);
    return found->second;
  }
  [[nodiscard]] Read<Spheres> loaded(const xml_node& loader) const {
    if (!loader) return Unread{"the link leads to no component of this file"};
    if (!is(loader, "SphereLoader")) return Unread{fmt::format("it takes data of a {}", excerpt(loader.name()))};
    const std::string name = loader.attribute("filename").value();
    const auto file = found(name);
    if (!file)
      return Unread{fmt::format("'{}' is neither beside the scene nor in a folder share above it", excerpt(name))};
    // What waits, as a pipe does, and what has no end, as a device may, are no meshes.
    if (std::error_code error; !fs::is_regular_file(*file, error))
      throw InputError(where(loader), "filename", fmt::format("is no regular file, got '{}'", excerpt(name)));
    Spheres spheres;
    InputLines lines(file->string());
    while (lines.next()) {
      std::istringstream words(lines.text());
      std::string word;
      words >> word;
      if (word != "sphe") continue;  // the first line, the number of spheres, remarks
      long index = 0;
      Vector3 center;
      double radius = 0;
      if (!(words >> index >> center[0] >> center[1] >> center[2] >> radius))
        throw InputError(lines.where(), "sphe",
                         fmt::format("expected an index and 4 numbers, got '{}'", excerpt(lines.text())));
      spheres.centers.push_back(center);
      spheres.radii.push_back(radius);
    }
    const Vector3 scale = vector(loader, loader.attribute("scale3d") ? "scale3d" : "scale", {1, 1, 1});
    const Eigen::Quaterniond q = turn(vector(loader, "rotation", {0, 0, 0}));
    const Vector3 translation = vector(loader, "translation", {0, 0, 0});
    for (Vector3& center : spheres.centers) center = q * center.cwiseProduct(scale) + translation;
    return spheres;
  }
  /// The points of a RegularGridTopology, x first.
  [[nodiscard]] Read<Positions> grid_of(const xml_node& grid) const {
    Eigen::Array3d n(2, 2, 2);
    if (grid.attribute("n")) n = vector(grid, "n", {2, 2, 2}).array();
    if (grid.attribute("nx") && grid.attribute("ny") && grid.attribute("nz"))
      n = {number(grid, "nx", 2), number(grid, "ny", 2), number(grid, "nz", 2)};
    std::array<int, 3> counts{};
    for (std::size_t i = 0; i < 3; ++i)
      counts[i] = formats::require_whole_number<int>(n[static_cast<Index>(i)], where(grid), "n", 1,
                                                     static_cast<int>(kMostSpheres));
    if (n.prod() > static_cast<double>(kMostSpheres))
      throw InputError(where(grid), "n", fmt::format("expected at most {} points, got {:.0f}", kMostSpheres, n.prod()));
    if (grid.attribute("cellWidth") || grid.attribute("p0")) return Unread{"its grid has a cellWidth or a p0"};
    Vector3 least = vector(grid, "min", {0, 0, 0});
    Vector3 most = vector(grid, "max", {1, 1, 1});
    constexpr const char* kLeast[] = {"xmin", "ymin", "zmin"};
    constexpr const char* kMostOf[] = {"xmax", "ymax", "zmax"};
    if (std::all_of(kLeast, kLeast + 3, [&](const char* key) { return grid.attribute(key); }) &&
        std::all_of(kMostOf, kMostOf + 3, [&](const char* key) { return grid.attribute(key); })) {
      const double scale = single(grid, "scale", 1);
      for (int i = 0; i < 3; ++i) {
        least[i] = single(grid, kLeast[i], 0) * scale;
        most[i] = single(grid, kMostOf[i], 1) * scale;
      }
    }
    Vector3 first = least;
    Vector3 step;
    for (int i = 0; i < 3; ++i) {
      step[i] = n[i] > 1 ? (most[i] - least[i]) / (n[i] - 1) : most[i] - least[i];
      if (n[i] == 1 && i < 2) first[i] = (most[i] + least[i]) / 2;
    }
    Positions points;
    for (int z = 0; z < counts[2]; ++z)
      for (int y = 0; y < counts[1]; ++y)
        for (int x = 0; x < counts[0]; ++x)
          points.centers.emplace_back(first[0] + step[0] * x, first[1] + step[1] * y, first[2] + step[2] * z);
    return points;
  }

  // States.

  /// The positions that a state is given, before they are moved.
  [[nodiscard]] Read<Positions> given(const xml_node& state) {
    const bool rigid = std::string_view(state.attribute("template").value()).starts_with("Rigid");
    Positions positions;
    if (const auto from = link(state, "position")) {
      if (from->data != "position" && from->data != "sphere_centers")
        return Unread{fmt::format("its positions are '{}'", excerpt(state.attribute("position").value()))};
      const auto& spheres = spheres_of(from->to);
      if (const Unread* why = unread(spheres)) return *why;
      positions.centers = std::get<Spheres>(spheres).centers;
      return positions;
    }
    if (const auto from = link(state, "src")) {
      const auto& spheres = spheres_of(from->to);
      if (const Unread* why = unread(spheres)) return *why;
      positions.centers = std::get<Spheres>(spheres).centers;
      return positions;
    }
    const char* key = state.attribute("position") ? "position" : "rest_position";
    if (link(state, key)) return Unread{fmt::format("its positions are '{}'", excerpt(state.attribute(key).value()))};
    const auto all = numbers(state, key);
    const std::size_t width = rigid ? 7 : 3;
    if (all.size() % width != 0)
      throw InputError(where(state), key, fmt::format("{} numbers are no rows of {}", all.size(), width));
    if (rigid) positions.orientations.emplace();
    for (std::size_t i = 0; i < all.size(); i += width) {
      positions.centers.emplace_back(all[i], all[i + 1], all[i + 2]);
      if (rigid) positions.orientations->emplace_back(all[i + 6], all[i + 3], all[i + 4], all[i + 5]);
    }
    if (positions.centers.size() <= 1 && !rigid) {
      for (const xml_node& beside : state.parent().children()) {
        if (is(beside, "RegularGridTopology") || is(beside, "RegularGrid")) return grid_of(beside);
        const std::string_view type = beside.name();
        if (type.ends_with("Topology") || type.ends_with("TopologyContainer"))
          return Unread{fmt::format("its positions are those of a {}", excerpt(type))};
      }
    }
    if (positions.centers.empty()) {  // a state that is told nothing has one point
      positions.centers.emplace_back(0, 0, 0);
      if (rigid) positions.orientations->emplace_back(1, 0, 0, 0);
    }
    return positions;
  }
  /// As MechanicalObject moves them: scaled, turned, moved, turned and moved again.
  void move(const xml_node& state, Positions& positions) const {
    const auto by_letters = [&](const char* whole, const char* x, const char* y, const char* z, double otherwise) {
      if (state.attribute(x) || state.attribute(y) || state.attribute(z))
        return Vector3(single(state, x, otherwise), single(state, y, otherwise), single(state, z, otherwise));
      return vector(state, whole, Vector3::Constant(otherwise));
    };
    Vector3 scale = vector(state, "scale3d", {1, 1, 1});
    if (state.attribute("scale")) scale = Vector3::Constant(single(state, "scale", 1));
    if (state.attribute("sx") || state.attribute("sy") || state.attribute("sz"))
      scale = by_letters("scale3d", "sx", "sy", "sz", 1);
    const Vector3 turns[] = {by_letters("rotation", "rx", "ry", "rz", 0),
                             by_letters("rotation2", "rx2", "ry2", "rz2", 0)};
    const Vector3 ways[] = {by_letters("translation", "dx", "dy", "dz", 0),
                            by_letters("translation2", "dx2", "dy2", "dz2", 0)};
    for (Vector3& center : positions.centers) center = center.cwiseProduct(scale);
    for (int i = 0; i < 2; ++i) {
      const Eigen::Quaterniond q = turn(turns[i]);
      const bool turned = !turns[i].isZero(0);
      for (Vector3& center : positions.centers) center = (turned ? Vector3(q * center) : center) + ways[i];
      if (turned && positions.orientations)
        for (Eigen::Quaterniond& orientation : *positions.orientations) orientation = q * orientation;
    }
  }
  /// The state of a node, or of the nearest one above it.
  [[nodiscard]] xml_node state_of(xml_node node) {
    for (; node && is_node(node); node = node.parent()) {
      const auto [found, is_new] = states_.try_emplace(key(node));
      if (is_new) found->second = node.child("MechanicalObject");
      if (found->second) return found->second;
    }
    return {};
  }
  /// Worked out once, however many models take them.
  [[nodiscard]] const Read<Positions>& positions_of(const xml_node& state) {
    if (const auto found = positions_.find(key(state)); found != positions_.end()) return found->second;
    return positions_.emplace(key(state), moved(state)).first->second;
  }
  [[nodiscard]] Read<Positions> moved(const xml_node& state) {
    if (!state) return Unread{"no MechanicalObject is in its node or above it"};
    const std::string_view kind = state.attribute("template").value();
    if (!kind.empty() && !kind.starts_with("Vec3") && !kind.starts_with("Rigid3") && kind != "Rigid")
      return Unread{fmt::format("its state is a MechanicalObject of {}", excerpt(kind))};
    const xml_node node = state.parent();
    xml_node mapping;
    for (const xml_node& element : node.children())
      if (std::string_view(element.name()).ends_with("Mapping")) mapping = element;
    if (is(mapping, "IdentityMapping")) return positions_of(state_of(node.parent()));
    auto positions = given(state);
    if (unread(positions)) return positions;
    auto& own = std::get<Positions>(positions);
    move(state, own);
    if (!mapping || is(mapping, "BarycentricMapping")) return positions;  // which leaves them where they are
    if (!is(mapping, "RigidMapping"))
      return Unread{fmt::format("its positions come from a {}", excerpt(mapping.name()))};
    for (const char* key : {"initialPoints", "rigidIndexPerPoint", "filename", "globalToLocalCoords", "index"})
      if (mapping.attribute(key)) return Unread{fmt::format("its RigidMapping has the attribute {}", key)};
    const auto& above = positions_of(state_of(node.parent()));
    if (unread(above)) return above;
    const auto& frames = std::get<Positions>(above);
    if (!frames.orientations) return Unread{"its RigidMapping has no rigid state above it"};
    for (Vector3& center : own.centers) center = frames.orientations->front() * center + frames.centers.front();
    return positions;
  }

  // Models.

  [[nodiscard]] Read<std::vector<double>> radii_of(const xml_node& spheres, std::size_t count) {
    std::vector<double> radii;
    if (const auto from = link(spheres, "listRadius")) {
      const auto& loaded = spheres_of(from->to);
      if (const Unread* why = unread(loaded)) return Unread{"listRadius: " + why->why};
      radii = std::get<Spheres>(loaded).radii;
    } else {
      radii = numbers(spheres, "listRadius");
    }
    if (link(spheres, "radius"))
      return Unread{fmt::format("its radius is '{}'", excerpt(spheres.attribute("radius").value()))};
    radii.resize(count, number(spheres, "radius", 1));
    return radii;
  }
  void read_spheres(const xml_node& spheres, std::string name, const std::string& node, const Pipelines& pipelines) {
    if (!truth(spheres, "active", true)) return leave_out(spheres, "active=\"0\"");
    const auto& positions = positions_of(state_of(spheres.parent()));
    if (const Unread* why = unread(positions)) return leave_out(spheres, why->why);
    const auto& at = std::get<Positions>(positions);
    if (at.centers.size() > kMostSpheres - all_spheres_)
      throw InputError(where(spheres), "", fmt::format("more than {} spheres in one scene", kMostSpheres));
    all_spheres_ += at.centers.size();
    auto radii = radii_of(spheres, at.centers.size());
    if (const Unread* why = unread(radii)) return leave_out(spheres, why->why);
    const auto count = static_cast<Index>(at.centers.size());
    ModelColumns columns;
    Eigen::MatrixXd centers(count, 3);
    for (Index i = 0; i < count; ++i) centers.row(i) = at.centers[static_cast<std::size_t>(i)].transpose();
    columns["radii"] = Eigen::Map<const Eigen::VectorXd>(std::get<std::vector<double>>(radii).data(), count);
    columns[at.orientations ? "positions" : "centers"] = centers;
    if (at.orientations) {
      Eigen::MatrixXd turns(count, 4);
      for (Index i = 0; i < count; ++i)
        turns.row(i) = (*at.orientations)[static_cast<std::size_t>(i)].coeffs().transpose();
      columns["orientations"] = turns;
    }
    MeetingRules rules{.node = node + "/",
                       .groups = {},
                       .simulated = truth(spheres, "simulated", true),
                       .self_collision = truth(spheres, "selfCollision", false),
                       .pipelines = with_named(spheres, pipelines)};
    for (const double group : numbers(spheres, "group"))
      rules.groups.insert(formats::require_whole_number<int>(group, where(spheres), "group"));
    try {
      scene_.models.push_back(
          {factory_.make(at.orientations ? "RigidSphereModel" : "SphereCollisionModel", std::move(name), columns),
           std::move(rules), where(spheres).line});
    } catch (const InvalidModel& error) {
      throw InputError(where(spheres), "", error.what());
    }
  }

  void read_node(const xml_node& node, const std::string& path, const Pipelines& above) {
    const Pipelines pipelines = with_own(node, above);
    std::size_t nodes = 0;
    std::size_t spheres = 0;
    // As SOFA names what has no name: by its type, numbered from 1 within its node.
    const auto named = [&](const xml_node& element, std::size_t& unnamed, const char* type) {
      const std::string_view name = element.attribute("name").value();
      return path + "/" + (name.empty() ? fmt::format("{}{}", type, ++unnamed) : std::string(name));
    };
    for (const xml_node& element : node.children()) {
      if (element.type() != pugi::node_element) continue;
      throw_if_interrupted();
      const std::string_view type = element.name();
      if (is_node(element)) {
        read_node(element, named(element, nodes, "Node"), pipelines);
      } else if (type == "SphereCollisionModel") {
        read_spheres(element, named(element, spheres, "SphereCollisionModel"), path, pipelines);
      } else if (type == "CubeCollisionModel") {
        leave_out(element, "SOFA makes its boxes around other models, and reads none from a scene");
      } else if (type.ends_with("CollisionModel")) {
        leave_out(element, "only spheres are");
      } else if (type == "include") {
        leave_out(element, fmt::format("give '{}' too", excerpt(element.attribute("href").value())));
      }
    }
  }

  // Pipelines: a CollisionPipeline has the models below its node, a SubCollisionPipeline those that it names. Several
  // of a node have the same models, and count as one.

  void find_pipelines(const xml_node& node) {
    for (const xml_node& element : node.children()) {
      throw_if_interrupted();
      const std::string_view type = element.name();
      if (is_node(element)) find_pipelines(element);
      const bool names_models = type == "SubCollisionPipeline";
      if (!names_models && type != "CollisionPipeline" && type != "DefaultPipeline") continue;
      // The roots of several files are one root.
      const bool of_root = node == document_.child("Node") && !names_models;
      const std::string id = of_root ? "root" : fmt::format("{}#{}", path_, ++pipelines_count_);
      if (!names_models) {
        pipelines_.try_emplace(key(node), id);
        continue;
      }
      pipelines_.try_emplace(key(element), id);
      std::istringstream links(element.attribute("collisionModels").value());
      for (std::string name; links >> name;)
        if (const xml_node model = component(element, std::string_view(name).substr(name.starts_with('@') ? 1 : 0)))
          naming_[key(model)].insert(id);
    }
  }
  /// The pipelines of what stands in a node, from those of the node above.
  [[nodiscard]] Pipelines with_own(const xml_node& node, const Pipelines& above) {
    const auto own = pipelines_.find(key(node));
    if (own == pipelines_.end() || above->contains(own->second)) return above;
    std::set<std::string> all = *above;
    all.insert(own->second);
    return shared(std::move(all));
  }
  [[nodiscard]] Pipelines with_named(const xml_node& model, const Pipelines& of_node) {
    const auto naming = naming_.find(key(model));
    if (naming == naming_.end()) return of_node;
    std::set<std::string> all = *of_node;
    all.insert(naming->second.begin(), naming->second.end());
    return shared(std::move(all));
  }
  [[nodiscard]] Pipelines shared(std::set<std::string> all) {
    Pipelines& one = sets_[all];
    if (!one) one = std::make_shared<const std::set<std::string>>(std::move(all));
    return one;
  }

  /// Those of the first intersection component, down the tree: the one that SOFA's pipeline takes.
  void read_distances(const xml_node& root) {
    const auto is_intersection = [](const xml_node& element) {
      const std::string_view type = element.name();
      return (type.ends_with("Intersection") && type != "RecordingIntersection") || type == "LocalMinDistance";
    };
    const xml_node first = root.find_node(is_intersection);
    if (!first || is(first, "DiscreteIntersection")) return;
    const bool exact = is(first, "ExactDiscreteIntersection");
    scene_.alarm = distance(first, "alarmDistance", exact ? 0 : 1);
    scene_.contact = distance(first, "contactDistance", exact ? 0 : 0.5);
    if (!exact && !is(first, "MinProximityIntersection"))
      tell(first, "gives its distances alone: pairs are asked about as by DiscreteIntersection");
  }

  std::string path_;
  std::string text_;
  const ModelFactory& factory_;
  std::vector<std::size_t> feeds_;  ///< where the line feeds are
  pugi::xml_document document_;
  std::unordered_map<const void*, Inside> inside_;
  std::unordered_map<const void*, Read<Spheres>> spheres_;      ///< of loaders
  std::unordered_map<const void*, xml_node> states_;            ///< of nodes, their own
  std::unordered_map<const void*, Read<Positions>> positions_;  ///< of states
  std::unordered_map<const void*, std::string> pipelines_;      ///< by the node that they stand in, or by themselves
  std::size_t pipelines_count_ = 0;
  std::unordered_map<const void*, std::set<std::string>> naming_;  ///< the pipelines that name a model
  std::map<std::set<std::string>, Pipelines> sets_;
  std::size_t all_spheres_ = 0;
  SofaScene scene_;
};

}  // namespace

bool may_meet(const MeetingRules& first, const MeetingRules& second) {
  if (first.pipelines && second.pipelines &&
      std::none_of(first.pipelines->begin(), first.pipelines->end(),
                   [&](const std::string& pipeline) { return second.pipelines->contains(pipeline); }))
    return false;
  if (!first.simulated && !second.simulated) return false;
  if (!first.node.empty() && first.node == second.node) return first.self_collision && second.self_collision;
  return std::none_of(first.groups.begin(), first.groups.end(),
                      [&](int group) { return second.groups.contains(group); });
}

void LeftOut::add(const LeftOut& more) {
  all += more.all;
  for (const std::string& one : more.first)
    if (!is_full()) first.push_back(one);
}

std::string LeftOut::text() const {
  std::string text = fmt::format("{}", fmt::join(first, "\n"));
  if (all > first.size()) text += fmt::format("\nand {} more that are not read as they stand", all - first.size());
  return text;
}

bool is_sofa_scene(std::string_view path) { return path.ends_with(".scn"); }

SofaScene read_sofa_scene(const std::string& path, const ModelFactory& factory) { return Reader(path, factory).read(); }

}  // namespace contact::tool
