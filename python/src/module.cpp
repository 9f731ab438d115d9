// The module contact_oracle._core: production, the oracle, the judge and the generators over NumPy arrays.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <bit>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <unordered_set>

#include "contact/pair_functions.hpp"
#include "engines/engine.hpp"
#include "formats/program.hpp"
#include "golden/agreement.hpp"
#include "golden/dataset.hpp"
#include "golden/dataset_writer.hpp"
#include "golden/families.hpp"
#include "golden/right_case.hpp"
#include "kernel/batch_pairs.hpp"
#include "oracle/gradient/gradient.hpp"
#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/staged_oracle.hpp"
#include "python/src/certify.hpp"
#include "python/src/columns.hpp"
#include "python/src/lock.hpp"
#include "tool/reports/explanation.hpp"
#include "tool/run/process.hpp"
#include "tool/run/profiles.hpp"

namespace contact::python {
namespace {

constexpr std::size_t kBlock = 512;  // pairs that are answered together: their columns stay in the nearest cache

template <class Names>
auto named(const Names& all, const std::string& text, std::string_view what) {
  for (const auto one : all)
    if (name(one) == text) return one;
  throw std::invalid_argument(fmt::format("unknown {} '{}'", what, text));
}
Pair pair_of(const std::string& text) { return named(kPairs, text, "pair"); }
Scalar scalar_of(const std::string& text) { return named(kScalars, text, "scalar"); }

/// Answers, in arrays of `Number`.
template <class Number>
class Answers {
 public:
  Answers(Pair pair, std::size_t size) : has_numbers_(has_numbers(pair)) {
    const auto n = static_cast<py::ssize_t>(size);
    hit_ = add<bool>("hit", {n});
    if (!has_numbers_) return;
    normal_ = add<Number>("normal", {n, 3});
    point1_ = add<Number>("point1", {n, 3});
    point2_ = add<Number>("point2", {n, 3});
    value_ = add<Number>("value", {n});
    degenerate_ = add<bool>("degenerate", {n});
    unique_ = add<bool>("unique", {n});
  }

  void set(std::size_t row, bool hit, const std::optional<Contact>& contact) {
    hit_[row] = hit;
    if (!has_numbers_) return;
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<Eigen::Index>(axis);
      normal_[3 * row + axis] = static_cast<Number>(contact ? contact->normal[at] : none);
      point1_[3 * row + axis] = static_cast<Number>(contact ? contact->point1[at] : none);
      point2_[3 * row + axis] = static_cast<Number>(contact ? contact->point2[at] : none);
    }
    value_[row] = static_cast<Number>(contact ? contact->value : none);
    degenerate_[row] = contact && contact->degenerate;
    unique_[row] = !contact || contact->unique;
  }
  [[nodiscard]] py::dict arrays() const { return arrays_; }

 private:
  template <class Value>
  Value* add(const char* name, const std::vector<py::ssize_t>& shape) {
    py::array_t<Value> array(shape);
    arrays_[name] = array;
    return array.mutable_data();
  }

