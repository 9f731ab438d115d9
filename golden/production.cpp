// Production's answers to generated questions, as the bytes of a digest.
#include "golden/production.hpp"

#include <optional>

#include "contact/pair_functions.hpp"
#include "golden/answer_bytes.hpp"

namespace contact::golden {

bool production_answers(const CommittedFile& stream) {
  return stream.scalar == Scalar::binary64 || !has_numbers(stream.pair) || stream.family->outside_domain;
}

std::string production_bytes(const Query& query) {
  if (const auto error = outside_domain(query)) return digest_bytes(*error);
  return std::visit(
      [&](const auto& shapes) {
        if (!query.has_numbers()) return digest_bytes(Expectation{is_hit(shapes, query.distances), std::nullopt});
        const auto contact = contact_of(shapes, query.distances);
        return digest_bytes(Expectation{contact.has_value(), contact});
      },
      query.shapes);
}

}  // namespace contact::golden
