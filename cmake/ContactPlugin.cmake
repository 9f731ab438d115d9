# contact_plugin(name SOURCES ... LINK ...): a shared library for contact::load_plugin. Installed with the package.
#
# Plug-in and host each hold a copy of contact::contact. Every symbol but the entry stays inside the plug-in, so that
# neither copy can take the other's place; they meet in what load_plugin hands over, and there alone.
function(contact_plugin name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} MODULE ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE contact::contact ${ARG_LINK} $<TARGET_NAME_IF_EXISTS:contact_warnings>
                                        $<TARGET_NAME_IF_EXISTS:contact_strict_floating_point>)
  set_target_properties(${name} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_link_options(${name} PRIVATE LINKER:--exclude-libs,ALL)
endfunction()
