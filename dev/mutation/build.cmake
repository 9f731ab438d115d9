# What rewritten libraries are compiled with: quickly, without warnings, and with assertions.
function(contact_compile_mutants)
  foreach(target kernel batch interval_oracle double_double_oracle oracle gradient)
    target_compile_options(contact_${target} PRIVATE -O1 -w -UNDEBUG -D_GLIBCXX_ASSERTIONS)
  endforeach()
  foreach(test kernel_test batch_test oracle_test)
    target_compile_options(${test} PRIVATE -w)
  endforeach()
  # Vectors travel as they do under -mavx2 in functions that are not compiled for it: in all that share a template.
  target_compile_options(contact_kernel PRIVATE -mavx)
  target_compile_options(kernel_test PRIVATE -mavx)
  # Two instruction sets are enough: between them they compile every line, but for what serves processors without FMA.
  target_compile_options(contact_batch PRIVATE -march=haswell)
  target_compile_definitions(contact_batch PRIVATE
    "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3_DL|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128|HWY_RVV|HWY_PPC8)")
  set_source_files_properties("${PROJECT_SOURCE_DIR}/golden/lint.cpp" TARGET_DIRECTORY contact_golden PROPERTIES COMPILE_OPTIONS -w)
  set_source_files_properties("${PROJECT_SOURCE_DIR}/tool/commands/lint.cpp" TARGET_DIRECTORY contact_commands PROPERTIES COMPILE_OPTIONS -w)
endfunction()
cmake_language(DEFER CALL contact_compile_mutants)
