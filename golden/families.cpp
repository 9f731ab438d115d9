// The families of generated questions: look-up, and what spheres and cubes share.
#include "golden/families.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace contact::golden {

std::span<const Family> families_of(Pair pair) { return pair == Pair::cube_cube ? cube_families() : sphere_families(); }

const Family* find_family(Pair pair, std::string_view name) {
  const auto families = families_of(pair);
  const auto it = std::find_if(families.begin(), families.end(), [&](const Family& f) { return f.name == name; });
  return it == families.end() ? nullptr : &*it;
}

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
        if (pair == Pair::sphere_sphere || pair == Pair::cube_cube || family.every_sphere_kind)
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
  if (Boxes* boxes = std::get_if<Boxes>(&query.shapes); boxes != nullptr && which < 12) {
    Box& box = which < 6 ? boxes->a : boxes->b;
    const auto axis = static_cast<Eigen::Index>(which % 3);
    std::swap(box.min[axis], box.max[axis]);
  } else if (which < 8) {
    auto& balls = std::get<Balls>(query.shapes);
    (which < 4 ? balls.a : balls.b).radius = -amount;
  } else {
    x = -amount;
  }
}

}  // namespace contact::golden
