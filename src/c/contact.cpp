// The C interface, contact/contact.h, over the functions of C++: by the batch kernels where a pair has them.
#include "contact/contact.h"

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "component/message.hpp"
#include "contact/batch_functions.hpp"
#include "contact/domain.hpp"
#include "contact/pair_functions.hpp"
#include "contact/pairs.hpp"

namespace contact {

// The shapes of C by those of C++: the same numbers in the same order.
#define CONTACT_SHAPE(Shape, InC) \
  const InC* in_c(const Shape&);  \
  static_assert(sizeof(InC) == kNumbersOf<Shape> * sizeof(double) && alignof(InC) == alignof(double));
CONTACT_SHAPE(Ball, contact_sphere)
CONTACT_SHAPE(Box, contact_cube)
CONTACT_SHAPE(Capsule, contact_capsule)
CONTACT_SHAPE(Triangle, contact_triangle)
CONTACT_SHAPE(Plane, contact_plane)
CONTACT_SHAPE(Ray, contact_ray)
CONTACT_SHAPE(Cast, contact_ray)
CONTACT_SHAPE(Line, contact_line)
CONTACT_SHAPE(Obb, contact_obb)
#undef CONTACT_SHAPE
const contact_hull* in_c(const Hull&);
template <class Shape>
using In = decltype(in_c(std::declval<Shape>()));

namespace {

static_assert(static_cast<int>(batch::PairState::miss) == CONTACT_STATE_MISS &&
              static_cast<int>(batch::PairState::contact) == CONTACT_STATE_CONTACT &&
              static_cast<int>(batch::PairState::degenerate) == CONTACT_STATE_DEGENERATE &&
              static_cast<int>(batch::PairState::many) == CONTACT_STATE_MANY &&
              static_cast<int>(batch::PairState::degenerate_and_many) == CONTACT_STATE_DEGENERATE_AND_MANY);
static_assert(static_cast<int>(PointConvention::nearest_surface) == CONTACT_POINTS_NEAREST_SURFACE &&
              static_cast<int>(PointConvention::center) == CONTACT_POINTS_CENTER &&
              static_cast<int>(PointConvention::published) == CONTACT_POINTS_PUBLISHED);

/// What is wrong with a call.
struct Refused {
  contact_status status;
  std::string message;
};

/// The words of this thread's last error, in room that needs no allocation.
std::array<char, 200>& last_error() {
  thread_local std::array<char, 200> text{};
  return text;
}
std::int32_t fail(contact_status status, std::string_view message) noexcept {
  auto& text = last_error();
  text[message.copy(text.data(), text.size() - 1)] = '\0';
  return status;
}

/// Does the work; whatever it throws becomes a status.
template <class Work>
std::int32_t guarded(Work&& work) noexcept {
  try {
    work();
    return CONTACT_OK;
  } catch (const Refused& refused) {
    return fail(refused.status, refused.message);
  } catch (const std::bad_alloc&) {
    return fail(CONTACT_OUT_OF_MEMORY, contact_status_text(CONTACT_OUT_OF_MEMORY));
  } catch (const std::exception& error) {
    return fail(CONTACT_FAILED, error.what());
  } catch (...) {
    return fail(CONTACT_FAILED, contact_status_text(CONTACT_FAILED));
  }
}

void expect_there(const void* array, const char* name) {
  if (array == nullptr) throw Refused{CONTACT_NULL_POINTER, std::string(name) + " is NULL"};
}

void expect_inside(const std::optional<DomainError>& error) {
  if (error) throw Refused{CONTACT_OUTSIDE_DOMAIN, component::message(*error)};
}

/// A count as a number, the same in every environment: of one that no double has the first 53 bits.
double number_of(std::uint64_t count) {
  return static_cast<double>(count >> 53 == 0 ? count : count & ~std::uint64_t{0x7ff});
}

/// Rows of one side of the pairs.
template <class Shape>
class Side {
 public:
  Side(const char* name, In<Shape> shapes, std::size_t count) {
    if (count == 0) return;
    expect_there(shapes, name);
    rows_ = reinterpret_cast<const double*>(shapes);
    for (std::size_t i = 0; i < count; ++i)
      if (const Shape shape = (*this)[i]; !inside_domain(shape))
        expect_inside(outside_domain(std::string(name) + "[" + std::to_string(i) + "]", shape));
  }

  Shape operator[](std::size_t i) const {
    Shape shape;
    const double* number = rows_ + i * kNumbers;
    for_each_number(shape, [&](double& x) { x = *number++; });
    return shape;
  }

