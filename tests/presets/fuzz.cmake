# The fuzzers, under AddressSanitizer and UndefinedBehaviorSanitizer.
# cmake -C tests/presets/fuzz.cmake -S . -B build/fuzz
set(CMAKE_GENERATOR Ninja CACHE INTERNAL "")
set(CMAKE_CXX_COMPILER clang++ CACHE STRING "")
set(CMAKE_C_COMPILER clang CACHE STRING "")
set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "" FORCE)
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1" CACHE STRING "" FORCE)
set(DEFRAY_FUZZ ON CACHE BOOL "" FORCE)
