// An engine in a shared library with the C interface of contact_engine.h.
#include "engines/hosts/library.hpp"

#define BOOST_DLL_USE_STD_FS
#include <fmt/format.h>

#include <algorithm>
#include <boost/dll/shared_library.hpp>
#include <cfenv>
#include <concepts>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>

#include "contact/contact_engine.h"
#include "engines/hosts/subprocess.hpp"
#include "engines/protocol/protocol.hpp"

namespace contact::engines {
namespace {

static_assert(static_cast<int>(Pair::sphere_sphere) == CONTACT_SPHERE_SPHERE &&
              static_cast<int>(Pair::rigid_sphere_rigid_sphere) == CONTACT_RIGID_SPHERE_RIGID_SPHERE &&
              static_cast<int>(Pair::sphere_rigid_sphere) == CONTACT_SPHERE_RIGID_SPHERE &&
              static_cast<int>(Pair::cube_cube) == CONTACT_CUBE_CUBE &&
              static_cast<int>(Pair::sphere_cube) == CONTACT_SPHERE_CUBE &&
              static_cast<int>(Pair::sphere_capsule) == CONTACT_SPHERE_CAPSULE &&
              static_cast<int>(Pair::capsule_capsule) == CONTACT_CAPSULE_CAPSULE &&
              static_cast<int>(Pair::sphere_triangle) == CONTACT_SPHERE_TRIANGLE &&
              static_cast<int>(Pair::ray_sphere) == CONTACT_RAY_SPHERE &&
              static_cast<int>(Pair::sphere_plane) == CONTACT_SPHERE_PLANE &&
              static_cast<int>(Pair::capsule_plane) == CONTACT_CAPSULE_PLANE &&
              static_cast<int>(Pair::ray_triangle) == CONTACT_RAY_TRIANGLE &&
              static_cast<int>(Pair::triangle_line) == CONTACT_TRIANGLE_LINE &&
              static_cast<int>(Pair::cast_sphere) == CONTACT_CAST_SPHERE &&
              static_cast<int>(Pair::cast_cube) == CONTACT_CAST_CUBE &&
              static_cast<int>(Pair::cast_capsule) == CONTACT_CAST_CAPSULE &&
              static_cast<int>(Pair::cast_triangle) == CONTACT_CAST_TRIANGLE &&
              static_cast<int>(Pair::cast_plane) == CONTACT_CAST_PLANE &&
              static_cast<int>(Pair::obb_obb) == CONTACT_OBB_OBB &&
              static_cast<int>(Pair::sphere_obb) == CONTACT_SPHERE_OBB &&
              static_cast<int>(Pair::capsule_cube) == CONTACT_CAPSULE_CUBE &&
              static_cast<int>(Pair::capsule_obb) == CONTACT_CAPSULE_OBB &&
              static_cast<int>(Pair::capsule_triangle) == CONTACT_CAPSULE_TRIANGLE &&
              static_cast<int>(Pair::cube_obb) == CONTACT_CUBE_OBB &&
              static_cast<int>(Pair::cube_triangle) == CONTACT_CUBE_TRIANGLE &&
              static_cast<int>(Pair::obb_triangle) == CONTACT_OBB_TRIANGLE &&
              static_cast<int>(Pair::triangle_triangle) == CONTACT_TRIANGLE_TRIANGLE &&
              static_cast<int>(Pair::cube_plane) == CONTACT_CUBE_PLANE &&
              static_cast<int>(Pair::obb_plane) == CONTACT_OBB_PLANE &&
              static_cast<int>(Pair::triangle_plane) == CONTACT_TRIANGLE_PLANE &&
              static_cast<int>(Pair::sphere_hull) == CONTACT_SPHERE_HULL &&
              static_cast<int>(Pair::capsule_hull) == CONTACT_CAPSULE_HULL &&
              static_cast<int>(Pair::cube_hull) == CONTACT_CUBE_HULL &&
              static_cast<int>(Pair::obb_hull) == CONTACT_OBB_HULL &&
              static_cast<int>(Pair::triangle_hull) == CONTACT_TRIANGLE_HULL &&
              static_cast<int>(Pair::hull_hull) == CONTACT_HULL_HULL &&
              static_cast<int>(Pair::hull_plane) == CONTACT_HULL_PLANE);

/// Questions of one pair as the arrays that the library reads, and its answers.
struct Arrays {
  Arrays(std::span<const Question> questions, std::size_t most)
      : pair(questions.front().query.pair),
        most_points(most),
        said(questions.size()),
        normal(3 * questions.size()),
        point1(3 * questions.size()),
        point2(3 * questions.size()),
        value(questions.size()),
        point_count(questions.size()),
        points(3 * most * questions.size()),
        depths(most * questions.size()) {
    std::size_t most_vertices = 0;
    for (const Question& question : questions)
      for_each_shape(question.query, [&]<class Shape>(const Shape& shape) {
        if constexpr (std::same_as<Shape, Hull>) most_vertices = std::max(most_vertices, shape.vertices.size());
      });
    for (const Question& question : questions) {
      std::vector<double>* rows = &a;
      for_each_shape(question.query, [&]<class Shape>(const Shape& shape) {
        const auto add = [&](double x) { rows->push_back(x); };
        if constexpr (std::same_as<Shape, Hull>) {
          const auto& vertices = shape.vertices;
          add(static_cast<double>(vertices.size()));
          add(shape.radius);
          for (std::size_t k = 0; k < most_vertices; ++k)
            for (int axis = 0; axis < 3; ++axis)
              add(vertices.empty() ? 0 : vertices[std::min(k, vertices.size() - 1)][axis]);
        } else {
          for_each_number(shape, add);
        }
        rows = &b;
      });
      alarm.push_back(question.query.distances.alarm);
      contact.push_back(question.query.distances.contact);
    }
  }

