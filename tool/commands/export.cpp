// export: a test of its own, in a user's language.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "engines/protocol/results.hpp"
#include "formats/output_file.hpp"
#include "formats/program.hpp"
#include "golden/dataset.hpp"
#include "golden/families.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/demand.hpp"
#include "tool/commands/engine_options.hpp"
#include "tool/export/standalone.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

using formats::InputError;

constexpr std::array<std::string_view, 2> kTruthNames{"true", "false"};

struct ExportOptions {
  std::string language;
  std::string pair;
  std::vector<std::string> families;
  std::uint64_t count = 100;
  std::uint64_t seed = golden::kCommittedSeed;
  std::string scalar = std::string(name(Scalar::binary64));
  std::string output;
  std::string tolerance;
  // Of the conventions, by the names of docs/specification.md.
  std::string normal = std::string(kNormalDirectionNames.front());
  std::string normal_unit = std::string(kTruthNames.front());
  std::string points = std::string(kPointsNames.front());
  std::string value = std::string(kValueKindNames.front());
  std::string value_less_contact = std::string(kTruthNames.front());
  std::string touching = std::string(kTouchingNames.front());
  std::string margin = std::string(kMarginNames.front());
  std::string coincident = std::string(kCoincidentNames.front());
  std::string shapes = std::string(kShapesAsNames.front());
  const CLI::App* parsed = nullptr;
};

template <class Choice, class Names>
Choice chosen(const Names& names, const std::string& text) {
  return static_cast<Choice>(index_of(names, text, "convention"));
}

oracle::Declaration declared_by(const ExportOptions& o) {
  oracle::Declaration declared;
  declared.scalar = named(kScalars, o.scalar);
  Conventions& c = declared.conventions;
  c.normal = chosen<NormalDirection>(kNormalDirectionNames, o.normal);
  c.normal_unit = o.normal_unit == kTruthNames.front();
  c.points = chosen<Points>(kPointsNames, o.points);
  if (c.points == Points::manifold)
    throw InputError({"export", 0}, "--points",
                     "manifold leaves the choice of points to the engine, so no list says which are right; none leaves "
                     "them out, and certify judges them");
  c.value = chosen<ValueKind>(kValueKindNames, o.value);
  c.value_less_contact = o.value_less_contact == kTruthNames.front();
  c.touching_overlap = c.touching_contact = chosen<Touching>(kTouchingNames, o.touching);
  c.margin = chosen<Margin>(kMarginNames, o.margin);
  c.coincident = chosen<Coincident>(kCoincidentNames, o.coincident);
  c.shapes = chosen<ShapesAs>(kShapesAsNames, o.shapes);
  if (!o.tolerance.empty()) declared.tolerance = read_tolerance(o.tolerance);
  return declared;
}

/// Those that are named, else all that have answers.
std::vector<const golden::Family*> families_of(const ExportOptions& o, Pair pair) {
  std::vector<const golden::Family*> families;
  std::vector<std::string_view> known;
  for (const golden::Family& family : golden::families_of(pair)) {
    if (family.name == "invalid") continue;
    known.push_back(family.name);
    if (o.families.empty() || std::find(o.families.begin(), o.families.end(), family.name) != o.families.end())
      families.push_back(&family);
  }
  for (const std::string& name : o.families) {
    if (name == "invalid")
      throw InputError({"export", 0}, "--family", "invalid has questions without an answer, and a test needs answers");
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError({"export", 0}, "--family",
                       fmt::format("unknown family '{}' of {}; known: {}", name, o.pair, fmt::join(known, ", ")));
  }
  return families;
}

/// The command line that makes the file again, wherever it is written.
std::string command_of(const ExportOptions& o) {
  std::string text = "contact-oracle export";
  for (const CLI::Option* option : o.parsed->get_options())
    if (option->count() != 0 && option->get_name() != "--output")
      text += fmt::format(" {} {}", option->get_name(), fmt::join(option->results(), ","));
  return text + " -o FILE";
}

/// JSON with room after its commas, where a line may end.
std::string spaced(std::string_view json) {
  std::string text;
  for (const char c : json) text += c == ',' ? std::string(", ") : std::string(1, c);
  return text;
}

/// The questions of a test, and how many were left out for each reason.
struct Chosen {
  std::vector<CertainQuestion> questions;
  std::map<std::string_view, std::uint64_t> left_out;
};

/// The first `count` questions of a family that say something, of all those that are looked at.
void choose(const golden::Family& family, Pair pair, const oracle::Declaration& declared, std::uint64_t seed,
            std::uint64_t count, Progress& progress, Chosen& chosen) {
  constexpr std::uint64_t kLookedAt = 20;  // times as many; where more say nothing, the family does not suit
  std::uint64_t found = 0;
  for (std::uint64_t first = 0; found < count && first < kLookedAt * count; first += count) {
    std::vector<CertainQuestion> some(count);
    in_parallel(some.size(), [&](std::size_t i) {
      const Query query = golden::generate_query(pair, family, declared.scalar, seed, first + i);
      some[i] = {query, oracle::certain(query, declared), std::string(family.name)};
    });
    for (CertainQuestion& one : some) {
      if (found == count) break;
      if (!one.certain.left_out.empty()) {
        ++chosen.left_out[one.certain.left_out];
        continue;
      }
      chosen.questions.push_back(std::move(one));
      ++found;
      progress.add(1);
    }
  }
}

