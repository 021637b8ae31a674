# Our own code compiles without warnings; headers of dependencies are SYSTEM and stay out of it.
function(anisomesh_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
                         # OpenMesh's vectors are uninitialized by default on purpose; GCC 12 sees that through its containers.
                         $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  if(ANISOMESH_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()
