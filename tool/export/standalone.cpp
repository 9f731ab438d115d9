// The text of a standalone test: a language's template, and what is put in the place of its words.
#include "tool/export/standalone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <map>

#include "engines/protocol/results.hpp"
#include "formats/json.hpp"
#include "golden/dataset.hpp"
#include "tool/export/templates.hpp"

namespace contact::tool {
namespace {

using Lines = std::vector<std::string>;

std::string hexadecimal(double x) { return fmt::format("{:a}", x + 0.0); }
std::string bits(double x) { return fmt::format("{:#018x}", std::bit_cast<std::uint64_t>(x + 0.0)); }
std::string long_bits(double x) { return bits(x) + "n"; }

/// How a language writes what it is given.
struct Writing {
  std::string_view text;  ///< the template
  std::string (*number)(double);
  std::string_view row_begin;
  std::string_view between;
  std::string_view row_end;
  std::string_view comment_begin;
  std::string_view comment_end;
  std::string_view binary32;
  std::string_view binary64;
  std::array<std::string_view, 2> truths;
};

Writing writing_of(Language language) {
  switch (language) {
    case Language::c:
      return {templates::kC, hexadecimal, "{", ", ", "},", "/* ", " */", "float", "double", {"0", "1"}};
    case Language::cpp:
      return {templates::kCpp, hexadecimal, "{", ", ", "},", "// ", "", "float", "double", {"0", "1"}};
    case Language::cuda:
      return {templates::kCuda, hexadecimal, "{", ", ", "},", "// ", "", "float", "double", {"0", "1"}};
    case Language::python:
      return {templates::kPython, hexadecimal, "\"", " ", "\",", "# ", "", "", "", {"False", "True"}};
    case Language::js:
      return {templates::kJs, long_bits, "[", ", ", "],", "// ", "", "", "", {"false", "true"}};
    case Language::rust:
      break;
  }
  return {templates::kRust, bits, "&[", ", ", "],", "// ", "", "f32", "f64", {"false", "true"}};
}

bool is_of_c(Language language) {
  return language == Language::c || language == Language::cpp || language == Language::cuda;
}

std::string capitalised(std::string_view name) {
  std::string text(name);
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

/// The words of a template, each of which stands for one line or more.
class Words {
 public:
  void set(const std::string& word, Lines lines) { lines_[word] = std::move(lines); }
  void set(const std::string& word, std::string line) { lines_[word] = {std::move(line)}; }

  /// The lines of a template. What stands before a word stands before each of its lines; a line whose word stands for
  /// none is left out.
  [[nodiscard]] Lines expand(std::string_view text) const {
    Lines lines;
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      const Lines more = expand_line(text.substr(0, end));
      lines.insert(lines.end(), more.begin(), more.end());
      text.remove_prefix(std::min(end, text.size() - 1) + 1);
    }
    return lines;
  }

 private:
  [[nodiscard]] Lines expand_line(std::string_view line) const {
    const std::size_t begin = line.find('@');
    if (begin == std::string_view::npos) return {std::string(line)};
    const std::size_t end = line.find('@', begin + 1);
    Lines all = lines_.at(std::string(line.substr(begin + 1, end - begin - 1)));
    const Lines rest = expand_line(line.substr(end + 1));
    for (std::string& one : all) one = std::string(line.substr(0, begin)) + one;
    if (!all.empty()) all.back() += rest.front();
    for (std::string& one : all) one.erase(one.find_last_not_of(' ') + 1);
    return all;
  }

  std::map<std::string, Lines> lines_;
};

/// Words in lines that are not too long.
Lines wrapped(const std::string& text, const std::string& further = "") {
  constexpr std::size_t kLength = 108;
  Lines lines{""};
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    const std::string_view word = rest.substr(0, end);
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > kLength) lines.push_back(further);
    if (lines.back().size() > (lines.size() == 1 ? 0 : further.size())) lines.back() += ' ';
    lines.back() += word;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return lines;
}

/// The most vertices of a hull of the questions; 0 where none has one.
std::size_t most_vertices(const std::vector<CertainQuestion>& questions) {
  std::size_t most = 0;
  for (const CertainQuestion& question : questions)
    for_each_value(question.query, [&]<class Value>(const Value& value) {
      if constexpr (AnyNumberOfVectors<Value>) most = std::max(most, value.size());
    });
  return most;
}

/// What a number of a field is, in an array(of, n) for each of its extents.
template <class Value, class Array>
std::string nested(std::string text, const Value& value, Array array) {
  const auto extents = extents_of(value);
  for (auto n = extents.rbegin(); n != extents.rend(); ++n) text = array(text, *n);
  return text;
}

/// The kinds of a question's shapes, each once, and the types of their fields.
Lines shape_types(Query& query, std::size_t most, Language language) {
  Lines lines;
  std::vector<std::string_view> known;
  for_each_shape(query, [&]<class Shape>(Shape& shape) {
    const std::string_view name = ShapeDescription<Shape>::kName;
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    known.push_back(name);
    lines.push_back(is_of_c(language) ? fmt::format("struct {} {{", name)
                                      : fmt::format("struct {} {{", capitalised(name)));
    for_each_field(shape, [&]<class Value>(const auto& field, Value& value) {
      if (AnyNumberOfVectors<Value>) {
        if (!is_of_c(language)) return lines.push_back(fmt::format("    {}: Vec<[Real; 3]>,", field.name));
        lines.push_back(fmt::format("  real count; /* of the {} that there are */", field.name));
        lines.push_back(fmt::format("  real {}[{}][3];", field.name, most));
      } else if (is_of_c(language)) {
        std::string extents;
        for (const std::uint64_t n : extents_of(value)) extents += fmt::format("[{}]", n);
        lines.push_back(fmt::format("  real {}{};", field.name, extents));
      } else {
        const auto array = [](const std::string& of, std::uint64_t n) { return fmt::format("[{}; {}]", of, n); };
        lines.push_back(fmt::format("    {}: {},", field.name, nested("Real", value, array)));
      }
    });
    lines.emplace_back(is_of_c(language) ? "};" : "}");
  });
  return lines;
}

/// How Rust makes a question of numbers that n() gives one after another.
std::string rust_reading(Query& query) {
  std::string text = "Question { ";
  std::string_view name = "a";
  for_each_shape(query, [&]<class Shape>(Shape& shape) {
    text += fmt::format("{}: {} {{ ", name, capitalised(ShapeDescription<Shape>::kName));
    name = "b";
    for_each_field(shape, [&]<class Value>(const auto& field, Value& value) {
      const auto array = [](const std::string& of, std::uint64_t n) {
        return fmt::format("[{}]", fmt::join(std::vector(n, of), ", "));
      };
      text += fmt::format("{}: {}, ", field.name,
                          AnyNumberOfVectors<Value> ? "vertices_of(&mut n)" : nested("n()", value, array));
    });
    text += "}, ";
  });
  return text + "alarm: n(), contact: n() }";
}

/// The checked numbers beside the normal: in words of each language, with their place among the numbers of an answer.
Lines checked_numbers(const Aspects& spoken, Language language) {
  Lines lines;
  const auto add = [&](Aspect aspect, int place, int size) {
    if (!spoken.has(aspect)) return;
    const std::string_view name = kAspectNames[static_cast<std::size_t>(aspect)];
    for (int i = 0; i < size; ++i) {
      const std::string index = size == 1 ? "" : fmt::format("[{}]", i);
      const std::string_view none = language == Language::python ? "None" : "null";
      const std::string axis = size == 1 ? std::string(none) : std::to_string(i);
      if (language == Language::python)
        lines.push_back(fmt::format(R"(("{}", {}),)", name, axis));
      else if (language == Language::js)
        lines.push_back(fmt::format(R"(["{}", {}],)", name, axis));
      else if (language == Language::rust)
        lines.push_back(fmt::format(R"(("{}{}", {}),)", name, index, place + i));
      else
        lines.push_back(fmt::format(R"({{"{}{}", {}}},)", name, index, place + i));
    }
  };
  add(Aspect::point1, 3, 3);
  add(Aspect::point2, 6, 3);
  add(Aspect::point, 9, 3);
  add(Aspect::value, 12, 1);
  return lines;
}

/// What an engine is asked for, in words.
Lines asked_for(Pair pair, const Conventions& c) {
  std::string decision = is_cast(pair)       ? "whether the ray hits the shape"
                         : is_crossing(pair) ? "whether the one crosses the other"
                         : has_numbers(pair) ? "whether the two shapes are within `alarm` of each other"
                                             : "whether the two boxes are within `alarm` of each other on every axis";
  if (!is_cast(pair) && !is_crossing(pair)) {
    if (c.margin == Margin::none)
      decision = fmt::format("whether the two shapes overlap, whatever `alarm` is; touching {}",
                             c.touching_contact == Touching::closed ? "counts" : "does not count");
    else
      decision += fmt::format("; at equality {}, and where alarm is 0, touching {}",
                              c.margin == Margin::inclusive ? "they are" : "they are not",
                              c.touching_contact == Touching::closed ? "counts" : "does not count");
    if (has_numbers(pair) && c.coincident == Coincident::no_contact)
      decision += "; not where cores meet, as of coincident centres";
  }
  Lines lines = wrapped("hit     " + decision, "        ");
  const auto add = [&](const std::string& text) {
    for (const std::string& line : wrapped(text, "        ")) lines.push_back(line);
  };
  const Aspects spoken = spoken_of(c);
  if (!has_numbers(pair)) return lines;
  if (spoken.has(Aspect::normal)) {
    std::string normal = is_cast(pair) ? "the shape's outward normal where the ray hits it"
                         : c.normal == NormalDirection::first_to_second ? "from the first shape to the second"
                                                                        : "from the second shape to the first";
    if (is_cast(pair) && c.normal == NormalDirection::second_to_first) normal += ", turned round";
    normal += c.normal_unit ? ", of length 1" : ", of any length";
    if (!is_cast(pair) && c.coincident == Coincident::zero_normal) normal += "; 0 where centres coincide";
    add("normal  " + normal);
  }
  const std::string where = is_cast(pair) || is_crossing(pair) ? ": where the ray or line meets it"
                            : c.points == Points::published    ? ", on its surface, farthest from the other"
                            : c.points == Points::center       ? ": of a sphere its centre, of a rigid sphere and "
                                                                 "any other shape on its surface"
                                                               : ", on its surface";
  if (spoken.has(Aspect::point1)) add("point1  of the first shape" + where);
  if (spoken.has(Aspect::point2)) add("point2  of the second shape" + where);
  if (spoken.has(Aspect::point)) add("point   half way between the nearest points of both surfaces");
  if (spoken.has(Aspect::value)) {
    if (is_cast(pair))
      add("value   how far along the ray, counted in directions");
    else if (is_crossing(pair))
      add("value   0");
    else
      add(fmt::format("value   {}{}",
                      c.value == ValueKind::depth
                          ? "how deep the shapes are in each other, below 0 where they are apart"
                          : "the distance of the surfaces, below 0 where they overlap",
                      !c.value_less_contact         ? ""
                      : c.value == ValueKind::depth ? "; plus `contact`"
                                                    : "; less `contact`"));
  }
  return lines;
}

Lines head(const Standalone& test) {
  Lines lines = wrapped(fmt::format(
      "{}: {} questions to a collision engine, and what is right. The file is a test of its own: fill in the "
      "call of an engine where it says so, and run it. It says which answers are wrong, and ends with 1 if any "
      "is.",
      name(test.pair), test.questions.size()));
  lines.emplace_back();
  const auto add = [&](const std::string& text) {
    for (const std::string& line : wrapped(text, "    ")) lines.push_back(line);
  };
  for (const std::string& line : test.about) add(line);
  if (const auto& t = test.declared.tolerance)
    add(
        fmt::format("tolerance: {}; a number may differ by length + relative * its scale, a normal by angle. Questions "
                    "whose decision is as near to the other are left out.",
                    engines::tolerance_object(*t)));
  else
    add(fmt::format(
        "tolerance: {} ulps of a number's scale, as at the level `bounded`; what is right is written as doubles, "
        "which adds 2 ulps of the number. Every decision counts, also that of shapes that just touch.",
        test.declared.bounds.value));
  if (has_numbers(test.pair)) {
    add("Where several normals are right, any of them is; where any direction is, its length alone is checked. Where "
        "many points are right, each coordinate lies between the least and the largest. So a wrong answer may pass.");
    // What a jump stops at between the moves that look for it is not known: docs/certify-your-engine.md.
    add(test.declared.tolerance
            ? "No right answer is called wrong but where the tolerance moves it a long way, as along nearly parallel "
              "edges: there ask `certify`."
            : "No right answer is called wrong.");
  }
  lines.emplace_back("SPDX-License-Identifier: MIT");
  return lines;
}

/// The numbers of a row, as the templates say.
std::vector<double> row_of(const CertainQuestion& question, std::size_t most, bool checks_normal) {
  std::vector<double> row;
  for_each_value(question.query, [&]<class Value>(const Value& value) {
    if constexpr (AnyNumberOfVectors<Value>) row.push_back(static_cast<double>(value.size()));
    for_each_number_in(value, [&](double x) { row.push_back(x); });
    if constexpr (AnyNumberOfVectors<Value>) row.resize(row.size() + 3 * (most - value.size()));
  });
  row.push_back(question.certain.hit ? 1 : 0);
  if (!question.certain.hit) return row;
  for (const oracle::Near& number : question.certain.numbers) {
    row.push_back(number.expected);
    row.push_back(number.allowed);
  }
  if (!checks_normal) return row;
  row.push_back(question.certain.normal_allowed);
  row.push_back(static_cast<double>(question.certain.normals.size()));
  for (const Vector3& normal : question.certain.normals)
    for (int axis = 0; axis < 3; ++axis) row.push_back(normal[axis]);
  return row;
}

std::string in_quotes(std::string_view text) {
  std::string quoted;
  for (const char c : text) quoted += c == '"' ? std::string("\\\"") : std::string(1, c);
  return quoted;
}

}  // namespace

