# What is installed: one library of all that production is, static, shared or both; headers; and how CMake and pkg-config find them.
# docs/library.md
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
if(BUILD_SHARED_LIBS)
  set(kinds shared)
elseif(PROJECT_IS_TOP_LEVEL AND UNIX AND NOT APPLE AND NOT DEFINED BUILD_SHARED_LIBS)
  set(kinds static shared)
else()
  set(kinds static)
endif()
set(CONTACT_LIBRARIES ${kinds} CACHE STRING "The kinds of library that are installed: static, shared, or both")

# Of the shared library nothing is seen but what the installed headers declare.
string(LENGTH ${CONTACT_ABI} abi_length)
configure_file(${CMAKE_CURRENT_SOURCE_DIR}/exports.map.in ${PROJECT_BINARY_DIR}/exports.map @ONLY)
foreach(kind IN LISTS CONTACT_LIBRARIES)
  string(TOUPPER ${kind} type)
  add_library(contact_${kind} ${type} $<TARGET_OBJECTS:contact_kernel> $<TARGET_OBJECTS:contact_batch> $<TARGET_OBJECTS:contact_contact>
                                      $<TARGET_OBJECTS:contact_c>)
  target_link_libraries(contact_${kind} PRIVATE $<TARGET_NAME_IF_EXISTS:hwy::hwy> ${CMAKE_DL_LIBS}
                                                $<BUILD_INTERFACE:contact_strict_floating_point> $<BUILD_INTERFACE:contact_warnings>)
  target_include_directories(contact_${kind} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_target_properties(contact_${kind} PROPERTIES LINKER_LANGUAGE CXX OUTPUT_NAME contact-oracle EXPORT_NAME c)
  add_library(contact_cxx_${kind} INTERFACE)
  target_compile_features(contact_cxx_${kind} INTERFACE cxx_std_20)
  target_link_libraries(contact_cxx_${kind} INTERFACE contact_${kind} Eigen3::Eigen)
  set_target_properties(contact_cxx_${kind} PROPERTIES EXPORT_NAME contact)
  # Programs need the shared library alone: component runtime.
  install(TARGETS contact_${kind} contact_cxx_${kind} EXPORT contact-oracle-${kind}
          ARCHIVE COMPONENT contact
          LIBRARY COMPONENT runtime NAMELINK_COMPONENT contact)
  install(EXPORT contact-oracle-${kind} FILE contact-oracle-${kind}.cmake NAMESPACE contact::
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/contact-oracle COMPONENT contact)
endforeach()
set_target_properties(contact_kernel contact_batch contact_contact contact_c PROPERTIES VISIBILITY_INLINES_HIDDEN ON)
if(TARGET contact_shared)
  set_target_properties(contact_shared PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${soversion}
                                                  LINK_DEPENDS ${PROJECT_BINARY_DIR}/exports.map)
  target_link_options(contact_shared PRIVATE LINKER:--version-script=${PROJECT_BINARY_DIR}/exports.map)
endif()

write_basic_package_version_file(${PROJECT_BINARY_DIR}/contact-oracle-config-version.cmake COMPATIBILITY SameMinorVersion)
configure_file(contact-oracle-config.cmake.in ${PROJECT_BINARY_DIR}/contact-oracle-config.cmake @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/contact-oracle-config.cmake ${PROJECT_BINARY_DIR}/contact-oracle-config-version.cmake
              ${PROJECT_SOURCE_DIR}/cmake/ContactPlugin.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/contact-oracle COMPONENT contact)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ ${PROJECT_BINARY_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        COMPONENT contact PATTERN *.in EXCLUDE)

# pkg-config: contact-oracle for C++, contact-oracle-c for C. Where there is a shared library, what the static one needs is private: for
# `pkg-config --static`. Where there is none, everybody needs it.
set(folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX})
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${folder} OUTPUT_VARIABLE prefix)
foreach(what libdir includedir)
  string(TOUPPER CMAKE_INSTALL_${what} directory)
  set(${what} \${prefix})
  cmake_path(APPEND ${what} ${${directory}})
endforeach()
set(private)
if("shared" IN_LIST CONTACT_LIBRARIES)
  set(private _private)
endif()
if("static" IN_LIST CONTACT_LIBRARIES)
  set(runtime ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
  list(REMOVE_ITEM runtime gcc gcc_s c)
  list(REMOVE_DUPLICATES runtime)
  list(TRANSFORM runtime PREPEND -l)
  list(JOIN runtime " " libs${private})
  if(hwy_FOUND)
    set(requires${private} libhwy)
  endif()
endif()
foreach(module contact-oracle contact-oracle-c)
  configure_file(${module}.pc.in ${PROJECT_BINARY_DIR}/${module}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${module}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT contact)
endforeach()
