# Debian packages, one a component, and an archive of all that is installed: ./run packages.
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "contact-oracle maintainers <maintainers@contact-oracle.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_STRIP_FILES ON)
set(CPACK_ARCHIVE_THREADS 1)  # the same bytes wherever it is packed

set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(about "It answers questions about spheres, boxes, capsules, triangles, rays and
planes correctly rounded, and judges the answers of other engines exactly.")

# contact_debian_package(component name section description SETTING=VALUE..): its copyright and changelog are of that component too.
function(contact_debian_package component name section description)
  string(TOUPPER ${component} key)
  foreach(setting "PACKAGE_NAME=${name}" "PACKAGE_SECTION=${section}" "DESCRIPTION=${description}" ${ARGN})
    string(REGEX MATCH "^([A-Z_]+)=(.*)$" setting "${setting}")
    set(CPACK_DEBIAN_${key}_${CMAKE_MATCH_1} "${CMAKE_MATCH_2}" PARENT_SCOPE)
  endforeach()
  set(excluded)
  if(component STREQUAL "python")
    set(excluded EXCLUDE_FROM_ALL)
  endif()
  set(more "")
  if(component STREQUAL "runtime")
    set(more "# CPack writes a call of ldconfig beside the trigger, and cannot be told not to.\n${name}: maintscript-calls-ldconfig\n")
  endif()
  set(overrides ${PROJECT_BINARY_DIR}/packaging/overrides/${name})
  configure_file(${PROJECT_SOURCE_DIR}/packaging/debian/overrides.in ${overrides} @ONLY)
  install(FILES ${overrides} DESTINATION share/lintian/overrides COMPONENT ${component} ${excluded})
  install(FILES ${PROJECT_SOURCE_DIR}/packaging/copyright ${changelogs} DESTINATION share/doc/${name} COMPONENT ${component} ${excluded})
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
endfunction()

# Debian wants them compressed, with no name or date in what gzip writes.
set(changelogs)
find_program(CONTACT_GZIP gzip)
if(CONTACT_GZIP)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/packaging)
  foreach(log CHANGELOG.md=changelog packaging/debian/changelog=changelog.Debian)
    string(REGEX MATCH "(.*)=(.*)" log ${log})
    set(source ${PROJECT_SOURCE_DIR}/${CMAKE_MATCH_1})
    set(packed ${PROJECT_BINARY_DIR}/packaging/${CMAKE_MATCH_2}.gz)
    execute_process(COMMAND ${CONTACT_GZIP} -9nc ${source} OUTPUT_FILE ${packed} COMMAND_ERROR_IS_FATAL ANY)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    list(APPEND changelogs ${packed})
  endforeach()
endif()

set(CPACK_COMPONENTS_ALL)
set(runtime "")
if(TARGET contact_shared)
  get_target_property(soversion contact_shared SOVERSION)
  set(control ${PROJECT_SOURCE_DIR}/packaging/debian/triggers ${PROJECT_BINARY_DIR}/packaging/shlibs)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/packaging/shlibs
       CONTENT "libcontact-oracle ${soversion} libcontact-oracle${soversion} (>= ${PROJECT_VERSION})\n")
  contact_debian_package(runtime libcontact-oracle${soversion} libs "verified reference for collision contacts (shared library)
The library of libcontact-oracle-dev for programs in C and in whatever calls C.")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${control})  # a list would not come through the function
  set(runtime "libcontact-oracle${soversion} (= ${PROJECT_VERSION}-1), ")
endif()
contact_debian_package(contact libcontact-oracle-dev libdevel "verified reference for collision contacts (development files)
Decisions and contacts of spheres, boxes, capsules, triangles, rays and
planes, each number the exact real one rounded once, for one pair and for
many in vectors. With SOFA's names for detection between models."
  "PACKAGE_DEPENDS=${runtime}libeigen3-dev (>= 3.4), libhwy-dev (>= 1.0.3)")
if(TARGET contact-oracle)
  contact_debian_package(program contact-oracle science "certifies the contacts that a physics engine computes
${about}
An exact oracle says what is right, and a second one checks it. With laws for
random questions, golden files, and reports for continuous integration."
    "PACKAGE_SUGGESTS=python3-contact-oracle, libcontact-oracle-dev")
endif()
if(TARGET contact-oracle-mpi)
  contact_debian_package(cluster contact-oracle-mpi science "certifies contacts with many processes under mpirun
The program of contact-oracle, whose runs mpirun shares among the processes
of a machine or a cluster. A report has the same bytes as that of one process."
    "PACKAGE_DEPENDS=contact-oracle (= ${PROJECT_VERSION}-1)")
endif()
if(TARGET contact_python)
  # The module is of one version of Python.
  contact_debian_package(python python3-contact-oracle python "verified reference for collision contacts, for Python
${about}
With a plugin for pytest and strategies for Hypothesis."
    "PACKAGE_DEPENDS=python3 (>= 3.11), python3 (<< 3.12), python3-numpy"
    "PACKAGE_RECOMMENDS=contact-oracle (= ${PROJECT_VERSION}-1)"
    "PACKAGE_SUGGESTS=python3-pytest, python3-hypothesis, python3-matplotlib, python3-pandas")
endif()
include(CPack)
