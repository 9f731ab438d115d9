# Debian packages of what is installed, by component: cpack -G DEB -D CPACK_COMPONENTS_ALL=python
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "contact-oracle maintainers <maintainers@contact-oracle.example>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-contact-oracle)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Verified reference for collision contacts, for Python
 Answers questions about spheres, boxes, capsules, triangles, rays and planes
 correctly rounded, and judges the answers of other engines exactly. With a
 plugin for pytest and strategies for Hypothesis.")
# The module is of one version of Python.
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pytest, python3-hypothesis, python3-pandas")
include(CPack)
