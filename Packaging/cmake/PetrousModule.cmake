include(GoogleTest)

if(PETROUS_UNITY)
  find_program(PETROUS_PYTHON3 python3 REQUIRED)
  file(GLOB_RECURSE headers Application/*.h Modules/*.h Testing/*.h)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${headers})
endif()

# Compiles the sources of a target in batches, PETROUS_UNITY_BATCH at most in each. Which sources can
# share one is found by reading them and their headers, whenever one has changed.
function(petrous_unity_batches target)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "[.](cpp|cxx)$")
  list(LENGTH sources count)
  if(count LESS 2)
    return()
  endif()
  set(script ${CMAKE_SOURCE_DIR}/Packaging/cmake/unity-batches.py)
  execute_process(COMMAND ${PETROUS_PYTHON3} -B ${script} ${PETROUS_UNITY_BATCH} ${sources}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
    OUTPUT_VARIABLE batches OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  foreach(source IN LISTS sources) # some by a relative path to another folder
    get_filename_component(source ${source} ABSOLUTE)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${script} ${source})
  endforeach()
  string(REPLACE ";" "|" batches "${batches}")
  string(REPLACE "\n" ";" batches "${batches}")
  set(number 0)
  foreach(batch IN LISTS batches)
    string(REPLACE "|" ";" batch "${batch}")
    list(LENGTH batch count)
    if(count GREATER 1)
      set_source_files_properties(${batch} PROPERTIES UNITY_GROUP ${target}${number})
      math(EXPR number "${number} + 1")
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # A batch includes its sources, and the fixtures of a test are in anonymous namespaces.
  target_compile_options(${target} PRIVATE
    $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
endfunction()

# Common settings of all targets: language level, warnings, sanitizers.
function(petrous_target_defaults target)
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
    $<$<BOOL:${PETROUS_WERROR}>:-Werror>)
  if(PETROUS_SANITIZE)
    target_compile_options(${target} PRIVATE
      -fsanitize=${PETROUS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(${target} PRIVATE -fsanitize=${PETROUS_SANITIZE})
  endif()
  if(PETROUS_UNITY)
    petrous_unity_batches(${target})
  endif()
endfunction()

# petrous_test_defaults(<target>): a test's own code is compiled more often than it runs, and runs
# briefly beside the code under test, which is optimized as in the release.
function(petrous_test_defaults target)
  petrous_target_defaults(${target})
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release,RelWithDebInfo>:-O1>)
endfunction()

# petrous_add_tests(<target> SOURCES file... [LINK target...] [LABELS label...])
# One executable; each GoogleTest case becomes a separate CTest test.
function(petrous_add_tests target)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;LABELS" ${ARGN})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  add_executable(${target} ${ARG_SOURCES})
  petrous_test_defaults(${target})
  target_link_libraries(${target} PRIVATE ${ARG_LINK} GTest::gtest_main)
  set(data_dir "${PETROUS_DATA_DIR}")
  if(PETROUS_SANITIZE MATCHES "thread")
    # Debian's libtbb is not instrumented: the sanitizer does not see the synchronization with its
    # worker threads and reports races. On a single processor the pool has no worker threads; our
    # own threads are still checked.
    set_target_properties(${target} PROPERTIES CROSSCOMPILING_EMULATOR "taskset;--cpu-list;0")
  endif()
  gtest_discover_tests(${target}
    DISCOVERY_MODE PRE_TEST
    PROPERTIES
      LABELS "${ARG_LABELS}"
      TIMEOUT 600
      ENVIRONMENT "PETROUS_DATA=${data_dir}"
      ENVIRONMENT_MODIFICATION "XDG_CACHE_HOME=set:${CMAKE_BINARY_DIR}/Testing/cache")
endfunction()

# petrous_share_samples(<target>): tests that begin with a sample patient, made once for all (MadeOnce.h).
function(petrous_share_samples target)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/Modules/Phantom/Testing)
  target_compile_definitions(${target} PRIVATE PETROUS_CACHED_BY="$<TARGET_FILE:petrous>"
    PETROUS_TEST_CACHE="${PROJECT_BINARY_DIR}/Testing/samples")
endfunction()

# petrous_add_module(<Name>
#   SOURCES file...            the library's sources, src/<Part>/<Name>.cpp
#   DEPENDS Module...          modules whose public headers it includes
#   EXTERNAL target...         libraries that its public headers use
#   PRIVATE_EXTERNAL target... libraries that only its sources use
#   TESTS file...              GoogleTest sources labelled 'unit'
#   RENDER_TESTS file...       GoogleTest sources labelled 'render' (draw off-screen)
#   DATA_TESTS file...         GoogleTest sources labelled 'data' (real files beside the project))
# The declared DEPENDS are checked against the #includes by Testing/IncludeDependencies.cmake.
function(petrous_add_module name)
  cmake_parse_arguments(ARG "" ""
    "SOURCES;DEPENDS;EXTERNAL;PRIVATE_EXTERNAL;TESTS;RENDER_TESTS;DATA_TESTS" ${ARGN})
  set(target Petrous${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(Petrous::${name} ALIAS ${target})
  petrous_target_defaults(${target})
  # Private headers are included by name only, from any part.
  set(parts src)
  foreach(source IN LISTS ARG_SOURCES)
    get_filename_component(part ${source} DIRECTORY)
    list(APPEND parts ${part})
  endforeach()
  list(REMOVE_DUPLICATES parts)
  target_include_directories(${target}
    PUBLIC include
    PRIVATE ${parts})
  list(TRANSFORM ARG_DEPENDS PREPEND Petrous:: OUTPUT_VARIABLE modules)
  target_link_libraries(${target}
    PUBLIC ${modules} ${ARG_EXTERNAL}
    PRIVATE ${ARG_PRIVATE_EXTERNAL})
  set_property(GLOBAL APPEND PROPERTY PETROUS_MODULES ${name})
  set_property(GLOBAL PROPERTY PETROUS_DEPENDS_${name} "${ARG_DEPENDS}")

  foreach(pair "TESTS|Tests|unit" "RENDER_TESTS|RenderTests|render" "DATA_TESTS|DataTests|data")
    string(REPLACE "|" ";" pair "${pair}")
    list(GET pair 0 files)
    list(GET pair 1 suffix)
    list(GET pair 2 label)
    if(ARG_${files})
      petrous_add_tests(${target}${suffix} SOURCES ${ARG_${files}} LABELS ${label}
        LINK Petrous::${name} ${ARG_PRIVATE_EXTERNAL})
      target_include_directories(${target}${suffix} PRIVATE ${parts} Testing)
    endif()
  endforeach()
endfunction()
