# dashpot_board_firmware(<target> [LAW <target of dashpot_compile> | MODEL_HEADER <file> MODEL_CLASS <class> | AXES <1|2>]
#                        [VELOCITY <initialiser>])
#
# Makes <target>.elf of the reference firmware in the current binary folder, with an emitted model on board where one is
# named, in float: a LAW made with SCALAR float, or the class in a header. VELOCITY initialises its velocity_description
# (default: the difference of two samples), of both joints alike. The board has the axes of its model; without one, AXES
# (default 1). The target's property ELF is the path. Without the cross compiler there is no
# target: check if(TARGET …). In a clone and in an installed dashpot alike; whatever the build itself is for.
find_program(DASHPOT_ARM_CXX arm-none-eabi-g++ NO_CMAKE_FIND_ROOT_PATH DOC "Cross compiler for the board's firmware")

set(dashpot_firmware_dir ${CMAKE_CURRENT_LIST_DIR} CACHE INTERNAL "Sources of the board's firmware")
if(EXISTS ${CMAKE_CURRENT_LIST_DIR}/../../../include/dashpot)  # else the package's configuration has said where
  set(dashpot_firmware_includes ${CMAKE_CURRENT_LIST_DIR}/../include ${CMAKE_CURRENT_LIST_DIR}/../../../include
      CACHE INTERNAL "Headers of the board's firmware")
endif()

set(dashpot_firmware_flags
  -std=c++17 -O2 -g -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics -ffp-contract=off
  -ffunction-sections -fdata-sections -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion
  CACHE INTERNAL "Flags of the board's firmware")

function(dashpot_board_firmware target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "LAW;MODEL_HEADER;MODEL_CLASS;AXES;VELOCITY" "")
  if(NOT DASHPOT_ARM_CXX)
    message(WARNING "arm-none-eabi-g++ is not installed: ${target} is not built")
    return()
  endif()

  set(flags ${dashpot_firmware_flags})
  if(DASHPOT_WARNINGS_AS_ERRORS)
    list(APPEND flags -Werror)
  endif()
  list(TRANSFORM dashpot_firmware_includes PREPEND -I OUTPUT_VARIABLE includes)
  if(arg_LAW)
    get_target_property(arg_MODEL_HEADER ${arg_LAW} DASHPOT_HEADER)
    get_target_property(arg_MODEL_CLASS ${arg_LAW} DASHPOT_CLASS)
    if(NOT arg_MODEL_CLASS)
      message(FATAL_ERROR "dashpot_board_firmware(${target}): LAW is '${arg_LAW}'; a target of dashpot_compile with a class in "
                          "C++ is expected")
    endif()
  endif()
  set(model)
  if(arg_MODEL_HEADER)
    set(model "-DDASHPOT_BOARD_MODEL_HEADER=\"${arg_MODEL_HEADER}\"" "-DDASHPOT_BOARD_MODEL_CLASS=${arg_MODEL_CLASS}")
  endif()
  if(arg_AXES)
    list(APPEND model -DDASHPOT_BOARD_AXES=${arg_AXES})
  endif()
  if(arg_VELOCITY)
    list(APPEND model "-DDASHPOT_BOARD_VELOCITY=${arg_VELOCITY}")
  endif()

  set(objects)
  foreach(source startup mps2_an386 main)
    set(object ${CMAKE_CURRENT_BINARY_DIR}/${target}_${source}.o)
    add_custom_command(OUTPUT ${object}
      COMMAND ${DASHPOT_ARM_CXX} ${flags} ${includes} ${model}
              -MD -MF ${object}.d -c ${dashpot_firmware_dir}/${source}.cpp -o ${object}
      DEPENDS ${dashpot_firmware_dir}/${source}.cpp ${arg_MODEL_HEADER} DEPFILE ${object}.d
      COMMENT "Cross-compiling ${target}_${source}.o" COMMAND_EXPAND_LISTS VERBATIM)
    list(APPEND objects ${object})
  endforeach()

  set(elf ${CMAKE_CURRENT_BINARY_DIR}/${target}.elf)
  set(script ${dashpot_firmware_dir}/mps2_an386.ld)
  add_custom_command(OUTPUT ${elf}
    COMMAND ${DASHPOT_ARM_CXX} ${flags} -nostdlib -nostartfiles -Wl,--gc-sections -T ${script}
            ${objects} -lc -lgcc -o ${elf}
    DEPENDS ${objects} ${script} COMMENT "Linking ${target}.elf" VERBATIM)
  add_custom_target(${target} ALL DEPENDS ${elf})
  set_target_properties(${target} PROPERTIES ELF ${elf})
  if(arg_LAW)
    add_dependencies(${target} ${arg_LAW})
  endif()
endfunction()