 private:
  static constexpr std::size_t kNumbers = kNumbersOf<Shape>;
  const double* rows_ = nullptr;
};

/// Hulls of one side. Each says where its vertices are.
template <>
class Side<Hull> {
 public:
  Side(const char* name, const contact_hull* hulls, std::size_t count) : hulls_(hulls) {
    if (count > 0) expect_there(hulls, name);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [vertices, of_them, radius] = hulls[i];
      const bool are_too_many = of_them > kMostVertices;  // then none is read
      if (!are_too_many && vertices != nullptr && inside_domain((*this)[i])) continue;
      const std::string path = std::string(name) + "[" + std::to_string(i) + "]";
      if (of_them > 0) expect_there(vertices, (path + ".vertices").c_str());
      auto error = outside_domain(path, are_too_many ? zero_shape<Hull>(kMostVertices + 1) : (*this)[i]);
      if (are_too_many) error->value = number_of(of_them);
      expect_inside(error);
    }
  }

  Hull operator[](std::size_t i) const {
    const contact_hull& in_c = hulls_[i];
    Hull hull{{}, in_c.radius};
    for (std::size_t k = 0; k < in_c.count; ++k) hull.vertices.emplace_back(in_c.vertices + 3 * k);
    return hull;
  }

 private:
  const contact_hull* hulls_;
};

/// So many pairs at a time are put in columns for the batch kernels: they stay in the cache.
constexpr std::size_t kBlock = 256;

/// One side of a block of pairs, as columns.
template <class Shape>
struct Block {
  std::array<std::array<double, kBlock>, kNumbersOf<Shape>> numbers;

  batch::ColumnsOf<Shape> load(const Side<Shape>& side, std::size_t begin, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t k = 0;
      Shape shape = side[begin + i];
      for_each_number(shape, [&](double x) { numbers[k++][i] = x; });
    }
    std::array<std::span<const double>, kNumbersOf<Shape>> spans;
    for (std::size_t k = 0; k < spans.size(); ++k) spans[k] = {numbers[k].data(), count};
    return std::bit_cast<batch::ColumnsOf<Shape>>(spans);
  }
};

/// Calls work(first, how many) for blocks that are all pairs together, and adds up the hits that it returns.
template <class Work>
std::size_t in_blocks(std::size_t count, Work&& work) {
  std::size_t hits = 0;
  for (std::size_t begin = 0; begin < count; begin += kBlock) hits += work(begin, std::min(kBlock, count - begin));
  return hits;
}

template <class A, class B>
std::int32_t test(std::size_t count, In<A> a, In<B> b, double alarm, std::uint8_t* hit, std::size_t* hits) noexcept {
  return guarded([&] {
    expect_inside(outside_domain("alarm", alarm));
    const Side<A> first("a", a, count);
    const Side<B> second("b", b, count);
    if (count > 0) expect_there(hit, "hit");
    std::size_t found = 0;
    if constexpr (batch::Decides<A, B>) {
      Block<A> first_block;
      Block<B> second_block;
      found = in_blocks(count, [&](std::size_t begin, std::size_t size) {
        return batch::test(first_block.load(first, begin, size), second_block.load(second, begin, size), alarm,
                           {hit + begin, size})
            .hits;
      });
    } else {
      for (std::size_t i = 0; i < count; ++i) {
        hit[i] = is_hit(of_a_kind(first[i], second[i]), {alarm, 0}) ? 1 : 0;
        found += hit[i];
      }
    }
    if (hits != nullptr) *hits = found;
  });
}

/// Writes a contact to row i of those columns that are wanted; zeros for a miss.
void write(const contact_contacts& out, std::size_t i, batch::PairState state, const Contact& contact) {
  const auto write_vector = [&](double* column, const Vector3& v) {
    if (column != nullptr)
      for (int axis = 0; axis < 3; ++axis) column[3 * i + static_cast<std::size_t>(axis)] = v[axis];
  };
  if (out.state != nullptr) out.state[i] = static_cast<std::uint8_t>(state);
  write_vector(out.normal, contact.normal);
  write_vector(out.point1, contact.point1);
  write_vector(out.point2, contact.point2);
  if (out.value != nullptr) out.value[i] = contact.value;
}

ContactPoints points_of(std::int32_t points, bool first_is_rigid, bool second_is_rigid) {
  if (points < CONTACT_POINTS_NEAREST_SURFACE || points > CONTACT_POINTS_PUBLISHED)
    throw Refused{CONTACT_UNKNOWN_POINTS, "points = " + std::to_string(points) + ": must be 0, 1 or 2"};
  const auto on = [&](bool is_rigid) {
    return point_on(static_cast<PointConvention>(points), is_rigid ? SphereKind::rigid : SphereKind::deformable);
  };
  return {on(first_is_rigid), on(second_is_rigid)};
}

