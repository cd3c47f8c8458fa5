# Tests and fuzzers under AddressSanitizer and UndefinedBehaviorSanitizer; with clang, in a
# quarter of GCC's time. cmake -C tests/presets/asan.cmake -S . -B build/asan
set(CMAKE_GENERATOR Ninja CACHE INTERNAL "")
set(CMAKE_CXX_COMPILER clang++ CACHE STRING "")
set(CMAKE_C_COMPILER clang CACHE STRING "")
set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "" FORCE)
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1" CACHE STRING "" FORCE)
set(DEFRAY_TESTS ON CACHE BOOL "" FORCE)
set(DEFRAY_SANITIZE address CACHE STRING "" FORCE)
set(DEFRAY_FUZZ ON CACHE BOOL "" FORCE)