  [[nodiscard]] Claim claim(std::size_t i) const {
    const std::uint32_t s = said[i];
    const auto says = [s](contact_said what) { return (s & static_cast<std::uint32_t>(what)) != 0; };
    const auto vector = [i](const std::vector<double>& v) { return Vector3(v[3 * i], v[3 * i + 1], v[3 * i + 2]); };
    Claim c;
    for (const auto& [flag, status] : {std::pair{CONTACT_UNSUPPORTED, Claim::Status::unsupported},
                                       {CONTACT_REJECTED, Claim::Status::rejected},
                                       {CONTACT_ERROR, Claim::Status::error}})
      if (says(flag)) return Claim::without(status, "the library says so");
    if (says(CONTACT_SAYS_OVERLAP)) c.overlap = says(CONTACT_OVERLAPS);
    c.speaks_of_contact = says(CONTACT_SAYS_CONTACT);
    if (c.speaks_of_contact && says(CONTACT_TOUCHES)) {
      ContactClaim& numbers = c.contact.emplace();
      if (says(CONTACT_NORMAL)) numbers.normal = vector(normal);
      if (says(CONTACT_POINT1)) numbers.point1 = vector(point1);
      if (says(CONTACT_POINT2)) numbers.point2 = vector(point2);
      if (says(CONTACT_MIDPOINT)) numbers.point = vector(point1);
      if (says(CONTACT_VALUE)) numbers.value = value[i];
      if (says(CONTACT_POINTS)) {
        if (most_points == 0)
          return Claim::without(Claim::Status::error,
                                "it says CONTACT_POINTS, and the conventions of the pair have no manifold");
        if (point_count[i] < 1 || static_cast<std::size_t>(point_count[i]) > most_points)
          return Claim::without(Claim::Status::error, fmt::format("point_count is {}: a contact has 1 to {} points",
                                                                  point_count[i], most_points));
        for (std::size_t k = i * most_points; k < i * most_points + static_cast<std::size_t>(point_count[i]); ++k)
          numbers.points.push_back({{points[3 * k], points[3 * k + 1], points[3 * k + 2]}, depths[k]});
      }
    }
    return c;
  }

  /// Numbers of a row of a; where b alone is a hull, of b.
  [[nodiscard]] std::int32_t width() const {
    return static_cast<std::int32_t>(
               of_shapes(pair, []<class, class B>() { return std::same_as<B, Hull>; }) ? b.size() : a.size()) /
           static_cast<std::int32_t>(alarm.size());
  }

  Pair pair;
  std::size_t most_points;
  std::vector<double> a;
  std::vector<double> b;
  std::vector<double> alarm;
  std::vector<double> contact;
  std::vector<std::uint32_t> said;
  std::vector<double> normal;
  std::vector<double> point1;
  std::vector<double> point2;
  std::vector<double> value;
  std::vector<std::int32_t> point_count;
  std::vector<double> points;
  std::vector<double> depths;
};

/// The floating-point environment that a library finds and leaves: its own from one call to the next, as in a process
/// without us. What it sets (at its loading already, where it was built with -ffast-math) would change how we read
/// numbers.
class Theirs {
 public:
  template <class Work>
  auto operator()(Work work) {
    struct Ours {
      explicit Ours(std::fenv_t& theirs) : left(theirs) {
        std::fegetenv(&ours);
        std::fesetenv(&left);
      }
      Ours(const Ours&) = delete;
      Ours& operator=(const Ours&) = delete;
      ~Ours() {
        std::fegetenv(&left);
        std::fesetenv(&ours);
      }
      std::fenv_t& left;
      std::fenv_t ours{};
    } const back(environment_);
    return work();
  }

