// SOFA: findIntersector of a DiscreteIntersection, and canIntersect and intersect of what it finds, as SOFA's narrow
// phase asks them. Both distances come from a MinProximityIntersection, as the last argument.
#include <sofa/component/collision/detection/intersection/DiscreteIntersection.h>
#include <sofa/component/collision/detection/intersection/MinProximityIntersection.h>
#include <sofa/component/collision/geometry/CubeCollisionModel.h>
#include <sofa/component/collision/geometry/LineCollisionModel.h>
#include <sofa/component/collision/geometry/RayCollisionModel.h>
#include <sofa/component/collision/geometry/SphereCollisionModel.h>
#include <sofa/component/collision/geometry/TriangleCollisionModel.h>
#include <sofa/component/statecontainer/MechanicalObject.h>
#include <sofa/component/topology/container/constant/MeshTopology.h>
#include <sofa/simulation/Node.h>
#include <sofa/simulation/graph/init.h>
#ifdef CONTACT_SOFA_CAPSULES
#include <CollisionOBBCapsule/geometry/CapsuleModel.h>
#endif

#include <array>
#include <memory>
#include <stdexcept>

#include "engines/adapters/adapter.hpp"
#include "engines/sofa/quiet.hpp"

namespace contact::adapters {
namespace {

namespace core = sofa::core;
namespace geometry = sofa::component::collision::geometry;
namespace intersection = sofa::component::collision::detection::intersection;
using core::collision::DetectionOutput;
using core::objectmodel::New;
using sofa::component::statecontainer::MechanicalObject;
using sofa::component::topology::container::constant::MeshTopology;
using sofa::defaulttype::Rigid3Types;
using sofa::defaulttype::Vec3Types;
using sofa::simulation::Node;
using sofa::type::Vec3;

Vec3 vec(const double* x) { return {x[0], x[1], x[2]}; }

/// A collision model of one element, in a node of its own with what the model asks for.
class Side {
 public:
  virtual ~Side() = default;
  Side() = default;
  Side(const Side&) = delete;
  Side& operator=(const Side&) = delete;
  virtual void set(const Shape& shape) = 0;
  [[nodiscard]] virtual core::CollisionModel& model() = 0;
};

template <class DataTypes>
class State {
 public:
  explicit State(std::size_t points) {
    node->addObject(positions);
    positions->resize(static_cast<sofa::Size>(points));
  }
  void init() {
    positions->init();
    for (const auto& object : node->object) object->init();
  }
  void put(std::size_t i, const double* x) {
    auto all = sofa::helper::getWriteOnlyAccessor(*positions->write(core::vec_id::write_access::position));
    DataTypes::setCPos(all[static_cast<sofa::Index>(i)], vec(x));
  }
  Node::SPtr node = New<Node>("side");
  typename MechanicalObject<DataTypes>::SPtr positions = New<MechanicalObject<DataTypes>>();
};

/// `DataTypes` Vec3Types for a Sphere, Rigid3Types for a RigidSphere, whose orientation stays (0,0,0,1).
template <class DataTypes>
class SphereSide final : public Side {
 public:
  SphereSide() {
    state_.node->addObject(spheres_);
    state_.init();
  }
  void set(const Shape& sphere) override {
    state_.put(0, sphere.numbers);
    sofa::helper::getWriteOnlyAccessor(spheres_->d_radius)[0] = sphere.radius;
  }
  core::CollisionModel& model() override { return *spheres_; }

 private:
  State<DataTypes> state_{1};
  typename geometry::SphereCollisionModel<DataTypes>::SPtr spheres_ = New<geometry::SphereCollisionModel<DataTypes>>();
};

class CubeSide final : public Side {
 public:
  CubeSide() { cubes_->resize(1); }
  void set(const Shape& box) override { cubes_->setParentOf(0, vec(box.numbers), vec(box.numbers + 3)); }
  core::CollisionModel& model() override { return *cubes_; }

 private:
  geometry::CubeCollisionModel::SPtr cubes_ = New<geometry::CubeCollisionModel>();
};

class RaySide final : public Side {
 public:
  RaySide() {
    state_.node->addObject(rays_);
    state_.init();
  }
  void set(const Shape& ray) override {
    state_.put(0, ray.numbers);
    geometry::Ray element(rays_.get(), 0);
    element.setDirection(vec(ray.numbers + 3));
    element.setL(ray.numbers[6]);
  }
  core::CollisionModel& model() override { return *rays_; }

 private:
  State<Vec3Types> state_{1};
  geometry::RayCollisionModel::SPtr rays_ = New<geometry::RayCollisionModel>();
};

/// Its normal is computed where SOFA's pipeline computes it, with the bounding tree.
class TriangleSide final : public Side {
 public:
  TriangleSide() {
    state_.node->addObject(topology_);
    for (int i = 0; i < 3; ++i) topology_->addPoint(i == 1, i == 2, 0);
    topology_->addTriangle(0, 1, 2);
    state_.node->addObject(triangles_);
    state_.init();
  }
  void set(const Shape& triangle) override {
    for (int i = 0; i < 3; ++i) state_.put(static_cast<std::size_t>(i), triangle.vertex(i));
    triangles_->computeBoundingTree(0);
  }
  core::CollisionModel& model() override { return *triangles_; }

