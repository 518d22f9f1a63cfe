# cmake -DOUTPUT=… -DTEMPLATES="a;b" -DHEADER=… -DTYPE=… -DFUNCTION=… -P embed_templates.cmake: writes the files as raw string
# literals, which the function gives; the header declares it and the type of an entry.
set(entries "")
foreach(path IN LISTS TEMPLATES)
  get_filename_component(name "${path}" NAME)
  file(READ "${path}" text)
  string(APPEND entries "    {\"${name}\", R\"dashpot_template(${text})dashpot_template\"sv},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"${HEADER}\"\n\nnamespace dashpot::compiler {\n\n"
  "std::span<const ${TYPE}> ${FUNCTION}() {\n"
  "  using namespace std::string_view_literals;  // whose lengths no compiler has to count\n"
  "  static constexpr ${TYPE} all[] = {\n${entries}  };\n"
  "  return all;\n}\n\n}  // namespace dashpot::compiler\n")
