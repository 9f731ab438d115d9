// What a certificate says of the floating-point modes is what they are.
#include "tool/run/environment.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <string>
#include <utility>

#ifdef __SSE2__
#include <xmmintrin.h>
#include <nlohmann/json.hpp>
#endif

namespace contact::tool {
namespace {

TEST(Environment, every_rounding_mode_is_found_by_what_it_does) {
  for (const auto& [mode, name] : {std::pair{FE_TONEAREST, "to nearest"},
                                   {FE_UPWARD, "upward"},
                                   {FE_DOWNWARD, "downward"},
                                   {FE_TOWARDZERO, "toward zero"}}) {
    ASSERT_EQ(std::fesetround(mode), 0);
    const nlohmann::json found = environment();
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(found.at("rounding"), name);
    EXPECT_EQ(found.at("subnormal_results"), "kept");
    EXPECT_EQ(found.at("subnormal_inputs"), "kept");
  }
}

#ifdef __SSE2__
TEST(Environment, flushed_results_and_inputs_are_told_apart) {
  constexpr unsigned kFlushToZero = 0x8000;
  constexpr unsigned kDenormalsAreZero = 0x0040;
  const unsigned before = _mm_getcsr();
  for (const unsigned modes : {0U, kFlushToZero, kDenormalsAreZero, kFlushToZero | kDenormalsAreZero}) {
    _mm_setcsr(before | modes);
    const nlohmann::json found = environment();
    _mm_setcsr(before);
    EXPECT_EQ(found.at("subnormal_results"), (modes & kFlushToZero) != 0 ? "flushed to zero" : "kept");
    EXPECT_EQ(found.at("subnormal_inputs"), (modes & kDenormalsAreZero) != 0 ? "taken for zero" : "kept");
    EXPECT_EQ(found.at("rounding"), "to nearest");
  }
}
#endif

TEST(Environment, processor_system_and_compiler_have_names) {
  for (const char* key : {"processor", "system", "compiler"})
    EXPECT_FALSE(environment().at(key).get<std::string>().empty()) << key;
}

}  // namespace
}  // namespace contact::tool
