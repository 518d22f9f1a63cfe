# cmake -DOUTPUT=… -DTEMPLATES="a;b" -P embed_templates.cmake: writes the templates as raw string literals.
set(entries "")
foreach(path IN LISTS TEMPLATES)
  get_filename_component(name "${path}" NAME)
  file(READ "${path}" text)
  string(APPEND entries "    {\"${name}\", R\"dashpot_template(${text})dashpot_template\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"emit/embedded_templates.hpp\"\n\nnamespace dashpot::compiler {\n\n"
  "std::span<const EmbeddedTemplate> embedded_templates() {\n  static constexpr EmbeddedTemplate all[] = {\n${entries}  };\n"
  "  return all;\n}\n\n}  // namespace dashpot::compiler\n")
