// detect: the contacts between whole models of a scene.
#include "contact/detect.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <charconv>
#include <memory>
#include <span>

#include "contact/discrete_intersection.hpp"
#include "contact/plugin.hpp"
#include "contact/shape_intersectors.hpp"
#include "engines/engine.hpp"
#include "formats/json.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/json_output.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"
#include "tool/run/scene.hpp"

namespace contact::tool {
namespace {

using formats::json_string;
using formats::number;

struct DetectOptions {
  std::vector<std::string> scenes;
  std::vector<std::string> plugins;
  std::optional<double> alarm;
  std::optional<double> contact;
  std::string points = std::string(engines::kComputedPointsNames.front());
  bool self = false;
  bool solid_cubes = false;
  std::size_t jobs = 0;
  std::string output;
  std::string json;
};

/// Two models, and what the table says of their contacts.
struct Meeting {
  const CollisionModel& first;
  const CollisionModel& second;
  bool has_intersector = false;
  std::uint64_t contacts = 0;
  std::uint64_t overlapping = 0;
  std::optional<DetectionOutput> deepest{};
};

std::vector<Meeting> meetings(const Scene& scene, const Intersection& intersection, bool self) {
  std::vector<Meeting> all;
  for (std::size_t i = 0; i < scene.models.size(); ++i)
    for (std::size_t j = i; j < scene.models.size(); ++j) {
      if (i == j ? !(self || scene.rules[i].self_collision) : !may_meet(scene.rules[i], scene.rules[j])) continue;
      const CollisionModel& first = *scene.models[i];
      const CollisionModel& second = *scene.models[j];
      bool swap = false;
      all.push_back({first, second, intersection.findIntersector(first, second, swap) != nullptr});
    }
  return all;
}

std::string header_line(const std::vector<Meeting>& all, const ProximityIntersection& intersection,
                        const std::string& points) {
  std::string without;
  for (const Meeting& m : all)
    if (!m.has_intersector)
      without += fmt::format("{}[{},{}]", without.empty() ? "" : ",", json_string(m.first.getName()),
                             json_string(m.second.getName()));
  return fmt::format(R"({{"format":"contact-oracle/contacts","version":1,"alarm":{},"contact":{},"points":"{}"{}}})"
                     "\n",
                     number(intersection.getAlarmDistance()), number(intersection.getContactDistance()), points,
                     without.empty() ? "" : fmt::format(R"(,"no_intersector":[{}])", without));
}

std::string element(const CollisionElement& e) {
  return fmt::format(R"({{"model":{},"index":{}}})", json_string(e.getCollisionModel().getName()), e.getIndex());
}

std::string contact_line(const DetectionOutput& c) {
  return fmt::format(R"({{"first":{},"second":{},"id":{},"normal":{},"point1":{},"point2":{},"value":{}}})"
                     "\n",
                     element(c.elem.first), element(c.elem.second), c.id, number(c.normal), number(c.point[0]),
                     number(c.point[1]), number(c.value));
}

/// Counts the contacts that come, and writes them where they are wanted, in their order; keeps none of them.
class Contacts {
 public:
  Contacts(std::vector<JsonOutput*> outputs, double contact_distance)
      : outputs_(std::move(outputs)), contact_distance_(contact_distance) {}

  void write(std::string_view text) {
    for (JsonOutput* output : outputs_) output->write(text);
  }

  void take(std::span<const OutputVector> some, Meeting& meeting) {
    throw_if_interrupted();
    for (const OutputVector& contacts : some)
      for (const DetectionOutput& c : contacts) {
        ++meeting.contacts;
        meeting.overlapping += c.value + contact_distance_ < 0 ? 1 : 0;
        if (!meeting.deepest || c.value < meeting.deepest->value) meeting.deepest = c;
      }
    if (outputs_.empty()) return;
    // Digits take longer than the contacts themselves: they are worked out on every thread.
    lines_.resize(std::max(lines_.size(), some.size()));
    in_parallel(some.size(), [&](std::size_t k) {
      lines_[k].clear();
      for (const DetectionOutput& c : some[k]) lines_[k] += contact_line(c);
    });
    for (std::size_t k = 0; k < some.size(); ++k) write(lines_[k]);
  }

