# The two interface targets that every target of this project builds with, and one way to declare a library and a test.

add_library(contact_warnings INTERFACE)
target_compile_options(contact_warnings INTERFACE -Wall -Wextra -Wconversion -Wshadow -Wpedantic -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(contact_warnings INTERFACE -Wno-restrict)  # false alarms on "x" + std::string (GCC bug 105651)
endif()
if(CONTACT_SANITIZE)
  target_compile_options(contact_warnings INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(contact_warnings INTERFACE -fsanitize=address,undefined)
endif()

if(CONTACT_FUZZ)
  target_compile_options(contact_warnings INTERFACE -fsanitize=fuzzer-no-link)
endif()

# Strict floating point. Contraction would fuse a product and a sum into one rounding, and so change what the filters'
# bounds, the generator's bytes and the plain formulas mean; x87 registers would round twice.
add_library(contact_strict_floating_point INTERFACE)
target_compile_options(contact_strict_floating_point INTERFACE -ffp-contract=off)
if(CMAKE_SIZEOF_VOID_P EQUAL 4 AND CMAKE_SYSTEM_PROCESSOR MATCHES "i[3-6]86|x86|AMD64")
  target_compile_options(contact_strict_floating_point INTERFACE -msse2 -mfpmath=sse)
endif()
if("${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_RELEASE}" MATCHES "-ffast-math|-Ofast|-funsafe-math-optimizations")
  message(FATAL_ERROR "contact-oracle promises exact decisions and correct rounding: build it without -ffast-math")
endif()

# contact_library(name SOURCES ... LINK ... PRIVATE_LINK ...): a static library with the alias contact::name.
function(contact_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(contact_${name} STATIC ${ARG_SOURCES})
  add_library(contact::${name} ALIAS contact_${name})
  target_compile_features(contact_${name} PUBLIC cxx_std_20)
  target_link_libraries(contact_${name} PUBLIC ${ARG_LINK}
                        PRIVATE ${ARG_PRIVATE_LINK} $<BUILD_INTERFACE:contact_warnings>
                                $<BUILD_INTERFACE:contact_strict_floating_point>)
  set_target_properties(contact_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
endfunction()

include(${CMAKE_CURRENT_LIST_DIR}/ContactPlugin.cmake)

# What the sanitizers look at every time: production, the oracles and the readers. `./run dev` has them look at all.
add_custom_target(core_tests)

# contact_test(name [CORE] LABEL label SOURCES ... LINK ...): one GoogleTest program; every test in it is a ctest of that label.
function(contact_test name)
  cmake_parse_arguments(ARG "CORE" "LABEL" "SOURCES;LINK" ${ARGN})
  if(NOT CONTACT_TESTS)
    return()
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_compile_features(${name} PRIVATE cxx_std_20)
  target_link_libraries(${name} PRIVATE ${ARG_LINK} GTest::gtest_main contact_warnings contact_strict_floating_point)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/proptests)
  target_compile_definitions(${name} PRIVATE CONTACT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(ARG_CORE)
    add_dependencies(core_tests ${name})
    string(APPEND ARG_LABEL -core)  # one label: a list does not come through, and ctest -L looks for a part
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 120 PROPERTIES LABELS ${ARG_LABEL})
endfunction()
