# dashpot_compile(TARGET NETWORK FILE [DEVICE FILE] [RATE HZ] [SCHEME NAME] [STATE_INPUT NAME] [DECOMPOSITION NAME|DAMPING]
#                 [SCALAR double|float] [VECTOR none|sse2|avx2|avx512|neon] [TEMPLATES FOLDER] [CONSTANT_TIME] [BATCH] [WITH_TEST]
#                 [FMU 2|3])
#
# Makes TARGET, an INTERFACE library: what links it includes <NAME.hpp>, the update law of the network called NAME in FILE,
# and is built after it. The law is compiled again when the network, the device, the compiler or a template changes, and
# only then. The options mean what they mean on the command line of dashpot; an option not given has the default of that
# command. A refused network stops the build with the compiler's own message.
#
# BATCH also makes <NAME_batch.hpp>, a class for many points of the network.
#
# FMU also makes NAME.fmu, the law as a unit for co-simulation of FMI 2.0 or 3.0, for the machine that builds; the property
# DASHPOT_FMU of TARGET is its path.
#
# WITH_TEST also makes TARGET_test, GoogleTest cases of the law against closed forms, and registers them with CTest.
#
# Relative paths start from the current source folder. One folder of output for each target: two targets may hold laws of
# one network, but one program can link only one of them, because both are the same class.
function(dashpot_compile target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "WITH_TEST;CONSTANT_TIME;BATCH"
    "NETWORK;DEVICE;RATE;SCHEME;STATE_INPUT;DECOMPOSITION;SCALAR;VECTOR;TEMPLATES;FMU" "")
  if(arg_UNPARSED_ARGUMENTS OR arg_KEYWORDS_MISSING_VALUES OR NOT arg_NETWORK)
    message(FATAL_ERROR "dashpot_compile(${target}): NETWORK FILE is needed, and each of its options has one value; not "
                        "understood: '${arg_UNPARSED_ARGUMENTS}' '${arg_KEYWORDS_MISSING_VALUES}'")
  endif()
  foreach(path IN ITEMS NETWORK DEVICE TEMPLATES)
    if(arg_${path})
      cmake_path(ABSOLUTE_PATH arg_${path} BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
    endif()
  endforeach()

  _dashpot_name_of(name "${arg_NETWORK}")
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target})
  set(outputs ${folder}/${name}.hpp)
  set(options)
  foreach(option IN ITEMS DEVICE RATE SCHEME STATE_INPUT DECOMPOSITION SCALAR VECTOR TEMPLATES)
    if(DEFINED arg_${option})
      string(TOLOWER --${option} flag)
      string(REPLACE _ - flag ${flag})
      list(APPEND options ${flag} ${arg_${option}})
    endif()
  endforeach()
  set(fmu)
  if(DEFINED arg_FMU)
    if(NOT arg_FMU MATCHES "^[23]$")
      message(FATAL_ERROR "dashpot_compile(${target}): FMU is '${arg_FMU}'; 2 or 3 is expected, the version of the standard")
    endif()
    list(APPEND outputs ${folder}/${name}.fmu)
    set(fmu COMMAND dashpot::dashpot compile ${arg_NETWORK} ${options} --target fmi${arg_FMU} -o ${folder})
  endif()
  if(arg_CONSTANT_TIME)
    list(APPEND options --constant-time)
  endif()
  if(arg_BATCH)
    list(APPEND outputs ${folder}/${name}_batch.hpp)
    list(APPEND options --batch)
  endif()
  if(arg_WITH_TEST)
    list(APPEND outputs ${folder}/${name}_test.cpp)
    list(APPEND options --with-test)
  endif()

  file(MAKE_DIRECTORY ${folder})
  add_custom_command(
    OUTPUT ${outputs}
    # A network under a new name leaves no header of the old one.
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${folder}
    COMMAND dashpot::dashpot compile ${arg_NETWORK} ${options} -o ${folder} --depfile ${folder}/${name}.d
    ${fmu}
    DEPENDS ${arg_NETWORK} ${arg_DEVICE} dashpot::dashpot
    DEPFILE ${folder}/${name}.d
    COMMENT "Compiling network ${name} for ${target}"
    VERBATIM)

  add_custom_target(${target}_law DEPENDS ${outputs})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_law)
  target_include_directories(${target} INTERFACE ${folder})
  target_link_libraries(${target} INTERFACE dashpot::runtime)
  # The bits that `dashpot simulate` prints are those of code without fused multiply-add.
  target_compile_options(${target} INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>)
  if(DEFINED arg_FMU)
    set_target_properties(${target} PROPERTIES DASHPOT_FMU ${folder}/${name}.fmu)
  endif()
  if(arg_WITH_TEST)
    _dashpot_add_test(${target} ${folder}/${name}_test.cpp)
  endif()
endfunction()

# The emitted file is called after the network, so its name is read when the build is configured, and again when the file
# changes. From a file that cannot be read no name comes; saying why is left to the compiler.
function(_dashpot_name_of result network)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${network})
  cmake_path(GET network STEM name)
  if(EXISTS ${network})
    file(READ ${network} text)
    string(JSON stated ERROR_VARIABLE unreadable GET "${text}" name)
    if(NOT unreadable AND stated MATCHES "^[A-Za-z][A-Za-z0-9_]*$")
      set(name ${stated})
    endif()
  endif()
  set(${result} ${name} PARENT_SCOPE)
endfunction()

function(_dashpot_add_test target source)
  find_package(GTest REQUIRED)
  include(GoogleTest)
  add_executable(${target}_test ${source})
  target_link_libraries(${target}_test PRIVATE ${target} GTest::gtest_main)
  gtest_discover_tests(${target}_test)
endfunction()