 private:
  std::vector<JsonOutput*> outputs_;
  double contact_distance_;
  std::vector<std::string> lines_;
};

/// Detects between all models, and shows how far it is where nothing else is printed meanwhile.
void detect_all(std::vector<Meeting>& all, const Intersection& intersection, Contacts& contacts, bool shows_progress) {
  std::uint64_t elements = 0;
  for (const Meeting& m : all)
    if (shows_progress && m.has_intersector) elements += static_cast<std::uint64_t>(m.first.getSize());
  Progress progress("detect", elements);
  for (Meeting& m : all) {
    std::uint64_t done = 0;
    const auto reached = [&](std::uint64_t element) {
      progress.add(element - done);
      done = element;
    };
    const auto take = [&](std::span<const OutputVector> some) {
      contacts.take(some, m);
      for (const OutputVector& run : some)
        if (!run.empty()) reached(std::max(done, static_cast<std::uint64_t>(run.back().elem.first.getIndex())));
    };
    detect_streamed(intersection, m.first, m.second, take, in_parallel);
    reached(static_cast<std::uint64_t>(m.first.getSize()));
  }
}

std::string table(const std::vector<Meeting>& all, std::size_t models, const ProximityIntersection& intersection,
                  const std::string& points) {
  std::string text = fmt::format("alarm {}, contact {}, points {}\n", number(intersection.getAlarmDistance()),
                                 number(intersection.getContactDistance()), points);
  if (all.empty() && models > 1)
    return text + fmt::format("\n{} models, and no pair of them meets in SOFA: see docs/sofa.md#scenes-without-sofa\n",
                              models);
  if (all.empty()) return text + "\none model, and no pair: --self detects inside a model\n";
  std::size_t first = std::string_view("first").size();
  std::size_t second = std::string_view("second").size();
  for (const Meeting& m : all) {
    first = std::max(first, m.first.getName().size());
    second = std::max(second, m.second.getName().size());
  }
  text += fmt::format("\n{:<{}}  {:<{}}  contacts  overlapping  deepest\n", "first", first, "second", second);
  for (const Meeting& m : all) {
    text += fmt::format("{:<{}}  {:<{}}  ", m.first.getName(), first, m.second.getName(), second);
    if (!m.has_intersector) {
      text += "no intersector\n";
      continue;
    }
    text += fmt::format("{:>8}  {:>11}", m.contacts, m.overlapping);
    if (m.deepest)
      text += fmt::format("  {}[{}] {}[{}] value {}", m.first.getName(), m.deepest->elem.first.getIndex(),
                          m.second.getName(), m.deepest->elem.second.getIndex(), number(m.deepest->value));
    text += "\n";
  }
  return text;
}

void run_detect(const DetectOptions& options) {
  require_apart({options.output, options.json}, options.scenes);
  JsonOutput output(options.output);
  JsonOutput json(options.json);
  const auto limit = tbb::global_control::max_allowed_parallelism;
  const tbb::global_control threads(limit, options.jobs > 0 ? options.jobs : tbb::global_control::active_value(limit));
  if (options.solid_cubes)  // before the plug-ins, whose intersectors replace others
    IntersectorFactory::getInstance().registerCreator("SolidCube", creator_of<SolidCubeDiscreteIntersection>());
  for (const std::string& plugin : options.plugins) load_plugin(plugin);
  const Scene scene = read_scene(options.scenes, ModelFactory::getInstance());
  for (const std::string& what : scene.left_out) say_error("{}\n", what);
  const Distances distances{options.alarm.value_or(scene.alarm.value_or(0)),
                            options.contact.value_or(scene.contact.value_or(0))};
  const auto& names = engines::kComputedPointsNames;
  const auto points =
      static_cast<PointConvention>(std::find(names.begin(), names.end(), options.points) - names.begin());
  const ProximityIntersection intersection(distances, points);

  std::vector<Meeting> all = meetings(scene, intersection, options.self);
  std::vector<JsonOutput*> wanted;
  for (JsonOutput* to : {&output, &json})
    if (to->wanted()) wanted.push_back(to);
  Contacts contacts(wanted, distances.contact);
  contacts.write(header_line(all, intersection, options.points));
  detect_all(all, intersection, contacts, !json.alone());
  for (JsonOutput* to : wanted) to->commit();
  if (!json.alone()) words() << table(all, scene.models.size(), intersection, options.points);
}

/// A distance on the command line.
std::string not_a_distance(const std::string& text) {
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size()) return "expected a number, got '" + text + "'";
  const auto outside = outside_domain("", x);
  return outside ? outside->rule + ", got " + text : "";
}

}  // namespace

void add_detect(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand(
      "detect",
      "The contacts between whole models of a scene\nA table of each pair of models, or all contacts with --json.");
  auto options = std::make_shared<DetectOptions>();
  command->add_option("scenes", options->scenes, "Scene files (below), .scn files of SOFA, or - for standard input")
      ->required();
  command
      ->add_option("--plugin", options->plugins,
                   "A shared library with more model types and intersectors; may be given again")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->add_option("--alarm", options->alarm, "Pairs up to this far apart are contacts (default: the scene's, or 0)")
      ->check(not_a_distance);
  command->add_option("--contact", options->contact, "What a value is less (default: the scene's, or 0)")
      ->check(not_a_distance);
  command->add_option("--points", options->points, "Contact points")
      ->capture_default_str()
      ->check(CLI::IsMember(engines::kComputedPointsNames));
  command->add_flag("--self", options->self, "Each model with itself, too");
  command->add_flag("--solid-cubes", options->solid_cubes,
                    "Spheres against cubes, too: cubes are solid (default: they bound something else, as in SOFA)");
  command
      ->add_option("--jobs", options->jobs, "Threads (default: a thread a core); the output is the same for any number")
      ->check(kFromOne);
  add_json_option(*command, options->json, "The contacts as JSON lines");
  command->add_option("-o,--output", options->output, "The same as --json=FILE")->type_name("FILE");
  command->footer(
      "A scene is JSON lines: a header (alarm and contact may be left out), then one model a line with one\n"
      "entry an element in each column; x is a number. Plug-ins bring more models. See docs/formats.md#scenes.\n\n" +
      scene_form(ModelFactory::getInstance()));
  command->callback([options, &exit] {
    run_detect(*options);
    exit = kCertified;
  });
}

}  // namespace contact::tool
