# dashpot_compile(TARGET NETWORK FILE [DEVICE FILE] [RATE HZ] [SCHEME NAME] [STATE_INPUT NAME] [DECOMPOSITION NAME|DAMPING]
#                 [SCALAR double|float] [VECTOR none|sse2|avx2|avx512|neon] [TEMPLATES FOLDER] [CONSTANT_TIME] [BATCH] [WITH_TEST]
#                 [TARGET cpp|c99] [NAME NAME] [UNCERTIFIED] [CERTIFICATE FILE] [FMU 2|3] [PYTHON] [WASM])
#
# Makes TARGET, an INTERFACE library: what links it includes <NAME.hpp>, the update law of the network called NAME in FILE,
# and is built after it. The law is compiled again when the network, the device, the compiler or a template changes, and
# only then. The options mean what they mean on the command line of dashpot; an option not given has the default of that
# command. A refused network stops the build with the compiler's own message.
#
# DEVICE also makes <DEVICE_device.hpp>, what a servo loop has to know of the device, with the digest that the law was
# certified for: dashpot::devices::DEVICE::name, ::digest and ::description(). In the file's name, what is neither letter
# nor digit of the device's name is an underscore.
#
# TARGET c99 makes <NAME.h> and <DEVICE_device.h> instead, for C and C++; they need nothing of dashpot. A device of two
# axes is not described in C: of it there is <NAME.h> alone.
#
# BATCH also makes <NAME_batch.hpp>, a class for many points of the network.
#
# FMU also makes NAME.fmu, the law as a unit for co-simulation of FMI 2.0 or 3.0, for the machine that builds; the property
# DASHPOT_FMU of TARGET is its path.
#
# PYTHON also makes python/NAME/, the law as a package for Python, for the machine that builds; the property DASHPOT_PYTHON
# of TARGET is the folder that Python looks for it in. WASM also makes wasm/NAME/, the law as a module for JavaScript; the
# property DASHPOT_WASM is its index.js. With one of these three the law is made by default, and by the target TARGET_law,
# whether anything links TARGET or not.
#
# WITH_TEST also makes TARGET_test, GoogleTest cases of the law against closed forms or, with TARGET c99, a program in C,
# and registers them with CTest.
#
# CERTIFICATE names a file to write, for `dashpot verify`, which reads C++ alone: not with TARGET c99. UNCERTIFIED also
# makes a law that lacks damping on its device.
#
# Relative paths start from the current source folder, that of CERTIFICATE from the current binary folder. One folder of
# output for each target: two targets may hold laws of one network, but one program can link only one of them, because both
# are the same class; NAME gives one of them another name. The properties DASHPOT_HEADER and DASHPOT_CLASS of TARGET are the
# path of the header and the class in it.
#
# Where the build is for another machine, the compiler is that of DASHPOT_COMPILER, else an installed one that runs here.
function(dashpot_compile target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "WITH_TEST;CONSTANT_TIME;BATCH;UNCERTIFIED;PYTHON;WASM"
    "NETWORK;DEVICE;RATE;SCHEME;STATE_INPUT;DECOMPOSITION;SCALAR;VECTOR;TEMPLATES;TARGET;NAME;CERTIFICATE;FMU" "")
  if(arg_UNPARSED_ARGUMENTS OR arg_KEYWORDS_MISSING_VALUES OR NOT arg_NETWORK)
    message(FATAL_ERROR "dashpot_compile(${target}): NETWORK FILE is needed, and each of its options has one value; not "
                        "understood: '${arg_UNPARSED_ARGUMENTS}' '${arg_KEYWORDS_MISSING_VALUES}'")
  endif()
  if(NOT DEFINED arg_TARGET)
    set(arg_TARGET cpp)
  elseif(NOT arg_TARGET MATCHES "^(cpp|c99)$")
    message(FATAL_ERROR "dashpot_compile(${target}): TARGET is '${arg_TARGET}'; cpp or c99 is expected")
  endif()
  if(DEFINED arg_NAME AND NOT arg_NAME MATCHES "^[A-Za-z][A-Za-z0-9_]*$")
    message(FATAL_ERROR "dashpot_compile(${target}): NAME is '${arg_NAME}'; a name that a class can have is expected")
  endif()
  foreach(path IN ITEMS NETWORK DEVICE TEMPLATES)
    if(arg_${path})
      cmake_path(ABSOLUTE_PATH arg_${path} BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
    endif()
  endforeach()

  _dashpot_compiler(compiler compiler_file)
  if(DEFINED arg_NAME)
    set(name ${arg_NAME})
  else()
    _dashpot_name_of(name "${arg_NETWORK}")
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target})
  if(arg_TARGET STREQUAL "c99")
    set(suffix h)
  else()
    set(suffix hpp)
  endif()
  set(outputs ${folder}/${name}.${suffix})
  set(options)
  foreach(option IN ITEMS DEVICE RATE SCHEME STATE_INPUT DECOMPOSITION SCALAR VECTOR TEMPLATES NAME)
    if(DEFINED arg_${option})
      string(TOLOWER --${option} flag)
      string(REPLACE _ - flag ${flag})
      list(APPEND options ${flag} ${arg_${option}})
    endif()
  endforeach()
  set(uncertified)
  if(arg_UNCERTIFIED)
    set(uncertified --uncertified)
  endif()
  # The same law for others, beside the header. Advice is given once, with the header.
  set(others)
  set(compile_for COMMAND ${compiler} compile ${arg_NETWORK} ${options} ${uncertified} --no-advice --target)
  if(DEFINED arg_FMU)
    if(NOT arg_FMU MATCHES "^[23]$")
      message(FATAL_ERROR "dashpot_compile(${target}): FMU is '${arg_FMU}'; 2 or 3 is expected, the version of the standard")
    endif()
    list(APPEND outputs ${folder}/${name}.fmu)
    list(APPEND others ${compile_for} fmi${arg_FMU} -o ${folder})
  endif()
  if(arg_PYTHON)
    list(APPEND outputs ${folder}/python/${name}/__init__.py)
    list(APPEND others ${compile_for} python -o ${folder}/python)
  endif()
  if(arg_WASM)
    list(APPEND outputs ${folder}/wasm/${name}/index.js)
    list(APPEND others ${compile_for} wasm -o ${folder}/wasm)
  endif()
  list(APPEND options --target ${arg_TARGET})
  if(arg_CONSTANT_TIME)
    list(APPEND options --constant-time)
  endif()
  list(APPEND options ${uncertified})
  if(arg_BATCH)
    list(APPEND outputs ${folder}/${name}_batch.hpp)
    list(APPEND options --batch)
  endif()
  if(arg_TARGET STREQUAL "c99")
    set(test ${folder}/${name}_test.c)
  else()
    set(test ${folder}/${name}_test.cpp)
  endif()
  if(arg_WITH_TEST)
    list(APPEND outputs ${test})
    list(APPEND options --with-test)
  endif()
  if(arg_CERTIFICATE)
    cmake_path(ABSOLUTE_PATH arg_CERTIFICATE BASE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR} NORMALIZE)
    list(APPEND outputs ${arg_CERTIFICATE})
    list(APPEND options --certificate ${arg_CERTIFICATE})
  endif()
  set(describe_device)
  set(axes)
  if(arg_DEVICE)
    _dashpot_stated(axes axes "${arg_DEVICE}")
  endif()
  if(arg_DEVICE AND NOT (axes EQUAL 2 AND arg_TARGET STREQUAL "c99"))
    _dashpot_device_name_of(device_name "${arg_DEVICE}")
    list(APPEND outputs ${folder}/${device_name}_device.${suffix})
    set(describe_device COMMAND ${compiler} device ${arg_DEVICE} --target ${arg_TARGET}
                                -o ${folder}/${device_name}_device.${suffix})
  endif()

  file(MAKE_DIRECTORY ${folder})
  add_custom_command(
    OUTPUT ${outputs}
    # A network under a new name leaves no header of the old one.
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${folder}
    COMMAND ${compiler} compile ${arg_NETWORK} ${options} -o ${folder} --depfile ${folder}/${name}.d
    ${describe_device}
    ${others}
    DEPENDS ${arg_NETWORK} ${arg_DEVICE} ${compiler_file}
    DEPFILE ${folder}/${name}.d
    COMMENT "Compiling network ${name} for ${target}"
    VERBATIM)

  set(by_default)
  if(arg_FMU OR arg_PYTHON OR arg_WASM)  # which no program has to link
    set(by_default ALL)
  endif()
  add_custom_target(${target}_law ${by_default} DEPENDS ${outputs})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_law)
  target_include_directories(${target} INTERFACE ${folder})
  set_target_properties(${target} PROPERTIES DASHPOT_HEADER ${folder}/${name}.${suffix})
  if(arg_TARGET STREQUAL "cpp")
    set_target_properties(${target} PROPERTIES DASHPOT_CLASS dashpot::generated::${name})
    target_link_libraries(${target} INTERFACE dashpot::runtime)
  endif()
  # The bits that `dashpot simulate` prints are those of code without fused multiply-add.
  target_compile_options(${target} INTERFACE $<$<COMPILE_LANGUAGE:C,CXX>:-ffp-contract=off>)
  if(DEFINED arg_FMU)
    set_target_properties(${target} PROPERTIES DASHPOT_FMU ${folder}/${name}.fmu)
  endif()
  if(arg_PYTHON)
    set_target_properties(${target} PROPERTIES DASHPOT_PYTHON ${folder}/python)
  endif()
  if(arg_WASM)
    set_target_properties(${target} PROPERTIES DASHPOT_WASM ${folder}/wasm/${name}/index.js)
  endif()
  if(arg_WITH_TEST AND arg_TARGET STREQUAL "c99")
    add_executable(${target}_test ${test})
    target_link_libraries(${target}_test PRIVATE ${target} m)
    add_test(NAME ${target}_test COMMAND ${target}_test)
  elseif(arg_WITH_TEST)
    _dashpot_add_test(${target} ${test})
  endif()
