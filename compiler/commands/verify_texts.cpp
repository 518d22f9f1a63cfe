#include "commands/verify_texts.hpp"

#include <fmt/format.h>

#include "compile.hpp"
#include "linear/reach.hpp"
#include "syntax/parse_device.hpp"
#include "verify/read_certificate.hpp"
#include "verify/verify_header.hpp"

namespace dashpot::compiler {
namespace {

// The first line of `found` that is not that of `expected`.
std::optional<std::string> first_difference(const std::string& found, const std::string& expected) {
  if (found == expected) return std::nullopt;
  std::size_t at = 0;
  while (at < found.size() && at < expected.size() && found[at] == expected[at]) ++at;
  const std::size_t start = at == 0 ? 0 : found.rfind('\n', at - 1) + 1;
  return found.substr(start, found.find('\n', at) - start);
}

// The code around the constants, which decides by jumps or in constant time.
void compare_code(const Compilation& compiled, const std::string& header, Diagnostics& diagnostics) {
  Diagnostics unheard;
  const std::string found = without_banner_and_digest(header);
  std::string by_jumps;
  for (const bool constant_time : {false, true}) {
    EmissionOptions options;
    options.constant_time = constant_time;
    const auto emitted = emit_cpp(compiled, options, unheard);
    if (!emitted) continue;
    const std::string expected = without_banner_and_digest(emitted->front().text);
    if (found == expected) return;
    if (!constant_time) by_jumps = expected;
  }
  if (const auto line = first_difference(found, by_jumps))
    diagnostics.report<DiagnosticCode::code_differs>({}, *line);
}

// A text of the certificate as a file that lives as long as diagnostics may point into it.
const SourceFile& kept(SourceFiles& files, const char* name, const std::string& text) {
  std::vector<std::unique_ptr<SourceFile>> one;
  one.push_back(std::make_unique<SourceFile>(name, text));
  const SourceFile& file = *one.front();
  files.keep(std::move(one));
  return file;
}

std::optional<Device> device_of(const CertificateFile& certificate, SourceFiles& files, Diagnostics& diagnostics) {
  if (!certificate.device_text) return std::nullopt;
  const auto decl = parse_device(kept(files, "device of the certificate", *certificate.device_text), diagnostics);
  return decl ? build_device(*decl, diagnostics) : std::nullopt;
}

}  // namespace

std::optional<std::string> verify_texts(const SourceFile& certificate_file, const SourceFile& header, SourceFiles& files,
                                        Diagnostics& diagnostics) {
  const std::optional<CertificateFile> certificate = read_certificate(certificate_file, diagnostics);
  if (!certificate) return std::nullopt;
  const SourceFile& network_file = kept(files, "network of the certificate", certificate->network_text);
  Diagnostics of_network;  // its warnings were given when it was compiled
  const std::optional<Network> network = check(network_file, of_network);
  const std::optional<Device> device = device_of(*certificate, files, diagnostics);
  const auto port = !network ? std::nullopt : device ? PortDevice::of(*device, *network, diagnostics) : PortDevice::ideal();
  if (!network) check(network_file, diagnostics);
  if (!port || diagnostics.has_errors()) {
    diagnostics.report<DiagnosticCode::no_certificate>({}, certificate_file.path(), "its network or device is not read");
    return std::nullopt;
  }
  const std::optional<HeaderConstants> constants = header_constants(header.text());
  if (!constants) {
    diagnostics.report<DiagnosticCode::no_emitted_header>({}, header.path());
    return std::nullopt;
  }
  if (!is_within_reach(*network, diagnostics, most_verified_nodes)) return std::nullopt;
  // What takes long is done last: many a wrong certificate is found out before.
  const bool is_linear = is_plainly_linear(*network);
  std::size_t count = is_linear ? verify_linear_constants(*certificate, *network, *port, *constants, diagnostics) : 0;
  Diagnostics unheard;
  const std::optional<Compilation> compiled = compile(network_file, certificate->choices, device, unheard);
  if (!compiled) {
    compile(network_file, certificate->choices, device, diagnostics);
    diagnostics.report<DiagnosticCode::no_certificate>({}, network_file.path(), "its network does not compile");
    return std::nullopt;
  }
  if (!is_linear) count = verify_constants(*certificate, *port, *constants, *compiled, diagnostics);
  compare_code(*compiled, header.text(), diagnostics);
  if (!diagnostics.has_errors()) verify_bounds(*certificate, *port, *constants, *compiled, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  return fmt::format("{}: {} constants are the nearest to those of the network, recomputed in 100 digits; the code is that of the network; {}\n",
                     network->name, count, certificate->certified ? "certified" : "not certified");
}

}  // namespace dashpot::compiler
