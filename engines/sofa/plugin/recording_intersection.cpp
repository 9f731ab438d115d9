// RecordingIntersection: intersectors that pass every call on and write it down, and the two files.
#include "engines/sofa/plugin/recording_intersection.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sofa/core/collision/DetectionOutput.h>

#include <cmath>

#include "engines/sofa/plugin/shapes.hpp"
#include "golden/query_id.hpp"

namespace contact::sofa_plugin {
namespace {

namespace core = sofa::core;
namespace geometry = sofa::component::collision::geometry;
using core::CollisionElementIterator;
using core::collision::DetectionOutput;
using core::collision::DetectionOutputVector;
using core::collision::ElementIntersector;
using Current = RecordingIntersection::Current;

std::string number(double x) {
  if (std::isnan(x)) return "\"NaN\"";
  if (std::isinf(x)) return x > 0 ? "\"Infinity\"" : "\"-Infinity\"";
  return fmt::format("{}", x);
}
template <class Vector>
std::string row(const Vector& x) {
  return fmt::format("[{},{},{}]", number(x[0]), number(x[1]), number(x[2]));
}
std::string text_of(const Ball& ball) {
  return fmt::format(R"({{"center":{},"radius":{}}})", row(ball.center), number(ball.radius));
}
std::string text_of(const Box& box) { return fmt::format(R"({{"min":{},"max":{}}})", row(box.min), row(box.max)); }

/// One kind of pair, as SOFA's intersector takes it. `First` and `Second` are SOFA's elements.
template <Pair pair, class First, class Second>
class Recorded final : public ElementIntersector {
 public:
  Recorded(ElementIntersector& of, RecordingIntersection& into) : of_(of), into_(into) {}

  bool canIntersect(CollisionElementIterator elem1, CollisionElementIterator elem2, const Current* current) override {
    const bool overlap = of_.canIntersect(elem1, elem2, current);
    std::optional<DetectionOutput> contact;
    if constexpr (has_numbers(pair)) {
      DetectionOutputVector* outputs = nullptr;
      of_.beginIntersect(elem1.getCollisionModel(), elem2.getCollisionModel(), outputs);
      if (of_.intersect(elem1, elem2, outputs, current) > 0) contact = last(outputs);
      outputs->release();
    }
    record(elem1, elem2, *current, {overlap, contact});
    return overlap;
  }
  int intersect(CollisionElementIterator elem1, CollisionElementIterator elem2, DetectionOutputVector* outputs,
                const Current* current) override {
    const int written = of_.intersect(elem1, elem2, outputs, current);
    if constexpr (has_numbers(pair)) {
      std::optional<DetectionOutput> contact;
      if (written > 0) contact = last(outputs);
      record(elem1, elem2, *current, {of_.canIntersect(elem1, elem2, current), contact});
    }
    return written;
  }
  int beginIntersect(core::CollisionModel* model1, core::CollisionModel* model2,
                     DetectionOutputVector*& outputs) override {
    return of_.beginIntersect(model1, model2, outputs);
  }
  int endIntersect(core::CollisionModel* model1, core::CollisionModel* model2,
                   DetectionOutputVector* outputs) override {
    return of_.endIntersect(model1, model2, outputs);
  }
  std::string name() const override { return of_.name(); }

 private:
  static DetectionOutput last(DetectionOutputVector* outputs) {
    return dynamic_cast<sofa::type::vector<DetectionOutput>&>(*outputs).back();
  }
  void record(const CollisionElementIterator& elem1, const CollisionElementIterator& elem2, const Current& current,
              const RecordingIntersection::Answer& answer) {
    const First first(elem1);
    const Second second(elem2);
    const bool itself = elem1.getCollisionModel() == elem2.getCollisionModel() && elem1.getIndex() == elem2.getIndex();
    // Some components add these to the alarm distance, and then answer another question.
    const auto own = [](const CollisionElementIterator& e) { return e.getCollisionModel()->getContactDistance(); };
    if (itself || own(elem1) != 0 || own(elem2) != 0) return into_.leave_out();
    into_.record({pair,
                  Two<decltype(shape_of(first)), decltype(shape_of(second))>{shape_of(first), shape_of(second)},
                  {.alarm = current.getAlarmDistance(), .contact = current.getContactDistance()}},
                 answer);
  }

