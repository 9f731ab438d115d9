// Production's answers to generated questions, as the bytes of a digest.
#include "golden/production.hpp"

#include <optional>

#include "contact/cube_cube.hpp"
#include "contact/sphere_sphere.hpp"
#include "golden/answer_bytes.hpp"

namespace contact::golden {

bool production_answers(const CommittedFile& stream) {
  return stream.scalar == Scalar::binary64 || stream.pair == Pair::cube_cube || stream.family->outside_domain;
}

std::string production_bytes(const Query& query) {
  if (const auto error = outside_domain(query)) return digest_bytes(*error);
  if (const Boxes* boxes = query.boxes())
    return digest_bytes(Expectation{test_cube_cube(boxes->a, boxes->b, query.distances.alarm), std::nullopt});
  const auto contact = compute_sphere_sphere(query.balls()->a, query.balls()->b, query.distances);
  return digest_bytes(Expectation{contact.has_value(), contact});
}

}  // namespace contact::golden
