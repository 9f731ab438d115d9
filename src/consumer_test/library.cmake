# Somebody else's programs in C and C++ against the installed library. VARIANT pkg_config finds it by pkg-config, shared and static;
# components by the components of find_package, in C alone and in C++ with a plug-in; an unknown component is refused in words;
# fortran and rust call the C interface.
cmake_minimum_required(VERSION 3.25)
set(library ${WORK}/installed/${LIBDIR})
set(ENV{LD_LIBRARY_PATH} ${library})
set(ENV{PKG_CONFIG_PATH} ${library}/pkgconfig)
set(folder ${WORK}/library_${VARIANT})
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder})
separate_arguments(flags UNIX_COMMAND "${FLAGS}")
set(in_c ${EXAMPLES}/c/contacts.c)
set(in_c_prints "contact-oracle ${VERSION}: 2 hits\nsphere 0: value -0.5 at (0, 0, -0.5)\nsphere 1: value 0 at (1, 0, 0)\nsphere 2: none\n")
set(in_cpp ${CMAKE_CURRENT_LIST_DIR}/spheres.cpp)
set(in_cpp_prints "value -0.25\n")

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The program needs the shared library, or does not, and prints what is expected.
function(expect program kind printed)
  execute_process(COMMAND ${READELF} -d ${program} OUTPUT_VARIABLE needed COMMAND_ERROR_IS_FATAL ANY)
  string(FIND "${needed}" "Shared library: [libcontact-oracle.so.${SOVERSION}]" found)
  if((kind STREQUAL "shared" AND found EQUAL -1) OR (kind STREQUAL "static" AND NOT found EQUAL -1))
    message(FATAL_ERROR "${program} should have the ${kind} library:\n${needed}")
  endif()
  execute_process(COMMAND ${program} ${ARGN} OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  if(NOT output STREQUAL printed)
    message(FATAL_ERROR "${program} printed\n${output}where this was expected\n${printed}")
  endif()
endfunction()

function(pkg_config module printed source)
  foreach(kind shared static)
    set(options --cflags --libs ${module})
    if(kind STREQUAL "static")
      list(PREPEND options --static)
    endif()
    execute_process(COMMAND ${PKG_CONFIG} ${options} OUTPUT_VARIABLE said OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    if(kind STREQUAL "static")  # where both lie side by side the linker takes the shared one
      string(REPLACE "-lcontact-oracle" "-l:libcontact-oracle.a" said "${said}")
    endif()
    separate_arguments(said UNIX_COMMAND "${said}")
    set(program ${folder}/${module}_${kind})
    run(${ARGN} ${flags} -Wall -Wextra -Wpedantic -Werror ${source} ${said} -o ${program})
    expect(${program} ${kind} "${printed}")
  endforeach()
endfunction()

function(configure name)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/components -B ${folder}/${name} -G Ninja
                          -DCMAKE_PREFIX_PATH=${WORK}/installed -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${COMPILER}
                          -DCMAKE_C_FLAGS=${FLAGS} -DCMAKE_CXX_FLAGS=${FLAGS} -DVERSION=${VERSION} -DEXAMPLES=${EXAMPLES} ${ARGN}
                  RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(failed ${failed} PARENT_SCOPE)
  set(output "${output}" PARENT_SCOPE)
endfunction()

# components(name kind printed settings...): configured, built and run
function(components name kind printed)
  configure(${name} ${ARGN})
  if(failed)
    message(FATAL_ERROR "${output}")
  endif()
  run(${CMAKE_COMMAND} --build ${folder}/${name})
  file(GLOB plugins ${folder}/${name}/capsule.so)
  expect(${folder}/${name}/consumer ${kind} "${printed}" ${plugins})
endfunction()

if(VARIANT STREQUAL "pkg_config")
  pkg_config(contact-oracle-c "${in_c_prints}" ${in_c} ${C_COMPILER} -std=c99)
  pkg_config(contact-oracle "${in_cpp_prints}" ${in_cpp} ${COMPILER} -std=c++20)
  # The headers of C are C++ too, and get along with those of the engine protocol.
  file(WRITE ${folder}/both.cpp "#include <contact/contact.h>\n#include <contact/contact_engine.h>\n")
  file(WRITE ${folder}/both.c "#include <contact/contact_engine.h>\n#include <contact/contact.h>\nint unused;\n")
  run(${COMPILER} -std=c++11 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I${WORK}/installed/include ${folder}/both.cpp)
  run(${C_COMPILER} -std=c99 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I${WORK}/installed/include ${folder}/both.c)
elseif(VARIANT STREQUAL "fortran" OR VARIANT STREQUAL "rust")
  execute_process(COMMAND ${PKG_CONFIG} --libs-only-L contact-oracle-c OUTPUT_VARIABLE said OUTPUT_STRIP_TRAILING_WHITESPACE
                  COMMAND_ERROR_IS_FATAL ANY)
  if(VARIANT STREQUAL "fortran")
    run(${COMPILER} -std=f2018 -Wall -Wextra -pedantic -Werror -J ${folder} ${EXAMPLES}/c/contacts.f90 ${said} -lcontact-oracle -o ${folder}/contacts)
  else()
    run(${COMPILER} -D warnings ${EXAMPLES}/c/contacts.rs ${said} -o ${folder}/contacts)
  endif()
  expect(${folder}/contacts shared "2 hits\nsphere 0: value -0.5\nsphere 1: value  0.0\n")
else()
  # The shared library asks a program in C for no other package and no C++.
  components(c shared "${in_c_prints}" -DCOMPONENTS=c,shared -DLANGUAGES=C -DSOURCE=${in_c} -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON
             -DCMAKE_DISABLE_FIND_PACKAGE_hwy=ON)
  components(c_static static "${in_c_prints}" -DCOMPONENTS=c,static -DLANGUAGES=C,CXX -DSOURCE=${in_c}
             -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON)
  components(cpp shared "0 wrong, 1 plug-ins\n" -DCOMPONENTS=contact,plugin -DBUILD_SHARED_LIBS=ON -DLANGUAGES=CXX
             -DSOURCE=${CMAKE_CURRENT_LIST_DIR}/main.cpp)
  configure(unknown -DCOMPONENTS=c,fortran -DLANGUAGES=C -DSOURCE=${in_c})
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(NOT failed OR NOT output MATCHES "contact-oracle has no component fortran: it has c, contact, plugin")
    message(FATAL_ERROR "the component fortran was not refused in words: ${failed}\n${output}")
  endif()
endif()
