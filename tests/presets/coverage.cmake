# Tests that count executed lines. cmake -C tests/presets/coverage.cmake -S . -B build/coverage
set(CMAKE_GENERATOR Ninja CACHE INTERNAL "")
set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "" FORCE)
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g0" CACHE STRING "" FORCE)
set(DEFRAY_TESTS ON CACHE BOOL "" FORCE)
set(DEFRAY_COVERAGE ON CACHE BOOL "" FORCE)
