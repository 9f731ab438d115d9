# Installs the production library into a new folder, builds a consumer and a plug-in against it there, and runs them.
foreach(step
    "${CMAKE_COMMAND};--install;${BUILD};--prefix;${WORK}/installed;--component;contact"
    "${CMAKE_COMMAND};-S;${SOURCE};-B;${WORK}/build;-G;Ninja;-DCMAKE_PREFIX_PATH=${WORK}/installed;-DCMAKE_CXX_COMPILER=${COMPILER};-DCMAKE_CXX_FLAGS=${FLAGS};-DEXAMPLES=${EXAMPLES}"
    "${CMAKE_COMMAND};--build;${WORK}/build"
    "${WORK}/build/consumer;${WORK}/build/capsule.so")
  execute_process(COMMAND ${step} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(REMOVE_RECURSE ${WORK})
