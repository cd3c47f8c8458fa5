# The test build: clang, which builds tests in a third of GCC's time, and its linker.
# cmake -C tests/presets/tests.cmake -S . -B build/tests
set(CMAKE_GENERATOR Ninja CACHE INTERNAL "")
set(CMAKE_CXX_COMPILER clang++ CACHE STRING "")
set(CMAKE_C_COMPILER clang CACHE STRING "")
set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "" FORCE)
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2" CACHE STRING "" FORCE)
set(DEFRAY_TESTS ON CACHE BOOL "" FORCE)
set(DEFRAY_BENCHMARKS ON CACHE BOOL "" FORCE)
