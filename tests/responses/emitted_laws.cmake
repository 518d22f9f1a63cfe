# Headers written by the compiler that is being built, as sources of a test.

# emit_laws(VARIANT NETWORKS files… CHOICES options…): every network compiled with the same choices, in a folder and a
# namespace of the variant's name. Adds to emitted_law_sources, emitted_law_headers and emitted_law_variants of the
# caller.
function(emit_laws variant)
  cmake_parse_arguments(PARSE_ARGV 1 laws "" "" "NETWORKS;CHOICES")
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/laws/${variant})
  set(includes "")
  set(entries "")
  set(headers "")
  foreach(network IN LISTS laws_NETWORKS)
    get_filename_component(name ${network} NAME_WE)
    list(APPEND headers ${folder}/${name}.hpp)
    string(APPEND includes "#include \"${variant}/${name}.hpp\"\n")
    string(APPEND entries "  append<dashpot::${variant}::${name}>(laws, variant, \"${name}\", \"${network}\");\n")
  endforeach()
  list(JOIN laws_CHOICES " " choices)
  configure_file(emitted_variant.cpp.in ${folder}/${variant}.cpp @ONLY)
  add_custom_command(
    OUTPUT ${headers}
    COMMAND ${CMAKE_COMMAND} -P ${CMAKE_CURRENT_SOURCE_DIR}/quietly.cmake --
            $<TARGET_FILE:dashpot::dashpot> compile ${laws_NETWORKS} ${laws_CHOICES} -o ${folder}
    DEPENDS dashpot::dashpot ${laws_NETWORKS}
    COMMENT "Emitting ${variant}"
    VERBATIM)
  set(emitted_law_sources ${emitted_law_sources} ${folder}/${variant}.cpp PARENT_SCOPE)
  set(emitted_law_headers ${emitted_law_headers} ${headers} PARENT_SCOPE)
  set(emitted_law_variants ${emitted_law_variants} ${variant} PARENT_SCOPE)
endfunction()

# One function that gathers all variants, in the order in which they were emitted.
function(write_registry)
  set(declarations "")
  set(calls "")
  foreach(variant IN LISTS emitted_law_variants)
    string(APPEND declarations "void append_${variant}(std::vector<EmittedLaw>& laws);\n")
    string(APPEND calls "  append_${variant}(laws);\n")
  endforeach()
  configure_file(registry.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/laws/registry.cpp @ONLY)
  set(emitted_law_sources ${emitted_law_sources} ${CMAKE_CURRENT_BINARY_DIR}/laws/registry.cpp PARENT_SCOPE)
endfunction()

function(has_slip_or_contact network result)
  file(READ ${network} text)
  string(REGEX MATCH "\"(slip|contact)\"" found "${text}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${network})
  if(found)
    set(${result} TRUE PARENT_SCOPE)
  else()
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()

# Maxwell branches side by side, all of different relaxation rates from about 0.1 to 10,000 per second.
function(write_parallel_branches file count)
  get_filename_component(name ${file} NAME_WE)
  set(branches "")
  foreach(i RANGE 1 ${count})
    math(EXPR damping "1000 * ${count} / (10 * ${i} + ${count} / 10)")
    string(APPEND branches ",\n  { \"series\": [ { \"damper\": \"${damping} mN s/m\" }, { \"spring\": \"${i} N/m\" } ] }")
  endforeach()
  file(CONFIGURE OUTPUT ${file} CONTENT
    "{ \"dashpot\": 1, \"name\": \"${name}\", \"network\": { \"parallel\": [\n  { \"spring\": 7 }${branches} ] } }\n")
endfunction()
