#include "commands/fmu.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <zip.h>

#include <memory>

#include "commands/system_compiler.hpp"
#include "emit/fmi_unit.hpp"

namespace dashpot::compiler {
namespace {

// The standard's name of this machine, by which an importer finds the library.
std::string platform(FmiVersion version) {
  struct utsname machine;
  const std::string processor = ::uname(&machine) == 0 ? machine.machine : "x86_64";
  if (version == FmiVersion::two && processor == "x86_64") return "linux64";
  return processor + "-linux";
}

std::optional<std::string> shared_library(const std::string& name, const std::string& source,
                                          Diagnostics& diagnostics) {
  const TemporaryFolder folder;
  const std::string library = name + ".so";
  if (!has_sources(folder, {{name + ".c", source}}, diagnostics) ||
      !makes_library({environment_or("CC", "cc"), "-std=c99", "-O2", "-ffp-contract=off", "-fPIC", "-shared",
                      "-fvisibility=hidden", "-s", "-Wl,--build-id=none"},
                     folder, name + ".c", library, diagnostics))
    return std::nullopt;
  return contents_of(folder.path() / library);
}

struct ErrorText {
  zip_error_t error;
  ErrorText() { zip_error_init(&error); }
  ~ErrorText() { zip_error_fini(&error); }
};

// The archive's bytes, or why there are none. Equal files make equal bytes: all are dated the first of January 1980.
std::optional<std::string> archive_of(const std::vector<OutputFile>& files, std::string& fault) {
  ErrorText why;
  zip_source_t* bytes = zip_source_buffer_create(nullptr, 0, 0, &why.error);
  zip_t* archive = bytes == nullptr ? nullptr : zip_open_from_source(bytes, ZIP_TRUNCATE, &why.error);
  if (archive == nullptr) {
    fault = zip_error_strerror(&why.error);
    if (bytes != nullptr) zip_source_free(bytes);
    return std::nullopt;
  }
  zip_source_keep(bytes);  // beyond the archive's end
  const std::unique_ptr<zip_source_t, decltype(&zip_source_free)> kept(bytes, zip_source_free);
  for (const OutputFile& file : files) {
    zip_source_t* content = zip_source_buffer(archive, file.text.data(), file.text.size(), 0);
    const zip_int64_t place =
        content == nullptr ? -1 : zip_file_add(archive, file.name.c_str(), content, ZIP_FL_ENC_UTF_8);
    if (place < 0 || zip_file_set_dostime(archive, zip_uint64_t(place), 0, (1 << 5) | 1, 0) < 0) {
      fault = zip_strerror(archive);
      if (place < 0 && content != nullptr) zip_source_free(content);
      zip_discard(archive);
      return std::nullopt;
    }
  }
  if (zip_close(archive) < 0) {
    fault = zip_strerror(archive);
    zip_discard(archive);
    return std::nullopt;
  }
  zip_stat_t facts;
  std::string result;
  if (zip_source_stat(bytes, &facts) == 0 && zip_source_open(bytes) == 0) {
    result.resize(facts.size);
    if (zip_source_read(bytes, result.data(), result.size()) == zip_int64_t(result.size())) {
      zip_source_close(bytes);
      return result;
    }
    zip_source_close(bytes);
  }
  fault = zip_error_strerror(zip_source_error(bytes));
  return std::nullopt;
}

constexpr const char* build_description =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiBuildDescription fmiVersion=\"3.0\">\n"
    "  <BuildConfiguration modelIdentifier=\"{0}\">\n"
    "    <SourceFileSet language=\"C99\" compiler=\"gcc\" compilerOptions=\"-ffp-contract=off\">\n"
    "      <SourceFile name=\"{0}.c\"/>\n    </SourceFileSet>\n  </BuildConfiguration>\n</fmiBuildDescription>\n";

std::optional<std::vector<OutputFile>> emit_fmu(const Compilation& compilation, FmiVersion version,
                                                const EmissionOptions& options, Diagnostics& diagnostics) {
  const std::string& name = compilation.network.name;
  std::optional<FmiUnit> unit = fmi_unit(compilation, version, options, diagnostics);
  std::optional<std::string> library = unit ? shared_library(name, unit->source, diagnostics) : std::nullopt;
  if (!library) return std::nullopt;
  std::vector<OutputFile> files = {{"modelDescription.xml", std::move(unit->description)},
                                   {"binaries/" + platform(version) + "/" + name + ".so", std::move(*library)},
                                   {"sources/" + name + ".c", std::move(unit->source)},
                                   {"documentation/index.html", std::move(unit->documentation)}};
  if (version == FmiVersion::three)
    files.push_back({"sources/buildDescription.xml", fmt::format(build_description, name)});
  std::string fault;
  std::optional<std::string> archive = archive_of(files, fault);
  if (archive) return std::vector<OutputFile>{{name + ".fmu", std::move(*archive)}};
  diagnostics.report<DiagnosticCode::cannot_write_file>({}, name + ".fmu", fault);
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<OutputFile>> emit_fmi2(const Compilation& compilation, const EmissionOptions& options,
                                                 Diagnostics& diagnostics) {
  return emit_fmu(compilation, FmiVersion::two, options, diagnostics);
}

std::optional<std::vector<OutputFile>> emit_fmi3(const Compilation& compilation, const EmissionOptions& options,
                                                 Diagnostics& diagnostics) {
  return emit_fmu(compilation, FmiVersion::three, options, diagnostics);
}

}  // namespace dashpot::compiler
