# Tests under ThreadSanitizer. cmake -C tests/presets/tsan.cmake -S . -B build/tsan
set(CMAKE_GENERATOR Ninja CACHE INTERNAL "")
set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "" FORCE)
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1" CACHE STRING "" FORCE)
set(DEFRAY_TESTS ON CACHE BOOL "" FORCE)
set(DEFRAY_SANITIZE thread CACHE STRING "" FORCE)