std::string standalone_test(const Standalone& test) {
  const Writing writing = writing_of(test.language);
  const Scalar scalar = test.declared.scalar;
  const Aspects spoken = has_numbers(test.pair) ? spoken_of(test.declared.conventions) : Aspects{};
  const bool checks_normal = spoken.has(Aspect::normal);
  Query zero = zero_query(test.pair);
  const std::size_t most = most_vertices(test.questions);
  CertainQuestion missed{zero, {}, ""};
  missed.certain.hit = false;
  const std::size_t inputs = row_of(missed, most, false).size() - 1;

  Lines rows;
  std::size_t width = 0;
  std::string_view family;
  for (const CertainQuestion& question : test.questions) {
    if (question.family != family)
      rows.push_back(fmt::format("    {}{}{}", writing.comment_begin, question.family, writing.comment_end));
    family = question.family;
    Lines numbers;
    for (const double x : row_of(question, most, checks_normal)) numbers.push_back(writing.number(x));
    width = std::max(width, numbers.size());
    rows.push_back(fmt::format("    {}{}{}", writing.row_begin, fmt::join(numbers, writing.between), writing.row_end));
  }

  // Every number of this question is 0, and no name has one.
  std::string question = fmt::format(R"({{"pair":"{}","scalar":"{}",{}}})", name(test.pair), name(scalar), "{}");
  std::string places = golden::inputs_text(zero);
  std::replace(places.begin(), places.end(), '0', '%');
  constexpr std::string_view kOneVertex = "[[%,%,%]]";
  for (std::size_t at = 0; (at = places.find(kOneVertex, at)) != std::string::npos;)
    places.replace(at, kOneVertex.size(), "*");
  question.replace(question.find("{}"), 2, places);

  const Lines numbers = checked_numbers(spoken, test.language);
  Words words;
  words.set("HEAD", head(test));
  words.set("ANSWER", asked_for(test.pair, test.declared.conventions));
  words.set("EXAMPLE", fmt::format("{{{}}}", golden::inputs_text(test.questions.front().query)));
  words.set("REAL", std::string(scalar == Scalar::binary32 ? writing.binary32 : writing.binary64));
  words.set("SHAPES", shape_types(zero, most, test.language));
  std::string_view which = "A";
  for_each_shape(zero, [&]<class Shape>(Shape& /*shape*/) {
    const std::string_view shape = ShapeDescription<Shape>::kName;
    words.set(std::string(which), is_of_c(test.language) ? std::string(shape) : capitalised(shape));
    which = "B";
  });
  words.set("READ", rust_reading(zero));
  words.set("PAIR", std::string(name(test.pair)));
  words.set("COUNT", std::to_string(test.questions.size()));
  words.set("INPUTS", std::to_string(inputs));
  // What stands behind the one or the other is for pairs with a hull, or for those without.
  words.set("HULL", most > 0 ? Lines{""} : Lines{});
  words.set("NO_HULL", most > 0 ? Lines{} : Lines{""});
  words.set("MOST_VERTICES", std::to_string(most));
  words.set("WIDTH", std::to_string(width));
  words.set("CHECKED", std::to_string(numbers.size()));
  words.set("NUMBERS", numbers);
  words.set("CHECKS_NORMAL", std::string(writing.truths[checks_normal ? 1 : 0]));
  words.set("DIRECTIONS", std::string(writing.truths[oracle::compares_directions(test.declared) ? 1 : 0]));
  words.set("UNIT_ALLOWED", writing.number(oracle::unit_allowed(test.declared)));
  words.set("QUESTION", question);
  words.set("QUESTION_IN_QUOTES", in_quotes(question));
  words.set("ROWS", rows);
  words.set("TYPES", words.expand(templates::kTypes));
  words.set("CHECK", words.expand(templates::kCheck));
  return fmt::format("{}\n", fmt::join(words.expand(writing.text), "\n"));
}

}  // namespace contact::tool