 private:
  std::fenv_t environment_ = [] {
    std::fenv_t now{};
    std::fegetenv(&now);
    return now;
  }();
};

class Library final : public Engine {
 public:
  explicit Library(const std::filesystem::path& file) : Engine({}) {
    const auto refuse = [&](const std::string& problem) {
      throw HarnessInvalid(fmt::format("{}: {}", file.string(), problem));
    };
    try {
      theirs_([&] { library_.load(std::filesystem::absolute(file), boost::dll::load_mode::rtld_now); });
    } catch (const std::exception& error) {
      refuse(fmt::format("cannot be loaded: {}", error.what()));
    }
    for (const char* function : {"contact_engine_interface", "contact_engine_declaration", "contact_engine_answer"})
      if (!library_.has(function)) refuse(fmt::format("is no engine: it exports no {}", function));
    // A library in C++ may throw, anything at all: that must not end the process that called it.
    const auto call = [&](const char* function, const auto& called) {
      try {
        return theirs_(called);
      } catch (const std::exception& error) {
        refuse(fmt::format("{} threw an exception: {}", function, error.what()));
      } catch (...) {
        refuse(fmt::format("{} threw an exception", function));
      }
      std::abort();  // refuse throws
    };
    if (const auto built = call("contact_engine_interface", library_.get<std::int32_t()>("contact_engine_interface"));
        built != CONTACT_ENGINE_INTERFACE)
      refuse(fmt::format("was built for engine interface {}, this is {}", built, CONTACT_ENGINE_INTERFACE));
    answer_ = library_.get<std::int32_t(const contact_questions*, contact_answers*)>("contact_engine_answer");
    const formats::Location where{file.string() + ": declaration", 0};
    const char* declaration =
        call("contact_engine_declaration", library_.get<const char*()>("contact_engine_declaration"));
    if (declaration == nullptr) refuse("contact_engine_declaration returned NULL");
    try {
      const auto json = formats::parse_object(declaration, where);
      const formats::Node node(json, where);
      set_info(engines::read_engine_info(node, {}));
    } catch (const formats::InputError& error) {
      throw HarnessInvalid(error.what());
    }
  }

  std::vector<Claim> answer(std::span<const Question> questions) override {
    std::vector<Claim> claims;
    while (!questions.empty()) {
      std::size_t run = 1;
      const Pair pair = questions.front().query.pair;
      while (run < questions.size() && questions[run].query.pair == pair) ++run;
      if (!info().serves(pair)) {
        claims.insert(claims.end(), run,
                      Claim::without(Claim::Status::unsupported, "the library does not declare this pair"));
        questions = questions.subspan(run);
        continue;
      }
      const Conventions conventions = info().declared_for(pair).conventions;
      Arrays arrays(questions.first(run),
                    conventions.points == Points::manifold ? static_cast<std::size_t>(conventions.most_points) : 0);
      const contact_questions asked{run,
                                    static_cast<std::int32_t>(arrays.pair),
                                    arrays.width(),
                                    arrays.a.data(),
                                    arrays.b.data(),
                                    arrays.alarm.data(),
                                    arrays.contact.data()};
      contact_answers answers{
          arrays.said.data(),        arrays.normal.data(), arrays.point1.data(),
          arrays.point2.data(),      arrays.value.data(),  static_cast<std::int32_t>(arrays.most_points),
          arrays.point_count.data(), arrays.points.data(), arrays.depths.data()};
      std::string error;
      try {
        const std::lock_guard lock(one_at_a_time_);
        if (const std::int32_t returned = theirs_([&] { return answer_(&asked, &answers); }); returned != 0)
          error = fmt::format("contact_engine_answer returned {}", returned);
      } catch (const std::exception& thrown) {
        error = fmt::format("contact_engine_answer threw an exception: {}", thrown.what());
      } catch (...) {
        error = "contact_engine_answer threw an exception";
      }
      for (std::size_t i = 0; i < run; ++i)
        claims.push_back(error.empty() ? arrays.claim(i) : Claim::without(Claim::Status::error, error));
      questions = questions.subspan(run);
    }
    return claims;
  }

 private:
  std::mutex one_at_a_time_;  // contact_engine.h promises it
  Theirs theirs_;
  boost::dll::shared_library library_;
  std::function<std::int32_t(const contact_questions*, contact_answers*)> answer_;
};

}  // namespace

std::unique_ptr<Engine> make_library(const std::filesystem::path& file) { return std::make_unique<Library>(file); }

}  // namespace contact::engines