  bool has_numbers_;
  py::dict arrays_;
  bool* hit_ = nullptr;
  Number* normal_ = nullptr;
  Number* point1_ = nullptr;
  Number* point2_ = nullptr;
  Number* value_ = nullptr;
  bool* degenerate_ = nullptr;
  bool* unique_ = nullptr;
};

/// Calls visit(row, question). Python's lock is not held meanwhile.
template <class Visit>
void for_each(const QuestionArrays& questions, Visit&& visit) {
  RowCount rows(name(questions.pair()), questions.size());
  Query query = zero_query(questions.pair());
  for (std::size_t row = 0; row < questions.size(); ++row) {
    questions.read_checked(row, query);
    visit(row, std::as_const(query));
    rows.add();
  }
}

/// Calls visit(row, contact) for some questions of two kinds of shapes with the same distances, in vectors.
template <class A, class B, class Visit>
void in_vectors(std::span<const Query> questions, ContactPoints points, batch::Pairs<A, B>& pairs, Visit&& visit) {
  for (std::size_t i = 0; i < pairs.size(); ++i)
    pairs.set(i, std::get<Two<A, B>>(questions[std::min(i, questions.size() - 1)].shapes));
  if constexpr (batch::Computes<A, B>) {
    pairs.compute(questions.front().distances, points);
    for (std::size_t i = 0; i < questions.size(); ++i) {
      const auto contact = pairs.contact(i);
      visit(i, contact.has_value(), contact);
    }
  } else {
    pairs.test(questions.front().distances.alarm);
    for (std::size_t i = 0; i < questions.size(); ++i) visit(i, pairs.hit()[i] != 0, std::nullopt);
  }
}

/// Calls visit(row, hit, contact) for every question.
template <class Visit>
void production(const QuestionArrays& questions, PointConvention convention, Visit&& visit) {
  RowCount rows(name(questions.pair()), questions.size());
  Query zeros = zero_query(questions.pair());
  std::visit(
      [&]<class A, class B>(const Two<A, B>&) {
        std::vector<Query> block(std::min(kBlock, questions.size()), zeros);
        const ContactPoints points = engines::contact_points(zeros, convention);
        const auto one = [&](std::size_t row, const Query& query) {
          const auto& shapes = std::get<Two<A, B>>(query.shapes);
          if constexpr (std::is_same_v<A, Box> && std::is_same_v<B, Box>) {
            visit(row, is_hit(shapes, query.distances), std::nullopt);
          } else {
            const auto contact = contact_of(shapes, query.distances, points);
            visit(row, contact.has_value(), contact);
          }
        };
        if constexpr (batch::Decides<A, B>) {
          batch::Pairs<A, B> pairs(block.size());
          for (std::size_t first = 0; first < questions.size(); first += kBlock) {
            const std::size_t count = std::min(kBlock, questions.size() - first);
            bool alike = true;
            for (std::size_t i = 0; i < count; ++i) {
              questions.read_checked(first + i, block[i]);
              alike = alike && block[i].distances.alarm == block[0].distances.alarm &&
                      block[i].distances.contact == block[0].distances.contact;
            }
            if (alike)
              in_vectors<A, B>(
                  std::span(block).first(count), points, pairs,
                  [&](std::size_t i, bool hit, const std::optional<Contact>& c) { visit(first + i, hit, c); });
            else
              for (std::size_t i = 0; i < count; ++i) one(first + i, block[i]);
            rows.add(count);
          }
        } else {
          for (std::size_t row = 0; row < questions.size(); ++row) {
            questions.read_checked(row, zeros);
            one(row, zeros);
            rows.add();
          }
        }
      },
      zero_query(questions.pair()).shapes);
}

/// Whether an exact real x has the same binary32 as its binary64 has, which is what production gives. The two can differ only
/// where the binary64 is halfway between two numbers of binary32, because rounding keeps the order and halfway is a binary64.
/// Where numbers of binary32 are normal, that is where the 29 bits which they lack are a one and zeros; elsewhere the
/// answer is no, but for 0.
bool rounds_alike(double x) {
  constexpr std::uint64_t kLacking = (std::uint64_t{1} << 29) - 1;
  const double size = std::abs(x);
  return x == 0 || (size >= std::numeric_limits<float>::min() && size <= std::numeric_limits<float>::max() &&
                    (std::bit_cast<std::uint64_t>(x) & kLacking) != (kLacking + 1) / 2);
}
bool rounds_alike(const Vector3& v) { return rounds_alike(v[0]) && rounds_alike(v[1]) && rounds_alike(v[2]); }
bool rounds_alike(const Contact& c) {
  return rounds_alike(c.value) && rounds_alike(c.normal) && rounds_alike(c.point1) && rounds_alike(c.point2);
}

/// In binary32 production's numbers are rounded again where this is the same as once, else the oracle rounds them.
template <class Number>
py::dict contacts_as(const QuestionArrays& questions, PointConvention convention) {
  Answers<Number> answers(questions.pair(), questions.size());
  {
    const WithoutLock no_lock;
    Query query = zero_query(questions.pair());
    production(questions, convention, [&](std::size_t row, bool hit, const std::optional<Contact>& c) {
      if (std::is_same_v<Number, double> || !c || rounds_alike(*c)) {
        answers.set(row, hit, c);
      } else {
        questions.read(row, query);
        answers.set(row, hit, oracle::staged_answer(query, Scalar::binary32).expected.contact);
      }
    });
  }
  return answers.arrays();
}

py::dict contacts(const std::string& pair, const py::list& columns, const py::array& alarm, const py::array& contact,
                  const std::string& points, const std::string& scalar) {
  const auto& names = engines::kComputedPointsNames;
  const auto it = std::find(names.begin(), names.end(), points);
  if (it == names.end())
    throw std::invalid_argument(fmt::format("unknown points '{}'; known: {}", points, fmt::join(names, ", ")));
  const auto convention = static_cast<PointConvention>(it - names.begin());
  const QuestionArrays questions(pair_of(pair), columns, alarm, contact);
  if (scalar_of(scalar) == Scalar::binary64) return contacts_as<double>(questions, convention);
  if (convention != PointConvention::nearest_surface)
    throw std::invalid_argument("of float32 only the points nearest_surface are answered");
  return contacts_as<float>(questions, convention);
}

py::array_t<bool> hits(const std::string& pair, const py::list& columns, const py::array& alarm,
                       const py::array& contact) {
  const QuestionArrays questions(pair_of(pair), columns, alarm, contact);
  py::array_t<bool> all(static_cast<py::ssize_t>(questions.size()));
  bool* hit = all.mutable_data();
  const WithoutLock no_lock;
  for_each(questions, [&](std::size_t row, const Query& query) {
    hit[row] = std::visit([&](const auto& shapes) { return is_hit(shapes, query.distances); }, query.shapes);
  });
  return all;
}

py::object ids(const std::string& pair, const py::list& columns, const py::array& alarm, const py::array& contact) {
  const QuestionArrays questions(pair_of(pair), columns, alarm, contact);
  QuestionColumns found(zero_query(questions.pair()), Scalar::binary64, questions.size());
  {
    const WithoutLock no_lock;
    for_each(questions, [&](std::size_t row, const Query& query) { found.set_id(row, golden::query_id(query)); });
  }
  return found.arrays()["id"];
}

std::vector<std::string> cases(const std::string& pair, const py::list& columns, const py::array& alarm,
                               const py::array& contact, const std::string& scalar) {
  const QuestionArrays questions(pair_of(pair), columns, alarm, contact);
  const Scalar rounded_to = scalar_of(scalar);
  std::vector<std::string> lines;
  const WithoutLock no_lock;
  for_each(questions, [&](std::size_t, const Query& query) {
    lines.push_back(golden::to_line(golden::make_case(query, rounded_to)));
  });
  return lines;
}

/// The derivatives by all numbers of the columns, in their order; of a vertex that is not there none. "why" says by its place in "reasons" why there is none.
py::dict gradients(const std::string& pair, const py::list& columns, const py::array& alarm, const py::array& contact) {
  const QuestionArrays questions(pair_of(pair), columns, alarm, contact);
  if (!has_distance(questions.pair()))
    throw std::invalid_argument(fmt::format("{} has no distance, and no derivatives are told of it", pair));
  std::vector<std::size_t> widths;
  for (const auto& column : columns) {
    const auto array = py::cast<py::array>(column);
    widths.push_back(static_cast<std::size_t>(array.size() / std::max<py::ssize_t>(array.shape(0), 1)));
  }
  const std::size_t width = std::accumulate(widths.begin(), widths.end(), std::size_t{0});
  const auto n = static_cast<py::ssize_t>(questions.size());
  const std::vector<py::ssize_t> shape{n, oracle::kOutputs, static_cast<py::ssize_t>(width)};
  py::array_t<double> derivatives(shape);
  py::array_t<double> sides({shape[0], shape[1], shape[2], py::ssize_t{2}});
  py::array_t<std::uint8_t> why(shape);
  std::vector<std::string> reasons{"", "no such vertex"};
  double* to = derivatives.mutable_data();
  double* to_sides = sides.mutable_data();
  std::uint8_t* to_why = why.mutable_data();
  {
    const WithoutLock no_lock;
    const double none = std::numeric_limits<double>::quiet_NaN();
    const std::size_t across = oracle::kOutputs * width;
    for_each(questions, [&](std::size_t row, const Query& query) {
      std::fill_n(to + row * across, across, none);
      std::fill_n(to_sides + 2 * row * across, 2 * across, none);
      std::fill_n(to_why + row * across, across, std::uint8_t{1});
      const auto found = oracle::gradient(query, oracle::truth_of(query));
      std::size_t k = 0;      // of the question's numbers
      std::size_t begin = 0;  // of the field's in a row
      std::size_t field = 0;
      for_each_value(query, [&](const auto& value) {
        if (field == widths.size()) return;  // the two distances
        std::size_t at = begin;
        for_each_number_in(value, [&](const double&) {
          for (std::size_t output = 0; output < oracle::kOutputs; ++output) {
            const oracle::Derivative& x = found->derivatives[k][output];
            const std::size_t place = (row * oracle::kOutputs + output) * width + at;
            to[place] = x.number.value_or(none);
            for (std::size_t side = 0; side < 2; ++side) to_sides[2 * place + side] = x.sides[side].value_or(none);
            const auto reason = std::find(reasons.begin(), reasons.end(), x.undefined);
            to_why[place] = static_cast<std::uint8_t>(reason - reasons.begin());
            if (reason == reasons.end()) reasons.emplace_back(x.undefined);
          }
          ++k, ++at;
        });
        begin += widths[field++];
      });
    });
  }
  py::dict all;
  all["derivatives"] = derivatives;
  all["sides"] = sides;
  all["why"] = why;
  all["reasons"] = py::cast(reasons);
  return all;
}

std::string explain(const std::string& line) {
  const formats::Location where{"question", 0};
  const auto parsed = formats::parse_object(line, where);
  const auto [query, scalar, decimals] = golden::read_query(formats::Node(parsed, where));
  if (const auto error = outside_domain(query)) throw OutsideDomain{error->field, 0, error->value, error->rule};
  return tool::explanation(query, oracle::truth_of(query), scalar);
}

py::list pairs() {
  py::list all;
  for (const Pair pair : kPairs) {
    const auto shape = [](const auto& s) {
      py::list fields;
      for_each_field(s, [&](const auto& field, const auto& value) {
        const py::tuple across = py::cast(extents_of(value));
        const std::string kind(kFieldKindNames[static_cast<std::size_t>(field.kind)]);
        py::dict one;
        one["name"] = std::string(field.name);
        one["kind"] = across.size() == 2 ? kind + "s" : kind;
        one["shape"] = across;
        one["any_number"] = AnyNumberOfVectors<decltype(value)>;
        fields.append(one);
      });
      py::dict found;
      found["shape"] = std::string(ShapeDescription<std::remove_cvref_t<decltype(s)>>::kName);
      found["fields"] = fields;
      return found;
    };
    const Query widest = widest_query(pair);
    py::dict one;
    one["name"] = std::string(name(pair));
    one["numbers"] = has_distance(pair) ? "distance" : is_crossing(pair) ? "crossing" : is_cast(pair) ? "cast" : "none";
    const char* key = "a";
    for_each_shape(widest, [&](const auto& of) { one[std::exchange(key, "b")] = shape(of); });
    all.append(one);
  }
  return all;
}

py::list families(const std::string& pair) {
  py::list all;
  for (const golden::Family& family : golden::families_of(pair_of(pair))) {
    py::dict one;
    one["name"] = std::string(family.name);
    one["reason"] = std::string(family.reason);
    one["outside_domain"] = family.outside_domain;
    all.append(one);
  }
  return all;
}

py::tuple generate(const std::string& pair, const std::string& family, std::uint64_t count, std::uint64_t seed,
                   const std::string& scalar, std::uint64_t first) {
  const Pair of = pair_of(pair);
  const golden::Family* generator = golden::find_family(of, family);
  if (generator == nullptr) throw std::invalid_argument(fmt::format("unknown family '{}' of {}", family, pair));
  const auto question = [&](std::uint64_t i) {
    return golden::generate_query(of, *generator, scalar_of(scalar), seed, first + i);
  };
  Query widest = zero_query(of);
  RowCount rows(family, has_hull(of) ? 2 * count : count);
  {
    const WithoutLock no_lock;
    for (std::uint64_t i = 0; has_hull(of) && i < count; ++i) widen(widest, question(i)), rows.add();
  }
  QuestionColumns columns(widest, scalar_of(scalar), count);
  {
    const WithoutLock no_lock;
    for (std::uint64_t i = 0; i < count; ++i) columns.set(i, question(i)), rows.add();
  }
  return columns.as_columns();
}

/// A column of numbers of a dataset's exact ones.
template <class Value>
py::array_t<Value> column(const std::vector<golden::Case>& all, Value oracle::Witness::*number) {
  py::array_t<Value> array(static_cast<py::ssize_t>(all.size()));
  std::transform(all.begin(), all.end(), array.mutable_data(), [&](const auto& c) { return c.exact.*number; });
  return array;
}

/// A column of texts, with so many in a row: read(case, i) is the i-th.
py::array texts(const std::vector<golden::Case>& all, std::size_t across, const auto& read) {
  std::size_t width = 1;
  for (const golden::Case& c : all)
    for (std::size_t i = 0; i < across; ++i) width = std::max(width, read(c, i).size());
  std::vector<std::size_t> shape{all.size()};
  if (across > 1) shape.push_back(across);
  const py::array array(py::dtype(fmt::format("S{}", width)), shape);
  auto* to = static_cast<char*>(const_cast<void*>(array.data()));
  std::memset(to, 0, width * across * all.size());
  for (const golden::Case& c : all)
    for (std::size_t i = 0; i < across; ++i, to += width) {
      const std::string_view text = read(c, i);
      std::copy(text.begin(), text.end(), to);
    }
  return array;
}

py::tuple read_dataset(const std::string& path) {
  golden::DatasetReader reader(path, golden::is_made);
  const golden::DatasetHeader header = reader.header();
  std::vector<golden::Case> all;
  {
    const WithoutLock no_lock;
    RowCount rows(path, header.count);
    while (auto c = reader.next()) all.push_back(std::move(*c)), rows.add();
  }
  Query widest = zero_query(header.pair);
  for (const golden::Case& c : all) widen(widest, c.query);
  QuestionColumns questions(widest, Scalar::binary64, all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    questions.set(i, all[i].query);
    questions.set_id(i, all[i].id);
  }
  py::dict arrays = questions.arrays();
  py::list flags;
  for (const golden::Case& c : all) flags.append(py::cast(c.flags));
  arrays["flags"] = flags;
  if (header.family == golden::kInvalidFamily) {
    arrays["expect/rejected"] =
        texts(all, 1, [](const golden::Case& c, std::size_t) -> std::string_view { return *c.rejected; });
    return py::make_tuple(to_line(header), arrays);
  }
  Answers<double> answers(header.pair, all.size());
  for (std::size_t i = 0; i < all.size(); ++i) answers.set(i, all[i].expect.hit, all[i].expect.contact);
  for (const auto& [name, array] : answers.arrays()) arrays[py::str("expect/" + py::cast<std::string>(name))] = array;
  const auto exact = [&](const char* name, std::size_t across, const auto& read) {
    arrays[name] = texts(all, across, [&](const golden::Case& c, std::size_t i) { return read(c.exact, i); });
  };
  using oracle::Witness;
  using Text = std::string_view;
  if (!has_numbers(header.pair)) {
    exact("exact/gap", 3, [](const Witness& w, std::size_t i) -> Text { return w.gap[i]; });
  } else if (is_cast(header.pair)) {
    exact("exact/t", 2, [](const Witness& w, std::size_t i) { return w.cast ? Text((*w.cast)[i]) : Text(); });
  } else if (is_crossing(header.pair)) {
    exact("exact/crossing", 3,
          [](const Witness& w, std::size_t i) { return w.crossing ? Text((*w.crossing)[i]) : Text(); });
  } else {
    exact("exact/distance2", 1, [](const Witness& w, std::size_t) -> Text { return w.distance2; });
    if (has_plane(header.pair))
      arrays["exact/below"] = column(all, &Witness::below);
    else if (is_convex(header.pair))
      exact("exact/depth2", 1, [](const Witness& w, std::size_t) -> Text { return w.depth2; });
    exact("exact/reach", 1, [](const Witness& w, std::size_t) -> Text { return w.reach; });
    arrays["exact/margin_ulps"] = column(all, &Witness::margin_ulps);
  }
  return py::make_tuple(to_line(header), arrays);
}

/// The datasets among files and in folders, as every command finds them: the path, pair, scalar and family of each.
py::list datasets(const std::vector<std::string>& paths) {
  py::list all;
  for (const auto& path : golden::dataset_files({paths.begin(), paths.end()})) {
    const golden::DatasetHeader header = golden::dataset_header(path);
    all.append(py::make_tuple(path.string(), name(header.pair), name(header.scalar), header.family));
  }
  return all;
}

void write_dataset(const std::string& path, const std::string& pair, const std::string& scalar,
                   const std::string& family, const py::list& columns, const py::array& alarm,
                   const py::array& contact) {
  const QuestionArrays questions(pair_of(pair), columns, alarm, contact);
  if (!golden::names_dataset(path))
    throw std::invalid_argument(fmt::format("the name of a dataset ends in .jsonl, .h5 or .npz, got '{}'", path));
  if (golden::find_family(questions.pair(), family) != nullptr)
    throw std::invalid_argument(fmt::format("'{}' is a family of the generator's: choose another name", family));
  if (family.empty()) throw std::invalid_argument("a family has a name");
  golden::DatasetHeader header;
  header.pair = questions.pair();
  header.scalar = scalar_of(scalar);
  header.family = family;
  header.count = questions.size();
  const WithoutLock no_lock;
  const auto writer = golden::create_dataset(path, header);
  std::unordered_set<std::string> written;
  for_each(questions, [&](std::size_t row, const Query& query) {
    const golden::Case c = golden::make_case(query, header.scalar);
    if (!written.insert(c.id).second)  // no reader takes such a file
      throw std::invalid_argument(fmt::format("row {}: the same question is written already", row));
    writer->write(c, golden::to_line(c));
  });
  writer->commit();
}

py::list profiles() {
  py::list all;
  for (const tool::Profile& profile : tool::kProfiles) {
    py::dict one;
    one["name"] = std::string(profile.name);
    one["length"] = profile.tolerance.length;
    one["relative"] = profile.tolerance.relative;
    one["angle"] = profile.tolerance.angle;
    one["scale"] = py::make_tuple(profile.tolerance.scale_min, profile.tolerance.scale_max);
    one["reason"] = std::string(profile.reason);
    all.append(one);
  }
  return all;
}

/// Ctrl-C, looked for now and then: it needs Python's lock. On other threads than the first there is none to be seen.
void look_for_signals() {
  constexpr std::chrono::milliseconds kBetween{50};
  thread_local std::chrono::steady_clock::time_point last;
  const auto now = std::chrono::steady_clock::now();
  if (now - last < kBetween) return;
  last = now;
  const WithLock python_lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  tool::look_for_interruptions_by(&look_for_signals);
  m.doc() = "Production, the oracle, the judge and the generators of contact-oracle over NumPy arrays.";
  static const py::exception<OutsideDomain> domain_error(m, "DomainError", PyExc_ValueError);
  static const py::exception<formats::InputError> bad_input(m, "BadInput", PyExc_ValueError);
  static const py::exception<golden::OracleFault> oracle_fault(m, "OracleFault", PyExc_RuntimeError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const OutsideDomain& e) {
      PyErr_SetObject(domain_error.ptr(), py::make_tuple(e.field, e.row, e.value, e.rule).ptr());
    } catch (const formats::InputError& e) {
      PyErr_SetString(bad_input.ptr(), e.what());
    } catch (const golden::OracleFault& e) {
      PyErr_SetString(oracle_fault.ptr(), e.what());
    } catch (const tool::Interrupted&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    }
  });
  // Whatever the caller has set. The judge's is certify's own affair: it calls the engine in the caller's.
  const py::call_guard<oracle::DefaultEnvironment> environment;
  using namespace py::literals;
  m.def("version", [] { return std::string(formats::version()); });
  m.def("pairs", &pairs);
  m.def("families", &families, "pair"_a);
  m.def("profiles", &profiles);
  m.def("contacts", &contacts, environment, "pair"_a, "columns"_a, "alarm"_a, "contact"_a,
        "points"_a = "nearest_surface", "scalar"_a = "binary64");
  m.def("hits", &hits, environment, "pair"_a, "columns"_a, "alarm"_a, "contact"_a);
  m.def("ids", &ids, environment, "pair"_a, "columns"_a, "alarm"_a, "contact"_a);
  m.def("cases", &cases, environment, "pair"_a, "columns"_a, "alarm"_a, "contact"_a, "scalar"_a = "binary64");
  m.def("gradients", &gradients, environment, "pair"_a, "columns"_a, "alarm"_a, "contact"_a);
  m.def("explain", &explain, environment, "line"_a);
  m.def("generate", &generate, environment, "pair"_a, "family"_a, "count"_a, "seed"_a, "scalar"_a = "binary64",
        "first"_a = 0);
  m.def("datasets", &datasets, environment, "paths"_a);
  m.def("read_dataset", &read_dataset, environment, "path"_a);
  m.def("write_dataset", &write_dataset, environment, "path"_a, "pair"_a, "scalar"_a, "family"_a, "columns"_a,
        "alarm"_a, "contact"_a);
  m.def("certify", &certify, "ask"_a, "engine"_a, "sources"_a, "options"_a);
  m.def("is_within", &is_within, environment, "engine"_a, "question"_a, "answer"_a);
}

}  // namespace contact::python