 private:
  State<Vec3Types> state_{3};
  MeshTopology::SPtr topology_ = New<MeshTopology>();
  geometry::TriangleCollisionModel<Vec3Types>::SPtr triangles_ = New<geometry::TriangleCollisionModel<Vec3Types>>();
};

/// Models whose elements are the edges of a topology, here one.
template <class Model>
class EdgeSide : public Side {
 public:
  EdgeSide() {
    state_.node->addObject(topology_);
    for (int i = 0; i < 2; ++i) topology_->addPoint(i, 0, 0);
    topology_->addEdge(0, 1);
    state_.node->addObject(edges_);
    state_.init();
  }
  void set(const Shape& shape) override {
    for (std::size_t i = 0; i < 2; ++i) state_.put(i, shape.numbers + 3 * i);
  }
  core::CollisionModel& model() override { return *edges_; }

 protected:
  [[nodiscard]] Model& edges() { return *edges_; }

 private:
  State<Vec3Types> state_{2};
  MeshTopology::SPtr topology_ = New<MeshTopology>();
  typename Model::SPtr edges_ = New<Model>();
};
using LineSide = EdgeSide<geometry::LineCollisionModel<Vec3Types>>;

#ifdef CONTACT_SOFA_CAPSULES
class CapsuleSide final : public EdgeSide<collisionobbcapsule::geometry::CapsuleCollisionModel<Vec3Types>> {
 public:
  void set(const Shape& capsule) override {
    EdgeSide::set(capsule);
    sofa::helper::getWriteOnlyAccessor(edges().writeRadii())[0] = capsule.radius;
  }
};
#endif

/// The models of one pair, and SOFA's intersector of them.
class Meeting {
 public:
  Meeting(std::unique_ptr<Side> first, std::unique_ptr<Side> second, intersection::DiscreteIntersection& component)
      : sides_{std::move(first), std::move(second)} {
    core::CollisionModel* models[2] = {&sides_[0]->model(), &sides_[1]->model()};
    // The order that this build asks in; what SOFA swaps is put back into the order of the question.
    constexpr int kFirst = CONTACT_SOFA_SECOND_FIRST;
    bool swap = false;
    intersector_ = component.findIntersector(models[kFirst], models[1 - kFirst], swap);
    if (intersector_ == nullptr) throw std::runtime_error("SOFA has no intersector of these two models");
    first_ = swap ? 1 - kFirst : kFirst;
    for (std::size_t i = 0; i < 2; ++i)
      elements_[i] = core::CollisionElementIterator(models[i == 0 ? first_ : 1 - first_], 0);
    core::collision::DetectionOutputVector* outputs = nullptr;
    intersector_->beginIntersect(elements_[0].getCollisionModel(), elements_[1].getCollisionModel(), outputs);
    contacts_ = dynamic_cast<sofa::type::vector<DetectionOutput>*>(outputs);
    outputs_.reset(outputs);
    if (contacts_ == nullptr) throw std::runtime_error("SOFA's contacts are no vector of DetectionOutput");
  }

  void set(const Shape& first, const Shape& second) {
    sides_[0]->set(first);
    sides_[1]->set(second);
  }
  bool test(const core::collision::Intersection& distances) {
    return intersector_->canIntersect(elements_[0], elements_[1], &distances);
  }
  /// Nothing where there is no contact.
  const DetectionOutput* compute(const core::collision::Intersection& distances) {
    contacts_->clear();
    return intersector_->intersect(elements_[0], elements_[1], outputs_.get(), &distances) == 0 ? nullptr
                                                                                                : &contacts_->back();
  }
  /// Whether SOFA's first element is the second of the question.
  [[nodiscard]] bool swapped() const { return first_ != 0; }

 private:
  struct Release {
    void operator()(core::collision::DetectionOutputVector* outputs) const { outputs->release(); }
  };
  std::array<std::unique_ptr<Side>, 2> sides_;
  core::collision::ElementIntersector* intersector_ = nullptr;
  int first_ = 0;
  std::array<core::CollisionElementIterator, 2> elements_;
  std::unique_ptr<core::collision::DetectionOutputVector, Release> outputs_;
  sofa::type::vector<DetectionOutput>* contacts_ = nullptr;
};

/// Everything that is made once.
class Sofa {
 public:
  Sofa() {
    sofa_engine::speak_on_standard_error();
    sofa::simulation::graph::init();
    component_ = New<intersection::DiscreteIntersection>();
    distances_ = New<intersection::MinProximityIntersection>();
  }

