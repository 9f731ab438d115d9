# The two interface targets that every target of this project builds with, and one way to declare a library and a test.

add_library(contact_warnings INTERFACE)
target_compile_options(contact_warnings INTERFACE -Wall -Wextra -Wconversion -Wshadow -Wpedantic -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(contact_warnings INTERFACE -Wno-restrict)  # false alarms on "x" + std::string (GCC bug 105651)
endif()
# gcc collects what it no longer needs from 500 MB on, not from 128 MB on: that saves a tenth of the time of a large unit.
target_compile_options(contact_warnings INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=500000>)
if(CONTACT_SANITIZE)
  target_compile_options(contact_warnings INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(contact_warnings INTERFACE -fsanitize=address,undefined)
  target_compile_definitions(contact_warnings INTERFACE CONTACT_SANITIZED)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(contact_warnings INTERFACE -Wno-maybe-uninitialized)  # false alarms on std::optional, of sanitized code alone
  endif()
endif()

if(CONTACT_FUZZ)
  target_compile_options(contact_warnings INTERFACE -fsanitize=fuzzer-no-link)
endif()

# Strict floating point. Contraction would fuse a product and a sum into one rounding, and so change what the filters'
# bounds, the generator's bytes and the plain formulas mean; x87 registers would round twice; what -ffast-math allows
# changes all of it. Whoever asks for such a thing, in CXXFLAGS, a preset or a parent project, means other code: each is
# undone here, one by one, since none undoes all. These options come last on the command line. Only -frounding-math stays,
# which loses speed alone and which CGAL asks for.
add_library(contact_strict_floating_point INTERFACE)
include(CheckCXXCompilerFlag)
set(strict)
foreach(flag
    -fno-fast-math -fno-unsafe-math-optimizations -fno-associative-math -fno-reciprocal-math -fno-finite-math-only -fsigned-zeros
    -fno-single-precision-constant -fno-cx-limited-range -fno-cx-fortran-rules -fexcess-precision=standard  # gcc's
    -fhonor-nans -fhonor-infinities -fno-approx-func -fdenormal-fp-math=ieee -ffp-eval-method=source  # clang's
    -ffp-contract=off)
  string(MAKE_C_IDENTIFIER "contact_has${flag}" known)
  set(CMAKE_REQUIRED_FLAGS -Werror)
  set(CMAKE_REQUIRED_QUIET ON)
  check_cxx_compiler_flag(${flag} ${known})
  if(${known})
    string(APPEND strict " ${flag}")
  endif()
endforeach()
unset(CMAKE_REQUIRED_FLAGS)
unset(CMAKE_REQUIRED_QUIET)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  string(APPEND strict " -ftrapping-math")  # the default; clang's is the other, which is as good
elseif(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # What is undone may be the parts of -ffp-model=fast, of which clang warns.
  string(APPEND strict " -Wno-unknown-warning-option -Wno-overriding-t-option -Wno-overriding-option")
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(i[3-6]86|x86.*|AMD64)$")
  string(APPEND strict " -msse2 -mfpmath=sse")
endif()
# One string: of equal options CMake keeps the first, which may be before the one that it undoes.
target_compile_options(contact_strict_floating_point INTERFACE "SHELL:${strict}")
# Else the linker would add what flushes subnormal numbers from the start.
target_link_options(contact_strict_floating_point INTERFACE "SHELL:-fno-fast-math -fno-unsafe-math-optimizations")

# contact_together(target): its sources are compiled as one, so that the large headers are read once for them all. The largest takes
# 2 GB of memory.
function(contact_together target)
  if(CONTACT_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  endif()
endfunction()

# What nobody waits for when it runs.
set(contact_short_to_compile $<$<CONFIG:Release,RelWithDebInfo>:-O1>)

# contact_library(name [OPTIMISED] SOURCES ... LINK ... PRIVATE_LINK ...): a static library with the alias contact::name.
# Time is spent in what is OPTIMISED: production, the oracles and the judge. Families, engines, reports and commands run for moments
# and take long to compile: they are at -O1, as tests are.
function(contact_library name)
  cmake_parse_arguments(ARG "OPTIMISED" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(contact_${name} STATIC ${ARG_SOURCES})
  add_library(contact::${name} ALIAS contact_${name})
  target_compile_features(contact_${name} PUBLIC cxx_std_20)
  target_link_libraries(contact_${name} PUBLIC ${ARG_LINK}
                        PRIVATE ${ARG_PRIVATE_LINK} $<BUILD_INTERFACE:contact_warnings>
                                $<BUILD_INTERFACE:contact_strict_floating_point>)
  set_target_properties(contact_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  if(NOT ARG_OPTIMISED)
    target_compile_options(contact_${name} PRIVATE ${contact_short_to_compile})
  endif()
  contact_together(contact_${name})
endfunction()

include(${CMAKE_CURRENT_LIST_DIR}/ContactPlugin.cmake)

# What the sanitizers look at every time: the readers, which foreign bytes meet. `./run dev` has them look at all.
add_custom_target(reader_tests)

# contact_test(name [READERS] LABEL label [SLOW pattern] SOURCES ... LINK ...): one GoogleTest program; every test in it is a ctest of that
# label, or of "slow" where GoogleTest's pattern says so.
# Its files are compiled as one: those that call different things by one name have namespaces of their own.
function(contact_test name)
  cmake_parse_arguments(ARG "READERS" "LABEL;SLOW" "SOURCES;LINK" ${ARGN})
  if(NOT CONTACT_TESTS)
    return()
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_compile_features(${name} PRIVATE cxx_std_20)
  target_link_libraries(${name} PRIVATE ${ARG_LINK} GTest::gtest_main contact_warnings contact_strict_floating_point)
  target_compile_options(${name} PRIVATE ${contact_short_to_compile})  # what is tested is optimised as ever
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/dev ${PROJECT_SOURCE_DIR}/proptests)
  target_compile_definitions(${name} PRIVATE CONTACT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  contact_together(${name})
  if(ARG_READERS)
    add_dependencies(reader_tests ${name})
    string(APPEND ARG_LABEL -readers)  # one label: a list does not come through, and ctest -L looks for a part
  endif()
  set(others "")
  if(ARG_SLOW)
    set(others TEST_FILTER -${ARG_SLOW})
    gtest_discover_tests(${name} TEST_FILTER ${ARG_SLOW} DISCOVERY_TIMEOUT 120 PROPERTIES LABELS slow)
  endif()
  gtest_discover_tests(${name} ${others} DISCOVERY_TIMEOUT 120 PROPERTIES LABELS ${ARG_LABEL})
endfunction()

# contact_refused_test(name source words [option..]): a source that must not compile. -Wfatal-errors ends at the first error, so that one
# must be the readable sentence.
function(contact_refused_test name source words)
  add_test(NAME ${name}
           COMMAND ${CMAKE_CXX_COMPILER} -std=c++20 ${ARGN} -fsyntax-only -Wfatal-errors -I${PROJECT_SOURCE_DIR}/src
                   -I${PROJECT_SOURCE_DIR}/include -I${PROJECT_BINARY_DIR}/include
                   -isystem $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES> ${CMAKE_CURRENT_SOURCE_DIR}/${source})
  set_tests_properties(${name} PROPERTIES LABELS unit PASS_REGULAR_EXPRESSION "${words}")
endfunction()
