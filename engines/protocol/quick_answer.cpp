// The common form of an engine's answer, read in one pass over the text.
#include "engines/protocol/quick_answer.hpp"

#include <utility>

#include "formats/quick_json.hpp"

namespace contact::engines {
namespace {

using namespace formats::quick;
using Key = simdjson::ondemand::raw_json_string;

/// What has been said already is said twice, which is for read_answer to refuse.
template <class T>
bool read_once(Result<value> node, std::optional<T>& to) {
  return !to && read(node, to.emplace());
}

/// A contact whose points have their depths in a list of their own.
struct Lists {
  std::optional<std::vector<Vector3>> points;
  std::optional<std::vector<double>> depths;
};

bool read_field(Key key, Result<value> node, ContactClaim& contact, Lists& lists) {
  if (key == "normal") return read_once(node, contact.normal);
  if (key == "point1") return read_once(node, contact.point1);
  if (key == "point2") return read_once(node, contact.point2);
  if (key == "point") return read_once(node, contact.point);
  if (key == "points") return read_once(node, lists.points);
  if (key == "depths") return read_once(node, lists.depths);
  return key == "value" && read_once(node, contact.value);
}

bool read_contact(Result<value> node, Claim& claim) {
  if (std::exchange(claim.speaks_of_contact, true)) return false;
  bool is_null = false;
  if (node.is_null().get(is_null) != simdjson::SUCCESS) return false;
  if (is_null) return true;
  ContactClaim& contact = claim.contact.emplace();
  Lists lists;
  if (!read_object(node, [&](Key key, Result<value> x) { return read_field(key, x, contact, lists); })) return false;
  if (!lists.points && !lists.depths) return true;
  if (!lists.points || !lists.depths || lists.points->size() != lists.depths->size()) return false;
  for (std::size_t i = 0; i < lists.points->size(); ++i)
    contact.points.push_back({(*lists.points)[i], (*lists.depths)[i]});
  return true;
}

}  // namespace

std::optional<Answer> quick_answer(std::string& line) {
  std::optional<std::string> op;
  std::optional<std::uint64_t> seq;
  Claim claim;
  const auto member = [&](Key key, Result<value> node) {
    if (key == "op") return read_once(node, op) && *op == "answer";
    if (key == "seq") return read_once(node, seq);
    if (key == "overlap") return read_once(node, claim.overlap);
    return key == "contact" && read_contact(node, claim);
  };
  if (!read_line(line, member) || !op || !seq) return std::nullopt;
  return Answer{*seq, std::move(claim)};
}

}  // namespace contact::engines
