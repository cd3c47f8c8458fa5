include(${CMAKE_CURRENT_LIST_DIR}/defrayTargets.cmake)