template <class A, class B>
std::int32_t compute(std::size_t count, In<A> a, In<B> b, Distances distances, std::int32_t points, bool first_is_rigid,
                     bool second_is_rigid, const contact_contacts* out, std::size_t* hits) noexcept {
  return guarded([&] {
    expect_inside(outside_domain(distances));
    const ContactPoints on = points_of(points, first_is_rigid, second_is_rigid);
    const Side<A> first("a", a, count);
    const Side<B> second("b", b, count);
    if (count > 0) expect_there(out, "out");
    std::size_t found = 0;
    if constexpr (batch::Computes<A, B>) {
      Block<A> first_block;
      Block<B> second_block;
      std::array<std::array<double, kBlock>, 10> numbers;
      std::array<batch::PairState, kBlock> states;
      found = in_blocks(count, [&](std::size_t begin, std::size_t size) {
        const auto column = [&](std::size_t k) { return std::span(numbers[k].data(), size); };
        const auto count_of_block =
            batch::compute(first_block.load(first, begin, size), second_block.load(second, begin, size), distances,
                           {.normal = {column(0), column(1), column(2)},
                            .point1 = {column(3), column(4), column(5)},
                            .point2 = {column(6), column(7), column(8)},
                            .value = column(9),
                            .state = {states.data(), size}},
                           on);
        for (std::size_t i = 0; i < size; ++i) {
          const auto at = [&](std::size_t k) { return numbers[k][i]; };
          write(*out, begin + i, states[i],
                {.normal = {at(0), at(1), at(2)},
                 .point1 = {at(3), at(4), at(5)},
                 .point2 = {at(6), at(7), at(8)},
                 .value = at(9),
                 .degenerate = false});
        }
        return count_of_block.hits;
      });
    } else {
      const Contact none{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, false};
      for (std::size_t i = 0; i < count; ++i) {
        const auto contact = contact_of(of_a_kind(first[i], second[i]), distances, on);
        write(*out, i, contact ? batch::state_of(*contact) : batch::PairState::miss, contact ? *contact : none);
        found += contact.has_value() ? 1 : 0;
      }
    }
    if (hits != nullptr) *hits = found;
  });
}

}  // namespace
}  // namespace contact

using namespace contact;

extern "C" {

// The functions of every pair. Each must stand in contact/contact.h: the using-declarations find nothing else.
#define CONTACT_TEST(name, A, B)                                                                         \
  using ::contact_test_##name;                                                                           \
  std::int32_t contact_test_##name(std::size_t count, In<A> a, In<B> b, double alarm, std::uint8_t* hit, \
                                   std::size_t* hits) {                                                  \
    return test<A, B>(count, a, b, alarm, hit, hits);                                                    \
  }
#define CONTACT_COMPUTE_none(name, A, B, first_is_rigid, second_is_rigid)
#define CONTACT_COMPUTE_distance(name, A, B, first_is_rigid, second_is_rigid)                                \
  using ::contact_compute_##name;                                                                            \
  std::int32_t contact_compute_##name(std::size_t count, In<A> a, In<B> b, double alarm, double contact,     \
                                      std::int32_t points, const contact_contacts* out, std::size_t* hits) { \
    return compute<A, B>(count, a, b, {alarm, contact}, points, first_is_rigid, second_is_rigid, out, hits); \
  }
#define CONTACT_COMPUTE_crossing CONTACT_COMPUTE_distance
#define CONTACT_COMPUTE_cast CONTACT_COMPUTE_distance
#define CONTACT_BOTH(name, A, B, numbers, first_is_rigid, second_is_rigid) \
  CONTACT_TEST(name, A, B)                                                 \
  CONTACT_COMPUTE_##numbers(name, A, B, first_is_rigid, second_is_rigid)
CONTACT_PAIRS(CONTACT_BOTH)

const char* contact_status_text(std::int32_t status) {
  switch (status) {
    case CONTACT_OK:
      return "done";
    case CONTACT_NULL_POINTER:
      return "an array is NULL";
    case CONTACT_OUTSIDE_DOMAIN:
      return "a number is outside the domain";
    case CONTACT_UNKNOWN_POINTS:
      return "no such convention for contact points";
    case CONTACT_OUT_OF_MEMORY:
      return "out of memory";
    case CONTACT_FAILED:
      return "an error of the library itself";
    default:
      return "no status of this library";
  }
}

const char* contact_last_error(void) { return last_error().data(); }

const char* contact_version(void) { return CONTACT_VERSION_STRING; }

}  // extern "C"
