// Engines with one mistake each: the list of all, and how one answers.
#include "engines/zoo/mutants.hpp"

#include <vector>

#include "engines/zoo/mutating.hpp"
#include "formats/program.hpp"

namespace contact::engines {

std::span<const Mutant> mutants() {
  static const std::vector<Mutant> all = [] {
    std::vector<Mutant> list;
    const auto append = [&](std::span<const Mutant> some, Origin origin) {
      for (Mutant m : some) {
        m.origin = m.source.empty() ? origin : Origin::real;
        list.push_back(m);
      }
    };
    append(real_mutants(), Origin::real);
    append(feature_mutants(), Origin::own);
    append(plane_mutants(), Origin::own);
    append(crossing_mutants(), Origin::own);
    append(reported_mutants(), Origin::own);
    append(cast_mutants(), Origin::own);
    append(convex_mutants(), Origin::own);
    append(own_mutants(), Origin::own);
    append(precision_mutants(), Origin::precision);
    return list;
  }();
  return all;
}

namespace {

/// What is made of a question, kept for the next one to ask: many mutants are put to one question.
template <class Made>
class Kept {
 public:
  template <class Make>
  const Made& of(const Query& query, Make make) {
    std::vector<double> numbers;
    for_each_number_unnamed(query, [&](double x) { numbers.push_back(x); });
    if (!made_ || pair_ != query.pair || numbers_ != numbers) {
      made_ = make(query);
      pair_ = query.pair;
      numbers_ = std::move(numbers);
    }
    return *made_;
  }

 private:
  std::optional<Made> made_;
  Pair pair_{};
  std::vector<double> numbers_;
};

}  // namespace

const oracle::Truth& truth_again(const Query& q) {
  thread_local Kept<oracle::Truth> kept;
  return kept.of(q, [](const Query& query) { return oracle::truth_of(query); });
}

Claim answer_of(const Mutant& mutant, const Query& query) {
  if (const auto error = outside_domain(query)) {
    Claim claim = rejection(*error);
    if (mutant.outside_domain) mutant.change(query, claim);
    return claim;
  }
  Query asked = query;
  if (mutant.ask != nullptr) mutant.ask(asked);
  // What overflows in the mistake stays the largest number: production refuses infinities.
  const double largest = std::numeric_limits<double>::max();
  for_each_number(asked, [largest](const std::string&, double& x) { x = std::clamp(x, -largest, largest); });
  thread_local Kept<Claim> kept;
  Claim claim = kept.of(asked, [](const Query& q) { return production_answer(q, PointConvention::nearest_surface); });
  if (mutant.change != nullptr && !mutant.outside_domain) mutant.change(query, claim);
  return claim;
}

std::unique_ptr<Engine> make_mutant(std::string_view id) {
  const auto all = mutants();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Mutant& mutant) { return mutant.id == id; });
  if (found == all.end()) return nullptr;
  engines::EngineInfo info;
  info.name = std::string(kMutantPrefix) + std::string(id);
  info.version = formats::version();
  info.declared.scalar = found->scalar;
  const auto answer = [&mutant = *found](std::span<const Question> questions) {
    std::vector<Claim> claims;
    claims.reserve(questions.size());
    for (const Question& question : questions) claims.push_back(answer_of(mutant, question.query));
    return claims;
  };
  return std::make_unique<FunctionEngine>(std::move(info), answer, true);
}

namespace {

/// The contact of a segment that does not reach its triangle, or passes by it: where the line goes through the plane.
void cross_anyway(const Query& query, Claim& claim) {
  const auto cross = [&](const oracle::CrossingInReals& crossing) {
    const Vector3 at = crossing.at_vector().cast<double>();
    claim.contact = ContactClaim{crossing.normal_vector().cast<double>().eval(), at, at, std::nullopt, 0.0};
  };
  if (const auto* ray = std::get_if<RayAndTriangle>(&query.shapes)) cross(oracle::CrossingInReals(*ray));
  if (const auto* line = std::get_if<TriangleAndLine>(&query.shapes)) cross(oracle::CrossingInReals(*line));
}

/// The contact of a ray that misses: where its line enters the shape, or where it begins.
void cast_anyway(const Query& query, Claim& claim) {
  claim.contact = oracle::of_cast(query.shapes, [](const auto& cast) -> std::optional<ContactClaim> {
    const Wide t = cast.first().value_or(0);
    const auto vector = [](const auto& v) { return Wide3(v[0], v[1], v[2]).template cast<double>().eval(); };
    const Vector3 at = vector(cast.at(t));
    return ContactClaim{vector(cast.normal(t)), at, at, std::nullopt, rounded(t)};
  });
}

}  // namespace

void decide(const Query& query, Claim& claim, bool hit) {
  claim.overlap = hit;
  if (!query.has_numbers()) return;
  if (!hit) claim.contact.reset();
  if (!hit || claim.contact) return;
  if (is_crossing(query.pair)) return cross_anyway(query, claim);
  if (is_cast(query.pair)) return cast_anyway(query, claim);
  Query surely = query;
  surely.distances.alarm = std::numeric_limits<double>::max();
  claim.contact = production_answer(surely, PointConvention::nearest_surface).contact;
  if (claim.contact) return;
  // The surfaces are apart by more than the largest number.
  const oracle::Truth as_a_hit = oracle::truth_with(query, oracle::Side::within, oracle::Side::within);
  const Contact right = oracle::expectation(as_a_hit, Scalar::binary64).contact.value();
  claim.contact = ContactClaim{right.normal, right.point1, right.point2, std::nullopt, right.value};
}

void guard(const Query& q, Claim& claim, Wide size, const Vector3& normal) {
  if (q.has_distance() && WideSpheres(q).distance <= size) turn(q, claim, [&](Vector3& n) { n = normal; });
}

void answer_at(const Query& q, Claim& claim, const Wide3& p, const Wide3& r) {
  const std::array<WideBall, 2> right = wide_balls(q);
  const WideBall& a = right[0];
  const WideBall& b = right[1];
  const Wide moved = (p - a.center).norm() + (r - b.center).norm();
  if (moved <= 1e-17L * (a.center.norm() + b.center.norm())) return;
  const Wide r2 = b.radius;
  const Wide3 d = r - p;
  const Wide distance = d.norm();
  decide(q, claim, distance <= a.radius + r2 + static_cast<Wide>(q.distances.alarm));
  in_contact(claim, [&](ContactClaim& c) {
    if (distance > 0) c.normal = Vector3((d / distance).cast<double>());
    const Wide3 n = c.normal->cast<Wide>();
    c.point1 = Vector3((p + a.radius * n).cast<double>());
    c.point2 = Vector3((r - r2 * n).cast<double>());
    c.value = rounded(distance - a.radius - r2 - static_cast<Wide>(q.distances.contact));
  });
}

}  // namespace contact::engines