endfunction()

# The command that compiles networks, and what has to be newer than the law: DASHPOT_COMPILER where it names one, else the
# target dashpot::dashpot, unless that is made for another machine; then one that is installed on this.
function(_dashpot_compiler result file)
  if(NOT DASHPOT_COMPILER AND CMAKE_CROSSCOMPILING)
    if(TARGET dashpot::dashpot)
      get_target_property(is_imported dashpot::dashpot IMPORTED)
      if(is_imported)
        foreach(property IN ITEMS IMPORTED_LOCATION IMPORTED_LOCATION_RELEASE IMPORTED_LOCATION_NOCONFIG
                                  IMPORTED_LOCATION_RELWITHDEBINFO IMPORTED_LOCATION_DEBUG IMPORTED_LOCATION_MINSIZEREL)
          get_target_property(location dashpot::dashpot ${property})
          if(location)
            execute_process(COMMAND ${location} --version OUTPUT_QUIET ERROR_QUIET RESULT_VARIABLE failed)
            if(failed STREQUAL "0")
              set(${result} ${location} PARENT_SCOPE)
              set(${file} ${location} PARENT_SCOPE)
              return()
            endif()
          endif()
        endforeach()
      endif()
    endif()
    find_program(DASHPOT_FOUND_COMPILER dashpot NO_CMAKE_FIND_ROOT_PATH DOC "A dashpot that runs on this machine")
    set(DASHPOT_COMPILER ${DASHPOT_FOUND_COMPILER})
    if(NOT DASHPOT_COMPILER)
      message(FATAL_ERROR "This build is for another machine, and no dashpot that runs on this one is found: name it with "
                          "-DDASHPOT_COMPILER=/path/to/dashpot")
    endif()
  endif()
  if(DASHPOT_COMPILER)
    if(NOT EXISTS ${DASHPOT_COMPILER})
      message(FATAL_ERROR "DASHPOT_COMPILER is '${DASHPOT_COMPILER}'; a file that is there is expected")
    endif()
    set(${result} ${DASHPOT_COMPILER} PARENT_SCOPE)
    set(${file} ${DASHPOT_COMPILER} PARENT_SCOPE)
  else()
    set(${result} dashpot::dashpot PARENT_SCOPE)
    set(${file} dashpot::dashpot PARENT_SCOPE)
  endif()
