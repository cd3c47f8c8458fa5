# The target `sanitized`: in asan/bin the fuzzers, and the tests with the library and the command
# line under AddressSanitizer and UndefinedBehaviorSanitizer. The tests' own objects are those of the
# build itself: compiling them again would take half as long as all the rest.
set(sanitizers -O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=undefined
               -fsanitize-ignorelist=${CMAKE_CURRENT_SOURCE_DIR}/presets/sanitized.ignore
               -D_GLIBCXX_ASSERTIONS)
set(sanitized_libraries defray_host defray_cli)
option(DEFRAY_SANITIZED_TESTS "`all` builds `sanitized` too" OFF)
if(DEFRAY_SANITIZED_TESTS)
  add_custom_target(sanitized ALL)
else()
  add_custom_target(sanitized)
endif()

# A library of ours once more, with all that its own CMakeLists.txt says.
function(add_sanitized_library library)
  set(target ${library}_sanitized)
  get_target_property(sources ${library} SOURCES)
  add_library(${target} STATIC EXCLUDE_FROM_ALL ${sources})
  foreach(source ${sources})
    get_source_file_property(is_alone ${source} TARGET_DIRECTORY ${library}
                             SKIP_UNITY_BUILD_INCLUSION)
    set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ${is_alone})
  endforeach()
  foreach(property COMPILE_DEFINITIONS COMPILE_OPTIONS INCLUDE_DIRECTORIES PRECOMPILE_HEADERS
                   LINK_LIBRARIES INTERFACE_INCLUDE_DIRECTORIES INTERFACE_LINK_LIBRARIES)
    get_target_property(value ${library} ${property})
    if(value)
      list(TRANSFORM value REPLACE "^defray_host$" "defray_host_sanitized")
      set_property(TARGET ${target} PROPERTY ${property} ${value})
    endif()
  endforeach()
  target_compile_options(${target} BEFORE PRIVATE ${sanitizers})
endfunction()

# asan/bin/NAME of these objects, and of the libraries of the target NAME.
function(add_sanitized_program name)
  set(target ${name}_sanitized)
  add_executable(${target} EXCLUDE_FROM_ALL ${ARGN})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name} RUNTIME_OUTPUT_DIRECTORY
                                                                 ${CMAKE_BINARY_DIR}/asan/bin)
  get_target_property(libraries ${name} LINK_LIBRARIES)
  list(REMOVE_ITEM libraries defray_test_support)
  list(APPEND libraries defray_host GTest::gtest_main)
  foreach(library ${sanitized_libraries})
    if(library IN_LIST libraries)
      list(REMOVE_ITEM libraries ${library})
      list(APPEND libraries ${library}_sanitized)
      # First: of what is inline in several objects the linker takes the first.
      target_link_options(${target} PRIVATE -Wl,--whole-archive
                          $<TARGET_FILE:${library}_sanitized> -Wl,--no-whole-archive)
    endif()
  endforeach()
  target_link_libraries(${target} PRIVATE ${libraries})
  target_link_options(${target} PRIVATE ${sanitizers})
  add_dependencies(sanitized ${target})
endfunction()

foreach(library ${sanitized_libraries})
  add_sanitized_library(${library})
endforeach()
add_sanitized_program(defray $<TARGET_OBJECTS:defray>)
foreach(folder kernels host command)
  add_sanitized_program(${folder}_tests $<TARGET_OBJECTS:${folder}_tests>
                        $<TARGET_OBJECTS:defray_test_support>)
endforeach()
