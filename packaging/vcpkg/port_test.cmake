# The vcpkg port with stand-ins for vcpkg's functions: it configures, installs, and a consumer finds and uses what it installed.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/stand_ins.cmake)
set(PORT contact-oracle)
set(CURRENT_PACKAGES_DIR ${WORK}/packages)
file(REMOVE_RECURSE ${WORK})

file(READ ${CMAKE_CURRENT_LIST_DIR}/${PORT}/vcpkg.json manifest)
string(JSON name GET "${manifest}" name)
string(JSON version GET "${manifest}" version)
if(NOT name STREQUAL PORT OR NOT version STREQUAL VERSION)
  message(FATAL_ERROR "packaging/vcpkg/${PORT}/vcpkg.json says ${name} ${version} where the project is ${PORT} ${VERSION}")
endif()

include(${CMAKE_CURRENT_LIST_DIR}/${PORT}/portfile.cmake)

# What vcpkg itself refuses in a port.
foreach(file share/${PORT}/copyright share/${PORT}/usage share/${PORT}/contact-oracle-config.cmake include/contact/contact.h)
  if(NOT EXISTS ${CURRENT_PACKAGES_DIR}/${file})
    message(FATAL_ERROR "the port installs no ${file}")
  endif()
endforeach()
if(EXISTS ${CURRENT_PACKAGES_DIR}/lib/cmake OR EXISTS ${CURRENT_PACKAGES_DIR}/debug/include)
  message(FATAL_ERROR "the port leaves lib/cmake or debug/include")
endif()

file(RENAME ${WORK}/packages ${WORK}/installed)  # as vcpkg moves it
run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/consumer -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/installed -DCMAKE_CXX_COMPILER=${COMPILER}
    -DBUILD_SHARED_LIBS=${SHARED} -DCMAKE_CXX_FLAGS=${FLAGS} -DCOMPONENTS=contact -DLANGUAGES=CXX -DVERSION=${VERSION}
    -DSOURCE=${CONSUMER}/../spheres.cpp)
run(${CMAKE_COMMAND} --build ${WORK}/consumer)
execute_process(COMMAND ${WORK}/consumer/consumer OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
if(NOT output STREQUAL "value -0.25\n")
  message(FATAL_ERROR "the consumer printed ${output}")
endif()