endfunction()

# The emitted file is called after the network, so its name is read when the build is configured, and again when the file
# changes. From a file that cannot be read no name comes; saying why is left to the compiler.
function(_dashpot_name_of result network)
  _dashpot_stated(stated name "${network}")
  if(stated MATCHES "^[A-Za-z][A-Za-z0-9_]*$")
    set(${result} ${stated} PARENT_SCOPE)
  else()
    cmake_path(GET network STEM name)
    set(${result} ${name} PARENT_SCOPE)
  endif()
endfunction()

function(_dashpot_device_name_of result device)
  _dashpot_stated(name name "${device}")
  string(REGEX REPLACE "[^A-Za-z0-9]" "_" name "${name}")
  set(${result} ${name} PARENT_SCOPE)
endfunction()

# What a file states under a key; nothing where there is no such file, or it cannot be read.
function(_dashpot_stated result key file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  set(stated)
  if(EXISTS ${file})
    file(READ ${file} text)
    string(JSON stated ERROR_VARIABLE unreadable GET "${text}" ${key})
    if(unreadable)
      set(stated)
    endif()
  endif()
  set(${result} "${stated}" PARENT_SCOPE)
endfunction()

function(_dashpot_add_test target source)
  find_package(GTest REQUIRED)
  include(GoogleTest)
  add_executable(${target}_test ${source})
  target_link_libraries(${target}_test PRIVATE ${target} GTest::gtest_main)
  gtest_discover_tests(${target}_test)
endfunction()
