// The families of generated questions: look-up, and what spheres and cubes share.
#include "golden/families.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace contact::golden {
namespace {

/// Committed families that no generator makes.
struct RecordedFamily {
  Pair pair;
  Family family;
};
constexpr std::string_view kUpstream = "compiled SOFA was asked these questions, and its answers are recorded";
constexpr RecordedFamily kRecorded[] = {
    {Pair::sphere_sphere,
     {"hardest", "", "the closest numbers known: for who computes with more digits and takes them for enough", nullptr,
      false, false, "it is a list of the closest numbers known, and a miss has no number"}},
    {Pair::sphere_sphere, {"upstream", "", kUpstream, nullptr, false}},
    {Pair::cube_cube, {"upstream", "", kUpstream, nullptr, false}},
};

std::vector<FamilyNote> notes(std::string_view Family::*why) {
  std::vector<FamilyNote> found;
  const auto add = [&](Pair pair, const Family& f) {
    if (!(f.*why).empty()) found.push_back({pair, f.name, f.*why});
  };
  for (const Pair pair : pairs_of_kinds()) {
    for (const Family& f : families_of(pair)) add(pair, f);
    for (const RecordedFamily& recorded : kRecorded)
      if (recorded.pair == pair) add(pair, recorded.family);
  }
  return found;
}

}  // namespace

std::span<const Family> families_of(Pair pair) {
  return std::visit([](const auto& shapes) { return families_of(static_cast<decltype(&shapes)>(nullptr)); },
                    description(pair).zeros());
}

const Family* find_family(Pair pair, std::string_view name) {
  const auto families = families_of(pair);
  const auto it = std::find_if(families.begin(), families.end(), [&](const Family& f) { return f.name == name; });
  return it == families.end() ? nullptr : &*it;
}

std::vector<FamilyNote> families_of_hits_alone() { return notes(&Family::hits_alone); }
std::vector<FamilyNote> families_kept() { return notes(&Family::kept_for); }

Query generate_query(Pair pair, const Family& family, Scalar scalar, Random::Key key, std::uint64_t index) {
  Random random(key, index);
  return family.make(pair, scalar, random);
}

std::string CommittedFile::path() const {
  return std::string(name(pair)) + "/" + std::string(family->name) +
         (scalar == Scalar::binary32 ? ".f32.jsonl" : ".jsonl");
}

std::vector<CommittedFile> committed_files() {
  std::vector<CommittedFile> files;
  for (const Pair pair : kPairs)
    for (const Family& family : families_of(pair))
      for (const Scalar scalar : kScalars)
        if (committed_count(pair) > 0 && (pair == pairs_of_kinds()[kind_of(pair)] || family.every_pair))
          files.push_back({pair, scalar, &family});
  return files;
}

void spoil(Query& query, Random& random) {
  // Every field takes its turn with NaN, both infinities and, for a length, a negative number; a box corner is
  // inverted instead.
  std::vector<double*> numbers;
  for_each_number(query, [&](const std::string&, double& x) { numbers.push_back(&x); });
  const int count = static_cast<int>(numbers.size());
  const auto which = static_cast<std::size_t>(random.turn(count));
  double& x = *numbers[which];
  switch (random.turn(4, count)) {
    case 0:
      x = std::numeric_limits<double>::quiet_NaN();
      return;
    case 1:
      x = std::numeric_limits<double>::infinity();
      return;
    case 2:
      x = -std::numeric_limits<double>::infinity();
      return;
    default:
      break;
  }
  const double amount = random.between(1, 8);
  int number = static_cast<int>(which);
  bool is_in_a_shape = false;
  for_each_shape(query, [&]<class Shape>(Shape& shape) {
    int size = 0;
    for_each_number(shape, [&](double) { ++size; });
    if (number >= 0 && number < size) {
      ShapeDescription<Shape>::break_a_rule(shape, number, amount);
      is_in_a_shape = true;
    }
    number -= size;
  });
  if (!is_in_a_shape) x = -amount;
}

}  // namespace contact::golden
