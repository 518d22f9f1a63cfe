#include "commands/verify_texts.hpp"

#include <fmt/format.h>

#include "compile.hpp"
#include "syntax/parse_device.hpp"
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

// What the network and the choices in the certificate give, compiled again: the code around the constants.
void compare_code(const CertificateFile& certificate, const SourceFile& network, const std::optional<Device>& device,
                  const std::string& header, Diagnostics& diagnostics) {
  Diagnostics unheard;
  const std::optional<Compilation> again = compile(network, certificate.choices, device, unheard);
  const auto emitted = again ? emit_cpp(*again, {}, unheard) : std::nullopt;
  if (!emitted) return diagnostics.report<DiagnosticCode::no_certificate>({}, network.path(), "its network does not compile");
  if (const auto line = first_difference(without_banner_and_digest(header), without_banner_and_digest(emitted->front().text)))
    diagnostics.report<DiagnosticCode::code_differs>({}, *line);
}

std::optional<Device> device_of(const CertificateFile& certificate, SourceFiles& files, Diagnostics& diagnostics) {
  if (!certificate.device_text) return std::nullopt;
  std::vector<std::unique_ptr<SourceFile>> text;
  text.push_back(std::make_unique<SourceFile>("device of the certificate", *certificate.device_text));
  const SourceFile& file = *text.front();
  files.keep(std::move(text));
  const auto decl = parse_device(file, diagnostics);
  return decl ? build_device(*decl, diagnostics) : std::nullopt;
}

}  // namespace

std::optional<std::string> verify_texts(const SourceFile& certificate_file, const SourceFile& header, SourceFiles& files,
                                        Diagnostics& diagnostics) {
  const std::optional<CertificateFile> certificate = read_certificate(certificate_file, diagnostics);
  if (!certificate) return std::nullopt;
  std::vector<std::unique_ptr<SourceFile>> text;
  text.push_back(std::make_unique<SourceFile>("network of the certificate", certificate->network_text));
  const SourceFile& network_file = *text.front();
  files.keep(std::move(text));
  Diagnostics of_network;  // its warnings were given when it was compiled
  const std::optional<Network> network = check(network_file, of_network);
  const std::optional<Device> device = device_of(*certificate, files, diagnostics);
  const auto port = !network ? std::nullopt : device ? PortDevice::of(*device, *network, diagnostics) : PortDevice::ideal();
  if (!port || diagnostics.has_errors()) {
    diagnostics.report<DiagnosticCode::no_certificate>({}, certificate_file.path(), "its network or device is not read");
    return std::nullopt;
  }
  const std::optional<HeaderConstants> constants = header_constants(header.text());
  if (!constants) {
    diagnostics.report<DiagnosticCode::no_emitted_header>({}, header.path());
    return std::nullopt;
  }
  const auto count = verify_constants(*certificate, *network, *port, *constants, diagnostics);
  if (!count) return std::nullopt;
  compare_code(*certificate, network_file, device, header.text(), diagnostics);
  if (!diagnostics.has_errors()) verify_bounds(*certificate, *port, *constants, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  return fmt::format("{}: {} constants are the nearest to those of the network, recomputed in 100 digits; the code is that of the network; {}\n",
                     network->name, *count, certificate->certified ? "certified" : "not certified");
}

}  // namespace dashpot::compiler