void write_test(const ExportOptions& o) {
  Standalone test;
  test.language = static_cast<Language>(index_of(kLanguageNames, o.language, "language"));
  test.pair = named(kPairs, o.pair);
  test.declared = declared_by(o);
  const std::vector<const golden::Family*> families = families_of(o, test.pair);
  formats::OutputFile file(o.output);
  Chosen chosen;
  {
    Progress progress(o.output, o.count);
    for (std::size_t i = 0; i < families.size(); ++i) {
      const std::uint64_t share =
          golden::cut(o.count, i + 1, families.size()) - golden::cut(o.count, i, families.size());
      if (share != 0) choose(*families[i], test.pair, test.declared, o.seed, share, progress, chosen);
    }
  }
  std::string reasons;
  for (const auto& [reason, count] : chosen.left_out)
    reasons += fmt::format("{}{} left out: {}", reasons.empty() ? "" : "; ", count, reason);
  if (chosen.questions.empty())
    throw InputError({"export", 0}, "--family", fmt::format("has no question that could be asked so: {}", reasons));
  test.questions = std::move(chosen.questions);
  std::vector<std::string_view> names;
  for (const CertainQuestion& question : test.questions)
    if (names.empty() || names.back() != question.family) names.push_back(question.family);
  test.about = {
      fmt::format("Made by contact-oracle {}: {}", formats::version(), command_of(o)),
      fmt::format("pair {}, families {}, seed {}, scalar {}", o.pair, fmt::join(names, ", "), o.seed, o.scalar),
      "conventions: " + spaced(engines::conventions_text(test.declared.conventions))};
  const auto hits = std::count_if(test.questions.begin(), test.questions.end(),
                                  [](const CertainQuestion& question) { return question.certain.hit; });
  file.write(standalone_test(test));
  file.commit();
  say("{}: {} questions, {} of them hits; fill in its function engine()\n", o.output, test.questions.size(), hits);
  if (!reasons.empty()) say("{}\n", reasons);
  if (test.questions.size() < o.count)
    say("only {} of {} questions were found that could be asked so\n", test.questions.size(), o.count);
}

}  // namespace

void add_export(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("export",
                                     "Write a test of its own, in your language\n"
                                     "One source file with questions and what is right: it needs nothing but the "
                                     "language, and the call of your engine, "
                                     "which you fill in.");
  auto o = std::make_shared<ExportOptions>();
  o->parsed = command;
  command->add_option("--language", o->language, "The language of the file")
      ->required()
      ->check(CLI::IsMember(kLanguageNames));
  command->add_option("--pair", o->pair, "The pair of shapes")->required()->check(CLI::IsMember(names_of(kPairs)));
  command
      ->add_option("--family", o->families,
                   "Only these families (default: all that have answers); `contact-oracle families` lists them")
      ->delimiter(',');
  command->add_option("--count", o->count, "How many questions, of all families together")
      ->capture_default_str()
      ->check(kFromOne);
  command->add_option("--seed", o->seed, "The seed of the questions")->capture_default_str()->check(kFromZero);
  command->add_option("--scalar", o->scalar, "The number format that the engine computes in")
      ->capture_default_str()
      ->check(CLI::IsMember(names_of(kScalars)));
  command->add_option("-o,--output", o->output, "The file")->type_name("FILE")->required();
  command->add_option("--tolerance", o->tolerance,
                      "length=L,relative=R,angle=A, as certify has it (default: 8 ulps of a number's scale, as at the "
                      "level `bounded`)");
  const Heading heading(*command, "What an answer means");
  const auto convention = [&](const char* option, std::string& value, const auto& names, const char* about) {
    command->add_option(option, value, about)->capture_default_str()->check(CLI::IsMember(names));
  };
  convention("--normal", o->normal, kNormalDirectionNames, "The direction of the normal; none: it is not checked");
  convention("--normal-unit", o->normal_unit, kTruthNames, "Whether the normal has length 1");
  convention("--points", o->points, kPointsNames, "Where the contact points lie");
  convention("--value", o->value, kValueKindNames, "The distance of the surfaces, its negative, or not checked");
  convention("--value-less-contact", o->value_less_contact, kTruthNames,
             "Whether the contact distance has been subtracted");
  convention("--touching", o->touching, kTouchingNames, "Whether shapes that just touch are hits at alarm 0");
  convention("--margin", o->margin, kMarginNames,
             "Whether shapes just the alarm distance apart are hits; none: the alarm distance is not looked at");
  convention("--coincident", o->coincident, kCoincidentNames, "What is right where centres coincide, or cores meet");
  convention("--shapes", o->shapes, kShapesAsNames,
             "centered: only boxes, capsules and planes whose centre and size are numbers of the scalar");
  command->callback([o, &exit] {
    write_test(*o);
    exit = kCertified;
  });
}

}  // namespace contact::tool
