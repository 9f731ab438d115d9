// The same for the instructions of a vector of four doubles. Included inside contact::kernel::one_vector.
namespace mutated {

#define MUTANT_INTRINSIC [[gnu::always_inline, gnu::target("avx2,fma")]] inline

MUTANT_INTRINSIC __m256d pick(unsigned place, __m256d right, __m256d wrong0, __m256d wrong1, __m256d wrong2,
                              unsigned variants) {
  const auto wrong = [&](unsigned i) -> const __m256d& { return i == 0 ? wrong0 : i == 1 ? wrong1 : wrong2; };
  if (!::mutant::recording) return ::mutant::chosen < variants ? wrong(::mutant::chosen) : right;
  for (unsigned i = 0; i < variants; ++i)
    ::mutant::note(place, i,
                   std::memcmp(&right, &wrong(i), sizeof right) == 0 ? ::mutant::kUnchanged : ::mutant::kChanged);
  return right;
}

#define MUTANT_INTRINSIC2(name, wrong0, wrong1, wrong2, variants)                                            \
  MUTANT_INTRINSIC __m256d name(unsigned place, __m256d a, __m256d b) {                                      \
    return ::mutant::on(place) ? pick(place, ::name(a, b), wrong0, wrong1, wrong2, variants) : ::name(a, b); \
  }
#define MUTANT_INTRINSIC3(name, wrong0, wrong1)                                                             \
  MUTANT_INTRINSIC __m256d name(unsigned place, __m256d a, __m256d b, __m256d c) {                          \
    return ::mutant::on(place) ? pick(place, ::name(a, b, c), wrong0, wrong1, wrong1, 2) : ::name(a, b, c); \
  }
MUTANT_INTRINSIC2(_mm256_and_pd, ::_mm256_or_pd(a, b), a, b, 3)
MUTANT_INTRINSIC2(_mm256_or_pd, ::_mm256_and_pd(a, b), a, b, 3)
MUTANT_INTRINSIC2(_mm256_andnot_pd, b, b, b, 1)
MUTANT_INTRINSIC3(_mm256_fmadd_pd, ::_mm256_fmsub_pd(a, b, c), ::_mm256_fnmadd_pd(a, b, c))
MUTANT_INTRINSIC3(_mm256_fmsub_pd, ::_mm256_fmadd_pd(a, b, c), ::_mm256_fnmsub_pd(a, b, c))

#define MUTANT_OPERATOR(name, op, op1)                                           \
  MUTANT_INTRINSIC __m256d name(unsigned place, __m256d a, __m256d b) {          \
    return ::mutant::on(place) ? pick(place, a op b, a op1 b, a, a, 1) : a op b; \
  }
MUTANT_OPERATOR(vector_add, +, -)
MUTANT_OPERATOR(vector_sub, -, +)
MUTANT_OPERATOR(vector_mul, *, /)

/// With what is a macro where the compiler does not optimize, and an immediate operand.
MUTANT_INTRINSIC __m256d compare(unsigned place, __m256d a, __m256d b, int how) {
  const __m256d right = how == _CMP_GE_OQ ? ::_mm256_cmp_pd(a, b, _CMP_GE_OQ) : ::_mm256_cmp_pd(a, b, _CMP_EQ_OQ);
  if (!::mutant::on(place)) return right;
  if (how == _CMP_GE_OQ)
    return pick(place, right, ::_mm256_cmp_pd(a, b, _CMP_GT_OQ), ::_mm256_cmp_pd(a, b, _CMP_LT_OQ), right, 2);
  return pick(place, right, ::_mm256_cmp_pd(a, b, _CMP_NEQ_OQ), right, right, 1);
}

#undef MUTANT_OPERATOR
#undef MUTANT_INTRINSIC2
#undef MUTANT_INTRINSIC3

}  // namespace mutated
