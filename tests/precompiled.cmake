# With DASHPOT_PRECOMPILE: everything in these rooms that links the compiler or GoogleTest reads a precompiled header,
# with what the compiler is made of where it links that. Rooms do nothing for it.
if(NOT DASHPOT_PRECOMPILE)
  return()
endif()

file(CONFIGURE OUTPUT precompiled.cpp CONTENT "// Nothing but what is precompiled.\n")
add_library(dashpot_precompiled OBJECT ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp)
# As the programs that read it are compiled, warnings included: -Wpedantic alone makes another language of it, and g++
# passes it over.
target_link_libraries(dashpot_precompiled PRIVATE dashpot::compiler dashpot_warnings GTest::gtest)
target_precompile_headers(dashpot_precompiled PRIVATE
  <algorithm> <cmath> <functional> <map> <memory> <optional> <string> <variant> <vector>
  <fmt/format.h> <boost/multiprecision/cpp_bin_float.hpp> <gtest/gtest.h>)

add_library(dashpot_precompiled_tests OBJECT ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp)
target_compile_features(dashpot_precompiled_tests PRIVATE cxx_std_20)
target_link_libraries(dashpot_precompiled_tests PRIVATE dashpot_warnings GTest::gtest)
target_precompile_headers(dashpot_precompiled_tests PRIVATE
  <algorithm> <array> <chrono> <cmath> <functional> <memory> <optional> <string> <thread> <vector> <gtest/gtest.h>)

function(read_precompiled_header folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(NOT type MATCHES "EXECUTABLE|STATIC_LIBRARY")
      continue()
    endif()
    get_target_property(libraries ${target} LINK_LIBRARIES)
    get_target_property(own ${target} PRECOMPILE_HEADERS)
    get_target_property(shared ${target} PRECOMPILE_HEADERS_REUSE_FROM)
    if(own OR shared)
      continue()
    endif()
    string(REGEX MATCH "GTest::|board_bench" has_tests "${libraries}")
    string(REGEX MATCH "dashpot_test_support|dashpot::compiler|paper_experiments" has_compiler "${libraries}")
    if(has_compiler AND has_tests)
      target_precompile_headers(${target} REUSE_FROM dashpot_precompiled)
    elseif(has_compiler)
      target_precompile_headers(${target} REUSE_FROM dashpot_compiler)
    elseif(has_tests)
      target_precompile_headers(${target} REUSE_FROM dashpot_precompiled_tests)
    endif()
  endforeach()
  get_property(rooms_within DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(room IN LISTS rooms_within)
    read_precompiled_header(${room})
  endforeach()
endfunction()
read_precompiled_header(${CMAKE_CURRENT_SOURCE_DIR})
