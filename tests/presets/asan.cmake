# Tests and fuzzers under AddressSanitizer and UndefinedBehaviorSanitizer; with clang, in a
# quarter of GCC's time. cmake -C tests/presets/asan.cmake -S . -B build/asan
include(${CMAKE_CURRENT_LIST_DIR}/clang.cmake)
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1" CACHE STRING "" FORCE)
set(DEFRAY_SANITIZE address CACHE STRING "" FORCE)
set(DEFRAY_FUZZ ON CACHE BOOL "" FORCE)
set(DEFRAY_REACHED ON CACHE BOOL "" FORCE)
