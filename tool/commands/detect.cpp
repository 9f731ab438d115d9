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
#include "tool/run/near_models.hpp"
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
  struct Deepest {
    Index first;
    Index second;
    double value;
  };

  ModelPair models;
  std::uint64_t contacts = 0;
  std::uint64_t overlapping = 0;
  std::optional<Deepest> deepest{};
};

std::string header_line(const Scene& scene, const NearModels& pairs, const ProximityIntersection& intersection,
                        const std::string& points) {
  std::string without;
  for (const auto& [first, second] : pairs.without)
    without += fmt::format("{}[{},{}]", without.empty() ? "" : ",", json_string(scene.models[first]->getName()),
                           json_string(scene.models[second]->getName()));
  const std::uint64_t more = pairs.without_all - pairs.without.size();
  return fmt::format(R"({{"format":"contact-oracle/contacts","version":1,"alarm":{},"contact":{},"points":"{}"{}{}}})"
                     "\n",
                     number(intersection.getAlarmDistance()), number(intersection.getContactDistance()), points,
                     without.empty() ? "" : fmt::format(R"(,"no_intersector":[{}])", without),
                     more == 0 ? "" : fmt::format(R"(,"no_intersector_more":{})", more));
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
        if (!meeting.deepest || c.value < meeting.deepest->value)
          meeting.deepest = {c.elem.first.getIndex(), c.elem.second.getIndex(), c.value};
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

/// Detects between the models that are near each other, and shows how far it is where nothing else is printed
/// meanwhile. The pairs that are listed, and what came of each.
std::vector<Meeting> detect_all(const Scene& scene, const NearModels& pairs, const Intersection& intersection,
                                Contacts& contacts, bool shows_progress) {
  const auto model = [&](std::uint32_t i) -> const CollisionModel& { return *scene.models[i]; };
  std::uint64_t elements = 0;
  for (const ModelPair& pair : pairs.near)
    if (shows_progress) elements += static_cast<std::uint64_t>(model(pair.first).getSize());
  Progress progress("detect", elements);
  const bool lists_all = scene.models.size() <= NearModels::kFew;
  std::vector<Meeting> all;
  auto near = pairs.near.begin();
  for (const ModelPair& pair : pairs.listed) {
    throw_if_interrupted();
    Meeting m{pair};
    if (near != pairs.near.end() && *near == pair) {
      ++near;
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
      detect_streamed(intersection, model(pair.first), model(pair.second), take, in_parallel);
      reached(static_cast<std::uint64_t>(model(pair.first).getSize()));
    }
    if (lists_all || m.contacts != 0) all.push_back(m);
  }
  return all;
}

/// A row for each pair that is listed, and a line for all others.
void print_table(const Scene& scene, const NearModels& pairs, const std::vector<Meeting>& all,
                 const ProximityIntersection& intersection, const std::string& points) {
  const auto name = [&](std::uint32_t i) -> const std::string& { return scene.models[i]->getName(); };
  const std::size_t models = scene.models.size();
  say("alarm {}, contact {}, points {}\n", number(intersection.getAlarmDistance()),
      number(intersection.getContactDistance()), points);
  const bool lists_all = models <= NearModels::kFew;
  if (all.empty() && pairs.without.empty()) {
    if (models == 1)
      say("\none model, and no pair: --self detects inside a model\n");
    else
      say("\n{} models, and no pair of them {}: see docs/sofa.md#scenes-without-sofa\n", models,
          lists_all ? "meets in SOFA" : "meets in SOFA and has a contact");
    return;
  }
  std::size_t first = std::string_view("first").size();
  std::size_t second = std::string_view("second").size();
  const auto widen = [&](const ModelPair& pair) {
    first = std::max(first, name(pair.first).size());
    second = std::max(second, name(pair.second).size());
  };
  for (const Meeting& m : all) widen(m.models);
  for (const ModelPair& pair : pairs.without) widen(pair);
  say("\n{:<{}}  {:<{}}  contacts  overlapping  deepest\n", "first", first, "second", second);
  const auto begin_row = [&](const ModelPair& pair) {
    throw_if_interrupted();
    say("{:<{}}  {:<{}}  ", name(pair.first), first, name(pair.second), second);
  };
  auto without = pairs.without.begin();
  const auto print_without = [&](const ModelPair* before) {
    for (; without != pairs.without.end() && (before == nullptr || *without < *before); ++without) {
      begin_row(*without);
      say("no intersector\n");
    }
  };
  for (const Meeting& m : all) {
    print_without(&m.models);
    begin_row(m.models);
    say("{:>8}  {:>11}", m.contacts, m.overlapping);
    if (m.deepest)
      say("  {}[{}] {}[{}] value {}", name(m.models.first), m.deepest->first, name(m.models.second), m.deepest->second,
          number(m.deepest->value));
    say("\n");
  }
  print_without(nullptr);
  if (const std::uint64_t more = pairs.without_all - pairs.without.size(); more != 0)
    say("and {} more pairs without an intersector\n", more);
  if (!lists_all) say("{} models; no other two of them meet in SOFA and have a contact\n", models);
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
  for (const std::string& what : scene.left_out.lines()) say_error("{}\n", what);
  const Distances distances{options.alarm.value_or(scene.alarm.value_or(0)),
                            options.contact.value_or(scene.contact.value_or(0))};
  const auto& names = engines::kComputedPointsNames;
  const auto points =
      static_cast<PointConvention>(std::find(names.begin(), names.end(), options.points) - names.begin());
  const ProximityIntersection intersection(distances, points);

  const NearModels pairs = near_models(scene, intersection, options.self);
  std::vector<JsonOutput*> wanted;
  for (JsonOutput* to : {&output, &json})
    if (to->wanted()) wanted.push_back(to);
  Contacts contacts(wanted, distances.contact);
  contacts.write(header_line(scene, pairs, intersection, options.points));
  const std::vector<Meeting> all = detect_all(scene, pairs, intersection, contacts, !json.alone());
  for (JsonOutput* to : wanted) to->commit();
  if (!json.alone()) print_table(scene, pairs, all, intersection, options.points);
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
  command
      ->add_option("--contact", options->contact,
                   "The contact distance, which each value is less (default: the scene's, or 0)")
      ->check(not_a_distance);
  command->add_option("--points", options->points, "Contact points")
      ->capture_default_str()
      ->check(CLI::IsMember(engines::kComputedPointsNames));
  command->add_flag("--self", options->self, "Each model with itself, too");
  command->add_flag("--solid-cubes", options->solid_cubes,
                    "Spheres against cubes, too: cubes are solid (default: they bound something else, as in SOFA)");
  command
      ->add_option("--jobs", options->jobs, "Threads (default: a thread a core); the output is the same for any number")
      ->check(kThreads);
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
