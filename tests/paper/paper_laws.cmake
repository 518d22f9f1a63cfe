# Laws that the experiments run, written by the compiler that is being built.

# paper_file(RESULT TEMPLATE OUTPUT): TEMPLATE.json.in of this room as OUTPUT.json, with the caller's variables in place of its
# @names@, and then the values of chosen.json in place of its @section.key@s.
function(paper_file result template output)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    ${CMAKE_CURRENT_SOURCE_DIR}/chosen.json ${CMAKE_CURRENT_SOURCE_DIR}/${template}.json.in)
  file(READ chosen.json chosen)
  file(READ ${template}.json.in text)
  string(REGEX MATCHALL "@[a-z_]+@" variables "${text}")
  foreach(variable IN LISTS variables)
    string(REPLACE "@" "" plain ${variable})
    string(REPLACE ${variable} "${${plain}}" text "${text}")
  endforeach()
  string(REGEX MATCHALL "@[^@]+@" keys "${text}")
  foreach(key IN LISTS keys)
    string(REPLACE "@" "" plain ${key})
    string(JSON value GET "${chosen}" ${plain} value)
    string(JSON unit GET "${chosen}" ${plain} unit)
    if(unit STREQUAL "1" OR unit STREQUAL "samples" OR value MATCHES "^\\[")  # of a list, numbers in SI
      string(REPLACE ${key} "${value}" text "${text}")
    else()
      string(REPLACE ${key} "${value} ${unit}" text "${text}")
    endif()
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${output}.json CONTENT "${text}" @ONLY)
  set(${result} ${CMAKE_CURRENT_BINARY_DIR}/${output}.json PARENT_SCOPE)
endfunction()

# paper_network(RESULT NAME): networks/NAME.json.in.
function(paper_network result name)
  paper_file(file networks/${name} networks/${name})
  set(${result} ${file} PARENT_SCOPE)
endfunction()

# paper_arm(RESULT NAME FIRST SECOND ENCODERS): devices/isotropic_arm.json.in, with brakes along these two directions of joint
# velocities and with these members of its encoders, as devices/NAME.json.
function(paper_arm result name isotropic_first isotropic_second isotropic_encoders)
  paper_file(file devices/isotropic_arm devices/${name})
  set(${result} ${file} PARENT_SCOPE)
endfunction()

# paper_law(NAME NETWORK FILE OPTIONS…): dashpot::paper::laws::NAME, the class emitted for the network with these options of
# the command line. Laws of one network are one class: each gets a namespace of its own, so that one program holds them all.
function(paper_law name network)
  get_filename_component(class ${network} NAME_WE)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/laws/${name})
  cmake_parse_arguments(law "" "--device" "" ${ARGN})
  add_custom_command(
    OUTPUT ${folder}/${class}.hpp
    COMMAND ${CMAKE_COMMAND} -P ${PROJECT_SOURCE_DIR}/tests/responses/quietly.cmake --
            $<TARGET_FILE:dashpot::dashpot> compile ${network} ${ARGN} --no-advice -o ${folder}
    DEPENDS dashpot::dashpot ${network} ${law_--device}
    COMMENT "Emitting ${name}"
    VERBATIM)
  set(paper_law_headers ${paper_law_headers} ${folder}/${class}.hpp PARENT_SCOPE)
  string(APPEND paper_law_lines "#define generated paper_${name}\n#include \"${name}/${class}.hpp\"\n#undef generated\n"
    "namespace dashpot::paper::laws {\nusing ${name} = dashpot::paper_${name}::${class};\n}\n")
  set(paper_law_lines "${paper_law_lines}" PARENT_SCOPE)
endfunction()

# laws/laws.hpp, and a library of headers whose users include it.
function(write_paper_laws target)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/laws/laws.hpp CONTENT
    "// Written by paper_laws.cmake: every law of the experiments under a name of its own.\n#pragma once\n\n${paper_law_lines}")
  add_custom_target(${target}_headers DEPENDS ${paper_law_headers})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_headers)
  target_include_directories(${target} INTERFACE ${CMAKE_CURRENT_BINARY_DIR}/laws)
  target_compile_options(${target} INTERFACE -ffp-contract=off)
  target_link_libraries(${target} INTERFACE dashpot::runtime)
endfunction()