  ElementIntersector& of_;
  RecordingIntersection& into_;
};

using geometry::Cube;
using geometry::CubeCollisionModel;
using geometry::RigidSphere;
using geometry::RigidSphereModel;
using geometry::Sphere;
using SphereModel = geometry::SphereCollisionModel<sofa::defaulttype::Vec3Types>;

/// Nothing where the pair has no place in a results file of DiscreteIntersection's pairs.
std::unique_ptr<ElementIntersector> recorded(ElementIntersector& of, RecordingIntersection& into,
                                             core::CollisionModel* first, core::CollisionModel* second) {
  const auto is = [](core::CollisionModel* model, auto* kind) {
    return dynamic_cast<std::remove_pointer_t<decltype(kind)>*>(model) != nullptr;
  };
  constexpr SphereModel* kSphere = nullptr;
  constexpr RigidSphereModel* kRigid = nullptr;
  constexpr CubeCollisionModel* kCube = nullptr;
  if (is(first, kSphere) && is(second, kSphere))
    return std::make_unique<Recorded<Pair::sphere_sphere, Sphere, Sphere>>(of, into);
  if (is(first, kRigid) && is(second, kRigid))
    return std::make_unique<Recorded<Pair::rigid_sphere_rigid_sphere, RigidSphere, RigidSphere>>(of, into);
  if (is(first, kSphere) && is(second, kRigid))
    return std::make_unique<Recorded<Pair::sphere_rigid_sphere, Sphere, RigidSphere>>(of, into);
  if (is(first, kCube) && is(second, kCube)) return std::make_unique<Recorded<Pair::cube_cube, Cube, Cube>>(of, into);
  return nullptr;
}

}  // namespace

RecordingIntersection::RecordingIntersection()
    : d_filename(initData(&d_filename, std::string("recorded"), "filename",
                          "The files are FILENAME.PAIR.queries.jsonl and FILENAME.answers.jsonl")),
      d_contactPoints(initData(&d_contactPoints, std::string("center"), "contactPoints",
                               "What the recorded component's contact points are: center (SOFA) or nearest_surface")),
      d_limit(initData(&d_limit, 1000000U, "limit", "How many different questions are written at most")),
      l_intersection(initLink("intersection", "The component that is recorded")) {}

RecordingIntersection::~RecordingIntersection() = default;

void RecordingIntersection::init() {
  Intersection::init();
  if (l_intersection.get() == nullptr || l_intersection.get() == this)
    msg_fatal() << "intersection='" << l_intersection.getLinkedPath()
                << "': expected the path of another intersection component, such as @exact";
  const std::string& points = d_contactPoints.getValue();
  if (points != "center" && points != "nearest_surface")
    msg_error() << "contactPoints='" << points << "': expected center or nearest_surface";
}

bool RecordingIntersection::open(std::ofstream& file, const std::string& ending) {
  file.open(d_filename.getValue() + ending);
  if (!file) msg_error() << "filename='" << d_filename.getValue() << "': " << ending << " cannot be written";
  return static_cast<bool>(file);
}

bool RecordingIntersection::open(Pair pair) {
  std::ofstream& queries = queries_[pair];
  if (!queries.is_open() && !open(queries, fmt::format(".{}.queries.jsonl", contact::name(pair)))) return false;
  if (answers_.is_open()) return queries && answers_;
  if (!open(answers_, ".answers.jsonl")) return false;
  answers_ << fmt::format(
      R"({{"format":"contact-oracle/results","version":1,"engine":{{"name":"{}","version":"recorded in SOFA {}"}},)"
      R"("scalar":"binary64","pairs":["sphere_sphere","rigid_sphere_rigid_sphere","sphere_rigid_sphere","cube_cube"],)"
      R"("conventions":{{"normal":"first-to-second","points":"{}","value":"signed","value_less_contact":true,)"
      R"("touching_overlap":"closed","touching_contact":"closed","margin":"inclusive"}}}})"
      "\n",
      l_intersection->getClassName(), CONTACT_SOFA_VERSION, d_contactPoints.getValue());
  return queries && answers_;
}

ElementIntersector* RecordingIntersection::findIntersector(core::CollisionModel* object1, core::CollisionModel* object2,
                                                           bool& swapModels) {
  ElementIntersector* of = l_intersection->findIntersector(object1, object2, swapModels);
  if (of == nullptr) return nullptr;
  const std::lock_guard lock(mutex_);
  auto& made = recorded_[of];
  if (!made) made = recorded(*of, *this, swapModels ? object2 : object1, swapModels ? object1 : object2);
  return made ? made.get() : of;
}

void RecordingIntersection::record(const Query& query, const Answer& answer) {
  bool finite = true;
  for_each_number_unnamed(query, [&](double x) { finite = finite && std::isfinite(x); });
  if (!finite) return leave_out();
  const std::string id = golden::query_id(query);
  std::string contact;
  if (has_numbers(query.pair))
    contact = answer.contact ? fmt::format(R"(,"contact":{{"normal":{},"point1":{},"point2":{},"value":{}}})",
                                           row(answer.contact->normal), row(answer.contact->point[0]),
                                           row(answer.contact->point[1]), number(answer.contact->value))
                             : std::string(R"(,"contact":null)");
  const std::string line = fmt::format(R"({{"id":"{}","overlap":{}{}}})", id, answer.overlap, contact);

  const std::lock_guard lock(mutex_);
  if (const auto known = lines_.find(id); known != lines_.end()) {
    if (known->second != line && differing_++ == 0)
      msg_warning() << "the same question has two answers, of which the first is recorded: " << known->second << " and "
                    << line;
    return;
  }
  if (lines_.size() >= d_limit.getValue() || !open(query.pair)) {
    ++left_out_;
    return;
  }
  std::visit(
      [&](const auto& two) {
        if constexpr (requires { text_of(two.a) + text_of(two.b); })
          queries_[query.pair] << fmt::format(
              R"({{"pair":"{}","scalar":"binary64","a":{},"b":{},"alarm":{},"contact":{}}})"
              "\n",
              contact::name(query.pair), text_of(two.a), text_of(two.b), number(query.distances.alarm),
              number(query.distances.contact));
      },
      query.shapes);
  answers_ << line << '\n';
  lines_.emplace(id, line);
}

void RecordingIntersection::leave_out() {
  const std::lock_guard lock(mutex_);
  ++left_out_;
}

void RecordingIntersection::endNarrowPhase() {
  l_intersection->endNarrowPhase();
  const std::lock_guard lock(mutex_);
  for (auto& [pair, file] : queries_) file.flush();
  answers_.flush();
}

void RecordingIntersection::cleanup() {
  const std::lock_guard lock(mutex_);
  msg_info() << lines_.size() << " questions are recorded, " << left_out_ << " were left out, " << differing_
             << " were answered differently again";
  queries_.clear();
  answers_.close();
}

}  // namespace contact::sofa_plugin
