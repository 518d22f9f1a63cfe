# dashpot_board_firmware(<target> [MODEL_HEADER <file> MODEL_CLASS <class> [VELOCITY <initialiser>]])
#
# Makes <target>.elf of the reference firmware in the current binary folder, with the emitted model in <file> on board where
# one is named; VELOCITY initialises its velocity_description (default: the difference of two samples). The target's property ELF is the path. Without the cross compiler there is no target: check if(TARGET …).
find_program(DASHPOT_ARM_CXX arm-none-eabi-g++ DOC "Cross compiler for the board's firmware")

set(dashpot_firmware_dir ${CMAKE_CURRENT_LIST_DIR} CACHE INTERNAL "Sources of the board's firmware")

set(dashpot_firmware_flags
  -std=c++17 -O2 -g -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics -ffp-contract=off
  -ffunction-sections -fdata-sections -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror
  CACHE INTERNAL "Flags of the board's firmware")

function(dashpot_board_firmware target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "MODEL_HEADER;MODEL_CLASS;VELOCITY" "")
  if(NOT DASHPOT_ARM_CXX)
    message(WARNING "arm-none-eabi-g++ is not installed: ${target} is not built")
    return()
  endif()

  set(includes -I${dashpot_firmware_dir}/../include -I${dashpot_firmware_dir}/../../../include)
  set(model)
  if(arg_MODEL_HEADER)
    set(model "-DDASHPOT_BOARD_MODEL_HEADER=\"${arg_MODEL_HEADER}\"" "-DDASHPOT_BOARD_MODEL_CLASS=${arg_MODEL_CLASS}")
  endif()
  if(arg_VELOCITY)
    list(APPEND model "-DDASHPOT_BOARD_VELOCITY=${arg_VELOCITY}")
  endif()

  set(objects)
  foreach(source startup mps2_an386 main)
    set(object ${CMAKE_CURRENT_BINARY_DIR}/${target}_${source}.o)
    add_custom_command(OUTPUT ${object}
      COMMAND ${DASHPOT_ARM_CXX} ${dashpot_firmware_flags} ${includes} ${model}
              -MD -MF ${object}.d -c ${dashpot_firmware_dir}/${source}.cpp -o ${object}
      DEPENDS ${dashpot_firmware_dir}/${source}.cpp ${arg_MODEL_HEADER} DEPFILE ${object}.d
      COMMENT "Cross-compiling ${target}_${source}.o" COMMAND_EXPAND_LISTS VERBATIM)
    list(APPEND objects ${object})
  endforeach()

  set(elf ${CMAKE_CURRENT_BINARY_DIR}/${target}.elf)
  set(script ${dashpot_firmware_dir}/mps2_an386.ld)
  add_custom_command(OUTPUT ${elf}
    COMMAND ${DASHPOT_ARM_CXX} ${dashpot_firmware_flags} -nostdlib -nostartfiles -Wl,--gc-sections -T ${script}
            ${objects} -lc -lgcc -o ${elf}
    DEPENDS ${objects} ${script} COMMENT "Linking ${target}.elf" VERBATIM)
  add_custom_target(${target} ALL DEPENDS ${elf})
  set_target_properties(${target} PROPERTIES ELF ${elf})
endfunction()
