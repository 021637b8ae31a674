# Configures the project with an npm that fails: that is said, and everything but the viewer is there to be built.
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work})
file(WRITE ${work}/npm "#!/bin/sh\necho 'npm error network getaddrinfo ENOTFOUND'\nexit 1\n")
file(CHMOD ${work}/npm PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
execute_process(
  COMMAND ${CMAKE_COMMAND} -G ${generator} -S ${source} -B ${work}/build -D CMAKE_CXX_COMPILER=${compiler} -D ANISOMESH_NPM=${work}/npm
    -D ANISOMESH_VIEW=ON -D ANISOMESH_TESTS=OFF -D ANISOMESH_EXAMPLES=OFF -D ANISOMESH_BENCHMARKS=OFF
  RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT failed EQUAL 0)
  message(FATAL_ERROR "configuring failed: ${output}")
endif()
string(REGEX REPLACE "[ \n]+" " " said "${output}")
foreach(text "anisomesh-view is left out" "Is there a network" "ENOTFOUND" "ANISOMESH_VIEW=OFF")
  if(NOT said MATCHES "${text}")
    message(FATAL_ERROR "'${text}' is not in: ${output}")
  endif()
endforeach()
execute_process(COMMAND ${CMAKE_COMMAND} --build ${work}/build --target help RESULT_VARIABLE failed OUTPUT_VARIABLE targets)
if(NOT targets MATCHES "anisomesh-remesh" OR targets MATCHES "apps/anisomesh-view:" OR targets MATCHES "anisomesh-view: phony")
  message(FATAL_ERROR "the targets are ${targets}")
endif()
