// A scene: whole collision models read from JSON lines.
#include "tool/run/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "formats/json.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

using formats::Node;

constexpr std::string_view kSceneFormat = "contact-oracle/scene";
constexpr std::uint64_t kVersion = 1;

std::string another_says(double distance) { return "another scene says " + formats::number(distance); }

/// The distance that a header gives, which must be the one that an earlier header gave.
void read_distance(const Node& header, const std::string& key, std::optional<double>& distance) {
  const auto given = header.find(key);
  if (!given) return;
  const double x = given->number();
  if (const auto error = outside_domain(key, x)) given->refuse(error->rule);
  if (distance && *distance != x) given->refuse(another_says(*distance));
  distance = x;
}

void read_header(const Node& header, Scene& scene) {
  if (const Node format = header.at("format"); format.text() != kSceneFormat)
    format.refuse(fmt::format("expected \"{}\"", kSceneFormat));
  if (const Node version = header.at("version"); version.count() != kVersion)
    version.refuse(fmt::format("this program reads version {}", kVersion));
  header.allow_only({"format", "version", "alarm", "contact"});
  read_distance(header, "alarm", scene.alarm);
  read_distance(header, "contact", scene.contact);
}

/// A name is printed in tables and messages as it stands.
std::string read_name(const Node& name) {
  std::string text = name.text();
  if (text.empty() || text != name.raw_text()) name.refuse("expected a name without control characters");
  return text;
}

std::unique_ptr<CollisionModel> read_model(const Node& line, const ModelFactory& factory,
                                           const std::vector<ModelMaker>& makers) {
  std::vector<std::string_view> types;
  types.reserve(makers.size());
  for (const ModelMaker& maker : makers) types.push_back(maker.type);
  const ModelMaker& maker = makers[line.at("model").one_of(types)];

  std::string name = read_name(line.at("name"));
  std::vector<std::string_view> keys{"model", "name"};
  for (const ModelColumn& column : maker.columns) keys.push_back(column.name);
  line.allow_only(keys);
  ModelColumns columns;
  for (const ModelColumn& column : maker.columns) columns[column.name] = line.at(column.name).rows(column.width);
  try {
    return factory.make(maker.type, std::move(name), columns);
  } catch (const InvalidModel& error) {
    throw formats::InputError(line.where(), "", error.what());
  }
}

void add_sofa_scene(const std::string& path, const ModelFactory& factory, Scene& scene,
                    std::map<std::string, std::string>& named) {
  SofaScene read = read_sofa_scene(path, factory);
  for (auto [key, distance, own] :
       {std::tuple{"alarm", &scene.alarm, read.alarm}, {"contact", &scene.contact, read.contact}}) {
    if (*distance && **distance != own)
      throw formats::InputError({path, 0}, key,
                                fmt::format("{}, and {}", formats::number(own), another_says(**distance)));
    *distance = own;
  }
  for (SofaScene::Model& of : read.models) {
    const formats::Location where{path, of.line};
    const auto [other, is_new] = named.emplace(of.model->getName(), where.text());
    if (!is_new)
      throw formats::InputError(where, "name",
                                fmt::format("the model at {} has the name {} too", other->second, of.model->getName()));
    scene.models.push_back(std::move(of.model));
    scene.rules.push_back(std::move(of.rules));
  }
  scene.left_out.add(read.left_out);
}

}  // namespace

Scene read_scene(const std::vector<std::string>& paths, const ModelFactory& factory) {
  Scene scene;
  std::map<std::string, std::string> named;  // where each name was given
  const std::vector<ModelMaker> makers = factory.makers();
  for (const std::string& path : paths) {
    if (is_sofa_scene(path)) {
      add_sofa_scene(path, factory, scene, named);
      continue;
    }
    InputLines lines(path, formats::kLargestText);
    while (lines.next()) {
      const auto parsed = formats::parse_object(lines.text(), lines.where());
      const Node node(parsed, lines.where());
      if (lines.where().line == 1) {
        read_header(node, scene);
        continue;
      }
      auto model = read_model(node, factory, makers);
      const auto [other, is_new] =
          named.emplace(model->getName(), fmt::format("{}:{}", lines.where().file, lines.where().line));
      if (!is_new) node.at("name").refuse(fmt::format("the model at {} has this name", other->second));
      scene.models.push_back(std::move(model));
      scene.rules.emplace_back();
    }
    if (lines.where().line == 0) throw formats::InputError(lines.where(), "", "empty: a scene begins with its header");
  }
  if (scene.models.empty())
    throw formats::InputError(
        {fmt::format("{}", fmt::join(paths, ", ")), 0}, "",
        scene.left_out.all == 0 ? "the scene holds no model" : "no model is read:", scene.left_out.lines());
  return scene;
}

std::string scene_form(const ModelFactory& factory) {
  std::string text = fmt::format(R"({{"format":"{}","version":{},"alarm":0.5,"contact":0.1}})"
                                 "\n",
                                 kSceneFormat, kVersion);
  for (const ModelMaker& maker : factory.makers()) {
    text += fmt::format(R"({{"model":"{}","name":"...")", maker.type);
    for (const auto& [name, width] : maker.columns) {
      std::string row = "x";
      for (Index i = 1; i < width; ++i) row += ",x";
      text += fmt::format(R"(,"{}":[{},...])", name, width == 1 ? row : "[" + row + "]");
    }
    text += "}\n";
  }
  return text;
}

}  // namespace contact::tool
