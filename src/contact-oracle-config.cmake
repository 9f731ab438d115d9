# find_package(contact-oracle): the target contact::contact, and contact_plugin to declare a plug-in with.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4)
find_dependency(Boost 1.74)
find_dependency(hwy 1.0.3)
include("${CMAKE_CURRENT_LIST_DIR}/contact-oracle-targets.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/ContactPlugin.cmake")
