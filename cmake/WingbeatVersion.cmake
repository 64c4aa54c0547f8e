# wingbeat_version(<source>): compiles version, git commit and source folder into one source file.
function(wingbeat_version source)
  set(commit "unknown")
  find_package(Git QUIET)
  if(Git_FOUND)
    execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --short=12 HEAD WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
      OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
    execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --absolute-git-dir WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
      OUTPUT_VARIABLE folder OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(NOT failed)
      set(commit ${found})
      # A new commit or another branch configures again.
      if(EXISTS ${folder}/logs/HEAD)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/logs/HEAD)
      endif()
    endif()
  endif()
  set_source_files_properties(${source} PROPERTIES COMPILE_DEFINITIONS
    "WINGBEAT_VERSION=\"${PROJECT_VERSION}\";WINGBEAT_COMMIT=\"${commit}\";WINGBEAT_SOURCE_DIR=\"${CMAKE_SOURCE_DIR}\"")
endfunction()
