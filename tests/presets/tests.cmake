# The test build: clang, which builds tests in a third of GCC's time, and its linker.
# cmake -C tests/presets/tests.cmake -S . -B build/tests
include(${CMAKE_CURRENT_LIST_DIR}/clang.cmake)
# Indices beyond an array or a vector end a test.
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -D_GLIBCXX_ASSERTIONS" CACHE STRING "" FORCE)
set(DEFRAY_BENCHMARKS ON CACHE BOOL "" FORCE)
set(DEFRAY_REACHED ON CACHE BOOL "" FORCE)
