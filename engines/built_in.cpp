// The engines that are part of this program: production, and the seed's formulas as everybody computes them.
#include <algorithm>
#include <array>

#include "contact/cube_cube.hpp"
#include "contact/sphere_sphere.hpp"
#include "engines/engine.hpp"
#include "golden/plain.hpp"

namespace contact::engines {
namespace {

ContactClaim claim_of(const Contact& c) { return {c.normal, c.point1, c.point2, std::nullopt, c.value}; }

Claim spheres_claim(bool overlap, const std::optional<Contact>& contact) {
  Claim claim;
  claim.overlap = overlap;
  claim.speaks_of_contact = true;
  if (contact) claim.contact = claim_of(*contact);
  return claim;
}

/// SOFA's computeIntersection of two cubes writes nothing, so cubes claim their overlap alone.
Claim cubes_claim(bool overlap) {
  Claim claim;
  claim.overlap = overlap;
  return claim;
}

Claim production(const Query& query, Points points) {
  if (const auto error = outside_domain(query)) {
    Claim claim;
    claim.status = Claim::Status::rejected;
    claim.text = error->field;
    return claim;
  }
  if (const Boxes* boxes = query.boxes()) return cubes_claim(test_cube_cube(boxes->a, boxes->b, query.distances.alarm));
  const Balls& balls = *query.balls();
  return spheres_claim(test_sphere_sphere(balls.a, balls.b, query.distances.alarm),
                       compute_sphere_sphere(balls.a, balls.b, query.distances, contact_points(query, points)));
}

template <class Real>
Claim plain(const Query& query, Points points) {
  if (const Boxes* boxes = query.boxes())
    return cubes_claim(golden::plain_cubes_overlap<Real>(*boxes, query.distances));
  const golden::PlainSpheres<Real> spheres(*query.balls(), query.distances);
  return spheres_claim(spheres.overlap(), spheres.contact(contact_points(query, points)));
}

Claim published(const Query& query, Points) { return production(query, Points::published); }

constexpr std::array kBuiltIn{
    BuiltIn{"production", "this project's implementation: exact decisions, correctly rounded numbers", Scalar::binary64,
            production},
    BuiltIn{"plain-double", "the seed's formulas in plain double arithmetic, as SOFA computes them", Scalar::binary64,
            plain<double>},
    BuiltIn{"plain-float", "the seed's formulas in plain float arithmetic", Scalar::binary32, plain<float>},
    BuiltIn{"published", "production with the contact points of the seed's printed formula", Scalar::binary64,
            published},
};

class BuiltInEngine final : public Engine {
 public:
  BuiltInEngine(const BuiltIn& engine, golden::EngineInfo info, Points points)
      : Engine(std::move(info)), engine_(engine), points_(points) {}

  std::vector<Claim> answer(std::span<const Question> questions) override {
    std::vector<Claim> claims;
    claims.reserve(questions.size());
    for (const Question& question : questions) claims.push_back(engine_.answer(question.query, points_));
    return claims;
  }

 private:
  const BuiltIn& engine_;
  Points points_;
};

}  // namespace

std::span<const BuiltIn> built_in_engines() { return kBuiltIn; }

std::unique_ptr<Engine> make_built_in(std::string_view name, Points points) {
  const auto it = std::find_if(kBuiltIn.begin(), kBuiltIn.end(), [&](const BuiltIn& e) { return e.name == name; });
  if (it == kBuiltIn.end()) return nullptr;
  golden::EngineInfo info;
  info.name = it->name;
  info.version = CONTACT_VERSION;
  info.declared.scalar = it->scalar;
  info.declared.conventions.points = points;
  return std::make_unique<BuiltInEngine>(*it, std::move(info), points);
}

ContactPoints contact_points(const Query& query, Points points) {
  const auto upstream = [](bool rigid) { return rigid ? PointOn::nearest_surface : PointOn::center; };
  switch (points) {
    case Points::center:
      return {upstream(query.first_is_rigid()), upstream(query.second_is_rigid())};
    case Points::published:
      return {PointOn::far_surface, PointOn::far_surface};
    default:
      return {};
  }
}

}  // namespace contact::engines
