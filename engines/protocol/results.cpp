// What engines say on paper: claims and declarations in JSON, and the results file that records them.
#include "engines/protocol/results.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engines/protocol/result_columns.hpp"
#include "golden/dataset.hpp"
#include "golden/query_id.hpp"

namespace contact::engines {
namespace {

constexpr double kLeastBound = 1;
constexpr double kLargestBound = 64;

template <class Enum, std::size_t N>
void read_choice(const formats::Node& node, std::string_view key, const std::array<std::string_view, N>& names,
                 Enum& choice) {
  if (const auto found = node.find(key)) choice = static_cast<Enum>(found->one_of(names));
}

/// The range of numbers that conventions or a tolerance serve.
void read_scale(const formats::Node& node, auto& of) {
  node.allow_only({"min", "max"});
  of.scale_min = node.at("min").number();
  of.scale_max = node.at("max").number();
  if (!(of.scale_min >= 0 && of.scale_min <= of.scale_max)) node.refuse("expected 0 <= min <= max");
}

bool has_scale(const auto& of) { return of.scale_min != 0 || std::isfinite(of.scale_max); }

std::string scale_text(const auto& of) {
  return fmt::format(R"(,"scale":{{"min":{},"max":{}}})", formats::number(of.scale_min), formats::number(of.scale_max));
}

/// A key that is absent stays as it is in `c`.
Conventions read_conventions(const formats::Node& node, Conventions c = {}) {
  node.allow_only({"normal", "normal_unit", "points", "value", "value_less_contact", "touching_overlap",
                   "touching_contact", "margin", "coincident", "shapes", "depth", "most_points", "scale"});
  read_choice(node, "normal", kNormalDirectionNames, c.normal);
  if (const auto unit = node.find("normal_unit")) c.normal_unit = unit->boolean();
  read_choice(node, "points", kPointsNames, c.points);
  read_choice(node, "value", kValueKindNames, c.value);
  if (const auto less = node.find("value_less_contact")) c.value_less_contact = less->boolean();
  read_choice(node, "touching_overlap", kTouchingNames, c.touching_overlap);
  read_choice(node, "touching_contact", kTouchingNames, c.touching_contact);
  read_choice(node, "margin", kMarginNames, c.margin);
  read_choice(node, "coincident", kCoincidentNames, c.coincident);
  read_choice(node, "shapes", kShapesAsNames, c.shapes);
  read_choice(node, "depth", kDepthOfNames, c.depth);
  if (const auto most = node.find("most_points")) {
    const std::uint64_t points = most->count();
    if (points < 1 || points > kMostPoints) most->refuse(fmt::format("a contact has 1 to {} points", kMostPoints));
    c.most_points = static_cast<int>(points);
  }
  if (const auto scale = node.find("scale")) read_scale(*scale, c);
  return c;
}

DeclaredBounds read_bounds(const formats::Node& node) {
  node.allow_only({"value", "normal", "point"});
  DeclaredBounds bounds;
  for (const auto& [key, bound] :
       {std::pair{"value", &bounds.value}, {"normal", &bounds.normal}, {"point", &bounds.point}})
    if (const auto found = node.find(key)) {
      *bound = found->number();
      if (!(*bound >= kLeastBound && *bound <= kLargestBound)) found->refuse("a declared bound is 1 to 64 ulps");
    }
  return bounds;
}

constexpr double kHalfTurn = 3.15;  // a little more: at that a normal may point anywhere

/// What an engine declares to claim. A number is one of a contact, so it speaks of the contact too.
Aspects read_claims(const formats::Node& node, const EngineInfo& info) {
  Aspects claims;
  for (const formats::Node& item : node.items()) {
    const auto aspect = static_cast<Aspect>(item.one_of(kAspectNames));
    const bool spoken = spoken_of(info.declared.conventions).has(aspect) ||
                        std::any_of(info.pair_conventions.begin(), info.pair_conventions.end(),
                                    [&](const auto& of_pair) { return spoken_of(of_pair.second).has(aspect); });
    if (!spoken) item.refuse("the engine's conventions say that it gives none");
    claims.add(aspect);
    if (aspect > Aspect::contact) claims.add(Aspect::contact);
  }
  if (claims.empty()) node.refuse("an engine that claims nothing cannot be judged");
  return claims;
}

}  // namespace

Tolerance read_tolerance(const formats::Node& node) {
  node.allow_only({"length", "relative", "angle", "scale"});
  Tolerance t;
  for (const auto& [key, part] : {std::pair{"length", &t.length}, {"relative", &t.relative}, {"angle", &t.angle}})
    if (const auto found = node.find(key)) {
      *part = found->number();
      if (!(*part >= 0 && std::isfinite(*part))) found->refuse("a tolerance is finite and not negative");
      if (part == &t.angle && t.angle > kHalfTurn) found->refuse("an angle is in radians, up to half a turn");
    }
  if (const auto scale = node.find("scale")) read_scale(*scale, t);
  return t;
}

bool EngineInfo::serves(Pair pair) const { return std::find(pairs.begin(), pairs.end(), pair) != pairs.end(); }

oracle::Declaration EngineInfo::declared_for(Pair pair) const {
  oracle::Declaration of_pair = declared;
  if (const auto own = pair_conventions.find(pair); own != pair_conventions.end()) of_pair.conventions = own->second;
  return of_pair;
}

EngineInfo read_engine_info(const formats::Node& node, std::initializer_list<std::string_view> beside) {
  std::vector<std::string_view> known{"engine", "scalar", "pairs",     "conventions", "pair_conventions",
                                      "bounds", "claims", "tolerance", "rounds"};
  known.insert(known.end(), beside);
  node.allow_only(known);
  EngineInfo info;
  const formats::Node engine = node.at("engine");
  engine.allow_only({"name", "version"});
  info.name = engine.at("name").text();
  info.version = engine.at("version").text();
  info.declared.scalar = golden::read_scalar(node.at("scalar"));
  info.pairs.clear();
  for (const formats::Node& pair : node.at("pairs").items()) info.pairs.push_back(golden::read_pair(pair));
  if (const auto conventions = node.find("conventions")) info.declared.conventions = read_conventions(*conventions);
  if (const auto of_pairs = node.find("pair_conventions")) {
    std::vector<std::string_view> served;
    for (const Pair pair : info.pairs) served.push_back(name(pair));
    of_pairs->allow_only(served);
    for (const Pair pair : info.pairs)
      if (const auto own = of_pairs->find(name(pair)))
        info.pair_conventions[pair] = read_conventions(*own, info.declared.conventions);
  }
  if (const auto bounds = node.find("bounds")) info.declared.bounds = read_bounds(*bounds);
  if (const auto claims = node.find("claims")) info.declared.claims = read_claims(*claims, info);
  if (const auto tolerance = node.find("tolerance")) info.declared.tolerance = read_tolerance(*tolerance);
  if (const auto rounds = node.find("rounds"))
    for (const formats::Node& item : rounds->items()) {
      static_cast<void>(item.one_of(oracle::kRoundsNames));
      info.declared.rounds_orientation = true;
    }
  return info;
}

namespace {

std::string conventions_with(const Conventions& c, bool scale) {
  const auto pick = [](const auto& names, auto choice) { return names[static_cast<std::size_t>(choice)]; };
  std::string text = fmt::format(
      R"({{"normal":"{}","normal_unit":{},"points":"{}","value":"{}","value_less_contact":{},"touching_overlap":"{}","touching_contact":"{}","margin":"{}","coincident":"{}","shapes":"{}","depth":"{}")",
      pick(kNormalDirectionNames, c.normal), c.normal_unit, pick(kPointsNames, c.points),
      pick(kValueKindNames, c.value), c.value_less_contact, pick(kTouchingNames, c.touching_overlap),
      pick(kTouchingNames, c.touching_contact), pick(kMarginNames, c.margin), pick(kCoincidentNames, c.coincident),
      pick(kShapesAsNames, c.shapes), pick(kDepthOfNames, c.depth));
  if (c.points == Points::manifold) text += fmt::format(R"(,"most_points":{})", c.most_points);
  return text + (scale ? scale_text(c) : "") + "}";
}

}  // namespace

std::string conventions_text(const Conventions& c) { return conventions_with(c, has_scale(c)); }

std::string tolerance_object(const Tolerance& t) {
  return fmt::format(R"({{"length":{},"relative":{},"angle":{}{}}})", formats::number(t.length),
                     formats::number(t.relative), formats::number(t.angle), has_scale(t) ? scale_text(t) : "");
}

std::string pair_conventions_text(const EngineInfo& engine) {
  const bool scale = has_scale(engine.declared.conventions);  // which a pair without one of its own would have too
  std::string text;
  for (const auto& [pair, conventions] : engine.pair_conventions)
    text += fmt::format(R"({}"{}":{})", text.empty() ? "" : ",", name(pair),
                        conventions_with(conventions, scale || has_scale(conventions)));
  return text.empty() ? text : fmt::format(R"("pair_conventions":{{{}}},)", text);
}

std::string rounds_text(const EngineInfo& engine) {
  return engine.declared.rounds_orientation ? fmt::format(R"(,"rounds":["{}"])", oracle::kRoundsNames[0]) : "";
}

std::string engine_text(const EngineInfo& engine) {
  std::string pairs;
  for (const Pair pair : engine.pairs) pairs += fmt::format("{}\"{}\"", pairs.empty() ? "" : ",", name(pair));
  const DeclaredBounds& b = engine.declared.bounds;
  std::string claims;
  if (engine.declared.claims)
    claims = fmt::format(R"(,"claims":["{}"])", fmt::join(engine.declared.claims->names(), R"(",")"));
  const std::string tolerance =
      engine.declared.tolerance ? fmt::format(R"(,"tolerance":{})", tolerance_object(*engine.declared.tolerance)) : "";
  return fmt::format(
      R"("engine":{{"name":{},"version":{}}},"scalar":"{}","pairs":[{}],"conventions":{},{}"bounds":{{"value":{},"normal":{},"point":{}}}{}{}{})",
      formats::json_string(engine.name), formats::json_string(engine.version), name(engine.declared.scalar), pairs,
      conventions_text(engine.declared.conventions), pair_conventions_text(engine), formats::number(b.value),
      formats::number(b.normal), formats::number(b.point), claims, tolerance, rounds_text(engine));
}

std::string to_line(const EngineInfo& engine) {
  return fmt::format(R"({{"format":"{}","version":{},{}}})", kResultsFormat, kResultsVersion, engine_text(engine));
}

std::uint64_t settle_decimals(Claim& claim, Scalar scalar) {
  std::uint64_t settled = 0;
  if (scalar != Scalar::binary32 || !claim.contact) return settled;
  const auto settle = [&](double& x) {
    if (const auto meant = formats::written_for_binary32(x)) {
      x = *meant;
      ++settled;
    }
  };
  for (std::optional<Vector3>* v :
       {&claim.contact->normal, &claim.contact->point1, &claim.contact->point2, &claim.contact->point})
    if (*v)
      for (double& x : **v) settle(x);
  for (ManifoldPoint& point : claim.contact->points) {
    for (double& x : point.at) settle(x);
    settle(point.depth);
  }
  if (claim.contact->value) settle(*claim.contact->value);
  return settled;
}

namespace {

/// The points of a manifold, and in a list of its own how deep the shapes are in each other at each.
std::vector<ManifoldPoint> read_points(const formats::Node& contact) {
  std::vector<ManifoldPoint> points;
  const formats::Node places = contact.at("points");
  const formats::Node depths = contact.at("depths");
  for (const formats::Node& place : places.items()) points.push_back({place.vector(), 0});
  if (points.empty() || points.size() > kMostPoints)
    places.refuse(fmt::format("a contact has 1 to {} points", kMostPoints));
  const auto items = depths.items();
  if (items.size() != points.size())
    depths.refuse(fmt::format("has {} numbers, and points has {}: each has a depth", items.size(), points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) points[i].depth = items[i].number();
  return points;
}

}  // namespace

Claim read_claim(const formats::Node& node) {
  Claim claim;
  for (const auto status : {Claim::Status::unsupported, Claim::Status::rejected, Claim::Status::error})
    if (const auto said = node.find(name(status))) {
      if (claim.status != Claim::Status::answered) said->refuse("an answer is one of unsupported, rejected and error");
      claim.status = status;
      claim.text = said->text();
    }
  if (const auto overlap = node.find("overlap")) claim.overlap = overlap->boolean();
  if (const auto contact = node.find("contact")) {
    claim.speaks_of_contact = true;
    if (!contact->is_null()) {
      contact->allow_only({"normal", "point1", "point2", "point", "points", "depths", "value"});
      ContactClaim numbers;
      for (const auto& [key, v] : {std::pair{"normal", &numbers.normal},
                                   {"point1", &numbers.point1},
                                   {"point2", &numbers.point2},
                                   {"point", &numbers.point}})
        if (const auto found = contact->find(key)) *v = found->vector();
      if (contact->find("points") || contact->find("depths")) numbers.points = read_points(*contact);
      if (const auto value = contact->find("value")) numbers.value = value->number();
      claim.contact = numbers;
    }
  }
  if (claim.status != Claim::Status::answered && (claim.overlap || claim.speaks_of_contact))
    node.refuse("an answer claims something, or says why not");
  return claim;
}

std::string to_line(const std::string& id, const Claim& claim) {
  return fmt::format(R"({{"id":"{}"{}}})", id, claim_text(claim));
}

std::string claim_text(const Claim& claim) {
  std::string text;
  if (claim.overlap) text += fmt::format(R"(,"overlap":{})", *claim.overlap);
  if (claim.speaks_of_contact && !claim.contact) text += R"(,"contact":null)";
  if (claim.contact) {
    std::string fields;
    const auto add = [&](std::string_view key, const std::string& value) {
      fields += fmt::format(R"({}"{}":{})", fields.empty() ? "" : ",", key, value);
    };
    if (claim.contact->normal) add("normal", formats::number(*claim.contact->normal));
    if (claim.contact->point1) add("point1", formats::number(*claim.contact->point1));
    if (claim.contact->point2) add("point2", formats::number(*claim.contact->point2));
    if (claim.contact->point) add("point", formats::number(*claim.contact->point));
    if (const auto& points = claim.contact->points; !points.empty()) {
      std::vector<std::string> places;
      std::vector<std::string> depths;
      for (const ManifoldPoint& point : points) {
        places.push_back(formats::number(point.at));
        depths.push_back(formats::number(point.depth));
      }
      add("points", fmt::format("[{}]", fmt::join(places, ",")));
      add("depths", fmt::format("[{}]", fmt::join(depths, ",")));
    }
    if (claim.contact->value) add("value", formats::number(*claim.contact->value));
    text += R"(,"contact":{)" + fields + "}";
  }
  // What only a host says of an engine, that it crashed or gave no answer in time, is written as an error.
  if (claim.status != Claim::Status::answered)
    text += fmt::format(R"(,"{}":{})", name(std::min(claim.status, Claim::Status::error)),
                        formats::json_string(claim.text));
  return text;
}

std::string claim_object(const Claim& claim) {
  const std::string text = claim_text(claim);
  return "{" + text.substr(std::min<std::size_t>(1, text.size())) + "}";
}

void check_results_format(const formats::Node& header) {
  if (const formats::Node format = header.at("format"); format.text() != kResultsFormat)
    format.refuse(fmt::format("expected \"{}\"", kResultsFormat));
  if (const formats::Node version = header.at("version"); version.count() != kResultsVersion)
    version.refuse(fmt::format("this program reads version {}", kResultsVersion));
}

namespace {

Results read_columns(const std::filesystem::path& path, formats::ArraysForm form) {
  ResultColumns columns(path, form);
  if (!columns.has_ids())
    throw formats::InputError({path.string(), 0}, "/id",
                              "missing: without ids the rows answer the questions of one dataset, in their order");
  Results results{columns.engine(), {}};
  for (std::uint64_t row = 0; row < columns.rows(); ++row)
    if (!results.claims.emplace(columns.id(row), columns.claim(row)).second)
      throw formats::InputError(columns.where(row), "/id", "this question is answered twice");
  return results;
}

}  // namespace

Results read_results(const std::filesystem::path& path) {
  if (const auto form = formats::arrays_form(path)) return read_columns(path, *form);
  std::ifstream stream = formats::open_to_read(path);
  formats::Location where{path.string(), 0};
  Results results;
  for (std::string line; formats::read_line(stream, line, where);) {
    if (stream.eof()) throw formats::InputError(where, "", "the last line has no line feed: the file is truncated");
    const auto json = formats::parse_object(line, where);
    const formats::Node node(json, where);
    if (where.line == 1) {
      check_results_format(node);
      results.engine = read_engine_info(node, {"format", "version"});
      continue;
    }
    node.allow_only({"id", "overlap", "contact", "unsupported", "rejected", "error"});
    const formats::Node id = node.at("id");
    if (!golden::is_query_id(id.text()))
      id.refuse(fmt::format("expected the {} hexadecimal digits of a question's id", golden::kIdLength));
    Claim claim = read_claim(node);
    results.decimals += settle_decimals(claim, results.engine.declared.scalar);
    if (!results.claims.emplace(id.text(), std::move(claim)).second) id.refuse("this question is answered twice");
  }
  if (where.line == 0) throw formats::InputError(where, "", "empty: a results file begins with its header");
  return results;
}

}  // namespace contact::engines