  Meeting& meeting(contact_pair pair) {
    auto& made = meetings_[pair];
    if (!made) {
      const auto [first, second] = sides(pair);
      made = std::make_unique<Meeting>(first(), second(), *component_);
    }
    return *made;
  }
  const core::collision::Intersection& distances(double alarm, double contact) {
    distances_->setAlarmDistance(alarm);
    distances_->setContactDistance(contact);
    return *distances_;
  }

 private:
  using Make = std::unique_ptr<Side> (*)();
  template <class T>
  static std::unique_ptr<Side> make() {
    return std::make_unique<T>();
  }
  /// Beside a ray or a capsule the sphere is a RigidSphere: its contact point lies on its surface.
  static std::pair<Make, Make> sides(contact_pair pair) {
    const Make sphere = make<SphereSide<Vec3Types>>;
    const Make rigid = make<SphereSide<Rigid3Types>>;
    const Make cube = make<CubeSide>;
    const Make ray = make<RaySide>;
    const Make triangle = make<TriangleSide>;
    switch (pair) {
      case CONTACT_SPHERE_SPHERE:
        return {sphere, sphere};
      case CONTACT_RIGID_SPHERE_RIGID_SPHERE:
        return {rigid, rigid};
      case CONTACT_SPHERE_RIGID_SPHERE:
        return {sphere, rigid};
      case CONTACT_CUBE_CUBE:
        return {cube, cube};
      case CONTACT_RAY_SPHERE:
        return {ray, rigid};
      case CONTACT_RAY_TRIANGLE:
        return {ray, triangle};
      case CONTACT_TRIANGLE_LINE:
        return {triangle, Make(make<LineSide>)};
#ifdef CONTACT_SOFA_CAPSULES
      case CONTACT_SPHERE_CAPSULE:
        return {rigid, Make(make<CapsuleSide>)};
      case CONTACT_CAPSULE_CAPSULE:
        return {Make(make<CapsuleSide>), Make(make<CapsuleSide>)};
#endif
      default:
        throw std::invalid_argument("SOFA's DiscreteIntersection has no such pair");
    }
  }

  intersection::DiscreteIntersection::SPtr component_;
  intersection::MinProximityIntersection::SPtr distances_;
  std::array<std::unique_ptr<Meeting>, CONTACT_TRIANGLE_LINE + 1> meetings_;
};

/// SOFA takes the direction of a ray beside a sphere for a unit vector, and cannot be asked about any other.
bool is_unit(const double* x) {
  constexpr double kRounded = 0x1p-50;  // a normalised vector's square is within 4 u of 1, and 3 roundings of it
  const double off = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 1;
  return off <= kRounded && off >= -kRounded;
}

}  // namespace

std::string declaration() {
  return R"({"engine":{"name":"SOFA DiscreteIntersection","version":")" CONTACT_SOFA_VERSION
         R"("},"scalar":"binary64","pairs":["sphere_sphere","rigid_sphere_rigid_sphere","sphere_rigid_sphere","cube_cube",)"
         R"("ray_sphere","ray_triangle","triangle_line")"
#ifdef CONTACT_SOFA_CAPSULES
         R"(,"sphere_capsule","capsule_capsule")"
#endif
         R"(],"conventions":{"normal":"first-to-second","points":"center","value":"signed","value_less_contact":true,)"
         R"("touching_overlap":"closed","touching_contact":"closed","margin":"inclusive"},"pair_conventions":{)"
#ifdef CONTACT_SOFA_CAPSULES
         R"("sphere_capsule":{"points":"nearest_surface"},"capsule_capsule":{"points":"nearest_surface"},)"
#endif
         R"("ray_sphere":{"points":"nearest_surface","value_less_contact":false,"margin":"none","touching_overlap":"open",)"
         R"("touching_contact":"open"},)"
         R"("ray_triangle":{"points":"nearest_surface"},"triangle_line":{"points":"nearest_surface"}}})";
}

void answer(const Question& q, Answer& said) {
  if (q.pair == CONTACT_RAY_SPHERE && !is_unit(q.a.numbers + 3)) return said.unsupported();
  static Sofa sofa;
  Meeting& meeting = sofa.meeting(q.pair);
  meeting.set(q.a, q.b);
  const auto& distances = sofa.distances(q.alarm, q.contact);
  // Of these pairs canIntersect says always yes, and of capsules always no, with a message that it should not be asked.
  const bool tested = q.pair <= CONTACT_CUBE_CUBE || q.pair == CONTACT_RAY_SPHERE;
  if (tested) said.overlap(meeting.test(distances));
  if (q.pair == CONTACT_CUBE_CUBE) return;
  const DetectionOutput* found = meeting.compute(distances);
  if (!tested) said.overlap(found != nullptr);
  said.contact(found != nullptr);
  if (found == nullptr) return;
  const int first = meeting.swapped() ? 1 : 0;
  said.normal(meeting.swapped() ? -found->normal : found->normal);
  said.point1(found->point[first]);
  said.point2(found->point[1 - first]);
  said.value(found->value);
}

}  // namespace contact::adapters
