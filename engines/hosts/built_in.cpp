// The engines that are part of this program: production, and the seed's formulas as everybody computes them.
#include <algorithm>
#include <array>

#include "contact/pair_functions.hpp"
#include "engines/engine.hpp"
#include "formats/program.hpp"
#include "golden/plain.hpp"

namespace contact::engines {
namespace {

/// SOFA's computeIntersection of two cubes writes nothing: of a pair without numbers the overlap alone is claimed.
Claim claim_of(const Query& query, bool overlap, const std::optional<Contact>& contact) {
  Claim claim;
  claim.overlap = overlap;
  claim.speaks_of_contact = query.has_numbers();
  if (contact) claim.contact = {contact->normal, contact->point1, contact->point2, std::nullopt, contact->value};
  return claim;
}

template <Scalar kScalar>
Claim plain(const Query& query, PointConvention points) {
  return claim_of(query, golden::plain_overlap(query, kScalar),
                  golden::plain_contact(query, kScalar, contact_points(query, points)));
}

Claim published(const Query& query, PointConvention) { return production_answer(query, PointConvention::published); }

/// The questions one by one.
template <Claim (*kAnswer)(const Query&, PointConvention)>
std::vector<Claim> each(std::span<const Question> questions, PointConvention points) {
  std::vector<Claim> claims;
  claims.reserve(questions.size());
  for (const Question& question : questions) claims.push_back(kAnswer(question.query, points));
  return claims;
}

bool all(Pair) { return true; }
constexpr std::array kBuiltIn{
    BuiltIn{"production", "this project's implementation: exact decisions, correctly rounded numbers", Scalar::binary64,
            true, each<production_answer>, all},
    BuiltIn{"batch", "production through its functions for many pairs; batch:AVX2 and so on choose the vectors",
            Scalar::binary64, false, batch_answers, batch_serves},
    BuiltIn{"component", "production through DiscreteIntersection and whole models", Scalar::binary64, false,
            each<component_answer>, component_serves},
    BuiltIn{"plain-double", "the seed's formulas in plain double arithmetic, as SOFA computes them", Scalar::binary64,
            true, each<plain<Scalar::binary64>>, all},
    BuiltIn{"plain-float", "the seed's formulas in plain float arithmetic", Scalar::binary32, true,
            each<plain<Scalar::binary32>>, all},
    BuiltIn{"published", "production with the contact points of the seed's printed formula", Scalar::binary64, true,
            each<published>, is_discrete_intersections},
};

}  // namespace

std::span<const BuiltIn> built_in_engines() { return kBuiltIn; }

std::unique_ptr<Engine> make_built_in(std::string_view name, PointConvention points) {
  std::string_view listed = name;
  if (name.starts_with(kBatchPrefix)) {
    use_batch_instruction_set(name.substr(kBatchPrefix.size()));
    listed = "batch";
  }
  const auto it = std::find_if(kBuiltIn.begin(), kBuiltIn.end(), [&](const BuiltIn& e) { return e.name == listed; });
  if (it == kBuiltIn.end()) return nullptr;
  engines::EngineInfo info;
  info.name = name;
  info.version = formats::version();
  std::erase_if(info.pairs, [it](Pair pair) { return !it->serves(pair); });
  info.declared.scalar = it->scalar;
  info.declared.conventions.points = static_cast<Points>(points);
  // `batch` fills its vectors with the questions beside one.
  return std::make_unique<FunctionEngine>(
      std::move(info), [it, points](std::span<const Question> questions) { return it->answer(questions, points); },
      it->answer != batch_answers);
}

Claim production_answer(const Query& query, PointConvention points) {
  if (const auto error = outside_domain(query)) return rejection(*error);
  return std::visit(
      [&](const auto& shapes) {
        return claim_of(query, is_hit(shapes, query.distances),
                        contact_of(shapes, query.distances, contact_points(query, points)));
      },
      query.shapes);
}

ContactPoints contact_points(const Query& query, PointConvention convention) {
  const auto kind = [](bool rigid) { return rigid ? SphereKind::rigid : SphereKind::deformable; };
  return {point_on(convention, kind(query.first_is_rigid())), point_on(convention, kind(query.second_is_rigid()))};
}

Claim rejection(const DomainError& error) { return Claim::without(Claim::Status::rejected, error.field); }

}  // namespace contact::engines
