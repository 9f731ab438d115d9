# contact_hdf5: HDF5 for whatever links it. Debian's shared library brings 28 others (curl, Kerberos, LDAP and what these
# need), which a program loads before it does anything: 27 of the 43 ms that it took to start. A program takes the static
# library where there is one that links; it cannot be part of a shared library.
add_library(contact_hdf5 INTERFACE)
list(GET HDF5_C_LIBRARIES 0 shared)
cmake_path(GET shared PARENT_PATH folder)
find_library(CONTACT_HDF5_STATIC NAMES libhdf5.a PATHS ${folder} ${folder}/hdf5/serial NO_DEFAULT_PATH)
find_library(CONTACT_SZIP NAMES sz)
set(static "")
if(CONTACT_HDF5_STATIC AND CONTACT_SZIP)
  set(static ${CONTACT_HDF5_STATIC} ${CONTACT_SZIP} ZLIB::ZLIB ${CMAKE_DL_LIBS} m)
  include(CheckCSourceCompiles)
  set(CMAKE_REQUIRED_INCLUDES ${HDF5_C_INCLUDE_DIRS})
  set(CMAKE_REQUIRED_LIBRARIES ${static})
  check_c_source_compiles("#include <hdf5.h>\nint main(void) { return H5open() + (H5Fopen(\"x\", 0, 0) > 0); }"
                          CONTACT_HDF5_STATIC_LINKS)
endif()
if(CONTACT_HDF5_STATIC_LINKS)
  target_link_libraries(contact_hdf5 INTERFACE
    "$<IF:$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>,${static},hdf5::hdf5>")
  target_include_directories(contact_hdf5 SYSTEM INTERFACE ${HDF5_C_INCLUDE_DIRS})
else()
  target_link_libraries(contact_hdf5 INTERFACE hdf5::hdf5)
endif()
